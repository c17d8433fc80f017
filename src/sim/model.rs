//! What a world is made from: points, bonds, forces, walls and a method, in `f64` and checked.

mod drives;
mod driving;
mod form;
mod printed;

use super::bond::{Bond, BondKind, PointId};
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
use super::source::Source;
use super::vector::{add, scale};

pub use driving::{Driving, NoDrive};
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

/// Shortest substep `[s]`: a run of shorter ones would not end in a lifetime.
const SHORTEST: f64 = 1e-12;

/// How many entries a list has for so many points, in words.
pub(crate) fn entries_for(found: usize, points: usize) -> String {
    let entries = if found == 1 { "entry" } else { "entries" };
    format!("{found} {entries} for {points} {}", if points == 1 { "point" } else { "points" })
}

/// A model that no world can be made from.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ModelError {
    /// Lists of different lengths.
    #[error("{list} has {}: give one a point", entries_for(*found, *points))]
    Length {
        /// The list.
        list: &'static str,
        /// Its length.
        found: usize,
        /// The number of positions.
        points: usize,
    },
    /// An index that no point has.
    #[error("{place} names point {point}, but there are {points} points")]
    NoSuchPoint {
        /// The bond or the pin.
        place: String,
        /// The index.
        point: u32,
        /// The number of points.
        points: usize,
    },
    /// A number outside its range.
    #[error("{place} is {value}: it must be {range}")]
    OutOfRange {
        /// What the number is of.
        place: String,
        /// The number.
        value: String,
        /// Its range in words.
        range: &'static str,
    },
    /// A bond between a point and itself.
    #[error("bond {bond} joins point {point} to itself")]
    Loop {
        /// The bond.
        bond: usize,
        /// The point.
        point: u32,
    },
    /// Something of the plane in space.
    #[error("`{what}` is of the plane: leave it out in space")]
    Planar {
        /// What it is.
        what: &'static str,
    },
    /// A solver that does not meet balls and boxes in space.
    #[error("solver {solver} does not meet balls and boxes in space: leave `solver` out")]
    NoConvex {
        /// The solver.
        solver: Solver,
    },
    /// Something that the loop of a source has not.
    #[error("the loop of source {of} has no {what}: leave that out, or use another solver")]
    NotPrinted {
        /// What it is.
        what: &'static str,
        /// The source.
        of: Source,
    },
    /// A solver by which bodies cannot meet.
    #[error("solver {solver} knows no contact: leave `solver` out")]
    NoContact {
        /// The solver.
        solver: Solver,
    },
    /// A solver that knows no angles or no areas.
    #[error("solver {solver} knows no {what}: use {others}")]
    NoForm {
        /// "angles" or "areas".
        what: &'static str,
        /// The solver.
        solver: Solver,
        /// Solvers that would do.
        others: &'static str,
    },
    /// More areas to be held, with rigid bonds, than are solved together.
    #[error(
        "`areas` are rigid in a body of {found} rigid bonds and areas: give `stiffness`, or hold no more than {most}"
    )]
    TooManyHeld {
        /// How many there are.
        found: usize,
        /// How many are solved together.
        most: usize,
    },
    /// Areas that are held, for which no equilibrium is looked for.
    #[error("an equilibrium is not looked for with rigid `areas`: give a `stiffness`")]
    HeldAreas,
    /// A tolerance where bodies meet.
    #[error("no tolerance is held to where bodies meet, or among balls and boxes: leave `tolerance` out")]
    Unbounded,
    /// A surface that pushes by depth, under a method or in a scene that knows none.
    #[error("`penalty` is not known to {what}: leave one of them out")]
    NoPenalty {
        /// What does not know it.
        what: &'static str,
    },
    /// A bond that has no error, where a tolerance is asked for.
    #[error("bond {bond} is relaxed: it is defined by its sweeps and has no error to bound: leave `tolerance` out")]
    NoError {
        /// The bond.
        bond: usize,
    },
    /// A bond that has no energy, where an equilibrium is asked for.
    #[error("bond {bond} is relaxed and has no energy to settle: make it a spring or rigid")]
    NoEnergy {
        /// The bond.
        bond: usize,
    },
    /// A drive that its bond or angle cannot have.
    #[error("{place}: {why}")]
    Drive {
        /// The bond or the angle.
        place: String,
        /// What is wrong, and what to do.
        why: String,
    },
    /// Outlines of obstacles that cross so often that they are no drawing.
    #[error("the outlines of the polygons cross each other or themselves more than 200000 times: make them simpler")]
    Crossings,
    /// Obstacles among which no equilibrium is looked for.
    #[error("an equilibrium is not looked for among polygons, balls and boxes: leave them out")]
    Polygons,
    /// Bodies that meet, for which no equilibrium is looked for.
    #[error("an equilibrium is not looked for where bodies meet: leave `contact` out")]
    Meets,
    /// A solver and a kind of bond that do not go together.
    #[error("bond {bond} is {kind}, which solver {solver} refuses: use {others}")]
    Refused {
        /// The bond.
        bond: usize,
        /// Its kind.
        kind: &'static str,
        /// The solver.
        solver: Solver,
        /// Solvers that would do.
        others: &'static str,
    },
}

