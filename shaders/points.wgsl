// Points: discs around the positions; pinned ones larger, in another colour, with a bright middle. A dark edge parts them from what they
// lie on.

// Marks the pinned ones.
const PINNED: u32 = 0x80000000u;
// A pin beside other points [1], and the radius of its middle beside its own [1].
const PIN: f32 = 1.35;
const MIDDLE: f32 = 0.36;
// Width of the dark edge, where there is room for one [px].
const EDGE: f32 = 1.1;

// The points in the order that they are drawn in.
@group(0) @binding(2) var<storage, read> points: array<u32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Disc {
    let point = points[index / 3u];
    let is_pinned = (point & PINNED) != 0u;
    let place = position_of(point & ~PINNED);
    var color = select(frame.point_color, frame.pin_color, is_pinned);
    if MAPS && is_set(frame.difference_scale, place.x) && !is_pinned {
        color = vec4(difference_color(values[point & ~PINNED]).rgb, color.a);
    }
    let radius = select(frame.point_radius, max(PIN * frame.point_radius, frame.least_pin), is_pinned);
    var out = disc(index % 3u, place, color, radius);
    out.is_pin = select(0.0, 1.0, is_pinned);
    return out;
}

@fragment
fn fragment(in: Disc) -> @location(0) vec4<f32> {
    var color = disc_color(in);
    if is_set(frame.coil_length, in.radius) && in.radius > 2.0 {
        let off = in.position.xy - in.center;
        let inner = coverage(off, in.radius - EDGE);
        color = vec4(mix(frame.ground.rgb, color.rgb, inner), color.a);
        if in.is_pin > 0.5 {
            color = vec4(mix(color.rgb, vec3(1.0), coverage(off, MIDDLE * in.radius)), color.a);
        }
    }
    return color;
}
