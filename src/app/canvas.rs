//! What a window is drawn on: surface, GPU, and the renderers of the world and the panels.

use std::sync::Arc;

use winit::event_loop::OwnedDisplayHandle;
use winit::window::Window;

use super::overlay::Overlay;
use super::painter::{Painter, over};
use crate::render::{Ensemble, Gpu, Pane, RenderCounters, RenderError};

/// Panels ready to be painted, again and again.
#[derive(Default)]
pub(super) struct Paint {
    pub(super) jobs: Vec<egui::ClippedPrimitive>,
    /// They are others than in the last picture.
    pub(super) is_new: bool,
    /// What is drawn over the world, under the panels: other in every picture.
    pub(super) marks: Vec<egui::ClippedPrimitive>,
    /// Textures that are new; none once they were given to the GPU.
    pub(super) textures: egui::TexturesDelta,
    pub(super) pixels_per_point: f32,
}

/// A surface with all that draws to it. Survives a surface that is outdated or lost; one of no size is not drawn to.
pub(super) struct Canvas {
    window: Arc<Window>,
    instance: wgpu::Instance,
    surface: wgpu::Surface<'static>,
    gpu: Gpu,
    config: wgpu::SurfaceConfiguration,
    ensemble: Ensemble,
    dimensions: usize,
    panels: Painter,
    overlay: Overlay,
    /// The surface must be configured before it is drawn to.
    outdated: bool,
}

