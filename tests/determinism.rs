//! The same input gives the same bits: twice, after saving and loading, expanded, and as it was when this was written.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

use crate::common;

use std::path::Path;

use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::scene::record::{hash, record};

/// Hash of a scene's samples at these times.
fn run(scene: &Scene, times: &[f64]) -> String {
    let mut world = scene.world(times.last().copied()).unwrap();
    hash(&record(&mut *world, times, |_| {}).unwrap(), scene.dimensions())
}

fn scenes() -> Vec<Scene> {
    let files = ["rim-pushed.json", "cloth-space.json", "rim-still.json"];
    let small = wobble::scene::gallery().iter().filter(|entry| entry.is_small());
    let gallery = small.map(|entry| entry.scene().unwrap());
    gallery.chain(files.iter().map(|name| Scene::read(&common::file(name)).unwrap())).collect()
}

#[test]
fn twice_the_same_and_after_saving_and_expanding() {
    for scene in scenes() {
        let first = run(&scene, &[0.3, 0.7]);
        assert_eq!(first, run(&scene, &[0.3, 0.7]), "{}", scene.name());
        let loaded = Scene::parse(&scene.to_json().unwrap(), "x.json").unwrap();
        assert_eq!(first, run(&loaded, &[0.3, 0.7]), "{} saved and loaded", scene.name());
        assert_eq!(first, run(&scene.expanded().unwrap(), &[0.3, 0.7]), "{} expanded", scene.name());
    }
}

#[test]
fn asking_for_more_samples_changes_nothing() {
    for scene in scenes() {
        let at_end = |times: &[f64]| {
            let mut world = scene.world(Some(0.7)).unwrap();
            let samples = record(&mut *world, times, |_| {}).unwrap();
            samples.last().cloned().unwrap()
        };
        assert_eq!(at_end(&[0.7]), at_end(&[0.01, 0.0333, 0.5, 0.7]), "{}", scene.name());
    }
}

/// Bits that must not change by accident, in any build on any machine: of small and large bodies, of walls, a polygon and a slope, of a
/// mouse along a track, of a cloth in space and of bodies that meet. A change of method changes them on purpose. A test in
/// `src/scene/record.rs` comes to the same ones in a build that is optimised otherwise.
#[test]
fn the_bits_are_those_of_the_last_version() {
    let frozen: Vec<Value> = serde_json::from_str(include_str!("files/bits.json")).unwrap();
    let of = |frozen: &Value| {
        let name = frozen["scene"].as_str().unwrap();
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
        let scene = if name.contains('/') { Scene::read(&path) } else { Scene::load(name) };
        let hash = run(&scene.unwrap(), &[frozen["time"].as_f64().unwrap()]);
        json!({"scene": name, "time": frozen["time"], "hash": hash})
    };
    assert_eq!(frozen.iter().map(of).collect::<Vec<_>>(), frozen);
}

#[test]
fn the_hash_sees_every_bit() {
    let scene = Scene::load("rim").unwrap();
    let world = scene.world(None).unwrap();
    let mut sample = world.sample(0.0);
    let before = hash(std::slice::from_ref(&sample), 2);
    sample.velocity[23][1] = f64::from_bits(sample.velocity[23][1].to_bits() ^ 1);
    assert_ne!(before, hash(std::slice::from_ref(&sample), 2));
}
