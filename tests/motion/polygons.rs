//! Points, ropes and bodies among polygons: against closed forms, against planes that are the same, and at speeds at which a
//! wall is thinner than a substep's way.

use std::path::{Path, PathBuf};

use super::common::physics::{run_to, spring};
use wobble::picture::{Picture, encode};
use wobble::scene::Scene;
use wobble::sim::{Bond, Bounds, Method, Model, Plane, PointId, Polygon, Sample, Solver, build};

const G: f64 = 9.81;

fn rod(a: u32, b: u32, length: f64) -> Bond {
    Bond::new(PointId(a), PointId(b), length)
}

fn polygon(loops: Vec<Vec<[f64; 2]>>, restitution: f64, friction: f64) -> Polygon {
    Polygon { loops, restitution, friction }
}

fn rectangle([left, low]: [f64; 2], [right, high]: [f64; 2]) -> Vec<[f64; 2]> {
    vec![[left, low], [right, low], [right, high], [left, high]]
}

/// A room from -1 to 1 in walls that are `thick` [m].
fn room(thick: f64, restitution: f64, friction: f64) -> Polygon {
    let outer = 1.0 + thick;
    polygon(vec![rectangle([-outer; 2], [outer; 2]), rectangle([-1.0; 2], [1.0; 2])], restitution, friction)
}

fn points(position: Vec<[f64; 2]>, velocity: Vec<[f64; 2]>, polygons: Vec<Polygon>) -> Model<2> {
    let mass = vec![1.0; position.len()];
    Model { position, velocity, mass, polygons, gravity: [0.0, -G], ..Model::default() }
}

fn at(model: &Model<2>, solver: Solver, h: f64, t: f64) -> Sample {
    let method = Method { solver, substep: Some(h), ..Method::default() };
    let model = Model { method, duration: Some(t), ..model.clone() };
    run_to(&mut *build(&model).unwrap(), t)
}

fn off(sample: &Sample, truth: &[[f64; 2]]) -> f64 {
    let distance = |(x, y): (&[f64; 3], &[f64; 2])| (x[0] - y[0]).hypot(x[1] - y[1]);
    sample.position.iter().zip(truth).map(distance).fold(0.0, f64::max)
}

/// Where a point of a room from -1 to 1 is that flies for `t` without gravity and is reflected by its walls.
fn reflected(x: f64, v: f64, t: f64) -> f64 {
    let place = (x + v * t + 1.0).rem_euclid(4.0);
    if place < 2.0 { place - 1.0 } else { 3.0 - place }
}

#[test]
fn a_point_in_a_room_flies_as_if_reflected() {
    let mut model = points(vec![[0.3, -0.2]], vec![[100.0, 61.7]], vec![room(1e-3, 1.0, 0.0)]);
    model.gravity = [0.0; 2];
    for (solver, h) in [(Solver::Auto, 1.0 / 60.0), (Solver::Rk4, 0.1), (Solver::VelocityVerlet, 0.003)] {
        let end = at(&model, solver, h, 3.0);
        let truth = [reflected(0.3, 100.0, 3.0), reflected(-0.2, 61.7, 3.0)];
        assert!(off(&end, &[truth]) < 1e-9, "{solver:?}: {:?} {truth:?}", end.position);
    }
}

#[test]
fn walls_of_a_polygon_are_as_bounds_and_planes_are() {
    let start = |polygons, bounds, planes| {
        let mut model = points(vec![[0.2, 0.3], [-0.4, 0.5]], vec![[1.0, 0.3], [-2.0, 0.0]], polygons);
        model.bonds = [spring(0, 1, 0.5, 200.0, 0.3)].into();
        Model { bounds, planes, ..model }
    };
    let material = (0.6, 0.2);
    let bounds = Bounds { min: [-1.0; 2], max: [1.0; 2], restitution: material.0, friction: material.1 };
    let plane =
        Plane { point: [0.0, -1.0], normal: [-1.0, 2.0], restitution: material.0, friction: material.1, penalty: None };
    let inside = polygon(vec![vec![[-3.0, -2.5], [3.0, 0.5], [3.0, -3.0]]], material.0, material.1);
    let truth = start(vec![], Some(bounds), vec![plane]);
    let same = start(vec![room(0.5, material.0, material.1), inside], None, vec![]);
    for (solver, allowed) in [(Solver::Rk8, 1e-8), (Solver::Auto, 1e-6)] {
        for t in [0.4, 1.0, 2.0, 3.0] {
            let (a, b) = (at(&truth, solver, 2e-3, t), at(&same, solver, 2e-3, t));
            let truth: Vec<[f64; 2]> = a.position.iter().map(|x| [x[0], x[1]]).collect();
            assert!(off(&b, &truth) < allowed, "{solver:?}, t = {t}: {:?} {:?}", a.position, b.position);
        }
    }
}

