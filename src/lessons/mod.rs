//! Lessons: steps beside a live scene, each with what to try, what is seen there, and numbers that can be measured.
//!
//! A lesson is a file in `assets/lessons`, which the program carries with it:
//!
//! | key | what it is |
//! |---|---|
//! | `title`, `about` | a few words for a list; one sentence on what it is about |
//! | `source` | where it can be read up |
//! | `steps` | 3 to 6 of them |
//!
//! A step has
//!
//! | key | what it is |
//! |---|---|
//! | `heading`, `text` | a few words; two or three plain sentences |
//! | `formula` | what stands apart, in Unicode; may be left out |
//! | `scene` | the scene of the gallery that it opens |
//! | `patch` | what that scene has differently: a merge patch ([RFC 7396](https://www.rfc-editor.org/rfc/rfc7396)) of its file; may be left out |
//! | `try`, `see` | what to do, and what is seen |
//! | `plot` | what the panel of plots shows ([`Plot`]): `{"of": "energies"}`, `{"of": "strain"}`, `{"of": "probes", "points": [1], "quantity": "x"}`, `{"of": "bonds", "bonds": [3], "quantity": "force"}`, `{"of": "angle", "points": [3, 18, 21]}`, or `"of": "phase"` with two points; may be left out |
//! | `show` | `strain` or `bonds` in place of bodies; may be left out |
//! | `claims` | numbers in its words that are measured: `words`, `measure` ([`Measure`]), `expected`, `within`; may be left out |
//!
//! A scene with a patch is called by its lesson and the number of its step, such as `orders-2`.

mod claim;
mod patch;

use std::sync::LazyLock;

use serde::Deserialize;
use serde_json::Value;

pub use claim::{Claim, Measure};

use crate::scene::record::RecordError;
use crate::scene::{Scene, SceneError, gallery};

/// Fewest and most steps of a lesson.
const STEPS: [usize; 2] = [3, 6];

/// What is wrong with a lesson.
#[derive(Debug, thiserror::Error)]
pub enum LessonError {
    /// The file is not JSON, or not a lesson by the table of keys.
    #[error("{name}.json: {source}: compare its keys with those of the module `lessons`")]
    File {
        /// The lesson.
        name: String,
        /// What the reader says, with line and column.
        source: serde_json::Error,
    },
    /// It has too few or too many steps.
    #[error("{name}.json: steps: there are {count}: write 3 to 6")]
    Steps {
        /// The lesson.
        name: String,
        /// Its steps.
        count: usize,
    },
    /// The gallery has no such scene.
    #[error("{name}.json: steps[{step}].scene: the gallery has no `{scene}`: `wobble scenes` lists them")]
    NoScene {
        /// The lesson.
        name: String,
        /// The step, from 0.
        step: usize,
        /// What it asks for.
        scene: String,
    },
    /// The scene that a step opens is out of order.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The scene that is measured leaves the finite numbers.
    #[error(transparent)]
    Motion(#[from] RecordError),
    /// What is to be measured is not there.
    #[error("the scene has no point {point}: it has {count}")]
    NoPoint {
        /// The point asked for.
        point: usize,
        /// How many there are.
        count: usize,
    },
    /// Half of a substep that the scene does not have.
    #[error("the order of a method shows with its substep: give the scene \"method\": {{\"substep\": …}}")]
    NoSubstep,
}

/// A lesson.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lesson {
    /// What it is called by: its file without the ending.
    #[serde(skip)]
    pub name: String,
    /// A few words for a list.
    pub title: String,
    /// One sentence on what it is about.
    pub about: String,
    /// Where it can be read up.
    pub source: String,
    /// 3 to 6 of them.
    pub steps: Vec<Step>,
}

/// A step of a lesson.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// A few words.
    pub heading: String,
    /// Two or three sentences.
    pub text: String,
    /// What stands apart, in Unicode.
    pub formula: Option<String>,
    /// The scene of the gallery that it opens.
    pub scene: String,
    /// What that scene has differently: a merge patch of its file.
    pub patch: Option<Value>,
    /// What to do.
    #[serde(rename = "try")]
    pub to_try: String,
    /// What is seen.
    #[serde(rename = "see")]
    pub seen: String,
    /// What is plotted.
    pub plot: Option<Plot>,
    /// How bodies are shown, where not as such.
    pub show: Option<Show>,
    /// Numbers in its words that can be measured.
    #[serde(default)]
    pub claims: Vec<Claim>,
}

/// What the plots show beside a step.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(tag = "of", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Plot {
    /// The energies of the world over time.
    Energies,
    /// The largest strain of a bond over time.
    Strain,
    /// A quantity of one or two points over time.
    Probes {
        /// The points.
        points: Vec<u32>,
        /// What of them.
        quantity: Quantity,
    },
    /// A quantity of one or two bonds over time.
    Bonds {
        /// The bonds, by their numbers.
        bonds: Vec<u32>,
        /// What of them.
        quantity: Quantity,
    },
    /// The angle at the second of three points over time, from the first to the third, in the plane.
    Angle {
        /// The points.
        points: [u32; 3],
    },
    /// A quantity of two points against each other.
    Phase {
        /// The points.
        points: [u32; 2],
        /// What of them.
        quantity: Quantity,
    },
}

