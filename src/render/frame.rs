//! The uniforms of a picture: `Frame` in common.wgsl, field by field.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use super::buffers::WorldBuffers;
use super::camera::{Camera, Pose};
use super::chunks::Wanted;
use super::detail::dot_radius;
use super::look::{Color, Look, Overlay};
use super::sight::Sight;
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
    obstacle_color: Color,
    rim_color: Color,
    obstacles: [f32; 4],
    region: [f32; 4],
    viewport: [f32; 2],
    mix: f32,
    bond_width: f32,
    point_radius: f32,
    strain_scale: f32,
    outline_width: f32,
    near: f32,
    dot_radius: f32,
}

const _: () = assert!(size_of::<Frame>() == 260);

impl Frame {
    /// The uniforms of a picture of what lies in `buffers`.
    pub(super) fn new(view: &View<'_>, camera: &Camera, look: &Look, buffers: &WorldBuffers) -> Self {
        let scale = look.scale_factor;
        let bond_pixels = buffers.typical_bond * camera.pixels_per_metre() / f64::from(scale);
        let bond_width = look.bond_width * scale;
        let [r, g, b, opacity] = look.point;
        Frame {
            clip_from_world: camera.clip_from_world(buffers.origin).to_cols_array(),
            bond_color: look.bond,
            stretch_color: look.stretch,
            squeeze_color: look.squeeze,
            point_color: [r, g, b, opacity * point_strength(look, bond_pixels)],
            pin_color: look.pin,
            region_color: look.region,
            obstacle_color: look.obstacle,
            rim_color: look.wall,
            obstacles: [0.0; 4],
            region: region(view, camera).unwrap_or_default(),
            viewport: camera.viewport(),
            mix: view.mix,
            bond_width,
            point_radius: scale * point_radius(look, bond_pixels),
            strain_scale: if look.overlay == Overlay::Strain { look.strain_scale } else { 0.0 },
            outline_width: look.outline_width * scale,
            near: camera.near() as f32,
            dot_radius: dot_radius(bond_width, buffers.is_surface()),
        }
    }

    /// What the picture wants of bonds and points that are relative to `origin` [m].
    pub(super) fn wanted(&self, camera: &Camera, origin: DVec3, has_mesh: bool) -> Wanted {
        let shapes = [0.5 * self.bond_width, self.dot_radius, LARGEST_PIN * self.point_radius];
        // A shape reaches a pixel beyond itself at most, and its place is rounded.
        let margin = 2.0 + f64::from(shapes.into_iter().fold(0.0, f32::max));
        Wanted {
            sight: Sight::new(camera, origin, margin),
            width: f64::from(self.bond_width),
            radius: f64::from(self.dot_radius),
            points_faded: self.point_color[3] == 0.0,
            has_mesh,
        }
    }

    /// The same picture of obstacles that are relative to `origin` [m], and may cover this much of it [px].
    pub(super) fn of_obstacles(&self, camera: &Camera, origin: DVec3, obstacles: [f32; 4]) -> Self {
        // Nothing else of it moves them: what changes from picture to picture is left out.
        let clip_from_world = camera.clip_from_world(origin).to_cols_array();
        Frame { clip_from_world, obstacles, mix: 0.0, region: [0.0; 4], point_color: [0.0; 4], ..*self }
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

/// A pinned point is so many times as large as others, at most: points.wgsl.
const LARGEST_PIN: f32 = 1.35;

/// Lengths of a bond, in radii of its points, at which points are gone and at which they are all there: closer together
/// they would hide the bonds, and a fine mesh would be a blank.
const FADE: [f64; 2] = [1.6, 3.2];

/// How much is left of points whose bonds are so long [1].
fn point_strength(look: &Look, bond_pixels: f64) -> f32 {
    if bond_pixels == 0.0 {
        return 1.0;
    }
    let radii = bond_pixels / f64::from(point_radius(look, bond_pixels));
    ((radii - FADE[0]) / (FADE[1] - FADE[0])).clamp(0.0, 1.0) as f32
}

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
