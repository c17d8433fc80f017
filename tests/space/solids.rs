//! Rigid bodies of many points among planes: the corners of their hulls touch, and move all of it.

use serde_json::{Value, json};
use wobble::sim::frame_of;

use super::tops::{is_a_body, mean, moving, run};
use super::{G, cross, dot, length, sub, world};
use crate::large::models::Draw;

/// Counted work of a frame that a body may take [ms].
const FRAME: f64 = 8.0;

/// Points of 1 kg of a lattice about a place, turned about x, then about z.
fn lattice(sides: [u32; 3], spacing: f64, at: [f64; 3], [about_x, about_z]: [f64; 2]) -> Vec<[f64; 3]> {
    let place = |k: u32| {
        let numbers = [k % sides[0], k / sides[0] % sides[1], k / sides[0] / sides[1]];
        let half = |axis: usize| 0.5 * f64::from(sides[axis] - 1);
        let [x, y, z] = [0, 1, 2].map(|axis| spacing * (f64::from(numbers[axis]) - half(axis)));
        let [y, z] = [about_x.cos() * y - about_x.sin() * z, about_x.sin() * y + about_x.cos() * z];
        [at[0] + about_z.cos() * x - about_z.sin() * y, at[1] + about_z.sin() * x + about_z.cos() * y, at[2] + z]
    };
    (0..sides.iter().product()).map(place).collect()
}

/// What is rigid by its bonds to all points within 1.8 spacings, thrown among walls.
fn among(position: &[[f64; 3]], velocity: &[[f64; 3]], spacing: f64, walls: &Value) -> Value {
    let near = |a: usize, b: usize| length(sub(position[a], position[b])) < 1.8 * spacing;
    let pairs = (0..position.len()).flat_map(|a| (a + 1..position.len()).map(move |b| (a, b)));
    let bonds: Vec<Value> = pairs.filter(|(a, b)| near(*a, *b)).map(|(a, b)| json!({"a": a, "b": b})).collect();
    json!({"wobble": 1, "dimensions": 3, "gravity": [0, -G, 0], "bounds": walls, "method": {"sleep": false},
        "points": {"position": position, "velocity": velocity}, "bonds": bonds})
}

fn walls(friction: f64, restitution: f64) -> Value {
    json!({"min": [-3, 0, -3], "max": [3, 9, 3], "friction": friction, "restitution": restitution})
}

#[test]
fn a_box_of_many_points_slides_as_far_as_coulombs_law_lets_it() {
    let position = lattice([5, 4, 5], 0.1, [0.0, 0.15, 0.0], [0.0; 2]);
    let scene = among(&position, &moving(&position, [0.6, 0.0, -0.8], [0.0; 3]), 0.1, &walls(0.3, 0.0));
    let (end, world) = run(&scene, 1.5);
    assert!(is_a_body(&*world), "{:?}", world.moved_by());
    let gone = 1.0 / (2.0 * 0.3 * G);
    let off = length(sub(mean(&end.position), [0.6 * gone, 0.15, -0.8 * gone]));
    assert!(off < 1e-9, "{off}");
    assert!(end.max_strain < 1e-12);
}

