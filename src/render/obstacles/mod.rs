//! Obstacles: polygons and planes as solid areas with a rim, under the bodies.
//!
//! What of each pixel they cover is added up from the exact share of every triangle; where it ends there is a rim. Both are kept
//! until obstacles, camera or the picture's size are others, and cost a look-up a pixel. Rims are looked for along edges alone: edges.rs.
//! In space planes are guides: patch.rs, and
//! balls and boxes are a pass of their own: solid.rs.

mod cut;
mod edges;
mod patch;
mod solid;

use std::ops::Range;

use glam::DVec2;

use super::buffers::WorldBuffers;
use super::camera::Camera;
use super::counters::RenderCounters;
use super::error::RenderError;
use super::frame::Frame;
use super::gpu::Gpu;
use super::growing::GrowingBuffer;
use super::skin::texture;
use super::view::View;
use crate::picture::{Filling, fill_outline};
use crate::sim::Polygon;
use cut::Cut;
pub(super) use patch::{Patch, RIM};
pub(super) use solid::solids;

/// Half floats, which every GPU adds up: what is covered of a pixel.
pub(super) const COVER: wgpu::TextureFormat = wgpu::TextureFormat::R16Float;
/// That, and what of it is rim.
pub(super) const SHARES: wgpu::TextureFormat = wgpu::TextureFormat::Rg8Unorm;

/// Vertices of a quad: one around each triangle.
const QUAD: u32 = 6;

/// The obstacles of a world on the GPU.
pub(super) struct Obstacles {
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    polygons: Vec<Polygon>,
    fillings: Vec<Filling>,
    planes: Vec<[[f64; 3]; 2]>,
    patches: Vec<Patch>,
    topology: Option<u64>,
    cut: Option<Cut>,
    triangles: GrowingBuffer,
    frame: GrowingBuffer,
    last_frame: Vec<u8>,
    binding: Option<wgpu::BindGroup>,
    runs: Vec<Range<u32>>,
    /// Ends of the edges along which there are rims; `None`: they are looked for everywhere.
    edges: Option<Vec<Range<u32>>>,
    cover: Option<Cover>,
}

/// What is covered of each pixel.
struct Cover {
    size: [u32; 2],
    /// The sums, then the shares; and how they are bound.
    views: [wgpu::TextureView; 2],
    bindings: [wgpu::BindGroup; 2],
    /// Whether it is that of the uniforms.
    is_fresh: bool,
}

impl Obstacles {
    pub(super) fn new(gpu: &Gpu) -> Self {
        Obstacles {
            layout: texture::layout(&gpu.device),
            sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("obstacles"),
                mag_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
            polygons: Vec::new(),
            fillings: Vec::new(),
            planes: Vec::new(),
            patches: Vec::new(),
            topology: None,
            cut: None,
            triangles: GrowingBuffer::new(gpu, "obstacles", wgpu::BufferUsages::STORAGE, 64),
            frame: GrowingBuffer::new(gpu, "frame", wgpu::BufferUsages::UNIFORM, 512),
            last_frame: Vec::new(),
            binding: None,
            runs: Vec::new(),
            edges: None,
            cover: None,
        }
    }

    /// How the target of what is covered is bound, beside the world's buffers.
    pub(super) fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// Nothing that was uploaded is of the next world.
    pub(super) fn forget(&mut self) {
        self.topology = None;
        self.patches.clear();
    }

