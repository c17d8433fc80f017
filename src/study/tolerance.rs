//! Runs where the program is told the error instead of the step, or nothing at all.

use std::time::Instant;

use serde::Serialize;

use super::methods::errors;
use super::problems::Truth;
use super::setting::tune;
use crate::scene::record::{record, seconds};
use crate::scene::{PrecisionName, Scene, SolverName};

/// The errors that are asked for `[m]`; `None`: nothing is, and the scene runs as it does by default.
pub const TOLERANCES: [Option<f64>; 3] = [None, Some(1e-4), Some(1e-6)];

/// Share of the size of a scene that its default may be off by.
const TRUSTED: f64 = 1e-3;

/// What came of asking for an error.
#[derive(Clone, Debug, Serialize)]
pub struct ToleranceReport {
    /// The error asked for at every sample `[m]`; `None`: nothing was.
    pub tolerance: Option<f64>,
    /// Why the scene does not take it, if so.
    pub refused: Option<String>,
    /// The error at every sample `[m]`.
    pub errors: Vec<f64>,
    /// The longest side of a box around all points at all samples `[m]`.
    pub size: f64,
    /// Whether all of them are within the tolerance; where nothing was asked for, within a thousandth of the size.
    pub holds: Option<bool>,
    /// The solver that was found.
    pub solver: Option<String>,
    /// The substep that was found `[s]`.
    pub substep: Option<f64>,
    /// The error that was foretold `[m]`.
    pub expected_error: Option<f64>,
    /// Wall time of the stepping `[s]`.
    pub seconds: Option<f64>,
    /// Wall time of finding method and substep `[s]`.
    pub search_seconds: Option<f64>,
}

/// Asks for an error on a scene and compares what comes with the truth.
pub(super) fn measure(scene: &Scene, truth: &Truth, tolerance: Option<f64>) -> ToleranceReport {
    let mut report = ToleranceReport {
        tolerance,
        refused: None,
        errors: Vec::new(),
        size: truth.size(),
        holds: None,
        solver: None,
        substep: None,
        expected_error: None,
        seconds: None,
        search_seconds: None,
    };
    let mut scene = scene.clone();
    scene.parameters.clear();
    scene.method.solver = Some(SolverName::Auto);
    scene.method.precision = Some(PrecisionName::F64);
    scene.method.tolerance = tolerance;
    let times = truth.times();
    let begun = Instant::now();
    let start = tune(&mut scene, &times).and_then(|found| Ok((found, scene.world(times.last().copied())?)));
    let (found, start) = match start {
        Ok(start) => start,
        Err(error) => {
            report.refused = Some(error.message);
            return report;
        }
    };
    report.search_seconds = Some(begun.elapsed().as_secs_f64());
    report.solver = Some(scene.method.solver.unwrap_or(SolverName::Auto).name().to_owned());
    report.substep = Some(start.substep());
    report.expected_error = found.map(|found| found.expected_error);
    if let Ok(samples) = record(&mut *start.boxed_clone(), &times, |_| ()) {
        report.errors = errors(truth, &samples);
        report.seconds = Some(seconds(&*start, &times));
    }
    let most = tolerance.unwrap_or(TRUSTED * report.size);
    let all_within = report.errors.iter().all(|&error| error <= most);
    report.holds = Some(report.errors.len() == times.len() && all_within);
    report
}
