//! Random bitmaps: whatever they are, the mesh is a mesh, or there is a message.

use std::collections::BTreeMap;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::super::plane::{doubled_area, turn};
use super::super::*;

/// Pictures in the test that always runs.
const FEW: u64 = 400;

/// Pictures in the test that is asked for.
const MANY: u64 = 10_000;

/// Paints a disc of ink, or of none.
fn dab(picture: &mut Picture, x: f64, y: f64, radius: f64, value: u8) {
    for v in 0..picture.height {
        for u in 0..picture.width {
            if (f64::from(u) + 0.5 - x).powi(2) + (f64::from(v) + 0.5 - y).powi(2) <= radius * radius {
                let at = 4 * (v * picture.width + u) as usize;
                picture.rgba[at..at + 3].fill(value);
            }
        }
    }
}

fn strokes(picture: &mut Picture, random: &mut Pcg64, radius: f64) {
    let side = f64::from(picture.width.max(picture.height));
    for _ in 0..random.random_range(1..6) {
        let (mut x, mut y): (f64, f64) = (random.random_range(0.0..side), random.random_range(0.0..side));
        let mut heading: f64 = random.random_range(0.0..std::f64::consts::TAU);
        for _ in 0..random.random_range(5..120) {
            dab(picture, x, y, radius, 0);
            heading += random.random_range(-0.4..0.4);
            (x, y) = (x + 0.7 * libm::cos(heading), y + 0.7 * libm::sin(heading));
        }
    }
}

/// A random picture and settings, by number.
fn random_case(seed: u64) -> (Picture, Settings) {
    let mut random = Pcg64::seed_from_u64(seed);
    let largest = [8, 24, 64, 128][random.random_range(0..4)];
    let (width, height) = (random.random_range(1..=largest), random.random_range(1..=largest));
    let mut picture = Picture::filled(width, height, [255; 4]);
    let kind = random.random_range(0..10);
    match kind {
        0 | 1 => {
            let density: f64 = random.random_range(0.0..1.0);
            for pixel in picture.rgba.chunks_exact_mut(4) {
                let is_ink = random.random_range(0.0..1.0) < density;
                let value = if kind == 0 { 255 * u8::from(!is_ink) } else { random.random_range(0..=255) };
                pixel[..3].fill(value);
            }
        }
        2..=4 => {
            for _ in 0..random.random_range(1..12) {
                let (x, y) = (random.random_range(0.0..f64::from(width)), random.random_range(0.0..f64::from(height)));
                let radius = random.random_range(0.5..0.4 * f64::from(largest));
                dab(&mut picture, x, y, radius, [0, 0, 255, 120][random.random_range(0..4)]);
            }
        }
        5 | 6 => {
            let radius = random.random_range(0.4..4.0);
            strokes(&mut picture, &mut random, radius);
        }
        7 => {
            let cell = random.random_range(1..9);
            for (k, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
                let (x, y) = (k as u32 % width, k as u32 / width);
                pixel[..3].fill(255 * (((x / cell + y / cell) % 2) as u8));
            }
        }
        8 => {
            let fill = [0, 255, 90][random.random_range(0..3)];
            picture = Picture::filled(width, height, [fill, fill, fill, 255]);
            for _ in 0..random.random_range(0..4) {
                let at = 4 * random.random_range(0..(width * height) as usize);
                picture.rgba[at..at + 3].fill(255 - fill);
            }
        }
        _ => {
            // Smooth dabs over strokes, with grain.
            strokes(&mut picture, &mut random, 0.6);
            dab(&mut picture, 0.4 * f64::from(width), 0.5 * f64::from(height), 0.3 * f64::from(height), 0);
            for pixel in picture.rgba.chunks_exact_mut(4) {
                let grain: i32 = random.random_range(-90..=90);
                let value = (i32::from(pixel[0]) + grain).clamp(0, 255) as u8;
                pixel[..3].fill(value);
            }
        }
    }
    let spacing = [2.0, 4.0, 8.0, 16.0, 1.0, 40.0][random.random_range(0..6)] * random.random_range(1.0..1.6);
    let size = match random.random_range(0..6) {
        0 => Size::Graded { spacing, ratio: random.random_range(1.0..9.0) },
        1 => Size::MaxArea(0.5 * spacing * spacing + 0.7),
        _ => Size::Spacing(spacing),
    };
    let settings = Settings {
        threshold: if random.random_range(0..3) == 0 {
            Threshold::At(random.random_range(0.0..=1.0))
        } else {
            Threshold::Otsu
        },
        invert: random.random_range(0..4) == 0,
        fill_holes: random.random_range(0..5) == 0,
        min_area: [0.0, 1.0, 4.0, 12.0, 100.0][random.random_range(0..5)],
        size,
        strokes: [Strokes::Ropes, Strokes::Ropes, Strokes::Mesh, Strokes::Widen, Strokes::Drop]
            [random.random_range(0..5)],
        thin: [0.5, 0.5, 0.3, 0.9][random.random_range(0..4)],
        blur: [0, 0, 0, 1, 3][random.random_range(0..5)],
    };
    (picture, settings)
}

