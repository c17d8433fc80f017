//! The state of the points, as structure of arrays.

use super::real::Real;

/// Positions and velocities of all points, and what one substep needs beside them.
///
/// Position and velocity are kept apart, both at the time reached, so that a substep can be cut anywhere; nothing is
/// ever formed as 2x - x_prev, which in `f32` loses gravity altogether at 100 m.
/// Shapes: every list has one entry a point, but those that this scene doesn't use, which are empty.
#[derive(Clone, Debug)]
pub(crate) struct Points<S: Real, const D: usize> {
    /// x `[m]`.
    pub(crate) position: Vec<[S; D]>,
    /// v `[m/s]`.
    pub(crate) velocity: Vec<[S; D]>,
    /// w = 1/m `[1/kg]`; 0 = pinned.
    pub(crate) inverse_mass: Vec<S>,
    /// What rounding has taken from `position` so far `[m]` (Kahan).
    pub(crate) position_lost: Vec<[S; D]>,
    /// What rounding has taken from `velocity` so far `[m/s]` (Kahan).
    pub(crate) velocity_lost: Vec<[S; D]>,
    /// Acceleration by springs and the mouse `[m/s^2]`, without gravity; only in scenes that have either.
    pub(crate) acceleration: Vec<[S; D]>,
    /// Velocity in the middle of the substep `[m/s]`, for dampers; only in scenes that have them.
    pub(crate) velocity_ahead: Vec<[S; D]>,
    /// Displacement of the substep under way `[m]`; only in scenes that project or have walls.
    pub(crate) displacement: Vec<[S; D]>,
}

impl<S: Real, const D: usize> Points<S, D> {
    /// Points in this state of motion; lists that only some scenes need are empty.
    pub(crate) fn new(state: State<S, D>, inverse_mass: Vec<S>) -> Self {
        Points {
            position: state.position,
            velocity: state.velocity,
            inverse_mass,
            position_lost: state.position_lost,
            velocity_lost: state.velocity_lost,
            acceleration: Vec::new(),
            velocity_ahead: Vec::new(),
            displacement: Vec::new(),
        }
    }

    /// Bytes that the lists take.
    pub(crate) fn heap_bytes(&self) -> usize {
        let Points {
            position, velocity, position_lost, velocity_lost, acceleration, velocity_ahead, displacement, ..
        } = self;
        let lists = [position, velocity, position_lost, velocity_lost, acceleration, velocity_ahead, displacement];
        let vectors: usize = lists.map(|list| list.capacity() * size_of::<[S; D]>()).iter().sum();
        vectors + self.inverse_mass.capacity() * size_of::<S>()
    }

    pub(crate) fn len(&self) -> usize {
        self.position.len()
    }

    /// Copies the state of motion.
    pub(crate) fn save(&self, to: &mut State<S, D>) {
        copy(&self.position, &mut to.position);
        copy(&self.velocity, &mut to.velocity);
        copy(&self.position_lost, &mut to.position_lost);
        copy(&self.velocity_lost, &mut to.velocity_lost);
    }

    /// Goes back to a copy.
    pub(crate) fn restore(&mut self, from: &State<S, D>) {
        copy(&from.position, &mut self.position);
        copy(&from.velocity, &mut self.velocity);
        copy(&from.position_lost, &mut self.position_lost);
        copy(&from.velocity_lost, &mut self.velocity_lost);
    }

    /// What is free stands still.
    pub(crate) fn stop(&mut self) {
        for i in (0..self.velocity.len()).filter(|&i| self.inverse_mass[i] != S::ZERO) {
            (self.velocity[i], self.velocity_lost[i]) = ([S::ZERO; D], [S::ZERO; D]);
        }
    }
}

/// Copies a list over one that has its length already, but for the first time.
#[inline(always)]
fn copy<S: Real, const D: usize>(from: &[[S; D]], to: &mut Vec<[S; D]>) {
    if to.len() == from.len() { to.copy_from_slice(from) } else { *to = from.to_vec() }
}

/// A state of motion: what a step changes and a step can be taken back to.
#[derive(Clone, Debug, Default)]
pub(crate) struct State<S, const D: usize> {
    pub(crate) position: Vec<[S; D]>,
    pub(crate) velocity: Vec<[S; D]>,
    pub(crate) position_lost: Vec<[S; D]>,
    pub(crate) velocity_lost: Vec<[S; D]>,
}
