//! Runs a scene in an engine that lives in this process.

use std::time::Instant;

use super::judge::{Look, Verdict};
use super::mesh::Mesh;
use super::scenes::{FRAMES_A_LOOK, Scene};
use crate::peer::FRAMES_A_SECOND;
use crate::times::Times;

/// A scene inside an engine.
pub(crate) trait Heap {
    /// Advances by one frame; this alone is timed.
    fn step(&mut self);

    /// Place of each point [m], in the order of the mesh.
    fn positions(&self) -> Vec<[f64; 2]>;

    /// Velocity of each point [m/s].
    fn velocities(&self) -> Vec<[f64; 2]>;

    /// Whether all bodies sleep.
    fn is_asleep(&self) -> bool;
}

/// What a run cost and how good it was.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    /// What a frame took.
    pub(crate) times: Times,
    /// What came of it.
    pub(crate) verdict: Verdict,
}

/// Steps a fresh heap to the end of its scene.
pub(crate) fn run(scene: &Scene, mesh: &Mesh, mut heap: impl Heap) -> Outcome {
    let mut seconds = Vec::with_capacity(scene.frames());
    let mut verdict = Verdict::default();
    for frame in 1..=scene.frames() {
        let start = Instant::now();
        heap.step();
        seconds.push(start.elapsed().as_secs_f64());
        if frame % FRAMES_A_LOOK == 0 {
            let time = frame as f64 / FRAMES_A_SECOND as f64;
            let (positions, velocities) = (heap.positions(), heap.velocities());
            let is_asleep = heap.is_asleep();
            verdict.look(mesh, &Look { time, positions: &positions, velocities: &velocities, is_asleep });
        }
    }
    Outcome { times: Times::of(seconds), verdict }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::heaps::mesh::wheel;
    use crate::heaps::{box2d, rapier};

    fn scene(seconds: usize) -> Scene {
        Scene { name: "wheel", seconds, bodies: 1, gap: 1.0, file: serde_json::Value::Null }
    }

    /// A wheel falls 0.1 m and lies still on two points, which are on the floor; the hub sags by less than 1 %.
    fn lies_on_the_floor(mesh: &Mesh, mut heap: impl Heap) {
        (0..scene(8).frames()).for_each(|_| heap.step());
        let positions = heap.positions();
        let lowest = positions.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
        // Both engines let a contact in by 5 mm before they mind.
        assert!((-0.006..0.003).contains(&lowest), "the lowest point is at {lowest} m");
        let height = mesh.positions[0][0].hypot(mesh.positions[0][1] - mesh.positions[16][1])
            * (std::f64::consts::PI / 16.0).cos();
        let hub = positions[16];
        assert!((hub[1] - lowest - height).abs() < 0.02 * height, "the hub is at {hub:?}, not {height} m");
        assert!(heap.velocities().iter().all(|v| v[0].hypot(v[1]) < 1e-2));
        assert!(heap.is_asleep());
    }

    #[test]
    fn a_wheel_comes_to_rest_on_the_floor_in_every_engine() -> anyhow::Result<()> {
        let mesh = wheel(0.5, 0.6)?;
        for skin in [crate::heaps::mesh::SKIN, rapier::OWN_SKIN] {
            lies_on_the_floor(&mesh, rapier::World::new(&scene(8), &mesh, skin));
        }
        for circles in [box2d::Circles::Skins, box2d::Circles::All] {
            lies_on_the_floor(&mesh, box2d::World::new(&scene(8), &mesh, circles));
        }
        Ok(())
    }
}
