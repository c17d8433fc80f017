//! What stands beside a history: it follows the log wherever that goes, and the world knows nothing of it.

use serde_json::{Value, json};
use wobble::history::{Companion, DeleteKeys, Do, Entry, History, Recording, Replay, SetKeys, distances, hash_now};
use wobble::scene::{BesideKeys, MethodKeys, Scene, SolverName};
use wobble::sim::{BondKind, Cursor, PointId, Reach};

use super::common::session::{Dice, play as play_at_random};
use super::{cursor, hash, play, strength};

/// Two springs and a loose point between walls, pushed by a mouse.
const SCENE: &str = r#"{
    "wobble": 1, "name": "springs", "gravity": [0, -9.81],
    "points": { "position": [[-1, 1], [-1, 0], [-1, -1], [1, 0.5]], "pinned": [0] },
    "bonds": [
        { "a": 0, "b": 1, "kind": "spring", "stiffness": 40, "damping": 0.1 },
        { "a": 1, "b": 2, "kind": "spring", "stiffness": 40, "damping": 0.1 }
    ],
    "mouse": { "strength": 20, "radius": 1.5 },
    "bounds": { "min": [-3, -3], "max": [3, 3], "restitution": 0.4 },
    "method": { "solver": "verlet", "substep": 0.01 }
}"#;

fn scene(beside: &[BesideKeys]) -> Scene {
    Scene { beside: beside.to_vec(), ..Scene::parse(SCENE, "springs.json").unwrap() }
}

fn history(beside: &[BesideKeys]) -> History {
    History::new(scene(beside).into()).unwrap()
}

fn by(solver: SolverName) -> BesideKeys {
    BesideKeys::by(solver)
}

/// Springs twice as stiff, in thicker air that moves.
fn stiffer() -> BesideKeys {
    let spring = |a: u32| json!({"a": a, "b": a + 1, "kind": "spring", "stiffness": 80, "damping": 0.1});
    let keys = json!({"bonds": [spring(0), spring(1)], "drag_rate": 2, "wind": {"velocity": [1, 0]}});
    serde_json::from_value(keys).unwrap()
}

fn set(keys: Value) -> Do {
    Do::Set(Box::new(serde_json::from_value::<SetKeys>(keys).unwrap()))
}

/// Brings all along to where the world is.
fn bring(history: &mut History) {
    assert!(history.bring_along(history.world().time(), &mut || true));
}

fn places(companion: &Companion) -> Vec<f64> {
    let mut list = Vec::new();
    companion.places(companion.world().time(), &mut list);
    list
}

#[test]
fn a_companion_is_its_scene_alone_and_the_world_has_the_bits_that_it_has_without() {
    let methods = [by(SolverName::Rk4), by(SolverName::Euler)];
    let mut with = history(&methods);
    let mut without = history(&[]);
    (0..150).for_each(|_| {
        with.step();
        without.step();
        bring(&mut with);
    });
    assert_eq!(hash(&with), hash(&without));
    for (companion, entry) in with.companions().iter().zip(&methods) {
        let mut alone = scene(&[]).companion(entry).world(None).unwrap();
        (0..150).for_each(|_| alone.step());
        let time = alone.time();
        assert_eq!(hash_now(companion.world(), time), hash_now(&*alone, time), "{}", companion.title());
        assert_ne!(hash_now(companion.world(), time), hash_now(with.world(), time), "another method");
    }
}

