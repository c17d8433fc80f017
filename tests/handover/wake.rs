//! What sleeps under its own method, or in a heap, wakes when something comes near, when it is edited, and when a pin moves.

use serde_json::{Value, json};
use wobble::sim::{Command, Dynamics, PointId, Selection, Solver, Why};

use super::{run_to, world};

/// Points of a disc.
const DISC: usize = 20;

fn disc(at: [f64; 2], velocity: [f64; 2]) -> Value {
    json!({"make": "disc", "radius": 0.3, "spacing": 0.15, "origin": at, "velocity": velocity,
        "material": {"kind": "spring", "stiffness": 2000, "damping": 3, "mass": 1}})
}

/// A block of 24 points on the floor.
fn block() -> Value {
    json!({"make": "lattice", "columns": 6, "rows": 4, "spacing": 0.1,
        "material": {"kind": "spring", "stiffness": 3000, "damping": 3, "mass": 1}})
}

fn on_a_floor(bodies: Value) -> Value {
    json!({"wobble": 1, "contact": true, "gravity": [0, -9.81], "bodies": bodies,
        "bounds": {"min": [-0.5, 0], "max": [0.7, 90], "friction": 0.5}})
}

fn height(world: &dyn Dynamics, points: std::ops::Range<usize>) -> f64 {
    let count = points.len() as f64;
    world.sample(world.time()).position[points].iter().map(|x| x[1]).sum::<f64>() / count
}

/// Whether points do not move at all for half a second.
fn is_still(world: &mut dyn Dynamics, points: std::ops::Range<usize>) -> bool {
    let places = |world: &dyn Dynamics| world.sample(world.time()).position[points.clone()].to_vec();
    let before = places(world);
    let end = world.time() + 0.5;
    run_to(world, end);
    before == places(world)
}

#[test]
fn what_sleeps_under_its_own_method_is_woken_by_what_falls_on_it() {
    let mut world = world(&on_a_floor(json!([block(), disc([0.25, 40.0], [0.0; 2])])));
    run_to(&mut *world, 2.0);
    assert!(is_still(&mut *world, 0..24) && world.counters().hand_overs == 0);
    let [start, mut met] = [height(&*world, 0..24), f64::NAN];
    // 40 m take 2.8 s.
    while world.time() < 3.0 {
        let gap = height(&*world, 24..24 + DISC) - 0.3 - 0.3;
        world.step();
        if met.is_nan() && world.moved_by()[0].method == Solver::Live {
            met = gap;
        }
    }
    assert!(met > 0.0 && met < 1.0, "it went live {met} m before the touch");
    assert_eq!((world.moved_by().len(), world.moved_by()[0].why), (1, Why::Contact));
    run_to(&mut *world, 3.5);
    assert!((height(&*world, 0..24) - start).abs() > 0.01, "it is where it slept");
}

#[test]
fn what_sleeps_alone_in_space_is_woken_by_what_flies_at_it() {
    let mut world = world(&json!({"wobble": 1, "contact": true,
        "bodies": [disc([0.0, 3.0], [0.0; 2]), disc([6.0, 3.1], [-4.0, 0.0])]}));
    run_to(&mut *world, 0.6);
    assert!(is_still(&mut *world, 0..DISC) && world.counters().hand_overs == 0);
    run_to(&mut *world, 2.0);
    let end = world.sample(world.time());
    assert!(end.position[..DISC].iter().all(|x| x[0] < -1.0), "it is pushed away");
}

/// Two discs on each other in a shaft, asleep.
fn pile() -> Box<dyn Dynamics> {
    let mut world = world(&on_a_floor(json!([disc([0.0, 0.3], [0.0; 2]), disc([0.02, 0.92], [0.0; 2])])));
    run_to(&mut *world, 4.0);
    assert!(world.is_asleep() && world.moved_by()[0].method == Solver::Live, "{:?}", world.moved_by());
    world
}

#[test]
fn what_lay_on_a_body_that_is_taken_away_falls() {
    let mut world = pile();
    let upper = height(&*world, DISC..2 * DISC);
    let points = (0..DISC as u32).map(PointId).collect();
    world.apply(&Command::Delete(Selection { points, ..Selection::default() })).unwrap();
    run_to(&mut *world, 5.0);
    let fell = upper - height(&*world, DISC..2 * DISC);
    assert!(fell > 0.3, "{fell} m");
}

#[test]
fn what_sleeps_in_a_heap_is_woken_by_a_body_that_is_added_above_it() {
    let mut world = pile();
    let before = world.sample(world.time()).position[..2 * DISC].to_vec();
    let addition = wobble::sim::Addition {
        position: vec![[-0.1, 5.0, 0.0], [0.1, 5.0, 0.0], [0.0, 5.2, 0.0]],
        velocity: vec![[0.0, -5.0, 0.0]; 3],
        mass: vec![1.0; 3],
        bonds: [[0, 1], [1, 2], [2, 0]]
            .map(|ends| {
                let [a, b] = ends.map(|end| PointId(2 * DISC as u32 + end));
                let kind = wobble::sim::BondKind::Spring { stiffness: 2000.0, damping: 3.0 };
                wobble::sim::Bond { kind, ..wobble::sim::Bond::new(a, b, 0.2) }
            })
            .to_vec(),
        ..wobble::sim::Addition::default()
    };
    world.apply(&Command::Add(Box::new(addition))).unwrap();
    run_to(&mut *world, 4.2);
    assert_eq!(world.sample(world.time()).position[..2 * DISC], before, "it has not come yet");
    run_to(&mut *world, 5.0);
    let after = world.sample(world.time()).position;
    let moved = before.iter().zip(&after).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max);
    assert!(moved > 0.01, "{moved} m");
}

#[test]
fn what_sleeps_is_woken_by_a_pin_that_is_led_at_it() {
    let mut world = world(&json!({"wobble": 1, "contact": true, "bodies": [disc([0.0, 3.0], [0.0; 2])],
        "points": {"position": [[-5, 3]], "pinned": [0]},
        "pin_motion": [{"point": 0, "track": [[0, -5, 3], [2, -5, 3], [4, 5, 3]]}]}));
    run_to(&mut *world, 1.4);
    assert!(is_still(&mut *world, 1..1 + DISC) && world.counters().hand_overs == 0);
    run_to(&mut *world, 4.0);
    assert_eq!(world.counters().hand_overs, 1);
    let end = world.sample(world.time());
    assert!(end.position[1..].iter().all(|x| x[0] > 4.0), "the pin pushed it along");
}

#[test]
fn what_hung_asleep_falls_when_its_pin_is_taken_out() {
    let mut hung = disc([0.0, 3.0], [0.0; 2]);
    hung["pinned"] = json!((0..DISC).collect::<Vec<_>>());
    let mut world = world(&on_a_floor(json!([hung, disc([0.0, 0.3], [0.0; 2])])));
    run_to(&mut *world, 1.0);
    assert!(is_still(&mut *world, 0..DISC));
    world.apply(&Command::Unpin((0..DISC as u32).map(PointId).collect())).unwrap();
    run_to(&mut *world, 4.0);
    let [upper, lower] = [height(&*world, 0..DISC), height(&*world, DISC..2 * DISC)];
    assert!(upper < 1.2 && upper - lower > 0.3, "it lies on the other: {upper} m, {lower} m");
}
