//! `wobble simulate`: runs a scene to a table.

mod apart;
mod beside;
mod led;
mod strain;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::bail;
use clap::Args;

use self::apart::Apart;
use self::strain::Strain;
use super::replay::past_end;
use super::spared::spare;
use super::values::{self, Times};
use super::{WrongCall, progress};
use crate::equilibrium::Softness;
use crate::history::{self, Start};
use crate::output;
use crate::picture::Tint;
use crate::scene::frames::Frames;
use crate::scene::record::{
    RecordedBalance, RecordedBeside, RecordedCounters, RecordedFrames, RecordedMover, RecordedSample, RecordedSoftness,
    Recording, hash, ledgers, record, seconds_and_frames,
};
use crate::scene::{BudgetKeys, Meeting, MethodKeys, OrderName, PrecisionName, Scene, SolverName, SourceName};
use crate::sim::judge;
use crate::sim::{Counters, Dynamics, InstructionSet, MOST_ITERATIONS, PlanPart, PointId, Precision, Sample, Verdict};
use crate::study;

/// Points that a message names before it counts the rest.
const NAMED: usize = 5;

/// What to run and where to write it.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  wobble simulate rim --samples 0.5,1,2 --out rim.json\n  wobble simulate rim-relaxed --order coloured --iterations 4 --samples 10 --out rim.csv\n  wobble simulate rim --samples 1 --hash"
)]
pub(super) struct Arguments {
    /// A scene of the gallery, a scene file, a recording, or a picture.
    scene: String,
    /// auto, euler, symplectic-euler, verlet, velocity-verlet, pefrl, blanes-moan-4, blanes-moan-6, rk2, rk4, rk8,
    /// implicit-midpoint, backward-euler, xpbd, path, relaxation, live, or as-printed with a --source.
    #[arg(long, value_parser = values::solver)]
    solver: Option<SolverName>,
    /// Whose loop `--solver as-printed` runs: 000, 000-graph, 001, 002, 003, 003-relative or 004.
    #[arg(long)]
    source: Option<SourceName>,
    /// Longest substep in seconds.
    #[arg(long, value_name = "H", allow_negative_numbers = true, value_parser = values::above_zero)]
    substep: Option<f64>,
    /// Sweeps over relaxed bonds in a substep.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MOST_ITERATIONS.into()))]
    iterations: Option<u32>,
    /// Order of the bonds in a sweep: fixed, symmetric, coloured or shuffled.
    #[arg(long)]
    order: Option<OrderName>,
    /// Seed of the shuffles.
    #[arg(long)]
    seed: Option<u64>,
    /// auto, f32 or f64.
    #[arg(long)]
    precision: Option<PrecisionName>,
    /// Largest error at every sample in metres: the cheapest setting that reaches it is searched for, of what no commands lead.
    #[arg(long, value_name = "E", allow_negative_numbers = true, value_parser = values::above_zero)]
    tolerance: Option<f64>,
    /// Counted work a frame of 1/60 s, in milliseconds, beyond which islands are handed over to the live step, or `none`.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    budget: Option<BudgetKeys>,
    /// The equilibrium that the start rolls down to instead of the motion: one sample.
    #[arg(long, conflicts_with_all = ["tolerance", "solver", "source", "substep", "iterations"])]
    settle: bool,
    /// Commands that lead the world: a list of them, or a recording, whose scene is not looked at.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["tolerance", "settle"])]
    commands: Option<PathBuf>,
    /// Writes the run as a recording: .json or .jsonl.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["tolerance", "settle"], value_parser = |text: &str| values::ending(text, &["json", "jsonl"]))]
    record: Option<PathBuf>,
    /// Times to sample at in seconds, ascending, such as 0.5,1,2; the last one ends the run.
    #[arg(long, value_name = "T,…", allow_hyphen_values = true, value_parser = values::times)]
    samples: Option<Times>,
    /// Where to write: .json or .csv, or `-` for a table on the standard output, which is where it goes if nothing else is asked for.
    #[arg(long, value_name = "FILE", value_parser = table)]
    out: Option<PathBuf>,
    /// Says which body each point is of: a last column `body` of a .csv, a list `bodies` in a .json.
    #[arg(long)]
    bodies: bool,
    /// Keeps a ledger of the energy: each sample says where it came from and went, and the whole whether it was kept.
    #[arg(long, conflicts_with = "settle")]
    ledger: bool,
    /// Prints the hash of all samples.
    #[arg(long)]
    hash: bool,
}

/// Names the standard output.
const STANDARD: &str = "-";

