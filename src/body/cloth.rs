//! Cloth: a grid of points, row by row, the first row at the top.

use super::{Body, BodyError, counted, positive};

/// Which diagonals the cells of a cloth have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Diagonals {
    /// None: rows and columns only.
    None,
    /// One a cell, from its upper left to its lower right point.
    One,
    /// Both.
    #[default]
    Both,
}

/// A grid of `columns` x `rows` points, `spacing` apart along `u` (a row) and `v` (from row to row).
///
/// Valid range: at least one point each way and two in all; `u` and `v` unit vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cloth {
    /// Points in a row.
    pub columns: u64,
    /// Points in a column.
    pub rows: u64,
    /// Distance between neighbours [m].
    pub spacing: f64,
    /// Which diagonals there are.
    pub diagonals: Diagonals,
    /// Unit vector along a row.
    pub u: [f64; 3],
    /// Unit vector from row to row.
    pub v: [f64; 3],
}

impl Cloth {
    /// The cloth, its first point at the origin; bonds cell by cell: to the right, below, then the diagonals.
    ///
    /// Errors: a parameter out of its range.
    pub fn make(&self) -> Result<Body, BodyError> {
        positive("spacing", self.spacing)?;
        counted("columns", self.columns, 1)?;
        counted("rows", self.rows, 1)?;
        counted("rows", self.columns.saturating_mul(self.rows), 2)?;
        let (columns, rows) = (self.columns as u32, self.rows as u32);
        let mut body = Body::default();
        for i in 0..rows {
            for j in 0..columns {
                let (a, b) = (self.spacing * f64::from(j), self.spacing * f64::from(i));
                body.position.push(std::array::from_fn(|k| self.u[k] * a + self.v[k] * b));
                body.share.push(edge_share(i, rows) * edge_share(j, columns));
                let point = i * columns + j;
                let (right, below) = (j + 1 < columns, i + 1 < rows);
                if right {
                    body.bonds.push([point, point + 1]);
                }
                if below {
                    body.bonds.push([point, point + columns]);
                }
                if right && below && self.diagonals != Diagonals::None {
                    body.bonds.push([point, point + columns + 1]);
                }
                if right && below && self.diagonals == Diagonals::Both {
                    body.bonds.push([point + 1, point + columns]);
                }
            }
        }
        Ok(body)
    }
}

/// A point at the edge stands for half the stretch of one inside; a row of one has no edge.
fn edge_share(index: u32, count: u32) -> f64 {
    if count > 1 && (index == 0 || index == count - 1) { 0.5 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cloth(columns: u64, rows: u64, diagonals: Diagonals) -> Body {
        let (u, v) = ([1.0, 0.0, 0.0], [0.0, -1.0, 0.0]);
        Cloth { columns, rows, spacing: 0.5, diagonals, u, v }.make().unwrap()
    }

    #[test]
    fn rows_run_from_the_top_down() {
        let body = cloth(3, 2, Diagonals::Both);
        assert_eq!(body.position[2], [1.0, 0.0, 0.0]);
        assert_eq!(body.position[5], [1.0, -0.5, 0.0]);
        assert_eq!(body.share, [0.25, 0.5, 0.25, 0.25, 0.5, 0.25]);
    }

    #[test]
    fn bonds_are_counted() {
        for (diagonals, count) in [(Diagonals::None, 220), (Diagonals::One, 320), (Diagonals::Both, 420)] {
            assert_eq!(cloth(11, 11, diagonals).bonds.len(), count);
        }
        assert_eq!(cloth(5, 1, Diagonals::Both).bonds.len(), 4);
    }
}
