//! Polygons, and points and bonds: drawn click by click, without a window.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::links::{Link, Links};
use super::tests::{Seen, added, at, hand, room};
use crate::app::action::Primitive;
use crate::app::player::{Note, Order, Stage};
use crate::app::tools::marks::Role;
use crate::app::tools::tests::{scope, shown};
use crate::app::tools::{Deed, Hand, Mark};
use crate::history::Do;
use crate::scene::Scene;
use crate::sim::{BondKind, Limit};

/// A press, a way to a place and a release. What comes of it first.
fn stroke(seen: &Seen, hand: &mut Hand, way: &[[f64; 2]]) -> Deed {
    let pressed = hand.press(scope(seen), at(seen, way[0][0], way[0][1]));
    way.iter().for_each(|&[x, y]| hand.trace(scope(seen), at(seen, x, y)));
    let [x, y] = way[way.len() - 1];
    let released = hand.release(scope(seen), at(seen, x, y));
    if pressed == Deed::default() { released } else { pressed }
}

fn clicks<const N: usize>(seen: &Seen, hand: &mut Hand, places: [[f64; 2]; N]) -> Deed {
    places.into_iter().map(|place| stroke(seen, hand, &[place])).last().unwrap()
}

fn is_red(hand: &Hand, seen: &Seen, [x, y]: [f64; 2]) -> bool {
    let marks = hand.marks(scope(seen), Some(at(seen, x, y)));
    // What closing would cross is no harm yet: its line is thinner.
    marks.iter().any(|mark| matches!(mark, Mark::Line(Role::Away, _, _, width) if *width > 1.0))
}

fn outline(deed: &Deed) -> Vec<DVec2> {
    let loops = added(deed).obstacles[0].polygon.as_ref().unwrap();
    assert_eq!((loops.len(), deed.edit), (1, Some("Polygon")));
    loops[0].iter().map(|corner| DVec2::new(corner.embed()[0], corner.embed()[1])).collect()
}

#[test]
fn an_outline_is_closed_by_its_first_corner_by_a_second_click_and_by_enter() {
    let seen = room();
    // An arrow, whose two ends lie on one line with its notch.
    let corners = [[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    for way in 0..3 {
        let mut hand = hand(Primitive::Polygon);
        assert!(clicks(&seen, &mut hand, corners).is_empty() && hand.is_drawing() && hand.is_busy());
        let deed = match way {
            0 => stroke(&seen, &mut hand, &[[-1.05, 0.05]]),
            1 => stroke(&seen, &mut hand, &[corners[3]]),
            _ => hand.finish(scope(&seen)),
        };
        let far = outline(&deed).iter().zip(corners).map(|(a, b)| a.distance(b.into())).fold(0.0, f64::max);
        assert!(far < 1e-9 && !hand.is_busy(), "{way}: {far}");
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
        assert_eq!(stage.history().world().polygons().len(), 1);
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "Polygon"));
        assert!(stage.history().world().polygons().is_empty());
    }
}

#[test]
fn an_outline_that_crosses_itself_is_red_before_and_refused() {
    let seen = room();
    let mut hand = hand(Primitive::Polygon);
    clicks(&seen, &mut hand, [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]]);
    let over = [1.0, -1.0];
    assert!(is_red(&hand, &seen, over) && !is_red(&hand, &seen, [1.0, 1.0]));
    let deed = stroke(&seen, &mut hand, &[over]);
    assert!(deed.is_empty() && deed.words.unwrap().contains("cross itself") && hand.is_drawing());
    assert_eq!(outline(&hand.finish(scope(&seen))).len(), 3, "that corner was not taken");
    // Closing would cross, though no side does yet.
    clicks(&seen, &mut hand, [[0.0, 0.0], [2.0, 1.0], [0.0, 1.0], [1.0, 2.0]]);
    let deed = hand.finish(scope(&seen));
    assert!(deed.words.is_some_and(|words| words.contains("cross")) && hand.is_drawing());
    let hint = hand.marks(scope(&seen), Some(at(&seen, 0.0, 2.9)));
    let hint = hint.into_iter().find_map(|mark| if let Mark::Words(_, words) = mark { Some(words) } else { None });
    let hint = hint.unwrap();
    assert!(hint.contains("closed now it would cross itself") && !hint.contains("Enter"), "{hint}");
    (0..4).for_each(|_| hand.step_back());
    assert!(!hand.is_busy(), "all corners are taken back");
    assert_eq!(hand.finish(scope(&seen)), Deed::default());
}

