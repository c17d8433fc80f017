//! Whether sweeps in one order, substep after substep, feed no energy in.
//!
//! A sweep over rigid bonds is a product of projections. It has real eigenvalues mu in [0, 1] where its bonds are of two
//! colours, or are swept forth and back; others may be complex, and Verlet's method, which multiplies by z with
//! z^2 - 2 mu z + mu = 0, can then grow. Whether it does depends on the angles between bonds: so it is tried.

use crate::sim::vector::{add, dot, length, scale, sub};

/// Substeps that are tried.
const TRIALS: u32 = 1_024;
/// What a motion may grow by in all of them: bonds that are steady pass motions on, but not without end.
const MOST_GROWTH: f64 = 2.0;

/// Whether small motions of points that start at rest stay small when the bonds `ends` are swept in this order.
///
/// Shapes: `x` `[m]` and `w` `[1/kg]` have one entry a point.
pub(crate) fn is_steady<const D: usize>(x: &[[f64; D]], w: &[f64], ends: &[[u32; 2]]) -> bool {
    let unit = |[a, b]: [usize; 2]| {
        let way = sub(x[a], x[b]);
        let size = length(way);
        scale(way, if size > 0.0 { 1.0 / size } else { 0.0 })
    };
    let ends = ends.iter().map(|pair| pair.map(|end| end as usize)).filter(|&[a, b]| w[a] + w[b] > 0.0);
    let bonds: Vec<([usize; 2], [f64; D])> = ends.map(|pair| (pair, unit(pair))).collect();
    let start = |i: usize| std::array::from_fn(|k| if w[i] > 0.0 { wave(i * D + k) } else { 0.0 });
    let mut now: Vec<[f64; D]> = (0..x.len()).map(start).collect();
    let mut before = now.clone();
    let size = |u: &[[f64; D]]| u.iter().zip(w).filter(|(_, w)| **w > 0.0).map(|(u, w)| dot(*u, *u) / w).sum::<f64>();
    let first = size(&now);
    for _ in 0..TRIALS {
        for (before, now) in before.iter_mut().zip(&mut now) {
            let next = sub(scale(*now, 2.0), *before);
            (*before, *now) = (*now, next);
        }
        for &([a, b], way) in &bonds {
            let push = dot(way, sub(now[a], now[b])) / (w[a] + w[b]);
            now[a] = sub(now[a], scale(way, w[a] * push));
            now[b] = add(now[b], scale(way, w[b] * push));
        }
    }
    size(&now) <= MOST_GROWTH * MOST_GROWTH * first
}

/// Numbers in (-1, 1) without an order that a body could have.
fn wave(i: usize) -> f64 {
    libm::sin((i * i) as f64 * 0.7 + i as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hub with so many spokes, listed in turn.
    fn hub(spokes: u32) -> (Vec<[f64; 2]>, Vec<[u32; 2]>) {
        let place = |i: u32| {
            let angle = f64::from(i) / f64::from(spokes) * std::f64::consts::TAU;
            [libm::cos(angle), libm::sin(angle)]
        };
        let x = std::iter::once([0.0; 2]).chain((0..spokes).map(place)).collect();
        (x, (1..=spokes).map(|i| [0, i]).collect())
    }

    #[test]
    fn a_hub_of_many_spokes_is_not_steady_one_way_and_is_forth_and_back() {
        let (x, mut ends) = hub(10);
        let w = vec![1.0; x.len()];
        assert!(!is_steady(&x, &w, &ends));
        ends.extend_from_within(..9);
        ends[10..].reverse();
        assert!(is_steady(&x, &w, &ends));
    }

    #[test]
    fn few_spokes_are_steady() {
        let (x, ends) = hub(4);
        assert!(is_steady(&x, &[0.0, 1.0, 1.0, 1.0, 1.0], &ends), "pinned in the middle");
        assert!(is_steady(&x, &[1.0; 5], &ends));
    }
}
