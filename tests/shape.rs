//! Angles, areas and bending: closed forms, orders of the methods, what is kept, and what commands and files make of them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::f64::consts::PI;

use serde_json::{Value, json};
use wobble::equilibrium::settle;
use wobble::scene::Scene;
use wobble::sim::{Addition, AngleChange, Change, Command, Dynamics, Sample, Selection, Values, angle_at, resume};
use wobble::sim::{Areas, BondId, PointId, SceneChange};

fn scene(json: &Value) -> Scene {
    Scene::parse(&json.to_string(), "scene").unwrap()
}

fn world(json: &Value) -> Box<dyn Dynamics> {
    scene(json).world(None).unwrap()
}

fn reached(world: &mut dyn Dynamics, t: f64) -> Sample {
    while world.time() < t - 1e-9 {
        world.step();
    }
    world.sample(world.time())
}

/// The state at a time by a method at a substep [s].
fn run(json: &Value, (solver, substep): (&str, f64), t: f64) -> Sample {
    let mut json = json.clone();
    json["method"] = json!({"solver": solver, "substep": substep, "precision": "f64", "sleep": false});
    reached(&mut *world(&json), t)
}

/// The methods for which angles and areas are forces, with their orders.
const EXACT: [(&str, f64); 12] = [
    ("euler", 1.0),
    ("symplectic-euler", 1.0),
    ("verlet", 2.0),
    ("velocity-verlet", 2.0),
    ("pefrl", 4.0),
    ("blanes-moan-4", 4.0),
    ("blanes-moan-6", 6.0),
    ("rk2", 2.0),
    ("rk4", 4.0),
    ("rk8", 8.0),
    ("implicit-midpoint", 2.0),
    ("backward-euler", 1.0),
];

/// A rod of length 1 with a mass of 2 kg at its end, on a hinge that is at rest straight ahead: its angle crosses pi.
fn pendulum() -> Value {
    let phi: f64 = 0.3;
    json!({"wobble": 1, "points": {"position": [[-1, 0], [0, 0], [phi.cos(), phi.sin()]], "mass": [1, 1, 2], "pinned": [0, 1]},
        "bonds": [{"a": 1, "b": 2}], "angles": [{"points": [0, 1, 2], "rest": PI, "stiffness": 50}]})
}

fn turn(sample: &Sample, point: usize) -> f64 {
    sample.position[point][1].atan2(sample.position[point][0])
}

#[test]
fn a_hinge_swings_as_the_closed_form_says_at_the_order_of_every_method() {
    // I phi'' = -k phi, I = m l^2.
    let omega = (50.0_f64 / 2.0).sqrt();
    let exact = 0.3 * (omega * 2.0).cos();
    for (solver, order) in EXACT {
        let h = if order > 4.0 {
            1.0 / 10.0
        } else if order > 1.0 {
            1.0 / 40.0
        } else {
            1.0 / 2000.0
        };
        let error = |h: f64| (turn(&run(&pendulum(), (solver, h), 2.0), 2) - exact).abs();
        let (coarse, fine) = (error(h), error(0.5 * h));
        let seen = (coarse / fine).log2();
        assert!(fine < 2e-2 && (seen > order - 0.4 || fine < 1e-11), "{solver}: {coarse} {fine}, order {seen}");
    }
}

/// Three points that angles and an area alone hold together, turning and flying.
fn sail() -> Value {
    json!({"wobble": 1, "points": {"position": [[0, 0], [1, 0], [0.2, 0.9]], "velocity": [[0.5, 0.1], [0.4, 1.0], [-0.8, 0.2]],
        "mass": [1, 2, 1.5]}, "triangles": [[0, 1, 2]], "areas": {"kind": "spring", "stiffness": 40},
        "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 60}, {"a": 0, "b": 2, "kind": "spring", "stiffness": 60}],
        "angles": [{"points": [1, 0, 2], "rest": 1.0, "stiffness": 8}, {"points": [0, 1, 2], "stiffness": 5}]})
}

