//! Triangles by what hangs together by sides.

use crate::picture::Tint;
use crate::sim::bond::lower_first;

/// Pieces of triangles: those that share a point alone are two.
pub(super) fn pieces(triangles: &[[u32; 3]]) -> Vec<Vec<[u32; 3]>> {
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * triangles.len());
    for (number, &[a, b, c]) in (0..).zip(triangles) {
        sides.extend([[a, b], [b, c], [c, a]].map(|side| (lower_first(side), number)));
    }
    sides.sort_unstable();
    let pairs = sides.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|pair| [pair[0].1, pair[1].1]);
    let piece_of = Tint::hanging(triangles.len(), pairs);
    let count = piece_of.iter().max().map_or(0, |last| *last as usize + 1);
    let mut list = vec![Vec::new(); count];
    piece_of.iter().zip(triangles).for_each(|(&piece, &corners)| list[piece as usize].push(corners));
    list.retain(|piece| !piece.is_empty());
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_that_share_a_corner_are_two_pieces() {
        let triangles = [[0, 1, 2], [0, 2, 3], [2, 4, 5], [2, 5, 6]];
        assert_eq!(pieces(&triangles).iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
    }
}
