//! Pictures of obstacles: areas of pixels against their formula, what is uploaded, and a golden.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

use crate::common;

use std::f64::consts::TAU;

use common::picture::{NO_BONDS, SIDE, assert_coverage, drawn, pixels, plain, view};
use glam::{DVec2, DVec3};
use image::RgbaImage;
use wobble::render::{Camera, Capture, Look, Pose, View};
use wobble::sim::{Convex, Figure, Polygon};

type Loop = Vec<[f64; 2]>;

fn polygon(loops: Vec<Loop>) -> Polygon {
    Polygon { loops, restitution: 0.0, friction: 0.0 }
}

/// Corners about a centre, by their radii [m].
fn round(center: [f64; 2], radii: &[f64]) -> Loop {
    let at = |(k, radius): (usize, &f64)| {
        let angle = TAU * (k as f64 + 0.3) / radii.len() as f64;
        [center[0] + radius * angle.cos(), center[1] + radius * angle.sin()]
    };
    radii.iter().enumerate().map(at).collect()
}

fn star(center: [f64; 2], points: usize, outer: f64, inner: f64) -> Loop {
    round(center, &[outer, inner].repeat(points))
}

fn square([x, y]: [f64; 2], half: f64) -> Loop {
    vec![[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]]
}

/// A look with nothing but the inside of obstacles, white on black, and no rims.
fn bare() -> Look {
    Look { wall: [1.0; 4], outline_width: 0.0, ..plain() }
}

fn picture_of(polygons: &[Polygon], planes: &[[[f64; 3]; 2]], camera: &Camera, look: &Look) -> RgbaImage {
    let seen = View { polygons, planes: planes.to_vec(), ..view(&[], NO_BONDS, 2) };
    drawn(&seen, camera, look)
}

/// The area that a loop has in the square metre above and to the right of `corner`, positive where it turns left.
fn area_in(points: &[[f64; 2]], corner: DVec2) -> f64 {
    let mut left: Vec<DVec2> = points.iter().map(|&at| DVec2::from(at) - corner - 0.5).collect();
    for side in [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y] {
        let over = |at: DVec2| at.dot(side) - 0.5;
        let pairs = (0..left.len()).map(|k| (left[k], left[(k + 1) % left.len()]));
        left = pairs
            .flat_map(|(a, b)| {
                let cut = (over(a) * over(b) < 0.0).then(|| a + (b - a) * (over(a) / (over(a) - over(b))));
                [Some(a).filter(|&a| over(a) <= 0.0), cut]
            })
            .flatten()
            .collect();
    }
    (0..left.len()).map(|k| 0.5 * left[k].perp_dot(left[(k + 1) % left.len()])).sum()
}

/// What loops that lie in each other cover of a pixel: outlines turn left, holes right.
fn exact(loops: &[Loop]) -> impl Fn(DVec2) -> f64 + '_ {
    |corner| loops.iter().map(|points| area_in(points, corner)).sum()
}

fn turned(mut points: Loop) -> Loop {
    points.reverse();
    points
}

#[test]
fn a_polygon_with_a_hole_covers_what_its_formula_says() {
    if common::gpu().is_none() {
        return;
    }
    let shapes: [Vec<Loop>; 4] = [
        vec![round([2.3, -1.1], &[27.0; 40]), turned(round([4.1, 2.2], &[13.0; 7]))],
        // Sharp tips, with a hole that is no wider than a pixel and an island in a hole.
        vec![star([-0.4, 0.7], 9, 31.0, 6.0), turned(star([-0.4, 0.7], 5, 5.0, 0.4))],
        vec![square([0.2, 0.3], 30.0), turned(square([0.2, 0.3], 20.5)), square([3.7, 3.3], 9.2)],
        // A wall of 0.3 px that goes there and back.
        vec![vec![[-28.1, -20.0], [25.3, 17.2], [25.3, -11.7], [25.6, -11.7], [25.6, 17.7], [-28.1, -19.6]]],
    ];
    for loops in shapes {
        let picture = picture_of(&[polygon(loops.clone())], &[], &pixels(), &bare());
        assert_coverage(&picture, exact(&loops));
    }
}

