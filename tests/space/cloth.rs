//! Cloth that falls on balls, boxes, other cloth and itself. What passed and what pokes through is looked for by other means than the
//! engine's: from frame to frame, and against the obstacles' own equations.

use serde_json::{Value, json};
use wobble::sim::{Dynamics, Figure, PointId, Sample};

use super::{G, cross, dot, length, run, sub, world};

/// A level square of cloth, its middle at a place.
fn cloth(count: u32, size: f64, [x, y, z]: [f64; 3]) -> Value {
    let spacing = size / f64::from(count - 1);
    json!({"make": "cloth", "columns": count, "rows": count, "spacing": spacing, "u": [1, 0, 0], "v": [0, 0, 1],
        "origin": [x - 0.5 * size, y, z - 0.5 * size],
        "material": {"kind": "spring", "stiffness": 400, "damping": 0.05, "mass": 0.4}})
}

fn scene(bodies: Value, obstacles: Value) -> Value {
    json!({"wobble": 1, "dimensions": 3, "gravity": [0, -G, 0], "drag_rate": 0.2, "contact": {"friction": 0.4},
        "bodies": bodies, "obstacles": obstacles})
}

fn corners(world: &dyn Dynamics) -> Vec<[usize; 3]> {
    world.triangles().iter().map(|corners| corners.map(PointId::index)).collect()
}

/// Where p lies over the plane of a triangle: how high [m], and by how much inside of all sides [m], below 0 beyond one.
fn over(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> (f64, f64) {
    let normal = cross(sub(b, a), sub(c, a));
    let unit = normal.map(|n| n / length(normal));
    let inside = [[a, b], [b, c], [c, a]].map(|[from, to]| {
        let side = cross(unit, sub(to, from));
        dot(sub(p, from), side) / length(side)
    });
    (dot(sub(p, a), unit), inside.into_iter().fold(f64::INFINITY, f64::min))
}

/// How often a point was over the inside of a triangle on one side of it, and a frame later on the other.
fn passed(triangles: &[[usize; 3]], before: &Sample, now: &Sample) -> usize {
    let mut count = 0;
    for corners in triangles {
        let [from, to] = [before, now].map(|sample| corners.map(|i| sample.position[i]));
        let middle = to[0];
        let far = length(sub(to[1], to[0])).max(length(sub(to[2], to[0])));
        for p in 0..now.position.len() {
            if corners.contains(&p) || length(sub(now.position[p], middle)) > 2.0 * far {
                continue;
            }
            let (was, had) = over(before.position[p], from);
            let (is, has) = over(now.position[p], to);
            count += usize::from(had > 1e-3 * far && has > 1e-3 * far && was * is < 0.0);
        }
    }
    count
}

/// Steps to `t`, and looks at each frame for what passes and for energy from nowhere.
fn fall(scene: &Value, t: f64) -> (Sample, Box<dyn Dynamics>) {
    let mut world = world(scene);
    let triangles = corners(&*world);
    let mut before = world.sample(0.0);
    let (first, mut most) = (before.energy, 0.0_f64);
    while world.time() < t - 1e-9 {
        world.step();
        let now = world.sample(world.time());
        assert_eq!(passed(&triangles, &before, &now), 0, "at {} s", world.time());
        most = most.max(now.energy - first);
        before = now;
    }
    assert!(most < 1e-3 * first.abs().max(1.0), "{most} J from nowhere, of {first}");
    (before, world)
}

/// How deep the deepest place of the triangles is inside a ball or box [m]: places on a fine grid over each.
fn deepest(figure: &Figure, triangles: &[[usize; 3]], sample: &Sample) -> f64 {
    let inside = |x: [f64; 3]| match figure {
        Figure::Ball { center, radius } => radius - length(sub(x, *center)),
        Figure::Box { .. } => {
            let frame = figure.frame().unwrap();
            let off = sub(x, frame.center);
            (0..3).map(|k| frame.half[k] - dot(off, frame.axes[k]).abs()).fold(f64::INFINITY, f64::min)
        }
    };
    let mut most = 0.0_f64;
    for corners in triangles {
        let [a, b, c] = corners.map(|i| sample.position[i]);
        for i in 0..=6 {
            for j in 0..=6 - i {
                let [s, t] = [i, j].map(|k| f64::from(k) / 6.0);
                most = most.max(inside(std::array::from_fn(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]))));
            }
        }
    }
    most
}

