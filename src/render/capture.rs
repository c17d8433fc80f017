//! Pictures off-screen: a target of any size, drawn to and read back.

use image::RgbaImage;

use super::camera::Camera;
use super::error::RenderError;
use super::gpu::Gpu;
use super::look::Look;
use super::renderer::Renderer;
use super::view::View;

/// An off-screen target with its renderer.
pub struct Capture {
    gpu: Gpu,
    renderer: Renderer,
    size: [u32; 2],
    texture: wgpu::Texture,
    readback: wgpu::Buffer,
    row_bytes: u32,
}

/// Colours as stored, so that coverage blends into the numbers of the file.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

impl Capture {
    /// A target of `size` [px] for worlds of `dimensions`, on the GPU that there is.
    ///
    /// Errors: no GPU; a size of 0 or beyond what the GPU draws.
    pub fn new(size: [u32; 2], dimensions: usize) -> Result<Self, RenderError> {
        let gpu = Gpu::headless()?;
        let [width, height] = size;
        let most = gpu.largest_side();
        if width == 0 || height == 0 || width > most || height > most {
            return Err(RenderError::Size { width, height, most });
        }
        // Rows of a copy begin at multiples of 256 bytes.
        let row_bytes = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let bytes = u64::from(row_bytes) * u64::from(height);
        if bytes > gpu.device.limits().max_buffer_size {
            return Err(RenderError::Size { width, height, most });
        }
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("capture"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let readback = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size: bytes,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let renderer = Renderer::new(&gpu, FORMAT, dimensions);
        Ok(Capture { gpu, renderer, size, texture, readback, row_bytes })
    }

    /// The GPU that draws.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The renderer, for its counters.
    pub fn renderer(&self) -> &Renderer {
        &self.renderer
    }

    /// Draws a picture and reads it back, opaque.
    ///
    /// Errors: a world too large for the GPU, or a GPU that gave up.
    pub fn picture(&mut self, view: &View<'_>, camera: &Camera, look: &Look) -> Result<RgbaImage, RenderError> {
        self.renderer.prepare(&self.gpu, view, camera, look)?;
        let target = self.texture.create_view(&Default::default());
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        self.renderer.draw(&self.gpu, &mut encoder, &target, self.size, self.size, look);
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
        self.renderer.submit(&self.gpu, [encoder.finish()]);
        self.read()
    }

    fn read(&self) -> Result<RgbaImage, RenderError> {
        let lost = |reason: String| RenderError::Lost { reason };
        let slice = self.readback.slice(..);
        slice.map_async(wgpu::MapMode::Read, |_| {});
        self.gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| lost(error.to_string()))?;
        self.gpu.check()?;
        let [width, height] = self.size;
        let mut pixels = Vec::with_capacity((4 * width * height) as usize);
        {
            let mapped = slice.get_mapped_range().map_err(|error| lost(error.to_string()))?;
            for row in mapped.chunks(self.row_bytes as usize) {
                pixels.extend_from_slice(&row[..(4 * width) as usize]);
            }
        }
        self.readback.unmap();
        for pixel in pixels.chunks_exact_mut(4) {
            pixel[3] = 255;
        }
        RgbaImage::from_raw(width, height, pixels).ok_or_else(|| lost("the picture came back too small".to_owned()))
    }
}
