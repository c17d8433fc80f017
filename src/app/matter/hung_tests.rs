//! Stops of bodies that hang on one pin: they are offered, hold, are led along with their pin, and are undone.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

use super::tests::{among, change, matter, stage_of};
use super::{Among, Joint, MatterChange, Stops};
use crate::app::player::{Note, Order, Stage};
use crate::sim::PointId;

/// A rigid box of 1 m by 0.4 m that is pinned by its upper left corner and swings down, a rope on a pin, a rod on a pin, and a box on two pins.
const HANGING: &str = r#"{"wobble": 1, "gravity": [0, -9.81],
    "points": {"position": [[0, 0], [0, -0.4], [1, -0.4], [1, 0], [4, 0], [4.5, 0], [5, 0], [8, 0], [9, 0],
        [12, 0], [13, 0], [13, 1], [12, 1]], "pinned": [0, 4, 7, 9, 10]},
    "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 0}, {"a": 0, "b": 2},
        {"a": 4, "b": 5}, {"a": 5, "b": 6}, {"a": 7, "b": 8},
        {"a": 9, "b": 10}, {"a": 10, "b": 11}, {"a": 11, "b": 12}, {"a": 12, "b": 9}, {"a": 9, "b": 11}],
    "triangles": [[0, 1, 2], [0, 2, 3], [9, 10, 11], [9, 11, 12]]}"#;

fn place(stage: &Stage, point: usize) -> [f64; 2] {
    [0, 1].map(|axis| stage.history().world().positions().get(2 * point + axis))
}

/// How far the box has swung down about its pin `[rad]`.
fn swung(stage: &Stage) -> f64 {
    let ([x, y], [px, py]) = (place(stage, 2), place(stage, 0));
    (-0.4_f64).atan2(1.0) - (y - py).atan2(x - px)
}

/// Some points and the prop that came last.
fn with_prop(stage: &Stage, own: Among) -> Among {
    let prop = PointId(stage.history().world().point_count() as u32 - 1);
    Among { points: own.points.into_iter().chain([prop]).collect(), ..own }
}

#[test]
fn what_hangs_on_one_pin_gets_stops_about_where_it_stands_as_one_step_of_undo() {
    let mut stage = stage_of(HANGING);
    let slab = among(0..4);
    let before = matter(&mut stage, &slab);
    let offered = [0..4, 4..7, 7..9, 9..13].map(|points| matter(&mut stage, &among(points)).joints);
    assert_eq!(
        offered,
        [[0, 1], [0, 1], [0, 1], [0, 0]],
        "a rope has its knee alone, what two pins hold turns about none"
    );
    let rope = matter(&mut stage, &among(4..7)).coming_stops;
    assert!(rope.iter().all(|joint| joint.prop.is_none()), "{rope:?}");
    assert_eq!(matter(&mut stage, &among(0..1)).joints, [0, 1], "the pin alone means it too");
    let [Joint { points, range, prop: Some([x, y]) }] = before.coming_stops[..] else {
        panic!("{:?}", before.coming_stops)
    };
    assert_eq!(points, [13, 0, 2].map(PointId), "of its corners the farthest one");
    let [least, most] = range;
    assert!((least - (FRAC_PI_2 - FRAC_PI_3)).abs() < 1e-9 && (most - (FRAC_PI_2 + FRAC_PI_3)).abs() < 1e-9);
    assert!((x + 0.02).abs() < 1e-6 && (y + 0.05).abs() < 1e-6, "at a right angle to its arm: {x}, {y}");
    change(&mut stage, &slab, MatterChange::Stops(Stops::Some));
    assert_eq!(stage.history().world().props(), [PointId(13)]);
    let now = with_prop(&stage, slab.clone());
    let pin = with_prop(&stage, among(0..1));
    assert_eq!(matter(&mut stage, &pin).joints, [1, 1], "the pin alone with its prop still means it");
    let after = matter(&mut stage, &now);
    assert_eq!((after.joints, after.bodies, after.coming_stops.len()), ([1, 1], 1, 0));
    assert!((after.mass - before.mass).abs() < 1e-5 * before.mass, "it weighs what it did");
    let stood = stage.history().world().angles()[0];
    assert!((stood.rest - FRAC_PI_2).abs() < 1e-6 && stood.range == Some(range), "{stood:?}");
    assert!(crate::render::joints(stage.history().world()).is_empty(), "it is no figure of limbs");
    // It is undone with its prop.
    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "stops"));
    assert_eq!((matter(&mut stage, &slab), stage.history().world().point_count()), (before, 13));
}

