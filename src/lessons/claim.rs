//! Numbers that a lesson claims, and how they are measured.

use serde::Deserialize;

use super::LessonError;
use crate::scene::record::{RecordError, run_to};
use crate::scene::{Scene, SolverName};
use crate::sim::{Dynamics, Sample};

/// The substep of the motion that errors are measured against, as a share of the scene's own `[1]`: by a method of order 8 that is a
/// billionth of the error by any lower order. More would be rounding.
const FINER: f64 = 1.0 / 16.0;
/// Time between two looks at a greatest value `[s]`: a frame.
const LOOK: f64 = 1.0 / 60.0;

/// A number that a step's words hold.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// What is claimed: holds `expected` as a number, or as a number of per cent.
    pub words: String,
    /// What is measured.
    pub measure: Measure,
    /// What comes of it.
    pub expected: f64,
    /// How far off that may be, >= 0.
    pub within: f64,
}

/// What is measured of a scene, by its own method.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(tag = "what", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Measure {
    /// How many points there are.
    Points,
    /// The energy at a time, in energies at the start `[1]`.
    EnergyRatio {
        /// `[s]`
        time: f64,
    },
    /// The greatest energy less the least one until a time, in energies at the start `[1]`, looked at after every substep.
    EnergySpan {
        /// `[s]`
        time: f64,
    },
    /// How far a point is from where it is by a finer motion `[m]`.
    Error {
        /// The point.
        point: usize,
        /// `[s]`
        time: f64,
    },
    /// That distance in those after the same time by half of the substep `[1]`: 2 to the power of the method's order.
    ErrorRatio {
        /// The point.
        point: usize,
        /// `[s]`
        time: f64,
    },
    /// The same after a single step, long and half as long `[1]`: 2 to the power of the order in one step.
    StepErrorRatio {
        /// The point.
        point: usize,
    },
    /// How far a point is from where it began `[m]`.
    Moved {
        /// The point.
        point: usize,
        /// `[s]`
        time: f64,
    },
    /// The speed of a point `[m/s]`.
    Speed {
        /// The point.
        point: usize,
        /// `[s]`
        time: f64,
    },
    /// The height of the lowest point `[m]`.
    Lowest {
        /// `[s]`
        time: f64,
    },
    /// The largest |length/rest - 1| of a bond `[1]`.
    Strain {
        /// `[s]`
        time: f64,
    },
    /// The largest of those until a time, looked at once a frame of 1/60 s `[1]`.
    PeakStrain {
        /// `[s]`
        time: f64,
    },
    /// The least angle at the second point, from the first to the third, anticlockwise from 0 to 360, until a time, looked at as often
    /// `[degrees]`; in the plane.
    LeastAngle {
        /// The points.
        points: [usize; 3],
        /// `[s]`
        time: f64,
    },
    /// The greatest of those `[degrees]`.
    GreatestAngle {
        /// The points.
        points: [usize; 3],
        /// `[s]`
        time: f64,
    },
}

impl Claim {
    /// Whether a measured value is what is claimed.
    pub fn holds(&self, measured: f64) -> bool {
        (measured - self.expected).abs() <= self.within
    }
}

impl Measure {
    /// Measures it of a scene.
    ///
    /// Accuracy: errors are against the solver `rk8` in 64 bits at a sixteenth of the substep, so they mean something where the
    /// motion is smooth: springs without surfaces.
    /// Errors: a scene that cannot be run; a motion that leaves the finite numbers; a point that is not there; an error ratio of a
    /// scene that says no substep.
    pub fn of(self, scene: &Scene) -> Result<f64, LessonError> {
        match self {
            Measure::Points => Ok(scene.world(None)?.point_count() as f64),
            Measure::EnergyRatio { time } => {
                let [first, last] = ends(scene, time)?;
                Ok(last.energy / first.energy)
            }
            Measure::EnergySpan { time } => energy_span(scene, time),
            Measure::Error { point, time } => error(scene, point, time),
            Measure::ErrorRatio { point, time } => {
                Ok(error(scene, point, time)? / error(&with_substep(scene, 0.5)?, point, time)?)
            }
            Measure::StepErrorRatio { point } => {
                let half = with_substep(scene, 0.5)?;
                Ok(error(scene, point, substep(scene)?)? / error(&half, point, substep(&half)?)?)
            }
            Measure::Moved { point, time } => {
                let [first, last] = ends(scene, time)?;
                Ok(distance(place(&first, point)?, place(&last, point)?))
            }
            Measure::Speed { point, time } => {
                let [_, last] = ends(scene, time)?;
                place(&last, point)?;
                Ok(distance(last.velocity[point], [0.0; 3]))
            }
            Measure::Lowest { time } => {
                let [_, last] = ends(scene, time)?;
                Ok(last.position.iter().map(|place| place[1]).fold(f64::INFINITY, f64::min))
            }
            Measure::Strain { time } => Ok(ends(scene, time)?[1].max_strain),
            Measure::PeakStrain { time } => frames(scene, time, |sample| Ok(sample.max_strain), (0.0, f64::max)),
            Measure::LeastAngle { points, time } => {
                frames(scene, time, |sample| angle(sample, points), (f64::INFINITY, f64::min))
            }
            Measure::GreatestAngle { points, time } => {
                frames(scene, time, |sample| angle(sample, points), (0.0, f64::max))
            }
        }
    }
}

