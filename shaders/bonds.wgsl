// Bonds: strokes between two points of the position buffer, each drawn as what it is, tinted by strain; and dots that stand for bonds
// too short to be told apart.

struct Packed {
    // With what it has of its body's own, and the kind, in the bits from FORM on.
    a: u32,
    b: u32,
    // [m]
    rest_length: f32,
}

@group(0) @binding(2) var<storage, read> bonds: array<Packed>;

// What each point's body has of its own: red, green and blue from the lowest byte on, and how wide its bonds are [m], as its bits.
@group(0) @binding(4) var<storage, read> own: array<vec2<u32>>;

const FORM: u32 = 29u;
// A bond has the colour, and the width; and it lies on a fill or a picture of that colour.
const OF_COLOR: u32 = 1u;
const OF_WIDTH: u32 = 2u;
const COVERED: u32 = 4u;

struct Bond {
    a: u32,
    b: u32,
    // [m]; below 0 that of a rope that keeps it, and of a bar, which has none.
    rest_length: f32,
    kind: u32,
    // What it has of its body's own.
    own: u32,
}

fn bond_at(index: u32) -> Bond {
    let packed = bonds[index];
    let mask = (1u << FORM) - 1u;
    return Bond(packed.a & mask, packed.b & mask, packed.rest_length, packed.b >> FORM, packed.a >> FORM);
}

// Bonds of a chunk. Instances are chunks.
const CHUNK: u32 = 1024u;
// From a bond to one beside it in the scene: a chunk is in an order that spreads its first few.
const NEIGHBOR: u32 = 303u;
// Bonds that a dot takes its colour from: those of a point pull in several directions.
const MIXED: u32 = 4u;

// Kinds of bonds; what is none of them is a plain stroke.
const ROD: u32 = 1u;
const COIL: u32 = 2u;
const ROPE: u32 = 3u;
const RELAXED: u32 = 4u;
// These act on one side only, and are drawn as ropes and rods.
const STRING: u32 = 5u;
const STRUT: u32 = 6u;
// Drawn over what covers other bonds.
const MUSCLE: u32 = 7u;
const FLESH: vec3<f32> = vec3(0.91, 0.42, 0.42);

// From this strain on what keeps its length is seen to be stretched, and from that one on it has all of the colour.
const STRETCHED: vec2<f32> = vec2(0.005, 0.05);

fn is_rope(bond: Bond) -> bool {
    return bond.kind == ROPE || bond.kind == STRING;
}

fn strain_of(bond: Bond, a: vec3<f32>, b: vec3<f32>) -> f32 {
    let rest_length = select(bond.rest_length, abs(bond.rest_length), is_rope(bond));
    if rest_length > 0.0 {
        return distance(a, b) / rest_length - 1.0;
    }
    return 0.0;
}

// A colour of what keeps its length, such as rods: that of the largest strain where it is stretched all the same. Plain strokes stay plain.
fn stretched(bond: Bond, color: vec4<f32>, a: vec3<f32>, b: vec3<f32>) -> vec4<f32> {
    if FORMS == 0u {
        return color;
    }
    let is_rigid = is_set(frame.coil_length, a.x) && (bond.kind == ROD || (is_rope(bond) && bond.rest_length < 0.0));
    let share = select(0.0, smoothstep(STRETCHED.x, STRETCHED.y, strain_of(bond, a, b)), is_rigid);
    return vec4(mix(color.rgb, frame.strain_colors[8].rgb, share), color.a);
}

// How wide a bond is of its own, between points there [px]; 0: as is usual.
fn own_width(bond: Bond, a: vec3<f32>, b: vec3<f32>) -> f32 {
    if (bond.own & OF_WIDTH) == 0u {
        return 0.0;
    }
    let to_x = vec3(frame.clip_from_world[0].x, frame.clip_from_world[1].x, frame.clip_from_world[2].x);
    let depth = (frame.clip_from_world * vec4(0.5 * (a + b), 1.0)).w;
    return bitcast<f32>(own[bond.a].y) * length(to_x) * 0.5 * frame.viewport.x / max(depth, 1e-6);
}

fn tint_of(bond: Bond, a: vec3<f32>, b: vec3<f32>) -> vec4<f32> {
    if MAPS && is_set(frame.strain_scale, a.x) {
        var strain = strain_of(bond, a, b);
        if bond.kind == STRING {
            strain = max(strain, 0.0);
        } else if bond.kind == STRUT {
            strain = min(strain, 0.0);
        }
        return vec4(strain_color(strain).rgb, frame.bond_color.a);
    }
    if MAPS && is_set(frame.difference_scale, a.x) {
        return vec4(difference_color(0.5 * (values[bond.a] + values[bond.b])).rgb, frame.bond_color.a);
    }
    if FORMS == 2u && bond.kind == MUSCLE && is_set(frame.coil_length, a.x) {
        return vec4(FLESH, frame.bond_color.a);
    }
    if (bond.own & OF_COLOR) != 0u && ((bond.own & COVERED) == 0u || !is_set(frame.fill_opacity, a.x)) {
        return stretched(bond, vec4(unpack4x8unorm(own[bond.a].x).rgb, frame.bond_color.a), a, b);
    }
    if FORMS == 2u && is_rope(bond) && is_set(frame.coil_length, a.x) {
        return stretched(bond, frame.rope_color, a, b);
    }
    return stretched(bond, frame.bond_color, a, b);
}