#[test]
fn by_the_same_method_it_is_the_world_to_the_bit_whatever_is_done_undone_and_gone_back_to() {
    let mut dice = Dice::new(7);
    let mut history = history(&[BesideKeys::default()]);
    let mut done = 0;
    let same = |history: &mut History, what: &str| {
        bring(history);
        let time = history.world().time();
        let [here, beside] = [history.world(), history.companions()[0].world()].map(|world| hash_now(world, time));
        assert_eq!(here, beside, "{what} at {time} s");
        assert_eq!(history.companions()[0].world().time(), time);
    };
    for round in 0..12 {
        done += play_at_random(&mut history, &mut dice, 0.7);
        same(&mut history, "played");
        match round % 4 {
            0 => _ = history.undo(),
            1 => history.go_to(0.4 * history.world().time()),
            2 => _ = history.reset(),
            _ => _ = history.redo(),
        }
        same(&mut history, "gone");
        history.give(vec![cursor(0.5, 0.2), Do::Grab(Reach::Points(vec![PointId(3)]))], None).ok();
    }
    assert!(done > 50, "{done} commands");
}

#[test]
fn led_by_a_file_it_is_its_scene_led_by_that_file() {
    let entry = |at, act| Entry { at, act, edit: None, name: None };
    // At no end of a step.
    let commands = [
        entry(0.0317, cursor(1.0, -0.2)),
        entry(0.1234, Do::Grab(Reach::Points(vec![PointId(3)]))),
        entry(0.1234, Do::Cursor { to: Some(Cursor::at([-1.0, 1.0])), by: Some(0.4321) }),
        entry(0.5003, Do::Release),
        entry(0.7777, strength(-60.0)),
    ];
    let recording = Recording { commands: commands.to_vec(), ..scene(&[]).into() };
    for method in [by(SolverName::Rk4), by(SolverName::SymplecticEuler), BesideKeys::default()] {
        let mut companion = Companion::new(&recording, &method).unwrap();
        let alone = Recording { scene: recording.scene.companion(&method), ..recording.clone() };
        let mut run = Replay::new(&alone, "alone").unwrap();
        for time in [0.0317, 0.41, 1.237] {
            companion.reach(&commands, time);
            run.advance(&commands, time).unwrap();
            let [beside, alone] = [companion.world(), run.world()].map(|world| hash_now(world, time));
            assert_eq!(beside, alone, "{} at {time} s", companion.title());
        }
    }
}

#[test]
fn the_mouse_acts_on_all_and_a_change_of_the_method_on_the_world_alone() {
    let mut pushed = history(&[by(SolverName::Rk4)]);
    let mut calm = history(&[by(SolverName::Rk4)]);
    pushed.give(vec![cursor(1.0, -0.2), strength(90.0)], Some("push")).unwrap();
    for history in [&mut pushed, &mut calm] {
        (0..30).for_each(|_| history.step());
        bring(history);
    }
    let [there, here] = [&pushed, &calm].map(|history| places(&history.companions()[0]));
    let most = distances(&there, &here, 2).into_iter().fold(0.0, f32::max);
    assert!(most > 0.3, "the loose point was pushed by {most} m");
    let method = MethodKeys { solver: Some(SolverName::Euler), ..MethodKeys::default() };
    let other = Do::Set(Box::new(SetKeys { method: Some(method), ..SetKeys::default() }));
    let mut turned = history(&[by(SolverName::Rk4)]);
    turned.give(vec![other], Some("solver")).unwrap();
    (0..30).for_each(|_| turned.step());
    bring(&mut turned);
    assert_eq!(places(&turned.companions()[0]), here, "its method is its own");
    assert_ne!(hash(&turned), hash(&calm));
}

