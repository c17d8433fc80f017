//! The inside of the mesh: a hexagonal lattice.

use super::super::plane::{Point, distance, to_segment};

/// Distance of two rows, in spacings: the height of an equilateral triangle.
const ROW: f64 = 0.866_025_403_784_438_6;

/// Least distance of a point of the lattice from the front, in spacings (or lengths of the front's edge, if smaller):
/// between this and 1 a triangle fits without a gap or a crowd.
const CLEAR_OF_FRONT: f64 = 0.8;

/// The same from the boundary, where there is no front: where a shape is narrow.
const CLEAR_OF_EDGE: f64 = 0.7;

/// Points of a lattice over the box about the boundary.
///
/// Shapes: `state` has one entry a point, row by row, with an empty margin of one point around: 0 is none.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    origin: Point,
    spacing: f64,
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// 0: no point. Else: a point, and how many steps it is from the lattice's end, as far as they were counted.
    pub(super) state: Vec<u8>,
}

impl Lattice {
    /// The points inside of the loops.
    pub(super) fn new(loops: &[Vec<Point>], spacing: f64) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in loops.iter().flatten() {
            for k in 0..2 {
                (low[k], high[k]) = (low[k].min(point[k]), high[k].max(point[k]));
            }
        }
        let columns = ((high[0] - low[0]) / spacing) as usize + 4;
        let rows = ((high[1] - low[1]) / (ROW * spacing)) as usize + 4;
        let origin = [low[0] - 1.25 * spacing, low[1] - ROW * spacing];
        let mut lattice = Lattice { origin, spacing, columns, rows, state: vec![0; columns * rows] };
        lattice.fill(loops);
        lattice
    }

    /// Marks points between the crossings of each row with the loops, in pairs.
    fn fill(&mut self, loops: &[Vec<Point>]) {
        let mut crossings: Vec<(usize, f64)> = Vec::new();
        for points in loops {
            for k in 0..points.len() {
                let (a, b) = (points[k], points[(k + 1) % points.len()]);
                let (upper, lower) = if a[1] < b[1] { (a, b) } else { (b, a) };
                let row = |y: f64| ((y - self.origin[1]) / (ROW * self.spacing)).ceil() as usize;
                for j in row(upper[1])..row(lower[1]).min(self.rows) {
                    let share = (self.y(j) - upper[1]) / (lower[1] - upper[1]);
                    crossings.push((j, upper[0] + share.clamp(0.0, 1.0) * (lower[0] - upper[0])));
                }
            }
        }
        crossings.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut k = 0;
        while k + 1 < crossings.len() {
            let ((row, from), (other, to)) = (crossings[k], crossings[k + 1]);
            if row != other {
                k += 1;
                continue;
            }
            let column = |x: f64| ((x - self.place(0, row)[0]) / self.spacing).ceil() as usize;
            let range = column(from).clamp(1, self.columns - 1)..column(to).clamp(1, self.columns - 1);
            let start = row * self.columns;
            if (1..self.rows - 1).contains(&row) && range.start < range.end {
                self.state[start + range.start..start + range.end].fill(1);
            }
            k += 2;
        }
    }

    fn y(&self, row: usize) -> f64 {
        self.origin[1] + row as f64 * ROW * self.spacing
    }

    /// Where a point is `[px]`.
    pub(super) fn place(&self, column: usize, row: usize) -> Point {
        let shift = 0.5 * (row % 2) as f64;
        [self.origin[0] + (column as f64 + shift) * self.spacing, self.y(row)]
    }

    /// Takes away points too close to edges and to points of the front.
    pub(super) fn clear(&mut self, edges: &[[Point; 2]], front: &[(Point, f64)]) {
        for &edge in edges {
            let reach = CLEAR_OF_EDGE * self.spacing.min(distance(edge[0], edge[1]));
            self.clear_near(edge, reach);
        }
        for &(point, length) in front {
            self.clear_near([point, point], CLEAR_OF_FRONT * self.spacing.min(length));
        }
    }

    fn clear_near(&mut self, [a, b]: [Point; 2], reach: f64) {
        let row = |y: f64| ((y - self.origin[1]) / (ROW * self.spacing)).max(0.0);
        let rows = row(a[1].min(b[1]) - reach) as usize..=(row(a[1].max(b[1]) + reach) as usize).min(self.rows - 1);
        for j in rows {
            let column = |x: f64| ((x - self.place(0, j)[0]) / self.spacing).max(0.0);
            let left = column(a[0].min(b[0]) - reach) as usize;
            let right = (column(a[0].max(b[0]) + reach) as usize).min(self.columns - 1);
            for i in left..=right {
                if self.state[j * self.columns + i] != 0 && to_segment(self.place(i, j), [a, b]).0 < reach {
                    self.state[j * self.columns + i] = 0;
                }
            }
        }
    }

    /// The six neighbours of a point, by their places in `state`: right, and on with y growing.
    ///
    /// Valid range: a point that is not on the margin.
    pub(super) fn around(&self, at: usize) -> [usize; 6] {
        let shift = at / self.columns % 2;
        let (above, below) = (at - self.columns + shift, at + self.columns + shift);
        [at + 1, below, below - 1, at - 1, above - 1, above]
    }

    /// Counts the steps of each point from the lattice's end, up to a limit.
    pub(super) fn count_steps(&mut self, limit: u8) {
        for step in 1..limit {
            let is_deep = |at: usize| self.state[at] == step && self.around(at).iter().all(|&k| self.state[k] >= step);
            let deep: Vec<usize> = (0..self.state.len()).filter(|&at| is_deep(at)).collect();
            deep.iter().for_each(|&at| self.state[at] = step + 1);
        }
    }

    /// Leaves ever fewer points with the distance from the boundary: of three, one.
    ///
    /// Model: every third point of a hexagonal lattice makes one that is wider by sqrt(3) and turned by 30 degrees.
    /// Each width is kept for three of its own steps, up to `ratio` times the spacing.
    pub(super) fn thin_out(&mut self, ratio: f64) {
        const STEPS: [(u8, f64); 4] = [(3, 1.732), (8, 3.0), (17, 5.196), (33, 9.0)];
        let levels = STEPS.iter().take_while(|(_, width)| *width <= ratio + 1e-3).count();
        if levels == 0 {
            return;
        }
        self.count_steps(STEPS[levels - 1].0 + 1);
        for at in 0..self.state.len() {
            let level = STEPS[..levels].iter().take_while(|(steps, _)| self.state[at] > *steps).count();
            if self.state[at] != 0 && !self.is_in_level(at, level) {
                self.state[at] = 0;
            }
        }
    }

    /// Whether a point belongs to the lattice that is wider by sqrt(3) to the power of `level`.
    fn is_in_level(&self, at: usize, level: usize) -> bool {
        let (row, column) = ((at / self.columns) as i64, (at % self.columns) as i64);
        // Coordinates along the directions right and right below.
        let (mut i, mut j) = (column - row.div_euclid(2), row);
        for _ in 0..level {
            if (i - j).rem_euclid(3) != 0 {
                return false;
            }
            // (i, j) = u (1, 1) + v (-1, 2).
            (i, j) = ((2 * i + j) / 3, (j - i) / 3);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_a_spacing_away() {
        let lattice = Lattice::new(&[vec![[0.0, 0.0], [50.0, 0.0], [50.0, 50.0], [0.0, 50.0]]], 4.0);
        let place = |at: usize| lattice.place(at % lattice.columns, at / lattice.columns);
        let inner: Vec<usize> = (0..lattice.state.len()).filter(|&at| lattice.state[at] != 0).collect();
        assert_eq!(inner.len(), 13 * 15 - 7);
        for at in inner {
            for k in lattice.around(at) {
                assert!((distance(place(at), place(k)) - 4.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn wider_lattices_hold_a_third_each_at_sqrt_3() {
        let lattice = Lattice::new(&[vec![[0.0, 0.0], [90.0, 0.0], [90.0, 90.0], [0.0, 90.0]]], 1.0);
        let place = |at: usize| lattice.place(at % lattice.columns, at / lattice.columns);
        for level in 0..4 {
            let all: Vec<Point> =
                (0..lattice.state.len()).filter(|&at| lattice.is_in_level(at, level)).map(place).collect();
            let share = all.len() as f64 * 3.0_f64.powi(level as i32) / lattice.state.len() as f64;
            assert!((share - 1.0).abs() < 0.1, "level {level}: {share}");
            let middle = all[all.len() / 2];
            let nearest = all.iter().map(|&p| distance(p, middle)).filter(|&d| d > 0.0).fold(f64::INFINITY, f64::min);
            assert!((nearest - 3.0_f64.sqrt().powi(level as i32)).abs() < 1e-9);
        }
    }
}
