// Obstacles: what of each pixel they cover is added up in a target of its own, triangle by triangle; then their rims are
// found; then both are shown at once. Drawn straight onto the picture, two triangles that share a pixel would let what lies
// below show through between them.

// Corners of triangles, three after each other; then ends of edges, two after each other, the first at a multiple of six.
@group(0) @binding(2) var<storage, read> corners: array<vec2<f32>>;
// What of each pixel is covered; when it is shown, also what of that is rim.
@group(1) @binding(0) var covered: texture_2d<f32>;
@group(1) @binding(1) var smooth_sampler: sampler;

struct Triangle {
    @builtin(position) position: vec4<f32>,
    // Its corners [px].
    @location(0) @interpolate(flat) ab: vec4<f32>,
    @location(1) @interpolate(flat) c: vec2<f32>,
}

fn on_screen(corner: u32) -> vec2<f32> {
    return pixel_of(frame.clip_from_world * vec4(corners[corner], 0.0, 1.0));
}

// The box along the longest side of a triangle, with all pixels that the triangle touches.
@vertex
fn cover_vertex(@builtin(vertex_index) index: u32) -> Triangle {
    let first = 3u * (index / 6u);
    var at = array(on_screen(first), on_screen(first + 1u), on_screen(first + 2u));
    var along = vec2(0.0);
    for (var k = 0u; k < 3u; k++) {
        let side = at[(k + 1u) % 3u] - at[k];
        along = select(along, side, dot(side, side) > dot(along, along));
    }
    along = select(vec2(1.0, 0.0), normalize(along), length(along) > 1e-6);
    let across = vec2(-along.y, along.x);
    let room = reach(0.0, along);
    var low = vec2(0.0);
    var high = vec2(0.0);
    for (var k = 0u; k < 3u; k++) {
        let from_first = vec2(dot(at[k] - at[0], along), dot(at[k] - at[0], across));
        low = min(low, from_first);
        high = max(high, from_first);
    }
    let corner = mix(low - room, high + room, 0.5 * corner_of(index % 6u) + 0.5);
    var out: Triangle;
    out.position = clip_of(at[0] + along * corner.x + across * corner.y, vec4(0.0, 0.0, 0.0, 1.0));
    out.ab = vec4(at[0], at[1]);
    out.c = at[2];
    return out;
}

// Area of the pixel about 0 to the left of a segment, between the heights of its ends; negative where it leads down.
//
// Always reckoned from the upper end: triangles on both sides of an edge find the same area, and leave no seam.
fn beside(from_point: vec2<f32>, to_point: vec2<f32>) -> f32 {
    let is_down = from_point.y > to_point.y;
    let a = select(from_point, to_point, is_down);
    let b = select(to_point, from_point, is_down);
    let low = clamp(a.y, -0.5, 0.5);
    let high = clamp(b.y, -0.5, 0.5);
    if low >= high {
        return 0.0;
    }
    let slope = (b.x - a.x) / (b.y - a.y);
    let ends = a.x + (vec2(low, high) - a.y) * slope;
    let left = min(ends.x, ends.y);
    let right = max(ends.x, ends.y);
    // How far the pixel reaches to the left of the segment: 0 left of it, 1 right of it, in between its place.
    var mean = clamp(0.5 * (left + right), -0.5, 0.5) + 0.5;
    if right - left > 1e-4 {
        let inside = clamp(vec2(left, right), vec2(-0.5), vec2(0.5));
        let beyond = max(right, 0.5) - max(left, 0.5);
        mean = ((inside.y - inside.x) * (0.5 * (inside.x + inside.y) + 0.5) + beyond) / (right - left);
    }
    return select(1.0, -1.0, is_down) * (high - low) * mean;
}

// Distance from 0 to the line through two points [px], positive to one side.
fn from_line(a: vec2<f32>, b: vec2<f32>) -> f32 {
    let side = b - a;
    return (a.x * side.y - a.y * side.x) / max(length(side), 1e-20);
}

