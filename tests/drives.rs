//! Drives against closed forms: muscles, motors and servos, their work, their keys and their sleep.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use crate::common;

use serde_json::json;

use common::physics::{angular_momentum, momentum, run_to, spring};
use wobble::history::{Do, DriveOrNone, History, Log, SetKeys, Start, hash_now};
use wobble::scene::{AddKeys, BondKeys, DriveKeys, Scene};
use wobble::sim::{
    Angle, AngleDrive, Angles, Bond, Command, Drive, Held, Key, Method, Model, PointId, Signal, Solver, Wave, angle_at,
    build,
};

fn wave(period: f64) -> Signal {
    Signal { wave: Some(Wave { period, phase: 0.0 }), held: None }
}

fn key(name: &str) -> Key {
    Key::of(name).unwrap()
}

fn held(name: &str, rate: f64) -> Signal {
    Signal { held: Some(Held { forth: key(name), back: None, rate }), wave: None }
}

fn method(solver: Solver, substep: f64) -> Method {
    Method { solver, substep: Some(substep), ledger: true, ..Method::default() }
}

const STIFFNESS: f64 = 90.0;
const MASS: f64 = 2.0;
const PERIOD: f64 = 1.3;
const AMPLITUDE: f64 = 0.2;
const REST: f64 = 1.5;

/// A mass on a muscle that hangs from a pin, in the plane without gravity.
fn oscillator(method: Method) -> Model<2> {
    let drive = Some(Drive { amplitude: AMPLITUDE, signal: wave(PERIOD) });
    Model {
        position: vec![[0.3, 0.1], [0.3 + REST, 0.1]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0, MASS],
        pinned: vec![PointId(0)],
        bonds: [Bond { drive, ..spring(0, 1, REST, STIFFNESS, 0.0) }].into(),
        method,
        ..Model::default()
    }
}

/// Where the mass is at a time, from its start [m]: u'' = -w^2 (u - A sin(f t)), u = u' = 0 at 0.
fn forced(t: f64) -> f64 {
    let (w, f) = ((STIFFNESS / MASS).sqrt(), std::f64::consts::TAU / PERIOD);
    AMPLITUDE * REST * w * w / (w * w - f * f) * ((f * t).sin() - f / w * (w * t).sin())
}

#[test]
fn a_mass_on_a_muscle_is_a_forced_oscillator_to_the_order_of_each_method() {
    let t = 2.0;
    let error = |solver: Solver, h: f64| {
        let sample = run_to(&mut *build(&oscillator(method(solver, h))).unwrap(), t);
        (sample.position[1][0] - 0.3 - REST - forced(t)).abs()
    };
    for (solver, h, most, order) in [
        (Solver::SymplecticEuler, 1e-3, 5e-3, 1.0),
        (Solver::Euler, 1e-4, 5e-3, 1.0),
        (Solver::BackwardEuler, 1e-4, 5e-3, 1.0),
        (Solver::Live, 1e-3, 5e-3, 1.0),
        (Solver::Verlet, 4e-3, 2e-4, 2.0),
        (Solver::VelocityVerlet, 4e-3, 2e-4, 2.0),
        (Solver::Rk2, 4e-3, 5e-4, 2.0),
        (Solver::ImplicitMidpoint, 4e-3, 2e-4, 2.0),
        (Solver::Pefrl, 0.02, 1e-5, 4.0),
        (Solver::BlanesMoan4, 0.02, 1e-5, 4.0),
        (Solver::Rk4, 0.02, 1e-5, 4.0),
        (Solver::BlanesMoan6, 0.05, 1e-6, 6.0),
        (Solver::Rk8, 0.1, 1e-6, 8.0),
    ] {
        let [coarse, fine] = [h, 0.5 * h].map(|h| error(solver, h));
        let found = (coarse / fine).log2();
        assert!(coarse < most && found > 0.75 * order, "{solver}: {coarse} {fine}, order {found}");
    }
    let usual = Method { sleeps: false, ..Method::default() };
    let sample = run_to(&mut *build(&oscillator(usual)).unwrap(), t);
    assert!((sample.position[1][0] - 0.3 - REST - forced(t)).abs() < 1e-4);
}

