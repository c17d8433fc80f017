//! Planes in space. They have no end: what of one lies about the place that the camera looks at is outlined, and can be clicked.

use glam::{DVec2, DVec3};

use super::chosen::Chosen;
use super::pick::Scope;
use crate::render::Pose;

/// Half a side of what is outlined, in distances of the camera `[1]`: about as much as is drawn of a plane in the view that a scene opens with.
const HALF: f64 = 0.5;

/// What of a plane is outlined: a square.
struct Floor {
    middle: DVec3,
    normal: DVec3,
    /// From the middle to the middles of two sides `[m]`.
    along: [DVec3; 2],
}

impl Floor {
    /// Where a ray from a place in a direction meets it, in lengths of the direction; `None`: beside it, or behind.
    fn entry(&self, [from, direction]: [DVec3; 2]) -> Option<f64> {
        let far = (self.middle - from).dot(self.normal) / direction.dot(self.normal);
        let off = from + far * direction - self.middle;
        let is_on = self.along.iter().all(|side| off.dot(*side).abs() <= side.length_squared());
        (far.is_finite() && far > 0.0 && is_on).then_some(far)
    }
}

impl Scope<'_> {
    /// Of a plane of space, given by a point and its normal; `None` in the plane, or without a normal.
    fn floor(&self, [point, normal]: [[f64; 3]; 2]) -> Option<Floor> {
        let Pose::Orbit { target, distance, .. } = self.camera.pose else { return None };
        let (point, normal) = (DVec3::from(point), DVec3::from(normal).try_normalize()?);
        let across = if normal.x.abs() < 0.9 { DVec3::X } else { DVec3::Z };
        let side = HALF * distance * (across - normal * across.dot(normal)).normalize();
        let middle = target - normal * (target - point).dot(normal);
        Some(Floor { middle, normal, along: [side, normal.cross(side)] })
    }

    /// The place of a plane of space that is seen in the middle `[m]`.
    pub(super) fn floor_middle(&self, plane: [[f64; 3]; 2]) -> Option<DVec3> {
        Some(self.floor(plane)?.middle)
    }

    /// The outline of a plane of space: its sides, from end to end `[px]`.
    pub(super) fn rim(&self, plane: [[f64; 3]; 2]) -> Vec<[DVec2; 2]> {
        let Some(Floor { middle, along: [u, v], .. }) = self.floor(plane) else { return Vec::new() };
        let corners = [u + v, u - v, -u - v, v - u].map(|off| self.camera.screen_from_world(middle + off));
        (0..4).filter_map(|k| Some([corners[k]?, corners[(k + 1) % 4]?].map(DVec2::from))).collect()
    }

    /// The number of the obstacle that a pixel means: in space planes, too, which stop neither the hand nor a brush.
    pub(in crate::app) fn obstacle(&self, at: DVec2) -> Option<u32> {
        match self.camera.pose {
            Pose::Plane { .. } => self.solid(at),
            Pose::Orbit { .. } => self.first(at).map(|(_, number)| number),
        }
    }

    /// The foremost obstacle of space under a pixel, and how far it is `[m]`. Through the back of a plane one looks at what lies before it.
    pub(super) fn first(&self, at: DVec2) -> Option<(f64, u32)> {
        let cursor = self.camera.cursor(at.to_array());
        let ray = [cursor.origin, cursor.direction].map(DVec3::from);
        let scenery = &self.shown.scenery;
        let planes = scenery.planes.iter().zip(&scenery.plane_numbers).filter_map(|(&plane, &number)| {
            let floor = self.floor(plane)?;
            Some((floor.normal.dot(ray[1]) > 0.0, floor.entry(ray)?, number))
        });
        let solids = self.foremost(at).map(|(far, number)| (false, far, number));
        let hit = planes.chain(solids).min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        hit.map(|(_, far, number)| (far, number))
    }
}

impl Chosen {
    /// Whether it is planes of space alone. They fill the picture: a drag over them means what lies before them, until they are selected.
    pub(super) fn is_ground(&self, scope: Scope<'_>) -> bool {
        let is_plane = |number: &u32| scope.shown.scenery.plane_numbers.contains(number);
        scope.shown.dimensions == 3 && self.points.is_empty() && self.obstacles.iter().all(is_plane)
    }
}
