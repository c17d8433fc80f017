//! A lattice: a grid of points that stands on its first row, every cell braced both ways.

use super::grid::{self, Grid};
use super::{Body, BodyError, length};

/// A grid, row by row from below; the first point is the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Points in a row, >= 1.
    pub columns: u64,
    /// Rows, >= 1.
    pub rows: u64,
    /// Distance of neighbours along rows and columns `[m]`.
    pub spacing: f64,
}

impl Lattice {
    /// How many points it makes.
    ///
    /// Errors: counts out of range; a spacing that is not positive.
    pub fn point_count(&self) -> Result<u32, BodyError> {
        length("spacing", self.spacing)?;
        grid::point_count(self.columns, self.rows)
    }

    pub(super) fn make(&self) -> Body {
        Grid {
            columns: self.columns,
            rows: self.rows,
            along: [self.spacing, 0.0, 0.0],
            across: [0.0, self.spacing, 0.0],
            diagonals: [true, true],
            is_covered: true,
        }
        .make()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_run_from_below_and_cells_are_braced_both_ways() {
        let lattice = Lattice { columns: 3, rows: 4, spacing: 0.5 };
        let body = lattice.make();
        assert_eq!(body.positions.len(), 12);
        assert_eq!(body.positions[3], [0.0, 0.5, 0.0]);
        assert_eq!(body.links.len(), 4 * 2 + 3 * 3 + 2 * 2 * 3);
        let last: Vec<_> = body.links[17..19].iter().map(|l| (l.a, l.b)).collect();
        assert_eq!(last, [(0, 4), (1, 3)]);
    }

    #[test]
    fn a_single_row_is_a_chain() {
        let row = Lattice { columns: 4, rows: 1, spacing: 1.0 };
        assert_eq!(row.make().links.len(), 3);
        assert_eq!(row.make().masses(6.0), [1.0, 2.0, 2.0, 1.0]);
    }
}