#[test]
fn energy_less_the_work_of_a_muscle_stays() {
    for (solver, h, share) in [
        (Solver::Rk4, 2e-3, 1e-8),
        (Solver::Pefrl, 2e-3, 1e-6),
        (Solver::VelocityVerlet, 1e-3, 1e-4),
        (Solver::Live, 2.5e-4, 7e-3),
    ] {
        let ledger = run_to(&mut *build(&oscillator(method(solver, h))).unwrap(), 3.2).ledger.unwrap();
        // Of u = forced(t) against the spring of its own rest length.
        let speed = (forced(3.2 + 1e-6) - forced(3.2 - 1e-6)) / 2e-6;
        let truth = 0.5 * MASS * speed * speed + 0.5 * STIFFNESS * forced(3.2) * forced(3.2);
        let size = ledger.most_kinetic;
        assert!((ledger.book.drives - truth).abs() < 2.0 * share * size, "{solver}: {ledger:?}, work {truth}");
        assert!(size > 1.0 && ledger.left_over().abs() < share * size, "{solver}: {ledger:?}");
    }
}

/// Two masses on a rigid muscle that turn about their middle.
fn skaters(substep: f64, signal: Signal) -> Model<2> {
    let drive = Some(Drive { amplitude: -0.4, signal });
    Model {
        position: vec![[-1.0, 0.0], [1.0, 0.0]],
        velocity: vec![[0.0, -1.5], [0.0, 1.5]],
        mass: vec![2.0; 2],
        bonds: [Bond { drive, ..Bond::new(PointId(0), PointId(1), 2.0) }].into(),
        method: Method { budget: Some(6.0), ..method(Solver::Auto, substep) },
        ..Model::default()
    }
}

#[test]
fn skaters_that_draw_each_other_near_turn_faster_and_their_work_is_booked() {
    let run = |substep: f64| {
        let mut world = build(&skaters(substep, held("space", 2.0))).unwrap();
        world.apply(&Command::Key { key: key("space"), down: true }).unwrap();
        let sample = run_to(&mut *world, 1.5);
        let [a, b] = [0, 1].map(|i| sample.position[i]);
        let length = (a[0] - b[0]).hypot(a[1] - b[1]);
        assert!((length - 1.2).abs() < 1e-4 && sample.max_strain < 1e-4, "{length} m");
        assert!(momentum(&sample, &[2.0; 2]).iter().all(|p| p.abs() < 1e-9));
        let spin = angular_momentum(&sample, &[2.0; 2])[2];
        (spin, sample.ledger.unwrap())
    };
    let [(spin, ledger), (finer, fine)] = [1e-3, 5e-4].map(run);
    // 2 m r v = 6 kg m^2/s stays, so the energy grows by (2/1.2)^2.
    assert!((spin - 6.0).abs() < 0.15 && (finer - 6.0).abs() < 0.6 * (spin - 6.0).abs(), "{spin} {finer}");
    let work = 0.5 * 4.0 * 1.5 * 1.5 * ((2.0_f64 / 1.2).powi(2) - 1.0);
    let [off, less] = [ledger, fine].map(|ledger| (ledger.book.drives - work).abs());
    assert!(off < 0.1 * work && less < 0.6 * off, "{off} J, {less} J off {work} J");
    assert!(ledger.left_over().abs() < 0.01 * work, "{ledger:?}");
}

/// A wheel of one point on a bond about a pin, and a motor between it and another pin.
fn wheel(method: Method, motor: AngleDrive, bond: Bond) -> Model<2> {
    let position = vec![[1.0, 0.0], [0.0, 0.0], [0.0, -0.5]];
    let points = [0, 1, 2].map(PointId);
    let angle = angle_at(points, points.map(|point| position[point.index()]));
    Model {
        position,
        velocity: vec![[0.0; 2]; 3],
        mass: vec![1.0, 1.0, 3.0],
        pinned: vec![PointId(0), PointId(1)],
        bonds: [bond].into(),
        angles: Angles::of(vec![Angle { drive: Some(motor), ..angle }]),
        method,
        ..Model::default()
    }
}

