//! What a ladder of runs says: the observed order, and the cost at an error.

use serde::Serialize;

use super::run::Run;

/// Errors that an order is read from `[m]`: above, a motion is not resolved; below, rounding shows.
const CLEAN: std::ops::Range<f64> = 1e-10..1e-2;

/// Decades of error, counted from the smallest, that a slope is fitted over.
const DECADES: f64 = 2.0;

/// Fewest runs that a slope is fitted through.
const FEWEST: usize = 3;

/// Orders below this are none: the method does not converge there.
const LEAST_ORDER: f64 = 0.3;

/// Runs in a row that must be within an error.
const LASTING: usize = 3;

/// What an error costs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Wall seconds per simulated second `[1]`.
    pub cost: f64,
    /// Whether no run came so far: the cost is carried on along the fitted order.
    pub is_extrapolated: bool,
}

/// The observed order: slope of log error against log step, by least squares.
///
/// Fitted over the last two decades (at least three runs) of the longest stretch of runs whose errors are between
/// 1e-10 and 1e-2 and fall; where no three fall in a row, over all runs between. `None`: fewer than three.
pub(super) fn order(runs: &[Run]) -> Option<f64> {
    let clean: Vec<&Run> = runs.iter().filter(|run| CLEAN.contains(&run.error)).collect();
    let falling = clean.chunk_by(|coarse, fine| fine.error < coarse.error);
    // The last of the longest: finer runs say more.
    let longest = falling.max_by_key(|stretch| stretch.len()).filter(|stretch| stretch.len() >= FEWEST);
    let stretch = longest.unwrap_or(&clean);
    let least = stretch.iter().map(|run| run.error).fold(f64::INFINITY, f64::min);
    let within = stretch.iter().filter(|run| run.error <= least * 10_f64.powf(DECADES)).count().max(FEWEST);
    let last = &stretch[stretch.len().saturating_sub(within)..];
    slope(&last.iter().map(|run| (run.substep.ln(), run.error.ln())).collect::<Vec<_>>())
}

/// Slope of the line through points by least squares; `None` for fewer than three.
pub(super) fn slope(points: &[(f64, f64)]) -> Option<f64> {
    if points.len() < FEWEST {
        return None;
    }
    let count = points.len() as f64;
    let (mx, my) = points.iter().fold((0.0, 0.0), |(mx, my), (x, y)| (mx + x / count, my + y / count));
    let (xx, xy) =
        points.iter().fold((0.0, 0.0), |(xx, xy), (x, y)| (xx + (x - mx) * (x - mx), xy + (x - mx) * (y - my)));
    (xx > 0.0).then(|| xy / xx)
}

/// The cost of an error of at most `error` `[m]`, by interpolation between runs, both logarithmic.
///
/// A run counts only if the next two finer ones are within the error too: one that hit it by chance says nothing.
/// Where even the coarsest run is within, it is its cost. `None`: no run is.
pub(super) fn cost_at(runs: &[Run], error: f64) -> Option<Cost> {
    let reached = (0..runs.len()).find(|&i| lasting_error(runs, i) <= error)?;
    let fine = &runs[reached];
    let measured = |cost: f64| Some(Cost { cost, is_extrapolated: false });
    let Some(coarse) = reached.checked_sub(1).map(|i| &runs[i]) else {
        return measured(fine.cost);
    };
    // Nothing to draw a line through where the coarser run diverged or the finer one is exact.
    if !coarse.error.is_finite() || fine.error == 0.0 {
        return measured(fine.cost);
    }
    let share = (coarse.error / error).ln() / (coarse.error / fine.error).ln();
    measured(coarse.cost * (fine.cost / coarse.cost).powf(share))
}

/// The largest error of a run and the next two finer ones `[m]`.
fn lasting_error(runs: &[Run], i: usize) -> f64 {
    runs[i..].iter().take(LASTING).map(|run| run.error).fold(0.0, f64::max)
}

