//! What is selected is flipped: left and right, or up and down.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::f64::consts::TAU;

use glam::DVec2;

use super::handles::{Frame, Handle};
use super::tests::{scope, shown};
use super::{Hand, Mark};
use crate::app::action::Tool;
use crate::app::player::{Note, Order, Stage};
use crate::history::{Do, Factors, MoveKeys};
use crate::scene::Scene;
use crate::sim::AngleDrive;

/// A soft box that flies, an arm with stops and a motor, and an obstacle without symmetry.
const SCENE: &str = r#"{"wobble": 1, "gravity": [0, 0], "contact": true, "view": {"center": [2, 0], "height": 12},
    "points": {"position": [[3, 0], [4, 0], [4.5, 1]], "velocity": [[0, 0], [0, 0], [0.5, -0.2]], "mass": 1},
    "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}],
    "angles": [{"points": [0, 1, 2], "min": 3.5, "max": 5, "drive": {"speed": -2, "torque": 1}}],
    "obstacles": [{"polygon": [[[6, -2], [7, -2], [6, 1]]]}],
    "bodies": [{"make": "lattice", "columns": 4, "rows": 3, "spacing": 0.5, "velocity": [1, 0.3],
        "material": {"kind": "spring", "stiffness": 300, "damping": 1, "mass": 2}}]}"#;

const POINTS: usize = 15;

fn place(stage: &Stage, point: usize) -> DVec2 {
    let x = stage.history().world().positions();
    DVec2::new(x.get(2 * point), x.get(2 * point + 1))
}

#[test]
fn a_flip_mirrors_bodies_obstacles_velocities_stops_and_motors_and_so_they_go_on() {
    let mut seen = shown(Scene::parse(SCENE, "x.json").unwrap());
    let mut hand = Hand::default();
    hand.select_all(scope(&seen));
    for axis in [0, 1] {
        let [mut plain, mut flipped] = [0, 1].map(|_| Stage::new(seen.2.clone().into()).unwrap());
        let middle = Frame::of(scope(&seen), &hand.chosen(scope(&seen)).unwrap()).unwrap().middle();
        let mirror = |x: DVec2| if axis == 0 { DVec2::new(-x.x, x.y) } else { DVec2::new(x.x, -x.y) };
        let there = |stage: &Stage, point: usize| middle + mirror(place(stage, point) - middle);
        let deed = hand.flip(scope(&seen), axis);
        assert_eq!((deed.edit, deed.commands.len()), (Some("flip"), 1), "masses and springs stay: {deed:?}");
        assert_eq!(flipped.obey(Order::Give(deed.commands, deed.edit)), None);
        flipped.show(&mut seen.0);
        let world = flipped.history().world();
        let [before, after] = [&plain, &flipped].map(|stage| stage.history().world().angles()[0]);
        assert_eq!(after.range.unwrap(), before.range.map(|[least, most]| [TAU - most, TAU - least]).unwrap());
        assert!(matches!(after.drive, Some(AngleDrive::Motor { speed: 2.0, torque: 1.0, .. })), "{after:?}");
        assert!(!world.triangles().is_empty());
        for &[a, b, c] in world.triangles() {
            let [a, b, c] = [a, b, c].map(|corner| place(&flipped, corner.index()));
            assert!((b - a).perp_dot(c - a) > 0.0, "its corners are anticlockwise");
        }
        let corner = DVec2::from(seen.0.scenery.polygons[0].loops[0][2]);
        assert!(corner.distance(middle + mirror(DVec2::new(6.0, 1.0) - middle)) < 1e-9, "{corner}");
        // A world in a mirror goes the ways of the world.
        for frame in 0..30 {
            for point in 0..POINTS {
                let off = place(&flipped, point).distance(there(&plain, point));
                assert!(off < 1e-4, "axis {axis}, frame {frame}, point {point}: {off} m");
            }
            for stage in [&mut plain, &mut flipped] {
                stage.obey(Order::Step(None));
            }
        }
        // Undo brings all back, and the next one begins with it.
        assert!(matches!(flipped.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "flip"));
        flipped.show(&mut seen.0);
        assert_eq!(flipped.history().world().angles()[0], before);
    }
}

#[test]
fn a_torque_on_what_is_flipped_turns_it_the_other_way_and_one_on_a_part_of_it_as_before() {
    let text = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0], [1, 1], [5, 0]], "mass": 1},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 0, "b": 2}],
        "forces": [{"points": [0, 1, 2], "force": [0.5, 0], "torque": 0.7}, {"points": [2, 3], "torque": 0.2}]}"#;
    let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
    let torques = |stage: &Stage| -> Vec<(f64, f64)> {
        stage.history().world().forces().iter().map(|force| (force.torque, force.force[0])).collect()
    };
    let flip = |scale: [f64; 2]| {
        let points = vec![0, 1, 2];
        Order::Give(
            vec![Do::Move(Box::new(MoveKeys { points, scale: Some(Factors::Each(scale)), ..Default::default() }))],
            Some("flip"),
        )
    };
    assert_eq!(stage.obey(flip([-1.0, 1.0])), None);
    assert_eq!(torques(&stage), [(-0.7, 0.5), (0.2, 0.0)]);
    assert_eq!(stage.obey(flip([-1.0, -1.0])), None);
    assert_eq!(torques(&stage), [(-0.7, 0.5), (0.2, 0.0)], "half a turn is no mirror");
    let angle = |stage: &Stage| (place(stage, 1) - place(stage, 0)).to_angle();
    let before = angle(&stage);
    stage.obey(Order::Step(None));
    let turn = (before - angle(&stage)).rem_euclid(TAU);
    assert!(turn > 0.0 && turn < 0.5, "it goes clockwise: {turn}");
    stage.obey(Order::Undo(None));
    stage.obey(Order::Undo(None));
    assert_eq!(torques(&stage), [(0.7, 0.5), (0.2, 0.0)]);
}

#[test]
fn a_corner_that_is_dragged_past_the_other_side_leaves_a_tenth_and_says_so() {
    let seen = shown(Scene::parse(SCENE, "x.json").unwrap());
    let mut hand = Hand::default();
    hand.take(Tool::Select);
    hand.select_all(scope(&seen));
    let frame = Frame::of(scope(&seen), &hand.chosen(scope(&seen)).unwrap()).unwrap();
    let handles = frame.handles(scope(&seen));
    let corner = handles.iter().find(|(handle, _)| *handle == Handle::Corner(2)).unwrap().1;
    hand.press(scope(&seen), corner);
    let to = corner - DVec2::new(900.0, 0.0);
    let says =
        |mark: &Mark| matches!(mark, Mark::Words(_, words) if words.contains("0.10 ×") && words.contains("Flip"));
    let marks = hand.marks(scope(&seen), Some(to));
    assert!(marks.iter().any(says), "{marks:?}");
    let deed = hand.release(scope(&seen), to);
    let [Do::Move(keys), ..] = &deed.commands[..] else { panic!("{deed:?}") };
    assert!(matches!(keys.scale, Some(Factors::Each([x, _])) if x == 0.1), "{keys:?}");
}
