//! What is selected: by clicks, boxes and strokes; moved, turned, scaled, copied, taken away.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::handles::{Frame, Handle};
use super::tests::{opened, pixel, scope, shown};
use super::{Chosen, Deed, Hand, Mark};
use crate::app::action::Tool;
use crate::app::clip::Clip;
use crate::app::player::Coming;
use crate::app::player::Probe;
use crate::app::player::{Order, Shown, Stage};
use crate::history::{Do, Factors};
use crate::render::Camera;
use crate::scene::Scene;
use crate::sim::{Limit, Obstacle, PointId};

const DISCS: &str = r#"{"wobble": 1, "gravity": [0, 0], "contact": true, "view": {"center": [0, 0], "height": 10},
    "obstacles": [{"box": {"min": [3, -1], "max": [5, 1]}}, {"plane": {"point": [0, -4.5], "normal": [0, 1]}}],
    "bodies": [{"make": "disc", "radius": 1, "spacing": 0.4, "origin": [-2, 0], "velocity": [0, 1],
        "material": {"kind": "spring", "stiffness": 300, "damping": 1, "mass": 2}},
      {"make": "rope", "count": 5, "to": [0, 1], "origin": [0.5, 2], "material": {"kind": "rigid", "mass": 1}}]}"#;

type Seen = (Shown, Camera, Scene);

fn hand() -> Hand {
    let mut hand = Hand::default();
    hand.take(Tool::Select);
    hand
}

fn discs() -> Seen {
    shown(Scene::parse(DISCS, "x.json").unwrap())
}

fn at(seen: &Seen, x: f64, y: f64) -> DVec2 {
    DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap())
}

/// Drags from one pixel to another; returns what comes of it.
fn drag(hand: &mut Hand, seen: &Seen, [from, to]: [DVec2; 2]) -> Deed {
    assert!(hand.press(scope(seen), from).is_empty());
    hand.trace(scope(seen), to);
    hand.release(scope(seen), to)
}

fn click(hand: &mut Hand, seen: &Seen, pixel: DVec2) {
    assert_eq!(drag(hand, seen, [pixel; 2]), Deed::default(), "a click changes nothing");
}

/// How many points and which obstacles are selected.
fn selected(hand: &Hand, seen: &Seen) -> (usize, Vec<u32>) {
    let chosen = hand.chosen(scope(seen)).unwrap_or_default();
    (chosen.points.len(), chosen.obstacles)
}

