//! The programs in `examples` do what they say.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use crate::common;

#[path = "../examples/hanging_chain.rs"]
#[allow(dead_code, reason = "the test calls what `main` calls")]
mod hanging_chain;
#[path = "../examples/picture_body.rs"]
#[allow(dead_code, reason = "the test calls what `main` calls")]
mod picture_body;

#[test]
fn a_chain_hangs_as_the_closed_form_says() {
    let [moving, hanging] = [2.0, hanging_chain::TIME].map(|time| hanging_chain::error(time).unwrap());
    assert!(moving > 1e-3, "it still swings: {moving} m");
    assert!(hanging < 1e-9, "{hanging} m");
}

#[test]
fn a_body_of_a_picture_is_drawn() {
    if common::gpu().is_none() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("body.png");
    let picture = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/pictures/jellyfish.png");
    picture_body::draw(&picture, &out).unwrap();
    let drawn = image::open(&out).unwrap().to_rgba8();
    // Its bell is pink; ground, grid and walls are blue and grey.
    let pink = drawn.pixels().filter(|pixel| pixel[0] > 150 && pixel[1] < pixel[2] && pixel[2] < pixel[0]).count();
    assert!(pink > 3_000, "{pink} pixels of the jellyfish");
}
