//! Explicit Runge-Kutta methods on positions and velocities.
//!
//! Rigid bonds enter as accelerations (Lagrange's multipliers of index 1) in every stage; what the truncation error
//! takes the points off the bonds by is projected away after the step, positions first, then velocities.
//! Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, VII.2.

use std::cmp::Ordering;

use super::tableau::{LONGEST_ROW, Tableau};
use crate::sim::constrain::direct::Direct;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::accumulate;

/// The state at the start of a step, of the stage under way, and the slopes of all stages: rows of numbers, first those
/// of the positions, then those of the velocities.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stages<S> {
    start: Vec<S>,
    state: Vec<S>,
    slopes: Vec<Vec<S>>,
    /// The largest error of a step that is let pass `[m]`, and for how long an error of a velocity is taken to last `[s]`; `None`: nobody asks.
    checked: Option<(S, S)>,
}

impl<S: Real> Stages<S> {
    /// Room for `count` numbers of positions, and as many of velocities, in `stages` stages.
    pub(crate) fn new(count: usize, stages: usize) -> Self {
        let row = vec![S::ZERO; 2 * count];
        Stages { start: row.clone(), state: row.clone(), slopes: vec![row; stages], checked: None }
    }

    /// With steps refused whose error is larger than `most` `[m]`, that of velocities times `lasts` `[s]` included, where the table has an
    /// estimate of it.
    pub(crate) fn checked(self, most: S, lasts: f64) -> Self {
        Stages { checked: Some((most, S::from_f64(lasts))), ..self }
    }
}

/// Advances by `h` from time `t`. Returns whether rigid bonds could be held; a substep beyond the limit of stability
/// of taut bonds is not begun, and one whose error is seen to be too large, where that is asked, not ended.
pub(crate) fn step<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    pull: &mut Pull<S, D>,
    Stages { start, state, slopes, checked }: &mut Stages<S>,
    table: &Tableau,
    around: &Environment<D>,
    (t, h): (f64, f64),
    counters: &mut Counters,
) -> bool {
    let half = points.len() * D;
    start[..half].copy_from_slice(points.position.as_flattened());
    start[half..].copy_from_slice(points.velocity.as_flattened());
    for (s, coefficients) in table.stages.iter().enumerate() {
        let time = t + table.nodes[s] * h;
        if s > 0 {
            combine(state, start, slopes, coefficients, h);
        }
        let now = if s > 0 { &*state } else { &*start };
        let (x, v) = now.split_at(half);
        let (slope, a) = slopes[s].split_at_mut(half);
        slope.copy_from_slice(v);
        let (x, v, a) = (chunks(x), chunks(v), chunks_mut(a));
        if s == 0
            && let Some(rigid) = &mut pull.rigid
        {
            rigid.tighten(x, v);
        }
        pull.accelerate(around, time, (x, v, &points.inverse_mass), a, counters);
        if s == 0 {
            while pull.rigid.as_mut().is_some_and(Direct::slacken) {
                pull.accelerate(around, time, (x, v, &points.inverse_mass), a, counters);
            }
            let most = table.stability / h;
            let too_fast = |rigid: &Direct<S, D>| rigid.frequency_square().to_f64() > most * most;
            if pull.rigid.as_ref().is_some_and(too_fast) {
                return false;
            }
        }
    }
    if let (Some((most, lasts)), Some(rows)) = (*checked, table.errors) {
        let error = error((state, lasts), slopes, rows, h);
        // NaN is refused.
        if error.partial_cmp(&most).is_none_or(Ordering::is_gt) {
            return false;
        }
    }
    let Points { position, position_lost, velocity, velocity_lost, .. } = points;
    add_up(position.as_flattened_mut(), position_lost.as_flattened_mut(), (slopes, 0), table.weights, h);
    add_up(velocity.as_flattened_mut(), velocity_lost.as_flattened_mut(), (slopes, half), table.weights, h);
    pull.restore(points, counters)
}

/// An estimate of the error of a step `[m]`: of positions, and of velocities as long as they last, all together; that of order 5, less what the
/// one of order 3 says that it is too large by. Source: as of the table, II.10.
fn error<S: Real>((sums, lasts): (&mut [S], S), slopes: &[Vec<S>], [of_5, of_3]: [&[(usize, f64)]; 2], h: f64) -> S {
    let half = sums.len() / 2;
    let mut squares = |row: &[(usize, f64)]| {
        sum_up(sums, slopes, row, h);
        let square = |list: &[S]| list.iter().fold(S::ZERO, |sum, &e| sum + e * e);
        square(&sums[..half]) + lasts * lasts * square(&sums[half..])
    };
    let (fine, coarse) = (squares(of_5), squares(of_3));
    let both = fine + S::from_f64(0.01) * coarse;
    if both == S::ZERO { S::ZERO } else { fine / both.sqrt() }
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
    /// Of the numbers of the slopes from `first` on.
    fn new((slopes, first): (&'a [Vec<S>], usize), row: &[(usize, f64)], h: f64, count: usize) -> Self {
        Sum {
            slopes: std::array::from_fn(|k| &slopes[row[k].0][first..first + count]),
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

    /// out = the sum.
    fn write(&self, out: &mut [S]) {
        for (i, out) in out.iter_mut().enumerate() {
            *out = self.of(i);
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
        by_length!($row, $n => $call, 1 2 3 4 5 6 7 8)
    };
    ($row:expr, $n:ident => $call:expr, $($length:literal)*) => {
        match $row.len() {
            $($length => {
                const $n: usize = $length;
                $call
            })*
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
    by_length!(row, N => Sum::<S, N>::new((slopes, 0), row, h, base.len()).add_to(base, out));
}

/// out = h sum of row_j slopes_j.
fn sum_up<S: Real>(out: &mut [S], slopes: &[Vec<S>], row: &[(usize, f64)], h: f64) {
    by_length!(row, N => Sum::<S, N>::new((slopes, 0), row, h, out.len()).write(out));
}

/// x += h sum of row_j slopes_j, compensated.
fn add_up<S: Real>(x: &mut [S], lost: &mut [S], slopes: (&[Vec<S>], usize), row: &[(usize, f64)], h: f64) {
    by_length!(row, N => Sum::<S, N>::new(slopes, row, h, x.len()).accumulate(x, lost));
}
