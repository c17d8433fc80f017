// Skins: pictures on triangles, and along their free sides a stroke in the picture's own colours, which smooths the edge.

// A corner of a triangle: its point, and where that lies in the picture.
struct Corner {
    point: u32,
    u: f32,
    v: f32,
}

@group(0) @binding(3) var<storage, read> corners: array<Corner>;
@group(1) @binding(0) var picture: texture_2d<f32>;
@group(1) @binding(1) var smooth_sampler: sampler;

struct Skin {
    @builtin(position) position: vec4<f32>,
    @location(0) at: vec2<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Skin {
    let corner = corners[index];
    var out: Skin;
    out.position = frame.clip_from_world * vec4(position_of(corner.point), 1.0);
    out.at = vec2(corner.u, corner.v);
    return out;
}

@fragment
fn fragment(in: Skin) -> @location(0) vec4<f32> {
    let color = textureSample(picture, smooth_sampler, in.at);
    return vec4(color.rgb, 1.0);
}

// Width of the stroke along free sides [px], and how dark it may be.
const EDGE: f32 = 1.6;
const DARKEST: f32 = 0.35;

// Free sides follow the triangles in the list: two corners each.
@vertex
fn edge_vertex(@builtin(vertex_index) index: u32) -> Stroke {
    let first = 2u * (index / 6u);
    let a = corners[first];
    let b = corners[first + 1u];
    let middle = 0.5 * vec2(a.u + b.u, a.v + b.v);
    let color = textureSampleLevel(picture, smooth_sampler, middle, 0.0);
    // Dark bodies would be lost on the dark ground.
    let lift = max(DARKEST - dot(color.rgb, vec3(0.3, 0.6, 0.1)), 0.0);
    return stroke(index % 6u, position_of(a.point), position_of(b.point), vec4(color.rgb + lift, 1.0), EDGE);
}

@fragment
fn edge_fragment(in: Stroke) -> @location(0) vec4<f32> {
    return stroke_color(in);
}
