//! One substep of a world, phase by phase.

use super::constrain::{relaxed, rigid};
use super::contact::bounds::Walls;
use super::force::{mouse, spring};
use super::integrate::verlet;
use super::real::Real;
use super::vector::zero;
use super::world::World;

impl<S: Real, const D: usize> World<S, D> {
    /// Advances by `h` [s]: half kick, drift (held by bonds and walls), half kick.
    ///
    /// Symmetric in time and second order; the plan decides which phases there are.
    pub(crate) fn step_by(&mut self, h: f64) {
        self.refresh_forces(h);
        self.slow(0.5 * h);
        verlet::kick(&mut self.points, self.gravity, 0.5 * h);
        self.drift(h);
        self.counters.substeps += 1;
        self.counters.points_moved += self.points.len() as u64;
        self.evaluate_forces();
        verlet::kick(&mut self.points, self.gravity, 0.5 * h);
        self.slow(0.5 * h);
        if let Some(walls) = &self.walls {
            walls.rest(&mut self.points, &self.touches);
        }
    }

    /// Moves the points: straight on where nothing holds them, else to where bonds and walls let them.
    fn drift(&mut self, h: f64) {
        let projects = self.plan.projects();
        if !projects && self.walls.is_none() {
            return verlet::drift(&mut self.points, h);
        }
        verlet::predict(&mut self.points, h);
        if projects {
            self.relax();
            self.hold();
            verlet::follow(&mut self.points, h);
        }
        if let Some(walls) = &self.walls {
            walls.stop(&mut self.points, self.gravity, h, &mut self.touches);
            self.counters.events += self.touches.len() as u64;
        }
        verlet::advance(&mut self.points);
        Walls::place(&mut self.points, &self.touches);
    }

    /// Sweeps over the relaxed bonds.
    fn relax(&mut self) {
        if self.plan.relaxed.is_empty() {
            return;
        }
        for _ in 0..self.plan.iterations {
            relaxed::sweep(&mut self.points, &self.plan.relaxed, &mut self.plan.relaxed_order);
        }
        self.count_sweeps(self.plan.iterations, self.plan.relaxed.len());
    }

    /// Sweeps over the rigid bonds until they hold.
    fn hold(&mut self) {
        if self.plan.rigid.is_empty() {
            return;
        }
        let held = rigid::hold(&mut self.points, &self.plan.rigid, &mut self.plan.rigid_order);
        self.counters.fallbacks += u64::from(!held.is_held);
        self.count_sweeps(held.sweeps, self.plan.rigid.len());
    }

    fn count_sweeps(&mut self, sweeps: u32, bonds: usize) {
        self.counters.iterations += u64::from(sweeps);
        self.counters.bonds_solved += u64::from(sweeps) * bonds as u64;
    }

    /// Drag: velocities decay by exp(-drag_rate h), exactly.
    fn slow(&mut self, h: f64) {
        if self.drag_rate > 0.0 {
            verlet::slow(&mut self.points, libm::exp(-self.drag_rate * h));
        }
    }

    /// Forces for the opening kick.
    ///
    /// They are those that the last substep ended with, unless a command came between. Dampers pull with the velocity in
    /// the middle of the kick: with the closing kick, which has it too, that makes damping second order.
    fn refresh_forces(&mut self, h: f64) {
        if self.stale {
            self.evaluate_forces();
            self.stale = false;
        }
        if self.plan.is_damped {
            verlet::look_ahead(&mut self.points, self.gravity, 0.5 * h);
            std::mem::swap(&mut self.points.velocity, &mut self.points.velocity_ahead);
            self.evaluate_forces();
            std::mem::swap(&mut self.points.velocity, &mut self.points.velocity_ahead);
        }
    }

    /// Accelerations by springs and the mouse, at the present positions and velocities.
    fn evaluate_forces(&mut self) {
        if self.points.acceleration.is_empty() {
            return;
        }
        self.points.acceleration.fill(zero());
        spring::pull(&mut self.points, &self.plan.springs);
        self.counters.bonds_solved += self.plan.springs.len() as u64;
        if let (Some(force), Some(cursor)) = (&self.mouse, self.cursor_now()) {
            self.counters.mouse_points += mouse::push(&mut self.points, force, cursor);
        }
    }
}
