//! Piles of rigid bodies: they come to rest, in each other nowhere, by work that grows with what may touch and not with what they are made of.

use serde_json::{Value, json};
use wobble::scene::record::ledgers;
use wobble::sim::{Dynamics, Sample, judge};

use super::world;

/// Columns and rows of points of a box, and its sides [m].
type Size = ([u32; 2], [f64; 2]);

const CRATE: Size = ([2, 2], [0.5, 0.5]);
const BOARD: Size = ([13, 8], [0.96, 0.56]);

fn go(world: &mut dyn Dynamics, t: f64) {
    while world.time() < t - 1e-9 {
        world.step_until(t);
    }
}

/// A rigid box of 1 kg with its middle there, turned by an angle [rad].
fn make_box(([columns, rows], [width, height]): Size, [x, y]: [f64; 2], angle: f64) -> Value {
    let spacing = width / f64::from(columns - 1);
    let (half, (sin, cos)) = ([0.5 * width, 0.5 * height], angle.sin_cos());
    let corner = [x - cos * half[0] + sin * half[1], y - sin * half[0] - cos * half[1]];
    json!({"make": "lattice", "columns": columns, "rows": rows, "spacing": spacing, "origin": corner, "angle": angle,
        "material": {"kind": "rigid", "mass": 1}})
}

fn scene(bodies: Vec<Value>, width: f64) -> Value {
    json!({"wobble": 1, "gravity": [0, -9.81], "contact": {"friction": 0.5}, "bodies": bodies,
        "bounds": {"min": [0, 0], "max": [width, 40], "friction": 0.5}})
}

/// So many boxes, each at another angle, that fall into a box 10 m wide.
fn pile(size: Size, count: u32) -> Value {
    let place = |k: u32| [0.8 + 1.15 * f64::from(k % 8) + 0.4 * f64::from(k / 8 % 2), 0.8 + 1.2 * f64::from(k / 8)];
    scene((0..count).map(|k| make_box(size, place(k), 0.83 * f64::from(k % 9))).collect(), 10.0)
}

/// How deep a corner of a box is in another box at most [m].
fn deepest(sample: &Sample, ([columns, rows], _): Size) -> f64 {
    let (columns, rows) = (columns as usize, rows as usize);
    let corners = |points: &[[f64; 3]]| -> Vec<[f64; 2]> {
        let corners = [0, columns - 1, columns * rows - 1, columns * (rows - 1)];
        corners.iter().map(|&k| [points[k][0], points[k][1]]).collect()
    };
    let boxes: Vec<Vec<[f64; 2]>> = sample.position.chunks(columns * rows).map(corners).collect();
    let depth = |x: [f64; 2], of: &[[f64; 2]]| {
        let behind = |k: usize| {
            let (a, b) = (of[k], of[(k + 1) % 4]);
            let u = [b[0] - a[0], b[1] - a[1]];
            (u[0] * (x[1] - a[1]) - u[1] * (x[0] - a[0])) / u[0].hypot(u[1])
        };
        (0..4).map(behind).fold(f64::INFINITY, f64::min)
    };
    let mut most: f64 = 0.0;
    for (i, one) in boxes.iter().enumerate() {
        for (_, other) in boxes.iter().enumerate().filter(|(j, _)| *j != i) {
            most = one.iter().fold(most, |most, &x| most.max(depth(x, other)));
        }
    }
    most
}

#[test]
fn a_pile_of_boxes_falls_asleep_and_nothing_lies_in_anything() {
    for (size, count) in [(CRATE, 60), (BOARD, 48)] {
        let mut world = world(&pile(size, count));
        let mut deep: f64 = 0.0;
        while !world.is_asleep() && world.time() < 8.0 {
            world.step();
            deep = deep.max(deepest(&world.sample(world.time()), size));
        }
        assert!(world.is_asleep(), "{count} boxes of {size:?} move for 8 s");
        assert!(deep < 5e-3, "{count} boxes of {size:?} were {deep} m deep in each other");
        let high = world.sample(world.time()).position.iter().fold(0.0, |most: f64, x| most.max(x[1]));
        assert!(high > 1.2, "they lie on each other, {high} m high");
    }
}

#[test]
fn a_tower_stands_and_a_pyramid_does() {
    let at = |row: u32, column: f64| make_box(CRATE, [5.0 + 0.53 * column, 0.252 + 0.521 * f64::from(row)], 0.0);
    let tower: Vec<Value> = (0..10).map(|row| at(row, 0.0)).collect();
    let rows = (0..8).flat_map(|row| (0..8 - row).map(move |column| (row, f64::from(column) + 0.5 * f64::from(row))));
    let pyramid: Vec<Value> = rows.map(|(row, column)| at(row, column)).collect();
    for bodies in [tower, pyramid] {
        let mut scene = scene(bodies, 20.0);
        scene["contact"]["radius"] = json!(0.01);
        let mut world = world(&scene);
        let start = world.sample(0.0);
        while !world.is_asleep() && world.time() < 6.0 {
            world.step();
        }
        assert!(world.is_asleep(), "{} points", start.position.len());
        let end = world.sample(world.time());
        let aside = start.position.iter().zip(&end.position).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f64::max);
        assert!(aside < 0.03, "it leans by {aside} m");
        let [before, after] =
            [&start, &end].map(|state| state.position.iter().fold(0.0, |most: f64, x| most.max(x[1])));
        assert!((before - after).abs() < 0.03, "it was {before} m high and is {after}");
    }
}

