//! What no one should ask of contact: whatever comes of it is finite, and has no energy from nowhere.

use serde_json::{Value, json};
use wobble::scene::Scene;

use super::tangle::faults;
use super::{disc, world};

/// Runs for `t` [s]; returns the energy at the start and the largest one [J].
fn energies(what: &str, scene: &Value, t: f64) -> [f64; 2] {
    let mut world = world(scene);
    let start = world.energy();
    let mut most = start;
    while world.time() < t - 1e-9 {
        world.step();
        assert!(world.is_finite(), "{what} at {} s", world.time());
        most = most.max(world.energy());
    }
    [start, most]
}

fn scene(contact: &Value, bodies: &[Value]) -> Value {
    json!({"wobble": 1, "contact": contact,
        "method": {"solver": "live"}, "bodies": bodies, "bounds": {"min": [-2, -2], "max": [2, 2]}})
}

fn four(speed: f64) -> Vec<Value> {
    (0..4)
        .map(|k| {
            let [x, y] = [[-1.0, 0.0], [1.0, 0.1], [0.1, 1.0], [0.0, -1.0]][k];
            disc([x, y], [-speed * x, -speed * y])
        })
        .collect()
}

#[test]
fn absurd_numbers_stay_finite() {
    for (what, contact) in [
        ("friction of 1e9", json!({"friction": 1e9})),
        ("a radius larger than the body", json!({"radius": 1.0})),
        ("no radius", json!({"radius": 0.0})),
        ("restitution 1", json!({"restitution": 1.0})),
        ("all of it", json!({"restitution": 1.0, "friction": 1e9, "radius": 0.3})),
    ] {
        let [start, most] = energies(what, &scene(&contact, &four(5.0)), 2.0);
        assert!(most < 1.01 * start, "{what}: {start} J, then {most} J");
    }
}

#[test]
fn what_overlaps_gains_no_energy() {
    for restitution in [0.0, 1.0] {
        let contact = json!({"restitution": restitution, "friction": 0.0});
        let bodies: Vec<Value> =
            (0..6).map(|k| disc([0.15 * f64::from(k) - 0.4, 0.05 * f64::from(k % 2)], [1.0, 0.5])).collect();
        let [start, most] = energies("overlap", &scene(&contact, &bodies), 2.0);
        // What parts them goes 1 m/s, which six of 1 kg have 3 J at.
        assert!(most < start + 1.5, "{start} J, then {most} J");
    }
}

#[test]
fn two_thousand_points_in_one_place_stay_finite() {
    let points = json!({"wobble": 1, "contact": true, "method": {"solver": "live"}, "gravity": [0, -9.81],
        "points": {"position": vec![[0.5, 0.5]; 2000]}, "bounds": {"min": [-2, 0], "max": [2, 3]}});
    energies("points", &points, 0.2);
    // A rope all of whose points lie in one place, and one across it.
    let bonds: Vec<Value> =
        (1..200).map(|k| json!({"a": k - 1, "b": k, "kind": "spring", "rest": 0.01, "stiffness": 100})).collect();
    let rope = json!({"wobble": 1, "contact": true,
        "method": {"solver": "live"}, "points": {"position": vec![[0.5, 0.5]; 200]}, "bonds": bonds});
    energies("rope", &rope, 0.2);
}

/// Work that is counted for each point in the first steps of so many that lie in one place, in the milliseconds of a frame.
fn work_in_one_place(scene: &Value, points: f64) -> f64 {
    let mut world = world(scene);
    let before = world.counters().work;
    for _ in 0..3 {
        world.step();
    }
    (world.counters().work - before) as f64 / points
}

#[test]
fn a_hundred_thousand_points_in_one_place_take_as_much_each_as_a_thousand() {
    let loose = |count: usize| {
        json!({"wobble": 1, "contact": true, "method": {"solver": "live"}, "gravity": [0, -9.81],
            "points": {"position": vec![[0.5, 0.5]; count]}, "bounds": {"min": [-2, 0], "max": [2, 3]}})
    };
    let began = std::time::Instant::now();
    let [few, many] = [1_000, 100_000].map(|count| work_in_one_place(&loose(count), count as f64));
    assert!(many < 1.5 * few, "{few} and {many} operations a point");
    // Twenty minutes by looking at every couple; all but frozen machines take seconds.
    assert!(began.elapsed().as_secs() < 120, "{:?}", began.elapsed());
}

#[test]
fn points_of_a_crowd_meet_so_many_edges_and_no_more() {
    let rope = |count: usize| {
        let bonds: Vec<Value> =
            (1..count).map(|k| json!({"a": k - 1, "b": k, "kind": "spring", "rest": 0.01, "stiffness": 100})).collect();
        json!({"wobble": 1, "contact": true, "method": {"solver": "live"}, "points": {"position": vec![[0.5, 0.5]; count]}, "bonds": bonds})
    };
    let [few, many] = [1_000, 4_000].map(|count| work_in_one_place(&rope(count), count as f64));
    assert!(many < 1.2 * few, "{few} and {many} operations a point");
}

