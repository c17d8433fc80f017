//! Soft drawings of thin strokes keep their shape under their weight, and what is drawn with a thick brush is cheap enough.

use std::sync::Arc;

use super::{picture, saved};
use wobble::picture::Picture;
use wobble::scene::{BodyKeys, Matter, Scene};

/// A house with a flag on it, on a canvas of 512 px, drawn by strokes so wide `[px]`.
fn house(wide: f64) -> Picture {
    picture([512, 512], [30, 60, 160], move |x, y| {
        let [walls, floors] = [(150.0..450.0).contains(&y), (100.0..400.0).contains(&x)];
        let left = (100.0..100.0 + wide).contains(&x) || (400.0 - wide..400.0).contains(&x);
        let level = (150.0..150.0 + wide).contains(&y) || (450.0 - wide..450.0).contains(&y);
        let pole = (250.0..250.0 + wide).contains(&x) && (30.0..150.0).contains(&y);
        let flag = (30.0..30.0 + wide).contains(&y) && (250.0..380.0).contains(&x);
        (left && walls) || (level && floors) || pole || flag
    })
}

/// How broad and how high a scene's only body is at its start and once it has stood for three seconds `[m]`, and the largest counted work of a frame
/// meanwhile `[ms]`.
fn stood(scene: &Scene) -> ([[f64; 2]; 2], f64) {
    let mut world = scene.world(None).unwrap();
    let size = |world: &dyn wobble::sim::Dynamics| {
        let places = world.sample(world.time()).position;
        [0, 1].map(|axis| {
            let along = || places.iter().map(|x| x[axis]);
            along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
        })
    };
    let before = size(&*world);
    let mut dearest = 0.0_f64;
    for frame in 1..=180 {
        let work = world.counters().work_ms();
        while world.time() < f64::from(frame) / 60.0 - 1e-9 {
            world.step();
        }
        dearest = dearest.max(world.counters().work_ms() - work);
    }
    ([before, size(&*world)], dearest)
}

#[test]
fn a_soft_drawing_of_strokes_of_two_pixels_keeps_its_shape_and_without_bending_it_falls_flat() {
    let folder = tempfile::tempdir().unwrap();
    let path = saved(folder.path(), "house.png", &house(2.0));
    let scene = Scene::load(path.to_str().unwrap()).unwrap();
    // Of strokes alone: 0.06 of what all of its weight turns at its height.
    let bending = scene.bodies[0].material.as_ref().unwrap().bending.unwrap();
    assert!((bending / (0.06 * 3.0 * 9.81 * 4.0) - 1.0).abs() < 1e-9, "{bending} N m^2");
    let points = scene.world(None).unwrap().point_count();
    assert!((90..140).contains(&points), "{points}");
    let ([before, after], dearest) = stood(&scene);
    // It gives way by a tenth of its height.
    assert!((after[1] / before[1] - 0.9).abs() < 0.04, "{before:?} {after:?}");
    assert!((after[0] / before[0] - 1.0).abs() < 0.05, "{before:?} {after:?}");
    assert!(dearest < 14.0, "{dearest} ms in a frame");
    let mut limp = scene.clone();
    limp.bodies[0].material.as_mut().unwrap().bending = Some(0.0);
    let ([before, after], _) = stood(&limp);
    assert!(after[1] < 0.2 * before[1], "{before:?} {after:?}");
}

#[test]
fn strokes_that_are_added_to_a_scene_are_as_firm_as_in_one_of_their_own() {
    let scene = Scene::parse(r#"{"wobble": 1, "points": {"position": [[9, 9]]}}"#, "x.json").unwrap();
    let world = scene.world(None).unwrap();
    let added = |material| {
        let keys = BodyKeys { material: Some(material), height: Some(2.0), ..BodyKeys::default() };
        let picture = Arc::new(house(2.0));
        let keys = scene.body_to_add(&*world, (&picture, keys), [[-3.0, -3.0], [3.0, 3.0]], false).unwrap();
        keys.bodies[0].material.as_ref().unwrap().bending
    };
    let soft = added(Matter::Soft.material(None)).unwrap();
    assert!((soft / (0.06 * 3.0 * 9.81 * 4.0) - 1.0).abs() < 1e-9, "{soft} N m^2");
    let mut said = Matter::Soft.material(None);
    said.bending = Some(0.5);
    assert_eq!(added(said), Some(0.5), "what is said stays");
    assert_eq!(added(Matter::Rigid.material(None)), None, "what is rigid has none");
}
