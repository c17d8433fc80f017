// Bonds: strokes between two points of the position buffer, tinted by strain; and dots that stand for bonds too short
// to be told apart.

struct Bond {
    a: u32,
    b: u32,
    // [m]
    rest_length: f32,
}

@group(0) @binding(3) var<storage, read> bonds: array<Bond>;

// Bonds of a chunk. Instances are chunks.
const CHUNK: u32 = 1024u;
// From a bond to one beside it in the scene: a chunk is in an order that spreads its first few.
const NEIGHBOR: u32 = 303u;
// Bonds that a dot takes its colour from: those of a point pull in several directions.
const MIXED: u32 = 4u;

// Stretched bonds turn towards one colour, squeezed ones towards the other.
fn tint(strain: f32) -> vec4<f32> {
    if frame.strain_scale <= 0.0 {
        return frame.bond_color;
    }
    let s = strain / frame.strain_scale;
    let share = abs(s) / sqrt(1.0 + s * s);
    let full = select(frame.squeeze_color, frame.stretch_color, s > 0.0);
    return mix(frame.bond_color, full, share);
}

fn tint_of(bond: Bond, a: vec3<f32>, b: vec3<f32>) -> vec4<f32> {
    var strain = 0.0;
    if bond.rest_length > 0.0 {
        strain = distance(a, b) / bond.rest_length - 1.0;
    }
    return tint(strain);
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) chunk: u32) -> Stroke {
    let bond = bonds[chunk * CHUNK + index / 6u];
    let a = position_of(bond.a);
    let b = position_of(bond.b);
    return stroke(index % 6u, a, b, tint_of(bond, a, b), frame.bond_width);
}

@fragment
fn fragment(in: Stroke) -> @location(0) vec4<f32> {
    return stroke_color(in);
}

@vertex
fn dot_vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) chunk: u32) -> Disc {
    let first = chunk * CHUNK + index / 3u;
    var middle: vec3<f32>;
    var color = vec4(0.0);
    for (var i = 0u; i < MIXED; i++) {
        let bond = bonds[(first & ~(CHUNK - 1u)) | ((first + i * NEIGHBOR) & (CHUNK - 1u))];
        let a = position_of(bond.a);
        let b = position_of(bond.b);
        if i == 0u {
            middle = 0.5 * (a + b);
        }
        color += tint_of(bond, a, b);
    }
    return disc(index % 3u, middle, color / f32(MIXED), frame.dot_radius);
}

@fragment
fn dot_fragment(in: Disc) -> @location(0) vec4<f32> {
    return disc_color(in);
}
