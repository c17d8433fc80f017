//! What lies on the GPU of a world: two states of the positions, the bonds, the points as they are drawn.
//!
//! Positions lie as an `f32` world has them, D numbers a point, and are uploaded without a copy; those of an `f64`
//! world are taken relative to an origin near the camera, where `f32` has its digits. Bonds and points are uploaded when
//! the topology changes, positions when they moved, and nothing otherwise. Large scenes are drawn in another order than
//! they were made in, so that what is close together lies together.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use super::camera::Camera;
use super::chunks::{Chunks, LARGE, Selection, Wanted};
use super::counters::RenderCounters;
use super::error::RenderError;
use super::forms::{BAR, MUSCLE, ROD, ROPE, form, is_rope, ropes};
use super::gpu::Gpu;
use super::growing::GrowingBuffer;
use super::order;
use super::view::View;
use crate::picture::Tint;
use crate::sim::{Bond, PointId, Positions};

/// A bond as it is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct GpuBond {
    pub(super) a: u32,
    pub(super) b: u32,
    pub(super) rest_length: f32,
    /// What it is drawn as: forms.rs.
    pub(super) form: u32,
    /// The colour and the width that its body has of its own, one above their place among [`WorldBuffers::colors`]; 0: neither.
    pub(super) color: u32,
}

/// A bond as the shader reads it: `Packed` in bonds.wgsl. Its form lies in the upper bits of `b`, its colour in those of `a`: the positions
/// of as many points as the others can count are more than a GPU's buffers hold.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
struct PackedBond {
    a: u32,
    b: u32,
    rest_length: f32,
}

const _: () = assert!(size_of::<PackedBond>() == 12);

/// Where form and colour begin in a packed bond: `FORM` in bonds.wgsl.
const FORM: u32 = 29;

impl From<&GpuBond> for PackedBond {
    fn from(&GpuBond { a, b, rest_length, form, color }: &GpuBond) -> Self {
        let (form, rest_length) = if form == BAR { (ROD, -1.0) } else { (form, rest_length) };
        let [a, b] = [(a, color), (b, form)].map(|(end, upper)| end & ((1 << FORM) - 1) | upper << FORM);
        PackedBond { a, b, rest_length }
    }
}

impl GpuBond {
    /// A plain stroke.
    #[cfg(test)]
    pub(super) fn new(a: u32, b: u32, rest_length: f32) -> Self {
        GpuBond { a, b, rest_length, form: 0, color: 0 }
    }
}

impl From<Bond> for GpuBond {
    fn from(bond: Bond) -> Self {
        GpuBond { a: bond.a.0, b: bond.b.0, rest_length: bond.rest_length as f32, form: form(&bond), color: 0 }
    }
}

/// So many colours and widths bonds have at most: as three bits count. Further ones are drawn as bonds are.
pub(super) const COLORS: usize = 7;

/// What bonds have of their body's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Own {
    color: Option<[u8; 3]>,
    /// `[m]`; 0: as is usual.
    width: f64,
}

impl Own {
    const NONE: Own = Own { color: None, width: 0.0 };

    /// As the shader reads it: the colour, below 0 where it is that of all bonds, and the width.
    pub(super) fn row(self) -> [f32; 4] {
        let [red, green, blue] = self.color.map_or([-1.0; 3], |color| color.map(|part| f32::from(part) / 255.0));
        [red, green, blue, self.width as f32]
    }
}

/// Marks the pinned ones among the points as they are drawn: `PINNED` in points.wgsl.
const PINNED: u32 = 1 << 31;

