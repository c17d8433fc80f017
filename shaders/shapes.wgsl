// Strokes, and how much of a pixel a shape covers: what the passes draw with.

// Which part of a shape is drawn: 0 all of it; in space first 1, the pixels that it fills, which hide what lies behind
// them, then 2, the others, which hide nothing. A pixel at an edge that wrote its depth would keep what is drawn later
// out of its other share, and leave a notch there.
override PART: u32 = 0u;

// Corner of a quad: (-1 or 1, -1 or 1), for the six vertices of its two triangles.
fn corner_of(vertex: u32) -> vec2<f32> {
    let right = vertex == 1u || vertex == 2u || vertex == 4u;
    let upper = vertex == 2u || vertex == 4u || vertex == 5u;
    return vec2(select(-1.0, 1.0, right), select(-1.0, 1.0, upper));
}

// A point that no pixel is drawn for.
fn nowhere() -> vec4<f32> {
    return vec4(2.0, 2.0, 2.0, 1.0);
}

// A stroke between two points on the screen: the quad around it, and what the fragment needs to measure its distance.
struct Stroke {
    @builtin(position) position: vec4<f32>,
    // Where it begins [px], and the unit vector along it.
    @location(0) @interpolate(flat) line: vec4<f32>,
    @location(1) @interpolate(flat) color: vec4<f32>,
    // Length and half the width [px].
    @location(2) @interpolate(flat) size: vec2<f32>,
}

fn stroke(vertex: u32, world_a: vec3<f32>, world_b: vec3<f32>, color: vec4<f32>, width: f32) -> Stroke {
    var a = frame.clip_from_world * vec4(world_a, 1.0);
    var b = frame.clip_from_world * vec4(world_b, 1.0);
    var out: Stroke;
    if a.w < frame.near && b.w < frame.near {
        out.position = nowhere();
        return out;
    }
    if a.w < frame.near {
        a = mix(a, b, (frame.near - a.w) / (b.w - a.w));
    }
    if b.w < frame.near {
        b = mix(b, a, (frame.near - b.w) / (a.w - b.w));
    }
    let from_pixel = pixel_of(a);
    let to_pixel = pixel_of(b);
    out = straight(from_pixel, to_pixel, color, width);
    let along = out.line.zw;
    let across = vec2(-along.y, along.x);
    let corner = corner_of(vertex);
    let at_b = corner.x > 0.0;
    let offset = (along * corner.x + across * corner.y) * reach(0.5 * width, along);
    out.position = clip_of(select(from_pixel, to_pixel, at_b) + offset, select(a, b, at_b));
    return out;
}

// A stroke between two pixels, whose corner is still to be placed.
fn straight(from_pixel: vec2<f32>, to_pixel: vec2<f32>, color: vec4<f32>, width: f32) -> Stroke {
    let span = to_pixel - from_pixel;
    let extent = length(span);
    // A stroke of no length is a dot.
    let along = select(vec2(1.0, 0.0), span / max(extent, 1e-20), extent > 1e-6);
    var out: Stroke;
    out.line = vec4(from_pixel, along);
    out.color = color;
    out.size = vec2(extent, 0.5 * width);
    return out;
}

// The same in the plane, for the three vertices of a triangle around the quad: it has twice the pixels, which of a short stroke are few, and
// is half as much to set up.
fn short_stroke(vertex: u32, world_a: vec3<f32>, world_b: vec3<f32>, color: vec4<f32>, width: f32) -> Stroke {
    let a = frame.clip_from_world * vec4(world_a, 1.0);
    let from_pixel = pixel_of(a);
    let to_pixel = pixel_of(frame.clip_from_world * vec4(world_b, 1.0));
    var out = straight(from_pixel, to_pixel, color, width);
    let along = out.line.zw;
    let across = vec2(-along.y, along.x);
    let beside = reach(out.size.y, along);
    let half = 0.5 * out.size.x + beside;
    // Across its beginning, to a point as far beyond its end.
    let corner = array(vec2(-1.0, -2.0), vec2(3.0, 0.0), vec2(-1.0, 2.0))[vertex];
    out.position = clip_of(0.5 * (from_pixel + to_pixel) + along * (corner.x * half) + across * (corner.y * beside), a);
    return out;
}

// How far from its middle the pixels of a part lie whose edge has this normal [px]: a pixel reaches half of |x| + |y|
// beyond its own middle. A hundredth is for the rasteriser, which rounds the corners.
fn reach(radius: f32, normal: vec2<f32>) -> f32 {
    if PART == 1u {
        // By the direction of the edge, pixels are filled to 0.9 from a depth of 0.387 to 0.4 on; those of thinner
        // strokes count as filled up to 0.54 from the middle.
        return max(radius - 0.38, 0.55);
    }
    return radius + 0.5 * (abs(normal.x) + abs(normal.y)) + 0.01;
}

// Opacity from which a pixel counts as filled: what shows through the rest is too faint to see. A stroke has such a
// pixel at every place along it; of one thinner than 1.8 px the best covered pixel is covered by half its width or more.
fn solid(radius: f32) -> f32 {
    return min(0.9, radius);
}

// A colour as the part shows it, at pixels of which a shape of this radius covers so much.
fn shown(color: vec4<f32>, covered: f32, radius: f32) -> vec4<f32> {
    let opacity = color.a * covered;
    // The parts overlap by a hair, so that rounding leaves no pixel to neither.
    if (PART == 1u && opacity < solid(radius)) || (PART == 2u && opacity > solid(radius) + 1e-4) {
        discard;
    }
    return vec4(color.rgb, opacity);
}

// Share of a pixel that lies within `radius` of something that is `offset` away from its middle [px], edges straight.
//
// Across an edge with the unit normal n a square pixel is as wide as two boxes, |n.x| and |n.y|, folded together. Its
// share from its middle to a depth t is odd in t: t/wide while |t| < (wide - narrow)/2, and bends to 1/2 from there to
// (wide + narrow)/2. The share between two parallel edges is the difference of theirs; the far one matters where the
// shape is thinner than the pixel. Here all lengths are multiplied by the distance, so that n need not be divided by it.
fn coverage(offset: vec2<f32>, radius: f32) -> f32 {
    let n = max(abs(offset), vec2(1e-6, 1e-9));
    let distance = length(n);
    let wide = max(n.x, n.y);
    let narrow = max(min(n.x, n.y), 1e-3 * wide);
    let most = vec2(0.5 * (wide + narrow));
    let even = vec2(0.5 * (wide - narrow));
    let depth = clamp(vec2(distance + radius, distance - radius) * distance, -most, most);
    let bend = depth - clamp(depth, -even, even);
    let share = depth - bend * abs(bend) * (0.5 / narrow);
    return (share.x - share.y) / wide;
}

fn stroke_color(in: Stroke) -> vec4<f32> {
    let at = in.position.xy - in.line.xy;
    let along = dot(at, in.line.zw);
    // Never 0: on the middle line, too, the edges have a direction.
    let across = dot(at, vec2(-in.line.w, in.line.z)) + 1e-5;
    let beyond = along - clamp(along, 0.0, in.size.x);
    let offset = in.line.zw * beyond + vec2(-in.line.w, in.line.z) * across;
    return fogged(shown(in.color, coverage(offset, in.size.y), in.size.y), in.position.w);
}