    /// Planes as they are drawn in space.
    pub(super) fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// Uploads obstacles that are others, or of which others are near, and finds out which are in view.
    ///
    /// Errors: more than the GPU's buffers hold.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        (view, camera, frame): (&View<'_>, &Camera, &Frame),
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        if self.topology != Some(view.topology) || self.planes != view.planes {
            self.read(view);
        }
        self.runs.clear();
        let is_any = view.dimensions == 2 && !(self.fillings.is_empty() && self.planes.is_empty());
        if is_any && camera.height().is_finite() {
            self.find(gpu, camera, frame, counters)?;
        }
        if self.runs.is_empty() && !self.last_frame.is_empty() {
            // What was in view is no more: the picture is another, and uploads tell.
            self.last_frame.clear();
            self.frame.write(gpu, bytemuck::bytes_of(frame), counters)?;
        }
        Ok(())
    }

    /// Finds out what is in view, and uploads it if that has not been done.
    fn find(
        &mut self,
        gpu: &Gpu,
        camera: &Camera,
        frame: &Frame,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        let is_anew = self.cut.as_ref().is_none_or(|cut| !cut.serves(camera));
        if is_anew {
            let flat = |[x, y, _]: [f64; 3]| DVec2::new(x, y);
            let planes: Vec<[DVec2; 2]> = self.planes.iter().map(|plane| plane.map(flat)).collect();
            let cut = Cut::new(&self.fillings, &planes, camera);
            self.cut = None;
            self.triangles.write(gpu, bytemuck::cast_slice(&cut.corners()), counters)?;
            self.cut = Some(cut);
            self.spoil();
        }
        let Some(cut) = &self.cut else { return Ok(()) };
        let (runs, bounds) = cut.in_view(camera);
        if !runs.is_empty() {
            let frame = frame.of_obstacles(camera, cut.origin.extend(0.0), bounds);
            let bytes = bytemuck::bytes_of(&frame);
            if is_anew || self.last_frame != bytes {
                self.edges = cut.edges_in_view(camera, bounds, frame.outline());
            }
            if self.last_frame != bytes {
                self.frame.write(gpu, bytes, counters)?;
                self.last_frame = bytes.to_vec();
                self.spoil();
            }
        }
        self.runs = runs;
        Ok(())
    }

    /// What is covered has to be added up anew.
    fn spoil(&mut self) {
        self.cover.iter_mut().for_each(|cover| cover.is_fresh = false);
    }

    /// Takes the obstacles of a view, unless they are those that there are.
    fn read(&mut self, view: &View<'_>) {
        self.topology = Some(view.topology);
        if self.polygons != view.polygons || self.planes != view.planes {
            self.fillings = view.polygons.iter().map(|polygon| fill_outline(&polygon.loops)).collect();
            self.polygons = view.polygons.to_vec();
            if self.planes != view.planes {
                self.patches.clear();
            }
            self.planes.clone_from(&view.planes);
            self.cut = None;
        }
        self.patches = match view.dimensions {
            3 => patch::patches(view, std::mem::take(&mut self.patches)),
            _ => Vec::new(),
        };
    }

    /// Binds the world's buffers anew, where they or the obstacles' own are others than before.
    pub(super) fn rebind(&mut self, gpu: &Gpu, layout: &wgpu::BindGroupLayout, buffers: &WorldBuffers, all: bool) {
        let own = [&mut self.triangles, &mut self.frame].map(GrowingBuffer::take_unbound);
        if !(all || own.contains(&true) || self.binding.is_none()) {
            return;
        }
        self.binding = Some(buffers.bind(gpu, ("obstacles", layout), [&self.frame, &self.triangles]));
    }

    /// Adds up what is covered of a picture of `size` `[px]`, and finds the rims, unless that is known.
    pub(super) fn cover(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        [add, plain, edge, rim, _]: &[wgpu::RenderPipeline; 5],
        size: [u32; 2],
        counters: &mut RenderCounters,
    ) {
        let is_wanted = !self.runs.is_empty() && size[0] > 0 && size[1] > 0;
        let Some(binding) = self.binding.as_ref().filter(|_| is_wanted) else { return };
        let cover = match self.cover.take().filter(|cover| cover.size == size) {
            Some(cover) if cover.is_fresh => return self.cover = Some(cover),
            Some(cover) => cover,
            None => Cover::new(gpu, (&self.layout, &self.sampler), size),
        };
        let mut pass = begin(encoder, &cover.views[0]);
        pass.set_pipeline(add);
        pass.set_bind_group(0, binding, &[]);
        for run in &self.runs {
            pass.draw(run.start / 3 * QUAD..run.end / 3 * QUAD, 0..1);
            counters.obstacle_triangles_drawn += u64::from((run.end - run.start) / 3);
        }
        drop(pass);
        let edges = self.edges.as_deref();
        let mut pass = begin(encoder, &cover.views[1]);
        pass.set_pipeline(if edges.is_some() { plain } else { rim });
        pass.set_bind_group(0, binding, &[]);
        pass.set_bind_group(1, &cover.bindings[0], &[]);
        pass.draw(0..QUAD, 0..1);
        let edges = edges.unwrap_or_default();
        if !edges.is_empty() {
            pass.set_pipeline(edge);
        }
        for run in edges {
            pass.draw(run.start / 2 * QUAD..run.end / 2 * QUAD, 0..1);
        }
        drop(pass);
        counters.draws += (self.runs.len() + 1 + edges.len()) as u64;
        self.cover = Some(Cover { is_fresh: true, ..cover });
    }

    /// Shows what is covered.
    pub(super) fn draw(
        &self,
        target: &mut wgpu::RenderPass<'_>,
        [.., show]: &[wgpu::RenderPipeline; 5],
        counters: &mut RenderCounters,
    ) {
        if let (Some(binding), Some(cover), false) = (&self.binding, &self.cover, self.runs.is_empty()) {
            target.set_pipeline(show);
            target.set_bind_group(0, binding, &[]);
            target.set_bind_group(1, &cover.bindings[1], &[]);
            target.draw(0..QUAD, 0..1);
            counters.draws += 1;
        }
    }
}

/// A pass to a target that is clear.
fn begin<'a>(encoder: &'a mut wgpu::CommandEncoder, view: &wgpu::TextureView) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("obstacles"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
        })],
        depth_stencil_attachment: None,
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}

impl Cover {
    fn new(gpu: &Gpu, (layout, sampler): (&wgpu::BindGroupLayout, &wgpu::Sampler), size: [u32; 2]) -> Self {
        let views = [COVER, SHARES].map(|format| {
            let texture = gpu.target(("obstacles", size), format, wgpu::TextureUsages::TEXTURE_BINDING);
            texture.create_view(&Default::default())
        });
        let bindings = views.each_ref().map(|view| {
            let entries = [
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(view) },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(sampler) },
            ];
            let label = Some("obstacles");
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label, layout, entries: &entries })
        });
        Cover { size, views, bindings, is_fresh: false }
    }
}
