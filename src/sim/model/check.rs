//! Whether a world can be made of a model: lists of one length, indices that exist, numbers in range, and a method that can move it.

use super::{MOST_GRAVITY, MOST_ITERATIONS, Model, ModelError};
use crate::sim::bond::{Bond, BondKind, PointId};
use crate::sim::contact::skin::Contact;
use crate::sim::force::steady::Force;
use crate::sim::force::wind::Wind;
use crate::sim::solver::Solver;

/// Shortest substep `[s]`: a run of shorter ones would not end in a lifetime.
const SHORTEST: f64 = 1e-12;

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
        self.check_fields()?;
        self.check_skins()?;
        self.check_contact()?;
        self.check_method()?;
        self.check_bounds()?;
        self.check_planes()?;
        self.check_penalties()?;
        self.check_solids()?;
        self.check_tracks()?;
        self.check_mouse()
    }

    /// Gravity, air and constant forces.
    fn check_fields(&self) -> Result<(), ModelError> {
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
        Ok(())
    }

    fn check_skins(&self) -> Result<(), ModelError> {
        for (material, _) in self.skins.lists() {
            let range = "of friction and radius finite and >= 0, restitution from 0 to 1";
            require(material.is_fine(), "the material of a skin", material, range)?;
        }
        if D == 3 && !self.skins.is_empty() {
            return Err(ModelError::Planar { what: "skins" });
        }
        Ok(())
    }

    /// Substep, sweeps and budget, and when the motion ends.
    fn check_method(&self) -> Result<(), ModelError> {
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
        Ok(())
    }

    fn check_bounds(&self) -> Result<(), ModelError> {
        if let Some(bounds) = &self.bounds {
            let is_box =
                (0..D).all(|k| bounds.min[k].is_finite() && bounds.max[k].is_finite() && bounds.min[k] < bounds.max[k]);
            require(is_box, "bounds.min", bounds.min, "finite and below bounds.max")?;
        }
        Ok(())
    }

    fn check_planes(&self) -> Result<(), ModelError> {
        for (i, plane) in self.planes.iter().enumerate() {
            let is_fine = plane.point.iter().chain(&plane.normal).all(|c| c.is_finite())
                && plane.normal.iter().any(|&n| n != 0.0);
            require(is_fine, &format!("plane {i}"), plane, "finite, with a normal that is not zero")?;
            let is_fine = plane.penalty.is_none_or(|penalty| penalty.is_fine());
            let numbers = plane.penalty.map_or([0.0; 2], |penalty| [penalty.stiffness, penalty.damping]);
            let place = format!("the `stiffness` and `damping` of the penalty of plane {i}");
            require(is_fine, &place, numbers, "finite and >= 0")?;
        }
        Ok(())
    }

    /// Polygons in the plane, balls and boxes in space.
    fn check_solids(&self) -> Result<(), ModelError> {
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
        Ok(())
    }

    fn check_tracks(&self) -> Result<(), ModelError> {
        for (point, track) in &self.pin_motion {
            require(self.pinned.contains(point), "pin_motion", point, "of a pinned point")?;
            let ascends = track.knots.windows(2).all(|pair| pair[0].0 < pair[1].0);
            require(ascends, "pin_motion", point, "along times that ascend")?;
        }
        Ok(())
    }

    fn check_mouse(&self) -> Result<(), ModelError> {
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

    pub(super) fn check_index(&self, place: impl Fn() -> String, point: PointId) -> Result<(), ModelError> {
        if point.index() < self.position.len() {
            return Ok(());
        }
        Err(ModelError::NoSuchPoint { place: place(), point: point.0, points: self.position.len() })
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

pub(super) fn require(
    fine: bool,
    place: &str,
    value: impl std::fmt::Debug,
    range: &'static str,
) -> Result<(), ModelError> {
    if fine {
        return Ok(());
    }
    Err(ModelError::OutOfRange { place: place.to_owned(), value: format!("{value:?}"), range })
}
