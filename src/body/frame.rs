//! Box: four corners, four edges, and beams across.

use super::{Body, BodyError, positive};

/// A rectangle of four points from the lower left anticlockwise, with 0, 1 or 2 support beams along its diagonals.
///
/// Valid range: `width` and `height` above 0, `supports` 0 to 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Width [m].
    pub width: f64,
    /// Height [m].
    pub height: f64,
    /// How many diagonals.
    pub supports: u64,
}

impl Frame {
    /// The box, its lower left corner at the origin.
    ///
    /// Errors: a parameter out of its range.
    pub fn make(&self) -> Result<Body, BodyError> {
        positive("width", self.width)?;
        positive("height", self.height)?;
        let beams = match self.supports {
            0 => &[][..],
            1 => &[[0, 2]],
            2 => &[[0, 2], [1, 3]],
            other => return Err(BodyError::new("supports", format!("{other} will not do: give 0, 1 or 2"))),
        };
        let (w, h) = (self.width, self.height);
        let mut bonds = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
        bonds.extend(beams);
        Ok(Body {
            position: vec![[0.0, 0.0, 0.0], [w, 0.0, 0.0], [w, h, 0.0], [0.0, h, 0.0]],
            bonds,
            share: Vec::new(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn supports_are_diagonals() {
        let bonds = |supports| Frame { width: 2.0, height: 1.0, supports }.make().map(|body| body.bonds.len());
        assert_eq!((bonds(0), bonds(1), bonds(2)), (Ok(4), Ok(5), Ok(6)));
        assert_eq!(bonds(3).unwrap_err().key, "supports");
    }
}
