//! Explicit Runge-Kutta methods on positions and velocities.
//!
//! Rigid bonds enter as accelerations (Lagrange's multipliers of index 1) in every stage; what the truncation error
//! takes the points off the bonds by is projected away after the step, positions first, then velocities.
//! Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, VII.2.

use super::tableau::{LONGEST_ROW, Tableau};
use super::verlet::accumulate;
use crate::sim::constrain::direct::Direct;
use crate::sim::counters::Counters;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::surroundings::Surroundings;

/// Slopes of all stages and the state of the one under way, stage by stage, D numbers a point.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stages<S> {
    velocity: Vec<Vec<S>>,
    acceleration: Vec<Vec<S>>,
    position: Vec<S>,
}

impl<S: Real> Stages<S> {
    /// Room for `count` numbers in `stages` stages.
    pub(crate) fn new(count: usize, stages: usize) -> Self {
        Stages {
            velocity: vec![vec![S::ZERO; count]; stages],
            acceleration: vec![vec![S::ZERO; count]; stages],
            position: vec![S::ZERO; count],
        }
    }
}

/// Advances by `h` from time `t`. Returns whether rigid bonds could be held; a substep beyond the limit of stability
/// of taut bonds is not begun.
pub(crate) fn step<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    pull: &mut Pull<S, D>,
    stages: &mut Stages<S>,
    table: &Tableau,
    around: &Surroundings<D>,
    (t, h): (f64, f64),
    counters: &mut Counters,
) -> bool {
    for (s, coefficients) in table.stages.iter().enumerate() {
        let time = t + table.nodes[s] * h;
        if s == 0 {
            stages.velocity[0].copy_from_slice(points.velocity.as_flattened());
            let (v, a) = (chunks(&stages.velocity[0]), chunks_mut(&mut stages.acceleration[0]));
            if let Some(rigid) = &mut pull.rigid {
                rigid.tighten(&points.position, &points.velocity);
            }
            pull.accelerate(around, time, (&points.position, v, &points.inverse_mass), a, counters);
            while pull.rigid.as_mut().is_some_and(Direct::slacken) {
                pull.accelerate(around, time, (&points.position, v, &points.inverse_mass), a, counters);
            }
            let too_fast = |rigid: &Direct<S, D>| rigid.frequency().to_f64() * h > table.stability;
            if pull.rigid.as_ref().is_some_and(too_fast) {
                return false;
            }
            continue;
        }
        combine(&mut stages.position, points.position.as_flattened(), &stages.velocity, coefficients, h);
        let velocity = points.velocity.as_flattened();
        combine(&mut stages.velocity[s], velocity, &stages.acceleration, coefficients, h);
        let (v, a) = (chunks(&stages.velocity[s]), chunks_mut(&mut stages.acceleration[s]));
        pull.accelerate(around, time, (chunks(&stages.position), v, &points.inverse_mass), a, counters);
    }
    let Points { position, position_lost, velocity, velocity_lost, .. } = points;
    let (x, v) = (position.as_flattened_mut(), velocity.as_flattened_mut());
    add_up(x, position_lost.as_flattened_mut(), &stages.velocity, table.weights, h);
    add_up(v, velocity_lost.as_flattened_mut(), &stages.acceleration, table.weights, h);
    pull.restore(points, counters)
}

fn chunks<S, const D: usize>(list: &[S]) -> &[[S; D]] {
    list.as_chunks().0
}

fn chunks_mut<S, const D: usize>(list: &mut [S]) -> &mut [[S; D]] {
    list.as_chunks_mut().0
}

/// One row of a table times h, ready to be summed.
struct Sum<'a, S, const N: usize> {
    slopes: [&'a [S]; N],
    weights: [S; N],
}

impl<'a, S: Real, const N: usize> Sum<'a, S, N> {
    fn new(slopes: &'a [Vec<S>], row: &[(usize, f64)], h: f64, count: usize) -> Self {
        Sum {
            slopes: std::array::from_fn(|k| &slopes[row[k].0][..count]),
            weights: std::array::from_fn(|k| S::from_f64(row[k].1 * h)),
        }
    }

    /// The sum of weight times slope for one number.
    #[inline(always)]
    fn of(&self, i: usize) -> S {
        let mut sum = self.weights[0] * self.slopes[0][i];
        for k in 1..N {
            sum += self.weights[k] * self.slopes[k][i];
        }
        sum
    }

    /// out = base + the sum.
    fn add_to(&self, base: &[S], out: &mut [S]) {
        let base = &base[..out.len()];
        for (i, out) in out.iter_mut().enumerate() {
            *out = base[i] + self.of(i);
        }
    }

    /// x += the sum, compensated.
    fn accumulate(&self, x: &mut [S], lost: &mut [S]) {
        let lost = &mut lost[..x.len()];
        for (i, x) in x.iter_mut().enumerate() {
            accumulate(std::array::from_mut(x), std::array::from_mut(&mut lost[i]), [self.of(i)]);
        }
    }
}

/// Calls a function with the length of a row as a constant: what is summed is then known when it is compiled.
macro_rules! by_length {
    ($row:expr, $n:ident => $call:expr) => {
        match $row.len() {
            1 => {
                const $n: usize = 1;
                $call
            }
            2 => {
                const $n: usize = 2;
                $call
            }
            3 => {
                const $n: usize = 3;
                $call
            }
            4 => {
                const $n: usize = 4;
                $call
            }
            5 => {
                const $n: usize = 5;
                $call
            }
            6 => {
                const $n: usize = 6;
                $call
            }
            7 => {
                const $n: usize = 7;
                $call
            }
            8 => {
                const $n: usize = 8;
                $call
            }
            // The longest row that a table has.
            _ => {
                const $n: usize = LONGEST_ROW;
                $call
            }
        }
    };
}

/// out = base + h sum of row_j slopes_j.
fn combine<S: Real>(out: &mut [S], base: &[S], slopes: &[Vec<S>], row: &[(usize, f64)], h: f64) {
    by_length!(row, N => Sum::<S, N>::new(slopes, row, h, base.len()).add_to(base, out));
}

/// x += h sum of row_j slopes_j, compensated.
fn add_up<S: Real>(x: &mut [S], lost: &mut [S], slopes: &[Vec<S>], row: &[(usize, f64)], h: f64) {
    by_length!(row, N => Sum::<S, N>::new(slopes, row, h, x.len()).accumulate(x, lost));
}
