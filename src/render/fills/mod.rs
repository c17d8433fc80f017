//! Bodies without a picture: what they cover, filled in a colour of their own, with an outline and in the plane a soft shadow about
//! it, body by body, so that overlaps read. What nets enclose in the plane, the cells between their bonds, is filled below all of that, and
//! seen through.
//!
//! Bodies with a picture are filled only where strain is shown in place of it.
//!
//! A list of primitives of nine kinds, drawn in order by one pass, is uploaded when the topology changes. Points have a row to shade
//! by, uploaded when they moved, where that is shown: a normal in space, a strain where strain is.

mod bodies;
mod cells;
mod limbs;
mod outline;
mod pieces;
mod round;
mod rows;
mod shade;

use bytemuck::{Pod, Zeroable};

use super::buffers::WorldBuffers;
use super::counters::RenderCounters;
use super::error::RenderError;
use super::gpu::Gpu;
use super::gpu_bond::GpuBond;
use super::growing::GrowingBuffer;
use super::quads::{QUAD, Quads};
use super::view::View;
use crate::sim::bond::lower_first;
use crate::sim::{Bond, PointId};
use bodies::{Filled, SKIN_COLOR, bodies};
pub use bodies::{body_color, color_of};
use limbs::{Cone, Part, Role, figure};
use outline::{Side, outline};
use round::may_be_round;
pub(super) use rows::Kinds;
use rows::{Row, rows};
use shade::{Shade, shades};

/// A primitive as the shader reads it: `Primitive` in fill.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
struct Primitive {
    /// Of a fill the corners of two triangles, of a side its ends with those before and after, then whether it may be an arc, 0 or 1, and
    /// nothing; of a bond the second and the third are its ends. Of a thread that tore the end that it hangs from, the other one, and the bits of
    /// its length at rest `[m]`. Of a limb two points for each end, then the bits of its larger radius
    /// `[m]` and what [`packed`] makes.
    points: [u32; 6],
    /// The kind in the upper eight bits, with [`PAINTED`] or without, then red, green, blue.
    ink: u32,
}

const _: () = assert!(size_of::<Primitive>() == 28);

/// Kinds of primitives: `FILL`, `OUTLINE`, `SHADOW`, `INNER`, `FLESH`, `SKIN`, `UNDER`, `CELL`, `THREAD` in fill.wgsl. Flesh and skin are limbs and their
/// rims, under them is what they stand for, which is seen where bonds are shown through fills, and cells are those of nets.
const FILL: u32 = 0;
const OUTLINE: u32 = 1;
const SHADOW: u32 = 2;
const INNER: u32 = 3;
const FLESH: u32 = 4;
const SKIN: u32 = 5;
const UNDER: u32 = 6;
const CELL: u32 = 7;
/// What is left of a thread that tore.
const THREAD: u32 = 8;
/// With a corner of a cell: the cell fades towards it, `FRAYED` in fill.wgsl.
const FRAYED: u32 = 1 << 31;
/// With a kind: points may have colours of their own there, `PAINTED` in fill.wgsl.
const PAINTED: u32 = 0x80;

/// Triangles from which on bodies are not filled: their bonds, which are drawn as few as it takes, cover the same.
const MOST: usize = 1 << 18;
/// Sides of outlines from which on there are no shadows: so many bodies are small.
const MOST_SHADOWS: usize = 6_000;

/// Bonds from which on those within bodies are not drawn on them, and nets have no cells: they are too short to be told apart.
const MOST_INNER: usize = 20_000;

