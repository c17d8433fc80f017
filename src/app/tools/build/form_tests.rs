//! Frames and planes, drawn out without a window.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use glam::DVec2;

use super::BuiltOf;
use super::tests::{Seen, at, hand, room};
use crate::app::action::Primitive;
use crate::app::matter::Preset;
use crate::app::player::{Order, Stage};
use crate::app::tools::marks::Role;
use crate::app::tools::tests::scope;
use crate::app::tools::{Deed, Hand, Mark};
use crate::sim::{BondKind, Obstacle};

fn drag(seen: &Seen, hand: &mut Hand, [from, to]: [[f64; 2]; 2]) -> Deed {
    assert!(hand.press(scope(seen), at(seen, from[0], from[1])).is_empty());
    hand.release(scope(seen), at(seen, to[0], to[1]))
}

fn given(seen: &Seen, deed: Deed) -> Stage {
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    assert_eq!(stage.obey(Order::Give(deed.commands, deed.edit)), None);
    stage
}

#[test]
fn a_frame_has_four_corners_where_it_was_drawn_and_both_diagonals_soft_or_rigid() {
    let seen = room();
    for (preset, is_soft) in [(Preset::Jelly, true), (Preset::Steel, false)] {
        let mut hand = hand(Primitive::Frame);
        hand.build_of(BuiltOf { filled: preset, ..BuiltOf::default() });
        let deed = drag(&seen, &mut hand, [[1.0, 2.0], [-1.0, 1.0]]);
        assert_eq!(deed.edit, Some("Frame"));
        let stage = given(&seen, deed);
        let world = stage.history().world();
        assert_eq!((world.point_count(), world.bonds().len()), (4, 6), "{preset:?}");
        let x = world.positions();
        for k in 0..4 {
            let off = [x.get(2 * k).abs() - 1.0, (x.get(2 * k + 1) - 1.5).abs() - 0.5];
            assert!(off.into_iter().all(|off| off.abs() < 1e-6), "{preset:?}: {off:?}");
        }
        assert!(world.bonds().iter().all(|bond| matches!(bond.kind, BondKind::Spring { .. }) == is_soft));
    }
}

/// The place and the normal of the one plane of a world.
fn plane(stage: &Stage) -> [DVec2; 2] {
    let all = stage.history().world().obstacles();
    let [(_, Obstacle::Plane { point, normal, .. })] = &all[..] else { panic!("{all:?}") };
    [point, normal].map(|of| DVec2::new(of[0], of[1]))
}

#[test]
fn a_plane_is_solid_at_the_right_hand_of_the_drag_and_is_undone() {
    let seen = room();
    for (way, free) in [([[-1.0, -1.0], [1.0, -1.0]], [0.0, 1.0]), ([[1.0, -1.0], [-1.0, -1.0]], [0.0, -1.0])] {
        let deed = drag(&seen, &mut hand(Primitive::Plane), way);
        assert_eq!(deed.edit, Some("Plane"));
        let mut stage = given(&seen, deed);
        let [point, normal] = plane(&stage);
        assert!((point.y + 1.0).abs() < 1e-9 && normal.distance(free.into()) < 1e-9, "{point} {normal}");
        stage.obey(Order::Undo(None));
        assert!(stage.history().world().obstacles().is_empty());
    }
}

#[test]
fn a_plane_bears_what_falls_beside_the_drag() {
    let seen = room();
    let mut stage = given(&seen, drag(&seen, &mut hand(Primitive::Plane), [[-5.0, -1.0], [-4.0, -1.0]]));
    // What is rigid does not bounce.
    let mut frames = hand(Primitive::Frame);
    frames.build_of(BuiltOf { filled: Preset::Steel, ..BuiltOf::default() });
    let body = drag(&seen, &mut frames, [[3.0, 0.0], [4.0, 1.0]]);
    assert_eq!(stage.obey(Order::Give(body.commands, body.edit)), None);
    for _ in 0..120 {
        stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false });
    }
    let x = stage.history().world().positions();
    let lowest = (0..4).map(|k| x.get(2 * k + 1)).fold(f64::INFINITY, f64::min);
    assert!((lowest + 1.0).abs() < 0.05, "{lowest}");
}

#[test]
fn a_plane_is_hatched_on_its_solid_side_all_across_the_view() {
    let seen = room();
    let mut hand = hand(Primitive::Plane);
    hand.press(scope(&seen), at(&seen, -1.0, -1.0));
    let marks = hand.marks(scope(&seen), Some(at(&seen, 1.0, -1.0)));
    let surface = at(&seen, 0.0, -1.0).y;
    let lines: Vec<[DVec2; 2]> = marks
        .iter()
        .filter_map(|mark| match mark {
            Mark::Line(Role::Come, from, to, _) => Some([*from, *to]),
            _ => None,
        })
        .collect();
    assert!(lines.len() > 40, "{}", lines.len());
    let [from, to] = lines[0];
    assert!((from.y - surface).abs() < 1e-6 && (to.x - from.x) >= 1000.0 - 1e-6, "{from} {to}");
    let is_below = |[foot, end]: &[DVec2; 2]| (foot.y - surface).abs() < 1e-6 && end.y > surface + 5.0;
    assert!(lines[1..].iter().all(is_below), "pixels count downwards");
}
