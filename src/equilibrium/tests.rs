//! Equilibria that are known, and starts that have none.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use super::{Equilibrium, settle};
use crate::sim::bond::{Bond, BondKind, Limit, PointId};
use crate::sim::contact::bounds::Bounds;
use crate::sim::contact::surface::Plane;
use crate::sim::model::Model;
use crate::sim::vector::{length, sub};

fn bond(a: u32, b: u32, rest_length: f64) -> Bond {
    Bond::new(PointId(a), PointId(b), rest_length)
}

fn spring(a: u32, b: u32, rest_length: f64, stiffness: f64) -> Bond {
    Bond { kind: BondKind::Spring { stiffness, damping: 0.0 }, ..bond(a, b, rest_length) }
}

fn model<const D: usize>(position: Vec<[f64; D]>, bonds: Vec<Bond>, pinned: &[u32]) -> Model<D> {
    Model {
        velocity: vec![[0.0; D]; position.len()],
        mass: vec![1.0; position.len()],
        pinned: pinned.iter().map(|&i| PointId(i)).collect(),
        gravity: std::array::from_fn(|k| if k == 1 { -9.81 } else { 0.0 }),
        position,
        bonds: bonds.into(),
        ..Model::default()
    }
}

fn plane<const D: usize>(normal: [f64; D]) -> Plane<D> {
    Plane { point: [0.0; D], normal, restitution: 0.0, friction: 0.0, penalty: None }
}

/// A square of side 1 with both diagonals, turned about its lowest corner, which lies at `at`.
fn square(angle: f64, at: [f64; 2]) -> Model<2> {
    let (s, c) = (libm::sin(angle), libm::cos(angle));
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let turned = corners.map(|[p, q]: [f64; 2]| [at[0] + p * c - q * s, at[1] + p * s + q * c]);
    let root = 2.0_f64.sqrt();
    let sides = [(0, 1, 1.0), (1, 2, 1.0), (2, 3, 1.0), (3, 0, 1.0), (0, 2, root), (1, 3, root)];
    model(turned.to_vec(), sides.map(|(a, b, rest)| bond(a, b, rest)).to_vec(), &[])
}

/// A cube of side 1, every pair of its corners bonded, rolled by `roll` about z and then tipped by `tip` about x.
fn cube(roll: f64, tip: f64, lift: f64) -> Model<3> {
    let turn = |[x, y, z]: [f64; 3]| {
        let (x, y) = (x * libm::cos(roll) - y * libm::sin(roll), x * libm::sin(roll) + y * libm::cos(roll));
        [x, y * libm::cos(tip) - z * libm::sin(tip) + lift, y * libm::sin(tip) + z * libm::cos(tip)]
    };
    let corner = |i: u32| [f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)];
    let position: Vec<[f64; 3]> = (0..8).map(|i| turn(corner(i))).collect();
    let pairs = (0..8_u32).flat_map(|i| (0..i).map(move |j| (i, j)));
    let rest = |i: u32, j: u32| length(sub(corner(i), corner(j)));
    model(position, pairs.map(|(i, j)| bond(i, j, rest(i, j))).collect(), &[])
}

fn heights<const D: usize>(found: &Equilibrium<D>) -> Vec<f64> {
    let mut list: Vec<f64> = found.position.iter().map(|x| x[1]).collect();
    list.sort_by(f64::total_cmp);
    list
}

fn lies_flat<const D: usize>(found: &Equilibrium<D>) {
    let list = heights(found);
    let half = list.len() / 2;
    assert!(found.is_settled && found.max_strain < 1e-12, "{found:?}");
    assert!(list[..half].iter().all(|y| y.abs() < 1e-12), "{list:?}");
    assert!(list[half..].iter().all(|y| (y - 1.0).abs() < 1e-12), "{list:?}");
}

#[test]
fn a_box_that_slides_freely_rests_where_it_stands() {
    let mut scene = square(0.0, [2.0, 0.0]);
    scene.planes = vec![plane([0.0, 1.0])];
    let found = settle(&scene).unwrap();
    lies_flat(&found);
    assert!(found.position.iter().zip(&scene.position).all(|(a, b)| (a[0] - b[0]).abs() < 1e-9), "{found:?}");
    scene.planes.clear();
    scene.bounds = Some(Bounds { min: [-5.0, 0.0], max: [5.0, 5.0], restitution: 0.0, friction: 0.0 });
    lies_flat(&settle(&scene).unwrap());
}