pub(super) fn table(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match extension(&path).as_deref() {
        Some("json" | "csv") => Ok(path),
        _ if text == STANDARD => Ok(path),
        _ => Err("name a file that ends in .json or .csv, or - for a table on the standard output".to_owned()),
    }
}

fn extension(path: &Path) -> Option<String> {
    Some(path.extension()?.to_str()?.to_ascii_lowercase())
}

pub(super) fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<()> {
    arguments.spare()?;
    let start = Start::load(&arguments.scene)?;
    if start.is_recording() && arguments.tolerance.is_some() {
        bail!(WrongCall(format!(
            "{}: a recording is replayed by its own method: no setting is searched for it: leave --tolerance out, or name its scene",
            arguments.scene
        )));
    }
    if start.is_recording() || arguments.commands.is_some() || arguments.record.is_some() {
        return led::run(arguments, start, quiet);
    }
    let mut scene = start.scene().clone();
    arguments.change(&mut scene);
    let mut times = arguments.times(&scene)?;
    let apart = apart::split(&mut scene, &times)?;
    if let Some(apart) = &apart {
        times = apart.times()?;
    }
    let end = times.last().copied();
    let past_end = end.and_then(|end| past_end(start.recording(), end));
    let is_cut = arguments.samples.is_some() || apart.is_some();
    let duration = if is_cut { end } else { scene.duration.or(end) };
    if arguments.settle {
        return settle(arguments, &scene, end.unwrap_or(0.0));
    }
    let found = search(&mut scene, &times, quiet)?;
    let start = scene.world(duration)?;
    let mut world = start.boxed_clone();
    let bar = progress::bar(quiet, end.unwrap_or(0.0));
    let samples = record(&mut *world, &times, |time| bar.set_position((time * progress::SCALE) as u64))?;
    bar.finish_and_clear();
    let mut strain = Strain::default();
    samples.iter().for_each(|sample| strain.look(&*world, sample));
    let is_kept = scene.method.ledger.is_some_and(|is_kept| is_kept);
    let entries = ledgers(&mut *start.boxed_clone(), if is_kept { end.unwrap_or(0.0) } else { 0.0 })?;
    // What a ledger takes is not the time of the stepping.
    scene.method.ledger = None;
    let timed = if is_kept { scene.world(duration)? } else { start.boxed_clone() };
    let mut recording = recording(&scene, &*timed, &times, &samples, world.counters());
    recording.moved_by = movers(&*world);
    recording.relaxed =
        study::softness(&scene)?.map(|Softness { bond, alone, stiffness }| RecordedSoftness { bond, stiffness, alone });
    recording.balance = is_kept.then(|| judge(&entries).into());
    recording.bodies = arguments.bodies_of(&scene.tints()?, world.point_count());
    recording.warnings.extend(strain.warning());
    recording.warnings.extend(past_end);
    recording.beside = beside::measured(&Scene { duration, ..scene.clone() }.into(), &samples)?;
    recording.search_seconds = found.as_ref().map_or(0.0, |found| found.seconds);
    recording.expected_error = found.as_ref().map(|found| found.expected_error);
    write(arguments, &recording)?;
    say_kernels(&*start, &samples)?;
    found.map_or(Ok(()), |found| found.report(&recording))?;
    apart.as_ref().map_or(Ok(()), Apart::report)
}

/// Says how large bodies were moved and the strain that was reached; nothing where there are none.
fn say_kernels(world: &dyn Dynamics, samples: &[Sample]) -> anyhow::Result<()> {
    let precision = if world.precision() == Precision::F32 { "f32" } else { "f64" };
    let set = InstructionSet::chosen();
    for part in world.parts().iter().filter(|part| !part.kernel.is_empty()) {
        let PlanPart { bonds, kernel, max_strain, .. } = part;
        let aim = max_strain.map_or_else(String::new, |strain| format!(" for a strain of {strain:?}"));
        let most = samples.iter().map(|sample| sample.max_strain).fold(0.0, f64::max);
        writeln!(
            std::io::stderr(),
            "wobble: {bonds} bonds as {kernel}{aim} ({precision}, {set}); largest strain of any bond at the samples {most:.1e}"
        )?;
    }
    Ok(())
}

fn write(arguments: &Arguments, recording: &Recording) -> anyhow::Result<()> {
    write_table(arguments.target(), arguments.hash, recording)
}

