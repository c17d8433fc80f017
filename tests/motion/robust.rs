//! Violent, contradictory and degenerate scenes: they stay finite, keep what can be kept, and say what cannot.

use super::common::physics::{run_to, spring};
use wobble::equilibrium::settle;
use wobble::sim::{Bond, BondKind, Bounds, Limit, Method, Model, Plane, PointId, Solver, Track, build};

fn rigid(a: u32, b: u32, rest_length: f64) -> Bond {
    Bond::new(PointId(a), PointId(b), rest_length)
}

fn model(position: Vec<[f64; 2]>, bonds: Vec<Bond>, pinned: &[u32]) -> Model<2> {
    Model {
        velocity: vec![[0.0; 2]; position.len()],
        mass: vec![1.0; position.len()],
        pinned: pinned.iter().map(|&i| PointId(i)).collect(),
        gravity: [0.0, -9.81],
        position,
        bonds: bonds.into(),
        ..Model::default()
    }
}

/// A complete graph on a circle of radius 1; lengths are off by `off`, in turns up and down.
fn complete(count: u32, off: f64) -> Model<2> {
    let at = |i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(count);
        [angle.cos(), angle.sin()]
    };
    let mut bonds = Vec::new();
    for i in 0..count {
        for j in 0..i {
            let (p, q) = (at(i), at(j));
            let sign = if (i + j) % 2 == 0 { 1.0 } else { -1.0 };
            bonds.push(rigid(i, j, (p[0] - q[0]).hypot(p[1] - q[1]) * (1.0 + sign * off)));
        }
    }
    model((0..count).map(at).collect(), bonds, &[])
}

#[test]
fn a_complete_graph_is_a_rigid_body() {
    let mut world = build(&complete(12, 0.0)).unwrap();
    assert!(world.warnings().is_empty());
    let end = run_to(&mut *world, 1.0);
    assert!(end.max_strain < 1e-9, "{}", end.max_strain);
    let truth = -0.5 * 9.81;
    let middle: f64 = end.position.iter().map(|x| x[1]).sum::<f64>() / 12.0;
    assert!((middle - truth).abs() < 1e-9, "{middle}");
}

#[test]
fn lengths_that_contradict_each_other_are_met_in_least_squares_with_a_word() {
    let mut world = build(&complete(12, 0.1)).unwrap();
    assert!(world.warnings()[0].contains("contradict"), "{:?}", world.warnings());
    let start = world.energy();
    let end = run_to(&mut *world, 2.0);
    assert!(end.max_strain < 0.3, "{}", end.max_strain);
    assert!((end.energy - start).abs() < 1e-6 * start.abs().max(1.0), "{start} {}", end.energy);
}

#[test]
fn bonds_that_repeat_each_other_change_nothing() {
    let mut once = model(vec![[0.0, 0.0], [1.0, 0.0]], vec![rigid(0, 1, 1.0)], &[0]);
    // By the rules a tree has a method of its own.
    once.method.solver = Solver::VelocityVerlet;
    let mut thrice = once.clone();
    thrice.bonds.extend([rigid(1, 0, 1.0), rigid(0, 1, 1.0)]);
    let end = |model: &Model<2>| run_to(&mut *build(model).unwrap(), 1.0).position[1];
    let (a, b) = (end(&once), end(&thrice));
    assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9, "{a:?} {b:?}");
}

