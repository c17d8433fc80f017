//! Friction: points stick where they touch rough surfaces, as long as friction can hold them.
//!
//! With friction many shapes are at rest; which one is found hangs on the way there. A point sticks where it comes to touch
//! and nothing pulls it along the surface but what friction answers. When all is at rest, those that are pulled by more
//! than friction times what presses slip: friction goes on against that pull, at its limit. So the shape that is found is
//! at rest by Coulomb's law.

use super::descent::Descent;
use super::hold::{Grip, Hold};
use super::part::{Part, extent};
use super::system::{GRIP, Step};
use crate::sim::vector::{add, dot, length, scale, sub};

/// Gap within which a point that presses touches, as a share of the extent.
const TOUCH: f64 = 1e-6;
/// Share of the largest friction by which any may be off its limit.
const SLACK: f64 = 1e-10;
/// Way back in a round, as a share of the extent, that is no mere give of what holds a point.
const BACK: f64 = 1e-3;
/// Times that a point may stick anew, to one surface. Those that come and go for ever then do so without friction, which
/// Coulomb's law allows as well.
const MOST_TURNS: u32 = 20;

/// How a point is on a rough surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// It does not touch.
    Off,
    /// It stays where it is, by any force along the surface.
    Sticks,
    /// Friction is at its limit.
    Slips,
}

/// A point and a rough surface.
#[derive(Clone, Debug)]
pub(super) struct Rub<const D: usize> {
    /// Place among the holds of the one that keeps the point out.
    hold: usize,
    pub(super) point: usize,
    normal: [f64; D],
    friction: f64,
    state: State,
    /// What friction takes from the force on the point `[N]`; 0 where it is off.
    pub(super) force: [f64; D],
    /// Times that it came to stick.
    turns: u32,
}

/// All pairs of a free point and a rough surface.
pub(super) fn rubs<const D: usize>(part: &Part<D>) -> Vec<Rub<D>> {
    let rub = |(hold, of): (usize, &Hold)| match of.grip {
        Grip::Surface { point, surface } if part.surfaces[surface].friction > 0.0 => {
            let surface = &part.surfaces[surface];
            let (normal, friction) = (surface.normal, surface.friction);
            Some(Rub { hold, point, normal, friction, state: State::Off, force: [0.0; D], turns: 0 })
        }
        _ => None,
    };
    part.holds.iter().enumerate().filter_map(rub).collect()
}

impl<const D: usize> Rub<D> {
    /// The part of a vector along the surface.
    fn along(&self, v: [f64; D]) -> [f64; D] {
        sub(v, scale(self.normal, dot(v, self.normal)))
    }

    /// How firmly it sticks `[N/m]`.
    fn grip(&self, firm: f64) -> f64 {
        if self.state == State::Sticks { GRIP * firm } else { 0.0 }
    }

    /// Its block of the matrix `[N/m]`.
    pub(super) fn block(&self, firm: f64) -> [[f64; D]; D] {
        let grip = self.grip(firm);
        std::array::from_fn(|k| {
            let axis = std::array::from_fn(|j| f64::from(u8::from(j == k)));
            scale(self.along(axis), grip)
        })
    }

    /// The force when the point has moved by `displacement` `[N]`.
    pub(super) fn force_after(&self, displacement: [f64; D], firm: f64) -> [f64; D] {
        add(self.force, scale(self.along(displacement), self.grip(firm)))
    }

    /// What it adds to the merit when the point has moved by `displacement` `[J]`.
    pub(super) fn work(&self, displacement: [f64; D], firm: f64) -> f64 {
        let along = self.along(displacement);
        dot(self.force, displacement) + 0.5 * self.grip(firm) * dot(along, along)
    }
}

impl<const D: usize> Descent<D> {
    /// Points that press and touch stick, and those that no longer press are off.
    pub(super) fn touch(&mut self) {
        let near = TOUCH * extent(&self.x);
        for rub in &mut self.rubs {
            let hold = &self.holds[rub.hold];
            if !hold.is_active {
                (rub.state, rub.force) = (State::Off, [0.0; D]);
            } else if rub.state == State::Off
                && rub.turns < MOST_TURNS
                && hold.off(&self.part.surfaces, &self.x).value.abs() <= near
            {
                rub.state = State::Sticks;
                rub.turns += 1;
            }
        }
    }

    /// Points that slip and would go where friction drags them stick again. Returns whether any does.
    pub(super) fn turn(&mut self, step: &Step<D>) -> bool {
        let most = BACK * extent(&self.x);
        let mut changed = false;
        for rub in self.rubs.iter_mut().filter(|rub| rub.state == State::Slips && rub.turns < MOST_TURNS) {
            if dot(rub.force, step.displacement[rub.point]) < -most * length(rub.force) {
                (rub.state, changed) = (State::Sticks, true);
                rub.turns += 1;
            }
        }
        changed
    }

    /// Friction that is at its limit, or would be beyond it, is set to that of the pressure that a step leads to. Returns
    /// whether any was off by more than rounding: then it is not at rest yet.
    pub(super) fn slip(&mut self, step: &Step<D>) -> bool {
        let limit = |rub: &Rub<D>| rub.friction * step.lambda[rub.hold].abs();
        let slack = SLACK * self.rubs.iter().map(limit).fold(0.0, f64::max);
        let mut changed = false;
        for (rub, &force) in self.rubs.iter_mut().zip(&step.rubs) {
            let (size, most) = (length(force), limit(rub));
            let is_off = match rub.state {
                State::Off => false,
                State::Sticks => size > most + slack,
                State::Slips => (size - most).abs() > slack,
            };
            if is_off && size > 0.0 {
                (rub.state, rub.force) = (State::Slips, scale(force, most / size));
                changed = true;
            }
        }
        changed
    }
}
