//! Points along one contour: evenly between corners, closer where it bends, and shifted to keep its area.

use super::super::plane::{Point, distance, to_segment};
use super::corners::{corners, tip};
use super::path::Path;
use super::settle::settled;

/// Finest points, in spacings, that bends alone bring about; beyond that a point is put where the contour is farthest.
const FINEST: f64 = 0.35;

/// Points that were put where the contour is farthest are joined with neighbours closer than this, in spacings, if that leaves
/// the polygon near enough: a short side makes a thin triangle.
const CLOSE: f64 = 0.3;

/// Growth of the distance between points along the contour, a pixel: neighbours differ by a third at most.
const GROWTH: f64 = 0.3;

/// Rounds of making points closer where the polygon is too far off.
const ROUNDS: usize = 8;

/// The polygon of a contour, and the largest distance between the two `[px]`.
///
/// Model: the contour is cut at its corners. Points divide each part into pieces of one length, of about the spacing;
/// where a piece is off by more than the tolerance, its length shrinks as the root of the excess, which is what a
/// circle's arc asks for, and neighbouring lengths adapt. Then points that are no corners move across the contour, so
/// that each piece keeps the area on its side.
pub(super) fn sampled(path: &Path<'_>, spacing: f64, tolerance: f64) -> (Vec<Point>, f64) {
    let corners = corners(path, spacing);
    let reach = (REACH * spacing).clamp(LEAST_REACH, MOST_REACH).min(path.length() / 16.0);
    let at_corner = |corner: usize, turn: f64| Cut {
        along: path.arc[corner] + turn,
        place: tip(path, corner, spacing, tolerance),
        is_corner: true,
    };
    let parts = corners.len().max(1);
    let mut cuts = Vec::new();
    for k in 0..parts {
        let ends = match corners.get(k) {
            None => [0.0, path.length()].map(|along| Cut { along, place: path.mean(along, reach), is_corner: false }),
            Some(&corner) => {
                let turn = if k + 1 == parts { path.length() } else { 0.0 };
                [at_corner(corner, 0.0), at_corner(corners[(k + 1) % parts], turn)]
            }
        };
        let part = Part { path, ends, least: 3_usize.div_ceil(parts), is_ring: corners.is_empty(), reach };
        cuts.extend(part.divided(spacing, tolerance));
    }
    settled(path, &cuts, tolerance)
}

/// How far to both sides of a point the contour is averaged, in spacings: steps of pixels level out.
const REACH: f64 = 0.3;

/// Limits of that `[px]`: a step of one pixel in two, and of one in eight.
const LEAST_REACH: f64 = 1.5;
const MOST_REACH: f64 = 4.0;

/// A point of the polygon.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    /// Where it cuts the contour, as a distance along it.
    pub(super) along: f64,
    pub(super) place: Point,
    pub(super) is_corner: bool,
}

/// A part of a contour between two corners, or all of it.
struct Part<'a> {
    path: &'a Path<'a>,
    ends: [Cut; 2],
    /// Least number of pieces.
    least: usize,
    is_ring: bool,
    /// How far the contour is averaged `[px]`.
    reach: f64,
}

