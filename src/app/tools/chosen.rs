//! Points and obstacles that are selected: what a click, a box or a stroke means, and what is done with all of it.

use glam::{DVec2, DVec3};

use super::Deed;
use super::marks::{self, Mark, Role};
use super::pick::Scope;
use super::segments;
use crate::history::{DeleteKeys, Do};
use crate::picture::Tint;
use crate::render::Pose;
use crate::sim::PointId;

/// Points and obstacles by their numbers, ascending, each once.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::app) struct Chosen {
    pub(in crate::app) points: Vec<PointId>,
    pub(in crate::app) obstacles: Vec<u32>,
}

impl Chosen {
    /// What lies under a pixel: a body, with what is grouped with it, before an obstacle.
    pub(super) fn at(scope: Scope<'_>, at: DVec2) -> Option<Self> {
        if let Some(hit) = scope.nearest(at) {
            let body = Chosen { points: scope.body(hit.point), ..Chosen::default() };
            return Some(body.with_groups(scope));
        }
        scope.obstacle(at).map(|number| Chosen { obstacles: vec![number], ..Chosen::default() })
    }

    /// The bodies of which a point lies in a region of pixels, with what is grouped with them, and the solid obstacles that have a corner
    /// there, or the middle of a side.
    pub(super) fn within(scope: Scope<'_>, is_inside: impl Fn(DVec2) -> bool) -> Self {
        let count = scope.shown.point_count();
        let pairs = scope.shown.scenery.bonds.ends().iter().copied().chain(scope.arms());
        let body = Tint::hanging(count, pairs.map(|ends| ends.map(|end| end.0)));
        let mut is_met = vec![false; count];
        for point in (0..count as u32).map(PointId).filter(|&point| scope.is_there(point)) {
            let at = scope.pixel(point);
            is_met[body[point.index()] as usize] |= at.is_some_and(&is_inside);
        }
        let is_chosen = |point: &PointId| is_met[body[point.index()] as usize] && scope.is_there(*point);
        let points = (0..count as u32).map(PointId).filter(is_chosen).collect();
        let mut obstacles: Vec<u32> = solids(scope)
            .filter(|(_, places)| places.iter().any(|&at| is_inside(at)))
            .map(|(number, _)| number)
            .collect();
        obstacles.sort_unstable();
        Chosen { points, obstacles }.with_groups(scope)
    }

    /// All bodies and all obstacles.
    pub(super) fn all(scope: Scope<'_>) -> Self {
        let count = scope.shown.point_count() as u32;
        let points = (0..count).map(PointId).filter(|&point| scope.is_there(point)).collect();
        let scenery = &scope.shown.scenery;
        let mut obstacles = [&scenery.solid_numbers[..], &scenery.plane_numbers].concat();
        obstacles.sort_unstable();
        Chosen { points, obstacles }
    }

    /// With all points that are grouped with one of these.
    fn with_groups(mut self, scope: Scope<'_>) -> Self {
        let groups = &scope.shown.scenery.groups;
        let mut left: Vec<_> = groups.iter().collect();
        loop {
            let has = |point: &PointId| self.points.binary_search(point).is_ok();
            let Some(place) = left.iter().position(|group| group.points.iter().any(has)) else { return self };
            let more = left.swap_remove(place).points.iter().copied().filter(|&point| scope.is_there(point));
            self.points.extend(more);
            self.points.sort_unstable();
            self.points.dedup();
        }
    }

    /// Whether nothing is.
    pub(in crate::app) fn is_empty(&self) -> bool {
        self.points.is_empty() && self.obstacles.is_empty()
    }

    /// What of it is there.
    pub(super) fn left(&self, scope: Scope<'_>) -> Self {
        let scenery = &scope.shown.scenery;
        let stands = |number: &u32| scenery.solid_numbers.contains(number) || scenery.plane_numbers.contains(number);
        Chosen {
            points: self.points.iter().copied().filter(|&point| scope.is_there(point)).collect(),
            obstacles: self.obstacles.iter().copied().filter(stands).collect(),
        }
    }

    /// Whether all of another one is among it.
    pub(super) fn has(&self, other: &Chosen) -> bool {
        let has_point = |point: &PointId| self.points.binary_search(point).is_ok();
        other.points.iter().all(has_point) && other.obstacles.iter().all(|number| self.obstacles.contains(number))
    }

    /// With another one; without it, where it had all of it and `takes_away`.
    pub(super) fn joined(&self, other: &Chosen, takes_away: bool) -> Self {
        if takes_away && self.has(other) {
            let is_other = |point: &PointId| other.points.binary_search(point).is_ok();
            return Chosen {
                points: self.points.iter().copied().filter(|point| !is_other(point)).collect(),
                obstacles: self.obstacles.iter().copied().filter(|number| !other.obstacles.contains(number)).collect(),
            };
        }
        let mut both = Chosen {
            points: [&self.points[..], &other.points].concat(),
            obstacles: [&self.obstacles[..], &other.obstacles].concat(),
        };
        both.points.sort_unstable();
        both.points.dedup();
        both.obstacles.sort_unstable();
        both.obstacles.dedup();
        both
    }

