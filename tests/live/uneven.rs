//! What is heavy on what is light: it presses that flat, or rests on it, but does not get into it.

use serde_json::{Value, json};
use wobble::sim::Sample;

use super::heap::inside;
use super::world;

/// A heavy box falls on something light: how deep each gets into the other [m], and the most energy beyond the first [J]. `light`: how many
/// points of the first bodies' outline there are; the box follows them.
fn deepest(light: &[Value], outline: usize, mass: f64) -> [f64; 2] {
    let heavy = json!({"make": "box", "width": 0.8, "height": 0.8, "supports": 2, "origin": [0, 1.4],
        "material": {"kind": "rigid", "mass": mass}});
    let bodies: Vec<Value> = light.iter().cloned().chain([heavy]).collect();
    let mut world = world(&json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": bodies,
        "bounds": {"min": [-4, 0], "max": [4, 6], "friction": 0.5}}));
    let start = world.sample(0.0).energy;
    let (mut depth, mut gained): (f64, f64) = (0.0, 0.0);
    while world.time() < 2.0 {
        world.step();
        let sample = world.sample(world.time());
        let (others, own) = sample.position.split_at(sample.position.len() - 4);
        let others = &others[..outline];
        depth = others.iter().map(|&x| inside(own, x)).fold(depth, f64::max);
        depth = own.iter().map(|&x| inside(others, x)).fold(depth, f64::max);
        gained = gained.max(sample.energy - start);
    }
    [depth, gained]
}

#[test]
fn a_rigid_box_bears_one_a_thousand_times_as_heavy() {
    let light = json!({"make": "box", "width": 1, "height": 0.5, "supports": 2, "origin": [0, 0.26],
        "material": {"kind": "rigid", "mass": 0.1}});
    let [depth, gained] = deepest(&[light], 4, 100.0);
    assert!(depth < 0.02, "{depth} m deep");
    assert!(gained < 1.0, "{gained} J");
}

#[test]
fn a_light_soft_disc_is_pressed_flat_but_not_pierced() {
    let light = json!({"make": "disc", "radius": 0.4, "spacing": 0.1, "origin": [0, 0.42],
        "material": {"kind": "spring", "stiffness": 2000, "mass": 0.5}});
    let outline = {
        let alone = world(&json!({"wobble": 1, "bodies": [light.clone()]}));
        let at = alone.sample(0.0).position;
        at.iter().take_while(|x| (x[0].hypot(x[1] - 0.42) - 0.4).abs() < 1e-6).count()
    };
    let [depth, gained] = deepest(&[light], outline, 70.0);
    assert!(depth < 0.02, "{depth} m deep");
    assert!(gained < 1.0, "{gained} J");
}

/// Heavy bodies that squeeze a light one from both sides, over a floor without friction: nothing but them acts along it.
#[test]
fn what_is_squeezed_from_both_sides_takes_no_momentum() {
    let disc = |x: f64, y: f64, v: f64, mass: f64| json!({"make": "disc", "radius": 0.3, "spacing": 0.2, "origin": [x, y], "velocity": [v, 0], "material": {"mass": mass}});
    let floor = json!({"make": "box", "width": 2, "height": 0.5, "supports": 2, "origin": [-0.2, 0.27], "material": {"mass": 2}});
    // On the floor, and above a light box that lies there.
    for (y, below) in [(0.31, None), (1.2, Some(floor))] {
        let three = [disc(-1.0, y, 5.0, 30.0), disc(-0.2, y, 0.0, 1.0), disc(0.7, y, -4.0, 30.0)];
        let bodies: Vec<Value> = three.into_iter().chain(below).collect();
        let mut world =
            world(&json!({"wobble": 1, "contact": {"friction": 0}, "gravity": [0, -9.81], "bodies": bodies,
            "bounds": {"min": [-40, 0], "max": [40, 19]}}));
        let masses = world.masses().to_vec();
        let along = |sample: &Sample| crate::common::physics::momentum(sample, &masses)[0];
        let start = along(&world.sample(0.0));
        while world.time() < 0.3 {
            world.step();
        }
        assert!(world.counters().contacts > 0, "they meet");
        let end = along(&world.sample(world.time()));
        assert!((end - start).abs() < 0.05 * start, "at {y} m: {start} kg m/s, {end} after it");
    }
}

#[test]
fn a_platform_that_is_pinned_bears_as_a_floor_does() {
    let boxed = |y: f64, size: [f64; 2], mass: f64| json!({"make": "box", "width": size[0], "height": size[1], "supports": 2, "origin": [0, y], "material": {"mass": mass}});
    let mut platform = boxed(1.0, [6.0, 0.4], 1.0);
    platform["pinned"] = json!([0, 1, 2, 3]);
    let mut world = world(&json!({"wobble": 1, "gravity": [0, -9.81], "contact": true,
        "bodies": [platform, boxed(1.4, [1.0, 0.3], 1.0), boxed(2.0, [1.0, 0.3], 1000.0)]}));
    let mut depth: f64 = 0.0;
    while world.time() < 2.0 {
        world.step();
        let at = world.sample(world.time()).position;
        let (light, heavy) = (&at[4..8], &at[8..]);
        depth = heavy
            .iter()
            .map(|&x| inside(light, x))
            .chain(light.iter().map(|&x| inside(heavy, x)))
            .fold(depth, f64::max);
    }
    assert!(depth < 0.02, "{depth} m deep");
}
