// The region of the mouse force at the cursor: an outline where the force ends, and a breath of colour inside.

// Opacity of the inside.
const FILL: f32 = 0.07;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    // A pixel reaches 0.71 px from its middle at most.
    let reach = frame.region.z + 0.5 * frame.outline_width + 0.71;
    return clip_of(frame.region.xy + corner_of(index) * reach, vec4(0.0, 0.0, 0.0, 1.0));
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let from_center = position.xy - frame.region.xy;
    var from_middle = length(from_center);
    var to_edge = from_center * (1.0 - frame.region.z / max(from_middle, 1e-6));
    if is_set(frame.region.w - 1.5, position.x) {
        // To the nearest side of the square: along the axis that is further out.
        let out = abs(from_center);
        from_middle = max(out.x, out.y);
        let beyond = from_middle - frame.region.z;
        to_edge = select(vec2(0.0, beyond), vec2(beyond, 0.0), out.x > out.y);
    }
    let outline = coverage(to_edge, 0.5 * frame.outline_width);
    let inside = select(0.0, FILL, from_middle < frame.region.z);
    return vec4(frame.region_color.rgb, frame.region_color.a * max(outline, inside));
}
