//! Primitives that are drawn out, without a window.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use crate::app::action::{Primitive, Tool};
use crate::app::player::{Note, Order, Shown, Stage};
use crate::app::tools::tests::{opened, scope, shown};
use crate::app::tools::{Deed, Hand, Mark};
use crate::history::{Do, History};
use crate::render::Camera;
use crate::scene::{AddKeys, Scene};
use crate::sim::{Dynamics, PointId};

pub(super) type Seen = (Shown, Camera, Scene);

/// An empty box, 8 m high in view, with gravity.
pub(super) const ROOM: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "bounds": {"min": [-6, -4], "max": [6, 4], "friction": 0.5},
    "view": {"center": [0, 0], "height": 8}}"#;

pub(super) fn room() -> Seen {
    shown(Scene::parse(ROOM, "x.json").unwrap())
}

pub(super) fn hand(primitive: Primitive) -> Hand {
    let mut hand = Hand::default();
    hand.choose(primitive);
    // What is round is drawn from its middle here.
    hand.hold([false, matches!(primitive, Primitive::Disc | Primitive::Rim | Primitive::SolidCircle)]);
    hand
}

/// Where a place is seen.
pub(super) fn at(seen: &Seen, x: f64, y: f64) -> DVec2 {
    seen.1.screen_from_world([x, y, 0.0].into()).unwrap().into()
}

/// A drag from place to place.
pub(super) fn drag(seen: &Seen, hand: &mut Hand, from: [f64; 2], to: [f64; 2]) -> Deed {
    let pressed = hand.press(scope(seen), at(seen, from[0], from[1]));
    assert!(pressed.is_empty() && hand.is_busy());
    hand.release(scope(seen), at(seen, to[0], to[1]))
}

pub(super) fn added(deed: &Deed) -> &AddKeys {
    let [Do::Add(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    keys
}

/// The box around the points of a world from a number on.
pub(super) fn extent(world: &dyn Dynamics, first: usize) -> [DVec2; 2] {
    let x = world.positions();
    let places = (first..world.point_count()).map(|k| DVec2::new(x.get(2 * k), x.get(2 * k + 1)));
    places.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
}

/// The history of a scene with deeds done at once.
pub(super) fn history(seen: &Seen, deeds: &[Deed]) -> History {
    let mut history = History::new(seen.2.clone().into()).unwrap();
    for deed in deeds {
        history.give(deed.commands.clone(), deed.edit).unwrap();
    }
    history
}

pub(super) fn close(found: DVec2, wanted: [f64; 2], within: f64) -> bool {
    found.distance(DVec2::from(wanted)) <= within
}

/// The middle of the box around lines and rings, and what is written.
pub(super) fn drawn(marks: &[Mark]) -> (DVec2, String) {
    let mut ends = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    let mut said = String::new();
    for mark in marks {
        let places = match mark {
            Mark::Line(_, from, to, _) => [*from, *to],
            Mark::Ring(_, middle, radius) => [*middle - *radius, *middle + *radius],
            Mark::Words(_, words) => {
                said.clone_from(words);
                continue;
            }
            _ => continue,
        };
        places.into_iter().for_each(|at| ends = [ends[0].min(at), ends[1].max(at)]);
    }
    (0.5 * (ends[0] + ends[1]), said)
}

pub(super) const BLOCK: &str = r#"{"wobble": 1, "view": {"center": [0, 0], "height": 10}, "bounds": {"min": [-6, -4], "max": [6, 4]},
    "obstacles": [{"box": {"min": [0, -1], "max": [2, 1]}}], "gravity": [0, 0], "contact": true,
    "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.3, "origin": [-4, 0],
        "material": {"kind": "spring", "stiffness": 300, "damping": 1, "mass": 1}},
      {"make": "lattice", "columns": 2, "rows": 2, "spacing": 0.4, "origin": [-4, 2], "pinned": [0, 1, 2, 3],
        "material": {"kind": "spring", "stiffness": 300, "damping": 1, "mass": 1}}]}"#;

