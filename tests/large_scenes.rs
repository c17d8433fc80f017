//! Pictures of large scenes: what is not in view is not drawn, and what cannot be told apart is drawn by fewer.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

use crate::common;

use common::picture::{between, bond, plain, view};
use glam::{DVec2, DVec3};
use image::RgbaImage;
use wobble::render::{Camera, Capture, Look, Overlay, Pose, RenderCounters, View};
use wobble::sim::{Bond, Bonds, PointId, Positions};

const SIDE: u32 = 256;

/// A cloth with both diagonals, its first point at `corner` and its neighbours a metre apart, in the plane z = 0.
fn cloth([columns, rows]: [u32; 2], corner: [f32; 2], dimensions: usize) -> (Vec<f32>, Bonds) {
    let at = |i: u32| [corner[0] + (i % columns) as f32, corner[1] + (i / columns) as f32, 0.0];
    let flat = (0..columns * rows).flat_map(|i| at(i).into_iter().take(dimensions)).collect();
    let mut bonds = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let mut link = |[a, b]: [[u32; 2]; 2], length| {
                if a[0].max(b[0]) < columns && b[1] < rows {
                    bonds.push(Bond { rest_length: length, ..bond(a[1] * columns + a[0], b[1] * columns + b[0]) });
                }
            };
            link([[column, row], [column + 1, row]], 1.0);
            link([[column, row], [column, row + 1]], 1.0);
            link([[column, row], [column + 1, row + 1]], 2.0_f64.sqrt());
            link([[column + 1, row], [column, row + 1]], 2.0_f64.sqrt());
        }
    }
    (flat, bonds.into())
}

/// 40,000 points and 159,000 bonds around the origin.
fn large(dimensions: usize) -> (Vec<f32>, Bonds) {
    cloth([200, 200], [-99.5, -99.5], dimensions)
}

fn camera(center: [f64; 2], height: f64) -> Camera {
    Camera::new(Pose::Plane { center: DVec2::from(center), height }, [SIDE, SIDE])
}

fn orbit(target: DVec3, distance: f64) -> Camera {
    Camera::new(Pose::Orbit { target, distance, yaw: 0.3, pitch: 0.2 }, [SIDE, SIDE])
}

/// White bonds of the usual width, no points.
fn look() -> Look {
    Look { point: [0.0; 4], bond_width: 1.8, ..plain() }
}

fn capture(dimensions: usize) -> Capture {
    Capture::new([SIDE, SIDE], dimensions).unwrap()
}

/// A picture, and what drawing it added to the counters.
fn picture(capture: &mut Capture, view: &View<'_>, camera: &Camera, look: &Look) -> (RgbaImage, RenderCounters) {
    let before = *capture.renderer().counters();
    let picture = capture.picture(view, camera, look).unwrap();
    let after = *capture.renderer().counters();
    let counters = RenderCounters {
        triangles_drawn: after.triangles_drawn - before.triangles_drawn,
        uploads: after.uploads - before.uploads,
        bytes_uploaded: after.bytes_uploaded - before.bytes_uploaded,
        bytes_held: after.bytes_held,
        submits: after.submits - before.submits,
        frames_drawn: after.frames_drawn - before.frames_drawn,
        draws: after.draws - before.draws,
        bonds_drawn: after.bonds_drawn - before.bonds_drawn,
        dots_drawn: after.dots_drawn - before.dots_drawn,
        obstacle_triangles_drawn: after.obstacle_triangles_drawn - before.obstacle_triangles_drawn,
        points_drawn: after.points_drawn - before.points_drawn,
        points_bounded: after.points_bounded - before.points_bounded,
    };
    (picture, counters)
}

/// Asserts that pictures are the same but for rounding: shapes that overlap are blended in another order.
fn assert_same(a: &RgbaImage, b: &RgbaImage, what: &str) {
    for (x, y, pixel) in a.enumerate_pixels() {
        let other = b.get_pixel(x, y);
        let off = (0..3).map(|k| pixel[k].abs_diff(other[k])).max().unwrap();
        assert!(off <= 3, "{what}: {x} {y}: {pixel:?} {other:?}");
    }
}