impl<const D: usize> Model<D> {
    /// Whether a world can be made of this: lists of one length, indices that exist, numbers in range.
    ///
    /// Errors: the first thing that is wrong.
    pub fn check(&self) -> Result<(), ModelError> {
        self.check_points()?;
        for (i, bond) in self.bonds.iter().enumerate() {
            self.check_bond(i, &bond)?;
        }
        for (i, corners) in self.triangles.iter().enumerate() {
            for &corner in corners {
                self.check_index(|| format!("triangle {i}"), corner)?;
            }
            check_triangle(i, *corners)?;
        }
        self.check_form()?;
        for &pin in &self.pinned {
            self.check_index(|| "pinned".to_owned(), pin)?;
        }
        for (point, _) in &self.pin_motion {
            self.check_index(|| "pin_motion".to_owned(), *point)?;
        }
        for (i, force) in self.forces.iter().enumerate() {
            for &point in &force.points {
                self.check_index(|| format!("force {i}"), point)?;
            }
        }
        self.check_surroundings()
    }

    /// The same of all but points and bonds.
    pub(crate) fn check_surroundings(&self) -> Result<(), ModelError> {
        let is_borne = self.gravity.iter().all(|g| g.abs() <= MOST_GRAVITY);
        require(is_borne, "gravity", self.gravity, "from -1e9 to 1e9 m/s^2")?;
        require(self.drag_rate >= 0.0 && self.drag_rate.is_finite(), "drag_rate", self.drag_rate, "finite and >= 0")?;
        if let Some(Wind { velocity, turbulence, .. }) = self.wind {
            require(velocity.iter().all(|u| u.is_finite()), "wind.velocity", velocity, "finite")?;
            let is_fine = turbulence >= 0.0 && turbulence.is_finite();
            require(is_fine, "wind.turbulence", turbulence, "finite and >= 0")?;
        }
        for (i, force) in self.forces.iter().enumerate() {
            check_force(i, force)?;
        }
        for (material, _) in self.skins.lists() {
            let range = "of friction and radius finite and >= 0, restitution from 0 to 1";
            require(material.is_fine(), "the material of a skin", material, range)?;
        }
        if D == 3 && !self.skins.is_empty() {
            return Err(ModelError::Planar { what: "skins" });
        }
        self.check_contact()?;
        if let Some(h) = self.method.substep {
            require((SHORTEST..f64::INFINITY).contains(&h), "substep", h, "finite and at least 1e-12")?;
        }
        if let Some(sweeps) = self.method.iterations {
            require((1..=MOST_ITERATIONS).contains(&sweeps), "iterations", sweeps, "from 1 to 100000")?;
        }
        if let Some(ms) = self.method.budget {
            require(ms > 0.0 && ms.is_finite(), "budget", ms, "finite and > 0")?;
        }
        if let Some(t) = self.duration {
            require(t >= 0.0 && t.is_finite(), "duration", t, "finite and >= 0")?;
        }
        if let Some(bounds) = &self.bounds {
            let is_box =
                (0..D).all(|k| bounds.min[k].is_finite() && bounds.max[k].is_finite() && bounds.min[k] < bounds.max[k]);
            require(is_box, "bounds.min", bounds.min, "finite and below bounds.max")?;
        }
        for (i, plane) in self.planes.iter().enumerate() {
            let is_fine = plane.point.iter().chain(&plane.normal).all(|c| c.is_finite())
                && plane.normal.iter().any(|&n| n != 0.0);
            require(is_fine, &format!("plane {i}"), plane, "finite, with a normal that is not zero")?;
            let is_fine = plane.penalty.is_none_or(|penalty| penalty.is_fine());
            let numbers = plane.penalty.map_or([0.0; 2], |penalty| [penalty.stiffness, penalty.damping]);
            let place = format!("the `stiffness` and `damping` of the penalty of plane {i}");
            require(is_fine, &place, numbers, "finite and >= 0")?;
        }
        self.check_penalties()?;
        for (i, polygon) in self.polygons.iter().enumerate() {
            let is_fine = D == 2
                && polygon.loops.iter().all(|outline| outline.len() >= 3)
                && polygon.loops.iter().flatten().flatten().all(|c| c.is_finite());
            require(is_fine, &format!("polygon {i}"), polygon, "in the plane, of three finite corners or more")?;
        }
        for (i, convex) in self.convex.iter().enumerate() {
            let range = "in space, finite, of a radius > 0, or with min below max and an axis that is not zero";
            require(D == 3 && convex.figure.is_fine(), &format!("ball or box {i}"), convex, range)?;
        }
        for (point, track) in &self.pin_motion {
            require(self.pinned.contains(point), "pin_motion", point, "of a pinned point")?;
            let ascends = track.knots.windows(2).all(|pair| pair[0].0 < pair[1].0);
            require(ascends, "pin_motion", point, "along times that ascend")?;
        }
        if let Some(mouse) = &self.mouse {
            require(mouse.radius > 0.0 && mouse.radius.is_finite(), "mouse.radius", mouse.radius, "finite and > 0")?;
            require(mouse.strength.is_finite(), "mouse.strength", mouse.strength, "finite")?;
        }
        Ok(())
    }

