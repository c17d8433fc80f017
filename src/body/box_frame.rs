//! A box: four corners, four edges, and up to two diagonals that support it.

use super::{Body, BodyError, length};

/// A rectangle about its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxFrame {
    /// Along x `[m]`.
    pub width: f64,
    /// Along y `[m]`.
    pub height: f64,
    /// Diagonals: 0, 1 (from the lower left) or 2.
    pub supports: u64,
}

impl BoxFrame {
    /// How many points it makes: 4.
    ///
    /// Errors: a side that is not positive; more than 2 supports.
    pub fn point_count(&self) -> Result<u32, BodyError> {
        length("width", self.width)?;
        length("height", self.height)?;
        if self.supports > 2 {
            return Err(BodyError::new("supports", format!("is {}: a box has 0, 1 or 2", self.supports)));
        }
        Ok(4)
    }

    pub(super) fn make(&self) -> Body {
        let (x, y) = (0.5 * self.width, 0.5 * self.height);
        let mut body = Body {
            positions: vec![[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]],
            links: Vec::new(),
            weights: vec![1.0; 4],
            ..Body::default()
        };
        for (a, b) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
            body.link(a, b);
        }
        for (a, b) in [(0, 2), (1, 3)].into_iter().take(self.supports as usize) {
            body.link(a, b);
        }
        body.cover([0, 1, 2, 3]);
        body
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn corners_run_anticlockwise_from_the_lower_left() {
        for supports in 0..3 {
            let frame = BoxFrame { width: 3.0, height: 4.0, supports };
            let body = frame.make();
            assert_eq!(body.links.len(), 4 + supports as usize);
            assert_eq!(body.positions[0], [-1.5, -2.0, 0.0]);
            assert_eq!(body.positions[2], [1.5, 2.0, 0.0]);
            assert!(body.positions[1][0] > 0.0 && body.positions[1][1] < 0.0);
            assert!(body.links[4..].iter().all(|l| l.rest_length == 5.0));
        }
    }

    #[test]
    fn a_flat_box_and_a_third_support_are_refused() {
        let frame = BoxFrame { width: 1.0, height: 1.0, supports: 3 };
        assert_eq!(frame.point_count().unwrap_err().to_string(), "supports: is 3: a box has 0, 1 or 2");
        let flat = BoxFrame { height: 0.0, ..frame };
        assert_eq!(flat.point_count().unwrap_err().key, "height");
    }
}