#[test]
fn what_is_out_of_view_is_not_drawn_and_nothing_in_view_is_missing() {
    if common::gpu().is_none() {
        return;
    }
    let (flat, bonds) = large(2);
    let mut capture = capture(2);
    // What small nets enclose is filled, large ones are bonds alone.
    let look = Look { point: [1.0; 4], point_radius: 1.2, has_fills: false, ..look() };
    for center in [[0.0, 0.0], [-37.3, 51.9], [90.0, -95.0]] {
        let camera = camera(center, 20.0);
        let (seen, done) = picture(&mut capture, &view(&flat, &bonds, 2), &camera, &look);
        // 1 % of the scene is in view: 400 points of 40,000.
        assert!(done.bonds_drawn < bonds.len() as u64 / 10, "{done:?}");
        assert!(done.points_drawn < 40_000 / 10, "{done:?}");
        assert!(done.draws < 40, "{done:?}");
        let corner = center.map(|x| (x - 20.0).floor().max(-100.0) as f32 + 0.5);
        let size = [0, 1].map(|axis| 40.min((99.5 - corner[axis]) as u32 + 1));
        let (near_flat, near_bonds) = cloth(size, corner, 2);
        let alone = Capture::new([SIDE, SIDE], 2).unwrap().picture(&view(&near_flat, &near_bonds, 2), &camera, &look);
        assert_same(&seen, &alone.unwrap(), "as a small scene of what is in view");
    }
    let (seen, done) = picture(&mut capture, &view(&flat, &bonds, 2), &camera([500.0, 0.0], 20.0), &look);
    assert_eq!((done.bonds_drawn, done.points_drawn), (0, 0), "nothing is in view");
    assert!(seen.pixels().all(|pixel| pixel.0 == [0, 0, 0, 255]));
}

#[test]
fn parts_come_into_view_when_they_move() {
    if common::gpu().is_none() {
        return;
    }
    let (flat, bonds) = large(2);
    let away: Vec<f32> = flat.iter().map(|x| x + 1000.0).collect();
    let camera = camera([0.0, 0.0], 20.0);
    for double in [false, true] {
        let wide = [&flat, &away].map(|flat| flat.iter().map(|&x| f64::from(x)).collect::<Vec<f64>>());
        let [here, there] = if double {
            [Positions::F64(&wide[0]), Positions::F64(&wide[1])]
        } else {
            [Positions::F32(&flat), Positions::F32(&away)]
        };
        let mut capture = capture(2);
        let state = |previous, current, mix, motion| View { previous, current, mix, motion, ..view(&[], &bonds, 2) };
        let mut drawn = |view: &View<'_>| picture(&mut capture, view, &camera, &look()).1.bonds_drawn;
        assert_eq!(drawn(&state(there, there, 1.0, 0)), 0);
        assert!(drawn(&state(here, here, 1.0, 1)) > 0, "it is here now");
        assert!(drawn(&state(here, there, 0.0, 2)) > 0, "it was here, and that is what is drawn");
        assert_eq!(drawn(&state(there, there, 1.0, 3)), 0);
    }
}