/// Down a ramp of 30 degrees with friction, then off its end: closed forms of both parts.
#[test]
fn a_point_slides_down_a_ramp_and_flies_off_its_end() {
    let (sin, cos) = (0.5, 0.75_f64.sqrt());
    for friction in [0.0, 0.2] {
        let ramp = polygon(vec![vec![[0.0, 0.0], [-2.0 * cos, 1.0], [-2.0 * cos, 0.5], [0.0, -0.5]]], 0.0, friction);
        let model = points(vec![[-cos, 0.5]], vec![[0.0; 2]], vec![ramp]);
        let a = G * (sin - friction * cos);
        let arrival = (2.0 / a).sqrt();
        let (t, speed) = (0.15, (2.0 * a).sqrt());
        let truth = [speed * cos * t, -speed * sin * t - 0.5 * G * t * t];
        for (solver, allowed) in [(Solver::Rk4, 1e-9), (Solver::Auto, 1e-9), (Solver::VelocityVerlet, 0.06)] {
            let end = at(&model, solver, 0.01, arrival + t);
            assert!(off(&end, &[truth]) < allowed, "{solver:?}, {friction}: {:?} {truth:?}", end.position);
        }
    }
}

/// A bowl of many sides: without friction, and restitution 0, each corner takes what of the velocity goes across it.
#[test]
fn a_point_that_slides_in_a_bowl_loses_what_its_corners_take() {
    const SIDES: u32 = 200;
    let corner = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(SIDES);
        [angle.cos(), angle.sin()]
    };
    let bowl: Vec<[f64; 2]> = (0..SIDES).map(corner).collect();
    let model = points(
        vec![[-0.999_8 * 0.75_f64.sqrt(), -0.999_8 * 0.5]],
        vec![[0.0; 2]],
        vec![polygon(vec![rectangle([-2.0; 2], [2.0; 2]), bowl], 0.0, 0.0)],
    );
    let mut energies = Vec::new();
    for t in [0.0, 0.5, 1.0, 4.0] {
        let end = at(&model, Solver::Rk4, 0.005, t);
        let [x, y, _] = end.position[0];
        assert!(x.hypot(y) < 1.0 + 1e-9, "inside the bowl: {:?}", end.position);
        energies.push(end.energy);
    }
    let drop = energies[0] + G;
    assert!(energies.windows(2).all(|pair| pair[1] <= pair[0] + 1e-9), "{energies:?}");
    // Each corner turns by tau/200 and takes (tau/200)^2 of the energy of motion.
    let most = drop * (1.0 - (1.0 - (std::f64::consts::TAU / 200.0).powi(2)).powi(80));
    assert!(energies[0] - energies[1] < most && energies[3] > -G, "{energies:?}, at most {most}");
}

#[test]
fn a_point_rests_in_a_corner_of_two_sides_and_on_a_flat_joint() {
    let v = polygon(vec![vec![[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]]], 0.3, 0.0);
    let tile = |left: f64| polygon(vec![rectangle([left, -1.0], [left + 1.0, 0.0])], 0.0, 0.0);
    for solver in [Solver::Auto, Solver::Rk4, Solver::VelocityVerlet] {
        let end = at(&points(vec![[0.4, 1.5]], vec![[0.0; 2]], vec![v.clone()]), solver, 0.005, 12.0);
        assert!(off(&end, &[[0.0, 0.0]]) < 1e-3, "{solver:?}: {:?}", end.position);
        let tiles = vec![tile(-1.0), tile(0.0), tile(1.0)];
        let end = at(&points(vec![[-0.9, 0.0]], vec![[1.0, 0.0]], tiles), solver, 0.01, 2.5);
        assert!(off(&end, &[[1.6, 0.0]]) < 1e-9, "no bump at joints, {solver:?}: {:?}", end.position);
    }
}