/// A rope that hangs from a pin at (-2, 3), 2 m long, and a box beside it.
pub(super) const LOOSE: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": true, "bounds": {"min": [-6, -4], "max": [6, 4]},
    "view": {"center": [0, 0], "height": 8}, "bodies": [{"make": "rope", "count": 9, "to": [0, -2], "origin": [-2, 3], "pinned": [0],
    "material": {"kind": "rigid", "mass": 1}}, {"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5, "origin": [1, 0],
    "material": {"kind": "spring", "stiffness": 300, "mass": 4}}]}"#;

#[test]
fn a_drag_becomes_one_edit_that_fills_what_was_drawn() {
    let seen = room();
    for (primitive, from, to) in [
        (Primitive::Box, [-1.0, 0.5], [1.0, -0.5]),
        (Primitive::Cloth, [1.5, 1.0], [-1.5, -1.0]),
        (Primitive::Disc, [0.0, 0.0], [0.6, 0.8]),
        (Primitive::Rim, [0.0, 0.0], [-0.8, 0.6]),
        (Primitive::Rope, [-1.0, 1.0], [2.0, -0.5]),
    ] {
        let deed = drag(&seen, &mut hand(primitive), from, to);
        assert_eq!((deed.edit, added(&deed).bodies.len()), (Some(primitive.name()), 1));
        let history = history(&seen, &[deed]);
        let [low, high] = extent(history.world(), 0);
        let (from, to) = (DVec2::from(from), DVec2::from(to));
        let reach = match primitive {
            Primitive::Disc | Primitive::Rim => [from - 1.0, from + 1.0],
            _ => [from.min(to), from.max(to)],
        };
        // Cells are square, rings have corners.
        assert!(low.distance(reach[0]) < 0.05 && high.distance(reach[1]) < 0.05, "{primitive:?}: {low} {high}");
    }
}

#[test]
fn a_figure_stands_where_the_drag_begins_with_its_feet_at_the_lower_end_and_falls_in_one_piece() {
    let seen = room();
    for (from, to) in [([0.4, 1.5], [1.4, -0.5]), ([0.4, -0.5], [-0.6, 1.5])] {
        let deed = drag(&seen, &mut hand(Primitive::Figure), from, to);
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None, "nor is anything warned of");
        let world = stage.history().world();
        let [low, high] = extent(world, 0);
        assert!((low.y + 0.5).abs() < 1e-9 && (high.y - 1.5).abs() < 1e-9, "{low} {high}");
        assert!(low.x < 0.4 && high.x > 0.4 && high.x - low.x < 2.0, "about its feet: {low} {high}");
        assert_eq!((world.point_count(), world.angles().len()), (36, 9), "the joints of a ragdoll");
        for _ in 0..90 {
            stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
        }
        let world = stage.history().world();
        let x = world.positions();
        let at = |k: PointId| DVec2::new(x.get(2 * k.index()), x.get(2 * k.index() + 1));
        let strains = world.bonds().iter().map(|bond| (at(bond.a).distance(at(bond.b)) - bond.rest_length).abs());
        assert!(strains.fold(0.0, f64::max) < 1e-3 && extent(world, 0)[0].y > -4.01);
    }
}

#[test]
fn obstacles_lie_where_they_were_drawn_and_slopes_are_planks_at_the_right_hand() {
    let seen = room();
    let solid = drag(&seen, &mut hand(Primitive::SolidBox), [1.0, 1.0], [-1.0, 0.0]);
    let circle = drag(&seen, &mut hand(Primitive::SolidCircle), [0.0, -2.0], [0.5, -2.0]);
    let slope = drag(&seen, &mut hand(Primitive::Slope), [-1.0, -3.0], [1.0, -2.0]);
    let names = [&solid, &circle, &slope].map(|deed| deed.edit.unwrap());
    assert_eq!(names, ["Solid box", "Solid circle", "Slope"]);
    let history = history(&seen, &[solid, circle, slope]);
    let [solid, circle, plank] = history.world().polygons() else { panic!("a box, a circle and a plank") };
    assert!(solid.loops[0].iter().all(|&[x, y]| (x.abs() - 1.0).abs() < 1e-9 && (y - 0.5).abs() - 0.5 < 1e-9));
    assert!(
        circle.loops[0].iter().all(|&corner| (DVec2::from(corner).distance(DVec2::new(0.0, -2.0)) - 0.5).abs() < 1e-6)
    );
    let is_corner = |at: [f64; 2]| plank.loops[0].iter().any(|&corner| close(DVec2::from(corner), at, 1e-9));
    assert!(is_corner([-1.0, -3.0]) && is_corner([1.0, -2.0]), "{plank:?}");
    let below = plank.loops[0].iter().filter(|&&[x, y]| y < -2.5 + 0.5 * x - 1e-9).count();
    assert_eq!(below, 2, "its other side is below a drag to the right: {plank:?}");
}