#[test]
fn forms_move_at_the_order_of_every_method_against_a_finer_run_by_another() {
    let reference = run(&sail(), ("rk8", 1.0 / 400.0), 1.0);
    for (solver, order) in EXACT {
        let h = if order > 2.0 {
            1.0 / 30.0
        } else if order > 1.0 {
            1.0 / 200.0
        } else {
            1.0 / 4000.0
        };
        let error = |h: f64| {
            let sample = run(&sail(), (solver, h), 1.0);
            let far = |(a, b): (&[f64; 3], &[f64; 3])| (a[0] - b[0]).hypot(a[1] - b[1]);
            sample.position.iter().zip(&reference.position).map(far).fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(h), error(0.5 * h));
        let seen = (coarse / fine).log2();
        assert!(fine < 1e-2 && (seen > order - 0.4 || fine < 1e-11), "{solver}: {coarse} {fine}, order {seen}");
    }
}

fn moments(sample: &Sample, mass: &[f64]) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for ((x, v), m) in sample.position.iter().zip(&sample.velocity).zip(mass) {
        sums[0] += m * v[0];
        sums[1] += m * v[1];
        sums[2] += m * (x[0] * v[1] - x[1] * v[0]);
    }
    sums
}

#[test]
fn energy_momentum_and_angular_momentum_stay() {
    let mass = [1.0, 2.0, 1.5];
    for (solver, h) in [("pefrl", 1e-3), ("rk8", 2e-3), ("velocity-verlet", 1e-4), ("implicit-midpoint", 1e-3)] {
        let (start, end) = (run(&sail(), (solver, h), 0.0), run(&sail(), (solver, h), 3.0));
        assert!((start.energy - end.energy).abs() < 1e-5 * start.energy, "{solver}: {} {}", start.energy, end.energy);
        for (a, b) in moments(&start, &mass).iter().zip(moments(&end, &mass)) {
            assert!((a - b).abs() < 1e-9, "{solver}: {a} {b}");
        }
    }
}

#[test]
fn a_triangle_breathes_as_the_closed_form_says_and_comes_back_through_inversion() {
    // Of equal sides: omega^2 = sqrt(3) k/m.
    let (k, m, size) = (30.0, 2.0, 1.0 + 1e-5);
    let corner = |n: f64| [size * (n * 2.0 * PI / 3.0).cos(), size * (n * 2.0 * PI / 3.0).sin()];
    let at = [corner(0.0), corner(1.0), corner(2.0)];
    let side = 3.0_f64.sqrt();
    let bonds: Vec<Value> = [[0, 1], [1, 2], [2, 0]]
        .iter()
        .map(|[a, b]| json!({"a": a, "b": b, "kind": "spring", "stiffness": 0, "rest": side}))
        .collect();
    let json = json!({"wobble": 1, "points": {"position": at, "mass": m}, "bonds": bonds, "triangles": [[0, 1, 2]],
        "areas": {"kind": "spring", "stiffness": k}});
    let omega = (3.0_f64.sqrt() * k / m).sqrt();
    let half = PI / omega;
    for solver in ["rk8", "pefrl", "implicit-midpoint"] {
        let x = run(&json, (solver, half / 400.0), half).position[0];
        assert!((x[0] - (1.0 - 1e-5)).abs() < 1e-8, "{solver}: {x:?}");
    }
    // Inside out it is pulled back: its energy falls all the way to its own area.
    let inverted = json!({"wobble": 1, "drag_rate": 2, "points": {"position": [[0, 0], [1, 0], [0.5, -0.3]], "mass": 1},
        "bonds": [{"a": 0, "b": 1, "rest": 1}, {"a": 1, "b": 2, "kind": "spring", "stiffness": 0.001, "rest": 1},
            {"a": 2, "b": 0, "kind": "spring", "stiffness": 0.001, "rest": 1}],
        "triangles": [[0, 1, 2]], "areas": {"kind": "spring", "stiffness": 50}});
    for solver in ["auto", "live", "implicit-midpoint"] {
        let mut json = inverted.clone();
        json["method"] = json!({"solver": solver});
        // Corners are anticlockwise at the start: one that starts inside out by its drawing is put right.
        let mut world = world(&json);
        let end = reached(&mut *world, 8.0);
        let [a, b, c] = world.triangles()[0].map(|corner| end.position[corner.index()]);
        let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        assert!((area - 0.433).abs() < 0.01, "{solver}: {area}");
    }
}