/// The buffers of a world, and what of it they hold.
pub(super) struct WorldBuffers {
    pub(super) previous: GrowingBuffer,
    pub(super) current: GrowingBuffer,
    pub(super) bonds: GrowingBuffer,
    pub(super) points: GrowingBuffer,
    pub(super) guides: GrowingBuffer,
    pub(super) solids: GrowingBuffer,
    pub(super) floor: GrowingBuffer,
    pub(super) frame: GrowingBuffer,
    /// What points are coloured by.
    pub(super) values: GrowingBuffer,
    point_count: u32,
    bond_count: u32,
    /// Those below obstacles, the numbers over them, and the marks over all else.
    pub(super) guide_counts: [u32; 3],
    pub(super) solid_count: u32,
    pub(super) has_floor: bool,
    /// Bonds and points that no skin and no fill covers, which come first: of small scenes.
    bare: [u32; 2],
    /// Skins and fills cover every bond.
    covers_all: bool,
    /// Colours that bonds have of their bodies' own, each with how wide they are drawn.
    pub(super) colors: [Own; COLORS],
    /// Pinned points.
    pub(super) pin_count: u32,
    /// What positions are relative to `[m]`.
    pub(super) origin: DVec3,
    /// Middle one of the rest lengths `[m]`; 0 without bonds.
    pub(super) typical_bond: f64,
    /// The same of bonds that are covered.
    pub(super) covered_bond: f64,
    /// The parts of a large scene.
    chunks: Option<Chunks>,
    /// What the present selection was made for: it stands until something moves or something else is wanted.
    selected: Option<Wanted>,
    pub(super) selection: Selection,
    motion: Option<u64>,
    topology: Option<u64>,
    last_frame: Vec<u8>,
    last_values: Vec<f32>,
    last_guides: Vec<u8>,
    last_solids: Vec<[f32; 4]>,
    last_floor: Vec<[f32; 4]>,
    /// Positions of an `f64` world as they were uploaded.
    staging: [Vec<f32>; 2],
}

/// How many picture heights the camera may stray from the origin of the positions: at 1000, a pixel of a picture of
/// 1000 is a millionth of the offset, which is what `f32` resolves ten times over.
const STRAY: f64 = 1000.0;

