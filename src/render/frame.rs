//! The uniforms of a picture: `Frame` in common.wgsl, field by field.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use super::buffers::WorldBuffers;
use super::camera::{Camera, Pose};
use super::chunks::Wanted;
use super::detail::dot_radius;
use super::look::{Color, Look, Overlay};
use super::seen_forms::Scale;
use super::sight::Sight;
use super::view::View;
use crate::sim::Region;

#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Frame {
    clip_from_world: [f32; 16],
    ground: Color,
    bond_color: Color,
    rope_color: Color,
    strain_colors: [Color; 9],
    point_color: Color,
    pin_color: Color,
    region_color: Color,
    obstacle_color: Color,
    rim_color: Color,
    shade_color: Color,
    lit_color: Color,
    obstacles: [f32; 4],
    region: [f32; 4],
    walls: [f32; 4],
    viewport: [f32; 2],
    bond_width: f32,
    point_radius: f32,
    strain_scale: f32,
    strain_full: f32,
    outline_width: f32,
    near: f32,
    dot_radius: f32,
    least_pin: f32,
    coil_length: f32,
    fill_opacity: f32,
    fill_outline: f32,
    fog_from: f32,
    fog_to: f32,
    fog: f32,
    difference_scale: f32,
    difference_full: f32,
}

const _: () = assert!(size_of::<Frame>() == 488);

/// What stands for no wall, in the shaders too `[m]`.
const FAR: f64 = 1e30;

/// The walls of the plane as they lie from `origin` on: the lower corner, then the upper one `[m]`.
fn walls(view: &View<'_>, origin: DVec3) -> [f32; 4] {
    let [low, high] = view.bounds.filter(|_| view.dimensions == 2).unwrap_or([[-FAR; 3], [FAR; 3]]).map(DVec3::from);
    let [low, high] = [low - origin, high - origin];
    [low.x, low.y, high.x, high.y].map(|x| x as f32)
}

impl Frame {
    /// The uniforms of a picture of what lies in `buffers`.
    pub(super) fn new(view: &View<'_>, camera: &Camera, look: &Look, buffers: &WorldBuffers) -> Self {
        let scale = look.scale_factor;
        let bond_pixels = buffers.typical_bond * camera.pixels_per_metre() / f64::from(scale);
        let bond_width = look.bond_width * scale * if look.has_forms { thinning(bond_pixels) } else { 1.0 };
        let [r, g, b, opacity] = look.point;
        let shows_difference = look.overlay == Overlay::Difference && view.values.is_some();
        let covered_pixels = buffers.covered_bond * camera.pixels_per_metre() / f64::from(scale);
        Frame {
            clip_from_world: camera.clip_from_world(buffers.origin).to_cols_array(),
            ground: look.ground,
            bond_color: look.bond,
            rope_color: look.rope,
            strain_colors: if shows_difference { look.of_distances() } else { look.strain },
            point_color: [r, g, b, opacity * point_strength(look, bond_pixels)],
            pin_color: look.pin,
            region_color: look.region,
            obstacle_color: look.obstacle,
            rim_color: look.wall,
            shade_color: look.solid[0],
            lit_color: look.solid[1],
            obstacles: [0.0; 4],
            region: region(view, camera).unwrap_or_default(),
            walls: walls(view, buffers.origin),
            viewport: camera.viewport(),
            bond_width,
            point_radius: scale * point_radius(look, bond_pixels),
            strain_scale: if look.overlay == Overlay::Strain { look.strain_scale } else { 0.0 },
            strain_full: look.strain_full,
            outline_width: look.outline_width * scale,
            near: camera.near() as f32,
            dot_radius: dot_radius(bond_width, buffers.is_surface()),
            least_pin: if look.has_forms && buffers.pin_count <= FEW { scale * look.least_pin } else { 0.0 },
            coil_length: if look.has_forms { scale * coil_length(buffers.bare_count()) } else { 0.0 },
            fill_opacity: fill_opacity(look),
            fill_outline: scale * (OUTLINE_OF_BOND * covered_pixels).clamp(OUTLINES[0], OUTLINES[1]) as f32,
            fog_from: (FOG[0] * camera.distance()) as f32,
            fog_to: (FOG[1] * camera.distance()) as f32,
            fog: look.fog,
            difference_scale: if shows_difference { DIFFERENCE_SCALE * look.difference_full } else { 0.0 },
            difference_full: look.difference_full,
        }
    }