#[test]
fn crowds_that_are_not_located_keep_their_energy() {
    let side = 24;
    let place = |k: i32| {
        [k % side, k / side].map(|i| -0.9 + 1.8 * (f64::from(i) + 0.3 * (f64::from(k) * 1.7).sin()) / f64::from(side))
    };
    let thrown = |k: i32| [3.0 * (f64::from(k) * 2.3).cos(), 3.0 * (f64::from(k) * 3.1).sin()];
    let few = points(
        (0..side * side).map(place).collect(),
        (0..side * side).map(thrown).collect(),
        vec![room(0.1, 1.0, 0.0)],
    );
    let many = (0..2 * side * side).map(|k| (place(k / 2), thrown(k)));
    let (position, velocity) = many.unzip();
    let bounds = Some(Bounds { min: [-1.0; 2], max: [1.0; 2], restitution: 1.0, friction: 0.0 });
    let many = Model { bounds, ..points(position, velocity, Vec::new()) };
    let energy = |sample: &Sample| -> f64 {
        sample.position.iter().zip(&sample.velocity).map(|(x, v)| G * x[1] + 0.5 * (v[0] * v[0] + v[1] * v[1])).sum()
    };
    for model in [few, many] {
        let start = energy(&build(&model).unwrap().sample(0.0)) + G * model.position.len() as f64;
        for solver in [Solver::Auto, Solver::VelocityVerlet] {
            let end = energy(&at(&model, solver, 1.0 / 60.0, 4.0)) + G * model.position.len() as f64;
            assert!((end / start - 1.0).abs() < 5e-3, "{solver:?}: {}", end / start);
        }
    }
}

#[test]
fn what_starts_inside_is_put_out_to_the_nearest_side() {
    let block = || vec![polygon(vec![rectangle([-1.0, -1.0], [1.0, 0.0])], 0.0, 0.0)];
    for solver in [Solver::Auto, Solver::Rk4, Solver::VelocityVerlet] {
        let end = at(&points(vec![[0.3, -0.1]], vec![[0.0; 2]], block()), solver, 0.01, 0.5);
        assert!(off(&end, &[[0.3, 0.0]]) < 1e-9, "{solver:?}: {:?}", end.position);
    }
}

/// Whether a point lies in the wall of a maze by more than `depth`, by the sides one by one.
fn depth_inside(polygon: &Polygon, x: [f64; 2]) -> f64 {
    let (mut inside, mut nearest) = (false, f64::INFINITY);
    for corners in &polygon.loops {
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            if (a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
                inside = !inside;
            }
            let (along, from) = ([b[0] - a[0], b[1] - a[1]], [x[0] - a[0], x[1] - a[1]]);
            let square = along[0] * along[0] + along[1] * along[1];
            let share = ((along[0] * from[0] + along[1] * from[1]) / square).clamp(0.0, 1.0);
            nearest = nearest.min((from[0] - share * along[0]).hypot(from[1] - share * along[1]));
        }
    }
    if inside { nearest } else { 0.0 }
}

/// A hole with a tip at the origin, open by so many degrees and turned so far from upwards, and the turn.
fn notch(degrees: f64, turn: f64, restitution: f64, friction: f64) -> (Polygon, impl Fn([f64; 2]) -> [f64; 2]) {
    let turned = move |[x, y]: [f64; 2]| [x * turn.cos() - y * turn.sin(), x * turn.sin() + y * turn.cos()];
    let (sin, cos) = (0.5 * degrees).to_radians().sin_cos();
    let hole = [[0.0, 0.0], [2.0 * sin, 2.0 * cos], [-2.0 * sin, 2.0 * cos]].map(turned).to_vec();
    (polygon(vec![rectangle([-4.0; 2], [4.0; 2]), hole], restitution, friction), turned)
}