impl WorldBuffers {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let storage = |what| GrowingBuffer::new(gpu, what, wgpu::BufferUsages::STORAGE, 64);
        WorldBuffers {
            previous: storage("positions"),
            current: storage("positions"),
            bonds: storage("bonds"),
            points: storage("points"),
            guides: storage("guides"),
            solids: storage("solids"),
            floor: storage("floor"),
            values: storage("values"),
            frame: GrowingBuffer::new(gpu, "frame", wgpu::BufferUsages::UNIFORM, 512),
            point_count: 0,
            bond_count: 0,
            guide_counts: [0; 3],
            solid_count: 0,
            has_floor: false,
            bare: [0, 0],
            covers_all: false,
            colors: [Own::NONE; COLORS],
            pin_count: 0,
            origin: DVec3::ZERO,
            typical_bond: 0.0,
            covered_bond: 0.0,
            chunks: None,
            selected: None,
            selection: Selection::default(),
            motion: None,
            topology: None,
            last_frame: Vec::new(),
            last_values: Vec::new(),
            last_guides: Vec::new(),
            last_solids: Vec::new(),
            last_floor: Vec::new(),
            staging: Default::default(),
        }
    }

    fn all(&mut self) -> [&mut GrowingBuffer; 9] {
        let WorldBuffers { previous, current, bonds, points, guides, solids, floor, frame, values, .. } = self;
        [previous, current, bonds, points, guides, solids, floor, frame, values]
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

    /// What each pass binds of a world, with a list of its own.
    pub(super) fn bound<'a>(&'a self, frame: &'a GrowingBuffer, list: &'a GrowingBuffer) -> [&'a GrowingBuffer; 5] {
        [frame, &self.previous, &self.current, list, &self.values]
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
            (self.origin, self.motion, self.selected) = (origin, None, None);
            if let Some(chunks) = &mut self.chunks {
                chunks.forget_motion();
            }
            self.upload_positions(gpu, view, counters)?;
            self.motion = Some(view.motion);
        }
        self.topology = Some(view.topology);
        self.upload_values(gpu, view, counters)
    }

    /// Uploads what points are coloured by, unless it is what they were.
    fn upload_values(&mut self, gpu: &Gpu, view: &View<'_>, counters: &mut RenderCounters) -> Result<(), RenderError> {
        let Some(values) = view.values else { return Ok(()) };
        // What is no number is not told apart by every GPU.
        let values: Vec<f32> = values.iter().map(|&value| if value.is_nan() { -1.0 } else { value }).collect();
        if self.last_values != values {
            self.values.write(gpu, bytemuck::cast_slice(&values), counters)?;
            self.last_values = values;
        }
        Ok(())
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
        let mut bonds: Vec<GpuBond> = view.bonds.iter().map(GpuBond::from).collect();
        let point_count = (view.current.len() / view.dimensions) as u32;
        // Points that were deleted have no place.
        let is_there = |point: &u32| {
            view.current.get(view.dimensions * *point as usize).is_finite() && !Tint::hides(view.tints, *point)
        };
        let mut points: Vec<u32> = (0..point_count).filter(is_there).collect();
        let cover = covered(view, filled);
        self.colors = paint(view, &cover, &mut bonds);
        if bonds.len().max(points.len()) >= LARGE {
            self.covered_bond = median_rest_length(&bonds);
            self.covers_all = points.iter().all(|&point| cover[point as usize] != 0);
            points = self.sort(view, &mut bonds);
            self.bare = [0, 0];
        } else {
            self.chunks = None;
            self.covers_all = false;
            // Lines between pins are a drawing, which has no joints to be seen.
            let is_pinned = pins(view.pinned, point_count);
            let is_scenery = scenery(&bonds, &is_pinned);
            bars(&mut bonds, &is_pinned);
            points.retain(|point| !is_scenery[*point as usize]);
            let is_in_row = ropes(view.bonds, cover.len());
            let in_a_row = bonds.iter_mut().zip(is_in_row).filter(|(bond, is)| *is && !is_rope(bond.form));
            in_a_row.for_each(|(bond, _)| bond.form = ROPE);
            self.bare = bare_first(view, &cover, &mut bonds, &mut points);
            self.covered_bond = median_rest_length(&bonds[self.bare[0] as usize..]);
        }
        // Points are sized by the bonds beside them: those that are covered say nothing of others.
        let bare = self.bare[0] as usize;
        self.typical_bond = median_rest_length(if bare > 0 { &bonds[..bare] } else { &bonds[..] });
        let packed: Vec<PackedBond> = bonds.iter().map(PackedBond::from).collect();
        self.bonds.write(gpu, bytemuck::cast_slice(&packed), counters)?;
        let is_pinned = pins(view.pinned, point_count);
        points.iter_mut().for_each(|point| *point |= if is_pinned[*point as usize] { PINNED } else { 0 });
        self.points.write(gpu, bytemuck::cast_slice(&points), counters)?;
        self.pin_count = is_pinned.iter().filter(|is| **is).count() as u32;
        (self.point_count, self.bond_count) = (points.len() as u32, bonds.len() as u32);
        Ok(())
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
        for (positions, staging) in [view.previous, view.current].into_iter().zip(&mut self.staging) {
            if let Positions::F64(x) = positions {
                relative(x, self.origin, view.dimensions, staging);
            }
        }
        let [previous, current] = states(view, &self.staging);
        self.previous.write(gpu, bytemuck::cast_slice(previous), counters)?;
        self.current.write(gpu, bytemuck::cast_slice(current), counters)
    }

    /// The present positions as they lie on the GPU.
    pub(super) fn current_places<'a>(&'a self, view: &View<'a>) -> &'a [f32] {
        states(view, &self.staging)[1]
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
        if self.last_frame != bytes {
            self.frame.write(gpu, bytes, counters)?;
            self.last_frame = bytes.to_vec();
        }
        Ok(())
    }

    /// Uploads guides, so many below obstacles, over them and over all else, unless they are those of the last picture.
    pub(super) fn set_guides(
        &mut self,
        gpu: &Gpu,
        bytes: &[u8],
        counts: [usize; 3],
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        if self.last_guides != bytes {
            self.guides.write(gpu, bytes, counters)?;
            self.last_guides = bytes.to_vec();
        }
        self.guide_counts = counts.map(|count| count as u32);
        Ok(())
    }

    /// Uploads the floor with its shadow, unless it is that of the last picture.
    pub(super) fn set_floor(
        &mut self,
        gpu: &Gpu,
        rows: Vec<[f32; 4]>,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        if self.last_floor != rows {
            self.floor.write(gpu, bytemuck::cast_slice(&rows), counters)?;
            self.last_floor = rows;
        }
        self.has_floor = !self.last_floor.is_empty();
        Ok(())
    }

    /// Uploads balls and boxes, unless they are those of the last picture: four rows, then four a solid.
    pub(super) fn set_solids(
        &mut self,
        gpu: &Gpu,
        rows: Vec<[f32; 4]>,
        counters: &mut RenderCounters,
    ) -> Result<(), RenderError> {
        if self.last_solids != rows {
            self.solids.write(gpu, bytemuck::cast_slice(&rows), counters)?;
            self.last_solids = rows;
        }
        self.solid_count = (self.last_solids.len() / 4).saturating_sub(1) as u32;
        Ok(())
    }
}

