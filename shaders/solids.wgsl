// Balls and boxes in space: a quad around each, in which every pixel looks along its rays. Edges are smooth by the share of
// rays that meet it. Where those of its corners all miss, or all meet one face, the others do so too.

// World from clip space in four columns; then of each solid its centre and radius (0 of a box), and its axes with half its
// sides [m].
@group(0) @binding(3) var<storage, read> solids: array<vec4<f32>>;

// Rays across a pixel, and down it.
const RAYS: u32 = 4u;
// How far below its surface a solid hides things [its size]: what lies on it, by triangles whose middles dip into it, is seen. Where it is looked
// along, that is further behind, up to the second number of times as far.
const SUNK: f32 = 0.02;
const ASLANT: f32 = 5.0;

struct Solid {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) first: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Solid {
    let first = 4u + 4u * (index / 6u);
    let center = solids[first];
    var low = frame.viewport;
    var high = vec2(0.0);
    for (var k = 0u; k < 8u; k++) {
        var at = center.xyz;
        for (var axis = 0u; axis < 3u; axis++) {
            let side = solids[first + 1u + axis];
            at += side.xyz * side.w * select(-1.0, 1.0, ((k >> axis) & 1u) == 1u);
        }
        let clip = frame.clip_from_world * vec4(at, 1.0);
        // What reaches behind the camera may be anywhere.
        let is_ahead = clip.w > frame.near;
        low = min(low, select(vec2(0.0), pixel_of(clip), is_ahead));
        high = max(high, select(frame.viewport, pixel_of(clip), is_ahead));
    }
    low = max(low - 2.0, vec2(0.0));
    high = min(high + 2.0, frame.viewport);
    let corner = mix(low, high, 0.5 * corner_of(index % 6u) + 0.5);
    var out: Solid;
    out.position = clip_of(corner, vec4(0.0, 0.0, 0.5, 1.0));
    out.first = first;
    return out;
}

// The last ray of a row of them.
const LAST: u32 = RAYS - 1u;

// Where a ray meets a solid: the normal there, and how far along it; below 0 where it does not.
fn met(first: u32, origin: vec3<f32>, along: vec3<f32>) -> vec4<f32> {
    let center = solids[first];
    let off = origin - center.xyz;
    if center.w > 0.0 {
        let b = dot(off, along);
        let across = off - along * b;
        let rest = center.w * center.w - dot(across, across);
        let t = -b - sqrt(max(rest, 0.0));
        return vec4((off + along * t) / center.w, select(-1.0, t, rest > 0.0));
    }
    var enters = 0.0;
    var leaves = 1e30;
    var normal = vec3(0.0);
    for (var axis = 0u; axis < 3u; axis++) {
        let side = solids[first + 1u + axis];
        let goes = dot(along, side.xyz);
        let from_center = dot(off, side.xyz);
        let rate = select(goes, 1e-20, abs(goes) < 1e-20);
        let near = (-sign(rate) * side.w - from_center) / rate;
        let far = (sign(rate) * side.w - from_center) / rate;
        if near > enters {
            enters = near;
            normal = -sign(rate) * side.xyz;
        }
        leaves = min(leaves, far);
    }
    return vec4(normal, select(-1.0, enters, enters < leaves && enters > 0.0));
}

struct Seen {
    @location(0) color: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

// What the rays of a pixel have found.
struct Found {
    hits: f32,
    light: f32,
    nearest: f32,
    place: vec3<f32>,
    // The normal of the first that met something, and whether all are that of one face: those of a ball are.
    normal: vec3<f32>,
    is_face: bool,
}

// A ray of a pixel whose middle lies, at two depths, where `near` and `far` say, with a pixel's ways across and down.
fn seen_along(k: u32, first: u32, near: vec4<f32>, far: vec4<f32>, ways: mat2x4<f32>, before: Found) -> Found {
    let offset = ways * ((vec2(f32(k % RAYS), f32(k / RAYS)) + 0.5) / f32(RAYS) - 0.5);
    let base = near + offset;
    let to = far + offset;
    let origin = base.xyz / base.w;
    let along = normalize(to.xyz / to.w - origin);
    let hit = met(first, origin, along);
    var found = before;
    if hit.w >= 0.0 {
        if found.hits == 0.0 {
            found.normal = hit.xyz;
        }
        found.is_face &= solids[first].w > 0.0 || dot(found.normal, hit.xyz) > 0.999;
        found.hits += 1.0;
        // From above, and a little from the eye.
        found.light += max(dot(hit.xyz, normalize(vec3(0.25, 1.0, 0.1) - 0.7 * along)), 0.0);
        if hit.w < found.nearest {
            found.nearest = hit.w;
            let size = max(solids[first].w, min(solids[first + 1u].w, solids[first + 2u].w));
            let faced = max(-dot(hit.xyz, along), 1.0 / ASLANT);
            found.place = origin + along * (hit.w + SUNK * size / faced);
        }
    }
    return found;
}

@fragment
fn fragment(in: Solid) -> Seen {
    let world = mat4x4(solids[0], solids[1], solids[2], solids[3]);
    let ndc = (in.position.xy / frame.viewport - 0.5) * vec2(2.0, -2.0);
    let near = world * vec4(ndc, 0.0, 1.0);
    let far = world * vec4(ndc, 0.99, 1.0);
    let ways = mat2x4(world[0] * (2.0 / frame.viewport.x), world[1] * (-2.0 / frame.viewport.y));
    var found = Found(0.0, 0.0, 1e30, vec3(0.0), vec3(0.0), true);
    for (var k = 0u; k < 4u; k++) {
        found = seen_along(LAST * (k % 2u) + RAYS * LAST * (k / 2u), in.first, near, far, ways, found);
    }
    var rays = 4.0;
    if found.hits > 0.0 && (found.hits < 4.0 || !found.is_face) {
        for (var k = 1u; k < RAYS * RAYS - 1u; k++) {
            if k != LAST && k != RAYS * LAST {
                found = seen_along(k, in.first, near, far, ways, found);
            }
        }
        rays = f32(RAYS * RAYS);
    }
    let share = found.hits / rays;
    if found.hits == 0.0 || (PART == 1u && share < 1.0) || (PART == 2u && share >= 1.0) {
        discard;
    }
    let clip = frame.clip_from_world * vec4(found.place, 1.0);
    let color = mix(frame.obstacle_color, frame.rim_color, 0.1 + 0.75 * found.light / found.hits);
    return Seen(vec4(color.rgb, color.a * share), clamp(clip.z / clip.w, 0.0, 1.0));
}
