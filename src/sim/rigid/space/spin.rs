//! How a rigid body turns by itself, by power series of its motion: to rounding, whatever its inertia.
//!
//! Model: seen in the shape, with the angular momentum l, the spin w = J l, a torque u and a weight f at the lever c that stay as they are in
//! the world, and the turn p since the start as a quaternion
//!
//! ```text
//! l' = l x w + c x f + u - gamma l        u' = u x w        f' = f x w        p' = p w / 2
//! ```
//!
//! All of that is products, so each coefficient of the series is a sum of products of those before. A part is as long as the last terms
//! vanish in rounding.
//! Source: K. R. Meyer, SIAM J. Numer. Anal. 28 (1991), for such series of polynomial systems; A. Jorba, M. Zou, Exp. Math. 14, 99 (2005), for
//! lengths of steps by their last terms.

use super::place::{Turn, times};
use super::shape::Shape;
use crate::sim::vector::{add, cross3, dot, length, scale};

/// Terms of a series: more make parts longer and dearer. About a turn of 1 rad is a part.
const TERMS: usize = 20;
/// Share of the largest term that the last ones may be.
const VANISHES: f64 = 1e-17;
/// Most parts of a flight: what spins on after that is not followed.
const MOST_PARTS: u32 = 1 << 18;
/// Halvings of a part.
const HALVINGS: u32 = 200;
/// Operations of a part, about.
pub(super) const OF_A_PART: u64 = 12_000;

/// What turns a body for a while, seen in the shape at its start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Torque {
    /// The same in the world for all of the time `[N m]`.
    pub(super) torque: [f64; 3],
    /// The weight of a body that is pinned `[N]`.
    pub(super) weight: [f64; 3],
    pub(super) drag_rate: f64,
}

impl Torque {
    pub(super) const NONE: Self = Torque { torque: [0.0; 3], weight: [0.0; 3], drag_rate: 0.0 };
}

/// Where a body has turned.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turned {
    /// Since the start, as the shape saw it there.
    pub(super) turn: Turn,
    /// In the shape as it lies then `[rad/s]`.
    pub(super) spin: [f64; 3],
    pub(super) parts: u32,
}

/// A body with this spin `[rad/s]`, seen in the shape, turns on for `h` `[s]`. What no part is short enough for is no number.
pub(super) fn turned(shape: &Shape, spin: [f64; 3], by: &Torque, h: f64) -> Turned {
    let mut turn = Turn([1.0, 0.0, 0.0, 0.0]);
    let mut state = State { momentum: shape.left(times(&shape.inertia, spin)), torque: by.torque, weight: by.weight };
    let (mut done, mut parts) = (0.0, 0);
    let is_still = spin == [0.0; 3] && by.torque == [0.0; 3] && by.weight == [0.0; 3];
    while done < h && !is_still {
        let series = Series::of(shape, &state, by.drag_rate);
        let Some(part) = series.part(h - done).filter(|_| parts < MOST_PARTS) else {
            return Turned { turn, spin: [f64::NAN; 3], parts };
        };
        let (next, by) = series.at(part);
        (state, turn) = (next, turn.then(by));
        // A part that is all that is left ends there to the bit.
        done = if part == h - done { h } else { done + part };
        parts += 1;
    }
    let spin = if parts == 0 { spin } else { times(&shape.inverse, state.momentum) };
    Turned { turn, spin, parts }
}

#[derive(Clone, Copy, Debug)]
struct State {
    momentum: [f64; 3],
    torque: [f64; 3],
    weight: [f64; 3],
}

/// Coefficients by powers of time.
struct Series {
    momentum: [[f64; 3]; TERMS],
    torque: [[f64; 3]; TERMS],
    weight: [[f64; 3]; TERMS],
    turn: [[f64; 4]; TERMS],
}