#[test]
fn a_motor_winds_a_wheel_up_with_all_its_torque_then_holds_its_speed() {
    let motor = AngleDrive::Motor { speed: -8.0, torque: 1.5, signal: Signal::default() };
    let inertia = 3.0 * 0.25;
    let rate = |x: [f64; 3], v: [f64; 3]| (x[0] * v[1] - x[1] * v[0]) / (x[0] * x[0] + x[1] * x[1]);
    for (solver, h, tolerance) in [
        (Solver::Auto, None, 1e-3),
        (Solver::VelocityVerlet, Some(1e-3), 1e-4),
        (Solver::Rk4, Some(2e-3), 1e-7),
        (Solver::Live, Some(1e-3), 1.5e-2),
    ] {
        let method = Method { solver, substep: h, ledger: true, ..Method::default() };
        let mut world = build(&wheel(method, motor, Bond::new(PointId(1), PointId(2), 0.5))).unwrap();
        // Until 95 % of 8 rad/s are reached, after 3.8 s.
        let early = run_to(&mut *world, 2.0);
        let omega = rate(early.position[2], early.velocity[2]);
        assert!((omega + 1.5 / inertia * 2.0).abs() < 8.0 * tolerance, "{solver}: {omega}");
        let late = run_to(&mut *world, 8.0);
        let omega = rate(late.position[2], late.velocity[2]);
        assert!((omega + 8.0).abs() < 8.0 * tolerance, "{solver}: {omega}");
        let ledger = late.ledger.unwrap();
        if solver == Solver::Live {
            // A rod that turns loses energy by its own order.
            continue;
        }
        let energy = 0.5 * inertia * 64.0;
        assert!((ledger.book.drives - energy).abs() < 10.0 * tolerance * energy, "{solver}: {ledger:?}");
        assert!(ledger.left_over().abs() < 10.0 * tolerance * energy, "{solver}: {ledger:?}");
    }
}

#[test]
fn a_servo_brings_its_angle_along_and_a_motor_lifts_no_more_than_it_can() {
    let servo = AngleDrive::Servo { amplitude: 0.7, signal: held("d", 3.0) };
    let mut model = wheel(Method::default(), servo, spring(1, 2, 0.5, 4000.0, 40.0));
    model.angles.list[0] = Angle { stiffness: 60.0, damping: 6.0, ..model.angles.list[0] };
    let mut world = build(&model).unwrap();
    world.apply(&Command::Key { key: key("d"), down: true }).unwrap();
    let turned = |x: [f64; 3]| x[1].atan2(x[0]) + std::f64::consts::FRAC_PI_2;
    let found = turned(run_to(&mut *world, 6.0).position[2]);
    assert!((found - 0.7).abs() < 1e-3, "{found} rad");
    world.apply(&Command::Key { key: key("d"), down: false }).unwrap();
    let found = turned(run_to(&mut *world, 12.0).position[2]);
    assert!(found.abs() < 1e-3, "{found} rad");
    // A weight of 3 kg at 0.5 m asks for 14.7 N m at the most: 10 hold it where they balance.
    let motor = AngleDrive::Motor { speed: 2.0, torque: 10.0, signal: Signal::default() };
    let stalled = Model {
        drag_rate: 3.0,
        gravity: [0.0, -9.81],
        ..wheel(Method::default(), motor, Bond::new(PointId(1), PointId(2), 0.5))
    };
    let found = turned(run_to(&mut *build(&stalled).unwrap(), 8.0).position[2]);
    assert!((found - (10.0_f64 / (3.0 * 0.5 * 9.81)).asin()).abs() < 1e-3, "{found} rad");
}

