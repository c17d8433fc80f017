// What every pass shares: the frame, the positions of two states, and the way from the world to the screen.
// Put in front of each of the other shaders, with shapes.wgsl and discs.wgsl.

// Numbers a point has in the position buffers: 2 in the plane, 3 in space.
override DIMENSIONS: u32 = 2u;

struct Frame {
    clip_from_world: mat4x4<f32>,
    // Colours, not premultiplied.
    bond_color: vec4<f32>,
    stretch_color: vec4<f32>,
    squeeze_color: vec4<f32>,
    point_color: vec4<f32>,
    pin_color: vec4<f32>,
    region_color: vec4<f32>,
    obstacle_color: vec4<f32>,
    rim_color: vec4<f32>,
    // Left, top, right, bottom of what obstacles may cover [px].
    obstacles: vec4<f32>,
    // Centre and radius of the mouse region [px], and its shape: 1 round, 2 square.
    region: vec4<f32>,
    // Size of the target [px].
    viewport: vec2<f32>,
    // What is drawn lies between two states: 0 = previous, 1 = current.
    mix: f32,
    // Width of a bond [px].
    bond_width: f32,
    // Radius of a point [px].
    point_radius: f32,
    // Strain at which the tint is halfway to its full colour; 0: no tint.
    strain_scale: f32,
    // Width of outlines [px].
    outline_width: f32,
    // Least distance from the camera that is seen [m]: what lies nearer is cut off. 0 in the plane.
    near: f32,
    // Radius of dots that stand for bonds [px].
    dot_radius: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> previous: array<f32>;
@group(0) @binding(2) var<storage, read> current: array<f32>;

fn position_of(point: u32) -> vec3<f32> {
    let i = point * DIMENSIONS;
    var before = vec3(previous[i], previous[i + 1u], 0.0);
    var now = vec3(current[i], current[i + 1u], 0.0);
    if DIMENSIONS == 3u {
        before.z = previous[i + 2u];
        now.z = current[i + 2u];
    }
    return mix(before, now, frame.mix);
}

// From clip space to pixels, y down.
fn pixel_of(clip: vec4<f32>) -> vec2<f32> {
    return (clip.xy / clip.w * vec2(0.5, -0.5) + 0.5) * frame.viewport;
}

// From pixels back to clip space, at the depth of `clip`.
fn clip_of(pixel: vec2<f32>, clip: vec4<f32>) -> vec4<f32> {
    let ndc = (pixel / frame.viewport - 0.5) * vec2(2.0, -2.0);
    return vec4(ndc * clip.w, clip.z, clip.w);
}
