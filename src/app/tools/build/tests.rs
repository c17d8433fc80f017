//! Primitives that are drawn out, without a window.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::{DVec2, DVec3};

use crate::app::action::{Primitive, Tool};
use crate::app::player::{Note, Order, Shown, Stage};
use crate::app::tools::tests::{opened, pixel, scope, shown};
use crate::app::tools::{Deed, Hand, Mark, Role};
use crate::history::{Do, History};
use crate::render::Camera;
use crate::scene::{AddKeys, Scene};
use crate::sim::{Dynamics, PointId};

pub(super) type Seen = (Shown, Camera, Scene);

/// An empty box, 8 m high in view, with gravity.
const ROOM: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "bounds": {"min": [-6, -4], "max": [6, 4], "friction": 0.5},
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
fn drag(seen: &Seen, hand: &mut Hand, from: [f64; 2], to: [f64; 2]) -> Deed {
    let pressed = hand.press(scope(seen), at(seen, from[0], from[1]));
    assert!(pressed.is_empty() && hand.is_busy());
    hand.release(scope(seen), at(seen, to[0], to[1]))
}

pub(super) fn added(deed: &Deed) -> &AddKeys {
    let [Do::Add(keys)] = &deed.commands[..] else { panic!("{deed:?}") };
    keys
}

/// The box around the points of a world from a number on.
fn extent(world: &dyn Dynamics, first: usize) -> [DVec2; 2] {
    let x = world.positions();
    let places = (first..world.point_count()).map(|k| DVec2::new(x.get(2 * k), x.get(2 * k + 1)));
    places.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
}

/// The history of a scene with deeds done at once.
fn history(seen: &Seen, deeds: &[Deed]) -> History {
    let mut history = History::new(seen.2.clone().into()).unwrap();
    for deed in deeds {
        history.give(deed.commands.clone(), deed.edit).unwrap();
    }
    history
}

fn close(found: DVec2, wanted: [f64; 2], within: f64) -> bool {
    found.distance(DVec2::from(wanted)) <= within
}

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

/// The middle of the box around lines and rings, and what is written.
fn drawn(marks: &[Mark]) -> (DVec2, String) {
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

const BLOCK: &str = r#"{"wobble": 1, "view": {"center": [0, 0], "height": 10}, "bounds": {"min": [-6, -4], "max": [6, 4]},
    "obstacles": [{"box": {"min": [0, -1], "max": [2, 1]}}], "gravity": [0, 0], "contact": true,
    "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.3, "origin": [-4, 0],
        "material": {"kind": "spring", "stiffness": 300, "damping": 1, "mass": 1}},
      {"make": "lattice", "columns": 2, "rows": 2, "spacing": 0.4, "origin": [-4, 2], "pinned": [0, 1, 2, 3],
        "material": {"kind": "spring", "stiffness": 300, "damping": 1, "mass": 1}}]}"#;

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

/// A rope that hangs from a pin at (-2, 3), 2 m long, and a box beside it.
const LOOSE: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": true, "bounds": {"min": [-6, -4], "max": [6, 4]},
    "view": {"center": [0, 0], "height": 8}, "bodies": [{"make": "rope", "count": 9, "to": [0, -2], "origin": [-2, 3], "pinned": [0],
    "material": {"kind": "rigid", "mass": 1}}, {"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5, "origin": [1, 0],
    "material": {"kind": "spring", "stiffness": 300, "mass": 4}}]}"#;

#[test]
fn a_body_that_is_drawn_over_the_loose_end_of_a_rope_is_tied_to_it() {
    let seen = shown(Scene::parse(LOOSE, "x.json").unwrap());
    let count = seen.0.point_count();
    let drags = [
        (Primitive::Box, [-2.6, 1.4], [-1.4, 0.2]),
        (Primitive::Disc, [-2.0, 0.8], [-1.4, 0.8]),
        (Primitive::Box, [0.0, 3.0], [0.6, 2.4]),
    ];
    for (primitive, from, to) in drags {
        for is_free in [false, true] {
            let ties = from[0] < -1.0 && !is_free;
            let mut hand = hand(primitive);
            hand.hold([is_free, primitive == Primitive::Disc]);
            hand.press(scope(&seen), at(&seen, from[0], from[1]));
            let to = at(&seen, to[0], to[1]);
            let said = drawn(&hand.marks(scope(&seen), Some(to))).1;
            let deed = hand.release(scope(&seen), to);
            assert_eq!(said.contains("the rope's end is tied to it"), ties, "{primitive:?}: {said}");
            assert_eq!(deed.commands.len(), if ties { 2 } else { 1 }, "{deed:?}");
            if !ties {
                continue;
            }
            let mut stage = Stage::new(seen.2.clone().into()).unwrap();
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
            let world = stage.history().world();
            let gone = world.gone().to_vec();
            assert!(!gone.is_empty() && gone.iter().all(|point| point.index() < count), "{gone:?}");
            let is_tie = |bond: &crate::sim::Bond| bond.a.index() < count && bond.b.index() >= count;
            let ties: Vec<_> = world.bonds().iter().filter(is_tie).collect();
            let [tie] = ties[..] else { panic!("{ties:?}") };
            assert!(tie.rest_length < 0.6 && !gone.contains(&tie.a), "{tie:?}");
            for _ in 0..180 {
                stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
            }
            // It hangs, and is pushed out of nothing.
            let [low, high] = extent(stage.history().world(), count);
            assert!(low.y > -1.5 && low.y < 0.9 && (low.x + high.x + 4.0).abs() < 1.0, "{low} {high}");
            assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == primitive.name()));
            assert_eq!(stage.history().world().gone().len(), 0);
        }
    }
}

