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

/// The hash that a mark at `time` holds, which lies in the world's next substep: see [`record::hash`]; points that were deleted
/// are left out.
pub fn hash_now(world: &dyn Dynamics, time: f64) -> String {
    let mut sample = world.sample(time);
    let gone = world.gone();
    if !gone.is_empty() {
        let is_left = |index: usize| gone.binary_search_by_key(&index, |point| point.index()).is_err();
        let keep = |list: &mut Vec<[f64; 3]>| {
            let mut index = 0;
            list.retain(|_| {
                index += 1;
                is_left(index - 1)
            });
        };
        keep(&mut sample.position);
        keep(&mut sample.velocity);
    }
    record::hash(std::slice::from_ref(&sample), world.dimensions())
}
