//! Rings in space turn what is selected about their axes, and their knob scales it.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::{DVec2, DVec3};

use super::space_tests::Room;
use super::{Hand, Scope};
use crate::app::action::Tool;
use crate::app::player::{Note, Order, Stage};
use crate::history::Do;
use crate::scene::Scene;
use crate::sim::PointId;

/// A box obstacle and a loose square of springs, and what is selected of them.
const THINGS: &str = r#"{"wobble": 1, "dimensions": 3, "gravity": [0, 0, 0],
    "obstacles": [{"box": {"min": [2, -0.5, -1], "max": [3, 0.5, 1]}}, {"circle": {"center": [-3, 0, 0], "radius": 0.5}},
        {"plane": {"point": [0, -2, 0], "normal": [0, 1, 0]}}],
    "bodies": [{"make": "cloth", "columns": 3, "rows": 3, "spacing": 0.5, "origin": [-0.5, 0.5, 0],
        "material": {"kind": "spring", "stiffness": 500, "mass": 1}}],
    "view": {"target": [0, 0, 0], "distance": 9, "yaw": 0.6, "pitch": 0.4}}"#;

impl Room {
    /// A pixel on the part of a ring that is in front, and one further along it.
    fn along_ring(&mut self, axis: usize) -> [DVec2; 2] {
        self.with(|hand, scope| {
            let chosen = hand.chosen(scope).unwrap();
            let rings = super::rings::Rings::of(scope, &chosen).unwrap();
            let on = |at: &DVec2| rings.ring(scope, *at) == Some(super::Ring::About(axis));
            let lines = rings.marks(scope, None).into_iter().filter_map(|mark| match mark {
                super::Mark::Line(_, a, _, width) if width > 1.0 => Some(a),
                _ => None,
            });
            let all: Vec<DVec2> = lines.filter(on).collect();
            [all[all.len() / 4], all[3 * all.len() / 4]]
        })
    }
}

#[test]
fn rings_turn_what_is_selected_about_their_axes_and_the_knob_scales_it_each_as_one_edit() {
    let body = super::Chosen { points: (0..9).map(PointId).collect(), obstacles: Vec::new() };
    let solid = super::Chosen { points: Vec::new(), obstacles: vec![0] };
    for chosen in [body, solid] {
        for axis in 0..3 {
            let mut room = Room::of(THINGS, Tool::Select);
            room.hand.select(chosen.clone());
            let before = (room.places(), room.shown.scenery.convex.clone());
            let [from, to] = room.along_ring(axis);
            let would = room.with(|hand, scope| {
                hand.press(scope, from);
                let marks = hand.marks(scope, Some(to));
                hand.cancel();
                marks
            });
            let words = |name: &str| {
                would.iter().any(|mark| matches!(mark, super::Mark::Words(_, said) if said.contains(name)))
            };
            assert!(words(["about x", "about y", "about z"][axis]), "{axis}: {would:?}");
            let deed = room.drag([from, to]);
            let [Do::Move(keys)] = &deed.commands[..] else { panic!("{axis}: {deed:?}") };
            let angle = keys.turn.unwrap();
            assert!(angle.abs() > 0.1 && deed.edit == Some("turn"), "{axis}: {angle}");
            room.give(&deed);
            let unit = [DVec3::X, DVec3::Y, DVec3::Z][axis];
            let turn = glam::DQuat::from_axis_angle(unit, angle);
            if chosen.obstacles.is_empty() {
                let middle = before.0.iter().sum::<DVec3>() / 9.0;
                for (was, is) in before.0.iter().zip(room.places()) {
                    assert!((middle + turn * (*was - middle)).distance(is) < 1e-9, "{axis}");
                }
            } else {
                let [was, is] = [&before.1, &room.shown.scenery.convex].map(|all| all[0].figure.frame().unwrap());
                for k in 0..3 {
                    assert!((turn * DVec3::from(was.axes[k])).distance(DVec3::from(is.axes[k])) < 1e-9, "{axis}");
                }
                assert_eq!(before.1[1].figure, room.shown.scenery.convex[1].figure, "no other one");
            }
            assert!(matches!(room.stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "turn"));
            room.stage.show(&mut room.shown);
            assert!(room.places() == before.0 && room.shown.scenery.convex == before.1, "undone");
        }
        let mut room = Room::of(THINGS, Tool::Select);
        room.hand.select(chosen.clone());
        let knob = room.with(|hand, scope| {
            let marks = hand.marks(scope, None);
            marks.into_iter().find_map(|mark| if let super::Mark::Square(_, at, _) = mark { Some(at) } else { None })
        });
        let knob = knob.unwrap();
        let middle = room.with(|hand, scope| {
            let rings = super::rings::Rings::of(scope, &hand.chosen(scope).unwrap());
            DVec2::from(scope.camera.screen_from_world(rings.unwrap().middle()).unwrap())
        });
        let deed = room.drag([knob, middle + 1.5 * (knob - middle)]);
        let [Do::Move(keys), ..] = &deed.commands[..] else { panic!("{deed:?}") };
        assert!(matches!(keys.scale, Some(crate::history::Factors::One(factor)) if (factor - 1.5).abs() < 1e-9));
        room.give(&deed);
        assert!(matches!(room.stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "scale"));
    }
}