impl Canvas {
    /// A canvas on `window` for worlds of `dimensions`.
    ///
    /// Errors: no GPU that can draw to the window.
    pub(super) fn new(
        window: Arc<Window>,
        display: OwnedDisplayHandle,
        dimensions: usize,
    ) -> Result<Self, RenderError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_with_display_handle_from_env(Box::new(display));
        descriptor.backends = crate::render::backends();
        let instance = wgpu::Instance::new(descriptor);
        let surface = surface(&instance, &window)?;
        let gpu = Gpu::open(&instance, Some(&surface))?;
        let config = configuration(&gpu, &surface, &window)?;
        let ensemble = Ensemble::new(&gpu, config.format, dimensions);
        let panels = Painter::new(&gpu, config.format);
        let overlay = Overlay::new(&gpu, config.format);
        Ok(Canvas { window, instance, surface, gpu, config, ensemble, dimensions, panels, overlay, outdated: true })
    }

    /// The window has another size `[px]`. One of no size (minimised) is remembered as nothing to draw on.
    pub(super) fn resize(&mut self, [width, height]: [u32; 2]) {
        let most = self.gpu.largest_side();
        self.config.width = width.min(most);
        self.config.height = height.min(most);
        self.outdated = true;
    }

    /// Width and height of the picture `[px]`.
    pub(super) fn size(&self) -> [u32; 2] {
        [self.config.width, self.config.height]
    }

    /// Largest side of a texture `[px]`.
    pub(super) fn largest_side(&self) -> u32 {
        self.gpu.largest_side()
    }

    /// Another world is to be drawn, of `dimensions`: whatever its numbers say, all of it is new.
    pub(super) fn forget_world(&mut self, dimensions: usize) {
        if dimensions == self.dimensions {
            return self.ensemble.forget_world();
        }
        // Its passes are others.
        let counters = self.ensemble.counters();
        self.ensemble = Ensemble::new(&self.gpu, self.config.format, dimensions);
        self.ensemble.count_from(counters);
        self.dimensions = dimensions;
    }

    /// Of the worlds that it draws.
    pub(super) fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// The GPU that draws.
    pub(super) fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    pub(super) fn counters(&self) -> RenderCounters {
        self.ensemble.counters()
    }

    /// Draws worlds into the upper left `area` `[px]` and the panels over it, and shows the picture.
    ///
    /// Errors: the GPU gave up, or a world too large for it; a surface that is only out of date is not an error.
    pub(super) fn draw(&mut self, panes: &[Pane<'_>], area: [u32; 2], paint: &mut Paint) -> Result<(), RenderError> {
        // Panels' textures are taken in every frame, drawn or not.
        if !paint.textures.set.is_empty() {
            self.overlay.spoil();
        }
        self.panels.take_textures(&self.gpu, &mut paint.textures);
        let drawn = match self.next_texture()? {
            Some(texture) => self.draw_to(texture, panes, area, paint),
            None => Ok(()),
        };
        self.panels.free_textures(&mut paint.textures);
        drawn?;
        self.gpu.check()
    }

    /// The surface's next texture; `None` where there is nothing to draw on now.
    fn next_texture(&mut self) -> Result<Option<wgpu::SurfaceTexture>, RenderError> {
        use wgpu::CurrentSurfaceTexture as Next;
        if self.config.width == 0 || self.config.height == 0 {
            return Ok(None);
        }
        // One try for each thing that can be wrong, then this frame is left out.
        for _ in 0..3 {
            if self.outdated {
                self.surface.configure(&self.gpu.device, &self.config);
                self.outdated = false;
            }
            match self.surface.get_current_texture() {
                Next::Success(texture) => return Ok(Some(texture)),
                Next::Suboptimal(texture) => {
                    self.outdated = true;
                    return Ok(Some(texture));
                }
                Next::Outdated => self.outdated = true,
                Next::Lost => {
                    self.surface = surface(&self.instance, &self.window)?;
                    self.outdated = true;
                }
                Next::Timeout | Next::Occluded | Next::Validation => return Ok(None),
            }
        }
        Ok(None)
    }

    fn draw_to(
        &mut self,
        texture: wgpu::SurfaceTexture,
        panes: &[Pane<'_>],
        area: [u32; 2],
        paint: &mut Paint,
    ) -> Result<(), RenderError> {
        self.ensemble.prepare(&self.gpu, panes)?;
        let target = texture.texture.create_view(&Default::default());
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let size = self.size();
        self.ensemble.draw(&self.gpu, &mut encoder, &target, (size, area), panes);
        let screen = egui_wgpu::ScreenDescriptor { size_in_pixels: size, pixels_per_point: paint.pixels_per_point };
        if std::mem::take(&mut paint.is_new) || !self.overlay.fits(size) {
            self.overlay.paint(&self.gpu, &mut self.panels, (&paint.jobs, &screen));
        }
        let mut commands = self.panels.upload(&self.gpu, &mut encoder, (&paint.marks, &screen));
        let mut pass = over(&mut encoder, &target);
        self.panels.paint(&mut pass, (&paint.marks, &screen));
        pass.set_viewport(0.0, 0.0, size[0] as f32, size[1] as f32, 0.0, 1.0);
        self.overlay.draw(&mut pass);
        drop(pass);
        commands.push(encoder.finish());
        self.ensemble.submit(&self.gpu, commands);
        self.window.pre_present_notify();
        self.gpu.queue.present(texture);
        Ok(())
    }
}

fn surface(instance: &wgpu::Instance, window: &Arc<Window>) -> Result<wgpu::Surface<'static>, RenderError> {
    instance.create_surface(Arc::clone(window)).map_err(|error| RenderError::NoAdapter { reason: error.to_string() })
}

/// The surface's own configuration, with a format that takes colours as they are stored.
fn configuration(
    gpu: &Gpu,
    surface: &wgpu::Surface<'_>,
    window: &Window,
) -> Result<wgpu::SurfaceConfiguration, RenderError> {
    let size = window.inner_size();
    let Some(mut config) = gpu.surface_config(surface, [size.width.max(1), size.height.max(1)]) else {
        return Err(RenderError::NoAdapter { reason: format!("`{}` cannot draw to this window", gpu.info.name) });
    };
    let formats = gpu.surface_capabilities(surface).formats;
    let stored = [wgpu::TextureFormat::Bgra8Unorm, wgpu::TextureFormat::Rgba8Unorm];
    if let Some(format) = stored.into_iter().find(|format| formats.contains(format)) {
        config.format = format;
    }
    (config.width, config.height) = (size.width, size.height);
    Ok(config)
}
