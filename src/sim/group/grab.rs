//! A grab: a critically damped spring that leads the middle of some points to the cursor, by a bounded force.
//!
//! With e = target - x, the acceleration that the middle of the points is to have is
//!
//! ```text
//! a = w^2 e + 2 w (v_target - v) + i,   i' = w^3/8 e
//! ```
//!
//! where the last term feeds a steady load forward, so that nothing sags. The force is that of the mass that is led: the body's, as
//! far as a substep can bear it, and at most [`MOST_G`] times the weight of what is held, or what tears that off. It is the same for all
//! points per mass, constant within a substep. A patch of what tears is led by less than tears it off until the cursor is far from it, and from
//! there on the bound grows with that distance. Bodies that may meet are led no faster than half an edge in the longest of their substeps,
//! so that what is grabbed finds what is in its way.

use super::Group;
use super::booking::Cause;
use super::engine::Engine;
use crate::sim::bulk::kernel::Kernel;
use crate::sim::environment::Environment;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, dot, length, scale, sub, widen, zero};

/// The grab's frequency w `[rad/s]`: it follows the hand within a tenth of a second.
const FREQUENCY: f64 = 20.0;
/// Most of w times a substep: beyond, the spring itself would be unstable.
const MOST_PHASE: f64 = 0.3;
/// Longest substep of a group that is grabbed `[s]`.
const LONGEST: f64 = 1.0 / 480.0;
/// Most force, in weights of the points that are held: they are neither flung nor torn out of what does not tear.
const MOST_G: f64 = 50.0;
/// The same of bodies that may meet others, in weights of all that hangs together with them.
const MOST_G_OF_BODY: f64 = 10.0;
/// What tears is torn by a hand that pulls far enough: force beside that which breaks all springs at what is held `[1]`, in so many weights of all
/// that hangs together with them at most.
const TEARING: f64 = 1.5;
const MOST_G_TO_TEAR: f64 = 50.0;
/// A patch is not torn off before the cursor is far from it: force beside that which breaks all springs at what is held `[1]`. Of what is pulled
/// aside those of a corner break first: a cloth of 11 by 11 points under its pins at 0.10 of all, down or towards the viewer at 0.24, a net
/// between its pins at 0.20. And so many weights of what is held at least, which it lifts where a thread is all that holds it to others.
const HOLDS: f64 = 0.06;
const LEAST_G: f64 = 1.5;
/// Gravity that the bound is measured in `[m/s^2]`.
const G: f64 = 9.81;
/// Most of what the damper changes of a velocity in a substep: 2 would be the edge of stability.
const MOST_DAMPING: f64 = 0.5;

/// Points of a group that are grabbed.
#[derive(Clone, Debug)]
pub(crate) struct Grabbed<const D: usize> {
    /// Places of free points in the group, ascending.
    pub(crate) slots: Vec<u32>,
    /// Mass of what hangs together with them `[kg]`.
    pub(crate) body_mass: f64,
    /// What breaks the springs that hold these points to others, where they may break `[N]`.
    pub(crate) tearing: f64,
    /// They are torn off only by a cursor that is farther from them than this `[m]`; 0: by any.
    pub(crate) torn_beyond: f64,
    /// From the cursor to where these points belong `[m]`: 0 where all that is grabbed is of one group.
    pub(crate) offset: [f64; D],
    /// The fastest that it is led `[m/s]`, and where it is led to now `[m]`: a jump of the cursor is followed no faster.
    pub(crate) most_lead: f64,
    pub(crate) lead: Option<[f64; D]>,
    /// What a steady load takes `[m/s^2]`.
    pub(crate) steady: [f64; D],
    /// Acceleration of the points now `[m/s^2]`.
    pub(crate) acceleration: [f64; D],
}

impl<S: Real, const D: usize> Group<S, D> {
    /// Longest substep `[s]`.
    pub(crate) fn longest(&self) -> f64 {
        // A loop as it is printed is another one in other steps.
        let is_printed = matches!(self.kernel(), Some(Kernel::Printed(_)));
        if self.grabbed.is_some() && !is_printed { self.substep.min(LONGEST) } else { self.substep }
    }

    /// The fastest that a point may be led `[m/s]`, where there is such a bound.
    pub(crate) fn most_lead(&self, slot: u32) -> Option<f64> {
        if let Engine::Bulk(bulk) = &self.engine { bulk.most_lead(slot) } else { None }
    }

    /// Works out the grab's force for the substep of `h` from `t` `[s]`, and gives it to engines that know no forces as a kick.
    pub(crate) fn lead_grabbed(&mut self, around: &Environment<D>, (t, h): (f64, f64)) {
        let Some(mut grabbed) = self.grabbed.take() else { return };
        grabbed.aim(&self.points, around, (t, h));
        let change: [S; D] = convert(grabbed.acceleration);
        let kicks = match &mut self.engine {
            Engine::Bulk(bulk) => {
                bulk.reload();
                true
            }
            Engine::Splitting(splitting) => !splitting.has_kicks(),
            _ => false,
        };
        self.pull.is_grabbed = true;
        if kicks {
            let gain = scale(change, S::from_f64(h));
            let before = self.energy_if_kept();
            for &slot in &grabbed.slots {
                let v = &mut self.points.velocity[slot as usize];
                *v = add(*v, gain);
            }
            // What is rigid goes as a whole at once.
            if let Engine::Bulk(bulk) = &mut self.engine
                && bulk.kernel().is_of_rigid_bodies()
            {
                bulk.begin(&mut self.points, around, t);
            }
            self.book_change(before, Cause::Grab);
        } else {
            if self.points.acceleration.is_empty() {
                self.points.acceleration = vec![zero(); self.points.len()];
            }
            self.pull.led.clone_from(&grabbed.slots);
            self.pull.lead = change;
            self.engine.refresh();
        }
        self.grabbed = Some(grabbed);
    }

