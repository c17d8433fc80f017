//! Ropes that are drawn out: what their ends are tied to, and where there is no room for them.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::tests::{BLOCK, LOOSE, ROOM, added, at, close, drag, drawn, extent, hand, history, room};
use crate::app::action::Primitive;
use crate::app::player::{Note, Order, Stage};
use crate::app::tools::tests::{opened, pixel, scope, shown};
use crate::app::tools::{Hand, Mark, Role};
use crate::history::Do;
use crate::scene::{AddKeys, Scene};
use crate::sim::PointId;

#[test]
fn ropes_and_cloths_hang_where_they_begin_unless_shift_is_held() {
    let seen = room();
    for (is_held, pins) in [(false, [1, 2]), (true, [0, 0])] {
        for (primitive, pins) in [Primitive::Rope, Primitive::Cloth].into_iter().zip(pins) {
            let mut hand = hand(primitive);
            hand.hold([is_held, false]);
            let deed = drag(&seen, &mut hand, [-1.0, 1.0], [1.0, 0.0]);
            assert_eq!(added(&deed).bodies[0].pinned.len(), pins, "{primitive:?}");
            let says = deed.words.as_deref() == Some("its start is pinned");
            assert_eq!(says, primitive == Primitive::Rope && !is_held, "{:?}", deed.words);
        }
    }
}

#[test]
fn what_each_end_of_a_rope_hangs_on_is_said_as_it_was_drawn() {
    let text = r#"{"wobble": 1, "points": {"position": [[-2, 0], [2, 0]], "pinned": [1]},
        "bodies": [{"make": "disc", "radius": 0.5, "spacing": 0.2, "origin": [0, -2]}], "contact": true, "view": {"center": [0, 0], "height": 8}}"#;
    let seen = shown(Scene::parse(text, "x.json").unwrap());
    for (from, to, words) in [
        ([0.0, 2.0], [0.0, -2.0], "its start is pinned, its end is tied to the body"),
        ([0.0, -2.0], [0.0, 2.0], "its start is tied to the body"),
        ([-2.0, 0.0], [2.0, 0.0], "its start is tied to the point, its end is tied to the pin"),
    ] {
        let deed = drag(&seen, &mut hand(Primitive::Rope), from, to);
        assert_eq!(deed.words.as_deref(), Some(words), "{from:?} to {to:?}");
    }
}

#[test]
fn a_rope_is_bonded_to_the_points_that_it_begins_and_ends_on() {
    let text = r#"{"wobble": 1, "points": {"position": [[-2, 0], [2, 0]]}, "view": {"center": [0, 0], "height": 8}}"#;
    let seen = shown(Scene::parse(text, "x.json").unwrap());
    for (from, to, bonds) in [([-2.0, 0.0], [0.0, 1.0], 1), ([0.0, 1.0], [2.0, 0.0], 1), ([-2.0, 0.0], [2.0, 0.0], 2)] {
        let deed = drag(&seen, &mut hand(Primitive::Rope), from, to);
        let keys = added(&deed);
        assert_eq!(keys.bonds.len(), bonds);
        assert_eq!(keys.bodies[0].pinned.len(), usize::from(from[1] == 1.0), "on empty ground it is pinned");
        let history = history(&seen, &[deed]);
        let world = history.world();
        let longest = world.bonds().iter().map(|bond| bond.rest_length).fold(0.0, f64::max);
        let shortest = world.bonds().iter().map(|bond| bond.rest_length).fold(f64::MAX, f64::min);
        assert!(longest - shortest < 1e-9, "pieces of one length, those to the points too: {shortest} {longest}");
        let reached: Vec<PointId> =
            world.bonds().ends().iter().flatten().copied().filter(|point| point.0 < 2).collect();
        assert_eq!(reached.len(), bonds);
    }
}

#[test]
fn a_rope_between_two_points_has_slack_as_the_wheel_says() {
    let text = r#"{"wobble": 1, "points": {"position": [[-2, 0], [2, 0]], "pinned": [0, 1]}, "gravity": [0, -10],
        "view": {"center": [0, 0], "height": 8}}"#;
    let seen = shown(Scene::parse(text, "x.json").unwrap());
    for (steps, slack) in [(0, 0.02), (4, 0.1), (-9, 0.0)] {
        let mut hand = hand(Primitive::Rope);
        hand.press(scope(&seen), at(&seen, -2.0, 0.0));
        assert!(hand.turn_wheel(steps), "it is not for the view while a rope is drawn");
        let marks = hand.marks(scope(&seen), Some(at(&seen, 2.0, 0.0)));
        let said = format!("{:.0} % slack", 100.0 * slack);
        assert!(marks.iter().any(|mark| matches!(mark, Mark::Words(_, words) if words.contains(&said))), "{marks:?}");
        let deed = hand.release(scope(&seen), at(&seen, 2.0, 0.0));
        let history = history(&seen, &[deed]);
        let lengths: Vec<f64> = history.world().bonds().iter().map(|bond| bond.rest_length).collect();
        assert!((lengths.iter().sum::<f64>() - 4.0 * (1.0 + slack)).abs() < 1e-8, "{slack}");
        assert!(lengths.iter().all(|long| (long - lengths[0]).abs() < 1e-8), "{lengths:?}");
    }
    assert!(!hand(Primitive::Rope).turn_wheel(1), "nothing is drawn");
}

