// Points: discs around the positions, pinned ones in another colour.

// A bit a point: 1 = pinned.
@group(0) @binding(3) var<storage, read> pinned: array<u32>;

struct Disc {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) center: vec2<f32>,
    @location(1) @interpolate(flat) color: vec4<f32>,
    @location(2) @interpolate(flat) radius: f32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Disc {
    let point = index / 6u;
    let clip = frame.clip_from_world * vec4(position_of(point), 1.0);
    let is_pinned = ((pinned[point / 32u] >> (point % 32u)) & 1u) == 1u;
    var out: Disc;
    out.color = select(frame.point_color, frame.pin_color, is_pinned);
    out.radius = frame.point_radius * select(1.0, 1.35, is_pinned);
    if clip.w < frame.near {
        out.position = nowhere();
        return out;
    }
    out.center = pixel_of(clip);
    out.position = clip_of(out.center + corner_of(index % 6u) * (out.radius + 1.0), clip);
    return out;
}

@fragment
fn fragment(in: Disc) -> @location(0) vec4<f32> {
    let covered = coverage(in.position.xy - in.center, in.radius);
    if covered <= LEAST_COVERAGE {
        discard;
    }
    return vec4(in.color.rgb, in.color.a * covered);
}
