//! Loose points, drawn at random from a box.

use super::draw::Draw;
use super::{Body, BodyError, count};

/// Loose points, uniform in the box from `min` to `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Points {
    /// How many, >= 1.
    pub count: u64,
    /// Lower corner `[m]`.
    pub min: [f64; 3],
    /// Upper corner `[m]`, on no axis below `min`.
    pub max: [f64; 3],
    /// Seed of the draws.
    pub seed: u64,
}

impl Points {
    /// How many points it makes.
    ///
    /// Errors: a count out of range; a corner that is not finite, or `max` below `min`.
    pub fn point_count(&self) -> Result<u32, BodyError> {
        check_corners(self.min, self.max)?;
        count("count", self.count, 1)
    }

    pub(super) fn make(&self) -> Body {
        scatter(&mut Draw::new(self.seed), self.count, self.min, self.max)
    }
}

/// Points in a box, in the order drawn.
pub(super) fn scatter(draw: &mut Draw, count: u64, min: [f64; 3], max: [f64; 3]) -> Body {
    let positions: Vec<_> = (0..count).map(|_| draw.point(min, max)).collect();
    Body { weights: vec![1.0; positions.len()], positions, ..Body::default() }
}

/// Corners that a box can be drawn between.
pub(super) fn check_corners(min: [f64; 3], max: [f64; 3]) -> Result<(), BodyError> {
    for (key, corner) in [("min", min), ("max", max)] {
        if !corner.iter().all(|x| x.is_finite()) {
            return Err(BodyError::new(key, "is not finite: give ordinary numbers"));
        }
    }
    match (0..3).find(|&k| min[k] > max[k]) {
        None => Ok(()),
        Some(k) => {
            Err(BodyError::new("min", format!("{:?} on axis {k} is above max, {:?}: swap them", min[k], max[k])))
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    fn ten() -> Points {
        Points { count: 10, min: [-1.0, -2.0, 0.0], max: [1.0, 3.0, 0.0], seed: 5 }
    }

    #[test]
    fn points_lie_in_their_box_and_follow_the_seed() {
        let body = ten().make();
        assert_eq!(body.positions.len(), 10);
        assert!(body.links.is_empty());
        for p in &body.positions {
            assert!((-1.0..1.0).contains(&p[0]) && (-2.0..3.0).contains(&p[1]) && p[2] == 0.0);
        }
        assert_eq!(body, ten().make());
        assert_ne!(body, Points { seed: 6, ..ten() }.make());
    }

    #[test]
    fn an_inverted_box_or_no_points_are_refused() {
        let wrong = Points { min: [0.0, 4.0, 0.0], ..ten() };
        let error = wrong.point_count().unwrap_err().to_string();
        assert_eq!(error, "min: 4.0 on axis 1 is above max, 3.0: swap them");
        let none = Points { count: 0, ..ten() };
        assert_eq!(none.point_count().unwrap_err().key, "count");
        let many = Points { count: u64::MAX, ..ten() };
        assert_eq!(many.point_count().unwrap_err().key, "count");
    }
}
