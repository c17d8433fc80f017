//! What edits warn of is told once, where it was done.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use super::{Note, Order, Stage};
use crate::app::matter::{Among, Fit, Placing};
use crate::app::tools::PinWay;
use crate::history::{Do, MoveKeys};
use crate::scene::{AddKeys, BodyKeys, BondKeys, KindName, MakerName, MassKeys, Material, PointKeys, Scene, Vector};
use crate::sim::PointId;

const BOX: &str = r#"{"wobble": 1, "contact": true, "bounds": {"min": [-5, 0], "max": [5, 5]},
    "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5, "origin": [0, 1],
        "material": {"kind": "spring", "stiffness": 300, "mass": 4}}]}"#;
const ROPE: &str =
    r#"{"wobble": 1, "bodies": [{"make": "rope", "count": 5, "to": [1.8, 0], "slack": 0.11, "pinned": [0, 4]}]}"#;

fn stage(text: &str) -> Stage {
    Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap()
}

fn warned(stage: &mut Stage) -> Vec<String> {
    match stage.take_warnings() {
        Some(Note::Warned(lines)) => lines,
        None => Vec::new(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_body_that_is_moved_into_a_wall_says_so_once() {
    let mut stage = stage(BOX);
    assert_eq!(warned(&mut stage), [""; 0]);
    let keys = MoveKeys { points: (0..9).collect(), by: Some(Vector::Plane([0.0, -1.3])), ..MoveKeys::default() };
    assert_eq!(stage.obey(Order::Give(vec![Do::Move(Box::new(keys))], Some("move"))), None);
    let lines = warned(&mut stage);
    assert!(lines.len() == 1 && lines[0].contains("lay inside a wall:"), "{lines:?}");
    assert_eq!(warned(&mut stage), [""; 0], "told already");
    for order in [Order::Undo(None), Order::Redo(None), Order::Reset] {
        stage.obey(order);
        assert_eq!(warned(&mut stage), [""; 0], "nothing of it is new");
    }
}

#[test]
fn what_a_number_puts_aside_is_not_told_of_twice() {
    // Its middle comes to the floor, half of it below, but for the lift, which lacks a millimetre.
    let put = |stage: &mut Stage, lift: [f64; 3]| {
        let among = Among { points: (0..9).map(PointId).collect(), ..Among::default() };
        let fit = Fit { lift, ..Fit::default() };
        stage.obey(Order::Place { among, fit, placing: Placing::At(1, 0.0), goes_on: false });
        warned(stage)
    };
    let [mut aside, mut alone] = [stage(BOX), stage(BOX)];
    for stage in [&mut aside, &mut alone] {
        assert_eq!(warned(stage), [""; 0]);
    }
    assert_eq!(put(&mut aside, [0.0, 0.499, 0.0]), [""; 0], "it was said where it was put");
    let lines = put(&mut alone, [0.0; 3]);
    assert!(lines.len() == 1 && lines[0].contains("lay inside a wall:"), "{lines:?}");
    // The next edit is told of as before.
    let keys = MoveKeys { points: (0..9).collect(), by: Some(Vector::Plane([0.0, -0.3])), ..MoveKeys::default() };
    aside.obey(Order::Give(vec![Do::Move(Box::new(keys))], Some("move")));
    let lines = warned(&mut aside);
    assert!(lines.len() == 1 && lines[0].contains("lay inside a wall:"), "{lines:?}");
}

#[test]
fn a_pin_that_is_led_further_than_bonds_reach_says_how_far() {
    let mut stage = stage(ROPE);
    let pin = *stage.history().world().pinned().last().unwrap();
    let mut lead = |x: f64| {
        stage.obey(Order::LeadPins(PinWay { pins: vec![(pin, [x, 0.0, 0.0])], goes_on: false, follows: false }));
        warned(&mut stage)
    };
    assert_eq!(pin, PointId(4));
    assert_eq!(lead(1.9), [""; 0], "within its reach");
    let lines = lead(2.8);
    assert!(lines.len() == 1 && lines[0].contains("further apart than the bonds"), "{lines:?}");
}

#[test]
fn a_crowd_in_one_place_that_comes_by_an_edit_is_told_once() {
    let mut stage = stage(r#"{"wobble": 1, "gravity": [0, 0], "contact": true, "points": {"position": [[9, 9]]}}"#);
    let tells = |lines: &[String]| lines.iter().filter(|line| line.contains("points lie in one place")).count();
    let mut rope = |count: u32| {
        let first = stage.history().world().point_count() as u32;
        let bond = |k: u32| BondKeys { kind: Some(KindName::Spring), ..BondKeys::new(first + k, first + k + 1) };
        let points = PointKeys {
            position: vec![Vector::Plane([1.0, 2.0]); count as usize],
            mass: Some(MassKeys::Same(1.0)),
            velocity: None,
            pinned: (first..first + count).collect(),
        };
        let bonds = (0..count - 1).map(|k| BondKeys { rest: Some(0.01), stiffness: Some(1.0), ..bond(k) }).collect();
        let keys = AddKeys { points: Some(points), bonds, ..AddKeys::default() };
        let note = stage.obey(Order::Give(vec![Do::Add(Box::new(keys))], Some("paste")));
        assert_eq!(note, None);
        tells(&warned(&mut stage))
    };
    assert_eq!([rope(1_600), rope(1_600), rope(1_600)], [0, 1, 0], "with the second rope there are too many");
    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(..))));
    assert_eq!(tells(&warned(&mut stage)), 0);
}

#[test]
fn bodies_in_space_that_pass_each_other_are_told_of_as_the_second_one_comes() {
    let scene = r#"{"wobble": 1, "dimensions": 3, "gravity": [0, 0, 0], "contact": true, "bodies": [
        {"make": "rope", "count": 5, "to": [1, 0, 0], "material": {"kind": "spring", "stiffness": 100, "mass": 1}}]}"#;
    let mut stage = stage(scene);
    assert_eq!(warned(&mut stage), [""; 0], "one passes nothing");
    let mut rope = |high: f64| {
        let body = BodyKeys {
            make: MakerName::Rope,
            count: Some(5),
            to: Some(Vector::Space([1.0, 0.0, 0.0])),
            origin: Some(Vector::Space([0.0, high, 0.0])),
            material: Some(Material { kind: Some(KindName::Spring), stiffness: Some(100.0), ..Material::default() }),
            ..BodyKeys::default()
        };
        let keys = AddKeys { bodies: vec![body], ..AddKeys::default() };
        assert_eq!(stage.obey(Order::Give(vec![Do::Add(Box::new(keys))], Some("build"))), None);
        warned(&mut stage)
    };
    let lines = rope(1.0);
    assert!(lines.len() == 1 && lines[0].contains("pass each other"), "{lines:?}");
    assert_eq!(rope(2.0), [""; 0], "it is known");
}

#[test]
fn every_scene_of_the_gallery_opens_without_a_warning() {
    // The largest takes too long for a test; it has neither contact nor obstacles.
    for entry in crate::scene::gallery().iter().filter(|entry| entry.name != "million-cloth") {
        let mut stage = Stage::new(entry.scene().unwrap().into()).unwrap();
        let mut shown = super::Shown::default();
        stage.show(&mut shown);
        assert_eq!(shown.scenery.warnings, [""; 0], "{}", entry.name);
        assert_eq!(warned(&mut stage), [""; 0], "{}", entry.name);
    }
}
