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
