//! What settles and sleeps, and what is told not to.

use serde_json::{Value, json};
use wobble::sim::Dynamics;

use super::{disc, run};

/// A disc that fell on a floor and came to its end there.
fn landed(method: &Value) -> (Box<dyn Dynamics>, f64) {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "method": method,
        "bodies": [disc([0.0, 0.4], [0.0; 2])], "bounds": {"min": [-5, 0], "max": [5, 9], "friction": 0.5}});
    let (sample, world) = run(&scene, 6.0);
    let fastest = super::fastest(&sample);
    (world, fastest)
}

#[test]
fn what_is_told_not_to_sleep_stays_awake() {
    let (rested, _) = landed(&json!({"solver": "live"}));
    assert!(rested.is_asleep());
    let (awake, _) = landed(&json!({"solver": "live", "sleep": false}));
    assert!(!awake.is_asleep());
}

#[test]
fn what_is_told_not_to_settle_goes_on_shaking() {
    let (_, settled) = landed(&json!({"solver": "live", "sleep": false}));
    let (_, free) = landed(&json!({"solver": "live", "sleep": false, "settle": false}));
    assert!(settled < 1e-3, "{settled} m/s");
    assert!(free > 3.0 * settled, "{free} m/s, settled {settled} m/s");
}

/// Its bell lies on its limbs, which cross as often as they are led back: after 2 to 13 s, as it falls.
#[test]
fn a_jellyfish_on_its_limbs_comes_to_rest() {
    let jellyfish = json!({"make": "picture", "file": "pictures/jellyfish.png", "height": 1, "origin": [0, 1.5], "spacing": 0.12,
        "material": {"kind": "spring", "young": 200, "mass": 0.5}});
    let scene = json!({"wobble": 1, "contact": true, "gravity": [0, -9.81], "bodies": [jellyfish],
        "bounds": {"min": [-1.5, 0], "max": [1.5, 10], "friction": 0.4}});
    let (sample, world) = run(&scene, 20.0);
    assert!(world.is_asleep(), "{} m/s", super::fastest(&sample));
}

/// Polygons of many corners roll on, as slowly as what settles them lets them, and no two of their contacts come and go together.
#[test]
fn a_heap_of_rigid_discs_falls_asleep() {
    let disc = |k: u32| {
        let (row, column) = (k / 3, k % 3);
        json!({"make": "disc", "radius": 0.5, "spacing": 0.15, "velocity": [0, -2],
            "origin": [0.7 + 1.15 * f64::from(column) + 0.4 * f64::from(row % 2), 0.7 + 1.2 * f64::from(row)],
            "material": {"kind": "rigid", "mass": 1}})
    };
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": (0..18).map(disc).collect::<Vec<_>>(),
        "bounds": {"min": [0, 0], "max": [4, 40], "friction": 0.3}});
    let (sample, world) = run(&scene, 6.0);
    assert!(world.is_asleep(), "{} m/s", super::fastest(&sample));
}

/// Boxes rest where a skin of their thickness holds them apart, not of their length.
#[test]
fn long_thin_boxes_lie_close_on_each_other() {
    let long = |y: f64| {
        json!({"make": "box", "width": 4, "height": 0.3, "origin": [0, y],
            "material": {"kind": "rigid", "mass": 1}})
    };
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": [long(0.2), long(0.6)],
        "bounds": {"min": [-3, 0], "max": [7, 9], "friction": 0.5}});
    let (sample, _) = run(&scene, 3.0);
    let height = |points: std::ops::Range<usize>| points.map(|i| sample.position[i][1]).sum::<f64>() / 4.0;
    let gap = height(4..8) - height(0..4) - 0.3;
    assert!((0.0..0.06).contains(&gap), "{gap} m");
}

#[test]
fn a_ragdoll_that_lies_on_itself_comes_to_rest() {
    // What led its parts out of each other, against its joints, made it creep over the floor.
    for angle in [0.3, 2.0] {
        let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true,
            "bodies": [{"make": "ragdoll", "origin": [0, 2], "angle": angle, "material": {"mass": 60}}],
            "bounds": {"min": [-3.5, 0], "max": [3.5, 12], "friction": 0.5}});
        let (sample, world) = run(&scene, 10.0);
        assert!(world.warnings().is_empty(), "{:?}", world.warnings());
        let fastest = super::fastest(&sample);
        assert_eq!(fastest, 0.0, "that fell at {angle}");
    }
}