#[test]
fn the_camera_alone_uploads_no_positions_and_looks_at_no_point_twice() {
    if common::gpu().is_none() {
        return;
    }
    let (flat, bonds) = large(2);
    let mut capture = capture(2);
    let seen = view(&flat, &bonds, 2);
    let mut done = |view: &View<'_>, camera: &Camera| picture(&mut capture, view, camera, &look()).1;
    let first = done(&seen, &camera([0.0, 0.0], 230.0));
    assert_eq!(first.points_bounded, 40_000, "one box around all is enough where all is in view");
    let moved = done(&seen, &camera([3.0, 0.0], 230.0));
    assert!(moved.bytes_uploaded < 1200, "a frame and some lines of the grid: {moved:?}");
    assert_eq!((moved.points_bounded, moved.frames_drawn), (0, 1));
    let near = done(&seen, &camera([0.0, 0.0], 20.0));
    assert!(near.bytes_uploaded < 2000 && near.points_bounded == 40_000, "boxes around the groups: {near:?}");
    let beside = done(&seen, &camera([40.0, 0.0], 20.0));
    assert!(beside.bytes_uploaded < 2000 && beside.points_bounded == 0, "as long as they stand: {beside:?}");
    let still = done(&seen, &camera([40.0, 0.0], 20.0));
    assert_eq!(still, RenderCounters { bytes_held: still.bytes_held, ..RenderCounters::default() });
    let stirred = done(&View { motion: 1, ..seen }, &camera([40.0, 0.0], 20.0));
    assert_eq!(stirred.bytes_uploaded, 8 * 40_000, "the positions, and no bonds");
}

#[test]
fn a_small_scene_is_drawn_whole_without_a_look_at_its_parts() {
    if common::gpu().is_none() {
        return;
    }
    let (flat, bonds) = cloth([60, 60], [0.0, 0.0], 2);
    let done = picture(&mut capture(2), &view(&flat, &bonds, 2), &camera([0.0, 0.0], 5.0), &plain()).1;
    assert_eq!((done.points_bounded, done.bonds_drawn, done.dots_drawn), (0, bonds.len() as u64, 0));
    assert_eq!((done.draws, done.points_drawn), (4, 3600), "the grid, the cells, the bonds, the points");
    assert_eq!(done.triangles_drawn, 2 * 59 * 59, "two triangles a cell");
}

#[test]
fn a_fine_cloth_is_covered_by_a_few_dots() {
    if common::gpu().is_none() {
        return;
    }
    for (dimensions, camera) in [(2, camera([0.0, 0.0], 366.0)), (3, orbit(DVec3::ZERO, 440.0))] {
        let (flat, bonds) = large(dimensions);
        let (seen, done) = picture(&mut capture(dimensions), &view(&flat, &bonds, dimensions), &camera, &look());
        // Bonds are 0.7 px long in the plane.
        assert!(done.dots_drawn > 0 && done.dots_drawn < bonds.len() as u64 / 10, "{done:?}");
        assert!(done.bonds_drawn < bonds.len() as u64 / 50, "{done:?}");
        let corner = |x, y| camera.screen_from_world(DVec3::new(x, y, 0.0)).unwrap();
        let corners = [corner(-99.5, -99.5), corner(99.5, -99.5), corner(99.5, 99.5), corner(-99.5, 99.5)];
        for (x, y, pixel) in seen.enumerate_pixels() {
            match depth(corners, [f64::from(x) + 0.5, f64::from(y) + 0.5]) {
                inside if inside > 2.0 => assert!(pixel[0] > 225, "a hole at {x} {y}: {pixel:?}"),
                inside if inside < -3.5 => assert_eq!(pixel[0], 0, "{x} {y} is outside"),
                _ => {}
            }
        }
    }
}

/// How far inside a convex shape a place lies [px]; below 0 outside, as far as from the furthest of its sides.
fn depth(corners: [[f64; 2]; 4], at: [f64; 2]) -> f64 {
    let corners = corners.map(DVec2::from);
    let sides = (0..4).map(|i| (corners[i], corners[(i + 1) % 4]));
    let middle = corners.into_iter().sum::<DVec2>() / 4.0;
    let signed = |(a, b): (DVec2, DVec2), at: DVec2| (b - a).normalize().perp_dot(at - a);
    let least = |side: (DVec2, DVec2)| signed(side, DVec2::from(at)) * signed(side, middle).signum();
    sides.map(least).fold(f64::INFINITY, f64::min)
}

