//! What the stepping thread hands to the window: two states of the positions, what stands about them, and figures.

use std::sync::{Arc, OnceLock};

use super::acts::Acts;
use super::beside::Beside;
use super::movers::Movers;
use super::rungs::Yielded;
use super::watch::{Apart, Measured};
use crate::app::matter::{Matter, Placed};
use crate::app::tools::{Kept, Walls};
use crate::history::{BranchView, Clock, Group};
use crate::picture::{Skin, Tint};
use crate::render::{Hinge, View, joints};
use crate::scene::LabelKeys;
use crate::sim::{
    Angle, Bond, Bonds, Convex, Cursor, Driving, Dynamics, ForceView, GrabView, Jam, Key, MouseForce, Obstacle,
    PointId, Polygon, Positions, SceneChange,
};

/// Positions in the scalar of their world, copied.
#[derive(Clone, Debug)]
pub enum Places {
    /// Of an `f32` world.
    F32(Vec<f32>),
    /// Of an `f64` world.
    F64(Vec<f64>),
}

impl Default for Places {
    fn default() -> Self {
        Places::F64(Vec::new())
    }
}

impl Places {
    /// Takes over positions; the memory that is there is used again.
    pub fn copy(&mut self, positions: Positions<'_>) {
        match (self, positions) {
            (Places::F32(to), Positions::F32(x)) => x.clone_into(to),
            (Places::F64(to), Positions::F64(x)) => x.clone_into(to),
            (places, Positions::F32(x)) => *places = Places::F32(x.to_vec()),
            (places, Positions::F64(x)) => *places = Places::F64(x.to_vec()),
        }
    }

    /// As a renderer reads them.
    pub fn view(&self) -> Positions<'_> {
        match self {
            Places::F32(x) => Positions::F32(x),
            Places::F64(x) => Positions::F64(x),
        }
    }
}

/// What changes with the topology only.
#[derive(Clone, Debug, Default)]
pub struct Scenery {
    /// The bonds that are left.
    pub bonds: Bonds,
    /// Bonds that tore or were cut.
    pub torn: Vec<Bond>,
    /// Their numbers; `None`: each has its own place.
    pub bond_numbers: Option<Vec<u32>>,
    /// What points weigh `[kg]`.
    pub masses: Vec<f64>,
    /// The points that never move, ascending.
    pub pinned: Vec<PointId>,
    /// Points that were deleted, ascending.
    pub gone: Vec<PointId>,
    /// Corners of the walls.
    pub bounds: Option<[[f64; 3]; 2]>,
    /// A point and the normal of each plane.
    pub planes: Vec<[[f64; 3]; 2]>,
    /// The polygons.
    pub polygons: Vec<Polygon>,
    /// Balls and boxes in space.
    pub convex: Vec<Convex>,
    /// The numbers of the polygons; in space of balls and boxes.
    pub solid_numbers: Vec<u32>,
    /// The numbers of the planes.
    pub plane_numbers: Vec<u32>,
    /// The numbers of planes that push out what gets into them, and by how much `[N/m]`, `[N s/m]`.
    pub penalties: Vec<(u32, [f64; 2])>,
    /// The number that the next obstacle gets.
    pub next_obstacle: u32,
    /// Points that are selected as one.
    pub groups: Arc<Vec<Group>>,
    /// What bodies cover.
    pub triangles: Vec<[PointId; 3]>,
    /// What is drawn on triangles.
    pub skins: Vec<Skin>,
    /// Which body points belong to.
    pub tints: Arc<[Tint]>,
    /// What the user should know of the scene.
    pub warnings: Vec<String>,
    /// Numbers of bodies and obstacles among those that the scene names for sliders, in its order.
    pub named: Vec<Option<f64>>,
    /// The keys that drives have, ascending.
    pub keys: Vec<Key>,
    /// Points that keyed drives move, ascending.
    pub driven: Vec<PointId>,
    /// The constant forces.
    pub forces: Vec<ForceView>,
    /// The angles between bonds.
    pub angles: Vec<Angle>,
    /// Where motors and servos turn.
    pub hinges: Vec<Hinge>,
    /// Where joints are, ascending.
    pub joints: Vec<PointId>,
    /// Pins that hold nothing, which motors and joints on the background push against, ascending.
    pub props: Vec<PointId>,
    walls: OnceLock<Walls>,
    /// What stands about what is led by a tool.
    pub(in crate::app) about_led: Kept,
}

/// Planes that push out what gets into them, and by how much `[N/m]`, `[N s/m]`.
fn penalties(world: &dyn Dynamics) -> Vec<(u32, [f64; 2])> {
    let penalty = |(number, obstacle): (u32, Obstacle)| match obstacle {
        Obstacle::Plane { penalty, .. } => penalty.map(|of| (number, [of.stiffness, of.damping])),
        Obstacle::Polygon(_) | Obstacle::Convex(_) => None,
    };
    if world.planes().is_empty() { Vec::new() } else { world.obstacles().into_iter().filter_map(penalty).collect() }
}

