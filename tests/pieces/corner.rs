//! A box that lands on a corner, which friction holds while the box turns about it.

use serde_json::json;

use super::{run, world};
use crate::common::physics::run_to;

#[test]
fn a_corner_that_friction_holds_stays_where_it_landed() {
    let (tilt, fall) = (0.2_f64, 0.5);
    let (s, c) = tilt.sin_cos();
    let position: Vec<[f64; 2]> =
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| [c * x - s * y, fall + s * x + c * y]).to_vec();
    let bonds = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]].map(|[a, b]| json!({"a": a, "b": b}));
    let mut world = world(&json!({"wobble": 1, "gravity": [0, -9.81],
        "points": {"position": position, "mass": 1, "velocity": vec![[1, 0]; 4]}, "bonds": bonds,
        "bounds": {"min": [-50, 0], "max": [50, 50], "friction": 0.4}}));
    // It hits after 0.3193 s; the next corner after 0.41 s.
    let landed = (2.0 * fall / 9.81_f64).sqrt();
    for t in [0.335, 0.35, 0.37, 0.4] {
        let corner = run(&mut *world, t).position[0];
        assert!((corner[0] - landed).abs() < 1e-9 && corner[1].abs() < 1e-9, "{corner:?} at {t} s");
    }
}

/// A rod lands on a rough floor and slides: however fine the substep that is asked for, its foot is where a coarse one puts it.
#[test]
fn the_finest_substeps_are_no_worse_than_coarse_ones() {
    let foot = |substep: f64| {
        let scene = json!({"wobble": 1, "gravity": [0, -9.81], "method": {"substep": substep, "budget": "none"},
            "points": {"position": [[0, 0.2], [0.54030230586814, 1.041470984807896]], "velocity": [[1, 0], [1, 0]], "mass": [1, 2]},
            "bonds": [{"a": 0, "b": 1}], "bounds": {"min": [-900, 0], "max": [900, 900], "friction": 0.4, "restitution": 0.3}});
        let mut world = world(&scene);
        let end = run_to(&mut *world, 0.5);
        assert_eq!(world.counters().hand_overs, 0, "{substep} s");
        end.position[0]
    };
    let coarse = foot(1e-3);
    for substep in [1e-4, 3e-5, 1e-5] {
        let fine = foot(substep);
        let off = (fine[0] - coarse[0]).hypot(fine[1] - coarse[1]);
        assert!(off < 1e-4, "{off} m off by {substep} s");
    }
}
