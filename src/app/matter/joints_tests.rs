//! Joints of what is selected, their stops, motors and lengths at rest: what is changed is seen, is that alone, and is undone.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use super::tests::{among, change, matter, stage, stage_of};
use super::{Among, Common, MatterChange, MotorChange, Preset, Stops};
use crate::app::player::{Note, Order, Stage};
use crate::history::{Do, DriveOrNone, SetKeys};
use crate::scene::{DriveKeys, KeyName, Scene};
use crate::sim::{AngleDrive, BondKind};

/// Two bars that share a point, and two angles of a beam, one of which is a joint with stops.
const KNEES: &str = r#"{"wobble": 1,
    "points": {"position": [[1, 0], [0, 0], [0, 1], [4, 0], [5, 0], [6, 0], [7, 0]]},
    "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 3, "b": 4}, {"a": 4, "b": 5}, {"a": 5, "b": 6}],
    "angles": [{"points": [3, 4, 5], "stiffness": 2}, {"points": [4, 5, 6], "stiffness": 3, "min": 2, "max": 4}]}"#;

#[test]
fn a_knee_gets_stops_and_an_angle_at_rest_each_in_a_step_of_undo() {
    let mut stage = Stage::new(Scene::parse(KNEES, "x.json").unwrap().into()).unwrap();
    let degrees = |span: super::Span| [span.least.to_degrees(), span.most.to_degrees()].map(f64::round);
    let ends = |stage: &mut Stage, among: &Among| matter(stage, among).stops.map(|both| both.map(degrees));
    let leg = among(0..3);
    let before = matter(&mut stage, &leg);
    assert_eq!((before.joints, before.stops, before.rest_angle), ([0, 1], None, None), "two bonds alone may be a knee");
    change(&mut stage, &leg, MatterChange::Stops(Stops::Some));
    assert_eq!((matter(&mut stage, &leg).joints, ends(&mut stage, &leg)), ([1, 1], Some([[30.0; 2], [150.0; 2]])));
    change(&mut stage, &leg, MatterChange::Stops(Stops::Least(0.5)));
    change(&mut stage, &leg, MatterChange::Stops(Stops::Most(2.5)));
    assert_eq!(stage.history().world().angles().last().unwrap().range, Some([0.5, 2.5]));
    for _ in 0..3 {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "stops"));
    }
    assert_eq!(matter(&mut stage, &leg), before);

    // Of several those change that have stops, and what differs says so.
    let beam = among(3..7);
    assert_eq!((matter(&mut stage, &beam).joints, ends(&mut stage, &beam)), ([1, 2], Some([[115.0; 2], [229.0; 2]])));
    change(&mut stage, &beam, MatterChange::Stops(Stops::Some));
    assert_eq!(ends(&mut stage, &beam), Some([[115.0, 120.0], [229.0, 240.0]]));
    change(&mut stage, &beam, MatterChange::Stops(Stops::Most(3.5)));
    let ranges = |stage: &Stage| stage.history().world().angles().iter().map(|angle| angle.range).collect::<Vec<_>>();
    assert_eq!(ranges(&stage)[1], Some([2.0, 3.5]));
    assert!(matches!(ranges(&stage)[0], Some([least, most]) if (least - 2.0944).abs() < 1e-3 && most == 3.5));
    let refused = Order::Change { among: beam.clone(), change: MatterChange::Stops(Stops::Most(1.0)), goes_on: false };
    assert!(matches!(stage.obey(refused), Some(Note::Refused(why)) if why.contains("below the largest")));
    change(&mut stage, &beam, MatterChange::Stops(Stops::None));
    assert_eq!(ranges(&stage), [None, None]);
    change(&mut stage, &beam, MatterChange::RestAngle(2.0));
    let rest = matter(&mut stage, &beam).rest_angle.unwrap();
    assert_eq!((rest.same(), matter(&mut stage, &among(0..7)).rest_angle), (Some(2.0), Some(rest)));
    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "rest angle"));
}

