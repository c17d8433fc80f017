//! Pieces that share two points become one.
//!
//! ```text
//! which      the first piece that shares two points with another, and the first of those: they are one, and that comes last from then on
//! into       the points of the second one are put into the first one, and with them what two bonds hold to both; those of the first one into
//!            the second one where that is larger and has others' points already
//! frame      where the points lie is said as the first of both says it, in the end
//! anew       only what shares a point with those that were put is looked at anew
//! ```
//!
//! But for once, a point goes into another piece only where that is as large at least: near linear in points and bonds, and in the couples of
//! pieces that share a point.

use std::collections::{BTreeMap, BTreeSet};

use super::pieces::Piece;
use super::shape::{FITS, Net, fits};
use crate::sim::vector::{add, cross, dot, scale, sub};

/// Makes one of those pieces that share two points, as long as there are such; bonds that get into one are `covered`. `None`: they contradict
/// each other.
pub(super) fn merge(pieces: Vec<Piece>, net: &Net<'_>, covered: &mut [bool]) -> Option<Vec<Piece>> {
    if pieces.len() < 2 {
        return Some(pieces);
    }
    let mut merging = Merging::new(pieces, net, covered);
    while let Some(pair) = merging.next_pair() {
        merging.unite(pair)?;
    }
    Some(merging.pieces())
}

/// A piece to which others may come.
#[derive(Clone, Debug, Default)]
struct Growing {
    places: BTreeMap<u32, [f64; 2]>,
    /// Whether points of others were put into it.
    has_others: bool,
    /// From those places to where its points are in the end; `None`: they are there.
    frame: Option<Shift>,
    /// Before those of higher rank.
    rank: u32,
    /// How many points it shares with others, by their numbers.
    near: BTreeMap<u32, u32>,
}

impl Growing {
    /// The pieces that share two points with it.
    fn partners(&self) -> impl Iterator<Item = u32> {
        self.near.iter().filter(|(_, shared)| **shared > 1).map(|(other, _)| *other)
    }

    fn place(&self, point: u32) -> [f64; 2] {
        self.places.get(&point).copied().unwrap_or_default()
    }

    /// Puts the points of another piece into it, and what two bonds hold to both. Returns the points that are new in it.
    ///
    /// All of it is gone through the first time, when all is there: what is hardly beside one end of a bond may be well beside the other.
    fn put(&mut self, gone: &Growing, shift: &Shift, net: &Net<'_>) -> Vec<u32> {
        let all: Vec<u32> = if self.has_others { Vec::new() } else { self.places.keys().copied().collect() };
        let new: Vec<u32> = gone.places.keys().filter(|point| !self.places.contains_key(point)).copied().collect();
        self.places.extend(new.iter().map(|&point| (point, shift.of(gone.place(point)))));
        let start = if self.has_others { self.border(&new, net) } else { all };
        self.has_others = true;
        let before = start.len();
        net.grow([start, new].concat(), &mut self.places).split_off(before)
    }

    /// The points before some `new` ones that bonds join to what has no place and a bond to a new one: from them on something may be laid out
    /// that could not before, in the order in which it would be from all points on.
    fn border(&self, new: &[u32], net: &Net<'_>) -> Vec<u32> {
        let beside = |points: &[u32], are_placed: bool| {
            let ends = points.iter().flat_map(|&point| net.of(point)).map(|spoke| spoke.1);
            let mut list: Vec<u32> = ends.filter(|end| self.places.contains_key(end) == are_placed).collect();
            list.sort_unstable();
            list.dedup();
            list
        };
        let mut list = beside(&beside(new, false), true);
        list.retain(|point| new.binary_search(point).is_err());
        list
    }

