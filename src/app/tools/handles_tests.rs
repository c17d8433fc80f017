//! What is selected is moved, turned and scaled: by its handles, clear of what stands there.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::handles::{Frame, Handle};
use super::select_tests::{Seen, at, click, discs, drag, hand, handle};
use super::tests::{opened, pixel, scope, shown};
use super::{Chosen, Hand, Mark};
use crate::app::action::Tool;
use crate::app::player::{Order, Shown, Stage};
use crate::history::{Do, Factors};
use crate::scene::Scene;
use crate::sim::PointId;

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
fn in_space_a_body_is_moved_in_the_plane_of_the_screen() {
    let seen = opened("cloth-ball");
    let mut hand = hand();
    hand.press(scope(&seen), pixel(&seen, 5));
    let deed = hand.release(scope(&seen), pixel(&seen, 5) + 50.0);
    assert!(matches!(deed.commands[..], [Do::Move(_)]) && deed.edit == Some("move"), "{deed:?}");
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
