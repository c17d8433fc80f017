//! wobble, which is another program: its points say where its bodies are.

use anyhow::{Context, Result, ensure};

use super::bodies::{Body, Shape};
use super::judge::Judge;
use super::run::Outcome;
use super::scenes::Scene;
use crate::program::Program;

/// Bits of a number in a world of wobble.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Precision {
    /// Chosen by its rules: by the number of points.
    Auto,
    /// 64.
    Double,
}

/// Runs a scene to its end, with a sample at each look.
///
/// Errors: what the program says.
pub(super) fn run(program: &Program, scene: &Scene, bodies: &[Body], precision: Precision) -> Result<Outcome> {
    let file = if precision == Precision::Double { scene.in_f64() } else { scene.file.clone() };
    let run = program.simulate(&file, &scene.looks()).with_context(|| scene.name)?;
    ensure!(run.samples.len() == scene.looks().len(), "{} samples of {}", run.samples.len(), scene.name);
    let mut judge = Judge::new(scene, bodies, Shape::Outline);
    for (sample, is_asleep) in run.samples.iter().zip(run.is_asleep()) {
        let each = sample.position.len() / bodies.len();
        let points = sample.position.chunks(each).zip(sample.velocity.chunks(each));
        let states = bodies.iter().zip(points).map(|(body, (places, velocities))| body.state(places, velocities));
        judge.look(&states.collect::<Vec<_>>(), is_asleep);
    }
    Ok(Outcome { times: run.times(scene.frames())?, verdict: judge.verdict() })
}
