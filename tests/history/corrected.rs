//! The loops as printed stand beside the right worlds of the same points.

use super::cursor;
use wobble::history::{Companion, Do, Entry, Recording, Replay, distances, hash_now};
use wobble::scene::{MethodKeys, Scene, SolverName, gallery};
use wobble::sim::{BondKind, Cursor, PointId, Reach};

fn printed() -> impl Iterator<Item = (&'static str, Scene)> {
    let all = gallery().iter().filter(|entry| entry.name.ends_with("-as-printed"));
    all.map(|entry| (entry.name, entry.scene().unwrap()))
}

/// A hand that hovers, then drags the last point about, lets it go and pins it.
fn handled(scene: &Scene) -> Vec<Entry> {
    let start = scene.world(None).unwrap();
    let last = start.point_count() - 1;
    let [x, y] = [0, 1].map(|k| start.positions().get(last * start.dimensions() + k));
    let entry = |at, act| Entry { at, act, edit: None, name: None };
    let point = || vec![PointId(last as u32)];
    vec![
        entry(0.02, cursor(x + 0.1, y)),
        entry(0.05, Do::Grab(Reach::Points(point()))),
        entry(0.05, Do::Cursor { to: Some(Cursor::at([x + 0.2, y - 0.1])), by: Some(0.15) }),
        entry(0.15, Do::Release),
        entry(0.2, Do::Pin(point())),
    ]
}

/// How far the farthest point is from where a run has it `[m]`.
fn apart(companion: &mut Companion, run: &Replay, commands: &[Entry], time: f64) -> f64 {
    companion.reach(commands, time);
    let [here, there] = [run.world(), companion.world()].map(|world| world.sample(time.max(world.time())).position);
    distances(here.as_flattened(), there.as_flattened(), 3).into_iter().map(f64::from).fold(0.0, f64::max)
}

#[test]
fn beside_each_loop_as_printed_is_the_right_world_of_its_points_which_moves_as_it_does_alone() {
    let mut seen = 0;
    for (name, scene) in printed() {
        let commands = handled(&scene);
        let recording = Recording { commands: commands.clone(), ..scene.clone().into() };
        let mut companion = Companion::new(&recording, &scene.beside[0]).unwrap();
        let right = scene.companion(&scene.beside[0]);
        assert_ne!(right.method.solver, Some(SolverName::AsPrinted), "{name}");
        let alone = Recording { scene: right, ..recording.clone() };
        let mut run = Replay::new(&alone, name).unwrap();
        let mut main = Replay::new(&recording, name).unwrap();
        assert_eq!(companion.world().point_count(), main.world().point_count(), "{name}");
        for time in [0.04, 0.12, 0.3] {
            run.advance(&commands, time).unwrap();
            main.advance(&commands, time).unwrap();
            let far = apart(&mut companion, &main, &commands, time);
            assert_eq!(hash_now(companion.world(), time), hash_now(run.world(), time), "{name} at {time} s");
            assert!(companion.refused().is_none(), "{name}: {:?}", companion.refused());
            assert!(time < 0.3 || far > 1e-6, "{name}: {far} m at {time} s are no difference to be seen");
        }
        seen += 1;
    }
    assert_eq!(seen, 11, "loops as printed");
}

#[test]
fn beside_springs_as_printed_are_the_springs_of_the_gallery() {
    let scene = Scene::load("spring-damper-as-printed").unwrap();
    let right = Scene::load("spring-damper").unwrap();
    // Where a hand leads a point hangs on the steps, so these are the same then. Rounding of 2,000 steps of some m/s is 1e-11 m; springs
    // that are stiffer by a share of 1e-6 come to 1e-6 m in 2 s.
    let substep = scene.beside[0].method.substep;
    let as_short = Scene { method: MethodKeys { substep, ..right.method.clone() }, ..right.clone() };
    for (commands, right, within) in [(Vec::new(), right, 1e-5), (handled(&scene), as_short, 1e-6)] {
        let recording = Recording { commands: commands.clone(), ..scene.clone().into() };
        let mut companion = Companion::new(&recording, &scene.beside[0]).unwrap();
        let alone = Recording { commands: commands.clone(), ..right.into() };
        let mut run = Replay::new(&alone, "spring-damper").unwrap();
        for time in [0.12, 0.5, 2.0] {
            run.advance(&commands, time).unwrap();
            let far = apart(&mut companion, &run, &commands, time);
            assert!(far < within, "{far} m at {time} s");
        }
    }
}

