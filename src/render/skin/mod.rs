//! Skins: pictures on the triangles of bodies, drawn under their bonds.
//!
//! A triangle is drawn as long as all of its sides are bonds: where one broke, the skin is open. Teeth that a cut leaves are closed (`notch.rs`). Along the sides that are then
//! free, and along bonds that are no triangle's, goes a stroke in the picture's colours: triangles alone have ragged edges. In the plane, where
//! the picture ends beside a side, it is drawn on up to its own edge instead (`rind.rs`).
//! Where a picture is half transparent it is seen through, without such a stroke: it ends where it is clear.
//! A body with a colour of its own has its picture in shades of it: what is light stays light beside what is dark. Colours beside each other go softly
//! from one to the other (`soft.rs`).

mod ink;
mod rind;
mod sides;
mod soft;
pub(super) mod texture;

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};

use super::buffers::WorldBuffers;
use super::counters::RenderCounters;
use super::cover::Strands;
use super::error::RenderError;
use super::gpu::Gpu;
use super::growing::GrowingBuffer;
use super::notch::closing;
use super::view::View;
use crate::picture::{Picture, Skin, Tint};
use crate::sim::bond::lower_first;
use rind::Rind;
use sides::Sides;
use soft::softened;

/// A corner as the shader reads it: `Corner` in skin.wgsl.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
struct Corner {
    point: u32,
    u: f32,
    v: f32,
    /// The colour that the picture is seen in there: red, green, blue from the lowest bits on, and [`THROUGH`].
    tint: u32,
}

const _: () = assert!(size_of::<Corner>() == 16);

/// What leaves a picture as it is.
const CLEAR: [u8; 3] = [255; 3];

/// The skins of a world on the GPU.
pub(super) struct Skins {
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    worn: Vec<Worn>,
    topology: Option<u64>,
}

/// One skin.
struct Worn {
    picture: Arc<Picture>,
    paint: wgpu::BindGroup,
    rind: GrowingBuffer,
    triangles: GrowingBuffer,
    edges: GrowingBuffer,
    /// Vertices of all three.
    counts: [u32; 3],
    /// The world's bindings, with the corners of each.
    bindings: Option<[wgpu::BindGroup; 3]>,
}

/// Marks corners of triangles of which only what the picture covers is shown: `CLIPPED` in skin.wgsl.
const CLIPPED: u32 = 1 << 31;

/// Where one of so many triangles is seen through, all of them are.
const FADING: usize = 8;

/// In a tint: the picture is shown as opaque as it is there, `tint.a` in skin.wgsl.
const THROUGH: u32 = 255 << 24;

/// Vertices of a stroke.
const QUAD: u32 = 6;

impl Skins {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("skin"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        Skins { layout: texture::layout(&gpu.device), sampler, worn: Vec::new(), topology: None }
    }

    /// Nothing that was uploaded is of the next world.
    pub(super) fn forget(&mut self) {
        self.worn.clear();
        self.topology = None;
    }

    /// Triangles are drawn otherwise from now on; pictures stay.
    pub(super) fn forget_triangles(&mut self) {
        self.topology = None;
    }

    /// How a skin's picture is bound, beside the world's buffers.
    pub(super) fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// Uploads skins that are new, and the triangles of all when bonds came or went.
    ///
    /// Errors: a skin larger than the GPU's buffers, a picture larger than its textures.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        view: &View<'_>,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        let is_same = self.worn.len() == view.skins.len()
            && self.worn.iter().zip(view.skins).all(|(worn, skin)| Arc::ptr_eq(&worn.picture, &skin.picture));
        if is_same && self.topology == Some(view.topology) {
            return Ok(());
        }
        self.topology = None;
        if !is_same {
            self.worn.clear();
            for skin in view.skins {
                self.worn.push(self.wear(gpu, skin, counters)?);
            }
        }
        let sides = Sides::of(view);
        for (worn, skin) in self.worn.iter_mut().zip(view.skins) {
            worn.dress(gpu, (skin, view), &sides, counters)?;
        }
        self.topology = Some(view.topology);
        Ok(())
    }

    /// A picture that another skin has already is not uploaded again.
    fn wear(&self, gpu: &Gpu, skin: &Skin, counters: &mut RenderCounters) -> Result<Worn, RenderError> {
        let same = self.worn.iter().find(|worn| Arc::ptr_eq(&worn.picture, &skin.picture));
        let paint = match same {
            Some(worn) => worn.paint.clone(),
            None => self.paint(gpu, &skin.picture, counters)?,
        };
        let list = || GrowingBuffer::new(gpu, "skin", wgpu::BufferUsages::STORAGE, 64);
        let picture = Arc::clone(&skin.picture);
        let [rind, triangles, edges] = [list(), list(), list()];
        Ok(Worn { picture, paint, rind, triangles, edges, counts: [0; 3], bindings: None })
    }

    fn paint(
        &self,
        gpu: &Gpu,
        picture: &Picture,
        counters: &mut RenderCounters,
    ) -> Result<wgpu::BindGroup, RenderError> {
        let view = texture::upload(gpu, picture, counters)?;
        let entries = [
            wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) },
            wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&self.sampler) },
        ];
        Ok(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("skin"),
            layout: &self.layout,
            entries: &entries,
        }))
    }

    /// Binds the world's buffers anew, where `all` of them or a skin's own are others than before.
    pub(super) fn rebind(&mut self, gpu: &Gpu, layout: &wgpu::BindGroupLayout, buffers: &WorldBuffers, all: bool) {
        for worn in &mut self.worn {
            let lists = [&mut worn.rind, &mut worn.triangles, &mut worn.edges];
            let is_other = lists.map(GrowingBuffer::take_unbound).contains(&true);
            if !(all || is_other || worn.bindings.is_none()) {
                continue;
            }
            let bound = |list| buffers.bind(gpu, ("skin", layout), [&buffers.frame.buffer, list]);
            worn.bindings = Some([&worn.rind, &worn.triangles, &worn.edges].map(bound));
        }
    }

    /// Draws all skins: what is beside triangles, these, then edges.
    pub(super) fn draw(
        &self,
        target: &mut wgpu::RenderPass<'_>,
        pipelines: &[wgpu::RenderPipeline; 3],
        counters: &mut RenderCounters,
    ) {
        for worn in &self.worn {
            let Some(bindings) = &worn.bindings else { continue };
            for ((pipeline, binding), count) in pipelines.iter().zip(bindings).zip(worn.counts) {
                if count > 0 {
                    target.set_pipeline(pipeline);
                    target.set_bind_group(0, binding, &[]);
                    target.set_bind_group(1, &worn.paint, &[]);
                    target.draw(0..count, 0..1);
                    counters.draws += 1;
                }
            }
            counters.triangles_drawn += u64::from(worn.counts[1] / 3);
        }
    }
}

