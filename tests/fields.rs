//! Constant forces and torques, wind, and skins' own materials, against closed forms and finer runs.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

use serde_json::{Value, json};
use wobble::equilibrium::settle;
use wobble::scene::Scene;
use wobble::sim::{
    Addition, Change, Command, CommandError, Dynamics, Force, PointId, Sample, SceneChange, Selection, Wind, judge,
    resume,
};

fn world(scene: &Value) -> Box<dyn Dynamics> {
    Scene::parse(&scene.to_string(), "scene").unwrap().world(None).unwrap()
}

fn run_on(world: &mut dyn Dynamics, t: f64) -> Sample {
    while world.time() + world.substep() < t + 1e-9 {
        world.step();
    }
    world.sample(t)
}

/// The state of a scene at a time [s].
fn at(scene: &Value, t: f64) -> Sample {
    run_on(&mut *world(scene), t)
}

fn with(scene: &Value, key: &str, value: Value) -> Value {
    let mut scene = scene.clone();
    scene[key] = value;
    scene
}

fn method(solver: &str, substep: f64) -> Value {
    match solver {
        "auto" => json!({"solver": solver}),
        "relaxation" => json!({"solver": solver, "substep": substep, "iterations": 1}),
        _ => json!({"solver": solver, "substep": substep}),
    }
}

fn assert_near(found: f64, wanted: f64, most: f64, what: &str) {
    assert!((found - wanted).abs() <= most, "{what}: {found} for {wanted}, off by {:e}", found - wanted);
}

const EXACT: [&str; 9] =
    ["auto", "verlet", "velocity-verlet", "pefrl", "blanes-moan-4", "blanes-moan-6", "rk4", "rk8", "implicit-midpoint"];
const FIRST_ORDER: [&str; 6] = ["euler", "symplectic-euler", "backward-euler", "xpbd", "relaxation", "live"];

#[test]
fn a_force_is_shared_by_mass_and_pins_take_none() {
    let scene = json!({"wobble": 1, "gravity": [0, -1], "points": {"position": [[0, 0], [5, 0], [9, 9]], "mass": [1, 3, 2],
        "pinned": [2]}, "forces": [{"points": [0, 1, 2, 1], "force": [8, 4]}]});
    for (solvers, most) in [(&EXACT[..], 1e-11), (&FIRST_ORDER, 0.02)] {
        for solver in solvers {
            let sample = at(&with(&scene, "method", method(solver, 0.01)), 1.0);
            // 8 N and 4 N on 4 kg: 2 and 1 m/s^2, of which gravity takes the second.
            for (point, x) in [(0, 0.0), (1, 5.0)] {
                assert_near(sample.position[point][0], x + 1.0, most, solver);
                assert_near(sample.position[point][1], 0.0, most, solver);
                assert_near(sample.velocity[point][0], 2.0, most, solver);
            }
            assert_eq!(sample.position[2], [9.0, 9.0, 0.0], "{solver}");
        }
    }
}

#[test]
fn a_torque_turns_a_free_box_by_its_inertia() {
    let body = json!({"make": "box", "width": 2, "height": 1, "supports": 2, "material": {"point_mass": 0.5}});
    let scene = json!({"wobble": 1, "bodies": [body], "forces": [{"points": [0, 1, 2, 3], "torque": 0.4}]});
    // I = 4 m (1 + 1/4) = 2.5 kg m^2: 0.16 rad/s^2.
    let (alpha, t) = (0.16, 1.5);
    for (solver, most) in [("auto", 1e-5), ("rk8", 1e-9), ("verlet", 1e-4), ("implicit-midpoint", 1e-3), ("live", 2e-3)]
    {
        let sample = at(&with(&scene, "method", method(solver, 1.0 / 480.0)), t);
        let [x, y, _] = sample.position[0];
        let [vx, vy, _] = sample.velocity[0];
        let start = at(&scene, 0.0).position[0];
        let turned = (start[0] * y - start[1] * x).atan2(start[0] * x + start[1] * y);
        assert_near(turned, 0.5 * alpha * t * t, most, solver);
        assert_near((x * vy - y * vx) / (x * x + y * y), alpha * t, most, solver);
        let middle = sample.position.iter().fold([0.0; 2], |sum, x| [sum[0] + x[0], sum[1] + x[1]]);
        assert!(middle[0].abs() + middle[1].abs() < 1e-9, "{solver}: {middle:?}");
    }
}

