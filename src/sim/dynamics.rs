//! A running world behind one face, whatever its scalar and its dimension.

use super::bond::{Bond, PointId};
use super::bonds::Bonds;
use super::command::{Applied, Command, CommandError, Knots, Obstacle, SceneChange};
use super::contact::convex::Convex;
use super::contact::polygon::Polygon;
use super::contact::skin::{Contact, SkinMaterial};
use super::counters::Counters;
use super::drive::Key;
use super::force::angle::Angle;
use super::force::mouse::{Cursor, MouseForce};
use super::ledger::{Book, Energies, Ledger};
use super::model::{Driving, Method};
use super::moved::MovedBy;
use super::plan_part::PlanPart;
use super::real::{Positions, Precision};
use super::saved::SavedWorld;

/// Position and velocity of every point at one time, in `f64`, three components a point (z = 0 in the plane).
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Time `[s]`.
    pub time: f64,
    /// Positions `[m]`; of points that are gone NaN.
    pub position: Vec<[f64; 3]>,
    /// Velocities `[m/s]`; of points that are gone NaN.
    pub velocity: Vec<[f64; 3]>,
    /// Kinetic + springs', angles', areas' + gravity's energy of the points that are not pinned `[J]`.
    pub energy: f64,
    /// Largest |length/rest - 1| over the bonds `[1]` (rest 0 left out).
    pub max_strain: f64,
    /// Where the energy came from and went, if [`Method::ledger`](super::model::Method::ledger) asks for it.
    pub ledger: Option<Ledger>,
}

/// What is grabbed, to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct GrabView {
    /// The points that are left of those grabbed.
    pub points: Vec<PointId>,
    /// Their middle `[m]`.
    pub middle: [f64; 3],
    /// Where it is led to `[m]`.
    pub target: [f64; 3],
    /// The force now `[N]`.
    pub force: [f64; 3],
}

/// A constant force, to be drawn or asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceView {
    /// Its number.
    pub number: u32,
    /// The points that it acts on.
    pub points: Vec<PointId>,
    /// `[N]`
    pub force: [f64; 3],
    /// About their middle `[N m]`.
    pub torque: f64,
}

