// What every pass shares: the frame, the positions of two states, and the way from the world to the screen.
// Put in front of each of the other shaders.

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

// Corner of a quad: (-1 or 1, -1 or 1), for the six vertices of its two triangles.
fn corner_of(vertex: u32) -> vec2<f32> {
    let right = vertex == 1u || vertex == 2u || vertex == 4u;
    let upper = vertex == 2u || vertex == 4u || vertex == 5u;
    return vec2(select(-1.0, 1.0, right), select(-1.0, 1.0, upper));
}

// A point that no pixel is drawn for.
fn nowhere() -> vec4<f32> {
    return vec4(2.0, 2.0, 2.0, 1.0);
}

// A stroke from `a` to `b` on the screen: the quad around it, and what the fragment needs to measure its distance.
struct Stroke {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) ends: vec4<f32>,
    @location(1) @interpolate(flat) color: vec4<f32>,
    @location(2) @interpolate(flat) width: f32,
}

fn stroke(vertex: u32, world_a: vec3<f32>, world_b: vec3<f32>, color: vec4<f32>, width: f32) -> Stroke {
    var a = frame.clip_from_world * vec4(world_a, 1.0);
    var b = frame.clip_from_world * vec4(world_b, 1.0);
    var out: Stroke;
    out.color = color;
    out.width = width;
    if a.w < frame.near && b.w < frame.near {
        out.position = nowhere();
        return out;
    }
    if a.w < frame.near {
        a = mix(a, b, (frame.near - a.w) / (b.w - a.w));
    }
    if b.w < frame.near {
        b = mix(b, a, (frame.near - b.w) / (a.w - b.w));
    }
    let from_pixel = pixel_of(a);
    let to_pixel = pixel_of(b);
    let span = to_pixel - from_pixel;
    let extent = length(span);
    // A stroke of no length is a dot.
    let along = select(vec2(1.0, 0.0), span / max(extent, 1e-20), extent > 1e-6);
    let across = vec2(-along.y, along.x);
    // Half the width, and a pixel for the smooth edge.
    let reach = 0.5 * width + 1.0;
    let corner = corner_of(vertex);
    let at_b = corner.x > 0.0;
    let end_pixel = select(from_pixel, to_pixel, at_b);
    let end_clip = vec4(select(a.x, b.x, at_b), select(a.y, b.y, at_b), select(a.z, b.z, at_b), select(a.w, b.w, at_b));
    out.position = clip_of(end_pixel + (along * corner.x + across * corner.y) * reach, end_clip);
    out.ends = vec4(from_pixel, to_pixel);
    return out;
}

fn squared_above_zero(x: f32) -> f32 {
    let y = max(x, 0.0);
    return y * y;
}

// Share of a pixel on the inner side of a straight edge `depth` inside of which its middle lies [px].
// Across the edge's normal a square pixel is as wide as two boxes, |n.x| and |n.y|, folded together.
fn inside_edge(depth: f32, normal: vec2<f32>) -> f32 {
    let wide = max(abs(normal.x), abs(normal.y));
    let narrow = max(min(abs(normal.x), abs(normal.y)), 1e-3);
    let x = depth + 0.5 * (wide + narrow);
    let folded = squared_above_zero(x) - squared_above_zero(x - wide) - squared_above_zero(x - narrow)
        + squared_above_zero(x - wide - narrow);
    return clamp(folded / (2.0 * wide * narrow), 0.0, 1.0);
}

// Share of a pixel that lies within `radius` of something that is `offset` away from its middle [px].
fn coverage(offset: vec2<f32>, radius: f32) -> f32 {
    let distance = length(offset);
    let normal = select(vec2(1.0, 0.0), offset / max(distance, 1e-12), distance > 1e-6);
    // The far edge matters where the shape is thinner than the pixel.
    return max(inside_edge(radius - distance, normal) + inside_edge(radius + distance, normal) - 1.0, 0.0);
}

// What covers less of a pixel is left out. In space it would hide what lies behind it by its depth.
override LEAST_COVERAGE: f32 = select(0.0, 0.35, DIMENSIONS == 3u);

fn stroke_color(in: Stroke) -> vec4<f32> {
    let from_a = in.position.xy - in.ends.xy;
    let span = in.ends.zw - in.ends.xy;
    let t = clamp(dot(from_a, span) / max(dot(span, span), 1e-12), 0.0, 1.0);
    let covered = coverage(from_a - span * t, 0.5 * in.width);
    if covered <= LEAST_COVERAGE {
        discard;
    }
    return vec4(in.color.rgb, in.color.a * covered);
}
