//! Runs a world and records its samples: what `wobble simulate` writes.

use std::io::Write;
use std::time::Instant;

use serde::Serialize;
use xxhash_rust::xxh3::Xxh3;

use super::frames::{Frames, next_close};
use crate::sim::{Book, Dynamics, Energies, Ledger, MovedBy, Sample, Verdict};

/// A motion that cannot be recorded.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RecordError {
    /// The motion left the finite numbers.
    #[error("the motion left the finite numbers at t = {time} s: use a smaller substep or softer bonds")]
    NotFinite {
        /// When it was noticed `[s]`.
        time: f64,
    },
}

/// Substeps between two looks at whether the motion is finite.
const LOOK_EVERY: u64 = 256;

/// Runs `world` on and samples it at `times` `[s]`, which ascend from the time that it has reached.
///
/// `progress` is told the time reached now and then. Samples are taken on copies: the motion does not depend on them.
/// Errors: [`RecordError::NotFinite`], at the latest at the next sample.
pub fn record(
    world: &mut dyn Dynamics,
    times: &[f64],
    mut progress: impl FnMut(f64),
) -> Result<Vec<Sample>, RecordError> {
    let mut samples = Vec::with_capacity(times.len());
    for &time in times {
        run_to(world, time, &mut progress)?;
        samples.push(world.sample(time));
        progress(time);
        if !world.is_finite() || samples.last().is_some_and(|sample| !sample.energy.is_finite()) {
            return Err(RecordError::NotFinite { time: world.time() });
        }
    }
    Ok(samples)
}

/// Takes the substeps that end at or before `time` `[s]`.
///
/// Errors: [`RecordError::NotFinite`].
pub fn run_to(world: &mut dyn Dynamics, time: f64, progress: &mut dyn FnMut(f64)) -> Result<(), RecordError> {
    // A substep that ends a rounding error after `time` still ends at it.
    while world.time() + world.substep() * (1.0 - 1e-9) <= time {
        world.step();
        if world.counters().substeps.is_multiple_of(LOOK_EVERY) {
            progress(world.time());
            if !world.is_finite() {
                return Err(RecordError::NotFinite { time: world.time() });
            }
        }
    }
    if world.is_finite() { Ok(()) } else { Err(RecordError::NotFinite { time: world.time() }) }
}

/// Runs `world` on to `end` `[s]` and takes its ledger now and at the end of every frame of 1/60 s: what
/// [`judge`](crate::sim::judge) judges. Empty where none is kept.
///
/// Errors: [`RecordError::NotFinite`].
pub fn ledgers(world: &mut dyn Dynamics, end: f64) -> Result<Vec<Ledger>, RecordError> {
    let mut entries = Vec::new();
    let mut time = world.time();
    loop {
        let Some(ledger) = world.sample(time).ledger else { return Ok(entries) };
        entries.push(ledger);
        if time >= end {
            return Ok(entries);
        }
        time = next_close(time).min(end);
        run_to(world, time, &mut |_| {})?;
    }
}

/// Wall seconds that stepping `world` to the last of `times` takes, in the median: short runs are repeated.
pub fn seconds(world: &dyn Dynamics, times: &[f64]) -> f64 {
    median(|| {
        let (mut copy, end) = (world.boxed_clone(), last(times));
        let start = Instant::now();
        while copy.time() + copy.substep() * (1.0 - 1e-9) <= end {
            copy.step();
        }
        (start.elapsed().as_secs_f64(), ())
    })
    .0
}

/// The same with the time and the counted work of every frame.
pub fn seconds_and_frames(world: &dyn Dynamics, times: &[f64]) -> (f64, Frames) {
    // Shorter ones are told apart from reading the clock in each only by a run that does not read it.
    const SHORT: f64 = 1e-5;
    let (sum, frames) = median(|| {
        let frames = Frames::of(&mut *world.boxed_clone(), last(times));
        (frames.seconds(), frames)
    });
    (if sum < SHORT * frames.count() as f64 { seconds(world, times) } else { sum }, frames)
}

