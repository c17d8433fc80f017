//! Angles and areas of a model: whether they are in order, and what is not said of them.

use super::check::require;
use super::{Model, ModelError};
use crate::sim::bond::{Lengths, PointId};
use crate::sim::force::angle::{Angle, Angles, measured};
use crate::sim::force::area::{self, Areas};
use crate::sim::sets::Sets;
use crate::sim::vector::{dot, length, sub};

/// How far a joint goes beyond its range at most `[rad]`, under what its body can bring up by itself. One that is made so near to a stop
/// of it is at that stop.
const MOST_BEYOND: f64 = 0.005;
/// Least oscillation of a joint beyond its range `[rad/s]`, where nothing says what will press it.
const SLOWEST_STOP: f64 = 200.0;

/// The area that a triangle between these places is made with `[m^2]`; 0 of what has no inside.
fn made<const D: usize>(lengths: &Lengths, [a, b, c]: [PointId; 3], places: [[f64; D]; 3]) -> f64 {
    let sides = [[a, b], [b, c], [c, a]].map(|ends| lengths.between(ends));
    area::rest(places, sides).unwrap_or(0.0)
}

impl<const D: usize> Model<D> {
    /// Errors: angles or areas that are none.
    pub(super) fn check_form(&self) -> Result<(), ModelError> {
        let mut last = None;
        for angle in &self.angles.list {
            let number = angle.number;
            require(last < Some(number) && number < self.angles.next, "angle", number, "numbered upwards")?;
            last = Some(number);
            for point in angle.points {
                self.check_index(|| format!("angle {number}"), point)?;
            }
            self.check_angle(angle)?;
        }
        if let Some(rest) = self.rest_areas.iter().find(|rest| !(**rest >= 0.0 && rest.is_finite())) {
            require(false, "rest_areas", rest, "finite and >= 0")?;
        }
        self.check_areas()
    }

    /// Whether an angle between points that are there is one that this model can have.
    pub(crate) fn check_angle(&self, angle: &Angle) -> Result<(), ModelError> {
        if D != 2 {
            return Err(ModelError::Planar { what: "angles" });
        }
        let place = format!("angle {}", angle.number);
        let [i, j, k] = angle.points;
        require(i != j && j != k && k != i, &place, [i.0, j.0, k.0], "of three points")?;
        let turn = 2.0 * std::f64::consts::PI;
        require(angle.rest > 0.0 && angle.rest < turn, &place, angle.rest, "at rest between 0 and 2 pi")?;
        let at_least_0 = |x: f64| x >= 0.0 && x.is_finite();
        let numbers = [angle.stiffness, angle.damping, angle.stop];
        require(numbers.into_iter().all(at_least_0), &place, angle, "of numbers that are finite and >= 0")?;
        let is_range = |[least, most]: [f64; 2]| least.is_finite() && least < most && most - least < turn;
        let range = angle.range.unwrap_or_default();
        require(angle.range.is_none_or(is_range), &place, range, "within min < max, less than a turn apart")?;
        let is_arm = |arm: f64| arm > 0.0 && arm.is_finite();
        require(angle.arms.into_iter().all(is_arm), &place, angle.arms, "between arms that have a length")?;
        self.check_angle_drive(angle)?;
        self.method
            .solver
            .form_refusal()
            .map_or(Ok(()), |others| Err(ModelError::NoForm { what: "angles", solver: self.method.solver, others }))
    }

    /// Errors: areas that are none.
    pub(crate) fn check_areas(&self) -> Result<(), ModelError> {
        let Some(Areas { stiffness, least }) = self.areas else { return Ok(()) };
        if D != 2 {
            return Err(ModelError::Planar { what: "areas" });
        }
        require(stiffness >= 0.0, "areas.stiffness", stiffness, ">= 0")?;
        require((0.0..1.0).contains(&least), "areas.least", least, "from 0 to below 1")?;
        match self.method.solver.form_refusal() {
            Some(others) if stiffness > 0.0 => {
                Err(ModelError::NoForm { what: "areas", solver: self.method.solver, others })
            }
            _ => Ok(()),
        }
    }

