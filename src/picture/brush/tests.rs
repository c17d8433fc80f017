//! Whole canvases, against what is known of discs, rings and mirrors.

use std::f64::consts::PI;
use std::time::Instant;

use rand::{RngExt, SeedableRng};

use super::*;
use crate::picture::mesh_picture;
use crate::picture::plane::{distance, turn};

const INK: fn(f64) -> Brush = |radius| Brush { radius, erases: false };
const ERASER: fn(f64) -> Brush = |radius| Brush { radius, erases: true };

fn stroke(mask: &mut Mask, brush: Brush, places: &[Point]) {
    mask.begin(brush, places[0]);
    places[1..].iter().for_each(|&place| mask.drag_to(place));
    mask.end();
}

fn area(mask: &Mask) -> f64 {
    mask.coverage().iter().map(|&value| f64::from(value) / 255.0).sum()
}

/// A closed ring of many segments about (128, 128).
fn ring(mask: &mut Mask, brush: Brush, radius: f64) {
    let place = |k: i32| {
        let angle = f64::from(k) * PI / 40.0;
        [128.0 + radius * libm::cos(angle), 128.0 + radius * libm::sin(angle)]
    };
    stroke(mask, brush, &(0..=80).map(place).collect::<Vec<_>>());
}

fn at(mask: &Mask, x: usize, y: usize) -> u8 {
    mask.coverage()[y * mask.size()[0] as usize + x]
}

#[test]
fn sides_are_checked() {
    for (width, height) in [(0, 5), (5, 0), (4097, 1), (1, 4097)] {
        assert_eq!(Mask::new(width, height).err(), Some(PictureError::Canvas { width, height, side: 4096 }));
    }
    assert_eq!(Mask::new(1, 4096).unwrap().size(), [1, 4096]);
    let message = PictureError::Canvas { width: 0, height: 5, side: 4096 }.to_string();
    assert_eq!(message, "the canvas is 0 x 5 pixels: each side must be from 1 to 4096");
}

#[test]
fn a_capsule_has_the_area_of_a_disc_and_a_strip() {
    let ends = [[60.3, 80.9], [190.2, 150.4]];
    let mut mask = Mask::new(256, 256).unwrap();
    stroke(&mut mask, INK(20.0), &ends);
    let truth = PI * 400.0 + 40.0 * distance(ends[0], ends[1]);
    assert!((area(&mask) / truth - 1.0).abs() < 2e-4, "{} {truth}", area(&mask));

    // An eraser leaves what it does not cover.
    mask.clear();
    mask.invert();
    stroke(&mut mask, ERASER(20.0), &ends);
    assert!(((65_536.0 - area(&mask)) / truth - 1.0).abs() < 2e-4);
}

#[test]
fn many_small_segments_make_the_bits_of_a_long_one_twice_too() {
    let (mut one, mut many) = (Mask::new(200, 100).unwrap(), Mask::new(200, 100).unwrap());
    // The places are exact, so that no rounding moves the segments.
    let places: Vec<Point> = (0..=128).map(|k| [20.0 + f64::from(k), 30.25 + 0.25 * f64::from(k)]).collect();
    stroke(&mut one, INK(7.5), &[places[0], places[128]]);
    stroke(&mut many, INK(7.5), &places);
    assert!(one.coverage() == many.coverage());
    stroke(&mut many, INK(7.5), &places);
    assert!(one.coverage() == many.coverage());
    assert!(many.undo() && !many.can_undo(), "a stroke that changes nothing is no step");
}

#[test]
fn inks_lie_where_they_were_painted_last_and_are_taken_back_with_their_strokes() {
    let mut mask = Mask::new(100, 100).unwrap();
    let ink = |mask: &Mask, x: usize, y: usize| mask.inks().get(100 * y + x).copied().unwrap_or(0);
    stroke(&mut mask, INK(20.0), &[[50.0, 50.0]]);
    assert!(mask.inks().is_empty(), "one ink alone takes no memory");
    let (covered, version) = (mask.coverage().to_vec(), mask.version());
    mask.set_ink(3);
    stroke(&mut mask, INK(4.0), &[[50.0, 50.0]]);
    assert!(mask.coverage() == covered && mask.version() > version, "an eye covers no more");
    assert_eq!([ink(&mask, 50, 50), ink(&mask, 58, 50)], [3, 0]);
    stroke(&mut mask, INK(4.0), &[[50.0, 50.0]]);
    mask.set_ink(5);
    stroke(&mut mask, INK(6.0), &[[70.0, 50.0], [90.0, 50.0]]);
    assert_eq!([ink(&mask, 85, 50), ink(&mask, 68, 50), ink(&mask, 50, 50)], [5, 5, 3]);
    let rim = (0..10_000).filter(|&k| mask.coverage()[k] > 0 && covered[k] == 0);
    assert!(rim.into_iter().all(|k| mask.inks()[k] == 5), "the rim of a fin is of its ink");
    assert!(mask.undo() && ink(&mask, 85, 50) == 0 && mask.coverage() == covered);
    assert!(mask.undo() && ink(&mask, 50, 50) == 0 && mask.coverage() == covered, "the same stroke twice is one step");
    assert!(mask.undo() && !mask.can_undo() && area(&mask) == 0.0);
    assert!(mask.redo() && mask.redo() && ink(&mask, 50, 50) == 3 && mask.can_redo());
    // A step of coverage alone forgets the inks that were taken back, too.
    stroke(&mut mask, ERASER(4.0), &[[50.0, 50.0]]);
    assert!(!mask.can_redo() && mask.undo() && ink(&mask, 50, 50) == 3);
}

