//! A box that lands on a corner, which friction holds while the box turns about it.

use serde_json::json;

use super::{run, world};

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