    /// Covers the bonds between `new` points and all others; `None`: one has another length.
    fn hold(&self, new: &[u32], net: &Net<'_>, covered: &mut [bool]) -> Option<()> {
        for &point in new {
            for &(_, other, rest, bond) in net.of(point).iter().filter(|spoke| self.places.contains_key(&spoke.1)) {
                if !fits(&([point, other], rest), |end| self.place(end)) {
                    return None;
                }
                covered[bond as usize] = true;
            }
        }
        Some(())
    }

    /// As it is in the end.
    fn grown(self) -> Piece {
        let (points, mut places): (Vec<u32>, Vec<[f64; 2]>) = self.places.into_iter().unzip();
        if let Some(frame) = self.frame {
            places.iter_mut().for_each(|x| *x = frame.of(*x));
        }
        Piece { points, places }
    }
}

struct Merging<'a> {
    net: &'a Net<'a>,
    covered: &'a mut [bool],
    /// Without points where they are part of others.
    pieces: Vec<Growing>,
    /// The numbers of the pieces that each point is in.
    homes: Vec<Vec<u32>>,
    /// Ranks and numbers of all that share two points with another.
    due: BTreeSet<(u32, u32)>,
    /// The rank of what is made next.
    rank: u32,
}

impl<'a> Merging<'a> {
    fn new(pieces: Vec<Piece>, net: &'a Net<'a>, covered: &'a mut [bool]) -> Self {
        let growing = |(Piece { points, places }, rank): (Piece, u32)| Growing {
            places: points.into_iter().zip(places).collect(),
            rank,
            ..Growing::default()
        };
        let pieces: Vec<Growing> = pieces.into_iter().zip(0..).map(growing).collect();
        let (homes, rank) = (vec![Vec::new(); net.count()], pieces.len() as u32);
        let mut merging = Merging { net, covered, pieces, homes, due: BTreeSet::new(), rank };
        for number in 0..rank {
            let points: Vec<u32> = merging.pieces[number as usize].places.keys().copied().collect();
            merging.take_in(number, &points);
            merging.note(number);
        }
        merging
    }

    /// Notes that a piece has these points from now on: those that share two points with it then are due.
    fn take_in(&mut self, number: u32, points: &[u32]) {
        for &point in points {
            for &other in &self.homes[point as usize] {
                *self.pieces[number as usize].near.entry(other).or_default() += 1;
                let beside = &mut self.pieces[other as usize];
                let shared = beside.near.entry(number).or_default();
                *shared += 1;
                if *shared == 2 {
                    self.due.insert((beside.rank, other));
                }
            }
            self.homes[point as usize].push(number);
        }
    }

    /// A piece is due if it shares two points with another.
    fn note(&mut self, number: u32) {
        let piece = &self.pieces[number as usize];
        if piece.partners().next().is_some() {
            self.due.insert((piece.rank, number));
        }
    }

    /// The first piece that shares two points with another, and the first of those.
    fn next_pair(&self) -> Option<[u32; 2]> {
        let &(_, one) = self.due.first()?;
        let other = self.pieces[one as usize].partners().min_by_key(|&other| self.pieces[other as usize].rank)?;
        Some([one, other])
    }

    /// Makes one of two pieces, which is where the first one says. Returns how many points were put into the other one; `None`: the two
    /// contradict each other.
    fn unite(&mut self, [one, other]: [u32; 2]) -> Option<usize> {
        for number in [one, other] {
            self.due.remove(&(self.pieces[number as usize].rank, number));
        }
        let [first, second] = [one, other].map(|number| &self.pieces[number as usize]);
        let stays = !second.has_others || first.places.len() >= second.places.len();
        let (into, from) = if stays { (one, other) } else { (other, one) };
        let gone = self.leave(from);
        let kept = &mut self.pieces[into as usize];
        let mut shared = gone.places.keys().copied().filter(|point| kept.places.contains_key(point));
        let ends = [shared.next()?, shared.next_back()?];
        let (there, here) = (ends.map(|end| gone.place(end)), ends.map(|end| kept.place(end)));
        let shift = Shift::between(there, here)?;
        if !stays {
            let back = Shift::between(here, there)?;
            kept.frame = Some(gone.frame.map_or(back, |frame| frame.after(&back)));
        }
        kept.rank = self.rank;
        self.rank += 1;
        let new = kept.put(&gone, &shift, self.net);
        kept.hold(&new, self.net, self.covered)?;
        self.take_in(into, &new);
        self.note(into);
        Some(gone.places.len())
    }