// A stroke with what it is of a bond.
struct Strand {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) line: vec4<f32>,
    @location(1) @interpolate(flat) color: vec4<f32>,
    @location(2) @interpolate(flat) size: vec2<f32>,
    // Kind, height of waves [px], waves along it, width of the wire [px].
    @location(3) @interpolate(flat) form: vec4<f32>,
}

// Half the width of a rod by its length on the screen [1] and at most [px], of a rope and of a coil's wire [px], in pixels of a screen
// of scale 1, which is what outlines are measured by.
const ROD_SHARE: f32 = 0.035;
const ROD_MOST: f32 = 3.4;
const ROPE_HALF: f32 = 2.1;
// Height of a coil by its length [1] and at most [px]; from a turn to the next at rest [px].
const COIL_SHARE: f32 = 0.1;
const COIL_MOST: f32 = 6.5;
const TURN: f32 = 10.0;
// Half the width of a muscle's belly by its length [1], at least and at most [px], and of its ends beside that [1].
const BELLY_SHARE: f32 = 0.11;
const BELLY: vec2<f32> = vec2(2.2, 7.0);
const TENDON: f32 = 0.3;

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) chunk: u32) -> Strand {
    let bond = bond_at(chunk * CHUNK + index / 6u);
    let a = position_of(bond.a);
    let b = position_of(bond.b);
    let wide = own_width(bond, a, b);
    var width = max(frame.bond_width, wide);
    var form = vec4(0.0);
    if FORMS == 2u && is_set(frame.coil_length, a.x) && bond.kind != 0u {
        let span = distance(pixel_of(frame.clip_from_world * vec4(a, 1.0)), pixel_of(frame.clip_from_world * vec4(b, 1.0)));
        let unit = frame.outline_width / 1.5;
        if bond.kind == ROD || bond.kind == STRUT {
            // A bar of pins has no length at rest: it is as thick as any rod, however short its pieces are.
            let half = select(min(ROD_SHARE * span, ROD_MOST * unit), ROD_MOST * unit, bond.rest_length < 0.0);
            width = select(max(width, 2.0 * half), width, wide > 0.0);
            form = vec4(f32(ROD), 0.0, 0.0, width);
        } else if is_rope(bond) {
            width = select(max(width, 2.0 * ROPE_HALF * unit), width, wide > 0.0);
            form = vec4(f32(ROPE), 0.0, 0.0, width);
        } else if bond.kind == COIL {
            // Waves grow out of the straight stroke as the camera comes nearer.
            let grown = smoothstep(frame.coil_length, 1.5 * frame.coil_length, span);
            let free = select(min(COIL_SHARE * span, COIL_MOST * unit), 0.5 * (width - frame.bond_width), wide > 0.0);
            let height = grown * free;
            width = select(width, mix(width, frame.bond_width, grown), wide > 0.0);
            let at_rest = span / max(1.0 + strain_of(bond, a, b), 0.05);
            let turns = clamp(round(at_rest / (TURN * unit)), 3.0, 18.0);
            form = vec4(f32(COIL), height, turns, width);
            width += 2.0 * height;
        } else if bond.kind == MUSCLE {
            // It gets thicker as it gets shorter.
            let thick = clamp(1.0 - strain_of(bond, a, b), 0.6, 1.6);
            let belly = 2.0 * clamp(BELLY_SHARE * thick * span, BELLY.x * unit, BELLY.y * thick * unit);
            width = select(max(width, belly), thick * width, wide > 0.0);
            form = vec4(f32(MUSCLE), 0.0, 0.0, width);
        } else {
            form = vec4(f32(RELAXED), 0.0, 0.0, width);
        }
    }
    let plain = stroke(index % 6u, a, b, tint_of(bond, a, b), width);
    return Strand(plain.position, plain.line, plain.color, plain.size, form);
}

// One of which no more than the colour tells its form, in the plane.
@vertex
fn short_vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) chunk: u32) -> Strand {
    let bond = bond_at(chunk * CHUNK + index / 3u);
    let a = position_of(bond.a);
    let b = position_of(bond.b);
    let width = max(frame.bond_width, own_width(bond, a, b));
    let plain = short_stroke(index % 3u, a, b, tint_of(bond, a, b), width);
    return Strand(plain.position, plain.line, plain.color, plain.size, vec4(0.0));
}

