//! Warnings of worlds as a window says them.

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
}
