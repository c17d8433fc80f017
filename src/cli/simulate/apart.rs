//! What a tolerance can be held to in a scene in which bodies meet: the time until they may.

use anyhow::bail;

use crate::scene::{BudgetKeys, Meeting, Scene, SolverName};
use crate::sim::Why;

/// Counted work of a frame that no scene has `[ms]`: nothing is handed over for being dear.
const ANY_WORK: f64 = 1e12;

/// How far a scene in which bodies meet goes as one in which they do not.
pub(super) struct Apart {
    /// The samples until bodies may meet `[s]`.
    times: Vec<f64>,
    /// When that is `[s]`.
    meets: f64,
}

impl Apart {
    /// The samples that a tolerance can be held to `[s]`.
    ///
    /// Errors: there are none.
    pub(super) fn times(&self) -> anyhow::Result<Vec<f64>> {
        if self.times.is_empty() {
            bail!("{}, before the first sample", self.words());
        }
        Ok(self.times.clone())
    }

    /// Errors, always: what comes after is not within the tolerance.
    pub(super) fn report(&self) -> anyhow::Result<()> {
        bail!("{} (what comes before is written)", self.words());
    }

    fn words(&self) -> String {
        format!("bodies may meet from t = {:.6} s on, and no tolerance is held to from then on", self.meets)
    }
}

/// Takes contact from a scene that is to keep to a tolerance, and says until when it goes the same; `None`: to the last of `times` `[s]`. A scene
/// of which that cannot be said is left as it is.
///
/// Errors: those of [`Scene::world`].
pub(super) fn split(scene: &mut Scene, times: &[f64]) -> anyhow::Result<Option<Apart>> {
    let is_auto = scene.method.solver.is_none_or(|solver| solver == SolverName::Auto);
    if scene.method.tolerance.is_none()
        || scene.contact.and_then(Meeting::resolve).is_none()
        || scene.dimensions() != 2
        || !is_auto
    {
        return Ok(None);
    }
    let mut together = scene.clone();
    (together.method.tolerance, together.method.budget) = (None, Some(BudgetKeys::Ms(ANY_WORK)));
    let end = times.last().copied().unwrap_or(0.0);
    let mut world = together.world(Some(end))?;
    let meets = loop {
        let own = world.moved_by();
        let met = own.iter().filter(|moved| moved.why == Why::Contact).map(|moved| moved.since);
        if let Some(since) = met.min_by(f64::total_cmp) {
            break Some(since);
        }
        if world.time() >= end {
            break None;
        }
        world.step();
    };
    scene.contact = None;
    Ok(meets.map(|meets| Apart { times: times.iter().copied().filter(|&t| t < meets).collect(), meets }))
}
