//! Other engines on the scenes of this project's benchmarks: what a frame costs at equal strain.

mod box2d;
mod heaps;
mod ladder;
mod peer;
mod program;
mod rapier_joints;
mod rapier_multibody;
mod rapier_soft;
mod report;
mod rigid;
mod run;
mod scenes;
mod times;

use std::path::PathBuf;

use anyhow::Result;
use clap::{Args, Parser, Subcommand};

use ladder::Budget;
use peer::Peer;
use report::{Machine, Record};
use scenes::Scene;

/// Runs Box2D and rapier2d on the scenes, from cheap settings to dear ones, until the bonds hold their lengths.
#[derive(Parser)]
#[command(version)]
struct Options {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    selection: Selection,
    /// Longest run of one setting [s]: 80 if not said, 10 with --quick.
    #[arg(long, value_name = "SECONDS")]
    run_limit: Option<f64>,
    /// Longest climb of one engine on one scene [s], its last run excepted: 90 if not said, 10 with --quick.
    #[arg(long, value_name = "SECONDS")]
    climb_limit: Option<f64>,
}

/// What else can be measured.
#[derive(Subcommand)]
enum Command {
    /// Lets soft bodies fall and come to rest in Box2D, rapier2d and wobble.
    Heaps(heaps::Options),
    /// Lets rigid bodies fly, slide, roll, bounce and pile up in Box2D, rapier2d and wobble.
    Rigid(rigid::Options),
}

/// Which runs, and where they are written.
#[derive(Args)]
struct Selection {
    /// Only small scenes, and shorter climbs: a minute or two.
    #[arg(long, global = true)]
    quick: bool,
    /// Write the runs into this folder: peers.csv and peers.json, heaps.csv, or rigid.csv and rigid.json.
    #[arg(long, global = true, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Only engines whose name has this in it.
    #[arg(long, global = true, default_value = "", value_name = "TEXT")]
    engine: String,
    /// Only scenes whose name has this in it.
    #[arg(long, global = true, default_value = "", value_name = "TEXT")]
    scene: String,
}

fn main() -> Result<()> {
    let options = Options::parse();
    match &options.command {
        Some(Command::Heaps(heaps)) => heaps::run(heaps, &options.selection),
        Some(Command::Rigid(rigid)) => rigid::run(rigid, &options.selection),
        None => climb_all(&options),
    }
}

/// Every engine on every scene of rigid bonds that was asked for.
fn climb_all(options: &Options) -> Result<()> {
    let Selection { quick, out, scene: name, .. } = &options.selection;
    let mut climbs = Vec::new();
    for scene in scenes::all(*quick)?.iter().filter(|scene| scene.name.contains(name)) {
        climbs.extend(climb::<box2d::Box2d>(options, scene));
        climbs.extend(climb::<rapier_soft::RapierSoft>(options, scene));
        climbs.extend(climb::<rapier_joints::RapierJoints>(options, scene));
        climbs.extend(climb::<rapier_multibody::RapierMultibody>(options, scene));
    }
    let machine = Machine::current();
    report::print(std::io::stdout(), &machine, &climbs)?;
    out.iter().try_for_each(|folder| report::save(folder, &machine, &climbs))
}

/// One engine on one scene, if both were asked for and go together.
fn climb<P: Peer>(options: &Options, scene: &Scene) -> Option<Vec<Record>> {
    let (run, climb) = if options.selection.quick { (10.0, 10.0) } else { (80.0, 90.0) };
    let budget = Budget { run: options.run_limit.unwrap_or(run), climb: options.climb_limit.unwrap_or(climb) };
    (P::NAME.contains(&options.selection.engine) && P::suits(scene)).then(|| ladder::climb::<P>(scene, budget))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::peer::Setting;
    use crate::run::{Limits, run};

    /// Error [m] of rope 50 at so many substeps, in the engine's first way.
    fn error<P: Peer>(substeps: usize) -> f64 {
        let scenes = scenes::all(true).unwrap_or_default();
        let rope = scenes.iter().find(|scene| scene.truth.is_some()).expect("rope 50 is in the list");
        let limits = Limits { strain: f64::INFINITY, seconds: f64::INFINITY };
        let world = P::world(rope, Setting { substeps, way: P::WAYS[0] });
        run(rope, world, limits).error.map_or(f64::INFINITY, |error| error.max)
    }

    #[test]
    fn every_engine_comes_closer_to_the_truth_with_more_substeps() {
        fn check<P: Peer>() {
            let (coarse, fine) = (error::<P>(12), error::<P>(96));
            assert!(fine < 0.01 && fine < 0.5 * coarse, "{}: {coarse} m, then {fine} m", P::NAME);
        }
        check::<box2d::Box2d>();
        check::<rapier_soft::RapierSoft>();
        check::<rapier_joints::RapierJoints>();
        check::<rapier_multibody::RapierMultibody>();
    }
}
