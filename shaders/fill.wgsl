// Fills: bodies without a picture. Primitives of nine kinds in the order that they are drawn in: cells of nets, threads that tore, a soft shadow about what is
// covered, that, where a map is shown bonds within it that are no side of a triangle, and its outline; of figures of limbs rim and flesh of round strokes in place
// of outlines, and below them what is covered, seen only where bonds are shown through it.

struct Primitive {
    // Of a fill the corners of two triangles; of a side its ends in the middle, those before and after beside them, then 1 where it may
    // be an arc. Of a limb two points
    // for each end, then the bits of its larger radius [m], and ten each: shares of the ways between those, lesser radius by the larger.
    points: array<u32, 6>,
    // The kind in the upper eight bits, with the mark PAINTED where points may have colours of their own, then red, green, blue.
    ink: u32,
}

@group(0) @binding(2) var<storage, read> primitives: array<Primitive>;
// Of each point red, green and blue of its own from the lowest byte on, then whether it has them.
@group(0) @binding(4) var<storage, read> own: array<vec2<u32>>;
// A row a point: its normal in space, which is shorter the sharper an edge it is on, 0 where triangles are flat up to it, and the mean strain of
// its bonds. Not there where neither is shown.
@group(1) @binding(0) var<storage, read> shades: array<vec4<f32>>;

const FILL: u32 = 0u;
const OUTLINE: u32 = 1u;
const SHADOW: u32 = 2u;
const INNER: u32 = 3u;
const FLESH: u32 = 4u;
const SKIN: u32 = 5u;
const UNDER: u32 = 6u;
const CELL: u32 = 7u;
const THREAD: u32 = 8u;
const PAINTED: u32 = 0x80u;
// Marks corners of cells that these fade towards.
const FRAYED: u32 = 0x80000000u;

struct Fill {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) line: vec4<f32>,
    // What is painted in part goes from one colour to the other along a triangle.
    @location(1) color: vec4<f32>,
    // As of a stroke, then the kind.
    @location(2) @interpolate(flat) size: vec3<f32>,
    // In a triangle: shares of its corners. In an outline the first is how far its arc bulges out [px].
    @location(3) share: vec3<f32>,
    // Normal, and strain or distance.
    @location(4) shade: vec4<f32>,
}

fn color_of(ink: u32) -> vec3<f32> {
    return vec3(f32((ink >> 16u) & 255u), f32((ink >> 8u) & 255u), f32(ink & 255u)) / 255.0;
}

// Whether something is shown in place of colours. Bodies in their colours have no lines on them in the plane, however large they are.
fn shows_map(other: f32) -> bool {
    return MAPS && (is_set(frame.strain_scale, other) | is_set(frame.difference_scale, other));
}

// The colour of a primitive at a point.
fn color_at(ink: u32, point: u32) -> vec3<f32> {
    if ((ink >> 24u) & PAINTED) == 0u {
        return color_of(ink);
    }
    let painted = unpack4x8unorm(own[point].x);
    return select(color_of(ink), painted.rgb, painted.a > 0.5);
}