fn handle(hand: &Hand, seen: &Seen, handle: Handle) -> DVec2 {
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
fn a_knob_turns_and_corners_scale_about_what_stays() {
    let seen = discs();
    let mut hand = hand();
    click(&mut hand, &seen, at(&seen, -2.0, 0.0));
    let knob = handle(&hand, &seen, Handle::Turn);
    // A quarter turn, from above to the left, a little off.
    let (to, middle) = (at(&seen, -4.0, 0.1), at(&seen, -2.0, 0.0));
    let deed = drag(&mut hand, &seen, [knob, to]);
    let [Do::Move(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    let expected = 0.5 * PI - (0.1_f64 / 2.0).atan();
    assert!((keys.turn.unwrap() - expected).abs() < 0.02 && deed.edit == Some("turn"), "{keys:?}");
    hand.hold([true, false]);
    let deed = drag(&mut hand, &seen, [knob, to]);
    let [Do::Move(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    assert_eq!(keys.turn, Some(PI / 12.0 * 6.0), "in steps of 15 degrees");
    // Twice as wide and half as high, about the lower left: pulled from the upper right.
    hand.hold([false, false]);
    let corner = handle(&hand, &seen, Handle::Corner(2));
    let frame = Frame::of(scope(&seen), &hand.chosen(scope(&seen)).unwrap()).unwrap();
    let still = handle(&hand, &seen, Handle::Corner(0)) + DVec2::new(9.0, -9.0);
    let to = still + (corner - still) * DVec2::new(2.0, 0.5);
    hand.press(scope(&seen), corner);
    let wide = |hand: &Hand| {
        let marks = hand.marks(scope(&seen), Some(to));
        let x = |mark: &Mark| if let Mark::Line(_, from, ..) = mark { Some(from.x) } else { None };
        let ends = marks.iter().filter_map(x).fold([f64::MAX, f64::MIN], |[a, b], x| [a.min(x), b.max(x)]);
        (ends[1] - ends[0]) / seen.1.pixels_per_metre()
    };
    assert!((wide(&hand) - 4.0).abs() < 0.6, "it is shown as wide as it will be: {}", wide(&hand));
    let deed = hand.release(scope(&seen), to);
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
    // A file says the same.
    let mut text = Vec::new();
    stage.history().recording().write_json(&mut text).unwrap();
    let log = crate::history::Log::of_text(&String::from_utf8(text).unwrap(), "x.json").unwrap();
    let given: Vec<Do> = log.commands().unwrap().into_iter().map(|entry| entry.act).collect();
    assert!(matches!(&given[..], [Do::Move(keys), ..] if matches!(keys.scale, Some(Factors::Each(_)))), "{given:?}");
    let mut after = Shown::default();
    stage.show(&mut after);
    let after = (after, seen.1, seen.2.clone());
    let scaled = Frame::of(scope(&after), &hand.chosen(scope(&after)).unwrap()).unwrap();
    let sides = |frame: &Frame| {
        let [low, _, high, _] = [0, 1, 2, 3].map(|k| frame.handles(scope(&seen))[k + 1].1);
        [high.x - low.x - 18.0, low.y - high.y - 18.0]
    };
    let ratio = [0, 1].map(|axis| sides(&scaled)[axis] / sides(&frame)[axis]);
    assert!((ratio[0] - 2.0).abs() < 1e-6 && (ratio[1] - 0.5).abs() < 1e-6, "{ratio:?} of {middle}");
    // A rope that stands upright has no width to scale: it grows in proportion.
    click(&mut hand, &seen, at(&seen, 0.5, 2.5));
    let corner = handle(&hand, &seen, Handle::Corner(2));
    let deed = drag(&mut hand, &seen, [corner, corner + DVec2::new(300.0, 0.0)]);
    assert!(matches!(&deed.commands[..], [Do::Move(keys), ..] if matches!(keys.scale, Some(Factors::One(_)))));
    // A plane turns, about its place in the middle of the picture, and has no corners.
    click(&mut hand, &seen, at(&seen, -4.0, -4.5));
    let frame = Frame::of(scope(&seen), &hand.chosen(scope(&seen)).unwrap()).unwrap();
    assert_eq!(frame.handles(scope(&seen)).len(), 1);
    let knob = handle(&hand, &seen, Handle::Turn);
    let deed = drag(&mut hand, &seen, [knob, knob + DVec2::new(30.0, 0.0)]);
    assert!(matches!(&deed.commands[..], [Do::Move(keys)] if keys.obstacles == [1] && keys.turn.unwrap() < -0.5));
}

/// A soft box that lies on a floor.
const LYING: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": true, "view": {"center": [0, 1], "height": 6},
    "obstacles": [{"plane": {"point": [0, 0], "normal": [0, 1]}}],
    "bodies": [{"make": "lattice", "columns": 5, "rows": 3, "spacing": 0.5, "origin": [-1, 0],
        "material": {"kind": "spring", "stiffness": 900, "damping": 5, "mass": 2}}]}"#;

#[test]
fn what_lies_on_a_floor_keeps_clear_of_it_as_it_is_turned_scaled_or_moved_and_is_seen_so_before() {
    let seen = shown(Scene::parse(LYING, "x.json").unwrap());
    let (floor, body) = (at(&seen, 0.0, 0.0).y, at(&seen, 0.0, 0.5));
    for way in 0..3 {
        let mut hand = hand();
        click(&mut hand, &seen, body);
        let from = match way {
            0 => handle(&hand, &seen, Handle::Turn),
            1 => handle(&hand, &seen, Handle::Corner(0)),
            _ => body,
        };
        let to = from + if way == 0 { DVec2::new(80.0, 60.0) } else { DVec2::new(0.0, 90.0) };
        assert!(hand.press(scope(&seen), from).is_empty());
        let marks = hand.marks(scope(&seen), Some(to));
        let says = |mark: &Mark| matches!(mark, Mark::Words(_, words) if words.contains("moved aside"));
        assert!(marks.iter().any(says), "{way}: {marks:?}");
        let y = |mark: &Mark| if let Mark::Line(_, from, ..) = mark { Some(from.y) } else { None };
        let lowest = marks.iter().filter_map(y).fold(f64::MIN, f64::max);
        // The box around it keeps nine pixels off it, turns with it and grows with it.
        assert!((-1.0..20.0).contains(&(lowest - floor)), "{way}: {lowest} px, the floor is at {floor} px");
        let deed = hand.release(scope(&seen), to);
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None, "{way}");
        let world = stage.history().world();
        let all =
            |axis: usize| (0..15).map(move |k| 2 * k + axis).map(|k| world.positions().get(k)).collect::<Vec<_>>();
        let low = all(1).into_iter().fold(f64::MAX, f64::min);
        assert!((0.0..1e-3).contains(&low), "{way}: it stands on the floor: {low}");
        let middle = all(0).into_iter().sum::<f64>() / 15.0;
        assert!(middle.abs() < 1e-9, "{way}: nothing moves it aside: {middle}");
    }
}

/// Two soft discs beside each other over a floor, and a box.
const PAIR: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": MEETS, "view": {"center": [0, 1], "height": 8},
    "obstacles": [{"plane": {"point": [0, 0], "normal": [0, 1]}}, {"box": {"min": [-4.5, 2.2], "max": [-3.5, 3]}}],
    "bodies": [{"make": "disc", "radius": 0.8, "spacing": 0.3, "origin": [-2, 0.9],
        "material": {"kind": "spring", "stiffness": 900, "damping": 5, "mass": 2}},
      {"make": "disc", "radius": 0.8, "spacing": 0.3, "origin": [1, 0.9],
        "material": {"kind": "spring", "stiffness": 900, "damping": 5, "mass": 2}}]}"#;

/// The middles of the outlines of both discs of a world, and how far apart their nearest points are `[m]`.
fn apart(seen: &Seen, commands: Vec<Do>) -> f64 {
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    assert_eq!(stage.obey(Order::Give(commands, Some("move"))), None);
    let x = stage.history().world().positions();
    let count = stage.history().world().point_count();
    let at = |k: usize| DVec2::new(x.get(2 * k), x.get(2 * k + 1));
    let middle = |range: std::ops::Range<usize>| range.clone().map(at).sum::<DVec2>() / range.len() as f64;
    middle(0..count / 2).distance(middle(count / 2..count))
}

#[test]
fn what_is_moved_keeps_clear_of_other_bodies_by_the_hand_too_while_time_stands_still() {
    for (tool, meets) in [(Tool::Hand, true), (Tool::Select, true), (Tool::Hand, false)] {
        let seen = shown(Scene::parse(&PAIR.replace("MEETS", &meets.to_string()), "x.json").unwrap());
        let [from, to] = [[-2.0, 0.9], [0.7, 1.2]].map(|[x, y]| at(&seen, x, y));
        let mut hand = Hand::default();
        hand.take(tool);
        hand.stand_still(true);
        assert!(hand.press(scope(&seen), from).is_empty());
        hand.trace(scope(&seen), to);
        let marks = hand.marks(scope(&seen), Some(to));
        let says = |mark: &Mark| matches!(mark, Mark::Words(_, words) if words.contains("moved aside"));
        assert_eq!(marks.iter().any(says), meets, "{tool:?}: {marks:?}");
        let deed = hand.release(scope(&seen), to);
        let [Do::Move(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
        let by = DVec3::from(keys.by.unwrap().embed()).truncate();
        // The outline was where it comes.
        let role = if tool == Tool::Hand { super::Role::Lead } else { super::Role::Hold };
        let line = |mark: &Mark| match mark {
            Mark::Line(of, from, ..) if *of == role => Some(*from),
            _ => None,
        };
        let outline: Vec<DVec2> = marks.iter().filter_map(line).collect();
        let middle = outline.iter().sum::<DVec2>() / outline.len() as f64;
        let lies = at(&seen, -2.0 + by.x, 0.9 + by.y);
        assert!(middle.distance(lies) < 12.0, "{tool:?}: seen at {middle}, it comes to {lies}");
        let apart = apart(&seen, deed.commands.clone());
        assert_eq!(apart > 1.45, meets, "{tool:?}: {apart} m from middle to middle");
        assert!(apart < 1.8, "no further than it takes: {apart} m");
    }
}

#[test]
fn a_body_of_very_many_points_keeps_clear_too_and_is_not_laid_around_another() {
    let text = PAIR
        .replace("MEETS", "true")
        .replacen("0.3", "0.02", 1)
        .replace(r#""radius": 0.8, "spacing": 0.3"#, r#""radius": 0.3, "spacing": 0.1"#);
    let seen = shown(Scene::parse(&text, "x.json").unwrap());
    let large = Chosen::at(scope(&seen), at(&seen, -2.0, 0.9)).unwrap();
    assert!(large.points.len() > 4_000, "{}", large.points.len());
    for (to, words) in [([0.2, 1.1], "moved aside"), ([1.05, 0.95], "overlaps")] {
        let mut hand = hand();
        hand.select(large.clone());
        let deed = drag(&mut hand, &seen, [at(&seen, -2.0, 0.9), at(&seen, to[0], to[1])]);
        assert!(deed.words.as_ref().is_some_and(|said| said.contains(words)), "{to:?}: {:?}", deed.words);
    }
}

#[test]
fn bodies_and_obstacles_that_are_moved_together_keep_clear_and_where_there_is_no_room_it_is_said() {
    let seen = shown(Scene::parse(&PAIR.replace("MEETS", "true"), "x.json").unwrap());
    let mut hand = hand();
    let disc = Chosen::at(scope(&seen), at(&seen, -2.0, 0.9)).unwrap();
    hand.select(Chosen { obstacles: vec![1], ..disc });
    let [from, to] = [[-2.0, 0.9], [-2.0, 0.3]].map(|[x, y]| at(&seen, x, y));
    let deed = drag(&mut hand, &seen, [from, to]);
    assert_eq!(deed.words.as_deref(), Some("moved aside: something was in the way"));
    let [Do::Move(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    let by = keys.by.unwrap().embed();
    assert!(by[1] > -0.2 && by[1] < 0.0 && keys.obstacles == [1], "both stay over the floor: {by:?}");
    // A gap between two floors that is lower than it is.
    let narrow = r#"{"wobble": 1, "contact": true, "view": {"center": [0, 1], "height": 8},
        "obstacles": [{"plane": {"point": [3, 0], "normal": [1, 0]}}, {"plane": {"point": [4, 0], "normal": [-1, 0]}}],
        "points": {"position": [[3.2, 0], [3.8, 0.1], [3.5, 0.6]]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 0}]}"#;
    let seen = shown(Scene::parse(narrow, "x.json").unwrap());
    let mut hand = self::hand();
    let all = Chosen { points: (0..3).map(PointId).collect(), ..Chosen::default() };
    hand.select(all);
    let corner = handle(&hand, &seen, Handle::Corner(2));
    assert!(hand.press(scope(&seen), corner).is_empty());
    let marks = hand.marks(scope(&seen), Some(corner + DVec2::new(400.0, -200.0)));
    let says = |mark: &Mark| matches!(mark, Mark::Words(_, words) if words.contains("no room here"));
    assert!(marks.iter().any(says), "{marks:?}");
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
fn in_space_a_body_is_moved_in_the_plane_of_the_screen() {
    let seen = opened("cloth-ball");
    let mut hand = hand();
    hand.press(scope(&seen), pixel(&seen, 5));
    let deed = hand.release(scope(&seen), pixel(&seen, 5) + 50.0);
    assert!(matches!(deed.commands[..], [Do::Move(_)]) && deed.edit == Some("move"), "{deed:?}");
}

#[test]
fn a_copy_moves_as_the_body_does() {
    let seen = discs();
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let mut hand = hand();
    click(&mut hand, &seen, pixel(&seen, 0));
    let chosen = hand.chosen(scope(&seen)).unwrap();
    let by = chosen.beside(scope(&seen));
    let count = chosen.points.len();
    assert!((2.0..3.0).contains(&by[0]), "beside it: {by:?}");
    let all = seen.0.point_count();
    stage.obey(Order::Add(Box::new(move |history| {
        Ok(Coming::of(Clip::of(history, &chosen).placed(history.world(), by)))
    })));
    (0..60).for_each(|_| _ = stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
    // The copy is what is selected when it is there, and nothing until then.
    hand.select(Chosen { points: vec![PointId(all as u32)], obstacles: Vec::new() });
    assert!(hand.chosen(scope(&seen)).is_none());
    let world = stage.history().world();
    assert_eq!(world.point_count(), all + count);
    let x = world.positions();
    for k in 0..count {
        let [dx, dy] = [0, 1].map(|axis| x.get(2 * (all + k) + axis) - x.get(2 * k + axis));
        assert!((dx - by[0]).abs() < 1e-6 && dy.abs() < 1e-6, "{dx} {dy}");
    }
}

const FULL: &str = r##"{"wobble": 1, "gravity": [0, -9.81], "contact": true,
    "points": {"position": [[0, 0], [1, 0], [2, 0.2], [2.5, 1]], "mass": [1, 2, 3, 4], "pinned": [3]},
    "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 90, "damping": 2, "break_strain": 0.5,
        "drive": {"amplitude": 0.2, "period": 1}}, {"a": 1, "b": 2}, {"a": 2, "b": 3, "limit": "max"}],
    "angles": [{"points": [0, 1, 2], "rest": 3, "stiffness": 5, "min": 2, "max": 4},
        {"points": [1, 2, 3], "drive": {"speed": 2, "torque": 3}}],
    "triangles": [[0, 1, 2]], "forces": [{"points": [0, 2], "force": [1, 2], "torque": 0.5}],
    "skins": [{"points": [0, 1], "friction": 0.9, "color": "#ff8800"}],
    "obstacles": [{"circle": {"center": [0, -3], "radius": 1}, "friction": 0.3},
        {"plane": {"point": [0, -5], "normal": [1, 4]}, "restitution": 0.6},
        {"polygon": [[[4, 0], [5, 0], [5, 1]]]}]}"##;

#[test]
fn a_copy_has_all_that_was_copied() {
    let seen = shown(Scene::parse(FULL, "x.json").unwrap());
    let chosen = Chosen::all(scope(&seen));
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    stage.obey(Order::Add(Box::new(move |history| {
        Ok(Coming::of(Clip::of(history, &chosen).placed(history.world(), [10.0, 0.0, 0.0])))
    })));
    let world = stage.history().world();
    assert_eq!((world.point_count(), world.pinned()), (8, &[PointId(3), PointId(7)][..]));
    assert_eq!(world.masses()[4..], [1.0, 2.0, 3.0, 4.0]);
    let bonds: Vec<_> = world.bonds().iter().collect();
    for k in 0..3 {
        let [own, copy] = [bonds[k], bonds[k + 3]];
        assert_eq!((copy.a.0, copy.b.0), (own.a.0 + 4, own.b.0 + 4));
        assert_eq!(
            (copy.kind, copy.limit, copy.break_strain, copy.drive, copy.rest_length),
            (own.kind, own.limit, own.break_strain, own.drive, own.rest_length)
        );
    }
    assert!(bonds[5].limit == Limit::Max && bonds[3].drive.is_some());
    let angles = world.angles();
    for k in 0..2 {
        let [own, copy] = [&angles[k], &angles[k + 2]];
        assert_eq!(copy.points, own.points.map(|point| PointId(point.0 + 4)));
        assert_eq!(
            (copy.rest, copy.stiffness, copy.range, copy.drive),
            (own.rest, own.stiffness, own.range, own.drive)
        );
    }
    let forces = world.forces();
    assert_eq!((forces.len(), forces[1].force, forces[1].torque), (2, [1.0, 2.0, 0.0], 0.5));
    assert_eq!(forces[1].points, [PointId(4), PointId(6)]);
    assert_eq!(world.triangles()[1], [4, 5, 6].map(PointId));
    assert_eq!(world.skin_of(PointId(5)).friction, Some(0.9));
    assert_eq!(stage.history().tints().iter().filter(|tint| tint.color == Some([255, 136, 0])).count(), 2);
    let obstacles = world.obstacles();
    assert_eq!(obstacles.len(), 6);
    let planes: Vec<_> = obstacles.iter().filter(|(_, one)| matches!(one, Obstacle::Plane { .. })).collect();
    let Obstacle::Plane { point, normal, restitution, .. } = planes[1].1 else { panic!() };
    assert_eq!((point, restitution), ([10.0, -5.0, 0.0], 0.6));
    assert!((normal[1] / normal[0] - 4.0).abs() < 1e-12);
    let polygons = world.polygons();
    assert_eq!((polygons.len(), polygons[2].friction), (4, 0.3));
    let [own, copy] = [&polygons[0].loops[0], &polygons[2].loops[0]];
    assert!(own.iter().zip(copy).all(|(x, y)| (y[0] - x[0] - 10.0).abs() < 1e-12 && x[1] == y[1]));
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
fn a_copy_in_another_scene_keeps_the_friction_of_the_one_that_it_is_of() {
    let rough = DISCS.replace("\"contact\": true", r#""contact": {"friction": 0.9, "restitution": 0.4}"#);
    let seen = shown(Scene::parse(&rough, "x.json").unwrap());
    let chosen = Chosen::at(scope(&seen), at(&seen, -2.0, 0.0)).unwrap();
    let stage = Stage::new(seen.2.clone().into()).unwrap();
    let clip = Clip::of(stage.history(), &chosen);
    let own = clip.placed(stage.history().world(), [0.0; 3]);
    let is_said = own.skins.iter().any(|skin| skin.friction.is_some() || skin.restitution.is_some());
    assert!(!is_said, "at home it is as the scene says");
    for contact in ["true", "false", r#"{"friction": 0.9}"#] {
        let text = DISCS.replace("\"contact\": true", &format!("\"contact\": {contact}"));
        let mut other = Stage::new(Scene::parse(&text, "x.json").unwrap().into()).unwrap();
        let first = other.history().world().point_count() as u32;
        let keys = clip.placed(other.history().world(), [0.0, 2.0, 0.0]);
        assert_eq!(other.obey(Order::Give(vec![Do::Add(Box::new(keys))], Some("add"))), None);
        let world = other.history().world();
        let met = world.contact().unwrap();
        for point in (first..world.point_count() as u32).map(PointId) {
            let skin = world.skin_of(point);
            let [friction, restitution] =
                [skin.friction.unwrap_or(met.friction), skin.restitution.unwrap_or(met.restitution)];
            assert_eq!((friction, restitution), (0.9, 0.4), "{contact}");
            assert_eq!(skin.friction.is_none(), met.friction == 0.9, "what is the same is not said");
        }
    }
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

#[test]
fn handles_keep_off_what_lies_over_the_world_and_do_there_what_they_do() {
    let seen = discs();
    let mut hand = hand();
    click(&mut hand, &seen, at(&seen, -2.0, 0.0));
    // A bar over the upper half of the disc, and a column over its left one.
    let free = [at(&seen, -2.4, 0.3), at(&seen, 5.0, -5.0)];
    let scope = super::Scope { free, ..scope(&seen) };
    let frame = Frame::of(scope, &hand.chosen(scope).unwrap()).unwrap();
    let handles = frame.handles(scope);
    assert_eq!(handles.len(), 5);
    for (handle, place) in &handles {
        assert!(place.cmpge(free[0]).all() && place.cmple(free[1]).all(), "{handle:?} at {place}");
        assert_eq!(frame.handle(scope, *place), Some(*handle), "each can be taken");
    }
    let is_seen = |at: &DVec2| at.cmpge(free[0]).all() && at.cmple(free[1]).all();
    for mark in frame.marks(scope, None) {
        let Mark::Line(_, from, to, _) = mark else { continue };
        assert!(is_seen(&from) && is_seen(&to), "the box goes with its handles: {from} to {to}");
    }
    let corner = handles.iter().find(|(handle, _)| *handle == Handle::Corner(2)).unwrap().1;
    let still = at(&seen, -3.0, -1.0);
    assert!(hand.press(scope, corner).is_empty());
    let deed = hand.release(scope, still + 1.5 * (corner - still));
    let [Do::Move(keys), ..] = &deed.commands[..] else { panic!("{deed:?}") };
    let factors = match keys.scale {
        Some(Factors::Each(factors)) => factors,
        Some(Factors::One(factor)) => [factor; 2],
        None => panic!("{keys:?}"),
    };
    assert!(factors.iter().all(|factor| (factor - 1.5).abs() < 1e-6), "{factors:?}");
    let out_of_view = super::Scope { free: [at(&seen, 3.0, 4.0), at(&seen, 5.0, 3.0)], ..scope };
    let far = frame.handles(out_of_view);
    assert!(far.iter().all(|(_, place)| place.x < out_of_view.free[0].x), "a box out of view stays there: {far:?}");
}

#[test]
fn the_box_goes_around_what_lies_at_the_edge_of_what_is_free() {
    let seen = discs();
    let mut hand = hand();
    click(&mut hand, &seen, at(&seen, -2.0, 0.0));
    // Its lowest point lies right there, as on a floor.
    let free = [at(&seen, -5.0, 5.0), at(&seen, 5.0, -1.0)];
    let scope = super::Scope { free, ..scope(&seen) };
    let frame = Frame::of(scope, &hand.chosen(scope).unwrap()).unwrap();
    let ends = frame.marks(scope, None).into_iter().filter_map(|mark| match mark {
        Mark::Line(_, from, to, _) => Some(from.y.max(to.y)),
        _ => None,
    });
    let lowest = ends.fold(f64::NEG_INFINITY, f64::max);
    assert!(lowest > free[1].y + 4.0, "below the disc, which ends at {}: {lowest}", free[1].y);
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