/// A rope of so many points, all in one place.
fn crowd(count: usize, meets: bool) -> Value {
    let bonds: Vec<Value> =
        (1..count).map(|k| json!({"a": k - 1, "b": k, "kind": "spring", "rest": 0.01, "stiffness": 100})).collect();
    json!({"wobble": 1, "contact": meets, "points": {"position": vec![[0.5, 0.5]; count]}, "bonds": bonds})
}

#[test]
fn a_crowd_that_takes_long_is_told_of() {
    let tells = |scene: &Value| world(scene).warnings().iter().any(|line| line.contains("points lie in one place"));
    assert!(tells(&crowd(3_000, true)) && !tells(&crowd(2_999, true)), "from three thousand on");
    assert!(!tells(&crowd(3_000, false)), "nothing meets");
    let loose = json!({"wobble": 1, "contact": true, "points": {"position": vec![[0.5, 0.5]; 4_000]}});
    assert!(!tells(&loose), "points without bonds do not meet");
}

#[test]
fn ropes_in_space_that_pass_each_other_are_told_of() {
    let rope = |z: f64| json!({"make": "rope", "count": 5, "origin": [0, 0, z], "to": [1, 0, z]});
    let cloth = json!({"make": "cloth", "columns": 3, "rows": 3, "spacing": 0.5, "origin": [0, 2, 0]});
    let tells = |bodies: Vec<Value>, contact: Value| {
        let scene = json!({"wobble": 1, "dimensions": 3, "contact": contact, "bodies": bodies});
        world(&scene).warnings().iter().any(|line| line.starts_with("2 bodies without triangles pass each other"))
    };
    assert!(tells(vec![rope(0.0), rope(1.0), cloth.clone()], json!(true)));
    assert!(
        !tells(vec![rope(0.0), rope(1.0)], json!({"bodies": false}))
            && !tells(vec![rope(0.0), rope(1.0)], json!(false))
    );
    assert!(!tells(vec![rope(0.0), cloth], json!(true)), "one has nothing of its kind to pass");
}

#[test]
fn a_frame_of_a_rope_that_is_wrung_bears_what_it_may() {
    // The mouse draws all of it into one place, and jumps about.
    let track: Vec<Value> = (0..8)
        .map(|k| {
            json!([f64::from(k) / 60.0, f64::from(k * 7919 % 13) / 5.0 - 1.2, f64::from(k * 4729 % 11) / 4.0 - 1.2])
        })
        .collect();
    let scene = json!({"wobble": 1, "gravity": [0, -1000], "contact": true, "method": {"solver": "live"},
        "bodies": [{"make": "rope", "count": 600, "origin": [-0.7, 1], "to": [0.1, -0.6], "material": {"kind": "rigid", "mass": 0.7}}],
        "mouse": {"strength": -1460, "radius": 1.45, "track": track}});
    let mut world = world(&scene);
    let mut worst: f64 = 0.0;
    while world.time() < 0.1 - 1e-9 {
        let before = world.counters().work_ms();
        world.step();
        worst = worst.max(world.counters().work_ms() - before);
    }
    // 114 ms with as many substeps as its speed asks for.
    assert!(world.is_finite() && worst < 60.0, "{worst} ms of counted work");
}

#[test]
fn many_bodies_in_one_place_come_apart() {
    let bodies: Vec<Value> = (0..12).map(|_| disc([0.0, 0.0], [0.0; 2])).collect();
    let mut world = world(&scene(&json!(true), &bodies));
    while world.time() < 4.0 {
        world.step();
    }
    assert!(world.is_finite());
    assert_eq!(faults(&*world), [0, 0]);
}

#[test]
fn triangles_without_an_inside_do_no_harm() {
    let lines = json!({"wobble": 1, "contact": true, "method": {"solver": "live"}, "gravity": [0, -9.81],
        "points": {"position": [[0, 1], [0.5, 1], [1, 1], [0.2, 1], [0.2, 1], [0.2, 1.5]], "velocity": [[0, -9], [0, -9], [0, -9], [0, -9], [0, -9], [0, -9]]},
        "bonds": [{"a": 0, "b": 1, "kind": "rigid"}, {"a": 1, "b": 2, "kind": "rigid"}, {"a": 0, "b": 2, "kind": "rigid"},
            {"a": 3, "b": 5, "kind": "rigid"}, {"a": 4, "b": 5, "kind": "rigid"}],
        "triangles": [[0, 1, 2], [3, 4, 5]], "bounds": {"min": [-2, 0], "max": [2, 3]}});
    match Scene::parse(&lines.to_string(), "scene").and_then(|scene| scene.world(None)) {
        Err(error) => assert!(error.to_string().contains("triangle"), "{error}"),
        Ok(_) => {
            energies("lines", &lines, 1.0);
        }
    }
}