impl Series {
    fn of(shape: &Shape, start: &State, drag_rate: f64) -> Self {
        let none = [[0.0; 3]; TERMS];
        let mut of = Series { momentum: none, torque: none, weight: none, turn: [[0.0; 4]; TERMS] };
        let mut spin = none;
        (of.momentum[0], of.torque[0], of.weight[0]) = (start.momentum, start.torque, start.weight);
        of.turn[0] = [1.0, 0.0, 0.0, 0.0];
        let [has_torque, has_weight] = [start.torque, start.weight].map(|v| v != [0.0; 3]);
        for n in 0..TERMS - 1 {
            spin[n] = times(&shape.inverse, of.momentum[n]);
            let share = 1.0 / (n + 1) as f64;
            let carried = |list: &[[f64; 3]; TERMS]| {
                let sum = (0..=n).fold([0.0; 3], |sum, k| add(sum, cross3(list[k], spin[n - k])));
                scale(sum, share)
            };
            let mut pushed = scale(of.momentum[n], -drag_rate);
            if has_weight {
                pushed = add(pushed, cross3(shape.centre, of.weight[n]));
                of.weight[n + 1] = carried(&of.weight);
            }
            if has_torque {
                pushed = add(pushed, of.torque[n]);
                of.torque[n + 1] = carried(&of.torque);
            }
            of.momentum[n + 1] = shape.left(add(carried(&of.momentum), scale(pushed, share)));
            let sum = (0..=n).fold([0.0; 4], |sum, k| add(sum, spun(of.turn[k], spin[n - k])));
            of.turn[n + 1] = scale(sum, 0.5 * share);
        }
        of
    }

    /// How long a part of at most `h` `[s]` may be; `None`: nothing is short enough.
    fn part(&self, h: f64) -> Option<f64> {
        let mut part = h;
        for _ in 0..HALVINGS {
            let is_short = vanishes(&self.momentum, part)
                && vanishes(&self.turn, part)
                && vanishes(&self.torque, part)
                && vanishes(&self.weight, part);
            if is_short {
                return Some(part);
            }
            part *= 0.5;
        }
        None
    }

    /// The state after a time `[s]`, and the turn until then.
    fn at(&self, time: f64) -> (State, Turn) {
        let state = State {
            momentum: sum(&self.momentum, time),
            torque: sum(&self.torque, time),
            weight: sum(&self.weight, time),
        };
        (state, Turn(sum(&self.turn, time)).unit())
    }
}

impl Turn {
    /// This one, then another as the shape sees it that has turned.
    fn then(self, next: Turn) -> Turn {
        let ([a, u @ ..], [b, v @ ..]) = (self.0, next.0);
        let [x, y, z] = add(add(scale(v, a), scale(u, b)), cross3(u, v));
        Turn([a * b - dot(u, v), x, y, z]).unit()
    }
}

/// A quaternion times a vector.
fn spun([a, u @ ..]: [f64; 4], w: [f64; 3]) -> [f64; 4] {
    let [x, y, z] = add(scale(w, a), cross3(u, w));
    [-dot(u, w), x, y, z]
}

/// Whether the last two terms are nothing beside the largest.
fn vanishes<const N: usize>(series: &[[f64; N]; TERMS], time: f64) -> bool {
    let (mut power, mut most, mut last) = (1.0, 0.0_f64, 0.0);
    for (n, term) in series.iter().enumerate() {
        let size = length(*term) * power;
        // What is no number never vanishes.
        most = if size <= most { most } else { size };
        last = if n + 2 >= TERMS { last + size } else { 0.0 };
        power *= time;
    }
    last <= VANISHES * most
}

/// From the last term to the first (Horner).
fn sum<const N: usize>(series: &[[f64; N]; TERMS], time: f64) -> [f64; N] {
    series.iter().rev().fold([0.0; N], |sum, term| add(*term, scale(sum, time)))
}

#[cfg(test)]
mod tests {
    use super::super::layout::Held;
    use super::*;
    use crate::sim::vector::sub;

    /// A box with corners of 1 kg and these half sides; `pins` of them are pinned.
    fn brick(half: [f64; 3], pins: &[usize]) -> Shape {
        let now: Vec<[f64; 3]> =
            (0..8_u32).map(|n| std::array::from_fn(|k| if n >> k & 1 == 1 { half[k] } else { -half[k] })).collect();
        let ends = (0..8_u32).flat_map(|a| (a + 1..8).map(move |b| [a, b]));
        let bonds = ends.map(|[a, b]| ([a, b], length(sub(now[a as usize], now[b as usize])))).collect();
        let mut masses = vec![1.0; 8];
        pins.iter().for_each(|&pin| masses[pin] = f64::INFINITY);
        Shape::of(Held { now, masses, bonds }).unwrap_or_else(|| unreachable!("it is rigid"))
    }

    /// Moments about the axes of the shape.
    fn moments(shape: &Shape) -> [f64; 3] {
        std::array::from_fn(|k| shape.inertia[k][k])
    }

