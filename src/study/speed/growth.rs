//! How the cost of a frame grows with the number of points.

use serde::Serialize;

use super::super::fit::slope;
use super::run::SpeedRun;

/// A row of `growth.csv`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GrowthRow {
    /// Scenes that differ only in size.
    pub family: &'static str,
    /// How they were run.
    pub method: String,
    /// How many sizes there are.
    pub sizes: usize,
    /// The exponent p of cost = c points^p, by least squares in logarithms.
    pub exponent: f64,
    /// The same of substeps a frame.
    pub substeps_exponent: f64,
}

/// The exponents of all families of at least three sizes.
pub(super) fn exponents(runs: &[SpeedRun]) -> Vec<GrowthRow> {
    let mut keys: Vec<(&'static str, &str)> = runs.iter().map(|run| (run.family, run.method.as_str())).collect();
    keys.sort_unstable();
    keys.dedup();
    let row = |(family, method): (&'static str, &str)| {
        let same = || runs.iter().filter(move |run| run.family == family && run.method == method);
        let of = |cost: fn(&SpeedRun) -> f64| {
            let points: Vec<(f64, f64)> = same().map(|run| ((run.points as f64).ln(), cost(run).ln())).collect();
            slope(&points)
        };
        let (exponent, substeps_exponent) = (of(|run| run.median_ms)?, of(|run| run.substeps)?);
        Some(GrowthRow { family, method: method.to_owned(), sizes: same().count(), exponent, substeps_exponent })
    };
    keys.into_iter().filter_map(row).collect()
}
