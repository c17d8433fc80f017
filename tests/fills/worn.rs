//! Strain on bodies that wear a picture.

use std::sync::Arc;

use super::{PLACES, at, look, sides, triangles};
use crate::common;
use crate::common::picture::{SIDE, between, pixels, view};
use wobble::picture::{Picture, Skin};
use wobble::render::{Capture, Look, Overlay, View};
use wobble::sim::{Bond, Bonds};

#[test]
fn a_percent_of_strain_is_seen_on_bodies_that_wear_a_picture_and_without_it_the_picture_is() {
    if common::gpu().is_none() {
        return;
    }
    let triangles = triangles();
    let skin = Skin {
        picture: Arc::new(Picture::filled(8, 8, [200, 60, 30, 255])),
        first: 0,
        triangles: triangles.iter().map(|corners| corners.map(|point| point.0)).collect(),
        texture: vec![[0.5; 2]; PLACES.len() / 2],
    };
    let skins = [skin];
    let colors = between([0.0, 0.0, 1.0, 1.0], [0.0, 1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]);
    let by_strain = Look { overlay: Overlay::Strain, strain: colors, ..look() };
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let mut shown = |strain: f64, look: &Look, change: u64| {
        let bonds: Bonds =
            sides().iter().map(|bond| Bond { rest_length: bond.rest_length / (1.0 + strain), ..bond }).collect();
        let seen =
            View { skins: &skins, triangles: &triangles, motion: change, topology: change, ..view(&PLACES, &bonds, 2) };
        at(&capture.picture(&seen, &pixels(), look).unwrap(), 10.0, -5.0)
    };
    let worn = shown(0.01, &look(), 0);
    assert!(worn.iter().zip([200, 60, 30]).all(|(seen, of)| seen.abs_diff(of) <= 2), "{worn:?}");
    let rest = shown(0.0, &by_strain, 1);
    // The share of the colours that a strain is shown by, of which sides of triangles take a sixth at most.
    let share = (0.01_f64 / 0.005).asinh() / 60_f64.asinh();
    let wanted = (0.8 * 255.0 * share) as u8;
    for (strain, channel, change) in [(0.01, 0, 2), (-0.01, 2, 3)] {
        let seen = shown(strain, &by_strain, change);
        assert!(seen[channel] >= wanted && rest[channel] < 8, "{strain}: {seen:?}, {rest:?} at rest");
    }
}
