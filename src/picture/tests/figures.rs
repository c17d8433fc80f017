//! Figures whose area, angles, parts and holes are known.

use std::f64::consts::PI;

use super::super::plane::{Point, distance, turn};
use super::super::*;
use super::robustness::check_mesh;

/// Draws a figure, smooth over a pixel, from the distance to its edge, negative inside `[px]`.
pub(super) fn draw(side: u32, off: impl Fn(f64, f64) -> f64) -> Picture {
    let mut picture = Picture::filled(side, side, [0, 0, 0, 255]);
    for (k, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
        let (x, y) = ((k as u32 % side) as f64 + 0.5, (k as u32 / side) as f64 + 0.5);
        let ink = (0.5 - off(x, y)).clamp(0.0, 1.0);
        pixel[3] = (255.0 * ink).round() as u8;
    }
    picture
}

fn hypot(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

fn make(picture: &Picture, spacing: f64) -> (PictureMesh, Stats) {
    let settings = Settings { size: Size::Spacing(spacing), ..Settings::default() };
    let made = mesh_picture(picture, &settings).unwrap();
    check_mesh(&made.mesh);
    let stats = made.stats();
    assert_eq!([stats.components, stats.holes], [stats.ink_components, stats.ink_holes]);
    (made.mesh, stats)
}

/// What smooth shapes must reach.
fn check_smooth(stats: &Stats, spacing: f64) {
    assert!(stats.min_angle_deg >= 35.0, "{stats:?}");
    assert!(stats.p1_angle_deg >= 42.0, "{stats:?}");
    assert!(stats.edge_cv <= 0.09, "{stats:?}");
    assert!(stats.area_error <= 1e-3, "{stats:?}");
    assert!(stats.shortest_edge >= 0.3 * spacing, "{stats:?}");
    assert!(stats.boundary_deviation_px <= tolerance(spacing), "{stats:?}");
}

#[test]
fn a_ring_has_its_area_and_good_triangles_at_every_spacing() {
    let picture = draw(512, |x, y| (hypot(x - 255.3, y - 256.9) - 160.0).abs() - 65.0);
    let area = PI * (225.0 * 225.0 - 95.0 * 95.0);
    for spacing in [3.0, 4.0, 6.5, 8.0, 12.0, 16.0] {
        let (mesh, stats) = make(&picture, spacing);
        check_smooth(&stats, spacing);
        assert_eq!((stats.components, stats.holes, mesh.loops.len()), (1, 1, 2));
        assert!((stats.area_px - area).abs() < 2e-3 * area, "{} for {area}", stats.area_px);
        assert!((mesh.areas.iter().sum::<f64>() - stats.area_px).abs() < 1e-6 * area);
        // The count is that of a lattice, more or less: an equilateral triangle for each 0.433 squares.
        let count = area / (0.433 * spacing * spacing);
        assert!((stats.triangles as f64 / count - 1.0).abs() < 0.1, "{} triangles for {count}", stats.triangles);
    }
}

#[test]
fn small_discs_keep_their_area() {
    for radius in [4.0, 8.0, 15.0, 30.0, 60.0] {
        let (_, stats) = make(&draw(160, |x, y| hypot(x - 80.2, y - 79.7) - radius), 16.0);
        let area = PI * radius * radius;
        assert!((stats.area_px - area).abs() < 0.01 * area + 2.0, "radius {radius}: {stats:?}");
        assert!(stats.area_error < if radius < 80.0 { 5e-3 } else { 1e-3 }, "radius {radius}: {stats:?}");
        assert!(stats.min_angle_deg > 30.0, "radius {radius}: {stats:?}");
    }
}

#[test]
fn a_turned_square_has_its_four_corners() {
    for turn in 0..9 {
        let (s, c) = (libm::sin(0.19 * f64::from(turn)), libm::cos(0.19 * f64::from(turn)));
        let local = |x: f64, y: f64| [c * (x - 128.0) + s * (y - 128.0), c * (y - 128.0) - s * (x - 128.0)];
        let picture = draw(256, |x, y| local(x, y)[0].abs().max(local(x, y)[1].abs()) - 80.0);
        let (mesh, stats) = make(&picture, 10.0);
        assert!(stats.area_error <= 1e-3 && stats.min_angle_deg >= 30.0, "turn {turn}: {stats:?}");
        for [u, v] in [[-80.0, -80.0], [80.0, -80.0], [80.0, 80.0], [-80.0, 80.0]] {
            let corner = [128.0 + c * u - s * v, 128.0 + s * u + c * v];
            let near = mesh.points.iter().map(|&p| distance(p, corner)).fold(f64::INFINITY, f64::min);
            assert!(near < 0.6, "turn {turn}: nearest point to a corner is {near} px away");
        }
    }
}

#[test]
fn parts_and_holes_are_counted_and_islands_stand_alone() {
    // A target of three rings about a disc, and a plate with four holes.
    let picture = draw(512, |x, y| {
        let r = hypot(x - 130.0, y - 130.0);
        let target = ((r / 30.0).rem_euclid(2.0) - 1.0).abs() * 30.0 - 15.0;
        let target = target.max(r - 105.0);
        let plate = (x - 340.0).abs().max((y - 370.0).abs()) - 110.0;
        let hole = |u: f64, v: f64| 25.0 - hypot(x - u, y - v);
        let holes = hole(290.0, 320.0).max(hole(390.0, 320.0)).max(hole(290.0, 420.0)).max(hole(390.0, 420.0));
        target.min(plate.max(holes))
    });
    let (mesh, stats) = make(&picture, 6.0);
    assert_eq!((stats.components, stats.holes), (3, 2 + 4));
    for &[a, b, c] in &mesh.triangles {
        let part = |k: u32| mesh.component[k as usize];
        assert!(part(a) == part(b) && part(b) == part(c));
    }
    let settings = Settings { size: Size::Spacing(6.0), fill_holes: true, ..Settings::default() };
    let filled = mesh_picture(&picture, &settings).unwrap().stats();
    assert_eq!((filled.components, filled.holes), (2, 0));
}

/// Lines of a pixel in black on white.
fn lines(draw: impl Fn(i32, i32) -> bool) -> Picture {
    let mut picture = Picture::filled(200, 200, [255; 4]);
    for (k, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
        if draw(k as i32 % 200, k as i32 / 200) {
            pixel[..3].fill(0);
        }
    }
    picture
}

#[test]
fn lines_of_a_pixel_survive_in_one_piece() {
    let diagonal = lines(|x, y| x == y && (20..180).contains(&x));
    let (mesh, stats) = make(&diagonal, 16.0);
    assert_eq!((stats.components, stats.holes, mesh.mesh_points), (1, 0, 0));
    let length: f64 = mesh.bonds.iter().map(|b| distance(mesh.points[b[0] as usize], mesh.points[b[1] as usize])).sum();
    assert!((length - 159.0 * 2.0_f64.sqrt()).abs() < 1.0);
    assert_eq!(mesh.bonds.len(), 14);
    assert!((mesh.areas.iter().sum::<f64>() - 160.0).abs() < 1.0);

    let circle = lines(|x, y| (hypot(f64::from(x) - 100.0, f64::from(y) - 100.0) - 80.0).abs() < 0.5);
    let (mesh, stats) = make(&circle, 16.0);
    assert_eq!((stats.components, stats.holes, mesh.mesh_points), (1, 1, 0));
    let radius = |p: &Point| distance(*p, [100.5, 100.5]);
    assert!(mesh.points.iter().all(|p| (radius(p) - 80.0).abs() < 1.0));
}

#[test]
fn earcut_finds_the_same_area_in_the_loops() {
    let picture = draw(300, |x, y| {
        let plate = (x - 150.0).abs().max((y - 150.0).abs()) - 120.0;
        plate.max(40.0 - hypot(x - 100.0, y - 110.0)).max(30.0 - hypot(x - 200.0, y - 190.0))
    });
    let (mesh, stats) = make(&picture, 9.0);
    assert_eq!(mesh.loops.len(), 3);
    let corners: Vec<f64> = mesh.loops.iter().flatten().flat_map(|&k| mesh.points[k as usize]).collect();
    let holes = [mesh.loops[0].len(), mesh.loops[0].len() + mesh.loops[1].len()];
    let ears = earcutr::earcut(&corners, &holes, 2).unwrap();
    let (ears, _) = ears.as_chunks::<3>();
    let area = |ear: &[usize; 3]| {
        let [a, b, c] = ear.map(|k| [corners[2 * k], corners[2 * k + 1]]);
        0.5 * turn(a, b, c).abs()
    };
    assert!((ears.iter().map(area).sum::<f64>() - stats.area_px).abs() < 1e-6);
}

#[test]
fn a_letter_keeps_its_hairline_serifs() {
    let letter = lines(|x, y| {
        (80..120).contains(&x) && (30..170).contains(&y) || (y == 30 || y == 169) && (30..170).contains(&x)
    });
    let (mesh, stats) = make(&letter, 12.0);
    assert_eq!((stats.components, stats.holes), (1, 0));
    assert!(mesh.points.len() > mesh.mesh_points && !mesh.triangles.is_empty());
    let ends = [[30.5, 30.5], [169.5, 30.5], [30.5, 169.5], [169.5, 169.5]];
    for end in ends {
        assert!(mesh.points.iter().any(|&p| distance(p, end) < 1.5), "no point at {end:?}");
    }
    for (strokes, has_end) in [(Strokes::Drop, false), (Strokes::Widen, true)] {
        let settings = Settings { size: Size::Spacing(12.0), strokes, ..Settings::default() };
        let made = mesh_picture(&letter, &settings).unwrap();
        check_mesh(&made.mesh);
        assert_eq!((made.mesh.components, made.mesh.mesh_points), (1, made.mesh.points.len()));
        assert_eq!(made.mesh.points.iter().any(|&p| distance(p, ends[0]) < 8.0), has_end);
    }
}

#[test]
fn a_handle_is_tied_to_the_mesh_at_both_ends() {
    let cup = lines(|x, y| {
        let handle = (hypot(f64::from(x) - 130.0, f64::from(y) - 100.0) - 40.0).abs() < 1.0;
        (30..120).contains(&x) && (40..160).contains(&y) || handle && x >= 120
    });
    let (mesh, stats) = make(&cup, 10.0);
    assert_eq!((stats.components, stats.holes), (1, 1));
    let ropes = &mesh.bonds[mesh.mesh_bonds..];
    let ties = ropes.iter().filter(|bond| (bond[0] as usize) < mesh.mesh_points).count();
    assert_eq!(ties, 2);
    // The rope's ends are the points of the boundary that are nearest to where it meets the cup, but for a pixel.
    for place in [[120.0, 61.8], [120.0, 139.2]] {
        let off = |k: u32| distance(mesh.points[k as usize], place);
        let nearest = mesh.loops[0].iter().map(|&k| off(k)).fold(f64::INFINITY, f64::min);
        assert!(ropes.iter().any(|bond| off(bond[0]) < nearest + 1.5), "{place:?}");
    }
}

#[test]
fn graded_meshes_are_coarser_inside() {
    let picture = draw(512, |x, y| hypot(x - 256.0, y - 256.0) - 240.0);
    let mut before = usize::MAX;
    for ratio in [1.0, 1.8, 3.0, 5.2, 9.0] {
        let settings = Settings { size: Size::Graded { spacing: 6.0, ratio }, ..Settings::default() };
        let made = mesh_picture(&picture, &settings).unwrap();
        check_mesh(&made.mesh);
        let stats = made.stats();
        assert!(stats.min_angle_deg >= 29.9, "ratio {ratio}: {stats:?}");
        assert!(stats.points < before, "ratio {ratio}");
        before = stats.points;
    }
}

#[test]
fn pictures_of_the_gallery_have_no_thin_triangles() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/pictures");
    for name in ["brush", "gear", "jellyfish", "letter", "maze", "pebble", "ring"] {
        let picture = decode(&std::fs::read(folder.join(name).with_extension("png")).unwrap()).unwrap();
        for spacing in [6.0, 8.0, 11.0, 16.0] {
            let (_, stats) = make(&picture, spacing);
            // Where the maze's walls meet, corners that pixels rounded off are met by short sides.
            let least = if name == "maze" && spacing < 10.0 { 20.0 } else { 29.5 };
            assert!(stats.min_angle_deg >= least, "{name}, {spacing} px: {stats:?}");
            assert!(stats.boundary_deviation_px <= tolerance(spacing), "{name}, {spacing} px: {stats:?}");
        }
    }
}