/// A cantilever of length 1, mass 1 kg and this many pieces, clamped by the two points in front of it.
fn cantilever(pieces: usize, bending: f64, gravity: f64) -> Value {
    let spacing = 1.0 / pieces as f64;
    json!({"wobble": 1, "gravity": [0, -gravity],
        "bodies": [{"make": "rope", "count": pieces + 2, "spacing": spacing, "origin": [-spacing, 0], "pinned": [0, 1],
            "material": {"bending": bending, "mass": 1.0 + spacing}}]})
}

#[test]
fn a_cantilever_sags_as_the_closed_form_says_whatever_its_pieces() {
    for pieces in [10, 20, 40] {
        let sag =
            -settle(&scene(&cantilever(pieces, 2.0, 0.1)).model::<2>().unwrap()).unwrap().position.last().unwrap()[1];
        // w L^4/(8 EI); the clamp turns by as much as half a piece in front of it would.
        let length = 1.0 + 0.5 / pieces as f64;
        let expected = 0.1 * length.powi(4) / (8.0 * 2.0);
        assert!((sag / expected - 1.0).abs() < 0.01, "{pieces}: {sag} {expected}");
    }
}

#[test]
fn a_clamped_beam_swings_as_the_closed_form_says_whatever_its_pieces() {
    // omega = 1.8751^2 sqrt(EI/(mu L^4)); released from the shape of its own weight it swings about straight.
    for pieces in [8, 16] {
        let mut json = cantilever(pieces, 2.0, 0.05);
        let bent = settle(&scene(&json).model::<2>().unwrap()).unwrap().position;
        let length = 1.0 + 0.5 / pieces as f64;
        let omega = 1.875_104_f64.powi(2) * 2.0_f64.sqrt() / length.powi(2);
        json["gravity"] = json!([0, 0]);
        let mut expanded: Value = serde_json::from_str(&scene(&json).expanded().unwrap().to_json().unwrap()).unwrap();
        for angle in expanded["angles"].as_array_mut().unwrap() {
            angle["rest"] = json!(PI);
        }
        expanded["points"]["position"] = json!(bent);
        let end = run(&expanded, ("velocity-verlet", 1.0 / 2000.0), PI / omega);
        let (from, to) = (bent.last().unwrap()[1], end.position.last().unwrap()[1]);
        assert!((to / from + 1.0).abs() < 0.04, "{pieces}: {from} {to}");
    }
}

#[test]
fn a_live_cantilever_sags_alike() {
    let mut json = cantilever(20, 0.2, 0.5);
    let still = -settle(&scene(&json).model::<2>().unwrap()).unwrap().position.last().unwrap()[1];
    json["drag_rate"] = json!(4);
    json["method"] = json!({"solver": "live"});
    let sag = -reached(&mut *world(&json), 6.0).position.last().unwrap()[1];
    // One sweep in a substep is a little softer than the law.
    assert!((sag / still - 1.0).abs() < 0.06, "{sag} {still}");
}

#[test]
fn joints_stop_at_their_limits_in_every_method() {
    // A rod falls from level to a limit half way down.
    let json = json!({"wobble": 1, "gravity": [0, -9.81],
        "points": {"position": [[-1, 0], [0, 0], [1, 0]], "pinned": [0, 1]},
        "bonds": [{"a": 1, "b": 2}], "angles": [{"points": [0, 1, 2], "min": 0.75 * PI, "max": 1.6 * PI}]});
    for (solver, _) in EXACT.into_iter().chain([("auto", 0.0), ("live", 0.0)]) {
        let mut json = json.clone();
        json["method"] = json!({"solver": solver});
        if solver == "euler" || solver == "symplectic-euler" || solver == "rk2" {
            json["method"]["substep"] = json!(5e-5);
        }
        let mut world = world(&json);
        let mut least = 0.0_f64;
        while world.time() < 0.8 {
            world.step();
            let x = world.positions();
            least = least.min(x.get(5).atan2(x.get(4)));
        }
        assert!((least + 0.25 * PI).abs() < 1e-2, "{solver}: {least}");
    }
}

