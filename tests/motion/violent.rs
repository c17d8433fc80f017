//! What is violent for a while: right by default, and with a tolerance, without a word of warning.

use wobble::scene::Scene;
use wobble::sim::{Bond, BondKind, Method, Model, PointId, Solver, build, judge};

use super::common::physics::run_to;

/// A heavy body hangs by a light one: where both rods come into line, the light one whips through at a thousand metres a second.
const WHIP: &str = r#"{"wobble": 1, "points": {"position": [[0, 0], [0.6, -0.8], [1.4, -0.2]], "mass": [1, 0.001, 1000], "pinned": [0]},
    "bonds": [{"a": 0, "b": 1, "kind": "rigid"}, {"a": 1, "b": 2, "kind": "rigid"}], "gravity": [0, -9.81], "samples": [1]}"#;
/// The same that starts folded together.
const FOLDED: &str = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0], [0.02, 0.001]], "mass": [1, 0.01, 1], "pinned": [0]},
    "bonds": [{"a": 0, "b": 1, "kind": "rigid"}, {"a": 1, "b": 2, "kind": "rigid"}], "gravity": [0, -9.81], "samples": [1]}"#;

/// Where points 1 and 2 are after 1 s: an extrapolation of order 16 (Gragg, Bulirsch and Stoer) of the accelerations with multipliers, in a
/// program of its own, which moves by 2e-9 from a local error of 1e-12 to one of 1e-13.
const TRUTHS: [(&str, [[f64; 2]; 2], f64); 2] = [
    (WHIP, [[-0.920_632_085_6, -0.390_431_252_1], [-0.871_888_488_6, -1.389_242_576_6]], 1e-7),
    (FOLDED, [[-0.963_884_261_4, -0.266_321_479_8], [0.011_119_600_7, -0.365_157_044_2]], 1e-4),
];

fn off(scene: &Scene, truth: [[f64; 2]; 2]) -> f64 {
    let mut world = scene.world(Some(1.0)).unwrap();
    let end = run_to(&mut *world, 1.0);
    assert_eq!(world.counters().hand_overs + world.counters().fallbacks, 0, "by its own method all along");
    let apart = |(x, y): (&[f64; 3], [f64; 2])| (x[0] - y[0]).hypot(x[1] - y[1]);
    end.position[1..].iter().zip(truth).map(apart).fold(0.0, f64::max)
}

#[test]
fn a_whip_between_rods_is_followed_by_default() {
    for (scene, truth, most) in TRUTHS {
        let off = off(&Scene::parse(scene, "scene").unwrap(), truth);
        assert!(off < most, "{off} m off, at most {most}: {scene}");
    }
}

#[test]
fn a_tolerance_holds_for_a_whip_and_its_error_is_stated() {
    for (scene, truth, _) in TRUTHS {
        let mut scene = Scene::parse(scene, "scene").unwrap();
        scene.method.tolerance = Some(1e-6);
        let found = wobble::study::tune(&mut scene, &[1.0]).unwrap().unwrap();
        let off = off(&scene, truth);
        assert!(found.is_reached && off <= 1e-6 && off < 3.0 * found.expected_error + 5e-9, "{off} m off: {found:?}");
    }
}

/// Two points a metre apart about their middle, which turn by `rate` [rad/s].
fn spinning(kind: BondKind, rate: f64, method: Method) -> Model<2> {
    Model {
        position: vec![[-0.5, 0.0], [0.5, 0.0]],
        velocity: vec![[0.0, -0.5 * rate], [0.0, 0.5 * rate]],
        mass: vec![1.0; 2],
        bonds: [Bond { kind, ..Bond::new(PointId(0), PointId(1), 1.0) }].into(),
        method,
        ..Model::default()
    }
}

#[test]
fn a_rod_that_spins_fast_is_where_it_should_be() {
    let mut world = build(&spinning(BondKind::Rigid, 300.0, Method::default())).unwrap();
    let [x, y, _] = run_to(&mut *world, 1.0).position[1];
    let off = (x - 0.5 * 300.0_f64.cos()).hypot(y - 0.5 * 300.0_f64.sin());
    assert!(off < 1e-6, "{off} m off after 48 turns");
}

/// The midpoint rule with the length in the middle would load this spring with 2.5 J of 100 by the turn of a substep.
#[test]
fn the_midpoint_rule_keeps_the_energy_of_what_turns_and_is_stiff() {
    let method =
        Method { solver: Solver::ImplicitMidpoint, substep: Some(1.0 / 60.0), ledger: true, ..Method::default() };
    let hard = BondKind::Spring { stiffness: 1e8, damping: 0.0 };
    let mut world = build(&spinning(hard, 20.0, method)).unwrap();
    for k in 1..=60 {
        let ledger = run_to(&mut *world, f64::from(k) / 60.0).ledger.unwrap();
        assert!(ledger.left_over().abs() < 1e-9 * ledger.start, "{ledger:?}");
    }
}

/// A disc whose springs swing by more than 3 radians in the substep that is given: by explicit methods what rounding leaves of that grows by a fifth in
/// each.
const COARSE: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "method": {"substep": 0.008333333333333333, "ledger": true},
    "bodies": [{"make": "disc", "radius": 0.43, "spacing": 0.0923, "material": {"kind": "spring", "stiffness": 123, "damping": 0, "mass": 0.229}}]}"#;

#[test]
fn a_substep_that_no_explicit_method_bears_goes_to_one_that_does() {
    let mut world = Scene::parse(COARSE, "scene").unwrap().world(None).unwrap();
    let entries: Vec<_> = (0..=120).map(|k| run_to(&mut *world, f64::from(k) / 60.0).ledger.unwrap()).collect();
    let verdict = judge(&entries);
    assert!(verdict.passes(), "{verdict:?}");
    assert_eq!(world.moved_by()[0].method, Solver::ImplicitMidpoint);
}
