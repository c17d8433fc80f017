//! Worlds side by side without a window: frames, and what companions may take of them.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use super::beside::{Beside, Companions, Escort};
use super::rungs::Load;
use super::tests::{scene, strength};
use super::{Note, Order, Pace, Shown, Stage};
use crate::history::{Do, History, SetKeys};
use crate::scene::{BesideKeys, Scene, SolverName};
use crate::sim::Cursor;

fn stage(beside: &[BesideKeys]) -> Stage {
    Stage::new(Scene { beside: beside.to_vec(), ..scene() }.into()).unwrap()
}

fn shown(stage: &mut Stage) -> Shown {
    let mut shown = Shown::default();
    stage.show(&mut shown);
    shown
}

/// Frames of an odd length with a cursor that goes about.
fn frames(stage: &mut Stage, count: u32) {
    for frame in 0..count {
        let cursor = Some(Cursor::at([0.02 * f64::from(frame), 1.0]));
        stage.obey(Order::Advance { wall: 0.0173, cursor, back: false });
    }
}

#[test]
fn in_every_frame_the_same_method_is_drawn_where_the_world_is_and_another_is_not() {
    let mut stage = stage(&[BesideKeys::default(), BesideKeys::by(SolverName::Euler)]);
    let mut drawn = 0;
    for _ in 0..20 {
        frames(&mut stage, 1);
        let shown = shown(&mut stage);
        let [by, steps] = ["automatic (", "), steps of 1.429 ms"].map(|words| shown.title.split_once(words));
        assert!(by.is_some_and(|(before, _)| before.is_empty()), "what the rules chose is named: {}", shown.title);
        assert!(steps.is_some_and(|(_, after)| after.is_empty()) && shown.beside.len() == 2, "{}", shown.title);
        let [same, other] = &shown.beside[..] else { panic!("two of them") };
        assert!(same.farthest.is_some_and(|most| most < 1e-12), "between steps too: {:?}", same.farthest);
        assert_eq!(same.words, "");
        // On a busy machine what takes longer is drawn a frame later.
        drawn += u32::from(other.farthest.is_some());
        assert!(other.farthest.is_none_or(|most| most > 0.0 && most < 0.2));
        assert_ne!(same.topology, 0, "its scenery is there");
    }
    assert!(drawn > 0);
    // What is undone, gone back to and reset goes for all.
    stage.obey(Order::Give(vec![strength(90.0)], Some("push")));
    frames(&mut stage, 10);
    let orders: [fn() -> Order; 4] =
        [|| Order::Undo(None), || Order::Redo(None), || Order::GoTo(0.05, None), || Order::Reset];
    for order in orders {
        stage.obey(order());
        // On a busy machine it comes a frame or two later.
        let there = (0..100).find_map(|_| {
            stage.obey(Order::Advance { wall: 0.0, cursor: None, back: false });
            shown(&mut stage).beside[0].farthest
        });
        assert_eq!(there, Some(0.0), "at the end of a step, to the bit");
    }
}

#[test]
fn a_world_that_keeps_what_is_its_own_says_so_until_that_is_undone() {
    let mut stage = stage(&[BesideKeys { drag_rate: Some(3.0), ..BesideKeys::default() }]);
    frames(&mut stage, 5);
    let thinner = SetKeys { drag_rate: Some(1.0), ..SetKeys::default() };
    stage.obey(Order::Give(vec![Do::Set(Box::new(thinner))], Some("drag")));
    // On a busy machine it comes a frame or two later.
    let mut comes = |order: Option<Order>, is_so: &dyn Fn(&Beside) -> bool| {
        if let Some(order) = order {
            stage.obey(order);
        }
        (0..100).any(|_| {
            frames(&mut stage, 1);
            is_so(&shown(&mut stage).beside[0])
        })
    };
    let is_told = |world: &Beside| world.farthest.is_some() && world.words.is_empty();
    assert!(comes(None, &|world| is_told(world) && world.kept.ends_with(" s it kept its own drag")));
    assert!(comes(Some(Order::Undo(None)), &|world| is_told(world) && world.kept.is_empty()));
}