/// A strip with bending, areas and a joint, turning.
fn strip() -> Value {
    json!({"wobble": 1, "gravity": [0, -2], "areas": {"kind": "spring", "stiffness": 20},
        "points": {"position": [[0, 2], [0.5, 2.1], [1, 2]], "pinned": [0]},
        "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 90, "damping": 1}, {"a": 1, "b": 2, "kind": "spring", "stiffness": 90}],
        "angles": [{"points": [0, 1, 2], "stiffness": 2, "damping": 0.1, "min": 1, "max": 4}],
        "bodies": [{"make": "rope", "count": 5, "spacing": 0.3, "spin": 1, "material": {"bending": 0.4}},
            {"make": "disc", "radius": 0.4, "spacing": 0.2, "origin": [3, 0], "material": {"kind": "spring", "stiffness": 200, "bending": 0.1}}]})
}

#[test]
fn a_scene_is_the_same_written_out_and_read_again() {
    let first = scene(&strip());
    let again = Scene::parse(&first.to_json().unwrap(), "again").unwrap();
    assert_eq!(first.model::<2>().unwrap(), again.model::<2>().unwrap());
    let written = Scene::parse(&first.expanded().unwrap().to_json().unwrap(), "expanded").unwrap();
    let (a, b) = (first.model::<2>().unwrap(), written.model::<2>().unwrap());
    let around = 13;
    assert_eq!(a.angles.list.len(), 1 + 3 + around);
    assert_eq!(a, b);
    assert!(written.bodies.is_empty());
}

#[test]
fn a_kept_world_goes_on_as_it_would_have() {
    let mut first = world(&strip());
    reached(&mut *first, 0.4);
    let saved = first.save().unwrap();
    let mut second = resume(&saved).unwrap();
    assert_eq!(saved, second.save().unwrap());
    let (a, b) = (reached(&mut *first, 0.8), reached(&mut *second, 0.8));
    assert!((a.energy - b.energy).abs() < 1e-7 * a.energy.abs().max(1.0), "{} {}", a.energy, b.energy);
    for (x, y) in a.position.iter().zip(&b.position) {
        assert!((x[0] - y[0]).hypot(x[1] - y[1]) < 1e-7, "{x:?} {y:?}");
    }
}