#[test]
fn a_motor_that_presses_against_its_stop_spins_nothing_up() {
    // Two boxes in a joint, free in space, whose motor turns them against each other until it is at the end of its range.
    let scene = r#"{ "wobble": 1,
        "points": { "position": [[0,0],[1,0],[2,0],[0.2,0.25],[0.8,0.25],[0.2,-0.25],[0.8,-0.25],[1.2,0.25],[1.8,0.25],[1.2,-0.25],
                                 [1.8,-0.25]],
                    "mass": [1,1,1,1,1,1,1,49,49,49,49] },
        "bonds": [{"a":0,"b":3},{"a":0,"b":5},{"a":3,"b":4},{"a":3,"b":5},{"a":4,"b":5},{"a":5,"b":6},{"a":4,"b":6},{"a":4,"b":1},
                  {"a":6,"b":1},{"a":1,"b":7},{"a":1,"b":9},{"a":7,"b":8},{"a":7,"b":9},{"a":8,"b":9},{"a":9,"b":10},{"a":8,"b":10},
                  {"a":8,"b":2},{"a":10,"b":2}],
        "triangles": [[0,3,5],[3,4,5],[4,5,6],[4,6,1],[1,7,9],[7,8,9],[8,9,10],[8,10,2]], "contact": true,
        "angles": [{ "points": [0,1,2], "min": 1.5, "max": 4.7, "drive": { "speed": 5, "torque": 2450 } }] }"#;
    let scene = Scene::parse(scene, "stopped").unwrap();
    let mut world = build(&scene.model::<2>().unwrap()).unwrap();
    let masses = world.masses().to_vec();
    let sample = run_to(&mut *world, 3.0);
    let turned = angular_momentum(&sample, &masses)[2];
    assert!(turned.abs() < 1.0, "{turned} kg m^2/s, of a motor of 2,450 N m");
    let [x, _, y] = [0, 1, 2].map(|i| sample.position[i]);
    assert!((x[0] - y[0]).hypot(x[1] - y[1]) < 1.8, "it is at its stop: {x:?} {y:?}");
}

#[test]
fn a_keyed_muscle_sleeps_until_its_key_and_one_that_moves_never() {
    let sleepy = Method { sleeps: true, budget: Some(6.0), ..Method::default() };
    let mut model = oscillator(sleepy);
    model.bonds = [Bond {
        drive: Some(Drive { amplitude: 0.2, signal: held("right", 5.0) }),
        ..spring(0, 1, REST, STIFFNESS, 60.0)
    }]
    .into();
    let mut world = build(&model).unwrap();
    run_to(&mut *world, 1.0);
    assert!(world.is_asleep(), "at rest");
    world.apply(&Command::Key { key: key("right"), down: true }).unwrap();
    assert!(!world.is_asleep(), "the key wakes it");
    let sample = run_to(&mut *world, 8.0);
    assert!((sample.position[1][0] - 0.3 - 1.2 * REST).abs() < 1e-3 && world.is_asleep(), "{:?}", sample.position[1]);
    let mut moving = build(&oscillator(Method { sleeps: true, ..sleepy })).unwrap();
    run_to(&mut *moving, 3.0);
    assert!(!moving.is_asleep());
}

fn history(scene: &str) -> History {
    History::new(Start::from(Scene::load(scene).unwrap())).unwrap()
}

fn give(history: &mut History, act: Do, edit: Option<&str>) {
    history.give(vec![act], edit).unwrap();
}

fn steps(history: &mut History, until: f64) -> String {
    while history.world().time() < until - 1e-9 {
        history.step();
    }
    hash_now(history.world(), history.world().time())
}

#[test]
fn keys_are_commands_of_the_log_which_runs_again_from_anywhere() {
    let mut live = history("walker");
    steps(&mut live, 0.5);
    give(&mut live, Do::Key { key: key("right"), down: true }, None);
    steps(&mut live, 0.6);
    let drive = DriveKeys { amplitude: Some(0.1), period: Some(0.5), ..DriveKeys::default() };
    let set = SetKeys { bonds: Some(vec![0]), drive: Some(DriveOrNone::This(drive)), ..SetKeys::default() };
    give(&mut live, Do::Set(Box::new(set)), Some("muscle"));
    assert!(live.world().bonds().get(0).drive.is_some());
    let middle = steps(&mut live, 2.0);
    give(&mut live, Do::Key { key: key("right"), down: false }, None);
    let late = steps(&mut live, 3.0);
    live.go_to(2.0);
    assert_eq!(hash_now(live.world(), 2.0), middle, "rewound");
    live.go_to(1.5);
    assert_eq!(live.letting_go().len(), 1, "nobody holds the key any more");
    let mut text = Vec::new();
    live.go_to(3.0);
    let made = live.recording();
    made.write_json(&mut text).unwrap();
    let read = Log::of_text(std::str::from_utf8(&text).unwrap(), "x").unwrap();
    let mut again = History::new(Start::from(read.recording().unwrap())).unwrap();
    again.go_to(3.0);
    assert_eq!(hash_now(again.world(), 3.0), late, "from its file");
    live.undo().unwrap();
    assert!(live.world().bonds().get(0).drive.is_none());
}

