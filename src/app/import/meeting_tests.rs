//! Bodies from pictures and drawings meet what is there, and whoever adds one is told where they do not.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::sync::Arc;

use super::Import;
use crate::app::player::{Note, Order, Stage, too_many_to_meet};
use crate::history::{Do, MoveKeys, SetKeys, VectorOrEach};
use crate::picture::Picture;
use crate::scene::{Scene, Vector};
use crate::sim::Dynamics;

/// A soft disc about the origin, in free space.
const DISC: &str = r#"{ "wobble": 1, "name": "disc", "bodies": [{ "make": "disc", "radius": 0.5, "spacing": 0.2,
    "material": { "kind": "spring", "stiffness": 4000, "damping": 4, "mass": 1 } }] }"#;

/// What of the plane is in view `[m]`.
const SEEN: [[f64; 2]; 2] = [[-6.0, -4.0], [6.0, 4.0]];

/// A round blot of ink.
fn blot() -> Picture {
    let side = 60;
    let ink = |x: u32, y: u32| (f64::from(x) - 29.5).hypot(f64::from(y) - 29.5) < 26.0;
    let pixels = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    let rgba = pixels.flat_map(|(x, y)| if ink(x, y) { [40, 90, 200, 255] } else { [0; 4] }).collect();
    Picture { width: side, height: side, rgba }
}

fn picture() -> Import {
    Import::of_picture("blot".to_owned(), Arc::new(blot()), || ())
}

fn stage(text: &str) -> Stage {
    Stage::new(Scene::parse(text, "test.json").unwrap().into()).unwrap()
}

fn add(stage: &mut Stage, import: &Import) -> Option<Note> {
    stage.obey(Order::Add(Box::new(import.adder(SEEN))))
}

/// The middle of points along x `[m]`.
fn middle(world: &dyn Dynamics, points: std::ops::Range<usize>) -> f64 {
    let count = points.len() as f64;
    points.map(|point| world.positions().get(2 * point)).sum::<f64>() / count
}

/// Puts what was added to the left of the disc and throws it there. Returns how far right of the disc it is a second later `[m]`.
pub(super) fn thrown_at_the_disc(import: &Import, changes: Vec<Do>) -> f64 {
    let mut stage = stage(DISC);
    let count = stage.history().world().point_count();
    assert_eq!(add(&mut stage, import), Some(Note::Added(None)));
    let world = stage.history().world();
    assert!(world.contact().is_some(), "whoever adds a body wants it to lie on the others");
    let all = world.point_count();
    let added: Vec<u32> = (count as u32..all as u32).collect();
    let [x, y] = [0, 1].map(|k| {
        let places = added.iter().map(|&point| world.positions().get(2 * point as usize + k));
        places.sum::<f64>() / added.len() as f64
    });
    let to_the_left =
        MoveKeys { points: added.clone(), by: Some(Vector::Plane([-2.5 - x, -y])), ..MoveKeys::default() };
    let thrown = SetKeys {
        points: Some(added),
        velocity: Some(VectorOrEach::One(Vector::Plane([4.0, 0.0]))),
        ..SetKeys::default()
    };
    let mut commands = vec![Do::Move(Box::new(to_the_left)), Do::Set(Box::new(thrown))];
    commands.extend(changes);
    assert_eq!(stage.obey(Order::Give(commands, None)), None);
    (0..60).for_each(|_| _ = stage.obey(Order::Step(None)));
    let world = stage.history().world();
    middle(world, count..all) - middle(world, 0..count)
}

#[test]
fn a_picture_meets_what_is_there() {
    let behind = thrown_at_the_disc(&picture(), Vec::new());
    assert!(behind < -0.5, "it pushes the disc before it: {behind}");
    let off = SetKeys { contact: Some(crate::scene::Meeting::Is(false)), ..SetKeys::default() };
    let through = thrown_at_the_disc(&picture(), vec![Do::Set(Box::new(off))]);
    assert!(through > 0.5, "without contact it goes through: {through}");
}

#[test]
fn a_scene_that_knows_no_contact_gets_the_body_and_says_why_it_meets_nothing() {
    let text = DISC.replacen("\"bodies\"", "\"method\": { \"solver\": \"rk4\" }, \"bodies\"", 1);
    let mut stage = stage(&text);
    let Some(Note::Added(Some(why))) = add(&mut stage, &picture()) else { panic!("nothing is said") };
    assert!(why.contains("rk4 knows no contact"), "{why}");
    assert!(stage.history().world().contact().is_none());
}

#[test]
fn in_a_scene_of_too_many_bonds_it_is_said_that_nothing_meets() {
    let text = r#"{ "wobble": 1, "name": "sheet", "bodies": [{ "make": "lattice", "columns": 102, "rows": 102,
        "spacing": 0.01, "material": { "kind": "spring", "stiffness": 100, "damping": 0, "mass": 0.01 } }] }"#;
    let mut stage = stage(text);
    assert_eq!(add(&mut stage, &picture()), Some(Note::Added(Some(too_many_to_meet()))));
}
