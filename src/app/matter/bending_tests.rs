//! Bending that is given to what has none, and set and taken away.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use super::tests::{SCENE, among, change, matter, stage, stage_of};
use super::{Among, MatterChange};
use crate::app::player::{Note, Order, Stage};
use crate::sim::PointId;

/// A rope along x that its first two points clamp: 1 m of it, and 1 kg, stand out. It was built without bending.
const CLAMPED: &str = r#"{"wobble": 1, "gravity": [0, -0.1], "drag_rate": 8, "bodies": [{"make": "rope", "count": 12,
    "spacing": 0.1, "origin": [-0.1, 0], "pinned": [0, 1], "material": {"mass": 1.1}}]}"#;

/// The bits of all places.
fn bits(stage: &Stage) -> Vec<u64> {
    let world = stage.history().world();
    (0..2 * world.point_count()).map(|k| world.positions().get(k).to_bits()).collect()
}

/// How far the end of the rope of [`CLAMPED`] is below its beginning after 5 s `[m]`.
fn droop(stage: &mut Stage) -> f64 {
    while stage.history().world().time() < 5.0 {
        stage.obey(Order::Step(None));
    }
    -stage.history().world().positions().get(2 * 11 + 1)
}

#[test]
fn a_rope_that_gets_bending_droops_as_a_clamped_beam_does_and_undo_takes_it_away_to_the_bit() {
    let (mut stage, rope) = (stage_of(CLAMPED), among(0..12));
    let (before, at_first) = (matter(&mut stage, &rope), bits(&stage));
    assert_eq!(before.bending.unwrap().same(), Some(0.0), "it could bend");
    change(&mut stage, &rope, MatterChange::Bending(2.0));
    assert_eq!(stage.history().world().angles().len(), 10);
    assert_eq!(bits(&stage), at_first, "nothing leaps");
    let shown = matter(&mut stage, &rope).bending.unwrap();
    assert!((shown.same().unwrap() - 2.0).abs() < 1e-6, "{shown:?}");
    // w L^4/(8 E I), with w = 0.1 N/m; the clamp gives way as half a piece in front of it would.
    let expected = 0.1 * 1.05_f64.powi(4) / (8.0 * 2.0);
    let stiff = droop(&mut stage);
    assert!((stiff / expected - 1.0).abs() < 0.03, "{stiff} m, {expected} m by the closed form");

    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "bending"));
    assert_eq!((matter(&mut stage, &rope), bits(&stage)), (before, at_first));
    assert!(stage.history().world().angles().is_empty());
    let (mut other, limp) = (stage_of(CLAMPED), droop(&mut stage));
    assert!(limp > 4.0 * stiff, "{limp} m without it");
    assert_eq!((droop(&mut other), bits(&other)), (limp, bits(&stage)));
}

#[test]
fn bending_comes_by_the_law_of_files_along_skins_and_chains_and_is_set_and_taken_away_in_one_unit() {
    let (mut stage, soft) = (stage(), among(3..12));
    let angles = |stage: &Stage| stage.history().world().angles().to_vec();
    let shown = |stage: &mut Stage, among: &Among| matter(stage, among).bending.map(|span| span.same());
    let before = matter(&mut stage, &soft);
    change(&mut stage, &soft, MatterChange::Bending(2.0));
    let made = stage_of(&SCENE.replace(r#""damping": 1,"#, r#""damping": 1, "bending": 2,"#));
    assert_eq!(angles(&stage), angles(&made));
    // All around the block, and not at the point within it; 2 N m^2 over 0.5 m.
    let middles: Vec<u32> = angles(&stage).iter().map(|angle| angle.points[1].0).collect();
    assert_eq!(middles, [3, 4, 5, 6, 8, 9, 10, 11]);
    assert!(angles(&stage).iter().all(|angle| (angle.stiffness, angle.damping) == (4.0, 0.0)));
    assert_eq!(shown(&mut stage, &soft), Some(Some(2.0)));
    change(&mut stage, &soft, MatterChange::Bending(3.0));
    assert_eq!((angles(&stage)[0].stiffness, shown(&mut stage, &soft)), (6.0, Some(Some(3.0))));
    change(&mut stage, &soft, MatterChange::Bending(0.0));
    assert_eq!((angles(&stage).len(), shown(&mut stage, &soft)), (8, Some(Some(0.0))), "they stay");
    for _ in 0..3 {
        assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(name, _)) if name == "bending"));
    }
    assert_eq!((matter(&mut stage, &soft), angles(&stage).len()), (before, 0));
    // A chain in the selection is another body: the skin bends beside it.
    change(&mut stage, &among(3..18), MatterChange::Bending(2.0));
    assert_eq!(angles(&stage).len(), 8 + 4);
    assert_eq!(shown(&mut stage, &among(3..18)), Some(Some(2.0)), "however far apart their points are");
    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(..))));
    // Where some of it bends, the rest gets as much.
    change(&mut stage, &soft, MatterChange::Bending(2.0));
    assert_eq!(shown(&mut stage, &among(3..18)), Some(None), "mixed");
    change(&mut stage, &among(3..18), MatterChange::Bending(5.0));
    let all = shown(&mut stage, &among(3..18)).flatten().unwrap();
    assert!(angles(&stage).len() == 8 + 4 && (all - 5.0).abs() < 1e-9, "{all}");
    assert!(matches!(stage.obey(Order::Undo(None)), Some(Note::Undone(..))));
    assert_eq!((angles(&stage).len(), shown(&mut stage, &soft)), (8, Some(Some(2.0))), "one step of undo");
}

