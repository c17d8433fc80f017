//! Paints what egui tessellates into a picture in memory, as a GPU would: premultiplied, in the numbers of the file.

use egui::epaint::{ClippedPrimitive, ImageData, Primitive, Vertex};
use egui::{Color32, TextureId, TexturesDelta};
use image::RgbaImage;

/// Letters, as they lie in the texture of a font.
struct Atlas {
    size: [usize; 2],
    pixels: Vec<Color32>,
}

impl Atlas {
    /// That of the letters, all of which were just laid out.
    fn of(textures: &TexturesDelta) -> Self {
        let mut atlas = Atlas { size: [0; 2], pixels: Vec::new() };
        for part in textures.set.get(&TextureId::default()).into_iter().flatten() {
            let ImageData::Color(image) = &part.image;
            let [left, top] = part.pos.unwrap_or([0; 2]);
            if part.pos.is_none() {
                atlas = Atlas { size: image.size, pixels: image.pixels.clone() };
                continue;
            }
            for (row, line) in image.pixels.chunks(image.size[0].max(1)).enumerate() {
                let from = (top + row) * atlas.size[0] + left;
                if let Some(to) = atlas.pixels.get_mut(from..from + line.len()) {
                    to.copy_from_slice(line);
                }
            }
        }
        atlas
    }

    /// The colour at a place of the texture, from 0 to 1 along both sides: letters lie on whole pixels, so the nearest is the one.
    fn at(&self, [u, v]: [f32; 2]) -> [f32; 4] {
        let along = |at: f32, size: usize| ((at * size as f32) as usize).min(size.saturating_sub(1));
        let place = along(v, self.size[1]) * self.size[0] + along(u, self.size[0]);
        self.pixels.get(place).map_or([255.0; 4], |color| color.to_array().map(f32::from))
    }
}

/// Paints primitives, whose positions are points of `scale` pixels.
pub(super) fn paint(picture: &mut RgbaImage, jobs: &[ClippedPrimitive], textures: &TexturesDelta, scale: f32) {
    let atlas = Atlas::of(textures);
    for job in jobs {
        let Primitive::Mesh(mesh) = &job.primitive else { continue };
        let clip = [job.clip_rect.min, job.clip_rect.max].map(|corner| [corner.x * scale, corner.y * scale]);
        for corners in mesh.indices.chunks_exact(3) {
            let corner = |k: usize| mesh.vertices.get(corners[k] as usize).copied();
            if let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) {
                triangle(picture, [a, b, c], &atlas, (clip, scale));
            }
        }
    }
}

/// Twice the area of a triangle, signed.
fn area(a: [f32; 2], b: [f32; 2], c: [f32; 2]) -> f32 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether a pixel on the side from `a` to `b` belongs to the triangle on its positive side: to one of the two that share it.
fn owns(a: [f32; 2], b: [f32; 2]) -> bool {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    y < 0.0 || (y == 0.0 && x > 0.0)
}

fn triangle(picture: &mut RgbaImage, mut corners: [Vertex; 3], atlas: &Atlas, (clip, scale): ([[f32; 2]; 2], f32)) {
    let place = |vertex: &Vertex| [vertex.pos.x * scale, vertex.pos.y * scale];
    let [a, b, c] = [0, 1, 2].map(|k| place(&corners[k]));
    if area(a, b, c) < 0.0 {
        corners.swap(1, 2);
    }
    let at = [0, 1, 2].map(|k| place(&corners[k]));
    let whole = area(at[0], at[1], at[2]);
    if whole.is_nan() || whole <= 0.0 {
        return;
    }
    let size = [picture.width(), picture.height()];
    let range = |axis: usize| {
        let along = at.map(|corner| corner[axis]);
        let least = along.into_iter().fold(f32::INFINITY, f32::min).max(clip[0][axis]).max(0.0);
        let most = along.into_iter().fold(f32::NEG_INFINITY, f32::max).min(clip[1][axis]).min(size[axis] as f32);
        least.floor() as u32..most.ceil().max(0.0) as u32
    };
    for (x, y) in range(1).flat_map(|y| range(0).map(move |x| (x, y))) {
        let middle = [x as f32 + 0.5, y as f32 + 0.5];
        let shares = [(1, 2), (2, 0), (0, 1)].map(|(from, to)| {
            let share = area(at[from], at[to], middle);
            if share == 0.0 && !owns(at[from], at[to]) { -1.0 } else { share / whole }
        });
        if shares.iter().all(|share| *share >= 0.0) {
            let color = mixed(&corners, shares, atlas);
            blend(picture.get_pixel_mut(x, y), color);
        }
    }
}

/// The colour between three corners, premultiplied, from 0 to 255.
fn mixed(corners: &[Vertex; 3], shares: [f32; 3], atlas: &Atlas) -> [f32; 4] {
    let sum = |of: &dyn Fn(&Vertex) -> f32| corners.iter().zip(shares).map(|(corner, share)| share * of(corner)).sum();
    let texel = atlas.at([sum(&|corner| corner.uv.x), sum(&|corner| corner.uv.y)]);
    std::array::from_fn(|k| {
        let own: f32 = sum(&|corner| f32::from(corner.color.to_array()[k]));
        own * texel[k] / 255.0
    })
}

fn blend(pixel: &mut image::Rgba<u8>, [red, green, blue, opacity]: [f32; 4]) {
    let below = 1.0 - opacity / 255.0;
    for (to, from) in pixel.0.iter_mut().zip([red, green, blue]) {
        *to = (f32::from(*to) * below + from).round().clamp(0.0, 255.0) as u8;
    }
}
