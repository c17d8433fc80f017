//! Bodies of the plane that stand beside what is selected and that it would meet: their outlines, as obstacles that it keeps clear of.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use super::pick::{self, Scope, distance_to_sides};
use crate::picture::Tint;
use crate::sim::triangles::skin;
use crate::sim::{PointId, Polygon};

/// Triangles of a scene up to which other bodies are looked at.
const MOST: usize = 100_000;

/// The other bodies of a scene, each by what it covers; none where bodies pass through each other. Ropes cover nothing.
pub(super) struct Others<'a> {
    scope: Scope<'a>,
    bodies: Vec<Body>,
    /// What the points cover that others are looked for about.
    own: Vec<[u32; 3]>,
}

struct Body {
    /// The lower and the upper corner of the box around it `[m]`.
    around: [DVec2; 2],
    triangles: Vec<[u32; 3]>,
    /// It stands in the way of what was looked at.
    is_met: bool,
}

impl<'a> Others<'a> {
    /// Those that are not of some points, which are ascending, nor hang on them.
    pub(super) fn of(scope: Scope<'a>, points: &[PointId]) -> Self {
        let scenery = &scope.shown.scenery;
        let meets = scope.shown.settings.contact.flatten().is_some_and(|contact| contact.with_others);
        if !meets || scope.shown.dimensions != 2 || scenery.triangles.len() > MOST {
            return Others { scope, bodies: Vec::new(), own: Vec::new() };
        }
        let count = scope.shown.point_count();
        let pairs = scenery.bonds.ends().iter().copied().chain(scope.arms());
        let body = Tint::hanging(count, pairs.map(|ends| ends.map(|end| end.0)));
        let mut own: Vec<u32> = points.iter().filter_map(|point| body.get(point.index()).copied()).collect();
        own.sort_unstable();
        own.dedup();
        let mut covered = Vec::new();
        let mut of: BTreeMap<u32, Vec<[u32; 3]>> = BTreeMap::new();
        for corners in scenery.triangles.iter().filter(|corners| corners.iter().all(|&corner| scope.is_there(corner))) {
            let number = body[corners[0].index()];
            let list = if own.binary_search(&number).is_ok() { &mut covered } else { of.entry(number).or_default() };
            list.push(corners.map(|corner| corner.0));
        }
        let bodies = of.into_values().filter_map(|triangles| {
            let corners = triangles.iter().flatten().map(|&corner| at(scope, corner));
            Some(Body { around: around(corners)?, triangles, is_met: false })
        });
        Others { scope, bodies: bodies.collect(), own: covered }
    }

    /// Leaves out those in which one of these places, those of the points, lies deeper than so far `[m]`, or the other way round: who lies in
    /// something already is not put out of it.
    pub(super) fn leave_out(&mut self, places: &[[f64; 2]], deep: f64) {
        let Some(own) = around(places.iter().copied().map(DVec2::from)) else { return };
        if !self.bodies.iter().any(|body| meet(body.around, own)) {
            return;
        }
        let (scope, covered) = (self.scope, loops(self.scope, &self.own));
        let is_deep = |loops: &[Vec<[f64; 2]>], place: [f64; 2]| {
            pick::is_inside(loops, place) && distance_to_sides(place.into(), loops) > deep
        };
        self.bodies.retain(|body| {
            if !meet(body.around, own) {
                return true;
            }
            let loops = loops(scope, &body.triangles);
            let mut corners = loops.iter().flatten();
            !places.iter().any(|&place| is_deep(&loops, place)) && !corners.any(|&corner| is_deep(&covered, corner))
        });
    }

    /// Whether something at some places `[m]` is no further than its own size from others than those that are told already.
    pub(super) fn come_near(&mut self, places: &[[f64; 2]]) -> bool {
        let Some(own) = around(places.iter().copied().map(DVec2::from)) else { return false };
        let far = DVec2::splat((own[1] - own[0]).max_element());
        let own = [own[0] - far, own[1] + far];
        let mut is_new = false;
        for body in self.bodies.iter_mut().filter(|body| !body.is_met && meet(body.around, own)) {
            (body.is_met, is_new) = (true, true);
        }
        is_new
    }

