//! What acts on a cluster from outside (mouse, forces, wind), and its work.
//!
//! The work of an impulse J is J . (u0 + u1)/2 with the velocities before and after it. Springs, bonds and contacts answer in the same
//! substep, and take from the point some of what J gave it: of that answer, as of J itself, half counts. So what pushes against springs
//! that hold it does nothing.

use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// Who gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Giver {
    Mouse,
    Forces,
    Wind,
}

/// A point got faster.
#[derive(Clone, Copy, Debug)]
struct Gift<S, const D: usize> {
    point: u32,
    giver: Giver,
    /// By so much, and by that part of it that the guard is told of `[m/s]`.
    gain: [S; D],
    seen: [S; D],
    /// Twice its mean velocity, as far as it is known `[m/s]`.
    twice: [S; D],
}

/// All that was given in a substep.
#[derive(Clone, Debug)]
pub(super) struct Given<S, const D: usize> {
    gifts: Vec<Gift<S, D>>,
    /// What springs that are forces answered before anything was given, one entry a point `[m/s]`; empty where nothing gives.
    answered: Vec<[S; D]>,
}

/// What was done in a substep, by whom, and as far as the guard is told of it `[J]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Works<S> {
    pub(super) mouse: S,
    pub(super) forces: S,
    pub(super) wind: S,
    pub(super) seen: S,
}

impl<S: Real, const D: usize> Given<S, D> {
    pub(super) fn none() -> Self {
        Given { gifts: Vec::new(), answered: Vec::new() }
    }

    /// A substep begins with these velocities `[m/s]`, in which something gives.
    pub(super) fn begin(&mut self, velocity: &[[S; D]], gives: bool) {
        self.gifts.clear();
        self.answered.clear();
        if gives {
            self.answered.extend(velocity.iter().map(|&v| scale(v, -S::ONE)));
        }
    }

    /// Springs that are forces changed velocities, and nothing else did.
    pub(super) fn note_answers(&mut self, velocity: &[[S; D]]) {
        self.answered.iter_mut().zip(velocity).for_each(|(answered, &v)| *answered = add(*answered, v));
    }

    /// A point gets faster by `gain` `[m/s]`, of which the guard is told `seen`.
    #[inline(always)]
    pub(super) fn give(&mut self, velocity: &mut [[S; D]], i: usize, giver: Giver, [gain, seen]: [[S; D]; 2]) {
        let before = velocity[i];
        velocity[i] = add(before, gain);
        self.gifts.push(Gift { point: i as u32, giver, gain, seen, twice: add(before, velocity[i]) });
    }

    /// All was given; what changes velocities from here on answers.
    pub(super) fn close(&mut self, velocity: &[[S; D]]) {
        self.gifts.iter_mut().for_each(|gift| gift.twice = sub(gift.twice, velocity[gift.point as usize]));
    }

    /// The works of a substep that ended with these velocities `[m/s]`, of points of these inverse masses `[1/kg]`.
    pub(super) fn works(&self, velocity: &[[S; D]], w: &[S]) -> Works<S> {
        let mut works = Works { mouse: S::ZERO, forces: S::ZERO, wind: S::ZERO, seen: S::ZERO };
        for gift in &self.gifts {
            let i = gift.point as usize;
            let answered = self.answered.get(i).copied().unwrap_or(zero());
            let momentum = scale(sub(add(gift.twice, velocity[i]), answered), S::HALF / w[i]);
            let done = dot(gift.gain, momentum);
            match gift.giver {
                Giver::Mouse => works.mouse += done,
                Giver::Forces => works.forces += done,
                Giver::Wind => works.wind += done,
            }
            works.seen += dot(gift.seen, momentum);
        }
        works
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point of 2 kg that goes at `begun` is pulled by a spring as hard as a force pushes it the other way: its works in the substep.
    fn works_against_a_spring(begun: f64) -> f64 {
        let mut velocity = [[begun, 0.0]];
        let mut given = Given::<f64, 2>::none();
        given.begin(&velocity, true);
        velocity[0][0] -= 0.5;
        given.note_answers(&velocity);
        given.give(&mut velocity, 0, Giver::Forces, [[0.5, 0.0]; 2]);
        given.close(&velocity);
        given.works(&velocity, &[0.5]).forces
    }

    #[test]
    fn a_force_that_a_spring_holds_works_by_the_way_alone() {
        assert_eq!(works_against_a_spring(0.0), 0.0);
        // An impulse of 1 N s at 3 m/s.
        assert!((works_against_a_spring(3.0) - 3.0).abs() < 1e-15);
    }
}
