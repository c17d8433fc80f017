//! Which rigid bonds make rigid pieces, and what is left beside them.
//!
//! A piece grows from a bond by points that two bonds hold to it; pieces that share two points are one (`merge.rs`). Linear in the bonds,
//! where few bonds are in no piece.

use super::merge::merge;
use super::shape::{Held, Net, fits};
use crate::sim::sizes::MOST_PIECES;

/// Points that rigid bonds hold in their places.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Ascending.
    pub(super) points: Vec<u32>,
    pub(super) places: Vec<[f64; 2]>,
}

/// What bonds make of points.
#[derive(Clone, Debug, Default)]
pub(super) struct Found {
    pub(super) pieces: Vec<Piece>,
    /// Numbers of the bonds that are in no piece.
    pub(super) rods: Vec<u32>,
}

/// The pieces among points; `None`: lengths contradict each other, or too much is loose.
pub(super) fn find(held: &Held<'_>) -> Option<Found> {
    let net = Net::new(held);
    let (pieces, mut covered) = apart(held, &net, MOST_PIECES)?;
    let pieces = merge(pieces, &net, &mut covered)?;
    let rods = (0..held.bonds.len() as u32).filter(|&k| !covered[k as usize]).collect();
    Some(Found { pieces, rods })
}

/// All pieces among points, however many; `None`: lengths contradict each other.
pub(super) fn all(held: &Held<'_>) -> Option<Vec<Piece>> {
    let net = Net::new(held);
    let (pieces, mut covered) = apart(held, &net, usize::MAX)?;
    merge(pieces, &net, &mut covered)
}

/// Whether lengths contradict each other where bonds hold points in their places.
pub(crate) fn contradicts(held: &Held<'_>) -> bool {
    all(held).is_none()
}

/// The pieces that grow from single bonds, and which bonds are in one; `None`: lengths contradict each other, or there are more than `most`,
/// loose bonds among them.
pub(super) fn apart(held: &Held<'_>, net: &Net<'_>, most: usize) -> Option<(Vec<Piece>, Vec<bool>)> {
    let mut search =
        Search { net, places: vec![None; held.now.len()], covered: vec![false; held.bonds.len()], pieces: Vec::new() };
    let mut loose = 0;
    for (k, &([a, b], rest)) in held.bonds.iter().enumerate() {
        if search.covered[k] {
            continue;
        }
        let start = Net::placed(&(a, b, rest, k as u32), &mut search.places);
        loose += usize::from(!search.take(start)?);
        if loose + search.pieces.len() > most {
            return None;
        }
    }
    Some((search.pieces, search.covered))
}

struct Search<'a> {
    net: &'a Net<'a>,
    /// Of the piece that grows; else of none.
    places: Vec<Option<[f64; 2]>>,
    /// Bonds that are in a piece.
    covered: Vec<bool>,
    pieces: Vec<Piece>,
}

impl Search<'_> {
    /// Grows a piece from points that have places. Returns whether there is one; `None`: its lengths contradict each other.
    fn take(&mut self, start: Vec<u32>) -> Option<bool> {
        let mut points = self.net.grow(start, &mut self.places);
        let is_piece = points.len() > 2;
        if is_piece {
            points.sort_unstable();
            let place = |point: u32| self.places[point as usize].unwrap_or_default();
            for &point in &points {
                for &(_, q, rest, k) in self.net.of(point) {
                    if self.places[q as usize].is_some() {
                        if !fits(&([point, q], rest), place) {
                            return None;
                        }
                        self.covered[k as usize] = true;
                    }
                }
            }
            let places = points.iter().map(|&point| place(point)).collect();
            points.iter().for_each(|&point| self.places[point as usize] = None);
            self.pieces.push(Piece { points, places });
        } else {
            points.iter().for_each(|&point| self.places[point as usize] = None);
        }
        Some(is_piece)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::vector::{dot, sub};

    fn found(now: &[[f64; 2]], ends: &[[u32; 2]]) -> Option<Found> {
        let length = |[a, b]: [u32; 2]| {
            let d = sub(now[a as usize], now[b as usize]);
            dot(d, d).sqrt()
        };
        let bonds = ends.iter().map(|&ends| (ends, length(ends))).collect();
        find(&Held { now: now.to_vec(), masses: vec![1.0; now.len()], bonds, surface: &[] })
    }

    #[test]
    fn two_triangles_at_a_corner_are_two_pieces_and_a_bond_between_them_is_none() {
        let now = [[0.0, 0.0], [1.0, 0.5], [1.0, -0.5], [-1.0, 0.5], [-1.0, -0.5], [-2.0, 0.0]];
        let ends = [[0, 1], [1, 2], [2, 0], [0, 3], [3, 4], [4, 0], [3, 5]];
        let found = found(&now, &ends).unwrap_or_default();
        let points: Vec<&[u32]> = found.pieces.iter().map(|piece| &piece.points[..]).collect();
        assert_eq!(points, [&[0, 1, 2][..], &[0, 3, 4][..]]);
        assert_eq!(found.rods, [6]);
    }

    #[test]
    fn a_piece_grows_over_what_two_points_of_it_hold() {
        // Two braced squares that share their lower corners 1 and 4 over a gap, and a point that hangs on one bond of each.
        let now = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [2.0, 0.1], [1.0, 1.5], [2.0, 1.2], [0.9, 3.0]];
        let left = [[0, 1], [1, 2], [2, 0], [0, 4], [2, 4]];
        let right = [[1, 3], [3, 5], [5, 1], [3, 4], [5, 4]];
        let all = [&left[..], &right[..], &[[2, 6], [5, 6]]].concat();
        let found = found(&now, &all).unwrap_or_default();
        assert_eq!(found.pieces.len(), 1);
        assert_eq!(found.pieces[0].points, [0, 1, 2, 3, 4, 5, 6]);
        assert!(found.rods.is_empty());
        for [a, b] in all {
            let apart = |list: &[[f64; 2]]| {
                let d = sub(list[a as usize], list[b as usize]);
                dot(d, d).sqrt()
            };
            assert!((apart(&found.pieces[0].places) - apart(&now)).abs() < 1e-12);
        }
    }

    #[test]
    fn three_parallel_bars_between_two_triangles_move() {
        let bars = [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.0, 3.0], [1.0, 3.0], [0.5, 4.0]];
        let ends = [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];
        let found = found(&bars, &ends).unwrap_or_default();
        assert_eq!((found.pieces.len(), found.rods.len()), (2, 3));
    }

    #[test]
    fn a_net_has_no_pieces() {
        let now: Vec<[f64; 2]> = (0..9).map(|k| [f64::from(k % 3), f64::from(k / 3)]).collect();
        let ends = [[0, 1], [1, 2], [3, 4], [4, 5], [6, 7], [7, 8], [0, 3], [3, 6], [1, 4], [4, 7], [2, 5], [5, 8]];
        let found = found(&now, &ends).unwrap_or_default();
        assert_eq!((found.pieces.len(), found.rods.len()), (0, 12));
    }
}