    /// A piece is none by itself any more. Returns what it was.
    fn leave(&mut self, number: u32) -> Growing {
        let gone = std::mem::take(&mut self.pieces[number as usize]);
        for &point in gone.places.keys() {
            self.homes[point as usize].retain(|&home| home != number);
        }
        for &other in gone.near.keys() {
            self.pieces[other as usize].near.remove(&number);
        }
        gone
    }

    /// What there is in the end, by rank.
    fn pieces(self) -> Vec<Piece> {
        let mut list = self.pieces;
        list.retain(|piece| !piece.places.is_empty());
        list.sort_unstable_by_key(|piece| piece.rank);
        list.into_iter().map(Growing::grown).collect()
    }
}

/// Turned about a place, which is put somewhere.
#[derive(Clone, Copy, Debug)]
struct Shift {
    /// Cosine and sine.
    turn: [f64; 2],
    from: [f64; 2],
    to: [f64; 2],
}

impl Shift {
    /// From one frame into another, by where two places are in both; `None`: they are as far apart in neither, or nowhere.
    fn between([a, b]: [[f64; 2]; 2], [p, q]: [[f64; 2]; 2]) -> Option<Self> {
        let (d, e) = (sub(b, a), sub(q, p));
        let (length, other) = (dot(d, d).sqrt(), dot(e, e).sqrt());
        let is_same = length > 0.0 && (length - other).abs() <= FITS * length;
        let turn = scale([dot(d, e), cross(d, e)], 1.0 / (length * other));
        is_same.then_some(Shift { turn, from: a, to: p })
    }

    fn of(&self, x: [f64; 2]) -> [f64; 2] {
        add(self.to, turned(self.turn, sub(x, self.from)))
    }

    /// Both: the other one comes first.
    fn after(&self, first: &Shift) -> Self {
        Shift { turn: turned(self.turn, first.turn), from: first.from, to: self.of(first.to) }
    }
}

/// A way turned by an angle, of which this is the cosine and the sine.
fn turned([cos, sin]: [f64; 2], r: [f64; 2]) -> [f64; 2] {
    [cos * r[0] - sin * r[1], sin * r[0] + cos * r[1]]
}

#[cfg(test)]
mod tests {
    use super::super::pieces::{apart, find};
    use super::super::shape::Held;
    use super::*;

    /// Points and bonds as long as they are apart, times a share.
    #[derive(Default)]
    struct Frame {
        now: Vec<[f64; 2]>,
        bonds: Vec<([u32; 2], f64)>,
    }

    impl Frame {
        fn point(&mut self, x: [f64; 2]) -> u32 {
            self.now.push(x);
            self.now.len() as u32 - 1
        }

        fn bond(&mut self, [a, b]: [u32; 2], share: f64) {
            let d = sub(self.now[a as usize], self.now[b as usize]);
            self.bonds.push(([a, b], share * dot(d, d).sqrt()));
        }

        /// Six triangles between two rails of four points. The ends of a rail have no neighbour in common: nothing grows over them.
        fn column(&mut self, left: [u32; 4], right: [u32; 4], share: f64) {
            (0..4).for_each(|k| self.bond([left[k], right[k]], share));
            for k in 0..3 {
                for ends in [[left[k], left[k + 1]], [right[k], right[k + 1]], [left[k], right[k + 1]]] {
                    self.bond(ends, share);
                }
            }
        }