#[test]
fn a_box_drops_and_tips_over_its_corner() {
    for height in [0.0, 2.0, 5000.0] {
        let mut scene = square(0.3, [0.0, height]);
        scene.planes = vec![plane([0.0, 1.0])];
        lies_flat(&settle(&scene).unwrap());
    }
    let mut below = square(0.3, [0.0, -2.0]);
    below.planes = vec![plane([0.0, 1.0])];
    lies_flat(&settle(&below).unwrap());
}

#[test]
fn a_box_on_its_corner_falls_over() {
    let mut scene = square(std::f64::consts::FRAC_PI_4, [0.0, 0.0]);
    scene.planes = vec![plane([0.0, 1.0])];
    lies_flat(&settle(&scene).unwrap());
    let kind = BondKind::Spring { stiffness: 1e4, damping: 0.0 };
    scene.bonds = scene.bonds.iter().map(|bond| Bond { kind, ..bond }).collect();
    let found = settle(&scene).unwrap();
    assert!(found.is_settled && heights(&found)[1].abs() < 1e-12, "{found:?}");
}

#[test]
fn cubes_fall_from_edges_and_corners_onto_a_side() {
    let diagonal = libm::atan(1.0 / 2.0_f64.sqrt());
    for (roll, tip) in [(0.0, 0.0), (std::f64::consts::FRAC_PI_4, 0.0), (std::f64::consts::FRAC_PI_4, -diagonal)] {
        let mut scene = cube(roll, tip, 0.5);
        scene.planes = vec![plane([0.0, 1.0, 0.0])];
        lies_flat(&settle(&scene).unwrap());
    }
}

#[test]
fn loose_points_drop_to_the_floor_below_them() {
    let mut scene = model(vec![[0.0, 3.0], [1.0, 2000.0]], vec![], &[]);
    scene.planes = vec![plane([0.0, 1.0])];
    let found = settle(&scene).unwrap();
    assert!(found.is_settled && found.falling.is_empty(), "{found:?}");
    assert!(length(sub(found.position[0], [0.0, 0.0])) < 1e-9, "{found:?}");
    assert!(length(sub(found.position[1], [1.0, 0.0])) < 1e-9, "{found:?}");
}

#[test]
fn a_valley_gathers_what_slides() {
    let mut scene = model(vec![[-40.0, 60.0], [3.0, 2.0]], vec![], &[]);
    scene.planes = vec![plane([-0.3, 1.0]), plane([0.5, 1.0])];
    let found = settle(&scene).unwrap();
    assert!(found.is_settled && found.position.iter().all(|&x| length(x) < 1e-9), "{found:?}");
}

#[test]
fn what_falls_for_ever_is_named_and_left() {
    let hung = vec![bond(0, 1, 1.0), bond(2, 3, 1.0)];
    let mut scene = model(vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.5], [3.0, 0.5]], hung, &[0]);
    let found = settle(&scene).unwrap();
    assert!(!found.is_settled && found.falling == [PointId(2), PointId(3)], "{found:?}");
    assert_eq!(found.position[2..], scene.position[2..]);
    assert!((found.position[1][1] + 1.0).abs() < 1e-12, "the rest is settled");
    scene.planes = vec![plane([-0.3, 1.0])];
    assert_eq!(settle(&scene).unwrap().falling, [PointId(2), PointId(3)], "a slope does not hold it");
    scene.planes.push(plane([0.3, 1.0]));
    let found = settle(&scene).unwrap();
    assert!(found.is_settled && found.falling.is_empty(), "a valley does: {found:?}");
    scene.gravity = [0.0, 0.0];
    assert!(settle(&scene).unwrap().is_settled, "nothing falls without gravity");
}

#[test]
fn a_groove_that_slopes_holds_nothing() {
    let mut scene = model(vec![[0.0, 3.0, 0.0]], vec![], &[]);
    scene.planes = vec![plane([0.2, 1.0, 0.0]), plane([-0.2, 1.0, 0.1])];
    assert_eq!(settle(&scene).unwrap().falling, [PointId(0)]);
    scene.planes.push(plane([0.0, 1.0, -1.0]));
    assert!(settle(&scene).unwrap().is_settled);
}

