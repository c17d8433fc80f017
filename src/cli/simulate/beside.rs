//! How far the same start by other methods gets from a run.

use crate::history::{Companion, Recording, distances};
use crate::scene::record::RecordedBeside;
use crate::sim::Sample;

/// What the scene has beside it, led by the same commands: measured at each of the samples.
///
/// Errors: a method that cannot run the scene.
pub(super) fn measured(recording: &Recording, samples: &[Sample]) -> anyhow::Result<Vec<RecordedBeside>> {
    let of = |entry| -> anyhow::Result<RecordedBeside> {
        let mut companion = Companion::new(recording, entry)?;
        let substep = companion.world().substep();
        let distance = samples.iter().map(|sample| farthest(&mut companion, recording, sample)).collect();
        let solver = recording.scene.companion(entry).method.solver.unwrap_or(crate::scene::SolverName::Auto).name();
        Ok(RecordedBeside { title: companion.title().to_owned(), solver, substep, distance })
    };
    recording.scene.beside.iter().map(of).collect()
}

/// The largest distance of a point from where a sample has it `[m]`.
fn farthest(companion: &mut Companion, recording: &Recording, sample: &Sample) -> f64 {
    companion.reach(&recording.commands, sample.time);
    let own = companion.world().sample(sample.time.max(companion.world().time()));
    let [main, own] = [sample, &own].map(|sample| sample.position.as_flattened());
    let all = distances(main, own, 3).into_iter();
    f64::from(all.filter(|distance| !distance.is_nan()).fold(0.0, f32::max))
}