#[test]
fn what_cannot_bend_has_no_bending_and_says_why() {
    let refused = |stage: &mut Stage, among: &Among, words: &str| {
        assert_eq!(matter(stage, among).bending, None, "{words}");
        let order = Order::Change { among: among.clone(), change: MatterChange::Bending(2.0), goes_on: false };
        let note = stage.obey(order);
        assert!(matches!(&note, Some(Note::Refused(why)) if why.contains(words)), "{words}: {note:?}");
        assert!(!stage.history().world().angles().iter().any(|angle| angle.stiffness > 0.0));
    };
    let rigid = "a skin that is not rigid";
    refused(&mut stage(), &among(0..3), rigid);
    refused(&mut stage(), &among(12..14), "a chain");
    let mut figure = stage_of(r#"{"wobble": 1, "bodies": [{"make": "ragdoll"}]}"#);
    let count = figure.history().world().point_count() as u32;
    refused(&mut figure, &among(0..count), rigid);
    let space = r#"{"wobble": 1, "dimensions": 3, "bodies": [{"make": "rope", "count": 5, "to": [1, 0, 0]}]}"#;
    refused(&mut stage_of(space), &among(0..5), "space");
    let large = r#"{"wobble": 1, "bodies": [{"make": "rope", "count": 4100, "spacing": 0.1}]}"#;
    refused(&mut stage_of(large), &among(0..4100), "too slow");
    // Zero where there is nothing to take away.
    let order = Order::Change { among: among(3..12), change: MatterChange::Bending(0.0), goes_on: false };
    assert!(matches!(stage().obey(order), Some(Note::Refused(why)) if why.contains("taken away")));
}

#[test]
fn bending_leaves_hinges_and_joints_free() {
    // A block about a hub, whose spokes are none of its bending.
    let wheel = r#"{"wobble": 1, "points": {"position": [[0.3, 0.3]], "pinned": [0]},
        "bonds": [{"a": 0, "b": 1}, {"a": 0, "b": 2}, {"a": 0, "b": 4}, {"a": 0, "b": 5}],
        "bodies": [{"make": "lattice", "columns": 3, "rows": 3, "spacing": 0.5,
            "material": {"kind": "spring", "stiffness": 300, "mass": 4}}]}"#;
    let mut stage = stage_of(wheel);
    change(&mut stage, &among(0..10), MatterChange::Bending(1.0));
    let angles = stage.history().world().angles();
    assert!(angles.len() == 8 && !angles.iter().any(|angle| angle.points.contains(&PointId(0))), "{angles:?}");
    // A beam with one joint in it bends at its other points.
    let beam = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0], [2, 0], [3, 0], [4, 0]]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 4}],
        "angles": [{"points": [1, 2, 3], "min": 2, "max": 4}]}"#;
    let mut stage = stage_of(beam);
    change(&mut stage, &among(0..5), MatterChange::Bending(1.0));
    let middles: Vec<u32> = stage.history().world().angles().iter().map(|angle| angle.points[1].0).collect();
    assert_eq!(middles, [2, 1, 3]);
}
