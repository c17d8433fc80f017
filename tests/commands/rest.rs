//! What rests, and what only seems to.

use super::*;

#[test]
fn small_motions_of_small_things_are_no_rest() {
    // Two points 1 mm apart on a spring that swings by a hundredth of it, once a second: x = 1 mm + 10 um cos(2 pi t).
    let k = 0.5 * std::f64::consts::TAU.powi(2);
    let model = Model::<2> {
        position: vec![[0.0; 2], [1.01e-3, 0.0]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0; 2],
        bonds: [Bond {
            kind: BondKind::Spring { stiffness: k, damping: 0.0 },
            ..Bond::new(PointId(0), PointId(1), 1e-3)
        }]
        .into_iter()
        .collect(),
        ..Model::default()
    };
    let mut world = build(&model).unwrap();
    for half in 1..=6 {
        steps(&mut *world, 0.5);
        let now = now(&*world);
        let meant = 1e-3 + 1e-5 * (std::f64::consts::TAU * world.time()).cos();
        let found = now.position[1][0] - now.position[0][0];
        assert!((found - meant).abs() < 1e-7, "after {half} halves: {found:e} {meant:e}");
    }
    assert!(!world.is_asleep());
}

#[test]
fn a_turning_point_is_no_rest_and_what_rests_sleeps() {
    // A pendulum of 4 s starts at its turning point, where it has no speed; one that hangs, still.
    let swing = |angle: f64| Model {
        position: vec![[0.0, 0.0], [4.0 * angle.sin(), -4.0 * angle.cos()]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0; 2],
        pinned: vec![PointId(0)],
        bonds: [Bond::new(PointId(0), PointId(1), 4.0)].into(),
        gravity: [0.0, -9.81],
        method: Method { sleeps: true, ..Method::default() },
        ..Model::default()
    };
    let mut world = build(&swing(0.01)).unwrap();
    for _ in 0..600 {
        steps(&mut *world, 1.0 / 60.0);
        assert!(!world.is_asleep(), "at {} s", world.time());
    }
    let mut world = build(&swing(0.0)).unwrap();
    steps(&mut *world, 1.0);
    assert!(world.is_asleep());
    let (substeps, place) = (world.counters().substeps, now(&*world).position);
    steps(&mut *world, 1.0);
    assert_eq!((world.counters().substeps, now(&*world).position), (substeps, place));
    world.apply(&Command::Cursor { to: Some(Cursor::at([1.0, -4.0])), by: 0.0 }).unwrap();
    assert!(world.is_asleep(), "there is no mouse force");
    world.apply(&Command::Grab(Reach::Points(vec![PointId(1)]))).unwrap();
    steps(&mut *world, 0.5);
    assert!(now(&*world).position[1][0] > 0.5, "a grab wakes it");
}

#[test]
fn bodies_of_springs_at_rest_on_the_floor_sleep_and_report_no_speed() {
    let scene = r#"{ "wobble": 1, "gravity": [0, -9.81], "drag_rate": 2,
        "bodies": [{ "make": "disc", "radius": 0.5, "spacing": 0.08, "origin": [0, 0.7],
            "material": { "kind": "spring", "stiffness": 4000, "damping": 2, "mass": 3 } }],
        "bounds": { "min": [-4, 0], "max": [4, 5], "restitution": 0.3, "friction": 0.6 } }"#;
    let mut world = Scene::parse(scene, "disc.json").unwrap().world(None).unwrap();
    let mut seconds = 0;
    while !world.is_asleep() {
        assert!(seconds < 20, "it is awake after {seconds} s");
        steps(&mut *world, 1.0);
        seconds += 1;
    }
    let sample = now(&*world);
    assert!(sample.velocity.iter().flatten().all(|&v| v == 0.0), "{:?}", sample.velocity);
    assert!(sample.position.iter().any(|x| x[1].abs() < 1e-3), "it lies on the floor");
}
