//! Sizes of what springs hold together, and of loose points.

use serde_json::{Value, json};
use wobble::sim::{Bond, Limit, Model, sizes};

use super::across::{Across, fine, floor, keys, of, precision, spring, thrown, tipped};
use crate::large::models::{FRAME, rope, sheet};

/// A net of rows, columns and one diagonal a cell.
fn net(size: [u32; 2], stiffness: f64) -> Model<2> {
    of(spring(stiffness), sheet(size, [true, false]))
}

/// A level row of springs from a pin.
fn row(count: usize, stiffness: f64) -> Model<2> {
    of(spring(stiffness), rope(count as u32 + 1))
}

/// The stiffness at which so many substeps a frame resolve a row of springs between unit masses by a method of order 4 `[N/m]`.
fn stiff(substeps: f64) -> f64 {
    (substeps * 0.5 / FRAME).powi(2) / 4.0
}

fn loose(count: usize) -> Model<2> {
    let position: Vec<[f64; 2]> =
        (0..count as u32).map(|i| [0.01 * f64::from(i), 1.0 + 0.001 * f64::from(i % 7)]).collect();
    thrown(
        0.6,
        Model {
            velocity: vec![[0.0; 2]; count],
            mass: vec![1.0; count],
            position,
            gravity: [0.0, -9.8],
            ..Model::default()
        },
    )
}

#[test]
fn located_touches_go_over_to_forces() {
    let net = thrown(0.5, net([16, 16], 2e3));
    let more = (sizes::MOST_TOUCHING - net.bonds.len()) as u32 - 1;
    let [below, above] = [more, more + 1].map(|more| keys(&tipped(&net, more, spring(2e3)), &floor(-1.6)));
    let fine = fine("rk4", 512);
    Across { size: "MOST_TOUCHING", below, above, fine, seconds: 0.2, points: 256 }
        .check_methods(["pefrl", "velocity-verlet a mesh by forces"]);
}

#[test]
fn forces_go_over_to_an_implicit_method_where_springs_touch() {
    let of_substeps = |substeps: f64| {
        let k = (substeps * 0.25 / FRAME).powi(2) / 12.0;
        keys(&thrown(0.5, net([18, 18], k)), &floor(-1.8))
    };
    let [below, above] = [0.999, 1.001].map(|share| of_substeps(share * sizes::MOST_TOUCHES));
    let fine = json!({ "method": { "solver": "rk4", "substep": FRAME / 8192.0 } });
    Across { size: "MOST_TOUCHES", below, above, fine, seconds: 0.04, points: 324 }
        .check_methods(["velocity-verlet a sheet by forces", "implicit-midpoint"]);
}

#[test]
fn stiff_springs_go_over_to_an_implicit_method() {
    let of_substeps = |substeps: f64| keys(&thrown(0.1, row(50, stiff(substeps))), &json!({}));
    let [below, above] = [0.999, 1.001].map(|share| of_substeps(share * sizes::STIFF));
    let fine = fine("pefrl", 2048);
    Across { size: "STIFF", below, above, fine, seconds: 0.2, points: 51 }
        .check_methods(["pefrl", "implicit-midpoint"]);
}

#[test]
fn stiff_springs_that_are_struck_go_over_to_an_implicit_method() {
    let of_work = |work: f64| {
        let net = net([12, 12], 1.0);
        // 160 operations a spring and substep.
        let substeps = work / (160.0 * net.bonds.len() as f64);
        let k = (substeps * 0.5 / FRAME).powi(2) / 12.0;
        keys(&thrown(0.5, of(spring(k), net)), &floor(-1.15))
    };
    let [below, above] = [0.999, 1.001].map(|share| of_work(share * sizes::MOST_STIFF_STRUCK));
    let fine = fine("pefrl", 2048);
    Across { size: "MOST_STIFF_STRUCK", below, above, fine, seconds: 0.15, points: 144 }
        .check_methods(["pefrl", "implicit-midpoint"]);
}

/// A net and bonds 50 m off, so that one more makes so many points, at so many substeps a frame.
fn large_net(points: usize, substeps: f64) -> [Value; 2] {
    let k = stiff(substeps) / 3.0;
    let net = thrown(0.1, net([60, 60], k));
    let more = (points - 3_600) as u32;
    [more - 1, more].map(|more| keys(&tipped(&net, more, spring(k)), &json!({})))
}

#[test]
fn implicit_steps_go_over_to_explicit_ones_that_are_cheaper() {
    let [below, above] =
        large_net(sizes::MOST_IMPLICIT, 0.95 * sizes::STIFF_OF_A_NET * (sizes::MOST_IMPLICIT as f64).sqrt());
    let fine = fine("pefrl", 1024);
    Across { size: "MOST_IMPLICIT", below, above, fine, seconds: FRAME, points: 3_600 }
        .check_methods(["implicit-midpoint", "pefrl"]);
}