/// The fills of a world on the GPU.
pub(super) struct Fills {
    layout: wgpu::BindGroupLayout,
    primitives: GrowingBuffer,
    shades: GrowingBuffer,
    /// Of bodies without a picture, cells of nets before them, then of those with one: the rows of primitives that they are drawn in.
    parts: [Vec<Row>; 2],
    /// What is filled of each of both, but for cells.
    triangles: [Vec<[u32; 3]>; 2],
    /// In space those that enclose a volume, whose edges are seen as such.
    enclosing: Vec<[u32; 3]>,
    /// Triangles that cells are filled with.
    cell_triangles: usize,
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
            enclosing: Vec::new(),
            cell_triangles: 0,
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
        let ([bare, worn, nets], open) = if view.triangles.len() > MOST { Default::default() } else { bodies(view) };
        let mut list = nets_of(&runs(&nets), &open);
        self.cell_triangles = nets.iter().map(|net| net.triangles.len()).sum();
        self.enclosing.clear();
        let mut counts = [0; 2];
        for (place, bodies) in [bare, worn].iter().enumerate() {
            self.triangles[place] = bodies.iter().flat_map(|body| body.triangles.iter().copied()).collect();
            let lines = Lines { inner: inner(view, bodies), limbs: limbs(view, bodies) };
            list.extend(primitives(bodies, &lines, view.dimensions));
            let solid = runs(bodies).into_iter().filter(|run| view.dimensions == 3 && encloses(&run.triangles));
            self.enclosing.extend(solid.flat_map(|run| run.triangles));
            counts[place] = list.len();
        }
        let of_bare = counts[0] as u32;
        let behind = |row: Row| Row { range: of_bare + row.range.start..of_bare + row.range.end, ..row };
        let [bare, worn] = [&list[..counts[0]], &list[counts[0]..]].map(|part| rows(part, view.dimensions));
        self.parts = [bare, worn.into_iter().map(behind).collect()];
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
        let is_any = self.cell_triangles > 0 || self.triangles.iter().any(|triangles| !triangles.is_empty());
        if !is_any || !(shows_strain || view.dimensions == 3) || self.shaded == wanted {
            return Ok(());
        }
        self.shaded = None;
        let bonds: Vec<GpuBond> =
            if shows_strain { view.bonds.iter().map(GpuBond::from).collect() } else { Vec::new() };
        let [bare, worn] = self.triangles.each_ref().map(Vec::as_slice);
        let triangles = [bare, worn, self.enclosing.as_slice()];
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
        let world = buffers.bind(gpu, ("fill", layout), [&buffers.frame.buffer, &self.primitives]);
        self.bindings = Some([world, bind(gpu, &self.layout, &[&self.shades])]);
    }

    /// Draws all fills, with their outlines and shadows; of bodies with a picture too where a map is shown in place of it.
    pub(super) fn draw(
        &self,
        shows_map: bool,
        target: &mut wgpu::RenderPass<'_>,
        (pipelines, quads): (&[wgpu::RenderPipeline; Kinds::ALL.len()], &Quads),
        counters: &mut RenderCounters,
    ) {
        let Some([world, shades]) = &self.bindings else { return };
        for (parts, triangles) in self.parts.iter().zip(&self.triangles).take(1 + usize::from(shows_map)) {
            for Row { kinds, are_quads, range } in parts {
                target.set_pipeline(&pipelines[*kinds as usize]);
                target.set_bind_group(0, world, &[]);
                target.set_bind_group(1, shades, &[]);
                let vertices = QUAD * range.start..QUAD * range.end;
                match are_quads {
                    true => quads.draw(target, vertices, 0..1),
                    false => target.draw(vertices, 0..1),
                }
                counters.draws += 1;
            }
            counters.triangles_drawn += triangles.len() as u64;
        }
        counters.triangles_drawn += self.cell_triangles as u64;
    }
}

fn bind(gpu: &Gpu, layout: &wgpu::BindGroupLayout, buffers: &[&GrowingBuffer]) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(buffers)
        .map(|(binding, of)| wgpu::BindGroupEntry { binding, resource: of.buffer.as_entire_binding() })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("fills"), layout, entries: &entries })
}

/// What is drawn on bodies beside their triangles, by their places.
#[derive(Default)]
struct Lines {
    /// Bonds within them, which are seen where a map is shown.
    inner: Vec<Vec<[u32; 2]>>,
    /// Those that are figures of limbs.
    limbs: Vec<Limbs>,
}

/// Whether a body is a figure of limbs.
#[derive(Clone, Debug, Default, PartialEq)]
enum Limbs {
    /// It is none.
    #[default]
    None,
    /// Its parts from behind to the front, each in its colour.
    Figure(Vec<(Part, [u8; 3])>),
    /// It is a part of the one before it, in another colour.
    Within,
}