/// The median of runs that return their wall seconds and something else: one alone, where it is not short.
fn median<T>(mut run: impl FnMut() -> (f64, T)) -> (f64, T) {
    let mut runs = vec![run()];
    // A clock's reading of less than 10 ms says more of the machine's noise than of the work.
    while runs[0].0 < 0.010 && runs.len() < 15 {
        runs.push(run());
    }
    runs.sort_by(|a, b| a.0.total_cmp(&b.0));
    runs.swap_remove(runs.len() / 2)
}

fn last(times: &[f64]) -> f64 {
    times.last().copied().unwrap_or(0.0)
}

/// Hash of the bits of all samples' positions and velocities, in order, but of points that were deleted: 32 hexadecimal digits
/// (XXH3, 128 bits).
pub fn hash(samples: &[Sample], dimensions: usize) -> String {
    let mut hasher = Xxh3::new();
    for sample in samples {
        let is_left = |point: &usize| !is_gone(&sample.position[*point]);
        let points = || (0..sample.position.len()).filter(is_left);
        let vectors = points().map(|k| &sample.position[k]).chain(points().map(|k| &sample.velocity[k]));
        for vector in vectors {
            for component in &vector[..dimensions] {
                hasher.update(&component.to_le_bytes());
            }
        }
    }
    format!("{:032x}", hasher.digest128())
}

/// Whether a position is that of a point that was deleted: a motion that leaves the numbers is no sample.
fn is_gone(position: &[f64; 3]) -> bool {
    position[0].is_nan()
}

/// A recorded motion with what made it.
#[derive(Clone, Debug, Serialize)]
pub struct Recording {
    /// Name of the scene.
    pub scene: String,
    /// The solver asked for.
    pub solver: &'static str,
    /// Longest substep `[s]`.
    pub substep: f64,
    /// `f32` or `f64`.
    pub precision: &'static str,
    /// The samples.
    pub samples: Vec<RecordedSample>,
    /// Wall time of the stepping `[s]`.
    pub seconds: f64,
    /// The same by frames, with their counted work; `None` where nothing was stepped, or by another hand.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames: Option<RecordedFrames>,
    /// Wall time that finding the setting took `[s]`.
    pub search_seconds: f64,
    /// The error that the setting is expected to have at every sample `[m]`, where it was searched for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected_error: Option<f64>,
    /// What relaxed bonds of a share below 1 amount to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relaxed: Option<RecordedSoftness>,
    /// How the energy was kept, where a ledger was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub balance: Option<RecordedBalance>,
    /// The number of the body that each point is of, counted from 0, where it is asked for; `None` of a point that no body has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bodies: Option<Vec<Option<u32>>>,
    /// What moves the islands at the end of the run, in the order of their lowest points.
    pub moved_by: Vec<RecordedMover>,
    /// Work done.
    pub counters: RecordedCounters,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// The same start by other methods, where the scene has some beside it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub beside: Vec<RecordedBeside>,
    /// See [`hash`].
    pub hash: String,
}

/// The same start by another method, and how far that gets.
#[derive(Clone, Debug, Serialize)]
pub struct RecordedBeside {
    /// What it is called.
    pub title: String,
    /// The solver asked for.
    pub solver: &'static str,
    /// Longest substep `[s]`.
    pub substep: f64,
    /// The largest distance of a point from where the run has it, at each sample `[m]`.
    pub distance: Vec<f64>,
}

/// The stiffness that relaxed bonds amount to at this substep, these sweeps and this order.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct RecordedSoftness {
    /// The bond that was pulled.
    pub bond: usize,
    /// Stiffness of springs that would give as much in its place `[N/m]`.
    pub stiffness: f64,
    /// The same of one bond alone `[N/m]`.
    pub alone: f64,
}

