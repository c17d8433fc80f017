//! The built-in problems: scenes whose motion is known better than any method here computes it.

use serde::{Deserialize, Serialize};

use super::error::StudyError;
use crate::scene::{BudgetKeys, Scene, SceneError};

/// A scene with its truth.
#[derive(Clone, Copy, Debug)]
pub struct Problem {
    /// What it is called by.
    pub name: &'static str,
    scene: &'static str,
    truth: &'static str,
}

/// What a truth is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Positions at the sample times.
    Dynamic,
    /// The shape at rest; the scene's drag brings a motion there.
    Static,
}

/// Where the points are, from a closed form or from a reference run of high order and precision.
#[derive(Clone, Debug, Deserialize)]
pub struct Truth {
    /// The problem's name.
    pub name: String,
    /// What the positions are of.
    pub kind: Kind,
    /// How far the positions may be off `[m]`.
    pub uncertainty: f64,
    /// A word on the scene.
    pub notes: String,
    /// The positions, times ascending; the last one is the scene's duration.
    pub samples: Vec<TruthSample>,
}

/// The positions at one time.
#[derive(Clone, Debug, Deserialize)]
pub struct TruthSample {
    /// Time `[s]`.
    pub t: f64,
    /// Positions, as many components a point as the scene has dimensions `[m]`.
    pub position: Vec<Vec<f64>>,
}

impl Truth {
    /// The sample times `[s]`.
    pub fn times(&self) -> Vec<f64> {
        self.samples.iter().map(|sample| sample.t).collect()
    }

    /// The longest side of a box around all points at all samples `[m]`.
    pub fn size(&self) -> f64 {
        let axis = |k: usize| {
            let at = self.samples.iter().flat_map(|sample| &sample.position).filter_map(|x| x.get(k).copied());
            let (low, high) = at.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
            high - low
        };
        (0..3).map(axis).fold(0.0, f64::max)
    }
}

impl TruthSample {
    /// The largest distance over points from here to `position` `[m]`, infinite where that left the finite numbers.
    ///
    /// Shapes: as many points as here, three components each (z = 0 in the plane).
    pub fn error(&self, position: &[[f64; 3]]) -> f64 {
        let distance = |(truth, x): (&Vec<f64>, &[f64; 3])| {
            let square: f64 = truth.iter().zip(x).map(|(a, b)| (a - b) * (a - b)).sum();
            square.sqrt()
        };
        let largest = |largest: f64, d: f64| if d.is_finite() { largest.max(d) } else { f64::INFINITY };
        self.position.iter().zip(position).map(distance).fold(0.0, largest)
    }
}

impl Problem {
    /// The scene, in which nothing sleeps or is handed over, read from its text.
    ///
    /// Errors: the text is out of order, which a test excludes.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        let mut scene = Scene::parse(self.scene, &format!("{}.scene.json", self.name))?;
        scene.method.sleep = Some(false);
        scene.method.budget = Some(BudgetKeys::None);
        Ok(scene)
    }

    /// The truth, read from its text.
    ///
    /// Errors: the text is out of order, which a test excludes.
    pub fn truth(&self) -> Result<Truth, StudyError> {
        serde_json::from_str(self.truth)
            .map_err(|error| StudyError::Truth { problem: self.name, reason: error.to_string() })
    }
}

/// All problems, in the order of their names.
pub fn problems() -> &'static [Problem] {
    &PROBLEMS
}

/// The problem of a name.
///
/// Errors: one line with the names that are near, or with all of them.
pub fn find(name: &str) -> Result<&'static Problem, String> {
    if let Some(problem) = PROBLEMS.iter().find(|problem| problem.name == name) {
        return Ok(problem);
    }
    let near = near(name);
    Err(match near.as_slice() {
        [] => {
            let all: Vec<&str> = PROBLEMS.iter().map(|problem| problem.name).collect();
            format!("`{name}` is no built-in problem: use one of {}", all.join(", "))
        }
        [only] => format!("`{name}` is no built-in problem: did you mean {only}?"),
        _ => format!("`{name}` is no built-in problem: did you mean one of {}?", near.join(", ")),
    })
}

