//! Balls and boxes in space, as the shader reads them: `solids` in solids.wgsl.

use glam::{DVec3, Vec4};

use crate::render::camera::Camera;
use crate::render::view::View;
use crate::sim::Figure;

/// The way from clip space to the world, then four rows a solid; positions relative to `origin` `[m]`. Empty where there is none.
pub(in crate::render) fn solids(view: &View<'_>, camera: &Camera, origin: DVec3) -> Vec<[f32; 4]> {
    if view.convex.is_empty() {
        return Vec::new();
    }
    let columns = camera.clip_from_relative(origin).inverse().as_mat4().to_cols_array_2d();
    let mut rows = columns.to_vec();
    for convex in view.convex {
        let row = |x: DVec3, w: f64| Vec4::from((x.as_vec3(), w as f32)).to_array();
        let center = DVec3::from(convex.figure.center()) - origin;
        match (convex.figure, convex.figure.frame()) {
            (_, Some(frame)) => {
                rows.push(row(center, 0.0));
                rows.extend((0..3).map(|k| row(DVec3::from(frame.axes[k]), frame.half[k])));
            }
            (Figure::Ball { radius, .. }, None) => {
                rows.push(row(center, radius));
                rows.extend([DVec3::X, DVec3::Y, DVec3::Z].map(|axis| row(axis, radius)));
            }
            (Figure::Box { .. }, None) => {}
        }
    }
    rows
}