/// A cube that falls on a corner: of what closes there e comes back, and friction that holds leaves it no speed along the floor.
#[test]
fn a_cube_that_is_dropped_on_a_corner_goes_on_by_newtons_law_of_restitution() {
    let (sides, spacing, restitution, angles) = (5, 0.1, 0.6, [0.5, 0.4]);
    let start = lattice([sides; 3], spacing, [0.0; 3], angles);
    let low = *start.iter().min_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
    let height = 0.3;
    let position = lattice([sides; 3], spacing, [0.0, height - low[1], 0.0], angles);
    let mass = f64::from(sides.pow(3));
    // A cube's tensor of inertia is a multiple of the unit's.
    let inertia = mass * spacing * spacing * (f64::from(sides * sides) - 1.0) / 6.0;
    let closing = (2.0 * G * height).sqrt();
    for friction in [0.0, 9.0] {
        let still = vec![[0.0; 3]; position.len()];
        let scene = among(&position, &still, spacing, &walls(friction, restitution));
        let after = 0.02;
        let (end, world) = run(&scene, closing / G + after);
        assert!(is_a_body(&*world), "{:?}", world.moved_by());
        let up = (1.0 + restitution) * closing;
        let normal = [0.0, 1.0, 0.0];
        let lever = cross(low, normal);
        let impulse = if friction == 0.0 {
            [0.0, up / (1.0 / mass + dot(lever, lever) / inertia), 0.0]
        } else {
            // What the impulse changes of the corner's velocity is (1/m + r^2/I) J - r (r . J)/I.
            let ease = 1.0 / mass + dot(low, low) / inertia;
            std::array::from_fn(|k| up / ease * (normal[k] + low[k] * low[1] * mass / inertia))
        };
        let speed: [f64; 3] =
            std::array::from_fn(|k| impulse[k] / mass - if k == 1 { closing + G * after } else { 0.0 });
        let off = length(sub(mean(&end.velocity), speed));
        assert!(off < 1e-9, "{friction}: {:?} {speed:?}", mean(&end.velocity));
        let spin = cross(low, impulse).map(|l| l / inertia);
        // Without torque a cube keeps its spin.
        let [a, b] = [0, position.len() - 1];
        let turned = cross(spin, sub(end.position[b], end.position[a]));
        let off = length(sub(sub(end.velocity[b], end.velocity[a]), turned));
        assert!(off < 1e-9, "{friction}: {off}");
    }
}

/// One of a hundred bodies, of up to 64 points, thrown; and the friction and restitution of what it meets.
fn thrown(case: u64) -> (Value, [f64; 2]) {
    let mut draw = Draw(1_000 + case);
    for _ in 0..9 {
        draw.next();
    }
    let mut among_of = |list: [f64; 3]| list[((draw.next() + 0.5) * 3.0) as usize];
    let (friction, restitution) = (among_of([0.0, 0.3, 0.9]), among_of([0.0, 0.5, 1.0]));
    let sides = [2, 3, 4].map(|_| 2 + ((draw.next() + 0.5) * 3.0) as u32);
    let angles = [0, 1].map(|_| 6.0 * draw.next());
    let position = lattice(sides, 0.15, [0, 1, 2].map(|k| if k == 1 { 1.5 } else { 2.0 * draw.next() }), angles);
    let [along, spin] = [8.0, 16.0].map(|most| [0, 1, 2].map(|_| most * draw.next()));
    (among(&position, &moving(&position, along, spin), 0.15, &walls(friction, restitution)), [friction, restitution])
}

#[test]
fn a_hundred_bodies_that_are_thrown_gain_nothing_are_never_frozen_and_take_a_few_milliseconds() {
    for case in 0..100 {
        let (scene, [friction, restitution]) = thrown(case);
        let mut world = world(&scene);
        let start = world.energy();
        let (mut last, mut work, mut seen, mut frozen) = (start, 0.0, 0.0_f64, 0);
        while world.time() < 1.5 {
            world.step();
            let energy = world.energy();
            assert!(energy < last + 1e-6 * start, "{case}: {energy} J after {last} at {} s", world.time());
            last = energy;
            if frame_of(world.time() + world.substep()) == frame_of(world.time()) {
                continue;
            }
            seen = seen.max(world.counters().work_ms() - work);
            work = world.counters().work_ms();
            let sample = world.sample(world.time());
            let low = sample.position.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
            assert!(low > -1e-9, "{case}: {low} m");
            // What stands still has three points on something.
            let is_still = sample.velocity.iter().all(|v| length(*v) == 0.0);
            let is_on = |x: &&[f64; 3]| x[1].min(3.0 - x[0].abs()).min(3.0 - x[2].abs()) < 1e-9;
            frozen += u32::from(is_still && sample.position.iter().filter(is_on).count() < 3);
        }
        assert!(is_a_body(&*world), "{case}: {:?}", world.moved_by());
        assert!(seen <= FRAME, "{case}: {seen} ms a frame");
        assert!(frozen == 0, "{case}: it was frozen in {frozen} frames");
        let keeps = friction == 0.0 && restitution == 1.0;
        assert!(!keeps || last > 0.99 * start, "{case}: {last} J of {start}");
    }
}