#[test]
fn how_far_the_right_world_is_stands_in_captions() {
    let said = [
        ("spring-damper-as-printed", 2.0, 3.884, "its end is 3.9 m from where"),
        ("cloth-wind-as-printed", 0.05, 0.05508, "a point is 0.055 m off"),
    ];
    for (name, time, expected, words) in said {
        let entry = gallery().iter().find(|entry| entry.name == name).unwrap();
        let scene = entry.scene().unwrap();
        let recording: Recording = scene.clone().into();
        let mut run = Replay::new(&recording, name).unwrap();
        run.advance(&[], time).unwrap();
        let far = apart(&mut Companion::new(&recording, &scene.beside[0]).unwrap(), &run, &[], time);
        assert!((far - expected).abs() < 2e-3 * expected, "{name}: {far} m");
        assert!(entry.to_try.contains(words), "{name}: {}", entry.to_try);
    }
    // A weight of 1 kg hangs m g L/k deep by strain, and m g/k by the form that is called an alternative.
    let scene = Scene::load("spring-damper-relative-as-printed").unwrap();
    let recording: Recording = scene.clone().into();
    for (entry, depth) in scene.beside.iter().zip([9.81 * 2.0 / 40.0, 9.81 / 40.0]) {
        let mut companion = Companion::new(&recording, entry).unwrap();
        companion.reach(&[], 80.0);
        let hangs = 1.0 - companion.world().positions().get(3);
        assert!((hangs - depth).abs() < 1e-3, "{}: {hangs} m", companion.title());
    }
}

#[test]
fn wind_and_damping_beside_are_what_is_printed_on_average() {
    let of = |name: &str| {
        let scene = Scene::load(name).unwrap();
        let entry = scene.beside[0].clone();
        (scene, entry)
    };
    // 0.99 of a velocity is left after each of six moves a frame, 0.9985 after a frame of 004.
    let rates = [
        ("box", 0.99_f64.powi(6)),
        ("ragdoll", 0.99_f64.powi(6)),
        ("cloth-wind", 0.99_f64.powi(6)),
        ("cloth-space", 0.9985),
    ];
    for (name, left) in rates {
        let (_, entry) = of(&format!("{name}-as-printed"));
        let rate = entry.drag_rate.unwrap();
        assert!(((-rate / 60.0).exp() - left).abs() < 1e-5, "{name}: {rate}");
    }
    // A frame makes one of all points faster by half of the wind's velocity on average.
    let (scene, entry) = of("cloth-wind-as-printed");
    let points = scene.world(None).unwrap().point_count() as f64;
    let [most, wind] = [scene.wind.as_ref().unwrap(), entry.wind.as_ref().unwrap()].map(|wind| wind.velocity.embed());
    for k in 0..2 {
        let (push, drag) = (60.0 * 0.5 * most[k] / points, entry.drag_rate.unwrap() * wind[k]);
        assert!((drag / push - 1.0).abs() < 1e-3, "{drag} and {push} m/s^2");
    }
}

#[test]
fn what_bonds_are_by_scenes_in_n_are_springs_in_n_a_metre_beside() {
    for name in ["spring-damper-as-printed", "spring-damper-relative-as-printed"] {
        let scene = Scene::load(name).unwrap();
        let recording: Recording = scene.clone().into();
        let companion = Companion::new(&recording, &scene.beside[0]).unwrap();
        let start = scene.world(None).unwrap();
        assert_eq!(start.bonds().len(), companion.world().bonds().len());
        for (printed, right) in start.bonds().iter().zip(companion.world().bonds().iter()) {
            let [BondKind::Spring { stiffness: axial, .. }, BondKind::Spring { stiffness, .. }] =
                [printed.kind, right.kind]
            else {
                panic!("{name} has springs alone");
            };
            assert!((stiffness * right.rest_length - axial).abs() < 1e-9, "{name}: {stiffness} N/m and {axial} N");
        }
    }
}