#[test]
fn a_click_makes_one_of_a_usual_size() {
    let seen = room();
    for primitive in Primitive::ALL.into_iter().filter(|primitive| !primitive.is_drawn()) {
        let deed = drag(&seen, &mut hand(primitive), [0.3, 0.2], [0.3, 0.2]);
        assert_eq!(deed.edit, Some(primitive.name()));
        let [low, high] = extent(history(&seen, &[deed]).world(), 0);
        let is_body = low.is_finite();
        assert!(!is_body || (0.9..=2.1).contains(&(high - low).max_element()), "{primitive:?}: {low} {high}");
    }
}

#[test]
fn what_is_too_small_is_not_made_and_is_said() {
    let seen = room();
    for primitive in Primitive::ALL.into_iter().filter(|primitive| !primitive.is_drawn()) {
        let flat = matches!(primitive, Primitive::Box | Primitive::Cloth | Primitive::SolidBox | Primitive::Figure);
        let to = if flat { [2.0, 0.01] } else { [0.06, 0.0] };
        let deed = drag(&seen, &mut hand(primitive), [0.0, 0.0], to);
        assert!(deed.is_empty() && deed.edit.is_none(), "{primitive:?}");
        assert!(deed.words.is_some_and(|words| words.starts_with("too small")), "{primitive:?}");
    }
}

#[test]
fn a_drag_that_is_cancelled_makes_nothing() {
    let seen = room();
    let mut hand = hand(Primitive::Disc);
    hand.press(scope(&seen), at(&seen, 0.0, 0.0));
    assert_eq!(hand.cancel(), (true, Deed::default()));
    assert_eq!(hand.release(scope(&seen), at(&seen, 1.0, 0.0)), Deed::default());
    assert_eq!((hand.tool(), hand.primitive()), (Tool::Build, Primitive::Disc), "the choice stays");
}

#[test]
fn in_space_what_is_of_the_plane_is_not_built_and_it_is_said() {
    let space = opened("cloth-ball");
    let is_of_space = |primitive: &Primitive| crate::app::tools::is_of_space(*primitive);
    assert_eq!(Primitive::ALL.into_iter().filter(is_of_space).count(), 4);
    for primitive in Primitive::ALL.into_iter().filter(|primitive| !is_of_space(primitive)) {
        let mut hand = hand(primitive);
        let deed = hand.press(scope(&space), DVec2::new(500.0, 350.0));
        assert!(deed.is_empty() && deed.words.is_some_and(|words| words.contains("in space")));
        let marks = hand.marks(scope(&space), Some(DVec2::new(500.0, 350.0)));
        let is_said = matches!(&marks[..], [Mark::Words(_, words)] if words.contains("in space"));
        assert!(!hand.is_busy() && is_said, "before the click too: {marks:?}");
    }
}

/// Every primitive, drawn into each other and into the walls.
fn heap(seen: &Seen) -> Vec<Deed> {
    let all = [
        (Primitive::SolidBox, [-2.0, -3.0], [2.0, -2.0]),
        (Primitive::SolidCircle, [3.0, 0.0], [3.8, 0.0]),
        (Primitive::Slope, [-5.0, -1.0], [0.0, -3.5]),
        (Primitive::Box, [-1.0, -2.5], [1.0, -1.0]),
        (Primitive::Disc, [0.5, -1.5], [1.2, -1.5]),
        (Primitive::Rim, [3.0, 0.5], [4.0, 0.5]),
        (Primitive::Cloth, [-3.0, 3.0], [-1.0, 2.0]),
        (Primitive::Box, [5.0, -3.0], [6.8, -4.5]),
        (Primitive::Rope, [-1.0, 3.5], [1.5, 2.0]),
        (Primitive::Box, [-0.5, 3.0], [0.5, 2.0]),
    ];
    let drawn = |(primitive, from, to)| drag(seen, &mut hand(primitive), from, to);
    all.into_iter().map(drawn).collect()
}

