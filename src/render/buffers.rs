//! What lies on the GPU of a world: its positions, the bonds, the points as they are drawn.
//!
//! Positions lie as an `f32` world has them, D numbers a point; those of an `f64` world are taken relative to an origin near the camera,
//! where `f32` has its digits. What is drawn lies between two states: it is mixed here, once, for shaders look at a point many times. Bonds
//! and points are uploaded when the topology changes, positions when they moved, and nothing otherwise. Large scenes are drawn in another order than
//! they were made in, so that what is close together lies together.

use glam::DVec3;

use super::camera::Camera;
use super::chunks::{Chunks, LARGE, Selection, Wanted};
use super::counters::RenderCounters;
use super::cover::{bare_first, bars, bearing, covered, pins, scenery};
use super::error::RenderError;
use super::floor;
use super::forms::{in_a_row, is_rope, ropes};
use super::gpu::Gpu;
use super::gpu_bond::{GpuBond, PackedBond, median_rest_length};
use super::growing::GrowingBuffer;
use super::kept::KeptBuffer;
use super::order;
use super::own::{self, Owns};
use super::places::{Staging, mixed, stage, states};
use super::seen_forms::{Forms, Scale, SeenForms};
use super::view::View;
use crate::picture::Tint;
use crate::sim::Positions;

/// Marks the pinned ones among the points as they are drawn: `PINNED` in points.wgsl.
const PINNED: u32 = 1 << 31;

/// Buffers that a pass binds.
pub(super) const BOUND: usize = 5;

/// The buffers of a world, and what of it they hold.
pub(super) struct WorldBuffers {
    pub(super) positions: GrowingBuffer,
    pub(super) bonds: GrowingBuffer,
    pub(super) points: GrowingBuffer,
    pub(super) guides: KeptBuffer<u8>,
    pub(super) solids: KeptBuffer<[f32; 4]>,
    pub(super) floor: KeptBuffer<[f32; 4]>,
    pub(super) frame: KeptBuffer<u8>,
    /// What points are coloured by.
    values: KeptBuffer<f32>,
    /// What bonds have of their bodies' own, a row for each point.
    own: KeptBuffer<[u32; 2]>,
    point_count: u32,
    bond_count: u32,
    /// Those below obstacles, the numbers over them, and the marks over all else.
    pub(super) guide_counts: [u32; 3],
    pub(super) solid_count: u32,
    /// Whether there is a floor, and a shadow on it.
    pub(super) has_floor: [bool; 2],
    /// Bonds and points that no skin and no fill covers, which come first: of small scenes.
    bare: [u32; 2],
    /// Skins and fills cover every bond.
    covers_all: bool,
    /// The widest that bonds are of their own `[m]`.
    pub(super) widest_own: f64,
    /// Pinned points.
    pub(super) pin_count: u32,
    forms: SeenForms,
    /// What positions are relative to `[m]`.
    pub(super) origin: DVec3,
    /// Middle one of the rest lengths `[m]`; 0 without bonds.
    pub(super) typical_bond: f64,
    /// Bonds are drawn as short strokes without forms.
    pub(super) are_short: bool,
    /// The same of bonds that are covered.
    pub(super) covered_bond: f64,
    /// The parts of a large scene.
    chunks: Option<Chunks>,
    /// What the present selection was made for: it stands until something moves or something else is wanted.
    selected: Option<Wanted>,
    pub(super) selection: Selection,
    motion: Option<u64>,
    topology: Option<u64>,
    /// Both states of an `f64` world as they lie on the GPU.
    staging: Staging,
    /// How far between them what was uploaded lies `[1]`, and that, where it is not the second.
    mix: Option<f32>,
    mixed: Vec<f32>,
}

/// How many picture heights the camera may stray from the origin of the positions: at 1000, a pixel of a picture of
/// 1000 is a millionth of the offset, which is what `f32` resolves ten times over.
const STRAY: f64 = 1000.0;