impl Part<'_> {
    /// The points of the part, its start among them, its end not.
    fn divided(&self, spacing: f64, tolerance: f64) -> Vec<Cut> {
        let [from, to] = self.ends.map(|cut| cut.along);
        let count = (((to - from) / spacing).round() as usize).max(self.least);
        let mut cuts = self.placed((0..=count).map(|k| from + (to - from) * (k as f64 / count as f64)));
        // Lengths asked for on a fine division of the part.
        let cells = (((to - from) / (0.25 * spacing)).ceil() as usize).max(8);
        let cell = (to - from) / cells as f64;
        let mut lengths = vec![spacing; cells];
        for _ in 0..ROUNDS {
            if !self.shorten(&cuts, &mut lengths, FINEST * spacing, tolerance) {
                break;
            }
            level(&mut lengths, GROWTH * cell, self.is_ring);
            cuts = self.placed(spread(from, cell, &lengths, self.least).into_iter());
        }
        let mut all = Vec::with_capacity(cuts.len());
        for pair in cuts.windows(2) {
            all.push(pair[0]);
            self.split([pair[0], pair[1]], tolerance, &mut all);
        }
        all.push(self.ends[1]);
        self.join(&mut all, CLOSE * spacing, tolerance);
        all.pop();
        all
    }

    /// Joins neighbours that are closer than `close` `[px]` in the middle between them, or in the end of the part, where the polygon
    /// stays within the tolerance.
    fn join(&self, cuts: &mut Vec<Cut>, close: f64, tolerance: f64) {
        let mut k = 0;
        while k + 1 < cuts.len() {
            let ([from, to], last) = ([cuts[k], cuts[k + 1]], cuts.len() - 1);
            let is_end = [k == 0, k + 1 == last];
            k += 1;
            if is_end == [true; 2] || cuts.len() <= self.least + 1 || distance(from.place, to.place) >= close {
                continue;
            }
            let along = 0.5 * (from.along + to.along);
            let joined = match is_end {
                [true, _] => from,
                [_, true] => to,
                _ => Cut { along, place: self.path.at(along), is_corner: false },
            };
            let around = [k.checked_sub(2), Some(k + 1)].map(|at| at.and_then(|at| cuts.get(at)).copied());
            let is_near = |other: Option<Cut>, is_before: bool| {
                other.is_none_or(|other| {
                    self.farthest(if is_before { [other, joined] } else { [joined, other] }).1 <= tolerance
                })
            };
            if is_near(around[0], true) && is_near(around[1], false) {
                cuts[k - 1] = joined;
                cuts.remove(k);
                k -= 1;
            }
        }
    }

    /// Lowers the lengths where pieces are too far off; whether any was.
    fn shorten(&self, cuts: &[Cut], lengths: &mut [f64], finest: f64, tolerance: f64) -> bool {
        let [from, to] = self.ends.map(|cut| cut.along);
        let last = lengths.len() - 1;
        let cell = |at: f64| (((at - from) / (to - from) * (last + 1) as f64) as usize).min(last);
        let mut any = false;
        for pair in cuts.windows(2) {
            let off = self.farthest([pair[0], pair[1]]).1;
            if off > tolerance {
                let shrunk = (pair[1].along - pair[0].along) * (tolerance / off).sqrt().clamp(0.5, 0.9);
                for length in &mut lengths[cell(pair[0].along)..=cell(pair[1].along)] {
                    let new = shrunk.max(finest);
                    any |= new < *length;
                    *length = length.min(new);
                }
            }
        }
        any
    }

    /// Points at these distances, of which the first and the last are the ends.
    fn placed(&self, along: impl Iterator<Item = f64>) -> Vec<Cut> {
        let place = |along| Cut { along, place: self.path.mean(along, self.reach), is_corner: false };
        let mut cuts: Vec<Cut> = along.map(place).collect();
        let last = cuts.len() - 1;
        (cuts[0], cuts[last]) = (self.ends[0], self.ends[1]);
        cuts
    }

    /// The place between two cuts that is farthest from the chord, as a distance along the contour, and how far it is.
    fn farthest(&self, [from, to]: [Cut; 2]) -> (f64, f64) {
        let (mut at, mut off) = (from.along, 0.0);
        let (mut along, mut before) = (from.along, self.path.at(from.along));
        for point in self.path.inside(from.along, to.along) {
            along += distance(before, point);
            before = point;
            let (here, _) = to_segment(point, [from.place, to.place]);
            if here > off {
                (at, off) = (along, here);
            }
        }
        (at, off)
    }

    /// Puts points where the contour is too far off until it nowhere is.
    fn split(&self, [from, to]: [Cut; 2], tolerance: f64, cuts: &mut Vec<Cut>) {
        let (along, off) = self.farthest([from, to]);
        if off > tolerance && along > from.along && along < to.along {
            let cut = Cut { along, place: self.path.at(along), is_corner: false };
            self.split([from, cut], tolerance, cuts);
            cuts.push(cut);
            self.split([cut, to], tolerance, cuts);
        }
    }
}

/// Limits how fast lengths grow from cell to cell, all around a loop if the part is one.
fn level(lengths: &mut [f64], growth: f64, wraps: bool) {
    for _ in 0..if wraps { 2 } else { 1 } {
        if wraps {
            let (first, last) = (lengths[0], lengths[lengths.len() - 1]);
            lengths[0] = first.min(last + growth);
        }
        (1..lengths.len()).for_each(|k| lengths[k] = lengths[k].min(lengths[k - 1] + growth));
        if wraps {
            let (first, last) = (lengths[0], lengths.len() - 1);
            lengths[last] = lengths[last].min(first + growth);
        }
        (0..lengths.len() - 1).rev().for_each(|k| lengths[k] = lengths[k].min(lengths[k + 1] + growth));
    }
}

/// Cuts such that between two of them as much of 1 / length lies everywhere.
fn spread(from: f64, cell: f64, lengths: &[f64], least: usize) -> Vec<f64> {
    let total: f64 = lengths.iter().map(|length| cell / length).sum();
    let count = (total.round() as usize).max(least);
    let (mut cuts, mut sum) = (vec![from], 0.0);
    for (k, length) in lengths.iter().enumerate() {
        let here = cell / length;
        while cuts.len() < count {
            let want = total * (cuts.len() as f64 / count as f64);
            if want > sum + here {
                break;
            }
            cuts.push(from + cell * (k as f64 + (want - sum) / here));
        }
        sum += here;
    }
    cuts.push(from + cell * lengths.len() as f64);
    cuts
}
