//! Error against cost: every method and the baseline over a ladder of steps on every problem.

use std::time::Instant;

use serde::Serialize;

use super::baseline::Baseline;
use super::equal::{self, EqualError};
use super::error::StudyError;
use super::fit;
use super::methods::{self, Variant, errors};
use super::problems::{Kind, Problem, Truth};
use super::rest::settle;
use super::run::{Run, Settings, ladder};
use super::tolerance::{self, TOLERANCES, ToleranceReport};
use crate::scene::{Scene, SceneError, SolverName};

/// One way to run a problem, over its ladder of steps.
#[derive(Clone, Debug, Serialize)]
pub struct MethodReport {
    /// In words, such as `relaxation, 4 sweeps, shuffled`.
    pub method: String,
    /// The solver's name; `baseline` for the sources' method.
    pub solver: &'static str,
    /// Why the problem does not take it, if so.
    pub refused: Option<String>,
    /// From the coarsest step to the finest.
    pub runs: Vec<Run>,
    /// The observed order, where errors fall.
    pub observed_order: Option<f64>,
}

/// What was measured on a problem.
#[derive(Clone, Debug, Serialize)]
pub struct ProblemReport {
    /// Its name.
    pub name: &'static str,
    /// What its truth is of: of a static problem the shape at rest, that its motion comes to by drag.
    pub kind: Kind,
    /// 2 in the plane, 3 in space.
    pub dimensions: usize,
    /// How many points it has.
    pub points: usize,
    /// How many bonds it has.
    pub bonds: usize,
    /// Simulated time `[s]`.
    pub duration: f64,
    /// How far the truth may be off `[m]`.
    pub uncertainty: f64,
    /// The variants of the baseline.
    pub baseline: Vec<MethodReport>,
    /// The program's own methods.
    pub methods: Vec<MethodReport>,
    /// Runs with nothing asked for, and with an error.
    pub tolerance: Vec<ToleranceReport>,
    /// Of a static problem: its equilibrium, found without motion.
    pub settle: Option<SettleReport>,
    /// What each error costs with each of them.
    pub equal_error: Vec<EqualError>,
}

/// An equilibrium, found without motion.
#[derive(Clone, Debug, Serialize)]
pub struct SettleReport {
    /// Largest distance from the truth `[m]`.
    pub error: f64,
    /// Wall time, in the median `[s]`.
    pub seconds: f64,
    /// Rounds of Newton's method.
    pub rounds: u32,
}

/// How far a study is.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// The problem at hand.
    pub problem: &'a str,
    /// Problems and methods done.
    pub done: u64,
    /// Problems times methods.
    pub total: u64,
}

