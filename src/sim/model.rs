//! What a world is made from: points, bonds, forces, walls and a method, in `f64` and checked.

mod check;
mod drives;
mod driving;
mod error;
mod form;
mod printed;

use super::bond::PointId;
use super::bonds::Bonds;
use super::contact::bounds::Bounds;
use super::contact::convex::Convex;
use super::contact::geometry::Geometry;
use super::contact::penalty::Cushion;
use super::contact::polygon::Polygon;
use super::contact::skin::{Contact, SkinMaterials};
use super::contact::surface::Plane;
use super::force::angle::Angles;
use super::force::area::Areas;
use super::force::mouse::{MouseForce, Track};
use super::force::steady::Force;
use super::force::wind::Wind;
use super::real::Precision;
use super::solver::{Order, Solver};
use super::vector::{add, scale};

pub(crate) use check::{check_force, check_triangle};
pub use driving::{Driving, NoDrive};
pub use error::ModelError;
pub(crate) use error::entries_for;
pub use form::angle_at;

/// A start: everything that decides a motion. The same model runs bit for bit as it did before.
///
/// Shapes: `position`, `velocity` and `mass` have one entry a point; `bonds` and `pinned` hold indices below that.
/// Valid range: every number finite, masses > 0, no bond between a point and itself. A scene file is checked when it
/// is read; [`Model::check`] holds hand-made models to the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Model<const D: usize> {
    /// Positions at the start `[m]`.
    pub position: Vec<[f64; D]>,
    /// Velocities at the start `[m/s]`; those of pinned points are ignored.
    pub velocity: Vec<[f64; D]>,
    /// Masses `[kg]`, > 0.
    pub mass: Vec<f64>,
    /// The points that never move, in any order.
    pub pinned: Vec<PointId>,
    /// The bonds, in the order that [`Order::Fixed`] sweeps them.
    pub bonds: Bonds,
    /// What bodies cover: corners that differ, anticlockwise where nothing is inside out.
    pub triangles: Vec<[PointId; 3]>,
    /// How triangles resist a change of their area, in the plane; `None`: not at all.
    pub areas: Option<Areas>,
    /// The area that each triangle is made with `[m^2]`, 0 of one that is left out, where triangles resist; empty: still to be worked out.
    pub rest_areas: Vec<f64>,
    /// Angles that resist, in the plane.
    pub angles: Angles,
    /// How bodies meet; `None`: they pass through each other.
    pub contact: Option<Contact>,
    /// What skins are made of, where bodies have their own.
    pub skins: SkinMaterials,
    /// Constant forces and torques on chosen points.
    pub forces: Vec<Force<D>>,
    /// Gravity `[m/s^2]`.
    pub gravity: [f64; D],
    /// Rate at which velocities relative to the air decay `[1/s]`, >= 0.
    pub drag_rate: f64,
    /// Air that moves; `None`: it is still.
    pub wind: Option<Wind<D>>,
    /// The force around the cursor, if the scene has one.
    pub mouse: Option<MouseForce>,
    /// The walls around the world, if any.
    pub bounds: Option<Bounds<D>>,
    /// When the motion ends `[s]`: a substep ends there. `None`: never.
    pub duration: Option<f64>,
    /// Planes that points cannot pass.
    pub planes: Vec<Plane<D>>,
    /// Polygons that points cannot enter; none in space.
    pub polygons: Vec<Polygon>,
    /// Balls and boxes that points cannot enter; none in the plane.
    pub convex: Vec<Convex>,
    /// The numbers that commands know planes and all other obstacles by, in the order of each list; empty: planes first, then the others.
    pub obstacle_numbers: [Vec<u32>; 2],
    /// Pinned points that are led along tracks.
    pub pin_motion: Vec<(PointId, Track<D>)>,
    /// How the motion is computed.
    pub method: Method,
}

/// Most sweeps over the bonds in a substep: a step has to end.
pub const MOST_ITERATIONS: u32 = 100_000;

