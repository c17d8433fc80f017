//! The uniforms of a picture: `Frame` in common.wgsl, field by field.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use super::camera::{Camera, Pose};
use super::look::{Color, Look, Overlay};
use super::view::View;
use crate::sim::Region;

#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Frame {
    clip_from_world: [f32; 16],
    bond_color: Color,
    stretch_color: Color,
    squeeze_color: Color,
    point_color: Color,
    pin_color: Color,
    region_color: Color,
    region: [f32; 4],
    viewport: [f32; 2],
    mix: f32,
    bond_width: f32,
    point_radius: f32,
    strain_scale: f32,
    outline_width: f32,
    near: f32,
}

const _: () = assert!(size_of::<Frame>() == 208);

impl Frame {
    /// The uniforms of a picture whose positions are relative to `origin` [m].
    pub(super) fn new(view: &View<'_>, camera: &Camera, look: &Look, origin: DVec3, typical_bond: f64) -> Self {
        let scale = look.scale_factor;
        Frame {
            clip_from_world: camera.clip_from_world(origin).to_cols_array(),
            bond_color: look.bond,
            stretch_color: look.stretch,
            squeeze_color: look.squeeze,
            point_color: look.point,
            pin_color: look.pin,
            region_color: look.region,
            region: region(view, camera).unwrap_or_default(),
            viewport: camera.viewport(),
            mix: view.mix,
            bond_width: look.bond_width * scale,
            point_radius: scale * point_radius(look, typical_bond * camera.pixels_per_metre() / f64::from(scale)),
            strain_scale: if look.overlay == Overlay::Strain { look.strain_scale } else { 0.0 },
            outline_width: look.outline_width * scale,
            near: camera.near() as f32,
        }
    }

    /// Whether there is a region to draw.
    pub(super) fn has_region(&self) -> bool {
        self.region[3] != 0.0
    }
}

/// Smallest radius of a point [px].
const LEAST_RADIUS: f32 = 1.2;
/// Radius of a point for each pixel that its bonds are long.
const RADIUS_OF_BOND: f64 = 0.12;

/// Points shrink with their bonds, so that a fine mesh is not a heap of discs. Logical pixels.
fn point_radius(look: &Look, bond_pixels: f64) -> f32 {
    if bond_pixels == 0.0 {
        return look.point_radius;
    }
    ((RADIUS_OF_BOND * bond_pixels) as f32).clamp(LEAST_RADIUS.min(look.point_radius), look.point_radius)
}

/// Centre, radius [px] and shape of the mouse region on the screen.
fn region(view: &View<'_>, camera: &Camera) -> Option<[f32; 4]> {
    let (force, cursor) = view.mouse?;
    let origin = DVec3::from(cursor.origin);
    let center = match camera.pose {
        Pose::Plane { .. } => origin,
        // Where the ray comes closest to what the camera looks at.
        Pose::Orbit { target, .. } => {
            let direction = DVec3::from(cursor.direction);
            origin + direction * (target - origin).dot(direction)
        }
    };
    let [x, y] = camera.screen_from_world(center)?;
    let radius = force.radius * camera.pixels_per_metre();
    let shape = match force.region {
        Region::Round => 1.0,
        Region::Square => 2.0,
    };
    Some([x as f32, y as f32, radius as f32, shape])
}