/// Writes the table, then says what the user should know.
fn write_table(out: Option<&Path>, has_hash: bool, recording: &Recording) -> anyhow::Result<()> {
    if out == Some(Path::new(STANDARD)) {
        recording.write_csv(std::io::stdout().lock())?;
    } else if let Some(path) = out {
        output::replace(path, |to| match extension(path).as_deref() {
            Some("csv") => recording.write_csv(to),
            _ => recording.write_json(to),
        })?;
    }
    for warning in &recording.warnings {
        writeln!(std::io::stderr(), "wobble: warning: {warning}")?;
    }
    if let Some(RecordedSoftness { bond, stiffness, alone }) = recording.relaxed {
        writeln!(
            std::io::stderr(),
            "wobble: relaxed bonds are as stiff here as springs of {stiffness:.3e} N/m (bond {bond}; one alone: {alone:.3e} N/m)"
        )?;
    }
    if let Some(balance) = recording.balance.as_ref().filter(|balance| balance.is_kept == Some(false)) {
        writeln!(std::io::stderr(), "wobble: warning: {}", balance.words())?;
    }
    if has_hash {
        writeln!(std::io::stdout(), "{}", recording.hash)?;
    }
    Ok(())
}

/// Writes the equilibrium in place of the motion: one sample.
///
/// Errors: forces do not balance, or something falls for ever (it is written all the same).
fn settle(arguments: &Arguments, scene: &Scene, time: f64) -> anyhow::Result<()> {
    let found = study::settle(scene, time)?;
    let mut runs: Vec<f64> = Vec::new();
    while runs.iter().sum::<f64>() < 0.010 && runs.len() < 15 {
        let clock = Instant::now();
        study::settle(scene, time)?;
        runs.push(clock.elapsed().as_secs_f64());
    }
    runs.sort_by(f64::total_cmp);
    let samples = [found.sample];
    let bodies = arguments.bodies_of(&scene.tints()?, samples[0].position.len());
    let recording = Recording {
        scene: scene.name().to_owned(),
        solver: "settle",
        substep: 0.0,
        precision: "f64",
        samples: samples.iter().map(|sample| RecordedSample::new(sample, scene.dimensions())).collect(),
        seconds: runs[runs.len() / 2],
        frames: None,
        search_seconds: 0.0,
        expected_error: None,
        relaxed: None,
        balance: None,
        bodies,
        moved_by: Vec::new(),
        counters: RecordedCounters { iterations: found.rounds.into(), ..RecordedCounters::default() },
        warnings: Vec::new(),
        beside: Vec::new(),
        hash: hash(&samples, scene.dimensions()),
    };
    write(arguments, &recording)?;
    if !found.falling.is_empty() {
        bail!(
            "{}: {}: a bond to a pin or a floor below would hold (written all the same)",
            arguments.scene,
            fall(&found.falling)
        );
    }
    if !found.is_settled {
        bail!(
            "{}: no equilibrium was found: a force of {:.1e} of the largest is left (written all the same)",
            arguments.scene,
            found.residual
        );
    }
    Ok(())
}

/// Says who falls: the first few by name.
fn fall(points: &[PointId]) -> String {
    let names: Vec<String> = points.iter().take(NAMED).map(|point| point.0.to_string()).collect();
    let more = points.len() - names.len();
    match (points.len(), more) {
        (1, _) => format!("point {} falls for ever", names.join("")),
        (_, 0) => format!("points {} fall for ever", names.join(", ")),
        _ => format!("points {} and {more} more fall for ever", names.join(", ")),
    }
}

/// What a search for a setting came to.
struct Searched {
    tolerance: f64,
    expected_error: f64,
    is_reached: bool,
    seconds: f64,
}

/// Finds the setting that the scene's tolerance asks for, if it has one, and puts it into the scene.
fn search(scene: &mut Scene, times: &[f64], quiet: bool) -> anyhow::Result<Option<Searched>> {
    let clock = Instant::now();
    let is_asked = scene.method.tolerance.is_some();
    let bar = is_asked.then(|| progress::waiting(quiet, "searching for the cheapest setting"));
    let tolerance = scene.method.tolerance.unwrap_or(f64::INFINITY);
    let found = study::tune(scene, times)?;
    bar.iter().for_each(|bar| bar.finish_and_clear());
    let seconds = clock.elapsed().as_secs_f64();
    Ok(found.map(|found| Searched {
        tolerance,
        expected_error: found.expected_error,
        is_reached: found.is_reached,
        seconds,
    }))
}

/// A number with three digits that count, as one would write it.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    format!("{rounded:?}")
}