    #[test]
    fn a_symmetric_top_precesses_at_its_rate() {
        let shape = brick([0.5, 0.5, 0.2], &[]);
        // Its moments ascend from the first axis to the last: that alone differs.
        let [_, across, own] = moments(&shape);
        let spin = [0.8, 0.0, 3.0];
        let rate = (own - across) / across * spin[2];
        let t = 20.0;
        let end = turned(&shape, spin, &Torque::NONE, t).spin;
        let expected = [0.8 * libm::cos(rate * t), 0.8 * libm::sin(rate * t), 3.0];
        assert!(length(sub(end, expected)) < 1e-12, "{end:?} {expected:?}");
    }

    #[test]
    fn an_asymmetric_top_comes_back_after_the_period_of_jacobis_functions() {
        let shape = brick([0.6, 0.4, 0.1], &[]);
        let [a, b, c] = moments(&shape);
        for spin in [[0.2, 0.1, 3.0], [3.0, 0.1, 0.2], [1e-3, 2.0, 0.0], [0.0, 2.0, 1e-3]] {
            let energy = a * spin[0] * spin[0] + b * spin[1] * spin[1] + c * spin[2] * spin[2];
            let square = (a * spin[0]).powi(2) + (b * spin[1]).powi(2) + (c * spin[2]).powi(2);
            // Landau and Lifshitz, Mechanics, section 37, for a < b < c and L^2 > 2 E b; else the ends change places.
            let (a, c) = if square > energy * b { (a, c) } else { (c, a) };
            let rate = ((c - b) * (square - energy * a) / (a * b * c)).sqrt();
            let modulus = ((b - a) * (energy * c - square) / ((c - b) * (square - energy * a))).sqrt();
            let period = 4.0 * quarter(modulus) / rate;
            let end = turned(&shape, spin, &Torque::NONE, period).spin;
            // What sets out beside the middle axis stays there for long, and errs by as much more.
            let most = 1e-9 * length(spin);
            assert!(length(sub(end, spin)) < most, "{spin:?}: {end:?} after {period}");
            let half = turned(&shape, spin, &Torque::NONE, 0.5 * period).spin;
            assert!((half[1] + spin[1]).abs() < most, "{half:?}");
        }
    }

    /// The complete elliptic integral of the first kind, by the arithmetic-geometric mean.
    fn quarter(modulus: f64) -> f64 {
        let (mut a, mut b) = (1.0, (1.0 - modulus * modulus).sqrt());
        for _ in 0..40 {
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
        }
        0.5 * std::f64::consts::PI / a
    }

    #[test]
    fn drag_slows_a_spin_by_its_rate_and_changes_no_direction_of_the_momentum() {
        let shape = brick([0.6, 0.4, 0.1], &[]);
        let by = Torque { drag_rate: 0.7, ..Torque::NONE };
        let spin = [1.0, 2.0, 0.5];
        let end = turned(&shape, spin, &by, 2.0);
        let [before, after] = [spin, end.spin].map(|spin| length(times(&shape.inertia, spin)));
        assert!((after / before - libm::exp(-1.4)).abs() < 1e-14);
    }

    #[test]
    fn a_torque_that_stays_in_the_world_adds_to_the_momentum_there() {
        let shape = brick([0.6, 0.4, 0.1], &[]);
        let torque = [0.4, -1.0, 0.3];
        let (spin, t) = ([1.0, 2.0, 0.5], 3.0);
        let end = turned(&shape, spin, &Torque { torque, ..Torque::NONE }, t);
        let before = times(&shape.inertia, spin);
        let [w, v @ ..] = end.turn.0;
        let after = times(&shape.inertia, end.spin);
        let twice = scale(cross3(v, after), 2.0);
        let after = add(add(after, scale(twice, w)), cross3(v, twice));
        assert!(length(sub(after, add(before, scale(torque, t)))) < 1e-12);
    }

    #[test]
    fn what_spins_too_fast_to_be_followed_is_no_number() {
        let shape = brick([0.6, 0.4, 0.1], &[]);
        assert!(turned(&shape, [f64::INFINITY, 0.0, 0.0], &Torque::NONE, 1.0).spin[0].is_nan());
        assert!(turned(&shape, [1e300, 1e200, 0.0], &Torque::NONE, 1.0).spin[0].is_nan());
    }
}
