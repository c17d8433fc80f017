//! Colours of bodies as they are drawn: as many as there are bodies, strokes of drawings in their tints, pictures that are seen through.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use std::sync::Arc;

use wobble::picture::{Picture, Settings, Size, Tint, Watch};
use wobble::render::{Camera, Capture, Look, View};
use wobble::scene::{BodyKeys, Matter, Scene};
use wobble::sim::Bonds;

use crate::common;
use common::picture::{SIDE, bond, pixels, plain, view};

/// Rows of bonds across the picture, each of a body of its own.
const ROWS: usize = 15;

#[test]
fn every_body_has_its_own_colour_and_width_however_many_there_are() {
    if common::gpu().is_none() {
        return;
    }
    let y = |row: usize| 4.0 * row as f32 - 28.0 + 0.5;
    let positions: Vec<f32> = (0..ROWS).flat_map(|row| [-24.0, y(row), 24.0, y(row)]).collect();
    let bonds: Bonds = (0..ROWS as u32).map(|row| bond(2 * row, 2 * row + 1)).collect();
    let color = |row: usize| [(16 * row) as u8, 255 - (16 * row) as u8, 90];
    // A metre is a pixel: rows are 1.2 to 2.6 pixels wide, whatever is usual.
    let width = |row: usize| 1.2 + 0.1 * row as f64;
    let tint =
        |row: usize| Tint { color: Some(color(row)), width: width(row), ..Tint::new(2 * row as u32, row as u32) };
    let tints: Vec<Tint> = (0..ROWS).map(tint).collect();
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let look = Look { bond_width: 0.5, point_radius: 0.0, ..plain() };
    let clear = Look { point: [0.0; 4], pin: [0.0; 4], ..look };
    let drawn = capture.picture(&View { tints: &tints, ..view(&positions, &bonds, 2) }, &pixels(), &clear).unwrap();
    for row in 0..ROWS {
        let middle = (0.5 * SIDE as f32 - y(row)) as u32;
        let column: Vec<[u8; 4]> = (middle - 2..=middle + 2).map(|y| drawn.get_pixel(32, y).0).collect();
        let off = (0..3).map(|k| column[2][k].abs_diff(color(row)[k])).max().unwrap();
        assert!(off <= 2, "row {row}: {:?} in place of {:?}", column[2], color(row));
        let green: f64 = column.iter().map(|pixel| f64::from(pixel[2])).sum::<f64>() / 90.0;
        assert!((green - width(row)).abs() < 0.1, "row {row}: {green} pixels wide in place of {}", width(row));
    }
}

/// A picture in the middle of which a shape has an opacity `[1]`, on black.
fn drawn(picture: Picture, settings: &Settings, tints: &[Tint], look: &Look) -> image::RgbaImage {
    let picture = Arc::new(picture);
    let keys = BodyKeys::cut(settings, 2.0, &picture);
    let scene = Scene::of_drawing("a drawing", picture, keys, Matter::Soft, &Watch::default()).unwrap();
    let (world, skins) = (scene.world(None).unwrap(), scene.skins().unwrap());
    let camera = Camera::fit([[-1.2, -1.0, 0.0], [1.2, 1.0, 0.0]], 2, [240, 200]);
    let view = View { skins: &skins, tints, mouse: None, ..View::of(&*world) };
    common::picture::drawn(&view, &camera, look)
}

fn on(ground: [f32; 4]) -> Look {
    Look { has_grid: false, ground, wall: [0.0; 4], ..Look::default() }
}

/// A disc of 50 px in a picture of 120, as opaque as `alpha` says at a distance from its middle `[px]`.
fn disc(color: [u8; 3], alpha: impl Fn(f64) -> f64) -> Picture {
    let mut picture = Picture::filled(120, 120, [color[0], color[1], color[2], 0]);
    for (i, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
        let [x, y] = [i % 120, i / 120].map(|at| at as f64 + 0.5 - 60.0);
        pixel[3] = (255.0 * alpha(x.hypot(y)) + 0.5) as u8;
    }
    picture
}

