//! Bodies without a picture: what they cover, filled in a colour of their own, with an outline and in the plane a soft shadow about
//! it, body by body, so that overlaps read.
//!
//! Bodies with a picture are filled only where strain is shown in place of it.
//!
//! A list of primitives of three kinds, drawn in order by one pass, is uploaded when the topology changes. Points have a row to shade
//! by, uploaded when they moved, where that is shown: a normal in space, a strain where strain is.

mod bodies;
mod outline;
mod shade;

use std::ops::Range;

use bytemuck::{Pod, Zeroable};

use super::buffers::{GpuBond, WorldBuffers};
use super::counters::RenderCounters;
use super::error::RenderError;
use super::gpu::Gpu;
use super::growing::GrowingBuffer;
use super::view::View;
use bodies::{Filled, bodies};
use outline::{Side, outline};
use shade::{Shade, shades};

/// A primitive as the shader reads it: `Primitive` in fill.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
struct Primitive {
    /// Of a fill the corners of two triangles, of a side its ends with those before and after, then nothing.
    points: [u32; 6],
    /// The kind in the upper eight bits, then red, green, blue.
    ink: u32,
}

const _: () = assert!(size_of::<Primitive>() == 28);

/// Kinds of primitives: `FILL`, `OUTLINE`, `SHADOW` in fill.wgsl.
const FILL: u32 = 0;
const OUTLINE: u32 = 1;
const SHADOW: u32 = 2;

/// Vertices of a primitive.
const QUAD: u32 = 6;
/// Triangles from which on bodies are not filled: their bonds, which are drawn as few as it takes, cover the same.
const MOST: usize = 1 << 18;
/// Sides of outlines from which on there are no shadows: so many bodies are small.
const MOST_SHADOWS: usize = 6_000;

/// The fills of a world on the GPU.
pub(super) struct Fills {
    layout: wgpu::BindGroupLayout,
    primitives: GrowingBuffer,
    shades: GrowingBuffer,
    /// Of bodies without a picture, then of those with one: primitives that fill, and in space those of outlines behind them; in the
    /// plane all are in the first.
    parts: [[Range<u32>; 2]; 2],
    /// What is filled of each of both.
    triangles: [Vec<[u32; 3]>; 2],
    bindings: Option<[wgpu::BindGroup; 2]>,
    topology: Option<u64>,
    /// The motion that the rows are of, and whether they have strains.
    shaded: Option<(u64, bool)>,
    rows: Vec<Shade>,
}

impl Fills {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("shades"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only: true },
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let storage = |what| GrowingBuffer::new(gpu, what, wgpu::BufferUsages::STORAGE, 64);
        Fills {
            layout,
            primitives: storage("fills"),
            shades: storage("shades"),
            parts: Default::default(),
            triangles: Default::default(),
            bindings: None,
            topology: None,
            shaded: None,
            rows: Vec::new(),
        }
    }

    /// How the rows of points are bound, beside the world's buffers.
    pub(super) fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// Nothing that was uploaded is of the next world.
    pub(super) fn forget(&mut self) {
        (self.topology, self.shaded) = (None, None);
    }

    /// What is filled of bodies without a picture.
    pub(super) fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles[0]
    }

    /// Finds out what is filled, and uploads it, when the topology changed.
    ///
    /// Errors: more than the GPU's buffers hold.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        view: &View<'_>,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        if self.topology == Some(view.topology) {
            return Ok(());
        }
        (self.topology, self.shaded) = (None, None);
        let bodies = if view.triangles.len() > MOST { Default::default() } else { bodies(view) };
        let mut list = Vec::new();
        for (place, bodies) in bodies.iter().enumerate() {
            self.triangles[place] = bodies.iter().flat_map(|body| body.triangles.iter().copied()).collect();
            let first = list.len() as u32;
            let (primitives, split) = primitives(bodies, view.dimensions);
            list.extend(primitives);
            self.parts[place] = [first..first + split, first + split..list.len() as u32];
        }
        self.primitives.write(gpu, bytemuck::cast_slice(&list), counters)?;
        self.topology = Some(view.topology);
        Ok(())
    }

    /// Works out and uploads the rows of points where positions are others: in space, and where strain is shown.
    ///
    /// Errors: more than the GPU's buffers hold.
    pub(super) fn shade(
        &mut self,
        gpu: &Gpu,
        (view, flat): (&View<'_>, &[f32]),
        shows_strain: bool,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        let wanted = Some((view.motion, shows_strain));
        let is_any = self.triangles.iter().any(|triangles| !triangles.is_empty());
        if !is_any || !(shows_strain || view.dimensions == 3) || self.shaded == wanted {
            return Ok(());
        }
        self.shaded = None;
        let bonds: Vec<GpuBond> =
            if shows_strain { view.bonds.iter().map(GpuBond::from).collect() } else { Vec::new() };
        let triangles = self.triangles.each_ref().map(Vec::as_slice);
        if view.dimensions == 3 {
            shades(flat.as_chunks::<3>().0, triangles, &bonds, &mut self.rows);
        } else {
            shades(flat.as_chunks::<2>().0, triangles, &bonds, &mut self.rows);
        }
        self.shades.write(gpu, bytemuck::cast_slice(&self.rows), counters)?;
        self.shaded = wanted;
        Ok(())
    }

    /// Binds the world's buffers anew, where `all` of them or those of fills are others than before.
    pub(super) fn rebind(&mut self, gpu: &Gpu, layout: &wgpu::BindGroupLayout, buffers: &WorldBuffers, all: bool) {
        let is_other = [self.primitives.take_unbound(), self.shades.take_unbound()].contains(&true);
        if !(all || is_other || self.bindings.is_none()) {
            return;
        }
        let world = buffers.bound(&buffers.frame, &self.primitives);
        self.bindings = Some([bind(gpu, layout, &world), bind(gpu, &self.layout, &[&self.shades])]);
    }

    /// Draws all fills, with their outlines and shadows; of bodies with a picture too where a map is shown in place of it.
    pub(super) fn draw(
        &self,
        shows_map: bool,
        target: &mut wgpu::RenderPass<'_>,
        pipelines: &[wgpu::RenderPipeline; 2],
        counters: &mut RenderCounters,
    ) {
        let Some([world, shades]) = &self.bindings else { return };
        for (parts, triangles) in self.parts.iter().zip(&self.triangles).take(1 + usize::from(shows_map)) {
            for (pipeline, part) in pipelines.iter().zip(parts) {
                if !part.is_empty() {
                    target.set_pipeline(pipeline);
                    target.set_bind_group(0, world, &[]);
                    target.set_bind_group(1, shades, &[]);
                    target.draw(QUAD * part.start..QUAD * part.end, 0..1);
                    counters.draws += 1;
                }
            }
            counters.triangles_drawn += triangles.len() as u64;
        }
    }
}