/// One sample, with as many components a point as the scene has dimensions.
#[derive(Clone, Debug, Serialize)]
pub struct RecordedSample {
    /// Time `[s]`.
    pub t: f64,
    /// Positions `[m]`; `None` of points that were deleted.
    pub position: Vec<Option<Vec<f64>>>,
    /// Velocities `[m/s]`, likewise.
    pub velocity: Vec<Option<Vec<f64>>>,
    /// Kinetic + springs' + gravity's energy of the points that are not pinned `[J]`.
    pub energy: f64,
    /// Largest strain `[1]`.
    pub max_strain: f64,
    /// Where the energy came from and went since the start, if that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ledger: Option<RecordedLedger>,
}

/// The ledger of a sample `[J]`: now - start = brought - taken + left over.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct RecordedLedger {
    /// Kinetic, springs' and gravity's energy now.
    pub kinetic: f64,
    /// See [`RecordedLedger::kinetic`].
    pub springs: f64,
    /// See [`RecordedLedger::kinetic`].
    pub gravity: f64,
    /// The sum of these at the start.
    pub start: f64,
    /// Brought by the mouse force, a grab, pins that are led, constant forces, drives, the wind, and commands.
    pub mouse: f64,
    /// See [`RecordedLedger::mouse`].
    pub grab: f64,
    /// See [`RecordedLedger::mouse`].
    pub pins: f64,
    /// See [`RecordedLedger::mouse`].
    pub forces: f64,
    /// See [`RecordedLedger::mouse`].
    pub drives: f64,
    /// See [`RecordedLedger::mouse`].
    pub wind: f64,
    /// See [`RecordedLedger::mouse`].
    pub commands: f64,
    /// See [`RecordedLedger::mouse`].
    pub parting: f64,
    /// Taken by dampers, drag, friction, impacts, bonds that broke, and sweeps over relaxed bonds.
    pub dampers: f64,
    /// See [`RecordedLedger::dampers`].
    pub drag: f64,
    /// See [`RecordedLedger::dampers`].
    pub friction: f64,
    /// See [`RecordedLedger::dampers`].
    pub impacts: f64,
    /// See [`RecordedLedger::dampers`].
    pub breaks: f64,
    /// See [`RecordedLedger::dampers`].
    pub relaxation: f64,
    /// What none of them explains: the method's own error.
    pub left_over: f64,
}

impl From<&Ledger> for RecordedLedger {
    fn from(ledger: &Ledger) -> Self {
        let Ledger { now, start, .. } = *ledger;
        let Energies { kinetic, gravity, .. } = now;
        let Book {
            mouse,
            grab,
            pins,
            forces,
            drives,
            wind,
            commands,
            parting,
            dampers,
            drag,
            friction,
            impacts,
            breaks,
            relaxation,
            ..
        } = ledger.book;
        RecordedLedger {
            kinetic,
            springs: now.elastic(),
            gravity,
            start,
            mouse,
            grab,
            pins,
            forces,
            drives,
            wind,
            commands,
            parting,
            dampers,
            drag,
            friction,
            impacts,
            breaks,
            relaxation,
            left_over: ledger.left_over(),
        }
    }
}

/// How the energy was kept, judged once a frame.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct RecordedBalance {
    /// The most that came from nowhere, as a share of the largest kinetic energy until then `[1]`, and when `[s]`.
    pub gain: f64,
    /// See [`RecordedBalance::gain`].
    pub gain_at: f64,
    /// The most that went without a reason within 10 s, likewise.
    pub loss: f64,
    /// See [`RecordedBalance::loss`].
    pub loss_at: f64,
    /// Whether these can be told from the work at pins that are led.
    pub is_told: bool,
    /// Whether both are small; `None` where that cannot be told.
    pub is_kept: Option<bool>,
}

