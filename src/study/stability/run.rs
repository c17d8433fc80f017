//! One subject run step by step, within bounds, and looked at frame by frame.

use std::collections::BTreeSet;
use std::time::Instant;

use serde::Serialize;

use super::counted::Counted;
use super::friction::Friction;
use super::judge::{Fault, faults};
use super::shape::Shape;
use super::skins::Skins;
use super::strain::{Strain, Strains};
use super::subject::{Rest, Subject};
use super::surfaces::Surfaces;
use crate::history::{HistoryError, Replay};
use crate::scene::Scene;
use crate::scene::frames::{Frames, next_close};
use crate::scene::record::RecordedFrames;
use crate::sim::{Dynamics, Ledger, Sample, Solver, judge};
use crate::study::setting::tune;

/// When a run is given up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bounds {
    /// Counted work of a run `[s]`: a judgement.
    pub work: f64,
    /// Wall time of a run `[s]`: looked at between steps, and so far above the other that it hardly ever counts.
    pub seconds: f64,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ended {
    /// At its end.
    Done,
    /// Positions left the finite numbers.
    NotFinite,
    /// It cost more counted work than it may.
    OutOfWork,
    /// It took longer than it may.
    OutOfTime,
    /// The scene is not taken: why.
    Refused(String),
}

/// What a run was found to do: nothing here depends on a clock, but for a run that the clock ended.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Findings {
    /// How it ended.
    pub ended: Ended,
    /// How far it came `[s]`.
    pub simulated: f64,
    /// Its points.
    pub points: usize,
    /// Its bonds.
    pub bonds: usize,
    /// What moved it: the solvers of its parts at the start.
    pub path: String,
    /// What of it was handed over to the live step, and why: `exact` where nothing was.
    pub moved: String,
    /// Energy that came from nowhere, as a share of the largest kinetic energy so far `[1]`; `None` where its ledger cannot tell.
    pub gain: Option<f64>,
    /// The same of what went without a reason within 10 s.
    pub loss: Option<f64>,
    /// Largest strain of a rigid bond in any frame `[1]`.
    pub strain: f64,
    /// The same by what held them.
    pub strains: Strains,
    /// Share of triangles that are inside out at the end `[1]`.
    pub inverted: f64,
    /// Sides of outlines that cross at the end, counted in pairs.
    pub crossings: u32,
    /// The same of skins of bodies that meet, of those alone that crossed nowhere at the start.
    pub crossed: u32,
    /// Deepest place of a point behind a surface in any frame `[m]`.
    pub depth: f64,
    /// Share that friction is off by while something slides `[1]`; `None` where nothing did.
    pub friction: Option<f64>,
    /// Speed of all points at the end, root of the mean square `[m/s]`.
    pub speed: f64,
    /// Of what has to stay at rest, the largest way from there in any frame `[m]`; of what has to come to rest, the speed at the end
    /// `[m/s]`.
    pub unrest: Option<f64>,
    /// Counted work a simulated second `[s]`.
    pub work_rate: f64,
    /// Counted work of the dearest frame `[ms]`.
    pub worst_work_ms: f64,
    /// Where a tolerance is asked for, the error that the cheapest setting is told to have over it `[1]`.
    pub told: Option<f64>,
    /// Commands that could not be done.
    pub refused_commands: u32,
    /// Work done.
    pub counters: Counted,
    /// What is wrong, ascending.
    pub faults: Vec<Fault>,
}

/// What the clock says of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Timing {
    /// Wall time of the stepping `[s]`.
    pub seconds: f64,
    /// The same a simulated second `[1]`.
    pub rate: f64,
    /// Of frames.
    pub frames: RecordedFrames,
}