#[test]
fn a_rope_is_tied_to_the_skin_where_it_is_seen_and_nowhere_else() {
    let text = r#"{"wobble": 1, "bodies": [{"make": "disc", "radius": 1, "spacing": 0.3}], "contact": true,
        "view": {"center": [0, 0], "height": 8}}"#;
    let seen = shown(Scene::parse(text, "x.json").unwrap());
    let inner = drag(&seen, &mut hand(Primitive::Rope), [0.1, 0.5], [3.0, 0.0]);
    let [x, y, _] = seen.0.place(added(&inner).bonds[0].a as usize);
    assert!(x.hypot(y) > 0.99 && y > 0.8, "within the disc it is the nearest point of the skin: {x} {y}");
    for point in 0..seen.0.point_count() {
        let [x, y, _] = seen.0.place(point);
        if x.hypot(y) < 0.99 {
            continue;
        }
        let near = drag(&seen, &mut hand(Primitive::Rope), [1.01 * x, 1.01 * y], [3.0 * x, 3.0 * y]);
        assert_eq!(added(&near).bonds[0].a as usize, point, "a little beside a corner of the skin");
        let far = drag(&seen, &mut hand(Primitive::Rope), [1.3 * x, 1.3 * y], [3.0 * x, 3.0 * y]);
        assert!(added(&far).bonds.is_empty(), "27 px beside it");
    }
    let passing = text.replace("\"contact\": true,", "");
    let seen = shown(Scene::parse(&passing, "x.json").unwrap());
    let inner =
        (0..seen.0.point_count()).find(|&point| seen.0.place(point)[0].hypot(seen.0.place(point)[1]) < 0.5).unwrap();
    let [x, y, _] = seen.0.place(inner);
    let deed = drag(&seen, &mut hand(Primitive::Rope), [x, y], [3.0, 0.0]);
    assert_eq!(added(&deed).bonds[0].a as usize, inner, "where nothing is pushed out it hangs within");
}

#[test]
fn a_rope_to_what_was_seen_before_something_else_came_is_refused() {
    let seen = opened("rim");
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let mut hand = hand(Primitive::Rope);
    hand.press(scope(&seen), pixel(&seen, 3));
    let rope = hand.release(scope(&seen), pixel(&seen, 3) + DVec2::new(120.0, -80.0));
    let disc = drag(&seen, &mut self::hand(Primitive::Disc), [0.0, 0.0], [0.5, 0.0]);
    assert!(stage.obey(Order::Give(disc.commands, disc.edit)).is_none());
    let note = stage.obey(Order::Give(rope.commands, rope.edit));
    assert!(matches!(note, Some(Note::Refused(why)) if why.contains("draw it again")));
}

#[test]
fn a_rope_between_two_pins_that_cannot_go_round_an_obstacle_keeps_it_away() {
    let text = r#"{"wobble": 1, "view": {"center": [0, 0], "height": 8}, "gravity": [0, -9.81], "contact": true,
        "bodies": [{"make": "rope", "count": 9, "to": [4, 0], "origin": [-2, 2], "pinned": [0, 8],
            "material": {"kind": "rigid", "mass": 1}}]}"#;
    let seen = shown(Scene::parse(text, "x.json").unwrap());
    // Across the straight rope; below it.
    for (low, high, is_refused) in [([-0.5, 1.0], [0.5, 2.5], true), ([-0.5, 0.0], [0.5, 1.8], false)] {
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        let mut hand = hand(Primitive::SolidBox);
        hand.press(scope(&seen), at(&seen, low[0], low[1]));
        let to = at(&seen, high[0], high[1]);
        let marks = hand.marks(scope(&seen), Some(to));
        let deed = hand.release(scope(&seen), to);
        // What is drawn before is what the release does.
        let is_red = marks.iter().any(|mark| matches!(mark, Mark::Line(Role::Away, ..)));
        assert_eq!(is_red, is_refused);
        assert_eq!(drawn(&marks).1.contains("cannot go round it"), is_refused);
        let is_said = deed.words.as_ref().is_some_and(|words| words.contains("cannot go round it"));
        assert_eq!((deed.is_empty(), is_said), (is_refused, is_refused), "{deed:?}");
        // And as the world has it.
        let keys = crate::scene::ObstacleKeys {
            r#box: Some(crate::scene::BoxKeys {
                min: crate::scene::Vector::Plane(low),
                max: crate::scene::Vector::Plane(high),
                angle: None,
                rotation: None,
            }),
            ..Default::default()
        };
        let add = AddKeys { obstacles: vec![keys], ..AddKeys::default() };
        let note = stage.obey(Order::Give(vec![Do::Add(Box::new(add))], Some("Solid box")));
        let is_kept = matches!(&note, Some(Note::Refused(why)) if why.contains("cannot go round"));
        assert_eq!(is_kept, is_refused, "{note:?}");
    }
}

