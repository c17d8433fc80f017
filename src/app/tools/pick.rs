//! What lies under a pixel: points, bonds, bodies, obstacles, as they are drawn.

use glam::{DVec2, DVec3};

use super::areas::is_in;
use super::segments::{distance_to_segment, is_inside};
use crate::app::player::Shown;
use crate::picture::Tint;
use crate::render::{Camera, Pose};
use crate::sim::{Angle, AngleDrive, PointId, RigidPieces};

/// What is taken by a press: how near its points are to the pixel at least `[logical px]`.
const GRIP: f64 = 14.0;
/// A press on what triangles cover, its rim and corners too, takes so many of the points of a body that hangs on no pin, in parts of all:
/// fewer could not lift it, for the force on each is bounded.
const HANDFUL: usize = 12;
/// The farthest that the nearest point may be `[logical px]`.
const REACH: f64 = 12.0;
/// What the hover force pushed away is within so many of its radii.
const BEYOND: f64 = 1.1;
/// A bond is hit so near `[logical px]`.
const BOND_REACH: f64 = 6.0;

/// The picture that is picked from.
#[derive(Clone, Copy)]
pub(in crate::app) struct Scope<'a> {
    pub(in crate::app) shown: &'a Shown,
    pub(in crate::app) camera: &'a Camera,
    /// Physical pixels in a logical one.
    pub(in crate::app) scale: f64,
    /// The left upper and the right lower corner of what no panel lies over `[px]`: handles are kept there.
    pub(in crate::app) free: [DVec2; 2],
}

/// A point under a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct Hit {
    pub(in crate::app) point: PointId,
    /// How far from the pixel `[px]`.
    pub(in crate::app) distance: f64,
    /// How far from the camera, in the plane 0 `[m]`.
    depth: f64,
}