// The normal that a corner of a triangle in space is lit by: that of the surface, or that of the triangle where it has an edge.
fn lit_by(normal: vec3<f32>, place: u32, corner: u32) -> vec3<f32> {
    let first = select(0u, 3u, corner >= 3u);
    let a = position_of(primitives[place].points[first]);
    let b = position_of(primitives[place].points[first + 1u]);
    let c = position_of(primitives[place].points[first + 2u]);
    let face = cross(b - a, c - a);
    let size = length(face);
    return normal + select(vec3(0.0), face / max(size, 1e-30), size > 0.0) * max(1.0 - length(normal), 0.0);
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Fill {
    let primitive = primitives[index / 6u];
    let corner = index % 6u;
    let kind = select((primitive.ink >> 24u) & ~PAINTED, CELL, KINDS == 2u);
    let has_all = KINDS == 0u;
    var out: Fill;
    out.color = vec4(color_of(primitive.ink), 1.0);
    out.size.z = f32(kind);
    if KINDS == 1u || KINDS == 2u || kind == FILL || kind == UNDER || (has_all && kind == CELL) {
        let marked = primitives[index / 6u].points[corner];
        let point = select(marked, marked & ~FRAYED, kind == CELL);
        let place = position_of(point);
        out.color = vec4(color_at(primitive.ink, point), 1.0);
        let is_hidden = kind == UNDER && !(frame.fill_opacity < 1.0);
        out.position = select(frame.clip_from_world * vec4(place, 1.0), nowhere(), is_hidden);
        // The second triangle is of corners 3, 4 and 5, or shares 0 and 2 with the first.
        let second = vec2<bool>(corner == 1u || corner == 5u, corner == 2u || corner == 4u);
        out.share = select(vec3(0.0), vec3(1.0), vec3<bool>(corner % 3u == 0u, second.x, second.y));
        if DIMENSIONS == 3u || (MAPS && is_set(frame.strain_scale, place.x)) {
            out.shade = shades[point];
        }
        if DIMENSIONS == 3u {
            out.shade = vec4(lit_by(out.shade.xyz, index / 6u, corner), out.shade.w);
        }
        if MAPS && is_set(frame.difference_scale, place.x) {
            out.shade.w = values[point];
        }
        if kind == CELL {
            // Of the plane, which has no normals.
            out.shade.x = select(1.0, FADED, marked != point);
        }
        return out;
    }
    if has_all && kind == THREAD {
        return thread(out, corner, primitive);
    }
    if has_all && (kind == FLESH || kind == SKIN) {
        return limb(out, corner, primitive, kind);
    }
    let a = position_of(primitive.points[1]);
    let b = position_of(primitive.points[2]);
    if KINDS == 3u || kind == OUTLINE || kind == INNER {
        let end = primitive.points[select(1u, 2u, corner_of(corner).x > 0.0)];
        out.color = vec4(color_at(primitive.ink, end), 1.0);
        let width = select(frame.fill_outline, INNER_WIDTH, has_all && kind == INNER);
        var high = 0.0;
        if DIMENSIONS == 2u && kind == OUTLINE && primitive.points[4] == 1u {
            high = bulge(a, b, position_of(primitive.points[0]), position_of(primitive.points[3]));
        }
        let side = stroke(corner, a, b, out.color, width + 2.0 * high);
        out.position = select(side.position, nowhere(), has_all && kind == INNER && !shows_map(a.x));
        out.line = side.line;
        out.size = vec3(side.size.x, 0.5 * width, f32(kind));
        out.share = vec3(high, 0.0, 0.0);
        if MAPS && is_set(frame.strain_scale, a.x) {
            out.shade = shades[end];
        }
        if MAPS && is_set(frame.difference_scale, a.x) {
            out.shade.w = values[end];
        }
        return out;
    }
    return shadow(out, corner, a, b, position_of(primitive.points[0]), position_of(primitive.points[3]));
}

// A corner of a cell of a net where no map is shown: it has its colour alone, which in the plane needs no perspective.
struct Cell {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(linear) color: vec4<f32>,
}

@vertex
fn cell_vertex(@builtin(vertex_index) index: u32) -> Cell {
    let marked = primitives[index / 6u].points[index % 6u];
    let point = marked & ~FRAYED;
    let color = dimmed(color_at(primitives[index / 6u].ink, point));
    let opacity = frame.fill_opacity * CELL_OPACITY.x * select(1.0, FADED, marked != point);
    return Cell(frame.clip_from_world * vec4(position_of(point), 1.0), vec4(color, opacity));
}

@fragment
fn cell_fragment(in: Cell) -> @location(0) vec4<f32> {
    return in.color;
}

// Turns of an outline from one side to the next up to which it is round, and from which on it has a corner [rad]: those of a regular polygon
// of ten sides, and of one of eight, which is one.
const ROUND: vec2<f32> = vec2(0.65, 0.75);
// Ratio of two turns, and of two sides, from which on they begin to be alike, and are.
const ALIKE: vec2<f32> = vec2(0.35, 0.65);
// A bulge that is not seen [px].
const FLAT: f32 = 0.05;

// How far a side of an outline bulges out [px]: as the circle does that it turns along, where both turns at its ends are alike and no corners.
// At a polygon of ten sides that is a twelfth of a side.
fn bulge(a: vec3<f32>, b: vec3<f32>, before: vec3<f32>, after: vec3<f32>) -> f32 {
    let sides = array(a.xy - before.xy, b.xy - a.xy, after.xy - b.xy);
    let long = vec3(length(sides[0]), length(sides[1]), length(sides[2]));
    let shortest = min(min(long.x, long.y), long.z);
    let longest = max(max(long.x, long.y), long.z);
    if !(shortest > ALIKE.x * longest) {
        return 0.0;
    }
    let turns = vec2(turn(sides[0], sides[1]), turn(sides[1], sides[2]));
    let least = min(turns.x, turns.y);
    let most = max(turns.x, turns.y);
    if !(least > 0.0 && most < ROUND.y) {
        return 0.0;
    }
    let is_round = smoothstep(ALIKE.x, ALIKE.y, shortest / longest) * smoothstep(ALIKE.x, ALIKE.y, least / most)
        * (1.0 - smoothstep(ROUND.x, ROUND.y, most));
    // The angle between a side of a circle and its tangent is half of a turn.
    let angle = 0.25 * (turns.x + turns.y) * is_round;
    let metre = abs(0.5 * frame.clip_from_world[1].y * frame.viewport.y);
    let high = 0.5 * long.y * tan(0.5 * angle) * metre;
    return select(0.0, high, high > FLAT);
}

// From one side of an outline to the next [rad], to the left.
fn turn(side: vec2<f32>, next: vec2<f32>) -> f32 {
    return atan2(side.x * next.y - side.y * next.x, dot(side, next));
}

// An end of a limb so thick [m], where it lies on a wall that its point may touch: what is drawn of it does not dip into that.
fn within(place: vec3<f32>, radius: f32) -> vec3<f32> {
    let low = frame.walls.xy + radius;
    let kept = clamp(place.xy, low, max(frame.walls.zw - radius, low));
    // What is beyond a wall is shown where it is.
    let is_near = all(abs(kept - place.xy) <= vec2(1.01 * radius));
    return vec3(select(place.xy, kept, is_near), place.z);
}

// A round stroke whose ends have radii of their own.
fn limb(plain: Fill, corner: u32, primitive: Primitive, kind: u32) -> Fill {
    let packed = primitive.points[5];
    let parts = vec3<f32>(vec3(packed, packed >> 10u, packed >> 20u) & vec3(1023u)) / 1023.0;
    let larger = bitcast<f32>(primitive.points[4]);
    let thick = select(vec2(larger, larger * parts.z), vec2(larger * parts.z, larger), (packed >> 30u) == 1u);
    let a = within(mix(position_of(primitive.points[0]), position_of(primitive.points[1]), parts.x), thick.x);
    let b = within(mix(position_of(primitive.points[2]), position_of(primitive.points[3]), parts.y), thick.y);
    // Limbs are of the plane, where a metre is as long everywhere.
    let metre = abs(0.5 * frame.clip_from_world[1].y * frame.viewport.y);
    let rim = select(0.0, frame.fill_outline, kind == SKIN);
    let radii = thick * metre + rim;
    let side = stroke(corner, a, b, plain.color, 2.0 * max(radii.x, radii.y));
    var out = plain;
    // Where bonds are shown through fills, what overlaps would be seen.
    out.position = select(side.position, nowhere(), frame.fill_opacity < 1.0);
    out.line = side.line;
    out.size = vec3(side.size, f32(kind));
    out.share = vec3(radii, 0.0);
    return out;
}

// How long what is left of a thread is, beside its length at rest and how far apart its ends are now [1]; how opaque a cell is beside one that
// tore, beside others.
const LEFT: vec2<f32> = vec2(0.45, 0.4);
const FADED: f32 = 0.2;

// What is left of a thread that tore at one of its ends: it points to the other.
fn thread(plain: Fill, corner: u32, primitive: Primitive) -> Fill {
    let a = position_of(primitive.points[0]);
    let way = position_of(primitive.points[1]) - a;
    let far = length(way);
    let long = min(LEFT.x * bitcast<f32>(primitive.points[2]), LEFT.y * far);
    let side = stroke(corner, a, a + way * (long / max(far, 1e-6)), plain.color, frame.bond_width);
    var out = plain;
    // The other end may be gone.
    out.position = select(nowhere(), side.position, far > 0.0 && far < 1e30);
    // Of the colour that bonds have there.
    let own_color = color_at(primitive.ink, primitive.points[0]);
    let is_own = any(own_color != color_of(primitive.ink));
    out.color = vec4(select(frame.bond_color.rgb, own_color, is_own), frame.bond_color.a);
    out.line = side.line;
    out.size = vec3(side.size.x, 0.5 * frame.bond_width, f32(THREAD));
    return out;
}

// Reach of a shadow to both sides of its outline, and how far below the body it lies [widths of an outline].
const SHADOW_REACH: vec2<f32> = vec2(2.0, 8.0);
const SHADOW_FALL: f32 = 1.5;
// Opacity of the darkest place of a shadow on a black ground and on a white one [1]: on that it takes light which the other has not.
const DARKEST: vec2<f32> = vec2(0.45, 0.15);

// A stretch of shadow beside a side: it ends where those of the sides before and after begin.
fn shadow(plain: Fill, vertex: u32, a: vec3<f32>, b: vec3<f32>, before: vec3<f32>, after: vec3<f32>) -> Fill {
    let at = array(
        pixel_of(frame.clip_from_world * vec4(before, 1.0)),
        pixel_of(frame.clip_from_world * vec4(a, 1.0)),
        pixel_of(frame.clip_from_world * vec4(b, 1.0)),
        pixel_of(frame.clip_from_world * vec4(after, 1.0)),
    );
    let corner = corner_of(vertex);
    let place = select(1u, 2u, corner.x > 0.0);
    let own = outward(at[2] - at[1]);
    let other = select(outward(at[1] - at[0]), outward(at[3] - at[2]), corner.x > 0.0);
    let sum = own + other;
    let along = select(own, normalize(sum), length(sum) > 1e-3);
    // Sharp corners reach out no more than twice as far.
    let far = select(-SHADOW_REACH.x, SHADOW_REACH.y, corner.y > 0.0) / max(dot(along, own), 0.5);
    let fall = frame.outline_width * vec2(0.0, SHADOW_FALL);
    let span = at[2] - at[1];
    let long = length(span);
    var out = plain;
    out.position = clip_of(at[place] + frame.outline_width * along * far + fall, vec4(0.0, 0.0, 0.5, 1.0));
    out.line = vec4(at[1] + fall, span / max(long, 1e-6));
    out.size = vec3(long, frame.outline_width, f32(SHADOW));
    return out;
}

// A shadow fades with the distance from its side, round about corners, and ends without an edge.
fn shadow_color(in: Fill) -> vec4<f32> {
    let at = in.position.xy - in.line.xy;
    let off = at - clamp(dot(at, in.line.zw), 0.0, in.size.x) * in.line.zw;
    let side = select(-1.0, 1.0, dot(off, outward(in.line.zw)) >= 0.0);
    let reach = SHADOW_REACH * in.size.y;
    let fading = 1.0 - smoothstep(-reach.x, reach.y, side * length(off));
    let darkest = mix(DARKEST.x, DARKEST.y, dot(frame.ground.rgb, vec3(0.3, 0.6, 0.1)));
    return vec4(0.0, 0.0, 0.0, darkest * fading * frame.fill_opacity);
}

// The unit normal of a side on the screen, away from what is covered.
fn outward(side: vec2<f32>) -> vec2<f32> {
    return vec2(-side.y, side.x) / max(length(side), 1e-6);
}

// How much white an outline has beside the colour of its body: a dark one would sink into the ground, a bright one would not.
const LIFT: vec2<f32> = vec2(0.55, 0.4);
// How bright the rim of a limb is on a bright ground, beside its colour.
const SHADE: f32 = 0.6;
// Opacity of the sides of triangles, where a map is shown or in space, and the height of a triangle [px] from which on they are seen, and seen in full.
const LINES: f32 = 0.13;
const ROOM: vec2<f32> = vec2(7.0, 22.0);
// Width of a bond within a body [px], and its room beside its length: it looks as a side of the triangles of a square does, so that two braces
// that cross are alike.
const INNER_WIDTH: f32 = 1.6;
const INNER_ROOM: f32 = 0.5;
// Where light comes from in space; how bright what faces away from it and what faces it is, and what is seen from its side.
const LIGHT: vec3<f32> = vec3(0.34, 0.82, 0.46);
const BRIGHT: vec2<f32> = vec2(0.36, 1.22);
const ASIDE: f32 = 0.82;
// How much a cell of a net covers: its bonds, and what lies behind it, are seen as well, and strains are told apart.
const CELL_OPACITY: vec2<f32> = vec2(0.4, 0.55);
// The other side of a surface, beside the one that is seen from where its normal points.
const REVERSE: vec3<f32> = vec3(0.78, 0.82, 0.92);

// A stroke with round ends of two radii: its edge touches both circles.
fn round_color(in: Fill, color: vec3<f32>) -> vec4<f32> {
    let at = in.position.xy - in.line.xy;
    let long = in.size.x;
    let place = vec2(abs(dot(at, vec2(-in.line.w, in.line.z))), dot(at, in.line.zw));
    let radii = in.share.xy;
    let lean = (radii.x - radii.y) / max(long, 1e-6);
    // One circle may lie in the other.
    let upright = sqrt(max(1.0 - lean * lean, 0.0));
    let along = dot(place, vec2(-lean, upright));
    var off = dot(place, vec2(upright, lean)) - radii.x;
    if abs(lean) >= 1.0 {
        off = min(length(place) - radii.x, length(place - vec2(0.0, long)) - radii.y);
    } else if along < 0.0 {
        off = length(place) - radii.x;
    } else if along > upright * long {
        off = length(place - vec2(0.0, long)) - radii.y;
    }
    return fogged(vec4(color, clamp(0.5 - off, 0.0, 1.0)), in.position.w);
}

// The colour of a body as what is within its outline has it: in the plane its own, in space what light is to shade.
fn dimmed(color: vec3<f32>) -> vec3<f32> {
    return select(mix(frame.ground.rgb, color, 0.8), color, DIMENSIONS == 2u);
}

// What a body is filled with: its colour, or that of what is shown in place of it.
fn flesh_color(in: Fill) -> vec3<f32> {
    var color = dimmed(in.color.rgb);
    if MAPS && is_set(frame.strain_scale, in.position.x) {
        color = strain_color(in.shade.w).rgb;
    }
    if MAPS && is_set(frame.difference_scale, in.position.x) {
        color = difference_color(in.shade.w).rgb;
    }
    return color;
}

// What is no triangle: each way to draw is taken once, for a driver without a GPU takes all of them for every pixel.
fn line_color(in: Fill, kind: u32) -> vec4<f32> {
    let has_all = KINDS == 0u;
    if has_all && kind == SHADOW {
        return shadow_color(in);
    }
    // Beside colours of strain a body's own would mean nothing.
    let bright = dot(in.color.rgb, vec3(0.3, 0.6, 0.1));
    let lift = mix(LIFT.x, LIFT.y, smoothstep(0.1, 0.4, bright));
    let is_map = (frame.strain_scale > 0.0) | (frame.difference_scale > 0.0);
    let own = select(mix(in.color.rgb, vec3(1.0), lift), vec3(0.88), is_map);
    if has_all && (kind == SKIN || kind == FLESH) {
        // Limbs lie on each other: on a bright ground a dark rim parts them.
        let is_bright = dot(frame.ground.rgb, vec3(0.3, 0.6, 0.1)) > 0.5;
        let rim = select(own, SHADE * in.color.rgb, is_bright && !is_map);
        var flesh = dimmed(in.color.rgb);
        if MAPS {
            flesh = select(flesh, strain_color(0.0).rgb, frame.strain_scale > 0.0);
        }
        return round_color(in, select(rim, flesh, kind == FLESH));
    }
    let is_inner = has_all && kind == INNER;
    let room = select(1.0, smoothstep(ROOM.x, ROOM.y, INNER_ROOM * in.size.x) * frame.fill_opacity, is_inner);
    let outline = select(vec4(own, 1.0), in.color, has_all && kind == THREAD);
    let color = select(outline, vec4(0.0, 0.0, 0.0, LINES), is_inner);
    if DIMENSIONS == 2u && kind == OUTLINE && in.share.x > 0.0 {
        return arc_color(in, own);
    }
    let line = stroke_color(Stroke(in.position, in.line, color, in.size.xy));
    return vec4(line.rgb, line.a * room);
}

// How far what fills an arc lies over what is filled beside it, whose sides are darker [px].
const LAP: f32 = 1.5;

// A side of an outline that is an arc, and what is covered between it and the straight line.
fn arc_color(in: Fill, rim: vec3<f32>) -> vec4<f32> {
    let half = 0.5 * in.size.x;
    let high = in.share.x;
    let outward = vec2(-in.line.w, in.line.z);
    let at = in.position.xy - in.line.xy;
    // From the middle of the straight line: along it, and away from what is covered.
    let place = vec2(dot(at, in.line.zw) - half, dot(at, outward));
    let radius = 0.5 * (half * half / high + high);
    let spoke = place + vec2(0.0, radius - high);
    let far = max(length(spoke), 1e-6);
    let is_beside = abs(spoke.x) * (radius - high) <= spoke.y * half;
    let end = vec2(sign(place.x) * half, 0.0);
    // Never 0, as of a stroke.
    let off = select(place - end, spoke / far * (far - radius), is_beside) + vec2(0.0, 1e-5);
    let line = coverage(in.line.zw * off.x + outward * off.y, in.size.y);
    let lap = select(0.0, LAP, frame.fill_opacity >= 1.0);
    let is_filled = place.y >= -lap && abs(place.x) <= half;
    let filled = select(0.0, clamp(0.5 - (far - radius), 0.0, 1.0) * frame.fill_opacity, is_filled);
    let opacity = line + filled * (1.0 - line);
    return vec4(mix(flesh_color(in), rim, line / max(opacity, 1e-6)), opacity);
}

@fragment
fn fragment(in: Fill, @builtin(front_facing) is_front: bool) -> @location(0) vec4<f32> {
    let steps = max(fwidth(in.share), vec3(1e-6));
    let kind = select(u32(in.size.z + 0.5), CELL, KINDS == 2u);
    // In space triangles are drawn by themselves: they alone write their depth.
    if (KINDS == 0u || KINDS == 3u) && PART != 1u && kind != FILL && kind != UNDER && kind != CELL {
        return line_color(in, kind);
    }
    var color = flesh_color(in);
    if DIMENSIONS == 2u && (KINDS == 0u || KINDS == 2u) && kind == CELL {
        let is_map = (frame.strain_scale > 0.0) | (frame.difference_scale > 0.0);
        return vec4(color, frame.fill_opacity * in.shade.x * select(CELL_OPACITY.x, CELL_OPACITY.y, is_map));
    }
    if DIMENSIONS == 3u {
        let length = length(in.shade.xyz);
        let normal = select(vec3(0.0, 1.0, 0.0), in.shade.xyz / length, length > 0.0) * select(-1.0, 1.0, is_front);
        let lit = 0.5 + 0.5 * dot(normal, LIGHT);
        let ahead = vec3(frame.clip_from_world[0].w, frame.clip_from_world[1].w, frame.clip_from_world[2].w);
        let faced = mix(ASIDE, 1.0, abs(dot(normal, normalize(ahead))));
        color = color * (mix(BRIGHT.x, BRIGHT.y, lit) * faced) * select(REVERSE, vec3(1.0), is_front);
    }
    if DIMENSIONS == 2u && !shows_map(in.position.x) {
        return fogged(vec4(color, frame.fill_opacity), in.position.w);
    }
    // Distance to the nearest side of the triangle [px].
    let off = in.share / steps;
    let near = min(min(off.x, off.y), off.z);
    let height = 1.0 / max(max(steps.x, steps.y), steps.z);
    let line = LINES * clamp(1.3 - near, 0.0, 1.0) * smoothstep(ROOM.x, ROOM.y, height);
    return fogged(vec4(color * (1.0 - line), frame.fill_opacity), in.position.w);
}
