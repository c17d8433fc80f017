//! A picture as the GPU reads it: with mipmaps, and a colour for what is clear too.
//!
//! Triangles end half a pixel or so beyond the ink. What is clear there has a colour that nobody chose; so every clear
//! pixel gets one from what lies around it: colours are averaged upwards, level by level, weighted by how opaque they are, and
//! what is missing in a level is filled in from the next coarser one (pull and push).
//!
//! Source: S. J. Gortler et al., The Lumigraph, SIGGRAPH 1996, section 3.4.

use crate::picture::Picture;
use crate::render::counters::RenderCounters;
use crate::render::error::RenderError;
use crate::render::gpu::Gpu;

/// Red, green, blue, multiplied by the opacity, and that.
type Pixel = [f32; 4];

struct Level {
    width: usize,
    height: usize,
    pixels: Vec<Pixel>,
}

/// How a picture and its sampler are bound.
pub(in crate::render) fn layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let visibility = wgpu::ShaderStages::VERTEX_FRAGMENT;
    let picture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("picture"),
        entries: &[entry(0, picture), entry(1, sampler)],
    })
}

/// Uploads a picture; one larger than the GPU's textures at half its size, as often as that takes.
///
/// Errors: none that a picture can cause.
pub(super) fn upload(
    gpu: &Gpu,
    picture: &Picture,
    counters: &mut RenderCounters,
) -> Result<wgpu::TextureView, RenderError> {
    let most = gpu.device.limits().max_texture_dimension_2d as usize;
    let mut levels = pull(picture);
    let opaque: Vec<Vec<f32>> =
        levels.iter().map(|level| level.pixels.iter().map(|pixel| pixel[3]).collect()).collect();
    push(&mut levels);
    let too_large = levels.iter().take_while(|level| level.width > most || level.height > most).count();
    levels.retain(|level| level.width <= most && level.height <= most);
    let size = |level: &Level| wgpu::Extent3d {
        width: level.width as u32,
        height: level.height as u32,
        depth_or_array_layers: 1,
    };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("skin"),
        size: size(&levels[0]),
        mip_level_count: levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for ((number, level), opaque) in (0..).zip(&levels).zip(&opaque[too_large..]) {
        let with_opacity = |(pixel, alpha): (&Pixel, &f32)| {
            let [r, g, b, _] = stored(pixel);
            [r, g, b, (255.0 * alpha + 0.5) as u8]
        };
        let bytes: Vec<u8> = level.pixels.iter().zip(opaque).flat_map(with_opacity).collect();
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo { mip_level: number, ..texture.as_image_copy() },
            &bytes,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * level.width as u32),
                rows_per_image: None,
            },
            size(level),
        );
        counters.uploads += 1;
        counters.bytes_uploaded += bytes.len() as u64;
    }
    Ok(texture.create_view(&Default::default()))
}

fn stored(pixel: &Pixel) -> [u8; 4] {
    let [r, g, b, _] = pixel.map(|part| (255.0 * part + 0.5) as u8);
    [r, g, b, 255]
}

/// The picture and its halves, down to one pixel.
fn pull(picture: &Picture) -> Vec<Level> {
    let pixel = |rgba: &[u8]| {
        let [r, g, b, a] = [0, 1, 2, 3].map(|k| f32::from(rgba[k]) / 255.0);
        [r * a, g * a, b * a, a]
    };
    let (width, height) = (picture.width as usize, picture.height as usize);
    let mut levels = vec![Level { width, height, pixels: picture.rgba.chunks_exact(4).map(pixel).collect() }];
    while let Some(fine) = levels.last().filter(|level| level.width > 1 || level.height > 1) {
        let (width, height) = ((fine.width / 2).max(1), (fine.height / 2).max(1));
        let mean = |i: usize| {
            let [x, y] = [2 * (i % width), 2 * (i / width)];
            let mut sum = [0.0; 4];
            for (x, y) in [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)] {
                let of = fine.pixels[y.min(fine.height - 1) * fine.width + x.min(fine.width - 1)];
                (0..4).for_each(|k| sum[k] += 0.25 * of[k]);
            }
            sum
        };
        let pixels = (0..width * height).map(mean).collect();
        levels.push(Level { width, height, pixels });
    }
    levels
}

/// Fills in what is clear, from the coarsest level on; the last one, if it is all clear, is black.
fn push(levels: &mut [Level]) {
    if let Some([.., last]) = levels.last_mut().map(|level| &mut level.pixels[0]).filter(|pixel| pixel[3] == 0.0) {
        *last = 1.0;
    }
    let count = levels.len();
    if let Some(last) = levels.last_mut() {
        last.pixels.iter_mut().for_each(|pixel| *pixel = pixel.map(|part| part / pixel[3]));
    }
    for number in (0..count.saturating_sub(1)).rev() {
        let (fine, coarse) = levels.split_at_mut(number + 1);
        let (fine, coarse) = (&mut fine[number], &coarse[0]);
        // As much as one opaque pixel below is enough to know a colour: else it would be mixed with those from far away.
        let below = 4.0_f32.powi(number as i32);
        for i in 0..fine.pixels.len() {
            let opacity = fine.pixels[i][3];
            let known = (opacity * below).min(1.0);
            if opacity > 0.0 {
                fine.pixels[i] = fine.pixels[i].map(|part| part * known / opacity);
            }
            let missing = 1.0 - known;
            if missing > 0.0 {
                let [x, y] = [(i % fine.width) / 2, (i / fine.width) / 2];
                let from = coarse.pixels[y.min(coarse.height - 1) * coarse.width + x.min(coarse.width - 1)];
                (0..4).for_each(|k| fine.pixels[i][k] += missing * from[k]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clear_pixels_take_the_colour_beside_them() {
        let mut picture = Picture::filled(8, 5, [0, 0, 0, 0]);
        picture.rgba[4 * 9..4 * 10].copy_from_slice(&[200, 100, 50, 255]);
        let mut levels = pull(&picture);
        push(&mut levels);
        assert_eq!((levels.len(), levels[3].pixels.len()), (4, 1));
        for level in &levels {
            for pixel in &level.pixels {
                assert_eq!(stored(pixel), [200, 100, 50, 255]);
            }
        }
    }

    #[test]
    fn what_is_far_away_does_not_colour_what_is_near() {
        let mut picture = Picture::filled(64, 64, [0, 0, 0, 0]);
        for i in 0..64 * 64 {
            let colour = if i % 64 < 8 { [0, 200, 0, 255] } else { [200, 0, 0, 255] };
            if i % 64 < 8 || i % 64 >= 32 {
                picture.rgba[4 * i..][..4].copy_from_slice(&colour);
            }
        }
        let mut levels = pull(&picture);
        push(&mut levels);
        let [red, green, ..] = stored(&levels[0].pixels[64 * 30 + 9]);
        assert!(red < 5 && green > 195, "two pixels from the green: {red} {green}");
    }

    #[test]
    fn opaque_pictures_stay_as_they_are() {
        let mut picture = Picture::filled(2, 2, [10, 20, 30, 255]);
        picture.rgba[0] = 250;
        let mut levels = pull(&picture);
        push(&mut levels);
        assert_eq!(levels[0].pixels.iter().flat_map(stored).collect::<Vec<_>>(), picture.rgba);
        assert_eq!(stored(&levels[1].pixels[0]), [70, 20, 30, 255]);
    }
}
