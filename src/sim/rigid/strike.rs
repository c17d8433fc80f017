//! Coulomb's law where a rigid body touches surfaces: all impulses of a moment together.
//!
//! ```text
//! v+ = v- + W P        W: inverse mass and inertia as the touching points feel them
//! v_n+ >= target,  P_n >= 0,  P_n (v_n+ - target) = 0        |P_t| <= friction P_n, against the sliding
//! ```
//!
//! What slides on when the moment begins is rubbed against its way; what does not is held, as far as friction goes. The tangential impulse
//! is limited by the normal impulse of the same moment. Gone through contact by contact (Gauss and Seidel's method) until nothing
//! changes: of a line of touching points the two ends are enough, so there are few.

use crate::sim::vector::{add, cross, dot, scale, sub};

/// Most times that all contacts are gone through.
const MOST_PASSES: u32 = 100;
/// Change of a motion, relative to the fastest, that is none.
const NOTHING: f64 = 1e-15;
/// Operations of a contact that is gone through once, about.
pub(super) const OF_A_CONTACT: u64 = 40;
/// Halvings in which the restitution is found that adds no energy.
const HALVINGS: u32 = 30;

/// What the impulses move: a body's velocities and what resists them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inertia {
    /// Inverse mass [1/kg] and inverse moment of inertia [1/(kg m^2)].
    pub(super) inverse: [f64; 2],
}

/// How fast a body goes [m/s] and spins [rad/s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Twist {
    pub(super) velocity: [f64; 2],
    pub(super) spin: f64,
}

impl Twist {
    /// The velocity of what is at `arm` from the origin.
    #[inline(always)]
    pub(super) fn at(&self, arm: [f64; 2]) -> [f64; 2] {
        add(self.velocity, scale([-arm[1], arm[0]], self.spin))
    }
}

/// A point of the body on a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// From the origin [m].
    pub(super) arm: [f64; 2],
    /// Away from the surface.
    pub(super) normal: [f64; 2],
    pub(super) friction: f64,
    /// Share of the speed across that comes back: 0 of what lies there or is slow.
    pub(super) restitution: f64,
    /// Which way it slides along (-n_y, n_x) for all of the moment, -1 or 1; 0: friction may hold it.
    pub(super) slides: f64,
    /// The least speed across afterwards, and the speed along where friction holds it [m/s].
    pub(super) target: [f64; 2],
}

/// What impulses made of a motion.
#[derive(Clone, Debug)]
pub(super) struct Pressed {
    pub(super) twist: Twist,
    /// Of each contact.
    pub(super) impulses: Vec<Impulse>,
    /// What impulses across and along took [J].
    pub(super) taken: [f64; 2],
    /// How often all contacts were gone through, and whether nothing changed any more: of what is held on all sides it may go on for ever.
    pub(super) passes: u32,
    pub(super) has_converged: bool,
}

/// Impulses of a contact, along its normal and across it [kg m/s].
pub(super) type Impulse = [f64; 2];

impl Contact {
    #[inline(always)]
    pub(super) fn tangent(&self) -> [f64; 2] {
        [-self.normal[1], self.normal[0]]
    }

    /// Velocities across and along the surface.
    #[inline(always)]
    pub(super) fn speeds(&self, twist: &Twist) -> [f64; 2] {
        let v = twist.at(self.arm);
        [dot(v, self.normal), dot(v, self.tangent())]
    }
}

impl Inertia {
    /// Kinetic energy, but for what cannot move [J].
    pub(super) fn energy(&self, twist: &Twist) -> f64 {
        let of = |inverse: f64, square: f64| if inverse > 0.0 { 0.5 * square / inverse } else { 0.0 };
        of(self.inverse[0], dot(twist.velocity, twist.velocity)) + of(self.inverse[1], twist.spin * twist.spin)
    }

    /// An impact: contacts that close give back what their restitution says, with no more energy than there was.
    pub(super) fn strike(&self, before: Twist, contacts: &[Contact]) -> Pressed {
        let most = self.energy(&before) * (1.0 + 1e-13);
        let with = |share: f64| {
            let aimed = |contact: &Contact| {
                let closing = (-contact.speeds(&before)[0]).max(0.0);
                Contact { target: [share * contact.restitution * closing, 0.0], ..*contact }
            };
            let pressed = self.press(before, &contacts.iter().map(aimed).collect::<Vec<_>>(), &[]);
            let is_fine = self.energy(&pressed.twist) <= most;
            (pressed, is_fine)
        };
        let (whole, is_fine) = with(1.0);
        if is_fine {
            return whole;
        }
        // Newton's law of restitution together with friction may add energy: so much of it as does not.
        let (plastic, is_fine) = with(0.0);
        if !is_fine {
            return self.stop(before, contacts.len());
        }
        let (mut low, mut high, mut found) = (0.0, 1.0, plastic);
        for _ in 0..HALVINGS {
            let share = 0.5 * (low + high);
            match with(share) {
                (next, true) => (low, found) = (share, next),
                _ => high = share,
            }
        }
        found
    }