#[test]
fn a_free_stroke_is_an_outline_with_as_few_corners_as_show_it() {
    let seen = room();
    let mut hand = hand(Primitive::Polygon);
    let round: Vec<[f64; 2]> = (0..300).map(|k| (1.2 * DVec2::from_angle(0.0205 * f64::from(k))).to_array()).collect();
    let corners = outline(&stroke(&seen, &mut hand, &round));
    assert!((12..60).contains(&corners.len()), "{}", corners.len());
    assert!(corners.iter().all(|corner| (corner.length() - 1.2).abs() < 0.02));
    let eight: Vec<[f64; 2]> =
        (0..300).map(|k| 0.021 * f64::from(k)).map(|t| [2.0 * t.sin(), (2.0 * t).sin()]).collect();
    let deed = stroke(&seen, &mut hand, &eight);
    assert!(deed.is_empty() && deed.words.unwrap().contains("cross") && !hand.is_busy(), "an eight");
    let deed = stroke(&seen, &mut hand, &[[0.0, 0.0], [1.0, 0.0]]);
    assert_eq!((deed, hand.is_drawing()), (Deed::default(), true), "a straight drag is a side");
}

/// A point that is held and one that is free.
fn pair() -> Seen {
    let text = r#"{"wobble": 1, "points": {"position": [[-1, 1], [1, 1]], "pinned": [0]}, "gravity": [0, -10],
        "view": {"center": [0, 0], "height": 8}}"#;
    shown(Scene::parse(text, "x.json").unwrap())
}

#[test]
fn a_chain_goes_from_point_to_point_and_comes_as_one_step() {
    let seen = pair();
    for link in Link::ALL {
        let mut hand = hand(Primitive::Bonds);
        hand.set_links(Links { link, ..Links::default() });
        // A click on a point of the world, a drag that begins there, a click on the other one, a second click.
        clicks(&seen, &mut hand, [[-1.05, 1.05]]);
        assert_eq!(stroke(&seen, &mut hand, &[[-1.0, 1.0], [0.0, 2.0]]), Deed::default());
        assert_eq!(clicks(&seen, &mut hand, [[1.0, 0.95]]), Deed::default());
        let deed = clicks(&seen, &mut hand, [[1.0, 1.0]]);
        assert!(!hand.is_busy() && deed.edit == Some("Bonds"));
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
        let world = stage.history().world();
        let ends: Vec<[u32; 2]> = world.bonds().ends().iter().map(|ends| ends.map(|end| end.0)).collect();
        assert_eq!((ends, world.point_count()), (vec![[0, 2], [1, 2]], 3), "{link:?}");
        for bond in world.bonds().iter() {
            assert!((bond.rest_length - 2f64.sqrt()).abs() < 1e-6);
            assert_eq!(matches!(bond.kind, BondKind::Spring { .. }), link == Link::Spring);
            assert_eq!(bond.limit == Limit::Max, link == Link::String);
        }
        stage.obey(Order::Undo(None));
        assert_eq!((stage.history().world().bonds().len(), stage.history().world().point_count()), (0, 2));
    }
}

#[test]
fn a_loop_has_its_sides_or_is_filled() {
    let seen = pair();
    let corners = [[-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 1.0]];
    let mut hand = hand(Primitive::Bonds);
    clicks(&seen, &mut hand, corners);
    let sides = clicks(&seen, &mut hand, [corners[0]]);
    assert_eq!((added(&sides).bonds.len(), added(&sides).triangles.len()), (4, 0));
    clicks(&seen, &mut hand, corners);
    hand.hold([true, false]);
    let body = clicks(&seen, &mut hand, [corners[0]]);
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    assert_eq!(stage.obey(Order::Give(body.commands, body.edit)), None);
    let world = stage.history().world();
    let place = |k: usize| DVec2::new(world.positions().get(2 * k), world.positions().get(2 * k + 1));
    let area = |&[a, b, c]: &[crate::sim::PointId; 3]| {
        let [a, b, c] = [a, b, c].map(|point| place(point.index()));
        0.5 * (b - a).perp_dot(c - a)
    };
    let areas: Vec<f64> = world.triangles().iter().map(area).collect();
    assert!((areas.iter().sum::<f64>() - 4.0).abs() < 1e-6 && areas.iter().all(|area| *area > 0.0));
    assert!((20..80).contains(&world.point_count()), "{}", world.point_count());
    let ends = world.bonds().ends();
    let of_point = |k: u32| ends.iter().filter(|ends| ends.iter().any(|end| end.0 == k)).count();
    assert!(of_point(0) >= 2 && of_point(1) >= 2, "the points that were there are its corners");
    let masses: f64 = world.masses()[2..].iter().sum();
    assert!((3.0..4.0).contains(&masses), "{masses} kg of 4 m^2, less the two corners");
    assert!(world.contact().is_some(), "it meets what comes");
}