        /// Columns side by side, each of which shares the ends of its rails with those beside it; bonds are listed in the `order` of the columns.
        /// Returns the first points of the inner ones of each.
        fn columns(order: &[usize]) -> (Frame, Vec<u32>) {
            let mut frame = Frame::default();
            let ends: Vec<[u32; 2]> =
                (0..=order.len()).map(|k| [0.0, 3.0].map(|y| frame.point([k as f64, y]))).collect();
            let mut inner = vec![0; order.len()];
            for &k in order {
                let mut rail = |end: usize, x: f64| {
                    let [low, high] = ends[end];
                    [low, frame.point([x, 1.0]), frame.point([x, 2.0]), high]
                };
                let (left, right) = (rail(k, k as f64 + 0.1), rail(k + 1, k as f64 + 0.9));
                inner[k] = left[1];
                frame.column(left, right, 1.0);
            }
            (frame, inner)
        }

        fn held(&self) -> Held<'_> {
            let (now, bonds) = (self.now.clone(), self.bonds.clone());
            Held { masses: vec![1.0; now.len()], now, bonds, surface: &[] }
        }

        /// The pieces before any is merged and after that, and how many points were put into others.
        fn merged(&self) -> Option<(Vec<Piece>, Vec<Piece>, usize)> {
            let held = self.held();
            let net = Net::new(&held);
            let (single, mut covered) = apart(&held, &net, usize::MAX)?;
            let mut merging = Merging::new(single.clone(), &net, &mut covered);
            let mut put = 0;
            while let Some(pair) = merging.next_pair() {
                put += merging.unite(pair)?;
            }
            let merged = merging.pieces();
            assert!(merged.len() > 1 || covered.iter().all(|is_in| *is_in));
            Some((single, merged, put))
        }