#[test]
fn degenerate_sets_of_bonds_work() {
    for scene in [
        model(vec![], vec![], &[]),
        model(vec![[0.0, 0.0]], vec![], &[0]),
        model(vec![[0.0, 0.0], [1.0, 0.0]], vec![rigid(0, 1, 1.0)], &[0, 1]),
        model(vec![[0.0, 0.0], [1.0, 0.0]], vec![rigid(0, 1, 2.0)], &[0, 1]),
        model(vec![[0.0, 0.0], [0.0, 0.0]], vec![rigid(0, 1, 1.0)], &[]),
        model(vec![[0.0, 0.0], [0.0, 0.0]], vec![spring(0, 1, 1.0, 100.0, 1.0)], &[]),
        model(vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], vec![rigid(0, 1, 1.0), rigid(1, 2, 1.0)], &[0, 2]),
    ] {
        for solver in Solver::ALL.into_iter().filter(|&solver| solver != Solver::Relaxation) {
            if scene.bonds.iter().any(|bond| solver.refusal(bond.kind).is_some()) {
                continue;
            }
            let method = Method { solver, substep: Some(0.01), iterations: Some(4), ..Method::default() };
            let mut world = build(&Model { method, ..scene.clone() }).unwrap();
            let end = run_to(&mut *world, 0.5);
            let numbers = end.position.iter().chain(&end.velocity).flatten();
            assert!(numbers.into_iter().all(|x| x.is_finite()), "{solver}: {end:?}");
        }
        let found = settle(&scene).unwrap();
        assert!(found.position.iter().flatten().all(|x| x.is_finite()));
    }
}

#[test]
fn a_weld_makes_one_point_of_two() {
    let scene = model(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]], vec![rigid(0, 1, 1.0), rigid(1, 2, 0.0)], &[0]);
    let mut world = build(&scene).unwrap();
    let end = run_to(&mut *world, 1.0);
    assert_eq!(end.position[1], end.position[2]);
    let alone = model(vec![[0.0, 0.0], [1.0, 0.0]], vec![rigid(0, 1, 1.0)], &[0]);
    let truth = run_to(&mut *build(&alone).unwrap(), 1.0).position[1];
    assert!((end.position[1][0] - truth[0]).abs() < 1e-12, "{end:?}");
}

#[test]
fn a_substep_too_long_is_split_and_then_handed_on() {
    // A chain whose links a substep of 0.1 s turns by far more than 30 degrees.
    let position: Vec<[f64; 2]> = (0..11).map(|i| [0.1 * f64::from(i), 0.0]).collect();
    let mut scene = model(position, (0..10).map(|i| rigid(i, i + 1, 0.1)).collect(), &[0]);
    scene.method = Method { solver: Solver::Rk4, substep: Some(0.1), ..Method::default() };
    let mut world = build(&scene).unwrap();
    let start = world.energy();
    let end = run_to(&mut *world, 3.0);
    assert!(world.counters().guard_splits > 0);
    assert!(end.max_strain < 1e-6, "{}", end.max_strain);
    assert!(end.energy < start + 0.05, "{start} {}", end.energy);
    // A spring so stiff that no halving of the substep serves goes to an implicit step.
    let mut stiff = model(vec![[0.0, 0.0], [2.0, 0.0]], vec![spring(0, 1, 1.0, 1e12, 0.0)], &[0]);
    stiff.method = Method { solver: Solver::Rk4, substep: Some(0.01), ..Method::default() };
    let mut world = build(&stiff).unwrap();
    let end = run_to(&mut *world, 1.0);
    assert!(world.counters().fallbacks > 0);
    assert!(end.max_strain < 0.3 && end.energy.is_finite(), "{end:?}");
}

#[test]
fn an_overstretched_bond_is_gone() {
    let weak = Bond { break_strain: 0.05, ..spring(0, 1, 1.0, 100.0, 0.0) };
    let strong = Bond { break_strain: 0.5, ..spring(0, 2, 1.0, 100.0, 0.0) };
    let scene = model(vec![[0.0, 0.0], [-0.3, -1.0], [0.3, -1.0]], vec![weak, strong], &[0]);
    let mut world = build(&scene).unwrap();
    let end = run_to(&mut *world, 1.0);
    assert_eq!((world.counters().bonds_torn, world.bonds().len()), (1, 1));
    assert!(end.position[1][1] < -3.0, "the torn point falls: {:?}", end.position[1]);
    assert!(end.position[2][1] > -1.6, "the other hangs: {:?}", end.position[2]);
}