#[test]
fn corners_and_places_between_polygons_are_exact_too() {
    if common::gpu().is_none() {
        return;
    }
    // A chequerboard of squares that are not in step with the pixels, and a fence of thin posts.
    let at = |k: u32| f64::from(k) * 4.3 - 28.0;
    let mut loops: Vec<Loop> =
        (0..100).filter(|k| (k / 10 + k % 10) % 2 == 0).map(|k| square([at(k % 10), at(k / 10)], 2.15)).collect();
    loops.extend((0..20).map(|k| square([f64::from(k) * 2.9 - 28.0, 25.0], 0.2)));
    let polygons: Vec<Polygon> = loops.iter().map(|one| polygon(vec![one.clone()])).collect();
    let picture = picture_of(&polygons, &[], &pixels(), &bare());
    let truth = exact(&loops);
    for (x, y, pixel) in picture.enumerate_pixels() {
        let share = truth(DVec2::new(f64::from(x) - 32.0, 31.0 - f64::from(y)));
        let error = (f64::from(pixel[0]) / 255.0 - share).abs();
        assert!(error < 0.006, "{error} at {x} {y}: {} instead of {share}", pixel[0]);
    }
}

#[test]
fn a_polygon_of_twenty_thousand_corners_covers_what_its_formula_says() {
    if common::gpu().is_none() {
        return;
    }
    let radii: Vec<f64> = (0..20_000).map(|k| if k % 2 == 0 { 29.0 } else { 25.0 + f64::from(k % 7) }).collect();
    let loops = vec![round([0.4, -0.3], &radii)];
    let picture = picture_of(&[polygon(loops.clone())], &[], &pixels(), &bare());
    assert_coverage(&picture, exact(&loops));
}

#[test]
fn loops_that_cross_are_filled_by_the_even_odd_rule() {
    if common::gpu().is_none() {
        return;
    }
    let points = round([0.0, 0.0], &[30.0; 5]);
    let pentagram: Loop = (0..5).map(|k| points[2 * k % 5]).collect();
    let is_around = |one: &Loop, at: DVec2| {
        let edges = (0..one.len()).map(|k| (DVec2::from(one[k]), DVec2::from(one[(k + 1) % one.len()])));
        let crossed = edges.filter(|(a, b)| (a.y > at.y) != (b.y > at.y));
        crossed.filter(|(a, b)| a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x) > at.x).count() % 2 == 1
    };
    let picture = picture_of(&[polygon(vec![pentagram.clone()])], &[], &pixels(), &bare());
    assert_eq!(picture.get_pixel(32, 32)[0], 0, "its middle is run around twice");
    assert_coverage(&picture, common::picture::sampled(|at| is_around(&pentagram, at)));
}

#[test]
fn a_plane_with_a_slope_is_solid_on_one_side() {
    if common::gpu().is_none() {
        return;
    }
    let (point, normal) = (DVec2::new(1.3, -4.6), DVec2::new(-0.6, 1.7));
    let plane = [point, normal].map(|x| [x.x, x.y, 0.0]);
    let picture = picture_of(&[], &[plane], &pixels(), &bare());
    let along = normal.perp().normalize() * 200.0;
    let deep = normal.normalize() * 300.0;
    let corners = [point + along, point - along - deep, point + along - deep].map(|x| x.to_array());
    let solid = [corners[0], (point - along).to_array(), corners[1], corners[2]];
    let sign = area_in(&solid, DVec2::new(0.0, -30.0)).signum();
    assert_coverage(&picture, |corner| sign * area_in(&solid, corner));
}

#[test]
fn a_wall_far_thinner_than_a_pixel_is_seen_and_a_wide_one_keeps_its_edges() {
    if common::gpu().is_none() {
        return;
    }
    let look = Look { obstacle: [1.0; 4], outline_width: 1.0, ..bare() };
    for width in [1e-3, 0.02, 0.3] {
        let wall = vec![[-25.0, -20.3], [25.0, 14.2], [25.0, 14.2 + width]];
        let picture = picture_of(&[polygon(vec![wall])], &[], &pixels(), &look);
        // Where it is half as thick as at its end.
        let sum: f64 = (0..SIDE).map(|y| f64::from(picture.get_pixel(32, y)[0]) / 255.0).sum();
        assert!((0.5..1.5).contains(&sum), "a wall of {width} px is {sum} px wide to the eye");
    }
    let edge = [square([0.3, -0.2], 20.0)];
    let picture = picture_of(&[polygon(edge.to_vec())], &[], &pixels(), &look);
    assert_coverage(&picture, exact(&edge));
}

