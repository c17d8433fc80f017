//! What a substep costs: one relaxation sweep over a mesh, by order, beside the naive program; and the gallery's rim.
//!
//! `cargo bench` prints time a sweep; the throughput is in bonds, so ns a bond = 1 / (elements a second).
#![allow(missing_docs, reason = "criterion's macros make public functions without docs")]
#![allow(clippy::unwrap_used, reason = "a bench that cannot go on stops")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use wobble::sim::{Bond, BondKind, Dynamics, Method, Model, Order, PointId, Solver, World};

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

fn sweeps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("substep of 10k points, 30k relaxed bonds");
    let listed = sheet(100, Order::Fixed);
    group.throughput(Throughput::Elements(listed.bonds.len() as u64));
    let mut naive = Naive::new(&listed);
    group.bench_function("naive", |b| b.iter(|| naive.step(0.001)));
    for (name, order) in [("listed", Order::Fixed), ("coloured", Order::Coloured), ("shuffled", Order::Shuffled)] {
        let model = sheet(100, order);
        let mut double = World::<f64, 2>::new(&model).unwrap();
        group.bench_function(format!("{name}, f64"), |b| b.iter(|| double.step()));
        let mut single = World::<f32, 2>::new(&model).unwrap();
        group.bench_function(format!("{name}, f32"), |b| b.iter(|| single.step()));
    }
    // The same points without bonds: what is left of a substep when the sweep is taken away.
    let mut bare = sheet(100, Order::Coloured);
    bare.bonds.truncate(1);
    let mut bare = World::<f64, 2>::new(&bare).unwrap();
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
        let mut world = World::<f64, 2>::new(&model).unwrap();
        world.apply(Command::MoveCursor(at.map(Cursor::at)));
        group.bench_function(name, |b| b.iter(|| world.step()));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).without_plots();
    targets = sweeps, rim_frame, mouse
}
criterion_main!(benches);
