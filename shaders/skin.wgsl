// Skins: pictures on triangles, and along their free sides a stroke in the picture's own colours, which smooths the edge; or, where the picture
// ends beside a side, strips on which it goes on up to its own edge.

// A corner of a triangle: its point, where that lies in the picture, and what the picture is multiplied by there; with an opacity in its last byte
// the picture is seen through, as opaque as it is.
struct Corner {
    point: u32,
    u: f32,
    v: f32,
    tint: u32,
}

@group(0) @binding(2) var<storage, read> corners: array<Corner>;
@group(1) @binding(0) var picture: texture_2d<f32>;
@group(1) @binding(1) var smooth_sampler: sampler;

struct Skin {
    @builtin(position) position: vec4<f32>,
    @location(0) at: vec2<f32>,
    // Above 0: only what the picture covers is shown.
    @location(1) @interpolate(flat) clipped: f32,
    @location(2) tint: vec4<f32>,
}

// Marks corners of triangles of which only what the picture covers is shown.
const CLIPPED: u32 = 0x80000000u;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Skin {
    let corner = corners[index];
    var out: Skin;
    out.position = frame.clip_from_world * vec4(position_of(corner.point & ~CLIPPED), 1.0);
    out.at = vec2(corner.u, corner.v);
    out.clipped = select(0.0, 1.0, corner.point >= CLIPPED);
    out.tint = unpack4x8unorm(corner.tint);
    return out;
}

// How light black ink gets before it takes a colour [1]: multiplied alone it would stay dark whatever the colour is. A colour counts by its
// strength, so that white changes nothing and grey makes darker.
const LIFT: f32 = 0.5;
// From this strength on [1] a colour takes the place of the ink's own hue, of which lightness alone is left: green ink that is multiplied by red
// is nearly black.
const STRONG: f32 = 0.5;

// How much of a colour is hue [1]: white, grey and black have none.
fn strength_of(tint: vec3<f32>) -> f32 {
    let most = max(max(tint.r, tint.g), tint.b);
    let least = min(min(tint.r, tint.g), tint.b);
    return (most - least) / max(most, 0.01);
}

// Ink in the colour that its body is given: as light beside other ink as it was, in that hue.
fn tinted(ink: vec3<f32>, tint: vec3<f32>) -> vec3<f32> {
    let strength = strength_of(tint);
    // Lighter than it is, as what has a hue is.
    let light = sqrt(dot(ink, vec3(0.30, 0.59, 0.11)));
    let washed = mix(ink, vec3(light), smoothstep(0.0, STRONG, strength));
    let dark = 1.0 - max(max(washed.r, washed.g), washed.b);
    return tint * mix(washed, vec3(1.0), LIFT * strength * dark);
}

@fragment
fn fragment(in: Skin) -> @location(0) vec4<f32> {
    let color = textureSample(picture, smooth_sampler, in.at);
    // The share of a pixel on the inner side of where the picture is half opaque.
    let covers = (color.a - 0.5) / max(fwidth(color.a), 1e-4) + 0.5;
    // Beyond its own edge the picture is not there, though its last pixels are read there.
    let ends = min(in.at, 1.0 - in.at) / max(fwidth(in.at), vec2(1e-6)) + 0.5;
    let there = clamp(min(ends.x, ends.y), 0.0, 1.0);
    let ink = select(clamp(covers, 0.0, 1.0), color.a, in.tint.a > 0.5);
    let whole = select(1.0, color.a, in.tint.a > 0.5);
    return vec4(tinted(color.rgb, in.tint.rgb), select(whole, ink * there, in.clipped > 0.0));
}

// A corner of a strip: nine numbers, the points of the triangle that it moves with, its shares of them, where it lies in the picture, and
// what that is multiplied by.
@group(0) @binding(2) var<storage, read> rind: array<array<u32, 9>>;

@vertex
fn rind_vertex(@builtin(vertex_index) index: u32) -> Skin {
    var corner = rind[index];
    var place = vec3(0.0);
    for (var k = 0u; k < 3u; k++) {
        place += bitcast<f32>(corner[3u + k]) * position_of(corner[k]);
    }
    var out: Skin;
    out.position = frame.clip_from_world * vec4(place, 1.0);
    out.at = vec2(bitcast<f32>(corner[6]), bitcast<f32>(corner[7]));
    out.clipped = 1.0;
    out.tint = unpack4x8unorm(corner[8]);
    return out;
}

// Width of the stroke along free sides [px].
const EDGE: f32 = 1.6;
// Along dark ink, which would be lost on the dark ground, it is a light rim: its width [px] and colour, and how much of the ink's hue is in it.
const RIM: f32 = 2.4;
const LIGHT: vec3<f32> = vec3(0.60, 0.67, 0.76);
const HUE: f32 = 0.6;
// How much of the hue of the colour that a body is given is in it instead.
const GIVEN: f32 = 0.85;
// Ink is dark below the first luminance [1], and not at all from the second on: the ground has 0.007, and 0.121 stands out
// from it by a contrast of 3 : 1.
const DARK: vec2<f32> = vec2(0.09, 0.17);

// The colour of a rim along ink of a colour: of the same hue, as light as it takes; of the colour that the body is given, where it has one.
fn rim_of(ink: vec3<f32>, tint: vec3<f32>) -> vec3<f32> {
    let most = max(max(ink.r, ink.g), ink.b);
    let least = min(min(ink.r, ink.g), ink.b);
    // What is nearly black has no hue.
    let strength = (most - least) / max(most, 0.15);
    let own = mix(LIGHT, ink / max(most, 0.01), HUE * strength);
    let brightest = max(max(tint.r, tint.g), tint.b);
    return mix(own, mix(LIGHT, tint / max(brightest, 0.01), GIVEN), strength_of(tint));
}

// Free sides follow the triangles in the list: two corners each.
@vertex
fn edge_vertex(@builtin(vertex_index) index: u32) -> Stroke {
    let first = 2u * (index / 6u);
    let a = corners[first];
    let b = corners[first + 1u];
    let middle = 0.5 * vec2(a.u + b.u, a.v + b.v);
    let tint = 0.5 * (unpack4x8unorm(a.tint) + unpack4x8unorm(b.tint));
    let ink = textureSampleLevel(picture, smooth_sampler, middle, 0.0);
    let color = tinted(ink.rgb, tint.rgb);
    // About the luminance of a colour in sRGB.
    let luminance = dot(color * color * (0.3 * color + 0.7), vec3(0.2126, 0.7152, 0.0722));
    let rim = select(1.0 - smoothstep(DARK.x, DARK.y, luminance), 0.0, tint.a > 0.5);
    let shown = vec4(mix(color, rim_of(color, tint.rgb), rim), select(1.0, ink.a, tint.a > 0.5));
    return stroke(index % 6u, position_of(a.point), position_of(b.point), shown, mix(EDGE, RIM, rim));
}

@fragment
fn edge_fragment(in: Stroke) -> @location(0) vec4<f32> {
    return stroke_color(in);
}
