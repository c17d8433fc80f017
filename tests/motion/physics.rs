//! The motion against closed forms and conservation laws, in the plane and in space, in both precisions.

use super::common::physics::{angular_momentum, center_of_mass, momentum, rim, run_to, spring};
use wobble::sim::{Bond, BondKind, Bounds, Method, Model, Order, PointId, Precision, Sample, Solver, build};

/// A frame of 1/60 s in 64 substeps.
const FINE: f64 = 1.0 / 3840.0;

fn thrown<const D: usize>(position: [f64; D], velocity: [f64; D], gravity: [f64; D]) -> Model<D> {
    Model {
        position: vec![position],
        velocity: vec![velocity],
        mass: vec![3.0],
        gravity,
        method: Method { substep: Some(FINE), ..Method::default() },
        ..Model::default()
    }
}

/// The same model, computed with these scalars.
fn in_precision<const D: usize>(model: &Model<D>, precision: Precision) -> Model<D> {
    Model { method: Method { precision, ..model.method }, ..model.clone() }
}

/// Largest component of x(t) - (x0 + v0 t + g t^2/2) after `t` seconds.
fn fall_error<const D: usize>(model: &Model<D>, precision: Precision, t: f64) -> f64 {
    let mut world = build(&in_precision(model, precision)).unwrap();
    let end = run_to(&mut *world, t);
    let truth =
        |k: usize| f64::from(model.position[0][k] as f32) + model.velocity[0][k] * t + 0.5 * model.gravity[k] * t * t;
    (0..D).map(|k| (end.position[0][k] - truth(k)).abs()).fold(0.0, f64::max)
}

#[test]
fn free_fall_is_exact_in_f64() {
    let plane = thrown([0.0, 100.0], [1.5, 2.0], [0.0, -9.81]);
    let space = thrown([0.5, 100.0, -2.0], [1.5, 2.0, -0.25], [0.25, -9.81, 1.0]);
    assert!(fall_error(&plane, Precision::F64, 4.0) < 1e-12, "{}", fall_error(&plane, Precision::F64, 4.0));
    assert!(fall_error(&space, Precision::F64, 4.0) < 1e-12, "{}", fall_error(&space, Precision::F64, 4.0));
}

/// Without compensation of the velocity this is 3e-4 m, without that of the position 1e-4 m.
#[test]
fn free_fall_in_f32_keeps_its_increments_at_a_hundred_metres() {
    let plane = thrown([0.0, 100.0], [1.5, 2.0], [0.0, -9.81]);
    let space = thrown([0.5, 100.0, -2.0], [1.5, 2.0, -0.25], [0.25, -9.81, 1.0]);
    assert!(fall_error(&plane, Precision::F32, 4.0) < 1e-5, "{}", fall_error(&plane, Precision::F32, 4.0));
    assert!(fall_error(&space, Precision::F32, 4.0) < 1e-5, "{}", fall_error(&space, Precision::F32, 4.0));
}

#[test]
fn drag_decays_velocity_exactly() {
    let mut model = thrown([0.0, 0.0], [2.0, 0.0], [0.0, 0.0]);
    model.drag_rate = 0.7;
    let mut world = build(&model).unwrap();
    let end = run_to(&mut *world, 2.0);
    assert!((end.velocity[0][0] - 2.0 * (-1.4_f64).exp()).abs() < 1e-12);
    assert!((end.position[0][0] - 2.0 / 0.7 * (1.0 - (-1.4_f64).exp())).abs() < 1e-7);
}