/// A seat on two ropes with a load on it is a pendulum: drag alone, of a rate c, takes its amplitude, by exp(-c t / 2).
#[test]
fn a_swing_with_a_load_swings_on() {
    let spring = |mass: f64| json!({"kind": "spring", "stiffness": 40_000, "damping": 5, "mass": mass});
    let rope = |x: f64| {
        json!({"make": "rope", "count": 15, "origin": [x, 3.1], "to": [0, -1.8], "pinned": [0],
            "material": {"kind": "rigid", "mass": 0.3}})
    };
    let scene = json!({"wobble": 1, "contact": {"friction": 0.5}, "gravity": [0, -9.81], "drag_rate": 0.1,
        "bodies": [
            {"make": "lattice", "columns": 13, "rows": 3, "spacing": 0.15, "origin": [-0.9, 1], "velocity": [0.4, 0],
                "material": spring(6.0)},
            rope(-0.75), rope(0.75),
            {"make": "lattice", "columns": 4, "rows": 3, "spacing": 0.15, "origin": [-0.2, 1.36], "velocity": [0.4, 0],
                "material": spring(3.0)}],
        "bonds": [{"a": 27, "b": 53, "rest": 0}, {"a": 37, "b": 68, "rest": 0}]});
    let mut world = super::world(&scene);
    let mut farthest = |from: f64, to: f64| {
        let mut most = 0.0_f64;
        while world.time() < to {
            world.step();
            let sample = world.sample(world.time());
            let x = sample.position[..39].iter().map(|x| x[0]).sum::<f64>() / 39.0;
            most = if world.time() < from { most } else { most.max(x.abs()) };
        }
        most
    };
    let (first, last) = (farthest(0.0, 3.0), farthest(12.0, 15.0));
    let expected = f64::exp(-0.05 * 12.0);
    assert!(first > 0.1 && (0.6 * expected..1.2 * expected).contains(&(last / first)), "{first} m, {last} m");
}

/// The first time at which a world sleeps, until `most` `[s]`, and how it is then.
fn asleep_within(scene: &Value, most: f64) -> (Option<f64>, f64) {
    let mut world = super::world(scene);
    while world.time() < most && !world.is_asleep() {
        world.step();
    }
    (world.is_asleep().then(|| world.time()), super::fastest(&world.sample(world.time())))
}

/// Nothing of it lies on the ground: drag of a rate c takes its swings by exp(-c t / 2), from a sag of 0.4 m to 1 mm in 15 s.
#[test]
fn a_bridge_with_a_box_on_it_falls_asleep() {
    let links = [[0, 5], [4, 9], [8, 13], [12, 17], [16, 21], [20, 1]];
    let link = |[a, b]: [u32; 2]| json!({"a": a, "b": b, "kind": "spring", "stiffness": 20_000, "damping": 100});
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "drag_rate": 0.8, "contact": {"friction": 0.6, "radius": 0.01},
        "points": {"position": [[-1.5, 0], [1.5, 0]], "pinned": [0, 1]}, "bonds": links.map(link),
        "bodies": [
            {"make": "box", "width": 0.5, "height": 0.12, "supports": 2, "origin": [-1.2, -0.06],
                "material": {"kind": "rigid", "mass": 6}, "repeat": {"count": [5, 1], "step": [0.6, 0]}},
            {"make": "box", "width": 0.4, "height": 0.4, "supports": 2, "origin": [0, 0.225],
                "material": {"kind": "rigid", "mass": 10}}]});
    let (at, fastest) = asleep_within(&scene, 30.0);
    assert!(at.is_some(), "{fastest} m/s after 30 s");
}

/// Two pins hold the shelf below what the box lies on.
#[test]
fn a_box_on_a_shelf_that_two_pins_hold_falls_asleep() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": {"friction": 0.5},
        "bodies": [
            {"make": "lattice", "columns": 8, "rows": 2, "spacing": 0.25, "pinned": [0, 7], "material": {"kind": "rigid", "mass": 5}},
            {"make": "box", "width": 0.4, "height": 0.4, "supports": 2, "origin": [0.9, 0.6],
                "material": {"kind": "rigid", "mass": 2}}]});
    let (at, fastest) = asleep_within(&scene, 10.0);
    assert!(at.is_some(), "{fastest} m/s after 10 s");
}
