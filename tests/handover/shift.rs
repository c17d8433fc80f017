//! A hand-over moves no point by more than a thousandth of its body: where points are after a step in which somebody else takes over,
//! beside where whoever moved them until then takes them in that very step. What is past mending goes back to where the frame began and
//! is taken from there by the live step: it is compared with a world that the live step moves from there.

use std::ops::Range;
use std::slice;

use serde_json::{Value, json};
use wobble::sim::{Command, Dynamics, Method, Sample, SceneChange, Solver, Why, frame_of};

use super::{abuse, across_a_wall, heavy, with, world};

/// What changed in a step.
#[derive(Debug)]
struct Change {
    #[expect(dead_code, reason = "a test that fails prints it")]
    at: f64,
    /// Why what is live now is so; `None`: something went back.
    why: Option<Why>,
    /// How far it put a point at most, as a share of the body's size.
    shift: f64,
}

/// The largest distance between the places of points, over the size of the body that these are of: of all that hang together here.
fn shift(before: &Sample, after: &Sample, bodies: &[Range<usize>]) -> f64 {
    let of = |body: &Range<usize>| {
        let (old, new) = (&before.position[body.clone()], &after.position[body.clone()]);
        let far = old.iter().zip(new).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max);
        let span = |k: usize| {
            let ends = |(low, high): (f64, f64), x: &[f64; 3]| (low.min(x[k]), high.max(x[k]));
            let (low, high) = new.iter().fold((f64::INFINITY, f64::NEG_INFINITY), ends);
            high - low
        };
        far / span(0).hypot(span(1))
    };
    bodies.iter().map(of).fold(0.0, f64::max)
}

/// The changes of a run. A sample beyond the last step is what those who move the points then make of it: nobody is handed over there.
fn changes(world: &mut dyn Dynamics, bodies: &[Range<usize>], end: f64) -> Vec<Change> {
    let mut changes = Vec::new();
    let mut frame = world.boxed_clone();
    while world.time() < end {
        let expected = world.sample(world.time() + world.substep());
        if frame_of(world.time() + world.substep()) != frame_of(world.time()) {
            frame = world.boxed_clone();
        }
        let before = *world.counters();
        world.step();
        let after = *world.counters();
        let why = match (after.hand_overs > before.hand_overs, after.returns > before.returns) {
            (false, false) => continue,
            (false, true) => None,
            (true, _) => {
                world.moved_by().iter().filter(|moved| moved.method == Solver::Live).map(|moved| moved.why).next()
            }
        };
        let now = world.sample(world.time());
        let mut shift = shift(&expected, &now, bodies);
        if why == Some(Why::Alarm) {
            shift = shift.min(self::shift(&by_the_live_step(&*frame, world.time()), &now, bodies));
        }
        changes.push(Change { at: world.time(), why, shift });
    }
    changes
}

/// Where the live step takes a world until `t` [s].
fn by_the_live_step(world: &dyn Dynamics, t: f64) -> Sample {
    let mut other = world.boxed_clone();
    // In one step, as what is gone back to takes it.
    let method = Method { solver: Solver::Live, substep: Some(1.0 / 60.0), ..Method::default() };
    let change = SceneChange { method: Some(method), ..SceneChange::default() };
    other.apply(&Command::Set(wobble::sim::Change::Scene(Box::new(change)))).unwrap();
    while other.time() + other.substep() <= t * (1.0 + 1e-12) {
        other.step();
    }
    other.sample(t)
}

/// That there are changes for this reason, and that each puts points by less than a thousandth.
fn check(what: &str, changes: &[Change], why: Option<Why>) {
    check_within(1e-3, what, changes, why);
}

fn check_within(most: f64, what: &str, changes: &[Change], why: Option<Why>) {
    assert!(changes.iter().any(|change| change.why == why), "{what}, {why:?}: {changes:?}");
    assert!(changes.iter().all(|change| change.shift < most), "{what}: {changes:?}");
}

fn disc(at: [f64; 2], velocity: [f64; 2]) -> Value {
    json!({"make": "disc", "radius": 0.3, "spacing": 0.15, "origin": at, "velocity": velocity,
        "material": {"kind": "spring", "stiffness": 2000, "damping": 0.3, "mass": 1}})
}

#[test]
fn what_meets_stays_where_it_is_and_so_does_what_goes_back() {
    let scene = json!({"wobble": 1, "contact": true,
        "bodies": [disc([-2.0, 0.0], [2.0, 0.3]), disc([2.0, 0.1], [-2.0, 0.0])]});
    let mut world = world(&scene);
    let count = world.point_count() / 2;
    let bodies = [0..count, count..2 * count];
    let changes = changes(&mut *world, &bodies, 4.0);
    check("two discs", &changes, Some(Why::Contact));
    check("two discs", &changes, None);
}

#[test]
fn what_meets_as_it_falls_and_bounces_stays_where_it_is() {
    let bodies: Value = (0..4).map(|k| disc([0.05 * f64::from(k % 2), 0.35 + 0.65 * f64::from(k)], [0.0; 2])).collect();
    let mut world = world(&json!({"wobble": 1, "contact": true, "gravity": [0, -9.81], "bodies": bodies,
        "bounds": {"min": [-3, 0], "max": [3, 9], "friction": 0.5, "restitution": 0.5}}));
    let count = world.point_count() / 4;
    let bodies: Vec<Range<usize>> = (0..4).map(|k| k * count..(k + 1) * count).collect();
    check("discs that fall", &changes(&mut *world, &bodies, 3.0), Some(Why::Contact));
}

#[test]
fn what_an_alarm_hands_over_stays_where_it_is() {
    let mut net = world(&heavy());
    let count = net.point_count();
    // Past mending: it goes back by a frame. A thousandth is not reached there.
    check_within(
        2e-3,
        "a net with a heavy ball",
        &changes(&mut *net, slice::from_ref(&(0..count)), 1.0),
        Some(Why::Alarm),
    );
    // What begins across a wall is drawn in, by each method in its own way: where it goes back it stays.
    let mut pendulum = world(&across_a_wall());
    let count = pendulum.point_count();
    let mut found = changes(&mut *pendulum, slice::from_ref(&(0..count)), 1.2);
    found.retain(|change| change.why.is_none());
    check("a pendulum across a wall", &found, None);
}

#[test]
fn what_costs_too_much_stays_where_it_is() {
    // What gives up its step half way is taken on by the live step: a world without a budget says where its own method takes it.
    let scene = abuse("abuse/lat10s-g1000-e1");
    let [mut budget, mut without] = [world(&scene), world(&with(&scene, "budget", json!("none")))];
    let count = budget.point_count();
    while budget.counters().hand_overs == 0 {
        assert!(budget.time() < 1.0, "it was never handed over");
        budget.step();
    }
    while without.time() + without.substep() <= budget.time() * (1.0 + 1e-12) {
        without.step();
    }
    let [expected, now] = [without.sample(budget.time()), budget.sample(budget.time())];
    let why = budget.moved_by().first().map(|moved| moved.why);
    let shift = shift(&expected, &now, slice::from_ref(&(0..count)));
    check("a lattice", &[Change { at: budget.time(), why, shift }], Some(Why::Budget));
}
