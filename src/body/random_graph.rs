//! Random points with random bonds: a simple graph, every one equally likely.

use std::collections::HashSet;

use super::draw::Draw;
use super::points::{check_corners, scatter};
use super::{Body, BodyError, MAX_BONDS, count};

/// Points uniform in a box, and bonds between distinct pairs of them, at rest as drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RandomGraph {
    /// How many points, >= 1.
    pub count: u64,
    /// How many bonds: at most count (count - 1)/2, for no pair is bonded twice.
    pub bonds: u64,
    /// Lower corner `[m]`.
    pub min: [f64; 3],
    /// Upper corner `[m]`, on no axis below `min`.
    pub max: [f64; 3],
    /// Seed of the draws.
    pub seed: u64,
}

impl RandomGraph {
    /// How many points it makes.
    ///
    /// Errors: those of [`super::Points::point_count`]; more bonds than there are pairs.
    pub fn point_count(&self) -> Result<u32, BodyError> {
        check_corners(self.min, self.max)?;
        let points = count("count", self.count, 1)?;
        let most = pair_count(self.count);
        if self.bonds > most.min(MAX_BONDS) {
            return Err(BodyError::new(
                "bonds",
                format!("is {}: {} points can have {} bonds at most", self.bonds, self.count, most.min(MAX_BONDS)),
            ));
        }
        Ok(points)
    }

    pub(super) fn make(&self) -> Body {
        let mut draw = Draw::new(self.seed);
        let mut body = scatter(&mut draw, self.count, self.min, self.max);
        for index in sample(&mut draw, pair_count(self.count), self.bonds) {
            let (a, b) = pair(index);
            body.link(a, b);
        }
        body
    }
}

/// Pairs among `count` points.
fn pair_count(count: u64) -> u64 {
    count * (count - 1) / 2
}

/// `take` distinct numbers below `bound`, every set equally likely, in the order drawn.
///
/// Source: R. W. Floyd in J. Bentley, "Programming Pearls: A sample of brilliance", CACM 30 (1987): one draw a number,
/// whatever share of the range is taken.
fn sample(draw: &mut Draw, bound: u64, take: u64) -> Vec<u64> {
    let mut taken = HashSet::new();
    let mut drawn = Vec::new();
    for last in bound - take..bound {
        let index = draw.below(last + 1);
        let index = if taken.insert(index) { index } else { last };
        taken.insert(index);
        drawn.push(index);
    }
    drawn
}

/// Pair number `index`, counted (0,1), (0,2), (1,2), (0,3), …: a < b.
fn pair(index: u64) -> (u32, u32) {
    // The root may be one off where 8 index passes 2^53; the loops settle it exactly.
    let mut b = ((((8 * index + 1) as f64).sqrt() + 1.0) / 2.0) as u64;
    while b * (b - 1) / 2 > index {
        b -= 1;
    }
    while (b + 1) * b / 2 <= index {
        b += 1;
    }
    ((index - b * (b - 1) / 2) as u32, b as u32)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::body::distance;

    fn graph(count: u64, bonds: u64, seed: u64) -> RandomGraph {
        RandomGraph { count, bonds, min: [-1.0, -1.0, 0.0], max: [1.0, 1.0, 0.0], seed }
    }

    #[test]
    fn bonds_join_distinct_pairs_at_their_distance() {
        let body = graph(10, 30, 1).make();
        assert_eq!((body.positions.len(), body.links.len()), (10, 30));
        let mut pairs: Vec<_> = body.links.iter().map(|l| (l.a, l.b)).collect();
        assert!(pairs.iter().all(|&(a, b)| a < b && b < 10));
        pairs.sort_unstable();
        pairs.dedup();
        assert_eq!(pairs.len(), 30);
        for l in &body.links {
            let d = distance(body.positions[l.a as usize], body.positions[l.b as usize]);
            assert_eq!(l.rest_length, d);
        }
    }

    #[test]
    fn the_complete_graph_is_reached_and_no_more() {
        assert_eq!(graph(10, 45, 3).make().links.len(), 45);
        let error = graph(10, 46, 3).point_count().unwrap_err().to_string();
        assert_eq!(error, "bonds: is 46: 10 points can have 45 bonds at most");
        assert!(graph(1, 0, 0).make().links.is_empty());
    }

    #[test]
    fn every_pair_is_drawn_about_equally_often() {
        let mut hits = [0_u32; 45];
        for seed in 0..3000 {
            for l in graph(10, 15, seed).make().links {
                hits[(l.b * (l.b - 1) / 2 + l.a) as usize] += 1;
            }
        }
        // Each pair is in a third of the graphs: 1000 with a deviation of 26.
        assert!(hits.iter().all(|&n| (870..1130).contains(&n)), "hits {hits:?}");
    }

    #[test]
    fn pair_numbers_are_exact_at_the_largest_count() {
        let n = crate::body::MAX_POINTS;
        assert_eq!(pair(pair_count(n) - 1), (n as u32 - 2, n as u32 - 1));
        assert_eq!(pair(0), (0, 1));
        assert_eq!(pair(pair_count(n - 1)), (0, n as u32 - 1));
    }
}
