//! Pictures off-screen: a target of any size, drawn to and read back.

use image::RgbaImage;

use super::camera::Camera;
use super::ensemble::{Ensemble, Pane};
use super::error::RenderError;
use super::gpu::Gpu;
use super::look::{Color, Look};
use super::renderer::Renderer;
use super::view::View;

/// What of a picture is not uploaded: the colour under it, whether it shows the mesh and fills, and the parts that it is drawn to.
type Drawn = (Color, bool, bool, Vec<[u32; 4]>);

/// An off-screen target with its renderers.
pub struct Capture {
    gpu: Gpu,
    ensemble: Ensemble,
    size: [u32; 2],
    texture: wgpu::Texture,
    readback: wgpu::Buffer,
    row_bytes: u32,
    /// Of the picture that lies in the read-back buffer, if one does.
    drawn: Option<Drawn>,
}

/// Bytes of a row of the read-back picture, and of all of it.
///
/// Errors: a size of 0 or beyond the limits.
fn layout([width, height]: [u32; 2], limits: &wgpu::Limits) -> Result<(u32, u64), RenderError> {
    let most = limits.max_texture_dimension_2d;
    if width == 0 || height == 0 || width > most || height > most {
        return Err(RenderError::Size { width, height, most });
    }
    // Rows of a copy begin at multiples of 256 bytes.
    let row_bytes = (4 * u64::from(width)).next_multiple_of(u64::from(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT));
    let bytes = row_bytes * u64::from(height);
    let most = limits.max_buffer_size;
    match u32::try_from(row_bytes) {
        Ok(row_bytes) if bytes <= most => Ok((row_bytes, bytes)),
        _ => Err(RenderError::Pixels { width, height, bytes, most }),
    }
}

/// Colours as stored, so that coverage blends into the numbers of the file.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

impl Capture {
    /// A target of `size` `[px]` for worlds of `dimensions`, on the GPU that there is.
    ///
    /// Errors: no GPU; a size of 0 or beyond what the GPU draws.
    pub fn new(size: [u32; 2], dimensions: usize) -> Result<Self, RenderError> {
        Capture::on(Gpu::headless()?, size, dimensions)
    }

    /// The same on a GPU that is open already.
    ///
    /// Errors: a size of 0 or beyond what the GPU draws.
    pub fn on(gpu: Gpu, size: [u32; 2], dimensions: usize) -> Result<Self, RenderError> {
        let [width, height] = size;
        let (row_bytes, bytes) = layout(size, &gpu.device.limits())?;
        let texture = gpu.target(("capture", [width, height]), FORMAT, wgpu::TextureUsages::COPY_SRC);
        let readback = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size: bytes,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let ensemble = Ensemble::new(&gpu, FORMAT, dimensions);
        Ok(Capture { gpu, ensemble, size, texture, readback, row_bytes, drawn: None })
    }

    /// The GPU that draws.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The renderer of the first world, for its counters.
    pub fn renderer(&self) -> &Renderer {
        self.ensemble.first()
    }

    /// The next picture is of another world, whatever its numbers say.
    pub fn forget_world(&mut self) {
        self.ensemble.forget_world();
        self.drawn = None;
    }

    /// Draws a picture and reads it back, opaque. One that is the same as the last is only read back.
    ///
    /// Errors: a world too large for the GPU, or a GPU that gave up.
    pub fn picture(&mut self, view: &View<'_>, camera: &Camera, look: &Look) -> Result<RgbaImage, RenderError> {
        self.pictures(&[Pane::whole(view.clone(), *camera, *look, self.size)])
    }

