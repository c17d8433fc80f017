//! Drawing at 1280x720: a frame of a net that moves, of about 3,000 and 30,000 bonds, without panels. Prints what a frame takes of wall time,
//! with the read-back that a window does not need.
#![allow(missing_docs, reason = "criterion's macros make public functions without docs")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench that cannot go on stops, and says what it found")]

use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use serde_json::json;
use wobble::render::{Camera, Capture, Look, View};
use wobble::scene::Scene;
use wobble::sim::Dynamics;

const SIZE: [u32; 2] = [1280, 720];
/// Rows of the nets, which are as many columns wide.
const ROWS: [u32; 2] = [39, 123];

/// A net that hangs from two corners and swings.
fn net(rows: u32) -> Box<dyn Dynamics> {
    let spacing = 4.0 / f64::from(rows - 1);
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "bodies": [{"make": "cloth", "columns": rows, "rows": rows,
        "spacing": spacing, "origin": [-2, 2], "diagonals": "none", "pinned": [0, rows - 1],
        "material": {"kind": "rigid", "mass": 1}}]});
    Scene::parse(&scene.to_string(), "net").unwrap().world(None).unwrap()
}

fn frames(c: &mut Criterion) {
    let mut capture = match Capture::new(SIZE, 2) {
        Ok(capture) => capture,
        Err(why) => {
            println!("skipped: {why}");
            return;
        }
    };
    let camera = Camera::fit([[-2.5, -3.0, 0.0], [2.5, 2.2, 0.0]], 2, SIZE);
    for rows in ROWS {
        let mut world = net(rows);
        let name = format!("draw {} bonds that move", world.bonds().len());
        capture.forget_world();
        let mut motion = 0;
        // The step is taken outside of what is timed: in the window it is taken by another thread meanwhile.
        let mut drawn = |count: u64| {
            let mut time = Duration::ZERO;
            for _ in 0..count {
                world.step();
                motion += 1;
                let view = View { motion, ..View::of(&*world) };
                let from = Instant::now();
                capture.picture(&view, &camera, &Look::default()).unwrap();
                time += from.elapsed();
            }
            time
        };
        c.bench_function(&name, |b| b.iter_custom(&mut drawn));
    }
}

criterion_group! { name = benches; config = Criterion::default().sample_size(60); targets = frames }
criterion_main!(benches);
