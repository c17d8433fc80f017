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

/// What is light rests on nothing: it goes on with what struck it, and nothing is lifted, though others in the heap rest on the floor.
#[test]
fn in_flight_what_is_heavy_and_what_is_light_share_their_momentum() {
    let at = |x: f64, y: f64, v: f64, mass: f64| {
        json!({"make": "box", "width": 0.4, "height": 0.4, "supports": 2, "origin": [x, y], "velocity": [v, 0],
            "material": {"kind": "rigid", "mass": mass}})
    };
    let mut world = world(&json!({"wobble": 1, "contact": {"friction": 0}, "gravity": [0, 0],
        "bodies": [at(0.0, 1.0, 4.0, 50.0), at(0.5, 1.1, 0.0, 0.5), at(1.0, 1.0, -1.0, 0.5)]}));
    let masses = world.masses().to_vec();
    let momentum = |sample: &Sample| crate::common::physics::momentum(sample, &masses);
    let start = momentum(&world.sample(0.0));
    while world.time() < 0.5 {
        world.step();
    }
    let end = momentum(&world.sample(world.time()));
    assert!((0..2).all(|k| (end[k] - start[k]).abs() < 1e-9 * start[0]), "{start:?} {end:?}");
}
