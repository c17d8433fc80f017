// What every pass shares: the frame, the positions, and the way from the world to the screen.
// Put in front of each of the other shaders, with shapes.wgsl and discs.wgsl.

// Numbers a point has in the position buffer: 2 in the plane, 3 in space.
override DIMENSIONS: u32 = 2u;
// Whether strains or distances may be shown by colours: what works them out is left out of the shader where they are not.
override MAPS: bool = true;
// What is seen of the forms of bonds: 0 nothing, 1 by their colour that rigid ones are stretched, 2 whatever there is. What is not is left out likewise.
override FORMS: u32 = 2u;
// Which primitives of fills are drawn: 0 any of them, 1 triangles of bodies alone, 2 cells of nets alone, 3 triangles of bodies and outlines. What others take is left out likewise.
override KINDS: u32 = 0u;

struct Frame {
    clip_from_world: mat4x4<f32>,
    // Colours, not premultiplied.
    ground: vec4<f32>,
    bond_color: vec4<f32>,
    rope_color: vec4<f32>,
    // From squeezed by `strain_full` to stretched by it.
    strain_colors: array<vec4<f32>, 9>,
    point_color: vec4<f32>,
    pin_color: vec4<f32>,
    region_color: vec4<f32>,
    obstacle_color: vec4<f32>,
    rim_color: vec4<f32>,
    // Of balls and boxes in space: where no light falls, and where all does.
    shade_color: vec4<f32>,
    lit_color: vec4<f32>,
    // Left, top, right, bottom of what obstacles may cover [px].
    obstacles: vec4<f32>,
    // Centre and radius of the mouse region [px], and its shape: 1 round, 2 square.
    region: vec4<f32>,
    // Lower and upper corner of the walls of the plane [m], far away where there are none.
    walls: vec4<f32>,
    // Size of the target [px].
    viewport: vec2<f32>,
    // Width of a bond [px].
    bond_width: f32,
    // Radius of a point [px].
    point_radius: f32,
    // Strain below which colours change in proportion to it, above by its logarithm; 0: no strain is shown.
    strain_scale: f32,
    // Strain of the last colours [1].
    strain_full: f32,
    // Width of outlines [px].
    outline_width: f32,
    // Least distance from the camera that is seen [m]: what lies nearer is cut off. 0 in the plane.
    near: f32,
    // Radius of dots that stand for bonds [px].
    dot_radius: f32,
    // Least radius of a pinned point [px].
    least_pin: f32,
    // Length of a spring on the screen from which on it is drawn as a coil [px]; 0: all bonds are plain strokes.
    coil_length: f32,
    // Opacity of fills, 0 where they and pictures are not shown, and the width of their outlines [px].
    fill_opacity: f32,
    fill_outline: f32,
    // Distances from the camera from which on, and up to which, things fade into the ground [m], and by how much at most.
    fog_from: f32,
    fog_to: f32,
    fog: f32,
    // Distance below which colours change in proportion to it, above by its logarithm [m]; 0: none is shown. Of the last colours [m].
    difference_scale: f32,
    difference_full: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> positions: array<f32>;
// What points are coloured by: not there where no difference is shown.
@group(0) @binding(3) var<storage, read> values: array<f32>;

fn position_of(point: u32) -> vec3<f32> {
    let i = point * DIMENSIONS;
    var position = vec3(positions[i], positions[i + 1u], 0.0);
    if DIMENSIONS == 3u {
        position.z = positions[i + 2u];
    }
    return position;
}

// Whether a number of the frame is above 0, asked together with a coordinate of the vertex or pixel, which may be any. Drivers that build a shader
// anew for what a uniform that it branches by is now do so in each frame, and may keep all that they built (Mesa's lavapipe 22.3).
fn is_set(number: f32, other: f32) -> bool {
    return (number > 0.0) & (other > -1e30);
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

// The colour of a strain.
fn strain_color(strain: f32) -> vec4<f32> {
    let share = asinh(abs(strain) / frame.strain_scale) / asinh(frame.strain_full / frame.strain_scale);
    return map_color(min(share, 1.0) * sign(strain));
}

// The colour of a place on the scale, -1 to 1.
fn map_color(share: f32) -> vec4<f32> {
    let place = 4.0 + 4.0 * share;
    let low = u32(clamp(floor(place), 0.0, 7.0));
    return mix(frame.strain_colors[low], frame.strain_colors[low + 1u], place - f32(low));
}

// The colour of a distance [m]; below 0 it is not known.
fn difference_color(difference: f32) -> vec4<f32> {
    let share = asinh(max(difference, 0.0) / frame.difference_scale) / asinh(frame.difference_full / frame.difference_scale);
    return select(map_color(min(share, 1.0)), frame.bond_color, difference < 0.0);
}

// A colour as it is seen from afar, in space; `inverse` is one over the distance along the view.
fn fogged(color: vec4<f32>, inverse: f32) -> vec4<f32> {
    if DIMENSIONS == 2u {
        return color;
    }
    let share = frame.fog * smoothstep(frame.fog_from, frame.fog_to, 1.0 / max(inverse, 1e-12));
    return vec4(mix(color.rgb, frame.ground.rgb, share), color.a);
}