#[test]
fn what_is_half_transparent_is_blended_and_ends_where_its_picture_does() {
    if common::gpu().is_none() {
        return;
    }
    let ink = [240, 160, 80];
    let share = 115.0 / 255.0;
    let half = || disc(ink, |r| share * (50.5 - r).clamp(0.0, 1.0));
    for (ground, behind) in [([0.0, 0.0, 0.0, 1.0], 0.0), ([1.0; 4], 255.0)] {
        let picture = drawn(half(), &Settings::default(), &[], &on(ground));
        let seen = ink.map(|part| share * f64::from(part) + (1.0 - share) * behind);
        let off = |x: u32, y: u32| {
            let pixel = picture.get_pixel(x, y);
            (0..3).map(|k| (f64::from(pixel[k]) - seen[k]).abs()).fold(0.0, f64::max)
        };
        let (mut inside, mut outside) = (0, 0);
        for (x, y, pixel) in picture.enumerate_pixels() {
            // 2 m are 120 px of the picture, and 200 px of this one but for a border.
            let r = (f64::from(x) + 0.5 - 120.0).hypot(f64::from(y) + 0.5 - 100.0);
            if r < 62.0 {
                assert!(off(x, y) <= 4.0, "at {x} {y}: {pixel:?} in place of {seen:?}");
                inside += 1;
            } else if r < 90.0 {
                // At its edge it is between what it is and what is behind: no line of the mesh.
                let between = |k: usize| {
                    let [low, high] = [seen[k].min(behind), seen[k].max(behind)];
                    (low - 4.0..=high + 4.0).contains(&f64::from(pixel[k]))
                };
                assert!((0..3).all(between), "at {x} {y}: {pixel:?}");
                outside += 1;
            }
        }
        assert!(inside > 10_000 && outside > 5_000);
    }
    // What fades out does so all the way, beyond its mesh too, which ends where it is half as opaque.
    let share = |r: f64| ((55.0 - r) / 45.0).clamp(0.0, 1.0);
    let fades = drawn(disc(ink, share), &Settings::default(), &[], &on([0.0, 0.0, 0.0, 1.0]));
    for x in [5_u32, 25, 40, 55, 64] {
        let red = f64::from(fades.get_pixel(120 + x, 100)[0]);
        // 120 px of it are 2 m, and a metre is 83 px here.
        let expected = 240.0 * share((f64::from(x) + 0.5) * 60.0 / 83.3);
        assert!((red - expected).abs() < 25.0, "{x} px from the middle: {red} in place of {expected}");
    }
}

#[test]
fn what_fades_from_the_edge_of_its_picture_on_ends_there() {
    if common::gpu().is_none() {
        return;
    }
    // Opaque at its upper edge, clear at its lower one.
    let mut picture = Picture::filled(120, 120, [80, 160, 230, 255]);
    for (i, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
        pixel[3] = (255 - 2 * (i / 120)) as u8;
    }
    let drawn = drawn(picture, &Settings::default(), &[], &on([0.0, 0.0, 0.0, 1.0]));
    let is_lit = |x: u32, y: u32| drawn.get_pixel(x, y)[2] > 60;
    // 2 m are 167 px.
    let columns: Vec<u32> = (0..240).filter(|x| (0..200).any(|y| is_lit(*x, y))).collect();
    let (first, last) = (columns[0], columns[columns.len() - 1]);
    assert!(first.abs_diff(37) <= 2 && last.abs_diff(202) <= 2, "it is seen from {first} to {last}");
    let tops: Vec<u32> = (first + 3..last - 2).map(|x| (0..200).find(|y| is_lit(x, *y)).unwrap()).collect();
    assert!(tops.iter().all(|top| top.abs_diff(tops[80]) <= 1), "its upper edge is straight: {tops:?}");
}