#[test]
fn points_that_bounce_in_a_notch_keep_their_energy() {
    for (degrees, turn) in [(8.0_f64, 0.3), (16.0, 1.2), (44.0, 2.0), (90.0, 0.1), (120.0, 4.0)] {
        let (notch, turned) = notch(degrees, turn, 1.0, 0.0);
        for k in 0..30 {
            let wide = 0.7 * (0.5 * degrees).to_radians().tan().min(1.0);
            let place = [wide * (f64::from(k) * 1.9).sin(), 0.9];
            let thrown = [3.0 * (f64::from(k) * 2.3).cos(), 3.0 * (f64::from(k) * 3.1).sin()];
            // Some go for the tip itself.
            let thrown = if k % 3 == 0 { place.map(|x| -2.0 * x) } else { thrown };
            let mut model = points(vec![turned(place)], vec![turned(thrown)], vec![notch.clone()]);
            model.gravity = [0.0; 2];
            for solver in [Solver::Auto, Solver::VelocityVerlet] {
                let end = at(&model, solver, 1.0 / 60.0, 3.0);
                let speed = |v: &[f64]| v[0].hypot(v[1]);
                let change = speed(&end.velocity[0]) / speed(&thrown) - 1.0;
                assert!(change.abs() < 1e-9, "{degrees} degrees, {k}, {solver:?}: {change}");
                assert!(depth_inside(&notch, [end.position[0][0], end.position[0][1]]) < 1e-9);
            }
        }
    }
}

#[test]
fn points_among_scraps_that_overlap_keep_their_speeds() {
    // Numbers that look random: 0 to 1.
    let number_at = |seed: i32, k: i32| (43_758.545_3 * (f64::from(seed * 131 + k) * 12.9898).sin()).rem_euclid(1.0);
    for seed in 0..40 {
        let mut scraps = vec![room(0.3, 1.0, 0.0)];
        for scrap in 0..3 + seed % 5 {
            let number = |k: i32| 2.0 * number_at(seed, 100 * scrap + k) - 1.0;
            let corner = |k: i32| [0, 1].map(|axis| 0.8 * number(axis) + 0.5 * number(2 + 2 * k + axis));
            scraps.push(polygon(vec![(0..3 + scrap % 4).map(corner).collect()], 1.0, 0.0));
        }
        let place = |k: i32| [0, 1].map(|axis| 1.8 * number_at(seed, 2_000 + 2 * k + axis) - 0.9);
        let free: Vec<i32> =
            (0..60).filter(|&k| scraps.iter().all(|scrap| depth_inside(scrap, place(k)) == 0.0)).take(20).collect();
        let thrown = |k: i32| [0, 1].map(|axis| 40.0 * number_at(seed, 3_000 + 2 * k + axis) - 20.0);
        let velocity: Vec<[f64; 2]> = free.iter().map(|&k| thrown(k)).collect();
        let mut model = points(free.iter().map(|&k| place(k)).collect(), velocity.clone(), scraps.clone());
        model.gravity = [0.0; 2];
        let end = run_to(&mut *build(&Model { duration: Some(2.0), ..model.clone() }).unwrap(), 2.0);
        for (k, (now, before)) in end.velocity.iter().zip(&velocity).enumerate() {
            let change = now[0].hypot(now[1]) / before[0].hypot(before[1]) - 1.0;
            assert!(change.abs() < 1e-6, "scene {seed}, point {k}: {change}");
            let deepest = scraps.iter().map(|scrap| depth_inside(scrap, [end.position[k][0], end.position[k][1]]));
            assert!(deepest.fold(0.0, f64::max) < 1e-9, "scene {seed}, point {k} is inside");
        }
    }
}

