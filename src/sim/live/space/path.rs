//! Rigid bonds that make one open path, in space: solved together as in the plane, along the directions that they have after the
//! prediction.

use super::cluster::Cluster;
use crate::sim::live::body::Link;
use crate::sim::real::Real;
use crate::sim::vector::{dot, scale, sub};

/// Rounds of it.
const ROUNDS: u32 = 2;

/// How many bonds at the front of `links` make a path: each begins where the one before ends.
pub(super) fn length<S: Real>(links: &[Link<S>]) -> usize {
    let is_next =
        |pair: &&[Link<S>]| pair[0].b == pair[1].a && pair[1].stiffness == S::INFINITY && pair[1].relaxed.is_none();
    1 + links.windows(2).take_while(is_next).count()
}

/// Solves the path at the front of `links`, rest lengths times `stretched` `[1]`.
pub(super) fn solve<S: Real>(state: &mut Cluster<S>, links: &[Link<S>], (base, stretched): (usize, S)) {
    let count = length(links);
    let links = &links[..count];
    let mut normal = vec![[S::ZERO; 3]; count];
    // The diagonal as it is eliminated, what stands above it over that, and the right side.
    let mut above = vec![S::ZERO; count];
    let mut value = vec![S::ZERO; count];
    for _ in 0..ROUNDS {
        let mut last = S::ZERO;
        for (k, link) in links.iter().enumerate() {
            let (a, b) = (base + link.a as usize, base + link.b as usize);
            let d = sub(state.now[a], state.now[b]);
            let length = dot(d, d).sqrt();
            normal[k] = if length > S::ZERO { scale(d, S::ONE / length) } else { [S::ONE, S::ZERO, S::ZERO] };
            let (w_a, w_b) = (state.w[a], state.w[b]);
            // The row: w_a (n_k . l_k - n_(k-1) . l_(k-1)) ... = length - rest, neighbours with -w n_k . n_(k-1).
            let side = if k > 0 { -w_a * dot(normal[k], normal[k - 1]) } else { S::ZERO };
            let own = w_a + w_b - side * last;
            let error = length - link.rest * stretched - if k > 0 { side * value[k - 1] } else { S::ZERO };
            let next = match links.get(k + 1) {
                Some(link) => {
                    let (a, b) = (base + link.a as usize, base + link.b as usize);
                    let d = sub(state.now[a], state.now[b]);
                    let length = dot(d, d).sqrt();
                    let ahead = if length > S::ZERO { scale(d, S::ONE / length) } else { [S::ONE, S::ZERO, S::ZERO] };
                    -w_b * dot(normal[k], ahead)
                }
                None => S::ZERO,
            };
            let inverse = if own > S::ZERO { S::ONE / own } else { S::ZERO };
            last = next * inverse;
            above[k] = last;
            value[k] = error * inverse;
        }
        for k in (0..count.saturating_sub(1)).rev() {
            value[k] = value[k] - above[k] * value[k + 1];
        }
        for (k, link) in links.iter().enumerate() {
            let (a, b) = (base + link.a as usize, base + link.b as usize);
            let pull = scale(normal[k], value[k]);
            state.turn([a, b], pull);
            state.shift(a, scale(pull, -state.w[a]));
            state.shift(b, scale(pull, state.w[b]));
        }
    }
    state.counts.bonds += u64::from(ROUNDS) * count as u64;
    state.counts.work += 60 * u64::from(ROUNDS) * count as u64;
}