/// Checks all that every mesh must be.
pub(super) fn check_mesh(mesh: &PictureMesh) {
    let count = mesh.points.len();
    assert!(mesh.points.iter().flatten().all(|x| x.is_finite()));
    assert!(mesh.texture.iter().flatten().all(|x| (0.0..=1.0).contains(x)));
    assert!(mesh.areas.iter().all(|area| area.is_finite() && *area >= 0.0));
    assert_eq!([mesh.texture.len(), mesh.areas.len(), mesh.component.len()], [count; 3]);
    let mut sides: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    let mut used = vec![false; count];
    for &[a, b, c] in &mesh.triangles {
        let [p, q, r] = [a, b, c].map(|k| mesh.points[k as usize]);
        // Anticlockwise with y up is clockwise with y down.
        assert!(turn(p, q, r) < 0.0, "triangle {a} {b} {c} has twice the area {}", turn(p, q, r));
        for [i, j] in [[a, b], [b, c], [c, a]] {
            *sides.entry([i.min(j), i.max(j)]).or_default() += 1;
            used[i as usize] = true;
            assert!((i as usize) < mesh.mesh_points);
        }
    }
    assert!(used[..mesh.mesh_points].iter().all(|&used| used), "a point of no triangle");
    let bonds: Vec<[u32; 2]> = sides.keys().copied().collect();
    assert_eq!(bonds, mesh.bonds[..mesh.mesh_bonds], "bonds are the sides of triangles");
    assert!(sides.values().all(|&count| count <= 2), "a side of three triangles");
    let mut ropes = mesh.bonds[mesh.mesh_bonds..].to_vec();
    assert!(ropes.iter().all(|&[a, b]| a < b && (b as usize) < count && !sides.contains_key(&[a, b])));
    ropes.sort_unstable();
    assert!(ropes.windows(2).all(|pair| pair[0] != pair[1]), "two ropes on one bond");
    // The loops are the sides of one triangle, and their points come first, in order.
    let mut single: Vec<[u32; 2]> = sides.iter().filter(|(_, count)| **count == 1).map(|(side, _)| *side).collect();
    let ring = |one: &Vec<u32>| (0..one.len()).map(|k| [one[k], one[(k + 1) % one.len()]]).collect::<Vec<_>>();
    let mut around: Vec<[u32; 2]> = mesh.loops.iter().flat_map(ring).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    single.sort_unstable();
    around.sort_unstable();
    assert_eq!(single, around);
    assert!(mesh.loops.iter().flatten().copied().eq(0..around.len() as u32));
    // Euler: loops of ink and of holes make up for points, sides and triangles.
    let area = |one: &Vec<u32>| {
        let points: Vec<Point> = one.iter().map(|&k| mesh.points[k as usize]).collect();
        doubled_area(&points)
    };
    let outer = mesh.loops.iter().filter(|one| area(one) > 0.0).count() as i64;
    let euler = mesh.mesh_points as i64 - mesh.mesh_bonds as i64 + mesh.triangles.len() as i64;
    assert_eq!(euler, 2 * outer - mesh.loops.len() as i64);
    let total: f64 = mesh.loops.iter().map(area).sum();
    let triangles: f64 =
        mesh.triangles.iter().map(|t| t.map(|k| mesh.points[k as usize])).map(|[a, b, c]| turn(a, c, b)).sum();
    assert!((total - triangles).abs() <= 1e-9 * total.abs().max(1.0), "triangles overlap: {triangles} in {total}");
}

fn check_case(seed: u64) {
    let (picture, settings) = random_case(seed);
    check(seed, &picture, &settings);
}

fn check(seed: u64, picture: &Picture, settings: &Settings) {
    match mesh_picture(picture, settings) {
        Ok(made) => {
            check_mesh(&made.mesh);
            let stats = made.stats();
            if settings.strokes == Strokes::Mesh {
                assert_eq!([stats.components, stats.holes], [stats.ink_components, stats.ink_holes], "case {seed}");
            }
            // Where there are but two values, strokes connect as contours do.
            let first = picture.rgba[0];
            let is_plain =
                picture.rgba.chunks_exact(4).all(|p| p[0] == first || p[0] == 255 - first && p[0] % 255 == 0);
            if settings.strokes == Strokes::Ropes
                && is_plain
                && settings.blur == 0
                && settings.threshold == Threshold::Otsu
            {
                assert_eq!(stats.components, stats.ink_components, "case {seed}");
            }
            if let Size::MaxArea(area) = settings.size {
                let largest = made.mesh.triangles.iter().map(|t| t.map(|k| made.mesh.points[k as usize]));
                let largest = largest.map(|[a, b, c]| 0.5 * turn(a, c, b)).fold(0.0, f64::max);
                assert!(largest <= area * (1.0 + 1e-9), "case {seed}: {largest} px^2 for {area}");
            }
        }
        Err(PictureError::Empty { .. } | PictureError::Dropped { .. } | PictureError::Thin | PictureError::NoBody) => {}
        Err(error) => panic!("case {seed}: {error}"),
    }
}

fn check_all(seeds: std::ops::Range<u64>) {
    let failed: Vec<u64> = seeds
        .filter(|&seed| {
            std::panic::catch_unwind(|| check_case(seed)).inspect_err(|_| eprintln!("case {seed} failed")).is_err()
        })
        .collect();
    assert!(failed.is_empty(), "cases {failed:?} failed");
}

#[test]
fn random_pictures_make_meshes() {
    check_all(0..FEW);
}

#[test]
#[ignore = "takes minutes: run it after a change to the meshing"]
fn many_random_pictures_make_meshes() {
    check_all(0..MANY);
}

/// A pixel of a stroke that touches two thick parts was tied to one of them only.
#[test]
fn frozen_a_stroke_between_two_thick_parts_ties_both() {
    let (picture, settings) = random_case(4159);
    check(4159, &picture, &Settings { blur: 0, ..settings });
}
