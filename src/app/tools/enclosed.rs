//! Obstacles that a body which is drawn would have within itself: there is no room for them, so it goes beside them.

use std::f64::consts::TAU;

use glam::DVec2;

use super::areas::{around, is_in, is_within, overlap};
use super::pick::Scope;
use super::room::here;
use crate::scene::Shape;
use crate::sim::{Polygon, segments_pass};

/// Directions in which a way is looked for, and steps along each, as far as the body and the obstacles are long together.
const DIRECTIONS: u32 = 24;
const STEPS: u32 = 32;
/// What a body stands on has at least this share of its width `[1]`: on less it would balance.
const STANDS: f64 = 0.5;
/// Halvings of the last step to where the way ends.
const HALVINGS: u32 = 10;

/// What a body covers.
pub(super) struct Cover {
    triangles: Vec<[DVec2; 3]>,
    around: [DVec2; 2],
}

impl Cover {
    /// Of what comes; `None`: it covers nothing.
    pub(super) fn of(shape: &Shape) -> Option<Self> {
        let at = |corner: u32| shape.places.get(corner as usize).copied().map(DVec2::from);
        let triangles: Vec<[DVec2; 3]> =
            shape.triangles.iter().filter_map(|&[a, b, c]| Some([at(a)?, at(b)?, at(c)?])).collect();
        let around = around(triangles.iter().flatten().copied())?;
        Some(Cover { triangles, around })
    }

    /// The obstacles of which something lies within it once it is `by` `[m]` further: what only touches it does not.
    fn encloses<'a>(&'a self, polygons: &'a [Polygon], by: DVec2) -> impl Iterator<Item = &'a Polygon> {
        polygons.iter().filter(move |polygon| {
            let corners = polygon.loops.iter().flatten().map(|&corner| DVec2::from(corner) - by);
            around(corners).is_some_and(|there| overlap(there, self.around)) && self.has(polygon, by)
        })
    }

    fn has(&self, polygon: &Polygon, by: DVec2) -> bool {
        let sides = polygon.loops.iter().flat_map(|corners| corners.iter().zip(corners.iter().cycle().skip(1)));
        let mut sides = sides.map(|(&from, &to)| [from, to].map(|end| DVec2::from(end) - by));
        sides.any(|[from, to]| {
            let side = [from.min(to), from.max(to)];
            overlap(side, self.around)
                && self.triangles.iter().any(|corners @ &[a, b, c]| {
                    let own = [a.min(b).min(c), a.max(b).max(c)];
                    let crosses =
                        |[p, q]: [DVec2; 2]| segments_pass([from, to].map(Into::into), [p, q].map(Into::into));
                    overlap(side, own)
                        && (is_within(*corners, from) || [[a, b], [b, c], [c, a]].into_iter().any(crosses))
                })
        })
    }

    /// Whether it covers a place, or ends there.
    pub(super) fn holds(&self, place: DVec2) -> bool {
        self.triangles.iter().any(|corners| is_in(*corners, place))
    }

    /// Whether it has some of them within itself.
    pub(super) fn has_any(&self, polygons: &[Polygon], by: DVec2) -> bool {
        self.encloses(polygons, by).next().is_some()
    }

    /// Whether it lies over another body once it is `by` `[m]` further: whether a corner of one lies within a triangle of the other.
    pub(super) fn lies_over(&self, scope: Scope<'_>, by: DVec2) -> bool {
        let [low, high] = self.around.map(|end| end + by);
        scope.shown.scenery.triangles.iter().any(|corners| {
            let there = corners.map(|corner| here(scope, corner));
            let [a, b, c] = there;
            let is_near = overlap([a.min(b).min(c), a.max(b).max(c)], [low, high]);
            let has =
                |of: &[DVec2; 3], by: DVec2, corners: &[DVec2; 3]| corners.iter().any(|&at| is_within(*of, at + by));
            is_near && self.triangles.iter().any(|own| has(own, -by, &there) || has(&there, by, own))
        })
    }

    /// Whether it would stand on what lies in a box `[m]` as on a needle: its middle is above that, and that is narrow.
    fn is_balanced(&self, there: [DVec2; 2], up: DVec2) -> bool {
        let side = up.perp();
        let along = |ends: [DVec2; 2], axis: DVec2| {
            let [a, b] = ends.map(|end| end.dot(axis));
            // The extent of a box along any direction.
            let (middle, half) = (0.5 * (a + b), 0.5 * (ends[1] - ends[0]).abs().dot(axis.abs()));
            [middle - half, middle + half]
        };
        let ([left, right], own) = (along(there, side), along(self.around, side));
        let middle = 0.5 * (own[0] + own[1]);
        let is_above = along(self.around, up)[0] > 0.5 * (along(there, up)[0] + along(there, up)[1]);
        up != DVec2::ZERO && is_above && (left..=right).contains(&middle) && right - left < STANDS * (own[1] - own[0])
    }

    /// The shortest way on that is found from `from` `[m]` to where it has none of them within itself, stands on none that is too narrow for it
    /// (`up` is against gravity), and `is_free`.
    pub(super) fn way_off(
        &self,
        polygons: &[Polygon],
        (from, up): (DVec2, DVec2),
        is_free: impl Fn(DVec2) -> bool,
    ) -> Option<DVec2> {
        let within = self.encloses(polygons, from).flat_map(|polygon| polygon.loops.iter().flatten());
        let [low, high] = around(within.map(|&corner| DVec2::from(corner)))?;
        let step = (low.distance(high) + self.around[0].distance(self.around[1])) / f64::from(STEPS);
        let is_balanced = |by: DVec2| self.is_balanced([low - by, high - by], up);
        let has_room = |by: DVec2| !self.has_any(polygons, by) && !is_balanced(by) && is_free(by);
        // Upwards first: of two ways that are equally long that one is taken.
        let direction = |k: u32| DVec2::Y.rotate(DVec2::from_angle(TAU * f64::from(k) / f64::from(DIRECTIONS)));
        for k in 1..=STEPS {
            for direction in (0..DIRECTIONS).map(direction) {
                let along = |far: f64| from + step * far * direction;
                if !has_room(along(f64::from(k))) {
                    continue;
                }
                let [mut short, mut far] = [f64::from(k - 1), f64::from(k)];
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (short + far);
                    *(if has_room(along(middle)) { &mut far } else { &mut short }) = middle;
                }
                return Some(along(far));
            }
        }
        None
    }
}