#[test]
fn a_string_pulls_and_does_not_push() {
    // A rigid string keeps its length; an elastic one overshoots by v sqrt(m/k), about 0.045 m.
    for (kind, longest) in [(BondKind::Rigid, 1.0 + 1e-6), (BondKind::Spring { stiffness: 1e4, damping: 10.0 }, 1.06)] {
        let string = Bond { limit: Limit::Max, kind, ..rigid(0, 1, 1.0) };
        let mut scene = model(vec![[0.0, 0.0], [0.3, 0.2]], vec![string], &[0]);
        scene.method.substep = Some(1e-3);
        let mut world = build(&scene).unwrap();
        let falling = run_to(&mut *world, 0.2);
        assert!((falling.position[1][1] - (0.2 - 0.5 * 9.81 * 0.04)).abs() < 1e-6, "{falling:?}");
        for i in 1..40 {
            let x = run_to(&mut *world, 0.2 + 0.1 * f64::from(i)).position[1];
            assert!(x[0].hypot(x[1]) < longest, "{kind:?}: {x:?}");
        }
    }
}

#[test]
fn a_led_pin_takes_what_hangs_on_it_along() {
    for kind in [BondKind::Rigid, BondKind::Spring { stiffness: 1e4, damping: 50.0 }] {
        let mut scene = model(vec![[0.0, 0.0], [0.0, -1.0]], vec![Bond { kind, ..rigid(0, 1, 1.0) }], &[0]);
        scene.drag_rate = 3.0;
        let knots = vec![(0.0, [0.0, 0.0]), (1.0, [2.0, 1.0]), (1.5, [2.0, 0.5])];
        scene.pin_motion = vec![(PointId(0), Track { knots })];
        let mut world = build(&scene).unwrap();
        let middle = run_to(&mut *world, 0.5);
        assert_eq!(middle.position[0], [1.0, 0.5, 0.0]);
        assert_eq!(middle.velocity[0], [2.0, 1.0, 0.0]);
        let end = run_to(&mut *world, 12.0);
        assert_eq!(end.position[0], [2.0, 0.5, 0.0]);
        assert!((end.position[1][0] - 2.0).abs() < 1e-3 && (end.position[1][1] + 0.5).abs() < 3e-3, "{end:?}");
    }
}

/// A rod that falls level meets the floor with one end: with the bond kept that end gets -e v, and the impulse also turns
/// the rod. For two equal masses m on a light rod at the angle a: v' = -v + J (1/m) along the normal, closed form below.
#[test]
fn an_impact_acts_through_rigid_bonds_at_once() {
    let (a, e) = (0.5_f64, 0.6);
    let mut scene = model(vec![[0.0, 0.01], [a.cos(), 0.01 + a.sin()]], vec![rigid(0, 1, 1.0)], &[]);
    scene.gravity = [0.0, 0.0];
    scene.velocity = vec![[0.0, -2.0]; 2];
    scene.planes = vec![Plane { point: [0.0, 0.0], normal: [0.0, 3.0], restitution: e, friction: 0.0, penalty: None }];
    scene.method.solver = Solver::Rk4;
    let mut world = build(&scene).unwrap();
    let end = run_to(&mut *world, 0.005_01);
    // J on end 0 along y, tension T along the rod: v0 = (T c, -2 + J + T s), v1 = (-T c, -2 - T s), (v0 - v1).d = 0.
    let (s, c) = (a.sin(), a.cos());
    // 2 T + J s = 0 and -2 + J + T s = 2 e, so J (1 - s s/2) = 2 (1 + e).
    let j = 2.0 * (1.0 + e) / (1.0 - 0.5 * s * s);
    let t = -0.5 * j * s;
    let truth = [[t * c, -2.0 + j + t * s], [-t * c, -2.0 - t * s]];
    for i in 0..2 {
        for k in 0..2 {
            assert!((end.velocity[i][k] - truth[i][k]).abs() < 1e-4, "{:?} {truth:?}", end.velocity);
        }
    }
    world.step();
    assert_eq!(world.counters().events, 1, "once, at the time of the impact");
}

