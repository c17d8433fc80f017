//! Bodies that meet: in the plane, on floors, slopes and points, at thin walls, in heaps, and alone in flight.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod across;
mod bad;
mod bent;
mod books;
mod flight;
mod heap;
mod kinds;
mod layers;
mod piles;
mod relaxed;
mod rest;
mod rigid;
mod rigs;
mod round;
mod sharp;
mod straps;
mod tangle;
mod thin;
mod uneven;
mod violence;
mod wake;
mod whirl;
mod whole;
mod words;

use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::sim::{Dynamics, Sample};

fn world(scene: &Value) -> Box<dyn Dynamics> {
    Scene::parse(&scene.to_string(), "scene").unwrap().world(None).unwrap()
}

/// The state at a time, and what it was reached with.
fn run(scene: &Value, t: f64) -> (Sample, Box<dyn Dynamics>) {
    let mut world = world(scene);
    while world.time() < t - 1e-9 {
        world.step();
    }
    (world.sample(world.time()), world)
}

fn soft() -> Value {
    json!({"kind": "spring", "stiffness": 3000, "damping": 0.2, "mass": 1})
}

fn disc(at: [f64; 2], velocity: [f64; 2]) -> Value {
    json!({"make": "disc", "radius": 0.25, "spacing": 0.1, "origin": at, "velocity": velocity, "material": soft()})
}

/// Twice the areas of the triangles of a world [m^2], with the sign of their turn.
fn areas(world: &dyn Dynamics, sample: &Sample) -> Vec<f64> {
    let of = |corners: &[wobble::sim::PointId; 3]| {
        let [a, b, c] = corners.map(|corner| sample.position[corner.index()]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    world.triangles().iter().map(of).collect()
}

fn middle(sample: &Sample, axis: usize) -> f64 {
    sample.position.iter().map(|x| x[axis]).sum::<f64>() / sample.position.len() as f64
}

fn fastest(sample: &Sample) -> f64 {
    sample.velocity.iter().map(|v| v[0].hypot(v[1])).fold(0.0, f64::max)
}

#[test]
fn ten_discs_in_a_shaft_come_to_rest_apart_and_creep_no_more() {
    let discs: Vec<Value> =
        (0..10).map(|k| disc([0.02 * f64::from(k % 2), 0.3 + 0.6 * f64::from(k)], [0.0; 2])).collect();
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": discs,
        "bounds": {"min": [-0.4, 0], "max": [0.4, 20], "friction": 0.5}});
    let (rest, mut world) = run(&scene, 5.0);
    assert!(world.is_asleep(), "after 5 s");
    assert!(areas(&*world, &rest).iter().all(|area| *area > 0.0), "no triangle is inside out");
    let each = rest.position.len() / 10;
    let middle = |own: &[[f64; 3]], axis: usize| own.iter().map(|x| x[axis]).sum::<f64>() / each as f64;
    let middles: Vec<[f64; 2]> = rest.position.chunks(each).map(|own| [middle(own, 0), middle(own, 1)]).collect();
    for (k, a) in middles.iter().enumerate() {
        let nearest = middles[..k].iter().map(|b| (a[0] - b[0]).hypot(a[1] - b[1])).fold(f64::INFINITY, f64::min);
        assert!(nearest > 0.4, "disc {k} is {nearest} m from another: {middles:?}");
    }
    let solved = world.counters().bonds_solved;
    while world.time() < 8.0 {
        world.step();
    }
    assert_eq!((world.sample(world.time()).position, world.counters().bonds_solved), (rest.position, solved));
}

#[test]
fn without_the_key_bodies_pass_through_each_other_and_nothing_is_counted() {
    let pair = json!([disc([0.0, 0.0], [2.0, 0.0]), disc([1.0, 0.0], [-2.0, 0.0])]);
    let mut scene = json!({"wobble": 1, "bodies": pair});
    let (through, world) = run(&scene, 1.0);
    let of_first = |sample: &Sample| sample.position[..sample.position.len() / 2].iter().map(|x| x[0]).sum::<f64>();
    assert!(world.counters().contacts == 0 && of_first(&through) > 0.0);
    scene["contact"] = json!(true);
    let (apart, world) = run(&scene, 1.0);
    assert!(world.counters().contacts > 0);
    // They come apart again, and their momenta add up to what they were: nothing.
    let momenta: Vec<f64> = apart.velocity.iter().zip(world.masses()).map(|(v, mass)| mass * v[0]).collect();
    let (left, right) = momenta.split_at(momenta.len() / 2);
    let [left, right]: [f64; 2] = [left, right].map(|list| list.iter().sum());
    assert!(left < -0.1 && right > 0.1 && (left + right).abs() < 1e-9, "{left} {right}");
}

#[test]
fn a_block_on_a_slope_slides_and_holds_by_coulombs_law() {
    let angle = 20.0_f64.to_radians();
    let g = [9.81 * angle.sin(), -9.81 * angle.cos()];
    let scene = |share: f64| {
        json!({"wobble": 1, "gravity": g, "contact": true, "method": {"solver": "live"},
            "bodies": [{"make": "lattice", "columns": 6, "rows": 4, "spacing": 0.1, "origin": [0, 0],
                "material": {"kind": "spring", "stiffness": 20000, "damping": 0.5, "mass": 2}}],
            "obstacles": [{"plane": {"point": [0, 0], "normal": [0, 1]}, "friction": share * angle.tan()}]})
    };
    for share in [0.5, 0.9] {
        let (mut world, mut at) = (world(&scene(share)), Vec::new());
        for t in [1.0, 2.0, 3.0] {
            while world.time() < t - 1e-9 {
                world.step();
            }
            at.push(middle(&world.sample(world.time()), 0));
        }
        let found = at[2] - 2.0 * at[1] + at[0];
        let right = g[0] * (1.0 - share);
        assert!((found / right - 1.0).abs() < 0.02, "at {share} of the limit: {found} m/s^2, not {right}");
    }
    let (early, _) = run(&scene(1.1), 2.0);
    let (late, _) = run(&scene(1.1), 12.0);
    assert!((middle(&late, 0) - middle(&early, 0)).abs() < 1e-4);
}

#[test]
fn a_run_is_the_same_each_time_and_from_a_copy() {
    let discs: Vec<Value> = (0..4).map(|k| disc([0.1 * f64::from(k), 0.4 + 0.6 * f64::from(k)], [1.0, 0.0])).collect();
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": discs,
        "bounds": {"min": [-1, 0], "max": [1, 20], "friction": 0.5}});
    let (first, _) = run(&scene, 2.0);
    let mut world = world(&scene);
    while world.time() < 1.0 {
        world.step();
    }
    let mut copy = world.boxed_clone();
    while copy.time() < 2.0 - 1e-9 {
        copy.step();
    }
    assert_eq!(first, copy.sample(copy.time()));
}
