//! What a substep costs: one relaxation sweep over a mesh, by order, beside the naive program; the gallery's rim; and
//! every kernel of large bodies beside the plain program.
//!
//! `cargo bench` prints time a sweep; the throughput is in bonds, so ns a bond = 1 / (elements a second). For tables at
//! all sizes, with the strain that a frame reaches: `wobble study speed`.
#![allow(missing_docs, reason = "criterion's macros make public functions without docs")]
#![allow(clippy::unwrap_used, reason = "a bench that cannot go on stops")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use wobble::sim::{Bond, BondKind, Method, Model, Order, PointId, Precision, Solver, build};
use wobble::study::speed::find_speed_scene;
use wobble::study::speed::naive::Naive as Plain;

/// A sheet of `n` x `n` points, spacing 0.1 m, rows, columns and one diagonal a cell: 3 n^2 bonds less the edges.
fn sheet(n: u32, order: Order) -> Model<2> {
    let mut model = Model::<2> {
        gravity: [0.0, -9.81],
        method: Method {
            solver: Solver::Relaxation,
            substep: Some(0.001),
            iterations: Some(1),
            order,
            ..Method::default()
        },
        ..Model::default()
    };
    let spacing = 0.1;
    for i in 0..n * n {
        model.position.push([f64::from(i % n) * spacing, -f64::from(i / n) * spacing]);
    }
    let mut join = |a: u32, b: u32, rest_length: f64| {
        let kind = BondKind::Relaxed { relaxation: 1.0, max_correction: f64::INFINITY };
        model.bonds.push(Bond { kind, ..Bond::new(PointId(a), PointId(b), rest_length) });
    };
    for i in 0..n * n {
        let (right, below) = (i % n + 1 < n, i / n + 1 < n);
        if right {
            join(i, i + 1, spacing);
        }
        if below {
            join(i, i + n, spacing);
        }
        if right && below {
            join(i, i + n + 1, spacing * 2.0_f64.sqrt());
        }
    }
    model.velocity = vec![[0.0; 2]; model.position.len()];
    model.mass = vec![1.0; model.position.len()];
    model.pinned = (0..n).map(PointId).collect();
    model
}

/// The program as one would first write it: array of structs, 2x - x_prev, listed order.
struct Naive {
    points: Vec<NaivePoint>,
    bonds: Vec<(usize, usize, f64)>,
}

struct NaivePoint {
    x: [f64; 2],
    previous: [f64; 2],
    free: bool,
}

impl Naive {
    fn new(model: &Model<2>) -> Self {
        let mut points: Vec<NaivePoint> =
            model.position.iter().map(|&x| NaivePoint { x, previous: x, free: true }).collect();
        for pin in &model.pinned {
            points[pin.index()].free = false;
        }
        let bonds = model.bonds.iter().map(|b| (b.a.index(), b.b.index(), b.rest_length)).collect();
        Naive { points, bonds }
    }

    fn step(&mut self, h: f64) {
        for p in self.points.iter_mut().filter(|p| p.free) {
            let next = [2.0 * p.x[0] - p.previous[0], 2.0 * p.x[1] - p.previous[1] - 9.81 * h * h];
            (p.previous, p.x) = (p.x, next);
        }
        for &(a, b, rest) in &self.bonds {
            let d = [self.points[a].x[0] - self.points[b].x[0], self.points[a].x[1] - self.points[b].x[1]];
            let length = (d[0] * d[0] + d[1] * d[1]).sqrt();
            let (w_a, w_b) = (f64::from(u8::from(self.points[a].free)), f64::from(u8::from(self.points[b].free)));
            if w_a + w_b == 0.0 || length == 0.0 {
                continue;
            }
            let c = (rest / length - 1.0) / (w_a + w_b);
            for (k, d) in d.into_iter().enumerate() {
                self.points[a].x[k] += c * w_a * d;
                self.points[b].x[k] -= c * w_b * d;
            }
        }
    }
}

/// The same model, computed with these scalars.
fn in_precision(model: &Model<2>, precision: Precision) -> Model<2> {
    Model { method: Method { precision, ..model.method }, ..model.clone() }
}

fn sweeps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("substep of 10k points, 30k relaxed bonds");
    let listed = sheet(100, Order::Fixed);
    group.throughput(Throughput::Elements(listed.bonds.len() as u64));
    let mut naive = Naive::new(&listed);
    group.bench_function("naive", |b| b.iter(|| naive.step(0.001)));
    for (name, order) in [("listed", Order::Fixed), ("coloured", Order::Coloured), ("shuffled", Order::Shuffled)] {
        let model = sheet(100, order);
        let mut double = build(&in_precision(&model, Precision::F64)).unwrap();
        group.bench_function(format!("{name}, f64"), |b| b.iter(|| double.step()));
        let mut single = build(&in_precision(&model, Precision::F32)).unwrap();
        group.bench_function(format!("{name}, f32"), |b| b.iter(|| single.step()));
    }
    // The same points without bonds: what is left of a substep when the sweep is taken away.
    let mut bare = sheet(100, Order::Coloured);
    bare.bonds.truncate(1);
    let mut bare = build(&bare).unwrap();
    group.bench_function("without bonds, f64", |b| b.iter(|| bare.step()));
    group.finish();
}

