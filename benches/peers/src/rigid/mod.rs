//! Rigid bodies that fly, slide, roll, bounce and pile up, in other engines and in wobble: what a frame costs, and how
//! wrong the motion is.

mod bodies;
mod box2d;
mod judge;
mod rapier;
mod report;
mod run;
mod scenes;
mod truth;
mod vector;
mod wobble;

use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use clap::Args;

use crate::Selection;
use crate::peer::Peer;
use crate::program::Program;
use crate::report::Machine;
use bodies::{Body, Shape};
use report::Record;
use run::Outcome;
use scenes::{SIDES, Scene};
use wobble::Precision;

/// What the rigid bodies need.
#[derive(Args)]
pub(crate) struct Options {
    /// The wobble program: it makes the bodies that all engines get, and is measured.
    #[arg(long, value_name = "FILE")]
    wobble: PathBuf,
    /// Runs of each engine on each scene but those with contact, which run once: the least times count.
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    runs: u32,
}

/// An engine, and what it takes for the bodies' outlines.
#[derive(Clone, Copy)]
enum Engine {
    /// wobble as it is, or in f64.
    Wobble(Precision),
    /// Box2D as it is.
    Box2d(Shape),
    /// rapier2d as it is.
    Rapier(Shape),
}

impl Engine {
    /// wobble first, then the others with each shape of the scene.
    fn of(scene: &Scene) -> Vec<Self> {
        let others = scene.shapes.iter().flat_map(|&shape| [Engine::Box2d(shape), Engine::Rapier(shape)]);
        [Precision::Auto, Precision::Double].map(Engine::Wobble).into_iter().chain(others).collect()
    }

    fn name(self) -> &'static str {
        match self {
            Engine::Wobble(_) => "wobble",
            Engine::Box2d(_) => "box2d",
            Engine::Rapier(_) => "rapier2d",
        }
    }

    fn version(self, wobble: &Program) -> Result<String> {
        match self {
            Engine::Wobble(_) => wobble.version(),
            Engine::Box2d(_) => Ok(crate::box2d::Box2d::version()),
            Engine::Rapier(_) => Ok(rapier2d::VERSION.to_owned()),
        }
    }

    fn shape(self) -> Shape {
        match self {
            Engine::Wobble(_) => Shape::Outline,
            Engine::Box2d(shape) | Engine::Rapier(shape) => shape,
        }
    }

    fn setting(self) -> &'static str {
        match self {
            Engine::Wobble(Precision::Auto) => "auto",
            Engine::Wobble(Precision::Double) => "f64",
            Engine::Box2d(shape) | Engine::Rapier(shape) => shape.name(),
        }
    }

    fn run(self, wobble: &Program, scene: &Scene, bodies: &[Body]) -> Result<Outcome> {
        let bodies = &*scene.placed(bodies, self.shape());
        match self {
            Engine::Wobble(precision) => wobble::run(wobble, scene, bodies, precision),
            Engine::Box2d(shape) => Ok(run::run(scene, bodies, shape, box2d::World::new(scene, bodies, shape))),
            Engine::Rapier(shape) => Ok(run::run(scene, bodies, shape, rapier::World::new(scene, bodies, shape))),
        }
    }
}

/// Runs what was asked for, prints a table, and writes rigid.csv and rigid.json if there is a folder for them.
pub(crate) fn run(options: &Options, selection: &Selection) -> Result<()> {
    let (wobble, machine) = (Program::new(&options.wobble)?, Machine::current());
    let mut records = Vec::new();
    for scene in scenes::all().iter().filter(|scene| scene.name.contains(&selection.scene)) {
        let bodies = bodies::parse(&wobble.expand(&scene.solid())?, scene.bodies).with_context(|| scene.name)?;
        let sides = bodies.iter().map(|body| body.corners.len()).max();
        ensure!(matches!(sides, Some(4 | SIDES)), "{}: bodies of {sides:?} corners", scene.name);
        records.extend(row_by_row(options, selection, (&wobble, scene, &bodies))?);
        // After each scene: what was measured stays if the run is ended.
        selection.out.iter().try_for_each(|folder| report::save(folder, &machine, &records))?;
    }
    report::print(std::io::stdout(), &machine, &records)?;
    Ok(())
}

/// All engines that were asked for on one scene, in turn as often as was asked for.
fn row_by_row(
    options: &Options,
    selection: &Selection,
    (wobble, scene, bodies): (&Program, &Scene, &[Body]),
) -> Result<Vec<Record>> {
    let engines = Engine::of(scene).into_iter().filter(|engine| engine.name().contains(&selection.engine));
    let engines: Vec<_> = engines.collect();
    let round = || engines.iter().map(|engine| engine.run(wobble, scene, bodies)).collect::<Result<Vec<_>>>();
    let mut outcomes = round()?;
    for _ in 1..scene.runs(options.runs) {
        for (outcome, again) in outcomes.iter_mut().zip(round()?) {
            outcome.times = outcome.times.least(again.times);
        }
    }
    let mut records: Vec<Record> = Vec::new();
    for (engine, outcome) in engines.iter().zip(outcomes) {
        let label = (engine.name(), engine.version(wobble)?, engine.setting());
        let mut record = Record::new(scene, bodies[0].points(), label, outcome, scene.runs(options.runs));
        if let Some(first) = records.first().filter(|_| matches!(engines[0], Engine::Wobble(Precision::Auto))) {
            record.compare(first);
        }
        eprintln!("{}", record.row());
        records.push(record);
    }
    Ok(records)
}
