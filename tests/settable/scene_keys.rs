//! Each key of scene files is set somewhere in the window, or a page says that it is of the file alone: a key that is new has to be told of here.

use std::collections::BTreeSet;

use serde_json::Value;
use wobble::history::SetKeys;

/// Where a key is set.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Where {
    /// By a command of its own name, whose control the tests beside this use.
    Set,
    /// By a control of the settings.
    Settings,
    /// In the panel of what is selected.
    Selected,
    /// By what a tool builds, draws, moves or turns.
    Tool,
    /// Where a picture or a drawing is cut out.
    Import,
    /// In the panel of worlds beside each other.
    Beside,
    /// As what is saved is looked at and called.
    Saved,
    /// By the file alone: the section of `docs/limitations.md` names it.
    File,
}

use Where::{Beside, File, Import, Saved, Selected, Set, Settings, Tool};

/// A kind of object of scene files, and what it has.
type Kind = (&'static str, &'static [(Where, &'static [&'static str])]);

/// All of them, in the order of their names.
const KINDS: [Kind; 30] = [
    ("AngleKeys", &[(Tool, &["points"]), (Selected, &["rest", "stiffness", "damping", "min", "max", "drive"])]),
    ("AreaKeys", &[(Settings, &["kind", "least", "stiffness"])]),
    ("BesideKeys", &[(Beside, &["method"]), (File, &["title", "bonds", "gravity", "drag_rate", "wind", "bounds"])]),
    (
        "BodyKeys",
        &[
            (
                Tool,
                &[
                    "make",
                    "count",
                    "radius",
                    "inner_radius",
                    "sectors",
                    "width",
                    "height",
                    "spacing",
                    "to",
                    "slack",
                    "columns",
                    "rows",
                    "u",
                    "v",
                    "origin",
                    "angle",
                    "material",
                    "pinned",
                    "seed",
                ],
            ),
            (Selected, &["velocity"]),
            (
                Import,
                &[
                    "file",
                    "threshold",
                    "invert",
                    "whole",
                    "min_area",
                    "blur",
                    "grading",
                    "holes",
                    "strokes",
                    "pattern",
                    "part",
                ],
            ),
            (File, &["bonds", "min", "max", "bracing", "supports", "diagonals", "max_area", "spin", "repeat"]),
        ],
    ),
    (
        "BondKeys",
        &[
            (Tool, &["a", "b"]),
            (
                Set,
                &[
                    "kind",
                    "rest",
                    "stiffness",
                    "compliance",
                    "damping",
                    "relaxation",
                    "max_correction",
                    "break_strain",
                    "limit",
                    "drive",
                ],
            ),
            (File, &["axial_stiffness"]),
        ],
    ),
    ("BoundsKeys", &[(Settings, &["min", "max", "restitution", "friction"])]),
    ("BoxKeys", &[(Tool, &["min", "max", "angle", "rotation"])]),
    ("CircleKeys", &[(Tool, &["center", "radius"])]),
    ("ContactKeys", &[(Settings, &["friction", "restitution", "radius", "self", "bodies"])]),
    (
        "DriveKeys",
        &[
            (Selected, &["amplitude", "speed", "torque", "period", "phase", "key", "back", "rate"]),
            (File, &["frequency"]),
        ],
    ),
    ("ForceKeys", &[(Tool, &["points", "force", "torque"])]),
    ("LabelKeys", &[(Settings, &["at", "text", "point"])]),
    (
        "Material",
        &[
            (
                Selected,
                &[
                    "kind",
                    "stiffness",
                    "damping",
                    "relaxation",
                    "max_correction",
                    "break_strain",
                    "bending",
                    "mass",
                    "friction",
                    "restitution",
                    "radius",
                    "layered",
                    "color",
                    "width",
                    "visible",
                ],
            ),
            (Import, &["young"]),
            (File, &["compliance", "point_mass"]),
        ],
    ),
    (
        "MethodKeys",
        &[
            (
                Settings,
                &[
                    "solver",
                    "substep",
                    "iterations",
                    "order",
                    "seed",
                    "max_strain",
                    "budget",
                    "sleep",
                    "settle",
                    "precision",
                    "tolerance",
                ],
            ),
            (File, &["source", "ledger"]),
        ],
    ),
    ("MouseKeys", &[(Settings, &["strength", "radius", "region", "profile"]), (File, &["track"])]),
    (
        "ObstacleKeys",
        &[
            (Tool, &["plane", "box", "circle", "polygon"]),
            (Import, &["picture"]),
            (Set, &["restitution", "friction", "penalty"]),
        ],
    ),
    ("ParameterKeys", &[(File, &["path", "min", "max", "label", "unit"])]),
    ("PenaltyKeys", &[(Selected, &["stiffness", "damping"])]),
    (
        "PictureKeys",
        &[
            (Tool, &["origin", "angle"]),
            (Import, &["file", "height", "spacing", "threshold", "invert", "whole", "min_area", "blur", "holes"]),
        ],
    ),
    ("PinMotionKeys", &[(Selected, &["point", "track"])]),
    ("PlaneKeys", &[(Tool, &["point", "normal"])]),
    ("PointGroupKeys", &[(Tool, &["points"]), (File, &["title"])]),
    ("PointKeys", &[(Tool, &["position", "pinned"]), (Set, &["velocity", "mass"])]),
    ("RepeatKeys", &[(File, &["count", "step"])]),
    ("RotationKeys", &[(Tool, &["axis", "angle"])]),
    (
        "Scene",
        &[
            (
                Set,
                &["areas", "contact", "gravity", "drag_rate", "wind", "bounds", "rate", "duration", "labels", "method"],
            ),
            (Settings, &["mouse"]),
            (Selected, &["skins", "pin_motion", "texture"]),
            (Tool, &["points", "bonds", "bodies", "triangles", "angles", "groups", "forces", "obstacles"]),
            (Beside, &["beside"]),
            (Saved, &["name", "view"]),
            (File, &["wobble", "tags", "dimensions", "parameters", "cursor_pin", "click_start", "samples"]),
        ],
    ),
    (
        "SkinKeys",
        &[
            (Selected, &["points", "color", "width", "visible"]),
            (Set, &["friction", "restitution", "radius", "layered"]),
        ],
    ),
    ("TextureKeys", &[(Selected, &["image"]), (File, &["uv"])]),
    ("ViewKeys", &[(Saved, &["center", "height", "target", "distance", "yaw", "pitch"]), (File, &["width", "follow"])]),
    ("WindKeys", &[(Settings, &["velocity", "turbulence", "seed"])]),
];

