//! The same input gives the same bits: twice, after saving and loading, expanded, and as it was when this was written.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod common;

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

/// Bits that must not change by accident, in any build on any machine. A change of method changes them on purpose.
#[test]
fn the_bits_are_those_of_the_last_version() {
    let recorded = [
        ("rim", "36ad5d51a81a448020f33307eab68bfe"),
        ("rim-relaxed", "529b73f26ef0f4c9f7a5d1ba8e9358f3"),
        ("random-graph", "b3f56e9cfdd47d0cb8284a8daf57e53f"),
        ("points", "1797bc90b97aa697fa7379b778941e17"),
    ];
    let here: Vec<(&str, String)> =
        recorded.iter().map(|&(name, _)| (name, run(&Scene::load(name).unwrap(), &[1.0]))).collect();
    let there: Vec<(&str, String)> = recorded.iter().map(|&(name, hash)| (name, hash.to_owned())).collect();
    assert_eq!(here, there);
}

/// The same of large bodies, of walls, a polygon and a slope, of a mouse along a track and of a cloth in space.
#[test]
fn the_bits_of_large_bodies_walls_and_mouse_are_those_of_the_last_version() {
    let recorded = [
        ("rope", 0.02, "4907501111b4215290260e33175e61c7"),
        ("net", 0.02, "648a444424d5f2b2297fed150ccafb9b"),
        ("tests/files/obstacles.json", 0.2, "7668c3ecf647e2d98ebdd860d74edce5"),
        ("tests/files/rim-pushed.json", 0.5, "d8a128c1e8cc848ea71963db5581061f"),
        ("tests/files/cloth-space.json", 0.2, "6bc5deb2a70bce7a6e2e7f2c5800c12d"),
        ("assets/problems/K3_rim_mouse.scene.json", 0.5, "0ea17c5f864968f3adaad8ff4e1710d3"),
        ("assets/problems/M1_bounce.scene.json", 0.5, "1a1263794cd8f62eabfc73c77337e42c"),
        ("assets/problems/N10_bounce_plane.scene.json", 0.5, "1567ecfc8fddef1f62ef372c1057a15b"),
    ];
    let of = |name: &str, time: f64| {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
        let scene = if name.contains('/') { Scene::read(&path) } else { Scene::load(name) };
        run(&scene.unwrap(), &[time])
    };
    let here: Vec<(&str, String)> = recorded.iter().map(|&(name, time, _)| (name, of(name, time))).collect();
    let there: Vec<(&str, String)> = recorded.iter().map(|&(name, _, hash)| (name, hash.to_owned())).collect();
    assert_eq!(here, there);
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