impl Worn {
    /// Uploads the triangles whose sides are all there, those that close notches between them, the edges, and in the plane what is beside them.
    fn dress(
        &mut self,
        gpu: &Gpu,
        (skin, view): (&Skin, &View<'_>),
        sides: &Sides,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        let own = |point: u32| Tint::of(view.tints, point).and_then(|tint| tint.color).unwrap_or(CLEAR);
        let soft = softened((skin.first, skin.texture.len()), &skin.triangles, own);
        let tint = |point: u32| {
            let soft = soft.get(point.wrapping_sub(skin.first) as usize).copied();
            let [red, green, blue] = soft.unwrap_or_else(|| own(point));
            u32::from_le_bytes([red, green, blue, 0])
        };
        let tint = |point: u32, is_through: bool| tint(point) | if is_through { THROUGH } else { 0 };
        let at = |point: u32| skin.texture.get((point - skin.first) as usize).copied().unwrap_or_default();
        let corner = |point: u32, is_through: bool| {
            let [u, v] = at(point);
            Corner { point, u, v, tint: tint(point, is_through) }
        };
        let size = [skin.picture.width as f32, skin.picture.height as f32];
        let place = |point: u32| [0, 1].map(|axis| at(point)[axis] * size[axis]);
        let mut whole = sides.whole(&skin.triangles);
        whole.extend(closing(view, &whole));
        let mut through: Vec<bool> =
            whole.iter().map(|corners| ink::is_triangle_through(&skin.picture, corners.map(place))).collect();
        // What fades out has opaque triangles too: between them and others there would be an edge.
        if FADING * through.iter().filter(|is| **is).count() >= through.len() {
            through.fill(true);
        }
        let both = || whole.iter().zip(&through);
        let mut triangles: Vec<Corner> =
            both().flat_map(|(corners, &is)| corners.map(|point| corner(point, is))).collect();
        let strands = Strands::of(skin, view.tints);
        let is_of_skin = |point: u32| (point.wrapping_sub(skin.first) as usize) < skin.texture.len();
        let has_picture = |point: u32| is_of_skin(point) && !strands.have(point);
        let mut edges = sides.edges(&skin.triangles, &whole, has_picture);
        let mut rind = Rind::default();
        if view.dimensions == 2 {
            let mut free = edges.clone();
            free.sort_unstable();
            rind = Rind::of(skin, (&whole, &through), &free, tint);
            let is_clipped = rind.clipped.iter().flat_map(|triangle| 3 * triangle..3 * triangle + 3);
            is_clipped.for_each(|corner| triangles[corner].point |= CLIPPED);
            edges.retain(|side| rind.sides.binary_search(side).is_err());
            // Of what is shown only as far as the picture goes, a side beyond that is nothing.
            let mut beyond: Vec<[u32; 2]> = rind.clipped.iter().flat_map(|&k| sides::sides(whole[k])).collect();
            beyond.iter_mut().for_each(|side| *side = lower_first(*side));
            beyond.sort_unstable();
            edges.retain(|side| {
                beyond.binary_search(side).is_err() || ink::is_strand_there(&skin.picture, side.map(place))
            });
        }
        let [opaque, seen_through] = [false, true].map(|wanted| {
            let of = both().filter(|(_, is)| **is == wanted).flat_map(|(&corners, _)| sides::sides(corners));
            let mut list: Vec<[u32; 2]> = of.map(lower_first).collect();
            list.sort_unstable();
            list
        });
        edges.retain(|side| seen_through.binary_search(side).is_err());
        // A side of an opaque triangle lies where the picture ends: strands alone may be seen through.
        let of_edge = |side: &[u32; 2]| {
            let is = opaque.binary_search(side).is_err() && ink::is_strand_through(&skin.picture, side.map(place));
            side.map(|point| corner(point, is))
        };
        let edges: Vec<Corner> = edges.iter().flat_map(of_edge).collect();
        self.rind.write(gpu, bytemuck::cast_slice(&rind.corners), counters)?;
        self.triangles.write(gpu, bytemuck::cast_slice(&triangles), counters)?;
        self.edges.write(gpu, bytemuck::cast_slice(&edges), counters)?;
        self.counts = [rind.corners.len() as u32, triangles.len() as u32, QUAD * (edges.len() / 2) as u32];
        Ok(())
    }
}
