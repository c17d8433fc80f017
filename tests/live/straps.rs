//! Pins that are led further apart than the rigid bonds between them reach: these are stretched alike, throw nothing, and are as they were
//! when the pins come back.

use serde_json::{Value, json};

use super::world;

/// How far apart the pins of what is 2 m long are led: there within a second, held for another, and back [m].
fn away(to: f64) -> Value {
    json!([[0, 1, 0], [1, to - 1.0, 0], [2, to - 1.0, 0], [3, 1, 0]])
}

fn rope(solver: &str, at: f64) -> Value {
    json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "method": {"solver": solver},
        "bodies": [{"make": "rope", "count": 15, "to": [2, 0], "slack": 0.1, "origin": [-1, 0], "pinned": [0, 14]}],
        "pin_motion": [{"point": 14, "track": away(at)}]})
}

/// The largest speed until `t` [m/s] of what is not led, and the largest strain then [1].
fn until(world: &mut dyn wobble::sim::Dynamics, t: f64) -> [f64; 2] {
    let mut fastest: f64 = 0.0;
    while world.time() < t - 1e-9 {
        world.step();
        let sample = world.sample(world.time());
        fastest = sample.velocity.iter().map(|v| v[0].hypot(v[1]).hypot(v[2])).fold(fastest, f64::max);
    }
    [fastest, world.sample(world.time()).max_strain]
}

#[test]
fn a_rope_between_pins_that_are_led_too_far_apart_is_straight_and_stretched_alike() {
    // What gets taut between pins that go on is the faster the straighter it is, without bound by its own method: it goes live before.
    for (solver, most) in [("live", 40.0), ("auto", 60.0)] {
        for over in [1.02, 1.1, 1.5] {
            let mut world = world(&rope(solver, 2.2 * over));
            let [fastest, strain] = until(&mut *world, 2.0);
            assert!(fastest < most, "{solver}, {over}: {fastest} m/s");
            assert!((strain - (over - 1.0)).abs() < 0.01, "{solver}, {over}: {strain}");
            let sag = world.sample(2.0).position.iter().map(|x| x[1].abs()).fold(0.0, f64::max);
            assert!(sag < 0.02, "{solver}, {over}: it hangs {sag} m lower");
            let [fastest, strain] = until(&mut *world, 6.0);
            assert!(fastest < most && strain < 1e-3, "{solver}, {over}: back at {fastest} m/s, strain {strain}");
        }
    }
}

#[test]
fn so_is_one_in_space() {
    for solver in ["live", "auto"] {
        let mut scene = rope(solver, 3.0);
        scene["dimensions"] = json!(3);
        scene["gravity"] = json!([0, -9.81, 0]);
        let lift = |list: &mut Value| list.as_array_mut().unwrap().push(json!(0));
        lift(&mut scene["bodies"][0]["to"]);
        lift(&mut scene["bodies"][0]["origin"]);
        scene["pin_motion"][0]["track"].as_array_mut().unwrap().iter_mut().for_each(lift);
        let mut world = world(&scene);
        let [fastest, strain] = until(&mut *world, 2.0);
        assert!(
            fastest < 40.0 && (strain - (3.0 / 2.2 - 1.0)).abs() < 0.01,
            "{solver}: {fastest} m/s, strain {strain}"
        );
        let [fastest, strain] = until(&mut *world, 6.0);
        assert!(fastest < 40.0 && strain < 1e-3, "{solver}: back at {fastest} m/s, strain {strain}");
    }
}

#[test]
fn a_net_between_corners_that_are_led_too_far_apart_throws_nothing() {
    let mut world = world(&json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "method": {"solver": "live"},
        "bodies": [{"make": "cloth", "columns": 11, "rows": 6, "spacing": 0.2, "origin": [-1, 0], "diagonals": "none",
            "pinned": [0, 10]}],
        "pin_motion": [{"point": 10, "track": away(2.5)}]}));
    let [fastest, strain] = until(&mut *world, 2.0);
    assert!(fastest < 40.0 && (0.2..0.4).contains(&strain), "{fastest} m/s, strain {strain}");
    // It has crumpled, and hangs from a row as long as the pins are apart.
    let [fastest, strain] = until(&mut *world, 5.0);
    assert!(fastest < 40.0 && strain < 0.15, "back at {fastest} m/s, strain {strain}");
}

/// A ragdoll that meets itself, between two of its points; the second is led away from the first by `way` `[m]` and back.
fn ragdoll(pins: [usize; 2], way: f64) -> Value {
    let mut scene = json!({"wobble": 1, "gravity": [0, -9.81], "bounds": {"min": [-6, -5], "max": [8, 6]}, "contact": true,
        "bodies": [{"make": "ragdoll", "material": {"mass": 70, "layered": false}, "pinned": pins}]});
    let [first, second] = pins.map(|pin| world(&scene).sample(0.0).position[pin]);
    let d = [second[0] - first[0], second[1] - first[1]];
    let scale = way / d[0].hypot(d[1]);
    let far = [second[0] + scale * d[0], second[1] + scale * d[1]];
    let knot = |t: f64, x: [f64; 2]| json!([t, x[0], x[1]]);
    let near = [second[0], second[1]];
    scene["pin_motion"] =
        json!([{"point": pins[1], "track": [knot(0.0, near), knot(1.0, far), knot(2.0, far), knot(3.0, near)]}]);
    scene
}

#[test]
fn a_ragdoll_that_is_pulled_apart_is_not_thrown_and_is_whole_again_when_it_is_let_go() {
    // By its head and a foot, and by a hand and a foot.
    for pins in [[8, 35], [34, 21]] {
        for way in [1.0, 3.0] {
            let mut world = world(&ragdoll(pins, way));
            let [fastest, strain] = until(&mut *world, 2.0);
            assert!(fastest < 30.0 && strain > 0.03, "{pins:?}, {way} m: {fastest} m/s, strain {strain}");
            let [fastest, _] = until(&mut *world, 4.0);
            let [after, strain] = until(&mut *world, 6.0);
            assert!(fastest.max(after) < 30.0, "{pins:?}, {way} m: back at {fastest}, {after} m/s");
            assert!(strain < 0.1, "{pins:?}, {way} m: strain {strain} at last");
        }
    }
}
