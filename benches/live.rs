//! The live step's pace: a hundred discs of about a hundred points fall into a box, a frame of 1/60 s at a time. Prints the median and
//! the worst of 600 frames from the start, and measures one in the heap.
#![allow(missing_docs, reason = "criterion's macros make public functions without docs")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench that cannot go on stops, and says what it found")]

use std::time::Instant;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::sim::Dynamics;

/// Frames that are timed one by one: the discs fall, hit, and come to rest.
const FRAMES: u32 = 600;
/// A frame in which all lie on each other and none sleeps.
const IN_THE_HEAP: u32 = 150;

fn scene() -> Value {
    let disc = |k: u32| {
        let (row, column) = (k / 8, k % 8);
        let shift = 0.4 * f64::from(row % 2);
        json!({"make": "disc", "radius": 0.5, "spacing": 0.09, "velocity": [0, -2],
            "origin": [0.7 + 1.15 * f64::from(column) + shift, 0.7 + 1.2 * f64::from(row)],
            "material": {"kind": "spring", "stiffness": 3000, "damping": 0.2, "mass": 1}})
    };
    let bodies: Vec<Value> = (0..100).map(disc).collect();
    json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": bodies,
        "bounds": {"min": [0, 0], "max": [10, 40], "friction": 0.3}})
}

fn frame(world: &mut dyn Dynamics, number: u32) {
    while world.time() < f64::from(number) / 60.0 - 1e-9 {
        world.step();
    }
}

fn live(c: &mut Criterion) {
    let mut world = Scene::parse(&scene().to_string(), "scene").unwrap().world(None).unwrap();
    let mut heap = None;
    let mut times: Vec<f64> = Vec::new();
    for number in 1..=FRAMES {
        if number == IN_THE_HEAP {
            heap = Some(world.boxed_clone());
        }
        let from = Instant::now();
        frame(&mut *world, number);
        times.push(1e3 * from.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    let (median, worst) = (times[times.len() / 2], times[times.len() - 1]);
    println!("{} points: {median:.2} ms a frame in the median, {worst:.2} ms in the worst", world.point_count());
    let heap = heap.unwrap();
    let step = |mut world: Box<dyn Dynamics>| {
        frame(&mut *world, IN_THE_HEAP);
        world
    };
    c.bench_function("discs: a frame in the heap", |b| {
        b.iter_batched(|| heap.boxed_clone(), step, BatchSize::LargeInput);
    });
}

criterion_group!(benches, live);
criterion_main!(benches);