    /// As [`press`](Self::press), with no more energy than before and what targets ask for; where what slides on two surfaces at once has no
    /// answer by that law, friction may hold it there, and if that has none either it is stopped.
    pub(super) fn press_or_stop(&self, before: Twist, contacts: &[Contact], guess: &[Impulse]) -> Pressed {
        let asked =
            contacts.iter().flat_map(|contact| contact.target).fold(0.0, |most: f64, speed| most.max(speed.abs()));
        // What comes to rest has the speed of its targets, at most about twice.
        let heaviest =
            self.inverse.iter().filter(|inverse| **inverse > 0.0).fold(0.0, |sum, inverse| sum + 1.0 / inverse);
        let most = self.energy(&before) * (1.0 + 1e-9) + 2.0 * heaviest * asked * asked;
        let is_fine = |pressed: &Pressed| self.energy(&pressed.twist) <= most;
        let pressed = self.press(before, contacts, guess);
        let slides = contacts.iter().any(|contact| contact.slides != 0.0);
        if is_fine(&pressed) && (pressed.has_converged || !slides) {
            return pressed;
        }
        let held: Vec<Contact> = contacts.iter().map(|contact| Contact { slides: 0.0, ..*contact }).collect();
        let other = self.press(before, &held, &[]);
        if is_fine(&other) { other } else { self.stop(before, contacts.len()) }
    }

    /// It stands still.
    fn stop(&self, before: Twist, contacts: usize) -> Pressed {
        Pressed {
            twist: Twist { velocity: [0.0; 2], spin: 0.0 },
            impulses: vec![[0.0; 2]; contacts],
            taken: [self.energy(&before), 0.0],
            passes: 1,
            has_converged: true,
        }
    }

    /// The impulses that leave no contact slower off its surface than its target, and the motion that they make. They are looked for from
    /// `guess` on, one entry a contact; empty: from none.
    fn press(&self, before: Twist, contacts: &[Contact], guess: &[Impulse]) -> Pressed {
        let mut twist = before;
        let mut impulses = vec![[0.0; 2]; contacts.len()];
        for ((contact, impulse), guess) in contacts.iter().zip(&mut impulses).zip(guess) {
            twist = self.pushed(&twist, contact, *guess);
            *impulse = *guess;
        }
        let speeds = contacts.iter().flat_map(|contact| [contact.speeds(&before), contact.target]);
        let fastest = speeds.flatten().fold(0.0, |most: f64, speed| most.max(speed.abs()));
        let (mut passes, mut has_converged) = (0, false);
        while passes < MOST_PASSES && !has_converged {
            let mut largest: f64 = 0.0;
            for (contact, impulse) in contacts.iter().zip(&mut impulses) {
                let new = self.solve(contact, *impulse, &twist);
                let change = sub(new, *impulse);
                twist = self.pushed(&twist, contact, change);
                *impulse = new;
                let gives = self.gives(contact);
                largest = largest.max((change[0] * gives[0]).abs()).max((change[1] * gives[1]).abs());
            }
            passes += 1;
            has_converged = largest <= NOTHING * fastest;
        }
        let mut taken = [0.0; 2];
        for (contact, impulse) in contacts.iter().zip(&impulses) {
            let (from, to) = (contact.speeds(&before), contact.speeds(&twist));
            for k in 0..2 {
                taken[k] -= 0.5 * impulse[k] * (from[k] + to[k]);
            }
        }
        Pressed { twist, impulses, taken, passes, has_converged }
    }

    /// One contact, the others as they are.
    fn solve(&self, contact: &Contact, old: Impulse, twist: &Twist) -> Impulse {
        let gives = self.gives(contact);
        if gives[0] == 0.0 {
            return old;
        }
        let rub = contact.slides * contact.friction;
        let [normal, _] = contact.speeds(twist);
        let [target, hold] = contact.target;
        // Where friction that goes along with what presses lifts the point more than that does, it is held instead (Painlevé).
        let across = gives[0] - rub * gives[2];
        if contact.slides != 0.0 && across > 0.0 {
            let push = (old[0] + (target - normal) / across).max(0.0);
            return [push, -rub * push];
        }
        let push = (old[0] + (target - normal) / gives[0]).max(0.0);
        let next = self.pushed(twist, contact, [push - old[0], 0.0]);
        let [_, along] = contact.speeds(&next);
        let most = contact.friction * push;
        let wanted = if gives[1] > 0.0 { old[1] + (hold - along) / gives[1] } else { 0.0 };
        [push, wanted.clamp(-most, most)]
    }

