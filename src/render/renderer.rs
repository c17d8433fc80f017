//! Draws a world: uploads what changed, then one pass after another into any target.

use super::buffers::WorldBuffers;
use super::counters::RenderCounters;
use super::ensemble::Pane;
use super::error::RenderError;
use super::fills::Fills;
use super::floor;
use super::frame::Frame;
use super::gpu::Gpu;
use super::guides::guides;
use super::look::{Color, Overlay};
use super::obstacles::{Obstacles, solids};
use super::passes::{DEPTH, Passes, Shown};
use super::seen_forms::Forms;
use super::skin::Skins;
use super::veil::Veil;
use crate::picture::Tint;

/// Lengths of typical bonds in their widths up to which a triangle around a stroke is drawn faster than a quad: it is set up once, not twice, but
/// has twice the pixels.
const SHORT: f32 = 24.0;

/// A renderer for worlds of one dimension, to targets of one format.
///
/// Blends colours as they are stored: the format must not convert sRGB by itself (`Rgba8Unorm`, `Bgra8Unorm`).
pub struct Renderer {
    passes: Passes,
    buffers: WorldBuffers,
    skins: Skins,
    obstacles: Obstacles,
    fills: Fills,
    depth: Option<(wgpu::TextureView, [u32; 2])>,
    dimensions: usize,
    has_region: bool,
    has_fills: bool,
    shows_map: bool,
    forms: Forms,
    veil: Veil,
    /// How bodies were drawn last.
    tints: Vec<Tint>,
    counters: RenderCounters,
}