/// Which bodies are figures of limbs, that is have joints; in the plane.
fn limbs(view: &View<'_>, bodies: &[Filled]) -> Vec<Limbs> {
    if view.dimensions != 2 || view.joints.is_empty() {
        return Vec::new();
    }
    let at = |point: u32| [0, 1].map(|axis| view.current.get(2 * point as usize + axis));
    let has_joint = |body: &Filled| {
        body.triangles.iter().flatten().any(|&corner| view.joints.binary_search(&PointId(corner)).is_ok())
    };
    let mut list = Vec::with_capacity(bodies.len());
    // What is painted in several colours is one figure still.
    for run in bodies.chunk_by(|a, b| a.body == b.body) {
        let triangles: Vec<[u32; 3]> = run.iter().flat_map(|body| body.triangles.iter().copied()).collect();
        let parts = if run.iter().any(has_joint) { figure(&triangles, &at) } else { None };
        list.push(parts.map_or(Limbs::None, |parts| {
            let of = |part: Part| {
                let own = run.iter().find(|body| body.triangles.contains(&part.of));
                let color = own.map_or([128; 3], |body| color_of_part(part.role, body));
                (part, color)
            };
            Limbs::Figure(parts.into_iter().map(of).collect())
        }));
        let is_figure = list.last() != Some(&Limbs::None);
        list.extend(run.iter().skip(1).map(|_| if is_figure { Limbs::Within } else { Limbs::None }));
    }
    list
}

/// How much white a limb in front has, and how bright one behind is, beside the torso `[1]`.
const IN_FRONT: f64 = 0.25;
const BEHIND: f64 = 0.6;

/// The colour of a part of a figure: a head and hands have that of skin, unless the figure is painted.
fn color_of_part(role: Role, body: &Filled) -> [u8; 3] {
    let mixed = |color: [u8; 3], to: f64, share: f64| {
        color.map(|part| (f64::from(part) + share * (to - f64::from(part))).round() as u8)
    };
    let skin = if body.is_own { body.color } else { SKIN_COLOR };
    match role {
        Role::Whole | Role::Torso => body.color,
        Role::Front => mixed(body.color, 255.0, IN_FRONT),
        Role::Behind => mixed(body.color, 0.0, 1.0 - BEHIND),
        Role::Head | Role::End(true) => skin,
        Role::End(false) => mixed(skin, 0.0, 1.0 - BEHIND),
    }
}

/// The shares of a limb's ends, that of its lesser radius in the larger one, ten bits each, and whether its second end is the wider one.
fn packed(cone: &Cone) -> u32 {
    let bits = |share: f32| (share.clamp(0.0, 1.0) * 1023.0).round() as u32;
    let [first, second] = cone.radii;
    let ratio = first.min(second) / first.max(second).max(f32::MIN_POSITIVE);
    bits(cone.shares[0]) | bits(cone.shares[1]) << 10 | bits(ratio) << 20 | u32::from(second > first) << 30
}

/// A body in all of its colours: what is painted in several goes from one to the other.
struct Run<'a> {
    bodies: &'a [Filled],
    triangles: Vec<[u32; 3]>,
    /// [`PAINTED`] or 0.
    mark: u32,
    /// The colour of points that have none of their own.
    color: [u8; 3],
}

impl<'a> Run<'a> {
    fn of(bodies: &'a [Filled]) -> Self {
        let triangles = bodies.iter().flat_map(|body| body.triangles.iter().copied()).collect();
        let is_painted = bodies.iter().any(|body| body.is_own);
        let (mark, color) = if is_painted { (PAINTED, color_of(bodies[0].body)) } else { (0, bodies[0].color) };
        Run { bodies, triangles, mark, color }
    }
}

/// Whether triangles enclose a volume, but for what was torn open: what they have of free sides is short beside what they cover, which of a sheet
/// it is not. So many sides a triangle, squared `[1]`; those of a square sheet are 8.
fn encloses(triangles: &[[u32; 3]]) -> bool {
    const MOST: usize = 6;
    let sides = outline(triangles).len();
    sides * sides < MOST * triangles.len()
}

fn runs(bodies: &[Filled]) -> Vec<Run<'_>> {
    bodies.chunk_by(|a, b| a.body == b.body).map(Run::of).collect()
}

