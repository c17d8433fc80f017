//! What is measured for plots: the world's own energies and points, and nothing that nobody asked for.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use super::pace::Pace;
use super::{Measured, Note, Order, Probe, Probes, Shown, Stage};
use crate::history::{DeleteKeys, Do, History, SetKeys};
use crate::scene::{Scene, Vector};
use crate::sim::{Cursor, PointId};

/// A soft disc and a rope of springs fall past a loose point.
const SCENE: &str = r#"{"wobble": 1, "gravity": [0.5, -9.81],
    "points": {"position": [[3, 1]], "velocity": [[-1, 2]]},
    "bodies": [
        {"make": "disc", "radius": 1, "spacing": 0.4, "velocity": [0, 1],
            "material": {"kind": "spring", "stiffness": 300, "damping": 1, "mass": 2}},
        {"make": "rope", "count": 6, "spacing": 0.2, "origin": [2, 0], "pinned": [0],
            "material": {"kind": "spring", "stiffness": 500, "damping": 0, "mass": 1}}]}"#;

fn stage(scene: &str) -> Stage {
    Stage::new(Scene::parse(scene, "x.json").unwrap().into()).unwrap()
}

fn frame(stage: &mut Stage) {
    stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
}

fn measured(stage: &mut Stage) -> Option<Measured> {
    let mut shown = Shown { measured: vec![Measured::default()], ..Shown::default() };
    stage.show(&mut shown);
    shown.measured.pop()
}

/// What is measured at fixed times while frames of so many seconds pass, of which the window sees every second one.
fn at_fixed_times(scene: &str, walls: &[f64]) -> Vec<Measured> {
    let mut history = History::new(Scene::parse(scene, "x.json").unwrap().into()).unwrap();
    let rate = history.scene().rate();
    let mut pace = Pace::new(&history, rate, None);
    pace.watch.set(Some([Some(Probe::Point(PointId(0))), None]), history.world(), rate);
    let (mut seen, mut list) = (Vec::new(), Vec::new());
    for (place, wall) in walls.iter().enumerate() {
        pace.advance(&mut history, *wall, None, || 0.0);
        if place % 2 == 0 || place + 1 == walls.len() {
            pace.watch.hand_out((history.world(), true), &mut list);
            seen.extend(list.iter().copied().filter(|measured| !measured.is_passing));
        }
    }
    // The present may be handed out in more than one frame.
    seen.dedup_by_key(|measured| measured.time);
    seen
}

