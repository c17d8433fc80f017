//! Damping and servos of angles, relaxed bonds, and what a brush paints of the like: what is changed is seen, is that alone, and is undone.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use super::tests::{among, change, matter};
use super::{Common, MatterChange, NEVER, Painted, Span, Switched};
use crate::app::player::{Note, Order, Stage};
use crate::scene::{DriveKeys, KeyName, Scene};

const KNEE: &str = r#"{"wobble": 1, "points": {"position": [[1, 0], [0, 0], [0, 1]]}, "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}],
    "angles": [{"points": [0, 1, 2], "stiffness": 2, "damping": 0.25}]}"#;
const SOFT: &str = r#"{"wobble": 1, "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5,
    "material": {"kind": "spring", "stiffness": 300, "damping": 1, "mass": 4}}]}"#;

fn stage(text: &str) -> Stage {
    Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap()
}

fn undone(stage: &mut Stage) -> String {
    match stage.obey(Order::Undo(None)) {
        Some(Note::Undone(name, _)) => name,
        other => format!("{other:?}"),
    }
}

#[test]
fn damping_of_angles_is_set_alone_and_undone() {
    let (mut stage, all) = (stage(KNEE), among(0..3));
    let before = matter(&mut stage, &all);
    assert_eq!(before.angle_damping.and_then(Span::same), Some(0.25));
    change(&mut stage, &all, MatterChange::AngleDamping(0.5));
    let after = matter(&mut stage, &all);
    assert_eq!(after.angle_damping.and_then(Span::same), Some(0.5));
    assert_eq!(super::Matter { angle_damping: before.angle_damping, ..after }, before);
    assert_eq!(undone(&mut stage), "damping of angles");
    assert_eq!(matter(&mut stage, &all), before);
    assert_eq!(matter(&mut stage, &among(0..2)).angle_damping, None, "of no angle");
}

#[test]
fn a_servo_is_given_to_angles_that_resist_taken_away_and_undone() {
    let (mut stage, all) = (stage(KNEE), among(0..3));
    assert_eq!(matter(&mut stage, &all).swings, Some(Common::One(None)));
    let swing = DriveKeys {
        amplitude: Some(0.5),
        period: Some(2.0),
        key: Some(KeyName::Left),
        rate: Some(8.0),
        ..DriveKeys::default()
    };
    change(&mut stage, &all, MatterChange::Swings(Some(swing)));
    let Some(Common::One(Some(told))) = matter(&mut stage, &all).swings else { panic!("all have one servo") };
    assert_eq!((told.amplitude, told.period, told.phase), (Some(0.5), Some(2.0), Some(0.0)));
    assert_eq!((told.key, told.back, told.rate), (Some(KeyName::Left), None, Some(8.0)));
    change(&mut stage, &all, MatterChange::Swings(None));
    assert_eq!(matter(&mut stage, &all).swings, Some(Common::One(None)));
    assert_eq!([undone(&mut stage), undone(&mut stage)], ["swings", "swings"]);
    assert_eq!(matter(&mut stage, &all).swings, Some(Common::One(None)));
    let mut free = self::stage(&KNEE.replace(r#""stiffness": 2, "#, ""));
    assert_eq!(matter(&mut free, &all).swings, None, "nothing pulls that angle to where a servo wants it");
}

#[test]
fn bonds_are_relaxed_with_all_of_their_error_until_a_share_is_set() {
    let (mut stage, all) = (stage(SOFT), among(0..9));
    let before = matter(&mut stage, &all);
    change(&mut stage, &all, MatterChange::Relaxed);
    let after = matter(&mut stage, &all);
    assert_eq!(after.kinds, [0, 0, before.bonds]);
    assert_eq!(
        (after.relaxation.and_then(Span::same), after.max_correction.and_then(Span::same)),
        (Some(1.0), Some(NEVER))
    );
    change(&mut stage, &all, MatterChange::Relaxation(0.25));
    change(&mut stage, &all, MatterChange::MaxCorrection(0.5));
    let set = matter(&mut stage, &all);
    assert_eq!((set.relaxation.and_then(Span::same), set.max_correction.and_then(Span::same)), (Some(0.25), Some(0.5)));
    assert_eq!([(); 3].map(|()| undone(&mut stage)), ["largest correction", "relaxation", "relaxed"]);
    assert_eq!(matter(&mut stage, &all), before);
}

#[test]
fn a_brush_paints_bending_width_and_whether_it_is_drawn_as_one_step_of_undo() {
    let (mut stage, all) = (stage(SOFT), among(0..9));
    let before = matter(&mut stage, &all);
    let numbers = Painted {
        bending: Switched { is_on: true, value: 2.0 },
        width: Switched { is_on: true, value: 0.125 },
        visible: Switched { is_on: true, value: false },
        ..Painted::default()
    };
    change(&mut stage, &all, MatterChange::Painted(numbers));
    let after = matter(&mut stage, &all);
    assert!(after.bending.is_some_and(|span| (span.least - 2.0).abs() < 1e-3 && (span.most - 2.0).abs() < 1e-3));
    assert_eq!((after.width.and_then(Span::same), after.hidden), (Some(0.125), 9));
    assert_eq!((after.stiffness, after.mass, after.color), (before.stiffness, before.mass, before.color));
    assert_eq!(undone(&mut stage), "brush");
    assert_eq!(matter(&mut stage, &all), before);
}

#[test]
fn servos_that_differ_are_told_apart() {
    let beam = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0], [2, 0], [3, 0]]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}],
        "angles": [{"points": [0, 1, 2], "stiffness": 2, "drive": {"amplitude": 0.5, "period": 1}}, {"points": [1, 2, 3], "stiffness": 2}]}"#;
    let (mut stage, all) = (stage(beam), among(0..4));
    let now = matter(&mut stage, &all);
    assert_eq!(now.swings, Some(Common::Mixed), "one of two");
    assert!(matches!(matter(&mut stage, &among(0..3)).swings, Some(Common::One(Some(_)))));
    assert_eq!(matter(&mut stage, &among(1..4)).swings, Some(Common::One(None)));
    change(&mut stage, &all, MatterChange::Swings(None));
    assert_eq!(matter(&mut stage, &all).swings, Some(Common::One(None)));
}
