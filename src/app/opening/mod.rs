//! How a scene opens: its camera.

mod beside;
mod clearing;
mod extent;
#[cfg(test)]
mod gallery_tests;
mod panes;
mod roaming;
mod swings;
#[cfg(test)]
mod tests;

use glam::{DVec2, DVec3};

use crate::render::{Camera, Pose, Tiles, View};
use crate::scene::{Scene, Vector, ViewKeys};

pub use beside::{Over, beside_all, beside_panels};
pub use clearing::{Free, clear, whole};
use clearing::{clear_with, drawn_back, mirrored, on_screen};
use extent::{include, points, surroundings};
pub use panes::{free_of_pane, narrowed, shared, tiles};
pub use roaming::{Followed, follow, followed};
use swings::swung;

/// Width of the pictures that views are made for, in heights: what is seen to both sides there is seen in narrower ones too.
const MADE_FOR: f64 = 16.0 / 9.0;
/// A picture of that shape `[px]`.
const USUAL: [u32; 2] = [1600, 900];
/// Room beside what a narrower picture would cut off `[1]`: beside walls, and beside points, which pins and springs are wider than.
const ROOM: f64 = 1.03;
const OUTER: f64 = 1.09;
/// The same in a picture of space, beside all of it, as a share of its lesser side `[1]`.
const BORDER: f64 = 0.03;

/// Least width of what is seen of a scene, in its heights `[1]`.
const SLIMMEST: f64 = 0.75;

/// The camera of a scene's `view`; what that leaves out fits the scene.
pub fn camera(scene: &Scene, seen: &View<'_>, size: [u32; 2]) -> Camera {
    let [width, tall] = size.map(f64::from);
    let height = |height: f64, center: DVec2| height.max(across(scene, height, center.x, seen) * tall / width);
    if roaming::roams(scene, seen, size) {
        return roaming::camera(scene, seen, size);
    }
    let camera = look(scene.view.as_ref(), height, fitted(seen, true, swung(scene, seen), size));
    let Pose::Orbit { .. } = camera.pose else { return camera };
    // In space what a narrower picture cuts off is seen from further away.
    let border = BORDER * width.min(tall);
    match width < MADE_FOR * tall {
        true => whole(camera, seen, [[border; 2], [width - border, tall - border]]),
        false => camera,
    }
}

/// The same, drawn back and moved so that what it shows lies where nothing lies over it: in the free part of its picture, and below what lies in
/// its upper right corner. In space there is as much room on the other side of what the view looks at as bodies take on theirs: they may begin
/// above it and end below.
pub fn opened(scene: &Scene, seen: &View<'_>, size: [u32; 2], (free, over): (Free, Over)) -> Camera {
    let opened = camera(scene, seen, size);
    match opened.pose {
        Pose::Plane { .. } => {
            let swung = swung(scene, seen);
            beside_all(|free| clear_with(opened, seen, swung, free), seen, (free, over))
        }
        Pose::Orbit { .. } => {
            let target = look(scene.view.as_ref(), |height, _| height, fit(seen, true, size)).focus();
            let about = |camera: &Camera| mirrored(on_screen(camera, seen), camera.screen_from_world(target));
            beside_all(|free| drawn_back(opened, free, about), seen, (free, over))
        }
    }
}

/// The same in the first of the panes of a window, of which panels leave `area` `[px]`: only one that is alone makes way for what lies in the
/// upper right corner, for others have titles there.
pub fn opened_in(scene: &Scene, seen: &View<'_>, tiles: &Tiles, (area, free, over): ([u32; 2], Free, Over)) -> Camera {
    let pane = tiles.pane(area);
    let over = if tiles.count() == 1 { over } else { Over::default() };
    opened(scene, seen, pane, (free_of_pane(pane, (area, free)), over))
}

/// The camera of a scene in a picture of usual shape: what is measured by it does not depend on the window.
pub fn alone(scene: &Scene, seen: &View<'_>) -> Camera {
    camera(scene, seen, USUAL)
}

