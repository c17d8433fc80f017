//! What undamped motion must keep: energy without drift, momentum, the phase of an oscillation.

use super::common::physics::{angular_momentum, momentum, rim, run_to, spring};
use wobble::equilibrium::settle;
use wobble::sim::{Bond, BondKind, Method, Model, PointId, Solver, build};

fn spinning(kind: BondKind, solver: Solver, h: f64) -> Model<2> {
    let mut model = rim(12, kind);
    model.method = Method { solver, substep: Some(h), ..Method::default() };
    model.mass = (0..model.position.len()).map(|i| 0.5 + 0.25 * (i % 7) as f64).collect();
    model.velocity = model.position.iter().map(|x| [0.3 - 1.5 * x[1], 0.2 + 1.5 * x[0]]).collect();
    model
}

#[test]
fn momentum_is_kept_over_a_hundred_thousand_steps() {
    let soft = BondKind::Spring { stiffness: 900.0, damping: 0.0 };
    for (kind, solver) in [(soft, Solver::Verlet), (soft, Solver::Pefrl), (BondKind::Rigid, Solver::VelocityVerlet)] {
        let model = spinning(kind, solver, 0.002);
        let mut world = build(&model).unwrap();
        let start = world.sample(0.0);
        for _ in 0..100_000 {
            world.step();
        }
        let end = world.sample(world.time());
        let (p, q) = (momentum(&start, &model.mass), momentum(&end, &model.mass));
        let (l, k) = (angular_momentum(&start, &model.mass)[2], angular_momentum(&end, &model.mass)[2]);
        // Speeds are about 3 m/s: that is what each point's momentum is rounded relative to.
        let scale = 3.0 * model.mass.iter().sum::<f64>();
        for axis in 0..2 {
            assert!((p[axis] - q[axis]).abs() <= 1e-12 * scale, "{solver}: {p:?} {q:?}");
        }
        assert!(((k - l) / l).abs() <= 1e-9, "{solver}: {l} {k}");
    }
}

/// Mean energies of stretches of periods, from first to last.
fn drift(solver: Solver, steps_a_period: f64) -> f64 {
    let period = std::f64::consts::TAU / 10.0;
    let model = Model::<2> {
        position: vec![[0.0, 0.0], [1.2, 0.0]],
        velocity: vec![[0.0, 0.0], [0.0, 0.5]],
        mass: vec![1.0; 2],
        pinned: vec![PointId(0)],
        bonds: [spring(0, 1, 1.0, 100.0, 0.0)].into(),
        method: Method { solver, substep: Some(period / steps_a_period), ..Method::default() },
        ..Model::default()
    };
    let mut world = build(&model).unwrap();
    let mut mean = |periods: f64| {
        let steps = (periods * steps_a_period) as u64;
        (0..steps)
            .map(|_| {
                world.step();
                world.energy()
            })
            .sum::<f64>()
            / steps as f64
    };
    let first = mean(100.0);
    mean(900.0);
    let last = mean(100.0);
    ((last - first) / first).abs()
}

#[test]
fn energy_does_not_drift_in_a_thousand_periods() {
    for (solver, steps) in [(Solver::Pefrl, 40.0), (Solver::BlanesMoan4, 30.0), (Solver::BlanesMoan6, 16.0)] {
        let found = drift(solver, steps);
        assert!(found <= 1e-6, "{solver}: {found}");
    }
    assert!(drift(Solver::Rk2, 60.0) > 1e-3, "the measure sees a drift where there is one");
}

#[test]
fn a_rigid_pendulum_keeps_its_energy() {
    let model = Model::<3> {
        position: vec![[0.0; 3], [0.6, -0.2, 0.5]],
        velocity: vec![[0.0; 3], [1.0, 0.4, -1.04]],
        mass: vec![1.0, 0.5],
        pinned: vec![PointId(0)],
        bonds: [Bond::new(PointId(0), PointId(1), 0.65_f64.sqrt())].into(),
        gravity: [0.0, -9.81, 0.0],
        method: Method { solver: Solver::VelocityVerlet, substep: Some(1e-3), ..Method::default() },
        ..Model::default()
    };
    let mut world = build(&model).unwrap();
    let start = world.energy();
    let end = run_to(&mut *world, 100.0);
    assert!((end.energy - start).abs() < 1e-5 * start.abs().max(1.0), "{start} {}", end.energy);
    assert!(end.max_strain < 1e-12);
}

/// The time of a hundred periods by crossings of the rest length.
fn period(h: f64) -> f64 {
    let model = Model::<2> {
        position: vec![[0.0, 0.0], [1.1, 0.0]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0; 2],
        pinned: vec![PointId(0)],
        bonds: [spring(0, 1, 1.0, 100.0, 0.0)].into(),
        method: Method { substep: Some(h), solver: Solver::VelocityVerlet, ..Method::default() },
        ..Model::default()
    };
    let mut world = build(&model).unwrap();
    let (mut crossings, mut before) = (Vec::new(), 0.1);
    while crossings.len() < 101 {
        let t = world.time();
        world.step();
        let now = world.sample(world.time()).position[1][0] - 1.0;
        if before < 0.0 && now >= 0.0 {
            crossings.push(t + (world.time() - t) * before / (before - now));
        }
        before = now;
    }
    (crossings[100] - crossings[0]) / 100.0
}

#[test]
fn a_springs_period_does_not_hang_on_the_substep() {
    let truth = std::f64::consts::TAU / 10.0;
    for h in [0.025, 0.0125, 0.006, 0.001] {
        assert!((period(h) / truth - 1.0).abs() <= 0.005, "{h}: {}", period(h));
    }
}

#[test]
fn a_weight_sags_by_its_weight_times_the_compliance() {
    let compliance = 2e-3;
    let mut model = Model::<2> {
        position: vec![[0.0, 0.0], [0.0, -1.0]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0, 3.0],
        pinned: vec![PointId(0)],
        bonds: [spring(0, 1, 1.0, 1.0 / compliance, 20.0)].into(),
        gravity: [0.0, -9.81],
        ..Model::default()
    };
    let truth = -1.0 - 3.0 * 9.81 * compliance;
    assert!((settle(&model).unwrap().position[1][1] - truth).abs() < 1e-13);
    for h in [0.01, 0.002] {
        model.method.substep = Some(h);
        let mut world = build(&model).unwrap();
        assert!((run_to(&mut *world, 20.0).position[1][1] - truth).abs() < 1e-9, "at a substep of {h} s");
    }
}
