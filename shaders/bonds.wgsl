// Bonds: strokes between two points of the position buffer, tinted by strain.

struct Bond {
    a: u32,
    b: u32,
    // [m]
    rest_length: f32,
}

@group(0) @binding(3) var<storage, read> bonds: array<Bond>;

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

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Stroke {
    let bond = bonds[index / 6u];
    let a = position_of(bond.a);
    let b = position_of(bond.b);
    var strain = 0.0;
    if bond.rest_length > 0.0 {
        strain = distance(a, b) / bond.rest_length - 1.0;
    }
    return stroke(index % 6u, a, b, tint(strain), frame.bond_width);
}

@fragment
fn fragment(in: Stroke) -> @location(0) vec4<f32> {
    return stroke_color(in);
}
