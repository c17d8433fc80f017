//! The scenes, as scene files of wobble; all else is made of them.

use serde_json::{Value, json};

use crate::peer::FRAMES_A_SECOND;

/// Frames between two looks at a heap.
pub(crate) const FRAMES_A_LOOK: usize = 6;

/// Equal bodies that fall into a box without a lid.
pub(crate) struct Scene {
    /// How tables and the command line call it.
    pub(crate) name: &'static str,
    /// How long it lasts [s].
    pub(crate) seconds: usize,
    /// Number of its bodies, from below.
    pub(crate) bodies: usize,
    /// Smallest distance between the skins of two bodies at the start [m].
    pub(crate) gap: f64,
    /// The scene file.
    pub(crate) file: Value,
}

impl Scene {
    /// Frames of a run.
    pub(crate) fn frames(&self) -> usize {
        self.seconds * FRAMES_A_SECOND
    }

    /// How often it is run where `runs` are asked for: a scene that takes minutes just once.
    pub(crate) fn runs(&self, runs: u32) -> u32 {
        if self.bodies > 100 { 1 } else { runs }
    }
}

/// All scenes, or those that are quick to run.
pub(crate) fn all(quick: bool) -> Vec<Scene> {
    let mut scenes = vec![heap("heap 100", 10, 8, 100), shaft(), slabs()];
    if !quick {
        scenes.push(heap("heap 1000", 5, 80, 1000));
    }
    scenes
}

/// The scene of `benches/live.rs` for 8 columns; for more, a box wider by as many columns.
fn heap(name: &'static str, seconds: usize, columns: usize, bodies: usize) -> Scene {
    const STEP: f64 = 1.15;
    let disc = |k: usize| {
        let (row, column) = (k / columns, k % columns);
        let shift = 0.4 * (row % 2) as f64;
        json!({"make": "disc", "radius": 0.5, "spacing": 0.09, "velocity": [0, -2], "material": soft(),
            "origin": [0.7 + STEP * column as f64 + shift, 0.7 + 1.2 * row as f64]})
    };
    let width = 0.8 + STEP * columns as f64;
    let file = in_box([0.0, 0.0], [width, 40.0], 0.3, (0..bodies).map(disc).collect());
    Scene { name, seconds, bodies, gap: STEP - 1.0, file }
}

/// The scene of `ten_discs_in_a_shaft_come_to_rest_apart_and_creep_no_more` in `tests/live.rs`.
fn shaft() -> Scene {
    let disc = |k: usize| {
        json!({"make": "disc", "radius": 0.25, "spacing": 0.1, "material": soft(),
            "origin": [0.02 * (k % 2) as f64, 0.3 + 0.6 * k as f64]})
    };
    let file = in_box([-0.4, 0.0], [0.4, 20.0], 0.5, (0..10).map(disc).collect());
    Scene { name: "shaft", seconds: 12, bodies: 10, gap: 0.1, file }
}

/// The scene of `ten_slabs_fall_asleep_and_creep_no_more` in `tests/live/heap.rs`.
fn slabs() -> Scene {
    let slab = |k: usize| {
        json!({"make": "lattice", "columns": 12, "rows": 3, "spacing": 0.1, "material": soft(),
            "origin": [0.01 * (k % 2) as f64 - 0.55, 0.02 + 0.25 * k as f64]})
    };
    let file = in_box([-6.0, 0.0], [6.0, 20.0], 0.5, (0..10).map(slab).collect());
    Scene { name: "slabs", seconds: 12, bodies: 10, gap: 0.05, file }
}

/// Bonds of 3000 N/m; the mass is the body's.
fn soft() -> Value {
    json!({"kind": "spring", "stiffness": 3000, "damping": 0.2, "mass": 1})
}

fn in_box(min: [f64; 2], max: [f64; 2], friction: f64, bodies: Vec<Value>) -> Value {
    json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "bodies": bodies,
        "bounds": {"min": min, "max": max, "friction": friction}})
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_box_of_8_columns_is_10_m_wide() {
        let scenes = all(false);
        let widths: Vec<f64> = scenes.iter().filter_map(|scene| scene.file["bounds"]["max"][0].as_f64()).collect();
        assert!((widths[0] - 10.0).abs() < 1e-12 && (widths[3] - 92.8).abs() < 1e-12, "{widths:?}");
        assert!(scenes.iter().all(|scene| scene.file["bodies"].as_array().map(Vec::len) == Some(scene.bodies)));
    }
}
