// Discs: points, and dots that stand for bonds.

struct Disc {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) center: vec2<f32>,
    @location(1) @interpolate(flat) color: vec4<f32>,
    @location(2) @interpolate(flat) radius: f32,
    // 1 of a pinned point.
    @location(3) @interpolate(flat) is_pin: f32,
}

fn disc(vertex: u32, center: vec3<f32>, color: vec4<f32>, radius: f32) -> Disc {
    let clip = frame.clip_from_world * vec4(center, 1.0);
    var out: Disc;
    out.color = color;
    out.radius = radius;
    if clip.w < frame.near || color.a == 0.0 {
        out.position = nowhere();
        return out;
    }
    out.center = pixel_of(clip);
    // The triangle around a circle: a third more pixels than a square, and half as much to set up, which is what
    // thousands of small discs cost.
    let corner = array(vec2(0.0, 2.0), vec2(-sqrt(3.0), -1.0), vec2(sqrt(3.0), -1.0))[vertex];
    let offset = corner * reach(out.radius, vec2(sqrt(0.5)));
    out.position = clip_of(out.center + offset, in_front(clip, out.radius));
    return out;
}

// The depth of the near side of a ball: a disc through its middle would be cut by the bonds that come towards the camera.
fn in_front(clip: vec4<f32>, radius: f32) -> vec4<f32> {
    if DIMENSIONS == 2u {
        return clip;
    }
    // Height of the picture in distances from the camera: 2 over the matrix's stretch of y.
    let row = vec3(frame.clip_from_world[0].y, frame.clip_from_world[1].y, frame.clip_from_world[2].y);
    let nearer = min(2.0 * radius / (frame.viewport.y * length(row)), 0.5);
    // 1 - depth is as near/distance, as far as far is much further than near.
    return vec4(clip.xy, max(clip.w - (clip.w - clip.z) / (1.0 - nearer), 0.0), clip.w);
}

fn disc_color(in: Disc) -> vec4<f32> {
    return fogged(shown(in.color, coverage(in.position.xy - in.center, in.radius), in.radius), in.position.w);
}
