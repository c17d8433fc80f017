//! One scene in one engine at one setting: time a frame, and how far the bonds or the positions are off.

use std::time::Instant;

use crate::peer::World;
use crate::scenes::Scene;

/// Frames of a run: 2 s.
pub(crate) const FRAMES: usize = 120;
/// Frames after which strain is read: t = 1, 1.25, 1.5, 1.75 and 2 s.
const READINGS: [usize; 5] = [60, 75, 90, 105, 120];

/// What a run cost and how good it was.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    /// Time of all frames [s].
    pub(crate) seconds: f64,
    /// Median time of a frame [ms].
    pub(crate) median_ms: f64,
    /// Total time over frames [ms].
    pub(crate) mean_ms: f64,
    /// Over all bonds and readings.
    pub(crate) strain: Deviation,
    /// Over all points at the end, where the truth is known [m].
    pub(crate) error: Option<Deviation>,
    /// False if the run was given up before 2 s: its deviations are then lower bounds.
    pub(crate) is_finished: bool,
}

/// Largest value and root mean square.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Deviation {
    /// The largest; infinite if any was not a number.
    pub(crate) max: f64,
    /// Root of the mean square.
    pub(crate) rms: f64,
}

/// When to give a run up.
#[derive(Clone, Copy)]
pub(crate) struct Limits {
    /// At a reading with more strain than this.
    pub(crate) strain: f64,
    /// After so many seconds of stepping.
    pub(crate) seconds: f64,
}

/// Steps a fresh world for 2 s, or until a limit is passed.
pub(crate) fn run(scene: &Scene, mut world: Box<dyn World>, limits: Limits) -> Outcome {
    let mut times = Vec::with_capacity(FRAMES);
    let mut seconds = 0.0;
    let mut strain = Sum::default();
    for frame in 1..=FRAMES {
        let start = Instant::now();
        world.step();
        let time = start.elapsed().as_secs_f64();
        seconds += time;
        times.push(time);
        if READINGS.contains(&frame) {
            read_strain(scene, &world.positions(), &mut strain);
        }
        if strain.max > limits.strain || seconds > limits.seconds {
            break;
        }
    }
    let frames = times.len();
    times.sort_by(f64::total_cmp);
    let is_finished = frames == FRAMES;
    let error = scene.truth.as_ref().filter(|_| is_finished).map(|truth| error(truth, &world.positions()));
    Outcome {
        seconds,
        median_ms: 1e3 * times[frames / 2],
        mean_ms: 1e3 * seconds / frames as f64,
        strain: strain.deviation(),
        error,
        is_finished,
    }
}

/// Adds |length / rest - 1| of every bond.
fn read_strain(scene: &Scene, positions: &[[f64; 2]], strain: &mut Sum) {
    for bond in &scene.bonds {
        let [a, b] = bond.ends.map(|i| positions[i]);
        strain.add((distance(a, b) / bond.rest - 1.0).abs());
    }
}

/// Distances of points from where they should be.
fn error(truth: &[[f64; 2]], positions: &[[f64; 2]]) -> Deviation {
    let mut sum = Sum::default();
    truth.iter().zip(positions).for_each(|(&a, &b)| sum.add(distance(a, b)));
    sum.deviation()
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

#[derive(Default)]
struct Sum {
    max: f64,
    squares: f64,
    count: usize,
}

impl Sum {
    fn add(&mut self, value: f64) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        self.max = self.max.max(value);
        self.squares += value * value;
        self.count += 1;
    }

    fn deviation(&self) -> Deviation {
        Deviation { max: self.max, rms: (self.squares / self.count.max(1) as f64).sqrt() }
    }
}