/// What is drawn of bodies: in the plane body by body, each over those before it; in space all fills, then all outlines.
fn primitives(bodies: &[Filled], lines: &Lines, dimensions: usize) -> Vec<Primitive> {
    let runs = runs(bodies);
    let sides: Vec<Vec<Side>> = runs.iter().map(|run| outline(&run.triangles)).collect();
    let has_shadows = sides.iter().map(Vec::len).sum::<usize>() <= MOST_SHADOWS;
    let (mut list, mut outlines) = (Vec::new(), Vec::new());
    let mut number = 0;
    for (Run { bodies, triangles, mark, color: plain }, sides) in runs.into_iter().zip(&sides) {
        let numbers = number..number + bodies.len();
        number = numbers.end;
        let is_round = dimensions == 2 && may_be_round(&triangles, sides);
        let side = |kind: u32, side: &Side| Primitive {
            points: [side.before, side.a, side.b, side.after, u32::from(is_round), 0],
            ink: ink(kind | mark, plain),
        };
        let limbs = lines.limbs.get(numbers.start).unwrap_or(&Limbs::None);
        let parts = if let Limbs::Figure(parts) = limbs { &parts[..] } else { &[] };
        let is_doll = parts.iter().any(|(part, _)| part.role != Role::Whole);
        if dimensions == 2 && has_shadows && !is_doll {
            list.extend(sides.iter().map(|one| side(SHADOW, one)));
        }
        for (part, color) in parts {
            // The rim of a part lies below all of it.
            for kind in [SKIN, FLESH] {
                list.extend(part.cones.iter().map(|cone| limb(kind, cone, *color)));
            }
        }
        for body in bodies {
            let (kind, color) = if is_doll { (UNDER, body.color) } else { (FILL | mark, plain) };
            list.extend(filling(kind, color, &body.triangles));
        }
        let inner = lines.inner.get(numbers).filter(|_| !is_doll).into_iter().flatten().flatten();
        list.extend(inner.map(|&[a, b]| Primitive { points: [a, a, b, b, 0, 0], ink: ink(INNER, plain) }));
        let to = if dimensions == 2 { &mut list } else { &mut outlines };
        to.extend(sides.iter().filter(|_| *limbs == Limbs::None).map(|one| side(OUTLINE, one)));
    }
    list.append(&mut outlines);
    list
}