/// One display frame of the gallery's rim-relaxed: 10 substeps of 6 ms.
fn rim_frame(criterion: &mut Criterion) {
    let scene = wobble::scene::Scene::load("rim-relaxed").unwrap();
    let mut world = scene.world(None).unwrap();
    criterion.bench_function("rim-relaxed, a frame of 10 substeps", |b| {
        b.iter(|| (0..10).for_each(|_| world.step()));
    });
}

/// The mouse force: in reach, out of reach, not there. Out of reach must cost next to nothing.
fn mouse(criterion: &mut Criterion) {
    use wobble::sim::{Command, Cursor, MouseForce, Profile, Region, Track};
    let mut group = criterion.benchmark_group("10k points and a mouse");
    let mut model = sheet(100, Order::Coloured);
    model.bonds.truncate(1);
    model.method.solver = Solver::Auto;
    let force = MouseForce {
        strength: 1.0,
        radius: 20.0,
        region: Region::Round,
        profile: Profile::Smooth,
        track: Track::default(),
    };
    let cursors = [("no force", None), ("out of reach", Some([1e6, 0.0])), ("in reach", Some([5.0, -5.0]))];
    for (name, at) in cursors {
        model.mouse = at.map(|_| force.clone());
        let mut world = build(&model).unwrap();
        world.apply(&Command::Cursor { to: at.map(Cursor::at), by: 0.0 }).unwrap();
        group.bench_function(name, |b| b.iter(|| world.step()));
    }
    group.finish();
}

/// A substep of one sweep of 1/960 s.
fn sweep() -> Method {
    Method { solver: Solver::Xpbd, substep: Some(1.0 / 960.0), iterations: Some(1), ..Method::default() }
}

/// A substep of one pass over paths.
fn pass() -> Method {
    Method { solver: Solver::Path, ..sweep() }
}

/// Kernels of large bodies in `f32`: rows of a sheet, equal small bodies in lanes, colours of a mesh, paths; the plain
/// program's substep on the same scene beside each. Of small bodies a pass over paths is a sweep.
fn kernels(criterion: &mut Criterion) {
    let cases = [
        ("rows", "hard-100", sweep()),
        ("rows", "hard-316", sweep()),
        ("lanes", "rims-1000", pass()),
        ("mesh", "disc-10k", sweep()),
        ("mesh", "disc-100k", sweep()),
        ("paths", "rope-10k", pass()),
        ("paths", "net-100", pass()),
        ("paths", "hard-100", pass()),
        ("paths", "hard-316", pass()),
        ("paths", "disc-10k", pass()),
    ];
    for (kernel, scene, method) in cases {
        let mut model = find_speed_scene(scene).unwrap().model().unwrap();
        model.method = Method { precision: Precision::F32, ..method };
        let mut group = criterion.benchmark_group(format!("{kernel}, {scene}"));
        group.throughput(Throughput::Elements(model.bonds.len() as u64));
        let mut world = build(&model).unwrap();
        group.bench_function("a substep", |b| b.iter(|| world.step()));
        let mut plain = Plain::<f32>::new(&model, 1.0 / 960.0);
        group.bench_function("the plain program's", |b| {
            b.iter(|| {
                plain.advance();
                plain.sweep();
            });
        });
        group.finish();
    }
}

/// A frame of 1/60 s of scenes that are held to a strain of 0.02, after the first second.
fn frames(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a frame, strain 0.02");
    for scene in ["rope-1000", "rope-10k", "net-100", "hard-100", "hard-corners-100", "rims-1000", "disc-10k"] {
        let mut model = find_speed_scene(scene).unwrap().model().unwrap();
        model.method.max_strain = Some(0.02);
        let mut world = build(&model).unwrap();
        (0..60).for_each(|_| world.step());
        group.bench_function(scene, |b| b.iter(|| world.step()));
    }
    group.finish();
}

/// Short readings: the study of speed is for tables, this for a look at a change.
fn quick() -> Criterion {
    let criterion = Criterion::default().sample_size(10).without_plots();
    criterion.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_millis(1500))
}

criterion_group! {
    name = benches;
    config = quick();
    targets = sweeps, rim_frame, mouse, kernels, frames
}
criterion_main!(benches);
