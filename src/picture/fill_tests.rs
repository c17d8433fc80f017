//! Areas of triangles against areas of loops.

use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::*;

fn filled(loops: &[Vec<Point>]) -> f64 {
    let Filling { points, triangles } = fill_outline(loops);
    let bits = |points: &[Point]| points.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert!(bits(&points).starts_with(&bits(&loops.concat())), "the points of all loops come first");
    triangles.iter().map(|ear| ear.map(|k| points[k as usize])).map(|[a, b, c]| 0.5 * turn(a, b, c).abs()).sum()
}

fn area(points: &[Point]) -> f64 {
    0.5 * doubled_area(points).abs()
}

/// A loop about a centre: its radius by the share of a full turn.
fn round(count: usize, [x, y]: Point, radius: impl Fn(usize) -> f64) -> Vec<Point> {
    let at = |k: usize| (radius(k), TAU * k as f64 / count as f64);
    let place = |(r, angle): (f64, f64)| [x + r * libm::cos(angle), y + r * libm::sin(angle)];
    (0..count).map(at).map(place).collect()
}

fn square(from: f64, to: f64) -> Vec<Point> {
    vec![[from, from], [to, from], [to, to], [from, to]]
}

fn close(found: f64, truth: f64) {
    assert!((found - truth).abs() <= 1e-9 * truth.abs(), "{found} instead of {truth}");
}

#[test]
fn a_square_is_two_triangles_of_its_points() {
    let loops = [vec![[9.0, 9.0]], square(0.0, 2.0)];
    let mut triangles = fill_outline(&loops).triangles;
    triangles.iter_mut().for_each(|ear| ear.sort_unstable());
    assert_eq!(triangles.len(), 2);
    assert!(triangles.iter().flatten().all(|k| (1..5).contains(k)));
    close(filled(&loops), 4.0);
}

#[test]
fn a_ring_is_filled_but_for_its_hole_in_any_order_and_sense() {
    let (outer, hole) = (round(90, [5.0, 5.0], |_| 40.0), round(50, [5.0, 5.0], |_| 30.0));
    let truth = area(&outer) - area(&hole);
    let turned: Vec<Point> = hole.iter().rev().copied().collect();
    for loops in [[outer.clone(), hole.clone()], [hole, outer.clone()], [outer, turned]] {
        close(filled(&loops), truth);
    }
}

#[test]
fn a_gear_with_holes() {
    let gear = round(400, [0.0, 0.0], |k| if k / 10 % 2 == 0 { 100.0 } else { 85.0 });
    let hole = |k: usize| round(40, [55.0 * libm::cos(k as f64), 55.0 * libm::sin(k as f64)], |_| 18.0);
    let mut loops: Vec<Vec<Point>> = (0..6).map(hole).collect();
    loops.push(gear);
    loops.push(round(64, [0.0, 0.0], |_| 25.0));
    let truth = area(&loops[6]) - area(&loops[7]) - 6.0 * area(&loops[0]);
    close(filled(&loops), truth);
}

#[test]
fn islands_lie_in_holes_to_any_depth() {
    let mut loops: Vec<Vec<Point>> = (0..12).map(|k| square(f64::from(k), 100.0 - f64::from(k))).collect();
    let truth: f64 = loops.iter().enumerate().map(|(k, points)| area(points) * [1.0, -1.0][k % 2]).sum();
    close(filled(&loops), truth);
    // Two islands beside each other in a hole, one with a hole.
    loops = vec![square(0.0, 50.0), square(5.0, 45.0), square(6.0, 20.0), square(8.0, 12.0), square(25.0, 40.0)];
    close(filled(&loops), 2500.0 - 1600.0 + 196.0 - 16.0 + 225.0);
}

/// A star of random points, with random holes in it and random islands in those.
fn star(random: &mut Pcg64) -> Vec<Vec<Point>> {
    let mut some = |count: usize, least: f64, most: f64| -> Vec<f64> {
        (0..count).map(|_| random.random_range(least..most)).collect()
    };
    let count = 3 + some(1, 0.0, 120.0)[0] as usize;
    let radii = some(count, 40.0, 100.0);
    let mut loops = vec![round(count, [300.0, 200.0], |k| radii[k])];
    // Every corner is at least 40 px from the middle, but edges of stars with few points come closer.
    let reach = 40.0 * libm::cos(0.5 * TAU / count as f64);
    for k in 0..some(1, 0.0, 5.0)[0] as usize {
        let far = 0.55 * reach;
        let angle = TAU * k as f64 / 5.0;
        let centre = [300.0 + far * libm::cos(angle), 200.0 + far * libm::sin(angle)];
        let count = 3 + some(1, 0.0, 30.0)[0] as usize;
        let radii = some(count, 0.1 * reach, 0.3 * reach);
        loops.push(round(count, centre, |k| radii[k]));
        let island = 0.09 * reach * libm::cos(0.5 * TAU / count as f64);
        loops.push(round(7, centre, |_| island));
    }
    loops
}

