//! What is told of bodies that start in each other.

use super::World;
use crate::sim::bond::PointId;
use crate::sim::real::Real;
use crate::sim::vector::{cross, sub};

/// Points against triangles that are looked at: of scenes with more in one place nothing is told.
const MOST_LOOKS: usize = 4_000_000;

/// A triangle with its body, from its leftmost to its rightmost corner.
struct Patch {
    corners: [[f64; 2]; 3],
    body: u32,
    left: f64,
    right: f64,
}

impl<S: Real, const D: usize> World<S, D> {
    /// Tells of bodies of a plane in which bodies meet that have a point in another one at these places [m].
    pub(super) fn warn_of_nested(&mut self, position: &[[f64; D]]) {
        let meets = self.model.contact.is_some_and(|contact| contact.with_others);
        if D != 2 || !meets || self.model.triangles.is_empty() {
            return;
        }
        let place = |point: usize| [position[point][0], position[point][1]];
        let mut bodies = self.bonded();
        let patch = |triangle: &[PointId; 3]| {
            let corners = triangle.map(|corner| place(corner.index()));
            let [a, b, c] = corners.map(|corner| corner[0]);
            Patch { corners, body: bodies.find(triangle[0].0), left: a.min(b).min(c), right: a.max(b).max(c) }
        };
        let mut patches: Vec<Patch> = self.model.triangles.iter().map(patch).collect();
        patches.sort_by(|a, b| a.left.total_cmp(&b.left));
        let mut points: Vec<usize> = (0..position.len()).collect();
        points.sort_by(|&a, &b| place(a)[0].total_cmp(&place(b)[0]));
        let (mut open, mut next, mut looks): (Vec<usize>, usize, usize) = (Vec::new(), 0, 0);
        let mut found: Vec<u32> = Vec::new();
        for point in points {
            let (x, own) = (place(point), bodies.find(point as u32));
            while patches.get(next).is_some_and(|patch| patch.left <= x[0]) {
                open.push(next);
                next += 1;
            }
            open.retain(|&k| patches[k].right >= x[0]);
            looks += open.len();
            if looks > MOST_LOOKS {
                return;
            }
            let inside = open.iter().map(|&k| &patches[k]).filter(|patch| patch.body != own && patch.holds(x));
            let others: Vec<u32> = inside.map(|patch| patch.body).collect();
            if !others.is_empty() {
                found.push(own);
                found.extend(others);
            }
        }
        found.sort_unstable();
        found.dedup();
        if !found.is_empty() {
            self.warnings.push(format!("{} bodies start in each other: they are parted, slowly", found.len()));
        }
    }
}

impl Patch {
    /// Whether a place is within it, its sides apart.
    fn holds(&self, x: [f64; 2]) -> bool {
        let [a, b, c] = self.corners;
        let turns = [(a, b), (b, c), (c, a)].map(|(from, to)| cross(sub(to, from), sub(x, from)));
        turns.iter().all(|&turn| turn > 0.0) || turns.iter().all(|&turn| turn < 0.0)
    }
}
