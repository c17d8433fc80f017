//! Every scene of the gallery but `million-cloth` for ten seconds under a mouse that jumps, grabs and flings, on one core: prints what a frame
//! takes, the median, the slowest of a hundred and the worst, each the best of three runs; without the drawing. Beside these stands what the
//! same frames take by counted work, by which budgets go. `WOBBLE_SCENE` names one of them or a scene file.
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
use wobble::scene::{Scene, gallery};

const LEFT_OUT: &str = "million-cloth";
/// How long it jumps [s].
const TIME: f64 = 10.0;
const FRAMES: u32 = 600;
const RUNS: usize = 3;

/// What frames take `[ms]`, ascending, by the clock and by counted work.
fn frames(scene: &Scene) -> [Vec<f64>; 2] {
    let mut world = scene.world(None).unwrap();
    let mut mouse = JumpingMouse::new(&*world, TIME);
    let mut times = [Vec::new(), Vec::new()];
    for frame in 1..=FRAMES {
        mouse.jump(&mut *world, u64::from(frame));
        let (from, done) = (Instant::now(), world.counters().work_ms());
        while world.time() < TIME * f64::from(frame) / f64::from(FRAMES) - 1e-9 {
            world.step();
        }
        times[0].push(1e3 * from.elapsed().as_secs_f64());
        times[1].push(world.counters().work_ms() - done);
    }
    times.iter_mut().for_each(|times| times.sort_by(f64::total_cmp));
    times
}

fn print(name: &str, scene: &Scene) {
    let runs: Vec<[Vec<f64>; 2]> = (0..RUNS).map(|_| frames(scene)).collect();
    let best = |kind: usize, place: usize| runs.iter().map(|times| times[kind][place]).fold(f64::INFINITY, f64::min);
    print!("{name:24}");
    for kind in [0, 1] {
        let [median, most, worst] = [300, 593, 599].map(|place| best(kind, place));
        print!(" {median:>9.2} {most:>9.2} {worst:>9.2}");
    }
    println!();
}

fn gallery_frames(_: &mut Criterion) {
    let asked = std::env::var("WOBBLE_SCENE").ok();
    println!("{:24} {:>29} {:>29}", "[ms a frame]", "median, p99, worst by clock", "by counted work");
    if let Some(asked) = asked {
        return print(&asked, &Scene::load(&asked).unwrap());
    }
    for entry in gallery().iter().filter(|entry| entry.name != LEFT_OUT) {
        print(entry.name, &entry.scene().unwrap());
    }
}

criterion_group! { name = benches; config = Criterion::default(); targets = gallery_frames }
criterion_main!(benches);