    /// Draws worlds side by side into one picture, the first over its ground colour: see [`Capture::picture`].
    ///
    /// Errors: as there.
    pub fn pictures(&mut self, panes: &[Pane<'_>]) -> Result<RgbaImage, RenderError> {
        self.pictures_below(panes, |_, _, _| Vec::new())
    }

    /// The same, with what `over` draws into the picture before it is read: it encodes its passes, and returns commands that go before them.
    /// Where nothing of the worlds changed it is not called, and the last picture is read once more.
    ///
    /// Errors: as there.
    pub fn pictures_below(
        &mut self,
        panes: &[Pane<'_>],
        over: impl FnOnce(&Gpu, &mut wgpu::CommandEncoder, &wgpu::TextureView) -> Vec<wgpu::CommandBuffer>,
    ) -> Result<RgbaImage, RenderError> {
        let before = self.ensemble.counters().uploads;
        // Gone if this fails halfway: then the next picture is drawn whatever it is.
        let drawn = self.drawn.take();
        self.ensemble.prepare(&self.gpu, panes)?;
        let look = panes.first().map(|pane| pane.look).unwrap_or_default();
        let clips = panes.iter().map(|pane| pane.clip).collect();
        let wanted = Some((look.ground, look.has_mesh, look.has_fills, clips));
        if self.ensemble.counters().uploads != before || drawn != wanted {
            self.draw(panes, over);
        }
        self.drawn = wanted;
        self.read()
    }

    /// Draws what was prepared, and copies it to where it can be read.
    fn draw(
        &mut self,
        panes: &[Pane<'_>],
        over: impl FnOnce(&Gpu, &mut wgpu::CommandEncoder, &wgpu::TextureView) -> Vec<wgpu::CommandBuffer>,
    ) {
        let target = self.texture.create_view(&Default::default());
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        self.ensemble.draw(&self.gpu, &mut encoder, &target, (self.size, self.size), panes);
        let mut commands = over(&self.gpu, &mut encoder, &target);
        let [width, height] = self.size;
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.readback,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.row_bytes),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        commands.push(encoder.finish());
        self.ensemble.submit(&self.gpu, commands);
    }

    fn read(&self) -> Result<RgbaImage, RenderError> {
        let lost = |reason: String| RenderError::Lost { reason };
        let slice = self.readback.slice(..);
        slice.map_async(wgpu::MapMode::Read, |_| {});
        self.gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| lost(error.to_string()))?;
        self.gpu.check()?;
        let [width, height] = self.size;
        let mut pixels = Vec::with_capacity(4 * width as usize * height as usize);
        {
            let mapped = slice.get_mapped_range().map_err(|error| lost(error.to_string()))?;
            for row in mapped.chunks(self.row_bytes as usize) {
                pixels.extend_from_slice(&row[..4 * width as usize]);
            }
        }
        self.readback.unmap();
        for pixel in pixels.chunks_exact_mut(4) {
            pixel[3] = 255;
        }
        RgbaImage::from_raw(width, height, pixels).ok_or_else(|| lost("the picture came back too small".to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits(max_texture_dimension_2d: u32, max_buffer_size: u64) -> wgpu::Limits {
        wgpu::Limits { max_texture_dimension_2d, max_buffer_size, ..Default::default() }
    }

    #[test]
    fn rows_are_aligned_and_large_pictures_counted_in_full() {
        let roomy = limits(1 << 31, u64::MAX);
        assert_eq!(layout([1, 3], &roomy), Ok((256, 768)));
        assert_eq!(layout([65, 1], &roomy), Ok((512, 512)));
        assert_eq!(layout([32768, 32768], &roomy), Ok((1 << 17, 1 << 32)), "4 GiB: more than 32 bits count");
    }

    #[test]
    fn a_picture_beyond_a_limit_is_refused_by_that_limit() {
        let tight = limits(32768, (1 << 32) - 1);
        let bytes = 1 << 32;
        let too_many = RenderError::Pixels { width: 32768, height: 32768, bytes, most: bytes - 1 };
        assert_eq!(layout([32768, 32768], &tight), Err(too_many));
        for [width, height] in [[0, 1], [1, 0], [32769, 1], [1, u32::MAX]] {
            let most = 32768;
            assert_eq!(layout([width, height], &tight), Err(RenderError::Size { width, height, most }));
        }
        let row = layout([1 << 30, 1], &limits(u32::MAX, u64::MAX));
        assert!(matches!(row, Err(RenderError::Pixels { .. })), "a row of 4 GiB: {row:?}");
    }
}
