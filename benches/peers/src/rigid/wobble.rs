//! wobble, which is another program: its points say where its bodies are.

use anyhow::{Context, Result};

use super::bodies::{Body, Shape};
use super::judge::Judge;
use super::run::Outcome;
use super::scenes::Scene;
use crate::program::Program;

/// Runs a scene to its end, with a sample at each look.
///
/// Errors: what the program says.
pub(super) fn run(program: &Program, scene: &Scene, bodies: &[Body]) -> Result<Outcome> {
    let run = program.simulate(&scene.file, &scene.looks()).with_context(|| scene.name)?;
    let mut judge = Judge::new(scene, bodies, Shape::Outline);
    for (sample, is_asleep) in run.samples.iter().zip(run.is_asleep()) {
        let each = sample.position.len() / bodies.len();
        let points = sample.position.chunks(each).zip(sample.velocity.chunks(each));
        let states = bodies.iter().zip(points).map(|(body, (places, velocities))| body.state(places, velocities));
        judge.look(&states.collect::<Vec<_>>(), is_asleep);
    }
    Ok(Outcome { times: run.times(scene.frames())?, verdict: judge.verdict() })
}
