//! What gives way to the load: by loads that are made up, no clock is looked at.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::time::{Duration, Instant};

use super::rungs::{Load, Rung, Rungs};
use super::{Note, Order, Stage};
use crate::history::{Do, History};
use crate::scene::Scene;
use crate::sim::Solver;

/// A mesh of springs that turns, and that a mouse may push: by a method of order 4.
const SPRINGS: &str = r#"{
    "wobble": 1, "name": "springs", "mouse": { "strength": 20, "radius": 0.5 },
    "bodies": [{ "make": "lattice", "columns": 6, "rows": 6, "spacing": 0.2, "spin": 1,
        "material": { "kind": "spring", "stiffness": 200, "damping": 0, "mass": 0.1 } }]
}"#;

/// A lattice of rigid bonds that turns as it falls, with a budget that it never reaches. Its bonds could break: it is no rigid body.
const RIGID: &str = r#"{
    "wobble": 1, "name": "rigid", "gravity": [0, -9.81], "method": { "budget": 100000 },
    "mouse": { "strength": 20, "radius": 0.5 },
    "bodies": [{ "make": "lattice", "columns": 7, "rows": 7, "spacing": 0.2, "spin": 1,
        "material": { "kind": "rigid", "mass": 0.1, "break_strain": 1000 } }]
}"#;

fn scene(text: &str) -> Scene {
    Scene::parse(text, "test.json").unwrap()
}

fn history(text: &str) -> History {
    History::new(scene(text).into()).unwrap()
}

const LATE: Load = Load { wall: 0.05, steps: 0.026, is_late: true, work: 0.041 };
const EASY: Load = Load { wall: 0.05, steps: 0.005, is_late: false, work: 0.002 };

/// Tells of a load for so many seconds of wall time, a twentieth at a time, while the world steps. Does what is proposed, and says when.
fn bear(rungs: &mut Rungs, history: &mut History, load: Load, seconds: f64) -> Vec<(f64, &'static str)> {
    let mut done = Vec::new();
    for frame in 1..=(seconds / load.wall).round() as u32 {
        history.step();
        if let Some((act, name)) = rungs.look(history, load) {
            history.give_aside(act, name).unwrap();
            done.push((f64::from(frame) * load.wall, name));
        }
    }
    done
}

fn solvers(history: &History) -> Vec<Solver> {
    history.world().parts().iter().map(|part| part.solver).collect()
}

fn positions(history: &History) -> Vec<f64> {
    let x = history.world().positions();
    (0..x.len()).map(|k| x.get(k)).collect()
}

#[test]
fn order_2_takes_the_place_of_order_4_and_gives_it_back_by_commands_that_replay_to_the_bit() {
    let (mut history, mut rungs) = (history(SPRINGS), Rungs::new());
    assert_eq!(solvers(&history), [Solver::Rk4]);
    assert_eq!(bear(&mut rungs, &mut history, LATE, 0.45), []);
    assert_eq!(bear(&mut rungs, &mut history, EASY, 0.05), [], "a single frame that is not late begins it anew");
    let taken = bear(&mut rungs, &mut history, LATE, 0.6);
    assert!(taken.len() == 1 && (0.5..0.56).contains(&taken[0].0) && taken[0].1 == "order 2 under load", "{taken:?}");
    assert_eq!(solvers(&history), [Solver::VelocityVerlet]);
    let yielded = rungs.yielded(&history).unwrap();
    assert_eq!((yielded.rung, yielded.work), (Rung::Order, Some(0.041)));
    let further = bear(&mut rungs, &mut history, LATE, 2.0);
    assert_eq!(further.iter().map(|taken| taken.1).collect::<Vec<_>>(), ["live step under load"]);
    assert_eq!(bear(&mut rungs, &mut history, LATE, 5.0), [], "below there is slow motion alone");
    let back = bear(&mut rungs, &mut history, EASY, 6.0);
    assert_eq!(back.len(), 1);
    assert!((back[0].0 - 5.0).abs() < 0.06, "{back:?}");
    assert_eq!((solvers(&history), rungs.yielded(&history)), (vec![Solver::Rk4], None));
    // Once more: then the load has to be gone for twice as long.
    assert_eq!(bear(&mut rungs, &mut history, LATE, 1.0).len(), 1);
    assert!((bear(&mut rungs, &mut history, EASY, 11.0)[0].0 - 10.0).abs() < 0.06);

    let mut again = History::new(history.recording().into()).unwrap();
    while again.world().time() < history.world().time() - 1e-9 {
        again.step();
    }
    assert_eq!(positions(&again), positions(&history));
    assert!(positions(&again).iter().all(|x| x.is_finite()));
}

