//! From the bytes of a picture file to the first frame in which its body has moved, drawn off-screen on a GPU that is open
//! already: all of it, and each stage by itself.
//!
//! The picture is 1024 x 1024 px, in colours that a PNG does not make small, with holes and a stroke; its mesh has the spacing
//! that it opens with (1/40 of a side), and 16 px. Each picture drawn is of a world that the renderer has not seen before.
#![allow(missing_docs, reason = "criterion's macros make public functions without docs")]
#![allow(clippy::unwrap_used, reason = "a bench that cannot go on stops")]

use std::hint::black_box;
use std::sync::Arc;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use wobble::picture::{Picture, Settings, Size, Skin, Watch, decode, encode, mesh_picture};
use wobble::render::{Camera, Capture, Look, RenderError, View};
use wobble::scene::{BodyKeys, Matter, PatternName, Scene};
use wobble::sim::Dynamics;

const SIDE: u32 = 1024;
/// Of the window that the frame is for [px].
const FRAME: [u32; 2] = [1100, 720];
/// What is stepped before the first frame: one sixtieth of a second [s].
const STEP: f64 = 1.0 / 60.0;

/// A cogwheel with a hole and a tail.
fn file() -> Vec<u8> {
    let mut picture = Picture::filled(SIDE, SIDE, [0; 4]);
    for i in 0..(SIDE * SIDE) as usize {
        let [x, y] = [i % SIDE as usize, i / SIDE as usize].map(|at| at as f64 + 0.5 - 512.0);
        let (away, turn) = (x.hypot(y), y.atan2(x));
        let is_wheel = (120.0..380.0 + 50.0 * (9.0 * turn).sin()).contains(&away);
        let is_tail = x.abs() < 3.0 && y < -300.0;
        let grain = (i.wrapping_mul(2_654_435_761) >> 7) as u8 & 31;
        let colours = [130 + (away / 8.0) as u8, 90 + grain, 60 + (turn * 20.0 + 63.0) as u8];
        picture.rgba[4 * i..4 * i + 3].copy_from_slice(&colours);
        picture.rgba[4 * i + 3] = if is_wheel || is_tail { 255 } else { 0 };
    }
    encode(&picture).unwrap()
}

/// The scene that a dropped picture becomes.
fn scene(picture: &Arc<Picture>, settings: &Settings, pattern: PatternName) -> Scene {
    let material = Some(Matter::Soft.material(None));
    let keys = BodyKeys { material, pattern: Some(pattern), ..BodyKeys::cut(settings, 2.0, picture) };
    Scene::of_drawing("dropped", Arc::clone(picture), keys, Matter::Soft, &Watch::default()).unwrap()
}

fn step(world: &mut dyn Dynamics) {
    while world.time() < STEP {
        world.step();
    }
}

fn draw(capture: &mut Capture, world: &dyn Dynamics, skins: &[Skin]) -> Result<(), RenderError> {
    let camera = Camera::fit([[-1.9, -1.9, 0.0], [1.9, 1.9, 0.0]], 2, FRAME);
    let look = Look::default();
    capture.forget_world();
    capture.picture(&View { skins, ..View::of(world) }, &camera, &look).map(|drawn| drop(black_box(drawn)))
}

fn import(criterion: &mut Criterion) {
    let bytes = file();
    let mut group = criterion.benchmark_group("import");
    group.measurement_time(Duration::from_secs(8)).sample_size(20);
    group.bench_function("decode", |bench| bench.iter(|| decode(&bytes).unwrap()));
    let picture = Arc::new(decode(&bytes).unwrap());
    let mut capture = Capture::new(FRAME, 2).ok();
    for (name, spacing, pattern) in [
        ("25.6 px", 25.6, PatternName::Edges),
        ("16 px", 16.0, PatternName::Edges),
        ("16 px braced", 16.0, PatternName::Braced),
    ] {
        let settings = Settings { size: Size::Spacing(spacing), ..Settings::default() };
        let stage = |stage: &str| format!("{stage}, {name}");
        group.bench_function(stage("mesh"), |bench| bench.iter(|| mesh_picture(&picture, &settings).unwrap()));
        group.bench_function(stage("scene with its mesh"), |bench| bench.iter(|| scene(&picture, &settings, pattern)));
        let made = scene(&picture, &settings, pattern);
        group.bench_function(stage("world"), |bench| bench.iter(|| made.world(None).unwrap()));
        group.bench_function(stage("skins"), |bench| bench.iter(|| made.skins().unwrap()));
        group.bench_function(stage("first frame's steps"), |bench| {
            bench.iter_batched_ref(
                || made.world(None).unwrap(),
                |world| step(&mut **world),
                criterion::BatchSize::LargeInput,
            );
        });
        // Without a GPU there is nothing to draw with.
        let Some(capture) = &mut capture else { continue };
        let (mut world, skins) = (made.world(None).unwrap(), made.skins().unwrap());
        step(&mut *world);
        group.bench_function(stage("upload and draw"), |bench| bench.iter(|| draw(capture, &*world, &skins).unwrap()));
        group.bench_function(stage("from the file's bytes to a frame"), |bench| {
            bench.iter(|| {
                let picture = Arc::new(decode(&bytes).unwrap());
                let scene = scene(&picture, &settings, pattern);
                let (mut world, skins) = (scene.world(None).unwrap(), scene.skins().unwrap());
                step(&mut *world);
                draw(capture, &*world, &skins).unwrap();
            });
        });
    }
    group.finish();
}

criterion_group!(benches, import);
criterion_main!(benches);