#[test]
fn a_state_in_the_middle_of_a_ramp_goes_on_with_it() {
    let scene = r#"{"wobble": 1, "points": {"position": [[0,0],[1,0]], "pinned": [0]}, "bonds": [{"a": 0, "b": 1, "kind": "spring",
        "stiffness": 90, "drive": {"amplitude": 0.4, "key": "right", "rate": 2}}]}"#;
    let mut live = History::new(Start::from(Scene::parse(scene, "x").unwrap())).unwrap();
    steps(&mut live, 0.5);
    give(&mut live, Do::Key { key: key("right"), down: true }, None);
    steps(&mut live, 0.7);
    let mut on = History::new(Start::from(live.snapshot().unwrap())).unwrap();
    assert_eq!(on.world().held_keys(), [key("right")]);
    let place = |history: &History| history.world().sample(1.0).position[1][0];
    for history in [&mut live, &mut on] {
        steps(history, 1.0);
    }
    assert!((place(&on) - place(&live)).abs() < 1e-9 && place(&on) > 1.3, "{} {}", place(&on), place(&live));
}

#[test]
fn muscles_whose_ends_other_rigid_bonds_hold_are_left_out_and_move_nothing() {
    // Two braced squares side by side, all bonds between them muscles that are out of step: one more than the squares have motions.
    let scene = |with_second: bool| {
        let muscle = |a: u32, b: u32| {
            let phase = 0.9 * f64::from(a + b);
            json!({ "a": a, "b": b, "drive": { "amplitude": 0.2, "period": 0.7, "phase": phase } })
        };
        let firm = [[0, 1], [2, 3], [0, 2], [1, 3], [0, 3], [1, 2], [4, 5], [6, 7], [4, 6], [5, 7], [4, 7], [5, 6]];
        let all = firm.map(|[a, b]: [u32; 2]| json!({ "a": a, "b": b })).into_iter();
        let all = all.chain([muscle(1, 4), muscle(3, 6), muscle(1, 6)]).chain(with_second.then(|| muscle(3, 4)));
        json!({ "wobble": 1, "points": { "position": [[0,1],[1,1],[0,2],[1,2],[2,1],[3,1],[2,2],[3,2]] },
            "gravity": [0, 0], "bonds": all.collect::<Vec<_>>() })
    };
    let parsed = |keys: &serde_json::Value| Scene::parse(&keys.to_string(), "x.json").unwrap();
    let is_said = |words: &[String], numbers: &str| {
        words.iter().any(|word| word.contains("move nothing") && word.contains(numbers))
    };
    let mut held = parsed(&scene(true)).world(None).unwrap();
    assert!(is_said(held.warnings(), "bonds 12, 13, 14 and 15"), "{:?}", held.warnings());
    run_to(&mut *held, 0.5);
    assert!(held.energy() < 1e-9, "{}", held.energy());
    // As many as they have motions are muscles, until a bond comes that holds them.
    let mut history = History::new(Start::from(parsed(&scene(false)))).unwrap();
    assert!(history.world().warnings().is_empty() && history.world().bonds().get(14).drive.is_some());
    steps(&mut history, 0.2);
    let brace = AddKeys { bonds: vec![BondKeys::new(3, 4)], ..AddKeys::default() };
    give(&mut history, Do::Add(Box::new(brace)), Some("brace"));
    assert!(is_said(history.world().warnings(), "bonds 12, 13 and 14"), "{:?}", history.world().warnings());
    assert!((0..16).all(|k| history.world().bonds().get(k).drive.is_none()));
    steps(&mut history, 0.5);
    history.undo().unwrap();
    assert!(history.world().bonds().get(14).drive.is_some());
    // On a pin that something else hangs on too, far from the origin.
    let pinned = json!({ "wobble": 1, "gravity": [0, 0], "points": { "position": [[10,10],[9,10],[11,10],[11,11],[10,11]], "pinned": [0] },
        "bonds": [{ "a": 0, "b": 1 }, { "a": 0, "b": 2 }, { "a": 2, "b": 3 }, { "a": 3, "b": 4 }, { "a": 4, "b": 0 },
            { "a": 0, "b": 3, "drive": { "amplitude": 0.2, "period": 0.7 } }] });
    let mut history = History::new(Start::from(parsed(&pinned))).unwrap();
    let brace = AddKeys { bonds: vec![BondKeys::new(2, 4)], ..AddKeys::default() };
    give(&mut history, Do::Add(Box::new(brace)), Some("brace"));
    assert!((history.world().bonds().get(5).rest_length - 2_f64.sqrt()).abs() < 1e-9);
    steps(&mut history, 0.5);
    assert!(history.world().energy() < 1e-9, "{}", history.world().energy());
}