#[test]
fn rims_lie_inside() {
    if common::gpu().is_none() {
        return;
    }
    let look = Look { obstacle: [0.0, 0.0, 0.0, 1.0], wall: [1.0, 0.0, 0.0, 1.0], outline_width: 4.0, ..plain() };
    let polygons = [polygon(vec![square([0.0, 0.0], 20.0)])];
    let picture = picture_of(&polygons, &[], &pixels(), &look);
    let row = |x: u32| picture.get_pixel(x, 32)[0];
    assert_eq!([11, 12, 13, 15, 16, 17, 32].map(row), [0, 255, 255, 255, 0, 0, 0]);
    let joined = [polygon(vec![square([-10.0, 0.0], 10.0)]), polygon(vec![square([7.0, 0.0], 10.0)])];
    let picture = picture_of(&joined, &[], &pixels(), &look);
    assert!((18..44).all(|x| picture.get_pixel(x, 32)[0] == 0), "none where obstacles overlap");
    assert_eq!(picture.get_pixel(30, 24)[0], 255, "one along both");
}

#[test]
fn obstacles_look_the_same_far_from_the_origin_and_in_bodies_of_kilometres() {
    if common::gpu().is_none() {
        return;
    }
    let picture = |offset: f64, size: f64| {
        // A corner at the middle of the picture, and the rest of it `size` m away.
        let corners = [[0.0, 0.0], [-size, -2.0 * size], [-size, size]];
        let polygons = [polygon(vec![corners.map(|[x, y]| [x + offset, y - offset]).to_vec()])];
        let plane = [[offset + 3.0, -offset, 0.0], [-2.0, 1.0, 0.0]];
        let pose = Pose::Plane { center: DVec2::new(offset, -offset), height: f64::from(SIDE) };
        let look = Look { has_grid: false, ..Look::default() };
        picture_of(&polygons, &[plane], &Camera::new(pose, [SIDE, SIDE]), &look)
    };
    let near = picture(0.0, 1e3);
    assert!(near.pixels().any(|pixel| *pixel != *near.get_pixel(0, 0)));
    for (offset, size) in [(1e6, 1e3), (0.0, 1e6), (1e6, 1e6), (-1e9, 1e7)] {
        let far = picture(offset, size);
        let differ =
            |(a, b): &(&image::Rgba<u8>, &image::Rgba<u8>)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 3);
        let off = far.pixels().zip(near.pixels()).filter(differ).count();
        assert_eq!(off, 0, "{offset} m away, {size} m large");
    }
}

#[test]
fn still_obstacles_are_uploaded_once_and_added_up_once() {
    if common::gpu().is_none() {
        return;
    }
    let polygons = [polygon(vec![star([-9.0, 4.0], 40, 20.0, 9.0)]), polygon(vec![square([1e4, 0.0], 5.0)])];
    let seen = |motion, positions| View {
        motion,
        polygons: &polygons,
        planes: vec![[[0.0, -20.0, 0.0], [0.1, 1.0, 0.0]]],
        ..view(positions, NO_BONDS, 2)
    };
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let mut counted = |seen: &View<'_>, camera: &Camera| {
        let before = *capture.renderer().counters();
        capture.picture(seen, camera, &bare()).unwrap();
        let after = *capture.renderer().counters();
        (after.bytes_uploaded - before.bytes_uploaded, after.obstacle_triangles_drawn - before.obstacle_triangles_drawn)
    };
    let (first, moved) = ([0.0_f32, 0.0], [3.0_f32, 0.0]);
    let (bytes, triangles) = counted(&seen(0, &first), &pixels());
    assert!(bytes > 80 * 24 && triangles == 78 + 2, "{bytes}: the star and what is left of a square; {triangles}");
    assert_eq!(counted(&seen(0, &first), &pixels()), (0, 0), "nothing moved");
    assert_eq!(counted(&seen(1, &moved), &pixels()), (8, 0), "a point did");
    let mut camera = pixels();
    camera.pan([3.0, -2.0]);
    let (bytes, triangles) = counted(&seen(1, &moved), &camera);
    assert!(bytes < 4000 && triangles == 80, "{bytes}: uniforms and the grid; {triangles}");
    camera.pan([-2.0 * f64::from(SIDE), 2.0 * f64::from(SIDE)]);
    assert_eq!(counted(&seen(1, &moved), &camera).1, 0, "out of view");
}

#[test]
fn a_new_polygon_replaces_the_old_one() {
    if common::gpu().is_none() {
        return;
    }
    let [one, other] = [-10.0, 10.0].map(|x| [polygon(vec![square([x, 0.0], 5.0)])]);
    let mut capture = Capture::new([SIDE, SIDE], 2).unwrap();
    let mut red = |polygons, topology, x| {
        let seen = View { polygons, topology, ..view(&[], NO_BONDS, 2) };
        capture.picture(&seen, &pixels(), &bare()).unwrap().get_pixel(x, 32)[0]
    };
    assert_eq!((red(&one, 0, 22), red(&one, 0, 42)), (255, 0));
    assert_eq!((red(&other, 1, 22), red(&other, 1, 42)), (0, 255));
    assert_eq!((red(&[], 2, 22), red(&[], 2, 42)), (0, 0));
}