#[test]
fn steps_of_any_length_come_along_and_are_told_apart_by_their_distance() {
    let substep = |substep| BesideKeys {
        method: MethodKeys { substep: Some(substep), ..MethodKeys::default() },
        ..BesideKeys::default()
    };
    let mut history = history(&[substep(0.0007), substep(0.037)]);
    play(&mut history, 40);
    let [time, mut budget] = [history.world().time(), 0.0];
    let mut steps = || {
        budget += 1.0;
        budget < 100.0
    };
    assert!(!history.bring_along(time, &mut steps), "400 short steps are too many");
    assert!(history.bring_along(time, &mut || true));
    let [finer, coarser] = history.companions() else { panic!("two of them") };
    for companion in [finer, coarser] {
        let (reached, own) = (companion.world().time(), companion.world().substep());
        assert!((time - 1e-9..time + own).contains(&reached), "{reached} of {time}");
    }
    let mut at = [Vec::new(), Vec::new()];
    finer.places(time, &mut at[0]);
    coarser.places(time, &mut at[1]);
    let main: Vec<f64> = (0..8).map(|k| history.world().positions().get(k)).collect();
    let far = at.map(|places| distances(&main, &places, 2).into_iter().fold(0.0, f32::max));
    assert!(0.0 < far[0] && far[0] < far[1] && far[1] < 0.5, "{far:?}");
    assert!(distances(&[0.0, 0.0], &[3.0, 4.0, 1.0, 1.0], 2)[1].is_nan(), "a point of one world only");
    assert_eq!(distances(&[0.0, 0.0], &[3.0, 4.0, 1.0, 1.0], 2)[0], 5.0);
}

#[test]
fn what_cannot_stand_there_is_refused_with_its_name_and_all_stays_as_it_was() {
    let mut history = history(&[by(SolverName::Rk4)]);
    (0..20).for_each(|_| history.step());
    let before = hash(&history);
    let relaxed = BesideKeys { title: Some("swept".to_owned()), ..by(SolverName::AsPrinted) };
    let error = history.set_beside(vec![by(SolverName::Rk2), relaxed]).unwrap_err().to_string();
    assert!(error.contains("beside[1]") && error.contains("`swept`") && error.contains("source"), "{error}");
    assert_eq!((history.companions().len(), history.companions()[0].title()), (1, "rk4, h = 10 ms"));
    history.set_beside(vec![by(SolverName::Rk2), by(SolverName::Rk4)]).unwrap();
    bring(&mut history);
    let titles: Vec<&str> = history.companions().iter().map(Companion::title).collect();
    assert_eq!((titles, hash(&history)), (vec!["rk2, h = 10 ms", "rk4, h = 10 ms"], before));
    let saved: Recording = history.recording();
    assert_eq!(saved.scene.beside.len(), 2, "a scene that is saved has them");
    history.set_beside(Vec::new()).unwrap();
    assert!(history.companions().is_empty() && history.bring_along(9.0, &mut || false), "nothing is on its way");
}

#[test]
fn of_a_snapshot_it_goes_on_from_the_same_state() {
    let mut first = history(&[]);
    play(&mut first, 60);
    let mut kept = first.snapshot().unwrap();
    kept.scene.beside = vec![BesideKeys::default(), by(SolverName::Rk4)];
    let mut again = History::new(kept.into()).unwrap();
    let at = again.world().time();
    let start: Vec<f64> = (0..8).map(|k| again.world().positions().get(k)).collect();
    assert!(again.companions().iter().all(|one| one.world().time() == at && places(one) == start));
    (0..50).for_each(|_| again.step());
    bring(&mut again);
    let time = again.world().time();
    let [here, same, other] = [again.world(), again.companions()[0].world(), again.companions()[1].world()]
        .map(|world| hash_now(world, time));
    assert!(here == same && here != other);
}

#[test]
fn what_an_entry_has_of_its_own_is_its_worlds_alone() {
    let mut with = history(&[stiffer()]);
    let mut without = history(&[]);
    (0..150).for_each(|_| {
        with.step();
        without.step();
        bring(&mut with);
    });
    assert_eq!(hash(&with), hash(&without));
    let mut alone = scene(&[]).companion(&stiffer()).world(None).unwrap();
    (0..150).for_each(|_| alone.step());
    let time = alone.time();
    assert_eq!(hash_now(with.companions()[0].world(), time), hash_now(&*alone, time));
    // The loose point comes to the wind's speed but for e^(-2 t).
    let loose = places(&with.companions()[0])[6];
    let expected = 1.0 + time - 0.5 * (1.0 - (-2.0 * time).exp());
    assert!((loose - expected).abs() < 5e-3, "{loose} instead of {expected}");
    assert_eq!(with.companions()[0].title(), "verlet, h = 10 ms, its own bonds, drag, wind");
}