#[test]
fn a_chain_that_is_left_comes_and_one_that_can_do_nothing_says_so() {
    let seen = pair();
    let mut hand = hand(Primitive::Bonds);
    clicks(&seen, &mut hand, [[0.0, 0.0], [0.5, 0.0], [2.0, 0.0]]);
    hand.step_back();
    let deed = hand.leave_drawing(scope(&seen));
    assert_eq!((added(&deed).bonds.len(), hand.is_busy()), (1, false), "Esc ends it as it is");
    // Something else came meanwhile: its numbers would be those of other points.
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let first = deed.commands.clone();
    assert_eq!(stage.obey(Order::Give(first, deed.edit)), None);
    assert!(
        matches!(stage.obey(Order::Give(deed.commands, deed.edit)), Some(Note::Refused(why)) if why.contains("again"))
    );
    let alone = clicks(&seen, &mut hand, [[1.0, 1.0], [1.0, 1.0]]);
    assert!(alone.is_empty() && alone.words.unwrap().contains("two points"));
    let point = clicks(&seen, &mut hand, [[0.0, 0.0], [0.0, 0.0]]);
    assert!(matches!(&point.commands[..], [Do::Add(keys)] if keys.points.as_ref().unwrap().position.len() == 1));
}

#[test]
fn what_a_loop_cannot_be_filled_for_and_bonds_that_do_nothing_are_said_before_and_after() {
    let text = r#"{"wobble": 1, "gravity": [0, 0], "view": {"center": [0, 0], "height": 8},
        "bodies": [{"make": "lattice", "columns": 4, "rows": 3, "spacing": 1, "origin": [-4, 0],
            "material": {"kind": "rigid", "mass": 2}}]}"#;
    let seen = shown(Scene::parse(text, "x.json").unwrap());
    let said = |hand: &Hand, place: [f64; 2]| {
        let marks = hand.marks(scope(&seen), Some(at(&seen, place[0], place[1])));
        let words =
            marks.into_iter().find_map(|mark| if let Mark::Words(_, words) = mark { Some(words) } else { None });
        words.unwrap()
    };
    let loops: [(&[[f64; 2]], &str, usize); 3] = [
        (&[[0.0, -2.0], [1.0, -2.0], [2.0, -2.0]], "around nothing", 3),
        (&[[0.0, -2.0], [1.0, -2.0], [3.0, -2.0], [2.0, -2.0]], "around nothing", 4),
        (&[[0.0, -2.0], [2.0, -1.0], [2.0, -2.0], [0.0, -1.0]], "crosses itself", 4),
    ];
    for (corners, words, bonds) in loops {
        let mut hand = hand(Primitive::Bonds);
        hand.set_links(Links { fills: true, ..Links::default() });
        for corner in corners {
            clicks(&seen, &mut hand, [*corner]);
        }
        assert!(said(&hand, corners[0]).contains(words), "{}", said(&hand, corners[0]));
        let deed = clicks(&seen, &mut hand, [corners[0]]);
        assert_eq!((added(&deed).bonds.len(), added(&deed).triangles.len()), (bonds, 0), "its sides alone");
        assert!(deed.words.is_some_and(|said| said.contains(words)));
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
    }
    // From corner to corner of what is rigid; then to where nothing is, and back to its skin from within.
    let mut hand = hand(Primitive::Bonds);
    clicks(&seen, &mut hand, [[-4.0, 0.0]]);
    assert!(said(&hand, [-1.0, 2.0]).contains("one rigid body"));
    clicks(&seen, &mut hand, [[-1.0, 2.0]]);
    let deed = clicks(&seen, &mut hand, [[-1.0, 2.0]]);
    assert!(deed.is_empty() && deed.words.is_some_and(|words| words.contains("one rigid body")));
    clicks(&seen, &mut hand, [[3.0, 3.0], [-1.3, 1.4]]);
    let deed = clicks(&seen, &mut hand, [[-1.3, 1.4]]);
    assert_eq!((added(&deed).bonds.len(), added(&deed).points.as_ref().unwrap().position.len()), (1, 1));
}

#[test]
fn bonds_are_drawn_within_the_walls_only_and_it_is_said_before_the_click() {
    let text = r#"{"wobble": 1, "bounds": {"min": [-2, -2], "max": [2, 2]}, "view": {"center": [0, 0], "height": 8}}"#;
    let seen = shown(Scene::parse(text, "x.json").unwrap());
    let mut hand = hand(Primitive::Bonds);
    assert!(stroke(&seen, &mut hand, &[[3.0, 0.0]]).words.is_some_and(|words| words.contains("beyond the walls")));
    assert!(!hand.is_drawing(), "nothing has begun");
    clicks(&seen, &mut hand, [[0.0, 0.0]]);
    assert!(is_red(&hand, &seen, [2.5, 0.5]) && !is_red(&hand, &seen, [1.5, 0.5]));
    let deed = stroke(&seen, &mut hand, &[[2.5, 0.5]]);
    assert!(deed.is_empty() && deed.words.is_some() && hand.is_drawing(), "the chain goes on from where it was");
    // A drag that ends beyond them adds nothing either.
    assert!(stroke(&seen, &mut hand, &[[1.0, 1.0], [1.0, 3.0]]).is_empty());
    let deed = hand.finish(scope(&seen));
    let points = added(&deed).points.as_ref().unwrap();
    assert_eq!(points.position.len(), 2, "{points:?}");
}
