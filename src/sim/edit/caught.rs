//! Whether bodies that obstacles push have room: what is caught, crushed, or pushed into another.

use super::crowd::{Before, Crowd, Hanging, was};
use super::push::Part;
use crate::sim::force::area;
use crate::sim::triangles::holds;
use crate::sim::vector::{length, sub};

/// A bond is pressed together to this share of its length at most, a triangle to this share of its area.
const CRUSHED: f64 = 0.4;
/// A held bond of what has limbs is changed by this share of its length at most.
const STRAINED: f64 = 0.02;
/// What gets shorter by less than this share does not get shorter.
const LESS: f64 = 1e-6;

impl<const D: usize> Crowd<D> {
    /// Whether obstacles came to be around something of a body, or deeper in it.
    pub(super) fn is_caught(&self, body: &Hanging, before: &[Before<D>], part: &Part<'_, D>) -> bool {
        let is_caught = |was: &Before<D>| match self.w[was.i] > 0.0 {
            true => !part.is_free(self.x[was.i], was.depth),
            false => was.depth == 0.0 && part.holds(self.x[was.i]),
        };
        let is_free = |i: usize| self.w[i] > 0.0;
        let was = |i: usize| was(before, i).map_or(self.x[i], |was| was.x);
        // What they went through already goes along with them.
        let goes_along = |i: usize| length(sub(self.x[i], was(i))) >= 0.5 * length(part.way(was(i)));
        let is_pierced = |ends: [usize; 2]| {
            let (now, before) = (ends.map(|end| self.x[end]), ends.map(was));
            let is_stopped = before != now && part.stops(now) && !part.stops(before);
            let went_along = || part.was_pierced(before) && ends.into_iter().filter(|&i| is_free(i)).all(goes_along);
            is_stopped || (part.pierced(now).is_some() && !went_along())
        };
        let mut bonds = body.bonds.iter().filter(|ends| ends.iter().any(|&end| is_free(end)));
        before.iter().any(is_caught) || bonds.any(|&ends| is_pierced(ends))
    }

    /// The body that one was pushed into, or over its points.
    pub(super) fn entered(&self, bodies: &[Hanging], number: usize, before: &[Before<D>]) -> Option<usize> {
        let own = &bodies[number];
        if D != 2 || !self.meets || own.triangles.is_empty() {
            return None;
        }
        let around = self.extent(own)?;
        let was = |i: usize| was(before, i).map_or(self.x[i], |was| was.x);
        let now = |i: usize| self.x[i];
        let lies = |x: [f64; D], [low, high]: [[f64; D]; 2]| (0..D).all(|k| low[k] <= x[k] && x[k] <= high[k]);
        let others = bodies.iter().enumerate().filter(|(other, body)| *other != number && !body.triangles.is_empty());
        let mut others = others.filter(|(_, other)| {
            let Some(beside) = self
                .extent(other)
                .filter(|reach| (0..D).all(|k| reach[0][k] <= around[1][k] && around[0][k] <= reach[1][k]))
            else {
                return false;
            };
            let comes = |body: &Hanging, i: usize| {
                covers(&body.triangles, now, now(i)) && !covers(&body.triangles, was, was(i))
            };
            own.points.iter().any(|&i| lies(now(i), beside) && comes(other, i))
                || other.points.iter().any(|&i| lies(now(i), around) && comes(own, i))
        });
        others.next().map(|(other, _)| other)
    }

    /// Whether bonds or triangles are pressed together to less than [`CRUSHED`] of what they are at rest, and were larger before.
    pub(super) fn is_crushed(&self, body: &Hanging, before: &[Before<D>]) -> bool {
        let was = |i: usize| was(before, i).map(|was| was.x);
        // Limbs are of the plane: in space what has triangles is a sheet, which folds.
        let has_limbs = D == 2 && !body.triangles.is_empty();
        body.bonds.iter().zip(&body.rests).any(|(&ends, &(rest, is_held))| {
            let now = length(sub(self.x[ends[1]], self.x[ends[0]]));
            let [Some(a), Some(b)] = ends.map(was) else { return false };
            let before = length(sub(b, a));
            let is_pressed = now < CRUSHED * rest && now < (1.0 - LESS) * before;
            let error = |length: f64| (length - rest).abs();
            is_pressed
                || (is_held && has_limbs && error(now) > STRAINED * rest && error(now) > error(before) + LESS * rest)
        }) || body.triangles.iter().zip(&body.areas).any(|(&corners, &rest)| {
            let now = area::size(corners.map(|corner| self.x[corner]));
            now < CRUSHED * rest
                && matches!(corners.map(was), [Some(a), Some(b), Some(c)] if now < area::size([a, b, c]) - LESS * rest)
        })
    }
}

/// Whether triangles cover a place, with their corners at `place` `[m]`.
fn covers<const D: usize>(triangles: &[[usize; 3]], place: impl Fn(usize) -> [f64; D], x: [f64; D]) -> bool {
    triangles.iter().any(|corners| holds(corners.map(&place), x))
}