/// No point of `model` gets into the polygon: deeper than settling in a tip takes it for a moment.
fn assert_outside(model: &Model<2>, polygon: &Polygon, case: &str) {
    for t in [0.7, 4.0] {
        let end = at(model, Solver::Auto, 1.0 / 60.0, t);
        let deepest = end.position.iter().map(|x| depth_inside(polygon, [x[0], x[1]])).fold(0.0, f64::max);
        assert!(deepest < 1e-4, "{case}: {deepest} m inside at {t} s");
    }
}

#[test]
fn points_in_a_notch_come_to_rest_in_its_tip() {
    let (turns, surfaces) = ([0.1, 1.15, 4.3], [(0.0, 0.0), (0.5, 0.0), (0.5, 0.3)]);
    // Every angle with all turns and with all surfaces, turned by another one each time.
    for (k, degrees) in [8.0, 16.0, 44.0, 140.0].into_iter().enumerate() {
        for (i, turn) in turns.into_iter().enumerate() {
            let (restitution, friction) = surfaces[(i + k) % surfaces.len()];
            let (notch, turned) = notch(degrees, turn, restitution, friction);
            let wide = 0.7 * (0.5 * degrees).to_radians().tan().min(1.0);
            let thrown = |k: i32| [3.0 * (f64::from(k) * 2.3).cos(), 3.0 * (f64::from(k) * 3.1).sin()];
            let place = |k: i32| turned([wide * (f64::from(k) * 1.9).sin(), 0.9]);
            let case = format!("{degrees} degrees turned by {turn}, {restitution}, {friction}");
            for k in 0..3 {
                assert_outside(&points(vec![place(k)], vec![thrown(k)], vec![notch.clone()]), &notch, &case);
            }
            let crowd = points((0..30).map(place).collect(), (0..30).map(thrown).collect(), vec![notch.clone()]);
            assert_outside(&crowd, &notch, &case);
        }
    }
}

/// Bodies of every kind of engine, thrown at 100 m/s about a room with walls of 1 cm and a saw of thin teeth.
#[test]
fn nothing_tunnels_at_a_hundred_metres_a_second() {
    let mut shell = room(0.01, 0.5, 0.1);
    shell.loops.extend((0..5).map(|k| {
        let x = -0.8 + 0.35 * f64::from(k);
        vec![[x, 0.995], [x + 0.01, 0.6], [x + 0.02, 0.995]]
    }));
    let grid = |n: usize, spacing: f64| -> Vec<[f64; 2]> {
        let at = |k: usize| spacing * (k as f64 - 0.5 * (n - 1) as f64);
        (0..n * n).map(|k| [at(k % n), at(k / n)]).collect()
    };
    let lattice = |n: usize, is_rigid: bool| {
        let mut bonds = Vec::new();
        for k in 0..n * n {
            let (column, row) = (k % n, k / n);
            let mut bond = |other: usize, length: f64| {
                let (a, b) = (k as u32, other as u32);
                bonds.push(if is_rigid { rod(a, b, length) } else { spring(a, b, length, 2e3, 0.5) });
            };
            let s = 0.3 / (n - 1) as f64;
            if column + 1 < n {
                bond(k + 1, s);
            }
            if row + 1 < n {
                bond(k + n, s);
            }
            if column + 1 < n && row + 1 < n {
                bond(k + n + 1, s * 2.0_f64.sqrt());
            }
        }
        bonds
    };
    for (name, n, is_bonded, is_rigid) in [
        ("loose points", 6, false, false),
        ("a small spring lattice", 3, true, false),
        ("a small rigid lattice", 3, true, true),
        ("a large spring lattice", 30, true, false),
        ("a large rigid lattice", 30, true, true),
    ] {
        let position = grid(n, 0.3 / (n - 1) as f64);
        let mut model = points(position.clone(), vec![[100.0, 57.0]; position.len()], vec![shell.clone()]);
        if is_bonded {
            model.bonds = lattice(n, is_rigid).into();
        }
        let mut world = build(&model).unwrap();
        let mut worst: f64 = 0.0;
        while world.time() < 1.0 {
            world.step();
            let positions = world.positions();
            for i in 0..world.point_count() {
                let x = [positions.get(2 * i), positions.get(2 * i + 1)];
                assert!(
                    x[0].abs() < 1.01 && x[1].abs() < 1.01,
                    "{name}: point {i} is out at {x:?}, t = {}",
                    world.time()
                );
                worst = worst.max(depth_inside(&shell, x));
            }
        }
        assert!(worst < 4e-3, "{name}: {worst} m deep in a wall");
        assert!(world.counters().events > 0, "{name}");
    }
}