/// The camera as it stood when something was saved.
pub fn saved(view: &ViewKeys, seen: &View<'_>, size: [u32; 2]) -> Camera {
    look(Some(view), |height, _| height, fit(seen, true, size))
}

/// A camera with what a view says of it.
fn look(view: Option<&ViewKeys>, height_at: impl Fn(f64, DVec2) -> f64, mut camera: Camera) -> Camera {
    let Some(view) = view else { return camera };
    match &mut camera.pose {
        Pose::Plane { center, height } => {
            *center = view.center.map_or(*center, |at| DVec3::from(at.embed()).truncate());
            *height = view.height.map_or(*height, |height| height_at(height, *center));
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

/// A camera as a file has it.
pub fn keys(camera: &Camera) -> ViewKeys {
    match camera.pose {
        Pose::Plane { center, height } => {
            ViewKeys { center: Some(Vector::Plane(center.to_array())), height: Some(height), ..ViewKeys::default() }
        }
        Pose::Orbit { target, distance, yaw, pitch } => ViewKeys {
            target: Some(Vector::Space(target.to_array())),
            distance: Some(distance),
            yaw: Some(yaw),
            pitch: Some(pitch),
            ..ViewKeys::default()
        },
    }
}

/// How much a picture narrower than views are made for shows across `[m]`, of a view so high: what the scene says, else so much that nothing of
/// points and walls is cut off to the sides which one of usual width shows.
fn across(scene: &Scene, height: f64, center: f64, view: &View<'_>) -> f64 {
    let shown = |extent: [[f64; 3]; 2]| {
        let sides = extent.map(|corner| (corner[0] - center).abs());
        sides.into_iter().filter(|&side| side <= 0.5 * MADE_FOR * height).fold(0.0, f64::max)
    };
    let wide = (2.0 * OUTER * shown(points(view))).max(2.0 * ROOM * shown(surroundings(view)));
    // In a picture higher than wide there is room beside what is slim, too.
    said_width(scene).unwrap_or(wide.max(SLIMMEST * height))
}

fn said_width(scene: &Scene) -> Option<f64> {
    scene.view.as_ref().and_then(|view| view.width)
}

/// A camera that shows all points, with walls and polygons too or without. Where there are no points it shows those anyway.
pub fn fit(view: &View<'_>, with_walls: bool, size: [u32; 2]) -> Camera {
    fitted(view, with_walls, None, size)
}

/// The same that shows one more box, if there is one `[m]`.
fn fitted(view: &View<'_>, with_walls: bool, more: Option<[[f64; 3]; 2]>, size: [u32; 2]) -> Camera {
    let dimensions = view.dimensions;
    let mut corners = points(view);
    more.iter().flatten().for_each(|corner| include(&mut corners, corner));
    if with_walls || view.current.is_empty() {
        surroundings(view).iter().for_each(|corner| include(&mut corners, corner));
    }
    let seen = (0..dimensions).all(|axis| corners[0][axis].is_finite() && corners[1][axis].is_finite());
    let corners = if seen { corners } else { [[-1.0; 3], [1.0; 3]] };
    let flat = |corner: [f64; 3]| corner.map(|c| if c.is_finite() { c } else { 0.0 });
    Camera::fit(corners.map(flat), dimensions, size)
}

/// A camera that shows all points in the free part of a picture.
pub fn fit_in(view: &View<'_>, free: Free, size: [u32; 2]) -> Camera {
    let [low, high] = free.map(DVec2::from);
    let room = (high - low).max(DVec2::ONE);
    let mut camera = fit(view, false, room.to_array().map(|side| side.round() as u32));
    let whole = DVec2::from(size.map(f64::from));
    match &mut camera.pose {
        Pose::Plane { height, .. } => *height *= whole.y / room.y,
        Pose::Orbit { distance, .. } => *distance *= whole.y / room.y,
    }
    camera.resize(size);
    camera.pan((0.5 * (low + high) - 0.5 * whole).to_array());
    camera
}
