//! Tiny random bitmaps of thin strokes: what is connected, and what is a hole, is counted by hand.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::super::plane::distance;
use super::super::*;

const PICTURES: u64 = 2_000;

/// How many parts the pixels of one kind have: ink connects across corners, paper does not.
fn parts(side: usize, is_in: &dyn Fn(usize, usize) -> bool, across: bool) -> usize {
    let mut left: BTreeSet<[usize; 2]> =
        (0..side * side).map(|k| [k % side, k / side]).filter(|&[x, y]| is_in(x, y)).collect();
    let mut count = 0;
    while let Some(start) = left.pop_first() {
        count += 1;
        let mut open = vec![start];
        while let Some([x, y]) = open.pop() {
            let near = |other: &[usize; 2]| {
                let (dx, dy) = (other[0].abs_diff(x), other[1].abs_diff(y));
                if across { dx.max(dy) == 1 } else { dx + dy == 1 }
            };
            let found: Vec<[usize; 2]> = left.iter().filter(|other| near(other)).copied().collect();
            found.iter().for_each(|one| {
                left.remove(one);
            });
            open.extend(found);
        }
    }
    count
}

/// How the holes of a mesh compare to those of its ink.
#[derive(Clone, Copy, PartialEq)]
enum Holes {
    Right,
    Closed,
    Wrong,
}

/// Checks the mesh of a tiny bitmap, by number.
fn holes(seed: u64) -> Holes {
    let mut random = Pcg64::seed_from_u64(seed);
    let side = random.random_range(3..12);
    let density = random.random_range(0.3..0.8);
    let ink: Vec<bool> = (0..side * side).map(|_| random.random_range(0.0..1.0) < density).collect();
    let spacing = [2.0, 3.0, 4.0, 6.0, 9.0][random.random_range(0..5)];
    let mut picture = Picture::filled(side as u32, side as u32, [255; 4]);
    for (pixel, _) in picture.rgba.chunks_exact_mut(4).zip(&ink).filter(|(_, ink)| **ink) {
        pixel[..3].fill(0);
    }
    // With a margin of paper, as the pictures' surroundings are.
    let is_ink = |x: usize, y: usize| {
        let inside = (1..=side).contains(&x) && (1..=side).contains(&y);
        inside && ink[(y - 1) * side + x - 1]
    };
    let want = [parts(side + 2, &is_ink, true), parts(side + 2, &|x, y| !is_ink(x, y), false) - 1];
    let settings =
        Settings { threshold: Threshold::At(0.5), min_area: 0.0, size: Size::Spacing(spacing), ..Settings::default() };
    let made = match mesh_picture(&picture, &settings) {
        Ok(made) => made,
        Err(PictureError::Empty { .. } | PictureError::NoBody) => return Holes::Right,
        Err(error) => panic!("case {seed}: {error}"),
    };
    let (mesh, stats) = (&made.mesh, made.stats());
    let at = |k: u32| mesh.points[k as usize];
    let mut points = mesh.points.clone();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let of_ropes = mesh.bonds[mesh.mesh_bonds..].iter().map(|&[a, b]| distance(at(a), at(b)));
    let shortest = of_ropes.fold(f64::INFINITY, f64::min);
    assert!(shortest > 1e-3, "case {seed}: a bond of {shortest} px");
    assert!(points.windows(2).all(|pair| pair[0] != pair[1]), "case {seed}: two points in one place");
    assert_eq!([stats.ink_components, stats.ink_holes], want, "case {seed}");
    assert_eq!(stats.components, want[0], "case {seed}");
    match stats.holes.cmp(&want[1]) {
        Ordering::Equal => Holes::Right,
        Ordering::Greater => Holes::Wrong,
        // A hole between a mesh and a stroke too short for a bond is closed.
        Ordering::Less if mesh.mesh_points > 0 => Holes::Closed,
        Ordering::Less => Holes::Wrong,
    }
}

#[test]
fn tiny_bitmaps_keep_their_parts_and_holes_and_have_no_points_in_one_place() {
    let found: Vec<Holes> = (0..PICTURES).map(holes).collect();
    let count = |which| found.iter().filter(|one| **one == which).count();
    // Junctions that are joined over several pixels may close a ring about no hole, in the thick of noise.
    assert!(count(Holes::Wrong) <= 20, "{} of {PICTURES} have other holes than their ink", count(Holes::Wrong));
    assert!(count(Holes::Closed) <= 110, "{} of {PICTURES} lost a hole", count(Holes::Closed));
}

/// A ring whose junctions are joined ran out and back, and two of its points lay in one place.
#[test]
fn frozen_rings_through_joined_junctions_stay_open() {
    let ink = "101111 100101 110101 011011 111001 100111";
    let values =
        ink.bytes().filter(|byte| *byte != b' ').flat_map(|byte| [255 * (b'1' - byte); 3].into_iter().chain([255]));
    let picture = Picture { width: 6, height: 6, rgba: values.collect() };
    let settings = Settings { min_area: 0.0, size: Size::Spacing(4.0), ..Settings::default() };
    let made = mesh_picture(&picture, &settings).unwrap();
    let (mesh, stats) = (&made.mesh, made.stats());
    assert_eq!([stats.components, stats.holes], [stats.ink_components, stats.ink_holes]);
    for &[a, b] in &mesh.bonds {
        assert!(distance(mesh.points[a as usize], mesh.points[b as usize]) > 0.1);
    }
}