    fn check_penalties(&self) -> Result<(), ModelError> {
        let what = match self.method.solver {
            _ if !self.has_penalties() => return Ok(()),
            _ if self.contact.is_some() => "`contact`",
            _ if !self.convex.is_empty() => "boxes and balls in space",
            _ if self.method.tolerance.is_some() => "`tolerance`",
            Solver::ImplicitMidpoint | Solver::BackwardEuler => "implicit solvers",
            Solver::Flight | Solver::Path | Solver::Live | Solver::AsPrinted(_) => "this solver",
            _ => return Ok(()),
        };
        Err(ModelError::NoPenalty { what })
    }

    fn check_contact(&self) -> Result<(), ModelError> {
        self.check_printed()?;
        let solver = self.method.solver;
        if !self.convex.is_empty() {
            match solver {
                Solver::AsPrinted(_) => {}
                Solver::Auto | Solver::Live if self.method.tolerance.is_some() => return Err(ModelError::Unbounded),
                Solver::Auto | Solver::Live => {}
                solver => return Err(ModelError::NoConvex { solver }),
            }
        }
        let Some(contact) = &self.contact else { return Ok(()) };
        let Contact { friction, restitution, radius, .. } = *contact;
        require(friction >= 0.0 && friction.is_finite(), "contact.friction", friction, "finite and >= 0")?;
        require((0.0..=1.0).contains(&restitution), "contact.restitution", restitution, "from 0 to 1")?;
        let is_size = |radius: f64| radius >= 0.0 && radius.is_finite();
        require(radius.is_none_or(is_size), "contact.radius", radius.unwrap_or_default(), "finite and >= 0")?;
        match solver {
            Solver::Auto | Solver::Live if self.method.tolerance.is_some() => Err(ModelError::Unbounded),
            Solver::Auto | Solver::Live => Ok(()),
            solver => Err(ModelError::NoContact { solver }),
        }
    }

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