    /// The middle of what is held, where somebody watches the energy `[m]`.
    pub(crate) fn middle_held(&self) -> Option<[f64; D]> {
        self.grabbed.as_ref().filter(|_| self.watch.is_some()).map(|grabbed| grabbed.middle(&self.points).0)
    }

    /// What is held came from there `[m]`.
    pub(crate) fn note_held(&mut self, from: Option<[f64; D]>) {
        if let (Some(from), Some(grabbed)) = (from, &self.grabbed) {
            let (to, _, mass) = grabbed.middle(&self.points);
            let work = mass * dot(grabbed.acceleration, sub(to, from));
            self.watch_grab(work);
        }
    }

    /// Nothing is grabbed any more: what was keeps its velocity.
    pub(crate) fn let_go(&mut self) {
        self.grabbed = None;
        self.pull.is_grabbed = false;
        self.pull.led.clear();
        self.engine.refresh();
    }
}

impl<const D: usize> Grabbed<D> {
    /// Mean place and velocity of the points by mass, and their mass `[m, m/s, kg]`.
    pub(crate) fn middle<S: Real>(&self, points: &Points<S, D>) -> ([f64; D], [f64; D], f64) {
        let (mut place, mut velocity, mut mass) = (zero(), zero(), 0.0);
        for &slot in &self.slots {
            let i = slot as usize;
            let m = 1.0 / points.inverse_mass[i].to_f64();
            place = add(place, scale(widen(points.position[i]), m));
            velocity = add(velocity, scale(widen(points.velocity[i]), m));
            mass += m;
        }
        (scale(place, 1.0 / mass), scale(velocity, 1.0 / mass), mass)
    }

    /// Where it is led from and to in a substep of `h` `[s]` in which the cursor goes as it does: straight behind it, no faster than may be.
    fn led(&mut self, (now, soon): ([f64; D], [f64; D]), h: f64) -> ([f64; D], [f64; D]) {
        /// Share of that way by which it may be off the cursor and count as there.
        const NEAR: f64 = 1e-6;
        if self.most_lead == f64::INFINITY {
            return (now, soon);
        }
        let (from, most) = (self.lead.unwrap_or(now), self.most_lead * h);
        let way = sub(soon, from);
        let size = length(way);
        let is_there = size <= most && length(sub(now, from)) <= NEAR * most;
        let led = if is_there { (now, soon) } else { (from, add(from, scale(way, (most / size).min(1.0)))) };
        self.lead = Some(led.1);
        led
    }

    /// Most acceleration `[m/s^2]` of this mass `[kg]`, so far from where it belongs `[m]`.
    fn most(&self, mass: f64, away: f64) -> f64 {
        // What may press others is not to press them flat.
        let of_body = if self.most_lead.is_finite() { MOST_G_OF_BODY * self.body_mass / mass } else { f64::INFINITY };
        let tears = (TEARING * self.tearing).min(MOST_G_TO_TEAR * G * self.body_mass) / mass;
        let most = (MOST_G.min(of_body) * G).max(tears);
        if self.torn_beyond == 0.0 || self.tearing == 0.0 {
            return most;
        }
        let held = most.min((HOLDS * self.tearing / mass).max(LEAST_G * G));
        let share = (away / self.torn_beyond - 1.0).clamp(0.0, 1.0);
        held + share * (most - held)
    }

    fn aim<S: Real>(&mut self, points: &Points<S, D>, around: &Environment<D>, (t, h): (f64, f64)) {
        let (Some(now), Some(soon)) = (around.target(t), around.target(t + h)) else {
            self.acceleration = zero();
            return;
        };
        let (now, soon) = self.led((now, soon), h);
        let (place, velocity, mass) = self.middle(points);
        let w = FREQUENCY.min(MOST_PHASE / h);
        // The whole body is to follow: of its mass as much as the damper can bear on the points that are held.
        let share = (self.body_mass / mass).clamp(1.0, (MOST_DAMPING / (2.0 * w * h)).max(1.0));
        let away = sub(add(now, self.offset), place);
        let slower = sub(scale(sub(soon, now), 1.0 / h), velocity);
        let wanted = add(add(scale(away, w * w), scale(slower, 2.0 * w)), self.steady);
        let wanted = scale(wanted, share);
        let size = length(wanted);
        let most = self.most(mass, length(away));
        if size <= most {
            self.acceleration = wanted;
            self.steady = add(self.steady, scale(away, 0.125 * w * w * w * h));
        } else {
            self.acceleration = scale(wanted, most / size);
        }
    }
}
