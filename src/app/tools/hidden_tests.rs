//! What is hidden: not drawn, found again, and saved.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::marks::{Mark, Role};
use super::tests::{SIZE, scope};
use super::{Chosen, Hand};
use crate::app::action::Tool;
use crate::app::matter::{Among, MatterChange};
use crate::app::opening;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::history::Start;
use crate::picture::Tint;
use crate::render::Camera;
use crate::scene::Scene;
use crate::sim::PointId;

/// A soft disc, and a rope that stands still.
const TWO: &str = r#"{"wobble": 1, "view": {"center": [0, 0], "height": 10}, "bodies": [
    {"make": "disc", "radius": 1, "spacing": 0.4, "origin": [-3, 0], "material": {"kind": "spring", "stiffness": 300}},
    {"make": "rope", "count": 5, "spacing": 0.5, "origin": [1, 0]}]}"#;

fn seen(stage: &mut Stage) -> (Shown, Camera, Scene) {
    let mut shown = Shown::default();
    stage.show(&mut shown);
    let scene = Scene::parse(TWO, "x.json").unwrap();
    let camera = opening::camera(&scene, &shown.view(), SIZE);
    (shown, camera, scene)
}

fn change(stage: &mut Stage, points: &[PointId], change: MatterChange) -> Option<Note> {
    let among = Among { points: points.to_vec(), ..Among::default() };
    stage.obey(Order::Change { among, change, goes_on: false })
}

fn tint(stage: &Stage, point: PointId) -> Tint {
    *Tint::of(stage.history().tints(), point.0).unwrap()
}

#[test]
fn a_hidden_body_is_outlined_by_the_tool_that_selects_and_can_be_chosen_and_shown_again() {
    let mut stage = Stage::new(Scene::parse(TWO, "x.json").unwrap().into()).unwrap();
    let all = seen(&mut stage);
    let count = all.0.point_count() as u32;
    let disc: Vec<PointId> = scope(&all).body(PointId(0));
    assert!(disc.len() > 10 && (disc.len() as u32) < count);
    assert_eq!(change(&mut stage, &disc, MatterChange::Visible(false)), None);
    let now = seen(&mut stage);
    let hidden = Chosen::hidden(scope(&now));
    assert_eq!((hidden.points.clone(), super::hidden_bodies(scope(&now)).len()), (disc.clone(), 1));
    let ghosts = |tool: Tool| {
        let mut hand = Hand::default();
        hand.take(tool);
        let marks = hand.marks(scope(&now), None);
        marks.iter().filter(|mark| matches!(mark, Mark::Line(Role::Ghost, ..))).count()
    };
    assert!(ghosts(Tool::Select) >= 8 && ghosts(Tool::Hand) == 0 && ghosts(Tool::Cut) == 0);
    // A click on its outline, a box around all, and all at once choose it too.
    let mut hand = Hand::default();
    hand.take(Tool::Select);
    let rim = scope(&now).pixel(disc[0]).unwrap();
    hand.press(scope(&now), rim);
    hand.release(scope(&now), rim);
    assert_eq!(hand.chosen(scope(&now)).unwrap().points, disc);
    hand.press(scope(&now), DVec2::new(2.0, 2.0));
    hand.trace(scope(&now), DVec2::new(990.0, 690.0));
    hand.release(scope(&now), DVec2::new(990.0, 690.0));
    assert_eq!(hand.chosen(scope(&now)).unwrap().points.len(), count as usize);
    // It is written with all that was done, with the moment alone, and undone.
    let snapshot = Start::from(stage.history().snapshot().unwrap());
    for start in [stage.history().recording().into(), snapshot] {
        let mut again = Stage::new(start).unwrap();
        while again.history().has_future() {
            again.obey(Order::Advance { wall: 0.1, cursor: None, back: false });
        }
        assert!(tint(&again, disc[3]).is_hidden && !tint(&again, PointId(count - 1)).is_hidden);
    }
    assert_eq!(change(&mut stage, &hidden.points, MatterChange::Visible(true)), None);
    assert!(Chosen::hidden(scope(&seen(&mut stage))).is_empty());
    for (name, is_hidden) in [("show", true), ("hide", false)] {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(undone, _)) if undone == name));
        assert_eq!(tint(&stage, disc[0]).is_hidden, is_hidden, "{name}");
    }
}

#[test]
fn a_bond_that_is_drawn_wide_is_hit_all_over_and_its_width_goes_with_a_copy() {
    let mut stage = Stage::new(Scene::parse(TWO, "x.json").unwrap().into()).unwrap();
    let before = seen(&mut stage);
    let rope = scope(&before).body(PointId(before.0.point_count() as u32 - 1));
    // 0.2 m beside the second of its bonds: 14 pixels.
    let at = DVec2::from(before.1.screen_from_world([1.75, 0.2, 0.0].into()).unwrap());
    assert_eq!(scope(&before).bond(at), None);
    assert_eq!(change(&mut stage, &rope, MatterChange::Width(0.5)), None);
    let now = seen(&mut stage);
    assert!(scope(&now).bond(at).is_some_and(|(_, [a, _])| rope.contains(&a)));
    stage.obey(Order::Inspect(Among { points: rope.clone(), ..Among::default() }));
    let matter = seen(&mut stage).0.matter.unwrap();
    assert_eq!((matter.width.and_then(|span| span.same()), matter.hidden), (Some(0.5), 0));
    assert_eq!(change(&mut stage, &rope, MatterChange::Visible(false)), None);
    let chosen = Chosen { points: rope.clone(), ..Chosen::default() };
    let clip = crate::app::clip::Clip::of(stage.history(), &chosen);
    let next = stage.history().world().point_count() as u32;
    let coming = move |history: &crate::history::History| {
        Ok(crate::app::player::Coming::of(clip.placed(history.world(), [0.0, 2.0, 0.0])))
    };
    stage.obey(Order::Add(Box::new(coming)));
    let copy = tint(&stage, PointId(next));
    assert_eq!((copy.width, copy.is_hidden), (0.5, true));
    // 0 is as is usual.
    change(&mut stage, &[PointId(next)], MatterChange::Width(0.0));
    assert_eq!((tint(&stage, PointId(next)).width, tint(&stage, PointId(next + 1)).width), (0.0, 0.5));
}
