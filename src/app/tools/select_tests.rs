//! What is selected: moved, copied, taken away.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::tests::{opened, pixel, scope, shown};
use super::{Deed, Hand, copy};
use crate::app::action::Tool;
use crate::app::player::{Order, Stage};
use crate::history::Do;
use crate::scene::Scene;
use crate::sim::PointId;

const DISCS: &str = r#"{"wobble": 1, "gravity": [0, 0], "contact": true, "view": {"center": [0, 0], "height": 10},
    "obstacles": [{"box": {"min": [3, -1], "max": [5, 1]}}],
    "bodies": [{"make": "disc", "radius": 1, "spacing": 0.4, "origin": [-2, 0], "velocity": [0, 1],
        "material": {"kind": "spring", "stiffness": 300, "damping": 1, "mass": 2}}]}"#;

fn hand() -> Hand {
    let mut hand = Hand::default();
    hand.take(Tool::Select);
    hand
}

#[test]
fn a_click_selects_and_a_drag_moves_by_one_edit() {
    let seen = shown(Scene::parse(DISCS, "x.json").unwrap());
    let at = |x: f64, y: f64| DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap());
    for (from, points, obstacles) in [([-2.0, 0.0], seen.0.point_count(), 0), ([4.0, 0.0], 0, 1)] {
        let mut hand = hand();
        let (from, to) = (at(from[0], from[1]), at(from[0] - 1.0, from[1] + 0.5));
        assert!(hand.press(scope(&seen), from).is_empty());
        assert_eq!(hand.release(scope(&seen), from), Deed::default(), "a click moves nothing");
        assert!(!hand.marks(scope(&seen), None).is_empty(), "it is outlined");
        hand.press(scope(&seen), from);
        let deed = hand.release(scope(&seen), to);
        let [Do::Move(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
        assert_eq!((deed.edit, keys.points.len(), keys.obstacles.len()), (Some("move"), points, obstacles));
        let [x, y, _] = keys.by.unwrap().embed();
        assert!((x + 1.0).abs() < 1e-9 && (y - 0.5).abs() < 1e-9);
        // Esc ends a drag first, then the selection.
        hand.press(scope(&seen), from);
        assert_eq!(hand.cancel(), (true, Deed::default()));
        assert_eq!(hand.release(scope(&seen), to), Deed::default());
        assert!(hand.cancel().0 && !hand.cancel().0);
    }
}

#[test]
fn what_is_selected_is_taken_away_wherever_the_cursor_is() {
    let seen = shown(Scene::parse(DISCS, "x.json").unwrap());
    let mut hand = hand();
    hand.press(scope(&seen), pixel(&seen, 0));
    hand.release(scope(&seen), pixel(&seen, 0));
    let deed = hand.delete(scope(&seen), None);
    let [Do::Delete(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert_eq!(keys.points.len(), seen.0.point_count());
    assert!(hand.delete(scope(&seen), None).is_empty(), "once");
}

#[test]
fn a_click_on_a_point_means_it_and_a_drag_or_another_tool_does_not() {
    let seen = shown(Scene::parse(DISCS, "x.json").unwrap());
    let at = pixel(&seen, 7);
    let clicked = |tool: Tool, from: DVec2, to: DVec2| {
        let mut hand = Hand::default();
        hand.take(tool);
        hand.press(scope(&seen), from);
        hand.clicked(scope(&seen), to)
    };
    assert_eq!(clicked(Tool::Select, at, at + 2.0), Some(PointId(7)));
    assert_eq!(clicked(Tool::Select, at - 40.0, at), None, "a drag that ends on it");
    assert_eq!(clicked(Tool::Hand, at, at), None);
    // In the middle of a triangle, whose corners are thirty pixels away.
    let corners = seen.0.scenery.triangles[0].map(|corner| pixel(&seen, corner.index()));
    let middle = corners.into_iter().sum::<DVec2>() / 3.0;
    assert!(corners[0].distance(middle) > 12.0);
    assert_eq!(clicked(Tool::Select, middle, middle), None);
}

#[test]
fn in_space_nothing_is_moved_and_it_is_said() {
    let seen = opened("cloth-ball");
    let mut hand = hand();
    hand.press(scope(&seen), pixel(&seen, 5));
    let deed = hand.release(scope(&seen), pixel(&seen, 5) + 50.0);
    assert!(deed.is_empty() && deed.words.is_some());
}

#[test]
fn a_copy_moves_as_the_body_does() {
    let seen = shown(Scene::parse(DISCS, "x.json").unwrap());
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let mut hand = hand();
    assert!(hand.to_copy(scope(&seen)).is_none(), "nothing is selected");
    hand.press(scope(&seen), pixel(&seen, 0));
    hand.release(scope(&seen), pixel(&seen, 0));
    let (points, by) = hand.to_copy(scope(&seen)).unwrap();
    let count = points.len();
    assert!((2.0..3.0).contains(&by[0]), "beside it: {by:?}");
    stage.obey(Order::Add(Box::new(move |_, world| Ok(copy(world, &[], &points, by)))));
    (0..60).for_each(|_| _ = stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
    // The copy is what is selected when it is there, and nothing until then.
    hand.select(PointId(count as u32));
    assert!(hand.to_copy(scope(&seen)).is_none());
    let world = stage.history().world();
    assert_eq!(world.point_count(), 2 * count);
    assert_eq!(world.triangles().len() % 2, 0);
    let x = world.positions();
    for k in 0..count {
        let [dx, dy] = [0, 1].map(|axis| x.get(2 * (count + k) + axis) - x.get(2 * k + axis));
        assert!((dx - by[0]).abs() < 1e-6 && dy.abs() < 1e-6, "{dx} {dy}");
    }
}