#[test]
fn walls_a_ring_and_a_slope() {
    if let Some(gpu) = common::gpu() {
        let picture = common::rendered(common::file("obstacles.json").to_str().unwrap(), "0.2", "160x120");
        common::golden::check("obstacles", &picture, &gpu.info);
    }
}

#[test]
fn a_plane_in_space_is_a_patch_below_the_scene() {
    if common::gpu().is_none() {
        return;
    }
    let positions = [-1.0_f32, 0.5, 0.0, 1.0, 1.5, 0.3];
    let seen = View { planes: vec![[[0.0; 3], [0.0, 1.0, 0.0]]], ..view(&positions, NO_BONDS, 3) };
    let camera = Camera::fit([[-1.5, 0.0, -1.5], [1.5; 3]], 3, [SIDE, SIDE]);
    let look = Look { point: [0.0; 4], pin: [0.0; 4], wall: [1.0; 4], axis: [1.0, 1.0, 1.0, 0.4], ..plain() };
    let picture = drawn(&seen, &camera, &look);
    let lit = |rows: std::ops::Range<u32>| {
        rows.flat_map(|y| (0..SIDE).map(move |x| (x, y))).filter(|&(x, y)| picture.get_pixel(x, y)[0] > 40).count()
    };
    assert!(lit(0..16) == 0 && lit(24..SIDE) > 200, "{} {}", lit(0..16), lit(24..SIDE));
}

#[test]
fn balls_and_boxes_in_space_are_seen_where_rays_meet_them_and_hide_what_lies_behind() {
    if common::gpu().is_none() {
        return;
    }
    let ball = Figure::Ball { center: [0.0; 3], radius: 0.5 };
    let block = Figure::Box { min: [0.8, -0.4, -0.3], max: [1.4, 0.5, 0.3], axis: [1.0, 2.0, 0.5], angle: 0.8 };
    let convex = [ball, block].map(|figure| Convex { figure, restitution: 0.0, friction: 0.0 });
    // One point before the ball, and one behind it.
    let positions = [0.0_f32, 0.0, 1.5, 0.0, 0.0, -1.5];
    let look = Look { solid: [[1.0; 4]; 2], point: [0.0, 0.0, 0.0, 1.0], point_radius: 2.0, ..plain() };
    for (yaw, dark) in [(0.0, true), (std::f64::consts::PI, true), (0.9, false)] {
        let pose = Pose::Orbit { target: DVec3::new(0.3, 0.0, 0.0), distance: 5.0, yaw, pitch: 0.0 };
        let camera = Camera::new(pose, [SIDE, SIDE]);
        let seen = View { convex: &convex, ..view(&positions, NO_BONDS, 3) };
        let picture = drawn(&seen, &camera, &look);
        let middle = camera.screen_from_world(DVec3::ZERO).unwrap().map(|x| x as u32);
        let points = [1.5, -1.5].map(|z| camera.screen_from_world(DVec3::new(0.0, 0.0, z)).unwrap());
        let mut inside = 0;
        for (x, y) in (0..SIDE).flat_map(|x| (0..SIDE).map(move |y| (x, y))) {
            // Some rays across the pixel.
            let hits = [[0.1, 0.1], [0.9, 0.1], [0.5, 0.5], [0.1, 0.9], [0.9, 0.9]].map(|[dx, dy]| {
                let cursor = camera.cursor([f64::from(x) + dx, f64::from(y) + dy]);
                convex.iter().any(|convex| convex.figure.entry([cursor.origin, cursor.direction], 0.0).is_some())
            });
            let lit = picture.get_pixel(x, y)[0];
            let is_near = |at: &[f64; 2]| (at[0] - f64::from(x)).hypot(at[1] - f64::from(y)) < 5.0;
            let is_near_point = points.iter().any(is_near);
            if hits == [true; 5] && !is_near_point {
                inside += 1;
                // Where both share a pixel a little shows through between them.
                assert!(lit > 180, "{x}, {y} of {yaw}: {lit}");
            }
            assert!(hits != [false; 5] || lit < 140 || is_near_point, "{x}, {y} of {yaw}: {lit}");
        }
        assert!(inside > 100, "{inside} pixels");
        let [x, y] = if yaw == 0.0 { points[0] } else { points[1] }.map(|x| x as u32);
        let [x, y] = if dark { [x, y] } else { middle };
        assert_eq!(picture.get_pixel(x, y)[0] < 100, dark, "the point before it from {yaw}");
    }
}
