//! What a tolerance can be held to in a scene in which bodies meet: the time until they may.

use anyhow::bail;

use crate::scene::{BudgetKeys, Meeting, Scene, SolverName};
use crate::sim::{Counters, Dynamics, Why};

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
    let meets = meeting(&mut *world, end);
    scene.contact = None;
    Ok(meets.map(|meets| Apart { times: times.iter().copied().filter(|&t| t < meets).collect(), meets }))
}

/// Since when bodies of a world may meet `[s]`; `None`: they do not until `end` `[s]`.
///
/// Who moves what is asked only where that may have changed since it was asked last: to ask goes through all points.
fn meeting(world: &mut dyn Dynamics, end: f64) -> Option<f64> {
    let mut asked = None;
    loop {
        let now = Some(changes(world.counters()));
        if asked != now {
            asked = now;
            let own = world.moved_by();
            let met = own.iter().filter(|moved| moved.why == Why::Contact).map(|moved| moved.since);
            if let Some(since) = met.min_by(f64::total_cmp) {
                return Some(since);
            }
        }
        if world.time() >= end {
            return None;
        }
        world.step();
    }
}

/// How often steps changed who moves what: where islands are handed over, go back, lose a bond or stand still, and nowhere else.
fn changes(counters: &Counters) -> u64 {
    counters.hand_overs + counters.returns + counters.bonds_torn + counters.frozen
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    /// Two discs in free fall, the upper one thrown down or left behind.
    fn world(velocity: f64) -> Box<dyn Dynamics> {
        let disc = |y: f64, v: f64| {
            format!(
                r#"{{"make": "disc", "radius": 0.2, "spacing": 0.1, "origin": [0, {y}], "velocity": [0, {v}],
                    "material": {{"kind": "rigid"}}}}"#
            )
        };
        let text = format!(
            r#"{{"wobble": 1, "gravity": [0, -9.81], "contact": true, "method": {{"budget": {ANY_WORK}}},
                "bodies": [{}, {}]}}"#,
            disc(0.0, 0.0),
            disc(1.4, velocity)
        );
        Scene::parse(&text, "test").unwrap().world(Some(1.0)).unwrap()
    }

    #[test]
    fn bodies_meet_when_asking_after_every_step_says_so() {
        for (velocity, meets) in [(-4.0, true), (4.0, false)] {
            let mut asked = world(velocity);
            let found = meeting(&mut *asked, 0.5);
            let mut every = world(velocity);
            let is_met = |world: &dyn Dynamics| world.moved_by().iter().any(|moved| moved.why == Why::Contact);
            while every.time() < 0.5 && !is_met(&*every) {
                every.step();
            }
            assert_eq!(found.is_some(), meets, "{velocity}");
            assert_eq!((asked.time(), is_met(&*asked)), (every.time(), meets), "{velocity}");
            assert!(meets || changes(every.counters()) == 0, "nothing else asks");
        }
    }
}