@fragment
fn fragment(in: Strand) -> @location(0) vec4<f32> {
    let kind = u32(in.form.x + 0.5);
    let plain = Stroke(in.position, in.line, in.color, in.size);
    if FORMS != 2u || kind == 0u {
        return stroke_color(plain);
    }
    let at = in.position.xy - in.line.xy;
    let along = dot(at, in.line.zw);
    let across = dot(at, vec2(-in.line.w, in.line.z));
    if kind == COIL && in.form.y > 0.5 {
        return coil_color(in, along, across);
    }
    if kind == MUSCLE {
        return muscle_color(in, along, across);
    }
    var color = stroke_color(plain);
    let off = across / max(in.size.y, 0.5);
    if kind == ROD && in.size.y > 1.2 {
        // Round bars: bright along the middle.
        color = vec4(color.rgb * (1.0 - 0.5 * off * off), color.a);
    } else if kind == ROPE {
        // Strands that go round each other.
        let twist = sin(6.2831853 * (along / (4.5 * in.size.y) + 0.35 * off));
        color = vec4(color.rgb * (0.86 - 0.3 * off * off + 0.12 * twist), color.a);
    } else if kind == RELAXED {
        // Dashes, where there is room for some.
        let dash = abs(fract(along / 9.0) - 0.5) * 9.0;
        let gap = clamp(dash - 2.6, 0.0, 1.0) * smoothstep(24.0, 40.0, in.size.x);
        color.a *= 1.0 - 0.8 * gap;
    }
    return color;
}

// A spindle of fibres: thick in the middle, sinews at its ends.
fn muscle_color(in: Strand, along: f32, across: f32) -> vec4<f32> {
    let share = clamp(along / max(in.size.x, 1.0), 0.0, 1.0);
    let belly = sin(3.1415927 * share);
    let half = in.size.y * mix(TENDON, 1.0, belly * belly);
    let beyond = max(max(-along, along - in.size.x), 0.0);
    let covered = clamp(half + 0.5 - length(vec2(across, beyond)), 0.0, 1.0);
    let off = across / max(half, 0.5);
    let fibres = 0.94 + 0.06 * cos(9.0 * off) * belly;
    let sinew = 1.0 - smoothstep(0.0, 0.22, min(share, 1.0 - share));
    let color = mix(in.color.rgb, vec3(0.93, 0.9, 0.86), 0.75 * sinew) * fibres * (1.0 - 0.45 * off * off);
    return fogged(shown(vec4(color, in.color.a), covered, half), in.position.w);
}

// A wire in waves between two straight ends, bright where it is in front.
fn coil_color(in: Strand, along: f32, across: f32) -> vec4<f32> {
    let end = 0.14 * in.size.x;
    let inner = max(in.size.x - 2.0 * end, 1.0);
    let share = clamp((along - end) / inner, 0.0, 1.0);
    let is_inside = along > end && along < in.size.x - end;
    let pace = 6.2831853 * in.form.z / inner;
    let phase = 6.2831853 * in.form.z * share;
    // Waves begin and end at the middle, with no jump.
    let rise = min(min(share, 1.0 - share) * in.form.z * 2.0, 1.0) * in.form.y;
    let wave = select(0.0, rise * sin(phase), is_inside);
    let slope = select(0.0, rise * pace * cos(phase), is_inside);
    let beyond = max(max(-along, along - in.size.x), 0.0);
    let off = length(vec2(abs(across - wave) / sqrt(1.0 + slope * slope), beyond));
    let covered = clamp(0.5 * in.form.w + 0.5 - off, 0.0, 1.0);
    let front = select(1.0, 0.8 + 0.2 * cos(phase), is_inside);
    return fogged(shown(vec4(in.color.rgb * front, in.color.a), covered, 0.5 * in.form.w), in.position.w);
}

@vertex
fn dot_vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) chunk: u32) -> Disc {
    let first = chunk * CHUNK + index / 3u;
    let bond = bond_at(first);
    let a = position_of(bond.a);
    let b = position_of(bond.b);
    let middle = 0.5 * (a + b);
    var color = tint_of(bond, a, b);
    for (var i = 1u; i < MIXED; i++) {
        let other = bond_at((first & ~(CHUNK - 1u)) | ((first + i * NEIGHBOR) & (CHUNK - 1u)));
        if MAPS {
            color += tint_of(other, position_of(other.a), position_of(other.b));
        } else {
            // It is not looked for where it is: of no length it is not stretched.
            color += tint_of(other, a, a);
        }
    }
    return disc(index % 3u, middle, color / f32(MIXED), frame.dot_radius);
}

@fragment
fn dot_fragment(in: Disc) -> @location(0) vec4<f32> {
    return disc_color(in);
}
