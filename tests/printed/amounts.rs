//! What the page says of relaxed bodies beside springs, and of a cloth that swings at three frame rates.

use super::{is_near, of_gallery};
use crate::common::physics::run_to;
use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::study::softness;

/// A scene of these keys.
fn scene(keys: &Value) -> Scene {
    Scene::parse(&keys.to_string(), "amounts.json").unwrap()
}

#[test]
fn a_relaxed_chain_hangs_a_little_deeper_than_springs_of_the_stiffness_of_one_of_its_bonds() {
    let mut world = of_gallery("relaxation", None);
    let start = world.sample(0.0);
    // Both chains have come to rest by then.
    let end = run_to(&mut *world, 100.0);
    let [relaxed, springs] = [8, 17].map(|last: usize| start.position[last][1] - end.position[last][1]);
    // Eight weights of 0.1 kg: the uppermost spring, of twice the stiffness for its pin, bears all of them.
    let by_formula = 0.1 * 9.81 * (8.0 / 303.2 + 28.0 / 151.6);
    is_near(springs / by_formula, 1.0, 2e-3);
    is_near(relaxed / springs, 1.026, 3e-3);
}

#[test]
fn a_relaxed_lattice_hangs_nearly_three_times_as_deep_as_springs_of_its_stiffness() {
    let lattice = |material: Value| {
        let pinned: Vec<u32> = (30..36).collect();
        json!({ "wobble": 1, "gravity": [0, -9.81], "drag_rate": 2, "method": { "substep": 1.0 / 240.0, "iterations": 1 },
            "bodies": [{ "make": "lattice", "columns": 6, "rows": 6, "spacing": 0.4, "pinned": pinned, "material": material }] })
    };
    let depth = |keys: &Value| {
        let mut world = scene(keys).world(None).unwrap();
        let start = world.sample(0.0);
        let end = run_to(&mut *world, 15.0);
        start.position.iter().zip(&end.position).map(|(from, to)| from[1] - to[1]).fold(0.0, f64::max)
    };
    let relaxed = lattice(json!({ "kind": "relaxed", "relaxation": 0.3, "point_mass": 0.1 }));
    let stiffness = softness(&scene(&relaxed)).unwrap().unwrap().stiffness;
    let springs = lattice(json!({ "kind": "spring", "stiffness": stiffness, "damping": 1, "point_mass": 0.1 }));
    is_near(depth(&relaxed) / depth(&springs), 2.72, 0.05);
}

#[test]
fn a_cloth_that_swings_is_the_same_at_any_frame_rate_but_as_printed() {
    let mut keys: Value =
        serde_json::from_str(&Scene::load("cloth-space-as-printed").unwrap().to_json().unwrap()).unwrap();
    keys["obstacles"] = json!([]);
    keys["beside"] = json!([]);
    // Its threads at their length, 30 degrees from straight down.
    let (sine, cosine) = 30_f64.to_radians().sin_cos();
    let rows = (0..11).map(|row| 2.0 * f64::from(row));
    let place = |down: f64| move |column: i32| json!([f64::from(2 * column - 10), -down * cosine, down * sine]);
    keys["points"]["position"] = rows.flat_map(|down| (0..11).map(place(down))).collect();
    // The lowest point after a second.
    let mut lowest = |method: Value, hertz: f64| {
        keys["method"] = method;
        keys["method"]["substep"] = json!(1.0 / hertz);
        let sample = run_to(&mut *scene(&keys).world(None).unwrap(), 1.0);
        sample.position.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min)
    };
    for (hertz, printed) in [(30.0, -18.90), (60.0, -18.36), (144.0, -18.27)] {
        is_near(lowest(json!({ "solver": "as-printed", "source": "004" }), hertz), printed, 0.02);
        // The error of its step alone, which goes with the square of it: 13 mm at 30 Hz.
        is_near(lowest(json!({}), hertz), -17.67, 0.02);
    }
}
