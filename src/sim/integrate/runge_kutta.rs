//! Explicit Runge-Kutta methods on positions and velocities.
//!
//! Rigid bonds enter as accelerations (Lagrange's multipliers of index 1) in every stage; what the truncation error
//! takes the points off the bonds by is projected away after the step, positions first, then velocities.
//! Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, VII.2.

use super::tableau::Tableau;
use super::verlet::accumulate;
use crate::sim::constrain::direct::Direct;
use crate::sim::counters::Counters;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::surroundings::Surroundings;

/// Numbers that are combined at once.
const BLOCK: usize = 8;

/// Slopes of all stages and the state of the one under way, stage by stage, D numbers a point.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stages<S> {
    velocity: Vec<Vec<S>>,
    acceleration: Vec<Vec<S>>,
    position: Vec<S>,
    /// Coefficients of one row times h.
    row: Vec<(usize, S)>,
}

impl<S: Real> Stages<S> {
    /// Room for `count` numbers in `stages` stages.
    pub(crate) fn new(count: usize, stages: usize) -> Self {
        Stages {
            velocity: vec![vec![S::ZERO; count]; stages],
            acceleration: vec![vec![S::ZERO; count]; stages],
            position: vec![S::ZERO; count],
            row: Vec::with_capacity(stages),
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
        scale_row(&mut stages.row, coefficients, h);
        combine(&mut stages.position, points.position.as_flattened(), &stages.velocity, &stages.row);
        let (_, rest) = stages.velocity.split_at_mut(s);
        combine(&mut rest[0], points.velocity.as_flattened(), &stages.acceleration, &stages.row);
        let (v, a) = (chunks(&stages.velocity[s]), chunks_mut(&mut stages.acceleration[s]));
        pull.accelerate(around, time, (chunks(&stages.position), v, &points.inverse_mass), a, counters);
    }
    scale_row(&mut stages.row, table.weights, h);
    add_up(&mut points.position, &mut points.position_lost, &stages.velocity, &stages.row);
    add_up(&mut points.velocity, &mut points.velocity_lost, &stages.acceleration, &stages.row);
    pull.project(points, counters)
}

fn chunks<S, const D: usize>(list: &[S]) -> &[[S; D]] {
    list.as_chunks().0
}

fn chunks_mut<S, const D: usize>(list: &mut [S]) -> &mut [[S; D]] {
    list.as_chunks_mut().0
}

fn scale_row<S: Real>(row: &mut Vec<(usize, S)>, coefficients: &[(usize, f64)], h: f64) {
    row.clear();
    row.extend(coefficients.iter().map(|&(j, a)| (j, S::from_f64(a * h))));
}

/// out = base + sum of row_j slopes_j.
fn combine<S: Real>(out: &mut [S], base: &[S], slopes: &[Vec<S>], row: &[(usize, S)]) {
    for (block, (out, base)) in out.chunks_mut(BLOCK).zip(base.chunks(BLOCK)).enumerate() {
        let sum = weighted(slopes, row, block * BLOCK, out.len());
        for k in 0..out.len() {
            out[k] = base[k] + sum[k];
        }
    }
}

/// The sum of row_j slopes_j over `length` numbers from `start` on.
#[inline(always)]
fn weighted<S: Real>(slopes: &[Vec<S>], row: &[(usize, S)], start: usize, length: usize) -> [S; BLOCK] {
    let mut sum = [S::ZERO; BLOCK];
    for &(j, a) in row {
        let slope = &slopes[j][start..start + length];
        if let Ok(slope) = <&[S; BLOCK]>::try_from(slope) {
            for k in 0..BLOCK {
                sum[k] += a * slope[k];
            }
        } else {
            for k in 0..length {
                sum[k] += a * slope[k];
            }
        }
    }
    sum
}

/// sum += row_j slopes_j, compensated.
fn add_up<S: Real, const D: usize>(sum: &mut [[S; D]], lost: &mut [[S; D]], slopes: &[Vec<S>], row: &[(usize, S)]) {
    for (i, (sum, lost)) in sum.iter_mut().zip(lost).enumerate() {
        let increment = weighted(slopes, row, i * D, D);
        accumulate(sum, lost, std::array::from_fn(|k| increment[k]));
    }
}
