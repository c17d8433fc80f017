//! Soft bodies that fall and come to rest, in other engines and in wobble: what a frame costs, and how good the rest is.

mod box2d;
pub(crate) mod depth;
mod judge;
pub(crate) mod mesh;
mod rapier;
mod report;
mod run;
mod scenes;
mod wobble;

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;

use crate::Selection;
use crate::peer::Peer;
use crate::program::Program;
use crate::report::Machine;
use box2d::Circles;
use mesh::Mesh;
use report::{Label, Record};
use run::Outcome;
use scenes::Scene;

/// What the heaps need.
#[derive(Args)]
pub(crate) struct Options {
    /// The wobble program: it makes the meshes that all engines get, and is measured.
    #[arg(long, value_name = "FILE")]
    wobble: PathBuf,
    /// Runs of each engine on each scene but the largest, which runs once: the least times count.
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    runs: u32,
}

/// An engine at one setting.
#[derive(Clone, Copy)]
enum Engine {
    /// wobble as it is.
    Wobble,
    /// rapier2d's soft bodies with skins so many mean edges thick.
    Rapier(f64),
    /// Box2D with circles around some points.
    Box2d(Circles),
}

/// rapier2d is given wobble's skin and the one that its own makers of bodies give.
const ENGINES: [Engine; 5] = [
    Engine::Wobble,
    Engine::Rapier(mesh::SKIN),
    Engine::Rapier(rapier::OWN_SKIN),
    Engine::Box2d(Circles::Skins),
    Engine::Box2d(Circles::All),
];

impl Engine {
    fn name(self) -> &'static str {
        match self {
            Engine::Wobble => "wobble",
            Engine::Rapier(_) => "rapier2d soft bodies",
            Engine::Box2d(_) => "box2d",
        }
    }

    fn label(self, wobble: &Program) -> Result<Label> {
        let (version, setting) = match self {
            Engine::Wobble => (wobble.version()?, format!("skin {} L", mesh::SKIN)),
            Engine::Rapier(skin) => (rapier2d::VERSION.to_owned(), format!("skin {skin} L")),
            Engine::Box2d(circles) => {
                let points = if circles == Circles::All { "all points" } else { "skins" };
                (crate::box2d::Box2d::version(), format!("circles {} L, {points}", box2d::CIRCLE))
            }
        };
        Ok(Label { engine: self.name(), version, setting })
    }

    fn run(self, wobble: &Program, scene: &Scene, mesh: &Mesh) -> Result<Outcome> {
        match self {
            Engine::Wobble => wobble::run(wobble, scene, mesh),
            Engine::Rapier(skin) => Ok(run::run(scene, mesh, rapier::World::new(scene, mesh, skin))),
            Engine::Box2d(circles) => Ok(run::run(scene, mesh, box2d::World::new(scene, mesh, circles))),
        }
    }
}

/// Runs what was asked for, prints a table, and writes heaps.csv if there is a folder for it.
pub(crate) fn run(options: &Options, selection: &Selection) -> Result<()> {
    let wobble = Program::new(&options.wobble)?;
    let engines: Vec<_> = ENGINES.into_iter().filter(|engine| engine.name().contains(&selection.engine)).collect();
    let mut records = Vec::new();
    for scene in scenes::all(selection.quick).iter().filter(|scene| scene.name.contains(&selection.scene)) {
        let text = wobble.expand(&scene.file)?;
        let mesh = Mesh::parse(&text, scene.bodies).with_context(|| format!("the mesh of {}", scene.name))?;
        let round = || engines.iter().map(|engine| engine.run(&wobble, scene, &mesh)).collect::<Result<Vec<_>>>();
        let mut outcomes = round()?;
        for _ in 1..scene.runs(options.runs) {
            for (outcome, again) in outcomes.iter_mut().zip(round()?) {
                outcome.times = outcome.times.least(again.times);
            }
        }
        for (engine, outcome) in engines.iter().zip(outcomes) {
            let record = Record::new(scene, &mesh, engine.label(&wobble)?, outcome, scene.runs(options.runs));
            eprintln!("{}", record.row());
            records.push(record);
        }
    }
    let machine = Machine::current();
    report::print(std::io::stdout(), &machine, &records)?;
    selection.out.iter().try_for_each(|folder| report::save(folder, &machine, &records))
}
