//! Coulomb's law with every method that is asked for by name: what slides, what is held, and no energy from nowhere.

use serde_json::{Value, json};

use super::common::physics::{middle, run_to, spring};
use wobble::scene::Scene;
use wobble::sim::{Bond, BondKind, Bounds, Method, Model, PointId, Solver, build};

const G: f64 = 9.81;
const MU: f64 = 0.3;

/// Three points of 1 kg with bonds of this kind, one side on a floor that slopes by `angle`, sliding down it.
fn triangle(kind: BondKind, solver: Solver, (speed, angle): (f64, f64)) -> Model<2> {
    let position = vec![[0.0, 0.0], [0.6, 0.0], [0.3, 0.3]];
    let length = |a: usize, b: usize| {
        let [p, q]: [[f64; 2]; 2] = [position[a], position[b]];
        (p[0] - q[0]).hypot(p[1] - q[1])
    };
    let bonds = [(0, 1), (1, 2), (0, 2)]
        .map(|(a, b)| Bond { kind, ..Bond::new(PointId(a), PointId(b), length(a as usize, b as usize)) });
    Model {
        velocity: vec![[speed, 0.0]; 3],
        mass: vec![1.0; 3],
        bonds: bonds.into(),
        gravity: [G * angle.sin(), -G * angle.cos()],
        bounds: Some(Bounds { min: [-9.0, 0.0], max: [90.0, 9.0], restitution: 0.0, friction: MU }),
        method: Method { solver, ledger: true, ..Method::default() },
        position,
        ..Model::default()
    }
}

fn hard(stiffness: f64) -> BondKind {
    BondKind::Spring { stiffness, damping: 0.2 * stiffness.sqrt() }
}

/// A lattice of rigid bonds that may break: more of them than hold it, on a floor that rubs.
#[test]
fn braced_lattices_that_slide_by_implicit_methods_make_no_energy() {
    for (side, solver) in
        [4, 5, 6].into_iter().flat_map(|side| ["implicit-midpoint", "backward-euler"].map(|by| (side, by)))
    {
        let scene = json!({"wobble": 1, "gravity": [0, -G], "method": {"solver": solver, "ledger": true},
            "bounds": {"min": [-50, 0], "max": [50, 50], "friction": MU},
            "bodies": [{"make": "lattice", "columns": side, "rows": side, "spacing": 0.2, "velocity": [1, 0],
                "material": {"kind": "rigid", "mass": 2, "break_strain": 10}}]});
        let mut world = Scene::parse(&scene.to_string(), "scene").unwrap().world(None).unwrap();
        let start = world.energy();
        for k in 1..=60 {
            let now = run_to(&mut *world, f64::from(k) / 60.0).energy;
            assert!(now <= 1.01 * start, "{side} by {solver}: {start} J, then {now} J");
        }
        assert_eq!(world.counters().bonds_torn, 0, "{side} by {solver}");
    }
}

#[test]
fn a_body_slides_as_far_by_every_method() {
    let expected = 1.0 / (2.0 * MU * G);
    let by = |kind: BondKind, solver: Solver, share: f64| {
        let mut world = build(&triangle(kind, solver, (1.0, 0.0))).unwrap();
        let start = middle(&*world, 0..3)[0];
        let end = run_to(&mut *world, 0.6);
        let way = middle(&*world, 0..3)[0] - start;
        assert!((way - expected).abs() < share * expected, "{kind:?} by {solver}: {way} for {expected}");
        let ledger = end.ledger.unwrap();
        assert!(ledger.left_over() < share.max(1e-3) * ledger.start, "{kind:?} by {solver} makes energy: {ledger:?}");
    };
    for (solver, share) in [
        (Solver::VelocityVerlet, 5e-3),
        (Solver::Pefrl, 5e-3),
        (Solver::BlanesMoan6, 5e-3),
        (Solver::Rk4, 1e-5),
        (Solver::ImplicitMidpoint, 1e-3),
        (Solver::BackwardEuler, 0.02),
    ] {
        by(BondKind::Rigid, solver, share);
    }
    for (stiffness, share) in [(1e4, 1e-3), (1e7, 1e-3), (1e9, 0.01)] {
        by(hard(stiffness), Solver::ImplicitMidpoint, share);
        by(hard(stiffness), Solver::BackwardEuler, 0.02);
    }
    by(hard(1e8), Solver::Auto, 0.01);
}

#[test]
fn a_body_on_a_slope_slides_by_what_friction_leaves_or_stays() {
    for solver in [Solver::ImplicitMidpoint, Solver::BackwardEuler] {
        for kind in [BondKind::Rigid, hard(1e6)] {
            let angle: f64 = 0.4;
            let mut slides = build(&triangle(kind, solver, (0.0, angle))).unwrap();
            let start = middle(&*slides, 0..3)[0];
            run_to(&mut *slides, 1.0);
            let way = middle(&*slides, 0..3)[0] - start;
            let expected = 0.5 * G * (angle.sin() - MU * angle.cos());
            assert!((way - expected).abs() < 0.02 * expected, "{kind:?} by {solver}: {way} for {expected}");
            let mut holds = build(&triangle(kind, solver, (0.0, 0.25))).unwrap();
            run_to(&mut *holds, 0.5);
            let start = middle(&*holds, 0..3)[0];
            run_to(&mut *holds, 5.0);
            let creep = middle(&*holds, 0..3)[0] - start;
            assert!(creep.abs() < 1e-9, "{kind:?} by {solver} creeps by {creep}");
        }
    }
}