#[test]
fn what_lies_within_a_rigid_body_is_not_moved_in_each_substep() {
    let substeps = |points: u32| {
        let size = ([points, points], [0.5, 0.5]);
        let bodies = vec![make_box(size, [1.0, 0.27], 0.0), make_box(size, [1.0, 0.79], 0.0)];
        let mut scene = scene(bodies, 4.0);
        scene["method"] = json!({"solver": "live", "sleep": false});
        let mut world = world(&scene);
        go(&mut *world, 0.5);
        let counters = world.counters();
        (counters.points_moved as f64 / counters.substeps as f64, counters.work as f64)
    };
    let [(plain, work), (full, more)] = [2, 12].map(substeps);
    assert_eq!([plain, full], [8.0; 2], "corners of two boxes in each");
    assert!(more < 1.5 * work, "{more} operations of 288 points, {work} of 8");
}

#[test]
fn a_ledger_changes_nothing_of_a_pile() {
    let end = |is_told: bool| {
        let mut scene = pile(BOARD, 24);
        scene["method"] = json!({"solver": "live", "ledger": is_told});
        let mut world = world(&scene);
        go(&mut *world, 2.0);
        (world.sample(world.time()), world.counters().contacts)
    };
    let [plain, told] = [false, true].map(end);
    assert!(plain.1 > 100, "they touch {} times", plain.1);
    assert_eq!(plain.0.position, told.0.position);
    assert_eq!(plain.0.velocity, told.0.velocity);
}

/// Two boards on each other slide where what pushes them is more than friction holds of their weight, and not before.
#[test]
fn all_the_weight_that_stands_on_a_board_holds_it() {
    let pushed = |force: f64| {
        let bodies = (0..2).map(|row| make_box(BOARD, [5.0, 0.281 + 0.565 * f64::from(row)], 0.0)).collect();
        let mut scene = scene(bodies, 20.0);
        scene["method"] = json!({"solver": "live", "sleep": false});
        // Both are pushed, so that neither slides on the other.
        let push = |k: u32| json!({"points": (104 * k..104 * (k + 1)).collect::<Vec<_>>(), "force": [0.5 * force, 0]});
        scene["forces"] = json!((0..2).map(push).collect::<Vec<_>>());
        let mut world = world(&scene);
        let x = |t: f64, world: &mut dyn Dynamics| {
            go(world, t);
            world.sample(t).position[0][0]
        };
        // Once they have landed.
        let start = x(0.5, &mut *world);
        x(1.5, &mut *world) - start
    };
    let holds = 0.5 * 2.0 * 9.81;
    let [held, slides] = [0.95, 1.1].map(|share| pushed(share * holds));
    assert!(held.abs() < 1e-3, "it slid by {held} m");
    // With the speed that they have by then, and at 0.49 m/s^2.
    assert!(slides > 0.2, "it slid by {slides} m");
}

#[test]
fn a_tower_of_ten_is_at_rest_also_where_all_is_ten_times_as_heavy() {
    let bodies = (0..10).map(|row| make_box(CRATE, [5.0, 0.26 + 0.52 * f64::from(row)], 0.0)).collect();
    let mut scene = scene(bodies, 20.0);
    (scene["gravity"], scene["contact"]["radius"]) = (json!([0, -100]), json!(0.01));
    scene["method"] = json!({"solver": "live", "ledger": true});
    let list = ledgers(&mut *world(&scene), 3.0).unwrap();
    let (end, verdict) = (list.last().unwrap(), judge(&list));
    assert!(end.now.kinetic == 0.0, "{:?}", end.now);
    // Of the 2,600 J that they have above the floor.
    assert!(end.left_over().abs() < 10.0 && verdict.passes(), "{} J: {verdict:?}", end.left_over());
}

/// Bars and boxes of 10 g, 1 kg and 100 kg that spin by up to 200 rad/s on both sides of a wall of 1 to 2 cm.
#[test]
fn what_is_light_and_spins_among_what_is_heavy_gets_through_no_thin_wall() {
    let scene: Value = serde_json::from_str(include_str!("../files/chamber.json")).unwrap();
    let mut world = world(&scene);
    let start = world.sample(0.0);
    let left: Vec<usize> = (0..start.position.len()).filter(|&i| start.position[i][0] < 10.0).collect();
    while world.time() < 2.5 {
        world.step();
        let now = world.sample(world.time());
        let most = left.iter().map(|&i| now.position[i][0] - 10.0).fold(f64::MIN, f64::max);
        assert!(most < 0.05, "{most} m beyond the wall at {} s", world.time());
    }
}