#[test]
fn stops_that_were_taken_from_a_figure_come_back_as_they_were_and_push_nothing() {
    let text = r#"{"wobble": 1, "gravity": [0, 0], "bodies": [{"make": "ragdoll"}]}"#;
    let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
    let all = among(0..stage.history().world().point_count() as u32);
    let ranges = |stage: &Stage| stage.history().world().angles().iter().map(|angle| angle.range).collect::<Vec<_>>();
    let drawn = |stage: &Stage| crate::render::joints(stage.history().world());
    let (before, joints) = (ranges(&stage), drawn(&stage));
    assert!(before.len() > 8 && before.iter().all(Option::is_some) && !joints.is_empty());
    matter(&mut stage, &all);
    change(&mut stage, &all, MatterChange::Stops(Stops::None));
    assert!(ranges(&stage).iter().all(Option::is_none));
    assert_eq!(drawn(&stage), joints, "it is drawn as a figure still");
    let coming: Vec<_> = matter(&mut stage, &all).coming_stops.iter().map(|joint| Some(joint.range)).collect();
    let energy = stage.history().world().energy();
    change(&mut stage, &all, MatterChange::Stops(Stops::Some));
    let is_same = |a: &[Option<[f64; 2]>]| {
        let off = |(a, b): (&Option<[f64; 2]>, &Option<[f64; 2]>)| {
            (0..2).any(|k| (a.unwrap()[k] - b.unwrap()[k]).abs() > 1e-9)
        };
        a.len() == before.len() && !a.iter().zip(&before).any(off)
    };
    assert!(is_same(&ranges(&stage)) && is_same(&coming), "{before:?}, {coming:?}, {:?}", ranges(&stage));
    assert!((stage.history().world().energy() - energy).abs() < 1e-9);
}

#[test]
fn a_corner_of_a_net_that_is_selected_alone_gets_stops_alone() {
    let text = r#"{"wobble": 1, "gravity": [0, 0], "bodies": [{"make": "lattice", "columns": 5, "rows": 5, "spacing": 0.2,
        "material": {"kind": "spring", "stiffness": 100, "mass": 1}}], "angles": [{"points": [6, 7, 8], "stiffness": 1},
        {"points": [2, 7, 12], "stiffness": 1}, {"points": [7, 8, 9], "stiffness": 1}]}"#;
    let mut stage = stage_of(text);
    let (corner, net) = (among(7..8), among(0..25));
    assert_eq!([&corner, &net].map(|among| matter(&mut stage, among).joints), [[0, 2], [0, 3]]);
    assert_eq!(matter(&mut stage, &among(6..8)).joints, [0, 0], "of two points none is a corner");
    change(&mut stage, &corner, MatterChange::Stops(Stops::Some));
    let has =
        |stage: &Stage| stage.history().world().angles().iter().map(|angle| angle.range.is_some()).collect::<Vec<_>>();
    assert_eq!(has(&stage), [true, true, false]);
    change(&mut stage, &corner, MatterChange::Stops(Stops::Least(1.0)));
    let least = |k: usize| stage.history().world().angles()[k].range.map(|range| range[0]);
    assert_eq!([least(0), least(1)], [Some(1.0); 2]);
    change(&mut stage, &corner, MatterChange::Stops(Stops::None));
    assert_eq!(has(&stage), [false; 3]);
}

#[test]
fn stops_reach_to_where_a_joint_stands() {
    let text = KNEES.replace(r#""stiffness": 2}"#, r#""rest": 1.5}"#);
    let mut stage = Stage::new(Scene::parse(&text, "x.json").unwrap().into()).unwrap();
    change(&mut stage, &among(3..6), MatterChange::Stops(Stops::Some));
    let [least, most] = stage.history().world().angles()[0].range.unwrap();
    assert!((least - (1.5 - std::f64::consts::FRAC_PI_3)).abs() < 1e-9, "{least}");
    assert!((most - std::f64::consts::PI).abs() < 1e-9, "{most}: it is straight");
}

#[test]
fn selected_bonds_get_another_length_at_rest() {
    let mut stage = Stage::new(Scene::parse(KNEES, "x.json").unwrap().into()).unwrap();
    let one = Among { bonds: Some(vec![3]), ..among(4..6) };
    change(&mut stage, &one, MatterChange::RestLength(1.5));
    let lengths =
        |stage: &Stage| stage.history().world().bonds().iter().map(|bond| bond.rest_length).collect::<Vec<_>>();
    assert_eq!(lengths(&stage), [1.0, 1.0, 1.0, 1.5, 1.0]);
    assert_eq!(matter(&mut stage, &one).rest_length.unwrap().same(), Some(1.5));
    let beam = matter(&mut stage, &among(3..7)).rest_length.unwrap();
    assert_eq!((beam.least, beam.most, beam.same()), (1.0, 1.5, None));
    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "rest length"));
    assert_eq!(lengths(&stage), [1.0; 5]);
}