#[test]
fn a_fill_is_of_its_ink_and_leaves_the_stroke_around_it_its_own() {
    let mut mask = Mask::new(256, 256).unwrap();
    mask.set_ink(1);
    ring(&mut mask, INK(6.0), 60.0);
    mask.set_ink(2);
    mask.fill(INK(6.0), [128.0, 128.0]);
    let ink = |x: usize| mask.inks()[256 * 128 + x];
    assert_eq!([ink(128), ink(128 + 50), ink(128 + 60), ink(10)], [2, 2, 1, 0]);
}

#[test]
fn mirrored_strokes_are_symmetric_bit_for_bit() {
    for (width, height) in [(101, 64), (64, 33)] {
        for mirror in [Mirror::Vertical, Mirror::Horizontal, Mirror::Both] {
            let mut mask = Mask::new(width, height).unwrap();
            mask.mirror = mirror;
            let mut random = rand_pcg::Pcg64::seed_from_u64(5);
            for k in 0..30 {
                let places: Vec<Point> =
                    (0..5).map(|_| [random.random_range(-20.0..120.0), random.random_range(-20.0..80.0)]).collect();
                stroke(&mut mask, Brush { radius: 0.7 * f64::from(k % 7), erases: k % 3 == 2 }, &places);
                mask.fill(Brush { radius: 1.0, erases: k % 2 == 1 }, places[0]);
            }
            let rows: Vec<&[u8]> = mask.coverage().chunks(width as usize).collect();
            if mirror != Mirror::Horizontal {
                assert!(rows.iter().all(|row| row.iter().eq(row.iter().rev())));
            }
            if mirror != Mirror::Vertical {
                assert!(rows.iter().eq(rows.iter().rev()));
            }
            assert!(mask.coverage().iter().any(|&v| v > 0) && mask.coverage().iter().any(|&v| v < 255));
        }
    }
}

#[test]
fn a_mirror_repeats_a_dab_in_its_quarters() {
    for (mirror, count) in
        [(Mirror::None, 1.0), (Mirror::Vertical, 2.0), (Mirror::Horizontal, 2.0), (Mirror::Both, 4.0)]
    {
        let mut mask = Mask::new(200, 160).unwrap();
        mask.mirror = mirror;
        stroke(&mut mask, INK(10.0), &[[30.0, 40.0]]);
        assert!((area(&mask) / (count * PI * 100.0) - 1.0).abs() < 2e-3);
    }
}

#[test]
fn steps_are_taken_back_and_done_again_bit_for_bit() {
    let mut mask = Mask::new(300, 200).unwrap();
    let mut random = rand_pcg::Pcg64::seed_from_u64(11);
    let mut seen = vec![mask.coverage().to_vec()];
    for k in 0..60 {
        let mut place = || [random.random_range(-40.0..340.0), random.random_range(-40.0..240.0)];
        let (a, b) = (place(), place());
        let brush = Brush { radius: f64::from(1 + k % 23), erases: k % 4 == 3 };
        match k % 10 {
            5 => mask.fill(brush, a),
            8 => mask.invert(),
            9 if k > 30 => mask.clear(),
            _ => stroke(&mut mask, brush, &[a, b, place()]),
        }
        if mask.coverage() != seen[seen.len() - 1] {
            seen.push(mask.coverage().to_vec());
        }
    }
    assert!(seen.len() > 50);
    for before in seen.iter().rev().skip(1) {
        assert!(mask.undo() && mask.coverage() == before);
    }
    assert!(!mask.undo() && !mask.can_undo() && mask.can_redo());
    for after in &seen[1..] {
        assert!(mask.redo() && mask.coverage() == after);
    }
    assert!(!mask.redo() && !mask.can_redo());
    mask.undo();
    stroke(&mut mask, INK(3.0), &[[-9.0, -9.0]]);
    assert!(mask.can_redo(), "a stroke beside the canvas is no step");
    mask.invert();
    assert!(!mask.can_redo());
}

