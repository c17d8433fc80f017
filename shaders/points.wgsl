// Points: discs around the positions, pinned ones in another colour.

// Marks the pinned ones.
const PINNED: u32 = 0x80000000u;

// The points in the order that they are drawn in.
@group(0) @binding(3) var<storage, read> points: array<u32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Disc {
    let point = points[index / 3u];
    let is_pinned = (point & PINNED) != 0u;
    let color = select(frame.point_color, frame.pin_color, is_pinned);
    return disc(index % 3u, position_of(point & ~PINNED), color, frame.point_radius * select(1.0, 1.35, is_pinned));
}

@fragment
fn fragment(in: Disc) -> @location(0) vec4<f32> {
    return disc_color(in);
}