#[test]
fn what_is_put_beside_a_running_world_catches_up_from_its_start_and_goes_away_again() {
    let mut stage = stage(&[]);
    frames(&mut stage, 40);
    let alone = shown(&mut stage);
    assert!(alone.beside.is_empty() && alone.title.is_empty() && !alone.figures.behind);
    stage.obey(Order::Beside(Companions::Reference));
    while shown(&mut stage).figures.behind {
        stage.obey(Order::Advance { wall: 0.0, cursor: None, back: false });
    }
    let with = shown(&mut stage);
    assert!(with.beside[0].title.starts_with("reference: Runge-Kutta, order 8, steps of "), "{}", with.beside[0].title);
    assert!(with.beside[0].farthest.is_some_and(|most| most < 1e-3), "{:?}", with.beside[0].farthest);
    assert_eq!(with.figures.time, alone.figures.time, "the world waits for nothing, and did not go on");
    let printed = Companions::These(vec![BesideKeys::by(SolverName::AsPrinted)]);
    let note = stage.obey(Order::Beside(printed));
    assert!(matches!(note, Some(Note::Refused(why)) if why.contains("as-printed")));
    assert_eq!(shown(&mut stage).beside.len(), 1);
    stage.obey(Order::Beside(Companions::These(Vec::new())));
    assert!(shown(&mut stage).beside.is_empty());
}

#[test]
fn under_load_companions_wait_before_anything_else_gives_way_and_come_after_in_a_pause() {
    let load = |is_late| Load { wall: 0.05, steps: 0.03, is_late, work: 0.04 };
    let start = Scene { beside: vec![BesideKeys::by(SolverName::Rk4)], ..scene() };
    let mut history = History::new(start.into()).unwrap();
    let mut pace = Pace::new(&history, 1.0, None);
    let mut escort = Escort::default();
    let late: Vec<bool> = (0..12).map(|_| escort.gives_way(&history, load(true))).collect();
    assert!(late[..11].iter().all(|is_first| *is_first) && !late[11], "for half a second it is theirs to wait");
    for _ in 0..3 {
        pace.advance(&mut history, 0.02, None, || 0.0);
        assert_eq!(escort.come(&mut history, &mut pace, 0.02), 0.0, "they take nothing");
    }
    let mut beside = Vec::new();
    escort.show(&history, &pace, pace.mix(history.world()), &mut beside);
    assert!(beside[0].words.starts_with("too slow to go along: it stands at 0.0 s"), "{}", beside[0].words);
    assert!(beside[0].farthest.is_none() && escort.is_behind(&history));
    pace.playing = false;
    pace.settle(&history);
    while escort.is_behind(&history) {
        escort.come(&mut history, &mut pace, 0.0);
    }
    escort.show(&history, &pace, pace.mix(history.world()), &mut beside);
    assert!(beside[0].words.is_empty() && beside[0].farthest.is_some());
    let mut alone = Escort::default();
    let history = History::new(scene().into()).unwrap();
    assert!(
        !alone.gives_way(&history, load(true))
            && alone.come(&mut History::new(scene().into()).unwrap(), &mut pace, 1.0) == 0.0
    );
}

#[test]
fn while_time_runs_worlds_are_as_far_apart_as_their_methods_and_not_as_points_on_straight_lines_between_steps() {
    let spring = r#"{"wobble": 1, "gravity": [0, -9.81], "points": {"position": [[0, 0], [1, 0]], "mass": [1, 0.5], "pinned": [0]},
        "bonds": [{"a": 0, "b": 1, "rest": 0.8, "kind": "spring", "stiffness": 50, "damping": 0.4}]}"#;
    let mut stage = Stage::new(Scene::parse(spring, "x.json").unwrap().into()).unwrap();
    stage.obey(Order::Beside(Companions::Reference));
    let mut seen = 0;
    for _ in 0..60 {
        frames(&mut stage, 1);
        if let Some(most) = shown(&mut stage).beside[0].farthest {
            assert!(most < 2e-7, "{most} m, where both are right to 1e-7 m");
            seen += 1;
        }
    }
    assert!(seen > 10, "{seen}");
}