/// Two points on a spring, pulled apart: x(t) = rest + A exp(-g t) (cos w t + g/w sin w t), reduced mass 2/3 kg.
fn oscillator_error<const D: usize>(precision: Precision, h: f64, damping: f64) -> f64 {
    let along = |x: f64| std::array::from_fn(|k| if k == D - 1 { x } else { 0.3 });
    let model = Model::<D> {
        position: vec![along(0.0), along(1.2)],
        velocity: vec![[0.0; D]; 2],
        mass: vec![1.0, 2.0],
        bonds: [spring(0, 1, 1.0, 100.0, damping)].into(),
        method: Method { substep: Some(h), solver: Solver::Verlet, ..Method::default() },
        ..Model::default()
    };
    let mut world = build(&in_precision(&model, precision)).unwrap();
    let end = run_to(&mut *world, 1.0);
    let (g, w0) = (damping / (2.0 * 2.0 / 3.0), (100.0_f64 * 1.5).sqrt());
    let w = (w0 * w0 - g * g).sqrt();
    let truth = 1.0 + 0.2 * (-g).exp() * (w.cos() + g / w * w.sin());
    (end.position[1][D - 1] - end.position[0][D - 1] - truth).abs()
}

fn assert_second_order(error: impl Fn(f64) -> f64) {
    let (coarse, fine) = (error(0.005), error(0.0025));
    let order = (coarse / fine).log2();
    assert!((order - 2.0).abs() < 0.2, "order {order}: {coarse} then {fine}");
    assert!(fine < 2e-4, "{fine}");
}

#[test]
fn springs_converge_with_order_two_with_and_without_damping() {
    assert_second_order(|h| oscillator_error::<2>(Precision::F64, h, 0.0));
    assert_second_order(|h| oscillator_error::<3>(Precision::F64, h, 0.0));
    assert_second_order(|h| oscillator_error::<2>(Precision::F64, h, 3.0));
    assert_second_order(|h| oscillator_error::<3>(Precision::F64, h, 3.0));
}

/// Comparisons with a largest error see nothing of what is no number: the helper that all runs go through does.
#[test]
#[should_panic(expected = "left the finite numbers")]
fn a_run_that_leaves_the_finite_numbers_fails_whatever_is_compared() {
    let mut world = build(&thrown([0.0, 0.0], [1e308, 0.0], [0.0, 0.0])).unwrap();
    run_to(&mut *world, 20.0);
}

/// A rigid pendulum of 1 m let go at the level: the angle as the arithmetic-geometric mean gives it at the bottom.
#[test]
fn a_rigid_pendulum_keeps_its_length_and_its_period() {
    let bob = |solver| Model::<2> {
        position: vec![[0.0, 0.0], [1.0, 0.0]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0; 2],
        pinned: vec![PointId(0)],
        bonds: [bond(0, 1, 1.0, BondKind::Rigid)].into(),
        gravity: [0.0, -9.81],
        method: Method { substep: Some(1e-3), solver, iterations: Some(1), ..Method::default() },
        ..Model::default()
    };
    // A quarter of the period: T/4 = pi / (2 agm(1, cos 45 deg)) sqrt(l/g).
    let quarter = std::f64::consts::PI / (2.0 * agm(1.0, std::f64::consts::FRAC_1_SQRT_2)) * (1.0_f64 / 9.81).sqrt();
    let mut world = build(&bob(Solver::Verlet)).unwrap();
    let end = run_to(&mut *world, quarter);
    assert!(end.position[1][0].abs() < 1e-5, "at the bottom: {:?}", end.position[1]);
    assert!(end.max_strain < 1e-9, "{}", end.max_strain);
    let along_bond = end.velocity[1][0] * end.position[1][0] + end.velocity[1][1] * end.position[1][1];
    assert!(along_bond.abs() < 1e-8, "velocity along the bond: {along_bond}");
    let mut sources = build(&bob(Solver::Relaxation)).unwrap();
    let other = run_to(&mut *sources, quarter);
    assert!(other.position[1][0].abs() > 1e-4, "the relaxed pendulum is first order: {:?}", other.position[1]);
}

fn agm(a: f64, b: f64) -> f64 {
    if (a - b).abs() < 1e-15 { a } else { agm(0.5 * (a + b), (a * b).sqrt()) }
}

fn bond(a: u32, b: u32, rest_length: f64, kind: BondKind) -> Bond {
    Bond { kind, ..Bond::new(PointId(a), PointId(b), rest_length) }
}

