//! What the brush takes from bodies, and what it keeps from scene to scene.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use super::tests::{pixel, scope, shown};
use super::{Brush, Hand};
use crate::app::action::Tool;
use crate::app::player::Shown;
use crate::render::Camera;
use crate::scene::Scene;

fn opened() -> (Shown, Camera, Scene) {
    let text = r#"{"wobble": 1, "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5, "origin": [0, 0],
        "material": {"kind": "spring", "stiffness": 300, "damping": 3, "mass": 4, "break_strain": 0.25}},
        {"make": "lattice", "columns": 2, "rows": 2, "spacing": 0.5, "origin": [2, 0], "material": {"kind": "rigid"}}],
        "view": {"center": [1, 0.5], "height": 4}}"#;
    shown(Scene::parse(text, "x.json").unwrap())
}

#[test]
fn with_alt_a_click_takes_the_numbers_of_what_lies_there_and_paints_nothing() {
    let seen = opened();
    let mut hand = Hand::default();
    hand.take(Tool::Paint);
    hand.hold([false, true]);
    let middle = 0.5 * (pixel(&seen, 0) + pixel(&seen, 1));
    let own = seen.0.scenery.bonds.get(scope(&seen).bond(middle).unwrap().0);
    let deed = hand.press(scope(&seen), middle);
    assert!(deed.painted.is_none() && deed.is_empty() && !hand.is_busy());
    assert!(deed.words.unwrap().contains("4.00 kg/m²"));
    let numbers = hand.brush().numbers;
    let crate::sim::BondKind::Spring { stiffness, damping } = own.kind else { unreachable!("springs") };
    assert_eq!((numbers.stiffness.value, numbers.damping.value, numbers.breaks.value), (stiffness, damping, 0.25));
    assert!(numbers.stiffness.is_on && numbers.damping.is_on && numbers.density.is_on && numbers.breaks.is_on);
    assert!((numbers.density.value - 4.0).abs() < 1e-9 && !numbers.friction.is_on);
    let before = hand.brush();
    let rigid = 0.5 * (pixel(&seen, 9) + pixel(&seen, 10));
    assert!(hand.press(scope(&seen), rigid).words.unwrap().contains("no body of springs"));
    assert_eq!(hand.brush(), before);
}

#[test]
fn in_another_scene_the_brush_keeps_its_size_alone() {
    let mut hand = Hand::default();
    let mut brush = Brush { radius: 40.0, ..Brush::default() };
    brush.numbers.stiffness.is_on = true;
    brush.numbers.density.value = 77.0;
    hand.set_brush(brush);
    hand.renew_brush();
    assert_eq!(hand.brush(), Brush { radius: 40.0, ..Brush::default() });
}
