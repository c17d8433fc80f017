//! Which bodies of a cluster are supported: they lie on walls, on obstacles, on what its pins hold still, or on others that are supported.
//!
//! What touches others while all of them hang swings with them: nothing brings it to rest there.

use super::cluster::{Cluster, OBSTACLE};
use crate::sim::real::Real;
use crate::sim::sets::Sets;
use crate::sim::vector::{convert, dot, sub};

/// Pins that hold a rigid body.
const ENOUGH: usize = 2;

/// Of each body of a cluster, whether it is supported by what pressed in the last substep, under this gravity `[m/s^2]`.
pub(super) fn supported<S: Real>(cluster: &Cluster<S>, gravity: [f64; 2]) -> Vec<bool> {
    let count = cluster.bodies.len();
    let ground = count as u32;
    let mut sets = Sets::new(count + 1);
    let gravity = convert(gravity);
    (0..ground).filter(|&body| stands(cluster, body, gravity)).for_each(|body| sets.join(body, ground));
    let of = |i: u32| match cluster.body_of[i as usize] {
        OBSTACLE => ground,
        _ if cluster.w[i as usize] == S::ZERO => ground,
        body => body,
    };
    let is_within = |[a, b]: [u32; 2]| cluster.body_of[a as usize] == cluster.body_of[b as usize];
    let pressed = cluster.pairs.iter().filter(|pair| pair.contact.pressed > S::ZERO && !is_within([pair.p, pair.a]));
    for pair in pressed {
        // An edge is as firm as the looser of its ends.
        let [a, b] = [pair.a, pair.b].map(of);
        sets.join(of(pair.p), a.min(b));
    }
    for on in cluster.on_planes.iter().filter(|on| on.contact.pressed > S::ZERO) {
        sets.join(of(on.p), ground);
    }
    let ground = sets.find(ground);
    (0..count as u32).map(|body| sets.find(body) == ground).collect()
}

/// Whether its own pins hold a body against swinging: it is rigid and has two of them, or its middle is above the lowest.
fn stands<S: Real>(cluster: &Cluster<S>, body: u32, gravity: [S; 2]) -> bool {
    let range = cluster.bases[body as usize] as usize..cluster.bases[body as usize + 1] as usize;
    let pins = || range.clone().filter(|&i| cluster.w[i] == S::ZERO);
    let Some(first) = pins().next() else { return false };
    if cluster.is_rigid(body) && pins().nth(ENOUGH - 1).is_some() {
        return true;
    }
    // How far down a point is.
    let depth = |i: usize| dot(sub(cluster.now[i], cluster.now[first]), gravity);
    let lowest = pins().fold(S::ZERO, |most, i| most.max(depth(i)));
    let sum = range.clone().fold(S::ZERO, |sum, i| sum + depth(i));
    sum < lowest * S::from_f64(range.len() as f64)
}