#[test]
fn a_rigid_box_comes_to_rest_on_the_floor() {
    let mut scene = model(
        vec![[0.0, 0.5], [1.0, 0.5], [1.0, 1.5], [0.0, 1.5]],
        vec![
            rigid(0, 1, 1.0),
            rigid(1, 2, 1.0),
            rigid(2, 3, 1.0),
            rigid(3, 0, 1.0),
            rigid(0, 2, 2.0_f64.sqrt()),
            rigid(1, 3, 2.0_f64.sqrt()),
        ],
        &[],
    );
    scene.bounds = Some(Bounds { min: [-5.0, 0.0], max: [5.0, 5.0], restitution: 0.3, friction: 0.5 });
    for solver in [Solver::Auto, Solver::Rk4] {
        scene.method.solver = solver;
        let mut world = build(&scene).unwrap();
        let end = run_to(&mut *world, 4.0);
        assert!(end.max_strain < 1e-9, "{solver}: {}", end.max_strain);
        assert!(world.is_still(1e-6), "{solver}: {:?}", end.velocity);
        assert!(end.position[0][1].abs() < 1e-9 && (end.position[2][1] - 1.0).abs() < 1e-9, "{solver}: {end:?}");
    }
}

#[test]
fn a_point_sticks_on_a_slope_that_is_not_steep_and_slides_on_one_that_is() {
    let slope = |angle: f64, friction: f64| {
        let mut scene = model(vec![[0.0, 0.0]], vec![], &[]);
        let normal = [-angle.sin(), angle.cos()];
        scene.planes = vec![Plane { point: [0.0, 0.0], normal, restitution: 0.0, friction, penalty: None }];
        scene.method = Method { substep: Some(1.0 / 240.0), ..Method::default() };
        run_to(&mut *build(&scene).unwrap(), 1.0).position[0]
    };
    let stuck = slope(0.4, 0.5);
    assert!(stuck[0].hypot(stuck[1]) < 1e-12, "{stuck:?}");
    let slid = slope(0.6, 0.5);
    let truth = 0.5 * 9.81 * (0.6_f64.sin() - 0.5 * 0.6_f64.cos());
    assert!((slid[0].hypot(slid[1]) - truth).abs() < 1e-9, "{slid:?} {truth}");
}

#[test]
fn a_chain_that_stands_on_its_pin_settles_below_it() {
    let position = vec![[0.0, 0.0], [0.01, 1.0], [0.0, 2.0]];
    let found = settle(&model(position, vec![rigid(0, 1, 1.0), rigid(1, 2, 1.0)], &[0])).unwrap();
    assert!(found.is_settled, "{found:?}");
    assert!((found.position[2][1] + 2.0).abs() < 1e-9, "a minimum, not a saddle: {found:?}");
}

#[test]
fn a_taut_string_lets_go_of_what_comes_back() {
    let string = Bond { limit: Limit::Max, ..rigid(0, 1, 1.0) };
    for solver in [Solver::Auto, Solver::Rk4, Solver::VelocityVerlet, Solver::Pefrl] {
        let mut falling = model(vec![[0.0, 0.0], [0.6, 0.8]], vec![string], &[0]);
        falling.method = Method { solver, substep: Some(1.0 / 240.0), ..Method::default() };
        let end = run_to(&mut *build(&falling).unwrap(), 0.3);
        let truth = 0.8 - 0.5 * 9.81 * 0.09;
        assert!((end.position[1][1] - truth).abs() < 1e-9, "{solver}: {:?} {truth}", end.position[1]);
        let mut meeting = model(vec![[0.0, 0.0], [1.0, 0.0]], vec![string], &[]);
        meeting.gravity = [0.0, 0.0];
        meeting.velocity = vec![[1.0, 0.0], [-1.0, 0.0]];
        meeting.method = falling.method;
        let end = run_to(&mut *build(&meeting).unwrap(), 0.25);
        assert!((end.position[0][0] - 0.25).abs() < 1e-9, "{solver}: {:?}", end.position);
    }
}