    /// Triangles whose areas are forces or kept, with those areas `[m^2]`.
    pub(crate) fn patches(&self) -> impl Iterator<Item = ([PointId; 3], f64)> {
        let resist = self.areas.is_some_and(|areas| areas.stiffness > 0.0);
        let of = move |(corners, rest): (&[PointId; 3], &f64)| (resist && *rest > 0.0).then_some((*corners, *rest));
        self.triangles.iter().zip(&self.rest_areas).filter_map(of)
    }

    /// The points of all angles, and of all triangles whose areas are forces or kept: each three hang together.
    pub(crate) fn ties(&self) -> impl Iterator<Item = [PointId; 3]> {
        self.angles.list.iter().map(|angle| angle.points).chain(self.patches().map(|(corners, _)| corners))
    }

    /// Energy of angles and areas `[J]`; `stops`: whether the joint at a point stops by a spring, not at once as in the live step.
    pub(crate) fn form_energy(&self, position: impl Fn(usize) -> [f64; D], stops: impl Fn(usize) -> bool) -> f64 {
        self.form_energy_of(|_| true, position, stops)
    }

    /// The same, of angles and of areas.
    pub(crate) fn form_energies(
        &self,
        position: impl Fn(usize) -> [f64; D],
        stops: impl Fn(usize) -> bool,
    ) -> [f64; 2] {
        self.form_energies_of(|_| true, position, stops)
    }

    /// The same of those alone whose three points `counts` names.
    pub(crate) fn form_energy_of(
        &self,
        counts: impl Fn(&[PointId; 3]) -> bool,
        position: impl Fn(usize) -> [f64; D],
        stops: impl Fn(usize) -> bool,
    ) -> f64 {
        self.form_energies_of(counts, position, stops).into_iter().sum()
    }

    fn form_energies_of(
        &self,
        counts: impl Fn(&[PointId; 3]) -> bool,
        position: impl Fn(usize) -> [f64; D],
        stops: impl Fn(usize) -> bool,
    ) -> [f64; 2] {
        use crate::sim::force::angle::Hinge;
        use crate::sim::force::area::Patch;
        let at = |points: [PointId; 3]| points.map(|point| position(point.index()));
        let hinge = |angle: &Angle| {
            let hinge = Hinge::<f64>::new(angle, [0, 1, 2]);
            let x = at(angle.points);
            if stops(angle.points[1].index()) { hinge.energy(x) } else { hinge.energy_within(x) }
        };
        let stiffness = self.areas.map_or(0.0, |areas| areas.stiffness);
        let patch = |(corners, rest)| Patch { corners: [0, 1, 2], rest, stiffness }.energy(at(corners));
        let is_elastic = stiffness > 0.0 && stiffness.is_finite();
        let areas = self.patches().filter(|(corners, _)| is_elastic && counts(corners)).map(patch).sum::<f64>();
        let angles = self.angles.list.iter().filter(|angle| counts(&angle.points)).map(hinge).sum::<f64>();
        // A sum of nothing may be a zero with a sign.
        [angles + 0.0, areas + 0.0]
    }

    /// Whether the areas of triangles at rest have to be known: where they resist, and where bodies meet, which are not to turn inside out.
    pub(crate) fn needs_areas(&self) -> bool {
        self.areas.is_some() || (D == 2 && self.contact.is_some())
    }

    /// What is not said of angles and areas, if something is missing: areas at rest and how hard joints stop.
    pub(crate) fn form_missing(&self) -> Option<(Vec<f64>, Angles)> {
        let has_areas = !self.needs_areas() || self.rest_areas.len() == self.triangles.len();
        let is_open = |angle: &Angle| angle.range.is_some() && angle.stop == 0.0;
        if has_areas && !self.angles.list.iter().any(is_open) {
            return None;
        }
        let mut angles = self.angles.clone();
        self.stop(&mut angles.list);
        Some((self.areas_at_rest(), angles))
    }