#[test]
fn a_command_that_sets_what_is_its_own_is_passed_over_and_told_and_any_other_is_done() {
    let after = |keys: Option<Value>| {
        let mut history = history(&[stiffer()]);
        (0..20).for_each(|_| history.step());
        if let Some(keys) = keys {
            history.give(vec![set(keys)], Some("set")).unwrap();
        }
        (0..30).for_each(|_| history.step());
        bring(&mut history);
        let companion = &history.companions()[0];
        (hash(&history), places(companion), companion.kept_own().map(str::to_owned))
    };
    let calm = after(None);
    assert_eq!(calm.2, None);
    let own = [
        (json!({"wind": {"velocity": [-5, 0]}, "drag_rate": 1}), "drag and wind"),
        (json!({"bonds": [0], "stiffness": 5}), "bonds"),
        (json!({"bonds": [1], "stiffness": 400, "over": 0.1}), "bonds"),
    ];
    for (keys, words) in own {
        let set = after(Some(keys.clone()));
        assert_ne!(set.0, calm.0, "{keys} changes the scene");
        assert_eq!(set.1, calm.1, "{keys} changes nothing beside it");
        assert_eq!(set.2, Some(format!("at 0.20 s it kept its own {words}")));
    }
    let both = after(Some(json!({"gravity": [3, 0], "wind": {"velocity": [-5, 0]}})));
    let gravity = after(Some(json!({"gravity": [3, 0]})));
    assert_eq!((both.1, both.2.as_deref()), (gravity.1.clone(), Some("at 0.20 s it kept its own wind")));
    assert!(gravity.1 != calm.1 && gravity.2.is_none(), "gravity is that of all");
}

#[test]
fn of_a_snapshot_it_goes_on_under_its_own_keys_with_what_is_left() {
    let mut first = history(&[]);
    play(&mut first, 30);
    first.give(vec![Do::Delete(DeleteKeys { bonds: vec![0], ..DeleteKeys::default() })], Some("cut")).unwrap();
    first.give(vec![set(json!({"gravity": [0, -2]}))], Some("lighter")).unwrap();
    play(&mut first, 30);
    let mut kept = first.snapshot().unwrap();
    kept.scene.beside = vec![stiffer()];
    let mut again = History::new(kept.into()).unwrap();
    let start: Vec<f64> = (0..8).map(|k| again.world().positions().get(k)).collect();
    let companion = &again.companions()[0];
    assert_eq!((companion.world().time(), places(companion)), (again.world().time(), start));
    let kinds: Vec<BondKind> = companion.world().bonds().iter().map(|bond| bond.kind).collect();
    assert_eq!(kinds, [BondKind::Spring { stiffness: 80.0, damping: 0.1 }], "the second bond is left");
    let settings = companion.world().settings();
    assert_eq!((settings.drag_rate, settings.gravity), (Some(2.0), Some([0.0, -2.0, 0.0])), "gravity is as it was set");
    (0..50).for_each(|_| again.step());
    bring(&mut again);
    let time = again.world().time();
    assert_ne!(hash_now(again.world(), time), hash_now(again.companions()[0].world(), time));
}

#[test]
fn a_scene_without_bodies_lists_the_bonds_of_these_beside_it_too() {
    let text = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0]]}, "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 4}],
        "bodies": [{"make": "box", "width": 1, "height": 1, "origin": [3, 0], "material": {"kind": "spring", "stiffness": 9}}],
        "beside": [{"bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 8}]}]}"#;
    let scene = Scene::parse(text, "x.json").unwrap();
    let expanded = scene.expanded().unwrap();
    expanded.check().unwrap();
    let [here, there] = [&scene, &expanded].map(|scene| scene.companion(&scene.beside[0]).model::<2>().unwrap());
    assert!(here.bonds.iter().eq(there.bonds.iter()) && here.bonds.len() == 6);
}
