//! Kick, drift, kick, with everything that moves points by their displacements: Verlet's method with SHAKE and RATTLE,
//! sweeps over relaxed bonds, semi-implicit Euler.
//!
//! Rigid bonds bend the displacement along the directions that they had at the start of the substep; with a direct
//! solve the velocities are held at its end too (RATTLE), which is symplectic and of order 2.
//! Source: H. C. Andersen, J. Comput. Phys. 52, 24 (1983).

use super::verlet;
use crate::sim::constrain::order::Sweeper;
use crate::sim::constrain::relaxed::{self, RelaxedBond};
use crate::sim::constrain::rigid::{self, RigidBond};
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, widen, zero};

/// Bonds that are swept one after the other.
#[derive(Clone, Debug)]
pub(crate) struct Swept<S> {
    /// Swept `iterations` times a substep.
    pub(crate) relaxed: Vec<RelaxedBond<S>>,
    pub(crate) relaxed_order: Sweeper,
    pub(crate) iterations: u32,
    /// Swept until they hold.
    pub(crate) rigid: Vec<RigidBond<S>>,
    pub(crate) rigid_order: Sweeper,
    /// The substep that the scene says `[s]`, which relaxed bonds are relative to.
    pub(crate) nominal: f64,
}

/// What sweeps over relaxed bonds take, where a ledger is kept.
///
/// A correction d of a place is the impulse m d/h. In kicks and drifts its work is this times the mean of the velocities of the drifts before and
/// after it: with that the energy at the middle of each drift, gravity's included, changes by works alone.
#[derive(Clone, Debug)]
pub(crate) struct SweepTally<S, const D: usize> {
    /// Velocities of the drift before: those at the start of the substep less the kick that closed the one before.
    before: Vec<[S; D]>,
    /// How far sweeps have moved each point in the substep `[m]`.
    bent: Vec<[S; D]>,
    /// What they took since it was begun, and what pins that are led did through them `[J]`.
    pub(crate) taken: f64,
    pub(crate) drawn: f64,
}

/// The method with what it keeps from substep to substep.
#[derive(Clone, Debug)]
pub(crate) struct KickDrift<S, const D: usize> {
    pub(crate) swept: Swept<S>,
    /// There where what sweeps take is asked for.
    pub(crate) tally: Option<Box<SweepTally<S, D>>>,
    /// Shares of the opening and the closing kick: halves, or 1 and 0 for semi-implicit Euler.
    pub(crate) kicks: [f64; 2],
    /// Velocities are held at the end of the substep too.
    pub(crate) holds_velocity: bool,
    /// Accelerations belong to the present positions.
    pub(crate) fresh: bool,
    /// Rows of the direct solver are aimed and factored for the present positions.
    pub(crate) aimed: bool,
}

impl<S: Real, const D: usize> KickDrift<S, D> {
    /// Advances by `h` from time `t`. Returns whether rigid bonds could be held.
    pub(crate) fn step(
        &mut self,
        points: &mut Points<S, D>,
        pull: &mut Pull<S, D>,
        around: &Environment<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
    ) -> bool {
        self.note_velocity(points);
        verlet::slow(points, pull.drag_rate, self.kicks[0] * h);
        self.kick(points, pull, around, (t, self.kicks[0] * h), counters);
        verlet::predict(points, h);
        self.relax(points, h, counters);
        let is_held = self.hold(points, pull, counters);
        verlet::follow(points, h);
        self.count_sweeps(points, h);
        verlet::advance(points);
        self.fresh = false;
        if self.kicks[1] > 0.0 {
            self.kick(points, pull, around, (t + h, self.kicks[1] * h), counters);
            verlet::slow(points, pull.drag_rate, self.kicks[1] * h);
        }
        if self.holds_velocity {
            self.hold_velocity(points, pull);
        }
        is_held
    }

    fn kick(
        &mut self,
        points: &mut Points<S, D>,
        pull: &mut Pull<S, D>,
        around: &Environment<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
    ) {
        if pull.is_damped() {
            self.make_ready(points, pull);
            pull.push_ahead(around, (t, h), pull.gravity, points, counters);
        } else if !self.fresh {
            pull.push(around, t, points, counters);
        }
        verlet::kick(points, pull.gravity, h);
        self.fresh = true;
    }

    /// Rows of the direct solver fit the present state, if they do not already.
    fn make_ready(&mut self, points: &Points<S, D>, pull: &mut Pull<S, D>) {
        if !self.aimed
            && let Some(rigid) = &mut pull.rigid
        {
            rigid.make_ready(points, &pull.contacts);
            self.aimed = true;
        }
    }

    /// Moves the points by sweeps alone: what comes after the step of another method.
    pub(crate) fn sweep_after(
        &mut self,
        points: &mut Points<S, D>,
        pull: &Pull<S, D>,
        h: f64,
        counters: &mut Counters,
    ) {
        points.displacement.fill(zero());
        self.relax(points, h, counters);
        if let Some(tally) = &mut self.tally {
            tally.taken += gone(points, pull, (&tally.bent, h));
        }
        if !self.swept.rigid.is_empty() {
            let held = rigid::hold(points, &self.swept.rigid, &mut self.swept.rigid_order);
            counters.sweep(held.sweeps, self.swept.rigid.len());
        }
        let rate = S::from_f64(1.0 / h);
        for i in 0..points.len() {
            if points.inverse_mass[i] != S::ZERO {
                points.velocity[i] = add(points.velocity[i], scale(points.displacement[i], rate));
            }
        }
        verlet::advance(points);
        rigid::hold_velocity(points, &self.swept.rigid);
    }

