//! A rope of 50 rigid bonds whose motion is known (problem F4): what a frame costs at an error in metres.

use serde::Serialize;

use super::super::error::StudyError;
use super::super::methods::{Variant, run};
use super::super::problems;
use super::run::FRAME;
use crate::scene::SolverName;

/// What the peers' table calls it.
pub(super) const PEER: &str = "rope 50 (F4)";
/// The problem.
const PROBLEM: &str = "F4_rope50";
/// Frames until the truth's last sample at 2 s.
const FRAMES: u64 = 120;
/// Substeps a frame.
const RUNGS: [u64; 8] = [1, 2, 4, 8, 16, 32, 64, 128];
/// An error that no finer substep has to follow `[m]`.
const ENOUGH: f64 = 1e-6;

/// A row of `rope50.csv`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReferenceRow {
    /// The solver.
    pub solver: &'static str,
    /// Substeps a frame.
    pub substeps: u64,
    /// Wall time over frames `[ms]`.
    pub mean_ms: f64,
    /// Largest distance of a point from where it should be after 2 s `[m]`.
    pub error_m: f64,
}

/// Runs the solvers that hold rigid bonds with ever more substeps, in 64 bits.
///
/// Errors: a solver that the problem does not take, which a test excludes.
pub(super) fn measure() -> Result<Vec<ReferenceRow>, StudyError> {
    let problem = problems::find(PROBLEM).map_err(|reason| StudyError::Truth { problem: PROBLEM, reason })?;
    let (scene, truth) = (problem.scene()?, problem.truth()?);
    let mut rows = Vec::new();
    for solver in [SolverName::VelocityVerlet, SolverName::Pefrl, SolverName::Rk8, SolverName::Path] {
        let variant = Variant { solver, iterations: None, order: None };
        for substeps in RUNGS {
            let run = run(&variant.set(&scene, FRAME / substeps as f64), &truth, FRAMES * substeps)?;
            let mean_ms = 1e3 * run.seconds / FRAMES as f64;
            rows.push(ReferenceRow { solver: solver.name(), substeps, mean_ms, error_m: run.error });
            if run.error < ENOUGH {
                break;
            }
        }
    }
    Ok(rows)
}