    fn check_points(&self) -> Result<(), ModelError> {
        let points = self.position.len();
        for (list, found) in [("velocity", self.velocity.len()), ("mass", self.mass.len())] {
            if found != points {
                return Err(ModelError::Length { list, found, points });
            }
        }
        for i in 0..points {
            let (x, v, m) = (self.position[i], self.velocity[i], self.mass[i]);
            if !(x.iter().chain(&v).all(|c| c.is_finite()) && m > 0.0 && m.is_finite() && (1.0 / m).is_finite()) {
                require(x.iter().all(|c| c.is_finite()), &format!("position {i}"), x, "finite")?;
                require(v.iter().all(|c| c.is_finite()), &format!("velocity {i}"), v, "finite")?;
                require(false, &format!("mass {i}"), m, "finite, > 0, and not too small to divide by")?;
            }
        }
        Ok(())
    }

    fn check_bond(&self, i: usize, bond: &Bond) -> Result<(), ModelError> {
        self.check_index(|| format!("bond {i}"), bond.a)?;
        self.check_index(|| format!("bond {i}"), bond.b)?;
        self.check_added_bond(i, bond)
    }

    /// Whether a bond between points that are there is one that this model can have.
    pub(crate) fn check_added_bond(&self, i: usize, bond: &Bond) -> Result<(), ModelError> {
        if bond.a == bond.b {
            return Err(ModelError::Loop { bond: i, point: bond.a.0 });
        }
        let solver = self.method.solver;
        if let Some((kind, others)) = solver.refusal(bond.kind) {
            return Err(ModelError::Refused { bond: i, kind, solver, others });
        }
        self.check_printed_bond(bond)?;
        let in_range = |value: f64| value >= 0.0 && value.is_finite();
        let fine = in_range(bond.rest_length)
            && bond.break_strain > 0.0
            && match bond.kind {
                BondKind::Rigid => true,
                BondKind::Spring { stiffness, damping } => in_range(stiffness) && in_range(damping),
                BondKind::Relaxed { relaxation, max_correction } => {
                    relaxation > 0.0 && relaxation <= 1.0 && max_correction >= 0.0
                }
            };
        self.check_drive(i, bond)?;
        if fine { Ok(()) } else { require(false, &format!("bond {i}"), bond, "of numbers in their ranges") }
    }

    fn check_index(&self, place: impl Fn() -> String, point: PointId) -> Result<(), ModelError> {
        if point.index() < self.position.len() {
            return Ok(());
        }
        Err(ModelError::NoSuchPoint { place: place(), point: point.0, points: self.position.len() })
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

/// Errors: two corners of triangle `i` are one.
pub(crate) fn check_triangle(i: usize, [a, b, c]: [PointId; 3]) -> Result<(), ModelError> {
    let differ = a != b && b != c && c != a;
    if differ { Ok(()) } else { require(false, &format!("triangle {i}"), [a.0, b.0, c.0], "of three points") }
}

/// Errors: force `i` has no point, a number that is not finite, or a torque in space.
pub(crate) fn check_force<const D: usize>(i: usize, force: &Force<D>) -> Result<(), ModelError> {
    let is_fine = force.force.iter().all(|f| f.is_finite()) && force.torque.is_finite();
    require(is_fine, &format!("force {i}"), (force.force, force.torque), "finite")?;
    require(!force.points.is_empty(), &format!("force {i}"), "on no point", "on one point or more")?;
    if D == 2 || force.torque == 0.0 { Ok(()) } else { Err(ModelError::Planar { what: "torque" }) }
}

fn require(fine: bool, place: &str, value: impl std::fmt::Debug, range: &'static str) -> Result<(), ModelError> {
    if fine {
        return Ok(());
    }
    Err(ModelError::OutOfRange { place: place.to_owned(), value: format!("{value:?}"), range })
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
