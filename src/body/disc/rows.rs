//! The inside of a disc: points of a triangular lattice, in rows.

/// Distance of two rows `[spacings]`: the height of a triangle with sides of 1.
pub(super) const ROW_HEIGHT: f64 = 0.866_025_403_784_438_6;

/// The points of a triangular lattice with sides of 1 that lie within a circle about one of them.
///
/// Shapes: numbered from 0, row by row from below, each from left to right.
#[derive(Clone, Debug)]
pub(super) struct Rows {
    rows: Vec<Row>,
    /// Row 0 of the lattice, which passes through the centre, in `rows`.
    middle: i64,
}

/// A row: x = column, and half a side more where the row is an odd one.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// The leftmost column.
    left: i64,
    count: u32,
    /// Number of the leftmost point.
    first: u32,
}

/// A point of the lattice by its row, counted from the middle, and its column.
pub(super) type Cell = [i64; 2];

impl Rows {
    /// The points within `reach` >= 0 of the centre `[spacings]`.
    pub(super) fn new(reach: f64) -> Self {
        let middle = (reach / ROW_HEIGHT) as i64;
        let mut first = 0;
        let row = |row: i64| {
            let y = row as f64 * ROW_HEIGHT;
            let half = (reach * reach - y * y).max(0.0).sqrt();
            let left = (-half - shift(row)).ceil() as i64;
            let right = (half - shift(row)).floor() as i64;
            let count = (right - left + 1).max(0) as u32;
            first += count;
            Row { left, count, first: first - count }
        };
        Rows { rows: (-middle..=middle).map(row).collect(), middle }
    }

    /// How many points there are.
    pub(super) fn len(&self) -> u32 {
        self.rows.last().map_or(0, |row| row.first + row.count)
    }

    /// All points, in their order.
    pub(super) fn cells(&self) -> impl Iterator<Item = Cell> + '_ {
        let of = |(k, row): (usize, &Row)| {
            let (j, left) = (k as i64 - self.middle, row.left);
            (0..i64::from(row.count)).map(move |i| [j, left + i])
        };
        self.rows.iter().enumerate().flat_map(of)
    }

    /// The number of a point, if it is within reach.
    pub(super) fn number(&self, [row, column]: Cell) -> Option<u32> {
        let row = self.rows.get(usize::try_from(row + self.middle).ok()?)?;
        let place = u32::try_from(column - row.left).ok()?;
        (place < row.count).then(|| row.first + place)
    }
}

/// Where a point is `[spacings]`.
pub(super) fn position([row, column]: Cell) -> [f64; 2] {
    [column as f64 + shift(row), row as f64 * ROW_HEIGHT]
}

/// The neighbours of a point that come after it: to the right, and to the left and right above.
pub(super) fn later_neighbours([row, column]: Cell) -> [Cell; 3] {
    let left = column - 1 + row.rem_euclid(2);
    [[row, column + 1], [row + 1, left], [row + 1, left + 1]]
}

/// How far a row is shifted to the right `[spacings]`.
fn shift(row: i64) -> f64 {
    0.5 * row.rem_euclid(2) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reach_of_one_is_a_hexagon() {
        let rows = Rows::new(1.0);
        let cells: Vec<Cell> = rows.cells().collect();
        assert_eq!(cells, [[-1, -1], [-1, 0], [0, -1], [0, 0], [0, 1], [1, -1], [1, 0]]);
        assert_eq!((rows.len(), Rows::new(0.99).len(), Rows::new(0.0).len()), (7, 1, 1));
    }

    #[test]
    fn numbers_and_neighbours_fit_the_places() {
        let rows = Rows::new(7.3);
        for (k, cell) in rows.cells().enumerate() {
            assert_eq!(rows.number(cell), Some(k as u32));
            let [x, y] = position(cell);
            assert!(x.hypot(y) <= 7.3 + 1e-12);
            for other in later_neighbours(cell) {
                let [u, v] = position(other);
                assert!(((u - x).hypot(v - y) - 1.0).abs() < 1e-12);
                assert!(rows.number(other).is_none_or(|other| other > k as u32));
            }
        }
        assert_eq!(rows.number([99, 0]), None);
        assert_eq!(rows.number([0, -8]), None);
    }
}
