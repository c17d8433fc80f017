//! What cloth and lattice share: points in rows and columns, and the bonds between neighbours.

use super::{Body, BodyError, MAX_POINTS, count};

/// A grid of points on two axes from the first point.
pub(super) struct Grid {
    /// Points in a row, >= 1.
    pub(super) columns: u64,
    /// Rows, >= 1.
    pub(super) rows: u64,
    /// From a point to the next of its row `[m]`.
    pub(super) along: [f64; 3],
    /// From a point to the one of the next row `[m]`.
    pub(super) across: [f64; 3],
    /// Whether each cell has the diagonal from its first point, and the other one.
    pub(super) diagonals: [bool; 2],
    /// Whether cells are covered; in the plane `across` is then to the left of `along`.
    pub(super) is_covered: bool,
}

/// How many points a grid has.
///
/// Errors: no columns or rows; more points in all than [`MAX_POINTS`].
pub(super) fn point_count(columns: u64, rows: u64) -> Result<u32, BodyError> {
    count("columns", columns, 1)?;
    count("rows", rows, 1)?;
    let points = columns.saturating_mul(rows);
    if points > MAX_POINTS {
        return Err(BodyError::new(
            "rows",
            format!("{rows} times {columns} columns make {points} points: {MAX_POINTS} is the most"),
        ));
    }
    Ok(points as u32)
}

impl Grid {
    /// Points row by row; bonds along the rows, then across them, then the diagonals cell by cell.
    pub(super) fn make(&self) -> Body {
        let (columns, rows) = (self.columns as u32, self.rows as u32);
        let mut body = Body::default();
        for row in 0..rows {
            for column in 0..columns {
                let (c, r) = (f64::from(column), f64::from(row));
                let position = |k| self.along[k] * c + self.across[k] * r;
                body.positions.push(std::array::from_fn(position));
                body.weights.push(edge(column, columns) * edge(row, rows));
            }
        }
        let at = |column: u32, row: u32| row * columns + column;
        for row in 0..rows {
            for column in 1..columns {
                body.link(at(column - 1, row), at(column, row));
            }
        }
        for row in 1..rows {
            for column in 0..columns {
                body.link(at(column, row - 1), at(column, row));
            }
        }
        for row in 1..rows {
            for column in 1..columns {
                if self.diagonals[0] {
                    body.link(at(column - 1, row - 1), at(column, row));
                }
                if self.diagonals[1] {
                    body.link(at(column, row - 1), at(column - 1, row));
                }
                if self.is_covered {
                    body.cover([at(column - 1, row - 1), at(column, row - 1), at(column, row), at(column - 1, row)]);
                }
            }
        }
        body
    }
}

/// Share of a point along one axis: half at an end, for half of its neighbourhood is missing.
fn edge(index: u32, count: u32) -> f64 {
    if count > 1 && (index == 0 || index + 1 == count) { 0.5 } else { 1.0 }
}
