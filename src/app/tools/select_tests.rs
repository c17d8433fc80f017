//! What is selected: by clicks, boxes and strokes; moved, turned, scaled, copied, taken away.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::handles::{Frame, Handle};
use super::tests::{opened, pixel, scope, shown};
use super::{Chosen, Deed, Hand, Mark};
use crate::app::action::Tool;
use crate::app::player::{Order, Probe, Shown, Stage};
use crate::history::Do;
use crate::render::Camera;
use crate::scene::Scene;
use crate::sim::PointId;

pub(super) const DISCS: &str = r#"{"wobble": 1, "gravity": [0, 0], "contact": true, "view": {"center": [0, 0], "height": 10},
    "obstacles": [{"box": {"min": [3, -1], "max": [5, 1]}}, {"plane": {"point": [0, -4.5], "normal": [0, 1]}}],
    "bodies": [{"make": "disc", "radius": 1, "spacing": 0.4, "origin": [-2, 0], "velocity": [0, 1],
        "material": {"kind": "spring", "stiffness": 300, "damping": 1, "mass": 2}},
      {"make": "rope", "count": 5, "to": [0, 1], "origin": [0.5, 2], "material": {"kind": "rigid", "mass": 1}}]}"#;

pub(super) type Seen = (Shown, Camera, Scene);

pub(super) fn hand() -> Hand {
    let mut hand = Hand::default();
    hand.take(Tool::Select);
    hand
}

pub(super) fn discs() -> Seen {
    shown(Scene::parse(DISCS, "x.json").unwrap())
}

pub(super) fn at(seen: &Seen, x: f64, y: f64) -> DVec2 {
    DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap())
}

/// Drags from one pixel to another; returns what comes of it.
pub(super) fn drag(hand: &mut Hand, seen: &Seen, [from, to]: [DVec2; 2]) -> Deed {
    assert!(hand.press(scope(seen), from).is_empty());
    hand.trace(scope(seen), to);
    hand.release(scope(seen), to)
}

pub(super) fn click(hand: &mut Hand, seen: &Seen, pixel: DVec2) {
    assert_eq!(drag(hand, seen, [pixel; 2]), Deed::default(), "a click changes nothing");
}

/// How many points and which obstacles are selected.
pub(super) fn selected(hand: &Hand, seen: &Seen) -> (usize, Vec<u32>) {
    let chosen = hand.chosen(scope(seen)).unwrap_or_default();
    (chosen.points.len(), chosen.obstacles)
}

pub(super) fn handle(hand: &Hand, seen: &Seen, handle: Handle) -> DVec2 {
    let frame = Frame::of(scope(seen), &hand.chosen(scope(seen)).unwrap()).unwrap();
    let handles = frame.handles(scope(seen));
    handles.into_iter().find(|(other, _)| *other == handle).unwrap().1
}