#[test]
fn a_polygon_out_of_reach_costs_nothing() {
    let far = || polygon(vec![rectangle([1e3, 1e3], [1e3 + 1.0, 1e3 + 1.0])], 0.0, 0.0);
    let model = points(vec![[0.0; 2]; 3], vec![[0.0; 2]; 3], vec![far()]);
    let mut world = build(&model).unwrap();
    (0..100).for_each(|_| world.step());
    assert_eq!(world.counters().events, 0);
    let truth = -0.5 * G * world.time().powi(2);
    assert!((world.positions().get(1) - truth).abs() < 1e-9);
}

#[test]
fn a_rigid_box_lands_flat_on_a_tilted_side_and_slides() {
    let (sin, cos) = (0.5, 0.75_f64.sqrt());
    let turn = |x: f64, y: f64| [x * cos + y * sin, -x * sin + y * cos];
    let slope = polygon(vec![vec![turn(-5.0, 0.0), turn(50.0, 0.0), turn(50.0, -1.0), turn(-5.0, -1.0)]], 0.0, 0.0);
    let n = 20;
    let position: Vec<[f64; 2]> =
        (0..n * n).map(|k| turn(0.05 * f64::from(k % n), 1e-6 + 0.05 * f64::from(k / n))).collect();
    let mut bonds = Vec::new();
    for k in 0..(n * n) as u32 {
        let n = n as u32;
        let (right, up) = (k % n + 1 < n, k / n + 1 < n);
        bonds.extend(right.then(|| rod(k, k + 1, 0.05)));
        bonds.extend(up.then(|| rod(k, k + n, 0.05)));
        bonds.extend((right && up).then(|| rod(k, k + n + 1, 0.05 * 2.0_f64.sqrt())));
    }
    let mut model = points(position.clone(), vec![[0.0; 2]; position.len()], vec![slope]);
    model.bonds = bonds.into();
    let mut world = build(&Model { duration: Some(1.0), ..model }).unwrap();
    let end = run_to(&mut *world, 1.0);
    let way = 0.5 * G * sin;
    let truth: Vec<[f64; 2]> = position.iter().map(|x| [x[0] + way * cos, x[1] - way * sin]).collect();
    assert!(off(&end, &truth) < 0.02 * way, "off by {}", off(&end, &truth));
}

/// A ring of ink, radii 20 and 40 px, in a picture of 100 px.
fn ring(folder: &Path) -> PathBuf {
    let mut picture = Picture::filled(100, 100, [0, 0, 0, 0]);
    for i in 0..100 * 100 {
        let from = (i as f64 % 100.0 - 49.5).hypot((i / 100) as f64 - 49.5);
        picture.rgba[4 * i + 3] = if (20.0..40.0).contains(&from) { 255 } else { 0 };
    }
    let path = folder.join("ring.png");
    std::fs::write(&path, encode(&picture).unwrap()).unwrap();
    path
}

fn area(corners: &[[f64; 2]]) -> f64 {
    let side = |k: usize| {
        let ([a, b], [c, d]) = (corners[k], corners[(k + 1) % corners.len()]);
        0.5 * (a * d - b * c)
    };
    (0..corners.len()).map(side).sum::<f64>().abs()
}

