//! What of the plane stands beside what is selected and ends somewhere: obstacles, and other bodies that it would meet, whose outlines it keeps clear
//! of too. Only what it comes near to is put together to walls, for that takes long.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use glam::{DVec2, DVec3};

use super::areas::{self, touch};
use super::pick::Scope;
use super::segments::{distance_to_sides, is_inside};
use super::skin;
use crate::picture::Tint;
use crate::sim::triangles::outer_sides;
use crate::sim::{PointId, Polygon};

/// Triangles of a scene up to which other bodies are looked at.
const MOST: usize = 100_000;
/// What comes so near to others than before, in its own size `[1]`, is near to all that are within the second of these: as far as it mostly goes to
/// find room among them.
const NEAR: f64 = 0.1;
const FAR: f64 = 1.25;

/// The other bodies of a scene, each by what it covers; none where bodies pass through each other. Ropes cover nothing.
#[derive(Default)]
pub(super) struct Others {
    bodies: Vec<Body>,
    /// Obstacles, which are there wherever one is.
    polygons: Vec<Standing>,
    /// What the points cover that others are looked for about.
    own: Patch,
    /// How often outlines were followed around.
    followed: u64,
}

struct Body {
    /// The lower and the upper corner of the box around it `[m]`.
    around: [DVec2; 2],
    patch: Patch,
    /// It stands in the way of what was looked at.
    is_met: bool,
}

/// An obstacle.
struct Standing {
    around: [DVec2; 2],
    polygon: Polygon,
    is_met: bool,
}

/// Triangles, and the corners of their outline, once they are asked for.
#[derive(Default)]
struct Patch {
    triangles: Vec<[u32; 3]>,
    loops: OnceLock<Vec<Vec<u32>>>,
}

impl Patch {
    fn of(triangles: Vec<[u32; 3]>) -> Self {
        Patch { triangles, loops: OnceLock::new() }
    }

    /// Where it ends `[m]`.
    fn outline(&self, scope: Scope<'_>) -> Vec<Vec<[f64; 2]>> {
        let sides = || outer_sides(self.triangles.iter().copied()).into_iter().map(|side| side.way);
        let loops = self.loops.get_or_init(|| skin::loops(sides()));
        loops.iter().map(|corners| corners.iter().map(|&corner| at(scope, corner).to_array()).collect()).collect()
    }
}

