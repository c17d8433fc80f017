//! Relaxed bonds give way in the live step as by the sweeps of their own method, whatever its substeps.

use serde_json::json;

use super::run;

#[test]
fn a_weight_on_a_relaxed_bond_hangs_as_deep_as_its_sweeps_amount_to() {
    for (relaxation, iterations, substep) in [(0.1, 3, 0.005), (0.05, 1, 0.001), (0.5, 2, 0.01)] {
        let scene = |dimensions: usize, solver: &str| {
            let gravity = json!([0.0, -9.81, 0.0][..dimensions]);
            let position = [[0, 0, 0], [0, -1, 0]].map(|x| json!(x[..dimensions]));
            json!({"wobble": 1, "dimensions": dimensions, "gravity": gravity, "drag_rate": 3,
                "method": {"solver": solver, "iterations": iterations, "substep": substep},
                "points": {"position": position, "mass": [1, 2], "pinned": [0]},
                "bonds": [{"a": 0, "b": 1, "kind": "relaxed", "relaxation": relaxation}]})
        };
        // docs/sources.md: of q = (1 - k)^n of an error K = m/h^2 (1 - q)/q.
        let left = (1.0_f64 - relaxation).powi(iterations);
        let depth = 9.81 * substep * substep * left / (1.0 - left);
        for dimensions in [2, 3] {
            let (rest, _) = run(&scene(dimensions, "live"), 8.0);
            let off = (-1.0 - rest.position[1][1]) / depth - 1.0;
            assert!(off.abs() < 0.02, "{relaxation}, {iterations}, {dimensions} dimensions: {off} of {depth} m");
        }
    }
}
