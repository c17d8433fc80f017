//! Numbers of where what is selected is, and what is put where they say.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use super::Among;
use super::placed::{Fit, Placed, Placing, Size};
use super::tests::among;
use crate::app::player::{Note, Order, Shown, Stage};
use crate::scene::Scene;
use crate::sim::Obstacle;

/// A box that is turned, a circle, a plane, and a rod that flies.
const SCENE: &str = r#"{"wobble": 1, "points": {"position": [[1, 4], [3, 6]], "velocity": [[1, 0], [1, 0]]}, "bonds": [{"a": 0, "b": 1}],
    "obstacles": [{"box": {"min": [0, 0], "max": [2, 1], "angle": 0.3}}, {"circle": {"center": [5, 1], "radius": 0.5}},
        {"plane": {"point": [0, -3], "normal": [0, 2]}}]}"#;

fn stage() -> Stage {
    Stage::new(Scene::parse(SCENE, "x.json").unwrap().into()).unwrap()
}

/// The obstacle that this is true of.
fn obstacle(stage: &Stage, is_meant: impl Fn(&Obstacle) -> bool) -> Among {
    let all = stage.history().world().obstacles();
    let found = all.into_iter().find(|(_, obstacle)| is_meant(obstacle)).unwrap();
    Among { obstacles: vec![found.0], ..Among::default() }
}

fn corners(count: usize) -> impl Fn(&Obstacle) -> bool {
    move |obstacle| matches!(obstacle, Obstacle::Polygon(polygon) if polygon.loops[0].len() == count)
}

fn is_plane(obstacle: &Obstacle) -> bool {
    matches!(obstacle, Obstacle::Plane { .. })
}

fn look(stage: &mut Stage, among: &Among) -> (Placed, Option<[f64; 3]>) {
    assert_eq!(stage.obey(Order::Inspect(among.clone())), None);
    let mut shown = Shown::default();
    stage.show(&mut shown);
    (shown.figures.placed.unwrap(), shown.figures.velocity)
}

fn put(stage: &mut Stage, among: &Among, placing: Placing, goes_on: bool) {
    let order = Order::Place { among: among.clone(), fit: Fit::default(), placing, goes_on };
    assert_eq!(stage.obey(order), None, "{placing:?}");
}

/// Its numbers in one row: the middle, the angle, width and height or the radius twice; 0 where it has none.
fn numbers(placed: Placed) -> [f64; 6] {
    let Placed { middle: [x, y, z], angle, size } = placed;
    let [wide, high] = match size {
        Some(Size::Box(sides)) => sides,
        Some(Size::Circle(radius)) => [radius; 2],
        None => [0.0; 2],
    };
    [x, y, z, angle.unwrap_or(0.0), wide, high]
}

fn is_near(placed: Placed, expected: [f64; 6]) -> bool {
    numbers(placed).into_iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9)
}

#[test]
fn where_it_is_is_told_of_what_has_a_form() {
    let mut stage = stage();
    let [bar, disc, ground] = [
        obstacle(&stage, corners(4)),
        obstacle(&stage, |one| !is_plane(one) && !corners(4)(one)),
        obstacle(&stage, is_plane),
    ];
    for (among, expected, size) in [
        (&bar, [1.0, 0.5, 0.0, 0.3, 2.0, 1.0], Some(Size::Box([0.0; 2]))),
        (&disc, [5.0, 1.0, 0.0, 0.0, 0.5, 0.5], Some(Size::Circle(0.0))),
        (&ground, [0.0, -3.0, 0.0, 0.0, 0.0, 0.0], None),
        (&among(0..2), [2.0, 5.0, 0.0, 0.0, 0.0, 0.0], None),
    ] {
        let placed = look(&mut stage, among).0;
        assert!(is_near(placed, expected), "{placed:?}");
        let forms = [placed.size, size].map(|size| size.map(|size| std::mem::discriminant(&size)));
        assert_eq!((forms[0], placed.angle.is_some()), (forms[1], among == &bar || among == &ground));
    }
    let both = Among { obstacles: [&bar.obstacles[..], &disc.obstacles].concat(), ..among(0..2) };
    let placed = look(&mut stage, &both).0;
    assert_eq!((placed.angle, placed.size), (None, None), "several have a middle alone");
    assert!((placed.middle[0] - 0.5 * (placed_left(0.3) + 5.5)).abs() < 1e-9, "{placed:?}");
}

/// The left end of the box of the scene `[m]`.
fn placed_left(angle: f64) -> f64 {
    1.0 - angle.cos() - 0.5 * angle.sin()
}

