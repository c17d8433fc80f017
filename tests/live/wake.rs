//! What sleeps is woken by what touches it.

use serde_json::json;

use super::{disc, world};

#[test]
fn a_body_that_sleeps_is_woken_by_a_touch() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "method": {"solver": "live"},
        "bodies": [disc([0.0, 0.26], [0.0; 2]), disc([3.0, 60.0], [-0.82, 0.0])],
        "bounds": {"min": [-5, 0], "max": [5, 100], "friction": 0.5}});
    let mut world = world(&scene);
    let count = world.point_count() / 2;
    let mut still = None;
    // 60 m take 3.5 s; until 2.9 s the other one tips from a corner onto a side.
    while world.time() < 5.0 {
        world.step();
        let sample = world.sample(world.time());
        let own = &sample.position[..count];
        if world.time() > 3.2 && still.is_none() {
            assert!(sample.velocity[..count].iter().all(|v| *v == [0.0; 3]), "it sleeps");
            still = Some(own.to_vec());
        }
    }
    let end = world.sample(world.time());
    let moved = still.unwrap().iter().zip(&end.position).any(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]) > 0.02);
    assert!(moved, "it is where it slept");
}
