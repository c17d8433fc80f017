//! Points that are bonded to those about them as they are drawn, without a window.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::collections::BTreeSet;

use super::links::Links;
use super::tests::{Seen, added, at, hand, room};
use crate::app::action::Primitive;
use crate::app::player::{Order, Stage};
use crate::app::tools::marks::Role;
use crate::app::tools::tests::{scope, shown};
use crate::app::tools::{Deed, Hand, Mark};
use crate::scene::Scene;
use crate::sim::bond::lower_first;

/// The view is 700 px of 8 m, so that they reach 1.37 m far.
const CONNECTS: fn() -> Links = || Links { connects: true, ..Links::default() };

fn drawing(links: Links) -> Hand {
    let mut hand = hand(Primitive::Bonds);
    hand.set_links(links);
    hand
}

fn click(seen: &Seen, hand: &mut Hand, [x, y]: [f64; 2]) -> Deed {
    let pressed = hand.press(scope(seen), at(seen, x, y));
    let released = hand.release(scope(seen), at(seen, x, y));
    if pressed == Deed::default() { released } else { pressed }
}

/// The bonds that a deed brings, ascending.
fn bonds(deed: &Deed) -> Vec<[u32; 2]> {
    let pairs: BTreeSet<[u32; 2]> = added(deed).bonds.iter().map(|bond| lower_first([bond.a, bond.b])).collect();
    assert_eq!(pairs.len(), added(deed).bonds.len(), "each once");
    pairs.into_iter().collect()
}

/// The ends of the thin lines while the pointer is at a place, the words beside it.
fn previewed(seen: &Seen, hand: &Hand, [x, y]: [f64; 2]) -> (usize, String) {
    let marks = hand.marks(scope(seen), Some(at(seen, x, y)));
    let is_thin = |mark: &&Mark| matches!(mark, Mark::Line(Role::Come, _, _, width) if *width == 1.0);
    let words = marks.iter().find_map(|mark| if let Mark::Words(_, words) = mark { Some(words.clone()) } else { None });
    (marks.iter().filter(is_thin).count(), words.unwrap())
}

const TRUSS: [[f64; 2]; 5] = [[-1.0, 0.0], [0.0, 0.0], [-0.5, 0.87], [0.5, 0.87], [1.0, 0.0]];

#[test]
fn a_truss_is_drawn_with_a_click_for_each_point_and_comes_as_one_step() {
    let seen = room();
    let mut hand = drawing(CONNECTS());
    for (k, place) in TRUSS.into_iter().enumerate() {
        // Those that are there are one for the third point and one for the fourth.
        let ties = [0, 0, 1, 1, 1][k];
        let (lines, words) = previewed(&seen, &hand, place);
        assert_eq!(lines, k.saturating_sub(2) + ties, "{k}");
        assert_eq!(words.contains("bonded to 1 point in reach"), ties == 1, "{k}: {words}");
        assert!(click(&seen, &mut hand, place).is_empty());
    }
    let deed = hand.finish(scope(&seen));
    let whole = vec![[0, 1], [0, 2], [1, 2], [1, 3], [1, 4], [2, 3], [3, 4]];
    assert_eq!(bonds(&deed), whole);
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
    assert_eq!(stage.history().world().bonds().len(), 7);
    stage.obey(Order::Undo(None));
    assert_eq!(stage.history().world().point_count(), 0, "all of it is one step");
    // Without the switch it is the chain alone, and so it is where none is in reach.
    for links in [Links::default(), Links { reach: 60, ..CONNECTS() }] {
        let mut hand = drawing(links);
        TRUSS.into_iter().for_each(|place| _ = click(&seen, &mut hand, place));
        assert_eq!(bonds(&hand.finish(scope(&seen))), [[0, 1], [1, 2], [2, 3], [3, 4]]);
    }
}

#[test]
fn a_point_that_is_taken_back_takes_its_bonds_with_it() {
    let seen = room();
    let mut hand = drawing(CONNECTS());
    TRUSS.into_iter().for_each(|place| _ = click(&seen, &mut hand, place));
    (0..2).for_each(|_| hand.step_back());
    assert_eq!(bonds(&hand.finish(scope(&seen))), [[0, 1], [0, 2], [1, 2]]);
}

#[test]
fn of_points_in_a_row_the_nearest_alone_is_bonded() {
    let seen = room();
    let mut hand = drawing(CONNECTS());
    [[-0.6, 0.0], [0.0, 0.0], [0.6, 0.01]].into_iter().for_each(|place| _ = click(&seen, &mut hand, place));
    assert_eq!(bonds(&hand.finish(scope(&seen))), [[0, 1], [1, 2]]);
}

/// Two points that are free, of which one is a pin, and a body of triangles below them.
fn others() -> Seen {
    let text = r#"{"wobble": 1, "gravity": [0, 0], "view": {"center": [0, 0], "height": 8},
        "points": {"position": [[-1, 1], [1, 1], [0, -0.4], [1, -1], [-1, -1]], "pinned": [0]},
        "bonds": [{"a": 2, "b": 3}, {"a": 3, "b": 4}, {"a": 4, "b": 2}], "triangles": [[2, 4, 3]]}"#;
    shown(Scene::parse(text, "x.json").unwrap())
}

#[test]
fn points_of_the_world_are_bonded_but_none_that_a_body_covers() {
    let seen = others();
    let mut hand = drawing(CONNECTS());
    assert!(previewed(&seen, &hand, [0.0, 0.5]).1.contains("bonded to 2 points in reach"));
    click(&seen, &mut hand, [0.0, 0.5]);
    // A second click ends it: a single point with its bonds.
    let deed = click(&seen, &mut hand, [0.0, 0.5]);
    assert_eq!(bonds(&deed), [[0, 5], [1, 5]], "the corner of the body is in reach too");
    // Where the chain comes from a point, its bond to that is no second one; Esc keeps a point that is bonded.
    click(&seen, &mut hand, [-1.0, 1.0]);
    click(&seen, &mut hand, [0.0, 0.5]);
    assert_eq!(bonds(&hand.finish(scope(&seen))), [[0, 5], [1, 5]]);
    let mut off = drawing(Links::default());
    click(&seen, &mut off, [0.0, 0.5]);
    assert!(added(&click(&seen, &mut off, [0.0, 0.5])).bonds.is_empty());
}

#[test]
fn a_loop_that_is_filled_keeps_its_bonds_to_points_beside_it() {
    let text = r#"{"wobble": 1, "gravity": [0, 0], "view": {"center": [0, 0], "height": 8}, "points": {"position": [[0, 2]]}}"#;
    let seen = shown(Scene::parse(text, "x.json").unwrap());
    let mut hand = drawing(Links { fills: true, ..CONNECTS() });
    let corners = [[-0.5, 1.0], [-0.5, -0.5], [0.5, -0.5], [0.5, 1.0]];
    corners.into_iter().for_each(|place| _ = click(&seen, &mut hand, place));
    let deed = click(&seen, &mut hand, corners[0]);
    let keys = added(&deed);
    assert!(!keys.triangles.is_empty());
    let to_it: Vec<u32> = keys.bonds.iter().filter(|bond| bond.a == 0).map(|bond| bond.b).collect();
    let places = &keys.points.as_ref().unwrap().position;
    let held: Vec<[f64; 3]> = to_it.iter().map(|point| places[*point as usize - 1].embed()).collect();
    assert_eq!(held.len(), 2);
    for [x, y, _] in held {
        assert!((x.abs() - 0.5).abs() < 1e-6 && (y - 1.0).abs() < 1e-6, "{x}, {y}");
    }
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
}