#[test]
fn what_no_drive_can_be_is_refused_with_a_cure() {
    let scene = |bond: &str, angle: &str, method: &str| {
        format!(
            "{{\"wobble\": 1, \"points\": {{\"position\": [[0,0],[1,0],[1,1]]}}, \"bonds\": [{{\"a\": 0, \"b\": 1{bond}}}], \
             \"angles\": [{{\"points\": [0,1,2]{angle}}}]{method}}}"
        )
    };
    let spring = ", \"kind\": \"spring\", \"stiffness\": 5, \"drive\": ";
    let said = |text: &str| match Scene::parse(text, "x.json") {
        Err(error) => error.to_string(),
        Ok(scene) => scene.world(None).err().map_or_else(String::new, |error| error.to_string()),
    };
    for (bond, angle, method, words) in [
        (format!("{spring}{{\"period\": 1}}"), "", "", "the key `amplitude` is missing"),
        (format!("{spring}{{\"amplitude\": 2, \"period\": 1}}"), "", "", "from -0.9 to 0.9"),
        (format!("{spring}{{\"amplitude\": 0.2}}"), "", "", "follows nothing"),
        (format!("{spring}{{\"amplitude\": 0.2, \"period\": 1, \"frequency\": 1}}"), "", "", "its reciprocal"),
        (format!("{spring}{{\"amplitude\": 0.2, \"period\": 0.001}}"), "", "", "from 0.02 to 1000000 s"),
        (format!("{spring}{{\"amplitude\": 0.2, \"key\": \"rigth\"}}"), "", "", "right"),
        (format!("{spring}{{\"amplitude\": 0.2, \"period\": 1, \"back\": \"a\"}}"), "", "", "stands without `key`"),
        (format!("{spring}{{\"speed\": 2, \"torque\": 1}}"), "", "", "is a key of a motor"),
        (
            ", \"limit\": \"max\", \"drive\": {\"amplitude\": 0.1, \"period\": 1}".to_owned(),
            "",
            "",
            "leave `limit` or `drive` out",
        ),
        (String::new(), ", \"drive\": {\"speed\": 2}", "", "the key `torque` is missing"),
        (String::new(), ", \"drive\": {\"speed\": 2, \"torque\": 0}", "", "give a number above 0"),
        (String::new(), ", \"drive\": {\"amplitude\": 1, \"period\": 1}", "", "give the angle a `stiffness`"),
        (
            ", \"drive\": {\"amplitude\": 0.1, \"period\": 1}".to_owned(),
            "",
            ", \"method\": {\"solver\": \"rk4\"}",
            "solver rk4 moves no rigid bond by a drive",
        ),
        (
            String::new(),
            ", \"drive\": {\"speed\": 2, \"torque\": 1}",
            ", \"method\": {\"solver\": \"backward-euler\"}",
            "solver backward-euler knows no motors",
        ),
    ] {
        let found = said(&scene(&bond, angle, method));
        assert!(found.contains(words), "{bond} {angle} {method}: {found}");
    }
}
