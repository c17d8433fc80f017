//! A linkage whose own method takes too long, or explodes, within a step: the live step takes over there, from a state that is sound.

use serde_json::{Value, json};

use super::{frames, world};

/// A weight of 14 kg on twelve rods of 6 cm with 10 g between them, as the mouse has whirled it up to 12 m/s.
fn whip() -> Value {
    let position = [
        [0.0, 1.0],
        [0.055511, 1.023835],
        [0.115304, 1.032463],
        [0.174228, 1.045785],
        [0.231869, 1.063871],
        [0.291549, 1.073244],
        [0.351871, 1.076537],
        [0.408641, 1.055877],
        [0.460334, 1.024614],
        [0.498239, 0.977574],
        [0.515519, 0.919686],
        [0.514362, 0.859285],
        [0.51265, 0.798898],
    ];
    let velocity = [
        [0.0, 0.0],
        [-0.37024, 0.862287],
        [-0.323067, 0.535375],
        [-0.449124, 1.092912],
        [-0.092412, -0.043942],
        [-0.365126, 1.692524],
        [-0.359128, 1.582648],
        [0.26534, 3.298505],
        [1.615195, 5.530515],
        [2.428147, 6.1856],
        [3.264907, 6.435373],
        [6.099168, 6.381085],
        [10.244386, 6.263568],
    ];
    let mass: Vec<f64> = (0..13).map(|k| if k == 12 { 14.295_35 } else { 0.01 }).collect();
    let bonds: Vec<Value> = (0..12).map(|k| json!({"a": k, "b": k + 1, "rest": 0.060_411_817})).collect();
    json!({"wobble": 1, "gravity": [0, -9.81], "bonds": bonds,
        "points": {"position": position, "velocity": velocity, "mass": mass, "pinned": [0]},
        "mouse": {"strength": 66.313_51, "radius": 1.441_75, "region": "square", "profile": "linear",
            "track": [[-0.01, -0.80708, -0.39827], [0.056667, -0.67361, -0.59687], [0.123333, -0.49251, -0.75328],
                [0.19, -0.2766, -0.85644], [0.24, -0.10094, -0.89432]]},
        "bounds": {"min": [-2.522293, -2.522293], "max": [2.522293, 2.522293], "restitution": 0, "friction": 0.3}})
}

#[test]
fn a_whip_that_its_own_method_cannot_follow_is_handed_over_in_time_and_sound() {
    let mut world = world(&whip());
    let start = world.energy();
    let (frames, _) = frames(&mut *world, 0.2);
    let worst = frames.iter().map(|frame| frame.work).fold(0.0, f64::max);
    // 44 ms, and bonds 1e148 times as long as at rest.
    assert!(worst < 10.0, "{worst} ms of counted work");
    let sample = world.sample(world.time());
    assert!(sample.max_strain < 1e-3, "{}", sample.max_strain);
    assert!(sample.energy < 1.2 * start, "{start} J, then {} J", sample.energy);
    assert!(frames.iter().any(|frame| frame.hand_overs > 0));
}
