//! Splitting methods: kicks by forces and flights without them, in a palindrome of coefficients.
//!
//! A flight is the exact motion under gravity and drag, so a thrown point is right at any substep, and drag does not
//! lower the order: what the forces of springs and mouse add depends on positions alone. Symplectic without drag: the
//! energy of undamped motion does not drift. Dampers make forces depend on velocities: order 2, whatever the method.

use super::flight::Flight;
use super::verlet::Kick;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;

/// One part of a substep, as a share of h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Part {
    /// v += a(x) c h.
    Kick(f64),
    /// Flight over c h.
    Flight(f64),
}

/// The first half of a palindrome, up to and with its middle.
fn palindrome(half: &[Part]) -> Vec<Part> {
    let mirrored = half[..half.len() - 1].iter().rev();
    half.iter().chain(mirrored).copied().collect()
}

/// Verlet's method: kick, flight, kick. Order 2, stable up to omega h = 2, one force a substep.
/// Source: L. Verlet, Phys. Rev. 159, 98 (1967); W. C. Swope et al., J. Chem. Phys. 76, 637 (1982).
pub(crate) fn verlet() -> Vec<Part> {
    palindrome(&[Part::Kick(0.5), Part::Flight(1.0)])
}

/// Semi-implicit Euler: kick, flight. Order 1, symplectic, stable up to omega h = 2.
pub(crate) fn symplectic_euler() -> Vec<Part> {
    vec![Part::Kick(1.0), Part::Flight(1.0)]
}

/// Flight alone: where no force acts.
pub(crate) fn flight() -> Vec<Part> {
    vec![Part::Flight(1.0)]
}

/// PEFRL: order 4, stable up to omega h = 2.97, four forces a substep.
/// Source: I. P. Omelyan, I. M. Mryglod, R. Folk, Comput. Phys. Commun. 146, 188 (2002), eq. (20), (22).
pub(crate) fn pefrl() -> Vec<Part> {
    const XI: f64 = 0.178_617_895_844_809_1;
    const LAMBDA: f64 = -0.212_341_831_062_605_4;
    const CHI: f64 = -0.066_264_582_669_818_5;
    palindrome(&[
        Part::Flight(XI),
        Part::Kick(0.5 - LAMBDA),
        Part::Flight(CHI),
        Part::Kick(LAMBDA),
        Part::Flight(1.0 - 2.0 * (CHI + XI)),
    ])
}

/// Order 4 in six forces a substep, for forces that depend on positions (SRKN_6^b).
/// Source: S. Blanes and P. C. Moan, J. Comput. Appl. Math. 142, 313 (2002), table 3.
pub(crate) fn blanes_moan_4() -> Vec<Part> {
    const A: [f64; 2] = [0.245_298_957_184_271, 0.604_872_665_711_08];
    const B: [f64; 3] = [0.082_984_406_417_405_2, 0.396_309_801_498_368, -0.039_056_304_922_348_6];
    palindrome(&[
        Part::Kick(B[0]),
        Part::Flight(A[0]),
        Part::Kick(B[1]),
        Part::Flight(A[1]),
        Part::Kick(B[2]),
        Part::Flight(0.5 - (A[0] + A[1])),
        Part::Kick(1.0 - 2.0 * (B[0] + B[1] + B[2])),
    ])
}

/// Order 6 in fourteen forces a substep, for forces that depend on positions (SRKN_14^a).
/// Source: S. Blanes and P. C. Moan, J. Comput. Appl. Math. 142, 313 (2002), table 3.
pub(crate) fn blanes_moan_6() -> Vec<Part> {
    const A: [f64; 7] = [
        0.037_859_319_840_611_6,
        0.102_635_633_102_435,
        -0.025_867_888_266_558_7,
        0.314_241_403_071_447,
        -0.130_144_459_517_415,
        0.106_417_700_369_543,
        -0.008_794_243_128_510_58,
    ];
    const B: [f64; 6] = [
        0.091_719_152_624_461_65,
        0.183_983_170_005_006,
        -0.056_534_365_832_888_27,
        0.004_914_688_774_712_854,
        0.143_761_127_168_358,
        0.328_567_693_746_804,
    ];
    let last_flight = 1.0 - 2.0 * A.iter().sum::<f64>();
    let last_kick = 0.5 - B.iter().sum::<f64>();
    let mut half = Vec::new();
    for k in 0..7 {
        half.push(Part::Flight(A[k]));
        half.push(Part::Kick(if k < 6 { B[k] } else { last_kick }));
    }
    half.push(Part::Flight(last_flight));
    palindrome(&half)
}