/// The two states as they lie on the GPU.
fn states<'a>(view: &View<'a>, staging: &'a [Vec<f32>; 2]) -> [&'a [f32]; 2] {
    let flat = |positions: Positions<'a>, staging: &'a [f32]| match positions {
        Positions::F32(x) => x,
        Positions::F64(_) => staging,
    };
    [flat(view.previous, &staging[0]), flat(view.current, &staging[1])]
}

/// Positions relative to an origin.
fn relative(x: &[f64], origin: DVec3, dimensions: usize, to: &mut Vec<f32>) {
    to.resize(x.len(), 0.0);
    let [a, b, c] = origin.to_array();
    if dimensions == 2 {
        subtract([a, b], x, to);
    } else {
        subtract([a, b, c], x, to);
    }
}

fn subtract<const D: usize>(origin: [f64; D], x: &[f64], to: &mut [f32]) {
    for (to, x) in to.as_chunks_mut::<D>().0.iter_mut().zip(x.as_chunks::<D>().0) {
        *to = std::array::from_fn(|axis| (x[axis] - origin[axis]) as f32);
    }
}

/// What each point lies under: 0 nothing, else the number of what one skin or triangles side by side cover.
fn covered(view: &View<'_>, filled: &[[u32; 3]]) -> Vec<u32> {
    let count = view.current.len() / view.dimensions;
    let mut cover = vec![0; count];
    let sides = filled.iter().flat_map(|&[a, b, c]| [[a, b], [b, c]]);
    let pieces = Tint::hanging(if filled.is_empty() { 0 } else { count }, sides);
    filled.iter().flatten().for_each(|&corner| cover[corner as usize] = 1 + pieces[corner as usize]);
    for (number, skin) in (0..).zip(view.skins) {
        let range = skin.first as usize..(skin.first as usize + skin.texture.len()).min(count);
        let points = cover.get_mut(range).into_iter().flatten();
        points.filter(|cover| **cover == 0).for_each(|cover| *cover = u32::MAX - number);
    }
    cover
}

/// Gives bonds the widths that their bodies have of their own, and those that nothing covers the colours, the first [`COLORS`] of them.
/// Returns these.
fn paint(view: &View<'_>, cover: &[u32], bonds: &mut [GpuBond]) -> [Own; COLORS] {
    let mut colors = [Own::NONE; COLORS];
    if view.tints.iter().all(|tint| tint.color.is_none() && tint.width == 0.0) {
        return colors;
    }
    let mut known: Vec<Own> = Vec::new();
    for bond in bonds {
        let Some(tint) = Tint::of(view.tints, bond.a) else { continue };
        let is_bare = cover[bond.a as usize] == 0 && cover[bond.b as usize] == 0;
        let own = Own { color: tint.color.filter(|_| is_bare), width: tint.width };
        if own == Own::NONE {
            continue;
        }
        let place = known.iter().position(|other| *other == own).or_else(|| {
            known.push(own);
            (known.len() <= COLORS).then(|| known.len() - 1)
        });
        bond.color = place.map_or(0, |place| place as u32 + 1);
        known.truncate(COLORS);
    }
    colors.iter_mut().zip(known).for_each(|(to, own)| *to = own);
    colors
}

/// Puts bonds and points that are not covered first, and returns how many there are of each. Pins are seen on skins too, and points
/// within a rope are not.
fn bare_first(view: &View<'_>, cover: &[u32], bonds: &mut [GpuBond], points: &mut [u32]) -> [u32; 2] {
    // Between two pieces a bond is seen, and a muscle is everywhere, and a bar.
    let is_hidden = |bond: &GpuBond| {
        !matches!(bond.form, MUSCLE | BAR)
            && cover[bond.a as usize] != 0
            && cover[bond.a as usize] == cover[bond.b as usize]
    };
    bonds.sort_by_key(is_hidden);
    // How many bonds of a rope and others end in a point.
    let mut ends = vec![[0_u32; 2]; cover.len()];
    for bond in &*bonds {
        let of = usize::from(!is_rope(bond.form));
        [bond.a, bond.b].into_iter().for_each(|end| ends[end as usize][of] += 1);
    }
    let is_pinned = pins(view.pinned, cover.len() as u32);
    let is_under = |point: &u32| {
        let at = *point as usize;
        (cover[at] != 0 || ends[at] == [2, 0]) && !is_pinned[at]
    };
    points.sort_by_key(is_under);
    let count = |shown: usize| shown as u32;
    [count(bonds.partition_point(|bond| !is_hidden(bond))), count(points.partition_point(|point| !is_under(point)))]
}