#[test]
fn a_fill_leaves_no_seam_in_a_closed_ring() {
    for (radius, thick) in [(60.0, 0.8), (60.0, 1.0), (60.0, 2.0), (33.3, 5.0), (90.7, 12.0)] {
        let mut mask = Mask::new(256, 256).unwrap();
        ring(&mut mask, INK(thick), radius);
        let before = mask.coverage().to_vec();
        mask.fill(INK(1.0), [128.0, 128.0]);
        let off = |k: usize| distance([(k % 256) as f64 + 0.5, (k / 256) as f64 + 0.5], [128.0, 128.0]) - radius;
        for (k, &value) in mask.coverage().iter().enumerate() {
            assert!(off(k) > -0.2 || value == 255, "{value} at {k} of {radius} {thick}");
            assert!(off(k) < thick || value == before[k], "beyond the stroke all is as it was");
        }
        // Half of the outer rim of a hairline may be filled too.
        assert!((area(&mask) / (PI * (radius + thick) * (radius + thick)) - 1.0).abs() < 0.02);
        mask.undo();
        assert!(mask.coverage() == before);
    }
}

#[test]
fn a_fill_leaves_no_seam_in_notches_nor_an_eraser_a_fringe() {
    let mut random = rand_pcg::Pcg64::seed_from_u64(8);
    let mut count = 0;
    for round in 0..150 {
        let mut mask = Mask::new(160, 160).unwrap();
        let mut place = || [random.random_range(20.0..140.0), random.random_range(20.0..140.0)];
        let corners: [Point; 3] = std::array::from_fn(|_| place());
        let radius = f64::from(2 + round % 5);
        stroke(&mut mask, INK(radius), &[corners[0], corners[1], corners[2], corners[0]]);
        // Room for a circle in the middle of the clear triangle, which then is one region.
        let sides = [1, 2, 0].map(|k| distance(corners[k], corners[(k + 1) % 3]));
        let around: f64 = sides.iter().sum();
        if turn(corners[0], corners[1], corners[2]).abs() / around < radius + 1.5 {
            continue;
        }
        let middle = [0, 1].map(|k| (0..3).map(|c| sides[c] * corners[c][k]).sum::<f64>() / around);
        count += 1;
        mask.fill(INK(1.0), middle);
        // Inside the triangle of the stroke's middle all is full.
        for k in 0..160 * 160 {
            let p = [(k % 160) as f64 + 0.5, (k / 160) as f64 + 0.5];
            let turns = [0, 1, 2].map(|c| turn(corners[c], corners[(c + 1) % 3], p));
            let is_inside = turns.iter().all(|&t| t > 0.0) || turns.iter().all(|&t| t < 0.0);
            assert!(!is_inside || mask.coverage()[k] == 255, "{} at {p:?} in {corners:?}", mask.coverage()[k]);
        }
        mask.fill(ERASER(1.0), middle);
        assert!(mask.coverage().iter().all(|&value| value == 0), "an eraser leaves no fringe");
    }
    assert!(count > 100, "{count}");
}

#[test]
fn fills_end_at_strokes_and_borders_and_know_their_side() {
    let mut mask = Mask::new(256, 256).unwrap();
    ring(&mut mask, INK(1.0), 50.0);
    let before = mask.version();
    for place in [[-0.1, 3.0], [256.0, 3.0], [f64::NAN, 3.0], [3.0, f64::INFINITY]] {
        mask.fill(INK(1.0), place);
    }
    mask.fill(INK(1.0), [178.5, 128.5]);
    mask.fill(ERASER(1.0), [3.0, 3.0]);
    assert_eq!(mask.version(), before);
    mask.fill(INK(1.0), [3.0, 3.0]);
    assert_eq!([at(&mask, 0, 0), at(&mask, 255, 255), at(&mask, 128, 128)], [255, 255, 0]);
    mask.fill(ERASER(1.0), [3.0, 3.0]);
    assert_eq!(area(&mask), 0.0);
}

