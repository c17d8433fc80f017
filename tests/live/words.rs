//! What is said of skins that cannot be as they are asked for.

use serde_json::json;
use wobble::scene::Scene;

use super::{disc, world};

#[test]
fn a_radius_that_is_too_large_is_told() {
    let warnings = |radius: f64| {
        let scene = json!({"wobble": 1, "contact": {"radius": radius}, "bodies": [disc([0.0; 2], [0.0; 2]), disc([2.0, 0.0], [0.0; 2])]});
        world(&scene).warnings().to_vec()
    };
    assert_eq!(
        warnings(0.2),
        ["the radius of the skin of 2 bodies is more than half an edge: it is taken as half an edge"]
    );
    assert!(warnings(0.03).is_empty());
}

#[test]
fn skins_of_their_own_materials_are_refused_in_space() {
    let scene = json!({"wobble": 1, "dimensions": 3, "contact": true,
        "bodies": [{"make": "cloth", "columns": 3, "rows": 3, "spacing": 0.1, "material": {"friction": 0.9}}]});
    let said = match Scene::parse(&scene.to_string(), "x.json").and_then(|scene| scene.world(None).map(drop)) {
        Ok(()) => panic!("accepted"),
        Err(error) => error.to_string(),
    };
    assert!(said.contains("skins") && said.contains("of the plane"), "{said}");
}

#[test]
fn bodies_that_start_in_each_other_and_friction_that_cannot_be_are_told() {
    let warnings = |apart: f64, friction: f64, meet: bool| {
        let scene = json!({"wobble": 1, "contact": meet, "bounds": {"min": [-9, -9], "max": [9, 9], "friction": friction},
            "bodies": [disc([0.0; 2], [0.0; 2]), disc([apart, 0.1], [0.0; 2]), disc([5.0, 0.0], [0.0; 2])]});
        world(&scene).warnings().to_vec()
    };
    assert_eq!(warnings(0.2, 0.5, true), ["2 bodies start in each other: they are parted, slowly"]);
    assert_eq!(warnings(1.0, 1e9, true), ["friction 1000000000 is taken as 30: it holds on a slope of 88 degrees"]);
    assert!(warnings(0.2, 0.5, false).is_empty() && warnings(1.0, 30.0, true).is_empty());
}

#[test]
fn what_starts_across_itself_or_another_is_told() {
    let warnings = |[positions, bonds, bodies, contact]: [serde_json::Value; 4]| {
        let scene = json!({"wobble": 1, "contact": contact, "points": {"position": positions}, "bonds": bonds, "bodies": bodies});
        world(&scene).warnings().to_vec()
    };
    let knot = json!([[0, 0], [1, 0], [1, 1], [0.5, -0.5]]);
    let rope = json!([{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}]);
    let told = ["a body starts across itself: where that can be undone it is, slowly"];
    assert_eq!(warnings([knot.clone(), rope.clone(), json!([]), json!(true)]), told);
    assert!(warnings([knot, rope, json!([]), json!({"self": false})]).is_empty());
    let across =
        [json!([[0, 0], [1, 0], [0.5, 0.5], [0.5, -0.5]]), json!([{"a": 0, "b": 1}, {"a": 2, "b": 3}]), json!([])];
    let with = |contact: serde_json::Value| {
        let [positions, bonds, bodies] = across.clone();
        warnings([positions, bonds, bodies, contact])
    };
    assert_eq!(with(json!(true)), ["2 bodies start in each other: they are parted, slowly"]);
    assert!(with(json!({"bodies": false})).is_empty());
    // Both diagonals of a cell are no fold.
    let net = json!([{"make": "cloth", "columns": 3, "rows": 3, "spacing": 0.1, "diagonals": "both"}]);
    assert!(warnings([json!([]), json!([]), net, json!(true)]).is_empty());
}

#[test]
fn a_plate_that_is_led_as_it_is_holds() {
    let warnings = |turned: f64| {
        let track = |point: u32, [x, y]: [f64; 2]| {
            let end = if point == 2 { [x + turned, y - 1.0] } else { [x, y - 1.0] };
            json!({"point": point, "track": [[0, x, y], [2, end[0], end[1]], [3, end[0], end[1]]]})
        };
        let corners = [[0.0, 0.0], [0.1, 0.0], [0.2, 0.0], [0.0, 0.1], [0.1, 0.1], [0.2, 0.1]];
        let tracks: Vec<_> = (0..6).map(|k| track(k, corners[k as usize])).collect();
        let plate = json!({"make": "lattice", "columns": 3, "rows": 2, "spacing": 0.1, "origin": [0, 0],
            "material": {"kind": "rigid", "mass": 1}, "pinned": [0, 1, 2, 3, 4, 5]});
        world(&json!({"wobble": 1, "bodies": [plate], "pin_motion": tracks})).warnings().join("\n")
    };
    assert_eq!(warnings(0.0), "");
    assert!(warnings(0.05).contains("cannot hold: both ends are pinned"), "{}", warnings(0.05));
}
