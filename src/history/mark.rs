//! Marks: hashes of states, by which two runs are compared.

use crate::scene::record;
use crate::sim::Dynamics;

/// What a motion came to at a time.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// When, after all commands of that time [s].
    pub at: f64,
    /// Of the bits of all living points' positions and velocities, in order.
    pub hash: String,
}

/// The hash that a mark at `time` holds, which lies in the world's next substep: see [`record::hash`].
pub fn hash_now(world: &dyn Dynamics, time: f64) -> String {
    record::hash(&[world.sample(time)], world.dimensions())
}