#[test]
fn the_end_of_a_rope_that_is_dragged_onto_a_body_is_tied_to_it() {
    let text = LOOSE.replace("[1, 0]", "[-1.8, 0.2]");
    let seen = shown(Scene::parse(&text, "x.json").unwrap());
    // On the box, beside the end, which hangs left of it.
    let to = at(&seen, -1.7, 0.9);
    for (is_free, pressed, ties) in [(false, 8, true), (true, 8, false), (false, 3, false)] {
        let mut hand = Hand::default();
        hand.hold([is_free, false]);
        let from = at(&seen, -2.0, 3.0 - 0.25 * f64::from(pressed)) - DVec2::new(3.0, 0.0);
        hand.press(scope(&seen), from);
        assert!(hand.is_grabbing());
        let said = drawn(&hand.marks(scope(&seen), Some(to))).1;
        assert_eq!(said.contains("let go: it is tied here"), ties, "{said}");
        let deed = hand.release(scope(&seen), to);
        assert_eq!((deed.commands.len(), deed.edit), if ties { (2, Some("tie a rope")) } else { (1, Some("drag")) });
        if ties {
            let mut stage = Stage::new(seen.2.clone().into()).unwrap();
            let there = crate::sim::Cursor::at([-1.7, 0.9]);
            let grab = Do::Grab(crate::sim::Reach::Points(vec![PointId(8)]));
            let grabs = vec![Do::Cursor { to: Some(there), by: None }, grab];
            assert_eq!(stage.obey(Order::Give(grabs, None)), None);
            let before = stage.history().world().bonds().len();
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
            let world = stage.history().world();
            assert_eq!((world.bonds().len(), world.grab().is_some()), (before + 1, false));
            let tie = world.bonds().iter().next_back().unwrap();
            assert!(tie.a == PointId(8) && tie.b.index() >= 9, "{tie:?}");
            assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "tie a rope"));
            assert_eq!(stage.history().world().bonds().len(), before);
        }
    }
}

#[test]
fn a_rope_does_not_begin_or_end_beyond_the_walls() {
    let seen = shown(Scene::parse(&ROOM.replace("\"height\": 8", "\"height\": 14"), "x.json").unwrap());
    for is_free in [false, true] {
        let mut hand = hand(Primitive::Rope);
        hand.hold([is_free, false]);
        for [from, to] in [[[-7.0, 2.0], [0.0, 5.5]], [[-7.0, 2.0]; 2], [[7.0, 2.0]; 2]] {
            let deed = drag(&seen, &mut hand, from, to);
            let world = history(&seen, &[deed]);
            let [low, high] = extent(world.world(), 0);
            let is_within = low.cmpge(DVec2::new(-6.001, -4.001)).all() && high.cmple(DVec2::new(6.001, 4.001)).all();
            assert!(is_within, "also by a click: {low} {high}");
        }
        let deed = drag(&seen, &mut hand, [2.0, -5.0], [2.0, -5.0]);
        assert!(deed.is_empty() && deed.words.is_some_and(|words| words.contains("beyond the walls")));
    }
}

#[test]
fn a_rope_that_ends_on_an_obstacle_or_a_wall_is_pinned_there_and_hangs_between() {
    let seen = shown(Scene::parse(BLOCK, "x.json").unwrap());
    for (to, surface) in [([0.2, 0.0], [0.0, 0.0]), ([-0.05, 0.5], [0.0, 0.5]), ([-1.0, 3.98], [-1.0, 4.0])] {
        let deed = drag(&seen, &mut hand(Primitive::Rope), [-3.0, 0.0], to);
        let body = &added(&deed).bodies[0];
        assert_eq!((body.pinned.len(), body.slack.is_some()), (2, true), "{to:?}");
        let (origin, way) = (body.origin.unwrap().embed(), body.to.unwrap().embed());
        assert!(close(DVec2::new(origin[0] + way[0], origin[1] + way[1]), surface, 0.02), "{origin:?} {way:?}");
        let history = history(&seen, &[deed]);
        assert!(history.world().warnings().is_empty(), "{:?}", history.world().warnings());
    }
    assert_eq!(added(&drag(&seen, &mut hand(Primitive::Rope), [-3.0, 0.0], [-1.0, 0.0])).bodies[0].pinned.len(), 1);
}

#[test]
fn a_rope_that_is_drawn_along_the_ground_lies_there_and_one_along_the_ceiling_hangs() {
    let seen = shown(Scene::parse(&BLOCK.replace("\"gravity\": [0, 0]", "\"gravity\": [0, -9.81]"), "x.json").unwrap());
    for (y, pins) in [(-3.97, 0), (3.97, 2)] {
        let deed = drag(&seen, &mut hand(Primitive::Rope), [-3.0, y], [2.0, y]);
        assert_eq!(added(&deed).bodies[0].pinned.len(), pins, "{y} m");
        let history = history(&seen, &[deed]);
        assert!(history.world().warnings().is_empty(), "{:?}", history.world().warnings());
    }
}