impl WorldBuffers {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let storage = |what| GrowingBuffer::new(gpu, what, wgpu::BufferUsages::STORAGE, 64);
        WorldBuffers {
            positions: storage("positions"),
            bonds: storage("bonds"),
            points: storage("points"),
            guides: KeptBuffer::new(storage("guides")),
            solids: KeptBuffer::new(storage("solids")),
            floor: KeptBuffer::new(storage("floor")),
            values: KeptBuffer::new(storage("values")),
            own: KeptBuffer::new(storage("own")),
            frame: KeptBuffer::new(GrowingBuffer::new(gpu, "frame", wgpu::BufferUsages::UNIFORM, 512)),
            point_count: 0,
            bond_count: 0,
            guide_counts: [0; 3],
            solid_count: 0,
            has_floor: [false; 2],
            bare: [0, 0],
            covers_all: false,
            widest_own: 0.0,
            pin_count: 0,
            forms: SeenForms::default(),
            origin: DVec3::ZERO,
            typical_bond: 0.0,
            are_short: false,
            covered_bond: 0.0,
            chunks: None,
            selected: None,
            selection: Selection::default(),
            motion: None,
            topology: None,
            staging: Staging::default(),
            mix: None,
            mixed: Vec::new(),
        }
    }

    fn all(&mut self) -> [&mut GrowingBuffer; 9] {
        let WorldBuffers { positions, bonds, points, guides, solids, floor, frame, values, own, .. } = self;
        let kept = [&mut guides.buffer, &mut frame.buffer, &mut values.buffer, &mut own.buffer];
        let [guides, frame, values, own] = kept;
        [positions, bonds, points, guides, &mut solids.buffer, &mut floor.buffer, frame, values, own]
    }

    /// Whether a buffer is another one since the last call, so that bindings to it are stale.
    pub(super) fn take_unbound(&mut self) -> bool {
        let mut any = false;
        for buffer in self.all() {
            any |= buffer.take_unbound();
        }
        any
    }

    /// Nothing that was uploaded is of the next world.
    pub(super) fn forget(&mut self) {
        (self.topology, self.motion, self.selected) = (None, None, None);
    }

    /// Bonds and points are drawn otherwise from now on.
    pub(super) fn forget_bonds(&mut self) {
        self.topology = None;
    }

    /// What each pass binds of a world, with a list of its own: [`BOUND`] buffers.
    pub(super) fn bind(
        &self,
        gpu: &Gpu,
        (label, layout): (&str, &wgpu::BindGroupLayout),
        [frame, list]: [&GrowingBuffer; 2],
    ) -> wgpu::BindGroup {
        let all: [_; BOUND] = [frame, &self.positions, list, &self.values.buffer, &self.own.buffer];
        let mut binding = 0..;
        let entries = all.map(|of| wgpu::BindGroupEntry {
            binding: binding.next().unwrap_or_default(),
            resource: of.buffer.as_entire_binding(),
        });
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
    }

    /// Bytes of all of them.
    pub(super) fn bytes(&mut self) -> u64 {
        self.all().into_iter().map(|buffer| buffer.buffer.size()).sum()
    }

    /// Whether the bonds of a large scene are pieces of surfaces.
    pub(super) fn is_surface(&self) -> bool {
        self.chunks.as_ref().is_some_and(Chunks::is_surface)
    }

    /// Bonds that no skin and no fill covers.
    pub(super) fn bare_count(&self) -> u32 {
        if self.chunks.is_some() { self.bond_count } else { self.bare[0] }
    }

    /// Uploads what changed of the world, in which `filled` triangles cover what is below them.
    ///
    /// Errors: a world too large for the GPU; nothing of it is drawn, and the next call uploads all of it.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        (view, filled): (&View<'_>, &[[u32; 3]]),
        camera: &Camera,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        if self.topology != Some(view.topology) {
            (self.topology, self.motion) = (None, None);
            self.upload_topology(gpu, view, filled, counters)?;
        }
        let double = matches!(view.current, Positions::F64(_));
        let origin = if double { self.origin_near(camera) } else { DVec3::ZERO };
        if self.motion != Some(view.motion) || self.origin != origin {
            (self.origin, self.motion, self.selected, self.mix) = (origin, Some(view.motion), None, None);
            self.forms.forget_motion();
            if let Some(chunks) = &mut self.chunks {
                chunks.forget_motion();
            }
            stage(view, self.origin, &mut self.staging);
        }
        if self.mix != Some(view.mix) {
            self.mix = None;
            self.upload_positions(gpu, view, counters)?;
            self.mix = Some(view.mix);
        }
        self.topology = Some(view.topology);
        self.upload_values(gpu, view, counters)
    }

    /// Uploads what points are coloured by, unless it is what they were.
    fn upload_values(&mut self, gpu: &Gpu, view: &View<'_>, counters: &mut RenderCounters) -> Result<(), RenderError> {
        let Some(values) = view.values else { return Ok(()) };
        // What is no number is not told apart by every GPU.
        let values = values.iter().map(|&value| if value.is_nan() { -1.0 } else { value }).collect();
        self.values.set(gpu, values, counters)
    }

    /// The present origin as long as it will do, else the camera's focus.
    fn origin_near(&self, camera: &Camera) -> DVec3 {
        let strayed = (camera.focus() - self.origin).length() > STRAY * camera.height();
        if strayed || self.motion.is_none() { camera.focus() } else { self.origin }
    }

    fn upload_topology(
        &mut self,
        gpu: &Gpu,
        view: &View<'_>,
        filled: &[[u32; 3]],
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        (self.point_count, self.bond_count) = (0, 0);
        (self.selected, self.selection) = (None, Selection::default());
        // What is switched off is not drawn.
        let drawn = view.bonds.iter().filter(|bond| !bond.is_off());
        let mut bonds: Vec<GpuBond> = drawn.map(GpuBond::from).collect();
        let point_count = (view.current.len() / view.dimensions) as u32;
        // Points that were deleted have no place.
        let is_there = |point: &u32| {
            view.current.get(view.dimensions * *point as usize).is_finite() && !Tint::hides(view.tints, *point)
        };
        let mut points: Vec<u32> = (0..point_count).filter(is_there).collect();
        let cover = covered(view, filled);
        let Owns { rows, widest } = own::paint(view, &cover, &mut bonds);
        self.own.set(gpu, rows, counters)?;
        self.widest_own = widest;
        let is_scenery = match bonds.len().max(points.len()) >= LARGE {
            true => {
                self.arrange_large(view, &cover, (&mut bonds, &mut points));
                Vec::new()
            }
            false => self.arrange_small(view, &cover, (&mut bonds, &mut points)),
        };
        self.typical_bond = beside_points(&bonds, self.bare[0] as usize, &is_scenery);
        self.forms = SeenForms::of(&bonds);
        let packed: Vec<PackedBond> = bonds.iter().map(PackedBond::from).collect();
        self.bonds.write(gpu, bytemuck::cast_slice(&packed), counters)?;
        let is_pinned = pins(view.pinned, point_count);
        points.iter_mut().for_each(|point| *point |= if is_pinned[*point as usize] { PINNED } else { 0 });
        self.points.write(gpu, bytemuck::cast_slice(&points), counters)?;
        self.pin_count = is_pinned.iter().filter(|is| **is).count() as u32;
        (self.point_count, self.bond_count) = (points.len() as u32, bonds.len() as u32);
        Ok(())
    }

    /// Puts bonds and points of a large scene in the order of its parts.
    fn arrange_large(&mut self, view: &View<'_>, cover: &[u32], (bonds, points): (&mut Vec<GpuBond>, &mut Vec<u32>)) {
        self.covered_bond = median_rest_length(bonds);
        self.covers_all = points.iter().all(|&point| cover[point as usize] != 0);
        *points = self.sort(view, bonds);
        self.bare = [0, 0];
    }

    /// Puts those that nothing covers first, of a small scene, and gives bonds the forms that come of what is about them. Returns whether
    /// each point is of a drawing, which has no joints to be seen: lines between pins.
    fn arrange_small(
        &mut self,
        view: &View<'_>,
        cover: &[u32],
        (bonds, points): (&mut Vec<GpuBond>, &mut Vec<u32>),
    ) -> Vec<bool> {
        self.chunks = None;
        self.covers_all = false;
        let is_pinned = pins(view.pinned, cover.len() as u32);
        let bears = bearing(bonds, &is_pinned);
        let is_scenery = scenery(bonds, &is_pinned, &bears);
        bars(bonds, &bears);
        points.retain(|point| !is_scenery[*point as usize]);
        let is_in_row = ropes(view.bonds, cover.len()).into_iter().zip(view.bonds);
        let is_in_row = is_in_row.filter(|(_, bond)| !bond.is_off()).map(|(is, _)| is);
        let of_rows = bonds.iter_mut().zip(is_in_row).filter(|(bond, is)| *is && !is_rope(bond.form));
        of_rows.for_each(|(bond, _)| bond.form = in_a_row(bond.form));
        self.bare = bare_first(view, cover, bonds, points);
        self.covered_bond = median_rest_length(&bonds[self.bare[0] as usize..]);
        is_scenery
    }

    /// Sorts the bonds of a large scene along a curve, and returns the points along it, pinned ones last. The curve of
    /// the last scene will do if it has as many points: bonds that broke leave the others where they are.
    fn sort(&mut self, view: &View<'_>, bonds: &mut Vec<GpuBond>) -> Vec<u32> {
        let point_count = view.current.len() / view.dimensions;
        let is_pinned = pins(view.pinned, point_count as u32);
        let last = self.chunks.take().map(|chunks| chunks.order().to_vec());
        let mut points = last
            .filter(|order| order.len() == point_count)
            .unwrap_or_else(|| order::along_curve(view.current, view.dimensions));
        points.sort_by_key(|&point| is_pinned[point as usize]);
        let mut rank = vec![0; point_count];
        for (place, &point) in points.iter().enumerate() {
            rank[point as usize] = place as u32;
        }
        *bonds = order::sorted(bonds, &rank);
        let common = points.partition_point(|&point| !is_pinned[point as usize]) as u32;
        self.chunks = Some(Chunks::new(points.clone(), &rank, common, bonds));
        points
    }

    fn upload_positions(
        &mut self,
        gpu: &Gpu,
        view: &View<'_>,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        let states = states(view, &self.staging);
        let positions = mixed(states, view.mix, &mut self.mixed);
        self.positions.write(gpu, bytemuck::cast_slice(positions), counters)
    }

    /// The present positions as they lie on the GPU.
    pub(super) fn current_places<'a>(&'a self, view: &View<'a>) -> &'a [f32] {
        states(view, &self.staging)[1]
    }

    /// What of the forms of bonds is seen in a picture.
    pub(super) fn seen_forms(&mut self, view: &View<'_>, scale: Scale) -> Forms {
        let states = states(view, &self.staging);
        self.forms.seen(states, view.dimensions, scale)
    }

    /// Finds out what a picture takes of bonds and points, unless that is what the last one took.
    pub(super) fn select(&mut self, view: &View<'_>, wanted: &Wanted, counters: &mut RenderCounters) {
        if self.selected.as_ref() == Some(wanted) {
            return;
        }
        self.selection = match &mut self.chunks {
            Some(chunks) if !wanted.has_mesh && self.covers_all => Selection::whole(0, chunks.pins()),
            Some(chunks) => chunks.select(states(view, &self.staging), view.dimensions, wanted, counters),
            None if !wanted.has_mesh => Selection::whole(self.bare[0], 0..self.bare[1]),
            None if wanted.points_faded && self.pin_count == 0 => Selection::whole(self.bond_count, 0..0),
            None => Selection::whole(self.bond_count, 0..self.point_count),
        };
        self.selected = Some(*wanted);
    }

    /// Uploads the uniforms of a picture, unless they are those of the last one.
    pub(super) fn set_frame(
        &mut self,
        gpu: &Gpu,
        bytes: &[u8],
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        self.frame.set(gpu, bytes.to_vec(), counters)
    }

    /// Uploads guides, so many below obstacles, over them and over all else, unless they are those of the last picture.
    pub(super) fn set_guides(
        &mut self,
        gpu: &Gpu,
        bytes: &[u8],
        counts: [usize; 3],
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        self.guide_counts = counts.map(|count| count as u32);
        self.guides.set(gpu, bytes.to_vec(), counters)
    }

    /// Uploads the floor with its shadow, unless it is that of the last picture.
    pub(super) fn set_floor(
        &mut self,
        gpu: &Gpu,
        rows: Vec<[f32; 4]>,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        self.has_floor = [!rows.is_empty(), floor::has_shadow(&rows)];
        self.floor.set(gpu, rows, counters)
    }

    /// Uploads balls and boxes, unless they are those of the last picture: four rows, then four a solid.
    pub(super) fn set_solids(
        &mut self,
        gpu: &Gpu,
        rows: Vec<[f32; 4]>,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        self.solids.set(gpu, rows, counters)?;
        self.solid_count = (self.solids.len() / 4).saturating_sub(1) as u32;
        Ok(())
    }
}

/// Middle one of the rest lengths beside points, by which these are sized `[m]`; 0 without bonds. Bonds that are covered, all but the first
/// `bare` where some are not, say nothing of others, and neither does a drawing.
fn beside_points(bonds: &[GpuBond], bare: usize, is_scenery: &[bool]) -> f64 {
    let beside = if bare > 0 { &bonds[..bare] } else { bonds };
    if !is_scenery.contains(&true) {
        return median_rest_length(beside);
    }
    let apart: Vec<GpuBond> = beside.iter().copied().filter(|bond| !is_scenery[bond.a as usize]).collect();
    median_rest_length(&apart)
}