    /// Whether one of those that something came near to lies wholly within what the points cover, once `place` has led that elsewhere.
    pub(super) fn lie_within(&self, place: impl Fn(DVec3) -> DVec3) -> bool {
        if !self.bodies.iter().any(|body| body.is_met) {
            return false;
        }
        let mut covered = loops(self.scope, &self.own);
        for corner in covered.iter_mut().flatten() {
            *corner = place(DVec2::from(*corner).extend(0.0)).truncate().to_array();
        }
        let first = |body: &Body| at(self.scope, body.triangles[0][0]).to_array();
        self.bodies.iter().filter(|body| body.is_met).any(|body| pick::is_inside(&covered, first(body)))
    }

    /// The outlines of all that something came near to.
    pub(super) fn outlines(&self) -> Vec<Polygon> {
        let outline = |body: &Body| {
            let loops = loops(self.scope, &body.triangles);
            (!loops.is_empty()).then_some(Polygon { loops, restitution: 0.0, friction: 0.0 })
        };
        self.bodies.iter().filter(|body| body.is_met).filter_map(outline).collect()
    }
}

/// Where what triangles cover ends `[m]`.
fn loops(scope: Scope<'_>, triangles: &[[u32; 3]]) -> Vec<Vec<[f64; 2]>> {
    let loops = closed(&skin(triangles, std::iter::empty()).closed).into_iter();
    loops.map(|corners| corners.into_iter().map(|corner| at(scope, corner).to_array()).collect()).collect()
}

/// The loops that sides make, each from a corner to the next; sides that lead nowhere are in none.
fn closed(sides: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    sides.iter().for_each(|&[from, to]| next.entry(from).or_default().push(to));
    let mut loops = Vec::new();
    while let Some((&first, _)) = next.first_key_value() {
        let (mut way, mut is_closed) = (vec![first], false);
        while let Some(to) = way.last().and_then(|at| next.get_mut(at)).and_then(Vec::pop) {
            is_closed = to == first;
            if is_closed {
                break;
            }
            way.push(to);
        }
        next.retain(|_, to| !to.is_empty());
        if is_closed && way.len() > 2 {
            loops.push(way);
        }
    }
    loops
}

fn at(scope: Scope<'_>, corner: u32) -> DVec2 {
    let [x, y, _] = scope.shown.place(corner as usize);
    DVec2::new(x, y)
}

/// The box around places; `None` of nothing, or where one is nowhere.
fn around(places: impl Iterator<Item = DVec2>) -> Option<[DVec2; 2]> {
    let all = places.fold(None, |all: Option<[DVec2; 2]>, at| {
        let at = if at.is_finite() { at } else { DVec2::NAN };
        Some(all.map_or([at; 2], |[low, high]| [low.min(at), high.max(at)]))
    });
    all.filter(|ends| ends.iter().all(|end| end.is_finite()))
}

fn meet([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    a.cmple(d).all() && c.cmple(b).all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_make_loops_and_what_leads_nowhere_is_in_none() {
        assert_eq!(closed(&[[0, 1], [1, 2], [2, 0]]), [[0, 1, 2]]);
        let two = closed(&[[0, 1], [1, 2], [2, 0], [5, 6], [6, 7], [7, 8], [8, 5]]);
        assert_eq!(two, [vec![0, 1, 2], vec![5, 6, 7, 8]]);
        // Two that touch in a corner.
        let mut touching = closed(&[[0, 1], [1, 2], [2, 0], [0, 3], [3, 4], [4, 0]]);
        touching.sort();
        assert_eq!(touching, [vec![0, 1, 2], vec![0, 3, 4]]);
        assert!(closed(&[[0, 1], [1, 2]]).is_empty());
    }
}