/// The state at the start and at a time.
fn ends(scene: &Scene, time: f64) -> Result<[Sample; 2], LessonError> {
    let mut world = scene.world(scene.duration)?;
    let first = world.sample(0.0);
    Ok([first, at(&mut *world, time)?])
}

/// The state at a time that is to come. An end of the last substep that rounding puts after it is taken for it.
fn at(world: &mut dyn Dynamics, time: f64) -> Result<Sample, RecordError> {
    run_to(world, time, &mut |_| ())?;
    Ok(world.sample(time.max(world.time())))
}

fn place(sample: &Sample, point: usize) -> Result<[f64; 3], LessonError> {
    let lacking = LessonError::NoPoint { point, count: sample.position.len() };
    sample.position.get(point).copied().ok_or(lacking)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

fn energy_span(scene: &Scene, time: f64) -> Result<f64, LessonError> {
    let mut world = scene.world(scene.duration)?;
    let first = world.energy();
    let [mut least, mut most] = [first; 2];
    while world.time() < time && world.is_finite() {
        world.step();
        let energy = world.energy();
        (least, most) = (least.min(energy), most.max(energy));
    }
    Ok((most - least) / first.abs())
}

/// The outcome of a measure once a frame until a time, as two of them are put together, from a first one on.
fn frames(
    scene: &Scene,
    time: f64,
    measure: impl Fn(&Sample) -> Result<f64, LessonError>,
    (first, both): (f64, fn(f64, f64) -> f64),
) -> Result<f64, LessonError> {
    let mut world = scene.world(scene.duration)?;
    let count = (time / LOOK).round() as u32;
    (1..=count).try_fold(first, |so_far, frame| Ok(both(so_far, measure(&at(&mut *world, f64::from(frame) * LOOK)?)?)))
}

/// The angle at the second of three points, from the first to the third, anticlockwise from 0 to 360 `[degrees]`.
fn angle(sample: &Sample, points: [usize; 3]) -> Result<f64, LessonError> {
    let [a, b, c] = [place(sample, points[0])?, place(sample, points[1])?, place(sample, points[2])?];
    let ([ax, ay], [cx, cy]) = ([a[0] - b[0], a[1] - b[1]], [c[0] - b[0], c[1] - b[1]]);
    Ok(libm::atan2(ax * cy - ay * cx, ax * cx + ay * cy).to_degrees().rem_euclid(360.0))
}

/// How far a point is from where a finer motion has it `[m]`.
fn error(scene: &Scene, point: usize, time: f64) -> Result<f64, LessonError> {
    let mut finer = match substep(scene) {
        Ok(_) => with_substep(scene, FINER)?,
        Err(_) => scene.clone(),
    };
    finer.method.solver = Some(SolverName::Rk8);
    let [own, fine] = [ends(scene, time)?, ends(&finer, time)?];
    Ok(distance(place(&own[1], point)?, place(&fine[1], point)?))
}

/// The substep that a scene says `[s]`.
fn substep(scene: &Scene) -> Result<f64, LessonError> {
    scene.method.substep.ok_or(LessonError::NoSubstep)
}

/// The same scene by a share of its substep.
fn with_substep(scene: &Scene, share: f64) -> Result<Scene, LessonError> {
    let shorter = share * substep(scene)?;
    let mut scene = scene.clone();
    scene.method.substep = Some(shorter);
    Ok(scene)
}