#[test]
fn a_cloth_drapes_over_a_ball_and_sleeps() {
    let ball = json!([{"circle": {"center": [0, 0, 0], "radius": 0.4}, "friction": 0.5},
        {"plane": {"point": [0, -0.6, 0], "normal": [0, 1, 0]}, "friction": 0.5}]);
    let scene = scene(json!([cloth(20, 1.2, [0.02, 0.5, 0.01])]), ball);
    let (sample, mut world) = fall(&scene, 3.0);
    let figure = world.convex()[0].figure;
    let deep = deepest(&figure, &corners(&*world), &sample);
    assert!(deep < 1e-3 * 0.4, "{deep} m inside");
    assert!(sample.position.iter().all(|x| x[1] > -0.6 - 1e-4));
    let over = sample.position.iter().filter(|x| length(**x) < 0.42).count();
    assert!(over > 60, "it lies on the ball by {over} points");
    while !world.is_asleep() && world.time() < 12.0 {
        world.step();
    }
    assert!(world.is_asleep(), "after 12 s");
    let counted = *world.counters();
    (0..10).for_each(|_| world.step());
    assert_eq!(counted.bonds_solved, world.counters().bonds_solved, "what sleeps is not stepped");
}

#[test]
fn no_corner_and_no_edge_of_a_box_pokes_through_a_coarse_cloth() {
    let figure = json!([{"box": {"min": [-0.3, -0.3, -0.3], "max": [0.3, 0.3, 0.3], "rotation": {"axis": [1, 0.2, 0.5], "angle": 0.7}}, "friction": 0.5}]);
    // Cells of a third of the box.
    let scene = scene(json!([cloth(10, 1.8, [0.0, 0.7, 0.0])]), figure);
    let (sample, world) = fall(&scene, 3.0);
    let figure = world.convex()[0].figure;
    let triangles = corners(&*world);
    let deep = deepest(&figure, &triangles, &sample);
    assert!(deep < 5e-3, "{deep} m inside");
    for corner in figure.frame().unwrap().corners() {
        // A ray from the middle through a corner meets the cloth behind the corner or nowhere.
        for corners in &triangles {
            let [a, b, c] = corners.map(|i| sample.position[i]);
            let normal = cross(sub(b, a), sub(c, a));
            let t = dot(normal, a) / dot(normal, corner);
            let (_, within) = over(corner.map(|x| x * t), [a, b, c]);
            assert!(!(within > 1e-6 && t > 0.0 && t < 0.99), "a corner pokes through by {}", 1.0 - t);
        }
    }
    assert!(sample.position.iter().any(|x| length(*x) < 0.6), "it hangs on the box");
}