impl Renderer {
    /// A renderer without a world: the first [`Renderer::prepare`] gives it one.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat, dimensions: usize) -> Self {
        let (skins, obstacles, fills) = (Skins::new(gpu), Obstacles::new(gpu), Fills::new(gpu));
        let own = [skins.layout(), obstacles.layout(), fills.layout()];
        let passes = Passes::new(gpu, format, dimensions, own);
        Renderer::of(gpu, passes, (skins, obstacles, fills), dimensions)
    }

    /// One for another world of the same picture: its pipelines are the same.
    pub(super) fn another(&self, gpu: &Gpu) -> Self {
        let own = (Skins::new(gpu), Obstacles::new(gpu), Fills::new(gpu));
        Renderer::of(gpu, self.passes.clone(), own, self.dimensions)
    }

    fn of(gpu: &Gpu, passes: Passes, (skins, obstacles, fills): (Skins, Obstacles, Fills), dimensions: usize) -> Self {
        Renderer {
            passes,
            buffers: WorldBuffers::new(gpu),
            skins,
            obstacles,
            fills,
            depth: None,
            dimensions,
            has_region: false,
            has_fills: false,
            shows_map: false,
            forms: Forms::None,
            veil: Veil::default(),
            tints: Vec::new(),
            counters: RenderCounters::default(),
        }
    }

    /// Uploads what changed since the last picture.
    ///
    /// Errors: a world larger than the GPU's buffers.
    pub fn prepare(&mut self, gpu: &Gpu, pane: &Pane<'_>) -> Result<(), RenderError> {
        let Pane { view, camera, look, .. } = pane;
        if self.tints != view.tints {
            view.tints.clone_into(&mut self.tints);
            self.buffers.forget_bonds();
            self.fills.forget();
            self.skins.forget_triangles();
            self.veil.forget();
        }
        let veiled = self.veil.over(view);
        let view = veiled.as_ref().unwrap_or(view);
        let counters = &mut self.counters;
        self.fills.update(gpu, view, counters)?;
        self.buffers.update(gpu, (view, self.fills.triangles()), camera, counters)?;
        let shows_strain = look.overlay == Overlay::Strain;
        self.has_fills = look.has_fills;
        self.shows_map = shows_strain || (look.overlay == Overlay::Difference && view.values.is_some());
        if look.has_fills {
            let places = self.buffers.current_places(view);
            self.fills.shade(gpu, (view, places), shows_strain, counters)?;
        }
        self.skins.update(gpu, view, counters)?;
        let origin = self.buffers.origin;
        let frame = Frame::new(view, camera, look, &self.buffers);
        self.obstacles.update(gpu, (view, camera, &frame), counters)?;
        let part = (pane.clip, pane.border());
        let (lines, counts) = guides((view, camera, self.obstacles.patches()), part, origin, look);
        self.buffers.set_guides(gpu, bytemuck::cast_slice(&lines), counts, counters)?;
        self.buffers.set_solids(gpu, solids(view, camera, origin), counters)?;
        self.buffers.set_floor(gpu, floor::rows(view, self.obstacles.patches(), origin, look), counters)?;
        self.has_region = frame.has_region();
        let scale = frame.scale_of_bonds(camera);
        self.forms = self.buffers.seen_forms(view, scale);
        let length = self.buffers.typical_bond * scale.pixels_per_metre;
        self.buffers.are_short =
            self.dimensions == 2 && self.forms != Forms::All && length < f64::from(SHORT * scale.bond_width);
        self.buffers.set_frame(gpu, bytemuck::bytes_of(&frame), counters)?;
        let wanted = frame.wanted(camera, &self.buffers, look.has_mesh || !look.has_fills);
        self.buffers.select(view, &wanted, counters);
        counters.bytes_held = self.buffers.bytes();
        let is_other = self.buffers.take_unbound();
        if is_other {
            self.passes.rebind(gpu, &self.buffers);
        }
        self.skins.rebind(gpu, self.passes.layout(), &self.buffers, is_other);
        self.fills.rebind(gpu, self.passes.layout(), &self.buffers, is_other);
        self.obstacles.rebind(gpu, self.passes.layout(), &self.buffers, is_other);
        Ok(())
    }

    /// The next picture is of another world: nothing that was uploaded is of it.
    pub fn forget_world(&mut self) {
        self.buffers.forget();
        self.skins.forget();
        self.obstacles.forget();
        self.fills.forget();
        self.veil.forget();
    }

    /// Draws what was prepared into a part of the upper left `area` of `target`, which has `size` `[px]`, over a ground of its colour,
    /// or over what is there: `clip` is left, top, width and height of that part `[px]`.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        (size, area, clip): ([u32; 2], [u32; 2], [u32; 4]),
        ground: Option<Color>,
    ) {
        let clear = |color: Color| {
            let [r, g, b, a] = color.map(f64::from);
            wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a })
        };
        let depth = self.depth_view(gpu, size);
        self.passes.cover(gpu, encoder, &mut self.obstacles, area, &mut self.counters);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("world"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: ground.map_or(wgpu::LoadOp::Load, clear), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: depth.as_ref().map(|view| wgpu::RenderPassDepthStencilAttachment {
                view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        let [left, top, width, height] = clip;
        if area[0] > 0 && area[1] > 0 && width > 0 && height > 0 {
            pass.set_viewport(0.0, 0.0, area[0] as f32, area[1] as f32, 0.0, 1.0);
            pass.set_scissor_rect(left, top, width, height);
            let shapes = (&self.buffers, &self.skins, &self.obstacles, &self.fills);
            let shown =
                Shown { region: self.has_region, fills: self.has_fills, map: self.shows_map, forms: self.forms };
            self.passes.draw(&mut pass, shapes, shown, &mut self.counters);
        }
        self.counters.frames_drawn += 1;
    }

    /// Submits a picture's commands.
    pub fn submit(&mut self, gpu: &Gpu, commands: impl IntoIterator<Item = wgpu::CommandBuffer>) {
        gpu.queue.submit(commands);
        self.counters.submits += 1;
    }

    /// The depth of a picture of this size, in space; the plane has none.
    fn depth_view(&mut self, gpu: &Gpu, size: [u32; 2]) -> Option<wgpu::TextureView> {
        if self.dimensions == 2 {
            return None;
        }
        if self.depth.as_ref().is_none_or(|(_, made_for)| *made_for != size) {
            let texture = gpu.target(("depth", size), DEPTH, wgpu::TextureUsages::empty());
            self.depth = Some((texture.create_view(&Default::default()), size));
        }
        self.depth.as_ref().map(|(view, _)| view.clone())
    }

    /// Goes on counting from what another renderer did before.
    pub fn count_from(&mut self, counters: RenderCounters) {
        self.counters = counters;
    }

    /// Work done since the renderer was made.
    pub fn counters(&self) -> &RenderCounters {
        &self.counters
    }
}