#[test]
fn a_ring_that_is_seen_from_its_side_is_turned_by_pulling_along_it() {
    let text = THINGS.replace(r#""yaw": 0.6, "pitch": 0.4"#, r#""yaw": 0, "pitch": 0"#);
    let mut room = Room::of(&text, Tool::Select);
    room.hand.select(super::Chosen { points: (0..9).map(PointId).collect(), obstacles: Vec::new() });
    for axis in 0..3 {
        let [from, to] = room.along_ring(axis);
        let deed = room.drag([from, to]);
        let [Do::Move(keys)] = &deed.commands[..] else { panic!("{axis}: {deed:?}") };
        assert!(keys.turn.is_some_and(|angle| angle.is_finite() && angle.abs() > 0.1), "{axis}: {:?}", keys.turn);
    }
}

#[test]
fn an_axis_without_a_direction_and_one_in_the_plane_are_refused_and_without_one_turns_are_about_z() {
    let turn = |axis: Option<crate::scene::Vector>| {
        let keys = crate::history::MoveKeys { points: vec![0], turn: Some(0.5), axis, ..Default::default() };
        vec![Do::Move(Box::new(keys))]
    };
    let mut room = Room::of(THINGS, Tool::Select);
    let none = Some(crate::scene::Vector::Space([0.0; 3]));
    assert!(matches!(room.stage.obey(Order::Give(turn(none), None)), Some(Note::Refused(why)) if why.contains("axis")));
    assert_eq!(room.stage.obey(Order::Give(turn(None), None)), None);
    let flat = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0]]}}"#;
    let mut plane = Stage::new(Scene::parse(flat, "x.json").unwrap().into()).unwrap();
    let some = Some(crate::scene::Vector::Plane([1.0, 0.0]));
    assert!(matches!(plane.obey(Order::Give(turn(some), None)), Some(Note::Refused(why)) if why.contains("about z")));
}