#[test]
fn what_is_measured_does_not_depend_on_how_many_frames_there_are() {
    let substep = |keys: &str| SCENE.replacen('{', &format!("{{{keys},"), 1);
    for (scene, apart) in [
        (SCENE.to_owned(), None),
        (substep(r#""method": {"substep": 0.005}"#), Some(0.015)),
        (substep(r#""method": {"substep": 0.02}"#), Some(0.02)),
        (substep(r#""rate": 0.125, "method": {"substep": 0.001}"#), Some(0.002)),
    ] {
        let (quick, slow) = ([1.0 / 144.0; 144], [0.03, 0.1, 0.07, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1]);
        let [quick, slow] = [at_fixed_times(&scene, &quick), at_fixed_times(&scene, &slow)];
        let count = quick.len().min(slow.len());
        assert!(count > 20 && quick.len().abs_diff(slow.len()) <= 1, "{} {}", quick.len(), slow.len());
        assert_eq!(quick[..count], slow[..count], "to the bit");
        let Some(apart) = apart else { continue };
        let steps: Vec<f64> = quick.windows(2).map(|pair| pair[1].time - pair[0].time).collect();
        assert!(steps.iter().all(|step| (step - apart).abs() < 0.1 * apart), "{apart} s: {steps:?}");
    }
}

#[test]
fn nothing_is_measured_while_nobody_looks() {
    let mut stage = stage(SCENE);
    frame(&mut stage);
    assert_eq!(measured(&mut stage), None);
    stage.obey(Order::Watch(Some(Probes::default())));
    assert!(measured(&mut stage).is_some());
    stage.obey(Order::Watch(None));
    assert_eq!(measured(&mut stage), None);
}

#[test]
fn what_was_before_is_measured_as_it_would_have_been() {
    let scene = SCENE.replacen('{', r#"{"method": {"substep": 0.02},"#, 1);
    let probes = [Some(Probe::Point(PointId(0))), Some(Probe::Bond(3))];
    let [mut watched, mut late] = [stage(&scene), stage(&scene)];
    watched.obey(Order::Watch(Some(probes)));
    let mut seen: Vec<Measured> = measured(&mut watched).into_iter().collect();
    for frame in 0..40 {
        for stage in [&mut watched, &mut late] {
            if frame == 20 {
                let keys = SetKeys { gravity: Some(Vector::Plane([0.0, 5.0])), ..SetKeys::default() };
                assert_eq!(stage.obey(Order::Give(vec![Do::Set(Box::new(keys))], Some("gravity"))), None);
            }
            stage.obey(Order::Advance { wall: 0.02, cursor: None, back: false });
        }
        seen.extend(measured(&mut watched));
    }
    late.obey(Order::Play(false));
    let Some(Note::Before(before)) = late.obey(Order::Watch(Some(probes))) else { panic!("there was something") };
    seen.pop();
    assert_eq!(before, seen, "to the bit, but for the present");
    let mut times = Vec::new();
    late.history().look_back(0.0, 0.0, |world| times.push(world.time()));
    assert_eq!(times[0], 0.0, "without work the copies that are kept");
    assert!(times.len() < seen.len() && times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
    late.obey(Order::GoTo(0.2, None));
    let Some(Note::Before(before)) = late.obey(Order::Watch(Some(probes))) else { panic!("there was something") };
    assert_eq!(before[..], seen[..10], "what is to come is not told");
}

#[test]
fn energies_are_those_of_the_world() {
    let mut stage = stage(SCENE);
    stage.obey(Order::Watch(Some(Probes::default())));
    for _ in 0..20 {
        frame(&mut stage);
        let Measured { time, energies, .. } = measured(&mut stage).unwrap();
        let world = stage.history().world();
        let sample = world.sample(world.time());
        assert_eq!(time, world.time());
        let free = |k: &usize| !world.pinned().contains(&PointId(*k as u32));
        let masses = || (0..world.point_count()).filter(free).map(|k| (world.masses()[k], k));
        let square = |v: [f64; 3]| v.iter().map(|v| v * v).sum::<f64>();
        let kinetic: f64 = masses().map(|(m, k)| 0.5 * m * square(sample.velocity[k])).sum();
        let [gx, gy] = [0.5, -9.81];
        let gravity: f64 = masses().map(|(m, k)| -m * (gx * sample.position[k][0] + gy * sample.position[k][1])).sum();
        let is_near = |a: f64, b: f64| (a - b).abs() < 1e-9 * (1.0 + a.abs());
        assert!(is_near(energies.kinetic, kinetic), "{} {kinetic} J", energies.kinetic);
        assert!(is_near(energies.gravity, gravity), "{} {gravity} J", energies.gravity);
        assert!(is_near(energies.sum(), sample.energy), "{} {} J", energies.sum(), sample.energy);
    }
    assert!(measured(&mut stage).unwrap().energies.springs > 0.01, "the rope is stretched");
}

#[test]
fn a_probe_follows_its_point_and_drops_out_with_it() {
    let mut stage = stage(SCENE);
    let point = PointId(0);
    stage.obey(Order::Watch(Some([None, Some(point.into())])));
    for _ in 0..10 {
        frame(&mut stage);
        let [none, probed] = measured(&mut stage).unwrap().probes;
        let (world, probed) = (stage.history().world(), probed.unwrap());
        let sample = world.sample(world.time());
        let speed = sample.velocity[0].iter().map(|v| v * v).sum::<f64>().sqrt();
        assert_eq!((none, probed.probe, probed.position), (None, Probe::Point(point), sample.position[0]));
        assert!((probed.speed() - speed).abs() < 1e-12 && speed > 0.5, "{} {speed} m/s", probed.speed());
    }
    let keys = DeleteKeys { points: vec![0], ..DeleteKeys::default() };
    assert_eq!(stage.obey(Order::Give(vec![Do::Delete(keys)], Some("delete"))), None);
    assert_eq!(measured(&mut stage).unwrap().probes, [None; 2]);
    stage.obey(Order::Watch(Some([Some(PointId(9999).into()), Some(Probe::Bond(9999))])));
    assert_eq!(measured(&mut stage).unwrap().probes, [None; 2], "there is no such point");
}

#[test]
fn a_probe_of_a_bond_has_its_strain_and_its_force() {
    // A weight of 2 kg on a spring of 100 N/m, at rest where that bears it, and beside it a string that hangs loose and a rod.
    let mut stage = stage(
        r#"{"wobble": 1, "gravity": [0, -9.81], "points": {"position": [[0, 0], [0, -1.1962], [1, 0], [1, -0.5], [2, 0], [2, -1]],
            "mass": 2, "pinned": [0, 2, 3, 4]},
        "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 100, "rest": 1},
            {"a": 2, "b": 3, "kind": "spring", "stiffness": 100, "rest": 1, "limit": "max"}, {"a": 4, "b": 5}]}"#,
    );
    stage.obey(Order::Watch(Some([Some(Probe::Bond(0)), Some(Probe::Bond(1))])));
    (0..30).for_each(|_| frame(&mut stage));
    let [spring, string] = measured(&mut stage).unwrap().probes.map(Option::unwrap);
    assert!((spring.force.unwrap() - 2.0 * 9.81).abs() < 1e-6, "{spring:?}");
    assert!((spring.strain.unwrap() - 0.1962).abs() < 1e-9 && spring.speed() < 1e-6, "{spring:?}");
    assert_eq!((string.strain, string.force), (Some(-0.5), Some(0.0)), "what is slack pulls nothing");
    stage.obey(Order::Watch(Some([Some(Probe::Bond(2)), None])));
    let [rod, _] = measured(&mut stage).unwrap().probes;
    let force = rod.and_then(|rod| rod.force).unwrap();
    assert!((force - 2.0 * 9.81).abs() < 1e-9, "the rod bears the same weight: {force} N");
    assert_eq!(
        stage.obey(Order::Give(
            vec![Do::Cut { from: Cursor::at([-0.5, -0.5]), to: Cursor::at([0.5, -0.5]) }],
            Some("cut")
        )),
        None
    );
    stage.obey(Order::Watch(Some([Some(Probe::Bond(0)), Some(Probe::Bond(1))])));
    let after = measured(&mut stage).unwrap().probes;
    assert!(after[0].is_none() && after[1].is_some(), "what is cut drops out, and others keep their numbers");
}

#[test]
fn a_bond_and_a_corner_have_their_angles() {
    let mut stage = stage(
        r#"{"wobble": 1, "gravity": [0, 0], "points": {"position": [[0, 0], [2, 0], [2, -3]], "pinned": [0, 1, 2]},
        "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 9}, {"a": 1, "b": 2, "kind": "spring", "stiffness": 9}]}"#,
    );
    stage.obey(Order::Watch(Some([Some(Probe::Bond(0)), Some(Probe::Bond(1))])));
    let [level, down] = measured(&mut stage).unwrap().probes.map(Option::unwrap);
    assert_eq!((level.length(), down.length()), (Some(2.0), Some(3.0)));
    assert_eq!((level.angle, down.angle), (Some(0.0), Some(270.0)));
    // At the point that both share one goes left and one down: a quarter of a turn anticlockwise.
    assert_eq!((level.angle_to(&down), down.angle_to(&level)), (Some(90.0), Some(270.0)));
    assert!((level.distance(&down) - 1.0_f64.hypot(1.5)).abs() < 1e-12);
    stage.obey(Order::Watch(Some([Some(Probe::Corner([0, 1, 2].map(PointId))), None])));
    let [corner, _] = measured(&mut stage).unwrap().probes;
    let corner = corner.unwrap();
    assert_eq!((corner.angle, corner.position, corner.length()), (Some(90.0), [2.0, 0.0, 0.0], None));
}

#[test]
fn how_far_points_are_from_the_world_beside_is_told_of_the_times_of_measurements() {
    // It falls by a method that is exact, and beside it by explicit Euler, which is behind by g h t/2.
    let text = r#"{"wobble": 1, "gravity": [0, -10], "points": {"position": [[0, 0], [1, 0]]},
        "method": {"solver": "verlet", "substep": 0.01},
        "beside": [{"method": {"solver": "euler"}}]}"#;
    let mut stage = stage(text);
    stage.obey(Order::Watch(Some([Some(Probe::Point(PointId(1))), None])));
    let (mut shown, mut seen) = (Shown::default(), Vec::new());
    let mut plots = crate::app::plots::Plots::new(1.0);
    plots.toggle(PointId(1), |_| false);
    for _ in 0..30 {
        stage.obey(Order::Advance { wall: 0.02, cursor: None, back: false });
        stage.show(&mut shown);
        plots.take(&shown);
        seen.extend(shown.apart.iter().copied());
    }
    assert!(seen.len() > 20, "{seen:?}");
    for apart in &seen {
        let expected = 0.5 * 10.0 * 0.01 * apart.time;
        assert!((apart.distances[0].unwrap() - expected).abs() < 1e-9, "{apart:?}: {expected}");
        assert_eq!(apart.distances[1], None, "nothing is probed there");
    }
    let known =
        plots.series().iter().filter(|measured| measured.probes[0].is_some_and(|probed| probed.error.is_some()));
    assert!(known.count() > 20, "the curve has them");
    stage.obey(Order::Watch(None));
    stage.obey(Order::Advance { wall: 0.02, cursor: None, back: false });
    stage.show(&mut shown);
    assert!(shown.apart.is_empty());
}

#[test]
fn energies_are_told_apart_by_their_kinds_and_a_ledger_where_one_is_kept() {
    let text = |keys: &str| {
        format!(
            r#"{{"wobble": 1, "gravity": [0, -9.81], "drag_rate": 0.5, "points": {{"position": [[0, 0], [1, 0.2], [2, 0]], "velocity": [[0, 0], [0, 1], [0, 0]]}},
            "bonds": [{{"a": 0, "b": 1, "kind": "spring", "stiffness": 200, "rest": 1}}, {{"a": 1, "b": 2, "kind": "spring", "stiffness": 200, "rest": 1}}],
            "angles": [{{"points": [0, 1, 2], "stiffness": 5}}]{keys}}}"#
        )
    };
    let look = |text: &str| {
        let mut stage = stage(text);
        stage.obey(Order::Watch(Some(Probes::default())));
        (0..10).for_each(|_| frame(&mut stage));
        (measured(&mut stage).unwrap(), stage.history().world().energy())
    };
    let (plain, energy) = look(&text(""));
    let kinds = plain.energies;
    assert!(kinds.springs > 0.0 && kinds.angles > 0.0 && kinds.areas == 0.0 && kinds.surfaces == 0.0, "{kinds:?}");
    assert!((kinds.sum() - energy).abs() < 1e-12 && plain.strain > 0.0);
    assert_eq!(plain.book, None, "nobody asked for one");
    let (kept, _) = look(&text(r#", "method": {"ledger": true}"#));
    assert!(kept.book.is_some_and(|book| book.drag > 0.01), "{kept:?}");
}

#[test]
fn large_worlds_are_measured_in_some_frames_only() {
    let mut stage = stage(
        r#"{"wobble": 1, "bodies": [{"make": "rope", "count": 30000, "spacing": 0.01,
            "material": {"kind": "spring", "stiffness": 100, "damping": 0, "mass": 0.1}}]}"#,
    );
    stage.obey(Order::Watch(Some(Probes::default())));
    let seen: Vec<bool> = (0..4).map(|_| measured(&mut stage).is_some()).collect();
    assert_eq!(seen, [true, false, true, false]);
}

#[test]
fn a_table_is_written_whole_or_not_at_all_and_it_is_said_where() {
    let mut stage = stage(SCENE);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    assert_eq!(stage.obey(Order::Table(path.clone(), b"t\n1\n".to_vec())), Some(Note::Written(path.clone())));
    assert_eq!(std::fs::read(&path).unwrap(), b"t\n1\n");
    let lost = stage.obey(Order::Table(folder.path().join("none/a.csv"), Vec::new()));
    assert!(matches!(lost, Some(Note::NotWritten(_))), "{lost:?}");
}