#[test]
fn what_is_built_into_each_other_comes_apart_quietly() {
    let seen = room();
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    for deed in heap(&seen) {
        assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None, "{:?} is not refused", deed.edit);
    }
    let mut fastest: f64 = 0.0;
    let mut last = Vec::new();
    for frame in 0..120 {
        stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
        let world = stage.history().world();
        assert!(world.is_finite());
        let x = world.positions();
        let now: Vec<f64> = (0..x.len()).map(|k| x.get(k)).collect();
        if frame > 60 {
            fastest = now.iter().zip(&last).map(|(a, b): (&f64, &f64)| 60.0 * (a - b).abs()).fold(fastest, f64::max);
        }
        last = now;
    }
    // What falls for 2 s over 8 m is not faster.
    assert!(fastest < 13.0, "{fastest} m/s");
    let [low, high] = extent(stage.history().world(), 0);
    assert!(low.cmpge(DVec2::new(-6.1, -4.1)).all() && high.cmple(DVec2::new(6.1, 4.1)).all(), "{low} {high}");
}

#[test]
fn what_is_built_is_replayed_and_undone() {
    let seen = room();
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let count = |stage: &Stage| stage.history().world().point_count();
    let deed = drag(&seen, &mut hand(Primitive::Disc), [0.0, 0.0], [0.7, 0.0]);
    assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
    let made = count(&stage);
    assert!(made > 20 && stage.history().world().contact().is_some(), "it lies on what comes");
    for _ in 0..30 {
        stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
    }
    let places = |history: &History| {
        let x = history.world().positions();
        (0..x.len()).map(|k| x.get(k)).collect::<Vec<_>>()
    };
    let mut again = History::new(stage.history().recording().into()).unwrap();
    again.go_to(stage.history().world().time());
    assert_eq!(places(&again), places(stage.history()), "the log brings it to the same bits");
    let Some(Note::Undone(name, _)) = stage.obey(Order::Undo(None)) else { panic!("it is undone") };
    assert_eq!((name.as_str(), count(&stage)), ("Disc", 0));
    assert!(stage.history().world().contact().is_none(), "as one with what made bodies meet");
    stage.obey(Order::Redo(None));
    assert_eq!(count(&stage), made);
}

#[test]
fn what_has_a_middle_is_drawn_from_corner_to_corner_or_with_alt_from_there() {
    let seen = room();
    for (primitive, is_round) in [
        (Primitive::Box, false),
        (Primitive::Cloth, false),
        (Primitive::SolidBox, false),
        (Primitive::Disc, true),
        (Primitive::Rim, true),
        (Primitive::SolidCircle, true),
    ] {
        for from_middle in [false, true] {
            let mut hand = Hand::default();
            hand.choose(primitive);
            hand.hold([false, from_middle]);
            let deed = drag(&seen, &mut hand, [1.0, 0.5], [-0.6, 1.3]);
            let history = history(&seen, &[deed]);
            let world = history.world();
            let [low, high] = match world.obstacles().into_iter().next() {
                Some((_, crate::sim::Obstacle::Polygon(polygon))) => {
                    let corners = polygon.loops.into_iter().flatten().map(DVec2::from);
                    corners.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
                }
                _ => extent(world, 0),
            };
            let wanted = match (is_round, from_middle) {
                (false, false) => [[-0.6, 0.5], [1.0, 1.3]],
                (false, true) => [[-0.6, -0.3], [2.6, 1.3]],
                (true, false) => [[-0.6, 0.5], [1.0, 2.1]],
                (true, true) => {
                    let radius = 1.6_f64.hypot(0.8);
                    [[1.0 - radius, 0.5 - radius], [1.0 + radius, 0.5 + radius]]
                }
            };
            // Cells of boxes are squares, rims have corners.
            let within = if is_round { 0.06 } else { 0.3 };
            let found = close(low, wanted[0], within) && close(high, wanted[1], within);
            assert!(found, "{primitive:?}, from the middle {from_middle}: {low} to {high}, not {wanted:?}");
        }
    }
}