/// Why the live step moved something, in any frame.
#[derive(Clone, Debug, Default)]
struct Movers(BTreeSet<&'static str>);

impl Movers {
    fn look(&mut self, world: &dyn Dynamics) {
        // Who is moved by whom changes seldom: where nothing was handed over, nothing is asked.
        if world.counters().hand_overs > 0 || world.contact().is_some() {
            let live = world.moved_by().into_iter().filter(|moved| moved.method == Solver::Live);
            self.0.extend(live.map(|moved| moved.why.name()));
        }
    }

    fn name(&self) -> String {
        let causes: Vec<&str> = self.0.iter().copied().collect();
        if causes.is_empty() { "exact".to_owned() } else { format!("live: {}", causes.join(", ")) }
    }
}

/// Runs a subject, with the ledger that energy is judged by, or without, which takes less time.
pub(super) fn run(subject: &Subject, bounds: Bounds, has_ledger: bool) -> (Findings, Timing) {
    let shape = Shape::of(&subject.recording.scene);
    let mut recording = subject.recording.clone();
    recording.scene.method.ledger = Some(has_ledger);
    let told = has_ledger.then(|| told(subject)).flatten();
    let replay = Replay::new(&recording, &subject.name);
    match (shape, replay) {
        (Ok(shape), Ok(replay)) => Drive::new(subject, shape, (replay, told)).finish(bounds),
        (Err(error), _) => refused(error.message),
        (_, Err(HistoryError::Scene(error))) => refused(error.message),
        (_, Err(error)) => refused(error.to_string()),
    }
}

/// Share of its substep that a setting is looked at again with: not a half, which guards that halve substeps would hide.
const FINER: f64 = 0.45;

/// The error that the cheapest setting is told to have, or has beside a finer run of the same method, over the one that the subject asks
/// for `[1]`; infinite: there is none.
fn told(subject: &Subject) -> Option<f64> {
    let tolerance = subject.tolerance?;
    let mut scene = subject.recording.scene.clone();
    scene.parameters.clear();
    scene.method.tolerance = Some(tolerance);
    let mut times = scene.sample_times();
    times.retain(|&time| time <= subject.duration);
    if times.is_empty() {
        times.push(subject.duration);
    }
    let Some(found) = tune(&mut scene, &times).ok().flatten() else { return Some(f64::INFINITY) };
    let shown = distance_to_a_finer_run(&scene, &times).unwrap_or(0.0);
    Some(found.expected_error.max(shown) / tolerance)
}

/// How far the samples of a setting are from those with a shorter substep `[m]`; `None`: it has none.
fn distance_to_a_finer_run(scene: &Scene, times: &[f64]) -> Option<f64> {
    let run = |scene: &Scene| -> Option<Vec<[f64; 3]>> {
        let mut world = scene.world(None).ok()?;
        let mut places = Vec::new();
        for &time in times {
            while world.time() + world.substep() < time {
                world.step();
            }
            places.extend(world.sample(time).position);
        }
        Some(places)
    };
    let mut finer = scene.clone();
    finer.method.substep = Some(FINER * scene.method.substep?);
    let (coarse, fine) = (run(scene)?, run(&finer)?);
    let apart = |(a, b): (&[f64; 3], &[f64; 3])| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
    Some(coarse.iter().zip(&fine).map(apart).fold(0.0, f64::max))
}

fn refused(reason: String) -> (Findings, Timing) {
    let found = Findings {
        ended: Ended::Refused(reason),
        simulated: 0.0,
        points: 0,
        bonds: 0,
        path: String::new(),
        moved: String::new(),
        gain: None,
        loss: None,
        strain: 0.0,
        strains: Strains::default(),
        inverted: 0.0,
        crossings: 0,
        crossed: 0,
        depth: 0.0,
        friction: None,
        speed: 0.0,
        unrest: None,
        told: None,
        work_rate: 0.0,
        worst_work_ms: 0.0,
        refused_commands: 0,
        counters: Counted::default(),
        faults: Vec::new(),
    };
    (found, Timing::default())
}

/// A run under way.
struct Drive<'a> {
    subject: &'a Subject,
    replay: Replay,
    /// Commands done.
    place: usize,
    refused: u32,
    /// When each step ended `[s]`, what it took `[s]`, and its counted work `[ms]`.
    steps: Vec<(f64, f64, f64)>,
    /// The ledger at the start and at the end of every frame.
    ledger: Vec<Ledger>,
    friction: Friction,
    shape: Shape,
    skins: Option<Skins>,
    surfaces: Surfaces,
    start: Vec<[f64; 3]>,
    strain: Strain,
    depth: f64,
    way: f64,
    moved: Movers,
    told: Option<f64>,
}

impl<'a> Drive<'a> {
    fn new(subject: &'a Subject, shape: Shape, (replay, told): (Replay, Option<f64>)) -> Self {
        let sample = replay.world().sample(replay.world().time());
        let ledger = sample.ledger.into_iter().collect();
        let (steps, mut surfaces) = (Vec::new(), Surfaces::default());
        surfaces.begin(replay.world(), &sample.position);
        let (place, refused) = (0, 0);
        let (depth, way) = (0.0, 0.0);
        let strain = Strain::new(subject.recording.scene.method.max_strain);
        let skins = Skins::of(replay.world(), &sample.position);
        let moved = Movers::default();
        let friction = Friction::of(&subject.recording.scene);
        let start = sample.position;
        Drive {
            subject,
            replay,
            place,
            refused,
            steps,
            ledger,
            friction,
            shape,
            skins,
            surfaces,
            start,
            strain,
            depth,
            way,
            moved,
            told,
        }
    }

    fn finish(mut self, bounds: Bounds) -> (Findings, Timing) {
        let (world, clock) = (self.replay.world(), Instant::now());
        let (points, bonds, path) = (world.point_count(), world.bonds().len(), path(world));
        let mut close = next_close(0.0);
        let ended = loop {
            self.command();
            let world = self.replay.world();
            if world.time() >= self.subject.duration * (1.0 - 1e-9) {
                break Ended::Done;
            }
            self.step();
            let world = self.replay.world();
            let (time, work) = (world.time(), world.counters().work_ms());
            if time >= close * (1.0 - 1e-9) {
                close = next_close(time);
                if !self.look() {
                    break Ended::NotFinite;
                }
            }
            if work > 1e3 * bounds.work {
                break Ended::OutOfWork;
            }
            if clock.elapsed().as_secs_f64() > bounds.seconds {
                break Ended::OutOfTime;
            }
        };
        let is_finite = self.look();
        let ended = if is_finite { ended } else { Ended::NotFinite };
        self.findings(ended, (points, bonds, path))
    }

