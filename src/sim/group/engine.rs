//! What moves a group: one integrator with what it keeps from step to step.

use crate::sim::account::kinetic;
use crate::sim::bulk::mover::Mover;
use crate::sim::constrain::xpbd::{self, CompliantBond};
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::integrate::implicit::Implicit;
use crate::sim::integrate::kick_drift::KickDrift;
use crate::sim::integrate::runge_kutta::{self, Stages};
use crate::sim::integrate::splitting::Splitting;
use crate::sim::integrate::tableau::Tableau;
use crate::sim::integrate::verlet;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{scale, sub, zero};

/// Kinetic energy after rigid bonds were put right, as a share of what there was, up to which it is believed `[1]`. Bonds make none: what is more is of
/// lengths that were wrong before.
const MOST_OF_BONDS: f64 = 1.1;

/// An integrator.
#[derive(Clone, Debug)]
pub(crate) enum Engine<S: Real, const D: usize> {
    /// Kicks and flights.
    Splitting(Splitting<S, D>),
    /// Kick, drift, kick with projections, in a row of shares of the substep that composes a higher order.
    KickDrift(KickDrift<S, D>, &'static [f64]),
    /// Explicit Runge-Kutta; relaxed bonds are swept after the step.
    RungeKutta(&'static Tableau, Stages<S>, Option<KickDrift<S, D>>),
    /// Newton's method on a sparse system.
    Implicit(Box<Implicit<S, D>>),
    /// Points go on as forces take them, then rigid bonds get their lengths along the directions that they have there:
    /// order 1, takes energy away, and bears any motion.
    Projected,
    /// Compliant projection with this many sweeps; relaxed bonds are swept after it.
    Xpbd(Vec<CompliantBond<S>>, u32, KickDrift<S, D>),
    /// Large bodies.
    Bulk(Box<dyn Mover<S, D>>),
}

impl<S: Real, const D: usize> Engine<S, D> {
    /// Advances by `h` from time `t`. Returns whether everything converged.
    pub(crate) fn step(
        &mut self,
        points: &mut Points<S, D>,
        pull: &mut Pull<S, D>,
        around: &Environment<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
    ) -> bool {
        match self {
            Engine::Splitting(splitting) => {
                splitting.step(points, pull, around, (t, h), counters);
                true
            }
            Engine::KickDrift(method, shares) => {
                let (mut time, mut is_held) = (t, true);
                for share in shares.iter() {
                    is_held &= method.step(points, pull, around, (time, share * h), counters);
                    time += share * h;
                }
                is_held
            }
            Engine::RungeKutta(table, stages, sweeps) => {
                let is_held = runge_kutta::step(points, pull, stages, table, around, (t, h), counters);
                if let Some(sweeps) = sweeps {
                    sweeps.sweep_after(points, pull, h, counters);
                }
                is_held
            }
            Engine::Projected => {
                set_out(points, pull, around, (t, h), counters);
                let (before, rushed) = (points.position.clone(), points.velocity.clone());
                let had = kinetic(&rushed, &points.inverse_mass);
                verlet::advance(points);
                let is_held = pull.project(points, counters);
                let rate = S::from_f64(1.0 / h);
                for i in 0..points.len() {
                    if points.inverse_mass[i] != S::ZERO {
                        points.velocity[i] = scale(sub(points.position[i], before[i]), rate);
                        points.velocity_lost[i] = zero();
                    }
                }
                // What bonds lacked before is made good in so short a time that it would be any speed.
                let is_led = || (0..points.len()).any(|i| points.inverse_mass[i] == S::ZERO && rushed[i] != zero());
                if kinetic(&points.velocity, &points.inverse_mass) > MOST_OF_BONDS * had && !is_led() {
                    points.velocity.copy_from_slice(&rushed);
                }
                pull.project(points, counters) && is_held
            }
            Engine::Implicit(implicit) => implicit.step(points, pull, around, (t, h), counters),
            Engine::Xpbd(bonds, sweeps, after) => {
                after.note_velocity(points);
                set_out(points, pull, around, (t, h), counters);
                xpbd::solve(bonds, &points.position, &mut points.displacement, h, *sweeps);
                counters.sweep(*sweeps, bonds.len());
                after.relax(points, h, counters);
                verlet::follow(points, h);
                after.count_sweeps(points, h);
                verlet::advance(points);
                true
            }
            Engine::Bulk(bulk) => {
                bulk.step(points, pull, around, (t, h), counters, None);
                true
            }
        }
    }

    /// Whether surfaces are met in its own steps.
    pub(crate) fn meets_surfaces(&self) -> bool {
        matches!(self, Engine::Implicit(_))
    }

    /// What sweeps over relaxed bonds take is counted from here on, or not.
    pub(crate) fn begin_tally(&mut self, is_kept: bool) {
        if let Some(sweeps) = self.sweeps() {
            sweeps.begin_tally(is_kept);
        }
    }

    /// What they took since then, and what pins that are led did through them `[J]`.
    pub(crate) fn tallied(&mut self) -> [f64; 2] {
        self.sweeps().and_then(|sweeps| sweeps.tally.as_ref()).map_or([0.0; 2], |tally| [tally.taken, tally.drawn])
    }

    fn sweeps(&mut self) -> Option<&mut KickDrift<S, D>> {
        match self {
            Engine::KickDrift(sweeps, _) | Engine::RungeKutta(_, _, Some(sweeps)) | Engine::Xpbd(_, _, sweeps) => {
                Some(sweeps)
            }
            _ => None,
        }
    }

    /// Forgets what belongs to the state before a change from outside.
    pub(crate) fn refresh(&mut self) {
        match self {
            Engine::Splitting(splitting) => splitting.fresh = false,
            Engine::KickDrift(method, _) => (method.fresh, method.aimed) = (false, false),
            _ => {}
        }
    }
}

/// What forces, gravity and drag over the whole of `h` make of velocities, and where that would take the points.
fn set_out<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    pull: &mut Pull<S, D>,
    around: &Environment<D>,
    (t, h): (f64, f64),
    counters: &mut Counters,
) {
    pull.push(around, t, points, counters);
    verlet::slow(points, pull.drag_rate, h);
    verlet::kick(points, pull.gravity, h);
    verlet::predict(points, h);
}