impl Scope<'_> {
    /// Where nothing lies over anything.
    pub(in crate::app) const ANYWHERE: [DVec2; 2] = [DVec2::NEG_INFINITY, DVec2::INFINITY];

    /// A pixel, or the nearest one that has so much room about it where nothing lies over it `[logical px]`.
    pub(super) fn kept(&self, at: DVec2, room: f64) -> DVec2 {
        let [low, high] = self.free;
        let room = DVec2::splat(room * self.scale);
        at.min(high - room).max(low + room)
    }

    /// Where a point is seen `[px]`; `None` of one that was deleted, or is behind the camera.
    pub(in crate::app) fn pixel(&self, point: PointId) -> Option<DVec2> {
        self.camera.screen_from_world(DVec3::from(self.shown.place(point.index()))).map(DVec2::from)
    }

    pub(super) fn depth(&self, place: [f64; 3]) -> f64 {
        match self.camera.pose {
            Pose::Plane { .. } => 0.0,
            Pose::Orbit { .. } => self.camera.depth(DVec3::from(place)),
        }
    }

    /// All points within so many pixels of a pixel.
    pub(super) fn near(&self, at: DVec2, most: f64) -> Vec<Hit> {
        let hit = |index: usize| {
            let place = self.shown.place(index);
            let pixel = DVec2::from(self.camera.screen_from_world(DVec3::from(place))?);
            let distance = pixel.distance(at);
            let point = PointId(index as u32);
            (distance <= most).then(|| Hit { point, distance, depth: self.depth(place) })
        };
        (0..self.shown.point_count()).filter_map(hit).collect()
    }

    /// The point that a pixel means: the nearest in reach, in space the foremost; else of the triangle or the bond that the pixel
    /// lies on the nearest corner.
    pub(in crate::app) fn nearest(&self, at: DVec2) -> Option<Hit> {
        let near = self.near(at, REACH * self.scale);
        if let Some(foremost) = near.iter().map(|hit| hit.depth).min_by(f64::total_cmp) {
            // What lies behind by more than is seen across is not meant.
            let across = 4.0 * REACH * self.scale / self.camera.pixels_per_metre();
            let hubs: Vec<PointId> = near.iter().map(|hit| hit.point).collect();
            let front = near.into_iter().filter(|hit| hit.depth <= foremost + across);
            // What a motor or a stop pushes against lies in its hub.
            let front = front.filter(|hit| !self.props_one_of(hit.point, &hubs));
            return front.min_by(|a, b| a.distance.total_cmp(&b.distance));
        }
        let corners = self.triangle(at).map(|corners| corners.to_vec());
        let corners = corners.or_else(|| self.bond(at).map(|(_, ends)| ends.to_vec()))?;
        let hit = |point: PointId| {
            Some(Hit {
                point,
                distance: self.pixel(point)?.distance(at),
                depth: self.depth(self.shown.place(point.index())),
            })
        };
        corners.into_iter().filter_map(hit).min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    /// Whether the motor of one of these hubs pushes against a pin, or a joint about one has it for its prop.
    fn props_one_of(&self, pin: PointId, hubs: &[PointId]) -> bool {
        let is_prop = self.shown.scenery.props.binary_search(&pin).is_ok();
        let pushes = |angle: &Angle| is_prop || matches!(angle.drive, Some(AngleDrive::Motor { .. }));
        let props = |angle: &&Angle| angle.points[0] == pin && hubs.contains(&angle.points[1]) && pushes(angle);
        self.is_pinned(pin) && self.shown.scenery.angles.iter().any(|angle| props(&angle))
    }

    /// The point that a pixel lies on, or is near to: not those of what it lies on.
    pub(in crate::app) fn point(&self, at: DVec2) -> Option<PointId> {
        self.nearest(at).filter(|hit| hit.distance <= REACH * self.scale).map(|hit| hit.point)
    }

    /// The points in reach of a pixel, the nearest first.
    pub(super) fn reached(&self, at: DVec2) -> Vec<PointId> {
        self.about(at, REACH * self.scale)
    }

    /// The points within so many pixels of a pixel, the nearest first.
    pub(super) fn about(&self, at: DVec2, most: f64) -> Vec<PointId> {
        let mut near = self.near(at, most);
        near.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.point.cmp(&b.point)));
        near.into_iter().map(|hit| hit.point).collect()
    }

    /// The points that a press takes: of a cloth or a net a patch, else those around the pixel, as deep as the nearest one, or the corners of what it
    /// lies on.
    pub(in crate::app) fn grip(&self, at: DVec2) -> Vec<PointId> {
        let Some(nearest) = self.nearest(at) else { return Vec::new() };
        if let Some(patch) = self.patch(nearest.point, at) {
            return patch;
        }
        let across = 4.0 * GRIP * self.scale / self.camera.pixels_per_metre();
        let mut points: Vec<PointId> = self
            .near(at, GRIP * self.scale)
            .into_iter()
            .filter(|hit| (hit.depth - nearest.depth).abs() <= across)
            .map(|hit| hit.point)
            .collect();
        if points.is_empty() {
            points = self.triangle(at).map_or_else(Vec::new, |corners| corners.to_vec());
        }
        if points.is_empty() {
            points.push(nearest.point);
        }
        // One body is grabbed, not what lies under it too.
        let body = self.body(nearest.point);
        points.retain(|point| body.binary_search(point).is_ok() && !self.is_pinned(*point));
        let handful = body.len() / HANDFUL;
        let hangs = || self.shown.scenery.pinned.iter().any(|pin| body.binary_search(pin).is_ok());
        if points.len() < handful && !hangs() && (self.triangle(at).is_some() || self.is_a_corner(nearest.point)) {
            points = self.nearest_of(&body, at, handful);
        }
        points
    }

    /// So many of some points, those nearest to the pixel, ascending; no pins.
    fn nearest_of(&self, points: &[PointId], at: DVec2, count: usize) -> Vec<PointId> {
        let far = |&point: &PointId| Some((self.pixel(point)?.distance(at), point));
        let mut list: Vec<(f64, PointId)> =
            points.iter().filter(|point| !self.is_pinned(**point)).filter_map(far).collect();
        list.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut nearest: Vec<PointId> = list.into_iter().take(count).map(|(_, point)| point).collect();
        nearest.sort_unstable();
        nearest
    }

    /// What the hover force around a pixel has pushed away: of the free point that is nearest within its reach, those that a press on
    /// it would take. It stands at the edge of the region, or a little beyond.
    pub(in crate::app) fn pushed(&self, at: DVec2) -> Vec<PointId> {
        let Some(force) = self.shown.mouse.as_ref().filter(|force| force.track.knots.is_empty()) else {
            return Vec::new();
        };
        let cursor = self.camera.cursor(at.to_array());
        let (origin, direction) = (DVec3::from(cursor.origin), DVec3::from(cursor.direction));
        let far = |index: usize| {
            let from = DVec3::from(self.shown.place(index)) - origin;
            let across = (from - from.dot(direction) * direction).length();
            (across <= BEYOND * force.radius).then_some((across, PointId(index as u32)))
        };
        let reached = (0..self.shown.point_count()).filter_map(far).filter(|(_, point)| !self.is_pinned(*point));
        let nearest = reached.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.and_then(|(_, point)| self.pixel(point)).map_or_else(Vec::new, |pixel| self.grip(pixel))
    }

    /// Whether triangles meet at a point.
    pub(super) fn is_a_corner(&self, point: PointId) -> bool {
        self.shown.scenery.triangles.iter().any(|corners| corners.contains(&point))
    }

    /// The triangle that a pixel lies on: the last, in space the foremost.
    pub(super) fn triangle(&self, at: DVec2) -> Option<[PointId; 3]> {
        let covers = |corners: &[PointId; 3]| {
            let [Some(a), Some(b), Some(c)] = corners.map(|corner| self.pixel(corner)) else { return false };
            is_in([a, b, c], at)
        };
        let mut under = self.shown.scenery.triangles.iter().rev().copied().filter(covers);
        let depth = |corners: &[PointId; 3]| corners.map(|corner| self.depth(self.shown.place(corner.index())));
        match self.camera.pose {
            Pose::Plane { .. } => under.next(),
            Pose::Orbit { .. } => {
                under.min_by(|a, b| depth(a).iter().sum::<f64>().total_cmp(&depth(b).iter().sum::<f64>()))
            }
        }
    }

    /// The bond that a pixel lies on, by its place in the list, and its ends.
    pub(in crate::app) fn bond(&self, at: DVec2) -> Option<(usize, [PointId; 2])> {
        let all = self.shown.scenery.bonds.ends().iter().enumerate();
        let (tints, ppm) = (&self.shown.scenery.tints, self.camera.pixels_per_metre());
        let is_wide = tints.iter().any(|tint| tint.width > 0.0);
        let far = |(place, &ends): (usize, &[PointId; 2])| {
            let (from, to) = (self.pixel(ends[0])?, self.pixel(ends[1])?);
            // One that is drawn wide is hit all over.
            let own = if is_wide { Tint::of(tints, ends[0].0).map_or(0.0, |tint| 0.5 * tint.width * ppm) } else { 0.0 };
            Some(((distance_to_segment(at, from, to) - own).max(0.0), place, ends))
        };
        let near = all.filter_map(far).filter(|(distance, ..)| *distance <= BOND_REACH * self.scale);
        near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, place, ends)| (place, ends))
    }

    /// All points that bonds and angles hold together with `point`, ascending: the pin that a motor pushes against is of what it turns.
    pub(in crate::app) fn body(&self, point: PointId) -> Vec<PointId> {
        let count = self.shown.point_count();
        let mut parent: Vec<u32> = (0..count as u32).collect();
        let root = |parent: &mut Vec<u32>, mut at: u32| {
            while parent[at as usize] != at {
                parent[at as usize] = parent[parent[at as usize] as usize];
                at = parent[at as usize];
            }
            at
        };
        let bonds = self.shown.scenery.bonds.ends().iter().copied();
        for [a, b] in bonds.chain(self.arms()) {
            if a.index().max(b.index()) < count {
                let (a, b) = (root(&mut parent, a.0), root(&mut parent, b.0));
                parent[a.max(b) as usize] = a.min(b);
            }
        }
        if point.index() >= count {
            return Vec::new();
        }
        let wanted = root(&mut parent, point.0);
        (0..count as u32).filter(|&other| root(&mut parent, other) == wanted).map(PointId).collect()
    }

    /// Both arms of all angles.
    pub(super) fn arms(&self) -> impl Iterator<Item = [PointId; 2]> {
        self.shown.scenery.angles.iter().flat_map(|angle| {
            let [i, j, k] = angle.points;
            [[i, j], [j, k]]
        })
    }

    /// The number of the obstacle that a pixel lies in, in space the foremost; of a plane, which has no end, near its surface.
    pub(in crate::app) fn solid(&self, at: DVec2) -> Option<u32> {
        match self.camera.pose {
            Pose::Plane { .. } => self.polygon(at).or_else(|| self.plane(at)),
            Pose::Orbit { .. } => self.convex(at),
        }
    }

    /// The number of the obstacle that has an end and that a pixel lies in.
    pub(super) fn with_an_end(&self, at: DVec2) -> Option<u32> {
        match self.camera.pose {
            Pose::Plane { .. } => self.polygon(at),
            Pose::Orbit { .. } => self.convex(at),
        }
    }

    /// The place where the ray of a pixel meets the foremost obstacle of space `[m]`.
    pub(super) fn entry(&self, at: DVec2) -> Option<DVec3> {
        let (far, _) = self.first(at)?;
        let cursor = self.camera.cursor(at.to_array());
        Some(DVec3::from(cursor.origin) + far * DVec3::from(cursor.direction))
    }

    /// The nearest plane whose surface is in reach of a pixel.
    fn plane(&self, at: DVec2) -> Option<u32> {
        let place = self.in_plane(at);
        let reach = REACH * self.scale / self.camera.pixels_per_metre();
        let planes = self.shown.scenery.planes.iter().zip(&self.shown.scenery.plane_numbers);
        let far = planes.map(|([point, normal], &number)| {
            let (point, normal) = (DVec3::from(*point).truncate(), DVec3::from(*normal).truncate());
            ((place - point).dot(normal.normalize_or_zero()).abs(), number)
        });
        let near = far.filter(|(distance, _)| *distance <= reach);
        near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, number)| number)
    }

    /// The place of a plane, given by a point and its normal, that is nearest to the middle of the picture `[m]`.
    pub(super) fn on_plane(&self, [point, normal]: &[[f64; 3]; 2]) -> Option<DVec2> {
        let Pose::Plane { center, .. } = self.camera.pose else { return None };
        let (point, normal) = (DVec3::from(*point).truncate(), DVec3::from(*normal).truncate().normalize_or_zero());
        Some(center - (center - point).dot(normal) * normal)
    }

    /// Whether a click of the hand at a pixel starts a motion there: where that is so pins are a part of the picture.
    pub(in crate::app) fn starts_at(&self, at: DVec2) -> bool {
        let is_led = || self.nearest(at).is_some_and(|hit| !self.is_pinned(hit.point));
        self.shown.starts && !is_led() && self.block(at).is_none()
    }

    /// What rigid bonds hold in its shape, where points are now; nothing in space.
    pub(super) fn rigid_pieces(&self) -> RigidPieces {
        if self.shown.dimensions != 2 {
            return RigidPieces::default();
        }
        let place = |point: PointId| {
            let [x, y, _] = self.shown.place(point.index());
            [x, y]
        };
        RigidPieces::of(self.shown.scenery.bonds.iter(), place)
    }

    /// Where a pixel lies in the plane `[m]`.
    pub(super) fn in_plane(&self, at: DVec2) -> DVec2 {
        self.camera.world_from_screen(at.to_array()).truncate()
    }

    /// Where a place of the plane is seen `[px]`.
    pub(super) fn on_screen(&self, place: DVec2) -> Option<DVec2> {
        self.camera.screen_from_world(place.extend(0.0)).map(DVec2::from)
    }

    /// Whether a point is there: it came, and was not deleted.
    pub(in crate::app) fn is_there(&self, point: PointId) -> bool {
        point.index() < self.shown.point_count() && self.shown.scenery.gone.binary_search(&point).is_err()
    }

    fn convex(&self, at: DVec2) -> Option<u32> {
        self.foremost(at).map(|(_, number)| number)
    }

    /// The foremost ball or box of space under a pixel, and how far it is `[m]`.
    pub(super) fn foremost(&self, at: DVec2) -> Option<(f64, u32)> {
        let cursor = self.camera.cursor(at.to_array());
        let ray = [cursor.origin, cursor.direction];
        let solids = self.shown.scenery.convex.iter().zip(&self.shown.scenery.solid_numbers);
        let hits = solids.filter_map(|(convex, &number)| Some((convex.figure.entry(ray, 0.0)?, number)));
        hits.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    fn polygon(&self, at: DVec2) -> Option<u32> {
        let place = self.camera.world_from_screen(at.to_array()).truncate();
        let polygons = self.shown.scenery.polygons.iter().zip(&self.shown.scenery.solid_numbers);
        let mut inside = polygons.filter(|(polygon, _)| is_inside(&polygon.loops, place.to_array()));
        inside.next_back().map(|(_, &number)| number)
    }

    /// The left upper and the right lower corner of what of the picture is seen beside panels `[px]`.
    pub(super) fn seen(&self) -> [DVec2; 2] {
        let view = DVec2::from(self.camera.viewport().map(f64::from));
        [self.free[0].max(DVec2::ZERO).min(view), self.free[1].min(view).max(DVec2::ZERO)]
    }

    /// Whether a point is held.
    pub(in crate::app) fn is_pinned(&self, point: PointId) -> bool {
        self.shown.scenery.pinned.binary_search(&point).is_ok()
    }
}