/// A strut from a pin carries a point only while it stands upright, which is a saddle.
#[test]
fn what_slides_off_a_strut_falls() {
    let strut = Bond { limit: Limit::Min, ..bond(0, 1, 1.0) };
    let mut scene = model(vec![[0.0, 1.0], [0.0, 2.5]], vec![strut], &[0]);
    assert_eq!(settle(&scene).unwrap().falling, [PointId(1)]);
    scene.planes = vec![plane([0.0, 1.0])];
    let found = settle(&scene).unwrap();
    assert!(found.is_settled && found.position[1][1].abs() < 1e-9, "{found:?}");
    assert!(length(sub(found.position[1], [0.0, 1.0])) > 1.0 - 1e-9, "{found:?}");
    let pocket = model(
        vec![[0.0, 0.0], [1.0, 0.0], [0.55, 1.5]],
        [0, 1].map(|i| Bond { a: PointId(i), b: PointId(2), ..strut }).to_vec(),
        &[0, 1],
    );
    let found = settle(&pocket).unwrap();
    assert!(found.is_settled && (found.position[2][1] - 0.75_f64.sqrt()).abs() < 1e-12, "{found:?}");
}

/// Its tension has no bound: it sags by the root of what rounding leaves of its length.
#[test]
fn a_rope_that_is_exactly_taut_stays_straight() {
    let position: Vec<[f64; 2]> = (0..9).map(|i| [0.25 * f64::from(i), 0.0]).collect();
    let found = settle(&model(position, (0..8).map(|i| bond(i, i + 1, 0.25)).collect(), &[0, 8])).unwrap();
    assert!(found.is_settled && heights(&found)[0] > -1e-6, "{found:?}");
}

#[test]
fn a_rigid_cloth_hangs_in_space_from_two_corners() {
    let side = 6_u32;
    let at = |i: u32| [0.2 * f64::from(i % side), 3.0, 0.2 * f64::from(i / side)];
    let mut bonds: Vec<Bond> = Vec::new();
    for i in 0..side * side {
        bonds.extend((i % side + 1 < side).then(|| bond(i, i + 1, 0.2)));
        bonds.extend((i + side < side * side).then(|| bond(i, i + side, 0.2)));
    }
    let found = settle(&model((0..side * side).map(at).collect(), bonds, &[0, side - 1])).unwrap();
    assert!(found.is_settled && found.max_strain < 1e-10, "{} {}", found.residual, found.max_strain);
    let lowest = (0..side * side).map(|i| 3.0 - 0.2 * f64::from(i / side));
    let off = found.position.iter().zip(lowest).map(|(x, y)| (x[1] - y).abs()).fold(0.0, f64::max);
    assert!(off < 1e-5, "its rows hang straight below each other: {off}");
}

/// A stiff spring turns about its pin by half a circle: steps are bent to its length.
#[test]
fn a_stiff_spring_that_stands_on_its_pin_turns_over() {
    let found = settle(&model(vec![[0.0, 0.0], [0.0, 1.0]], vec![spring(0, 1, 1.0, 1e8)], &[0])).unwrap();
    assert!(found.is_settled && (found.position[1][1] + 1.0 + 9.81e-8).abs() < 1e-12, "{found:?}");
    assert!(found.rounds < 200, "{}", found.rounds);
}

#[test]
fn a_rope_from_a_pin_ends_on_the_floor() {
    let position: Vec<[f64; 2]> = (0..31).map(|i| [0.1 * f64::from(i), 1.0]).collect();
    let mut scene = model(position, (0..30).map(|i| bond(i, i + 1, 0.1)).collect(), &[0]);
    scene.planes = vec![plane([0.0, 1.0])];
    let found = settle(&scene).unwrap();
    assert!(found.is_settled && found.max_strain < 1e-12, "{found:?}");
    assert!(found.position[11..].iter().all(|x| x[1].abs() < 1e-12), "{found:?}");
    assert!(found.position[..11].iter().all(|x| (x[0] - found.position[0][0]).abs() < 1e-9), "{found:?}");
}