/// A free rim of unequal masses in flight, moving and spinning, of one kind of bond.
fn flying_rim(kind: BondKind, order: Order) -> Model<2> {
    let mut model = rim(12, kind);
    model.gravity = [0.0, -9.81];
    model.method = Method { substep: Some(0.002), iterations: Some(2), order, ..Method::default() };
    model.mass = (0..model.position.len()).map(|i| 0.5 + 0.25 * (i % 7) as f64).collect();
    model.velocity = model.position.iter().map(|x| [1.0 - 0.5 * x[1], 3.0 + 0.5 * x[0]]).collect();
    model
}

const KINDS: [BondKind; 3] = [
    BondKind::Spring { stiffness: 900.0, damping: 2.0 },
    BondKind::Relaxed { relaxation: 0.7, max_correction: 0.5 },
    BondKind::Rigid,
];

#[test]
fn the_centre_of_mass_of_a_rim_in_flight_is_exact() {
    for kind in KINDS {
        for order in [Order::Fixed, Order::Symmetric, Order::Coloured, Order::Shuffled] {
            let model = flying_rim(kind, order);
            let mut world = build(&model).unwrap();
            let (start, v) =
                (center_of_mass(&world.sample(0.0), &model.mass), momentum(&world.sample(0.0), &model.mass));
            let end = center_of_mass(&run_to(&mut *world, 1.0), &model.mass);
            let total: f64 = model.mass.iter().sum();
            for k in 0..2 {
                let truth = start[k] + v[k] / total + 0.5 * model.gravity[k];
                assert!((end[k] - truth).abs() < 1e-11, "{kind:?} {order:?}: {} m off", end[k] - truth);
            }
        }
    }
}

#[test]
fn bonds_keep_momentum() {
    for kind in KINDS {
        let mut model = flying_rim(kind, Order::Coloured);
        model.gravity = [0.0, 0.0];
        let mut world = build(&model).unwrap();
        let before = world.sample(0.0);
        let after = run_to(&mut *world, 2.0);
        let scale: f64 = model.mass.iter().sum::<f64>() * 4.0;
        let change = |f: fn(&Sample, &[f64]) -> [f64; 3]| {
            let (a, b) = (f(&before, &model.mass), f(&after, &model.mass));
            (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max) / scale
        };
        assert!(change(momentum) < 1e-12, "{kind:?}: momentum {}", change(momentum));
        // Sweeps along the new direction take angular momentum: the relaxed method is left out.
        if !matches!(kind, BondKind::Relaxed { .. }) {
            assert!(change(angular_momentum) < 1e-9, "{kind:?}: angular momentum {}", change(angular_momentum));
        }
    }
}

/// A floor at y = 0 and a point that falls on it from 1 m.
fn dropped(restitution: f64, friction: f64, sideways: f64) -> Model<2> {
    Model {
        position: vec![[0.0, 1.0]],
        velocity: vec![[sideways, 0.0]],
        mass: vec![2.0],
        gravity: [0.0, -9.81],
        bounds: Some(Bounds { min: [-50.0, 0.0], max: [50.0, 10.0], restitution, friction }),
        method: Method { substep: Some(1.0 / 960.0), ..Method::default() },
        ..Model::default()
    }
}

#[test]
fn a_bounce_rises_to_the_square_of_the_restitution() {
    let mut world = build(&dropped(0.8, 0.0, 0.0)).unwrap();
    let landing = (2.0_f64 / 9.81).sqrt();
    let top = run_to(&mut *world, landing * 1.8);
    assert!((top.position[0][1] - 0.64).abs() < 2e-3, "{:?}", top.position);
}

#[test]
fn a_dropped_point_comes_to_rest_on_the_floor() {
    for restitution in [0.0, 0.5] {
        let mut world = build(&dropped(restitution, 0.0, 0.0)).unwrap();
        let end = run_to(&mut *world, 6.0);
        assert_eq!(end.position[0][1], 0.0);
        assert_eq!(end.velocity[0], [0.0; 3]);
        assert!(world.is_still(1e-4));
    }
}