#[test]
fn zooming_out_nothing_pops() {
    if common::gpu().is_none() {
        return;
    }
    // Stretched along x alone, so that its bonds have several colours.
    let (mut flat, bonds) = large(2);
    flat.iter_mut().step_by(2).for_each(|x| *x *= 1.05);
    let strain = between([1.0; 4], [1.0; 4], [1.0, 0.0, 0.0, 1.0]);
    let look = Look { overlay: Overlay::Strain, strain, point: [0.5, 1.0, 0.5, 1.0], ..look() };
    let mut capture = capture(2);
    let mut last: Option<([f64; 3], u64)> = None;
    let mut pixels = 6.0;
    while pixels > 0.4 {
        let camera = camera([0.0, 0.0], f64::from(SIDE) / pixels);
        let (seen, done) = picture(&mut capture, &view(&flat, &bonds, 2), &camera, &look);
        let half = (0.5 * 180.0 * pixels).min(100.0) as u32;
        let middle = SIDE / 2 - half..SIDE / 2 + half;
        let tone = std::array::from_fn(|k| {
            let sum: f64 = middle
                .clone()
                .flat_map(|x| middle.clone().map(move |y| (x, y)))
                .map(|(x, y)| f64::from(seen.get_pixel(x, y)[k]))
                .sum();
            sum / f64::from(4 * half * half)
        });
        if let Some((before, _)) = last {
            let jump = (0..3).map(|k| (tone[k] - before[k]).abs()).fold(0.0, f64::max);
            assert!(jump < 8.0, "at {pixels} px: {before:?} {tone:?}");
        }
        // As many shapes as the picture has room for, however many bonds there are.
        let shapes = done.bonds_drawn + done.dots_drawn;
        assert!(shapes < 100_000, "at {pixels} px: {done:?}");
        last = Some((tone, shapes));
        pixels /= 1.03;
    }
}

#[test]
fn a_long_thread_hangs_together_from_afar() {
    if common::gpu().is_none() {
        return;
    }
    // A spiral of 40,000 bonds, 0.1 px each, and the same of 3,000.
    let spiral = |count: u32| {
        let at = |i: u32| {
            let turn = (f64::from(i) / f64::from(count)).sqrt() * 60.0;
            [1.8 * turn * turn.cos(), 1.8 * turn * turn.sin()]
        };
        let flat: Vec<f32> = (0..=count).flat_map(|i| at(i).map(|x| x as f32)).collect();
        let length = |i: u32| DVec2::from(at(i)).distance(DVec2::from(at(i + 1)));
        let bonds: Bonds = (0..count).map(|i| Bond { rest_length: length(i), ..bond(i, i + 1) }).collect();
        (flat, bonds)
    };
    let camera = camera([0.0, 0.0], f64::from(SIDE));
    let shown = |(flat, bonds): &(Vec<f32>, Bonds)| picture(&mut capture(2), &view(flat, bonds, 2), &camera, &look());
    let ((fine, done), (coarse, _)) = (shown(&spiral(40_000)), shown(&spiral(3_000)));
    assert!(done.bonds_drawn + done.dots_drawn < 25_000, "{done:?}");
    let brightest = |x: u32, y: u32| {
        let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y)));
        around.map(|(x, y)| coarse.get_pixel(x, y)[0]).max().unwrap()
    };
    let (mut full, mut faint) = (0, 0);
    for (x, y) in (1..SIDE - 1).flat_map(|x| (1..SIDE - 1).map(move |y| (x, y))) {
        let seen = fine.get_pixel(x, y)[0];
        assert!(seen == 0 || brightest(x, y) > 0, "nothing beside the thread: {x} {y}");
        if coarse.get_pixel(x, y)[0] > 220 {
            full += 1;
            faint += u32::from(seen < 128);
        }
    }
    assert!(full > 3000 && faint * 100 < full, "{faint} of {full} pixels have a gap");
}

