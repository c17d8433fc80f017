//! Circles in the plane; balls, boxes and planes in space, and cloth that meets them, others and itself.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod boxes;
mod cloth;
mod obstacles;
mod pace;
mod rest;
mod solids;
mod tops;

use serde_json::Value;
use wobble::scene::Scene;
use wobble::sim::{Dynamics, Sample};

const G: f64 = 9.81;

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

fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