fn bind(gpu: &Gpu, layout: &wgpu::BindGroupLayout, buffers: &[&GrowingBuffer]) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(buffers)
        .map(|(binding, of)| wgpu::BindGroupEntry { binding, resource: of.buffer.as_entire_binding() })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("fills"), layout, entries: &entries })
}

/// What is drawn of bodies: in the plane body by body, each over those before it; in space all fills, then all outlines. Also how many
/// come before those that have a pipeline of their own.
fn primitives(bodies: &[Filled], dimensions: usize) -> (Vec<Primitive>, u32) {
    let sides: Vec<Vec<Side>> = bodies.iter().map(|body| outline(&body.triangles)).collect();
    let has_shadows = sides.iter().map(Vec::len).sum::<usize>() <= MOST_SHADOWS;
    let (mut list, mut outlines) = (Vec::new(), Vec::new());
    for (body, sides) in bodies.iter().zip(&sides) {
        let side = |kind, side: &Side| Primitive {
            points: [side.before, side.a, side.b, side.after, 0, 0],
            ink: ink(kind, body.color),
        };
        if dimensions == 2 && has_shadows {
            list.extend(sides.iter().map(|one| side(SHADOW, one)));
        }
        list.extend(body.triangles.chunks(2).map(|pair| {
            let [a, b, c] = pair[0];
            // A triangle without another beside it has one of no area.
            let [d, e, f] = pair.get(1).copied().unwrap_or([a; 3]);
            Primitive { points: [a, b, c, d, e, f], ink: ink(FILL, body.color) }
        }));
        let to = if dimensions == 2 { &mut list } else { &mut outlines };
        to.extend(sides.iter().map(|one| side(OUTLINE, one)));
    }
    let split = list.len() as u32;
    list.append(&mut outlines);
    (list, split)
}

fn ink(kind: u32, [red, green, blue]: [u8; 3]) -> u32 {
    u32::from_be_bytes([kind as u8, red, green, blue])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_the_plane_a_body_lies_over_those_before_it_and_in_space_outlines_lie_over_all() {
        let body = |first: u32| Filled { color: [1, 2, 3], triangles: vec![[first, first + 1, first + 2]] };
        let kinds = |dimensions| {
            let (list, split) = primitives(&[body(0), body(3)], dimensions);
            (list.iter().map(|primitive| primitive.ink >> 24).collect::<Vec<u32>>(), split)
        };
        let one = [[SHADOW; 3].as_slice(), &[FILL], &[OUTLINE; 3]].concat();
        assert_eq!(kinds(2), ([one.clone(), one].concat(), 14));
        assert_eq!(kinds(3), ([[FILL; 2].as_slice(), &[OUTLINE; 6]].concat(), 2));
        assert_eq!(primitives(&[body(0)], 3).0[0].points, [0, 1, 2, 0, 0, 0]);
    }
}