/// A box that falls over its corner: when the other one lands, the first is thrown up, for a floor cannot pull. With four
/// equal masses at the corners the impulse that stops corner 1 alone gives corner 0 a third of its speed upwards.
#[test]
fn a_resting_corner_is_let_go_by_an_impact_on_the_other() {
    let (s, c) = 0.1_f64.sin_cos();
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let position = corners.map(|[p, q]: [f64; 2]| [p * c - q * s, p * s + q * c]).to_vec();
    let side = |a: u32, b: u32| rigid(a, b, 1.0);
    let bonds = vec![side(0, 1), side(1, 2), side(2, 3), side(3, 0), rigid(0, 2, 2.0_f64.sqrt())];
    let mut scene = model(position, bonds, &[]);
    scene.bounds = Some(Bounds { min: [-9.0, 0.0], max: [9.0, 9.0], restitution: 0.0, friction: 0.0 });
    scene.method = Method { solver: Solver::Rk4, substep: Some(1.0 / 960.0), ..Method::default() };
    let mut world = build(&scene).unwrap();
    let mut before = world.sample(0.0);
    while world.counters().events == 0 {
        before = world.sample(world.time());
        assert!(before.time < 0.3, "it never landed");
        world.step();
    }
    let after = world.sample(world.time());
    let (landing, thrown) = (before.velocity[1][1], after.velocity[0][1]);
    assert!(landing < -0.5, "{landing}");
    assert!((thrown + landing / 3.0).abs() < 0.03, "{thrown} after {landing}");
}

#[test]
fn what_stands_on_a_saddle_is_pushed_off_it() {
    let upright =
        model((0..4).map(|i| [0.0, f64::from(i)]).collect(), (0..3).map(|i| rigid(i, i + 1, 1.0)).collect(), &[0]);
    let found = settle(&upright).unwrap();
    assert!(found.is_settled && (found.position[3][1] + 3.0).abs() < 1e-9, "{found:?}");
    let position = (0..5).map(|i| [0.5 * f64::from(i), 0.0]).collect();
    let slack = model(position, (0..4).map(|i| rigid(i, i + 1, 0.6)).collect(), &[0, 4]);
    let found = settle(&slack).unwrap();
    assert!(found.is_settled && found.max_strain < 1e-9, "{found:?}");
    assert!(found.position[2][1] < -0.5 && (found.position[2][0] - 1.0).abs() < 1e-6, "{found:?}");
}

#[test]
fn a_bond_that_two_pins_stretch_is_named() {
    let scene = model(vec![[0.0, 0.0], [1.0, 0.0]], vec![rigid(0, 1, 1.5)], &[0, 1]);
    let world = build(&scene).unwrap();
    assert!(
        world.warnings()[0].contains("cannot hold: both ends are pinned, and not at that length (bond 0)"),
        "{:?}",
        world.warnings()
    );
}

/// Two pins that part pull a point between them to their middle: least squares, and nothing thrown into the distance.
#[test]
fn pins_that_part_leave_the_nearest_shape() {
    let mut scene = model(vec![[0.0, 0.0], [2.0, 0.0], [1.0, 0.5]], vec![rigid(0, 2, 1.2), rigid(1, 2, 1.2)], &[0, 1]);
    scene.pin_motion = vec![(PointId(1), Track { knots: vec![(0.0, [2.0, 0.0]), (0.2, [3.0, 0.0])] })];
    let mut world = build(&scene).unwrap();
    let end = run_to(&mut *world, 0.5);
    let x = end.position[2];
    assert!((x[0] - 1.5).abs() < 0.1 && x[1].abs() < 0.2, "{x:?}");
}

/// A damped spring beside a rigid bond: dampers feel the velocities that the bonds leave, or the order is lost.
#[test]
fn a_damper_beside_a_rigid_bond_does_not_lower_the_order() {
    let mut scene = model(
        vec![[0.0, 0.0], [0.8, -0.5], [1.5, -0.7]],
        vec![rigid(0, 1, 0.89_f64.sqrt()), spring(1, 2, 0.53_f64.sqrt(), 60.0, 0.3)],
        &[0],
    );
    scene.mass = vec![1.0, 0.5, 0.3];
    let mut end = |solver, h| {
        scene.method = Method { solver, substep: Some(h), ..Method::default() };
        run_to(&mut *build(&scene).unwrap(), 0.8).position[2]
    };
    let truth = end(Solver::Rk8, 0.001);
    let mut error = |h| {
        let x = end(Solver::VelocityVerlet, h);
        (x[0] - truth[0]).hypot(x[1] - truth[1])
    };
    let order = (error(0.01) / error(0.005)).log2();
    assert!((order - 2.0).abs() < 0.2, "{order}");
}
