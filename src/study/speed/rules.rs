//! Whether the rules chose well: what `auto` costs beside the cheapest setting that holds the same strain.

use serde::Serialize;

use super::super::error::StudyError;
use super::run::{Limits, SpeedRun, fixed, run};
use super::scenes::SpeedScene;
use crate::sim::{Model, Solver};

/// The strain that settings are compared at `[1]`.
pub(super) const STRAIN: f64 = 0.02;
/// Substeps a frame that are tried, until one holds the strain.
const RUNGS: [u32; 16] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256];
/// Settings that would be so many times dearer than `auto` are not tried.
const DEAR: f64 = 6.0;
/// The scenes that are compared.
const SCENES: [&str; 7] =
    ["rope-1000", "net-100", "hard-100", "net-corners-100", "hard-corners-100", "rims-1000", "disc-10k"];

/// A row of `rules.csv`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RuleRow {
    /// The scene.
    pub scene: &'static str,
    /// The strain that is held at all readings `[1]`.
    pub strain: f64,
    /// What a frame costs with `auto` `[ms]`.
    pub auto_ms: f64,
    /// The cheapest other setting that holds the strain; empty if none does that is not far dearer.
    pub cheapest: Option<String>,
    /// What it costs `[ms]`.
    pub cheapest_ms: Option<f64>,
    /// Cost of `auto` over it: below 1 where `auto` is cheaper. A step of a given substep is a step of the world, which
    /// brings its points into the model's order; `auto` does that once a frame.
    pub ratio: Option<f64>,
}

/// Whether a scene is compared.
pub(super) fn is_compared(scene: &SpeedScene) -> bool {
    SCENES.contains(&scene.name)
}

/// Tries paths and sweeps with ever more substeps on a scene whose run with `auto` is known.
///
/// Errors: the model is out of order.
pub(super) fn measure(
    scene: &SpeedScene,
    model: &Model<2>,
    auto: &SpeedRun,
    seconds: f64,
) -> Result<(RuleRow, Vec<SpeedRun>), StudyError> {
    let mut runs = climb(scene, model, auto, (Solver::Path, "paths"), seconds)?;
    runs.extend(climb(scene, model, auto, (Solver::Xpbd, "sweeps"), seconds)?);
    let holding = runs.iter().filter(|run| run.is_finished && run.max_strain <= STRAIN);
    let cheapest = holding.min_by(|a, b| a.median_ms.total_cmp(&b.median_ms));
    let row = RuleRow {
        scene: scene.name,
        strain: STRAIN,
        auto_ms: auto.median_ms,
        cheapest: cheapest.map(|run| run.method.clone()),
        cheapest_ms: cheapest.map(|run| run.median_ms),
        ratio: cheapest.map(|run| auto.median_ms / run.median_ms),
    };
    Ok((row, runs))
}

/// One solver with ever more substeps, until the strain is held or a frame would be too dear.
fn climb(
    scene: &SpeedScene,
    model: &Model<2>,
    auto: &SpeedRun,
    (solver, name): (Solver, &str),
    seconds: f64,
) -> Result<Vec<SpeedRun>, StudyError> {
    let limits = Limits { seconds, strain: STRAIN };
    let mut runs: Vec<SpeedRun> = Vec::new();
    for substeps in RUNGS {
        let a_substep = runs.last().map_or(0.0, |run| run.median_ms / run.substeps);
        if a_substep * f64::from(substeps) > DEAR * auto.median_ms {
            break;
        }
        let label = format!("{name}, {substeps} substep{}", if substeps == 1 { "" } else { "s" });
        let done = run(scene, model, (fixed(solver, substeps), label), auto.threads, limits)?;
        let holds = done.is_finished && done.max_strain <= STRAIN;
        runs.push(done);
        if holds {
            break;
        }
    }
    Ok(runs)
}
