//! Splitting methods: kicks by forces and flights without them, in a palindrome of coefficients.
//!
//! A flight is the exact motion under gravity and drag, so a thrown point is right at any substep, and drag does not
//! lower the order: what the forces of springs and mouse add depends on positions alone. Symplectic without drag: the
//! energy of undamped motion does not drift. Dampers make forces depend on velocities: order 2, whatever the method.

use super::verlet::{Split, accumulate};
use crate::sim::counters::Counters;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::surroundings::Surroundings;
use crate::sim::vector::{add, convert, scale, sub, widen};

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

/// Constants of a flight over one stretch of time.
#[derive(Clone, Copy, Debug)]
struct Flight<S, const D: usize> {
    /// Displacement is v times this [s].
    reach: Split<S>,
    /// Velocities keep this share.
    keep: S,
    /// Displacement by gravity [m], in two parts.
    fall: [[S; D]; 2],
    /// Change of velocity by gravity [m/s], in two parts.
    gain: [[S; D]; 2],
    /// The stretch [s]: how far pins go.
    time: Split<S>,
}

/// A vector in two parts.
fn parts<S: Real, const D: usize>(vector: [f64; D]) -> [[S; D]; 2] {
    let high = convert(vector);
    [high, convert(sub(vector, widen(high)))]
}

impl<S: Real, const D: usize> Flight<S, D> {
    /// v' = g - r v: v(h) = v e + g phi, x(h) = x + v phi + g psi; e = exp(-r h), phi = (1 - e)/r, psi = (h - phi)/r.
    fn new(gravity: [f64; D], rate: f64, h: f64) -> Self {
        let (keep, phi, psi) = if rate == 0.0 {
            (1.0, h, 0.5 * h * h)
        } else {
            let phi = -libm::expm1(-rate * h) / rate;
            (libm::exp(-rate * h), phi, fall_time(rate * h) * h * h)
        };
        Flight {
            reach: Split::new(phi),
            keep: S::from_f64(keep),
            fall: parts(gravity.map(|g| g * psi)),
            gain: parts(gravity.map(|g| g * phi)),
            time: Split::new(h),
        }
    }
}

/// (z - 1 + exp(-z))/z^2, by its series where the difference would cancel.
fn fall_time(z: f64) -> f64 {
    if z.abs() > 0.1 {
        return (z + libm::expm1(-z)) / (z * z);
    }
    let mut term = 0.5;
    let mut sum = term;
    for n in 3..14 {
        term *= -z / f64::from(n);
        sum += term;
    }
    sum
}

/// A splitting method with what it keeps from substep to substep.
#[derive(Clone, Debug)]
pub(crate) struct Splitting<S, const D: usize> {
    parts: Vec<Part>,
    /// Flights of `parts`, for the substep `made_for`.
    flights: Vec<Flight<S, D>>,
    made_for: f64,
    /// Accelerations belong to the present positions.
    pub(crate) fresh: bool,
}

impl<S: Real, const D: usize> Splitting<S, D> {
    pub(crate) fn new(parts: Vec<Part>) -> Self {
        Splitting { parts, flights: Vec::new(), made_for: f64::NAN, fresh: false }
    }

    /// What a substep is made of.
    pub(crate) fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Advances by `h` from time `t`.
    pub(crate) fn step(
        &mut self,
        points: &mut Points<S, D>,
        pull: &mut Pull<S, D>,
        around: &Surroundings<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
    ) {
        if h != self.made_for {
            self.prepare(pull, h);
        }
        let (mut time, mut flown) = (t, 0);
        for at in 0..self.parts.len() {
            match self.parts[at] {
                Part::Kick(share) => {
                    let gravity = pull.kicking_gravity();
                    if pull.is_damped {
                        pull.push_ahead(around, (time, share * h), gravity, points, counters);
                    } else if !self.fresh {
                        pull.push(around, time, points, counters);
                    }
                    super::verlet::kick(points, gravity, share * h);
                    self.fresh = !pull.is_damped;
                }
                Part::Flight(share) => {
                    fly(points, &self.flights[flown]);
                    flown += 1;
                    time = if at + 1 == self.parts.len() { t + h } else { time + share * h };
                    self.fresh = false;
                }
            }
        }
    }

    fn prepare(&mut self, pull: &Pull<S, D>, h: f64) {
        let flights = self.parts.iter().filter_map(|part| match part {
            Part::Flight(share) => Some(Flight::new(pull.flying_gravity(), pull.drag_rate, share * h)),
            Part::Kick(_) => None,
        });
        self.flights = flights.collect();
        self.made_for = h;
    }
}

/// Moves every point by its flight; pins go straight on.
fn fly<S: Real, const D: usize>(points: &mut Points<S, D>, flight: &Flight<S, D>) {
    let drags = flight.keep != S::ONE;
    let falls = flight.gain != [[S::ZERO; D]; 2];
    for i in 0..points.len() {
        let v = points.velocity[i];
        let lost = points.velocity_lost[i];
        let is_free = points.inverse_mass[i] != S::ZERO;
        let reach = if is_free { flight.reach } else { flight.time };
        let fine = add(scale(v, reach.low), scale(lost, reach.high));
        let mut way = add(scale(v, reach.high), fine);
        if is_free {
            if drags {
                points.velocity[i] = scale(v, flight.keep);
                points.velocity_lost[i] = scale(lost, flight.keep);
            }
            if falls {
                way = add(way, add(flight.fall[0], flight.fall[1]));
                points.velocity_lost[i] = add(points.velocity_lost[i], flight.gain[1]);
                accumulate(&mut points.velocity[i], &mut points.velocity_lost[i], flight.gain[0]);
            }
        }
        accumulate(&mut points.position[i], &mut points.position_lost[i], way);
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

    #[test]
    fn a_flight_with_little_drag_is_one_without() {
        let (with, without) = (fall_time(1e-9), 0.5);
        assert!((with - without).abs() < 1e-9);
        assert!((fall_time(0.0999) - fall_time(0.1001)).abs() < 1e-4);
        assert!((fall_time(0.1) - (0.1 - 1.0 + (-0.1_f64).exp()) / 0.01).abs() < 1e-13);
    }
}
