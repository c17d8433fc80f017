//! What an edit of a running world costs: a box that comes beside a thousand rims and beside a net, a bond of a net that goes,
//! a grab, and the copy of a world that a keyframe keeps.
#![allow(missing_docs, reason = "criterion's macros make public functions without docs")]
#![allow(clippy::unwrap_used, reason = "a bench that cannot go on stops")]

use std::hint::black_box;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use wobble::scene::Scene;
use wobble::sim::{Addition, Bond, BondId, Command, Cursor, Dynamics, PointId, Reach, Selection};

/// A braced box of side 1 in a free place.
fn a_box(world: &dyn Dynamics) -> Command {
    let [first, ..] = world.next_numbers();
    let bond = |(a, b): (u32, u32)| {
        let rest = if a + 2 == b { 2.0_f64.sqrt() } else { 1.0 };
        Bond::new(PointId(first + a), PointId(first + b), rest)
    };
    Command::Add(Box::new(Addition {
        position: vec![[50.0, 0.0, 0.0], [51.0, 0.0, 0.0], [51.0, 1.0, 0.0], [50.0, 1.0, 0.0]],
        velocity: vec![[0.0; 3]; 4],
        mass: vec![1.0; 4],
        bonds: [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)].map(bond).to_vec(),
        ..Addition::default()
    }))
}

fn world(name: &str) -> Box<dyn Dynamics> {
    let mut world = Scene::load(name).unwrap().world(None).unwrap();
    for _ in 0..10 {
        world.step();
    }
    world.apply(&Command::Cursor { to: Some(Cursor::at([0.0, 0.0])), by: 0.0 }).unwrap();
    world
}

fn edit(c: &mut Criterion, what: &str, world: &dyn Dynamics, command: &Command) {
    let apply = |mut world: Box<dyn Dynamics>| {
        black_box(world.apply(command).unwrap());
        world
    };
    c.bench_function(what, |b| b.iter_batched(|| world.boxed_clone(), apply, BatchSize::LargeInput));
}

fn edits(c: &mut Criterion) {
    for name in ["rim", "thousand-rims", "net"] {
        let world = world(name);
        edit(c, &format!("{name}: a box comes"), &*world, &a_box(&*world));
        let bond = Selection { bonds: vec![BondId(world.bonds().len() as u32 / 2)], ..Selection::default() };
        edit(c, &format!("{name}: a bond goes"), &*world, &Command::Delete(bond));
        // One beside a pin, where there are any.
        let middle = PointId(world.point_count() as u32 / 2 + 1);
        edit(c, &format!("{name}: a grab"), &*world, &Command::Grab(Reach::Points(vec![middle])));
        c.bench_function(&format!("{name}: a copy"), |b| b.iter_with_large_drop(|| world.boxed_clone()));
    }
}

criterion_group!(benches, edits);
criterion_main!(benches);
