//! What is seen of a primitive while it is drawn out: its outline, its size, and what it will push.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::tests::{BLOCK, added, at, drawn, extent, hand, history, room};
use crate::app::action::{Primitive, Tool};
use crate::app::tools::tests::{scope, shown};
use crate::app::tools::{Hand, Mark, Role};
use crate::scene::Scene;

#[test]
fn the_outline_is_what_the_release_makes() {
    let seen = room();
    let mut hand = hand(Primitive::Box);
    let size = |marks: &[Mark]| {
        marks.iter().find_map(|mark| match mark {
            Mark::Words(_, words) => Some(words.clone()),
            _ => None,
        })
    };
    assert_eq!(size(&hand.marks(scope(&seen), Some(at(&seen, 0.0, 0.0)))).as_deref(), Some("1.00 × 1.00 m, 36 points"));
    hand.press(scope(&seen), at(&seen, -1.0, 0.5));
    let marks = hand.marks(scope(&seen), Some(at(&seen, 0.37, -0.5)));
    let deed = hand.release(scope(&seen), at(&seen, 0.37, -0.5));
    let [low, high] = extent(history(&seen, std::slice::from_ref(&deed)).world(), 0);
    let points = added(&deed).point_count(&seen.2);
    assert_eq!(size(&marks), Some(format!("{:.2} × {:.2} m, {points} points", (high - low).x, (high - low).y)));
    let ends = marks.iter().filter_map(|mark| if let Mark::Line(_, from, _, _) = mark { Some(*from) } else { None });
    let drawn = ends.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)]);
    let corners = [at(&seen, low.x, high.y), at(&seen, high.x, low.y)];
    assert!(drawn[0].distance(corners[0]) < 1e-6 && drawn[1].distance(corners[1]) < 1e-6, "{drawn:?} {corners:?}");
}

#[test]
fn the_size_of_what_is_drawn_stands_beside_the_cursor_within_the_view_at_its_edges_too() {
    let seen = room();
    let [wide, high] = seen.1.viewport().map(f64::from);
    for primitive in [Primitive::Box, Primitive::Disc, Primitive::SolidBox, Primitive::Cloth] {
        for to in
            [[0.99, 0.5], [0.01, 0.5], [0.5, 0.02], [0.5, 0.98], [0.99, 0.02], [0.01, 0.98], [0.99, 0.98], [0.01, 0.02]]
        {
            let mut hand = hand(primitive);
            let to = DVec2::from(to) * DVec2::new(wide, high);
            hand.press(scope(&seen), at(&seen, 0.0, 0.0));
            let marks = hand.marks(scope(&seen), Some(to));
            let words = marks.iter().find_map(|mark| match mark {
                Mark::Words(corner, words) => Some((*corner, words.chars().count() as f64)),
                _ => None,
            });
            let (corner, letters) = words.unwrap();
            let [low, high_] = [corner - DVec2::new(0.0, 22.0), corner + DVec2::new(7.5 * letters, 0.0)];
            let far = to.distance(to.clamp(low, high_));
            assert!(far < 60.0, "{primitive:?} to {to}: {low} to {high_}");
            let is_seen = low.cmpge(DVec2::ZERO).all() && high_.cmple(DVec2::new(wide, high)).all();
            assert!(is_seen, "{primitive:?} to {to}: {low} to {high_}");
        }
    }
}

#[test]
fn the_size_of_what_is_drawn_lies_across_no_line_of_it() {
    let seen = room();
    for primitive in Primitive::ALL.into_iter().filter(|primitive| !primitive.is_drawn()) {
        for to in [[1.4, 0.9], [-1.4, 0.9], [-1.4, -0.9], [1.4, -0.9], [0.3, -0.2], [0.0, 0.0]] {
            let mut hand = hand(primitive);
            hand.press(scope(&seen), at(&seen, 0.0, 0.0));
            let marks = hand.marks(scope(&seen), Some(at(&seen, to[0], to[1])));
            let words = marks.iter().find_map(|mark| match mark {
                Mark::Words(corner, words) => Some((*corner, words.chars().count() as f64)),
                _ => None,
            });
            let (corner, letters) = words.unwrap();
            let [low, high] = [corner - DVec2::new(0.0, 17.0), corner + DVec2::new(6.5 * letters, 0.0)];
            let share = |k: i32| f64::from(k) / 400.0;
            let places = marks.iter().flat_map(|mark| -> Vec<DVec2> {
                match *mark {
                    Mark::Line(_, from, to, _) => (0..=400).map(|k| from.lerp(to, share(k))).collect(),
                    Mark::Ring(_, middle, radius) => {
                        let turn = |k: i32| DVec2::from_angle(std::f64::consts::TAU * share(k));
                        (0..400).map(|k| middle + radius * turn(k)).collect()
                    }
                    _ => Vec::new(),
                }
            });
            let is_in = |at: &DVec2| at.cmpgt(low).all() && at.cmplt(high).all();
            assert_eq!(places.filter(is_in).count(), 0, "{primitive:?} to {to:?}: {low} to {high}");
        }
    }
}

