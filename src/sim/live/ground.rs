//! Which bodies of a cluster lie on the ground: on walls, obstacles and pinned points, or on bodies that do.
//!
//! What touches others and all of which hangs swings with them: it does not come to rest where it touches something.

use super::cluster::{Cluster, OBSTACLE};
use crate::sim::real::Real;
use crate::sim::sets::Sets;

/// Of each body of a cluster, whether it lies on the ground by what pressed in the last substep.
pub(super) fn grounded<S: Real>(cluster: &Cluster<S>) -> Vec<bool> {
    let count = cluster.bodies.len();
    let ground = count as u32;
    let mut sets = Sets::new(count + 1);
    let body = |i: u32| match cluster.body_of[i as usize] {
        OBSTACLE => ground,
        _ if cluster.w[i as usize] == S::ZERO => ground,
        body => body,
    };
    for pair in cluster.pairs.iter().filter(|pair| pair.contact.pressed > S::ZERO) {
        let [a, b] = [pair.a, pair.b].map(body);
        // An edge is as firm as the looser of its ends.
        sets.join(body(pair.p), a.min(b));
    }
    for on in cluster.on_planes.iter().filter(|on| on.contact.pressed > S::ZERO) {
        sets.join(body(on.p), ground);
    }
    let ground = sets.find(ground);
    (0..count as u32).map(|body| sets.find(body) == ground).collect()
}