/// The names that start like `name` for longest, and those that contain it, upper or lower case.
fn near(name: &str) -> Vec<&'static str> {
    let text = name.to_lowercase();
    let shared =
        |candidate: &str| text.chars().zip(candidate.to_lowercase().chars()).take_while(|(a, b)| a == b).count();
    let longest = PROBLEMS.iter().map(|problem| shared(problem.name)).max().unwrap_or(0);
    let is_near = |candidate: &str| {
        (longest > 0 && shared(candidate) == longest) || (!text.is_empty() && candidate.to_lowercase().contains(&text))
    };
    PROBLEMS.iter().map(|problem| problem.name).filter(|candidate| is_near(candidate)).collect()
}

/// A problem, its texts embedded from `assets/problems`.
macro_rules! problem {
    ($name:literal) => {
        Problem {
            name: $name,
            scene: include_str!(concat!("../../assets/problems/", $name, ".scene.json")),
            truth: include_str!(concat!("../../assets/problems/", $name, ".truth.json")),
        }
    };
}

static PROBLEMS: [Problem; 29] = [
    problem!("A1_freefall"),
    problem!("A2_drag"),
    problem!("B1_osc"),
    problem!("B2_osc_damped"),
    problem!("B5_elastic_pendulum"),
    problem!("B7_stiff_pendulum_1e6"),
    problem!("C1_circle"),
    problem!("C3_decay"),
    problem!("D1_pendulum90"),
    problem!("E1_double"),
    problem!("F1_chain10"),
    problem!("F4_rope50"),
    problem!("G1_lattice_small"),
    problem!("G2_lattice_moderate"),
    problem!("H1_catenary_rigid"),
    problem!("H3_elastic_hang"),
    problem!("I1_rim_free"),
    problem!("I3_rim_floor"),
    problem!("I5_rim_rigid"),
    problem!("J1_heavy_1000"),
    problem!("K1_mouse_trap"),
    problem!("K3_rim_mouse"),
    problem!("L1_cloth"),
    problem!("M1_bounce"),
    problem!("N1_flight"),
    problem!("N3_spherical_pendulum"),
    problem!("N6_cloth5"),
    problem!("N8_cloth11_corners"),
    problem!("N10_bounce_plane"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_problem_is_in_order() {
        for problem in problems() {
            let (scene, truth) = (problem.scene().unwrap(), problem.truth().unwrap());
            assert_eq!((scene.name(), truth.name.as_str()), (problem.name, problem.name));
            assert_eq!(scene.samples, truth.times(), "{}", problem.name);
            assert_eq!(scene.duration, truth.times().last().copied(), "{}", problem.name);
            assert!(truth.uncertainty < 1e-16, "{}", problem.name);
            let points = scene.points.as_ref().unwrap().position.len();
            for sample in &truth.samples {
                assert_eq!(sample.position.len(), points);
                assert!(sample.position.iter().all(|x| x.len() == scene.dimensions()));
            }
        }
    }

    #[test]
    fn samples_are_evenly_spaced_up_to_the_duration() {
        for problem in problems() {
            let times = problem.truth().unwrap().times();
            let (count, end) = (times.len() as f64, *times.last().unwrap());
            for (i, t) in times.iter().enumerate() {
                assert!((t - end * (i + 1) as f64 / count).abs() < 1e-12 * end, "{}", problem.name);
            }
        }
    }

    #[test]
    fn a_name_that_is_none_is_answered_by_those_near_it() {
        assert_eq!(find("B1_osc").unwrap().name, "B1_osc");
        assert!(find("b1_ocs").unwrap_err().ends_with("did you mean B1_osc?"));
        assert!(find("rim").unwrap_err().contains("I1_rim_free, I3_rim_floor, I5_rim_rigid, K3_rim_mouse"));
        assert!(find("?").unwrap_err().contains("use one of A1_freefall, A2_drag"));
        assert!(find("").is_err());
    }

    #[test]
    fn the_error_is_the_largest_distance() {
        let truth = TruthSample { t: 1.0, position: vec![vec![0.0, 0.0], vec![1.0, 1.0]] };
        assert_eq!(truth.error(&[[0.0; 3], [4.0, 5.0, 0.0]]), 5.0);
        assert_eq!(truth.error(&[[f64::NAN, 0.0, 0.0], [1.0, 1.0, 0.0]]), f64::INFINITY);
    }
}
