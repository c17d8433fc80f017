use super::*;
use crate::study::fit;
use crate::study::problems::{TruthSample, find};

fn baseline(text: &str) -> Result<Baseline, String> {
    Baseline::new(&Scene::parse(text, "test.json").unwrap())
}

/// The order observed with the first variant over runs of 2^12 to 2^17 steps a sample.
fn order(name: &str) -> f64 {
    let problem = find(name).unwrap();
    let (baseline, truth) = (Baseline::new(&problem.scene().unwrap()).unwrap(), problem.truth().unwrap());
    let variant = baseline.variants()[0];
    let steps = (12..18).map(|i| (1 << i) * truth.samples.len() as u64);
    let runs: Vec<Run> = steps.map(|steps| baseline.run(variant, &truth, steps)).collect();
    fit::order(&runs).unwrap()
}

/// Where a point is at a time, as a truth.
fn truth_at(t: f64, position: Vec<f64>) -> Truth {
    let samples = vec![TruthSample { t, position: vec![position] }];
    Truth {
        name: String::new(),
        kind: crate::study::problems::Kind::Dynamic,
        uncertainty: 0.0,
        notes: String::new(),
        samples,
    }
}

const ONE: Variant = Variant { sweeps: 0, is_shuffled: false };

#[test]
fn free_fall_is_off_by_half_a_step_of_gravity() {
    let fall = baseline(
        r#"{"wobble": 1, "points": {"position": [[0, 0]], "velocity": [[1, 2]]}, "gravity": [0, -10], "duration": 1}"#,
    )
    .unwrap();
    // x_n = v n h + a h^2 n (n + 1)/2: the start is off by a h^2/2, which grows to a h t/2.
    for steps in [10, 100] {
        let h = 1.0 / steps as f64;
        let run = fall.run(ONE, &truth_at(1.0, vec![1.0, 2.0 - 5.0]), steps);
        assert!((run.error - 5.0 * h).abs() < 1e-12, "{}", run.error);
    }
}

#[test]
fn a_spring_is_met_to_first_order() {
    let order = order("B1_osc");
    assert!((order - 1.0).abs() < 0.05, "{order}");
}

#[test]
fn a_rigid_pendulum_is_met_to_first_order() {
    let order = order("D1_pendulum90");
    assert!((order - 1.0).abs() < 0.2, "{order}");
}

#[test]
fn a_hanging_rope_comes_to_rest_in_its_shape() {
    let problem = find("H1_catenary_rigid").unwrap();
    let baseline = Baseline::new(&problem.scene().unwrap()).unwrap();
    let run = baseline.run(Variant { sweeps: 50, is_shuffled: true }, &problem.truth().unwrap(), 16_000);
    assert!(run.error < 1e-3, "{}", run.error);
}

#[test]
fn a_point_bounces_off_walls_and_planes_alike() {
    let walls = r#""bounds": {"min": [-9, 0], "max": [9, 9], "restitution": 0.5}"#;
    let plane = r#""obstacles": [{"plane": {"point": [3, 0], "normal": [0, 2]}, "restitution": 0.5}]"#;
    for ground in [walls, plane] {
        let scene = format!(
            r#"{{"wobble": 1, "points": {{"position": [[0, 1]], "velocity": [[1, -2]]}}, {ground}, "duration": 1}}"#
        );
        // Down at 0.5 s, then up at half the speed.
        let run = baseline(&scene).unwrap().run(ONE, &truth_at(1.0, vec![1.0, 0.5]), 1 << 16);
        assert!(run.error < 1e-4, "{}", run.error);
    }
}

#[test]
fn all_problems_are_taken_and_what_is_not_is_named() {
    for problem in crate::study::problems() {
        let baseline = Baseline::new(&problem.scene().unwrap());
        assert!(baseline.is_ok(), "{}", problem.name);
    }
    let limited =
        r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0]]}, "bonds": [{"a": 0, "b": 1, "limit": "max"}]}"#;
    assert!(baseline(limited).unwrap_err().contains("bonds with a limit"));
}

#[test]
fn only_rigid_bonds_are_swept() {
    let variants = |name| Baseline::new(&find(name).unwrap().scene().unwrap()).unwrap().variants();
    assert_eq!(variants("B1_osc"), [ONE]);
    assert_eq!(variants("D1_pendulum90").len(), 5);
    assert_eq!(variants("E1_double").len(), 10);
    assert_eq!(variants("E1_double")[6].label(), "sources' method, 4 sweeps, shuffled");
}
