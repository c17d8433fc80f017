// Balls and boxes in space: a quad around each, in which every pixel looks along its rays. Edges are smooth by the share of
// rays that meet it. A pixel far from all edges looks along one: what is there is the same all over it.

// World from clip space in four columns; then of each solid its centre and radius (0 of a box), and its axes with half its
// sides [m].
@group(0) @binding(2) var<storage, read> solids: array<vec4<f32>>;

// Rays across a pixel, and down it.
const RAYS: u32 = 4u;
// How far from a pixel's middle its rays may go across and down [px], with room for what is not straight.
const SPREAD: f32 = 0.4;
// How far below its surface a solid hides things [its size]: what lies on it, by triangles whose middles dip into it, is seen. Where it is looked
// along, that is further behind, up to the second number of times as far.
const SUNK: f32 = 0.02;
const ASLANT: f32 = 5.0;
// Where light comes from, and how much of it from the eye: the world's way, before it has a length of 1.
const LIGHT: vec3<f32> = vec3(0.25, 1.0, 0.1);
const FROM_EYE: f32 = 0.7;

// A solid as its pixels see it, from its centre on and along its axes [m]. A driver without a GPU takes long for each look into a buffer: all that
// a pixel needs comes with the quad.
struct Solid {
    @builtin(position) position: vec4<f32>,
    // Half its sides, and its radius.
    @location(0) @interpolate(flat) half: vec4<f32>,
    @location(1) @interpolate(flat) eye: vec3<f32>,
    // From the eye to the nearest that is seen: at the upper left corner of the picture, and from a pixel to the next across and down.
    @location(2) @interpolate(flat) corner: vec3<f32>,
    @location(3) @interpolate(flat) across: vec3<f32>,
    @location(4) @interpolate(flat) down: vec3<f32>,
    @location(5) @interpolate(flat) light: vec3<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Solid {
    let first = 4u + 4u * (index / 6u);
    let center = solids[first];
    let sides = array(solids[first + 1u], solids[first + 2u], solids[first + 3u]);
    var low = frame.viewport;
    var high = vec2(0.0);
    for (var k = 0u; k < 8u; k++) {
        let signs = select(vec3(-1.0), vec3(1.0), (vec3(k) & vec3(1u, 2u, 4u)) != vec3(0u));
        let at = center.xyz + signs.x * sides[0].xyz * sides[0].w + signs.y * sides[1].xyz * sides[1].w + signs.z * sides[2].xyz * sides[2].w;
        let clip = frame.clip_from_world * vec4(at, 1.0);
        // What reaches behind the camera may be anywhere.
        let is_ahead = clip.w > frame.near;
        low = min(low, select(vec2(0.0), pixel_of(clip), is_ahead));
        high = max(high, select(frame.viewport, pixel_of(clip), is_ahead));
    }
    low = max(low - 2.0, vec2(0.0));
    high = min(high + 2.0, frame.viewport);
    let corner = mix(low, high, 0.5 * corner_of(index % 6u) + 0.5);
    // All rays come from where clip space has no width; what is nearest has one depth.
    let eye = solids[2].xyz / solids[2].w;
    let scale = 1.0 / solids[3].w;
    let own = transpose(mat3x3(sides[0].xyz, sides[1].xyz, sides[2].xyz));
    var out: Solid;
    out.position = clip_of(corner, vec4(0.0, 0.0, 0.5, 1.0));
    out.half = vec4(sides[0].w, sides[1].w, sides[2].w, center.w);
    out.eye = own * (eye - center.xyz);
    out.corner = own * ((solids[3].xyz - solids[0].xyz + solids[1].xyz) * scale - eye);
    out.across = own * solids[0].xyz * (2.0 * scale / frame.viewport.x);
    out.down = own * solids[1].xyz * (-2.0 * scale / frame.viewport.y);
    out.light = own * LIGHT;
    return out;
}

// Where a ray meets a solid: the normal there, and how far along it, 1 where it is nearest to what is seen; below 0 where it does not.
fn met(in: Solid, along: vec3<f32>) -> vec4<f32> {
    // A ball.
    let radius = in.half.w;
    let length = dot(along, along);
    let middle = -dot(in.eye, along) / length;
    let off = in.eye + along * middle;
    let rest = radius * radius - dot(off, off);
    let round = middle - sqrt(max(rest, 0.0) / length);
    // A box.
    let rate = select(along, vec3(1e-20), abs(along) < vec3(1e-20));
    let enters = (-sign(rate) * in.half.xyz - in.eye) / rate;
    let leaves = (sign(rate) * in.half.xyz - in.eye) / rate;
    let entered = max(max(enters.x, enters.y), enters.z);
    let left = min(min(leaves.x, leaves.y), leaves.z);
    // Of faces that it enters at once the first: no edge is brighter than both.
    let is_face = vec3(enters.x == entered, enters.x < entered && enters.y == entered, max(enters.x, enters.y) < entered);
    let face = select(vec3(0.0), -sign(rate), is_face);
    let is_ball = radius > 0.0;
    let normal = select(face, (in.eye + along * round) / max(radius, 1e-20), is_ball);
    let at = select(entered, round, is_ball);
    let is_met = select(left > entered, rest > 0.0, is_ball) && at > 1.0;
    return vec4(normal, select(-1.0, at, is_met));
}

// Whether all rays of a pixel meet what the one through its middle does, where that meets something.
fn is_within(in: Solid, along: vec3<f32>, hit: vec4<f32>) -> bool {
    let place = in.eye + along * hit.w;
    // As the ray goes across and down, so far goes the place: on the face of a box along it.
    let rate = dot(along, hit.xyz);
    let across = SPREAD * hit.w * abs(in.across - along * (dot(in.across, hit.xyz) / rate));
    let down = SPREAD * hit.w * abs(in.down - along * (dot(in.down, hit.xyz) / rate));
    let is_inside = (abs(place) + across + down <= in.half.xyz) | (abs(hit.xyz) > vec3(0.5));
    // A ball is seen as far from its edge as the ray goes by its centre.
    let off = length(in.eye - along * (dot(in.eye, along) / dot(along, along)));
    let room = SPREAD * hit.w * (length(in.across) + length(in.down));
    return hit.w > 0.0 && select(all(is_inside), in.half.w > off + 1.1 * room, in.half.w > 0.0);
}

// Whether all rays of a pixel miss a solid by more than they are apart.
fn is_beside(in: Solid, along: vec3<f32>) -> bool {
    let farthest = (length(in.eye) + length(in.half.xyz)) * inverseSqrt(dot(along, along));
    var wider = in;
    let room = SPREAD * farthest * (abs(in.across) + abs(in.down));
    wider.half = in.half + select(vec4(room, 0.0), vec4(vec3(0.0), length(room)), in.half.w > 0.0);
    return met(wider, along).w < 0.0;
}

struct Seen {
    @location(0) color: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

// How bright a place is with this normal, seen along a ray: from above, and a little from the eye.
fn light_of(in: Solid, normal: vec3<f32>, along: vec3<f32>) -> f32 {
    return max(dot(normal, normalize(in.light - FROM_EYE * normalize(along))), 0.0);
}

@fragment
fn fragment(in: Solid) -> Seen {
    let along = in.corner + in.across * in.position.x + in.down * in.position.y;
    let hit = met(in, along);
    let is_whole = is_within(in, along, hit);
    let is_none = hit.w < 0.0 && is_beside(in, along);
    if is_none || (PART == 2u && is_whole) {
        discard;
    }
    var hits = select(0.0, 1.0, is_whole);
    var light = light_of(in, hit.xyz, along);
    var nearest = hit;
    let rays = select(RAYS * RAYS, 0u, is_whole || is_none);
    if rays > 0u {
        light = 0.0;
        nearest.w = 1e30;
    }
    for (var k = 0u; k < rays; k++) {
        let off = (vec2(f32(k % RAYS), f32(k / RAYS)) + 0.5) / f32(RAYS) - 0.5;
        let ray = along + in.across * off.x + in.down * off.y;
        let other = met(in, ray);
        if other.w > 0.0 {
            hits += 1.0;
            light += light_of(in, other.xyz, ray);
            if other.w < nearest.w {
                nearest = other;
            }
        }
    }
    let share = hits / f32(max(rays, 1u));
    if hits == 0.0 || (PART == 1u && share < 1.0) || (PART == 2u && share >= 1.0) {
        discard;
    }
    let size = max(in.half.w, min(in.half.x, in.half.y));
    let faced = max(-dot(nearest.xyz, normalize(along)), 1.0 / ASLANT);
    let place = nearest.w + SUNK * size / (faced * length(along));
    // Depth goes as one over the distance, from 0 where that is 1.
    let far = length(vec3(frame.clip_from_world[0].z, frame.clip_from_world[1].z, frame.clip_from_world[2].z));
    let whole = length(vec3(frame.clip_from_world[0].w, frame.clip_from_world[1].w, frame.clip_from_world[2].w));
    let depth = far / whole * (1.0 - 1.0 / place);
    let color = mix(frame.shade_color, frame.lit_color, light / hits);
    return Seen(vec4(color.rgb, color.a * share), clamp(depth, 0.0, 1.0));
}
