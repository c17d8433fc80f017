//! The random battery: scenes from seeds, of all makers, bonds, surfaces, mice, led pins and commands.
//!
//! A case is its number alone: whatever else is run, the same number is the same scene. Families take turns, so that any stretch
//! of numbers has them all; in every other turn bodies meet.

mod acts;
mod around;
mod bodies;
mod dice;
mod more;

use serde_json::{Value, json};

use super::causes;
use super::subject::{Rest, Subject};
use crate::history::{HistoryError, Log, Recording};
use crate::scene::{PointKeys, Scene, Vector};
use crate::study::rest;

use dice::Dice;

/// What the first body of a case is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Loose points.
    Points,
    /// Points with random bonds.
    RandomGraph,
    /// Two rings with spokes.
    Rim,
    /// Braced boxes side by side.
    Box,
    /// Ropes, free, hung or between two pins.
    Rope,
    /// A rope whose end is many times heavier or lighter.
    HeavyEnd,
    /// A taut spine with teeth between two pins.
    Comb,
    /// A net without diagonals that hangs.
    Net,
    /// A cloth with diagonals.
    Cloth,
    /// A braced grid.
    Lattice,
    /// A meshed disc.
    Disc,
    /// A meshed picture.
    Picture,
    /// Several bodies of several kinds.
    Pile,
    /// What starts in its equilibrium and must stay there.
    Resting,
}

impl Family {
    /// All, in the order in which they take turns.
    pub const ALL: [Family; 14] = [
        Family::Points,
        Family::RandomGraph,
        Family::Rim,
        Family::Box,
        Family::Rope,
        Family::HeavyEnd,
        Family::Comb,
        Family::Net,
        Family::Cloth,
        Family::Lattice,
        Family::Disc,
        Family::Picture,
        Family::Pile,
        Family::Resting,
    ];

    /// Its name in calls and tables.
    pub fn name(self) -> &'static str {
        match self {
            Family::Points => "points",
            Family::RandomGraph => "random-graph",
            Family::Rim => "rim",
            Family::Box => "box",
            Family::Rope => "rope",
            Family::HeavyEnd => "heavy-end",
            Family::Comb => "comb",
            Family::Net => "net",
            Family::Cloth => "cloth",
            Family::Lattice => "lattice",
            Family::Disc => "disc",
            Family::Picture => "picture",
            Family::Pile => "pile",
            Family::Resting => "resting",
        }
    }

    /// The family of a case.
    pub fn of(case: u64) -> Family {
        Family::ALL[(case % Family::ALL.len() as u64) as usize]
    }
}

/// How long a case runs `[s]`.
pub(super) const SECONDS: f64 = 2.0;

/// The subject of a case; the same number is the same subject for ever in a version.
///
/// Errors: a scene that the program refuses, which a test excludes for the first few hundred.
pub fn subject(case: u64) -> Result<Subject, HistoryError> {
    let family = Family::of(case);
    let mut dice = Dice::new(case);
    let mut scene = json!({ "wobble": 1, "name": format!("case-{case}") });
    bodies::fill(family, &mut dice, &mut scene);
    around::fill(family, &mut dice, &mut scene);
    more::fill(family, &mut Dice::apart(case), &mut scene);
    if meets(case) {
        scene["contact"] = json!(true);
    }
    let commands = if family != Family::Resting && dice.chance(0.2) { acts::commands(&mut dice) } else { Vec::new() };
    let mut recording = recording(&scene, commands)?;
    let is_laid = family == Family::Resting && lay_down(&mut recording.scene);
    let rest = if is_laid { Rest::Stays } else { Rest::Free };
    let causes = causes::of(&recording);
    let (name, family) = (format!("case-{case}"), family.name().to_owned());
    Ok(Subject { name, family, case: Some(case), causes, recording, duration: SECONDS, rest, tolerance: None })
}

/// Whether bodies meet each other and themselves: in every other turn of the families.
fn meets(case: u64) -> bool {
    case / Family::ALL.len() as u64 % 2 == 1
}

/// A recording of a scene and commands, both as files have them.
pub(super) fn recording(scene: &Value, commands: Vec<Value>) -> Result<Recording, HistoryError> {
    let whole = json!({ "wobble_recording": 1, "scene": scene, "commands": commands });
    Log::of_text(&whole.to_string(), "a case")?.whole()?.recording()
}

/// Puts all points into the equilibrium that they roll down to, at rest; false where there is none.
pub(super) fn lay_down(scene: &mut Scene) -> bool {
    let Ok(found) = rest::settle(scene, 0.0) else { return false };
    let Ok(mut whole) = scene.expanded() else { return false };
    let dimensions = whole.dimensions();
    let Some(points) = whole.points.take().filter(|_| found.is_settled) else { return false };
    let position = found.sample.position.iter().map(|&x| Vector::new(x, dimensions)).collect();
    *scene = Scene { points: Some(PointKeys { position, velocity: None, ..points }), ..whole };
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_a_scene() {
        for case in 0..28 {
            let (one, other) = (subject(case).unwrap(), subject(case).unwrap());
            assert_eq!(one.recording, other.recording);
            assert_eq!((one.family.as_str(), one.case), (Family::of(case).name(), Some(case)));
        }
        assert_ne!(subject(4).unwrap().recording.scene.bodies, subject(18).unwrap().recording.scene.bodies);
    }

    #[test]
    fn every_case_is_taken() {
        for case in 0..280 {
            let subject = subject(case).unwrap_or_else(|error| panic!("case {case}: {error}"));
            let world = subject.recording.scene.world(None);
            let world = world.unwrap_or_else(|error| panic!("case {case}: {error}"));
            assert!(world.point_count() > 0, "case {case}");
        }
    }

    #[test]
    fn all_causes_come_up() {
        let subjects: Vec<Subject> = (0..560).map(|case| subject(case).unwrap()).collect();
        for cause in super::super::Cause::ALL {
            let count = subjects.iter().filter(|subject| subject.causes.contains(&cause)).count();
            assert!((5..500).contains(&count), "{cause:?} {count} times");
        }
        let resting = subjects.iter().filter(|subject| subject.rest == Rest::Stays).count();
        assert!(resting >= 20, "{resting} of 40 rest");
    }
}
