//! A heap in wobble, which is another program: judged by its samples.

use anyhow::Result;

use super::judge::{Look, Verdict};
use super::mesh::Mesh;
use super::run::Outcome;
use super::scenes::{FRAMES_A_LOOK, Scene};
use crate::peer::FRAMES_A_SECOND;
use crate::program::{Program, Run};

/// Runs a scene to its end, with a sample at each look.
pub(crate) fn run(program: &Program, scene: &Scene, mesh: &Mesh) -> Result<Outcome> {
    let looks = (1..=scene.frames() / FRAMES_A_LOOK).map(|k| (k * FRAMES_A_LOOK) as f64 / FRAMES_A_SECOND as f64);
    let run = program.simulate(&scene.file, &looks.collect::<Vec<_>>())?;
    Ok(Outcome { times: run.times(scene.frames())?, verdict: verdict(&run, mesh) })
}

fn verdict(run: &Run, mesh: &Mesh) -> Verdict {
    let mut verdict = Verdict::default();
    for (sample, is_asleep) in run.samples.iter().zip(run.is_asleep()) {
        let (positions, velocities) = (&*sample.position, &*sample.velocity);
        verdict.look(mesh, &Look { time: sample.t, positions, velocities, is_asleep });
    }
    verdict
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_heap_sleeps_once_it_stands_still_to_the_last_bit() -> Result<()> {
        let mesh = crate::heaps::mesh::wheel(1.0, 2.0)?;
        let sample = |t: f64, vy: f64| json!({"t": t, "position": mesh.positions, "velocity": vec![[0.0, vy]; 17]});
        let run: Run = serde_json::from_value(json!({
            "samples": [sample(0.1, 1e-9), sample(0.2, 0.0), sample(0.3, 0.0)],
            "seconds": 0.6, "frames": {"count": 300, "median_ms": 1.5, "p99_ms": 3.0, "worst_ms": 4.0}}))?;
        let verdict = verdict(&run, &mesh);
        assert_eq!((verdict.calm_after, verdict.asleep_after), (Some(0.1), Some(0.2)));
        Ok(())
    }
}