#[test]
fn a_box_that_is_drawn_under_the_loose_end_of_a_rope_or_from_a_pin_hangs_there() {
    let seen = shown(Scene::parse(LOOSE, "x.json").unwrap());
    let count = seen.0.point_count();
    let place = |point: usize| DVec3::from(seen.0.place(point)).truncate();
    let (end, pin) = (place(8), place(0));
    let below = [end + DVec2::new(-0.5, -0.05), end + DVec2::new(0.5, -1.05)];
    let from_pin = [pin + DVec2::new(-0.03, 0.02), pin + DVec2::new(-1.2, 0.9)];
    for ([from, to], words, weld) in
        [(below, "the rope's end is tied to it", false), (from_pin, "tied to the pin", true)]
    {
        for is_free in [false, true] {
            let mut hand = hand(Primitive::Box);
            hand.hold([is_free, false]);
            hand.press(scope(&seen), at(&seen, from.x, from.y));
            let to = at(&seen, to.x, to.y);
            let said = drawn(&hand.marks(scope(&seen), Some(to))).1;
            assert_eq!(said.contains(words), !is_free, "{said}");
            let deed = hand.release(scope(&seen), to);
            let mut stage = Stage::new(seen.2.clone().into()).unwrap();
            assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
            let is_tie = |bond: &crate::sim::Bond| bond.a.index() < count && bond.b.index() >= count;
            let ties: Vec<_> = stage.history().world().bonds().iter().filter(is_tie).collect();
            assert_eq!(ties.len(), usize::from(!is_free), "{ties:?}");
            assert!(ties.iter().all(|tie| (tie.rest_length == 0.0) == weld), "{ties:?}");
            for _ in 0..120 {
                stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
            }
            let world = stage.history().world();
            assert!(world.is_finite());
            let [_, high] = extent(world, count);
            assert_eq!(high.y > from.y - 0.6, !is_free, "{words}, free {is_free}: {high} from {from}");
        }
    }
}

#[test]
fn what_is_drawn_under_or_over_the_end_of_a_rope_hangs_where_the_rope_is_and_a_box_by_the_middle_of_its_side() {
    let seen = shown(Scene::parse(LOOSE, "x.json").unwrap());
    let count = seen.0.point_count();
    // From a little beside the middle, from well beside it, over the end, and a disc that is drawn from its middle.
    let drags = [
        (Primitive::Box, [-2.55, 0.97], [-1.5, 0.1], true),
        (Primitive::Box, [-2.3, 0.97], [-1.0, 0.1], false),
        (Primitive::Box, [-2.55, 1.6], [-1.4, 0.6], true),
        (Primitive::Disc, [-1.97, 0.45], [-1.45, 0.45], true),
    ];
    for (primitive, from, to, is_middle) in drags {
        let deed = drag(&seen, &mut hand(primitive), from, to);
        let mut stage = Stage::new(seen.2.clone().into()).unwrap();
        assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
        let place = |stage: &Stage, point: usize| {
            let x = stage.history().world().positions();
            DVec2::new(x.get(2 * point), x.get(2 * point + 1))
        };
        let is_tie = |bond: &crate::sim::Bond| bond.a.index() < count && bond.b.index() >= count;
        let ties: Vec<_> = stage.history().world().bonds().iter().filter(is_tie).collect();
        let [tie] = ties[..] else { panic!("{ties:?}") };
        assert!((place(&stage, tie.b.index()).x + 2.0).abs() < 1e-6, "{primitive:?} {from:?}: right below the rope");
        let [low, high] = extent(stage.history().world(), count);
        let off = 0.5 * (low.x + high.x) + 2.0;
        assert_eq!(off.abs() < 1e-6, is_middle, "{primitive:?} {from:?}: {off} m beside the rope");
        if is_middle {
            (0..240).for_each(|_| _ = stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
            let [low, high] = extent(stage.history().world(), count);
            assert!((0.5 * (low.x + high.x) + 2.0).abs() < 0.03, "{primitive:?} {from:?}: it hangs straight down");
        }
    }
}

#[test]
fn boxes_are_not_tied_to_bodies_that_they_are_drawn_beside() {
    let text = LOOSE.replace("[1, 0]", "[0.4, 0.2]");
    let seen = shown(Scene::parse(&text, "x.json").unwrap());
    let corner = (0..seen.0.point_count()).map(|point| DVec3::from(seen.0.place(point)).truncate()).skip(9);
    let corner = corner.max_by(|a, b| (a.x + a.y).total_cmp(&(b.x + b.y))).unwrap();
    let deed = drag(&seen, &mut hand(Primitive::Box), [corner.x, corner.y], [corner.x + 1.0, corner.y + 1.0]);
    assert!(added(&deed).bonds.is_empty() && deed.words.is_none(), "{deed:?}");
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
