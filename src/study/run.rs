//! One run of a method over a problem, and the ladder of steps that it is run at.

use serde::Serialize;

/// How long runs may take and how close the rungs of a ladder are.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Settings {
    /// Wall time of the longest run `[s]`.
    pub cap_seconds: f64,
    /// Factor between the steps of two rungs, where runs are short.
    pub factor: f64,
}

impl Settings {
    /// What a study is made with.
    pub const FULL: Settings = Settings { cap_seconds: 0.5, factor: std::f64::consts::SQRT_2 };
    /// Coarser and shorter: for tests, and for a look.
    pub const QUICK: Settings = Settings { cap_seconds: 0.05, factor: 2.0 };
}

/// What a run did and how far it was off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Run {
    /// Steps asked for over the whole run; a method may split them.
    pub steps: u64,
    /// Step asked for `[s]`.
    pub substep: f64,
    /// Wall time of the stepping `[s]`.
    pub seconds: f64,
    /// Wall seconds per simulated second `[1]`.
    pub cost: f64,
    /// Largest distance over points from the truth at the last sample `[m]`; infinite (in JSON null) if it diverged.
    pub error: f64,
    /// The same over all samples `[m]`.
    pub largest_error: f64,
    /// Energy at the last sample less that at the first, over the largest one in size `[1]`.
    pub energy_drift: Option<f64>,
    /// Work done.
    pub work: Work,
}

/// The work of a run, counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Work {
    /// Substeps taken.
    pub substeps: u64,
    /// Bonds evaluated or swept.
    pub bonds_solved: u64,
    /// Points advanced.
    pub points_moved: u64,
    /// Sweeps over the bonds.
    pub iterations: u64,
    /// Points that touched a wall.
    pub events: u64,
    /// Substeps that did not converge.
    pub fallbacks: u64,
}

impl Work {
    /// Whether steps were split or did not converge, so that a run of smaller steps may well be quicker.
    fn is_swollen(&self, steps: u64) -> bool {
        self.fallbacks > 0 || self.substeps > 2 * steps
    }
}

impl Run {
    /// A run that is nowhere near the truth.
    pub(super) const DIVERGED: Run = Run {
        steps: 0,
        substep: 0.0,
        seconds: f64::INFINITY,
        cost: f64::INFINITY,
        error: f64::INFINITY,
        largest_error: f64::INFINITY,
        energy_drift: None,
        work: Work { substeps: 0, bonds_solved: 0, points_moved: 0, iterations: 0, events: 0, fallbacks: 0 },
    };
}

/// Wall time that a run is read for, together, before its median counts `[s]`.
const ENOUGH: f64 = 0.1;

/// Most readings of one run.
const READINGS: f64 = 15.0;

/// The median wall time of a run whose first reading is known; the shorter it is, the more often it is read `[s]`.
///
/// A run of more than 50 ms is read once.
pub(super) fn median_seconds(first: f64, mut read: impl FnMut() -> f64) -> f64 {
    // At least 3, or there is no median; odd, so that it is a reading.
    let count = ((ENOUGH / first).min(READINGS) as usize) | 1;
    if count < 3 {
        return first;
    }
    let mut readings: Vec<f64> = (0..count).map(|_| read()).collect();
    readings.sort_by(f64::total_cmp);
    readings[count / 2]
}

/// Runs longer than this are a factor 2 apart: close rungs there would cost more than they tell `[s]`.
const LONG: f64 = 0.02;

/// How many times longer than the cap a run may take whose steps were split or did not converge.
const SWOLLEN: f64 = 4.0;

/// An error that a finer step cannot lower, for rounding is as large `[m]`.
const EXACT: f64 = 1e-12;

/// An error below which a ladder that goes nowhere has met its floor `[m]`.
const NEAR_EXACT: f64 = 1e-7;

/// Most steps of a run: a method that takes no time at all ends here.
const MOST_STEPS: u64 = 1 << 40;