#[test]
fn strokes_of_drawings_have_the_colours_that_they_are_tinted_in() {
    if common::gpu().is_none() {
        return;
    }
    // A white line, too thin for triangles.
    let mut line = Picture::filled(160, 120, [255, 255, 255, 0]);
    for (i, pixel) in line.rgba.chunks_exact_mut(4).enumerate() {
        let [x, y] = [i % 160, i / 160].map(|at| at as f64 + 0.5);
        let off = (x - x.clamp(20.0, 140.0)).hypot(y - 60.3);
        pixel[3] = (255.0 * (1.6 - off + 0.5).clamp(0.0, 1.0)) as u8;
    }
    let settings = Settings { size: Size::Spacing(16.0), ..Settings::default() };
    for color in [[208, 48, 96], [40, 120, 60], [50, 60, 190], [120, 20, 20], [240, 220, 120]] {
        let tints = [Tint { color: Some(color), ..Tint::new(0, 0) }];
        let picture = drawn(line.clone(), &settings, &tints, &on([0.06, 0.08, 0.12, 1.0]));
        let lightest = |x: u32| {
            (60..140)
                .map(|y| picture.get_pixel(x, y).0)
                .max_by_key(|p| p[..3].iter().map(|c| u32::from(*c)).sum::<u32>())
        };
        let most = (0..3).max_by_key(|&k| color[k]).unwrap();
        for x in (80..160).step_by(9) {
            let pixel = lightest(x).unwrap();
            let others = (0..3).filter(|&k| k != most && color[most] - color[k] > 50);
            for k in others {
                assert!(pixel[most] > pixel[k] + 25, "{color:?} is drawn as {pixel:?} at {x}");
            }
        }
    }
}

#[test]
fn dark_pictures_take_the_colour_that_they_are_given() {
    if common::gpu().is_none() {
        return;
    }
    let ink = [22, 22, 26];
    // In the middle, and what is brightest: the rim.
    let seen = |tints: &[Tint]| {
        let picture =
            drawn(disc(ink, |r| (50.5 - r).clamp(0.0, 1.0)), &Settings::default(), tints, &on([0.06, 0.08, 0.12, 1.0]));
        let rim = picture.pixels().max_by_key(|pixel| pixel[0]).unwrap().0;
        (picture.get_pixel(120, 100).0, rim)
    };
    let (plain, light) = seen(&[]);
    assert!(light[0] > 140 && light[1] > 140, "a rim that is seen on a dark ground: {light:?}");
    assert!((0..3).all(|k| plain[k].abs_diff(ink[k]) <= 3), "without a colour it stays as it is: {plain:?}");
    let (red, rim) = seen(&[Tint { color: Some([220, 40, 30]), ..Tint::new(0, 0) }]);
    assert!(red[0] > 90 && red[0] > red[1] + 50 && red[0] > red[2] + 50, "{red:?}");
    assert!(rim[0] > rim[1] + 140 && rim[0] > rim[2] + 140, "its rim has that colour, too: {rim:?}");
    let white = seen(&[Tint { color: Some([255; 3]), ..Tint::new(0, 0) }]);
    assert_eq!(white, (plain, light), "white changes nothing");
}

#[test]
fn pictures_of_any_hue_are_bright_in_the_colour_that_they_are_given() {
    if common::gpu().is_none() {
        return;
    }
    let tints = [Tint { color: Some([220, 40, 30]), ..Tint::new(0, 0) }];
    let seen = |ink: [u8; 3]| {
        let disc = disc(ink, |r| (50.5 - r).clamp(0.0, 1.0));
        drawn(disc, &Settings::default(), &tints, &on([0.06, 0.08, 0.12, 1.0])).get_pixel(120, 100).0
    };
    let (green, blue, dark) = (seen([60, 170, 90]), seen([60, 90, 200]), seen([20, 60, 30]));
    for red in [green, blue, dark] {
        assert!(red[0] > red[1] + 80 && red[0] > red[2] + 80, "{red:?}");
    }
    assert!(green[0] > 140 && green[0] > dark[0] + 20, "light ink stays lighter than dark ink: {green:?}, {dark:?}");
}
