//! What stands about something that is led about with the pointer: looked at once for all places that it is led to, until something else is led, or
//! something moved.

use std::sync::{Mutex, OnceLock, PoisonError};

use glam::DVec3;

use super::chosen::Chosen;
use super::others::Others;
use super::pick::Scope;
use super::room::Walls;
use crate::sim::triangles::outer_sides;
use crate::sim::vector::truncate;
use crate::sim::{Bond, Bonds, PointId};

/// Of more points those alone are looked at that lie on the rim of what they cover.
const MOST: usize = 4_000;

/// What was found last, kept beside the scenery that it is of.
#[derive(Default)]
pub(in crate::app) struct Kept(Mutex<Last>);

#[derive(Default)]
struct Last {
    found: Option<Found>,
    /// How often it was looked.
    looks: u64,
}

struct Found {
    chosen: Chosen,
    /// Positions are those of this number.
    motion: u64,
    /// The longest way that is none `[m]`.
    least: f64,
    standing: Standing,
}

impl Clone for Kept {
    /// What is kept is of one alone.
    fn clone(&self) -> Self {
        Kept::default()
    }
}

impl std::fmt::Debug for Kept {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        to.write_str("Kept")
    }
}

impl Kept {
    /// Looks at what stands about what is selected, unless that is known.
    pub(super) fn with<T>(
        &self,
        scope: Scope<'_>,
        (chosen, least): (&Chosen, f64),
        see: impl FnOnce(&mut Standing) -> T,
    ) -> T {
        let mut last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let motion = scope.shown.motion;
        let is_known = |found: &Found| found.motion == motion && found.least == least && found.chosen == *chosen;
        if !last.found.as_ref().is_some_and(is_known) {
            last.looks += 1;
            let standing = Standing::of(scope, chosen, least);
            last.found = Some(Found { chosen: chosen.clone(), motion, least, standing });
        }
        let Some(found) = &mut last.found else { return see(&mut Standing::of(scope, chosen, least)) };
        see(&mut found.standing)
    }

    /// How often it was looked, and how many outlines were made of what was found last.
    #[cfg(test)]
    pub(in crate::app) fn work(&self) -> [u64; 2] {
        let last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let outlines = match &last.found {
            Some(Found { standing: Standing::Plane(plane), .. }) => plane.others.followed(),
            _ => 0,
        };
        [last.looks, outlines]
    }
}

/// What is led, and what stands about it.
pub(super) enum Standing {
    /// Nothing is led that could lie in something.
    Nothing,
    Plane(Box<Plane>),
    Space(Box<Led<3>>),
}

/// What is led.
pub(super) struct Led<const D: usize> {
    /// The points that are looked at, ascending, and where they are `[m]`.
    pub(super) points: Vec<PointId>,
    pub(super) places: Vec<[f64; D]>,
    /// The bonds between them.
    pub(super) bonds: Bonds,
    /// What never moves.
    pub(super) still: Walls<D>,
    /// Whether it lies in something already, deeper than what is none.
    is_in: OnceLock<bool>,
}

/// The same in the plane.
pub(super) struct Plane {
    pub(super) led: Led<2>,
    /// Not all of its points are looked at.
    pub(super) is_rim: bool,
    planes: Vec<[[f64; 3]; 2]>,
    pub(super) others: Others,
    /// What never moves; where it is near to bodies what of that is near, and their outlines.
    walls: Walls,
}

impl Standing {
    fn of(scope: Scope<'_>, chosen: &Chosen, least: f64) -> Self {
        let scenery = &scope.shown.scenery;
        let points: Vec<PointId> = chosen.points.iter().copied().filter(|&point| scope.is_there(point)).collect();
        if points.is_empty() {
            return Standing::Nothing;
        }
        let is_left = |of: &[u32], k: usize| of.get(k).is_none_or(|number| !chosen.obstacles.contains(number));
        let planes = scenery.planes.iter().enumerate().filter(|(k, _)| is_left(&scenery.plane_numbers, *k));
        let planes: Vec<_> = planes.map(|(_, plane)| *plane).collect();
        if scope.shown.dimensions == 2 {
            let polygons = scenery.polygons.iter().enumerate().filter(|(k, _)| is_left(&scenery.solid_numbers, *k));
            let polygons: Vec<_> = polygons.map(|(_, polygon)| polygon.clone()).collect();
            let still = match chosen.obstacles.is_empty() {
                true => scenery.walls().clone(),
                false => Walls::of(scenery.bounds, &planes, polygons.clone()),
            };
            let mut others = Others::of(scope, &points, polygons);
            let count = points.len();
            let led = Led::of(scope, outer(scope, points), still);
            others.leave_out(scope, &led.places, least);
            let (is_rim, walls) = (led.points.len() < count, led.still.clone());
            return Standing::Plane(Box::new(Plane { led, is_rim, planes, others, walls }));
        }
        let convex = scenery.convex.iter().enumerate().filter(|(k, _)| is_left(&scenery.solid_numbers, *k));
        let convex = convex.map(|(_, convex)| *convex).collect();
        let walls = Walls::<3>::all(scenery.bounds, &planes, (Vec::new(), convex));
        Standing::Space(Box::new(Led::of(scope, points, walls)))
    }
}