impl From<Verdict> for RecordedBalance {
    fn from(verdict: Verdict) -> Self {
        let Verdict { gain, gain_at, loss, loss_at, is_told } = verdict;
        RecordedBalance { gain, gain_at, loss, loss_at, is_told, is_kept: verdict.is_told.then_some(verdict.passes()) }
    }
}

impl RecordedBalance {
    /// What was not kept, and how much of it.
    pub fn words(&self) -> String {
        use crate::sim::{MOST_GAIN, MOST_LOSS};
        let share = |share: f64, most: f64, at: f64| {
            format!("{:.1} % of the largest kinetic energy by {at:.3} s, where {} % may", 100.0 * share, 100.0 * most)
        };
        match (self.gain <= MOST_GAIN, self.loss <= MOST_LOSS) {
            (true, true) => "the energy was kept".to_owned(),
            (false, _) => format!("energy came from nowhere: {}", share(self.gain, MOST_GAIN, self.gain_at)),
            (true, false) => format!("energy went without a reason: {}", share(self.loss, MOST_LOSS, self.loss_at)),
        }
    }
}

impl RecordedSample {
    /// A sample of a scene in `dimensions`.
    pub fn new(sample: &Sample, dimensions: usize) -> Self {
        let is_left = |point: usize| !is_gone(&sample.position[point]);
        let cut = |list: &[[f64; 3]]| {
            let vector = |(point, x): (usize, &[f64; 3])| is_left(point).then(|| x[..dimensions].to_vec());
            list.iter().enumerate().map(vector).collect()
        };
        RecordedSample {
            t: sample.time,
            position: cut(&sample.position),
            velocity: cut(&sample.velocity),
            energy: sample.energy,
            max_strain: sample.max_strain,
            ledger: sample.ledger.as_ref().map(RecordedLedger::from),
        }
    }
}

/// Frames of 1/60 s of the scene: time and counted work of the steps that end in each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RecordedFrames {
    /// How many.
    pub count: u64,
    /// Wall time of the median one `[ms]`.
    pub median_ms: f64,
    /// Wall time that one in a hundred exceeds `[ms]`.
    pub p99_ms: f64,
    /// Wall time of the slowest one `[ms]`.
    pub worst_ms: f64,
    /// Counted work of the dearest one [ms on the reference machine]: the same on every machine.
    pub worst_work_ms: f64,
}

impl From<&Frames> for RecordedFrames {
    fn from(frames: &Frames) -> Self {
        RecordedFrames {
            count: frames.count(),
            median_ms: frames.quantile_ms(0.5),
            p99_ms: frames.quantile_ms(0.99),
            worst_ms: frames.quantile_ms(1.0),
            worst_work_ms: frames.worst_work_ms(),
        }
    }
}

/// Islands that step together, and what moves them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RecordedMover {
    /// The lowest of their points that can move.
    pub first: u32,
    /// Points that can move.
    pub count: usize,
    /// The method.
    pub method: &'static str,
    /// Since when `[s]`.
    pub since: f64,
    /// `plan`, `budget`, `contact` or `alarm`; `not finite` of what stands still.
    pub why: &'static str,
}

impl From<&MovedBy> for RecordedMover {
    fn from(moved: &MovedBy) -> Self {
        let MovedBy { first, count, method, since, why, .. } = *moved;
        RecordedMover { first: first.0, count, method: method.name(), since, why: why.name() }
    }
}