#[test]
fn what_hangs_on_one_pin_swings_no_further_than_its_stops() {
    let mut free = stage_of(HANGING);
    let mut held = stage_of(HANGING);
    let slab = among(0..4);
    change(&mut held, &slab, MatterChange::Stops(Stops::Some));
    let all = with_prop(&held, slab);
    // A quarter turn is where it stands, and down is below that.
    change(&mut held, &all, MatterChange::Stops(Stops::Least(FRAC_PI_2 - 0.5)));
    let farthest = |stage: &mut Stage| {
        (0..120).fold(0.0_f64, |most, _| {
            stage.obey(Order::Step(None));
            most.max(swung(stage))
        })
    };
    let [free, held] = [farthest(&mut free), farthest(&mut held)];
    assert!(free > 1.0, "{free}");
    assert!((0.45..0.6).contains(&held), "{held}");
}

/// A soft box that is pinned by its upper left corner, with `more` keys, and points after its own.
fn soft(points: &str, pinned: &str, more: &str) -> String {
    format!(
        r#"{{"wobble": 1, "gravity": [0, 0],
        "points": {{"position": [[0, 0], [0, -1], [1, -1], [1, 0]{points}], "pinned": [{pinned}]}},
        "bonds": [{{"a": 0, "b": 1, "kind": "spring", "stiffness": 900}}, {{"a": 1, "b": 2, "kind": "spring", "stiffness": 900}},
            {{"a": 2, "b": 3, "kind": "spring", "stiffness": 900}}, {{"a": 3, "b": 0, "kind": "spring", "stiffness": 900}},
            {{"a": 0, "b": 2, "kind": "spring", "stiffness": 900}}],
        "triangles": [[0, 1, 2], [0, 2, 3]]{more}}}"#
    )
}

#[test]
fn a_body_whose_stops_were_taken_away_swings_freely_whatever_bending_it_gets() {
    let mut stage = stage_of(&soft("", "0", ""));
    let body = among(0..4);
    let before = matter(&mut stage, &body);
    change(&mut stage, &body, MatterChange::Stops(Stops::Some));
    let all = with_prop(&stage, body.clone());
    let [prop] = stage.history().world().props()[..] else { panic!("it pushes against nothing") };
    change(&mut stage, &all, MatterChange::Stops(Stops::None));
    let world = stage.history().world();
    assert!(world.angles().is_empty() && world.props().is_empty() && world.gone().contains(&prop));
    assert_eq!((matter(&mut stage, &all).joints, matter(&mut stage, &body).mass), ([0, 1], before.mass));
    change(&mut stage, &all, MatterChange::Bending(2.0));
    let is_own = |point: PointId| point.0 < 4;
    assert!(stage.history().world().angles().iter().all(|angle| angle.points.into_iter().all(is_own)));
    assert!(!stage.history().world().angles().is_empty());
    for name in ["bending", "stops", "stops"] {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(undone, _)) if undone == name));
    }
    assert_eq!(matter(&mut stage, &body), before);
}

#[test]
fn an_angle_on_the_background_gets_no_bending() {
    // As the file of one whose stops were taken away before.
    let text = soft(", [-0.05, -0.05]", "0, 4", r#", "angles": [{"points": [4, 0, 2], "rest": 1.5}]"#);
    let mut stage = stage_of(&text);
    assert_eq!(stage.history().world().props(), [PointId(4)]);
    change(&mut stage, &among(0..5), MatterChange::Bending(2.0));
    let angles = stage.history().world().angles();
    assert!(angles.len() > 1 && angles[0].stiffness == 0.0, "{angles:?}");
    assert!(angles[1..].iter().all(|angle| angle.stiffness > 0.0 && angle.points[1] != PointId(0)), "{angles:?}");
}

#[test]
fn pins_on_their_way_are_offered_no_stops_and_those_with_a_prop_take_it_along() {
    let way = r#", "pin_motion": [{"point": 0, "track": [[0, 0, 0], [1, 2, 0]]}]"#;
    let mut stage = stage_of(&soft("", "0", way));
    let body = among(0..4);
    assert_eq!(matter(&mut stage, &body).joints, [0, 0]);
    while stage.history().world().time() < 1.1 {
        stage.obey(Order::Step(None));
    }
    assert_eq!(matter(&mut stage, &body).joints, [0, 1], "it stands again");
    change(&mut stage, &body, MatterChange::Stops(Stops::Some));
    let all = with_prop(&stage, body);
    let pins = matter(&mut stage, &all).pins;
    let own: Vec<PointId> = pins.iter().map(|pin| pin.point).collect();
    let props: Vec<PointId> = pins[0].props.iter().map(|(prop, _)| *prop).collect();
    assert_eq!((own, props), (vec![PointId(0)], stage.history().world().props()));
}
