//! Points along one contour: evenly between corners, closer where it bends, and shifted to keep its area.

use super::super::plane::{Point, distance, dot, doubled_area, minus, to_segment};
use super::corners::{corners, tip};
use super::crossing::middle;
use super::path::Path;

/// Finest points, in spacings, that bends alone bring about; beyond that a point is put where the contour is farthest.
const FINEST: f64 = 0.35;

/// Growth of the distance between points along the contour, a pixel: neighbours differ by a third at most.
const GROWTH: f64 = 0.3;

/// Rounds of making points closer where the polygon is too far off.
const ROUNDS: usize = 8;

/// Rounds of shifting points to keep the area: each leaves about a tenth of the error.
const SHIFTS: usize = 3;

/// The polygon of a contour, and the largest distance between the two [px].
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

/// Limits of that [px]: a step of one pixel in two, and of one in eight.
const LEAST_REACH: f64 = 1.5;
const MOST_REACH: f64 = 4.0;

/// A point of the polygon.
#[derive(Clone, Copy, Debug)]
struct Cut {
    /// Where it cuts the contour, as a distance along it.
    along: f64,
    place: Point,
    is_corner: bool,
}

/// A part of a contour between two corners, or all of it.
struct Part<'a> {
    path: &'a Path<'a>,
    ends: [Cut; 2],
    /// Least number of pieces.
    least: usize,
    is_ring: bool,
    /// How far the contour is averaged [px].
    reach: f64,
}

/// Shifts points to keep the area; those at edges that get too far off go back, and at last onto the contour.
fn settled(path: &Path<'_>, cuts: &[Cut], tolerance: f64) -> (Vec<Point>, f64) {
    let count = cuts.len();
    let mut placed: Vec<Point> = cuts.iter().map(|cut| cut.place).collect();
    let mut is_fixed: Vec<bool> = cuts.iter().map(|cut| cut.is_corner).collect();
    loop {
        let mut points = placed.clone();
        for _ in 0..SHIFTS {
            shift(path, cuts, &is_fixed, &mut points, tolerance);
        }
        let offs = deviations(path, cuts, &points);
        let mut is_done = true;
        let was_fixed = is_fixed.clone();
        for k in (0..count).filter(|&k| offs[k] > tolerance) {
            for end in [k, (k + 1) % count] {
                if was_fixed[end] {
                    let on_contour = path.at(cuts[end].along);
                    is_done &= placed[end] == on_contour;
                    placed[end] = on_contour;
                } else {
                    (is_done, is_fixed[end]) = (false, true);
                }
            }
        }
        if is_done {
            return (points, offs.into_iter().fold(0.0, f64::max));
        }
    }
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
        all
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

/// Moves points that are not fixed across the contour, to bring back the area that the chords beside them cut off.
///
/// Model: moved by d across the line between its neighbours, a point adds half of d times their distance.
fn shift(path: &Path<'_>, cuts: &[Cut], is_fixed: &[bool], points: &mut [Point], tolerance: f64) {
    let count = points.len();
    let lost: Vec<f64> = (0..count).map(|k| lost_area(path, cuts, points, k)).collect();
    let share = |edge: usize, other: usize| if is_fixed[other] { lost[edge] } else { 0.5 * lost[edge] };
    let old = points.to_vec();
    for k in (0..count).filter(|&k| !is_fixed[k]) {
        let (before, after) = ((k + count - 1) % count, (k + 1) % count);
        let along = minus(old[after], old[before]);
        let length = dot(along, along).sqrt();
        if length > 0.0 {
            let area = share(before, before) + share(k, after);
            let by = (2.0 * area / length).clamp(-0.5 * tolerance, 0.5 * tolerance) / length;
            points[k] = [old[k][0] + by * along[1], old[k][1] - by * along[0]];
        }
    }
}

/// Area between the contour and the edge after point `k`, positive where the edge cuts ink off.
fn lost_area(path: &Path<'_>, cuts: &[Cut], points: &[Point], k: usize) -> f64 {
    let next = (k + 1) % points.len();
    let (from, to) = piece(path, cuts, k);
    let mut ring = vec![points[k], path.at(from)];
    ring.extend(path.inside(from, to));
    ring.extend([path.at(to), points[next]]);
    0.5 * doubled_area(&ring)
}

/// From where to where along the contour the piece after cut `k` runs.
fn piece(path: &Path<'_>, cuts: &[Cut], k: usize) -> (f64, f64) {
    let length = path.length();
    let along = cuts[k].along;
    let from = if along >= length { along - length } else { along };
    let to = cuts.get(k + 1).map_or(cuts[0].along + length, |cut| cut.along) - (along - from);
    (from, if to > from { to } else { to + length })
}

/// The larger, for each edge, of the distance of the contour's points from it, and of its ends and middle from the
/// contour; each is sought only in the pieces that belong together, so it may be overestimated.
fn deviations(path: &Path<'_>, cuts: &[Cut], points: &[Point]) -> Vec<f64> {
    let count = points.len();
    let mut offs = vec![0.0_f64; count];
    // How far the two ends of each edge are from its piece of the contour.
    let mut ends = vec![[0.0_f64; 2]; count];
    let mut arc = Vec::new();
    for k in 0..count {
        let chord = [points[k], points[(k + 1) % count]];
        let (from, to) = piece(path, cuts, k);
        arc.clear();
        arc.push(path.at(from));
        arc.extend(path.inside(from, to));
        arc.push(path.at(to));
        let to_arc = |point: Point| {
            arc.windows(2).map(|pair| to_segment(point, [pair[0], pair[1]]).0).fold(f64::INFINITY, f64::min)
        };
        offs[k] = arc.iter().map(|&point| to_segment(point, chord).0).fold(to_arc(middle(chord)), f64::max);
        ends[k] = chord.map(to_arc);
    }
    for k in 0..count {
        let before = (k + count - 1) % count;
        offs[k] = offs[k].max(ends[k][0].min(ends[before][1]));
    }
    offs
}