impl Searched {
    /// Says what was taken and what error to expect.
    ///
    /// Errors: the tolerance was not reached.
    fn report(&self, recording: &Recording) -> anyhow::Result<()> {
        let taken = format!("{} with a substep of {} s", recording.solver, short(recording.substep));
        if !self.is_reached {
            let tolerance = self.tolerance;
            match self.expected_error {
                error if error.is_finite() => {
                    bail!(
                        "an error of {tolerance:?} m was not reached: {taken} comes to {error:.1e} m (written all the same)"
                    )
                }
                _ => bail!(
                    "an error of {tolerance:?} m was not reached: {taken}, whose error cannot be told (written all the same)"
                ),
            }
        }
        writeln!(std::io::stderr(), "wobble: {taken}, expected error {:.1e} m", self.expected_error)?;
        Ok(())
    }
}

impl Arguments {
    /// Errors: what would be written over the scene or its commands, or over each other.
    fn spare(&self) -> anyhow::Result<()> {
        let read: Vec<&Path> = [Path::new(&self.scene)].into_iter().chain(self.commands.as_deref()).collect();
        let table = self.out.as_deref().filter(|out| *out != Path::new(STANDARD));
        let written: Vec<&Path> = table.into_iter().chain(self.record.as_deref()).collect();
        spare(&read, &written)
    }

    /// Where the table goes.
    fn target(&self) -> Option<&Path> {
        let is_asked = self.out.is_some() || self.hash || self.record.is_some();
        if is_asked { self.out.as_deref() } else { Some(Path::new(STANDARD)) }
    }

    /// Which body each of so many points is of, if that is asked for.
    fn bodies_of(&self, runs: &[Tint], count: usize) -> Option<Vec<Option<u32>>> {
        let body = |point: u32| Tint::of(runs, point).map(|run| run.body);
        self.bodies.then(|| (0..count as u32).map(body).collect())
    }

    /// What the call says instead of the scene.
    fn change(&self, scene: &mut Scene) {
        let method = &mut scene.method;
        method.solver = self.solver.or(method.solver);
        // A solver that is asked for takes the loop of a source away, but for another one.
        let is_printed = method.solver == Some(SolverName::AsPrinted);
        method.source = self.source.or(method.source).filter(|_| is_printed || self.source.is_some());
        method.substep = self.substep.or(method.substep);
        method.iterations = self.iterations.or(method.iterations);
        method.order = self.order.or(method.order);
        method.seed = self.seed.or(method.seed);
        method.precision = self.precision.or(method.precision);
        method.tolerance = self.tolerance.or(method.tolerance);
        method.budget = self.budget.or(method.budget);
        method.ledger = self.ledger.then_some(true).or(method.ledger);
    }

    fn times(&self, scene: &Scene) -> anyhow::Result<Vec<f64>> {
        let times = self.samples.as_ref().map_or_else(|| scene.sample_times(), |times| times.0.clone());
        if times.is_empty() {
            bail!("{}: the scene has no duration: give --samples", self.scene);
        }
        Ok(times)
    }
}

/// What moves the islands of a world now.
fn movers(world: &dyn Dynamics) -> Vec<RecordedMover> {
    world.moved_by().iter().map(RecordedMover::from).collect()
}

fn recording(scene: &Scene, start: &dyn Dynamics, times: &[f64], samples: &[Sample], counters: &Counters) -> Recording {
    let about = About { substep: start.substep(), precision: start.precision(), warnings: start.warnings().to_vec() };
    let (seconds, frames) = seconds_and_frames(start, times);
    made(scene, about, (seconds, Some(&frames)), samples, counters)
}

/// Whether a scene names the method or the substep that its bodies are to be moved by: where they may meet the live step has them anyway.
fn is_asked_for(scene: &Scene) -> bool {
    let MethodKeys { solver, substep, .. } = &scene.method;
    let has_method = solver.is_some_and(|solver| !matches!(solver, SolverName::Auto | SolverName::Live));
    let may_meet = scene.contact.and_then(Meeting::resolve).is_some();
    !may_meet && (has_method || substep.is_some())
}

/// What is written of the world that a run began with.
struct About {
    substep: f64,
    precision: Precision,
    warnings: Vec<String>,
}

