//! How bodies that joints hold together answer to impulses where they meet something.

use super::inertia::{Inertia, Inertial};
use super::joints::Factored;
use super::meeting::Meeting;
use super::motion::Twist;
use crate::sim::contact::coulomb::coupled::{Coupled, Speeds};
use crate::sim::contact::coulomb::{Impulse, Pressed, Rub, press_or_stop};
use crate::sim::vector::{add, scale, sub};

/// Share of what a body alone would give at a point below which its joints hold it there.
const HELD: f64 = 1e-10;
/// Share of an energy that is rounding.
const ROUNDING: f64 = 1e-9;

/// Bodies in joints, and where they touch.
pub(super) struct Together<'a> {
    pub(super) joints: &'a Factored<'a>,
    contacts: &'a [Meeting],
    /// What an impulse of 1 does to all bodies: along the normal of each contact and across it.
    columns: Vec<Vec<Twist>>,
    /// What that is at all contacts.
    pub(super) coupled: Coupled,
}

impl<'a> Together<'a> {
    pub(super) fn new(joints: &'a Factored<'a>, contacts: &'a [Meeting]) -> Self {
        let (mut columns, mut gives) = (Vec::new(), Vec::new());
        let speeds = |twists: &[Twist]| contacts.iter().map(|of| of.rates(twists)).collect();
        for (k, contact) in contacts.iter().enumerate() {
            for (axis, impulse) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
                let mut column = vec![Twist::STILL; joints.inertias.len()];
                contact.push(joints.inertias, &mut column, impulse);
                let alone = contact.rates(&column)[axis];
                joints.hold(&mut column, &[]);
                let own = contact.rates(&column)[axis];
                if own <= HELD * alone {
                    column.fill(Twist::STILL);
                }
                let all: Vec<[f64; 2]> = speeds(&column);
                debug_assert!(all[k][axis] >= 0.0);
                columns.push(column);
                gives.push(all);
            }
        }
        let inverses = joints.inertias.iter().flat_map(|of| of.inverse);
        let mass = inverses.filter(|inverse| *inverse > 0.0).map(|inverse| 1.0 / inverse).sum();
        let smooth = (0..contacts.len()).filter(|&k| contacts[k].is_string()).collect();
        Together { joints, contacts, columns, coupled: Coupled { gives, mass, rounding: ROUNDING, smooth } }
    }

    /// What the law asks of each contact.
    pub(super) fn rubs(&self) -> Vec<Rub> {
        self.contacts.iter().map(|contact| contact.rub).collect()
    }

    /// The work `[J]` of points that are led, and of drives, where joints and these impulses made the second of two motions of the first.
    pub(super) fn works(&self, (before, after): (&[Twist], &[Twist]), impulses: &[Impulse]) -> [f64; 2] {
        if !self.joints.does_work() {
            return [0.0; 2];
        }
        let between = |(from, to): (&Twist, &Twist)| Twist {
            velocity: sub(to.velocity, from.velocity),
            spin: to.spin - from.spin,
        };
        let mut changes: Vec<Twist> = before.iter().zip(after).map(between).collect();
        let mut work = 0.0;
        for (contact, impulse) in self.contacts.iter().zip(impulses) {
            contact.push(self.joints.inertias, &mut changes, impulse.map(|push| -push));
            work += contact.work_of_lead(impulse[0]);
        }
        let [led, driven] = self.joints.works(&changes);
        [led + work, driven]
    }

    /// The direction along the surface of a contact.
    pub(super) fn tangent(&self, contact: usize) -> [f64; 2] {
        self.contacts[contact].tangent()
    }

    /// The motion that keeps joints and surfaces by Coulomb's law, from one that need not; rows of joints get their targets.
    pub(super) fn press(
        &self,
        (before, targets): (&[Twist], &[f64]),
        rubs: &[Rub],
        guess: &[Impulse],
    ) -> (Vec<Twist>, Pressed<Speeds>) {
        let mut held = before.to_vec();
        self.joints.hold(&mut held, targets);
        let pressed = press_or_stop(&self.coupled, &self.seen(&held), rubs, guess);
        let twists = self.moved(&held, &pressed);
        (twists, pressed)
    }

    /// What the law needs to know of a motion that keeps the joints.
    pub(super) fn seen(&self, twists: &[Twist]) -> Speeds {
        let energy = |(of, twist): (&Inertia, &Twist)| of.energy(twist);
        Speeds {
            speeds: self.contacts.iter().map(|contact| contact.speeds(twists)).collect(),
            energy: self.joints.inertias.iter().zip(twists).map(energy).sum(),
        }
    }

    /// The motion of all bodies that impulses made.
    pub(super) fn moved(&self, before: &[Twist], pressed: &Pressed<Speeds>) -> Vec<Twist> {
        if pressed.is_stopped {
            return vec![Twist::STILL; before.len()];
        }
        let mut twists = before.to_vec();
        for (column, share) in self.columns.iter().zip(pressed.impulses.iter().flatten()) {
            for (twist, by) in twists.iter_mut().zip(column) {
                twist.velocity = add(twist.velocity, scale(by.velocity, *share));
                twist.spin += by.spin * share;
            }
        }
        if pressed.share < 1.0 {
            for twist in &mut twists {
                twist.velocity = scale(twist.velocity, pressed.share);
                twist.spin *= pressed.share;
            }
        }
        twists
    }
}