#[test]
fn no_triangle_is_larger_than_asked_for() {
    let picture = draw(256, |x, y| hypot(x - 128.0, y - 128.0) - 100.0);
    for max_area in [10.0, 50.0, 300.0] {
        let settings = Settings { size: Size::MaxArea(max_area), ..Settings::default() };
        let made = mesh_picture(&picture, &settings).unwrap();
        let corners = made.mesh.triangles.iter().map(|t| t.map(|k| made.mesh.points[k as usize]));
        let largest = corners.map(|[a, b, c]| 0.5 * turn(a, c, b)).fold(0.0, f64::max);
        assert!(largest <= max_area, "{largest}");
        // Not many more than needed.
        assert!((made.mesh.triangles.len() as f64) < 2.2 * PI * 1e4 / max_area);
    }
}

#[test]
fn a_picture_that_is_cut_into_parts_makes_the_same_bits_in_pools_of_one_two_and_five_threads() {
    let picture = draw(400, |x, y| (hypot(x - 200.0, y - 200.0) - 110.0 - 30.0 * libm::sin(x / 11.0)).abs() - 40.0);
    assert!(picture.rgba.len() / 4 > 2 * coverage::PART, "it is taken in three parts");
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let made = pool.install(|| mesh_picture(&picture, &Settings::default()).unwrap());
        let bits: Vec<u64> = made.mesh.points.iter().flatten().map(|x| x.to_bits()).collect();
        (bits, made.mesh)
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(5));
}