/// The keys of an object of a schema, ascending; none of what is no object.
fn keys(schema: &Value) -> Option<BTreeSet<String>> {
    Some(schema["properties"].as_object()?.keys().cloned().collect())
}

#[test]
fn every_key_of_scene_files_is_set_somewhere_or_told_of() {
    let schema = wobble::scene::schema();
    let kinds = schema["$defs"].as_object().unwrap().iter().map(|(name, kind)| (name.as_str(), kind));
    let all = kinds.chain([("Scene", &schema)]).filter_map(|(name, kind)| Some((name, keys(kind)?)));
    let (mut missed, mut known) = (Vec::new(), BTreeSet::new());
    for (name, keys) in all {
        known.insert(name);
        let told = KINDS.iter().filter(|(kind, _)| *kind == name).flat_map(|(_, told)| *told);
        let told: Vec<String> = told.flat_map(|(_, keys)| *keys).map(|key| (*key).to_owned()).collect();
        let once: BTreeSet<String> = told.iter().cloned().collect();
        if once != keys || once.len() != told.len() {
            let new: Vec<&String> = keys.symmetric_difference(&once).collect();
            missed.push(format!("{name}: {new:?} of {told:?}"));
        }
    }
    assert_eq!(missed, [""; 0], "each key is told of once, and none that is not there");
    assert_eq!(known, KINDS.iter().map(|(name, _)| *name).collect());
}

#[test]
fn what_commands_set_and_what_the_file_alone_has_is_as_it_is_told() {
    let set = schemars::schema_for!(SetKeys).to_value();
    let set = keys(&set).unwrap();
    let page = include_str!("../../docs/limitations.md");
    let section = page.split("## Keys of the file alone").nth(1).unwrap().split("\n## ").next().unwrap();
    let mut wrong = Vec::new();
    for (kind, told) in KINDS {
        for (place, keys) in told {
            for key in *keys {
                match place {
                    Set if !set.contains(*key) => wrong.push(format!("{kind}: no command sets {key}")),
                    File if !section.contains(&format!("`{key}`")) => {
                        wrong.push(format!("{kind}: the page does not tell of {key}"));
                    }
                    _ => {}
                }
            }
        }
    }
    assert_eq!(wrong, [""; 0]);
}