/// Bonds between pins on which something hangs are one bar, whatever they are made of.
fn bars(bonds: &mut [GpuBond], is_pinned: &[bool]) {
    let mut holds = vec![false; is_pinned.len()];
    for bond in &*bonds {
        for [end, other] in [[bond.a, bond.b], [bond.b, bond.a]] {
            holds[end as usize] |= !is_pinned[other as usize];
        }
    }
    let is_of = |end: u32| is_pinned[end as usize] && holds[end as usize];
    for bond in bonds.iter_mut().filter(|bond| is_of(bond.a) && is_of(bond.b)) {
        bond.form = BAR;
    }
}

/// Pins that have bonds, all of them to pins.
fn scenery(bonds: &[GpuBond], is_pinned: &[bool]) -> Vec<bool> {
    let mut ends = vec![[false; 2]; is_pinned.len()];
    for bond in bonds {
        let holds_pins = is_pinned[bond.a as usize] && is_pinned[bond.b as usize];
        [bond.a, bond.b].iter().for_each(|&end| ends[end as usize][usize::from(holds_pins)] = true);
    }
    ends.iter().zip(is_pinned).map(|(ends, is_pinned)| *is_pinned && *ends == [false, true]).collect()
}

/// Which points are pinned. Pins of points that there are not are left out.
fn pins(pinned: &[PointId], point_count: u32) -> Vec<bool> {
    let mut is_pinned = vec![false; point_count as usize];
    for pin in pinned {
        if let Some(point) = is_pinned.get_mut(pin.index()) {
            *point = true;
        }
    }
    is_pinned
}

fn median_rest_length(bonds: &[GpuBond]) -> f64 {
    // A sample is enough to size points by.
    let step = (bonds.len() / 1000).max(1);
    let mut lengths: Vec<f32> = bonds.iter().step_by(step).map(|bond| bond.rest_length).collect();
    lengths.sort_by(f32::total_cmp);
    lengths.get(lengths.len() / 2).copied().map_or(0.0, f64::from)
}

#[cfg(test)]
pub(in crate::render) mod tests {
    use super::*;
    use crate::picture::{Picture, Skin};
    use crate::sim::Bonds;
    use std::sync::Arc;

    #[test]
    fn pins_of_points_that_there_are_not_are_left_out() {
        assert_eq!(pins(&[PointId(0), PointId(2)], 3), [true, false, true]);
        assert_eq!(pins(&[PointId(3), PointId(u32::MAX), PointId(1)], 3), [false, true, false]);
        assert!(pins(&[PointId(0)], 0).is_empty());
    }