impl Scenery {
    /// That of a world with these skins.
    pub fn of(world: &dyn Dynamics, skins: &[Skin], (tints, groups): (&Arc<[Tint]>, &Arc<Vec<Group>>)) -> Self {
        let [of_planes, of_solids] = world.obstacle_numbers();
        let [_, _, next_obstacle] = world.next_numbers();
        let mut pinned = world.pinned().to_vec();
        pinned.sort_unstable();
        Scenery {
            bonds: world.bonds().clone(),
            torn: world.torn().to_vec(),
            bond_numbers: world.bond_numbers().map(<[u32]>::to_vec),
            masses: world.masses().to_vec(),
            pinned,
            gone: world.gone().to_vec(),
            bounds: world.bounds(),
            planes: world.planes(),
            polygons: world.polygons().to_vec(),
            convex: world.convex().to_vec(),
            solid_numbers: of_solids.to_vec(),
            plane_numbers: of_planes.to_vec(),
            penalties: penalties(world),
            next_obstacle,
            groups: Arc::clone(groups),
            triangles: world.triangles().to_vec(),
            skins: skins.to_vec(),
            tints: Arc::clone(tints),
            warnings: world.warnings().to_vec(),
            named: Vec::new(),
            keys: world.drive_keys(),
            driven: driven(world),
            forces: world.forces(),
            angles: world.angles().to_vec(),
            hinges: Hinge::of(world),
            joints: joints(world),
            props: world.props(),
            walls: OnceLock::new(),
            about_led: Kept::default(),
        }
    }

    /// The obstacles that tools find room beside, in the plane.
    pub(in crate::app) fn walls(&self) -> &Walls {
        self.walls.get_or_init(|| Walls::of(self.bounds, &self.planes, self.polygons.clone()))
    }

    /// Where the bond of this number is in the list, if it is there.
    fn bond_place(&self, number: u32) -> Option<usize> {
        match &self.bond_numbers {
            Some(numbers) => numbers.iter().position(|own| *own == number),
            None => Some(number as usize),
        }
    }

    /// The ends of the bond of this number, if it is there.
    pub fn bond_ends(&self, number: u32) -> Option<[PointId; 2]> {
        self.bonds.ends().get(self.bond_place(number)?).copied()
    }

    /// The bond of this number, if it is there.
    pub fn bond(&self, number: u32) -> Option<Bond> {
        self.bonds.iter().nth(self.bond_place(number)?)
    }

    /// As the renderer reads it, without points.
    pub fn view(&self, dimensions: usize) -> View<'_> {
        let Scenery {
            bonds,
            torn,
            masses,
            pinned,
            bounds,
            planes,
            polygons,
            convex,
            triangles,
            skins,
            tints,
            hinges,
            joints,
            ..
        } = self;
        View {
            dimensions,
            previous: Positions::F64(&[]),
            current: Positions::F64(&[]),
            mix: 1.0,
            motion: 0,
            topology: 0,
            bonds,
            torn,
            skins,
            triangles,
            tints,
            values: None,
            trails: Vec::new(),
            masses,
            pinned,
            bounds: *bounds,
            planes: planes.clone(),
            polygons,
            convex,
            mouse: None,
            hinges: hinges.clone(),
            joints: joints.clone(),
            covered: &[],
        }
    }

    /// The number of the bond at this place of the list.
    pub fn bond_number(&self, place: usize) -> u32 {
        self.bond_numbers.as_ref().map_or(place as u32, |numbers| numbers.get(place).copied().unwrap_or(u32::MAX))
    }
}

/// Points that keyed drives of a world move, ascending.
pub(crate) fn driven(world: &dyn Dynamics) -> Vec<PointId> {
    if world.drive_keys().is_empty() {
        return Vec::new();
    }
    let bonds = world.bonds().iter().filter(|bond| bond.drive.is_some_and(|drive| drive.signal.held.is_some()));
    let angles = world.angles().iter();
    let angles = angles.filter(|angle| angle.drive.is_some_and(|drive| drive.signal().held.is_some()));
    let mut points: Vec<PointId> =
        bonds.flat_map(|bond| [bond.a, bond.b]).chain(angles.flat_map(|angle| angle.points)).collect();
    points.sort_unstable();
    points.dedup();
    points
}