/// The counters of a recording.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct RecordedCounters {
    /// Substeps taken.
    pub substeps: u64,
    /// Bonds taken by sweeps or evaluated as springs.
    pub bonds_solved: u64,
    /// Points advanced.
    pub points_moved: u64,
    /// Sweeps over the bonds.
    pub iterations: u64,
    /// Touches of walls.
    pub events: u64,
    /// Substeps that a guard split.
    pub guard_splits: u64,
    /// Substeps that did not converge and went on with what they had.
    pub fallbacks: u64,
    /// Bonds torn.
    pub bonds_torn: u64,
    /// Groups of islands that were handed over to the live step.
    pub hand_overs: u64,
    /// Those that went back to their own methods.
    pub returns: u64,
    /// Points and edges of bodies that pressed each other in the live step, once a substep.
    pub contacts: u64,
    /// Motions that it cut where a point would have passed an edge.
    pub truncations: u64,
    /// Steps after which it took energy from bodies that had got it from nowhere.
    pub guarded: u64,
    /// Searches for what is near what.
    pub detections: u64,
    /// Looks whether skins cross.
    pub looks: u64,
    /// Points that it led back to the shape of their body, once a substep.
    pub mended: u64,
    /// Couples of bodies that it parted, once a substep.
    pub parted: u64,
    /// Bodies that it slowed down as they came to rest, once a step.
    pub settled: u64,
    /// Islands that left the finite numbers and stood still from then on.
    pub frozen: u64,
}

impl Recording {
    /// As one JSON object.
    ///
    /// Errors: the writer's.
    pub fn write_json(&self, mut to: impl Write) -> std::io::Result<()> {
        serde_json::to_writer(&mut to, self)?;
        to.write_all(b"\n")
    }

    /// As CSV: a row a sample and point (t, point, x, y, vx, vy; in space with z and vz; then body, where it is asked for).
    ///
    /// Errors: the writer's.
    pub fn write_csv(&self, to: impl Write) -> std::io::Result<()> {
        // What the writer answered is told as it is: a reader that has gone is told by that from other failures.
        self.write_rows(to).map_err(|error| match error.into_kind() {
            csv::ErrorKind::Io(error) => error,
            other => std::io::Error::other(format!("{other:?}")),
        })
    }

    fn write_rows(&self, to: impl Write) -> csv::Result<()> {
        let space =
            self.samples.iter().flat_map(|sample| sample.position.iter().flatten().next()).any(|x| x.len() == 3);
        let mut rows = csv::Writer::from_writer(to);
        let columns = if space {
            &["t", "point", "x", "y", "z", "vx", "vy", "vz"][..]
        } else {
            &["t", "point", "x", "y", "vx", "vy"]
        };
        rows.write_record(columns.iter().chain(self.bodies.iter().map(|_| &"body")))?;
        for sample in &self.samples {
            for (point, (x, v)) in sample.position.iter().zip(&sample.velocity).enumerate() {
                let (Some(x), Some(v)) = (x, v) else { continue };
                rows.write_field(number(sample.t))?;
                rows.write_field(point.to_string())?;
                for &component in x.iter().chain(v) {
                    rows.write_field(number(component))?;
                }
                if let Some(bodies) = &self.bodies {
                    let body = bodies.get(point).copied().flatten();
                    rows.write_field(body.map_or_else(String::new, |body| body.to_string()))?;
                }
                rows.write_record(None::<&[u8]>)?;
            }
        }
        Ok(rows.flush()?)
    }
}

/// The shortest digits that read back as the same number.
fn number(value: f64) -> String {
    format!("{value:?}")
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::scene::Scene;

    #[derive(serde::Deserialize)]
    struct Frozen {
        scene: String,
        time: f64,
        hash: String,
    }

    /// The bits that tests/determinism.rs holds in another build.
    #[test]
    fn the_bits_do_not_depend_on_how_the_code_is_optimised() {
        let frozen: Vec<Frozen> = serde_json::from_str(include_str!("../../tests/files/bits.json")).unwrap();
        for Frozen { scene: name, time, hash: expected } in frozen {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(&name);
            let scene = if name.contains('/') { Scene::read(&path) } else { Scene::load(&name) }.unwrap();
            let mut world = scene.world(Some(time)).unwrap();
            let samples = record(&mut *world, &[time], |_| {}).unwrap();
            assert_eq!(hash(&samples, scene.dimensions()), expected, "{name}");
        }
    }
}
