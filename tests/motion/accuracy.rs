//! The methods against the reference problems, whose truths were made by other programs, and against their orders.

use wobble::scene::record::record;
use wobble::scene::{PrecisionName, Scene, SolverName};
use wobble::sim::Sample;
use wobble::study::problems::{self, Kind, Problem, Truth};

/// The largest distance from the truth at each of its samples [m].
fn errors(samples: &[Sample], truth: &Truth) -> Vec<f64> {
    assert_eq!(samples.len(), truth.samples.len());
    let errors: Vec<f64> =
        samples.iter().zip(&truth.samples).map(|(sample, truth)| truth.error(&sample.position)).collect();
    assert!(!errors.is_empty() && errors.iter().all(|error| error.is_finite()), "{errors:?}");
    errors
}

fn run(scene: &Scene, truth: &Truth) -> f64 {
    let times = truth.times();
    let mut world = scene.world(times.last().copied()).unwrap();
    let samples = record(&mut *world, &times, |_| {}).unwrap();
    errors(&samples, truth).into_iter().fold(0.0, f64::max)
}

fn with_tolerance(problem: &Problem, tolerance: f64) {
    let (mut scene, truth) = (problem.scene().unwrap(), problem.truth().unwrap());
    scene.method.tolerance = Some(tolerance);
    let found = wobble::study::tune(&mut scene, &truth.times()).unwrap().unwrap();
    assert!(found.is_reached && found.expected_error <= tolerance, "{}: {found:?}", problem.name);
    let error = run(&scene, &truth);
    assert!(error <= tolerance, "{} by {:?}: {error} m", problem.name, scene.method);
}

#[test]
fn every_problem_is_within_a_tenth_of_a_millimetre() {
    for problem in problems::problems() {
        with_tolerance(problem, 1e-4);
    }
}

#[test]
fn every_problem_is_within_a_micrometre() {
    for problem in problems::problems() {
        with_tolerance(problem, 1e-6);
    }
}

#[test]
fn automatic_settings_are_right_to_a_tenth_of_a_millimetre() {
    for problem in problems::problems() {
        let (scene, truth) = (problem.scene().unwrap(), problem.truth().unwrap());
        let error = run(&scene, &truth);
        assert!(error <= 1e-4, "{}: {error} m", problem.name);
    }
}

#[test]
fn equilibria_are_exact() {
    let mut seen = 0;
    for problem in problems::problems() {
        let (scene, truth) = (problem.scene().unwrap(), problem.truth().unwrap());
        if truth.kind == Kind::Static {
            seen += 1;
            let found = wobble::study::settle(&scene, 0.0).unwrap();
            let error = errors(&[found.sample], &truth)[0];
            assert!(found.is_settled && error <= 1e-12, "{}: {error} m after {} rounds", problem.name, found.rounds);
        }
    }
    assert!(seen >= 2, "{seen} problems at rest");
}

/// The observed order of a solver on a problem between substeps of `h` and `h/2`.
fn order(name: &str, solver: SolverName, h: f64) -> f64 {
    let problem = problems::find(name).unwrap();
    let (mut scene, truth) = (problem.scene().unwrap(), problem.truth().unwrap());
    scene.method.solver = Some(solver);
    let mut error = |h: f64| {
        scene.method.substep = Some(h);
        let times = truth.times();
        let mut world = scene.world(times.last().copied()).unwrap();
        let samples = record(&mut *world, &times, |_| {}).unwrap();
        assert_eq!(world.counters().guard_splits, 0, "{name} {solver}: a guard hides the order");
        *errors(&samples, &truth).last().unwrap()
    };
    (error(h) / error(0.5 * h)).log2()
}

#[test]
fn observed_orders_are_those_of_the_methods() {
    use SolverName::*;
    for (name, solver, h, expected) in [
        ("B5_elastic_pendulum", Euler, 0.000_1, 1.0),
        ("B5_elastic_pendulum", Verlet, 0.01, 2.0),
        ("B5_elastic_pendulum", VelocityVerlet, 0.01, 2.0),
        ("B5_elastic_pendulum", Rk2, 0.005, 2.0),
        ("B5_elastic_pendulum", ImplicitMidpoint, 0.005, 2.0),
        ("B5_elastic_pendulum", BackwardEuler, 0.000_2, 1.0),
        ("B5_elastic_pendulum", Pefrl, 0.02, 4.0),
        ("B5_elastic_pendulum", BlanesMoan4, 0.02, 4.0),
        ("B5_elastic_pendulum", Rk4, 0.004, 4.0),
        ("B5_elastic_pendulum", BlanesMoan6, 0.04, 6.0),
        ("B2_osc_damped", Verlet, 0.01, 2.0),
        ("B2_osc_damped", Rk4, 0.02, 4.0),
        ("E1_double", Verlet, 0.004, 2.0),
        ("E1_double", VelocityVerlet, 0.004, 2.0),
        ("E1_double", Rk4, 0.004, 4.0),
        ("E1_double", Pefrl, 0.01, 4.0),
        ("E1_double", BlanesMoan6, 0.01, 6.0),
        ("N3_spherical_pendulum", VelocityVerlet, 0.004, 2.0),
        ("N3_spherical_pendulum", Rk4, 0.02, 4.0),
        ("N6_cloth5", VelocityVerlet, 0.002, 2.0),
        ("N6_cloth5", Rk4, 0.004, 4.0),
        ("I3_rim_floor", Rk4, 0.004, 4.0),
        ("K3_rim_mouse", Rk4, 0.004, 4.0),
    ] {
        let found = order(name, solver, h);
        assert!((found - expected).abs() <= 0.2, "{name} by {solver}: order {found}, not {expected}");
    }
    for (name, h) in [("B1_osc", 0.05), ("B5_elastic_pendulum", 0.05), ("N6_cloth5", 0.012)] {
        let found = order(name, Rk8, h);
        assert!(found >= 7.5, "{name} by rk8: order {found}");
    }
}

#[test]
fn single_precision_follows_double_at_a_hundred_metres() {
    for name in ["B1_osc", "G1_lattice_small", "I1_rim_free", "D1_pendulum90", "N6_cloth5"] {
        let problem = problems::find(name).unwrap();
        let (mut scene, truth) = (problem.scene().unwrap(), problem.truth().unwrap());
        for position in &mut scene.points.as_mut().unwrap().position {
            let numbers: Vec<f64> = serde_json::from_str(&serde_json::to_string(position).unwrap()).unwrap();
            let moved: Vec<f64> = numbers.iter().map(|x| x + 95.0).collect();
            *position = serde_json::from_str(&serde_json::to_string(&moved).unwrap()).unwrap();
        }
        let end = [truth.times()[0]];
        let mut at = |precision| {
            scene.method.precision = Some(precision);
            record(&mut *scene.world(Some(end[0])).unwrap(), &end, |_| {}).unwrap().remove(0)
        };
        let (single, double) = (at(PrecisionName::F32), at(PrecisionName::F64));
        let apart = |(a, b): (&[f64; 3], &[f64; 3])| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let error = single.position.iter().zip(&double.position).map(apart).fold(0.0, f64::max);
        // The start itself is rounded by up to 4e-6 m there.
        assert!(error <= 1e-5 + 2e-5, "{name}: {error} m");
    }
}