    /// What an impulse of 1 changes of the contact's own velocity: across by across, along by along, and one by the other [1/kg].
    fn gives(&self, contact: &Contact) -> [f64; 3] {
        let [lever, hold] = [contact.normal, contact.tangent()].map(|way| cross(contact.arm, way));
        let [ease, swing] = self.inverse;
        [ease + swing * lever * lever, ease + swing * hold * hold, swing * lever * hold]
    }

    /// The motion after an impulse, along the normal and across it.
    fn pushed(&self, twist: &Twist, contact: &Contact, [normal, along]: Impulse) -> Twist {
        let impulse = add(scale(contact.normal, normal), scale(contact.tangent(), along));
        Twist {
            velocity: add(twist.velocity, scale(impulse, self.inverse[0])),
            spin: twist.spin + cross(contact.arm, impulse) * self.inverse[1],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_floor(arm: [f64; 2], friction: f64, restitution: f64) -> Contact {
        Contact { arm, normal: [0.0, 1.0], friction, restitution, slides: 0.0, target: [0.0; 2] }
    }

    /// A rod of two points of 1 kg, 2 m apart, its middle at the origin.
    const ROD: Inertia = Inertia { inverse: [0.5, 0.5] };

    #[test]
    fn a_level_rod_that_hits_with_one_end_turns_about_the_other() {
        let falling = Twist { velocity: [0.3, -1.0], spin: 0.0 };
        let after = ROD.strike(falling, &[on_floor([-1.0, 0.0], 0.0, 0.5)]).twist;
        let [hit, free] = [[-1.0, 0.0], [1.0, 0.0]].map(|arm| after.at(arm));
        assert!((hit[1] - 0.5).abs() < 1e-14 && (free[1] + 1.0).abs() < 1e-14, "{hit:?} {free:?}");
        assert!((hit[0] - 0.3).abs() < 1e-14, "no friction");
    }

    #[test]
    fn what_an_impact_takes_is_what_the_rod_has_less_and_never_below_nothing() {
        for restitution in [0.0, 0.5, 1.0] {
            for friction in [0.0, 0.1, 0.7, 9.0] {
                for turned in 0..16 {
                    let angle = 0.4 * f64::from(turned);
                    let arm = [libm::cos(angle), libm::sin(angle)];
                    let before = Twist { velocity: [1.0, -1.0], spin: 0.3 * f64::from(turned) - 2.0 };
                    if before.at(arm)[1] >= 0.0 {
                        continue;
                    }
                    let Pressed { twist: after, taken, .. } =
                        ROD.strike(before, &[on_floor(arm, friction, restitution)]);
                    let lost = ROD.energy(&before) - ROD.energy(&after);
                    assert!((taken[0] + taken[1] - lost).abs() < 1e-12, "{taken:?} {lost}");
                    assert!(lost > -1e-12, "{restitution} {friction} {angle}: {lost}");
                    assert!(after.at(arm)[1] > -1e-12);
                }
            }
        }
    }

    #[test]
    fn friction_is_a_share_of_what_presses_until_the_point_holds() {
        let before = Twist { velocity: [1.0, -1.0], spin: 0.0 };
        let end = |friction: f64, slides: f64| {
            let contact = Contact { slides, ..on_floor([-1.0, 0.0], friction, 0.0) };
            ROD.strike(before, &[contact]).twist.at([-1.0, 0.0])
        };
        // Level: what presses is 1 kg m/s, and friction moves both points.
        assert!((end(0.1, 0.0)[0] - 0.95).abs() < 1e-14 && (end(0.1, -1.0)[0] - 0.95).abs() < 1e-14);
        assert!(end(9.0, 0.0)[0].abs() < 1e-12);
    }

    #[test]
    fn a_box_that_lands_flat_stops_level_and_with_restitution_1_returns_level() {
        let body = Inertia { inverse: [0.25, 1.0 / (4.0 * 0.5)] };
        let before = Twist { velocity: [0.0, -2.0], spin: 0.0 };
        for restitution in [0.0, 1.0] {
            let both = [-0.5, 0.5].map(|x| on_floor([x, -0.5], 0.5, restitution));
            let after = body.strike(before, &both).twist;
            assert!((after.velocity[1] - 2.0 * restitution).abs() < 1e-12 && after.spin.abs() < 1e-12, "{after:?}");
        }
    }

    #[test]
    fn what_is_pinned_turns_alone() {
        let pinned = Inertia { inverse: [0.0, 0.5] };
        let before = Twist { velocity: [0.0; 2], spin: -1.0 };
        let after = pinned.strike(before, &[on_floor([1.0, 0.0], 0.3, 1.0)]).twist;
        assert!((after.spin - 1.0).abs() < 1e-14 && after.velocity == [0.0; 2]);
    }
}