impl Others {
    /// Those that are not of some points, which are ascending, nor hang on them.
    pub(super) fn of(scope: Scope<'_>, points: &[PointId], polygons: Vec<Polygon>) -> Self {
        let scenery = &scope.shown.scenery;
        let standing = |polygon: Polygon| {
            let around = around(polygon.loops.iter().flatten().copied().map(DVec2::from))?;
            Some(Standing { around, polygon, is_met: false })
        };
        let polygons: Vec<Standing> = polygons.into_iter().filter_map(standing).collect();
        let meets = scope.shown.settings.contact.flatten().is_some_and(|contact| contact.with_others);
        if !meets || scope.shown.dimensions != 2 || scenery.triangles.len() > MOST {
            return Others { polygons, ..Others::default() };
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
            Some(Body { around: around(corners)?, patch: Patch::of(triangles), is_met: false })
        });
        Others { bodies: bodies.collect(), polygons, own: Patch::of(covered), followed: 0 }
    }

    /// Leaves out those in which one of these places, those of the points, lies deeper than so far `[m]`, or the other way round: who lies in
    /// something already is not put out of it.
    pub(super) fn leave_out(&mut self, scope: Scope<'_>, places: &[[f64; 2]], deep: f64) {
        let Some(own) = around(places.iter().copied().map(DVec2::from)) else { return };
        if !self.bodies.iter().any(|body| touch(body.around, own)) {
            return;
        }
        let covered = self.own.outline(scope);
        let is_deep = |loops: &[Vec<[f64; 2]>], place: [f64; 2]| {
            is_inside(loops, place) && distance_to_sides(place.into(), loops) > deep
        };
        self.bodies.retain(|body| {
            if !touch(body.around, own) {
                return true;
            }
            let loops = body.patch.outline(scope);
            let mut corners = loops.iter().flatten();
            !places.iter().any(|&place| is_deep(&loops, place)) && !corners.any(|&corner| is_deep(&covered, corner))
        });
    }

    /// Whether something at some places `[m]` came near to others than those that it was near to before: then it is near to those about it, and where
    /// it `goes_on` from there, as it looks for room, to those before too.
    pub(super) fn come_near(&mut self, places: &[[f64; 2]], goes_on: bool) -> bool {
        let Some(own) = around(places.iter().copied().map(DVec2::from)) else { return false };
        let far = (own[1] - own[0]).max_element();
        let within = |share: f64| [own[0] - share * far, own[1] + share * far];
        let is_new = |is_met: bool, there: [DVec2; 2]| !is_met && touch(there, within(NEAR));
        if !self.bodies.iter().any(|body| is_new(body.is_met, body.around))
            && !self.polygons.iter().any(|standing| is_new(standing.is_met, standing.around))
        {
            return false;
        }
        let is_near = |is_met: bool, there: [DVec2; 2]| goes_on && is_met || touch(there, within(FAR));
        self.bodies.iter_mut().for_each(|body| body.is_met = is_near(body.is_met, body.around));
        self.polygons.iter_mut().for_each(|standing| standing.is_met = is_near(standing.is_met, standing.around));
        true
    }

    /// Whether it is near to a body.
    pub(super) fn meet_any(&self) -> bool {
        self.bodies.iter().any(|body| body.is_met)
    }

    /// Whether one of those that something came near to lies wholly within what the points cover, once `place` has led that elsewhere.
    pub(super) fn lie_within(&self, scope: Scope<'_>, place: impl Fn(DVec3) -> DVec3) -> bool {
        if !self.bodies.iter().any(|body| body.is_met) {
            return false;
        }
        let mut covered = self.own.outline(scope);
        for corner in covered.iter_mut().flatten() {
            *corner = place(DVec2::from(*corner).extend(0.0)).truncate().to_array();
        }
        let first = |body: &Body| at(scope, body.patch.triangles[0][0]).to_array();
        self.bodies.iter().filter(|body| body.is_met).any(|body| is_inside(&covered, first(body)))
    }

    /// The outlines of all that something is near to, obstacles first.
    pub(super) fn outlines(&mut self, scope: Scope<'_>) -> Vec<Polygon> {
        let outline = |body: &Body| {
            let loops = body.patch.outline(scope);
            (!loops.is_empty()).then_some(Polygon { loops, restitution: 0.0, friction: 0.0 })
        };
        let outlines: Vec<Polygon> = self.bodies.iter().filter(|body| body.is_met).filter_map(outline).collect();
        self.followed += outlines.len() as u64;
        let near = self.polygons.iter().filter(|standing| standing.is_met).map(|standing| standing.polygon.clone());
        near.chain(outlines).collect()
    }

    /// How many outlines were made of it until now: what a drag costs beside its own points.
    #[cfg(test)]
    pub(super) fn followed(&self) -> u64 {
        self.followed
    }
}

fn at(scope: Scope<'_>, corner: u32) -> DVec2 {
    let [x, y, _] = scope.shown.place(corner as usize);
    DVec2::new(x, y)
}

/// The box around places; `None` of nothing, or where one is nowhere.
fn around(places: impl Iterator<Item = DVec2>) -> Option<[DVec2; 2]> {
    let mut is_somewhere = true;
    let all = areas::around(places.inspect(|at| is_somewhere &= at.is_finite()));
    all.filter(|_| is_somewhere)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_that_is_nowhere_leaves_no_box_wherever_it_stands_in_the_list() {
        let [here, there, nowhere] = [DVec2::ZERO, DVec2::ONE, DVec2::new(f64::NAN, 1.0)];
        assert_eq!(around([there, here].into_iter()), Some([here, there]));
        for list in [[nowhere, here, there], [here, nowhere, there], [here, there, nowhere]] {
            assert_eq!(around(list.into_iter()), None);
        }
        assert_eq!(around(std::iter::empty()), None);
    }
}