#[test]
fn angles_come_change_and_go_by_commands() {
    let json = json!({"wobble": 1, "points": {"position": [[0, 0], [1, 0], [1.5, 0.8], [2, 0]], "pinned": [0, 1]},
        "bonds": [{"a": 1, "b": 2}, {"a": 2, "b": 3, "kind": "spring", "stiffness": 100}],
        "angles": [{"points": [0, 1, 2], "stiffness": 1}]});
    let mut world = world(&json);
    assert!(world.energy() < 1e-20);
    let places = [[1.0, 0.0], [1.5, 0.8], [2.0, 0.0]];
    let angle = wobble::sim::Angle { stiffness: 3.0, ..angle_at([1, 2, 3].map(PointId), places) };
    let addition = Addition { angles: vec![angle], ..Addition::default() };
    assert_eq!(world.apply(&Command::Add(Box::new(addition))).unwrap().angles, 1..2);
    let set = |angles: Vec<u32>, to: AngleChange| Command::Set(Change::Angles { angles, to: Box::new(to) });
    let rest = AngleChange { rest: Some(Values::Same(angle.rest + 0.2)), ..AngleChange::default() };
    world.apply(&set(vec![1], rest.clone())).unwrap();
    assert!((world.energy() - 0.5 * 3.0 * 0.04).abs() < 1e-12, "{}", world.energy());
    assert!(world.apply(&set(vec![7], rest)).is_err());
    let wrong = AngleChange { range: Some(Some([3.0, 1.0])), ..AngleChange::default() };
    assert!(world.apply(&set(vec![0], wrong)).is_err());
    // A bond takes the angles along it with it, an angle is deleted by its number, and a number is not given twice.
    world.apply(&Command::Delete(Selection { bonds: vec![BondId(1)], ..Selection::default() })).unwrap();
    assert!(world.energy() < 1e-20);
    assert!(world.apply(&Command::Delete(Selection { angles: vec![1], ..Selection::default() })).is_err());
    world.apply(&Command::Delete(Selection { angles: vec![0], ..Selection::default() })).unwrap();
    let bent = AngleChange { rest: Some(Values::Same(1.0)), ..AngleChange::default() };
    assert!(world.apply(&set(vec![0], bent)).is_err());
    let angle = angle_at([0, 1, 2].map(PointId), [[0.0, 0.0], [1.0, 0.0], [1.5, 0.8]]);
    let addition = Addition { angles: vec![angle], ..Addition::default() };
    assert_eq!(world.apply(&Command::Add(Box::new(addition))).unwrap().angles, 2..3);
    world.apply(&Command::Delete(Selection { points: vec![PointId(2)], ..Selection::default() })).unwrap();
    assert!(world.apply(&Command::Delete(Selection { angles: vec![2], ..Selection::default() })).is_err());
}

#[test]
fn a_ledger_knows_the_dampers_of_angles() {
    let json = json!({"wobble": 1, "method": {"ledger": true, "solver": "rk8", "substep": 0.005},
        "points": {"position": [[-1, 0], [0, 0], [0.8, 0.6]], "pinned": [0, 1]},
        "bonds": [{"a": 1, "b": 2}], "angles": [{"points": [0, 1, 2], "rest": PI, "stiffness": 20, "damping": 0.7}]});
    let ledger = reached(&mut *world(&json), 1.0).ledger.unwrap();
    assert!(ledger.book.dampers > 1.0, "{ledger:?}");
    assert!(ledger.left_over().abs() < 1e-6 * ledger.start, "{ledger:?}");
}

#[test]
fn what_cannot_be_is_refused_in_a_line() {
    let with = |key: &str, value: Value| {
        let mut json = json!({"wobble": 1, "points": {"position": [[0, 0], [1, 0], [1, 1], [1, 0]]}});
        json[key] = value;
        json
    };
    let said = |json: Value| {
        let read = Scene::parse(&json.to_string(), "x").and_then(|scene| scene.model::<2>().map(|_| ()));
        read.unwrap_err().to_string()
    };
    let angle = |keys: Value| {
        let mut angle = json!({"points": [0, 1, 2]});
        angle.as_object_mut().unwrap().extend(keys.as_object().unwrap().clone());
        said(with("angles", json!([angle])))
    };
    for (found, expected) in [
        (angle(json!({"points": [0, 1, 3]})), "angles[0].points: an arm has no length: put its points apart"),
        (angle(json!({"min": 2, "max": 1})), "angles[0].min: 2.0 is not below 1.0 of `max`: give min < max"),
        (angle(json!({"min": -3.5, "max": 3})), "angles[0].max: 3.0 is a turn or more above -3.5 of `min`"),
        (angle(json!({"rest": 0})), "angles[0].rest: is 0.0: give an angle between 0 and 2 pi"),
        (angle(json!({"stiffness": -1})), "angles[0].stiffness: is -1.0: give a number of 0 or more"),
        (angle(json!({"min": 1})), "angles[0].min: stands without `max`"),
        (said(with("areas", json!({"least": 0.2}))), "areas.least: is of bodies that meet"),
        (said(with("areas", json!({}))), "areas: say nothing"),
        (
            said(with(
                "bodies",
                json!([{"make": "cloth", "columns": 2, "rows": 2, "spacing": 1, "material": {"bending": 1}}]),
            )),
            "bodies[0].material.bending: is of chains and skins, and `cloth` has none: leave it out",
        ),
    ] {
        assert!(found.contains(expected), "{found}");
    }
    for solver in ["xpbd", "path", "relaxation"] {
        let mut json = with("angles", json!([{"points": [0, 1, 2], "stiffness": 1}]));
        json["method"] = json!({"solver": solver, "substep": 0.01, "iterations": 1});
        assert!(said(json).contains(&format!("angles: solver `{solver}` knows no angles: use auto")), "{solver}");
    }
    let space = json!({"wobble": 1, "dimensions": 3, "points": {"position": [[0, 0, 0], [1, 0, 0], [1, 1, 0]]},
        "angles": [{"points": [0, 1, 2]}]});
    let read = Scene::parse(&space.to_string(), "x").and_then(|scene| scene.model::<3>().map(|_| ()));
    assert!(read.unwrap_err().to_string().contains("angles: act in the plane only: leave them out in space"));
}