/// Strongest gravity along an axis `[m/s^2]`: far beyond that of any star that shines, and its motions stay among the finite numbers.
pub const MOST_GRAVITY: f64 = 1e9;

impl<const D: usize> Model<D> {
    /// The counted work of a frame beyond which islands are handed over to the live step `[ms]`; `None`: none ever is.
    pub(crate) fn budget(&self) -> Option<f64> {
        let Method { solver, tolerance, budget, .. } = self.method;
        let is_known = self.convex.is_empty() && !self.has_penalties();
        // In space what meets others is live from the start.
        let is_open = D == 2 || self.contact.is_none();
        let is_meant = is_open && solver == Solver::Auto && tolerance.is_none() && is_known;
        budget.filter(|_| is_meant)
    }

    /// Whether islands that their own methods lose are put back among the numbers, and stand still there: not where a method or an error
    /// was asked for, whose failures are to be seen.
    pub(crate) fn freezes(&self) -> bool {
        let Method { solver, tolerance, budget, .. } = self.method;
        solver == Solver::Auto && tolerance.is_none() && budget.is_some()
    }

    /// Whether islands are moved by their own methods until they may meet something.
    pub(crate) fn meets_on_demand(&self) -> bool {
        self.contact.is_some() && self.budget().is_some()
    }

    /// The acceleration that is the same everywhere and for ever `[m/s^2]`: gravity, and what the mean wind gives by drag.
    pub(crate) fn field(&self) -> [f64; D] {
        self.wind.map_or(self.gravity, |wind| add(self.gravity, scale(wind.velocity, self.drag_rate)))
    }

    /// Whether surfaces push by depth in place of contact.
    pub(crate) fn has_penalties(&self) -> bool {
        self.planes.iter().any(|plane| plane.penalty.is_some())
    }

    /// What is stored in surfaces that push by depth, of free points at these places `[J]`.
    pub(crate) fn penalty_energy(&self, places: impl Iterator<Item = [f64; D]> + Clone) -> f64 {
        let cushions = self.planes.iter().filter_map(Cushion::<f64, D>::of);
        cushions.map(|cushion| cushion.energy(places.clone())).sum()
    }

    /// Whether forces on some points, or gusts, push what would fly otherwise.
    pub(crate) fn has_fields(&self) -> bool {
        let has_gusts = |wind: &Wind<D>| wind.turbulence > 0.0 && self.drag_rate > 0.0;
        !self.forces.is_empty() || self.wind.as_ref().is_some_and(has_gusts)
    }

    /// Whether there is a wind that pushes nothing.
    pub(crate) fn has_idle_wind(&self) -> bool {
        // A loop of its own makes its own of it.
        let is_printed = matches!(self.method.solver, Solver::AsPrinted(_));
        !is_printed && self.drag_rate == 0.0 && self.wind.is_some_and(|wind| wind.velocity.iter().any(|&u| u != 0.0))
    }

    /// Whether all that can move is moved together by the live step from the start.
    pub(crate) fn is_live(&self) -> bool {
        let meets = self.contact.is_some() && !self.meets_on_demand();
        let is_printed = matches!(self.method.solver, Solver::AsPrinted(_));
        !is_printed && (meets || self.method.solver == Solver::Live || !self.convex.is_empty())
    }

    /// Times at which a step has to end `[s]`: knots of tracks, and the duration; in any order.
    pub(crate) fn knots(&self) -> impl Iterator<Item = f64> {
        let tracks = self.pin_motion.iter().flat_map(|(_, track)| track.knots.iter().map(|knot| knot.0));
        let mouse = self.mouse.iter().flat_map(|mouse| mouse.track.knots.iter().map(|knot| knot.0));
        tracks.chain(mouse).chain(self.duration)
    }

