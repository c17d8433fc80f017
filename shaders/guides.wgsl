// Guides: the grid and the walls, strokes that do not hang on points.

struct Guide {
    // Ends [m]; w is the stroke's width [px] at `a`.
    a: vec4<f32>,
    b: vec4<f32>,
    color: vec4<f32>,
}

@group(0) @binding(2) var<storage, read> guides: array<Guide>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Stroke {
    let guide = guides[index / 6u];
    return stroke(index % 6u, guide.a.xyz, guide.b.xyz, guide.color, guide.a.w);
}

@fragment
fn fragment(in: Stroke) -> @location(0) vec4<f32> {
    return stroke_color(in);
}