#[test]
fn flat_triangles_are_left_out_with_a_word() {
    let json = json!({"wobble": 1, "points": {"position": [[0, 0], [1, 0], [2, 0], [0, 1]]}, "triangles": [[0, 1, 2], [0, 2, 3]],
        "areas": {"kind": "spring", "stiffness": 5}});
    let world = world(&json);
    assert!(
        world.warnings().iter().any(|text| text.contains("of area 0 at the start") && text.ends_with("(triangle 0)")),
        "{:?}",
        world.warnings()
    );
}

#[test]
fn least_keeps_more_or_less_of_triangles_that_meet() {
    let json = |least: f64| {
        json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "areas": {"least": least},
            "bounds": {"min": [-3, 0], "max": [3, 9], "friction": 0.5},
            "bodies": [{"make": "disc", "radius": 0.5, "spacing": 0.15, "origin": [0, 0.6], "velocity": [0, -4],
                "material": {"kind": "spring", "stiffness": 60, "damping": 0.5, "mass": 2}}]})
    };
    let flattest = |least: f64| {
        let mut world = world(&json(least));
        let share = |world: &dyn Dynamics, start: &[f64]| {
            let now = sizes(world);
            now.iter().zip(start).map(|(now, start)| now / start).fold(f64::INFINITY, f64::min)
        };
        let start = sizes(&*world);
        let mut most = f64::INFINITY;
        while world.time() < 1.5 {
            world.step();
            most = most.min(share(&*world, &start));
        }
        most
    };
    let (soft, firm) = (flattest(0.1), flattest(0.8));
    assert!(firm > 0.6 && soft < 0.5, "{soft} {firm}");
}

#[test]
fn areas_that_are_set_later_are_those_of_a_scene_that_had_them() {
    let mut json = json!({"wobble": 1, "gravity": [0, -9.81], "bounds": {"min": [-3, 0], "max": [3, 9]}, "method": {"sleep": false},
        "bodies": [{"make": "disc", "radius": 0.5, "spacing": 0.2, "origin": [0, 0.6],
            "material": {"kind": "spring", "stiffness": 60, "damping": 0.5, "mass": 2}}]});
    let set = |world: &mut dyn Dynamics, areas: Option<Areas>| {
        let change = SceneChange { areas: Some(areas), ..SceneChange::default() };
        world.apply(&Command::Set(Change::Scene(Box::new(change)))).unwrap()
    };
    let spring = Areas { stiffness: 900.0, ..Areas::default() };
    let (mut soft, mut firm, mut back) = (world(&json), world(&json), world(&json));
    set(&mut *firm, Some(spring));
    set(&mut *back, Some(spring));
    set(&mut *back, None);
    json["areas"] = json!({"kind": "spring", "stiffness": 900});
    let mut had = world(&json);
    let area = |world: &dyn Dynamics| sizes(world).iter().sum::<f64>();
    let [soft_at, firm_at, back_at, had_at] =
        [&mut soft, &mut firm, &mut back, &mut had].map(|world| reached(&mut **world, 0.6).position);
    let apart = |a: &[[f64; 3]], b: &[[f64; 3]]| {
        a.iter().zip(b).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max)
    };
    let [firm_off, back_off] = [apart(&firm_at, &had_at), apart(&back_at, &soft_at)];
    // The steps of a world are as long as its start asked for: an error of the method.
    assert!(firm_off < 1e-6 && back_off < 1e-9, "{firm_off} {back_off}");
    assert!(area(&*firm) > area(&*soft) + 0.02, "{} {}", area(&*firm), area(&*soft));
    let bad = SceneChange { areas: Some(Some(Areas { stiffness: -1.0, ..spring })), ..SceneChange::default() };
    assert!(soft.apply(&Command::Set(Change::Scene(Box::new(bad)))).is_err());
    assert_eq!(soft.sample(soft.time()).position, soft_at);
}

