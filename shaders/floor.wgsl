// The floor in space: a quad a little lighter than the ground, and over it one with the soft shadow of what is above, from cells.

// A corner (w: how much lighter); two sides (w: their lengths) [m]; where the cells begin along both, how wide they are [m], how dark it gets;
// how many they are along both; then the cells, four a row, along the first side first.
@group(0) @binding(2) var<storage, read> rows: array<vec4<f32>>;

struct Floor {
    @builtin(position) position: vec4<f32>,
    // Along both sides, from where the cells begin [cells].
    @location(0) at: vec2<f32>,
    // How dark it gets, and how many cells there are along both sides.
    @location(1) @interpolate(flat) cells: vec3<f32>,
    // The colour where there is no shadow.
    @location(2) @interpolate(flat) plain: vec3<f32>,
}

// The floor, then the part of it that the cells of the shadow lie on.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Floor {
    let sides = vec2(rows[1].w, rows[2].w);
    let cells = rows[3];
    let is_shadow = index >= 6u;
    let low = select(vec2(0.0), cells.xy, is_shadow);
    let high = select(sides, cells.xy + cells.z * rows[4].xy, is_shadow);
    let at = clamp(mix(low, high, 0.5 * corner_of(index % 6u) + 0.5), vec2(0.0), sides);
    let share = at / max(sides, vec2(1e-30));
    var out: Floor;
    out.position = frame.clip_from_world * vec4(rows[0].xyz + share.x * rows[1].xyz + share.y * rows[2].xyz, 1.0);
    out.at = (at - cells.xy) / max(cells.z, 1e-9);
    out.cells = vec3(cells.w, rows[4].xy);
    out.plain = mix(frame.ground.rgb, frame.rim_color.rgb, rows[0].w);
    return out;
}

@fragment
fn fragment(in: Floor) -> @location(0) vec4<f32> {
    return fogged(vec4(in.plain, 1.0), in.position.w);
}

fn cell(column: i32, row: i32, size: vec2<i32>) -> f32 {
    let is_there = (column >= 0) & (row >= 0) & (column < size.x) & (row < size.y);
    let place = u32(select(0, row * size.x + column, is_there));
    return select(0.0, rows[5u + place / 4u][place % 4u], is_there);
}

@fragment
fn shadow_fragment(in: Floor) -> @location(0) vec4<f32> {
    let size = vec2<i32>(in.cells.yz);
    let at = in.at - 0.5;
    let low = vec2<i32>(floor(at));
    let share = at - floor(at);
    let below = mix(cell(low.x, low.y, size), cell(low.x + 1, low.y, size), share.x);
    let above = mix(cell(low.x, low.y + 1, size), cell(low.x + 1, low.y + 1, size), share.x);
    let dark = in.cells.x * mix(below, above, share.y);
    return fogged(vec4(in.plain * (1.0 - dark), 1.0), in.position.w);
}