    /// The same without positions, velocities and bonds, which a world keeps apart.
    pub(crate) fn bare(&self) -> Self {
        Model {
            position: Vec::new(),
            velocity: Vec::new(),
            mass: self.mass.clone(),
            pinned: self.pinned.clone(),
            bonds: Bonds::new(),
            triangles: self.triangles.clone(),
            areas: self.areas,
            rest_areas: self.rest_areas.clone(),
            angles: self.angles.clone(),
            contact: self.contact,
            skins: self.skins.clone(),
            forces: self.forces.clone(),
            gravity: self.gravity,
            drag_rate: self.drag_rate,
            wind: self.wind,
            mouse: self.mouse.clone(),
            bounds: self.bounds,
            duration: self.duration,
            planes: self.planes.clone(),
            polygons: self.polygons.clone(),
            convex: self.convex.clone(),
            obstacle_numbers: self.obstacle_numbers.clone(),
            pin_motion: self.pin_motion.clone(),
            method: self.method,
        }
    }

    /// Whether there is anything that points cannot pass.
    pub(crate) fn has_surfaces(&self) -> bool {
        self.bounds.is_some() || !self.planes.is_empty() || !self.polygons.is_empty() || !self.convex.is_empty()
    }
}

impl<'a, const D: usize> From<&'a Model<D>> for Geometry<'a, D> {
    fn from(model: &'a Model<D>) -> Self {
        Geometry {
            bounds: model.bounds.as_ref(),
            planes: &model.planes,
            polygons: &model.polygons,
            convex: &model.convex,
        }
    }
}

impl<const D: usize> Default for Model<D> {
    /// No points, no forces, the automatic method.
    fn default() -> Self {
        Model {
            position: Vec::new(),
            velocity: Vec::new(),
            mass: Vec::new(),
            pinned: Vec::new(),
            bonds: Bonds::new(),
            triangles: Vec::new(),
            areas: None,
            rest_areas: Vec::new(),
            angles: Angles::default(),
            contact: None,
            skins: SkinMaterials::default(),
            forces: Vec::new(),
            gravity: [0.0; D],
            drag_rate: 0.0,
            wind: None,
            mouse: None,
            bounds: None,
            duration: None,
            planes: Vec::new(),
            polygons: Vec::new(),
            convex: Vec::new(),
            obstacle_numbers: [Vec::new(), Vec::new()],
            pin_motion: Vec::new(),
            method: Method::default(),
        }
    }
}

/// How a motion is computed: the keys of `method` in a scene file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Method {
    /// The integrator and the way bonds are held.
    pub solver: Solver,
    /// Substep h `[s]`, > 0; `None`: chosen from the fastest motion of the scene.
    pub substep: Option<f64>,
    /// Sweeps over the bonds in a substep, from 1 to [`MOST_ITERATIONS`].
    pub iterations: Option<u32>,
    /// The order in which a sweep takes the bonds.
    pub order: Order,
    /// Seed of [`Order::Shuffled`].
    pub seed: u64,
    /// The scalar of the world.
    pub precision: Precision,
    /// Largest error at every sample `[m]`, > 0, that a search has to reach; `None`: fixed rules.
    pub tolerance: Option<f64>,
    /// Largest strain of rigid bonds `[1]`, > 0, that large bodies are held to; `None`: 0.02 for islands of more than 2,000
    /// rigid bonds, 1e-6 for smaller ones.
    pub max_strain: Option<f64>,
    /// Counted work a frame of 1/60 s `[ms]`, > 0, beyond which islands that [`Solver::Auto`] moves exactly are handed over to the
    /// live step, in the plane, as they are where their method fails; `None`: they never are. A tolerance means `None`.
    pub budget: Option<f64>,
    /// What stays where it is falls asleep, and is not stepped until something reaches it.
    pub sleeps: bool,
    /// What touches something and is slow is slowed down in the live step until it rests.
    pub settles: bool,
    /// Keeps a [`Ledger`](super::ledger::Ledger) of the world's energy. It changes nothing of the motion, and takes time.
    pub ledger: bool,
}
