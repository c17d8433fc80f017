//! From outlines to sides with the solid on their right: what polygons cover together, each by the even-odd rule.
//!
//! Outlines may cross themselves and each other, and share sides: they are cut where they meet, and what has the solid on both
//! sides, or on none, is no side.

use super::cut::{Piece, Places, TooManyCrossings, cut};
use super::grid::Grid;
use super::{Polygon, Segment, Side};
use crate::sim::vector::sub;

/// All sides of the polygons: where one covers another's, or touches it side to side, neither has a side there.
///
/// Errors: they cross too often.
pub(super) fn sides(polygons: &[Polygon]) -> Result<Vec<Side>, TooManyCrossings> {
    let (places, mut pieces) = cut(&segments(polygons))?;
    pieces.sort_unstable();
    let odd: Vec<Piece> =
        pieces.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1).map(|same| same[0]).collect();
    let drawn = Drawn::new(&places, &odd);
    let mut sides = Vec::with_capacity(odd.len());
    let mut first = 0;
    for same in odd.chunk_by(|a, b| a.ends == b.ends) {
        sides.extend(drawn.side(first, same));
        first += same.len();
    }
    Ok(sides)
}

/// What leads from corner to corner.
fn segments(polygons: &[Polygon]) -> Vec<(Segment, u32)> {
    let mut list = Vec::new();
    for (k, polygon) in polygons.iter().enumerate() {
        for corners in &polygon.loops {
            let next = corners.iter().cycle().skip(1);
            list.extend(corners.iter().zip(next).map(|(&corner, &next)| ([corner, next], k as u32)));
        }
    }
    list
}

/// Pieces with a grid over them.
struct Drawn<'a> {
    pieces: &'a [Piece],
    segments: Vec<Segment>,
    grid: Grid,
}

impl<'a> Drawn<'a> {
    fn new(places: &Places, pieces: &'a [Piece]) -> Self {
        let place = |end: u32| places.list[end as usize];
        let segments: Vec<Segment> = pieces.iter().map(|piece| piece.ends.map(place)).collect();
        Drawn { pieces, grid: Grid::new(&segments), segments }
    }

    /// The side that pieces between the same places make, of polygons one each; the number of the first is given. `None` where
    /// there is as much solid on its left as on its right: some or none.
    fn side(&self, first: usize, same: &[Piece]) -> Option<Side> {
        let [a, b] = self.segments[first];
        let [dx, dy] = sub(b, a);
        // Along x the ray goes to the left of the picture, along y down: which side of the segment is that?
        let (axis, is_left) = if dy.abs() >= dx.abs() { (0, dy > 0.0) } else { (1, dx < 0.0) };
        let before = self.around([a, b], axis, same[0].ends);
        let is_in = |piece: &Piece| before.binary_search(&piece.polygon).is_ok();
        // Beyond the segment polygons of it end, or begin.
        let ends = same.iter().filter(|piece| is_in(piece)).count();
        let (is_solid, is_solid_beyond) = (!before.is_empty(), before.len() - ends + (same.len() - ends) > 0);
        if is_solid == is_solid_beyond {
            return None;
        }
        let ends = if is_solid == is_left { [b, a] } else { [a, b] };
        Some(Side { ends, polygon: same[0].polygon })
    }

    /// The polygons around the middle of a segment on the side of the ray along an axis, ascending: those of which the ray crosses
    /// an odd number of other pieces.
    fn around(&self, [a, b]: Segment, axis: usize, own: [u32; 2]) -> Vec<u32> {
        let from = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let mut to = from;
        to[axis] = self.grid.cells.low[axis] - self.grid.cells.side;
        let across = 1 - axis;
        let is_crossed = |&k: &u32| {
            let [c, d] = self.segments[k as usize];
            if self.pieces[k as usize].ends == own || (c[across] > from[across]) == (d[across] > from[across]) {
                return false;
            }
            let share = (from[across] - c[across]) / (d[across] - c[across]);
            c[axis] + share * (d[axis] - c[axis]) < from[axis]
        };
        let near = self.grid.near(from, to, 0.0);
        let mut crossed: Vec<u32> =
            near.iter().filter(|k| is_crossed(k)).map(|&k| self.pieces[k as usize].polygon).collect();
        crossed.sort_unstable();
        crossed.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1).map(|same| same[0]).collect()
    }
}