#[test]
fn many_bodies_in_one_place_come_apart_without_speed() {
    for count in [6, 24] {
        let heap = |k: i32| disc([0.03 * f64::from(k), 0.02 * f64::from(5 * k % 7)], [0.0; 2]);
        let bodies: Vec<Value> = (0..count).map(heap).collect();
        let scene = json!({"wobble": 1, "contact": true, "bodies": bodies});
        let mut world = world(&scene);
        let mut most: f64 = 0.0;
        while world.time() < 3.0 {
            world.step();
            let sample = world.sample(world.time());
            let twice: f64 =
                sample.velocity.iter().zip(world.masses()).map(|(v, mass)| mass * (v[0] * v[0] + v[1] * v[1])).sum();
            most = most.max(0.5 * twice);
        }
        // Of 1 kg each: 0.4 m/s in the mean.
        assert!(most < 0.08 * f64::from(count), "{count}: {most} J");
        assert!(world.energy() < 0.1 * f64::from(count), "{count}: springs are squeezed: {} J", world.energy());
    }
}

#[test]
fn a_triangle_named_twice_is_left_out_with_a_word() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "areas": {"kind": "rigid"},
        "points": {"position": [[0, 0.5], [0.4, 0.6], [0.1, 0.9]], "velocity": [[1, 0], [0, 0], [0, 1]]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 0}],
        "triangles": [[0, 1, 2], [2, 1, 0]], "bounds": {"min": [-1, 0], "max": [3, 5]}});
    let world = Scene::parse(&scene.to_string(), "twice.json").unwrap().world(None).unwrap();
    assert_eq!(world.triangles().len(), 1);
    assert!(
        world.warnings().iter().any(|words| words.contains("repeated") && words.ends_with("(triangle 1)")),
        "{:?}",
        world.warnings()
    );
    let [start, most] = energies("twice", &scene, 2.0);
    assert!(most < 1.01 * start, "{start} J, then {most} J");
}

#[test]
fn a_joint_that_starts_outside_its_stops_is_told_of() {
    let at = |angle: f64| {
        json!({"wobble": 1, "points": {"position": [[1, 0], [0, 0], [angle.cos(), angle.sin()]]},
            "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}],
            "angles": [{"points": [0, 1, 2], "min": 1.0, "max": 2.0}]})
    };
    let world = |angle: f64| Scene::parse(&at(angle).to_string(), "joint.json").unwrap().world(None).unwrap();
    let words = |angle: f64| {
        let world = world(angle);
        world
            .warnings()
            .iter()
            .filter(|words| words.starts_with("a joint is outside its stops, which push it back in with an energy of "))
            .count()
    };
    assert_eq!([1.0, 1.5, 2.0, 0.5, 2.5, -2.0].map(words), [0, 0, 0, 1, 1, 1]);
    // What rests against a stop is a little beyond it: it starts there.
    for angle in [2.004, 0.996] {
        let mut world = world(angle);
        assert_eq!(world.warnings(), [] as [String; 0], "{angle}");
        let range = world.angles()[0].range.unwrap();
        assert!((range[0] - angle.min(1.0)).abs() < 1e-12 && (range[1] - angle.max(2.0)).abs() < 1e-12, "{range:?}");
        let start = world.energy();
        while world.time() < 1.0 {
            world.step();
        }
        assert!((world.energy() - start).abs() < 1e-9, "{} J, {start} J at the start", world.energy());
    }
}

#[test]
fn walls_that_hold_everything_make_no_energy() {
    for method in [json!({}), json!({"solver": "live"})] {
        for friction in [30.0, 1e9] {
            let scene = json!({"wobble": 1, "gravity": [0, -9.81], "method": method, "contact": true,
                "bodies": [disc([0.0, 0.5], [6.0, -3.0])],
                "bounds": {"min": [-1, 0], "max": [1, 5], "friction": friction, "restitution": 0.5}});
            let [start, most] = energies("walls", &scene, 2.0);
            assert!(most < 1.01 * start, "{method} {friction}: {start} J, then {most} J");
        }
    }
}

#[test]
fn rigid_boxes_that_give_all_back_gain_nothing_in_a_minute() {
    let of = |(k, [x, y]): (u32, [f64; 2])| {
        let k = f64::from(k);
        json!({"make": "box", "width": 0.5, "height": 0.5, "supports": 2, "origin": [x, y],
            "velocity": [2.0 - k, 1.0 + 0.7 * k], "spin": k + 1.0, "material": {"kind": "rigid", "point_mass": 0.1}})
    };
    let places = [[0.0, 0.0], [1.2, 0.0], [0.0, 1.2], [1.2, 1.2]];
    let scene = json!({"wobble": 1, "contact": {"restitution": 1, "friction": 0}, "method": {"solver": "live"},
        "bodies": (0..).zip(places).map(of).collect::<Vec<_>>(),
        "bounds": {"min": [-0.6, -0.6], "max": [1.9, 1.9], "restitution": 1}});
    let [start, most] = energies("boxes", &scene, 60.0);
    // Of some five hundred blows each gives back what came in to a thousandth.
    assert!(most < 1.02 * start, "{start} J, then {most} J");
}
