//! How a scene opens: its camera.

use glam::DVec3;

use crate::render::{Camera, Pose};
use crate::scene::Scene;
use crate::sim::Dynamics;

/// The camera of a scene's `view`; what that leaves out fits the scene.
pub fn camera(scene: &Scene, world: &dyn Dynamics, size: [u32; 2]) -> Camera {
    let mut camera = fit(world, true, size);
    let Some(view) = &scene.view else { return camera };
    let [width, tall] = camera.viewport().map(f64::from);
    match &mut camera.pose {
        Pose::Plane { center, height } => {
            *center = view.center.map_or(*center, |at| DVec3::from(at.embed()).truncate());
            // In a picture higher than wide the same stretch is seen across.
            *height = view.height.map_or(*height, |height| height / (width / tall).min(1.0));
        }
        Pose::Orbit { target, distance, yaw, pitch } => {
            *target = view.target.map_or(*target, |at| DVec3::from(at.embed()));
            *distance = view.distance.unwrap_or(*distance);
            *yaw = view.yaw.unwrap_or(*yaw);
            *pitch = view.pitch.unwrap_or(*pitch);
        }
    }
    camera
}

/// A camera that shows all points, with the walls too or without.
pub fn fit(world: &dyn Dynamics, with_walls: bool, size: [u32; 2]) -> Camera {
    let mut corners = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    let mut include = |axis: usize, value: f64| {
        corners[0][axis] = corners[0][axis].min(value);
        corners[1][axis] = corners[1][axis].max(value);
    };
    let (positions, dimensions) = (world.positions(), world.dimensions());
    for i in 0..positions.len() {
        include(i % dimensions, positions.get(i));
    }
    for corner in world.bounds().filter(|_| with_walls).iter().flatten() {
        (0..dimensions).for_each(|axis| include(axis, corner[axis]));
    }
    let seen = (0..dimensions).all(|axis| corners[0][axis].is_finite() && corners[1][axis].is_finite());
    let corners = if seen { corners } else { [[-1.0; 3], [1.0; 3]] };
    let flat = |corner: [f64; 3]| corner.map(|c| if c.is_finite() { c } else { 0.0 });
    Camera::fit(corners.map(flat), dimensions, size)
}