#[test]
fn a_click_selects_and_a_drag_moves_by_one_edit() {
    let seen = discs();
    let disc = seen.0.point_count() - 5;
    for (from, points, obstacles) in [([-2.0, 0.0], disc, 0), ([4.0, 0.0], 0, 1), ([-4.0, -4.5], 0, 1)] {
        let mut hand = hand();
        let (from, to) = (at(&seen, from[0], from[1]), at(&seen, from[0] - 1.0, from[1] + 0.5));
        click(&mut hand, &seen, from);
        assert!(!hand.marks(scope(&seen), None).is_empty(), "it is outlined");
        let deed = drag(&mut hand, &seen, [from, to]);
        let [Do::Move(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
        assert_eq!((deed.edit, keys.points.len(), keys.obstacles.len()), (Some("move"), points, obstacles));
        let [x, y, _] = keys.by.unwrap().embed();
        assert!((x + 1.0).abs() < 1e-9 && (y - 0.5).abs() < 1e-9);
        // Esc ends a drag first, then the selection.
        hand.press(scope(&seen), from);
        assert_eq!(hand.cancel(), (true, Deed::default()));
        assert_eq!(hand.release(scope(&seen), to), Deed::default());
        assert!(!hand.cancel().0 && hand.chosen(scope(&seen)).is_some());
        hand.deselect();
        assert!(hand.chosen(scope(&seen)).is_none());
    }
}

#[test]
fn a_box_and_a_stroke_select_what_they_touch_and_shift_adds() {
    let seen = discs();
    let disc = seen.0.point_count() - 5;
    let mut hand = hand();
    // Around the rope's upper end alone.
    drag(&mut hand, &seen, [at(&seen, 0.2, 3.5), at(&seen, 1.0, 2.9)]);
    assert_eq!(selected(&hand, &seen), (5, vec![]));
    hand.hold([true, false]);
    drag(&mut hand, &seen, [at(&seen, 2.5, 1.5), at(&seen, 5.5, -1.5)]);
    assert_eq!(selected(&hand, &seen), (5, vec![0]), "the plane has no end and is not boxed in");
    click(&mut hand, &seen, at(&seen, -2.0, 0.0));
    assert_eq!(selected(&hand, &seen), (5 + disc, vec![0]));
    click(&mut hand, &seen, at(&seen, 0.5, 2.5));
    assert_eq!(selected(&hand, &seen), (disc, vec![0]), "out again");
    hand.hold([false, false]);
    click(&mut hand, &seen, at(&seen, -4.0, 4.0));
    assert_eq!(selected(&hand, &seen), (0, vec![]), "a click beside all bodies");
    // With Alt a stroke may begin on a body: around the disc, and not around what its box would hold too.
    hand.hold([false, true]);
    let path = [[-2.0, 0.0], [-4.0, 1.5], [-0.5, 3.0], [-0.6, -2.0], [-3.0, -2.0]];
    let path = path.map(|[x, y]| at(&seen, x, y));
    assert!(hand.press(scope(&seen), path[0]).is_empty());
    path.into_iter().for_each(|pixel| hand.trace(scope(&seen), pixel));
    assert_eq!(hand.marks(scope(&seen), Some(path[4])).len(), 6, "it is drawn, closed");
    hand.release(scope(&seen), path[4]);
    assert_eq!(selected(&hand, &seen), (disc, vec![]));
    // The same without Alt, by the switch.
    hand.hold([false, false]);
    hand.draw_lasso(true);
    drag(&mut hand, &seen, [at(&seen, -4.5, 4.5), at(&seen, -4.0, 4.0)]);
    assert_eq!(selected(&hand, &seen), (0, vec![]));
}

#[test]
fn what_is_selected_is_taken_away_wherever_the_cursor_is() {
    let seen = discs();
    let mut hand = hand();
    hand.select_all(scope(&seen));
    let deed = hand.delete(scope(&seen), None);
    let [Do::Delete(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert_eq!((keys.points.len(), &keys.obstacles[..]), (seen.0.point_count(), &[0, 1][..]));
    assert!(hand.delete(scope(&seen), None).is_empty(), "once");
}

#[test]
fn a_click_on_a_point_means_it_and_a_drag_or_another_tool_does_not() {
    let seen = discs();
    let at = pixel(&seen, 7);
    let clicked = |tool: Tool, from: DVec2, to: DVec2| {
        let mut hand = Hand::default();
        hand.take(tool);
        hand.press(scope(&seen), from);
        hand.clicked(scope(&seen), to)
    };
    assert_eq!(clicked(Tool::Select, at, at + 2.0), Some(Probe::Point(PointId(7))));
    assert_eq!(clicked(Tool::Select, at - 40.0, at), None, "a drag that ends on it");
    assert_eq!(clicked(Tool::Hand, at, at), None);
    // In the middle of a triangle, whose corners are thirty pixels away.
    let corners = seen.0.scenery.triangles[0].map(|corner| pixel(&seen, corner.index()));
    let middle = corners.into_iter().sum::<DVec2>() / 3.0;
    assert!(corners[0].distance(middle) > 12.0);
    assert_eq!(clicked(Tool::Select, middle, middle), None);
    let half = 0.5 * (corners[0] + corners[1]);
    let [a, b] = [0, 1].map(|k| seen.0.scenery.triangles[0][k]);
    let Some(Probe::Bond(number)) = clicked(Tool::Select, half, half) else { panic!("a side is a bond") };
    let ends = seen.0.scenery.bond_ends(number).unwrap();
    assert!(ends == [a, b] || ends == [b, a]);
}

#[test]
fn a_group_is_selected_by_any_of_its_bodies() {
    let seen = discs();
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let show = |stage: &mut Stage| {
        let mut shown = Shown::default();
        stage.show(&mut shown);
        (shown, seen.1, seen.2.clone())
    };
    let all: Vec<PointId> = Chosen::all(scope(&seen)).points;
    let group =
        |points: Vec<PointId>| Order::Give(vec![Do::Group { points, name: "group 1".to_owned() }], Some("group"));
    let of_rope = |seen: &Seen| Chosen::at(scope(seen), at(seen, 0.5, 2.5)).unwrap().points.len();
    assert_eq!(of_rope(&seen), 5);
    assert_eq!(stage.obey(group(all.clone())), None);
    assert_eq!(of_rope(&show(&mut stage)), all.len());
    assert_eq!(stage.obey(group(Vec::new())), None);
    assert_eq!(of_rope(&show(&mut stage)), 5, "no group any more");
    stage.obey(Order::Undo(None));
    assert_eq!(of_rope(&show(&mut stage)), all.len());
    stage.obey(Order::Undo(None));
    assert_eq!(of_rope(&show(&mut stage)), 5);
}

#[test]
fn each_of_a_thousand_bodies_is_outlined_when_all_are_selected() {
    let seen = opened("thousand-rims");
    let mut hand = hand();
    hand.select_all(scope(&seen));
    let marks = hand.marks(scope(&seen), None);
    let boxes: Vec<[DVec2; 2]> = marks
        .iter()
        .filter_map(|mark| if let Mark::Frame(_, low, high) = mark { Some([*low, *high]) } else { None })
        .collect();
    assert_eq!(boxes.len(), 1000);
    assert!(marks.len() < 1100, "as many shapes as bodies: {}", marks.len());
    let is_in = |at: DVec2| boxes.iter().any(|[low, high]| at.cmpge(*low).all() && at.cmple(*high).all());
    assert!((0..seen.0.point_count()).step_by(97).all(|point| is_in(pixel(&seen, point))));
}

/// Presses twice in one place, the second time soon after the first.
fn double_click(hand: &mut Hand, seen: &Seen, pixel: DVec2) {
    hand.hasten(false);
    click(hand, seen, pixel);
    hand.hasten(true);
    click(hand, seen, pixel);
}

#[test]
fn a_double_click_or_ctrl_selects_one_bond_or_one_point() {
    let seen = discs();
    let first = (seen.0.point_count() - 5) as u32;
    let points = |hand: &Hand| -> Vec<u32> {
        let chosen = hand.chosen(scope(&seen)).unwrap_or_default();
        assert!(chosen.obstacles.is_empty());
        chosen.points.iter().map(|point| point.0 - first).collect()
    };
    // The rope goes up by a quarter of a metre a bond.
    let on = |place: f64| at(&seen, 0.5, 2.0 + 0.25 * place);
    let mut hand = hand();
    double_click(&mut hand, &seen, on(1.5));
    assert_eq!(points(&hand), [1, 2], "a bond has two points");
    hand.hold([true, false]);
    double_click(&mut hand, &seen, on(2.5));
    assert_eq!(points(&hand), [1, 2, 3], "the bond beside it too");
    double_click(&mut hand, &seen, on(1.5));
    assert_eq!(points(&hand), [2, 3], "that one no more, but for what the other has of it");
    hand.hold([false, false]);
    double_click(&mut hand, &seen, on(4.0));
    assert_eq!(points(&hand), [4], "a point");
    // Two clicks apart in time or place are no double click.
    hand.hasten(false);
    click(&mut hand, &seen, on(1.5));
    assert_eq!(points(&hand).len(), 5);
    hand.hasten(true);
    click(&mut hand, &seen, on(2.5));
    assert_eq!(points(&hand).len(), 5);
    // By one press with Ctrl, which is shown before.
    hand.hasten(false);
    hand.deselect();
    let whole = hand.marks(scope(&seen), Some(on(1.5)));
    hand.hold_command(true);
    let part = hand.marks(scope(&seen), Some(on(1.5)));
    let rings = part.iter().filter(|mark| matches!(mark, Mark::Ring(..))).count();
    assert!(rings == 2 && part != whole, "{part:?}");
    click(&mut hand, &seen, on(1.5));
    assert_eq!(points(&hand), [1, 2]);
    hand.hold([true, false]);
    click(&mut hand, &seen, on(2.5));
    assert_eq!(points(&hand), [1, 2, 3]);
    click(&mut hand, &seen, on(0.0));
    assert_eq!(points(&hand), [0, 1, 2, 3]);
    click(&mut hand, &seen, on(0.0));
    assert_eq!(points(&hand), [1, 2, 3]);
    // A drag moves what was taken alone.
    hand.hold([false, false]);
    let deed = drag(&mut hand, &seen, [on(3.5), on(3.5) + DVec2::new(60.0, 0.0)]);
    let [Do::Move(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert_eq!(keys.points, [first + 3, first + 4]);
}

#[test]
fn a_body_that_is_dragged_soon_after_a_click_goes_as_a_whole() {
    let seen = discs();
    let mut hand = hand();
    let rod = at(&seen, 0.5, 2.375);
    click(&mut hand, &seen, rod);
    hand.hasten(true);
    let deed = drag(&mut hand, &seen, [rod, rod + DVec2::new(60.0, 0.0)]);
    let [Do::Move(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert_eq!(keys.points.len(), 5);
}

#[test]
fn a_click_on_a_rope_selects_the_rope_and_one_on_what_hangs_on_it_all() {
    const HANGS: &str = r#"{"wobble": 1, "gravity": [0, 0], "view": {"center": [0, 0], "height": 10},
        "bodies": [{"make": "rope", "count": 5, "to": [0, 1], "origin": [-3, 0], "material": {"kind": "rigid", "mass": 1}},
          {"make": "disc", "radius": 1, "spacing": 0.4, "origin": [2, 0], "material": {"kind": "rigid", "mass": 2}}],
        "bonds": [{"a": 4, "b": 5}]}"#;
    let seen = shown(Scene::parse(HANGS, "x.json").unwrap());
    let all = seen.0.point_count();
    let (rope, disc) = (pixel(&seen, 2), at(&seen, 2.0, 0.0));
    let mut hand = hand();
    click(&mut hand, &seen, rope);
    assert_eq!(selected(&hand, &seen).0, 5);
    click(&mut hand, &seen, rope);
    assert_eq!(selected(&hand, &seen).0, 5, "once more");
    click(&mut hand, &seen, disc);
    assert_eq!(selected(&hand, &seen).0, all);
    hand.hold([true, false]);
    click(&mut hand, &seen, rope);
    assert_eq!(selected(&hand, &seen).0, all - 5, "with Shift the rope goes");
    hand.hold([false, false]);
    click(&mut hand, &seen, at(&seen, 0.0, 4.5));
    let moved = drag(&mut hand, &seen, [rope, rope + DVec2::new(40.0, 0.0)]);
    let [Do::Move(keys)] = &moved.commands[..] else { panic!("{moved:?}") };
    assert_eq!(keys.points.len(), all, "what hangs together is dragged together");
}