        /// Most that the length of a bond is other in a piece `[m]`.
        fn off(&self, piece: &Piece) -> f64 {
            let at = |point: u32| piece.points.binary_search(&point).ok().map(|k| piece.places[k]);
            let off = |&([a, b], rest): &([u32; 2], f64)| {
                let d = sub(at(a)?, at(b)?);
                Some((dot(d, d).sqrt() - rest).abs())
            };
            self.bonds.iter().filter_map(off).fold(0.0, f64::max)
        }
    }

    #[test]
    fn a_strip_of_two_thousand_triangles_is_one_piece_and_each_point_is_put_few_times() {
        let order: Vec<usize> = (0..334).collect();
        let (strip, _) = Frame::columns(&order);
        let (single, merged, put) = strip.merged().unwrap_or_default();
        assert_eq!((single.len(), merged.len()), (334, 1));
        assert_eq!(merged[0].points.len(), strip.now.len());
        assert!(strip.off(&merged[0]) < 1e-9, "{}", strip.off(&merged[0]));
        // But for once, a point gets into a piece twice as large each time: 334 < 2^9.
        assert!(put <= 10 * strip.now.len(), "{put} of {}", strip.now.len());
    }

    #[test]
    fn what_hangs_on_a_large_piece_is_put_into_it_and_the_last_one_says_where_all_is() {
        let mut frame = Frame::default();
        let rail =
            |frame: &mut Frame, y: f64| -> Vec<u32> { (0..400).map(|k| frame.point([f64::from(k), y])).collect() };
        let (low, high) = (rail(&mut frame, 0.0), rail(&mut frame, 1.0));
        for k in 0..399 {
            for ends in [[low[k], low[k + 1]], [high[k], high[k + 1]], [low[k], high[k]], [low[k], high[k + 1]]] {
                frame.bond(ends, 1.0);
            }
        }
        frame.bond([low[399], high[399]], 1.0);
        for k in (0..400).step_by(4) {
            let mut at = |i: usize, y: f64| frame.point([(k + i) as f64, y]);
            let (left, right) = ([high[k], at(1, 1.5), at(2, 1.5), high[k + 3]], [0, 1, 2, 3].map(|i| at(i, 2.5)));
            frame.column(left, right, 1.0);
        }
        let (single, merged, put) = frame.merged().unwrap_or_default();
        assert_eq!((single.len(), merged.len(), put), (101, 1, 8 * 100));
        assert!(frame.off(&merged[0]) < 1e-9, "{}", frame.off(&merged[0]));
        for (point, x) in single[100].points.iter().zip(&single[100].places) {
            let k = merged[0].points.binary_search(point).unwrap_or_default();
            let d = sub(merged[0].places[k], *x);
            assert!(dot(d, d).sqrt() < 1e-9, "{point}: {d:?}");
        }
    }

    /// The points of pieces, with the first two of all couples that share two made one that comes last, as long as there are such.
    fn one_by_one(single: &[Piece]) -> Vec<Vec<u32>> {
        let mut list: Vec<Vec<u32>> = single.iter().map(|piece| piece.points.clone()).collect();
        let shares = |a: &[u32], b: &[u32]| a.iter().filter(|point| b.contains(point)).count() > 1;
        loop {
            let mut couples = (0..list.len()).flat_map(|a| (a + 1..list.len()).map(move |b| [a, b]));
            let Some([a, b]) = couples.find(|&[a, b]| shares(&list[a], &list[b])) else { return list };
            let moved = list.remove(b);
            let mut points = [list.remove(a), moved].concat();
            points.sort_unstable();
            points.dedup();
            list.push(points);
        }
    }

    #[test]
    fn pieces_come_in_the_order_of_looking_at_every_couple_anew() {
        for step in [1, 5, 7, 11] {
            let order: Vec<usize> = (0..12).map(|k| k * step % 12).collect();
            let (mut frame, inner) = Frame::columns(&order);
            // Two triangles that hang on a point of the row each, one of them listed first.
            for k in [2, 9] {
                let [a, b] = [[-0.5, 5.0], [0.5, 5.0]].map(|[x, y]| frame.point([k as f64 + x, y]));
                [[inner[k], a], [a, b], [b, inner[k]]].into_iter().for_each(|ends| frame.bond(ends, 1.0));
            }
            frame.bonds.rotate_right(3);
            let (single, merged, _) = frame.merged().unwrap_or_default();
            let found: Vec<Vec<u32>> = merged.iter().map(|piece| piece.points.clone()).collect();
            assert_eq!((single.len(), found.len()), (14, 3), "{step}");
            assert_eq!(found, one_by_one(&single), "{step}");
            assert!(merged.iter().all(|piece| frame.off(piece) < 1e-9));
        }
    }

    #[test]
    fn what_two_pieces_hold_between_them_is_part_of_both() {
        let (mut frame, inner) = Frame::columns(&[0, 1]);
        let hung = frame.point([1.0, 4.0]);
        inner.iter().for_each(|&point| frame.bond([point, hung], 1.0));
        let found = find(&frame.held()).unwrap_or_default();
        assert_eq!((found.pieces.len(), found.pieces[0].points.len(), found.rods.len()), (1, frame.now.len(), 0));
        assert!(frame.off(&found.pieces[0]) < 1e-12);
    }

    #[test]
    fn pieces_of_other_sizes_where_they_meet_contradict_each_other() {
        for (share, fits) in [(1.0, true), (1.001, false)] {
            let mut frame = Frame::default();
            let ends = [0.0, 3.0].map(|y| frame.point([0.0, y]));
            for (side, share) in [(-1.0, 1.0), (1.0, share)] {
                let mut at = |x: f64, y: f64| frame.point([side * x, y]);
                let (left, right) =
                    ([ends[0], at(0.1, 1.0), at(0.1, 2.0), ends[1]], [0.0, 1.0, 2.0, 3.0].map(|y| at(1.0, y)));
                frame.column(left, right, share);
            }
            assert_eq!(find(&frame.held()).is_some(), fits, "{share}");
        }
    }
}
