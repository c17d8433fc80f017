//! Guides: the grid of the plane with its numbers, the walls, and planes in space, as strokes.

use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3};

use super::camera::{Camera, Pose};
use super::look::{Color, Look};
use super::numerals;
use super::obstacles::{Patch, RIM};
use super::view::{Hinge, View, Ways};
use crate::sim::PointId;

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

/// The guides of a picture, those below first, and how many of them lie below obstacles, over these (the numbers of the grid), and over all
/// else (the marks of motors). Positions relative to `origin` `[m]`.
pub(super) fn guides(
    (view, camera, patches): (&View<'_>, &Camera, &[Patch]),
    (clip, border): ([u32; 4], Option<[DVec3; 2]>),
    origin: DVec3,
    look: &Look,
) -> (Vec<Guide>, [usize; 3]) {
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
    let stretches = view.trails.iter().enumerate().rev().flat_map(|(place, (trails, color))| {
        trails
            .stretches(view, place == 0)
            .into_iter()
            .map(move |stretch| (stretch, look.trails[color % look.trails.len()]))
    });
    for (([a, b], fresh), [red, green, blue, opacity]) in stretches {
        let color = [red, green, blue, opacity * (fresh * fresh) as f32];
        list.push(guide(a - origin, b - origin, look.outline_width * look.scale_factor, color));
    }
    list.extend(border.map(|[a, b]| guide(a - origin, b - origin, BORDER * look.scale_factor, look.wall)));
    let below = list.len();
    if let Pose::Plane { center, height } = camera.pose
        && look.has_grid
        && let Some(seen) = seen(camera, center, height)
    {
        numbers(&mut list, (camera, view.covered, bounds), (clip, seen), origin, look);
    }
    let over = list.len();
    if let Pose::Plane { .. } = camera.pose {
        view.hinges.iter().for_each(|hinge| motor(&mut list, camera, (view, hinge), origin, look));
    }
    let counts = [below, over - below, list.len() - over];
    (list, counts)
}

/// Arcs of motors: their radius beside the shorter arm `[1]`, at least and at most `[px]`, and their width `[px]`; arms shorter than the last are
/// not marked `[px]`.
const ARC_SHARE: f64 = 0.4;
const ARC: [f64; 2] = [8.0, 17.0];
const ARC_WIDTH: f32 = 2.2;
const LEAST_ARM: f64 = 7.0;
/// Half of an arc `[rad]`, in so many strokes, and the length of its heads `[px]`.
const HALF_ARC: f64 = 2.2;
const ARC_STROKES: u32 = 22;
const HEAD: f64 = 5.5;

/// Adds the mark of a hinge that is driven: an arc about it that goes along with what it turns, with a head each way that it turns.
fn motor(list: &mut Vec<Guide>, camera: &Camera, (view, hinge): (&View<'_>, &Hinge), origin: DVec3, look: &Look) {
    let count = view.current.len() / 2;
    if hinge.points.iter().any(|point| point.index() >= count) {
        return;
    }
    let mix = f64::from(view.mix);
    let place = |point: PointId| {
        let at = |axis: usize| {
            let index = 2 * point.index() + axis;
            view.previous.get(index) * (1.0 - mix) + view.current.get(index) * mix
        };
        DVec2::new(at(0), at(1))
    };
    let [from, middle, to] = hinge.points.map(place);
    let (scale, metre) = (f64::from(look.scale_factor), camera.pixels_per_metre());
    let arms = [from, to].map(|end| end.distance(middle) * metre / scale);
    // A hub may lie on what holds it.
    if !(arms[0].max(arms[1]) >= LEAST_ARM && metre.is_normal()) {
        return;
    }
    let pixel = scale / metre;
    let radius = (ARC_SHARE * arms[0].min(arms[1])).clamp(ARC[0], ARC[1]) * pixel;
    let start = (to - middle).to_angle();
    let at = |angle: f64, radius: f64| middle + radius * DVec2::from_angle(start + angle);
    let mut line = |a: DVec2, b: DVec2| {
        let width = ARC_WIDTH * look.scale_factor;
        list.push(guide(a.extend(0.0) - origin, b.extend(0.0) - origin, width, look.motor));
    };
    let angle = |k: u32| HALF_ARC * (2.0 * f64::from(k) / f64::from(ARC_STROKES) - 1.0);
    (0..ARC_STROKES).for_each(|k| line(at(angle(k), radius), at(angle(k + 1), radius)));
    for (way, has_head) in [(1.0, hinge.ways != Ways::Right), (-1.0, hinge.ways != Ways::Left)] {
        let back = way * (HALF_ARC - HEAD * pixel / radius);
        for side in [-0.6, 0.6] {
            if has_head {
                line(at(back, radius + side * HEAD * pixel), at(way * HALF_ARC, radius));
            }
        }
    }
}

/// The corners of what is seen of the plane `[m]`; `None` where the picture's edges are the same number, so far out or so near, or not
/// finite.
fn seen(camera: &Camera, center: DVec2, height: f64) -> Option<(DVec2, DVec2)> {
    let [width_px, height_px] = camera.viewport();
    let half = 0.5 * DVec2::new(height * f64::from(width_px) / f64::from(height_px), height);
    let (low, high) = (center - half, center + half);
    let is_fine = low.cmplt(high).all() && low.is_finite() && high.is_finite();
    (is_fine && spacing(camera.pixels_per_metre(), 1.0).is_normal()).then_some((low, high))
}

fn guide(a: DVec3, b: DVec3, width: f32, color: Color) -> Guide {
    Guide { a: a.as_vec3().extend(width).to_array(), b: b.as_vec3().extend(0.0).to_array(), color }
}

/// Distance between lines of the grid `[m]`: 1, 2 or 5 times a power of ten, not closer than [`CLOSEST`] on the screen; 2 only where each has
/// room for its number, for of every second or third of these no number is 1, 2 or 5.
fn spacing(pixels_per_metre: f64, scale_factor: f32) -> f64 {
    let least = CLOSEST / pixels_per_metre;
    let decade = 10_f64.powf(least.log10().floor());
    let has_room = |first: f64| first != 2.0 || first * decade * pixels_per_metre >= APART[0] * f64::from(scale_factor);
    let firsts = [1.0, 2.0, 5.0, 10.0].into_iter().filter(|&first| first * decade >= least && has_room(first));
    firsts.map(|first| first * decade).next().unwrap_or(decade)
}

/// Adds the lines of the grid; none where nothing is [`seen`].
fn grid(list: &mut Vec<Guide>, camera: &Camera, center: DVec2, height: f64, origin: DVec3, look: &Look) {
    let Some((low, high)) = seen(camera, center, height) else { return };
    let step = spacing(camera.pixels_per_metre(), look.scale_factor);
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
/// Below them is ground, so much wider `[px]` and so opaque `[1]`: they are read on bodies and lines too.
pub(super) const HALO: [f32; 2] = [3.2, 0.75];
const APART: [f64; 2] = [90.0, 60.0];
/// Least gap between two in a row `[px]`.
const GAP: f64 = 24.0;

/// Numbers along the left edge stand to the right of what lies there where that leaves place for more of them: so far at most, as a share
/// of the picture's width, and where the edge itself has less than this share of the place `[1]`.
const ASIDE: f64 = 0.4;
const ENOUGH: f64 = 0.5;
/// Width that they take `[px]`, and from one look at what lies over them to the next.
const COLUMN: f64 = 56.0;
const LOOK: f64 = 8.0;

/// Distance between numbers of the grid `[m]`: 1, 2 or 5 times a power of ten, and of the lines `step` `[m]` apart, not closer than `apart`
/// on the screen. It depends on the scale alone, not on what is seen.
fn between_numbers(step: f64, metre: f64, apart: f64) -> f64 {
    let decade = 10_f64.powf(step.log10().floor());
    let steps = (0..4).flat_map(|power| [1.0, 2.0, 5.0].map(|first| first * 10_f64.powi(power) * decade));
    // 2 times 1 is a step between lines that are 1 apart, 5 times 1 none between those that are 2 apart.
    let is_of_lines = |wide: &f64| (wide / step - (wide / step).round()).abs() < 1e-6;
    let mut steps = steps.filter(|wide| *wide > (1.0 - 1e-9) * step).filter(is_of_lines);
    steps.find(|wide| wide * metre >= apart).unwrap_or(1e3 * step)
}

/// The widest that a number of the grid is as far from the origin as `far` `[m]`, in whole powers of ten: where one more digit comes in on
/// one side nothing else changes.
fn widest(far: f64, steps: [f64; 2], size: f64) -> f64 {
    let whole = 10_f64.powf(far.max(steps[0]).log10().ceil().clamp(-300.0, 300.0));
    numerals::strokes(&numerals::length(-0.888_888_888 * whole, steps), size).1
}

/// The lower and the upper corner of what walls bound `[m]`.
type Walls = [[f64; 3]; 2];

/// Adds the numbers of the grid: along the lower edge of a part of the picture and its left one, in steps of 1, 2 or 5, where nothing lies
/// over them. `clip` is left, top, width and height of that part `[px]`, the corners are those of the picture `[m]`.
fn numbers(
    list: &mut Vec<Guide>,
    (camera, covered, bounds): (&Camera, &[[f32; 4]], Option<Walls>),
    (clip, (low, high)): ([u32; 4], (DVec2, DVec2)),
    origin: DVec3,
    look: &Look,
) {
    let scale = f64::from(look.scale_factor);
    let lines = spacing(camera.pixels_per_metre(), look.scale_factor);
    let metre = camera.pixels_per_metre();
    let [left, top, width, height] = clip.map(f64::from);
    let low = DVec2::new(low.x + left / metre, high.y - (top + height) / metre);
    let high = low + DVec2::new(width, height) / metre;
    if look.number[3] == 0.0 || !low.cmplt(high).all() {
        return;
    }
    let far = low.abs().max(high.abs()).max_element();
    let inset = f64::from(look.inset) * scale;
    for axis in 0..2 {
        let apart = APART[axis] * scale;
        let step = between_numbers(lines, metre, apart);
        let wide = widest(far, [step, lines], DIGITS * scale) + GAP * scale;
        let step = if axis == 0 && wide > apart { between_numbers(lines, metre, wide) } else { step };
        let walls = bounds.map(|ends| ends.map(|end| (end[0] - low.x) * metre - EDGE * scale - inset));
        let column = match axis {
            1 => beside_walls(column(covered, clip, (EDGE * scale + inset, scale)), walls, scale),
            _ => 0.0,
        };
        let (first, last) = ((low[axis] / step).ceil(), (high[axis] / step).floor());
        for line in 0..=((last - first) as i64) {
            let at = (first + line as f64) * step;
            let (strokes, width) = numerals::strokes(&numerals::length(at, [step, lines]), DIGITS * scale);
            // Along the lower edge under the middle of its line, along the left edge just above it.
            let mut corner = low + EDGE * scale / metre;
            corner.x += (inset + column) / metre;
            corner[axis] = at + [-0.5 * width, 3.0 * scale][axis] / metre;
            // What would be cut off, or lies in the corner where both meet, is left out.
            let room = [30.0, 26.0][axis] * scale / metre;
            let beside = if axis == 0 { inset / metre } else { 0.0 };
            if corner[axis] < low[axis] + beside + room || at > high[axis] - room {
                continue;
            }
            let size = DVec2::new(width, DIGITS * numerals::TALL * scale);
            let there = DVec2::new(corner.x - low.x, high.y - corner.y) * metre - DVec2::new(0.0, size.y);
            let there = there + DVec2::new(left, top);
            if lies_over(covered, there, there + size).is_some() {
                continue;
            }
            let place = |end: DVec2| (corner + end / metre).extend(0.0) - origin;
            let [red, green, blue, _] = look.ground;
            let halo = (NUMBER_WIDTH + HALO[0], [red, green, blue, HALO[1]]);
            for (width, color) in [halo, (NUMBER_WIDTH, look.number)] {
                let width = width * look.scale_factor;
                list.extend(strokes.iter().map(|&[a, b]| guide(place(a), place(b), width, color)));
            }
        }
    }
}

/// What lies over a box `[px]`.
fn lies_over(covered: &[[f32; 4]], low: DVec2, high: DVec2) -> Option<[f64; 4]> {
    let over =
        |&[left, top, right, bottom]: &[f64; 4]| low.x < right && high.x > left && low.y < bottom && high.y > top;
    covered.iter().map(|side| side.map(f64::from)).find(over)
}

/// How far all numbers along the left edge go to the right `[px]`: as far as it takes for most of the edge's height to be free. It depends on
/// what lies over the picture alone, so that no number moves aside by itself.
fn column(covered: &[[f32; 4]], clip: [u32; 4], (inset, scale): (f64, f64)) -> f64 {
    let [left, top, width, height] = clip.map(f64::from);
    let free = |by: f64| {
        let x = left + inset + by;
        let rows = (height / (LOOK * scale)).floor() as u32;
        let is_free = |row: &u32| {
            let y = top + LOOK * scale * f64::from(*row);
            lies_over(covered, DVec2::new(x, y), DVec2::new(x + COLUMN * scale, y + LOOK * scale)).is_none()
        };
        (0..rows).filter(is_free).count() as f64
    };
    let beside = covered.iter().map(|side| f64::from(side[2]) + EDGE * scale - left - inset);
    let mut all: Vec<f64> = beside.filter(|by| *by > 0.0 && inset + by < ASIDE * width).chain([0.0]).collect();
    all.sort_by(f64::total_cmp);
    let best = all.iter().map(|by| free(*by)).fold(0.0, f64::max);
    all.into_iter().find(|by| free(*by) >= ENOUGH * best).unwrap_or(0.0)
}

/// The same where a column that makes way for something would lie on a wall: right of that. The places of walls are right of the column at
/// the edge `[px]`, which the view leaves free.
fn beside_walls(column: f64, walls: Option<[f64; 2]>, scale: f64) -> f64 {
    let on = |at: &f64| column > 0.0 && (column - EDGE * scale..column + COLUMN * scale).contains(at);
    walls.into_iter().flatten().find(on).map_or(column, |at| at + EDGE * scale)
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
    use crate::sim::Bonds;

    /// The guides of a world that has the picture for itself.
    fn drawn(view: &View<'_>, camera: &Camera, origin: DVec3, look: &Look) -> (Vec<Guide>, [usize; 3]) {
        let [width, height] = camera.viewport().map(|side| side as u32);
        guides((view, camera, &[]), ([0, 0, width, height], None), origin, look)
    }

    #[test]
    fn grid_lines_are_round_numbers_apart() {
        assert_eq!(spacing(100.0, 1.0), 0.5);
        assert_eq!(spacing(45.0, 1.0), 1.0);
        assert_eq!(spacing(1.0, 1.0), 50.0);
        assert_eq!([spacing(46.0, 1.0), spacing(44.0, 1.0), spacing(30.0, 1.0)], [1.0, 5.0, 5.0]);
    }

    #[test]
    fn there_is_no_grid_where_numbers_end() {
        let count = |center: DVec2, height: f64| {
            let camera = Camera::new(Pose::Plane { center, height }, [640, 480]);
            drawn(&View::empty(&Bonds::default(), 2), &camera, camera.focus(), &Look::default()).0.len()
        };
        assert!((10..2000).contains(&count(DVec2::splat(1e3), 1e-3)));
        assert_eq!(count(DVec2::splat(1e20), 1e-6), 0, "both edges are the same number");
        assert_eq!(count(DVec2::new(0.0, 1e20), 1.0), 0);
        for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e-320, f64::MAX] {
            assert!(count(DVec2::ZERO, bad) < 1000, "{bad}");
            assert!(count(DVec2::splat(bad), 1.0) < 1000, "{bad}");
        }
    }

    #[test]
    fn numbers_come_last_each_on_ground_of_its_own() {
        let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 8.0 }, [640, 480]);
        let of = |look: Look| drawn(&View::empty(&Bonds::default(), 2), &camera, DVec3::ZERO, &look);
        let (all, [below, ..]) = of(Look::default());
        let bare = of(Look { number: [0.0; 4], ..Look::default() });
        assert_eq!((bare.0.len(), bare.1), (below, [below, 0, 0]), "lines alone lie below");
        let is = |guide: &&Guide| guide.color == Look::default().number;
        let digits = all[below..].iter().filter(is).count();
        assert!(digits > 50 && all.len() == below + 2 * digits, "each stroke has a wider one below it");
        assert!(!is(&&all[below]) && all.last().as_ref().is_some_and(is));
    }

    #[test]
    fn numbers_stay_clear_of_what_lies_over_the_picture() {
        let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 8.0 }, [640, 480]);
        let places = |covered: &[[f32; 4]]| {
            let bonds = Bonds::default();
            let view = View { covered, ..View::empty(&bonds, 2) };
            let (all, [below, ..]) = drawn(&view, &camera, DVec3::ZERO, &Look::default());
            let ends = all[below..].iter().flat_map(|guide| [guide.a, guide.b]);
            ends.map(|[x, y, ..]| [320.0 + 60.0 * x, 240.0 - 60.0 * y]).collect::<Vec<_>>()
        };
        let within = |[left, top, right, bottom]: [f32; 4], list: &[[f32; 2]]| {
            list.iter().filter(|[x, y]| (left..right).contains(x) && (top..bottom).contains(y)).count()
        };
        let free = places(&[]);
        let panel = [0.0, 100.0, 150.0, 300.0];
        let message = [200.0, 440.0, 400.0, 480.0];
        assert!(within(panel, &free) > 20 && within(message, &free) > 10, "there are numbers there");
        let clear = places(&[panel, message]);
        assert_eq!([within(panel, &clear), within(message, &clear)], [0, 0]);
        assert_eq!(within([150.0, 0.0, 250.0, 430.0], &clear), 0, "most of the edge is free: they stay there");
        let tall = places(&[[0.0, 60.0, 150.0, 380.0]]);
        assert!(within([150.0, 60.0, 250.0, 380.0], &tall) > 20, "beside a panel along most of it");
        let wide = places(&[[0.0, 100.0, 500.0, 300.0]]);
        assert_eq!(within([0.0, 100.0, 640.0, 300.0], &wide), 0, "too far away");
        let x_of = |list: &[[f32; 2]]| {
            let at_left = list.iter().filter(|[_, y]| *y < 430.0);
            at_left.map(|[x, _]| *x).fold(f32::INFINITY, f32::min)
        };
        assert!(x_of(&clear) < 10.0 && x_of(&tall) > 150.0, "all of them in one column");
        let on_wall = |x: f64| {
            let bonds = Bonds::default();
            let bounds = Some([[x, -3.0, 0.0], [x + 4.0, 3.0, 0.0]]);
            let view = View { covered: &[[0.0, 60.0, 150.0, 380.0]], bounds, ..View::empty(&bonds, 2) };
            let (all, [below, over, _]) = drawn(&view, &camera, DVec3::ZERO, &Look::default());
            let ends = all[below..below + over].iter().flat_map(|guide| [guide.a, guide.b]);
            x_of(&ends.map(|[x, y, ..]| [320.0 + 60.0 * x, 240.0 - 60.0 * y]).collect::<Vec<_>>())
        };
        assert!(on_wall(-2.5) > 171.0, "right of a wall at 170: {}", on_wall(-2.5));
        assert_eq!(on_wall(0.0), x_of(&tall), "one that lies elsewhere moves none");
    }

    #[test]
    fn numbers_are_in_steps_of_1_2_or_5_whatever_is_seen() {
        let leading = |x: f64| (x / 10_f64.powf((x.log10() + 1e-9).floor())).round();
        for k in 0..400 {
            let metre = 0.01 * 1.03_f64.powi(k);
            let lines = spacing(metre, 1.0);
            for apart in [60.0, 90.0, 140.0] {
                let step = between_numbers(lines, metre, apart);
                assert!([1.0, 2.0, 5.0].contains(&leading(step)), "{step} for {lines}");
                assert!((step / lines - (step / lines).round()).abs() < 1e-9, "{step} is no multiple of {lines}");
                assert!(step * metre >= apart && step * metre < 5.1 * apart.max(lines * metre), "{step} at {metre}");
            }
        }
        let all = [9.9, 10.1, -10.1].map(|far: f64| widest(far.abs(), [0.5, 0.5], 1.0));
        assert_eq!(all[1], all[2]);
    }

    #[test]
    fn each_part_of_a_picture_has_numbers_along_its_own_edges() {
        let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 8.0 }, [640, 480]);
        let bonds = Bonds::default();
        let numbers = |clip| {
            let (all, [below, ..]) =
                guides((&View::empty(&bonds, 2), &camera, &[]), (clip, None), DVec3::ZERO, &Look::default());
            let ends = all[below..].iter().flat_map(|guide| [guide.a, guide.b]);
            ends.map(|[x, y, ..]| [320.0 + 60.0 * x, 240.0 - 60.0 * y]).collect::<Vec<_>>()
        };
        let right = numbers([320, 0, 320, 480]);
        assert!(right.iter().all(|[x, _]| (320.0..=640.0).contains(x)), "{right:?}");
        let beside = right.iter().filter(|[x, y]| *x < 360.0 && *y < 440.0).count();
        assert!(beside > 30, "y at the left edge of the right half: {beside} ends");
        assert!(numbers([0, 0, 640, 240]).iter().all(|[_, y]| *y <= 240.0), "x above the lower half");
    }

    #[test]
    fn a_motor_has_an_arc_about_its_hinge_with_a_head_where_it_turns() {
        let camera = Camera::new(Pose::Plane { center: DVec2::ZERO, height: 8.0 }, [640, 480]);
        let (bonds, places) = (Bonds::default(), [-1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        let of = |ways: Ways, places: &[f64]| {
            let current = crate::sim::Positions::F64(places);
            let hinges = vec![Hinge { points: [0, 1, 2].map(PointId), ways }];
            let view = View { hinges, previous: current, current, ..View::empty(&bonds, 2) };
            let (all, [below, over, marks]) = drawn(&view, &camera, DVec3::ZERO, &Look::default());
            assert_eq!(all.len(), below + over + marks);
            all[below + over..].to_vec()
        };
        let left = of(Ways::Left, &places);
        assert_eq!([left.len(), of(Ways::Both, &places).len()], [24, 26]);
        let tip = left.last().map(|guide| [guide.b[0], guide.b[1]]).unwrap_or_default();
        assert!(tip[0] < 0.0 && tip[1] < 0.0, "anticlockwise from above it comes by the left: {tip:?}");
        assert_eq!(of(Ways::Left, &places.map(|x| 0.01 * x)).len(), 0, "too small to be seen");
        assert_eq!(of(Ways::Left, &[-0.01, 0.0, 0.0, 0.0, 0.0, 1.0]).len(), 24, "its hub lies on what holds it");
        assert_eq!(of(Ways::Left, &places[..4]).len(), 0, "of points that are gone");
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
        assert!(drawn(&View::empty(&Bonds::default(), 3), &camera, DVec3::ZERO, &Look::default()).0.is_empty());
    }
}