#[test]
fn shapes_without_forces_are_settled() {
    let free = settle(&Model { gravity: [0.0; 2], ..square(0.4, [3.0, 1.0]) }).unwrap();
    assert!(free.is_settled && free.falling.is_empty(), "{free:?}");
    let stretched = vec![spring(0, 1, 1.0, 10.0), spring(1, 2, 1.0, 10.0), spring(0, 2, 1.0, 10.0)];
    let triangle = Model { gravity: [0.0; 2], ..model(vec![[0.0, 0.0], [1.5, 0.0], [0.4, 1.3]], stretched, &[]) };
    let found = settle(&triangle).unwrap();
    assert!(found.is_settled && found.max_strain < 1e-12, "{found:?}");
    let lonely = Model { gravity: [0.0; 2], ..model(vec![[1.0, 2.0]], vec![], &[]) };
    assert_eq!(settle(&lonely).unwrap().position, lonely.position);
}

/// Two islands of stiffness 1e9 apart: each is measured by its own.
#[test]
fn a_stiff_island_does_not_blur_a_soft_one() {
    let mut scene = model(
        vec![[0.0, 0.0], [0.0, 1.0], [3.0, 0.0], [3.0, 1.0]],
        vec![spring(0, 1, 1.0, 1e10), spring(2, 3, 1.0, 10.0)],
        &[0, 2],
    );
    scene.position[3] = [3.0, -1.0];
    let found = settle(&scene).unwrap();
    assert!(found.is_settled && (found.position[3][1] + 1.981).abs() < 1e-12, "{found:?}");
}

/// A slope of 0.3 holds what has a friction above 0.3, whatever its shape and whichever of its corners carries more.
#[test]
fn a_rough_slope_holds_what_friction_can_hold() {
    for (friction, holds) in [(0.25, false), (0.29, false), (0.31, true), (0.4, true), (1.0, true)] {
        let slope = Plane { friction, ..plane([-0.3, 1.0]) };
        let mut scene = square(0.2, [0.0, 2.0]);
        scene.planes = vec![slope];
        let found = settle(&scene).unwrap();
        assert_eq!((found.is_settled, found.falling.is_empty()), (holds, holds), "{friction}: {found:?}");
        let corner = found.position[0];
        assert!(!holds || (length(corner) < 0.05 && (corner[1] - 0.3 * corner[0]).abs() < 1e-12), "{found:?}");
        let mut point = model(vec![[0.0, 2.0]], vec![], &[]);
        point.planes = vec![slope];
        let found = settle(&point).unwrap();
        assert_eq!((found.is_settled, found.falling.is_empty()), (holds, holds), "{friction}: {found:?}");
        assert!(!holds || length(found.position[0]) < 1e-9, "it lies where it fell: {found:?}");
    }
}

/// A rod of two equal masses between a floor and a wall, of the same friction f, slips when the tangent of its angle to
/// the floor is below (1 - f^2)/(2 f).
#[test]
fn a_ladder_slips_until_it_is_steep_enough() {
    let friction = 0.5;
    for (top, slips) in [(3.0, false), (1.2, false), (1.0, true)] {
        let foot = 1.5;
        let mut scene = model(vec![[0.0, top], [foot, 0.0]], vec![bond(0, 1, f64::hypot(top, foot))], &[]);
        scene.bounds = Some(Bounds { min: [0.0, 0.0], max: [9.0, 9.0], restitution: 0.0, friction });
        let found = settle(&scene).unwrap();
        assert!(found.is_settled && found.max_strain < 1e-12, "{found:?}");
        assert_eq!(found.position[1][0] - foot > 0.1, slips, "{top}: {found:?}");
    }
}

#[test]
fn a_soft_lattice_on_a_rough_slope_stays_there() {
    let side = 5_u32;
    let at = |i: u32| [0.2 * f64::from(i % side), 1.0 + 0.2 * f64::from(i / side)];
    let pairs = (0..side * side).flat_map(|i| (0..i).map(move |j| (i, j)));
    let near = pairs.map(|(i, j)| (i, j, length(sub(at(i), at(j))))).filter(|pair| pair.2 < 0.3);
    let bonds = near.map(|(i, j, rest)| spring(i, j, rest, 3000.0)).collect();
    let mut scene = model((0..side * side).map(at).collect(), bonds, &[]);
    scene.planes = vec![Plane { friction: 0.6, ..plane([-0.2, 1.0]) }];
    let found = settle(&scene).unwrap();
    assert!(found.is_settled, "{found:?}");
    assert!(found.position.iter().all(|x| (-0.5..1.5).contains(&x[0]) && x[1] > 0.2 * x[0] - 1e-12), "{found:?}");
    scene.planes = vec![plane([-0.2, 1.0])];
    assert_eq!(settle(&scene).unwrap().falling.len(), 25);
}