#[test]
fn random_stars_with_holes_and_islands() {
    let mut random = Pcg64::seed_from_u64(21);
    for round in 0..200 {
        let mut loops = star(&mut random);
        let sign = |k: usize| if k == 0 || k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let truth: f64 = loops.iter().enumerate().map(|(k, points)| sign(k) * area(points)).sum();
        let middle = loops.len() / 2;
        loops.rotate_left(middle);
        let found = filled(&loops);
        assert!((found - truth).abs() < 1e-9 * truth, "round {round}: {found} instead of {truth}");
    }
}

#[test]
fn loops_without_area_are_left_out() {
    let nan = f64::NAN;
    let bad: [Vec<Point>; 8] = [
        vec![],
        vec![[1.0, 1.0]],
        vec![[1.0, 1.0], [2.0, 2.0]],
        vec![[1.0, 1.0]; 5],
        vec![[0.1, 0.1], [0.2, 0.2], [0.7, 0.7], [0.3, 0.3]],
        vec![[1.0, 1.0], [nan, 2.0], [3.0, 0.0]],
        vec![[1.0, 1.0], [f64::INFINITY, 2.0], [3.0, 0.0]],
        vec![[1e300, 0.0], [0.0, 1e300], [-1e300, -1e300]],
    ];
    assert!([&[][..], &bad].iter().all(|loops| fill_outline(loops).triangles.is_empty()));
    for one in bad {
        close(filled(&[one.clone(), square(-1.0, 5.0), one]), 36.0);
    }
    // The same loop twice is outside of both.
    assert!(filled(&[square(0.0, 3.0), square(0.0, 3.0)]) < 1e-9);
}

#[test]
fn holes_may_touch_outlines_and_each_other() {
    let diamond = |x: f64| vec![[x - 5.0, 20.0], [x, 15.0], [x + 5.0, 20.0], [x, 25.0]];
    let loops = [square(0.0, 40.0), diamond(5.0), diamond(15.0), diamond(25.0), diamond(35.0)];
    close(filled(&loops), 1600.0 - 200.0);
}

#[test]
fn loops_that_cross_are_filled_where_an_odd_number_runs_around() {
    let bow_tie = vec![[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]];
    close(filled(std::slice::from_ref(&bow_tie)), 8.0);
    close(filled(&[square(0.0, 4.0), square(2.0, 6.0)]), 16.0 + 16.0 - 2.0 * 4.0);
    close(filled(&[square(-1.0, 5.0), bow_tie]), 36.0 - 8.0);
    // A star of five points drawn in one stroke: its middle is run around twice.
    let star: Vec<Point> = (0..5).map(|k| round(5, [1.0, 2.0], |_| 3.0)[2 * k % 5]).collect();
    let [outer, inner] = [3.0, 3.0 * libm::cos(0.4 * TAU / 2.0) / libm::cos(0.2 * TAU / 2.0)];
    let points = 5.0 * outer * inner * libm::sin(TAU / 10.0);
    let middle = 2.5 * inner * inner * libm::sin(TAU / 5.0);
    close(filled(&[star]), points - middle);
}

#[test]
fn random_loops_that_cross_are_filled_as_samples_say() {
    let mut random = Pcg64::seed_from_u64(8);
    for round in 0..60 {
        let mut place = || [random.random_range(0.0..20.0), random.random_range(0.0..20.0)];
        let loops: Vec<Vec<Point>> =
            (0..1 + round % 4).map(|_| (0..3 + round % 9).map(|_| place()).collect()).collect();
        let Filling { points, triangles } = fill_outline(&loops);
        let is_around = |[a, b, c]: [Point; 3], at| {
            let sides = [turn(a, b, at), turn(b, c, at), turn(c, a, at)];
            sides.iter().all(|&side| side > 0.0) || sides.iter().all(|&side| side < 0.0)
        };
        for at in (0..400).map(|k| [f64::from(k % 20) + 0.317, f64::from(k / 20) + 0.619]) {
            let odd = loops.iter().map(|one| crossings(one, at[1]).filter(|&x| x < at[0]).count()).sum::<usize>() % 2;
            let covers = triangles.iter().filter(|ear| is_around(ear.map(|k| points[k as usize]), at)).count();
            assert_eq!(covers, odd, "round {round} at {at:?}");
        }
    }
}

#[test]
fn garbage_ends_without_a_panic() {
    let mut random = Pcg64::seed_from_u64(4);
    for round in 0..4000 {
        let loops: Vec<Vec<Point>> = (0..random.random_range(0..6))
            .map(|_| {
                let count = random.random_range(0..70);
                let scale = [1.0, 6.0, 1e3, 1e150, 1e-200][round % 5];
                let mut place = || [random.random_range(-scale..scale), random.random_range(-scale..scale)];
                let mut points: Vec<Point> = (0..count).map(|_| place()).collect();
                // Few different places: points repeat, edges overlap.
                if round % 5 == 1 {
                    points.iter_mut().flatten().for_each(|x| *x = x.round());
                }
                points
            })
            .collect();
        let Filling { points, triangles } = fill_outline(&loops);
        assert!(triangles.iter().flatten().all(|&k| (k as usize) < points.len()));
    }
}
