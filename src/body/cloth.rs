//! A cloth: a grid of points that hangs down from its first row.

use super::grid::{self, Grid};
use super::{Body, BodyError, length};
use crate::sim::vector;

/// A grid, row by row from the top; the first point is the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cloth {
    /// Points in a row, >= 1.
    pub columns: u64,
    /// Rows, >= 1.
    pub rows: u64,
    /// Distance of neighbours along rows and columns `[m]`.
    pub spacing: f64,
    /// Bonds across each cell.
    pub diagonals: Diagonals,
    /// Whether its cells are covered by triangles, two each: in space, where it is a surface.
    pub is_covered: bool,
    /// Direction of the rows, of any length above 0.
    pub u: [f64; 3],
    /// Direction from row to row, of any length above 0.
    pub v: [f64; 3],
}

/// Bonds across each cell of a cloth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Diagonals {
    /// None.
    None,
    /// From each point to the one after it in the next row.
    One,
    /// Both.
    #[default]
    Both,
}

impl Cloth {
    /// Direction of the rows where none is given: along x.
    pub const U: [f64; 3] = [1.0, 0.0, 0.0];
    /// Direction from row to row where none is given: down.
    pub const V: [f64; 3] = [0.0, -1.0, 0.0];

    /// How many points it makes.
    ///
    /// Errors: counts out of range; a spacing that is not positive; directions that are not finite, zero or parallel.
    pub fn point_count(&self) -> Result<u32, BodyError> {
        length("spacing", self.spacing)?;
        let u = direction("u", self.u)?;
        let v = direction("v", self.v)?;
        // 1e-6: the sine of the smallest angle between two directions that still spans a surface.
        if vector::length(vector::cross3(u, v)) < 1e-6 {
            return Err(BodyError::new("v", "is parallel to u: give another direction"));
        }
        grid::point_count(self.columns, self.rows)
    }

    pub(super) fn make(&self) -> Body {
        let step = |axis| vector::scale(unit(axis), self.spacing);
        Grid {
            columns: self.columns,
            rows: self.rows,
            along: step(self.u),
            across: step(self.v),
            diagonals: match self.diagonals {
                Diagonals::None => [false, false],
                Diagonals::One => [true, false],
                Diagonals::Both => [true, true],
            },
            is_covered: self.is_covered,
        }
        .make()
    }
}

fn direction(key: &'static str, axis: [f64; 3]) -> Result<[f64; 3], BodyError> {
    let unit = unit(axis);
    if unit.iter().all(|x| x.is_finite()) {
        Ok(unit)
    } else {
        Err(BodyError::new(key, "is no direction: give finite numbers, not all 0"))
    }
}

/// The vector at length 1; not finite where there is no direction. Scaled first, so that no square overflows.
fn unit(axis: [f64; 3]) -> [f64; 3] {
    let largest = axis.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let scaled = axis.map(|x| x / largest);
    let length = vector::length(scaled);
    scaled.map(|x| x / length)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    fn cloth() -> Cloth {
        let (diagonals, is_covered) = (Diagonals::None, false);
        Cloth { columns: 11, rows: 11, spacing: 2.0, diagonals, is_covered, u: Cloth::U, v: Cloth::V }
    }

    #[test]
    fn the_first_row_is_at_the_top() {
        let body = cloth().make();
        assert_eq!(body.positions[0], [0.0, 0.0, 0.0]);
        assert_eq!(body.positions[10], [20.0, 0.0, 0.0]);
        assert_eq!(body.positions[11], [0.0, -2.0, 0.0]);
        assert!(body.links.iter().all(|l| l.rest_length == 2.0));
    }

    #[test]
    fn diagonals_are_none_one_or_both() {
        for (diagonals, bonds) in [(Diagonals::None, 220), (Diagonals::One, 320), (Diagonals::Both, 420)] {
            let body = Cloth { diagonals, ..cloth() }.make();
            assert_eq!((body.positions.len(), body.links.len()), (121, bonds));
        }
    }

    #[test]
    fn in_space_the_axes_give_the_directions() {
        let body = Cloth { u: [0.0, 0.0, 5.0], v: [3.0, 4.0, 0.0], ..cloth() }.make();
        assert_eq!(body.positions[1], [0.0, 0.0, 2.0]);
        let below = body.positions[11];
        assert!((below[0] - 1.2).abs() < 1e-15 && (below[1] - 1.6).abs() < 1e-15);
    }

    #[test]
    fn mass_is_shared_by_area() {
        let body = Cloth { columns: 3, rows: 2, ..cloth() }.make();
        assert_eq!(body.masses(8.0), [1.0, 2.0, 1.0, 1.0, 2.0, 1.0]);
    }

    #[test]
    fn parallel_axes_and_huge_grids_are_refused() {
        let flat = Cloth { v: [-2.0, 0.0, 0.0], ..cloth() };
        assert_eq!(flat.point_count().unwrap_err().to_string(), "v: is parallel to u: give another direction");
        let none = Cloth { u: [0.0; 3], ..cloth() };
        assert_eq!(none.point_count().unwrap_err().key, "u");
        let huge = Cloth { columns: 10_000, rows: 10_000, ..cloth() };
        assert_eq!(huge.point_count().unwrap_err().key, "rows");
        let no_rows = Cloth { rows: 0, ..cloth() };
        assert_eq!(no_rows.point_count().unwrap_err().key, "rows");
    }
}
