//! Presses on cloths and nets that tear.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::{DVec2, DVec3};

use super::tests::{grabbed, opened, pixel, scope};
use super::{Deed, Hand, Mark, Role};
use crate::app::player::{Order, Shown, Stage};
use crate::history::Do;
use crate::render::Camera;
use crate::scene::Scene;
use crate::sim::{PointId, Reach};

/// The points about one, of a cloth so many points wide: three by three.
fn around(point: u32, wide: u32) -> Vec<PointId> {
    let rows = [point - wide, point, point + wide];
    rows.into_iter().flat_map(|middle| middle - 1..=middle + 1).map(PointId).collect()
}

fn is_patch(deed: &Deed) -> bool {
    deed.commands.iter().any(|command| matches!(command, Do::Grab(Reach::Patch { .. })))
}

#[test]
fn a_press_on_a_cloth_or_a_net_that_tears_takes_a_patch_and_shows_it_before() {
    // A net whose meshes have one diagonal each takes those corners only that a bond or the reach brings.
    for (name, point, wide) in [("cloth-space", 60, 11), ("tearable-net", 187, 25)] {
        let opened = opened(name);
        let mut hand = Hand::default();
        let at = pixel(&opened, point) + DVec2::new(3.0, 2.0);
        let marks = hand.marks(scope(&opened), Some(at));
        let deed = hand.press(scope(&opened), at);
        let points = grabbed(&deed);
        let near = around(point as u32, wide);
        assert!(is_patch(&deed) && points.len() >= 7, "{name}: {points:?}");
        assert!(points.contains(&PointId(point as u32)), "{name}: {points:?}");
        let far = |point: &PointId| pixel(&opened, point.index()).distance(at);
        assert!(points.iter().all(|point| near.contains(point) || far(point) <= 28.0), "{name}: {points:?}");
        let lines = marks.iter().filter(|mark| matches!(mark, Mark::Line(Role::Lead, ..))).count();
        assert!(lines >= 8, "{name}: the bonds of the patch are shown: {marks:?}");
        // The middle stays where it is below the pointer.
        let (shown, camera, _) = &opened;
        let to = hand.led_to(camera.cursor(at.to_array()));
        let middle = scope(&opened).middle(&points);
        let from = middle - DVec3::from(to.origin);
        let across = if shown.dimensions == 2 { from } else { from.reject_from(DVec3::from(to.direction)) };
        assert!(across.length() < 1e-6, "{name}: {across}");
    }
}

#[test]
fn a_patch_hangs_together_has_no_pins_and_is_of_nothing_solid() {
    let opened_cloth = opened("cloth-space");
    // The second row: above it are pins.
    let at = pixel(&opened_cloth, 16);
    let points = grabbed(&Hand::default().press(scope(&opened_cloth), at));
    assert!(points.contains(&PointId(16)) && points.iter().all(|point| point.0 >= 11), "{points:?}");
    // Two nets that lie over each other, and no bond from one to the other.
    let net = |x: f64| {
        format!(
            r#"{{"make": "cloth", "columns": 5, "rows": 5, "spacing": 0.5, "origin": [{x}, 1],
            "material": {{"kind": "spring", "stiffness": 60, "point_mass": 0.1, "break_strain": 0.5}}}}"#
        )
    };
    let text = format!(
        r#"{{"wobble": 1, "view": {{"center": [0, 0], "height": 8}}, "bodies": [{}, {}, {{"make": "lattice", "columns": 4,
        "rows": 4, "spacing": 0.3, "origin": [2.5, -2], "material": {{"kind": "spring", "stiffness": 2000, "mass": 2, "break_strain": 0.5}}}}]}}"#,
        net(-1.0),
        net(-0.95)
    );
    let nets = super::tests::shown(Scene::parse(&text, "x.json").unwrap());
    let points = grabbed(&Hand::default().press(scope(&nets), pixel(&nets, 12)));
    assert!(points.len() > 4 && points.iter().all(|point| point.0 < 25), "{points:?}");
    let deed = Hand::default().press(scope(&nets), pixel(&nets, 55));
    assert!(!grabbed(&deed).is_empty() && !is_patch(&deed), "{deed:?}");
}

/// Plays a drag of the hand in a scene from a point on, over so many pixels, and returns how many bonds it tore and how far the point is then from
/// where the pointer is `[px]`.
fn dragged(name: &str, point: usize, by: DVec2) -> (u64, f64) {
    let scene = opened(name).2;
    let mut stage = Stage::new(scene.clone().into()).unwrap();
    let mut seen: (Shown, Camera, Scene) = opened(name);
    let mut hand = Hand::default();
    hand.set_strength(scene.mouse_force().map(|force| force.strength));
    let at = pixel(&seen, point);
    let deed = hand.press(scope(&seen), at);
    let to = Some(hand.led_to(seen.1.cursor(at.to_array())));
    let commands = std::iter::once(Do::Cursor { to, by: None }).chain(deed.commands).collect();
    assert_eq!(stage.obey(Order::Give(commands, None)), None);
    for frame in 1..=90 {
        let share = (f64::from(frame) / 40.0).min(1.0);
        let cursor = Some(hand.led_to(seen.1.cursor((at + share * by).to_array())));
        drop(stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor, back: false }));
        stage.show(&mut seen.0);
    }
    (stage.history().world().counters().bonds_torn, pixel(&seen, point).distance(at + by))
}

#[test]
fn a_cloth_is_led_by_its_patch_and_torn_by_a_hand_that_is_far_from_it_alone() {
    let (torn, off) = dragged("cloth-space", 71, DVec2::new(0.0, -60.0));
    assert!(torn == 0 && off < 30.0, "{torn} bonds, {off} px off");
    let (torn, off) = dragged("cloth-space", 71, DVec2::new(0.0, 110.0));
    assert!(torn == 0, "pulled down farther than it goes: {torn} bonds, {off} px off");
    let (torn, _) = dragged("cloth-space", 71, DVec2::new(0.0, 600.0));
    assert!(torn > 0, "a hand that pulls hard tears it");
}
