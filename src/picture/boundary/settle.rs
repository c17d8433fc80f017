//! Points of a polygon shifted across their contour, so that it keeps its area.

use super::super::plane::{Point, dot, doubled_area, minus, to_segment};
use super::crossing::middle;
use super::path::Path;
use super::sample::Cut;

/// Rounds of shifting points to keep the area: each leaves about a tenth of the error.
const SHIFTS: usize = 3;

/// How many points to both sides of a point feel where it is, or whether it may move: one a round of shifting, and two more
/// to the edges whose distance from the contour is measured.
const FELT: usize = SHIFTS + 2;

/// What is known of a polygon while it settles.
///
/// Shapes: one entry a point in each list.
struct Settling<'a> {
    path: &'a Path<'a>,
    cuts: &'a [Cut],
    is_fixed: Vec<bool>,
    /// Places before any round of shifting, and after each.
    rounds: [Vec<Point>; SHIFTS + 1],
    /// How far the two ends of the edge after each point are from its piece of the contour `[px]`.
    ends: Vec<[f64; 2]>,
    /// How far that edge is from it `[px]`.
    offs: Vec<f64>,
}

/// The settled points, and the largest distance between polygon and contour `[px]`.
///
/// Points move across the contour to bring back the area that edges cut off; those at edges that get too far off go back,
/// and at last onto the contour. Each time only what feels the change is done anew: a long contour has a few such edges
/// for many rounds.
pub(super) fn settled(path: &Path<'_>, cuts: &[Cut], tolerance: f64) -> (Vec<Point>, f64) {
    let count = cuts.len();
    let placed: Vec<Point> = cuts.iter().map(|cut| cut.place).collect();
    let mut polygon = Settling {
        path,
        cuts,
        is_fixed: cuts.iter().map(|cut| cut.is_corner).collect(),
        rounds: std::array::from_fn(|_| placed.clone()),
        ends: vec![[0.0; 2]; count],
        offs: vec![0.0; count],
    };
    let mut at: Vec<usize> = (0..count).collect();
    loop {
        polygon.shift(&at, tolerance);
        polygon.measure(&at);
        let changed = polygon.draw_back(&at, tolerance);
        if changed.is_empty() {
            let [.., points] = polygon.rounds;
            return (points, polygon.offs.into_iter().fold(0.0, f64::max));
        }
        at = around(&changed, count);
    }
}

/// The points that feel a change of some, in order, each once.
fn around(changed: &[usize], count: usize) -> Vec<usize> {
    let near = |&k: &usize| (0..=2 * FELT).map(move |step| (k + FELT * count + step - FELT) % count);
    let mut all: Vec<usize> = changed.iter().flat_map(near).collect();
    all.sort_unstable();
    all.dedup();
    all
}

impl Settling<'_> {
    /// Moves these points that are not fixed across the contour, to bring back the area that the edges beside them cut off.
    ///
    /// Model: moved by d across the line between its neighbours, a point adds half of d times their distance.
    fn shift(&mut self, at: &[usize], tolerance: f64) {
        let count = self.cuts.len();
        for round in 0..SHIFTS {
            // The area is lost at the edges after these points and before them.
            let mut lost = (usize::MAX, 0.0);
            for &k in at {
                let (before, after) = ((k + count - 1) % count, (k + 1) % count);
                let old = &self.rounds[round];
                let lost_before = if lost.0 == before { lost.1 } else { self.lost_area(old, before) };
                lost = (k, self.lost_area(old, k));
                self.rounds[round + 1][k] = self.rounds[round][k];
                if self.is_fixed[k] {
                    continue;
                }
                let old = &self.rounds[round];
                let share = |area: f64, other: usize| if self.is_fixed[other] { area } else { 0.5 * area };
                let along = minus(old[after], old[before]);
                let length = dot(along, along).sqrt();
                if length > 0.0 {
                    let area = share(lost_before, before) + share(lost.1, after);
                    let by = (2.0 * area / length).clamp(-0.5 * tolerance, 0.5 * tolerance) / length;
                    let [x, y] = old[k];
                    self.rounds[round + 1][k] = [x + by * along[1], y - by * along[0]];
                }
            }
        }
    }

    /// Area between the contour and the edge after point `k`, positive where the edge cuts ink off.
    fn lost_area(&self, points: &[Point], k: usize) -> f64 {
        let next = (k + 1) % points.len();
        let (from, to) = self.piece(k);
        let mut ring = vec![points[k], self.path.at(from)];
        ring.extend(self.path.inside(from, to));
        ring.extend([self.path.at(to), points[next]]);
        0.5 * doubled_area(&ring)
    }

    /// From where to where along the contour the piece after cut `k` runs.
    fn piece(&self, k: usize) -> (f64, f64) {
        let length = self.path.length();
        let along = self.cuts[k].along;
        let from = if along >= length { along - length } else { along };
        let to = self.cuts.get(k + 1).map_or(self.cuts[0].along + length, |cut| cut.along) - (along - from);
        (from, if to > from { to } else { to + length })
    }

    /// Measures, for the edge after each of these points, the larger of the distance of the contour's points from it, and of
    /// its ends and middle from the contour; each is sought only in the pieces that belong together, so it may be
    /// overestimated.
    fn measure(&mut self, at: &[usize]) {
        let count = self.cuts.len();
        let mut arc = Vec::new();
        for &k in at {
            let points = &self.rounds[SHIFTS];
            let chord = [points[k], points[(k + 1) % count]];
            let (from, to) = self.piece(k);
            arc.clear();
            arc.push(self.path.at(from));
            arc.extend(self.path.inside(from, to));
            arc.push(self.path.at(to));
            let to_arc = |point: Point| {
                arc.windows(2).map(|pair| to_segment(point, [pair[0], pair[1]]).0).fold(f64::INFINITY, f64::min)
            };
            self.offs[k] = arc.iter().map(|&point| to_segment(point, chord).0).fold(to_arc(middle(chord)), f64::max);
            self.ends[k] = chord.map(to_arc);
        }
        for &k in at {
            let before = (k + count - 1) % count;
            self.offs[k] = self.offs[k].max(self.ends[k][0].min(self.ends[before][1]));
        }
    }

    /// Takes points back at edges that are too far off: first from their shift, then onto the contour. Returns them.
    fn draw_back(&mut self, at: &[usize], tolerance: f64) -> Vec<usize> {
        let count = self.cuts.len();
        let ends = at.iter().filter(|&&k| self.offs[k] > tolerance).flat_map(|&k| [k, (k + 1) % count]);
        let mut ends: Vec<usize> = ends.collect();
        ends.sort_unstable();
        ends.dedup();
        ends.retain(|&end| {
            if !self.is_fixed[end] {
                self.is_fixed[end] = true;
                return true;
            }
            let on_contour = self.path.at(self.cuts[end].along);
            let is_new = self.rounds[0][end] != on_contour;
            self.rounds[0][end] = on_contour;
            is_new
        });
        ends
    }
}
