//! Marks: hashes of states, by which two runs are compared.

use crate::scene::record;
use crate::sim::{Dynamics, PointId};

/// What a motion came to at a time.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// When, after all commands of that time `[s]`.
    pub at: f64,
    /// Of the bits of all living points' positions and velocities, in order.
    pub hash: String,
}

/// The hash that a mark at `time` holds, which lies in the world's next substep: see [`record::hash`].
pub fn hash_now(world: &dyn Dynamics, time: f64) -> String {
    record::hash(&[world.sample(time)], world.dimensions())
}

/// Where two states of a world differ most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// The lowest point of the island, that is of all that bonds hold together.
    pub island: PointId,
    /// How far its points are apart at most `[m]`, infinite where one of them is gone.
    pub apart: f64,
}

/// Where two states differ most, by the islands of `world`; `None`: all points are at the same places.
pub fn difference(world: &dyn Dynamics, other: &dyn Dynamics) -> Option<Difference> {
    let at = |world: &dyn Dynamics| world.sample(world.time()).position;
    let (here, there) = (at(world), at(other));
    let apart = |point: usize| match (here.get(point), there.get(point)) {
        // A point that is gone has no place.
        (Some(a), Some(b)) if a[0].is_nan() && b[0].is_nan() => 0.0,
        (Some(a), Some(b)) => {
            let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
            if square.is_finite() { square.sqrt() } else { f64::INFINITY }
        }
        _ => f64::INFINITY,
    };
    let all = (0..here.len().max(there.len())).map(|point| (point, apart(point)));
    let (point, apart) = all.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, apart)| *apart > 0.0)?;
    Some(Difference { island: PointId(lowest(world, point)), apart })
}

/// The lowest point that bonds hold together with a point.
fn lowest(world: &dyn Dynamics, point: usize) -> u32 {
    let ends = world.bonds().ends();
    let mut lowest: Vec<u32> =
        (0..=ends.iter().flatten().map(|end| end.index()).fold(point, usize::max) as u32).collect();
    let mut is_done = false;
    while !is_done {
        is_done = true;
        for [a, b] in ends {
            let least = lowest[a.index()].min(lowest[b.index()]);
            is_done &= lowest[a.index()] == least && lowest[b.index()] == least;
            (lowest[a.index()], lowest[b.index()]) = (least, least);
        }
    }
    lowest[point]
}
