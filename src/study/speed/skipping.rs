//! What costs nothing when it is not needed: a scene at rest, a mouse that is away, walls that are far.

use serde::Serialize;

use super::super::error::StudyError;
use super::clock::{in_turn, median};
use super::run::paths;
use super::scenes::SpeedScene;
use crate::sim::{Bounds, Command, Cursor, Dynamics, Method, Model, MouseForce, Profile, Region, Track, build};

/// The scenes that are measured.
const SCENES: [&str; 3] = ["hard-32", "hard-100", "rims-1000"];
/// The strain that they are held to `[1]`.
const STRAIN: f64 = 0.02;
/// Drag that brings a scene to rest `[1/s]`.
const DRAG: f64 = 4.0;
/// Frames in which a scene has to fall asleep: 10 s.
const PATIENCE: u32 = 600;
/// Distance of the mouse and the walls `[m]`: far outside every scene, and no further than `f32` resolves.
const FAR: f64 = 1e4;

/// A row of `skipping.csv`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SkipRow {
    /// The scene.
    pub scene: &'static str,
    /// What is compared with the scene as it is: `asleep`, `mouse away`, `walls far`.
    pub what: &'static str,
    /// A frame of the scene awake, or without the feature `[ms]`.
    pub without_ms: f64,
    /// A frame asleep, or with the feature `[ms]`; empty where the scene did not fall asleep.
    pub with_ms: Option<f64>,
    /// Median over pairs of frames, taken in turn, of the second over the first.
    pub ratio: Option<f64>,
}

/// Whether a scene is measured.
pub(super) fn is_measured(scene: &SpeedScene) -> bool {
    SCENES.contains(&scene.name)
}

/// Measures a scene in pairs, for about `seconds` `[s]` each.
///
/// Errors: the model is out of order.
pub(super) fn measure(scene: &SpeedScene, model: &Model<2>, seconds: f64) -> Result<Vec<SkipRow>, StudyError> {
    let plain = Model { method: paths(STRAIN), ..model.clone() };
    let sleepy = Model { method: Method { sleeps: true, ..plain.method }, ..plain.clone() };
    let row = |what, (without, with, ratio): (f64, Option<f64>, Option<f64>)| SkipRow {
        scene: scene.name,
        what,
        without_ms: 1e3 * without,
        with_ms: with.map(|with| 1e3 * with),
        ratio,
    };
    let mut mouse = build(&Model { mouse: Some(force()), ..plain.clone() })?;
    mouse.apply(&Command::Cursor { to: Some(Cursor::at([FAR, FAR])), by: 0.0 }).map_err(StudyError::Command)?;
    let walls = Bounds { min: [-FAR; 2], max: [FAR; 2], restitution: 0.3, friction: 0.4 };
    let walls = build(&Model { bounds: Some(walls), ..plain.clone() })?;
    Ok(vec![
        row("asleep", asleep(&sleepy, seconds)?),
        row("mouse away", pair(build(&plain)?, mouse, seconds)),
        row("walls far", pair(build(&plain)?, walls, seconds)),
    ])
}

fn force() -> MouseForce {
    MouseForce {
        strength: 100.0,
        radius: 0.5,
        region: Region::Round,
        profile: Profile::Smooth,
        track: Track::default(),
    }
}

/// Frames of two worlds in turn: their medians `[s]`, and the median of the ratios.
fn pair(mut without: Box<dyn Dynamics>, mut with: Box<dyn Dynamics>, seconds: f64) -> (f64, Option<f64>, Option<f64>) {
    compare(in_turn(seconds, &mut [&mut || without.step(), &mut || with.step()]))
}

/// A world that came to rest, played as a player does, beside itself kept awake.
fn asleep(model: &Model<2>, seconds: f64) -> Result<(f64, Option<f64>, Option<f64>), StudyError> {
    let mut world = build(&Model { drag_rate: DRAG, ..model.clone() })?;
    for _ in 0..PATIENCE {
        play(&mut *world);
    }
    let mut awake = world.boxed_clone();
    let mut keep_awake = || {
        awake.wake();
        play(&mut *awake);
    };
    if !world.is_asleep() {
        let alone = in_turn(seconds, &mut [&mut keep_awake]).swap_remove(0);
        return Ok((median(alone), None, None));
    }
    Ok(compare(in_turn(seconds, &mut [&mut keep_awake, &mut || play(&mut *world)])))
}

/// A frame: a step, unless the world sleeps.
fn play(world: &mut dyn Dynamics) {
    if !world.is_asleep() {
        world.step();
    }
}

fn compare(readings: Vec<Vec<f64>>) -> (f64, Option<f64>, Option<f64>) {
    let ratios = readings[0].iter().zip(&readings[1]).map(|(without, with)| with / without).collect();
    let [without, with] = [0, 1].map(|i| median(readings[i].clone()));
    (without, Some(with), Some(median(ratios)))
}