    /// Sweeps over the relaxed bonds.
    pub(crate) fn relax(&mut self, points: &mut Points<S, D>, h: f64, counters: &mut Counters) {
        let Swept { relaxed, relaxed_order, iterations, nominal, .. } = &mut self.swept;
        if relaxed.is_empty() {
            return;
        }
        let share = relaxed::share_of(h, *nominal);
        if let Some(tally) = &mut self.tally {
            tally.bent.clone_from(&points.displacement);
        }
        for _ in 0..*iterations {
            match &mut self.tally {
                Some(tally) => {
                    let drawn = relaxed::sweep_counting(points, relaxed, relaxed_order, (share, h));
                    tally.drawn += drawn;
                    tally.taken += drawn;
                }
                None => relaxed::sweep(points, relaxed, relaxed_order, share),
            }
        }
        counters.sweep(*iterations, relaxed.len());
        if let Some(tally) = &mut self.tally {
            tally.bent.iter_mut().zip(&points.displacement).for_each(|(bent, way)| *bent = sub(*way, *bent));
            let kicks = S::from_f64(self.kicks[1] / self.kicks[0]);
            let met = tally.before.iter_mut().zip(&points.velocity);
            met.for_each(|(before, v)| *before = sub(*before, scale(*v, kicks)));
        }
    }

    /// Notes the velocities that a substep begins with.
    pub(crate) fn note_velocity(&mut self, points: &Points<S, D>) {
        let kicks = S::from_f64(1.0 + self.kicks[1] / self.kicks[0]);
        if let Some(tally) = &mut self.tally {
            tally.before.clear();
            tally.before.extend(points.velocity.iter().map(|&v| scale(v, kicks)));
            tally.bent.clear();
        }
    }

    /// Counts what sweeps took, by the velocities that they left.
    pub(crate) fn count_sweeps(&mut self, points: &Points<S, D>, h: f64) {
        let Some(tally) = &mut self.tally else { return };
        for (i, (&bent, &before)) in tally.bent.iter().zip(&tally.before).enumerate() {
            if points.inverse_mass[i] != S::ZERO {
                let mean = scale(add(points.velocity[i], before), S::HALF);
                tally.taken -= dot(widen(mean), widen(bent)) / (h * points.inverse_mass[i].to_f64());
            }
        }
    }

    /// What sweeps take is counted from here on, or not.
    pub(crate) fn begin_tally(&mut self, is_kept: bool) {
        let is_kept = is_kept && !self.swept.relaxed.is_empty();
        self.tally =
            is_kept.then(|| Box::new(SweepTally { before: Vec::new(), bent: Vec::new(), taken: 0.0, drawn: 0.0 }));
    }

    /// Bends displacements until rigid bonds hold.
    fn hold(&mut self, points: &mut Points<S, D>, pull: &mut Pull<S, D>, counters: &mut Counters) -> bool {
        self.make_ready(points, pull);
        if let Some(rigid) = &mut pull.rigid {
            let held = rigid.bend(points, &pull.contacts);
            self.aimed = false;
            counters.sweep(held.iterations, rigid.len());
            return held.is_held;
        }
        if self.swept.rigid.is_empty() {
            return true;
        }
        let held = rigid::hold(points, &self.swept.rigid, &mut self.swept.rigid_order);
        counters.sweep(held.sweeps, self.swept.rigid.len());
        held.is_held
    }

    /// Projects swept rigid bonds at the start: positions first, then velocities.
    ///
    /// Returns whether they hold.
    pub(crate) fn hold_start(&mut self, points: &mut Points<S, D>) -> bool {
        if self.swept.rigid.is_empty() {
            return true;
        }
        points.displacement.fill(zero());
        let held = rigid::hold(points, &self.swept.rigid, &mut self.swept.rigid_order.clone());
        verlet::advance(points);
        points.displacement.fill(zero());
        rigid::hold_velocity(points, &self.swept.rigid);
        held.is_held
    }

    /// Takes from velocities what would change the length of rigid bonds.
    pub(crate) fn hold_velocity(&mut self, points: &mut Points<S, D>, pull: &mut Pull<S, D>) {
        self.make_ready(points, pull);
        if let Some(rigid) = &mut pull.rigid {
            rigid.project_velocity(points, &pull.contacts);
        } else if !self.swept.rigid.is_empty() {
            rigid::hold_velocity(points, &self.swept.rigid);
        }
    }
}

/// What points lose that are moved so at once, after a step, and their velocities with them `[J]`.
fn gone<S: Real, const D: usize>(points: &Points<S, D>, pull: &Pull<S, D>, (bent, h): (&[[S; D]], f64)) -> f64 {
    let moved: Vec<[S; D]> = points.position.iter().zip(bent).map(|(&x, &bent)| add(x, bent)).collect();
    let mut gone = pull.elastic(&points.position) - pull.elastic(&moved);
    for (i, &bent) in bent.iter().enumerate() {
        if points.inverse_mass[i] != S::ZERO {
            let [v, bent]: [[f64; D]; 2] = [points.velocity[i], bent].map(widen);
            let mean = add(v, scale(bent, 0.5 / h));
            gone += dot(bent, sub(pull.gravity, scale(mean, 1.0 / h))) / points.inverse_mass[i].to_f64();
        }
    }
    gone
}
