//! Whether bonds leave points no motion but those of a rigid body, by the rank of their system at places.

use super::layout::Held;
use crate::sim::sizes::MOST_RANKED;
use crate::sim::vector::{scale, sub};

/// Share of the largest number of a row below which what is left of it is rounding.
const NOTHING: f64 = 1e-9;

/// Whether points are held: bonds have a rank of three times the points, less six. `false` where there are too many points.
///
/// Model: a bond between a and b says (x_a - x_b) . (v_a - v_b) = 0. Gauss' elimination with the largest number of all as pivot.
pub(super) fn is_rigid(held: &Held) -> bool {
    let count = held.now.len();
    if !(4..=MOST_RANKED).contains(&count) || held.bonds.len() + 6 < 3 * count {
        return false;
    }
    let mut rows: Vec<Vec<f64>> = held
        .bonds
        .iter()
        .map(|&([a, b], rest)| {
            let way = scale(sub(held.now[a as usize], held.now[b as usize]), 1.0 / rest);
            let mut row = vec![0.0; 3 * count];
            for k in 0..3 {
                row[3 * a as usize + k] = way[k];
                row[3 * b as usize + k] = -way[k];
            }
            row
        })
        .collect();
    rank(&mut rows) == 3 * count - 6
}

fn rank(rows: &mut [Vec<f64>]) -> usize {
    let mut rank = 0;
    while rank < rows.len() {
        let entries = rows[rank..]
            .iter()
            .enumerate()
            .flat_map(|(r, row)| row.iter().enumerate().map(move |(c, x)| (r, c, x.abs())));
        let Some((row, column, most)) = entries.max_by(|a, b| a.2.total_cmp(&b.2)) else { break };
        // NaN is no rank.
        let is_something = most > NOTHING && most.is_finite();
        if !is_something {
            break;
        }
        rows.swap(rank, rank + row);
        let (done, left) = rows.split_at_mut(rank + 1);
        let pivot = &done[rank];
        for row in left {
            let share = row[column] / pivot[column];
            if share != 0.0 {
                row.iter_mut().zip(pivot).for_each(|(x, p)| *x -= share * p);
                row[column] = 0.0;
            }
        }
        rank += 1;
    }
    rank
}

#[cfg(test)]
mod tests {
    use super::super::layout::tests::{SIX, TETRAHEDRON, held};
    use super::*;

    /// The corners of a cube by their bits, its edges, and a diagonal of each side.
    fn cube(diagonals: [[u32; 2]; 6]) -> Held {
        let now: Vec<[f64; 3]> = (0..8).map(|n: u32| std::array::from_fn(|k| f64::from(n >> k & 1))).collect();
        let edges = [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];
        held(&now, &[&edges[..], &diagonals[..]].concat())
    }

    #[test]
    fn a_cube_needs_all_six_diagonals_whichever_they_are() {
        let any = [[0, 3], [4, 7], [0, 5], [2, 7], [0, 6], [1, 7]];
        assert!(is_rigid(&cube(any)));
        let mut twice = any;
        twice[5] = twice[4];
        assert!(!is_rigid(&cube(twice)), "one side can shear");
    }

    #[test]
    fn a_tetrahedron_is_rigid_and_a_hinge_is_not() {
        assert!(is_rigid(&held(&TETRAHEDRON, &SIX)));
        assert!(!is_rigid(&held(&TETRAHEDRON, &SIX[..5])));
    }
}