@fragment
fn cover_fragment(in: Triangle) -> @location(0) vec4<f32> {
    let middle = in.position.xy;
    let a = in.ab.xy - middle;
    let b = in.ab.zw - middle;
    let c = in.c - middle;
    let sides = vec3(from_line(a, b), from_line(b, c), from_line(c, a));
    let least = min(min(sides.x, sides.y), sides.z);
    let most = max(max(sides.x, sides.y), sides.z);
    // No pixel reaches further from its middle.
    if least > 0.708 || most < -0.708 {
        return vec4(1.0, 0.0, 0.0, 0.0);
    }
    return vec4(abs(beside(a, b) + beside(b, c) + beside(c, a)), 0.0, 0.0, 0.0);
}

// The part of the picture that obstacles may be in.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let pixel = mix(frame.obstacles.xy, frame.obstacles.zw, 0.5 * corner_of(index) + 0.5);
    return clip_of(pixel, vec4(0.0, 0.0, 0.0, 1.0));
}

// Width of a wall [px] below which it is drawn as if it had that, where there are rims.
const LEAST_WIDTH: f32 = 0.9;

// How many times as wide as it is what is covered about a pixel must be drawn: 1 where it is wide enough. Of a straight wall a
// square of three pixels holds three times its width; beside an edge of something wide there is a row that is covered.
fn widening(at: vec2<i32>) -> f32 {
    var sum = 0.0;
    for (var k = 0; k < 9; k++) {
        sum += min(textureLoad(covered, at + vec2(k % 3 - 1, k / 3 - 1), 0).r, 1.0);
    }
    return clamp(3.0 * min(LEAST_WIDTH, frame.outline_width) / max(sum, 1e-4), 1.0, 1024.0);
}

// What is covered as it is, where no edge is near.
@fragment
fn plain_fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    return vec4(min(textureLoad(covered, vec2<i32>(position.xy), 0).r, 1.0), 0.0, 0.0, 0.0);
}

// How far from an edge beyond the width of a rim what is found there may be other than beside none [px]: a rim looks for what is free in a mean of
// four pixels, and an edge is in a pixel up to half its diagonal away.
const BEYOND: f32 = 2.2;

// The box along an edge with all pixels that it may matter to.
@vertex
fn edge_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let first = 2u * (index / 6u);
    let a = on_screen(first);
    let b = on_screen(first + 1u);
    let along = select(vec2(1.0, 0.0), normalize(b - a), distance(a, b) > 1e-6);
    let corner = corner_of(index % 6u);
    let off = (frame.outline_width + BEYOND) * corner;
    let pixel = select(a, b, corner.x > 0.0) + along * off.x + vec2(-along.y, along.x) * off.y;
    return clip_of(pixel, vec4(0.0, 0.0, 0.0, 1.0));
}

// Directions in which the rim looks for what is free.
const DIRECTIONS: u32 = 12u;

// Rims: what is free within their width makes a covered pixel a part of one. So obstacles that overlap have one together.
@fragment
fn rim_fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let share = min(textureLoad(covered, vec2<i32>(position.xy), 0).r, 1.0);
    if share == 0.0 {
        return vec4(0.0);
    }
    var least = share;
    for (var k = 0u; k < DIRECTIONS; k++) {
        let angle = 6.2831853 / f32(DIRECTIONS) * f32(k);
        let at = position.xy + frame.outline_width * vec2(cos(angle), sin(angle));
        least = min(least, textureSampleLevel(covered, smooth_sampler, at / frame.viewport, 0.0).r);
    }
    return vec4(min(share * widening(vec2<i32>(position.xy)), 1.0), 1.0 - least, 0.0, 0.0);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let share = textureLoad(covered, vec2<i32>(position.xy), 0).rg;
    if share.r == 0.0 {
        discard;
    }
    let color = mix(frame.obstacle_color, frame.rim_color, share.g);
    return vec4(color.rgb, color.a * share.r);
}