/// A splitting method with what it keeps from substep to substep.
#[derive(Clone, Debug)]
pub(crate) struct Splitting<S, const D: usize> {
    parts: Vec<Part>,
    /// What `parts` amount to in the substep `made_for`.
    moves: Vec<Move<S, D>>,
    made_for: f64,
    /// Accelerations belong to the present positions.
    pub(crate) fresh: bool,
}

/// A kick, a flight, or one after the other in one pass over the points.
#[derive(Clone, Copy, Debug)]
struct Move<S, const D: usize> {
    kick: Option<Kick<S, D>>,
    flight: Option<Flight<S, D>>,
    /// When it begins, and how long its kick is [s after the start of the substep, s].
    begins: f64,
    kicks: f64,
}

impl<S: Real, const D: usize> Splitting<S, D> {
    pub(crate) fn new(parts: Vec<Part>) -> Self {
        Splitting { parts, moves: Vec::new(), made_for: f64::NAN, fresh: false }
    }

    /// What a substep is made of.
    pub(crate) fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Whether forces act on the points at all.
    pub(crate) fn has_kicks(&self) -> bool {
        self.parts.iter().any(|part| matches!(part, Part::Kick(_)))
    }

    /// Advances by `h` from time `t`.
    pub(crate) fn step(
        &mut self,
        points: &mut Points<S, D>,
        pull: &mut Pull<S, D>,
        around: &Environment<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
    ) {
        if h != self.made_for {
            self.prepare(pull, h);
        }
        for Move { kick, flight, begins, kicks } in &self.moves {
            if kick.is_some() {
                if pull.is_damped() {
                    let gravity = pull.kicking_gravity();
                    pull.push_ahead(around, (t + begins, *kicks), gravity, points, counters);
                } else if !self.fresh {
                    pull.push(around, t + begins, points, counters);
                }
                self.fresh = !pull.is_damped();
            }
            match (kick, flight) {
                (Some(kick), Some(flight)) => flight.take_kicked(points, kick),
                (Some(kick), None) => kick.give(points),
                (None, Some(flight)) => flight.take(points),
                (None, None) => {}
            }
            self.fresh &= flight.is_none();
        }
    }

    fn prepare(&mut self, pull: &Pull<S, D>, h: f64) {
        self.moves.clear();
        self.made_for = h;
        let mut flown = 0.0;
        for part in &self.parts {
            match *part {
                Part::Kick(share) => self.moves.push(Move {
                    kick: Some(Kick::new(pull.kicking_gravity(), share * h)),
                    flight: None,
                    // The last kick is at the end, whatever rounding made of the flights.
                    begins: if (1.0 - flown).abs() < 1e-12 { h } else { flown * h },
                    kicks: share * h,
                }),
                Part::Flight(share) => {
                    let flight = Some(Flight::new(pull.flying_gravity(), pull.drag_rate, share * h));
                    match self.moves.last_mut() {
                        Some(last) if last.flight.is_none() => last.flight = flight,
                        _ => self.moves.push(Move { kick: None, flight, begins: flown * h, kicks: 0.0 }),
                    }
                    flown += share;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sums(parts: &[Part]) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for part in parts {
            match part {
                Part::Kick(c) => sums[0] += c,
                Part::Flight(c) => sums[1] += c,
            }
        }
        sums
    }

    #[test]
    fn kicks_and_flights_each_make_a_whole_substep() {
        for parts in [verlet(), symplectic_euler(), pefrl(), blanes_moan_4(), blanes_moan_6()] {
            let [kicks, flights] = sums(&parts);
            assert!((kicks - 1.0).abs() < 1e-14 && (flights - 1.0).abs() < 1e-14, "{parts:?}");
        }
    }

    #[test]
    fn methods_read_the_same_backwards() {
        for parts in [verlet(), pefrl(), blanes_moan_4(), blanes_moan_6()] {
            let backwards: Vec<Part> = parts.iter().rev().copied().collect();
            assert_eq!(parts, backwards);
        }
    }
}
