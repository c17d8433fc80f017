//! Islands that go from their own methods to the live step, by budget and on alarms, and back.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod lost;
mod meet;
mod shift;
mod wake;
mod whip;
mod wild;

use std::path::Path;

use serde_json::{Value, json};
use wobble::scene::{Scene, schema};
use wobble::sim::{
    Change, Command, Dynamics, Ledger, Method, MovedBy, PointId, SceneChange, Solver, Why, frame_of, judge,
};

/// Counted work of a frame that a scene is held to [ms].
const FRAME: f64 = 8.0;

fn scene(value: &Value) -> Scene {
    Scene::parse(&value.to_string(), "scene").unwrap()
}

fn world(value: &Value) -> Box<dyn Dynamics> {
    scene(value).world(None).unwrap()
}

fn with(value: &Value, key: &str, what: Value) -> Value {
    let mut changed = value.clone();
    changed["method"][key] = what;
    changed
}

fn abuse(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/files/{name}.json"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// What a frame of a run took, and who moved what at its end.
struct Frame {
    /// Counted work [ms].
    work: f64,
    hand_overs: u64,
    moved: Vec<MovedBy>,
}

/// Runs to `end` [s] and notes every frame; the ledger too, where one is kept.
fn frames(world: &mut dyn Dynamics, end: f64) -> (Vec<Frame>, Vec<Ledger>) {
    let (mut frames, mut entries) = (Vec::new(), Vec::new());
    entries.extend(world.sample(world.time()).ledger);
    let (mut work, mut hand_overs) = (0.0, 0);
    while world.time() < end - 1e-9 {
        let before = *world.counters();
        world.step();
        work += world.counters().work_ms() - before.work_ms();
        hand_overs += world.counters().hand_overs - before.hand_overs;
        if frame_of(world.time() + world.substep()) != frame_of(world.time()) {
            frames.push(Frame { work, hand_overs, moved: world.moved_by() });
            entries.extend(world.sample(world.time()).ledger);
            (work, hand_overs) = (0.0, 0);
        }
    }
    (frames, entries)
}

fn bits(world: &dyn Dynamics) -> Vec<u64> {
    let sample = world.sample(world.time());
    sample.position.iter().chain(&sample.velocity).flatten().map(|x| x.to_bits()).collect()
}

fn run_to(world: &mut dyn Dynamics, end: f64) {
    while world.time() < end - 1e-9 {
        world.step();
    }
}

/// A net of rigid bonds with a ball 10,000 times as heavy, whose own method makes energy: its upper row is all but taut, a pin being 0.1 um nearer.
fn heavy() -> Value {
    let mut scene = abuse("abuse/net12-ball-rigid-10000");
    let pin = scene["points"]["pinned"][1].as_u64().unwrap();
    let place = |scene: &Value, i: u64, k: usize| scene["points"]["position"][i as usize][k].as_f64().unwrap();
    for k in 0..scene["bonds"].as_array().unwrap().len() {
        let [a, b] = ["a", "b"].map(|end| scene["bonds"][k][end].as_u64().unwrap());
        if [a, b].contains(&pin) {
            let [x, y] = [0, 1].map(|axis| place(&scene, a, axis) - place(&scene, b, axis));
            scene["bonds"][k]["rest"] = json!(x.hypot(y));
        }
    }
    scene["points"]["position"][pin as usize][0] = json!(place(&scene, pin, 0) - 1e-7);
    scene
}

/// A rope of springs that hangs from a pin, free of all that could go wrong.
fn rope(at: f64) -> Value {
    json!({"make": "rope", "count": 8, "spacing": 0.2, "origin": [at, 0], "pinned": [0],
        "material": {"kind": "spring", "stiffness": 4000, "damping": 1}})
}

/// A rope, and a lattice of this stiffness [N/m] that falls on a floor, which a mouse goes through.
fn among_walls(stiffness: f64) -> Value {
    json!({"wobble": 1, "gravity": [0, -9.81],
        "bodies": [rope(0.0), {"make": "lattice", "columns": 4, "rows": 4, "spacing": 0.2, "origin": [2, 0.3],
            "material": {"kind": "spring", "stiffness": stiffness, "damping": 2}}],
        "mouse": {"strength": 60, "radius": 1, "track": [[0, -2, 0], [1, 3, 0.5]]},
        "bounds": {"min": [-5, -2], "max": [5, 3], "restitution": 0.5, "friction": 0.3}})
}

#[test]
fn a_crowd_that_is_sure_to_take_too_much_does_not_begin() {
    let bodies = |count: usize| {
        let disc = |k: usize| {
            json!({"make": "disc", "radius": 0.3, "spacing": 0.06, "origin": [k, 0],
            "material": {"kind": "spring", "stiffness": 2000, "damping": 2, "mass": 1}})
        };
        json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": (0..count).map(disc).collect::<Vec<_>>()})
    };
    let begins = |count: usize| {
        let mut world = world(&bodies(count));
        let live = world.moved_by().iter().filter(|moved| moved.why == Why::Budget).map(|moved| moved.count).sum();
        run_to(&mut *world, 1.0 / 60.0);
        (live, world.counters().work)
    };
    let (one, alone) = begins(1);
    assert_eq!(one, 0, "one is moved by its own method");
    let (live, work): (usize, u64) = begins(300);
    assert!(live > 0, "of three hundred most are live from the first step on");
    assert!(work < 100 * alone, "{work} operations in a frame of all, {alone} in one of one");
}

#[test]
fn within_the_budget_the_bits_are_those_without_one() {
    let scene = among_walls(6000.0);
    let mut with_budget = world(&scene);
    let mut without = world(&with(&scene, "budget", json!("none")));
    run_to(&mut *with_budget, 2.0);
    run_to(&mut *without, 2.0);
    assert_eq!(bits(&*with_budget), bits(&*without));
    assert_eq!(
        (with_budget.counters().hand_overs, with_budget.counters().guard_splits),
        (0, without.counters().guard_splits)
    );
    assert!(with_budget.moved_by().iter().all(|moved| moved.why == Why::Plan && moved.since == 0.0));
}

/// A lattice so soft that the floor folds it, and its own springs hold it so.
#[test]
fn what_stays_inside_out_is_led_back() {
    let scene = among_walls(2000.0);
    let inside_out = |budget: Value| {
        let mut world = world(&with(&scene, "budget", budget));
        run_to(&mut *world, 4.0);
        let place = world.sample(world.time()).position;
        let size = |corners: &[PointId; 3]| {
            let [a, b, c] = corners.map(|corner| place[corner.index()]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        world.triangles().iter().filter(|corners| size(corners) <= 0.0).count()
    };
    assert!(inside_out(json!("none")) > 0);
    assert_eq!(inside_out(json!(6)), 0);
}

#[test]
fn scenes_that_cost_too_much_or_explode_stay_within_their_frames_and_keep_their_energy() {
    let scenes = [
        "abuse/comb20-rigid",
        "abuse/lat10s-g1000-e1",
        "abuse/net12-ball-rigid-10000",
        "abuse/random-12",
        "abuse/random-157",
        "abuse/random-189",
        "abuse/random-239",
        "abuse/rope1000-spring-v200-e1",
        "abuse/pendulum-across-a-wall",
        "abuse/rope-between-elastic-walls",
        "abuse/lattice-dropped-hard",
    ];
    let known: Vec<Value> = serde_json::from_str(include_str!("files/known/known.json")).unwrap();
    let judged: Vec<Value> = serde_json::from_str(include_str!("files/abuse/judged.json")).unwrap();
    let is_long = |name: &str| {
        let of =
            |entry: &&Value| name.strip_prefix("abuse/").is_some_and(|name| entry["file"] == format!("{name}.json"));
        judged.iter().find(of).is_some_and(|entry| entry["now"].as_array().unwrap().contains(&json!("frame")))
    };
    let mut wrong = Vec::new();
    for name in scenes {
        let mut world = world(&with(&abuse(name), "ledger", json!(true)));
        let (frames, entries) = frames(&mut *world, 1.0);
        let worst = frames.iter().filter(|frame| frame.hand_overs == 0).map(|frame| frame.work).fold(0.0, f64::max);
        let over = frames.iter().map(|frame| frame.work).fold(0.0, f64::max);
        let verdict = judge(&entries);
        let moved: Vec<&str> = frames.iter().flat_map(|frame| &frame.moved).map(|moved| moved.why.name()).collect();
        let is_live = moved.iter().any(|why| *why != "plan");
        let line = format!("{name}: frames {worst:.2} ms, with a hand-over {over:.2}, {verdict:?}, live {is_live}");
        let may_gain =
            known.iter().any(|entry| entry["file"] == format!("../{name}.json") && entry["fault"] == "energy gained");
        let most = if is_long(name) { 1.2 * FRAME } else { FRAME };
        if worst > most || !world.is_finite() || (verdict.gains() && !may_gain) {
            wrong.push(line);
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_fails_goes_live_and_the_rest_stays_bit_for_bit() {
    let mut beside = heavy();
    beside["bodies"].as_array_mut().unwrap().push(rope(100.0));
    // Walls hold both: a rope outside them would be drawn in, which is violent.
    beside["bounds"]["max"] = json!([200, 4]);
    let mut both = world(&beside);
    let mut without = world(&with(&beside, "budget", json!("none")));
    let (frames, _) = frames(&mut *both, 0.5);
    run_to(&mut *without, 0.5);
    let last = frames.last().unwrap();
    let [net, rope] = &last.moved[..] else { panic!("{:?}", last.moved) };
    assert_eq!((net.method, net.why), (Solver::Live, Why::Alarm));
    assert_eq!((rope.why, rope.since, rope.count), (Why::Plan, 0.0, 7));
    let of_rope = |world: &dyn Dynamics| world.sample(0.5).position[rope.first.index()..].to_vec();
    assert_eq!(of_rope(&*both), of_rope(&*without));
}

#[test]
fn calm_bodies_get_no_alarm_wherever_they_are() {
    for (at, gravity) in [([0.0, 0.0], -9.81), ([900.0, 0.0], -9.81), ([0.0, 900.0], -1e-3), ([900.0, 0.0], 0.0)] {
        for precision in ["f64", "f32"] {
            let mut hung = rope(at[0]);
            hung["origin"] = json!(at);
            let mut world = world(&json!({"wobble": 1, "gravity": [0, gravity], "method": {"precision": precision},
                "bodies": [hung], "bounds": {"min": [-1000, -1000], "max": [1000, 1000]}}));
            run_to(&mut *world, 1.0);
            let moved = world.moved_by();
            assert!(moved.iter().all(|moved| moved.why == Why::Plan), "{at:?}, {gravity}, {precision}: {moved:?}");
        }
    }
}

#[test]
fn the_same_bits_come_from_a_copy_that_was_taken_while_live() {
    let mut one = world(&heavy());
    run_to(&mut *one, 0.2);
    assert!(one.moved_by().iter().any(|moved| moved.method == Solver::Live));
    let mut copy = one.boxed_clone();
    run_to(&mut *one, 0.4);
    run_to(&mut *copy, 0.4);
    assert_eq!(bits(&*one), bits(&*copy));
}

#[test]
fn a_state_that_is_kept_knows_what_is_live() {
    let mut world = world(&heavy());
    run_to(&mut *world, 0.2);
    let live = world.moved_by();
    let mut again = wobble::sim::resume(&world.save().unwrap()).unwrap();
    assert_eq!(again.moved_by(), live);
    run_to(&mut *again, 0.3);
    assert!(again.is_finite() && again.moved_by()[0].method == Solver::Live);
}

/// A pendulum of so many rods that it is not moved as bodies in joints, and begins across a wall.
fn across_a_wall() -> Value {
    let mut scene = abuse("abuse/pendulum-across-a-wall");
    scene["bodies"][0]["count"] = json!(15);
    scene
}

#[test]
fn what_an_alarm_handed_over_goes_back_when_it_is_calm() {
    let mut world = world(&across_a_wall());
    let (frames, _) = frames(&mut *world, 1.2);
    let methods: Vec<(Solver, Why)> = frames.iter().map(|frame| (frame.moved[0].method, frame.moved[0].why)).collect();
    assert_eq!(methods[1], (Solver::Live, Why::Alarm));
    let last = frames.last().unwrap().moved[0];
    assert!(last.method != Solver::Live && last.why == Why::Plan && last.since > 0.9, "{last:?}");
    assert_eq!((world.counters().hand_overs, world.counters().returns), (1, 1));
}

#[test]
fn what_was_handed_over_is_made_exact_at_once_by_another_method() {
    let mut world = world(&heavy());
    run_to(&mut *world, 0.1);
    let live = world.moved_by();
    assert_eq!((live.len(), live[0].method, live[0].why), (1, Solver::Live, Why::Alarm), "{live:?}");
    let method = Method { sleeps: true, ..Method::default() };
    let change = SceneChange { method: Some(method), ..SceneChange::default() };
    world.apply(&Command::Set(Change::Scene(Box::new(change)))).unwrap();
    let exact = world.moved_by();
    let is_exact = exact[0].why == Why::Plan && exact[0].method != Solver::Live;
    assert!(is_exact && exact[0].since == world.time(), "{exact:?}");
    run_to(&mut *world, 1.0);
    assert_eq!(world.moved_by(), exact);
}

#[test]
fn budgets_that_are_none_get_their_line() {
    let cases = [
        (json!(0), "method.budget"),
        (json!(-1), "method.budget"),
        (json!("much"), "`much` is no budget"),
        (json!(true), "milliseconds of counted work"),
        (json!([6]), "milliseconds of counted work"),
        (Value::Null, "method.budget"),
    ];
    for (budget, words) in cases {
        let text = json!({"wobble": 1, "method": {"budget": budget}}).to_string();
        let error = Scene::parse(&text, "scene").and_then(|scene| scene.world(None).map(|_| ())).unwrap_err();
        assert!(error.to_string().contains(words) && error.to_string().lines().count() == 1, "{error}");
    }
    for budget in [json!("none"), json!(6), json!(0.5)] {
        let text = json!({"wobble": 1, "method": {"budget": budget}}).to_string();
        let scene = Scene::parse(&text, "scene").unwrap();
        assert_eq!(serde_json::to_value(&scene).unwrap()["method"]["budget"].as_f64(), budget.as_f64());
        assert_eq!(Scene::parse(&serde_json::to_string(&scene).unwrap(), "again").unwrap(), scene);
    }
    assert!(schema().to_string().contains("BudgetKeys"));
}
