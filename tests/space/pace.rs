//! What costs too much in space, or fails, goes to the live step as in the plane.

use serde_json::{Value, json};
use wobble::sim::{MovedBy, Why, frame_of};

use super::{length, run, world};

/// Counted work of a frame that a scene is held to [ms].
const FRAME: f64 = 8.0;

/// A cloth of so many by so many points that hangs by two corners above a floor.
fn cloth(count: u32, stiffness: f64, budget: &Value) -> Value {
    json!({"wobble": 1, "dimensions": 3, "gravity": [0, -9.81, 0], "method": {"budget": budget},
        "bodies": [{"make": "cloth", "columns": count, "rows": count, "spacing": 2.0 / f64::from(count), "diagonals": "both", "origin": [-1, 1, 0],
            "material": {"kind": "spring", "stiffness": stiffness, "mass": 0.5}, "pinned": [0, count - 1]}],
        "obstacles": [{"plane": {"point": [0, -2, 0], "normal": [0, 1, 0]}}]})
}

/// The most counted work of a frame until `t` [ms], and who moves what then.
fn work(scene: &Value, t: f64) -> (f64, Vec<MovedBy>) {
    let mut world = world(scene);
    let (mut most, mut before): (f64, f64) = (0.0, 0.0);
    while world.time() < t - 1e-9 {
        world.step();
        if frame_of(world.time() + world.substep()) != frame_of(world.time()) {
            most = most.max(world.counters().work_ms() - before);
            before = world.counters().work_ms();
        }
    }
    assert!(world.is_finite());
    (most, world.moved_by())
}

#[test]
fn a_stiff_cloth_goes_live_before_it_costs_more_than_a_frame_and_stretches_little() {
    let scene = cloth(40, 1e5, &json!(6));
    let (most, movers) = work(&scene, 0.5);
    assert!(most <= FRAME, "{most} ms");
    assert!(movers.iter().all(|moved| moved.why == Why::Budget), "{movers:?}");
    let (exact, _) = work(&cloth(40, 1e5, &json!("none")), 1.0 / 60.0);
    assert!(exact > 10.0 * FRAME, "its own method takes {exact} ms");
    let (sample, _) = run(&scene, 1.0);
    assert!(sample.max_strain < 0.1, "{}", sample.max_strain);
}

#[test]
fn a_cloth_within_its_budget_has_the_bits_that_it_has_without_one() {
    let [with, without] = [json!(6), json!("none")].map(|budget| run(&cloth(8, 300.0, &budget), 1.0));
    assert_eq!(with.0.position, without.0.position);
    assert!(with.1.moved_by().iter().all(|moved| moved.why == Why::Plan));
}

/// Rigid bonds hold exactly in space, whatever that takes: the live step would stretch a net of them.
#[test]
fn a_net_of_rigid_bonds_stays_exact() {
    let scene = json!({"wobble": 1, "dimensions": 3, "gravity": [0, -9.81, 0], "method": {"budget": 1},
        "bodies": [{"make": "cloth", "columns": 15, "rows": 15, "spacing": 0.1, "diagonals": "none", "v": [0, 0, 1],
            "material": {"kind": "rigid", "mass": 1}, "pinned": (0..15).collect::<Vec<_>>()}]});
    let (sample, world) = run(&scene, 1.0);
    assert!(world.moved_by().iter().all(|moved| moved.why == Why::Plan), "{:?}", world.moved_by());
    assert!(sample.max_strain < 1e-6, "{}", sample.max_strain);
}

/// A cloth of rigid bonds whose bar is swept to and fro over a box and a ball: what holds it back strains its bonds, and these throw nothing.
#[test]
fn a_cloth_whose_bar_is_swept_over_things_is_not_thrown() {
    let way = |k: u32| {
        let at = |frame: u32| {
            let t = f64::from(frame) / 60.0;
            json!([t, 1.0 - 0.2 * f64::from(k), 1.6 - 1.4 * t.min(1.0), 1.2 * (20.0 / 1.2 * t).sin()])
        };
        json!({"point": k, "track": (0..=120).map(at).collect::<Vec<_>>()})
    };
    let mut scene: Value =
        serde_json::from_str(wobble::scene::gallery().iter().find(|entry| entry.name == "cloth-space").unwrap().json)
            .unwrap();
    scene.as_object_mut().unwrap().remove("parameters");
    scene["bodies"][0]["material"] = json!({"kind": "rigid", "point_mass": 0.03});
    scene["pin_motion"] = json!((0..11).map(way).collect::<Vec<_>>());
    let mut world = world(&scene);
    let mut most: f64 = 0.0;
    while world.time() < 1.6 {
        world.step();
        let sample = world.sample(world.time());
        most = sample.velocity.iter().map(|v| length(*v)).fold(most, f64::max);
    }
    assert!(most < 300.0, "{most} m/s");
}
