//! Layers of a body pass each other, and meet what is none.

use serde_json::{Value, json};
use wobble::sim::{Change, Command, Dynamics, PointId, SkinMaterial};

use super::world;

/// A string of four points whose ends fly at each other, by the live step; `skins`: what is said of its points.
fn closing(skins: &Value, contact: &Value) -> Box<dyn Dynamics> {
    world(&json!({"wobble": 1, "method": {"solver": "live"}, "contact": contact, "skins": skins,
        "points": {"position": [[0, 0], [1, 0], [1, 1], [0, 1]], "velocity": [[0, 2], [0, 0], [0, 0], [0, -2]], "mass": 1},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}]}))
}

fn ends(mut world: Box<dyn Dynamics>) -> Vec<[f64; 3]> {
    while world.time() < 0.8 {
        world.step();
    }
    world.sample(world.time()).position
}

#[test]
fn layers_of_a_body_pass_each_other() {
    let loose = ends(closing(&json!([]), &json!({"self": false})));
    let met = ends(closing(&json!([]), &json!(true)));
    let layered = |points: Value| json!([{"points": points, "layered": true}]);
    assert_eq!(ends(closing(&layered(json!([0, 1, 2, 3])), &json!(true))), loose);
    assert!(loose[0][1] > loose[3][1] && met[0][1] < met[3][1], "{loose:?}, {met:?}");
    assert_eq!(ends(closing(&layered(json!([0, 1])), &json!(true))), met, "what is none is met");
    let mut set = closing(&json!([]), &json!(true));
    let points = (0..4).map(PointId).collect();
    let skin = SkinMaterial { layered: Some(true), ..SkinMaterial::default() };
    set.apply(&Command::Set(Change::Points { points, mass: None, velocity: None, skin })).unwrap();
    assert_eq!(ends(set), loose, "by a command");
}