#[test]
fn a_cloth_that_has_shrunk_to_a_speck_is_seen() {
    if common::gpu().is_none() {
        return;
    }
    let (flat, bonds) = large(2);
    let (seen, done) = picture(&mut capture(2), &view(&flat, &bonds, 2), &camera([0.0, 0.0], 1e5), &look());
    assert!(seen.pixels().any(|pixel| pixel[0] > 200));
    assert!(done.dots_drawn + done.bonds_drawn < 3_000, "{done:?}");
}

#[test]
fn pins_are_seen_where_other_points_fade() {
    if common::gpu().is_none() {
        return;
    }
    let (flat, bonds) = large(2);
    let pinned: Vec<PointId> = (0..200).map(PointId).collect();
    let seen = View { pinned: &pinned, ..view(&flat, &bonds, 2) };
    let look = Look { point: [0.0, 1.0, 0.0, 1.0], pin: [1.0, 0.0, 0.0, 1.0], point_radius: 4.0, ..look() };
    let (picture, done) = picture(&mut capture(2), &seen, &camera([0.0, 0.0], 366.0), &look);
    assert_eq!(done.points_drawn, 200);
    let is_red = |pixel: &image::Rgba<u8>| pixel[0] > 200 && pixel[1] < 50;
    assert!(picture.pixels().filter(|pixel| is_red(pixel)).count() > 200);
    assert!(!picture.pixels().any(|pixel| pixel[1] > 200 && pixel[0] < 50), "no other point");
}

#[test]
fn a_tear_leaves_the_rest_in_place() {
    if common::gpu().is_none() {
        return;
    }
    let (flat, bonds) = large(2);
    let (camera, look) = (camera([0.0, 0.0], 20.0), look());
    let mut capture = capture(2);
    picture(&mut capture, &view(&flat, &bonds, 2), &camera, &look);
    let left: Bonds = bonds.iter().filter(|bond| bond.a.0 % 7 != 0).collect();
    let torn = View { topology: 1, ..view(&flat, &left, 2) };
    let (seen, _) = picture(&mut capture, &torn, &camera, &look);
    let fresh = Capture::new([SIDE, SIDE], 2).unwrap().picture(&torn, &camera, &look).unwrap();
    assert_same(&seen, &fresh, "as if it had never had the others");
}

#[test]
fn in_space_what_is_behind_the_camera_is_not_drawn() {
    if common::gpu().is_none() {
        return;
    }
    let (mut flat, bonds) = large(3);
    for point in flat.as_chunks_mut::<3>().0 {
        point[2] = point[0];
    }
    let mut capture = capture(3);
    let mut done = |camera: &Camera| picture(&mut capture, &view(&flat, &bonds, 3), camera, &look()).1.bonds_drawn;
    let near = done(&orbit(DVec3::ZERO, 20.0));
    assert!(near > 500 && near < bonds.len() as u64 / 2, "{near}");
    assert_eq!(done(&orbit(DVec3::new(0.0, 0.0, 500.0), 20.0)), 0, "behind");
}

#[test]
fn a_million_points_are_drawn() {
    if common::gpu().is_none() {
        return;
    }
    let (flat, bonds) = cloth([1000, 1000], [-500.0, -500.0], 2);
    let size = [1280, 720];
    let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 1100.0 }, size);
    let mut capture = Capture::new(size, 2).unwrap();
    let (seen, done) = picture(&mut capture, &view(&flat, &bonds, 2), &camera, &look());
    assert!(done.bonds_drawn + done.dots_drawn < 400_000, "{done:?}");
    assert!(done.bytes_held < 80_000_000, "two states, the bonds, the order of the points: {done:?}");
    let middle = (320..960).flat_map(|x| (40..680).map(move |y| (x, y)));
    let darkest = middle.map(|(x, y)| seen.get_pixel(x, y)[0]).min().unwrap();
    assert!(darkest > 200, "a hole: {darkest}");
}
