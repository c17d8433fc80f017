//! Drags in the plane that faces who plays: in space the one parallel to the screen through what was pressed on.

use glam::{DVec2, DVec3};

use super::chosen::Chosen;
use super::pick::Scope;
use crate::render::{Camera, Pose};
use crate::sim::PointId;

/// What a press took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hold {
    /// The pixel that was pressed on `[px]`.
    pub(super) at: DVec2,
    /// The place that lay there `[m]`.
    pub(super) place: DVec3,
}

impl Scope<'_> {
    /// The place under a pixel in the plane through another place that faces the camera `[m]`; a plane scene is one.
    pub(super) fn facing(&self, through: DVec3, at: DVec2) -> DVec3 {
        let at = at.to_array();
        let Pose::Orbit { target, .. } = self.camera.pose else { return self.camera.world_from_screen(at) };
        // Both lie in planes that are parallel to the screen.
        let (eye, seen) = (DVec3::from(self.camera.cursor(at).origin), self.camera.world_from_screen(at));
        let ahead = target - eye;
        eye + (through - eye).dot(ahead) / ahead.length_squared() * (seen - eye)
    }

    /// What a press on a pixel takes hold of: the surface of an obstacle or the point of a body, as deep as it is.
    pub(super) fn hold(&self, at: DVec2) -> Hold {
        let deep = match self.camera.pose {
            Pose::Plane { .. } => None,
            Pose::Orbit { .. } => match self.nearest(at) {
                Some(hit) => Some(DVec3::from(self.shown.place(hit.point.index()))),
                None => self.entry(at),
            },
        };
        let through = deep.unwrap_or_else(|| self.camera.focus());
        Hold { at, place: self.facing(through, at) }
    }

    /// The mean place of points `[m]`.
    pub(super) fn middle(&self, points: &[PointId]) -> DVec3 {
        let places = points.iter().map(|point| DVec3::from(self.shown.place(point.index())));
        places.sum::<DVec3>() / points.len().max(1) as f64
    }

    /// How far what was taken goes that is dragged to a pixel `[m]`.
    pub(super) fn way(&self, hold: Hold, to: DVec2) -> DVec3 {
        self.facing(hold.place, to) - self.facing(hold.place, hold.at)
    }
}

/// The camera that sees things where they are as this one sees them once they went so far `[m]`.
pub(super) fn before(camera: &Camera, by: DVec3) -> Camera {
    let mut moved = *camera;
    match &mut moved.pose {
        Pose::Plane { center, .. } => *center -= by.truncate(),
        Pose::Orbit { target, .. } => *target -= by,
    }
    moved
}

impl Chosen {
    /// The mean place of its points `[m]`.
    pub(super) fn middle(&self, scope: Scope<'_>) -> DVec3 {
        scope.middle(&self.points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::player::Shown;

    #[test]
    fn what_is_dragged_in_space_stays_under_the_pointer_and_as_deep_as_it_was() {
        let pose = Pose::Orbit { target: DVec3::new(1.0, 2.0, 3.0), distance: 7.0, yaw: 0.7, pitch: 0.4 };
        // Also where panels push the middle aside.
        let camera = Camera::new(pose, [900, 700]).moved([60.0, -40.0]);
        let shown = Shown::default();
        let scope = Scope { shown: &shown, camera: &camera, scale: 1.0, free: Scope::ANYWHERE };
        let place = DVec3::new(2.0, 1.0, 4.5);
        let from = DVec2::from(camera.screen_from_world(place).unwrap_or_default());
        let to = from + DVec2::new(120.0, -75.0);
        let hold = Hold { at: from, place };
        let by = scope.way(hold, to);
        let after = DVec2::from(camera.screen_from_world(place + by).unwrap_or_default());
        assert!(after.distance(to) < 1e-6, "{after}");
        assert!((camera.depth(place + by) - camera.depth(place)).abs() < 1e-9);
        let seen = DVec2::from(before(&camera, by).screen_from_world(place).unwrap_or_default());
        assert!(seen.distance(to) < 1e-6, "{seen}");
    }
}
