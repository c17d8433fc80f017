//! Guides: the grid of the plane with its numbers, the walls, and planes in space, as strokes.

use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3};

use super::camera::{Camera, Pose};
use super::look::{Color, Look};
use super::numerals;
use super::obstacles::{Patch, RIM};
use super::view::View;

/// A stroke as the shader reads it: `Guide` in guides.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Guide {
    a: [f32; 4],
    b: [f32; 4],
    color: Color,
}

const _: () = assert!(size_of::<Guide>() == 48);

/// Least distance between lines of the grid `[px]`.
const CLOSEST: f64 = 45.0;

/// Width of the line between two worlds `[px]`: half of it lies in either.
const BORDER: f32 = 3.0;
/// Opacity of a plane's rim in space, where it ends nowhere, beside that of walls `[1]`.
const PATCH_RIM: f32 = 0.6;

/// The guides of a picture, those below first, and how many of them lie below obstacles: the numbers of the grid, which come last, are
/// read on those too. Positions relative to `origin` `[m]`.
pub(super) fn guides(
    camera: &Camera,
    (view, patches, border): (&View<'_>, &[Patch], Option<[DVec3; 2]>),
    origin: DVec3,
    look: &Look,
) -> (Vec<Guide>, usize) {
    let (bounds, dimensions) = (view.bounds, view.dimensions);
    let mut list = Vec::new();
    if let Pose::Plane { center, height } = camera.pose
        && look.has_grid
    {
        grid(&mut list, camera, center, height, origin, look);
    }
    if let Some(bounds) = bounds {
        if dimensions == 3 && look.has_grid && patches.is_empty() {
            floor(&mut list, bounds, origin, look);
        }
        walls(&mut list, bounds, dimensions, origin, look);
    }
    for (k, [a, b]) in patches.iter().flat_map(|patch| patch.lines.iter().enumerate()) {
        let [red, green, blue, opacity] = look.wall;
        let color = if k < RIM { [red, green, blue, PATCH_RIM * opacity] } else { look.axis };
        list.push(guide(a - origin, b - origin, look.scale_factor, color));
    }
    for ([a, b], fresh) in view.trails.map(|trails| trails.stretches(view)).unwrap_or_default() {
        let [red, green, blue, opacity] = look.trail;
        let color = [red, green, blue, opacity * (fresh * fresh) as f32];
        list.push(guide(a - origin, b - origin, look.outline_width * look.scale_factor, color));
    }
    list.extend(border.map(|[a, b]| guide(a - origin, b - origin, BORDER * look.scale_factor, look.wall)));
    let below = list.len();
    if let Pose::Plane { center, height } = camera.pose
        && look.has_grid
        && let Some(seen) = seen(camera, center, height)
    {
        numbers(&mut list, camera, seen, origin, look);
    }
    (list, below)
}

/// The corners of what is seen of the plane `[m]`; `None` where the picture's edges are the same number, so far out or so near, or not
/// finite.
fn seen(camera: &Camera, center: DVec2, height: f64) -> Option<(DVec2, DVec2)> {
    let [width_px, height_px] = camera.viewport();
    let half = 0.5 * DVec2::new(height * f64::from(width_px) / f64::from(height_px), height);
    let (low, high) = (center - half, center + half);
    let is_fine = low.cmplt(high).all() && low.is_finite() && high.is_finite();
    (is_fine && spacing(camera.pixels_per_metre()).is_normal()).then_some((low, high))
}

fn guide(a: DVec3, b: DVec3, width: f32, color: Color) -> Guide {
    Guide { a: a.as_vec3().extend(width).to_array(), b: b.as_vec3().extend(0.0).to_array(), color }
}

/// Distance between lines of the grid `[m]`: 1, 2 or 5 times a power of ten, not closer than [`CLOSEST`] on the screen.
fn spacing(pixels_per_metre: f64) -> f64 {
    let least = CLOSEST / pixels_per_metre;
    let decade = 10_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|step| step * decade).into_iter().find(|&step| step >= least).unwrap_or(decade)
}

/// Adds the lines of the grid; none where nothing is [`seen`].
fn grid(list: &mut Vec<Guide>, camera: &Camera, center: DVec2, height: f64, origin: DVec3, look: &Look) {
    let Some((low, high)) = seen(camera, center, height) else { return };
    let step = spacing(camera.pixels_per_metre());
    for axis in 0..2 {
        let (first, last) = ((low[axis] / step).ceil(), (high[axis] / step).floor());
        for line in 0..=((last - first) as i64) {
            let at = (first + line as f64) * step;
            let mut ends = [low.extend(0.0), high.extend(0.0)];
            for end in &mut ends {
                end[axis] = at;
            }
            let color = if at == 0.0 { look.axis } else { look.grid };
            list.push(guide(ends[0] - origin, ends[1] - origin, look.scale_factor, color));
        }
    }
}

/// Numbers of the grid: height of their digits, room from the picture's edge, and width of their strokes `[px]`; least distance between
/// two along each axis `[px]`.
const DIGITS: f64 = 1.15;
const EDGE: f64 = 6.0;
const NUMBER_WIDTH: f32 = 1.15;
const APART: [f64; 2] = [90.0, 60.0];
/// Least gap between two in a row `[px]`.
const GAP: f64 = 24.0;