impl<const D: usize> Led<D> {
    fn of(scope: Scope<'_>, points: Vec<PointId>, still: Walls<D>) -> Self {
        let number = |point: PointId| points.binary_search(&point).ok().map(|k| PointId(k as u32));
        let within = |ends: &[PointId; 2]| Some(Bond::new(number(ends[0])?, number(ends[1])?, 1.0));
        let bonds = scope.shown.scenery.bonds.ends().iter().filter_map(within).collect();
        let places = points.iter().map(|point| truncate(scope.shown.place(point.index()))).collect();
        Led { points, places, bonds, still, is_in: OnceLock::new() }
    }

    /// Whether it lies in what never moves, deeper than so far `[m]`: then it is not put out of that.
    pub(super) fn lies_in_something(&self, least: f64) -> bool {
        *self.is_in.get_or_init(|| {
            let was = self.still.clear(&self.places, &self.bonds, &[]);
            !was.stuck.is_empty() || was.furthest() > least
        })
    }

    /// Its places once `place` has led it elsewhere `[m]`.
    pub(super) fn led(&self, place: impl Fn(DVec3) -> DVec3) -> Vec<[f64; D]> {
        let there = |at: &[f64; D]| {
            let mut all = [0.0; 3];
            all[..D].copy_from_slice(at);
            truncate(place(DVec3::from(all)).to_array())
        };
        self.places.iter().map(there).collect()
    }
}

impl Plane {
    /// What stands about it at some places `[m]`, to which it may go on from others as it looks for room.
    pub(super) fn around(&mut self, scope: Scope<'_>, (places, goes_on): (&[[f64; 2]], bool)) -> Walls {
        if self.others.come_near(places, goes_on) {
            // Outlines that cross themselves too often are none.
            self.walls = match self.others.meet_any() {
                true => Walls::of(scope.shown.scenery.bounds, &self.planes, self.others.outlines(scope)),
                false => self.led.still.clone(),
            }
            .or(&self.led.still);
        }
        self.walls.clone()
    }
}

/// The points that are looked at of many: those on the rim of what they cover, and those that cover nothing.
fn outer(scope: Scope<'_>, points: Vec<PointId>) -> Vec<PointId> {
    if points.len() <= MOST {
        return points;
    }
    let mut is_own = vec![false; scope.shown.point_count()];
    points.iter().for_each(|point| is_own[point.index()] = true);
    let own = scope.shown.scenery.triangles.iter().filter(|corners| corners.iter().all(|at| is_own[at.index()]));
    let own: Vec<[u32; 3]> = own.map(|corners| corners.map(|corner| corner.0)).collect();
    let mut is_looked_at = is_own;
    own.iter().flatten().for_each(|&corner| is_looked_at[corner as usize] = false);
    outer_sides(own).into_iter().flat_map(|side| side.ends).for_each(|end| is_looked_at[end as usize] = true);
    points.into_iter().filter(|point| is_looked_at[point.index()]).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use glam::DVec2;

    use super::super::tests::{scope, shown};
    use super::super::{Chosen, Hand};
    use crate::app::action::Tool;
    use crate::scene::Scene;

    /// Soft boxes of a hundred points in rows, 20 m wide, and a wall of polygons above them.
    fn boxes(count: usize) -> String {
        let body = |k: usize| {
            let (x, y) = (1.9 * (k % 10) as f64, 1.9 * (k / 10) as f64);
            format!(
                r#"{{"make": "lattice", "columns": 10, "rows": 10, "spacing": 0.16, "origin": [{x}, {y}],
                    "material": {{"kind": "spring", "stiffness": 900, "damping": 5, "mass": 2}}}}"#
            )
        };
        let block = |k: usize| format!(r#"{{"box": {{"min": [{k}, 16], "max": [{k}.5, 17]}}}}"#);
        let bodies: Vec<String> = (0..count).map(body).collect();
        let blocks: Vec<String> = (0..20).map(block).collect();
        format!(
            r#"{{"wobble": 1, "contact": true, "view": {{"center": [9, 7], "height": 22}}, "obstacles": [{}], "bodies": [{}]}}"#,
            blocks.join(", "),
            bodies.join(", ")
        )
    }

    #[test]
    fn what_stands_still_is_looked_at_once_for_a_drag() {
        for count in [10, 60] {
            let seen = shown(Scene::parse(&boxes(count), "x.json").unwrap());
            let at = |x: f64, y: f64| DVec2::from(seen.1.screen_from_world([x, y, 0.0].into()).unwrap());
            let from = at(0.7, 0.7);
            let mut hand = Hand::default();
            hand.take(Tool::Select);
            hand.stand_still(true);
            hand.select(Chosen::at(scope(&seen), from).unwrap());
            assert!(hand.press(scope(&seen), from).is_empty());
            for event in 0..100 {
                let to = from.lerp(at(17.0, 12.0), f64::from(event) / 99.0);
                assert!(!hand.marks(scope(&seen), Some(to)).is_empty());
            }
            let [looks, outlines] = seen.0.scenery.about_led.work();
            assert_eq!(looks, 1, "{count}");
            // About twenty stand about it at a time: they are put together a few times on a way fourteen times as long as the body.
            assert!(outlines > 0 && outlines < 600, "{count}: {outlines} outlines in a hundred events");
            hand.release(scope(&seen), from);
            let other = Chosen::at(scope(&seen), at(2.6, 0.7)).unwrap();
            hand.select(other);
            assert!(hand.press(scope(&seen), at(2.6, 0.7)).is_empty());
            hand.marks(scope(&seen), Some(at(3.6, 0.9)));
            assert_eq!(seen.0.scenery.about_led.work()[0], 2, "something else is led");
        }
    }
}
