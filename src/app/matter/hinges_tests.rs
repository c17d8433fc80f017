//! Stops of hinges between two bodies: they are offered, set, undone, and hold against a motor.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use super::tests::{among, change, matter, stage_of};
use super::{Joint, MatterChange, Stops};
use crate::app::player::{Note, Order, Stage};

/// Two rigid boxes about a hub between them, of which one is pinned, and a rope.
const BOXES: &str = r#"{"wobble": 1, "gravity": [0, 0],
    "points": {"position": [[-1, -0.5], [-0.2, -0.5], [-0.2, 0.5], [-1, 0.5], [0.2, -0.5], [1, -0.5], [1, 0.5], [0.2, 0.5], [0, 0],
        [0, 4], [1, 4], [2, 4], [3, 4]], "pinned": [0, 3]},
    "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 0}, {"a": 0, "b": 2},
        {"a": 4, "b": 5}, {"a": 5, "b": 6}, {"a": 6, "b": 7}, {"a": 7, "b": 4}, {"a": 4, "b": 6},
        {"a": 8, "b": 1}, {"a": 8, "b": 2}, {"a": 8, "b": 4}, {"a": 8, "b": 7},
        {"a": 9, "b": 10}, {"a": 10, "b": 11}, {"a": 11, "b": 12}],
    "triangles": [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]MOTOR}"#;

fn boxes(motor: &str) -> Stage {
    stage_of(&BOXES.replace("MOTOR", motor))
}

#[test]
fn a_hinge_between_two_bodies_gets_stops_about_where_it_stands_and_loses_them_again() {
    let mut stage = boxes("");
    let (both, rope) = (among(0..9), among(9..13));
    let before = matter(&mut stage, &both);
    assert_eq!((before.joints, before.stops), ([0, 1], None));
    assert_eq!(matter(&mut stage, &rope).joints, [0, 0], "where two bonds meet in a rope is no hinge");
    assert_eq!(matter(&mut stage, &among(0..4)).joints, [0, 0], "one of the boxes has none by itself");
    let [Joint { points, range: [least, most], prop: None }] = before.coming_stops[..] else {
        panic!("{:?}", before.coming_stops)
    };
    assert_eq!(points[1].0, 8);
    assert!((most - least - 2.0 * std::f64::consts::FRAC_PI_3).abs() < 1e-9 && least < 0.8 && most > 0.7);
    change(&mut stage, &both, MatterChange::Stops(Stops::Some));
    let range = |stage: &Stage| stage.history().world().angles()[0].range;
    assert_eq!((matter(&mut stage, &both).joints, range(&stage)), ([1, 1], Some([least, most])));
    change(&mut stage, &both, MatterChange::Stops(Stops::Least(0.5)));
    change(&mut stage, &both, MatterChange::Stops(Stops::Most(1.25)));
    assert_eq!(range(&stage), Some([0.5, 1.25]));
    change(&mut stage, &both, MatterChange::Stops(Stops::None));
    assert_eq!((matter(&mut stage, &both).joints, range(&stage)), ([0, 1], None));
    for _ in 0..4 {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "stops"));
    }
    assert_eq!(matter(&mut stage, &both), before);
}

#[test]
fn a_motor_turns_its_hinge_no_further_than_its_stops() {
    let mut stage =
        boxes(r#", "angles": [{"points": [1, 8, 7], "rest": 3.141592653589793, "drive": {"speed": 2, "torque": 5}}]"#);
    let both = among(0..9);
    let before = matter(&mut stage, &both);
    assert!(before.motors.is_some() && before.joints == [0, 1], "a motor is no stop, and is not in its way");
    change(&mut stage, &both, MatterChange::Stops(Stops::Some));
    let after = matter(&mut stage, &both);
    assert_eq!((after.joints, after.motors), ([1, 1], before.motors));
    let angle = |stage: &Stage| {
        let world = stage.history().world();
        let stopped = world.angles().iter().find(|angle| angle.range.is_some()).unwrap();
        let at = |point: usize| [0, 1].map(|axis| world.positions().get(2 * stopped.points[point].index() + axis));
        let [i, j, k] = [0, 1, 2].map(at);
        let from = |[x, y]: [f64; 2]| (y - j[1]).atan2(x - j[0]);
        let (turn, middle) = (from(k) - from(i), stopped.range.unwrap().iter().sum::<f64>() / 2.0);
        (turn - std::f64::consts::TAU * ((turn - middle) / std::f64::consts::TAU).round(), stopped.range.unwrap())
    };
    let first = angle(&stage).0;
    let mut farthest = 0.0_f64;
    for _ in 0..180 {
        stage.obey(Order::Step(None));
        let (now, [least, most]) = angle(&stage);
        // A stop is a stiff spring: what hits it goes a little beyond.
        assert!((least - 0.15..=most + 0.15).contains(&now), "{now} of {least} to {most}");
        farthest = farthest.max((now - first).abs());
    }
    assert!(farthest > 0.9, "it gets to its stop: {farthest}");
}