fn made(
    scene: &Scene,
    about: About,
    (seconds, frames): (f64, Option<&Frames>),
    samples: &[Sample],
    counters: &Counters,
) -> Recording {
    let mut warnings = about.warnings;
    if counters.fallbacks > 0 {
        warnings.push(format!(
            "{} parts of {} substeps were too violent for the solver and went to a more robust one: use a smaller substep",
            counters.fallbacks, counters.substeps
        ));
    }
    if counters.hand_overs > 0 && is_asked_for(scene) {
        let words = "bodies were handed to the live step, which has substeps of its own: what is asked for took more work than a frame may, or \
             did not hold: who, since when and why is in `moved_by`: `--budget none` keeps it";
        warnings.push(words.to_owned());
    }
    if counters.frozen > 0 {
        let what = if counters.frozen == 1 { "an island".to_owned() } else { format!("{} islands", counters.frozen) };
        warnings
            .push(format!("{what} left the finite numbers: what stands still since then, and where, is in `moved_by`"));
    }
    Recording {
        scene: scene.name().to_owned(),
        solver: scene.method.solver.unwrap_or(SolverName::Auto).name(),
        substep: about.substep,
        precision: if about.precision == Precision::F32 { "f32" } else { "f64" },
        samples: samples.iter().map(|sample| RecordedSample::new(sample, scene.dimensions())).collect(),
        seconds,
        frames: frames.map(RecordedFrames::from),
        search_seconds: 0.0,
        expected_error: None,
        relaxed: None,
        balance: None,
        bodies: None,
        moved_by: Vec::new(),
        counters: RecordedCounters {
            substeps: counters.substeps,
            bonds_solved: counters.bonds_solved,
            points_moved: counters.points_moved,
            iterations: counters.iterations,
            events: counters.events,
            guard_splits: counters.guard_splits,
            fallbacks: counters.fallbacks,
            bonds_torn: counters.bonds_torn,
            hand_overs: counters.hand_overs,
            returns: counters.returns,
            contacts: counters.contacts,
            truncations: counters.truncations,
            guarded: counters.guarded,
            detections: counters.detections,
            looks: counters.looks,
            mended: counters.mended,
            parted: counters.parted,
            settled: counters.settled,
            frozen: counters.frozen,
        },
        warnings,
        beside: Vec::new(),
        hash: hash(samples, scene.dimensions()),
    }
}

/// The table of a world that is led: samples as they come.
pub(super) struct Table {
    scene: Scene,
    clock: Instant,
    about: Option<About>,
    strain: Strain,
    samples: Vec<Sample>,
    counters: Counters,
    movers: Vec<RecordedMover>,
    balance: Option<Verdict>,
    beside: Vec<RecordedBeside>,
    bodies: Option<Vec<Option<u32>>>,
    past_end: Option<String>,
}

impl Table {
    /// An empty one; the wall time of the run is counted from now.
    pub(super) fn new(scene: &Scene) -> Self {
        let (clock, counters) = (Instant::now(), Counters::default());
        let (strain, scene) = (Strain::default(), scene.clone());
        let (samples, movers) = (Vec::new(), Vec::new());
        let (beside, bodies, past_end) = (Vec::new(), None, None);
        Table { scene, clock, about: None, strain, samples, counters, movers, balance: None, beside, bodies, past_end }
    }

    /// Takes a sample at `time` `[s]`, which lies within the world's next step.
    pub(super) fn sample(&mut self, world: &dyn Dynamics, time: f64) {
        let warnings = world.warnings().to_vec();
        self.about = Some(About { substep: world.substep(), precision: world.precision(), warnings });
        let sample = world.sample(time.max(world.time()));
        self.strain.look(world, &sample);
        self.samples.push(sample);
        self.counters = *world.counters();
        self.movers = movers(world);
    }

    /// How the energy was kept, where a ledger was.
    pub(super) fn balance(&mut self, balance: Option<Verdict>) {
        self.balance = balance;
    }

    /// That the run goes on where the scene ends, if it does.
    fn pass_end(&mut self, words: Option<String>) {
        self.past_end = words;
    }

    /// Which body each point is of, where that is asked for.
    fn name_bodies(&mut self, bodies: Option<Vec<Option<u32>>>) {
        self.bodies = bodies;
    }

    /// How far the same start by other methods gets, led by the same commands.
    ///
    /// Errors: a method that cannot run the scene.
    fn measure_beside(&mut self, run: &history::Recording) -> anyhow::Result<()> {
        self.beside = beside::measured(run, &self.samples)?;
        Ok(())
    }

    /// Writes it.
    pub(super) fn write(self, out: Option<&Path>, has_hash: bool, frames: Option<&Frames>) -> anyhow::Result<()> {
        let seconds = frames.map_or_else(|| self.clock.elapsed().as_secs_f64(), Frames::seconds);
        let Some(mut about) = self.about else { return Ok(()) };
        about.warnings.extend(self.strain.warning().into_iter().chain(self.past_end));
        let recording = made(&self.scene, about, (seconds, frames), &self.samples, &self.counters);
        let balance = self.balance.map(RecordedBalance::from);
        let (moved_by, beside, bodies) = (self.movers, self.beside, self.bodies);
        write_table(out, has_hash, &Recording { balance, moved_by, beside, bodies, ..recording })
    }
}
