//! What is selected is copied: with all that it has, beside itself and into other scenes.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use super::Chosen;
use super::select_tests::{DISCS, at, click, discs, hand};
use super::tests::{pixel, scope, shown};
use crate::app::clip::Clip;
use crate::app::player::{Coming, Order, Stage};
use crate::history::Do;
use crate::scene::Scene;
use crate::sim::{Limit, Obstacle, PointId};

#[test]
fn a_copy_moves_as_the_body_does() {
    let seen = discs();
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    let mut hand = hand();
    click(&mut hand, &seen, pixel(&seen, 0));
    let chosen = hand.chosen(scope(&seen)).unwrap();
    let by = chosen.beside(scope(&seen));
    let count = chosen.points.len();
    assert!((2.0..3.0).contains(&by[0]), "beside it: {by:?}");
    let all = seen.0.point_count();
    stage.obey(Order::Add(Box::new(move |history| {
        Ok(Coming::of(Clip::of(history, &chosen).placed(history.world(), by)))
    })));
    (0..60).for_each(|_| _ = stage.obey(Order::Advance { wall: 1.0 / 60.0, cursor: None, back: false }));
    // The copy is what is selected when it is there, and nothing until then.
    hand.select(Chosen { points: vec![PointId(all as u32)], obstacles: Vec::new() });
    assert!(hand.chosen(scope(&seen)).is_none());
    let world = stage.history().world();
    assert_eq!(world.point_count(), all + count);
    let x = world.positions();
    for k in 0..count {
        let [dx, dy] = [0, 1].map(|axis| x.get(2 * (all + k) + axis) - x.get(2 * k + axis));
        assert!((dx - by[0]).abs() < 1e-6 && dy.abs() < 1e-6, "{dx} {dy}");
    }
}

const FULL: &str = r##"{"wobble": 1, "gravity": [0, -9.81], "contact": true,
    "points": {"position": [[0, 0], [1, 0], [2, 0.2], [2.5, 1]], "mass": [1, 2, 3, 4], "pinned": [3]},
    "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 90, "damping": 2, "break_strain": 0.5,
        "drive": {"amplitude": 0.2, "period": 1}}, {"a": 1, "b": 2}, {"a": 2, "b": 3, "limit": "max"}],
    "angles": [{"points": [0, 1, 2], "rest": 3, "stiffness": 5, "min": 2, "max": 4},
        {"points": [1, 2, 3], "drive": {"speed": 2, "torque": 3}}],
    "triangles": [[0, 1, 2]], "forces": [{"points": [0, 2], "force": [1, 2], "torque": 0.5}],
    "skins": [{"points": [0, 1], "friction": 0.9, "color": "#ff8800"}],
    "obstacles": [{"circle": {"center": [0, -3], "radius": 1}, "friction": 0.3},
        {"plane": {"point": [0, -5], "normal": [1, 4]}, "restitution": 0.6},
        {"polygon": [[[4, 0], [5, 0], [5, 1]]]}]}"##;