    /// What the picture wants of bonds and points as they lie in `buffers`.
    pub(super) fn wanted(&self, camera: &Camera, buffers: &WorldBuffers, has_mesh: bool) -> Wanted {
        let origin = buffers.origin;
        let own = 0.5 * (buffers.widest_own * camera.pixels_per_metre()) as f32;
        let shapes = [0.5 * self.bond_width, own, self.dot_radius, LARGEST_PIN * self.point_radius, self.least_pin];
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

    /// The same picture of obstacles that are relative to `origin` `[m]`, and may cover this much of it `[px]`.
    pub(super) fn of_obstacles(&self, camera: &Camera, origin: DVec3, obstacles: [f32; 4]) -> Self {
        // Nothing else of it moves them: what changes from picture to picture is left out.
        let clip_from_world = camera.clip_from_world(origin).to_cols_array();
        Frame { clip_from_world, obstacles, region: [0.0; 4], point_color: [0.0; 4], ..*self }
    }

    /// Width of outlines `[px]`.
    pub(super) fn outline(&self) -> f32 {
        self.outline_width
    }

    /// How large bonds are.
    pub(super) fn scale_of_bonds(&self, camera: &Camera) -> Scale {
        let Frame { coil_length, bond_width, .. } = *self;
        Scale { pixels_per_metre: camera.pixels_per_metre(), coil_length, bond_width }
    }

    /// Whether there is a region to draw.
    pub(super) fn has_region(&self) -> bool {
        self.region[3] != 0.0
    }
}

/// Of fills, 0 where there are none.
fn fill_opacity(look: &Look) -> f32 {
    match (look.has_fills, look.has_mesh) {
        (false, _) => 0.0,
        (true, true) => UNDER_MESH,
        (true, false) => 1.0,
    }
}

/// Share of the largest distance below which colours go in proportion `[1]`.
pub(super) const DIFFERENCE_SCALE: f32 = 0.01;
/// Opacity of fills whose bonds are shown over them.
const UNDER_MESH: f32 = 0.3;
/// Width of the outline of a fill for each pixel that its bonds are long, and its bounds `[px]`.
const OUTLINE_OF_BOND: f64 = 0.09;
const OUTLINES: [f64; 2] = [0.7, 2.2];
/// Distances between which things fade, in those of the camera from what it looks at.
const FOG: [f64; 2] = [1.05, 3.0];
/// Bonds that no fill covers up to which springs are coils as soon as there is room for a few turns, and pins that are few.
const FEW: u32 = 80;
/// Length of a spring `[px]` from which on it is a coil, where there are few and where there are many.
const COILS: [f32; 2] = [36.0, 90.0];

/// Length of a spring on the screen from which on it is a coil `[px]`, of so many bonds.
fn coil_length(bonds: u32) -> f32 {
    COILS[usize::from(bonds > FEW)]
}

/// Bonds as long as this `[px]` have their full width; shorter ones thin out with their length, so that a fine net is a veil and not a
/// pattern that the pixels make.
const FULL_WIDTH_FROM: f64 = 16.0;
/// Least share of the width of bonds that is left.
const THINNEST: f64 = 0.42;

/// Share of the width that bonds of this length have.
fn thinning(bond_pixels: f64) -> f32 {
    if bond_pixels == 0.0 { 1.0 } else { (bond_pixels / FULL_WIDTH_FROM).clamp(THINNEST, 1.0) as f32 }
}

/// Smallest radius of a point `[px]`.
const LEAST_RADIUS: f32 = 1.2;
/// Radius of a point for each pixel that its bonds are long.
const RADIUS_OF_BOND: f64 = 0.12;

/// A pinned point is so many times as large as others, where it is not too small: points.wgsl.
const LARGEST_PIN: f32 = 1.35;

/// Lengths of a bond, in radii of its points, at which points are gone and at which they are all there: closer together
/// they would hide the bonds, and a fine mesh would be a blank.
const FADE: [f64; 2] = [4.0, 7.0];

/// How much is left of points whose bonds are so long `[1]`.
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

/// Centre, radius `[px]` and shape of the mouse region on the screen.
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