#[test]
fn a_picture_stands_as_the_outlines_of_its_ink() {
    let folder = tempfile::tempdir().unwrap();
    ring(folder.path());
    let text = r#"{ "wobble": 1,
        "points": { "position": [[1, 2], [1.1, 3.5]], "mass": 1 }, "gravity": [0, -9.81],
        "obstacles": [
            { "picture": { "file": "ring.png", "height": 2, "origin": [1, 2], "angle": 0.3, "spacing": 0.05 }, "friction": 0.5 },
            { "box": { "min": [4, 0], "max": [6, 2], "angle": 0.7853981633974483 }, "restitution": 0.25 } ] }"#;
    let path = folder.path().join("scene.json");
    std::fs::write(&path, text).unwrap();
    let scene = Scene::read(&path).unwrap();
    let model: Model<2> = scene.model().unwrap();
    let [ring, square] = &model.polygons[..] else { panic!("{:?}", model.polygons) };
    assert_eq!((ring.loops.len(), ring.friction, square.restitution), (2, 0.5, 0.25));
    for (corners, radius) in ring.loops.iter().zip([0.8, 0.4]) {
        let truth = std::f64::consts::PI * radius * radius;
        assert!((area(corners) / truth - 1.0).abs() < 0.01, "{} of {truth}", area(corners));
        assert!(corners.iter().all(|x| ((x[0] - 1.0).hypot(x[1] - 2.0) - radius).abs() < 0.02));
    }
    let top = square.loops[0].iter().map(|x| x[1]).fold(f64::NEG_INFINITY, f64::max);
    assert!((top - 1.0 - 2.0_f64.sqrt()).abs() < 1e-12, "turned about its middle");

    // One point falls within the hole, one on the ring and down its side.
    let mut world = scene.world(None).unwrap();
    let end = run_to(&mut *world, 1.5);
    let from = |i: usize| (end.position[i][0] - 1.0).hypot(end.position[i][1] - 2.0);
    assert!(from(0) < 0.41 && end.position[0][1] < 1.65, "{:?}", end.position);
    assert!(from(1) > 0.79, "{:?}", end.position);

    let expanded = scene.expanded().unwrap();
    assert!(expanded.obstacles.iter().all(|obstacle| obstacle.polygon.is_some()));
    assert_eq!(expanded.model::<2>().unwrap().polygons, model.polygons, "corner by corner");
}

#[test]
fn a_picture_becomes_a_scene_with_an_obstacle_on_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    let (picture, out) = (ring(folder.path()), folder.path().join("out.json"));
    let done = std::process::Command::new(env!("CARGO_BIN_EXE_wobble"))
        .args(["mesh", "--spacing", "6", "--material", "fixed", "--out"])
        .args([&out, &picture])
        .output()
        .unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let scene = Scene::read(&out).unwrap();
    let mut world = scene.world(None).unwrap();
    assert_eq!((world.polygons().len(), world.bonds().len()), (1, 0));
    let polygon = world.polygons()[0].clone();
    let end = run_to(&mut *world, 2.0);
    assert!(end.position.len() > 100 && world.counters().events > 100);
    assert!(end.position.iter().all(|x| depth_inside(&polygon, [x[0], x[1]]) < 1e-6), "none inside");
}

#[test]
fn obstacles_that_cannot_be_are_refused_at_their_key() {
    let error = |keys: &str, dimensions: u32| {
        let text =
            format!(r#"{{ "wobble": 1, "dimensions": {dimensions}, "obstacles": [{{ "picture": {{ {keys} }} }}] }}"#);
        Scene::parse(&text, "x.json").unwrap_err().to_string()
    };
    assert!(error(r#""file": "none.png""#, 2).contains("obstacles[0].picture.file: `none.png` cannot be found"));
    assert!(error(r#""file": "pictures/gear.png", "height": 0"#, 2).contains("obstacles[0].picture.height"));
    assert!(error(r#""file": "pictures/gear.png", "threshold": 2"#, 2).contains("obstacles[0].picture.threshold"));
    assert!(error(r#""file": "pictures/gear.png""#, 3).contains("obstacles[0].picture: lies in the plane"));
    assert!(error(r#""height": 1"#, 2).contains("file"));
    let model = points(vec![[0.0; 2]], vec![[0.0; 2]], vec![room(0.1, 0.0, 0.0)]);
    assert!(wobble::equilibrium::settle(&model).unwrap_err().to_string().contains("polygons"));
    let model = points(vec![[0.0; 2]], vec![[0.0; 2]], vec![polygon(vec![vec![[0.0; 2]; 2]], 0.0, 0.0)]);
    assert!(model.check().is_err());
}