/// The cells of nets, and what hangs loose where they are torn: they fade towards it.
fn nets_of(nets: &[Run<'_>], open: &[&Bond]) -> Vec<Primitive> {
    let ends = open.iter().flat_map(|bond| [(bond.a.0, (bond.b.0, bond)), (bond.b.0, (bond.a.0, bond))]);
    let mut loose: Vec<(u32, (u32, &&Bond))> = ends.collect();
    loose.sort_by_key(|(end, _)| *end);
    let is_loose = |point: u32| loose.binary_search_by_key(&point, |(end, _)| *end).is_ok();
    let mut list = Vec::new();
    for net in nets {
        let fading = |corner: u32| if is_loose(corner) { corner | FRAYED } else { corner };
        let cells: Vec<[u32; 3]> = net.triangles.iter().map(|corners| corners.map(fading)).collect();
        list.extend(filling(CELL | net.mark, net.color, &cells));
    }
    for net in nets {
        let mut corners: Vec<u32> = net.triangles.iter().flatten().copied().collect();
        corners.sort_unstable();
        let own = loose.iter().filter(|(end, _)| corners.binary_search(end).is_ok());
        list.extend(own.map(|&(end, (to, bond))| Primitive {
            points: [end, to, (bond.rest_length as f32).to_bits(), 0, 0, 0],
            ink: ink(THREAD | net.mark, net.color),
        }));
    }
    list
}

/// Triangles in a colour, two in a primitive; those of a quad, which come one after the other, are in one.
fn filling(kind: u32, color: [u8; 3], triangles: &[[u32; 3]]) -> impl Iterator<Item = Primitive> {
    let are_quad = |pair: &[[u32; 3]]| matches!(pair, &[[a, _, c], [d, e, _], ..] if [a, c] == [d, e]);
    let mut left = triangles;
    std::iter::from_fn(move || {
        let &[a, b, c] = left.first()?;
        let is_alone = left.len() == 1 || (!are_quad(left) && are_quad(&left[1..]));
        // A triangle without another beside it has one of no area.
        let [d, e, f] = if is_alone { [a; 3] } else { left[1] };
        left = &left[if is_alone { 1 } else { 2 }..];
        Some(Primitive { points: [a, b, c, d, e, f], ink: ink(kind, color) })
    })
}

fn limb(kind: u32, cone: &Cone, color: [u8; 3]) -> Primitive {
    let [[a, b], [c, d]] = cone.ends;
    let radius = cone.radii[0].max(cone.radii[1]).to_bits();
    Primitive { points: [a, b, c, d, radius, packed(cone)], ink: ink(kind, color) }
}

/// The bonds of each body that lie within it and are no side of a triangle, such as second diagonals: in the plane, of scenes with few bonds.
fn inner(view: &View<'_>, bodies: &[Filled]) -> Vec<Vec<[u32; 2]>> {
    if view.dimensions != 2 || view.bonds.len() > MOST_INNER || bodies.is_empty() {
        return Vec::new();
    }
    let mut body_of = vec![u32::MAX; view.current.len() / 2];
    let mut sides = Vec::new();
    for (number, body) in (0..).zip(bodies) {
        for &[a, b, c] in &body.triangles {
            [a, b, c].into_iter().for_each(|corner| body_of[corner as usize] = number);
            sides.extend([[a, b], [b, c], [c, a]].map(lower_first));
        }
    }
    sides.sort_unstable();
    let mut list = vec![Vec::new(); bodies.len()];
    for bond in view.bonds.iter().filter(|bond| bond.drive.is_none()) {
        let ends = lower_first([bond.a.0, bond.b.0]);
        let [of_a, of_b] = ends.map(|end| body_of.get(end as usize).copied().unwrap_or(u32::MAX));
        if of_a == of_b && of_a != u32::MAX && sides.binary_search(&ends).is_err() {
            list[of_a as usize].push(ends);
        }
    }
    list
}

fn ink(kind: u32, [red, green, blue]: [u8; 3]) -> u32 {
    u32::from_be_bytes([kind as u8, red, green, blue])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_enclose_a_volume_also_torn_and_sheets_do_not() {
        let at = |x: u32, y: u32| 5 * y + x;
        let cell = |k: u32| (k % 4, k / 4);
        let of_cell = |(x, y): (u32, u32)| {
            let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
            [[a, b, c], [a, c, d]]
        };
        let sheet: Vec<[u32; 3]> = (0..16).map(cell).flat_map(of_cell).collect();
        assert!(!encloses(&sheet) && !encloses(&sheet[..8]));
        // Two sheets sewn together along their rims.
        let is_rim = |point: u32| [0, 4].contains(&(point % 5)) || [0, 4].contains(&(point / 5));
        let back = |corners: &[u32; 3]| corners.map(|point| if is_rim(point) { point } else { point + 100 });
        let whole: Vec<[u32; 3]> =
            sheet.iter().copied().chain(sheet.iter().map(back).map(|[a, b, c]| [a, c, b])).collect();
        assert!(encloses(&whole) && encloses(&whole[2..]), "a hole makes it no sheet");
    }

    #[test]
    fn a_second_diagonal_is_drawn_on_its_body_and_sides_are_not_again() {
        use crate::sim::{Bonds, Positions};
        let ends = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [3, 1], [1, 4]];
        let bonds: Bonds = ends.iter().map(|&[a, b]| Bond::new(PointId(a), PointId(b), 1.0)).collect();
        let places = [0.0; 10];
        let at = Positions::F64(&places);
        let triangles = [[0, 1, 2], [0, 2, 3]];
        let body = Filled { body: 0, is_own: false, color: [1, 2, 3], triangles: triangles.to_vec() };
        let view = View { previous: at, current: at, ..View::empty(&bonds, 2) };
        let list = inner(&view, std::slice::from_ref(&body));
        assert_eq!(list, [vec![[1, 3]]]);
        let kinds = primitives(&[body], &Lines { inner: list, ..Lines::default() }, 2);
        let drawn: Vec<[u32; 6]> = kinds.iter().filter(|one| one.ink >> 24 == INNER).map(|one| one.points).collect();
        assert_eq!(drawn, [[1, 1, 3, 3, 0, 0]]);
    }

    #[test]
    fn what_has_joints_with_stops_is_a_figure_of_limbs() {
        use crate::sim::{Bonds, Positions};
        // Two squares that share a corner, the second one half as large.
        let places = [0.0, 0.0, 2.0, 0.0, 2.0, 2.0, 0.0, 2.0, 3.0, 2.0, 3.0, 3.0, 2.0, 3.0];
        let triangles = vec![[0, 1, 2], [0, 2, 3], [2, 4, 5], [2, 5, 6]];
        let body = Filled { body: 0, is_own: false, color: [1, 2, 3], triangles };
        let (at, bonds) = (Positions::F64(&places), Bonds::default());
        let view = View { previous: at, current: at, joints: vec![PointId(2)], ..View::empty(&bonds, 2) };
        let found = limbs(&view, std::slice::from_ref(&body));
        assert!(
            matches!(&found[..], [Limbs::Figure(parts)] if parts.len() == 1 && parts[0].1 == [1, 2, 3]),
            "{found:?}"
        );
        let halves: Vec<Filled> = body
            .triangles
            .chunks(2)
            .map(|triangles| Filled { triangles: triangles.to_vec(), ..body.clone() })
            .collect();
        let painted = limbs(&view, &halves);
        assert!(matches!(&painted[..], [Limbs::Figure(_), Limbs::Within]), "one figure of two colours: {painted:?}");
        assert!(limbs(&View { joints: Vec::new(), ..view.clone() }, std::slice::from_ref(&body)).is_empty());
        let list = primitives(&[body], &Lines { limbs: found, ..Lines::default() }, 2);
        let kinds: Vec<u32> = list.iter().map(|primitive| primitive.ink >> 24).collect();
        let expected = [[SHADOW; 8].as_slice(), &[SKIN; 8], &[FLESH; 8], &[FILL; 2]].concat();
        assert_eq!(kinds, expected, "without an outline across the joint");
    }

    #[test]
    fn limbs_are_packed_with_both_radii_and_their_places() {
        let cone = Cone { ends: [[1, 2], [3, 4]], shares: [0.25, 1.0], radii: [0.1, 0.2] };
        let Primitive { points, ink } = limb(FLESH, &cone, [9, 8, 7]);
        assert_eq!((&points[..4], f32::from_bits(points[4]), ink), (&[1, 2, 3, 4][..], 0.2, 0x0409_0807));
        let part = |shift: u32| f64::from(points[5] >> shift & 1023) / 1023.0;
        for (shift, wanted) in [(0, 0.25), (10, 1.0), (20, 0.5)] {
            assert!((part(shift) - wanted).abs() < 1e-3, "{shift}: {}", part(shift));
        }
        assert_eq!(points[5] >> 30, 1, "the second end is wider");
    }

    #[test]
    fn in_the_plane_a_body_lies_over_those_before_it_and_in_space_outlines_lie_over_all() {
        let body = |first: u32| Filled {
            body: first,
            is_own: false,
            color: [1, 2, 3],
            triangles: vec![[first, first + 1, first + 2]],
        };
        let kinds = |dimensions| {
            let list = primitives(&[body(0), body(3)], &Lines::default(), dimensions);
            list.iter().map(|primitive| primitive.ink >> 24).collect::<Vec<u32>>()
        };
        let one = [[SHADOW; 3].as_slice(), &[FILL], &[OUTLINE; 3]].concat();
        assert_eq!(kinds(2), [one.clone(), one].concat());
        assert_eq!(kinds(3), [[FILL; 2].as_slice(), &[OUTLINE; 6]].concat());
        assert_eq!(primitives(&[body(0)], &Lines::default(), 3)[0].points, [0, 1, 2, 0, 0, 0]);
    }

    #[test]
    fn threads_hang_from_cells_where_they_tore_and_these_fade_there() {
        let net = Filled { body: 0, is_own: false, color: [1, 2, 3], triangles: vec![[0, 1, 2]] };
        let torn = Bond::new(PointId(2), PointId(9), 0.5);
        let list = nets_of(&runs(&[net]), &[&torn]);
        assert_eq!(list[0].points, [0, 1, 2 | FRAYED, 0, 0, 0]);
        assert_eq!((list[1].points[..2].to_vec(), f32::from_bits(list[1].points[2])), (vec![2, 9], 0.5));
        assert_eq!((list.len(), list[1].ink >> 24), (2, THREAD), "no cell is at the other end");
    }

    #[test]
    fn what_is_painted_in_part_has_one_outline_and_colours_by_its_points() {
        let part = |is_own, triangles| Filled { body: 4, is_own, color: [1, 2, 3], triangles };
        let square = [part(false, vec![[0, 1, 2]]), part(true, vec![[0, 2, 3]])];
        let list = primitives(&square, &Lines::default(), 2);
        let of = |kind: u32| list.iter().filter(move |one| one.ink == ink(kind | PAINTED, color_of(4))).count();
        assert_eq!((of(FILL), of(OUTLINE), of(SHADOW), list.len()), (2, 4, 4, 10), "no side between the two");
    }
}
