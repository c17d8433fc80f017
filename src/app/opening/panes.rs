//! Worlds side by side: how they share a window, and what a pane shows that gets another size.

use super::clearing::{Free, clear, whole};
use super::extent::{points, surroundings};
use super::{MADE_FOR, ROOM, SLIMMEST, alone, said_width};
use crate::render::{Camera, Pose, Tiles, View};
use crate::scene::Scene;

/// How `count` worlds of a scene share a picture of `size` `[px]`; `alone` is its camera in a picture of usual shape. `taken` is what of each pane's
/// width and height is not for the world `[px]`, below what lies over the upper edge of the picture, so high.
pub fn tiles(
    (scene, alone): (&Scene, &Camera),
    seen: &View<'_>,
    (count, size): (usize, [u32; 2]),
    taken: ([f64; 2], f64),
) -> Tiles {
    if count < 2 {
        return Tiles::ALONE;
    }
    let (center, height) = (alone.focus(), alone.height());
    let width = match alone.pose {
        Pose::Plane { .. } => {
            let sides = [points(seen), surroundings(seen)].map(|extent| extent.map(|at| (at[0] - center.x).abs()));
            let shown = |side: &f64| *side <= 0.5 * MADE_FOR * height;
            let shown = sides.into_iter().flatten().filter(shown).fold(0.0, f64::max);
            said_width(scene).unwrap_or((2.0 * ROOM * shown).max(SLIMMEST * height))
        }
        Pose::Orbit { .. } => height,
    };
    Tiles::new(count, [width, height], size, taken)
}

/// How `count` worlds of a scene share what panels leave of the window, `area` `[px]`, of which nothing lies over the part `free`: above that
/// stand titles, so high, which each world has, and above these what all of them have once.
pub fn shared(scene: &Scene, seen: &View<'_>, count: usize, (area, free, titles): ([u32; 2], Free, f64)) -> Tiles {
    let [low, high] = free;
    let head = (low[1] - titles).max(0.0);
    let [across, down] = [0, 1].map(|axis| (f64::from(area[axis]) - (high[axis] - low[axis])).max(0.0));
    tiles((scene, &alone(scene, seen)), seen, (count, area), ([across, (down - head).max(0.0)], head))
}

/// The camera of a pane that a panel takes room from, or gives some back: as large as before, with the same place in the left upper corner, and
/// only where that would leave out what was seen, moved and drawn back by as little as it takes. `free` is what nothing lies over of the pane,
/// which is of `size` `[px]` now.
pub fn narrowed(mut own: Camera, seen: &View<'_>, size: [u32; 2], free: Free) -> Camera {
    let before = own.viewport();
    if (0..2).any(|axis| f64::from(size[axis]) < f64::from(before[axis])) {
        own = match own.pose {
            Pose::Plane { .. } => clear(own, seen, free),
            Pose::Orbit { .. } => whole(own, seen, free),
        };
    }
    own.resize_still(size);
    own
}

/// What nothing lies over of a pane of this size `[px]`: at each side as much is left out as what lies over the picture takes there.
pub fn free_of_pane(pane: [u32; 2], (area, free): ([u32; 2], Free)) -> Free {
    let [low, high] = free;
    let ends = [0, 1].map(|axis| high[axis] - f64::from(area[axis]) + f64::from(pane[axis]));
    let has_room = (0..2).all(|axis| ends[axis] > low[axis]);
    if has_room { [low, ends] } else { [[0.0; 2], pane.map(f64::from)] }
}
