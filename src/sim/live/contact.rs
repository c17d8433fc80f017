//! The law of a contact, whatever touches: it pushes and never pulls, it rubs within Coulomb's cone, and it gives back a share of the speed that
//! came in.
//!
//! Pushes of a substep are summed up, and what is bounded is the sum: a pass may take back what an earlier one gave too much.
//! Source: E. Catto, Iterative Dynamics with Temporal Coherence, 2005 (accumulated impulses).

use super::loads::{self, Load};
use crate::sim::real::Real;

/// Share of the speed that came in by which what restitution asks for may be missed.
const BOUNCED: f64 = 1e-3;

/// What presses `[kg m]` where what overlaps by `depth` `[m]` is pushed apart, `w` `[1/kg]` for each push: never less than nothing.
#[inline(always)]
pub(super) fn pressed<S: Real>(before: S, depth: S, w: S) -> S {
    (before + depth / w).max(S::ZERO)
}

/// What rubs in the plane `[kg m]` against a slide `[m]`, no more than `most` `[kg m]`: Coulomb's cone.
#[inline(always)]
pub(super) fn rubbed<S: Real>(before: S, slide: S, (w, most): (S, S)) -> S {
    within(before - slide / w, most)
}

/// A number that is no further from 0 than another.
#[inline(always)]
pub(super) fn within<S: Real>(x: S, most: S) -> S {
    x.max(-most).min(most)
}

/// The normal speed that lacks, beside what there is, where what came in by `approach` goes out by a share of it `[m/s]`.
#[inline(always)]
pub(super) fn lacking<S: Real>(restitution: S, approach: S, speed: S) -> S {
    -restitution * approach - speed
}

/// A contact of the plane as it is solved within a substep.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact<S> {
    /// What presses apart in this substep `[kg m]`.
    pub(super) pressed: S,
    /// What rubs `[kg m]`.
    pub(super) rubbed: S,
    /// Overlap from before the substep, which is not to become speed `[m]`.
    pub(super) old: S,
    /// Normal speed at the start of the substep `[m/s]`: what forces give within it is pressed away, and does not bounce.
    pub(super) approach: S,
    /// What restitution gave back `[kg m/s]`.
    bounced: S,
    pub(super) is_met: bool,
    /// What pressed and rubbed in the substep before (`loads.rs`) `[N]`.
    pub(super) load: Load<S>,
}

impl<S: Real> Contact<S> {
    /// One that nothing met yet.
    pub(super) fn new() -> Self {
        Contact {
            pressed: S::ZERO,
            rubbed: S::ZERO,
            old: S::ZERO,
            approach: S::ZERO,
            bounced: S::ZERO,
            is_met: false,
            load: [S::ZERO; 2],
        }
    }

    /// The substep begins anew; of the last one what a push was and the least speed that bounced are known.
    #[inline(always)]
    pub(super) fn clear(&mut self, last: (S, S)) {
        self.load = self.load_after(last);
        (self.pressed, self.rubbed, self.bounced, self.old, self.is_met) = (S::ZERO, S::ZERO, S::ZERO, S::ZERO, false);
    }

    /// What it bore in that substep `[N]`; where nothing pressed, in those before.
    #[inline(always)]
    pub(super) fn load_after(&self, last: (S, S)) -> Load<S> {
        if self.pressed > S::ZERO { loads::load([self.pressed, self.rubbed], self.approach, last) } else { self.load }
    }

    /// Pushes apart what overlaps by `depth` `[m]`. Returns by how much more or less than before `[kg m]`.
    #[inline(always)]
    pub(super) fn press(&mut self, depth: S, w: S) -> S {
        let before = self.pressed;
        self.pressed = pressed(before, depth, w);
        self.pressed - before
    }