#[test]
fn a_full_picture_is_a_rectangle_and_an_empty_one_an_error() {
    let (mesh, stats) = make(&Picture::filled(120, 80, [0, 0, 0, 255]), 10.0);
    assert_eq!(mesh.loops.len(), 1);
    assert!((stats.area_px - 9600.0).abs() < 1.0);
    let empty = mesh_picture(&Picture::filled(120, 80, [255; 4]), &Settings::default()).unwrap_err();
    assert!(empty.to_string().contains("nothing in the picture"));
    let speck = lines(|x, y| x == 50 && y == 50);
    let dropped = mesh_picture(&speck, &Settings::default()).unwrap_err();
    assert_eq!(dropped, PictureError::Dropped { min_area: 12.0 });
}

#[test]
fn settings_out_of_range_and_too_many_points_are_told() {
    let picture = Picture::filled(4000, 4000, [0, 0, 0, 255]);
    let with = |change: fn(&mut Settings)| {
        let mut settings = Settings::default();
        change(&mut settings);
        mesh_picture(&picture, &settings).unwrap_err().to_string()
    };
    assert_eq!(with(|s| s.size = Size::Spacing(f64::NAN)), "spacing is NaN: it must be from 1 to 4096 px");
    assert_eq!(with(|s| s.size = Size::MaxArea(0.0)), "max_area is 0: it must be from 0.7 to 1e7 px^2");
    assert_eq!(with(|s| s.threshold = Threshold::At(1.1)), "threshold is 1.1: it must be from 0 to 1");
    assert!(with(|s| s.min_area = -1.0).starts_with("min_area is -1"));
    assert!(with(|s| s.thin = 2.0).starts_with("thin is 2"));
    assert!(with(|s| s.size = Size::Graded { spacing: 5.0, ratio: 0.0 }).starts_with("grading is 0"));
    assert!(with(|s| s.size = Size::Spacing(1.0)).contains("4000000 are the most; 3 px would do"));
}

#[test]
fn specks_of_noise_are_dropped_in_ink_and_beside_it() {
    let mut state = 1_u64;
    let mut picture = draw(256, |x, y| hypot(x - 128.0, y - 128.0) - 90.0);
    for pixel in picture.rgba.chunks_exact_mut(4) {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        if state >> 59 == 0 {
            pixel[3] = 255 - pixel[3];
        }
    }
    let made = mesh_picture(&picture, &Settings::default()).unwrap();
    check_mesh(&made.mesh);
    let stats = made.stats();
    assert_eq!((stats.components, stats.holes), (1, 0));
    assert!((stats.area_px / (PI * 8100.0) - 1.0).abs() < 0.01);
}
