//! Segments cut where they cross or touch; places that rounding cannot tell apart become one.

use super::Segment;
use super::grid::{Grid, extent};
use crate::sim::vector::{cross, dot, length, scale, sub};
use std::collections::BTreeMap;

/// Crossings at most: drawings have fewer, and more would take seconds.
pub(super) const MOST_CROSSINGS: usize = 200_000;
/// Places nearer than this share of the extent of all are one; and no nearer than so many roundings of a coordinate.
const NEAR: f64 = 1e-11;
const ROUNDINGS: f64 = 16.0;

/// Places, each once.
pub(super) struct Places {
    pub(super) list: Vec<[f64; 2]>,
    /// Below this distance places are one `[m]`.
    near: f64,
    cells: BTreeMap<[i64; 2], Vec<u32>>,
}

/// A piece of a segment, from one place to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Piece {
    /// Numbers of the places, ascending.
    pub(super) ends: [u32; 2],
    /// Which polygon it is of.
    pub(super) polygon: u32,
}

impl Places {
    fn of_segments(segments: &[(Segment, u32)]) -> Self {
        let plain: Vec<Segment> = segments.iter().map(|(ends, _)| *ends).collect();
        let [low, high] = extent(&plain);
        let size = length(sub(high, low));
        let reach = [low, high].iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        let near = (NEAR * size).max(ROUNDINGS * f64::EPSILON * reach).max(f64::MIN_POSITIVE);
        Places { list: Vec::new(), near, cells: BTreeMap::new() }
    }

    /// The number of a place: of one that is near, or a new one.
    fn number(&mut self, x: [f64; 2]) -> u32 {
        let cell = x.map(|x| (x / (2.0 * self.near)).floor() as i64);
        for dx in -1..=1 {
            for dy in -1..=1 {
                let around = self.cells.get(&[cell[0].saturating_add(dx), cell[1].saturating_add(dy)]);
                let is_it = |k: &&u32| length(sub(self.list[**k as usize], x)) <= self.near;
                if let Some(&known) = around.and_then(|list| list.iter().find(is_it)) {
                    return known;
                }
            }
        }
        let number = self.list.len() as u32;
        self.list.push(x);
        self.cells.entry(cell).or_default().push(number);
        number
    }

    fn segment(&self, ends: [u32; 2]) -> Segment {
        ends.map(|end| self.list[end as usize])
    }
}

/// The pieces of segments, which cross and touch each other nowhere but at their ends.
///
/// Errors: more than [`MOST_CROSSINGS`].
pub(super) fn cut(segments: &[(Segment, u32)]) -> Result<(Places, Vec<Piece>), TooManyCrossings> {
    let mut places = Places::of_segments(segments);
    let whole: Vec<([u32; 2], u32)> =
        segments.iter().map(|(ends, polygon)| (ends.map(|end| places.number(end)), *polygon)).collect();
    let whole: Vec<([u32; 2], u32)> = whole.into_iter().filter(|([a, b], _)| a != b).collect();
    let drawn: Vec<Segment> = whole.iter().map(|(ends, _)| places.segment(*ends)).collect();
    let grid = Grid::new(&drawn);
    let mut cuts: Vec<Vec<(f64, u32)>> = vec![Vec::new(); whole.len()];
    let mut crossings = 0;
    for (k, &[a, b]) in drawn.iter().enumerate() {
        for other in grid.near(a, b, places.near).into_iter().map(|other| other as usize).filter(|&other| other > k) {
            let ends = [whole[k].0, whole[other].0];
            let touches = touch(&places, ends, |which, cut| cuts[[k, other][which]].push(cut));
            if !touches && let Some(shares) = crossing([drawn[k], drawn[other]]) {
                let at = places.number([0, 1].map(|axis| a[axis] + shares[0] * (b[axis] - a[axis])));
                cuts[k].push((shares[0], at));
                cuts[other].push((shares[1], at));
                crossings += 1;
                if crossings > MOST_CROSSINGS {
                    return Err(TooManyCrossings);
                }
            }
        }
    }
    let mut pieces = Vec::with_capacity(whole.len());
    for ((&([first, last], polygon), _), cuts) in whole.iter().zip(&drawn).zip(&mut cuts) {
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut from = first;
        for to in cuts.iter().map(|cut| cut.1).chain([last]) {
            if from != to {
                pieces.push(Piece { ends: [from.min(to), from.max(to)], polygon });
                from = to;
            }
        }
    }
    Ok((places, pieces))
}

/// Outlines that cross too often.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TooManyCrossings;

/// Whether two segments have a place in common that is an end of one; tells `see` which of them that cuts, and where.
fn touch(places: &Places, ends: [[u32; 2]; 2], mut see: impl FnMut(usize, (f64, u32))) -> bool {
    let mut touches = false;
    for which in [0, 1] {
        let own = ends[which];
        let [a, b] = places.segment(own);
        let along = sub(b, a);
        let square = dot(along, along);
        for end in ends[1 - which] {
            if own.contains(&end) {
                touches = true;
                continue;
            }
            let from = sub(places.list[end as usize], a);
            let share = dot(from, along) / square;
            let is_on = (0.0..=1.0).contains(&share) && length(sub(from, scale(along, share))) <= places.near;
            if is_on {
                touches = true;
                see(which, (share, end));
            }
        }
    }
    touches
}

/// The shares of two segments at which they cross, if they do.
fn crossing([[a, b], [c, d]]: [Segment; 2]) -> Option<[f64; 2]> {
    let (along, other, apart) = (sub(b, a), sub(d, c), sub(c, a));
    let across = cross(along, other);
    let shares = [cross(apart, other) / across, cross(apart, along) / across];
    shares.iter().all(|share| (0.0..=1.0).contains(share)).then_some(shares)
}