    /// Rubs against a slide `[m]`, likewise.
    #[inline(always)]
    pub(super) fn rub(&mut self, slide: S, (w, most): (S, S)) -> S {
        let before = self.rubbed;
        self.rubbed = rubbed(before, slide, (w, most));
        self.rubbed - before
    }

    /// Whether it rubs with all that friction gives.
    #[inline(always)]
    pub(super) fn slips(&self, friction: S) -> bool {
        self.rubbed.abs() >= friction * self.pressed
    }

    /// Whether it is to bounce: where it pressed, or a rigid body was met, and what came was faster than `least` `[m/s]`. A rigid body
    /// does not go on either where nothing is given back.
    pub(super) fn bounces(&self, (restitution, is_rigid): (S, bool), least: S) -> bool {
        let has_hit = self.pressed > S::ZERO || (self.is_met && is_rigid);
        if !has_hit || self.approach > -least {
            return false;
        }
        restitution != S::ZERO || is_rigid
    }

    /// Gives back what lacks beside a normal speed `[m/s]`. Returns by how much more or less than before `[kg m/s]`, and whether that was
    /// worth another look.
    pub(super) fn give_back(&mut self, restitution: S, speed: S, w: S) -> (S, bool) {
        // What others pushed it on since is taken off again.
        let before = self.bounced;
        self.bounced = pressed(before, lacking(restitution, self.approach, speed), w);
        let push = self.bounced - before;
        (push, push.abs() * w > -self.approach * S::from_f64(BOUNCED))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_contact_pushes_as_deep_as_it_is_takes_that_back_and_never_pulls() {
        let mut contact = Contact::new();
        assert_eq!(contact.press(0.5, 2.0), 0.25);
        assert_eq!(contact.press(-0.25, 2.0), -0.125, "it was too much");
        assert_eq!((contact.press(-9.0, 2.0), contact.pressed), (-0.125, 0.0));
    }

    #[test]
    fn what_rubs_stays_within_the_cone_and_slips_at_its_rim() {
        let mut contact = Contact::new();
        contact.press(1.0, 1.0);
        let most = 0.5 * contact.pressed;
        assert_eq!(contact.rub(0.25, (1.0, most)), -0.25);
        assert!(!contact.slips(0.5));
        assert_eq!(contact.rub(9.0, (1.0, most)), -0.25, "no more than half of what presses");
        assert!(contact.slips(0.5));
        assert_eq!((contact.rub(-9.0, (1.0, most)), contact.rubbed), (1.0, 0.5));
    }

    #[test]
    fn what_came_fast_is_given_back_once() {
        let mut contact = Contact { approach: -4.0, ..Contact::new() };
        assert!(!contact.bounces((0.5, false), 0.1), "it did not press");
        contact.press(1.0, 1.0);
        assert!(contact.bounces((0.5, false), 0.1) && !contact.bounces((0.5, false), 5.0));
        assert!(!contact.bounces((0.0, false), 0.1) && contact.bounces((0.0, true), 0.1));
        // Half of 4 m/s, of something that goes by 2 m/s for each kg m/s.
        assert_eq!(contact.give_back(0.5, 0.0, 2.0), (1.0, true));
        assert_eq!(contact.give_back(0.5, 2.0, 2.0), (0.0, false));
        assert_eq!(contact.give_back(0.5, 3.0, 2.0), (-0.5, true), "others pushed it on");
        assert_eq!(contact.give_back(0.5, 9.0, 2.0), (-0.5, true), "no more than it was given");
    }

    #[test]
    fn a_blow_leaves_no_load_and_what_presses_does() {
        let mut contact = Contact { pressed: 2.0, rubbed: 1.0, approach: -0.1, ..Contact::new() };
        contact.clear((3.0, 0.5));
        assert_eq!((contact.load, contact.pressed), ([6.0, 3.0], 0.0));
        (contact.pressed, contact.approach) = (2.0, -4.0);
        contact.clear((3.0, 0.5));
        assert_eq!(contact.load, [0.0; 2]);
    }
}
