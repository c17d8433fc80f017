//! Points drawn at random, with or without random bonds: the same for the same seed, on every machine.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use super::{Body, BodyError, counted};

/// `count` points, uniform in a box.
///
/// Valid range: `count` >= 1, `min` <= `max` on every axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatteredPoints {
    /// How many points.
    pub count: u64,
    /// Lower corner [m].
    pub min: [f64; 3],
    /// Upper corner [m].
    pub max: [f64; 3],
    /// Seed.
    pub seed: u64,
}

/// Scattered points and `bonds` different pairs of them, every simple graph as likely as every other.
///
/// Valid range: as [`ScatteredPoints`]; `bonds` <= `count` (`count` - 1) / 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RandomGraph {
    /// The points.
    pub points: ScatteredPoints,
    /// How many bonds.
    pub bonds: u64,
}

impl ScatteredPoints {
    /// The points.
    ///
    /// Errors: a parameter out of its range.
    pub fn make(&self) -> Result<Body, BodyError> {
        Ok(Body { position: self.draw(&mut self.generator())?, ..Body::default() })
    }

    fn generator(&self) -> Pcg32 {
        Pcg32::seed_from_u64(self.seed)
    }

    fn draw(&self, generator: &mut Pcg32) -> Result<Vec<[f64; 3]>, BodyError> {
        counted("count", self.count, 1)?;
        if (0..3).any(|k| self.min[k] > self.max[k]) {
            return Err(BodyError::new("min", "lies above max: give the lower corner first"));
        }
        let mut within = |k: usize| self.min[k] + (self.max[k] - self.min[k]) * uniform(generator);
        let flat = self.min[2] == self.max[2];
        let point = |_| [within(0), within(1), if flat { self.min[2] } else { within(2) }];
        Ok((0..self.count).map(point).collect())
    }
}

/// Uniform in [0, 1): 53 random bits, by our own arithmetic so that a library's change of mind changes no scene.
fn uniform(generator: &mut Pcg32) -> f64 {
    (generator.random::<u64>() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}

impl RandomGraph {
    /// The points, then the bonds.
    ///
    /// Errors: a parameter out of its range.
    pub fn make(&self) -> Result<Body, BodyError> {
        let mut generator = self.points.generator();
        let position = self.points.draw(&mut generator)?;
        let n = position.len() as u64;
        let most = n * (n - 1) / 2;
        if self.bonds > most {
            let problem = format!("{n} points have only {most} pairs, not {}: give fewer", self.bonds);
            return Err(BodyError::new("bonds", problem));
        }
        counted("bonds", self.bonds, 0)?;
        // Floyd's sampling: `bonds` different numbers of `most`, in a set that keeps no order of its own.
        let mut chosen = std::collections::BTreeSet::new();
        for last in most - self.bonds..most {
            let draw = ((uniform(&mut generator) * (last + 1) as f64) as u64).min(last);
            if !chosen.insert(draw) {
                chosen.insert(last);
            }
        }
        Ok(Body { position, bonds: chosen.into_iter().map(pair).collect(), share: Vec::new() })
    }
}

/// The pair (a < b) of number `index` in the order (0,1), (0,2), (1,2), (0,3), …
fn pair(index: u64) -> [u32; 2] {
    let mut b = ((((8 * index + 1) as f64).sqrt() + 1.0) / 2.0) as u64;
    // The square root may be off by one at the corners of large numbers.
    while b * (b - 1) / 2 > index {
        b -= 1;
    }
    while (b + 1) * b / 2 <= index {
        b += 1;
    }
    [(index - b * (b - 1) / 2) as u32, b as u32]
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: ScatteredPoints =
        ScatteredPoints { count: 10, min: [-1.0, -1.0, 0.0], max: [1.0, 1.0, 0.0], seed: 7 };

    #[test]
    fn points_lie_in_their_box_and_repeat_with_the_seed() {
        let body = POINTS.make().unwrap();
        assert_eq!(body, POINTS.make().unwrap());
        assert_ne!(body, ScatteredPoints { seed: 8, ..POINTS }.make().unwrap());
        assert!(body.position.iter().all(|x| x[0].abs() <= 1.0 && x[1].abs() <= 1.0 && x[2] == 0.0));
    }

    #[test]
    fn bonds_are_different_pairs() {
        let body = RandomGraph { points: POINTS, bonds: 30 }.make().unwrap();
        let mut pairs = body.bonds.clone();
        pairs.dedup();
        assert_eq!(pairs.len(), 30);
        assert!(body.bonds.iter().all(|[a, b]| a < b && *b < 10));
        assert_eq!(RandomGraph { points: POINTS, bonds: 45 }.make().unwrap().bonds.len(), 45);
        assert_eq!(RandomGraph { points: POINTS, bonds: 46 }.make().unwrap_err().key, "bonds");
    }

    #[test]
    fn pairs_are_numbered_without_gaps() {
        let all: Vec<[u32; 2]> = (0..6).map(pair).collect();
        assert_eq!(all, [[0, 1], [0, 2], [1, 2], [0, 3], [1, 3], [2, 3]]);
        assert_eq!(pair(199_999_990_000_000 - 1), [19_999_998, 19_999_999]);
    }
}
