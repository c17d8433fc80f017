//! Paints what egui tessellates on the GPU: panels and words in the window, words in pictures off-screen.

use egui::{ClippedPrimitive, TexturesDelta};
use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};

use crate::render::Gpu;

/// egui's own renderer, set up in one way for all that is painted.
pub(super) struct Painter(Renderer);

impl Painter {
    /// For targets of a format that takes colours as they are stored.
    pub(super) fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        // What is painted once more has the same colours.
        let options = RendererOptions { dithering: false, ..Default::default() };
        Painter(Renderer::new(&gpu.device, format, options))
    }

    /// Gives the GPU the textures that are new, before anything is painted with them.
    #[allow(clippy::iter_over_hash_type, reason = "textures are independent of each other")]
    pub(super) fn take_textures(&mut self, gpu: &Gpu, textures: &mut TexturesDelta) {
        for (id, deltas) in textures.set.drain() {
            for delta in deltas {
                self.0.update_texture(&gpu.device, &gpu.queue, id, &delta);
            }
        }
    }

    /// Frees the textures that are needed no more, after the last picture with them.
    #[allow(clippy::iter_over_hash_type, reason = "textures are independent of each other")]
    pub(super) fn free_textures(&mut self, textures: &mut TexturesDelta) {
        for id in textures.free.drain() {
            self.0.free_texture(&id);
        }
    }

    /// Uploads what [`Painter::paint`] is going to paint. The commands that are returned go before those of `encoder`.
    pub(super) fn upload(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (jobs, screen): (&[ClippedPrimitive], &ScreenDescriptor),
    ) -> Vec<wgpu::CommandBuffer> {
        self.0.update_buffers(&gpu.device, &gpu.queue, encoder, jobs, screen)
    }

    /// Paints what was uploaded in a pass of [`over`].
    pub(super) fn paint(
        &self,
        pass: &mut wgpu::RenderPass<'static>,
        (jobs, screen): (&[ClippedPrimitive], &ScreenDescriptor),
    ) {
        self.0.render(pass, jobs, screen);
    }
}

/// A pass that draws over what is in a target.
pub(super) fn over(encoder: &mut wgpu::CommandEncoder, target: &wgpu::TextureView) -> wgpu::RenderPass<'static> {
    let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("panels"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    });
    pass.forget_lifetime()
}