#[test]
fn rings_and_their_knob_keep_off_what_lies_over_the_world() {
    let mut room = Room::of(THINGS, Tool::Select);
    room.hand.select(super::Chosen { points: (0..9).map(PointId).collect(), obstacles: Vec::new() });
    let of = |scope: Scope<'_>, hand: &mut Hand| {
        let rings = super::rings::Rings::of(scope, &hand.chosen(scope).unwrap()).unwrap();
        let marks = rings.marks(scope, None).into_iter().filter_map(|mark| match mark {
            super::Mark::Line(_, at, ..) | super::Mark::Square(_, at, _) => Some(at),
            _ => None,
        });
        marks.collect::<Vec<DVec2>>()
    };
    let open = room.with(|hand, scope| of(scope, hand));
    let [low, high] = open.iter().fold([open[0]; 2], |[low, high], at| [low.min(*at), high.max(*at)]);
    // A bar over the upper rim of the rings, and a column over the right one.
    let free = [DVec2::new(0.0, low.y + 12.0), DVec2::new(high.x - 12.0, 2000.0)];
    let kept = room.with(|hand, scope| of(Scope { free, ..scope }, hand));
    for at in kept {
        assert!(at.y > free[0].y && at.x < free[1].x, "{at} in {free:?}");
    }
}

/// A bar that is seen from above, with a loose point on either side of each of its ends.
const BAR: &str = r#"{"wobble": 1, "dimensions": 3, "gravity": [0, 0, 0],
    "obstacles": [{"box": {"min": [-1.5, -0.3, -0.2], "max": [1.5, 0.3, 0.2]}}],
    "points": {"position": [[1.2, 0, -0.5], [-1.2, 0, 0.5], [1.2, 0, 0.5], [-1.2, 0, -0.5]]},
    "view": {"target": [0, 0, 0], "distance": 9, "yaw": 0.3, "pitch": 0.9}}"#;

#[test]
fn an_obstacle_that_is_turned_by_a_ring_or_scaled_by_the_knob_pushes_while_time_runs_as_one_edit() {
    for is_turned in [true, false] {
        let mut room = Room::of(BAR, Tool::Select);
        room.hand.select(super::Chosen { points: Vec::new(), obstacles: vec![0] });
        let (before, figure) = (room.places(), room.shown.scenery.convex[0].figure);
        let [from, to] = match is_turned {
            true => room.along_ring(1),
            false => room.with(|hand, scope| {
                let rings = super::rings::Rings::of(scope, &hand.chosen(scope).unwrap()).unwrap();
                let middle = DVec2::from(scope.camera.screen_from_world(rings.middle()).unwrap());
                let mut marks = rings.marks(scope, None).into_iter();
                let knob =
                    marks.find_map(|mark| if let super::Mark::Square(_, at, _) = mark { Some(at) } else { None });
                [knob.unwrap(), middle + 3.5 * (knob.unwrap() - middle)]
            }),
        };
        let to = if is_turned { from.lerp(to, 0.9) } else { to };
        assert!(room.with(|hand, scope| hand.press(scope, from)).is_empty());
        let mut said = Vec::new();
        for k in 1..=60 {
            let at = from.lerp(to, f64::from(k) / 60.0);
            if let Some(way) = room.with(|hand, scope| hand.haul(scope, at, 1.0 / 60.0)) {
                assert_eq!(room.stage.obey(Order::Haul(way)), None);
            }
            drop(room.stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
            room.stage.show(&mut room.shown);
            said = room.with(|hand, scope| hand.marks(scope, Some(at)));
        }
        let words = if is_turned { "about y" } else { "×" };
        assert!(
            said.iter().any(|mark| matches!(mark, super::Mark::Words(_, said) if said.contains(words))),
            "{said:?}"
        );
        assert!(room.with(|hand, scope| hand.release(scope, to)).is_empty(), "it is there already");
        let places = room.places();
        let pushed = before.iter().zip(&places).filter(|(was, is)| was.distance(**is) > 0.2).count();
        // Whichever way round it is turned, each of its ends meets one of them.
        assert!(pushed >= if is_turned { 2 } else { 4 }, "turned: {is_turned}: {before:?} to {places:?}");
        let name = if is_turned { "turn" } else { "scale" };
        assert!(matches!(room.stage.obey(Order::Undo(None)), Some(Note::Undone(undone, _)) if undone == name));
        room.stage.show(&mut room.shown);
        assert!(room.shown.scenery.convex[0].figure == figure && room.places() == before, "all of it is one step");
    }
}