#[test]
fn explicit_steps_of_a_large_net_go_over_to_implicit_ones() {
    let count = sizes::MOST_IMPLICIT + 100;
    let of_share = |share: f64| large_net(count, share * sizes::STIFF_OF_A_NET * (count as f64).sqrt())[0].clone();
    let [below, above] = [0.995, 1.005].map(of_share);
    let fine = fine("pefrl", 1024);
    Across { size: "STIFF_OF_A_NET", below, above, fine, seconds: FRAME, points: 3_600 }
        .check_methods(["pefrl", "implicit-midpoint"]);
}

#[test]
fn stiff_springs_in_a_long_row_stay_implicit() {
    // Factors of a tree grow no faster than its points.
    let [short, long] = [2_000, 6_000].map(|count| keys(&row(count, 1e9), &json!({})));
    let [short, long] = [short, long].map(|keys| super::across::moved(&keys, FRAME));
    assert_eq!([&*short.by, &*long.by], ["implicit-midpoint"; 2]);
    assert!(long.work < 4.0 * short.work, "{} in {}", long.work, short.work);
}

#[test]
fn order_4_goes_over_to_order_2() {
    let row = thrown(0.1, row(sizes::LARGE - 10, 100.0));
    let [below, above] = [8, 9].map(|more| keys(&tipped(&row, more, spring(100.0)), &json!({})));
    let fine = fine("pefrl", 32);
    Across { size: "LARGE", below, above, fine, seconds: 0.1, points: sizes::LARGE - 9 }
        .check_methods(["pefrl", "velocity-verlet a mesh by forces"]);
}

#[test]
fn large_scenes_go_over_to_single_precision() {
    let row = thrown(0.1, row(sizes::LARGE_SINGLE - 10, 100.0));
    let by_forces = json!({ "method": { "solver": "velocity-verlet", "precision": "auto" } });
    let [below, above] = [8, 9].map(|more| keys(&tipped(&row, more, spring(100.0)), &by_forces));
    let fine = fine("pefrl", 32);
    let across = Across { size: "LARGE_SINGLE", below, above, fine, seconds: 0.1, points: sizes::LARGE_SINGLE - 9 };
    across.check();
    assert_ne!(precision(&across.below), precision(&across.above));
}

#[test]
fn hits_of_many_points_are_not_located() {
    let count = sizes::MOST_LOCATED;
    let ground = json!({ "obstacles": [{ "plane": { "point": [0, 0], "normal": [0, 1] }, "restitution": 0.8, "friction": 0.1 }] });
    let [below, above] = [count, count + 1].map(|count| keys(&loose(count), &ground));
    let fine = fine("velocity-verlet", 512);
    Across { size: "MOST_LOCATED", below, above, fine, seconds: 0.6, points: count }.check();
}

/// A hill, whose sides are walls.
fn hill() -> Value {
    let outline = json!([[-50, -5], [50, -5], [50, 0], [0.4, 0.1], [0, 0], [-50, 0]]);
    json!({ "obstacles": [{ "polygon": [outline], "restitution": 0.8, "friction": 0.1 }] })
}

#[test]
fn hits_of_many_points_among_walls_are_not_located() {
    let count = sizes::MOST_AMONG_WALLS;
    let [below, above] = [count, count + 1].map(|count| keys(&loose(count), &hill()));
    let fine = fine("rk4", 64);
    Across { size: "MOST_AMONG_WALLS", below, above, fine, seconds: 0.6, points: count }.check();
}

#[test]
fn loose_points_go_in_groups() {
    let count = sizes::MOST_LOOSE;
    let [below, above] = [count, count + 1].map(|count| keys(&loose(count), &json!({})));
    let fine = fine("rk8", 4);
    Across { size: "MOST_LOOSE", below, above, fine, seconds: 0.6, points: count }.check();
}

#[test]
fn many_strings_decide_for_themselves() {
    // A spring of two halves is the same spring.
    let halved = |halved: usize| {
        let whole = thrown(1.5, row(380, 2e3));
        let halves = whole.bonds.iter().enumerate().flat_map(|(i, bond)| {
            let count = 1 + usize::from(i < halved);
            std::iter::repeat_n(Bond { kind: spring(2e3 / count as f64), limit: Limit::Max, ..bond }, count)
        });
        keys(&Model { bonds: halves.collect(), ..whole.clone() }, &json!({}))
    };
    let [below, above] = [0, 1].map(|more| halved(sizes::MOST_LIMITED - 380 + more));
    let fine = fine("rk4", 256);
    let [below, above] = Across { size: "MOST_LIMITED", below, above, fine, seconds: 0.3, points: 381 }.check();
    assert!(below.events > 0 && above.events == 0, "{} and {} events", below.events, above.events);
}

#[test]
fn explicit_steps_have_a_shortest_one() {
    let of_substeps = |substeps: f64| {
        let pair = thrown(1.0, Model { pinned: Vec::new(), ..row(1, 2.0 * stiff(substeps)) });
        keys(&pair, &json!({ "method": { "solver": "pefrl" } }))
    };
    let [below, above] = [0.999, 1.001].map(|share| of_substeps(share * sizes::MOST_SUBSTEPS));
    let fine = fine("blanes-moan-6", 100_000);
    Across { size: "MOST_SUBSTEPS", below, above, fine, seconds: FRAME, points: 2 }.check();
}