/// Adds the numbers of the grid: along the lower edge and the left one, at every line or every second or fifth.
fn numbers(list: &mut Vec<Guide>, camera: &Camera, (low, high): (DVec2, DVec2), origin: DVec3, look: &Look) {
    let scale = f64::from(look.scale_factor);
    let step = spacing(camera.pixels_per_metre());
    let metre = camera.pixels_per_metre();
    if look.number[3] == 0.0 {
        return;
    }
    for axis in 0..2 {
        let wide = |at: f64| numerals::strokes(&numerals::length(at, step), DIGITS * scale).1;
        let widest = if axis == 0 { wide(low.x).max(wide(high.x)) + GAP * scale } else { 0.0 };
        let apart = widest.max(APART[axis] * scale);
        let every = [1.0, 2.0, 5.0, 10.0, 20.0].into_iter().find(|every| every * step * metre >= apart);
        let step = every.unwrap_or(50.0) * step;
        let (first, last) = ((low[axis] / step).ceil(), (high[axis] / step).floor());
        for line in 0..=((last - first) as i64) {
            let at = (first + line as f64) * step;
            let (strokes, width) = numerals::strokes(&numerals::length(at, step), DIGITS * scale);
            // Along the lower edge under the middle of its line, along the left edge just above it.
            let mut corner = low + EDGE * scale / metre;
            corner.x += f64::from(look.inset) * scale / metre;
            corner[axis] = at + [-0.5 * width, 3.0 * scale][axis] / metre;
            // What would be cut off, or lies in the corner where both meet, is left out.
            let room = [30.0, 26.0][axis] * scale / metre;
            let beside = if axis == 0 { f64::from(look.inset) * scale / metre } else { 0.0 };
            if corner[axis] < low[axis] + beside + room || at > high[axis] - room {
                continue;
            }
            let place = |end: DVec2| (corner + end / metre).extend(0.0) - origin;
            let width = NUMBER_WIDTH * look.scale_factor;
            list.extend(strokes.iter().map(|&[a, b]| guide(place(a), place(b), width, look.number)));
        }
    }
}

/// Cells of the floor of walls in space along its longer side.
const FLOOR_CELLS: f64 = 10.0;

/// Adds a grid on the floor of walls in space.
fn floor(list: &mut Vec<Guide>, [low, high]: [[f64; 3]; 2], origin: DVec3, look: &Look) {
    let (low, high) = (DVec3::from(low), DVec3::from(high));
    let step = (high - low).x.max((high - low).z) / FLOOR_CELLS;
    if !(step.is_normal() && step > 0.0) {
        return;
    }
    for axis in [0, 2] {
        for line in 1..((high - low)[axis] / step).ceil() as i64 {
            let mut ends = [low, DVec3::new(high.x, low.y, high.z)];
            ends.iter_mut().for_each(|end| end[axis] = low[axis] + line as f64 * step);
            list.push(guide(ends[0] - origin, ends[1] - origin, look.scale_factor, look.axis));
        }
    }
}

/// The edges of the walls: four in the plane, twelve in space.
fn walls(list: &mut Vec<Guide>, [low, high]: [[f64; 3]; 2], dimensions: usize, origin: DVec3, look: &Look) {
    let corner = |bits: usize| {
        DVec3::from_array(std::array::from_fn(|k| if (bits >> k) & 1 == 1 { high[k] } else { low[k] })) - origin
    };
    for bits in 0..1_usize << dimensions {
        for axis in (0..dimensions).filter(|axis| (bits >> axis) & 1 == 0) {
            let width = look.outline_width * look.scale_factor;
            list.push(guide(corner(bits), corner(bits | (1 << axis)), width, look.wall));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::buffers::tests::empty;
    use crate::sim::Bonds;

    #[test]
    fn grid_lines_are_round_numbers_apart() {
        assert_eq!(spacing(100.0), 0.5);
        assert_eq!(spacing(45.0), 1.0);
        assert_eq!(spacing(1.0), 50.0);
    }

    #[test]
    fn there_is_no_grid_where_numbers_end() {
        let count = |center: DVec2, height: f64| {
            let camera = Camera::new(Pose::Plane { center, height }, [640, 480]);
            guides(&camera, (&empty(&Bonds::default(), 2), &[], None), camera.focus(), &Look::default()).0.len()
        };
        assert!((10..1000).contains(&count(DVec2::splat(1e3), 1e-3)));
        assert_eq!(count(DVec2::splat(1e20), 1e-6), 0, "both edges are the same number");
        assert_eq!(count(DVec2::new(0.0, 1e20), 1.0), 0);
        for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e-320, f64::MAX] {
            assert!(count(DVec2::ZERO, bad) < 1000, "{bad}");
            assert!(count(DVec2::splat(bad), 1.0) < 1000, "{bad}");
        }
    }

    #[test]
    fn numbers_come_last_and_over_obstacles() {
        let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 8.0 }, [640, 480]);
        let of = |look: Look| guides(&camera, (&empty(&Bonds::default(), 2), &[], None), DVec3::ZERO, &look);
        let (all, below) = of(Look::default());
        let bare = of(Look { number: [0.0; 4], ..Look::default() });
        assert_eq!((bare.0.len(), bare.1), (below, below), "lines alone lie below");
        assert!(all.len() > below + 50 && all[below..].iter().all(|guide| guide.color == Look::default().number));
    }

    #[test]
    fn walls_have_four_edges_or_twelve() {
        let camera = Camera::fit([[-1.0; 3], [1.0; 3]], 3, [100, 100]);
        let count = |dimensions| {
            let mut list = Vec::new();
            walls(&mut list, [[-1.0; 3], [1.0; 3]], dimensions, DVec3::ZERO, &Look::default());
            list.len()
        };
        assert_eq!((count(2), count(3)), (4, 12));
        assert!(guides(&camera, (&empty(&Bonds::default(), 3), &[], None), DVec3::ZERO, &Look::default()).0.is_empty());
    }
}