/// Runs a method at ever smaller steps: from one step a sample (at least 4) on, each a multiple of `samples`.
///
/// Ends when the next run would exceed the cap, or the error is exact or has met its floor. A run that diverged ends
/// nothing: a smaller step may be stable.
pub(super) fn ladder(settings: &Settings, samples: u64, mut run: impl FnMut(u64) -> Run) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let mut a_sample = 4_u64.div_ceil(samples);
    let mut exact = a_sample as f64;
    loop {
        let done = run(a_sample * samples);
        runs.push(done);
        let before = a_sample;
        while a_sample == before {
            exact *= if done.seconds > LONG { 2.0 } else { settings.factor };
            a_sample = exact.round() as u64;
        }
        let ratio = if done.work.is_swollen(done.steps) { 1.0 / SWOLLEN } else { a_sample as f64 / before as f64 };
        if done.seconds * ratio > settings.cap_seconds
            || a_sample * samples > MOST_STEPS
            || done.largest_error < EXACT
            || has_met_floor(&runs)
        {
            return runs;
        }
    }
}

/// Whether the last four errors are no better than what came before, and that is near exact.
fn has_met_floor(runs: &[Run]) -> bool {
    let Some(split) = runs.len().checked_sub(4) else { return false };
    let least = |runs: &[Run]| runs.iter().map(|run| run.error).fold(f64::INFINITY, f64::min);
    let (before, last) = (least(&runs[..split]), least(&runs[split..]));
    before < NEAR_EXACT && last > 0.5 * before
}

/// A run of which only cost and error count.
#[cfg(test)]
pub(super) fn sketch(steps: u64, cost: f64, error: f64) -> Run {
    Run {
        steps,
        substep: 1.0 / steps as f64,
        seconds: cost,
        cost,
        error,
        largest_error: error,
        energy_drift: None,
        work: Work::default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(settings: &Settings, samples: u64, error: impl Fn(u64) -> f64) -> Vec<u64> {
        let runs = ladder(settings, samples, |steps| sketch(steps, steps as f64 * 1e-3, error(steps)));
        runs.iter().map(|run| run.steps).collect()
    }

    #[test]
    fn rungs_are_multiples_of_the_samples_up_to_the_cap() {
        let settings = Settings { cap_seconds: 0.1, factor: std::f64::consts::SQRT_2 };
        assert_eq!(steps(&settings, 4, |_| 1.0), [4, 8, 12, 16, 24, 44, 92]);
        assert_eq!(steps(&settings, 1, |_| 1.0)[..4], [4, 6, 8, 11]);
    }

    #[test]
    fn an_exact_method_runs_once_and_a_diverged_one_goes_on() {
        assert_eq!(steps(&Settings::QUICK, 4, |_| 0.0), [4]);
        assert_eq!(steps(&Settings::QUICK, 4, |n| if n < 16 { f64::INFINITY } else { 1e-13 }), [4, 8, 16]);
    }

    #[test]
    fn a_floor_ends_the_ladder() {
        let settings = Settings { cap_seconds: 1e9, factor: 2.0 };
        let runs = steps(&settings, 4, |n| (n as f64).powi(-8).max(1e-11));
        assert!(runs.len() < 12, "{runs:?}");
    }

    #[test]
    fn steps_that_are_split_do_not_end_the_ladder() {
        let settings = Settings { cap_seconds: 0.1, factor: 2.0 };
        let runs = ladder(&settings, 4, |steps| {
            let is_split = steps < 16;
            let work = Work { substeps: if is_split { 900 } else { steps }, ..Work::default() };
            Run { work, ..sketch(steps, if is_split { 0.2 } else { steps as f64 * 1e-3 }, 1.0) }
        });
        assert_eq!(runs.iter().map(|run| run.steps).collect::<Vec<_>>(), [4, 8, 16, 32, 64]);
    }

    #[test]
    fn a_short_run_is_read_again_and_a_long_one_is_not() {
        let mut readings = 0.0;
        let median = median_seconds(1e-6, || {
            readings += 1.0;
            readings
        });
        assert_eq!((median, readings), (8.0, 15.0));
        assert_eq!(median_seconds(0.03, || 1.0), 1.0);
        assert_eq!(median_seconds(0.5, || 0.0), 0.5);
        assert_eq!(median_seconds(0.0, || 1.0), 1.0);
    }
}