#[test]
fn muscles_stay_springs_as_their_body_gets_rigid() {
    for given in [MatterChange::Rigid, MatterChange::Preset(Preset::Steel)] {
        let mut stage = stage();
        let soft = among(3..12);
        let muscle = soft.bonds_of(stage.history().world())[0].0;
        let drive = DriveOrNone::This(DriveKeys { amplitude: Some(0.2), period: Some(1.0), ..DriveKeys::default() });
        let keys = SetKeys { bonds: Some(vec![muscle]), drive: Some(drive), ..SetKeys::default() };
        assert_eq!(stage.obey(Order::Give(vec![Do::Set(Box::new(keys))], Some("muscle"))), None);
        change(&mut stage, &soft, given);
        let bonds = soft.bonds_of(stage.history().world());
        let springs: Vec<u32> =
            bonds.iter().filter(|(_, bond)| bond.kind != BondKind::Rigid).map(|(number, _)| *number).collect();
        assert_eq!(springs, [muscle], "{given:?}");
    }
}

/// What turns about a hub with two motors, which push against a point that hangs on nothing.
const DRIVEN: &str = r#"{"wobble": 1, "points": {"position": [[-1, 0], [0, 0], [1, 0], [0, 1]], "pinned": [0, 1]},
    "bonds": [{"a": 1, "b": 2}, {"a": 1, "b": 3}, {"a": 2, "b": 3}],
    "angles": [{"points": [0, 1, 2], "drive": {"speed": -6, "torque": 10}},
      {"points": [0, 1, 3], "drive": {"speed": -6, "torque": 20, "key": "right", "rate": 2}}]}"#;

#[test]
fn motors_are_shown_by_their_hinges_and_changed_each_in_a_step_of_undo() {
    let (mut stage, wheel) = (stage_of(DRIVEN), among(1..4));
    let shown = |stage: &mut Stage| matter(stage, &wheel).motors.unwrap();
    let before = shown(&mut stage);
    assert_eq!((before.speed.same(), before.torque.same(), before.keys), (Some(-6.0), Some(30.0), Common::Mixed));
    assert_eq!(matter(&mut stage, &among(2..4)).motors, None, "its hub is not meant");
    let torques = |stage: &Stage| {
        let angles = stage.history().world().angles();
        let torque = |drive: Option<AngleDrive>| match drive {
            Some(AngleDrive::Motor { torque, .. }) => torque,
            _ => 0.0,
        };
        [0, 1].map(|k| torque(angles[k].drive))
    };
    let undo = |stage: &mut Stage| {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "motor"))
    };
    change(&mut stage, &wheel, MatterChange::Motor(MotorChange::Speed(4.0)));
    let faster = shown(&mut stage);
    assert_eq!((faster.speed.same(), faster.torque, faster.keys), (Some(4.0), before.torque, Common::Mixed));
    assert_eq!(torques(&stage), [10.0, 20.0]);
    undo(&mut stage);
    change(&mut stage, &wheel, MatterChange::Motor(MotorChange::Torque(60.0)));
    assert_eq!((shown(&mut stage).torque.same(), torques(&stage)), (Some(60.0), [30.0, 30.0]));
    assert_eq!(shown(&mut stage).keys, Common::Mixed, "each has its own still");
    undo(&mut stage);
    for (keys, held) in [
        ([Some(KeyName::Up), Some(KeyName::Down)], [Some(KeyName::Up), Some(KeyName::Down)]),
        ([Some(KeyName::Up), Some(KeyName::Up)], [Some(KeyName::Up), None]),
        ([None, Some(KeyName::Down)], [None, None]),
    ] {
        change(&mut stage, &wheel, MatterChange::Motor(MotorChange::Keys(keys[0], keys[1])));
        let now = shown(&mut stage);
        assert_eq!((now.keys, now.speed, now.torque), (Common::One(held), before.speed, before.torque));
        undo(&mut stage);
    }
    assert_eq!(shown(&mut stage), before);
}