/// What is plotted of a point, or of a bond.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// Its first coordinate `[m]`.
    X,
    /// Its second coordinate `[m]`.
    Y,
    /// The length of its velocity `[m/s]`.
    Speed,
    /// Of a bond: length/rest - 1 `[%]`.
    Strain,
    /// Of a bond: the force by which it pulls its ends together `[N]`, where that is known.
    Force,
    /// Of a bond: its length `[m]`.
    Length,
    /// Of a bond: how it is turned `[degrees]`.
    Angle,
    /// Of a point: how far it is from where the first world beside has it `[m]`.
    Error,
    /// Of two: how far apart they are `[m]`.
    Distance,
    /// Of two bonds: the angle from the first to the second `[degrees]`.
    Between,
}

/// How bodies are shown beside a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Show {
    /// By their strain.
    Strain,
    /// As points and bonds.
    Bonds,
}

/// A lesson that the program carries with it.
macro_rules! own {
    ($($name:literal),*) => {
        [$(($name, include_str!(concat!("../../assets/lessons/", $name, ".json")))),*]
    };
}

/// The files, in the order of a list, by their names: what is seen at once first, what is measured later.
static FILES: [(&str, &str); 8] =
    own!["constraints", "verlet", "pictures", "boxes", "cloth", "euler", "orders", "stability"];

/// All lessons, in the order of a list: those that are in order, as all of them are, which a test holds.
pub fn lessons() -> &'static [Lesson] {
    static LESSONS: LazyLock<Vec<Lesson>> =
        LazyLock::new(|| FILES.iter().filter_map(|(name, text)| Lesson::parse(name, text).ok()).collect());
    &LESSONS
}

/// The names of all lessons with the text of their files.
pub fn files() -> &'static [(&'static str, &'static str)] {
    &FILES
}

impl Lesson {
    /// The lesson of a file's text, by the file's name without the ending.
    ///
    /// Errors: the text is no JSON or has other keys; fewer than 3 steps or more than 6.
    pub fn parse(name: &str, text: &str) -> Result<Lesson, LessonError> {
        let read: Result<Lesson, _> = serde_json::from_str(text);
        let lesson = read.map_err(|source| LessonError::File { name: name.to_owned(), source })?;
        let count = lesson.steps.len();
        if !(STEPS[0]..=STEPS[1]).contains(&count) {
            return Err(LessonError::Steps { name: name.to_owned(), count });
        }
        Ok(Lesson { name: name.to_owned(), ..lesson })
    }

    /// The scene that a step opens, by the step's number from 0; `None`: there is no such step.
    ///
    /// Errors: the gallery has no such scene; with its patch it is out of order.
    pub fn scene(&self, step: usize) -> Option<Result<Scene, LessonError>> {
        self.steps.get(step).map(|opened| opened.scene(&self.name, step))
    }
}

/// What the scene of a step is called that is changed for it.
fn own_name(lesson: &str, step: usize) -> String {
    format!("{lesson}-{}", step + 1)
}

/// The heading of the step whose own scene is called so.
pub fn heading_of(scene: &str) -> Option<&'static str> {
    let (lesson, number) = scene.rsplit_once('-')?;
    let place = number.parse::<usize>().ok()?.checked_sub(1)?;
    let step = lessons().iter().find(|other| other.name == lesson)?.steps.get(place)?;
    (step.patch.is_some() && own_name(lesson, place) == scene).then_some(&step.heading)
}

impl Step {
    fn scene(&self, name: &str, step: usize) -> Result<Scene, LessonError> {
        let entry = gallery().iter().find(|entry| entry.name == self.scene).ok_or_else(|| LessonError::NoScene {
            name: name.to_owned(),
            step,
            scene: self.scene.clone(),
        })?;
        let Some(patch) = &self.patch else { return Ok(entry.scene()?) };
        let file = |source| LessonError::File { name: name.to_owned(), source };
        let mut keys: Value = serde_json::from_str(entry.json).map_err(file)?;
        patch::merge(&mut keys, patch);
        let own = own_name(name, step);
        patch::merge(&mut keys, &serde_json::json!({ "name": own }));
        Ok(Scene::parse(&keys.to_string(), &format!("{own}.json"))?)
    }
}

#[cfg(test)]
mod tests {
    use super::{heading_of, lessons};

    #[test]
    fn every_scene_that_a_step_changed_is_called_by_the_heading_of_that_step_and_no_other_is() {
        for lesson in lessons() {
            for (place, step) in lesson.steps.iter().enumerate() {
                let scene = lesson.scene(place).and_then(Result::ok);
                let heading = scene.and_then(|scene| heading_of(scene.name()));
                assert_eq!(heading, step.patch.is_some().then_some(&*step.heading), "{} {place}", lesson.name);
            }
        }
        for other in ["ring", "pictures-0", "pictures-99", "pictures-06", "nothing-1", "-1"] {
            assert_eq!(heading_of(other), None, "{other}");
        }
    }
}
