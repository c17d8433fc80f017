// The region of the mouse force at the cursor: an outline where the force ends, and a breath of colour inside.

// Opacity of the inside.
const FILL: f32 = 0.07;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let reach = frame.region.z + frame.outline_width + 1.0;
    return clip_of(frame.region.xy + corner_of(index) * reach, vec4(0.0, 0.0, 0.0, 1.0));
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let from_center = position.xy - frame.region.xy;
    var to_edge = from_center * (1.0 - frame.region.z / max(length(from_center), 1e-6));
    if frame.region.w == 2.0 {
        // To the nearest side of the square: along the axis that is further out.
        let beyond = abs(from_center) - frame.region.z;
        to_edge = select(vec2(0.0, beyond.y), vec2(beyond.x, 0.0), beyond.x > beyond.y);
    }
    let is_inside = dot(to_edge, from_center) < 0.0 || (frame.region.w == 2.0 && max(to_edge.x, to_edge.y) <= 0.0);
    let outline = coverage(to_edge, 0.5 * frame.outline_width);
    let inside = select(0.0, FILL, is_inside);
    return vec4(frame.region_color.rgb, frame.region_color.a * max(outline, inside));
}