    /// Does the commands that are due.
    fn command(&mut self) {
        let commands = &self.subject.recording.commands;
        while let Some(entry) = commands.get(self.place).filter(|entry| self.replay.is_due(entry.at)) {
            match self.replay.follow(self.place, entry) {
                Ok(()) => {}
                Err(_) => self.refused += 1,
            }
            self.place += 1;
        }
    }

    fn step(&mut self) {
        let next = self.subject.recording.commands.get(self.place).map_or(self.subject.duration, |entry| entry.at);
        let work = self.replay.world().counters().work_ms();
        let clock = Instant::now();
        self.replay.step(Some(next.min(self.subject.duration)));
        let seconds = clock.elapsed().as_secs_f64();
        let world = self.replay.world();
        self.friction.look_at_blows(world);
        self.steps.push((world.time(), seconds, world.counters().work_ms() - work));
    }

    /// Looks at the state at the end of a frame; false where it is no state any more.
    fn look(&mut self) -> bool {
        let world = self.replay.world();
        let sample = world.sample(world.time());
        // What stands still since it left the numbers is no motion either.
        if !world.is_finite() || !sample.energy.is_finite() || world.counters().frozen > 0 {
            return false;
        }
        self.strain.look(world, &sample);
        self.depth = self.depth.max(self.surfaces.depth(world, &sample.position));
        self.way = self.way.max(furthest(&self.start, &sample.position));
        self.moved.look(world);
        self.ledger.extend(sample.ledger);
        self.friction.look(world, &sample);
        true
    }

    fn findings(self, ended: Ended, (points, bonds, path): (usize, usize, String)) -> (Findings, Timing) {
        let world = self.replay.world();
        let (sample, simulated) = (world.sample(world.time()), world.time());
        let (energy, each) = (judge(&self.ledger), 1.0 / simulated.max(1e-9));
        // Shares of the speed that rounding gives to what rests say nothing: whether it stays is judged by its way.
        let is_told = energy.is_told && !self.ledger.is_empty() && self.subject.rest != Rest::Stays;
        let mut frames = Frames::between(0.0, simulated);
        self.steps.iter().for_each(|&(time, seconds, work)| frames.add(time, seconds, work));
        let has_shape = ended != Ended::NotFinite && !self.shape.is_empty();
        let shape = has_shape.then(|| self.shape.left(world.bonds()));
        let mut found = Findings {
            ended,
            simulated,
            points,
            bonds,
            path,
            moved: self.moved.name(),
            gain: is_told.then_some(energy.gain),
            loss: is_told.then_some(energy.loss),
            strain: self.strain.largest,
            strains: self.strain.most,
            inverted: shape.as_ref().map_or(0.0, |shape| shape.inverted(&sample.position)),
            crossings: shape.as_ref().map_or(0, |shape| shape.crossings(&sample.position)),
            crossed: self.skins.as_ref().map_or(0, |skins| skins.crossed(world, &sample.position)),
            depth: self.depth,
            friction: self.friction.error(),
            speed: speed(&sample),
            unrest: match self.subject.rest {
                Rest::Free => None,
                Rest::Stays => Some(self.way),
                Rest::Comes => Some(speed(&sample)),
            },
            told: self.told,
            work_rate: 1e-3 * world.counters().work_ms() * each,
            worst_work_ms: frames.worst_work_ms(),
            refused_commands: self.refused,
            counters: world.counters().into(),
            faults: Vec::new(),
        };
        found.faults = faults(&found);
        let seconds = frames.seconds();
        (found, Timing { seconds, rate: seconds * each, frames: (&frames).into() })
    }
}

/// The solvers of a world's parts, each once.
fn path(world: &dyn Dynamics) -> String {
    let name = |part: &crate::sim::PlanPart| match part.kernel.is_empty() || part.solver == Solver::Live {
        true => part.solver.name().to_owned(),
        false => format!("{} of a large body", part.solver.name()),
    };
    world.parts().iter().map(name).collect::<BTreeSet<String>>().into_iter().collect::<Vec<_>>().join(" + ")
}

fn furthest(start: &[[f64; 3]], now: &[[f64; 3]]) -> f64 {
    let way = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>();
    start.iter().zip(now).map(way).fold(0.0, f64::max).sqrt()
}

/// Root of the mean square speed of all points that are there `[m/s]`.
fn speed(sample: &Sample) -> f64 {
    let squares =
        sample.velocity.iter().map(|v| v.iter().map(|v| v * v).sum::<f64>()).filter(|square| !square.is_nan());
    let (sum, count) = squares.fold((0.0, 0.0), |(sum, count), square| (sum + square, count + 1.0));
    if count > 0.0 { (sum / count).sqrt() } else { 0.0 }
}