#[test]
fn a_cloth_that_folds_on_the_floor_does_not_pass_itself() {
    let floor = json!([{"plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}, "friction": 0.4}]);
    // It stands on its edge, a little off the vertical.
    let standing = json!({"make": "cloth", "columns": 8, "rows": 16, "spacing": 0.06, "u": [1, 0, 0], "v": [0.0, -1, 0.08],
        "origin": [0, 0.95, 0], "material": {"kind": "spring", "stiffness": 400, "damping": 0.05, "mass": 0.2}});
    let (sample, world) = fall(&scene(json!([standing]), floor), 3.0);
    assert!(world.counters().contacts > 1000, "{:?}", world.counters());
    let lowest = sample.position.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
    let highest = sample.position.iter().map(|x| x[1]).fold(0.0, f64::max);
    assert!(lowest > -5e-4 && highest < 0.3, "from {lowest} to {highest} m");
}

#[test]
fn a_plate_of_rigid_bonds_that_falls_on_a_box_stays_whole_and_gains_nothing() {
    let mut plate = cloth(12, 1.32, [-0.04, 1.2, -0.04]);
    plate["material"] = json!({"kind": "rigid", "mass": 144});
    plate["diagonals"] = json!("both");
    let obstacles = json!([{"plane": {"point": [0, -1, 0], "normal": [0, 1, 0]}},
        {"box": {"min": [-0.3, -1, -0.3], "max": [0.3, -0.3, 0.3]}}]);
    let mut world = world(&scene(json!([plate]), obstacles));
    let energy = |sample: &Sample| sample.energy;
    let start = energy(&world.sample(0.0));
    while world.time() < 1.5 {
        world.step();
        let sample = world.sample(world.time());
        assert!(sample.max_strain < 0.6, "strain {} at {} s", sample.max_strain, sample.time);
        assert!(energy(&sample) < start + 1e-3 * start.abs(), "{} J of {start} at {} s", energy(&sample), sample.time);
    }
    let on_the_box = world.sample(1.5).position.iter().filter(|x| x[1] > -0.32).count();
    assert!(on_the_box > 0, "it has met the box");
}

#[test]
fn two_cloths_that_fall_on_each_other_stay_apart() {
    let floor = json!([{"plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}, "friction": 0.4}]);
    let lower = cloth(9, 0.6, [0.0, 0.1, 0.0]);
    let mut upper = cloth(9, 0.6, [0.11, 0.25, 0.07]);
    upper["velocity"] = json!([0, -3, 0]);
    let (sample, world) = fall(&scene(json!([lower, upper]), floor), 1.5);
    assert!(world.counters().contacts > 1000);
    let mean = |list: &[[f64; 3]]| list.iter().map(|x| x[1]).sum::<f64>() / list.len() as f64;
    let (below, above) = sample.position.split_at(81);
    assert!(mean(above) > mean(below), "{} over {}", mean(above), mean(below));
}

#[test]
fn a_point_at_50_m_s_does_not_pass_a_cloth() {
    for (speed, mass) in [(5.0, 0.01), (50.0, 0.001), (50.0, 0.01), (50.0, 1.0)] {
        let mut scene = scene(json!([cloth(9, 0.8, [0.0, 0.0, 0.0])]), json!([]));
        scene["bodies"][0]["pinned"] = json!([0, 8, 72, 80]);
        scene["gravity"] = json!([0, 0, 0]);
        scene["points"] = json!({"position": [[0.013, 0.5, 0.027]], "velocity": [[0, -speed, 0]], "mass": mass});
        scene["bodies"][0]["material"]["kind"] = json!("rigid");
        scene["bodies"][0]["material"] = json!({"mass": 0.4});
        let (sample, world) = run(&scene, 0.5 / speed + 0.05);
        let triangles = corners(&*world);
        // It is above the triangle that it lies over; none is left that it lies under.
        let p = sample.position[0];
        for corners in &triangles {
            let at = corners.map(|i| sample.position[i]);
            let (height, within) = over(p, at);
            let up = cross(sub(at[1], at[0]), sub(at[2], at[0]))[1].signum();
            assert!(within < 0.0 || height * up > 0.0, "{speed} m/s of {mass} kg: {height} m");
        }
        assert!(world.counters().contacts > 0);
    }
}

#[test]
fn a_copy_runs_on_to_the_same_bits_and_so_does_another_run() {
    let ball = json!([{"circle": {"center": [0, 0, 0], "radius": 0.4}}]);
    let scene = scene(json!([cloth(10, 1.0, [0.02, 0.45, 0.01])]), ball);
    let (_, mut world) = run(&scene, 0.5);
    let mut copy = world.boxed_clone();
    for _ in 0..30 {
        world.step();
        copy.step();
    }
    let (again, _) = run(&scene, world.time());
    let one = world.sample(world.time());
    assert_eq!(
        (&one.position, &one.velocity),
        (&copy.sample(copy.time()).position, &copy.sample(copy.time()).velocity)
    );
    assert_eq!((&one.position, &one.velocity), (&again.position, &again.velocity));
}
