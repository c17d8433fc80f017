//! Every scene of the gallery but `million-cloth` for ten seconds under a mouse that jumps, grabs and flings, on one core: prints what a frame
//! takes, the median, the slowest of a hundred and the worst, each the best of three runs; without the drawing. `WOBBLE_SCENE=NAME` runs one.
#![allow(
    missing_docs,
    unreachable_pub,
    reason = "criterion's macros make public functions without docs, and tests share a file"
)]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench that cannot go on stops, and says what it found")]

#[path = "../tests/common/jumping.rs"]
mod jumping;

use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use jumping::JumpingMouse;
use wobble::scene::{Entry, gallery};

const LEFT_OUT: &str = "million-cloth";
/// How long it jumps [s].
const TIME: f64 = 10.0;
const FRAMES: u32 = 600;
const RUNS: usize = 3;

/// What its frames take [ms], ascending.
fn frames(entry: &Entry) -> Vec<f64> {
    let mut world = entry.scene().unwrap().world(None).unwrap();
    let mut mouse = JumpingMouse::new(&*world, TIME);
    let mut times: Vec<f64> = (1..=FRAMES)
        .map(|frame| {
            mouse.jump(&mut *world, u64::from(frame));
            let from = Instant::now();
            while world.time() < TIME * f64::from(frame) / f64::from(FRAMES) - 1e-9 {
                world.step();
            }
            1e3 * from.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times
}

fn gallery_frames(_: &mut Criterion) {
    let asked = std::env::var("WOBBLE_SCENE").ok();
    let is_run = |entry: &&Entry| asked.as_ref().map_or(entry.name != LEFT_OUT, |name| entry.name == *name);
    println!("{:24} {:>9} {:>9} {:>9}", "[ms a frame]", "median", "p99", "worst");
    for entry in gallery().iter().filter(is_run) {
        let runs: Vec<Vec<f64>> = (0..RUNS).map(|_| frames(entry)).collect();
        let best = |place: usize| runs.iter().map(|times| times[place]).fold(f64::INFINITY, f64::min);
        let [median, most, worst] = [300, 593, 599].map(best);
        println!("{:24} {median:>9.2} {most:>9.2} {worst:>9.2}", entry.name);
    }
}

criterion_group! { name = benches; config = Criterion::default(); targets = gallery_frames }
criterion_main!(benches);
