//! Lattice: a block of square cells, braced both ways, row by row from below.

use super::{Body, BodyError, Cloth, Diagonals};

/// A grid of `columns` x `rows` points with both diagonals in every cell.
///
/// Valid range: as [`Cloth`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Points in a row.
    pub columns: u64,
    /// Points in a column.
    pub rows: u64,
    /// Distance between neighbours [m].
    pub spacing: f64,
}

impl Lattice {
    /// The lattice, its lower left point at the origin.
    ///
    /// Errors: a parameter out of its range.
    pub fn make(&self) -> Result<Body, BodyError> {
        let (u, v) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        Cloth { columns: self.columns, rows: self.rows, spacing: self.spacing, diagonals: Diagonals::Both, u, v }.make()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lattice_stands_on_its_first_row() {
        let body = Lattice { columns: 2, rows: 3, spacing: 1.0 }.make().unwrap();
        assert_eq!(body.position[0], [0.0, 0.0, 0.0]);
        assert_eq!(body.position[5], [1.0, 2.0, 0.0]);
        assert_eq!(body.bonds.len(), 3 + 4 + 4);
    }
}