#[test]
fn a_number_puts_it_there_exactly_and_is_one_step_of_undo() {
    let slope = 21.8_f64.to_radians();
    let bar = [1.0, 0.5, 0.0, 0.3, 2.0, 1.0];
    let with = |of: [f64; 6], place: usize, x: f64| {
        let mut all = of;
        all[place] = x;
        all
    };
    let (disc, ground) = ([5.0, 1.0, 0.0, 0.0, 0.5, 0.5], [0.0, -3.0, 0.0, 0.0, 0.0, 0.0]);
    let rod = [2.0, 5.0, 0.0, 0.0, 0.0, 0.0];
    let cases: [(usize, Placing, [f64; 6], &str); 9] = [
        (0, Placing::At(0, 1.25), with(bar, 0, 1.25), "move"),
        (0, Placing::Angle(slope), with(bar, 3, slope), "turn"),
        (0, Placing::TurnBy(-0.1), with(bar, 3, 0.2), "turn"),
        (0, Placing::Side(0, 3.0), with(bar, 4, 3.0), "scale"),
        (0, Placing::Side(1, 0.25), with(bar, 5, 0.25), "scale"),
        (1, Placing::Radius(0.75), with(with(disc, 4, 0.75), 5, 0.75), "scale"),
        (2, Placing::Angle(slope), with(ground, 3, slope), "turn"),
        (2, Placing::At(1, -2.5), with(ground, 1, -2.5), "move"),
        (3, Placing::At(1, 7.0), with(rod, 1, 7.0), "move"),
    ];
    for (which, placing, expected, name) in cases {
        let mut stage = stage();
        let is_disc = |one: &Obstacle| !is_plane(one) && !corners(4)(one);
        let among = match which {
            0 => obstacle(&stage, corners(4)),
            1 => obstacle(&stage, is_disc),
            2 => obstacle(&stage, is_plane),
            _ => among(0..2),
        };
        let (before, velocity) = look(&mut stage, &among);
        put(&mut stage, &among, placing, false);
        let (after, still) = look(&mut stage, &among);
        assert!(is_near(after, expected), "{placing:?}: {after:?}");
        assert_eq!(still, velocity, "{placing:?} leaves velocities");
        assert!(
            matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(undone, _)) if undone == name),
            "{placing:?}"
        );
        assert_eq!(look(&mut stage, &among).0, before, "{placing:?} undone");
    }
}

#[test]
fn a_box_that_is_flipped_stands_at_its_angle_and_is_dragged_on_past_a_right_angle() {
    let text = r#"{"wobble": 1, "obstacles": [{"polygon": [[[2, 0], [0, 0], [0, 1], [2, 1]]]}]}"#;
    let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
    let bar = obstacle(&stage, corners(4));
    assert_eq!(look(&mut stage, &bar).0.angle, Some(0.0), "not half a turn");
    for (to, shown, goes_on) in [(89.0_f64, 89.0_f64, false), (91.0, -89.0, true), (93.0, -87.0, true)] {
        let before = look(&mut stage, &bar).0;
        let turn = before.turn_to(to.to_radians()).unwrap().to_degrees();
        assert!(turn.abs() < 89.5, "{turn}°: no half turn more");
        put(&mut stage, &bar, Placing::Angle(to.to_radians()), goes_on);
        let after = look(&mut stage, &bar).0;
        assert!(is_near(after, [1.0, 0.5, 0.0, shown.to_radians(), 2.0, 1.0]), "{after:?}");
    }
}

#[test]
fn a_turn_that_is_dragged_on_goes_on_from_what_was_taken_of_it() {
    let mut stage = stage();
    let bar = obstacle(&stage, corners(4));
    let before = look(&mut stage, &bar).0;
    let nothing = Among::default();
    // What is refused on the way is no part of it.
    for (of, by, goes_on) in [(&bar, 0.1, false), (&bar, 0.25, true), (&nothing, 0.3, true), (&bar, 0.4, true)] {
        let order = Order::Place { among: of.clone(), fit: Fit::default(), placing: Placing::TurnBy(by), goes_on };
        assert_eq!(stage.obey(order).is_some(), of == &nothing, "{by}");
    }
    assert!(is_near(look(&mut stage, &bar).0, [1.0, 0.5, 0.0, 0.7, 2.0, 1.0]));
    put(&mut stage, &bar, Placing::TurnBy(-0.2), false);
    assert!(is_near(look(&mut stage, &bar).0, [1.0, 0.5, 0.0, 0.5, 2.0, 1.0]), "the next one begins anew");
    stage.obey(Order::Undo(None));
    stage.obey(Order::Undo(None));
    assert_eq!(look(&mut stage, &bar).0, before, "one edit each");
}

#[test]
fn a_number_that_is_dragged_on_is_one_edit() {
    let mut stage = stage();
    let bar = obstacle(&stage, corners(4));
    let before = look(&mut stage, &bar).0;
    for (x, goes_on) in [(1.1, false), (1.2, true), (1.3, true)] {
        put(&mut stage, &bar, Placing::At(0, x), goes_on);
    }
    assert!((look(&mut stage, &bar).0.middle[0] - 1.3).abs() < 1e-12);
    stage.obey(Order::Undo(None));
    assert_eq!(look(&mut stage, &bar).0, before);
}

#[test]
fn a_drag_whose_first_number_is_refused_or_not_asked_for_is_an_edit_of_its_own() {
    let mut stage = stage();
    let bar = obstacle(&stage, corners(4));
    put(&mut stage, &bar, Placing::Angle(0.5), false);
    let before = look(&mut stage, &bar).0;
    let (fit, placing) = (Fit::default(), Placing::Angle(0.1));
    let refused = Order::Place { among: among(0..2), fit, placing, goes_on: false };
    assert!(matches!(stage.obey(refused), Some(Note::Refused(_))));
    [0.6, 0.7].into_iter().for_each(|angle| put(&mut stage, &bar, Placing::Angle(angle), true));
    let turned = look(&mut stage, &bar).0;
    [1.1, 1.2].into_iter().for_each(|x| put(&mut stage, &bar, Placing::At(0, x), true));
    assert!((look(&mut stage, &bar).0.middle[0] - 1.2).abs() < 1e-12);
    for (name, then) in [("move", turned), ("turn", before)] {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(undone, _)) if undone == name));
        assert_eq!(look(&mut stage, &bar).0, then, "{name}");
    }
}

#[test]
fn what_has_no_such_number_says_so() {
    let mut stage = stage();
    for placing in [Placing::Angle(0.1), Placing::Radius(1.0), Placing::Side(0, 1.0)] {
        let order = Order::Place { among: among(0..2), fit: Fit::default(), placing, goes_on: false };
        assert!(matches!(stage.obey(order), Some(Note::Refused(_))), "{placing:?}");
    }
}