    /// The numbers of its points, as commands name them.
    pub(super) fn numbers(&self) -> Vec<u32> {
        self.points.iter().map(|point| point.0).collect()
    }

    /// It goes away.
    pub(super) fn deleted(&self) -> Deed {
        let name = if self.points.is_empty() { "delete an obstacle" } else { "delete" };
        let keys = DeleteKeys { points: self.numbers(), obstacles: self.obstacles.clone(), ..DeleteKeys::default() };
        Deed::edit(name, Do::Delete(keys))
    }

    /// Its outline.
    pub(super) fn outline(&self, scope: Scope<'_>, role: Role) -> Vec<Mark> {
        let bodies = if self.points.is_empty() { Vec::new() } else { marks::body(role, scope, &self.points) };
        let solids = self.obstacles.iter().flat_map(|&number| marks::obstacle(role, scope, number));
        bodies.into_iter().chain(solids).collect()
    }

    /// Which way the first of its planes has its free side, where it is nothing but planes.
    fn free_side(&self, scope: Scope<'_>) -> Option<DVec3> {
        let scenery = &scope.shown.scenery;
        let is_plane = |number: &u32| scenery.plane_numbers.contains(number);
        if !self.points.is_empty() || !self.obstacles.iter().all(is_plane) {
            return None;
        }
        let first = scenery.plane_numbers.iter().position(|number| self.obstacles.contains(number))?;
        DVec3::from(scenery.planes.get(first)?[1]).try_normalize()
    }

    /// The box around it in the plane `[m]`: its lower and its upper corner; around nothing but planes, which have no end, the place of the
    /// first that is nearest to the middle of the picture.
    pub(super) fn extent(&self, scope: Scope<'_>) -> Option<[DVec2; 2]> {
        let points = self.points.iter().map(|point| DVec3::from(scope.shown.place(point.index())).truncate());
        let scenery = &scope.shown.scenery;
        let polygons = scenery.polygons.iter().zip(&scenery.solid_numbers);
        let polygons = polygons.filter(|(_, number)| self.obstacles.contains(number));
        let corners = polygons.flat_map(|(polygon, _)| &polygon.loops).flatten().map(|&corner| DVec2::from(corner));
        let around = points.chain(corners).fold(None, |around: Option<[DVec2; 2]>, x| {
            Some(around.map_or([x; 2], |[low, high]| [low.min(x), high.max(x)]))
        });
        around.or_else(|| {
            let planes = scenery.planes.iter().zip(&scenery.plane_numbers);
            let (plane, _) = planes.into_iter().find(|(_, number)| self.obstacles.contains(number))?;
            Some([scope.on_plane(plane)?; 2])
        })
    }

    /// From where it is to a place beside it `[m]`, to the right as far as it is wide and a little more; of a plane off itself, towards its
    /// free side: along itself it would lie in itself.
    pub(in crate::app) fn beside(&self, scope: Scope<'_>) -> [f64; 3] {
        // A single point is as wide as a finger.
        let finger = 24.0 * scope.scale / scope.camera.pixels_per_metre();
        if let Some(normal) = self.free_side(scope) {
            return (FINGERS * finger * normal).to_array();
        }
        let width = match scope.camera.pose {
            Pose::Plane { .. } => self.extent(scope).map_or(0.0, |[low, high]| high.x - low.x),
            Pose::Orbit { .. } => width_in_space(self, scope),
        };
        [1.1 * width.max(finger), 0.0, 0.0]
    }
}

/// A copy of a plane is so many fingers off it.
const FINGERS: f64 = 1.5;

fn width_in_space(chosen: &Chosen, scope: Scope<'_>) -> f64 {
    let points = chosen.points.iter().map(|point| [scope.shown.place(point.index())[0]; 2]);
    let scenery = &scope.shown.scenery;
    let solids = scenery.convex.iter().zip(&scenery.solid_numbers);
    let solids = solids.filter(|(_, number)| chosen.obstacles.contains(number));
    let ends = points.chain(solids.map(|(convex, _)| convex.figure.extent().map(|corner| corner[0])));
    let [low, high] =
        ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [from, to]| [low.min(from), high.max(to)]);
    if high > low { high - low } else { 0.0 }
}

/// The solid obstacles with pixels on them: corners and middles of sides; of balls and boxes in space their middles.
fn solids(scope: Scope<'_>) -> impl Iterator<Item = (u32, Vec<DVec2>)> {
    let scenery = &scope.shown.scenery;
    let pixel = move |x: DVec3| scope.camera.screen_from_world(x).map(DVec2::from);
    let of_polygons = scenery.polygons.iter().map(move |polygon| {
        let places = segments::sides(&polygon.loops).flat_map(|[from, to]| [from, 0.5 * (from + to)]);
        places.filter_map(|place| pixel(place.extend(0.0))).collect()
    });
    let of_convex = scenery
        .convex
        .iter()
        .map(move |convex| pixel(DVec3::from(convex.figure.center())).into_iter().collect::<Vec<DVec2>>());
    scenery.solid_numbers.iter().copied().zip(of_polygons.chain(of_convex))
}