#[test]
fn what_the_live_step_moves_at_less_cost_goes_there_and_comes_back() {
    let (mut history, mut rungs) = (history(RIGID), Rungs::new());
    for _ in 0..40 {
        history.step();
    }
    assert!(history.world().is_cheaper_live(), "{:?}", history.world().parts());
    assert_eq!(history.world().counters().hand_overs, 0);
    let taken = bear(&mut rungs, &mut history, LATE, 0.6);
    assert_eq!(taken.iter().map(|taken| taken.1).collect::<Vec<_>>(), ["live step under load"]);
    for _ in 0..40 {
        history.step();
    }
    assert!(history.world().counters().hand_overs > 0);
    assert_eq!(history.world().moved_by()[0].method, Solver::Live);
    assert_eq!(bear(&mut rungs, &mut history, EASY, 5.1).len(), 1);
    assert_eq!((rungs.yielded(&history), history.method().budget), (None, scene(RIGID).method.budget));
}

#[test]
fn a_scene_that_asks_for_a_method_or_for_no_budget_only_gets_slower() {
    for method in [r#""budget": "none""#, r#""solver": "rk4""#, r#""tolerance": 0.01"#] {
        let text = SPRINGS.replacen("\"mouse\"", &format!("\"method\": {{ {method} }}, \"mouse\""), 1);
        let (mut history, mut rungs) = (history(&text), Rungs::new());
        assert_eq!(bear(&mut rungs, &mut history, LATE, 3.0), [], "{method}");
    }
}

#[test]
fn a_log_that_is_followed_is_left_as_it_is_and_its_rung_is_known() {
    let (mut first, mut rungs) = (history(SPRINGS), Rungs::new());
    bear(&mut rungs, &mut first, LATE, 1.0);
    let mut followed = History::new(first.recording().into()).unwrap();
    let mut rungs = Rungs::new();
    while followed.has_future() {
        assert!(rungs.look(&followed, LATE).is_none());
        followed.step();
    }
    let yielded = rungs.yielded(&followed).unwrap();
    assert_eq!((yielded.rung, yielded.work), (Rung::Order, None));
}

#[test]
fn what_is_taken_back_does_not_give_way_again() {
    let (mut history, mut rungs) = (history(SPRINGS), Rungs::new());
    assert_eq!(bear(&mut rungs, &mut history, LATE, 1.0).len(), 1);
    let (act, name) = rungs.back(&history);
    rungs.refuse_all();
    history.give(vec![act], Some(name)).unwrap();
    assert_eq!((solvers(&history), rungs.yielded(&history)), (vec![Solver::Rk4], None));
    assert_eq!(bear(&mut rungs, &mut history, LATE, 3.0), []);
}

#[test]
fn what_gives_way_by_itself_is_no_step_of_undo_and_stays_in_the_recording() {
    let (mut history, mut rungs) = (history(SPRINGS), Rungs::new());
    history.give(vec![Do::Pin(vec![crate::sim::PointId(0)])], Some("pin")).unwrap();
    let taken = bear(&mut rungs, &mut history, LATE, 2.0);
    assert!(!taken.is_empty());
    let names = |history: &History| -> Vec<(Option<u64>, String)> {
        let entries = history.recording().commands;
        entries.into_iter().map(|entry| (entry.edit, entry.name.unwrap_or_default())).collect()
    };
    assert_eq!(names(&history)[..2], [(Some(0), "pin".to_owned()), (None, taken[0].1.to_owned())]);
    // A file has it as it is.
    let mut text = Vec::new();
    history.recording().write_json(&mut text).unwrap();
    let read = crate::history::Log::of_text(&String::from_utf8(text).unwrap(), "x.json").unwrap();
    assert_eq!(read.commands().unwrap(), history.recording().commands);
    // What the player did is undone, with all that followed, and nothing is left to undo.
    assert_eq!(history.undo().unwrap().name, "pin");
    assert_eq!(history.undo(), None);
    assert_eq!(solvers(&history), [Solver::Rk4]);
    assert_eq!(history.redo().unwrap().name, "pin");
}