/// What the app, the command line and the renderer see of a world.
///
/// Implemented by `World<S, D>` for `f32` and `f64` in the plane and in space.
pub trait Dynamics: Send {
    /// 2 in the plane, 3 in space.
    fn dimensions(&self) -> usize;
    /// How many points there are.
    fn point_count(&self) -> usize;
    /// The scalar: [`Precision::F32`] or [`Precision::F64`].
    fn precision(&self) -> Precision;
    /// Time reached `[s]`.
    fn time(&self) -> f64;
    /// Length of the next substep `[s]`.
    fn substep(&self) -> f64;
    /// Advances by one substep.
    fn step(&mut self);
    /// Takes one substep, or goes to `time` `[s]` within it where it would go beyond. What no command touches there takes the substep
    /// whole afterwards, bit for bit as if it had not been cut; the grid of substeps stays.
    fn step_until(&mut self, time: f64);
    /// Does a command between two substeps.
    ///
    /// Errors: it cannot be done where it stands; the world is as it was.
    fn apply(&mut self, command: &Command) -> Result<Applied, CommandError>;
    /// Changes whenever points, bonds, pins or obstacles came, went or changed, other than by a step without breaks.
    fn topology(&self) -> u64;
    /// Points that were deleted, ascending: their numbers stay, their positions are NaN.
    fn gone(&self) -> &[PointId];
    /// Bonds that tore or were cut since the world was made, in that order, whatever became of their ends.
    fn torn(&self) -> &[Bond];
    /// The numbers of the bonds that are left, ascending, in the order of [`Dynamics::bonds`]; `None`: each has its own place.
    fn bond_numbers(&self) -> Option<&[u32]>;
    /// Where the bond of this number is in [`Dynamics::bonds`], if it is there.
    fn bond_place(&self, number: u32) -> Option<usize> {
        match self.bond_numbers() {
            Some(numbers) => numbers.binary_search(&number).ok(),
            None => ((number as usize) < self.bonds().len()).then_some(number as usize),
        }
    }
    /// The numbers of the obstacles that are left: planes in the order of [`Dynamics::planes`], then polygons; in space balls and boxes.
    fn obstacle_numbers(&self) -> [&[u32]; 2];
    /// The numbers that the next point, bond and obstacle get.
    fn next_numbers(&self) -> [u32; 3];
    /// The constant forces that are left.
    fn forces(&self) -> Vec<ForceView>;
    /// Where the live cursor is now.
    fn cursor(&self) -> Option<Cursor>;
    /// What is grabbed.
    fn grab(&self) -> Option<GrabView>;
    /// State at `time`, in [time reached, time reached + substep], by a step on a copy: the motion is not changed.
    fn sample(&self, time: f64) -> Sample;
    /// Positions now, as they lie in memory.
    fn positions(&self) -> Positions<'_>;
    /// The bonds that are left, in the order of the model.
    fn bonds(&self) -> &Bonds;
    /// The angles that are left, their numbers ascending.
    fn angles(&self) -> &[Angle];
    /// The keys that drives have, ascending.
    fn drive_keys(&self) -> Vec<Key>;
    /// The keys that are held, ascending.
    fn held_keys(&self) -> &[Key];
    /// What bodies cover, of the points and bonds that are left.
    fn triangles(&self) -> &[[PointId; 3]];
    /// What can be set of the scene, as it stands: to set it changes nothing.
    fn settings(&self) -> SceneChange;
    /// How bodies meet; `None`: they pass through each other.
    fn contact(&self) -> Option<Contact>;
    /// The points that never move.
    fn pinned(&self) -> &[PointId];
    /// Where pins are led: the track of each that has one.
    fn pin_tracks(&self) -> Vec<(PointId, Knots)>;
    /// The props, ascending: pins that hold nothing, which motors and joints on the background push against.
    fn props(&self) -> Vec<PointId> {
        if self.angles().is_empty() {
            return Vec::new();
        }
        let mut pinned = self.pinned().to_vec();
        pinned.sort_unstable();
        let firsts = self.angles().iter().filter(|angle| angle.stiffness == 0.0).map(|angle| angle.points[0]);
        let mut props: Vec<PointId> = firsts.filter(|point| pinned.binary_search(point).is_ok()).collect();
        props.sort_unstable();
        props.dedup();
        if props.is_empty() {
            return props;
        }
        let mut holds = vec![false; props.len()];
        let held = self.bonds().ends().iter().flatten().chain(self.triangles().iter().flatten());
        held.filter_map(|point| props.binary_search(point).ok()).for_each(|prop| holds[prop] = true);
        let free = props.into_iter().zip(holds).filter(|(_, holds)| !holds);
        free.map(|(prop, _)| prop).collect()
    }
    /// The masses of all points `[kg]`.
    fn masses(&self) -> &[f64];
    /// Corners of the walls, if there are any (z = 0 in the plane).
    fn bounds(&self) -> Option<[[f64; 3]; 2]>;
    /// A point and the normal of every plane that points cannot pass (z = 0 in the plane).
    fn planes(&self) -> Vec<[[f64; 3]; 2]>;
    /// The polygons that points cannot enter.
    fn polygons(&self) -> &[Polygon];
    /// Balls and boxes in space that points cannot enter.
    fn convex(&self) -> &[Convex];
    /// All obstacles with their numbers, in the order of [`Dynamics::obstacle_numbers`].
    fn obstacles(&self) -> Vec<(u32, Obstacle)>;
    /// What of the skin at a point is said apart from what [`Dynamics::contact`] says for all.
    fn skin_of(&self, point: PointId) -> SkinMaterial;
    /// The mouse force and where its cursor is now, if the scene has the force and a cursor is there.
    fn mouse(&self) -> Option<(&MouseForce, Cursor)>;
    /// The mouse force, if the scene has it, wherever its cursor is.
    fn mouse_force(&self) -> Option<&MouseForce>;
    /// Kinetic + springs', angles', areas' + gravity's energy of the points that are not pinned `[J]`.
    fn energy(&self) -> f64 {
        self.energies().sum()
    }
    /// The same by kind `[J]`.
    fn energies(&self) -> Energies;
    /// What is booked of where energy came from and went, where a ledger is kept: of a run that goes on, as [`Sample::ledger`] has it.
    fn book(&self) -> Option<Book>;
    /// The largest |length/rest - 1| of the bonds that act `[1]`, as [`Sample::max_strain`].
    fn max_strain(&self) -> f64;
    /// The force by which a rigid bond, by its place among [`Dynamics::bonds`], pulls its ends together `[N]`, below 0 where it pushes;
    /// `None` where it is no rigid bond or the state does not tell: see docs/window.md.
    fn tension(&self, place: usize) -> Option<f64>;
    /// Velocity of a point `[m/s]`; 0 of one that is gone.
    fn velocity(&self, point: PointId) -> [f64; 3];
    /// Work done so far.
    fn counters(&self) -> &Counters;
    /// Bytes that points, bonds, the plan and the state of large bodies take; those of small bodies' solvers are not counted.
    fn heap_bytes(&self) -> usize;
    /// What moves the parts of the world: a line a group of islands.
    fn parts(&self) -> &[PlanPart];
    /// What moves the islands, since when and why: those that step together as one, in the order of their lowest points.
    fn moved_by(&self) -> Vec<MovedBy>;
    /// How the motion is computed now.
    fn method(&self) -> Method;
    /// What decides whether bonds and angles can have drives now.
    fn driving(&self) -> Driving;
    /// Whether an island that its own method moves would take clearly less counted work in the live step, where that may move it.
    fn is_cheaper_live(&self) -> bool;
    /// What moves a point that can move: the group of islands that it is in; `None` where it is gone.
    fn mover_of(&self, point: PointId) -> Option<&PlanPart>;
    /// What the user should know of the scene: lengths that contradict each other, bonds that cannot hold.
    fn warnings(&self) -> &[String];
    /// Whether everything sleeps, and nothing that is still to come could wake it.
    fn is_asleep(&self) -> bool;
    /// Wakes everything.
    fn wake(&mut self);
    /// Whether nothing moves faster than `speed` `[m/s]`, no cursor reaches a point and no track moves.
    fn is_still(&self, speed: f64) -> bool;
    /// Whether every position is a finite number.
    fn is_finite(&self) -> bool;
    /// The world as it stands, to be kept; `None` of a dimension that there is not.
    fn save(&self) -> Option<SavedWorld>;
    /// A copy that runs on by itself.
    fn boxed_clone(&self) -> Box<dyn Dynamics>;
}