#[test]
fn a_copy_has_all_that_was_copied() {
    let seen = shown(Scene::parse(FULL, "x.json").unwrap());
    let chosen = Chosen::all(scope(&seen));
    let mut stage = Stage::new(seen.2.clone().into()).unwrap();
    stage.obey(Order::Add(Box::new(move |history| {
        Ok(Coming::of(Clip::of(history, &chosen).placed(history.world(), [10.0, 0.0, 0.0])))
    })));
    let world = stage.history().world();
    assert_eq!((world.point_count(), world.pinned()), (8, &[PointId(3), PointId(7)][..]));
    assert_eq!(world.masses()[4..], [1.0, 2.0, 3.0, 4.0]);
    let bonds: Vec<_> = world.bonds().iter().collect();
    for k in 0..3 {
        let [own, copy] = [bonds[k], bonds[k + 3]];
        assert_eq!((copy.a.0, copy.b.0), (own.a.0 + 4, own.b.0 + 4));
        assert_eq!(
            (copy.kind, copy.limit, copy.break_strain, copy.drive, copy.rest_length),
            (own.kind, own.limit, own.break_strain, own.drive, own.rest_length)
        );
    }
    assert!(bonds[5].limit == Limit::Max && bonds[3].drive.is_some());
    let angles = world.angles();
    for k in 0..2 {
        let [own, copy] = [&angles[k], &angles[k + 2]];
        assert_eq!(copy.points, own.points.map(|point| PointId(point.0 + 4)));
        assert_eq!(
            (copy.rest, copy.stiffness, copy.range, copy.drive),
            (own.rest, own.stiffness, own.range, own.drive)
        );
    }
    let forces = world.forces();
    assert_eq!((forces.len(), forces[1].force, forces[1].torque), (2, [1.0, 2.0, 0.0], 0.5));
    assert_eq!(forces[1].points, [PointId(4), PointId(6)]);
    assert_eq!(world.triangles()[1], [4, 5, 6].map(PointId));
    assert_eq!(world.skin_of(PointId(5)).friction, Some(0.9));
    assert_eq!(stage.history().tints().iter().filter(|tint| tint.color == Some([255, 136, 0])).count(), 2);
    let obstacles = world.obstacles();
    assert_eq!(obstacles.len(), 6);
    let planes: Vec<_> = obstacles.iter().filter(|(_, one)| matches!(one, Obstacle::Plane { .. })).collect();
    let Obstacle::Plane { point, normal, restitution, .. } = planes[1].1 else { panic!() };
    assert_eq!((point, restitution), ([10.0, -5.0, 0.0], 0.6));
    assert!((normal[1] / normal[0] - 4.0).abs() < 1e-12);
    let polygons = world.polygons();
    assert_eq!((polygons.len(), polygons[2].friction), (4, 0.3));
    let [own, copy] = [&polygons[0].loops[0], &polygons[2].loops[0]];
    assert!(own.iter().zip(copy).all(|(x, y)| (y[0] - x[0] - 10.0).abs() < 1e-12 && x[1] == y[1]));
}

#[test]
fn a_copy_in_another_scene_keeps_the_friction_of_the_one_that_it_is_of() {
    let rough = DISCS.replace("\"contact\": true", r#""contact": {"friction": 0.9, "restitution": 0.4}"#);
    let seen = shown(Scene::parse(&rough, "x.json").unwrap());
    let chosen = Chosen::at(scope(&seen), at(&seen, -2.0, 0.0)).unwrap();
    let stage = Stage::new(seen.2.clone().into()).unwrap();
    let clip = Clip::of(stage.history(), &chosen);
    let own = clip.placed(stage.history().world(), [0.0; 3]);
    let is_said = own.skins.iter().any(|skin| skin.friction.is_some() || skin.restitution.is_some());
    assert!(!is_said, "at home it is as the scene says");
    for contact in ["true", "false", r#"{"friction": 0.9}"#] {
        let text = DISCS.replace("\"contact\": true", &format!("\"contact\": {contact}"));
        let mut other = Stage::new(Scene::parse(&text, "x.json").unwrap().into()).unwrap();
        let first = other.history().world().point_count() as u32;
        let keys = clip.placed(other.history().world(), [0.0, 2.0, 0.0]);
        assert_eq!(other.obey(Order::Give(vec![Do::Add(Box::new(keys))], Some("add"))), None);
        let world = other.history().world();
        let met = world.contact().unwrap();
        for point in (first..world.point_count() as u32).map(PointId) {
            let skin = world.skin_of(point);
            let [friction, restitution] =
                [skin.friction.unwrap_or(met.friction), skin.restitution.unwrap_or(met.restitution)];
            assert_eq!((friction, restitution), (0.9, 0.4), "{contact}");
            assert_eq!(skin.friction.is_none(), met.friction == 0.9, "what is the same is not said");
        }
    }
}
