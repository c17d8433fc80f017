//! A point near a triangle: on which side it belongs, how hard they press each other, how they rub.

use super::cluster::Cluster;
use super::geometry::{Beside, Passage, beside, nearest, passage, volume};
use super::touch::{MENDED, rub};
use crate::sim::live::contact::{lacking, pressed};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// The side of a triangle that a point belongs to, by the numbers of both.
pub(super) type Sides = Vec<(u64, i8)>;

/// A point near a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<S> {
    /// Places in the cluster: the point, then the corners.
    pub(super) points: [u32; 4],
    /// Numbers of point and triangle for ever.
    pub(super) key: u64,
    /// +1: the point belongs where the corners are anticlockwise; -1: on the other side.
    pub(super) side: S,
    /// Distance that they keep `[m]`, and how far they were from that when they were found.
    pub(super) distance: S,
    pub(super) room: S,
    pub(super) friction: S,
    pub(super) restitution: S,
    /// What presses them apart in this substep `[kg m]`, and what rubs.
    pub(super) pressed: S,
    pub(super) rubbed: [S; 3],
    pub(super) slips: bool,
    /// Overlap from before the substep, which is not to become speed `[m]`.
    pub(super) old: S,
    /// Normal speed before they were solved `[m/s]`.
    pub(super) approach: S,
    pub(super) is_met: bool,
}

impl<S: Real> Pair<S> {
    /// The substep begins anew.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        (self.pressed, self.rubbed, self.old, self.is_met) = (S::ZERO, zero(), S::ZERO, false);
    }

    /// Its points in a list.
    #[inline(always)]
    pub(super) fn of<T: Copy>(&self, list: &[T]) -> [T; 4] {
        let [p, a, b, c] = self.points;
        [list[p as usize], list[a as usize], list[b as usize], list[c as usize]]
    }

    /// Parts point and triangle where they are nearer than they may be.
    #[inline(always)]
    pub(super) fn press(&mut self, state: &mut Cluster<S>) {
        let Some(Beside { shares, normal, mut gap }) = beside(self.of(&state.now), self.side) else { return };
        if gap >= self.distance && self.pressed == S::ZERO {
            return;
        }
        let shares = signed(shares);
        let own = self.of(&state.w);
        let w = (0..4).fold(S::ZERO, |sum, k| sum + shares[k] * shares[k] * own[k]);
        if w == S::ZERO {
            return;
        }
        if !self.is_met {
            // What comes from behind, around a side, is no contact.
            let Some(before) = beside(self.of(&state.start), self.side) else { return };
            self.is_met = true;
            self.approach = dot(mean(self.of(&state.velocity), shares), normal);
            let overlap = (self.distance - before.gap).max(S::ZERO);
            if overlap > S::ZERO {
                let mended = overlap * S::from_f64(MENDED);
                for k in 0..4 {
                    state.put(self.points[k] as usize, scale(normal, mended / w * shares[k] * own[k]));
                }
                gap += mended;
                self.old = overlap - mended;
            }
        }
        let before = self.pressed;
        self.pressed = pressed(before, self.distance - self.old - gap, w);
        let d = mean(self.of(&state.way), shares);
        let (rubbed, slips) = rub(self.rubbed, (d, normal), (w, self.friction * self.pressed));
        let impulse = add(scale(normal, self.pressed - before), sub(rubbed, self.rubbed));
        (self.rubbed, self.slips) = (rubbed, slips);
        for k in 0..4 {
            state.shift(self.points[k] as usize, scale(impulse, shares[k] * own[k]));
        }
    }

    /// Where the point went around the triangle in this substep the side is the other one.
    pub(super) fn follow(&mut self, state: &Cluster<S>) {
        let (before, now) = (self.of(&state.start), self.of(&state.now));
        if self.side * volume(now) >= S::ZERO {
            return;
        }
        // Beside a triangle, in whose plane it may lie, a point changes sides all the time, by rounding too: there no side means anything.
        let found = nearest(before);
        let most = (1..4).fold(S::ZERO, |most, k| {
            let way = sub(sub(now[0], before[0]), sub(now[k], before[k]));
            most.max(dot(way, way))
        });
        let is_beside = !found.is_within && dot(found.from, found.from) > most;
        let was_right = self.side * volume(before) >= S::ZERO;
        if is_beside || was_right && passage(before, now) != Passage::Through {
            self.side = -self.side;
        }
    }

    /// Gives the normal velocity that restitution asks for, where they pressed each other and came faster than `least` `[m/s]`.
    pub(super) fn bounce(&self, state: &mut Cluster<S>, least: S) {
        if self.restitution == S::ZERO || self.pressed == S::ZERO || self.approach > -least {
            return;
        }
        let Some(Beside { shares, normal, .. }) = beside(self.of(&state.now), self.side) else { return };
        let (shares, own) = (signed(shares), self.of(&state.w));
        let w = (0..4).fold(S::ZERO, |sum, k| sum + shares[k] * shares[k] * own[k]);
        let speed = dot(mean(self.of(&state.velocity), shares), normal);
        let lacking = lacking(self.restitution, self.approach, speed);
        if lacking > S::ZERO && w > S::ZERO {
            for (k, i) in self.points.into_iter().enumerate() {
                let gain = scale(normal, lacking / w * shares[k] * own[k]);
                state.velocity[i as usize] = add(state.velocity[i as usize], gain);
            }
        }
    }
}

/// What the point and the corners count for in the distance of both.
#[inline(always)]
pub(super) fn signed<S: Real>([a, b, c]: [S; 3]) -> [S; 4] {
    [S::ONE, -a, -b, -c]
}

#[inline(always)]
pub(super) fn mean<S: Real>(list: [[S; 3]; 4], shares: [S; 4]) -> [S; 3] {
    (0..4).fold(zero(), |sum, k| add(sum, scale(list[k], shares[k])))
}