fn sizes(world: &dyn Dynamics) -> Vec<f64> {
    let x = world.positions();
    let of = |corners: &[PointId; 3]| {
        let [a, b, c] = corners.map(|corner| [x.get(2 * corner.index()), x.get(2 * corner.index() + 1)]);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    };
    world.triangles().iter().map(of).collect()
}

#[test]
fn rigid_areas_hold_to_a_thousandth_in_every_method() {
    let json = json!({"wobble": 1, "gravity": [0, -9.81], "areas": {"kind": "rigid"},
        "bounds": {"min": [-2, 0], "max": [2, 5]},
        "bodies": [{"make": "disc", "radius": 0.4, "spacing": 0.3, "origin": [0, 0.5], "velocity": [1, -2],
            "material": {"kind": "spring", "stiffness": 300, "damping": 0.5, "mass": 1}}]});
    for (solver, _) in EXACT.into_iter().chain([("auto", 0.0), ("live", 0.0)]) {
        let mut json = json.clone();
        json["method"] = json!({"solver": solver});
        if solver == "implicit-midpoint" || solver == "backward-euler" {
            // Implicit steps do not locate what they touch.
            json.as_object_mut().unwrap().remove("bounds");
        }
        let mut world = world(&json);
        let start = sizes(&*world);
        let mut worst = 0.0_f64;
        while world.time() < 0.5 {
            world.step();
            let now = sizes(&*world);
            worst = now.iter().zip(&start).map(|(now, start)| (now / start - 1.0).abs()).fold(worst, f64::max);
        }
        assert!(worst < 1e-3, "{solver}: {worst}");
    }
}

#[test]
fn held_areas_move_at_the_order_of_the_method_and_keep_energy() {
    let mut json = sail();
    json["areas"] = json!({"kind": "rigid"});
    let reference = run(&json, ("rk8", 1.0 / 400.0), 1.0);
    for (solver, order) in [("velocity-verlet", 2.0), ("pefrl", 4.0), ("rk4", 4.0), ("implicit-midpoint", 2.0)] {
        let h = if order > 2.0 { 1.0 / 50.0 } else { 1.0 / 400.0 };
        let error = |h: f64| {
            let sample = run(&json, (solver, h), 1.0);
            let far = |(a, b): (&[f64; 3], &[f64; 3])| (a[0] - b[0]).hypot(a[1] - b[1]);
            sample.position.iter().zip(&reference.position).map(far).fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(h), error(0.5 * h));
        let seen = (coarse / fine).log2();
        assert!(fine < 1e-3 && seen > order - 0.5, "{solver}: {coarse} {fine}, order {seen}");
    }
    let mass = [1.0, 2.0, 1.5];
    let (start, end) = (run(&json, ("velocity-verlet", 2e-4), 0.0), run(&json, ("velocity-verlet", 2e-4), 2.0));
    assert!((start.energy - end.energy).abs() < 1e-5 * start.energy, "{} {}", start.energy, end.energy);
    for (a, b) in moments(&start, &mass).iter().zip(moments(&end, &mass)) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}
