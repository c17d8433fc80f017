//! Triangles laid out in the plane as their sides say: the shape at rest of a piece of a body.

use super::body::{Area, Body};
use super::cluster::{Cluster, Common};
use super::pair::left;
use crate::sim::bond::lower_first;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Points that hang together by triangles, and where they are at rest `[m]`.
pub(super) type Shape<S> = (Vec<u32>, Vec<[S; 2]>);

/// The triangles of a body with what they are laid out by.
pub(super) struct Sheet<'a, S> {
    areas: &'a [Area<S>],
    /// Lengths at rest by ends, ascending `[m]`.
    lengths: Vec<([u32; 2], S)>,
    /// Triangles by their sides, ascending.
    sides: Vec<([u32; 2], u32)>,
    places: &'a [[S; 2]],
}

impl<'a, S: Real> Sheet<'a, S> {
    pub(super) fn new(state: &'a Cluster<S>, common: &'a Common<'a, S>, (body, base): (&Body<S>, usize)) -> Self {
        let areas = common.areas(body);
        let links = common.springs(body).iter().chain(common.holds(body));
        let mut lengths: Vec<([u32; 2], S)> = links.map(|link| (lower_first([link.a, link.b]), link.rest)).collect();
        lengths.sort_by_key(|entry| entry.0);
        let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * areas.len());
        for (area, k) in areas.iter().zip(0..) {
            let [a, b, c] = area.corners;
            sides.extend([[a, b], [b, c], [c, a]].map(|side| (lower_first(side), k)));
        }
        sides.sort_unstable();
        Sheet { areas, lengths, sides, places: &state.now[base..] }
    }

    /// The points within so many rings of triangles about some.
    pub(super) fn around(&self, points: &[bool], rings: u32) -> Vec<bool> {
        let mut points = points.to_vec();
        for _ in 0..rings {
            let mut wider = points.clone();
            for area in self.areas.iter().filter(|area| area.corners.iter().any(|&corner| points[corner as usize])) {
                area.corners.iter().for_each(|&corner| wider[corner as usize] = true);
            }
            if wider == points {
                break;
            }
            points = wider;
        }
        points
    }

    /// The shapes of the triangles all of whose corners are among some points.
    pub(super) fn shapes(&self, points: &[bool]) -> Vec<Shape<S>> {
        let is_wanted = |area: &Area<S>| area.corners.iter().all(|&corner| points[corner as usize]);
        let mut is_left: Vec<bool> = self.areas.iter().map(is_wanted).collect();
        let mut at: Vec<Option<[S; 2]>> = vec![None; points.len()];
        let mut shapes = Vec::new();
        for seed in 0..is_left.len() {
            if is_left[seed] {
                shapes.push(self.spread(seed, &mut is_left, &mut at));
            }
        }
        shapes
    }

    /// Lays out what hangs together with a triangle.
    fn spread(&self, seed: usize, is_left: &mut [bool], at: &mut [Option<[S; 2]>]) -> Shape<S> {
        let [a, b, _] = self.areas[seed].corners;
        let mut shape = (Vec::new(), Vec::new());
        let mut lay = |point: u32, x: [S; 2], at: &mut [Option<[S; 2]>]| {
            // A point that two pieces share goes with the first.
            if at[point as usize].is_none() {
                at[point as usize] = Some(x);
                shape.0.push(point);
                shape.1.push(x);
            }
        };
        let origin = at[a as usize].unwrap_or([S::ZERO; 2]);
        lay(a, origin, at);
        lay(b, add(origin, [self.length(a, b), S::ZERO]), at);
        is_left[seed] = false;
        let mut next = vec![seed];
        let mut done = 0;
        while let Some(&k) = next.get(done) {
            done += 1;
            let [a, b, c] = self.areas[k].corners;
            for [p, q, r] in [[a, b, c], [b, c, a], [c, a, b]] {
                if let (Some(x), Some(y), None) = (at[p as usize], at[q as usize], at[r as usize]) {
                    lay(r, self.third([x, y], [p, q, r], self.areas[k].rest), at);
                }
            }
            for side in [[a, b], [b, c], [c, a]].map(lower_first) {
                let start = self.sides.partition_point(|entry| entry.0 < side);
                for &(_, other) in self.sides[start..].iter().take_while(|entry| entry.0 == side) {
                    if std::mem::take(&mut is_left[other as usize]) {
                        next.push(other as usize);
                    }
                }
            }
        }
        shape
    }

    /// The third corner on the left of a side that lies at two places.
    fn third(&self, [x, y]: [[S; 2]; 2], [p, q, r]: [u32; 3], area: S) -> [S; 2] {
        let u = sub(y, x);
        let square = dot(u, u);
        if square == S::ZERO {
            return x;
        }
        let [from, to] = [self.length(p, r), self.length(q, r)];
        let along = S::HALF * (S::ONE + (from * from - to * to) / square);
        add(x, add(scale(u, along), scale(left(u), (area + area) / square)))
    }

    /// The length at rest of a side `[m]`; one without a bond has that of now.
    fn length(&self, a: u32, b: u32) -> S {
        let ends = lower_first([a, b]);
        let start = self.lengths.partition_point(|entry| entry.0 < ends);
        match self.lengths.get(start) {
            Some(entry) if entry.0 == ends => entry.1,
            _ => {
                let d = sub(self.places[a as usize], self.places[b as usize]);
                dot(d, d).sqrt()
            }
        }
    }
}
