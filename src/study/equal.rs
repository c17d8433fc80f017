//! Methods compared at equal error: what it costs with each, and how many times less than with the baseline.

use serde::Serialize;

use super::accuracy::MethodReport;
use super::fit::{Cost, cost_at, cost_beyond};
use super::targets::{LEVELS, REACHED, target_of};

/// A method and what an error costs with it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Priced {
    /// The method, in words.
    pub method: String,
    /// The cost.
    #[serde(flatten)]
    pub cost: Cost,
}

/// What an error costs with every method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EqualError {
    /// The error `[m]`.
    pub error: f64,
    /// The cheapest variant of the baseline; `None`: it never gets there.
    pub baseline: Option<Priced>,
    /// Every method that gets there within the cap, the cheapest first.
    pub methods: Vec<Priced>,
    /// Cost of the baseline over that of the best method; infinite (in JSON null) where the baseline never gets there.
    pub ratio: Option<f64>,
    /// The ratio to reach; infinite (in JSON null) where the baseline never gets there.
    pub target: Option<f64>,
    /// Whether it is reached within 20 %.
    pub is_reached: Option<bool>,
}

impl EqualError {
    /// The cheapest method.
    pub fn best(&self) -> Option<&Priced> {
        self.methods.first()
    }
}

/// Compares all methods of a problem at each of [`LEVELS`].
pub(super) fn compare(problem: &str, baseline: &[MethodReport], methods: &[MethodReport]) -> Vec<EqualError> {
    let target = target_of(problem);
    let level = |(i, error): (usize, f64)| {
        let baseline_runs = baseline.iter().any(|report| report.refused.is_none());
        let baseline = cheapest(baseline, |report| cost_beyond(&report.runs, error)).into_iter().next();
        let methods = cheapest(methods, |report| cost_at(&report.runs, error));
        let ratio = methods.first().filter(|_| baseline_runs).map(|best| match &baseline {
            Some(baseline) => baseline.cost.cost / best.cost.cost,
            None => f64::INFINITY,
        });
        let target = target.map(|target| target.ratios[i]);
        let is_reached = target.map(|target| ratio.is_some_and(|ratio| ratio >= REACHED * target));
        EqualError { error, baseline, methods, ratio, target, is_reached }
    };
    LEVELS.into_iter().enumerate().map(level).collect()
}

/// The methods that have a cost, the cheapest first; a measured one comes before one that is carried on.
fn cheapest(reports: &[MethodReport], cost: impl Fn(&MethodReport) -> Option<Cost>) -> Vec<Priced> {
    let priced = |report: &MethodReport| Some(Priced { method: report.method.clone(), cost: cost(report)? });
    let mut list: Vec<Priced> = reports.iter().filter_map(priced).collect();
    list.sort_by(|a, b| {
        let guessed = a.cost.is_extrapolated.cmp(&b.cost.is_extrapolated);
        guessed.then(a.cost.cost.total_cmp(&b.cost.cost))
    });
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::run::sketch;

    fn report(method: &str, per_step: f64, order: i32) -> MethodReport {
        let runs = (2..14).map(|i| 1_u64 << i);
        let runs = runs.map(|n| sketch(n, n as f64 * per_step, (1.0 / n as f64).powi(order)));
        MethodReport {
            method: method.to_owned(),
            solver: "verlet",
            refused: None,
            runs: runs.collect(),
            observed_order: Some(f64::from(order)),
        }
    }

    #[test]
    fn the_ratio_is_of_the_cheapest_on_both_sides() {
        let baseline = [report("1 sweep", 1.0, 1), report("4 sweeps", 4.0, 1)];
        let methods = [report("a", 2.0, 2), report("b", 11.0, 4)];
        let [coarse, fine] = &compare("B1_osc", &baseline, &methods)[..] else { panic!() };
        assert_eq!(coarse.baseline.as_ref().unwrap().method, "1 sweep");
        assert_eq!(coarse.best().unwrap().method, "b");
        let expected = 1e3 / (11.0 * 1e3_f64.powf(0.25));
        assert!((coarse.ratio.unwrap() / expected - 1.0).abs() < 1e-9);
        assert_eq!((coarse.target, coarse.is_reached), (Some(14.0), Some(true)));
        assert!(fine.baseline.as_ref().unwrap().cost.is_extrapolated);
        assert_eq!(fine.is_reached, Some(false), "{:?}", fine.ratio);
    }

    #[test]
    fn a_baseline_that_never_gets_there_makes_the_ratio_infinite() {
        let never = [report("never", 1.0, 0)];
        let level = &compare("M1_bounce", &never, &[report("a", 1.0, 2)])[0];
        assert_eq!((level.ratio, level.is_reached), (Some(f64::INFINITY), Some(true)));
        let none = &compare("M1_bounce", &never, &[])[0];
        assert_eq!((none.ratio, none.is_reached), (None, Some(false)));
        assert_eq!(compare("A1_freefall", &never, &[])[0].is_reached, None);
    }
}