#[test]
fn a_disc_that_is_put_on_level_ground_rolls_to_no_side() {
    let seen = room();
    for radius in [0.3, 0.5, 0.77] {
        let deed = drag(&seen, &mut hand(Primitive::Disc), [0.2, -4.0 + radius], [0.2 + radius, -4.0 + radius]);
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        stage.obey(Order::Give(deed.commands, deed.edit));
        let middle = |stage: &Stage| {
            let world = stage.history().world();
            (0..world.point_count()).map(|k| world.positions().get(2 * k)).sum::<f64>() / world.point_count() as f64
        };
        let from = middle(&stage);
        (0..240).for_each(|_| _ = stage.obey(Order::Step(None)));
        let far = (middle(&stage) - from).abs();
        assert!(far < 0.02 * radius, "radius {radius}: {far} m in 4 s");
    }
}

/// A peg in the middle, and a plank beside it that is thinner than the cells of a body.
const PEGS: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": true, "view": {"center": [0, 0], "height": 8},
    "obstacles": [{"circle": {"center": [0, 0], "radius": 0.1}}, {"box": {"min": [2, -0.02], "max": [3, 0.02]}}]}"#;

#[test]
fn a_body_that_is_drawn_around_an_obstacle_goes_beside_it() {
    let seen = shown(Scene::parse(PEGS, "x.json").unwrap());
    let is_clear = |[low, high]: [DVec2; 2], is_round: bool| {
        let is_off = |[from, to]: [[f64; 2]; 2]| {
            low.cmpge(DVec2::from(to) - 1e-2).any() || high.cmple(DVec2::from(from) + 1e-2).any()
        };
        // A disc has sides, which are nearer to its middle than its rim.
        let is_round_off = (0.5 * (low + high)).length() > 0.1 + 0.98 * 0.5 * (high.y - low.y);
        (if is_round { is_round_off } else { is_off([[-0.1; 2], [0.1; 2]]) }) && is_off([[2.0, -0.02], [3.0, 0.02]])
    };
    for (primitive, from, to, moves) in [
        (Primitive::Box, [-1.1, 0.9], [0.9, -1.1], true),
        (Primitive::Disc, [0.1, 0.1], [0.9, 0.1], true),
        (Primitive::Box, [1.8, 0.5], [3.2, -0.5], true),
        (Primitive::Box, [-1.0, 1.301], [1.0, 0.101], false),
        // What has a hole may be about it.
        (Primitive::Rim, [0.0, 0.0], [0.9, 0.0], false),
    ] {
        let mut hand = hand(primitive);
        hand.press(scope(&seen), at(&seen, from[0], from[1]));
        let marks = hand.marks(scope(&seen), Some(at(&seen, to[0], to[1])));
        let deed = hand.release(scope(&seen), at(&seen, to[0], to[1]));
        let said = deed.words.clone().unwrap_or_default();
        assert_eq!(said.contains("beside the obstacle"), moves, "{primitive:?} {from:?}: {said}");
        assert_eq!(drawn(&marks).1.contains("beside the obstacle"), moves, "{primitive:?}: it is said before");
        let history = history(&seen, &[deed]);
        let there = extent(history.world(), 0);
        let is_round = primitive == Primitive::Disc;
        assert_eq!(is_clear(there, is_round), primitive != Primitive::Rim, "{primitive:?}: {there:?}");
        let middle = 0.5 * (there[0] + there[1]);
        assert!(middle.length() < 3.5, "it is near to where it was drawn: {middle}");
        let is_on_the_peg = middle.x.abs() < 0.1 && middle.y > 0.0;
        assert!(!moves || !is_on_the_peg, "{primitive:?}: it would balance on the peg: {middle}");
        if !moves {
            continue;
        }
        // The outline is where it comes to be.
        let top = at(&seen, middle.x, there[1].y).y;
        let is_there = |mark: &Mark| match mark {
            Mark::Line(_, a, b, _) => (a.y - top).abs() < 2.0 || (b.y - top).abs() < 2.0,
            Mark::Ring(_, middle, radius) => (middle.y - radius - top).abs() < 8.0,
            _ => false,
        };
        assert!(marks.iter().any(is_there), "{primitive:?}: {marks:?}");
    }
}
