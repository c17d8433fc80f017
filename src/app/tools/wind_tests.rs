//! Wind by an arrow.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::{Hand, Mark, PushWay, Scope};
use crate::app::action::Tool;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::render::{Camera, Pose};
use crate::scene::Scene;

const STILL: &str = r#"{"wobble": 1, "points": {"position": [[0, 0]]}}"#;

fn camera() -> Camera {
    Camera::new(Pose::Plane { center: DVec2::ZERO, height: 10.0 }, [1000, 1000])
}

/// A drag of the tool.
fn drag(hand: &mut Hand, stage: &mut Stage, [from, to]: [DVec2; 2]) -> Option<Note> {
    let mut shown = Shown::default();
    stage.show(&mut shown);
    let camera = camera();
    let scope = Scope { shown: &shown, camera: &camera, scale: 1.0, free: Scope::ANYWHERE };
    assert!(hand.press(scope, from).is_empty());
    let deed = hand.release(scope, to);
    stage.obey(Order::Give(deed.commands, deed.edit))
}

fn wind(stage: &mut Stage) -> Option<[f64; 2]> {
    let mut shown = Shown::default();
    stage.show(&mut shown);
    shown.settings.wind.flatten().map(|wind| [wind.velocity[0], wind.velocity[1]])
}

#[test]
fn an_arrow_is_wind_that_is_felt_changed_by_its_end_taken_away_there_and_undone() {
    let mut stage = Stage::new(Scene::parse(STILL, "x.json").unwrap().into()).unwrap();
    let mut hand = Hand::default();
    hand.take(Tool::Push);
    hand.set_push_way(PushWay::Wind);
    let [from, to] = [DVec2::new(300.0, 300.0), DVec2::new(500.0, 400.0)];
    assert_eq!(drag(&mut hand, &mut stage, [from, to]), None);
    // 100 px are 5 m/s.
    assert_eq!(wind(&mut stage), Some([10.0, -5.0]));
    // There was no drag: it was given some, in the same step of undo.
    let still = stage.history().world().sample(0.0).velocity[0];
    (0..30).for_each(|_| drop(stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false })));
    let now = stage.history().world().time();
    assert!(stage.history().world().sample(now).velocity[0][0] > still[0] + 1.0, "it is blown along");
    // The end is where it is seen: a drag there changes it.
    let mut shown = Shown::default();
    stage.show(&mut shown);
    let camera = camera();
    let scope = Scope { shown: &shown, camera: &camera, scale: 1.0, free: Scope::ANYWHERE };
    let said =
        |marks: &[Mark]| marks.iter().any(|mark| matches!(mark, Mark::Words(_, words) if words.contains("11.2 m/s")));
    assert!(said(&hand.marks(scope, Some(DVec2::new(900.0, 900.0)))), "its number stands beside it");
    drag(&mut hand, &mut stage, [to, DVec2::new(400.0, 300.0)]);
    assert_eq!(wind(&mut stage), Some([5.0, 0.0]));
    let end = DVec2::new(400.0, 300.0);
    drag(&mut hand, &mut stage, [end, end]);
    assert_eq!(wind(&mut stage), None, "a click on it takes it away");
    for before in [Some([5.0, 0.0]), Some([10.0, -5.0]), None] {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(..))));
        assert_eq!(wind(&mut stage), before);
    }
}