#[test]
fn islands_are_made_exact_by_a_command_that_is_undone() {
    let text = RIGID.replacen("100000", "0.01", 1);
    let mut stage = Stage::new(scene(&text).into()).unwrap();
    let step = |stage: &mut Stage| (0..60).for_each(|_| _ = stage.obey(Order::Step(None)));
    step(&mut stage);
    let mover = |stage: &Stage| stage.history().world().moved_by()[0].method;
    assert_eq!(mover(&stage), Solver::Live);
    assert_eq!(stage.obey(Order::Exact), Some(Note::Exact));
    assert_eq!(mover(&stage), Solver::VelocityVerlet);
    step(&mut stage);
    assert_eq!(mover(&stage), Solver::VelocityVerlet, "whatever it costs");
    let Some(Note::Undone(name, _)) = stage.obey(Order::Undo(None)) else { panic!("nothing was undone") };
    assert_eq!((name.as_str(), mover(&stage)), ("exact motion", Solver::Live));
}

#[test]
fn among_bodies_that_meet_those_that_touch_nothing_are_made_exact() {
    let text = RIGID.replacen("100000", "0.01", 1).replacen("\"gravity\"", "\"contact\": true, \"gravity\"", 1);
    let mut stage = Stage::new(scene(&text).into()).unwrap();
    let step = |stage: &mut Stage, frames: u32| (0..frames).for_each(|_| _ = stage.obey(Order::Step(None)));
    step(&mut stage, 10);
    let mover = |stage: &Stage| stage.history().world().moved_by()[0].method;
    assert_eq!(mover(&stage), Solver::Live);
    stage.obey(Order::Exact);
    // It goes back as any island does: where its own method takes it as it is.
    step(&mut stage, 5);
    assert_eq!(mover(&stage), Solver::VelocityVerlet, "{:?}", stage.history().world().moved_by());
    assert!(stage.history().world().contact().is_some());
}

/// The same in thick air, where it comes to rest after two seconds.
fn slowing() -> String {
    SPRINGS.replacen("\"mouse\"", "\"drag_rate\": 4, \"mouse\"", 1)
}

fn frame(stage: &mut Stage) {
    stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
}

/// Late frames until something gives way.
fn burden(stage: &mut Stage) {
    (0..12).for_each(|_| stage.give_way(LATE));
    assert!(is_rougher(stage), "{:?}", stage.history().world().parts());
}

fn is_rougher(stage: &Stage) -> bool {
    let last = stage.history().method_changes().next().and_then(|change| change.name.map(str::to_owned));
    last.is_some_and(|name| Rung::of(&name).is_some())
}

#[test]
fn what_gave_way_is_given_back_as_all_falls_asleep_and_all_sleeps_again() {
    let mut stage = Stage::new(scene(&slowing()).into()).unwrap();
    frame(&mut stage);
    burden(&mut stage);
    let is_given_back = (0..600).any(|_| {
        frame(&mut stage);
        !is_rougher(&stage)
    });
    assert!(is_given_back, "it sleeps: {}", stage.history().rests());
    let at = stage.history().world().time();
    // Another method woke it: what is slow meanwhile takes no rung.
    while stage.history().world().time() < at + 0.9 && !stage.history().rests() {
        stage.give_way(LATE);
        frame(&mut stage);
    }
    assert!(!is_rougher(&stage) && stage.history().rests());
    let mut shown = crate::app::player::Shown::default();
    stage.show(&mut shown);
    assert_eq!(shown.figures.yielded, None);
}

#[test]
fn what_gave_way_is_given_back_as_the_scene_ends() {
    let text = SPRINGS.replacen("\"mouse\"", "\"duration\": 0.5, \"mouse\"", 1);
    let mut stage = Stage::new(scene(&text).into()).unwrap();
    frame(&mut stage);
    burden(&mut stage);
    (0..20).for_each(|_| frame(&mut stage));
    assert!(is_rougher(&stage));
    (0..20).for_each(|_| frame(&mut stage));
    assert!(!is_rougher(&stage), "at {} s", stage.history().world().time());
}

#[test]
fn what_gave_way_is_given_back_after_a_while_of_pause_in_which_nothing_is_asked_for() {
    let mut stage = Stage::new(scene(SPRINGS).into()).unwrap();
    frame(&mut stage);
    burden(&mut stage);
    frame(&mut stage);
    assert_eq!(stage.patience(), None, "time passes");
    stage.obey(Order::Play(false));
    let left = stage.patience().unwrap();
    assert!(!stage.idle(Instant::now()) && is_rougher(&stage));
    assert!(stage.idle(Instant::now() + left + Duration::from_secs(1)) && !is_rougher(&stage));
    assert_eq!(
        (stage.patience(), stage.history().undoes()),
        (None, None),
        "nobody asked for it: it is no step of undo"
    );
    // A log that is followed is left as it is.
    stage.obey(Order::GoTo(0.0, None));
    assert!(!stage.idle(Instant::now() + Duration::from_secs(9)));
}