/// A square of four points of 1 kg, hard springs along its sides and one diagonal, 1 m above a floor; the floor gives back this share.
fn falls(restitution: f64, solver: Solver) -> Model<2> {
    let position = vec![[0.0, 1.0], [1.0, 1.2], [0.8, 2.2], [-0.2, 2.0]];
    let bonds = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)].map(|(a, b): (u32, u32)| {
        let [p, q]: [[f64; 2]; 2] = [position[a as usize], position[b as usize]];
        spring(a, b, (p[0] - q[0]).hypot(p[1] - q[1]), 1e6, 0.0)
    });
    Model {
        velocity: vec![[0.0; 2]; 4],
        mass: vec![1.0; 4],
        bonds: bonds.into(),
        gravity: [0.0, -G],
        bounds: Some(Bounds { min: [-9.0, 0.0], max: [9.0, 9.0], restitution, friction: MU }),
        method: Method { solver, ..Method::default() },
        position,
        ..Model::default()
    }
}

#[test]
fn hard_springs_make_no_energy_at_walls() {
    for solver in [Solver::ImplicitMidpoint, Solver::BackwardEuler] {
        for restitution in [0.0, 0.5, 1.0] {
            let mut world = build(&falls(restitution, solver)).unwrap();
            let start = world.sample(0.0).energy;
            let mut least = f64::INFINITY;
            for frame in 1..=60 {
                let sample = run_to(&mut *world, f64::from(frame) / 20.0);
                // The midpoint rule's own error on what is too fast for its substep is of some per cent.
                assert!(
                    sample.energy < start + 0.03 * start.abs(),
                    "{solver}, {restitution}: {} of {start}",
                    sample.energy
                );
                assert!(sample.position.iter().all(|x| x[1] > -1e-9), "{solver}: {:?}", sample.position);
                least = least.min(sample.energy);
            }
            // What has nothing left lies on the floor: its four points weigh at most half of their height.
            assert!(restitution > 0.5 || least < 0.5 * start, "{solver}, {restitution}: {least} of {start}");
        }
    }
}

/// A lattice of nine points with springs as hard as steel.
fn steel(origin: [f64; 2], angle: f64, damping: f64) -> Value {
    json!({"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5, "origin": origin, "angle": angle,
        "material": {"kind": "spring", "stiffness": 1e9, "damping": damping, "mass": 1}})
}

/// Energy of a scene every tenth of a second, over that at its start, and where the middle of its points ends.
fn energies(scene: &Value, end: f64) -> (Vec<f64>, f64) {
    let mut world = Scene::parse(&scene.to_string(), "scene").unwrap().world(None).unwrap();
    let start = world.sample(0.0).energy;
    let energies = (1..=(end * 10.0) as u32).map(|k| run_to(&mut *world, f64::from(k) / 10.0).energy / start).collect();
    let count = world.point_count();
    (energies, middle(&*world, 0..count)[0])
}

#[test]
fn what_is_as_hard_as_steel_falls_and_stands_without_energy_from_nowhere() {
    for solver in ["implicit-midpoint", "backward-euler"] {
        let floor = json!({"min": [-3, 0], "max": [3, 6], "restitution": 0, "friction": 0.5});
        let falls = json!({"wobble": 1, "gravity": [0, -G], "method": {"solver": solver}, "bounds": floor,
            "bodies": [steel([-0.5, 1.2], 0.3, 6e3)]});
        let (shares, _) = energies(&falls, 3.0);
        assert!(shares.iter().all(|share| *share < 1.01), "{solver}: {shares:?}");
        // It lies on a side: its middle is half a metre up.
        assert!((shares[29] * 17.91 / (0.5 * G) - 1.0).abs() < 0.01, "{solver}: {shares:?}");
        let (sin, cos) = 0.6_f64.sin_cos();
        let slope = json!([{"plane": {"point": [0, 0], "normal": [sin, cos]}, "friction": 1.5, "restitution": 0}]);
        let stands = json!({"wobble": 1, "gravity": [0, -G], "method": {"solver": solver}, "obstacles": slope,
            "bodies": [steel([0.001 * sin, 0.001 * cos], -0.6, 6e3)]});
        let (shares, middle) = energies(&stands, 1.5);
        assert!((middle - 0.5 * (sin + cos)).abs() < 5e-3, "{solver} goes to {middle}: {shares:?}");
    }
}

#[test]
fn a_hard_cube_that_tumbles_in_space_makes_no_energy() {
    let corner = |k: u32| [0.5 * f64::from(k >> 2), 1.0 + 0.5 * f64::from((k >> 1) & 1), 0.5 * f64::from(k & 1)];
    let position: Vec<[f64; 3]> = (0..8).map(corner).collect();
    let velocity: Vec<[f64; 3]> = (0..8).map(|k| [1.0 + 0.3 * f64::from(k), 0.0, 0.2 * f64::from(k)]).collect();
    let bonds: Vec<Value> = (0..8)
        .flat_map(|a| (0..a).map(move |b| json!({"a": a, "b": b, "kind": "spring", "stiffness": 1e8, "damping": 1e3})))
        .collect();
    let scene = json!({"wobble": 1, "dimensions": 3, "gravity": [0, -G, 0], "points": {"position": position, "velocity": velocity},
        "bonds": bonds, "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}, "friction": 0.5, "restitution": 0.2}]});
    let (shares, _) = energies(&scene, 3.0);
    assert!(shares.iter().all(|share| *share < 1.01), "{shares:?}");
    assert!(shares[29] < 0.25, "it comes to rest: {shares:?}");
}
