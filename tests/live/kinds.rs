//! All kinds of bodies meet each other: pictures with holes and what lies in them, brush strokes, rims, pieces of what was cut or torn.

use serde_json::{Value, json};
use wobble::sim::{Command, Cursor, Dynamics};

use super::tangle::faults;
use super::{disc, soft, world};
use crate::common::physics::middle;

/// A scene on a floor between walls.
fn room(bodies: &Value) -> Value {
    json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "drag_rate": 0.3, "bodies": bodies,
        "bounds": {"min": [-2, 0], "max": [2, 20], "friction": 0.5}})
}

fn picture(name: &str, height: f64, origin: [f64; 2]) -> Value {
    json!({"make": "picture", "file": format!("pictures/{name}.png"), "height": height, "spacing": 0.1, "origin": origin,
        "material": {"kind": "spring", "young": 20000, "mass": 2}})
}

fn until(world: &mut dyn Dynamics, t: f64) {
    while world.time() < t - 1e-9 {
        world.step();
    }
}

/// The bodies of a world have met and are whole.
fn assert_apart(what: &str, world: &dyn Dynamics) {
    assert!(world.counters().contacts > 0, "{what}: nothing met anything");
    assert_eq!(faults(world), [0, 0], "{what}: triangles inside out, crossings");
}

#[test]
fn what_lies_in_a_hole_stays_in_it_as_the_ring_rolls_and_bounces() {
    let mut ring = picture("ring", 2.4, [0.0, 1.6]);
    ring["spin"] = json!(-3);
    ring["velocity"] = json!([1.5, 0]);
    let mut world = world(&room(&json!([ring, disc([0.0, 1.6], [0.0; 2])])));
    let all = world.point_count();
    let first = all - super::world(&room(&json!([disc([0.0; 2], [0.0; 2])]))).point_count();
    for t in [0.5, 1.0, 2.0, 4.0] {
        until(&mut *world, t);
        assert_apart("ring", &*world);
        let [ring, disc] = [middle(&*world, 0..first), middle(&*world, first..all)];
        let apart = (ring[0] - disc[0]).hypot(ring[1] - disc[1]);
        assert!(apart < 0.75, "at {t} s the disc is {apart} m from the middle of the ring");
    }
}

#[test]
fn a_brush_stroke_a_rim_and_a_letter_fall_on_each_other() {
    let rim = json!({"make": "rim", "radius": 0.6, "inner_radius": 0.45, "sectors": 24, "origin": [-0.3, 5.2],
        "bracing": ["outer", "inner", "spoke", "rising", "falling"], "material": soft()});
    let bodies = json!([
        picture("brush", 1.4, [0.0, 0.9]),
        picture("letter", 1.2, [0.3, 2.8]),
        rim,
        disc([0.2, 6.6], [0.0, -5.0])
    ]);
    let mut world = world(&room(&bodies));
    until(&mut *world, 5.0);
    assert_apart("heap of all kinds", &*world);
}

#[test]
fn pieces_of_what_is_cut_in_flight_lie_on_each_other() {
    let slab = json!({"make": "lattice", "columns": 13, "rows": 7, "spacing": 0.1, "origin": [-0.6, 0.6],
        "material": {"kind": "spring", "stiffness": 3000, "damping": 0.3, "mass": 1}});
    let mut world = world(&room(&json!([slab])));
    until(&mut *world, 0.1);
    // Level, between two rows: the upper piece comes to lie on the lower one.
    let y = middle(&*world, 0..world.point_count())[1] + 0.05;
    let cut = world.apply(&Command::Cut { from: Cursor::at([-2.0, y]), to: Cursor::at([2.0, y]) }).unwrap();
    assert!(cut.is_something);
    until(&mut *world, 3.0);
    assert_apart("slab in two", &*world);
    let [low, high] = [middle(&*world, 0..52), middle(&*world, 52..91)];
    assert!(high[1] - low[1] > 0.25, "the pieces keep apart: {low:?} {high:?}");
}

#[test]
fn pieces_of_what_tears_meet() {
    let brittle = json!({"make": "disc", "radius": 0.5, "spacing": 0.1, "origin": [0.1, 1.4], "velocity": [0, -9],
        "material": {"kind": "spring", "stiffness": 3000, "damping": 0.2, "mass": 1, "break_strain": 0.1}});
    let mut world = world(&room(&json!([brittle, disc([0.0, 0.3], [0.0; 2])])));
    let whole = world.bonds().iter().count();
    until(&mut *world, 4.0);
    assert!(world.bonds().iter().count() < whole, "it tears");
    assert_apart("torn disc", &*world);
}
