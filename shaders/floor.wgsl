// The floor in space: a quad a little lighter than the ground, and on it the soft shadow of what is above, from cells.

// A corner (w: how much lighter); two sides (w: their lengths) [m]; where the cells begin along both, how wide they are [m], how dark it gets;
// how many they are along both; then the cells, four a row, along the first side first.
@group(0) @binding(3) var<storage, read> rows: array<vec4<f32>>;

struct Floor {
    @builtin(position) position: vec4<f32>,
    // Along both sides [m].
    @location(0) at: vec2<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Floor {
    let share = 0.5 * corner_of(index) + 0.5;
    let place = rows[0].xyz + share.x * rows[1].xyz + share.y * rows[2].xyz;
    var out: Floor;
    out.position = frame.clip_from_world * vec4(place, 1.0);
    out.at = share * vec2(rows[1].w, rows[2].w);
    return out;
}

fn cell(column: i32, row: i32, size: vec2<i32>) -> f32 {
    let is_there = (column >= 0) & (row >= 0) & (column < size.x) & (row < size.y);
    let place = u32(select(0, row * size.x + column, is_there));
    return select(0.0, rows[5u + place / 4u][place % 4u], is_there);
}

@fragment
fn fragment(in: Floor) -> @location(0) vec4<f32> {
    let size = vec2<i32>(rows[4].xy);
    let at = (in.at - rows[3].xy) / max(rows[3].z, 1e-9) - 0.5;
    let low = vec2<i32>(floor(at));
    let share = at - floor(at);
    let below = mix(cell(low.x, low.y, size), cell(low.x + 1, low.y, size), share.x);
    let above = mix(cell(low.x, low.y + 1, size), cell(low.x + 1, low.y + 1, size), share.x);
    let dark = rows[3].w * mix(below, above, share.y);
    let plain = mix(frame.ground.rgb, frame.rim_color.rgb, rows[0].w);
    return fogged(vec4(plain * (1.0 - dark), 1.0), in.position.w);
}
