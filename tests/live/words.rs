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
fn the_velocity_of_a_pinned_point_is_not_dropped_in_silence() {
    let warnings = |pinned: &[u32], body: serde_json::Value| {
        let scene = json!({"wobble": 1, "bodies": body, "points": {"position": [[5, 0], [6, 0], [7, 0]],
            "velocity": [[1, 0], [0, 2], [0, 0]], "pinned": pinned}});
        world(&scene).warnings().to_vec()
    };
    let told = "is pinned: the velocity at the start is left out: unpin, or lead by `pin_motion`";
    assert_eq!(warnings(&[1, 2], json!([])), [format!("a point {told} (point 1)")]);
    assert!(warnings(&[2], json!([])).is_empty());
    let rope =
        |pinned: &[u32]| json!([{"make": "rope", "count": 3, "to": [0, -1], "velocity": [1, 0], "pinned": pinned}]);
    assert!(warnings(&[2], rope(&[0])).is_empty(), "what hangs is thrown without its pin");
    let many = format!("points {} (points 3, 4 and 5)", told.replacen("is", "are", 1));
    assert_eq!(warnings(&[2], rope(&[0, 1, 2]))[0], many);
}

#[test]
fn a_torque_on_one_place_is_told() {
    let warnings = |second: [f64; 2], pinned: &[u32]| {
        let scene = json!({"wobble": 1, "points": {"position": [[0, 1], second], "pinned": pinned},
            "forces": [{"points": [0, 1], "force": [1, 0]}, {"points": [0, 1], "torque": 3}]});
        world(&scene).warnings().to_vec()
    };
    let told =
        "a torque turns nothing: of its points those that are free lie in one place: give two that are apart (force 1)";
    assert_eq!(warnings([0.0, 1.0], &[]), [told]);
    assert_eq!(warnings([1.0, 1.0], &[1]), [told]);
    assert!(warnings([1.0, 1.0], &[]).is_empty());
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
    assert!(warnings([json!([]), json!([]), json!([{"make": "ragdoll"}]), json!(true)]).is_empty(), "limbs are layers");
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

#[test]
fn what_skins_cannot_be_made_of_is_told() {
    let warnings = |contact: serde_json::Value, material: serde_json::Value| {
        let mut body = disc([0.0; 2], [0.0; 2]);
        body["material"].as_object_mut().unwrap().extend(material.as_object().unwrap().clone());
        world(&json!({"wobble": 1, "contact": contact, "bodies": [body]})).warnings().to_vec()
    };
    let told = ["friction 1000000000 is taken as 30: it holds on a slope of 88 degrees"];
    assert_eq!(warnings(json!({"friction": 1e9}), json!({})), told);
    assert_eq!(warnings(json!(true), json!({"friction": 1e9})), told);
    assert!(warnings(json!(true), json!({"friction": 30})).is_empty());
}

#[test]
fn bodies_in_one_place_are_told_however_they_came_there() {
    let told = |bodies: serde_json::Value, obstacles: serde_json::Value| {
        let scene = json!({"wobble": 1, "contact": true, "bodies": bodies, "obstacles": obstacles});
        world(&scene).warnings().iter().any(|word| word == "2 bodies start in each other: they are parted, slowly")
    };
    // No corner of one is within the other.
    assert!(told(json!([disc([0.0; 2], [0.0; 2]), disc([0.0; 2], [0.0; 2])]), json!([])));
    // Side by side they are not.
    let square = |x: f64| json!({"make": "lattice", "columns": 2, "rows": 2, "spacing": 1, "origin": [x, 0], "material": {"kind": "spring", "stiffness": 100, "mass": 1}});
    assert!(!told(json!([square(0.0), square(1.0)]), json!([])));
    // One is moved out of a floor into the other.
    let floor = json!([{"plane": {"point": [0, -0.5], "normal": [0, 1]}}]);
    let apart = json!([square(0.0), {"make": "lattice", "columns": 2, "rows": 2, "spacing": 1, "origin": [0.2, -1.2], "material": {"kind": "spring", "stiffness": 100, "mass": 1}}]);
    assert!(!told(apart.clone(), json!([])) && told(apart, floor));
}

#[test]
fn triangles_without_an_inside_are_told() {
    let warnings = |contact: bool| {
        let scene = json!({"wobble": 1, "contact": contact, "points": {"position": [[0, 0], [1, 0], [2, 0]]},
            "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 0, "b": 2}], "triangles": [[0, 1, 2]]});
        world(&scene).warnings().to_vec()
    };
    assert_eq!(warnings(true), ["a triangle of area 0 at the start: not kept open (triangle 0)"]);
    assert!(warnings(false).is_empty());
}

#[test]
fn cloths_in_the_same_places_are_told() {
    let cloth = |y: f64| json!({"make": "cloth", "columns": 3, "rows": 3, "spacing": 0.1, "u": [1, 0, 0], "v": [0, 0, 1], "origin": [0, y, 0]});
    let warnings = |apart: f64| {
        world(&json!({"wobble": 1, "dimensions": 3, "contact": true, "bodies": [cloth(0.0), cloth(apart)]}))
            .warnings()
            .join("\n")
    };
    assert_eq!(warnings(0.0), "2 bodies start in the same places: move them apart");
    assert_eq!(warnings(0.1), "");
}

#[test]
fn a_scene_far_from_the_origin_says_how_far_its_places_are_rounded() {
    let words = |precision: &str, far: f64| {
        let rope = json!({"make": "rope", "count": 3, "spacing": 0.5, "origin": [far, 0], "pinned": [0]});
        let method = json!({"precision": precision});
        let scene = json!({"wobble": 1, "gravity": [0, -9.81], "method": method, "bodies": [rope]});
        world(&scene).warnings().to_vec()
    };
    // 24 bits of 100 km are 1.2e-2 m.
    assert!(
        words("f32", 1e5)[0].contains("rounded to 1.2e-2 m, 2.38 % of the shortest bond"),
        "{:?}",
        words("f32", 1e5)
    );
    assert!(words("f32", 10.0).is_empty() && words("f64", 1e5).is_empty());
}
