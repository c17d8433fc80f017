//! Rope: a row of points, each bonded to the next.

use super::{Body, BodyError, counted};

/// `count` points from the origin on, `step` apart.
///
/// Valid range: `count` >= 2, `step` finite and not zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rope {
    /// How many points.
    pub count: u64,
    /// From one point to the next [m].
    pub step: [f64; 3],
}

impl Rope {
    /// The rope; an end carries half the mass of a point between two links.
    ///
    /// Errors: a parameter out of its range.
    pub fn make(&self) -> Result<Body, BodyError> {
        counted("count", self.count, 2)?;
        if self.step == [0.0; 3] || !self.step.iter().all(|c| c.is_finite()) {
            return Err(BodyError::new("spacing", "the points would coincide: give a length above 0"));
        }
        let n = self.count as u32;
        let link = super::distance(self.step, [0.0; 3]);
        let at = |i: u32| self.step.map(|c| c * f64::from(i));
        Ok(Body {
            position: (0..n).map(at).collect(),
            bonds: (1..n).map(|i| [i - 1, i]).collect(),
            share: (0..n).map(|i| if i == 0 || i == n - 1 { 0.5 * link } else { link }).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rope_is_a_row() {
        let body = Rope { count: 4, step: [0.0, -0.5, 0.0] }.make().unwrap();
        assert_eq!(body.position[3], [0.0, -1.5, 0.0]);
        assert_eq!(body.bonds, [[0, 1], [1, 2], [2, 3]]);
        assert_eq!(body.share, [0.25, 0.5, 0.5, 0.25]);
        assert!(Rope { count: 1, step: [1.0, 0.0, 0.0] }.make().is_err());
        assert!(Rope { count: 3, step: [0.0; 3] }.make().is_err());
    }
}