#[test]
fn what_is_drawn_into_walls_and_obstacles_is_shown_where_it_will_lie() {
    let seen = shown(Scene::parse(BLOCK, "x.json").unwrap());
    let count = seen.0.point_count();
    for (primitive, from, to, what) in [
        (Primitive::Box, [5.5, -3.0], [6.5, -2.0], "wall"),
        (Primitive::Box, [1.4, 0.4], [2.4, -0.4], "obstacle"),
        (Primitive::Disc, [0.3, 0.2], [0.8, 0.2], "obstacle"),
        (Primitive::Disc, [-5.9, -3.9], [-5.4, -3.9], "wall"),
    ] {
        let mut hand = hand(primitive);
        hand.press(scope(&seen), at(&seen, from[0], from[1]));
        let pixel = at(&seen, to[0], to[1]);
        let (middle, said) = drawn(&hand.marks(scope(&seen), Some(pixel)));
        let deed = hand.release(scope(&seen), pixel);
        assert!(deed.words.as_ref().is_some_and(|words| words.contains(what)), "{:?}", deed.words);
        let there = history(&seen, &[deed]);
        let twice = there.world().warnings().iter().find(|line| line.contains("lay inside"));
        assert_eq!(twice, None, "one message is enough");
        let [low, high] = extent(there.world(), count);
        let lies = 0.5 * (low + high);
        let shown = seen.1.world_from_screen(middle.to_array()).truncate();
        assert!(shown.distance(lies) < 0.03, "{primitive:?}: shown {shown}, it lies {lies}");
        assert!(said.contains(&format!("{what} was in the way")), "{said}");
    }
}

#[test]
fn an_obstacle_shows_what_it_puts_aside_and_takes_in_no_body() {
    let seen = shown(Scene::parse(BLOCK, "x.json").unwrap());
    // Around the body; from its side; over what is wholly pinned.
    let cases = [
        ([-4.5, 1.0], [-3.0, -0.5], Some("would be inside it"), 0),
        ([-5.0, 1.0], [-3.9, -0.5], Some("pushes a body aside"), 1),
        ([-4.5, 3.0], [-3.8, 1.5], Some("neither can move"), 1),
        ([3.0, 3.0], [4.0, 2.0], None, 1),
    ];
    for (from, to, words, commands) in cases {
        for primitive in [Primitive::SolidBox, Primitive::Polygon] {
            let mut hand = hand(primitive);
            let corners = [from, [to[0], from[1]], to, [from[0], to[1]]].map(|[x, y]| at(&seen, x, y));
            let (marks, deed) = if primitive == Primitive::SolidBox {
                hand.press(scope(&seen), corners[0]);
                (hand.marks(scope(&seen), Some(corners[2])), hand.release(scope(&seen), corners[2]))
            } else {
                for corner in corners {
                    hand.press(scope(&seen), corner);
                    hand.release(scope(&seen), corner);
                }
                (hand.marks(scope(&seen), Some(corners[0])), hand.finish(scope(&seen)))
            };
            let said = drawn(&marks).1;
            let is_red = marks.iter().any(|mark| matches!(mark, Mark::Line(Role::Away, ..)));
            assert_eq!((deed.commands.len(), is_red), (commands, commands == 0), "{primitive:?}: {deed:?}");
            let more = deed.words.unwrap_or_default();
            match words {
                // Once it is done the world tells of bodies that it put aside.
                Some("pushes a body aside") => {
                    assert!(said.contains("pushes a body aside") && more.is_empty(), "{more}")
                }
                Some(words) => assert!(said.contains(words) && more.contains(words), "{primitive:?}: {said}, {more}"),
                None => assert!(!said.contains(": ") || primitive == Primitive::Polygon, "{said}"),
            }
        }
    }
    // The obstacle that is there, dragged onto each.
    for (to, words, commands) in [([-3.7, 0.3], "would be inside it", 0), ([-3.9, 2.2], "neither can move", 1)] {
        let mut hand = Hand::default();
        hand.take(Tool::Select);
        hand.press(scope(&seen), at(&seen, 1.0, 0.0));
        let to = at(&seen, to[0], to[1]);
        hand.trace(scope(&seen), to);
        assert!(drawn(&hand.marks(scope(&seen), Some(to))).1.contains(words));
        let deed = hand.release(scope(&seen), to);
        assert!(deed.commands.len() == commands && deed.words.is_some_and(|said| said.contains(words)));
    }
}