/// What panels show of a world.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figures {
    /// Time reached `[s]`.
    pub time: f64,
    /// How far the motion goes that was seen already `[s]`.
    pub end: f64,
    /// What was done before is done again, until something new is done.
    pub follows: bool,
    /// It plays.
    pub playing: bool,
    /// It sleeps, and so does what stands beside it.
    pub asleep: bool,
    /// What stands beside it is on its way to where it is.
    pub behind: bool,
    /// It stands at the end of its duration.
    pub ended: bool,
    /// Seconds of the scene a second of wall time.
    pub rate: f64,
    /// The same as the scene has it, and where it ends.
    pub clock: Clock,
    /// Share of its pace that is reached `[1]`.
    pub pace: f64,
    /// Time that stepping took of a frame `[s]`.
    pub step: f64,
    /// Time that stepping 1/60 s at its pace takes, about `[s]`.
    pub work: f64,
    /// The same for each point, the least of late: of that no busy moment of the machine is a part `[s]`.
    pub cost: f64,
    /// Points that are left.
    pub points: usize,
    /// Bonds that are left.
    pub bonds: usize,
    /// `[J]`, as it was when figures were last taken.
    pub energy: f64,
    /// The mean velocity of what is selected, as it was when figures were last taken `[m/s]`.
    pub velocity: Option<[f64; 3]>,
    /// Where that is, likewise.
    pub placed: Option<Placed>,
    /// What moves its islands otherwise than by plan, as it was when figures were last taken.
    pub movers: Arc<Movers>,
    /// Stiffness of springs that would give way as much as relaxed bonds do `[N/m]`; `None` where none takes a share of its error.
    pub relaxed: Option<f64>,
    /// What gave way to the load.
    pub yielded: Option<Yielded>,
    /// What the live step did of late, as it was when figures were last taken.
    pub acts: Acts,
    /// Substeps taken since the program began.
    pub substeps: u64,
    /// The branches that can be gone to; empty where there never was more than one.
    pub branches: Arc<[BranchView]>,
    /// What undo would take back is called, as it was when figures were last taken; `None`: there is nothing to undo.
    pub undoes: Option<String>,
    /// What redo would bring again, likewise.
    pub redoes: Option<String>,
}

/// From which numbers on points and obstacles are not what they were: those are of what was given last, or of another branch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Latest {
    /// How often that was so.
    pub times: u64,
    /// The first such number of points and of obstacles.
    pub from: [u32; 2],
}

/// A moment of a world, as it is drawn.
#[derive(Clone, Debug, Default)]
pub struct Shown {
    /// The last order that had been done then.
    pub serial: u64,
    /// 2 or 3.
    pub dimensions: usize,
    /// Positions before the last substep.
    pub previous: Places,
    /// Positions after it.
    pub current: Places,
    /// How far between the two the picture lies, 0 to 1.
    pub mix: f32,
    /// Changes whenever positions did.
    pub motion: u64,
    /// Changes whenever the scenery did.
    pub topology: u64,
    /// What was given last.
    pub latest: Latest,
    /// What stands about them.
    pub scenery: Arc<Scenery>,
    /// What can be set of the scene, as it is.
    pub settings: SceneChange,
    /// The mouse force, and where its own track is if it has one.
    pub mouse: Option<MouseForce>,
    /// Its strength when nothing is led `[1/s^2]`; `None`: there is none, or it goes along a track.
    pub base: Option<f64>,
    /// Where its cursor is.
    pub cursor: Option<Cursor>,
    /// A click starts a motion where it is.
    pub starts: bool,
    /// What decides whether bonds and angles can have drives.
    pub driving: Driving,
    /// What is grabbed.
    pub grab: Option<GrabView>,
    /// What is in the way of obstacles that are dragged and has no room.
    pub jam: Option<Jam>,
    /// The same start by other methods, and what the method of the world is called beside them.
    pub beside: Vec<Beside>,
    /// Empty where nothing stands beside it.
    pub title: String,
    /// The world sleeps, whatever stands beside it does.
    pub rests: bool,
    /// What panels show.
    pub figures: Figures,
    /// What plots are made of since the last state, ascending in time, if that is asked for.
    pub measured: Vec<Measured>,
    /// What was found since the last state of how far measured points are from where the first world beside has them.
    pub apart: Vec<Apart>,
    /// What is selected is made of, if that is asked for.
    pub matter: Option<Arc<Matter>>,
    /// The words that stand in the world, those of points that are gone too.
    pub labels: Arc<Vec<LabelKeys>>,
}

impl Shown {
    /// The window did not take the state before this one: what was measured for that is measured still.
    pub(super) fn follow_unseen(&mut self, unseen: &Shown) {
        let at_their_times = unseen.measured.iter().filter(|measured| !measured.is_passing);
        self.measured.splice(0..0, at_their_times.copied());
        self.apart.splice(0..0, unseen.apart.iter().copied());
    }

    /// As the renderer reads it.
    pub fn view(&self) -> View<'_> {
        View {
            previous: self.previous.view(),
            current: self.current.view(),
            mix: self.mix,
            motion: self.motion,
            topology: self.topology,
            mouse: self.mouse.as_ref().zip(self.cursor),
            ..self.scenery.view(self.dimensions)
        }
    }

    /// Where a point is drawn `[m]`, z = 0 in the plane.
    pub fn place(&self, point: usize) -> [f64; 3] {
        let (from, to) = (self.previous.view(), self.current.view());
        let mix = f64::from(self.mix);
        std::array::from_fn(|axis| {
            let at = self.dimensions * point + axis;
            if axis >= self.dimensions || at >= to.len() || at >= from.len() {
                return 0.0;
            }
            from.get(at) + mix * (to.get(at) - from.get(at))
        })
    }

    /// How many numbers were given to points; some of them may be gone.
    pub fn point_count(&self) -> usize {
        self.current.view().len().checked_div(self.dimensions).unwrap_or(0)
    }
}