/// As [`cost_at`]; beyond the best run carried on along the observed order.
pub(super) fn cost_beyond(runs: &[Run], error: f64) -> Option<Cost> {
    cost_at(runs, error).or_else(|| {
        let order = order(runs).filter(|&order| order > LEAST_ORDER)?;
        // Not from the last run, which rounding may have had the better of, nor from one that hit by chance.
        let lasting = runs.iter().enumerate().map(|(i, run)| (run.cost, lasting_error(runs, i)));
        let (best, reached) = lasting.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|best| best.1.is_finite())?;
        let cost = best * (reached / error).powf(1.0 / order);
        Some(Cost { cost, is_extrapolated: true })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::run::sketch;

    /// Runs of 4, 8, … steps at a cost of 1 a step.
    fn runs(error: impl Fn(f64) -> f64) -> Vec<Run> {
        (2..16).map(|i| 1_u64 << i).map(|n| sketch(n, n as f64, error(1.0 / n as f64))).collect()
    }

    #[test]
    fn the_order_of_a_power_is_its_exponent() {
        for p in [1, 2, 4] {
            let order = order(&runs(|h| 0.3 * h.powi(p))).unwrap();
            assert!((order - f64::from(p)).abs() < 1e-12, "{order}");
        }
    }

    #[test]
    fn unresolved_runs_and_the_floor_are_left_out() {
        let with_floor = runs(|h| if h > 0.02 { 1.0 } else { (h * h).max(1e-9) });
        assert!((order(&with_floor).unwrap() - 2.0).abs() < 0.05);
        assert_eq!(order(&runs(|_| 1.0)), None);
        let flat = order(&runs(|_| 1e-4)).unwrap();
        assert!(flat.abs() < 1e-12, "{flat}");
    }

    #[test]
    fn the_asymptotic_end_decides() {
        let bent = order(&runs(|h| h + 200.0 * h * h)).unwrap();
        assert!((bent - 1.0).abs() < 0.2, "{bent}");
    }

    #[test]
    fn interpolation_is_exact_on_a_power() {
        let runs = runs(|h| 0.3 * h * h);
        let cost = cost_at(&runs, 1e-5).unwrap();
        assert!((cost.cost - (0.3_f64 / 1e-5).sqrt()).abs() < 1e-9, "{cost:?}");
        assert!(!cost.is_extrapolated);
        assert_eq!(cost_at(&runs, 1e-12), None);
    }

    #[test]
    fn a_hit_by_chance_does_not_count() {
        let mut runs = runs(|h| h);
        runs[1].error = 1e-9;
        let cost = cost_at(&runs, 1e-3).unwrap();
        assert!((cost.cost - 1000.0).abs() < 1e-9, "{cost:?}");
    }

    #[test]
    fn a_floor_of_rounding_does_not_raise_the_cost() {
        let mut runs = runs(|h| h);
        runs.extend([(1 << 16, 0.002), (1 << 17, 0.004)].map(|(n, error)| sketch(n, n as f64, error)));
        let cost = cost_at(&runs, 1e-3).unwrap();
        assert!((cost.cost - 1000.0).abs() < 1e-9, "{cost:?}");
        let cost = cost_beyond(&runs, 1e-6).unwrap();
        assert!((cost.cost / 1e6 - 1.0).abs() < 1e-9, "{cost:?}");
    }

    #[test]
    fn the_coarsest_run_and_a_diverged_one_are_bounds() {
        let exact = runs(|_| 0.0);
        assert_eq!(cost_at(&exact, 1e-3).unwrap().cost, 4.0);
        let unstable = runs(|h| if h > 0.01 { f64::INFINITY } else { h.powi(4) });
        assert_eq!(cost_at(&unstable, 1e-3).unwrap().cost, 128.0);
    }

    #[test]
    fn extrapolation_follows_the_order_or_is_none() {
        let cost = cost_beyond(&runs(|h| h), 1e-6).unwrap();
        assert!(cost.is_extrapolated && (cost.cost / 1e6 - 1.0).abs() < 1e-9, "{cost:?}");
        assert_eq!(cost_beyond(&runs(|_| 0.1), 1e-6), None);
        assert_eq!(cost_beyond(&runs(|_| 1e-3), 1e-6), None);
    }
}
