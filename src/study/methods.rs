//! The methods that are measured: every solver that a scene can name, and the ways to run those that sweep.

use std::time::Instant;

use super::problems::Truth;
use super::run::{Run, Work, median_seconds};
use crate::scene::record::{record, seconds};
use crate::scene::{OrderName, PrecisionName, Scene, SceneError, SolverName};
use crate::sim::{Dynamics, Sample};

/// A solver with the keys that it is varied by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Variant {
    /// The solver.
    pub solver: SolverName,
    /// Sweeps in a substep, where it is varied by them.
    pub iterations: Option<u32>,
    /// Order of the bonds in a sweep, where it is varied by it.
    pub order: Option<OrderName>,
}

impl Variant {
    /// In words.
    pub(super) fn label(&self) -> String {
        let sweeps = match self.iterations {
            None => String::new(),
            Some(1) => ", 1 sweep".to_owned(),
            Some(n) => format!(", {n} sweeps"),
        };
        let order = self.order.map_or(String::new(), |order| format!(", {order}"));
        format!("{}{sweeps}{order}", self.solver)
    }

    /// The scene with this method at a substep `[s]`, in 64 bits.
    pub(super) fn set(&self, scene: &Scene, substep: f64) -> Scene {
        let mut scene = scene.clone();
        scene.parameters.clear();
        scene.method.solver = Some(self.solver);
        scene.method.substep = Some(substep);
        scene.method.iterations = self.iterations;
        scene.method.order = self.order;
        scene.method.precision = Some(PrecisionName::F64);
        scene
    }
}

/// Every solver that a method can name, but for `auto`, which picks among the others, `path`, which is for the look
/// of large meshes and not for the truth, and `as-printed`, which is for its faults.
pub(super) fn solvers() -> impl Iterator<Item = SolverName> {
    let named = SolverName::NAMES.iter().filter_map(|name| name.parse().ok());
    named.filter(|solver| !matches!(solver, SolverName::Auto | SolverName::Path | SolverName::AsPrinted))
}

/// The ways to run a solver; one that does not sweep, or has nothing to sweep, is run in one way.
pub(super) fn variants(solver: SolverName, has_bonds: bool) -> Vec<Variant> {
    let one = |iterations, order| Variant { solver, iterations, order };
    match (solver, has_bonds) {
        (SolverName::Relaxation, true) => {
            let orders = [OrderName::Coloured, OrderName::Shuffled];
            let each = |iterations| orders.map(|order| one(Some(iterations), Some(order)));
            [1, 4, 15, 50].into_iter().flat_map(each).collect()
        }
        // Swept bonds mean nothing without a count, even where there are none.
        (SolverName::Relaxation, false) => vec![one(Some(1), None)],
        (SolverName::Xpbd, true) => [1, 4, 16].map(|iterations| one(Some(iterations), None)).to_vec(),
        _ => vec![one(None, None)],
    }
}

/// Runs a scene, its method set, and compares it with the truth.
///
/// Errors: the scene does not take the method.
pub(super) fn run(scene: &Scene, truth: &Truth, steps: u64) -> Result<Run, SceneError> {
    let times = truth.times();
    let end = times.last().copied().unwrap_or(0.0);
    let start = scene.world(Some(end))?;
    let mut world = start.boxed_clone();
    let begun = Instant::now();
    let samples = record(&mut *world, &times, |_| ()).ok();
    let (seconds, errors) = match &samples {
        Some(samples) => (steady_seconds(&*start, &times), errors(truth, samples)),
        // It diverged: there is nothing to time but the way there.
        None => (begun.elapsed().as_secs_f64(), vec![f64::INFINITY]),
    };
    let counters = world.counters();
    Ok(Run {
        steps,
        substep: end / steps as f64,
        seconds,
        cost: seconds / end,
        error: errors.last().copied().unwrap_or(f64::INFINITY),
        largest_error: errors.iter().copied().fold(0.0, f64::max),
        energy_drift: samples.as_deref().and_then(energy_drift),
        work: Work {
            substeps: counters.substeps,
            bonds_solved: counters.bonds_solved,
            points_moved: counters.points_moved,
            iterations: counters.iterations,
            events: counters.events,
            fallbacks: counters.fallbacks,
        },
    })
}

/// Wall time of the stepping `[s]`; a reading that was a single one is backed by others.
fn steady_seconds(start: &dyn Dynamics, times: &[f64]) -> f64 {
    let first = seconds(start, times);
    if first < READ_ALONE { first } else { median_seconds(first, || seconds(start, times)) }
}

/// A run shorter than this is read repeatedly by itself `[s]`.
const READ_ALONE: f64 = 0.010;

/// The error at every sample `[m]`.
pub(super) fn errors(truth: &Truth, samples: &[Sample]) -> Vec<f64> {
    truth.samples.iter().zip(samples).map(|(truth, sample)| truth.error(&sample.position)).collect()
}

/// The energy at the last sample less that at the first, over the largest one in size; `None` for a single sample.
fn energy_drift(samples: &[Sample]) -> Option<f64> {
    let [first, .., last] = samples else { return None };
    let largest = samples.iter().map(|sample| sample.energy.abs()).fold(0.0, f64::max);
    Some(if largest == 0.0 { 0.0 } else { (last.energy - first.energy) / largest })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::problems;

    #[test]
    fn every_solver_but_three_is_measured_once_or_in_its_variants() {
        let names: Vec<&str> = solvers().map(SolverName::name).collect();
        assert_eq!(names.len(), SolverName::NAMES.len() - 3);
        assert!(!names.contains(&"auto") && !names.contains(&"path") && !names.contains(&"as-printed"));
        for solver in solvers() {
            let labels: Vec<String> = variants(solver, true).iter().map(Variant::label).collect();
            let mut unique = labels.clone();
            unique.dedup();
            assert_eq!(labels, unique);
            assert_eq!(variants(solver, false).len(), 1, "{solver}");
        }
        assert_eq!(variants(SolverName::Relaxation, true)[3].label(), "relaxation, 4 sweeps, shuffled");
    }

    #[test]
    fn a_run_has_an_error_that_falls_with_the_step() {
        let problem = problems::find("B1_osc").unwrap();
        let (scene, truth) = (problem.scene().unwrap(), problem.truth().unwrap());
        let verlet = Variant { solver: SolverName::Verlet, iterations: None, order: None };
        let error = |steps: u64| {
            let run = run(&verlet.set(&scene, 10.0 / steps as f64), &truth, steps).unwrap();
            assert_eq!((run.work.substeps, run.steps), (steps, steps));
            assert!(run.cost > 0.0 && run.largest_error >= run.error && run.energy_drift.is_some());
            run.error
        };
        let ratio = error(2000) / error(4000);
        assert!((3.5..4.5).contains(&ratio), "{ratio}");
    }

    #[test]
    fn a_motion_that_diverges_has_an_infinite_error() {
        let problem = problems::find("A1_freefall").unwrap();
        let (mut scene, truth) = (problem.scene().unwrap(), problem.truth().unwrap());
        scene.gravity = serde_json::from_str("[0, -1e9]").unwrap();
        scene.points.as_mut().unwrap().velocity = Some(serde_json::from_str("[[0, 1e308]]").unwrap());
        let verlet = Variant { solver: SolverName::Verlet, iterations: None, order: None };
        let run = run(&verlet.set(&scene, 4.0 / 400.0), &truth, 400).unwrap();
        assert_eq!(run.error, f64::INFINITY);
    }
}