/// Measures problems one by one; `progress` is told before each method.
///
/// Errors: a built-in text that is out of order.
pub fn measure(
    problems: &[&Problem],
    settings: &Settings,
    progress: &mut dyn FnMut(Progress<'_>),
) -> Result<Vec<ProblemReport>, StudyError> {
    // Solvers, the baseline and the runs with a tolerance.
    let each = methods::solvers().count() as u64 + 2;
    let total = problems.len() as u64 * each;
    let mut reports = Vec::new();
    for (i, problem) in problems.iter().enumerate() {
        let mut done = i as u64 * each;
        let mut next = || {
            progress(Progress { problem: problem.name, done, total });
            done += 1;
        };
        reports.push(measure_problem(problem, settings, &mut next)?);
    }
    Ok(reports)
}

fn measure_problem(
    problem: &Problem,
    settings: &Settings,
    next: &mut dyn FnMut(),
) -> Result<ProblemReport, StudyError> {
    let (scene, truth) = (problem.scene()?.expanded()?, problem.truth()?);
    next();
    let baseline = measure_baseline(&scene, &truth, settings);
    let mut methods = Vec::new();
    for solver in methods::solvers() {
        next();
        methods.extend(measure_solver(solver, &scene, &truth, settings));
    }
    next();
    let tolerance = match truth.kind {
        Kind::Dynamic => TOLERANCES.map(|error| tolerance::measure(&scene, &truth, error)).to_vec(),
        // The truth is where the motion ends after an endless time: no error at a sample can be asked for.
        Kind::Static => Vec::new(),
    };
    Ok(ProblemReport {
        name: problem.name,
        kind: truth.kind,
        dimensions: scene.dimensions(),
        points: scene.points.as_ref().map_or(0, |points| points.position.len()),
        bonds: scene.bonds.len(),
        duration: truth.samples.last().map_or(0.0, |sample| sample.t),
        uncertainty: truth.uncertainty,
        settle: match truth.kind {
            Kind::Static => Some(measure_settle(&scene, &truth)?),
            Kind::Dynamic => None,
        },
        equal_error: equal::compare(problem.name, &baseline, &methods),
        baseline,
        methods,
        tolerance,
    })
}

/// Finds the equilibrium, a few times.
fn measure_settle(scene: &Scene, truth: &Truth) -> Result<SettleReport, StudyError> {
    const RUNS: usize = 9;
    let mut seconds = Vec::with_capacity(RUNS);
    let mut last = settle(scene, 0.0)?;
    for _ in 0..RUNS {
        let clock = Instant::now();
        last = settle(scene, 0.0)?;
        seconds.push(clock.elapsed().as_secs_f64());
    }
    seconds.sort_by(f64::total_cmp);
    let error = errors(truth, &[last.sample]).into_iter().fold(0.0, f64::max);
    Ok(SettleReport { error, seconds: seconds[RUNS / 2], rounds: last.rounds })
}

/// Every variant of the baseline, or why there is none.
fn measure_baseline(scene: &Scene, truth: &Truth, settings: &Settings) -> Vec<MethodReport> {
    const SOLVER: &str = "baseline";
    let baseline = match Baseline::new(scene) {
        Ok(baseline) => baseline,
        Err(reason) => return vec![MethodReport::refused("sources' method".to_owned(), SOLVER, reason)],
    };
    let samples = truth.samples.len() as u64;
    let variants = baseline.variants().into_iter();
    let measured = variants.map(|variant| {
        let runs = ladder(settings, samples, |steps| baseline.run(variant, truth, steps));
        MethodReport::of(variant.label(), SOLVER, runs)
    });
    measured.collect()
}

/// Every variant of a solver; one report with the reason where the problem does not take the solver.
fn measure_solver(solver: SolverName, scene: &Scene, truth: &Truth, settings: &Settings) -> Vec<MethodReport> {
    let mut reports = Vec::new();
    for variant in methods::variants(solver, !scene.bonds.is_empty()) {
        match measure_variant(&variant, scene, truth, settings) {
            Ok(runs) => reports.push(MethodReport::of(variant.label(), solver.name(), runs)),
            Err(error) => {
                reports.push(MethodReport::refused(variant.label(), solver.name(), error.message));
                break;
            }
        }
    }
    reports
}

/// Errors: the problem does not take the method.
fn measure_variant(
    variant: &Variant,
    scene: &Scene,
    truth: &Truth,
    settings: &Settings,
) -> Result<Vec<Run>, SceneError> {
    let samples = truth.samples.len() as u64;
    let end = truth.samples.last().map_or(0.0, |sample| sample.t);
    // Asked once, so that the ladder itself cannot fail.
    variant.set(scene, end / samples as f64).world(Some(end))?;
    let mut refused = None;
    let runs = ladder(settings, samples, |steps| {
        let scene = variant.set(scene, end / steps as f64);
        methods::run(&scene, truth, steps).unwrap_or_else(|error| {
            refused = Some(error);
            Run::DIVERGED
        })
    });
    refused.map_or(Ok(runs), Err)
}

impl MethodReport {
    fn of(method: String, solver: &'static str, runs: Vec<Run>) -> Self {
        let observed_order = fit::order(&runs);
        MethodReport { method, solver, refused: None, runs, observed_order }
    }

    fn refused(method: String, solver: &'static str, reason: String) -> Self {
        MethodReport { method, solver, refused: Some(reason), runs: Vec::new(), observed_order: None }
    }
}
