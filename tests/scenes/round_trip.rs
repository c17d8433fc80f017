//! Writing and reading again changes nothing.

use wobble::scene::{Scene, gallery};

/// Every key of the specification, in the plane; what this version cannot run too.
const PLANE: &str = r#"{ "wobble": 1, "name": "all \"keys\" é", "tags": ["a", "b"], "dimensions": 2,
  "points": { "position": [[0.1,-0.0],[1e-300,1.7976931348623157e308],[2,2]], "velocity": [[0,1],[2,3],[4,5]],
    "mass": [0.1,0.30000000000000004,3], "pinned": [2,0] },
  "bonds": [ { "a": 0, "b": 1 }, { "a": 1, "b": 0, "kind": "rigid", "rest": 0, "compliance": 0.1, "limit": "min" },
    { "a": 0, "b": 2, "kind": "spring", "stiffness": 10, "damping": 0.5, "break_strain": 2, "limit": "max" },
    { "a": 0, "b": 2, "kind": "relaxed", "relaxation": 0.5, "max_correction": 0.1, "limit": "both" } ],
  "bodies": [
    { "make": "points", "count": 2, "min": [0,0], "max": [1,1], "seed": 18446744073709551615 },
    { "make": "random-graph", "count": 4, "bonds": 3, "min": [0,0], "max": [1,1] },
    { "make": "rim", "radius": 3, "inner_radius": 2, "sectors": 5, "bracing": ["falling"], "origin": [1,1], "angle": 0.1,
      "velocity": [1,2], "spin": 3, "material": { "kind": "spring", "compliance": 0.1, "damping": 1, "mass": 4, "friction": 0.2, "restitution": 0.3, "radius": 0.01, "layered": true }, "pinned": [1] },
    { "make": "box", "width": 1, "height": 2, "supports": 0 }, { "make": "rope", "count": 3, "to": [1,1] },
    { "make": "cloth", "columns": 2, "rows": 2, "spacing": 1, "diagonals": "none" },
    { "make": "lattice", "columns": 2, "rows": 2, "spacing": 1, "material": { "point_mass": 2, "break_strain": 1 } } ],
  "triangles": [[0,1,2]], "skins": [ { "points": [0,1], "friction": 0.3, "restitution": 0.1, "radius": 0.02, "layered": false } ], "areas": { "kind": "spring", "stiffness": 3 },
  "contact": { "friction": 0.1, "restitution": 0.2, "radius": 0.01, "self": false, "bodies": true },
  "forces": [ { "points": [1,2], "force": [1,2], "torque": 3 } ],
  "gravity": [0,-9.81], "drag_rate": 0.1, "wind": { "velocity": [1,0], "turbulence": 0.1, "seed": 3 },
  "mouse": { "strength": 3, "radius": 1, "region": "square", "profile": "linear", "track": [[0,1,2],[1,2,3]] },
  "pin_motion": [ { "point": 0, "track": [[0,1,2],[1,2,3]] } ],
  "bounds": { "min": [-5,-5], "max": [5,5], "restitution": 0.1, "friction": 0.2 },
  "obstacles": [ { "plane": { "point": [0,0], "normal": [0,2] }, "restitution": 0.1, "friction": 0.2 },
    { "box": { "min": [0,0], "max": [1,1], "angle": 0.1 } }, { "circle": { "center": [0,0], "radius": 1 } },
    { "polygon": [[[0,0],[3,0],[0,3]], [[0.5,0.5],[1,0.5],[0.5,1]]] } ],
  "method": { "solver": "blanes-moan-4", "substep": 0.01, "iterations": 3, "order": "symmetric", "seed": 4,
    "precision": "f32", "tolerance": 0.001, "max_strain": 0.1 },
  "beside": [ { "title": "thick air", "drag_rate": 2, "wind": { "velocity": [0,0] }, "gravity": [1,0],
    "bounds": { "min": [-4,-4], "max": [4,4] }, "method": { "substep": 0.02 } } ],
  "rate": 2, "duration": 3, "samples": [0,1,1,3], "view": { "center": [0,0], "height": 10, "width": 4 },
  "labels": [ { "at": [1,2], "text": "here" }, { "at": [0,0.5], "text": "λ, \"there\"", "point": 2 } ] }"#;

/// What is different in space.
const SPACE: &str = r#"{ "wobble": 1, "dimensions": 3,
  "points": { "position": [[0,0,0],[1,2,3]], "mass": 2, "pinned": [0] },
  "bodies": [ { "make": "cloth", "columns": 2, "rows": 2, "spacing": 1, "u": [0,0,1], "v": [1,0,0], "diagonals": "both" } ],
  "texture": { "image": "a.png", "uv": [[0,0],[0,1],[1,0],[1,1],[0,0],[0,0]] },
  "pin_motion": [ { "point": 0, "track": [[0,1,2,3]] } ],
  "obstacles": [ { "box": { "min": [0,0,0], "max": [1,1,1], "rotation": { "axis": [0,1,0], "angle": 1 } } } ],
  "view": { "target": [0,0,0], "distance": 4, "yaw": 1, "pitch": -1 },
  "labels": [ { "at": [1,2,3], "text": "here", "point": 1 } ] }"#;

#[test]
fn every_key_survives() {
    let mut texts = vec![PLANE, SPACE, "{ \"wobble\": 1 }"];
    texts.extend(gallery().iter().map(|entry| entry.json));
    for text in texts {
        let scene = Scene::parse(text, "first").unwrap_or_else(|error| panic!("{error}"));
        let written = scene.to_json().unwrap();
        let again = Scene::parse(&written, "second").unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(again, scene);
        assert_eq!(again.to_json().unwrap(), written);
        let value = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
        assert_eq!(as_floats(value(&written)), as_floats(value(text)), "a key was lost");
    }
}

/// 1 and 1.0 are the same number of a scene; large whole numbers are seeds and stay.
fn as_floats(value: serde_json::Value) -> serde_json::Value {
    use serde_json::Value;
    match value {
        Value::Number(number) => match number.as_f64().filter(|x| x.abs() < 1e15) {
            Some(x) => (x + 0.0).into(),
            None => Value::Number(number),
        },
        Value::Array(list) => list.into_iter().map(as_floats).collect(),
        Value::Object(map) => map.into_iter().map(|(k, v)| (k, as_floats(v))).collect(),
        other => other,
    }
}

#[test]
fn written_scenes_have_a_bond_a_line_and_short_lists_in_place() {
    let text = "{\"wobble\":1,\"tags\":[\"a\",\"b\"],\"points\":{\"position\":[[0,0],[0.1,1]]},\"bonds\":[{\"a\":0,\"b\":1},{\"a\":1,\"b\":0}]}";
    let scene = Scene::parse(text, "x.json").unwrap();
    let expected = "{\n  \"wobble\": 1,\n  \"tags\": [\"a\",\"b\"],\n  \"points\": {\n    \"position\": [[0.0,0.0],[0.1,1.0]]\n  },\n  \"bonds\": [\n    { \"a\": 0, \"b\": 1 },\n    { \"a\": 1, \"b\": 0 }\n  ]\n}\n";
    assert_eq!(scene.to_json().unwrap(), expected);
}