#[test]
fn a_torque_on_two_bodies_turns_them_about_their_middle() {
    // Two loose points with no bond: their motion is known by a finer run of another method.
    let scene = json!({"wobble": 1, "points": {"position": [[-1, 0], [1, 0], [0, 3]], "mass": [1, 2, 1]},
        "forces": [{"points": [0, 1], "torque": 0.3}]});
    let fine = at(&with(&scene, "method", method("rk8", 0.01)), 2.0);
    for (solver, most) in [("auto", 1e-7), ("velocity-verlet", 1e-4), ("live", 2e-3)] {
        let sample = at(&with(&scene, "method", method(solver, 0.005)), 2.0);
        for k in 0..3 {
            (0..2).for_each(|axis| assert_near(sample.position[k][axis], fine.position[k][axis], most, solver));
        }
    }
}

#[test]
fn a_free_point_in_wind_has_the_closed_form() {
    let (rate, u, g, v0) = (0.7_f64, 5.0, -9.81, [1.0, 2.0]);
    let scene = json!({"wobble": 1, "gravity": [0, g], "drag_rate": rate, "wind": {"velocity": [u, 0.5]},
        "points": {"position": [[0, 0]], "velocity": [v0]}});
    let t = 2.0;
    let (keep, phi) = ((-rate * t).exp(), (1.0 - (-rate * t).exp()) / rate);
    let end = [u, 0.5 + g / rate];
    for solver in ["auto", "velocity-verlet", "symplectic-euler", "pefrl", "blanes-moan-4", "blanes-moan-6"] {
        let sample = at(&with(&scene, "method", method(solver, 0.01)), t);
        for k in 0..2 {
            let exact = end[k] * t + (v0[k] - end[k]) * phi;
            assert_near(sample.position[0][k], exact, 1e-12 * t / 0.01, solver);
            assert_near(sample.velocity[0][k], end[k] + (v0[k] - end[k]) * keep, 1e-12, solver);
        }
    }
    for (solver, most) in [("rk4", 1e-9), ("rk8", 1e-12), ("implicit-midpoint", 1e-4), ("live", 0.03)] {
        let sample = at(&with(&scene, "method", method(solver, 0.01)), t);
        assert_near(sample.position[0][1], end[1] * t + (v0[1] - end[1]) * phi, most, solver);
        assert_near(sample.velocity[0][0], u + (v0[0] - u) * keep, most, solver);
    }
}

#[test]
fn all_methods_end_at_the_speed_of_the_wind() {
    let cloth = json!({"make": "cloth", "columns": 4, "rows": 3, "spacing": 0.2, "material": {"kind": "spring", "stiffness": 50}});
    let scene = json!({"wobble": 1, "drag_rate": 4, "wind": {"velocity": [3, -1]}, "bodies": [cloth]});
    for solver in EXACT.into_iter().chain(["xpbd", "live"]) {
        let sample = at(&with(&scene, "method", method(solver, 1.0 / 480.0)), 6.0);
        for v in &sample.velocity {
            assert_near(v[0], 3.0, 0.02, solver);
            assert_near(v[1], -1.0, 0.02, solver);
        }
    }
}