    /// A world of nothing.
    pub(in crate::render) fn empty(bonds: &Bonds, dimensions: usize) -> View<'_> {
        View {
            dimensions,
            previous: Positions::F64(&[]),
            current: Positions::F64(&[]),
            mix: 1.0,
            motion: 0,
            topology: 0,
            bonds,
            skins: &[],
            triangles: &[],
            tints: &[],
            values: None,
            trails: None,
            pinned: &[],
            bounds: None,
            planes: Vec::new(),
            polygons: &[],
            convex: &[],
            mouse: None,
            hinges: Vec::new(),
            joints: Vec::new(),
            covered: &[],
        }
    }

    #[test]
    fn muscles_are_seen_on_what_covers_other_bonds() {
        let mut bonds = [GpuBond::new(0, 1, 1.0), GpuBond { form: MUSCLE, ..GpuBond::new(1, 2, 1.0) }];
        let nothing = Bonds::default();
        let [shown, _] = bare_first(&empty(&nothing, 2), &[1; 3], &mut bonds, &mut [0, 1, 2]);
        assert_eq!((shown, bonds[0].form), (1, MUSCLE));
    }

    #[test]
    fn pins_are_seen_on_skins_and_other_points_are_not() {
        let skin = Skin {
            picture: Arc::new(Picture::filled(2, 2, [255; 4])),
            first: 0,
            triangles: vec![[0, 1, 2]],
            texture: vec![[0.0; 2]; 3],
        };
        let bonds = Bonds::default();
        let places = [0.0; 10];
        let view = View {
            previous: Positions::F64(&places),
            current: Positions::F64(&places),
            skins: &[skin],
            pinned: &[PointId(1), PointId(4)],
            ..empty(&bonds, 2)
        };
        let mut points: Vec<u32> = (0..5).collect();
        let cover = covered(&view, &[]);
        assert_eq!(bare_first(&view, &cover, &mut [], &mut points), [0, 3]);
        assert_eq!(points, [1, 3, 4, 0, 2]);
        let cover = covered(&view, &[[1, 2, 3]]);
        assert_eq!(bare_first(&view, &cover, &mut [], &mut points), [0, 2], "the last is a pin, the first too");
    }

    #[test]
    fn a_bond_between_two_pieces_is_seen_and_one_within_a_piece_is_not() {
        let cover = [1, 1, 1, 5, 5, 0];
        let mut bonds = [[0, 1], [1, 3], [3, 4], [4, 5]].map(|[a, b]| GpuBond::new(a, b, 1.0));
        let world = Bonds::default();
        let places = [0.0; 12];
        let view = View { previous: Positions::F64(&places), current: Positions::F64(&places), ..empty(&world, 2) };
        let mut points: Vec<u32> = (0..6).collect();
        assert_eq!(bare_first(&view, &cover, &mut bonds, &mut points), [2, 1]);
        assert_eq!(bonds.map(|bond| [bond.a, bond.b]), [[1, 3], [4, 5], [0, 1], [3, 4]]);
    }

    #[test]
    fn bare_bonds_have_the_colours_of_their_bodies_and_covered_ones_have_not() {
        let bonds: Bonds =
            [[0, 1], [1, 2], [3, 4], [5, 6]].map(|[a, b]| Bond::new(PointId(a), PointId(b), 1.0)).into_iter().collect();
        let tint = |first, color| Tint { color, ..Tint::new(first, first) };
        let tints = [tint(0, Some([255, 0, 0])), tint(3, None), tint(5, Some([0, 255, 0]))];
        let view = View { tints: &tints, ..empty(&bonds, 2) };
        let mut list: Vec<GpuBond> = bonds.iter().map(GpuBond::from).collect();
        let colors = paint(&view, &[0, 0, 0, 0, 0, 7, 7], &mut list);
        assert_eq!(list.iter().map(|bond| bond.color).collect::<Vec<_>>(), [1, 1, 0, 0]);
        assert_eq!(colors[0].row(), [1.0, 0.0, 0.0, 0.0]);
        let packed = PackedBond::from(&list[1]);
        assert_eq!([packed.a >> FORM, packed.a & ((1 << FORM) - 1), packed.b >> FORM], [1, 1, list[1].form]);
        // More colours than there is room for.
        let bonds: Bonds = (0..9).map(|k| Bond::new(PointId(2 * k), PointId(2 * k + 1), 1.0)).collect();
        let tints: Vec<Tint> = (0..9).map(|k| tint(2 * k, Some([k as u8, 9, 9]))).collect();
        let mut list: Vec<GpuBond> = bonds.iter().map(GpuBond::from).collect();
        paint(&View { tints: &tints, ..empty(&bonds, 2) }, &[0; 18], &mut list);
        assert_eq!(list.iter().map(|bond| bond.color).collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6, 7, 0, 0]);
    }

    #[test]
    fn positions_are_relative_to_the_origin() {
        let mut to = vec![9.0; 7];
        relative(&[1.0, 2.0, 3.0, 1e9, 5.0, 6.0], DVec3::new(1.0, 1.0, 3.0), 3, &mut to);
        assert_eq!(to, [0.0, 1.0, 0.0, 999_999_999.0_f64 as f32, 4.0, 3.0]);
        relative(&[1.0, 2.0, 3.0, 4.0], DVec3::new(1.0, 1.0, 7.0), 2, &mut to);
        assert_eq!(to, [0.0, 1.0, 2.0, 3.0]);
    }
}