#[test]
fn friction_brings_a_sliding_point_to_a_stand() {
    let mut model = dropped(0.0, 0.5, 2.0);
    model.position[0] = [0.0, 0.0];
    let mut world = build(&model).unwrap();
    let end = run_to(&mut *world, 2.0);
    let truth = 2.0 * 2.0 / (2.0 * 0.5 * 9.81);
    assert!((end.position[0][0] - truth).abs() < 0.01, "slid {} m of {truth}", end.position[0][0]);
    assert_eq!(end.velocity[0][0], 0.0);
}

#[test]
fn no_point_leaves_the_walls_however_fast() {
    let mut model = dropped(1.0, 0.0, 0.0);
    model.velocity[0] = [1e6, -1e6];
    let mut world = build(&model).unwrap();
    for _ in 0..2000 {
        world.step();
        let [x, y, _] = world.sample(world.time()).position[0];
        assert!((-50.0..=50.0).contains(&x) && (0.0..=10.0).contains(&y), "({x}, {y})");
    }
}

#[test]
fn f32_follows_f64() {
    let model = flying_rim(KINDS[0], Order::Coloured);
    let (mut single, mut double) = (build(&in_precision(&model, Precision::F32)).unwrap(), build(&model).unwrap());
    let (a, b) = (run_to(&mut *single, 1.0), run_to(&mut *double, 1.0));
    let apart = a.position.iter().zip(&b.position).map(|(x, y)| (x[0] - y[0]).hypot(x[1] - y[1])).fold(0.0, f64::max);
    assert!(apart < 1e-5, "{apart}");
}

/// A substep cut short must not be a blow: the energy of a sample goes on smoothly from that of the substep before.
#[test]
fn relaxed_bonds_bear_short_substeps() {
    let mut model = flying_rim(KINDS[1], Order::Coloured);
    model.position[0][0] += 0.3;
    let mut world = build(&model).unwrap();
    for _ in 0..20 {
        world.step();
    }
    let before = world.energy();
    for part in [1e-6, 1e-3, 0.1] {
        let energy = world.sample(world.time() + part * world.substep()).energy;
        assert!((energy / before - 1.0).abs() < 0.25, "at {part} of a substep {energy} J after {before} J");
    }
}

#[test]
fn a_sample_does_not_change_the_motion() {
    let model = flying_rim(KINDS[2], Order::Shuffled);
    let (mut asked, mut alone) = (build(&model).unwrap(), build(&model).unwrap());
    for _ in 0..100 {
        asked.sample(asked.time() + 0.4 * asked.substep());
        asked.step();
        alone.step();
    }
    assert_eq!(asked.sample(asked.time()), alone.sample(alone.time()));
}

/// Explicit Euler on a circle grows by sqrt(1 + h^2) a step: 1.368 a turn at h = 0.1.
#[test]
fn eulers_circle_grows_as_the_slides_say() {
    let scene = wobble::scene::Scene::load("slide-circle").unwrap();
    let mut world = scene.world(None).unwrap();
    for _ in 0..100 {
        world.step();
    }
    let end = world.sample(world.time());
    let radius = end.position[1][0].hypot(end.position[1][1]);
    assert!((radius - 1.01_f64.powf(50.0)).abs() < 1e-9, "{radius}");
}

/// v' = -k v by explicit Euler: a factor of 1 - h k a step.
#[test]
fn eulers_decay_oscillates_past_one_and_grows_past_two() {
    let scene = wobble::scene::Scene::load("slide-decay").unwrap();
    let mut world = scene.world(None).unwrap();
    for _ in 0..20 {
        world.step();
    }
    let end = world.sample(world.time());
    for (point, start, k) in [(1, 5.0, 5.0), (3, 15.0, 15.0), (5, 19.5, 19.5), (7, 20.2, 20.2)] {
        let truth = start * (1.0_f64 - 0.1 * k).powi(20);
        assert!((end.velocity[point][0] - truth).abs() < 1e-9 * start, "{point}: {:?} {truth}", end.velocity[point]);
    }
}