    /// The area of every triangle at rest `[m^2]`, 0 of one that has no inside; none where nobody needs them.
    pub fn areas_at_rest(&self) -> Vec<f64> {
        if !self.needs_areas() {
            return Vec::new();
        }
        let lengths = Lengths::of(self.bonds.iter().map(|bond| ([bond.a, bond.b], bond.rest_length)));
        let of = |corners: &[PointId; 3]| made(&lengths, *corners, corners.map(|corner| self.position[corner.index()]));
        self.triangles.iter().map(of).collect()
    }

    /// Works out how hard joints stop that do not say it.
    ///
    /// Model: what hangs together of mass M and extent R can bring up the energy E = 2 M (g + a) R + M v^2/2 by itself, with the
    /// acceleration a of the mouse force and the largest speed v; a spring of stiffness 2 E/e^2 takes it within e. A joint that stands
    /// beyond its range by no more than e, as one that rests against a stop does, has its stop there: copies and what is opened again
    /// begin without a push.
    fn stop(&self, angles: &mut [Angle]) {
        let mut is_free = vec![true; self.position.len()];
        self.pinned.iter().for_each(|pin| is_free[pin.index()] = false);
        let mut sets = Sets::new(is_free.len());
        let mut join = |a: PointId, b: PointId| {
            if is_free[a.index()] && is_free[b.index()] {
                sets.join(a.0, b.0);
            }
        };
        self.bonds.ends().iter().for_each(|&[a, b]| join(a, b));
        self.ties().for_each(|[a, b, c]| {
            join(a, b);
            join(b, c);
        });
        let pushed = self.mouse.as_ref().map_or(0.0, |mouse| mouse.strength.abs() * mouse.radius);
        let pull = length(self.gravity) + pushed;
        for angle in angles.iter_mut().filter(|angle| angle.range.is_some() && angle.stop == 0.0) {
            angle.reach(angle.points.map(|point| self.position[point.index()]), MOST_BEYOND);
            let Some(free) = angle.points.into_iter().find(|point| is_free[point.index()]) else {
                // Between pins nothing presses it.
                angle.stop = 1.0;
                continue;
            };
            let own = sets.find(free.0);
            let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
            let (mut mass, mut fastest) = (0.0, 0.0_f64);
            for i in 0..is_free.len() {
                let is_member = is_free[i] && sets.find(i as u32) == own;
                if !is_member && !angle.points.contains(&PointId(i as u32)) {
                    continue;
                }
                let x = self.position[i];
                (0..D).for_each(|k| (low[k], high[k]) = (low[k].min(x[k]), high[k].max(x[k])));
                if is_member {
                    mass += self.mass[i];
                    fastest = fastest.max(dot(self.velocity[i], self.velocity[i]));
                }
            }
            let energy = 2.0 * mass * pull * length(sub(high, low)) + 0.5 * mass * fastest;
            let [p, q] = angle.arms;
            let w = |n: usize| {
                if is_free[angle.points[n].index()] { 1.0 / self.mass[angle.points[n].index()] } else { 0.0 }
            };
            let both = 1.0 / p + 1.0 / q;
            let light = w(0) / (p * p) + w(1) * both * both + w(2) / (q * q);
            let least = if light > 0.0 { SLOWEST_STOP * SLOWEST_STOP / light } else { 1.0 };
            let spring = angle.stiffness * 2.0 * std::f64::consts::PI / MOST_BEYOND;
            angle.stop = least.max(spring).max(2.0 * energy / (MOST_BEYOND * MOST_BEYOND)).min(f64::MAX);
        }
    }
}

/// An angle between places, as it is made: what is not said of it is as it stands there.
pub fn angle_at<const D: usize>(points: [PointId; 3], places: [[f64; D]; 3]) -> Angle {
    let (rest, arms) = measured(places);
    Angle { number: 0, points, rest, stiffness: 0.0, damping: 0.0, range: None, arms, stop: 0.0, drive: None }
}