fn gusty() -> Value {
    json!({"wobble": 1, "drag_rate": 2, "wind": {"velocity": [4, 1], "turbulence": 0.5, "seed": 3},
        "points": {"position": [[0, 0], [1, 0], [7, 2]], "velocity": [[0, 1], [0, 0], [-3, 0]]},
        "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 40}]})
}

#[test]
fn methods_have_their_order_in_gusts() {
    let fine = at(&with(&gusty(), "method", method("rk8", 1.0 / 256.0)), 1.0);
    let error = |solver: &str, h: f64| {
        let sample = at(&with(&gusty(), "method", method(solver, h)), 1.0);
        let off =
            |k: usize| (sample.position[k][0] - fine.position[k][0]).hypot(sample.position[k][1] - fine.position[k][1]);
        (0..3).map(off).fold(0.0, f64::max)
    };
    for (solver, order) in [
        ("symplectic-euler", 1.0),
        ("velocity-verlet", 2.0),
        ("implicit-midpoint", 2.0),
        ("rk4", 4.0),
        ("pefrl", 4.0),
        ("blanes-moan-6", 6.0),
    ] {
        let (coarse, fine) = (error(solver, 1.0 / 32.0), error(solver, 1.0 / 64.0));
        let found = (coarse / fine).log2();
        assert!(found > order - 0.4, "{solver}: order {found:.2}, errors {coarse:e} and {fine:e}");
    }
    assert!(error("auto", 0.0) < 1e-6, "auto: {:e}", error("auto", 0.0));
    assert!(error("live", 1.0 / 60.0) < 0.01, "live: {:e}", error("live", 1.0 / 60.0));
}

/// A large cloth that hangs by its upper edge.
fn hung(kind: Value) -> Value {
    let pinned: Vec<u32> = (0..30).collect();
    let cloth = json!({"make": "cloth", "columns": 30, "rows": 24, "spacing": 0.1, "pinned": pinned, "material": kind});
    json!({"wobble": 1, "bodies": [cloth]})
}

#[test]
fn large_bodies_feel_forces_as_they_feel_gravity() {
    for kind in
        [json!({"point_mass": 0.01}), json!({"kind": "spring", "stiffness": 200, "damping": 0.05, "point_mass": 0.01})]
    {
        let hung = hung(kind);
        let drops = with(&hung, "gravity", json!([2, -9.81]));
        // 690 points of 10 g that are free.
        let points: Vec<u32> = (0..720).collect();
        let pulled = with(&hung, "forces", json!([{"points": points, "force": [2.0 * 6.9, -9.81 * 6.9]}]));
        let blown = with(&with(&hung, "drag_rate", json!(0.1)), "gravity", json!([2, -9.81]));
        let wind = with(&with(&hung, "drag_rate", json!(0.1)), "wind", json!({"velocity": [20, -98.1]}));
        for (one, other, most) in [(&drops, &pulled, 2e-3), (&blown, &wind, 1e-9)] {
            let (one, other) = (at(one, 0.25), at(other, 0.25));
            for (a, b) in one.position.iter().zip(&other.position) {
                let off = (a[0] - b[0]).hypot(a[1] - b[1]);
                assert!(off < most, "{off} at {a:?}");
            }
        }
    }
}

#[test]
fn a_large_cloth_moves_in_gusts_as_it_does_by_a_fine_method() {
    let spring = json!({"kind": "spring", "stiffness": 30, "damping": 0.02, "point_mass": 0.01});
    let scene = with(&hung(spring), "gravity", json!([0, -9.81]));
    let scene = with(&scene, "drag_rate", json!(1.5));
    let scene = with(&scene, "wind", json!({"velocity": [6, 0], "turbulence": 0.6, "seed": 5}));
    let fine = at(&with(&scene, "method", method("rk4", 1.0 / 720.0)), 0.25);
    let calm = with(&scene, "wind", json!({"velocity": [6, 0]}));
    let scene = with(&scene, "method", json!({"solver": "velocity-verlet"}));
    let calm = with(&calm, "method", json!({"solver": "velocity-verlet"}));
    assert!(world(&scene).parts().iter().any(|part| !part.kernel.is_empty()), "it is moved as a large body");
    let off = |sample: &Sample| {
        let each = sample.position.iter().zip(&fine.position);
        each.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max)
    };
    let (own, without) = (off(&at(&scene, 0.25)), off(&at(&calm, 0.25)));
    assert!(own < 5e-3 && without > 5.0 * own, "off by {own}; without gusts {without}");
}

#[test]
fn the_ledger_has_the_work_of_forces_and_wind() {
    let base = json!({"wobble": 1, "gravity": [0, -2], "method": {"ledger": true},
        "points": {"position": [[0, 0], [1, 0]], "mass": [1, 2]},
        "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 30}]});
    let pushed = with(&base, "forces", json!([{"points": [0], "force": [3, 1]}, {"points": [0, 1], "torque": 0.5}]));
    let blown = with(&with(&base, "drag_rate", json!(1.0)), "wind", json!({"velocity": [5, 0], "turbulence": 0.4}));
    for (scene, is_wind) in [(pushed, false), (blown, true)] {
        for solver in ["auto", "live"] {
            let mut scene = scene.clone();
            scene["method"]["solver"] = json!(solver);
            let mut world = world(&scene);
            let mut entries = vec![world.sample(0.0).ledger.unwrap()];
            for frame in 1..=120 {
                entries.push(run_on(&mut *world, f64::from(frame) / 60.0).ledger.unwrap());
            }
            let (last, verdict) = (entries[120], judge(&entries));
            let work = if is_wind { last.book.wind } else { last.book.forces };
            if solver == "auto" {
                assert!(verdict.passes() && verdict.gain < 1e-4, "{verdict:?}");
                assert!(work > 1.0 && last.left_over().abs() < 1e-5 * work, "{last:?}");
            }
        }
    }
    // A constant force does the work of its way.
    let alone = json!({"wobble": 1, "method": {"ledger": true}, "points": {"position": [[0, 0]]},
        "forces": [{"points": [0], "force": [3, 0]}]});
    let sample = at(&alone, 1.0);
    assert_near(sample.ledger.unwrap().book.forces, 3.0 * sample.position[0][0], 1e-9, "work");
}

fn force(points: &[u32], push: [f64; 3]) -> Force<3> {
    Force { points: points.iter().map(|&point| PointId(point)).collect(), force: push, torque: 0.0 }
}

fn add(force: Force<3>) -> Command {
    Command::Add(Box::new(Addition { forces: vec![force], ..Addition::default() }))
}

fn remove(forces: &[u32]) -> Command {
    Command::Delete(Selection { forces: forces.to_vec(), ..Selection::default() })
}

#[test]
fn forces_come_go_and_change_by_commands_and_wake_what_sleeps() {
    for contact in [Value::Null, json!(true)] {
        let bodies: Vec<Value> = (0..2)
            .map(|k| json!({"make": "lattice", "columns": 3, "rows": 2, "spacing": 0.2, "origin": [4 * k, 0], "material": {"kind": "spring", "stiffness": 500, "damping": 5}}))
            .collect();
        let mut scene = json!({"wobble": 1, "bodies": bodies});
        if contact == json!(true) {
            scene["contact"] = contact;
        }
        let mut world = world(&scene);
        run_on(&mut *world, 2.0);
        assert!(world.is_asleep());
        let applied = world.apply(&add(force(&[0, 6], [12.0, 0.0, 0.0]))).unwrap();
        assert_eq!(applied.forces, 0..1);
        assert!(!world.is_asleep());
        let (before, t) = (world.sample(2.0), 2.0);
        let after = run_on(&mut *world, t + 0.05);
        let speed =
            |sample: &Sample, first: usize| sample.velocity[first..first + 6].iter().map(|v| v[0]).sum::<f64>() / 6.0;
        assert!(speed(&before, 0) == 0.0);
        for first in [0, 6] {
            // 6 N on each body of 6 kg for 0.05 s.
            assert_near(speed(&after, first), 0.05, 2e-3, "speed");
        }
        // Half of those that share it are gone: the other bears all.
        world.apply(&Command::Delete(Selection { points: vec![PointId(6)], ..Selection::default() })).unwrap();
        assert_eq!(world.forces()[0].points, [PointId(0)]);
        let start = world.time();
        let (before, after) = (world.sample(start), run_on(&mut *world, start + 0.05));
        assert_near(speed(&after, 0) - speed(&before, 0), 0.1, 4e-3, "speed");
        let stop = Change::Forces { forces: vec![0], force: Some([0.0, 6.0, 0.0]), torque: None };
        world.apply(&Command::Set(stop)).unwrap();
        assert_eq!(world.forces()[0].force, [0.0, 6.0, 0.0]);
        let saved = world.save().unwrap();
        assert_eq!(resume(&saved).unwrap().forces(), world.forces());
        world.apply(&remove(&[0])).unwrap();
        assert_eq!(world.apply(&add(force(&[1], [1.0, 0.0, 0.0]))).unwrap().forces, 1..2, "no number comes twice");
        assert!(matches!(world.apply(&remove(&[0])), Err(CommandError::NoSuch { kind: "force", number: 0 })));
        world.apply(&Command::Delete(Selection { points: vec![PointId(1)], ..Selection::default() })).unwrap();
        assert!(world.forces().is_empty(), "one with no point is gone");
        for bad in [force(&[], [1.0; 3]), force(&[2], [f64::NAN, 0.0, 0.0]), force(&[99], [1.0; 3])] {
            assert!(world.apply(&add(bad)).is_err());
        }
    }
}

#[test]
fn a_pinned_point_hands_its_share_to_the_others() {
    let scene = json!({"wobble": 1, "points": {"position": [[0, 0], [1, 0], [2, 0]]},
        "forces": [{"points": [0, 1, 2], "force": [6, 0]}]});
    let mut world = world(&scene);
    world.apply(&Command::Pin(vec![PointId(2)])).unwrap();
    let sample = run_on(&mut *world, 1.0);
    assert_near(sample.velocity[0][0], 3.0, 1e-12, "of two");
    assert_eq!(sample.position[2], [2.0, 0.0, 0.0]);
}

#[test]
fn wind_is_set_kept_and_told_where_it_pushes_nothing() {
    let mut world = world(&json!({"wobble": 1, "points": {"position": [[0, 0]]}, "wind": {"velocity": [1, 0]}}));
    assert!(world.warnings().iter().any(|text| text.contains("drag_rate")), "{:?}", world.warnings());
    let wind = Wind { velocity: [2.0, 0.0, 0.0], turbulence: 0.5, seed: 9 };
    let change = SceneChange { wind: Some(Some(wind)), drag_rate: Some(3.0), ..SceneChange::default() };
    world.apply(&Command::Set(Change::Scene(Box::new(change)))).unwrap();
    let mut copy = resume(&world.save().unwrap()).unwrap();
    let (one, other) = (run_on(&mut *world, 2.0), run_on(&mut *copy, 2.0));
    assert_eq!(one.position, other.position);
    assert!(one.velocity[0][0] > 0.5 && !world.is_asleep());
    let bad = SceneChange { wind: Some(Some(Wind { turbulence: -1.0, ..wind })), ..SceneChange::default() };
    assert!(world.apply(&Command::Set(Change::Scene(Box::new(bad)))).is_err());
    let still = SceneChange { wind: Some(None), ..SceneChange::default() };
    world.apply(&Command::Set(Change::Scene(Box::new(still)))).unwrap();
    run_on(&mut *world, 20.0);
    assert!(world.is_asleep(), "still air brings it to rest");
}

#[test]
fn an_equilibrium_bears_forces_torques_and_the_mean_wind() {
    let settled = |scene: &Value| {
        let model = Scene::parse(&scene.to_string(), "scene").unwrap().model::<2>().unwrap();
        let found = settle(&model).unwrap();
        assert!(found.is_settled, "{found:?}");
        found.position
    };
    let spring = json!({"wobble": 1, "points": {"position": [[0, 0], [1, 0]], "mass": 2, "pinned": [0]},
        "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 50}]});
    let x = settled(&with(&spring, "forces", json!([{"points": [0, 1], "force": [10, 0]}])));
    assert_near(x[1][0], 1.2, 1e-9, "10 N on 50 N/m");
    let x =
        settled(&with(&with(&spring, "drag_rate", json!(0.5)), "wind", json!({"velocity": [3, 0], "turbulence": 1})));
    assert_near(x[1][0], 1.06, 1e-9, "2 kg 0.5/s 3 m/s on 50 N/m");
    // A rod on a pin in its middle between two springs along y: k l^2 sin a cos a 2 about = M; small: a = M/(2 k).
    let rod = json!({"wobble": 1, "points": {"position": [[-1, 0], [0, 0], [1, 0], [-1, 100], [1, 100]], "pinned": [1, 3, 4]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 0, "b": 2}, {"a": 0, "b": 3, "kind": "spring", "stiffness": 10},
            {"a": 2, "b": 4, "kind": "spring", "stiffness": 10}],
        "forces": [{"points": [0, 2], "torque": 0.2}]});
    let x = settled(&rod);
    assert_near(x[2][1], 0.01, 1e-4, "0.2 N m on 2 10 N/m 1 m^2");
}

#[test]
fn what_a_scene_says_of_forces_wind_and_skins_survives_and_what_is_wrong_has_its_place() {
    let scene = json!({"wobble": 1, "contact": true, "drag_rate": 1, "wind": {"velocity": [1, 0], "turbulence": 0.2, "seed": 5},
        "points": {"position": [[9, 9], [9, 8]]}, "skins": [{"points": [1], "friction": 0.9}],
        "bodies": [{"make": "disc", "radius": 0.3, "spacing": 0.1, "material": {"friction": 0.1, "restitution": 0.5, "radius": 0.02},
            "repeat": {"count": [2, 1], "step": [1, 0]}}],
        "forces": [{"points": [0, 1], "force": [1, 2], "torque": 3}]});
    let read = Scene::parse(&scene.to_string(), "scene").unwrap();
    let again = Scene::parse(&serde_json::to_string(&read).unwrap(), "scene").unwrap();
    let expanded = Scene::parse(&serde_json::to_string(&read.expanded().unwrap()).unwrap(), "scene").unwrap();
    let model = read.model::<2>().unwrap();
    assert_eq!(again.model::<2>().unwrap(), model);
    assert_eq!(expanded.model::<2>().unwrap(), model);
    assert_eq!(model.skins.of(PointId(1)).friction, Some(0.9));
    assert_eq!(model.skins.of(PointId(40)).restitution, Some(0.5));
    let refused = |key: &str, value: Value, words: &str| {
        let scene = with(&scene, key, value);
        let result = Scene::parse(&scene.to_string(), "scene").and_then(|scene| scene.model::<2>().map(|_| ()));
        let error = result.expect_err(words).to_string();
        assert!(error.contains(words) && error.contains(key), "{error}");
    };
    refused("forces", json!([{"points": []}]), "names no point");
    refused("forces", json!([{"points": [0]}]), "pushes nothing");
    refused("forces", json!([{"points": [0, 9999], "force": [1, 0]}]), "point 9999 does not exist");
    refused("forces", json!([{"points": [0, 0], "torque": 1}]), "turns nothing");
    refused("forces", json!([{"points": [0], "force": [1, 0, 0]}]), "vector");
    refused("forces", json!([{"points": [0], "force": [1, 0], "mass": 1}]), "unknown key");
    refused("wind", json!({"velocity": [1, 0], "turbulence": -0.1}), "turbulence");
    refused("wind", json!({"velocity": [1, 0, 0]}), "velocity");
    refused("wind", json!({"velocity": [1, 0], "seed": -1}), "seed");
    refused("wind", json!({"turbulence": 1}), "velocity");
    refused("skins", json!([{"points": [0], "friction": -1}]), "friction");
    refused("skins", json!([{"points": [0], "restitution": 1.5}]), "restitution");
    refused("skins", json!([{"points": [9999]}]), "does not exist");
    let space = json!({"wobble": 1, "dimensions": 3, "points": {"position": [[0, 0, 0], [1, 0, 0]]},
        "forces": [{"points": [0, 1], "torque": 1}]});
    let error = Scene::parse(&space.to_string(), "scene").unwrap_err().to_string();
    assert!(error.contains("leave it out in space"), "{error}");
    let space = with(&space, "forces", json!([{"points": [0, 1], "force": [0, 0, 4]}]));
    assert_near(at(&space, 1.0).position[0][2], 1.0, 1e-12, "in space");
}

/// The acceleration along a slope of a block on a pinned one, with these frictions [m/s^2].
fn slides(own: Value, below: Value) -> f64 {
    let (g, tilt) = (9.81_f64, 0.4_f64);
    let pinned: Vec<u32> = (0..164).collect();
    let floor = json!({"make": "lattice", "columns": 82, "rows": 2, "spacing": 0.1, "origin": [-0.55, -0.1], "pinned": pinned, "material": below});
    let block =
        json!({"make": "lattice", "columns": 6, "rows": 3, "spacing": 0.1, "origin": [0, 0.012], "material": own});
    let scene = json!({"wobble": 1, "gravity": [g * tilt.sin(), -g * tilt.cos()], "contact": {"radius": 0.005},
        "bodies": [floor, block], "method": {"sleep": false}});
    let speed = |t: f64| at(&scene, t).velocity[164..].iter().map(|v| v[0]).sum::<f64>() / 18.0;
    (speed(1.0) - speed(0.5)) / 0.5
}

#[test]
fn friction_between_skins_is_the_root_of_the_product_of_theirs() {
    let of = |friction: Value| {
        let mut material = json!({"kind": "spring", "stiffness": 20000, "damping": 2, "point_mass": 0.1});
        if !friction.is_null() {
            material["friction"] = friction;
        }
        material
    };
    let free = 9.81 * 0.4_f64.sin();
    let press = 9.81 * 0.4_f64.cos();
    for (own, below, mu) in
        [(json!(0.1), json!(0.4), 0.2), (json!(0.0), json!(9.0), 0.0), (json!(0.02), Value::Null, 0.1)]
    {
        let found = slides(of(own.clone()), of(below));
        assert_near(found, free - mu * press, 0.02 * free, &format!("friction {own}"));
    }
}

#[test]
fn the_larger_restitution_of_two_skins_counts_and_radii_add_up() {
    let drop = |own: f64, below: f64| {
        let pinned: Vec<u32> = (0..24).collect();
        let material = |e: f64, radius: f64| json!({"kind": "spring", "stiffness": 2e5, "damping": 5, "point_mass": 0.1, "restitution": e, "radius": radius});
        let floor = json!({"make": "lattice", "columns": 12, "rows": 2, "spacing": 0.1, "origin": [-0.5, -0.1], "pinned": pinned, "material": material(below, 0.03)});
        let ball = json!({"make": "points", "count": 1, "seed": 1, "min": [0, 0.5], "max": [0, 0.5], "material": {"restitution": own, "radius": 0.02, "point_mass": 0.1}});
        json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": [floor, ball], "method": {"sleep": false}})
    };
    let fall = 9.81_f64 * 2.0 * 0.45;
    for (own, below, e) in [(0.8, 0.0, 0.8), (0.1, 0.6, 0.6)] {
        let mut world = world(&drop(own, below));
        // It falls for 0.303 s to a gap of 0.05 m.
        let sample = run_on(&mut *world, 0.4);
        let [_, y, _] = sample.position[24];
        let speed = (sample.velocity[24][1].powi(2) + 2.0 * 9.81 * (y - 0.05)).sqrt();
        assert_near(speed, e * fall.sqrt(), 0.03 * fall.sqrt(), "speed off the floor");
    }
    let rest = at(&drop(0.0, 0.0), 2.0);
    assert_near(rest.position[24][1], 0.05, 2e-3, "both radii");
}

/// Discs in a bin, two side by side in each row.
fn pile() -> Value {
    let disc = |k: u32| {
        json!({"make": "disc", "radius": 0.25, "spacing": 0.1, "origin": [-0.27 + 0.54 * f64::from(k % 2), 0.27 + 0.55 * f64::from(k / 2)],
            "material": {"kind": "spring", "stiffness": 3000, "damping": 0.5, "mass": 1}})
    };
    let discs: Vec<Value> = (0..8).map(disc).collect();
    json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": discs,
        "bounds": {"min": [-0.6, 0], "max": [0.6, 20], "friction": 0.3}})
}

#[test]
fn a_grabbed_body_is_pulled_out_of_a_pile_and_nothing_tears_through() {
    let mut world = world(&pile());
    run_on(&mut *world, 1.0);
    let each = world.point_count() as u32 / 8;
    let points: Vec<PointId> = (0..each).map(PointId).collect();
    let middle = |sample: &Sample, disc: usize| {
        let own = &sample.position[disc * each as usize..][..each as usize];
        let mean = |k: usize| own.iter().map(|x| x[k]).sum::<f64>() / f64::from(each);
        [mean(0), mean(1)]
    };
    let t = world.time();
    let start = middle(&world.sample(t), 0);
    let to = |at: [f64; 2], by: f64| Command::Cursor { to: Some(wobble::sim::Cursor::at(at)), by };
    world.apply(&to(start, t)).unwrap();
    world.apply(&Command::Grab(wobble::sim::Reach::Points(points))).unwrap();
    // The hand is gone at once.
    world.apply(&to([0.0, 4.0], t)).unwrap();
    world.apply(&to([0.0, 4.0], t + 1e-3)).unwrap();
    for frame in 1..=120 {
        let sample = run_on(&mut *world, t + f64::from(frame) / 60.0);
        assert!(sample.position.iter().flatten().all(|x| x.is_finite()));
        let middles: Vec<[f64; 2]> = (0..8).map(|disc| middle(&sample, disc)).collect();
        for (k, a) in middles.iter().enumerate() {
            for b in &middles[..k] {
                let apart = (a[0] - b[0]).hypot(a[1] - b[1]);
                assert!(apart > 0.2, "frame {frame}: discs {apart} m apart");
            }
        }
    }
    let sample = world.sample(world.time());
    assert!((middle(&sample, 0)[1] - 4.0).abs() < 0.4, "it is out: {:?}", middle(&sample, 0));
    let inverted = world.triangles().iter().filter(|corners| {
        let [a, b, c] = corners.map(|corner| sample.position[corner.index()]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0.0
    });
    assert_eq!(inverted.count(), 0);
}

#[test]
fn a_pin_that_jumps_leaves_what_hangs_on_it_whole() {
    for material in
        [json!({"point_mass": 0.1}), json!({"kind": "spring", "stiffness": 4000, "damping": 0.5, "point_mass": 0.05})]
    {
        let net = json!({"make": "cloth", "columns": 8, "rows": 6, "spacing": 0.1, "diagonals": "none", "pinned": [0, 7], "material": material});
        let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": {"self": false}, "drag_rate": 4, "bodies": [net],
            "pin_motion": [{"point": 0, "track": [[0, 0, 0], [0.3, 0, 0], [0.301, 5, 1]]}, {"point": 7, "track": [[0, 0.7, 0], [0.3, 0.7, 0], [0.301, 5.7, 1]]}]});
        let mut world = world(&scene);
        let mut fastest = 0.0_f64;
        for frame in 1..=240 {
            let sample = run_on(&mut *world, f64::from(frame) / 60.0);
            assert!(sample.position.iter().flatten().all(|x| x.is_finite()), "frame {frame}");
            fastest = sample.velocity.iter().map(|v| v[0].hypot(v[1])).fold(0.0, f64::max);
        }
        let sample = world.sample(4.0);
        assert_eq!([sample.position[0], sample.position[7]], [[5.0, 1.0, 0.0], [5.7, 1.0, 0.0]]);
        assert!(sample.max_strain < 0.3 && fastest < 20.0, "strain {}, {fastest} m/s", sample.max_strain);
    }
}
