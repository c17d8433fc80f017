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
    let round = length(from_center);
    let square = max(abs(from_center.x), abs(from_center.y));
    let distance = select(round, square, frame.region.w == 2.0);
    let outline = coverage(abs(distance - frame.region.z), 0.5 * frame.outline_width);
    let inside = FILL * coverage(distance, frame.region.z);
    return vec4(frame.region_color.rgb, frame.region_color.a * max(outline, inside));
}
