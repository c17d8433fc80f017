//! Warnings and refusals of worlds as a window says them: not in the words of files.

use crate::history::Why;
use crate::sim::{CommandError, ModelError, Solver};

/// What numbers in brackets may be of.
const NUMBERED: [&str; 4] = ["point", "bond", "triangle", "angle"];

/// A warning without the numbers at its end, which nobody sees who plays: those are for whoever writes scenes.
pub(super) fn seen(warning: &str) -> &str {
    let numbers = |inside: &str| inside.ends_with(')') && NUMBERED.iter().any(|what| inside.starts_with(what));
    match warning.rsplit_once(" (") {
        Some((words, inside)) if numbers(inside) => words,
        _ => warning,
    }
}

/// Where another solver is chosen.
const CHOOSE: &str = "choose \"automatic\" as the solver in the settings (G)";

/// Why something cannot be done, in the words of who plays: what files call keys is named as the window does, and numbers that nobody sees
/// are left out.
pub(super) fn refused(why: &Why) -> String {
    match why {
        Why::World(CommandError::Model(error)) => unfit(error),
        _ => said(&why.to_string()),
    }
}

/// The same of what no world can be made of.
fn unfit(error: &ModelError) -> String {
    let instead = |others: &str| format!("choose {others} as the solver in the settings (G)");
    match error {
        ModelError::NotPrinted { what, .. } => {
            format!("this scene runs the loop of its source as it is printed, which has no {what}: {CHOOSE}")
        }
        ModelError::NoConvex { solver } => {
            format!("{} does not meet balls and boxes in space: {CHOOSE}", called(*solver))
        }
        ModelError::NoContact { solver } => format!("{} knows no contact: {CHOOSE}", called(*solver)),
        ModelError::NoForm { what, solver, others } => {
            format!("{} knows no {what}: {}", called(*solver), instead(others))
        }
        ModelError::Refused { kind, solver, others, .. } => {
            format!("a bond is {kind}, which {} refuses: {}", called(*solver), instead(others))
        }
        other => said(&other.to_string()),
    }
}

/// A solver, as one says it.
fn called(solver: Solver) -> String {
    match solver {
        Solver::AsPrinted(_) => "the loop of the source, as it is printed,".to_owned(),
        _ => format!("solver {solver}"),
    }
}

/// Words of a file without the path that they begin with there, numbers and code.
pub(super) fn said(words: &str) -> String {
    let words = match words.split_once(": ") {
        Some((path, rest)) if path.contains(['[', '.']) && !path.contains(' ') => rest,
        _ => words,
    };
    without_numbers(&words.replace('`', "\""))
}

/// "bond 12 is" becomes "a bond is".
fn without_numbers(words: &str) -> String {
    let mut said: Vec<&str> = Vec::new();
    for word in words.split(' ') {
        let is_number = !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_digit());
        match said.last() {
            Some(last) if is_number && NUMBERED.contains(last) => {
                let at = said.len() - 1;
                said.insert(at, if *last == "angle" { "an" } else { "a" });
            }
            _ => said.push(word),
        }
    }
    said.join(" ")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn no_number_of_a_point_or_a_bond_is_said() {
        let scenes = [
            r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0]], "pinned": [0, 1], "velocity": [[1, 0], [0, 0]]},
                "bonds": [{"a": 0, "b": 1, "rest": 1.5}]}"#,
            r#"{"wobble": 1, "contact": true, "points": {"position": [[0, 0], [1, 0], [2, 0]]},
                "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 0, "b": 2}], "triangles": [[0, 1, 2], [0, 1, 2]]}"#,
            r#"{"wobble": 1, "contact": true, "bounds": {"min": [-5, 0], "max": [5, 5]}, "bodies": [{"make": "lattice",
                "columns": 3, "rows": 3, "spacing": 0.5, "origin": [0, -0.3], "material": {"kind": "spring", "stiffness": 300, "mass": 4}}]}"#,
        ];
        let mut count = 0;
        for text in scenes {
            let world = Scene::parse(text, "x.json").unwrap().world(None).unwrap();
            assert!(!world.warnings().is_empty(), "{text}");
            for warning in world.warnings() {
                let said = seen(warning);
                let is_named = |what: &&str| {
                    said.split(what).skip(1).any(|rest| rest.starts_with(" 0") || rest.starts_with("s 0"))
                };
                assert!(!NUMBERED.iter().any(is_named), "{said}");
                count += usize::from(said != warning);
            }
        }
        assert!(count >= 4, "{count} have numbers");
        assert_eq!(seen("bodies pass through each other (as said)"), "bodies pass through each other (as said)");
    }

    #[test]
    fn what_is_refused_is_said_without_the_words_of_files() {
        use crate::app::player::{Note, Order, Stage};
        use crate::history::{Do, MoveKeys, SetKeys};
        use crate::scene::{AddKeys, BodyKeys, KindName, MakerName, Material, Meeting, gallery};
        let rk4 = ModelError::Refused { bond: 12, kind: "rigid", solver: Solver::Rk4, others: "verlet or path" };
        assert_eq!(
            refused(&Why::World(rk4.into())),
            "a bond is rigid, which solver rk4 refuses: choose verlet or path as the solver in the settings (G)"
        );
        let none = ModelError::NoContact { solver: Solver::Rk4 };
        assert_eq!(refused(&Why::World(none.into())), format!("solver rk4 knows no contact: {CHOOSE}"));
        assert_eq!(refused(&Why::Words("the pins are 3 m apart".to_owned())), "the pins are 3 m apart");
        assert_eq!(said("bodies[3].mass: `mass` is 0, and point 4 has none"), "\"mass\" is 0, and a point has none");
        // What tools ask for in the scenes of the sources as they are printed.
        let body = BodyKeys {
            make: MakerName::Disc,
            radius: Some(0.3),
            material: Some(Material::default()),
            ..BodyKeys::default()
        };
        let rigid = SetKeys { bonds: Some(vec![0]), kind: Some(KindName::Rigid), ..SetKeys::default() };
        let meets = SetKeys { contact: Some(Meeting::Is(true)), ..SetKeys::default() };
        let asked = [
            Do::Add(Box::new(AddKeys { bodies: vec![body], ..AddKeys::default() })),
            Do::Set(Box::new(rigid)),
            Do::Set(Box::new(meets)),
            Do::Move(Box::new(MoveKeys {
                points: vec![0],
                scale: Some(crate::history::Factors::One(2.0)),
                ..MoveKeys::default()
            })),
        ];
        let mut said = 0;
        for entry in gallery().iter().filter(|entry| entry.name.ends_with("as-printed")) {
            for act in &asked {
                let mut stage = Stage::new(entry.scene().unwrap().into()).unwrap();
                let words = match stage.obey(Order::Give(vec![act.clone()], Some("x"))) {
                    Some(Note::Refused(why) | Note::Added(Some(why))) => why,
                    _ => continue,
                };
                for file in ["`", "as-printed", "source 0", "leave", " use "] {
                    assert!(!words.contains(file), "{}: {words}", entry.name);
                }
                said += 1;
            }
        }
        assert!(said > 5, "{said} are refused");
    }
}