#[test]
fn places_that_are_no_numbers_or_far_away_do_no_harm() {
    let (mut mask, mut truth) = (Mask::new(64, 64).unwrap(), Mask::new(64, 64).unwrap());
    mask.drag_to([1.0, 1.0]);
    mask.end();
    assert!(!mask.can_undo());
    let nan = f64::NAN;
    stroke(&mut mask, INK(4.0), &[[nan, 3.0], [10.0, 12.0], [3.0, nan], [f64::INFINITY, 2.0], [50.0, 40.0]]);
    stroke(&mut truth, INK(4.0), &[[10.0, 12.0], [50.0, 40.0]]);
    assert!(mask.coverage() == truth.coverage());
    stroke(&mut mask, INK(nan), &[[1e300, 32.0], [-1e300, 32.0]]);
    assert!((0..64).all(|x| at(&mask, x, 31) >= 127 && at(&mask, x, 32) >= 127));
    stroke(&mut mask, INK(1e9), &[[-300.0, 32.0], [-f64::MAX, f64::MAX]]);
    assert_eq!(area(&mask), 4096.0);
}

#[test]
fn changes_are_told_once_and_cover_what_changed() {
    let mut mask = Mask::new(1024, 1024).unwrap();
    assert_eq!(mask.changed(), Some([0, 0, 1024, 1024]));
    assert_eq!(mask.changed(), None);
    let version = mask.version();
    mask.begin(INK(5.0), [100.0, 200.0]);
    assert_eq!(mask.changed(), Some([95, 195, 10, 10]));
    mask.drag_to([140.0, 200.0]);
    let drawn = mask.version();
    assert!(drawn > version);
    assert_eq!(mask.changed(), Some([95, 195, 50, 10]));
    mask.end();
    assert_eq!((mask.version(), mask.changed()), (drawn, None));
    assert!(mask.undo());
    assert_eq!(mask.changed(), Some([64, 192, 128, 64]));
    assert!(mask.version() > drawn);
}

#[test]
fn pictures_come_and_go_unchanged_and_can_be_meshed() {
    let mut mask = Mask::new(256, 256).unwrap();
    ring(&mut mask, INK(14.0), 80.0);
    let picture = mask.to_picture([240, 250, 255]);
    assert_eq!((picture.width, picture.height, picture.rgba[..4].to_vec()), (256, 256, vec![240, 250, 255, 0]));
    let again = Mask::from_picture(&picture).unwrap();
    assert!(again.coverage() == mask.coverage() && !again.can_undo());
    let stats = mesh_picture(&picture, &Settings::default()).unwrap().stats();
    assert_eq!((stats.components, stats.holes), (1, 1));
    assert!((stats.area_px / (PI * (94.0 * 94.0 - 66.0 * 66.0)) - 1.0).abs() < 0.02);
    let paper = Picture::filled(9, 9, [255; 4]);
    assert_eq!(area(&Mask::from_picture(&paper).unwrap()), 0.0);
    assert!(Mask::from_picture(&Picture::filled(4097, 1, [0; 4])).is_err());
}

/// Run by hand: `cargo test --profile ci -- --ignored --nocapture times`.
#[test]
#[ignore = "times depend on the machine"]
#[allow(clippy::print_stdout, reason = "a measurement is told")]
fn times() {
    let mut mask = Mask::new(1024, 1024).unwrap();
    let mut time = |name: &str, runs: u32, run: &dyn Fn(&mut Mask, u32)| {
        let start = Instant::now();
        (0..runs).for_each(|k| run(&mut mask, k));
        println!("{name}: {:.4} ms", start.elapsed().as_secs_f64() * 1e3 / f64::from(runs));
    };
    let place = |k: u32| [f64::from(k * 37 % 1024), f64::from(k * 91 % 1024)];
    time("dab, radius 30, a step each", 2000, &|mask, k| stroke(mask, INK(30.0), &[place(k)]));
    time("dab, radius 512, a step each", 100, &|mask, k| stroke(mask, INK(512.0), &[place(k)]));
    time("clear", 20, &|mask, _| mask.clear());
    time("invert", 20, &|mask, _| mask.invert());
    time("undo and redo of invert", 20, &|mask, _| {
        mask.undo();
        mask.redo();
    });
    time("fill of 1024^2 and clear", 20, &|mask, _| {
        mask.clear();
        mask.fill(INK(1.0), [500.0, 500.0]);
    });
    time("diagonal, radius 2", 100, &|mask, k| stroke(mask, INK(2.0), &[[0.0, f64::from(k)], [1024.0, 1024.0]]));
    time("level line, radius 2", 100, &|mask, k| {
        stroke(mask, INK(2.0), &[[0.0, 3.0 + f64::from(k)], [1024.0, 3.3 + f64::from(k)]]);
    });
}
