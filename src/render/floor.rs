//! The floor of a scene in space: a level plane, a little lighter than the ground, with the soft shadow of what is above it.
//!
//! The shadow is worked out here, for it has few cells: what stands above the floor is thrown onto it cell by cell, along the way of the light, and
//! smoothed. The GPU draws a quad of one colour, and over it one that reads four cells a pixel, no larger than the shadow: those reads are what costs a
//! driver without a GPU most.

use glam::DVec3;

use super::look::{Look, luminance};
use super::obstacles::Patch;
use super::view::View;
use crate::sim::Figure;

/// Cells along the longer side of what throws a shadow at least, and room about it for what is smoothed.
const CELLS: f64 = 56.0;
const ROOM: i64 = 6;
/// Cells to each side that a smoothed one is the mean of, and how often that is done.
const REACH: usize = 2;
const TIMES: usize = 2;
/// Triangles, bonds or points from which on there is no shadow: it would take longer than the frame.
const MOST: usize = 40_000;
/// Where light comes from. It stands higher than that of fills: a shadow says where above the floor something is.
const LIGHT: DVec3 = DVec3::new(0.17, 0.82, 0.23);
/// Strength of a shadow on a dark floor and on a light one, and what is left of it from half the floor's width up `[1]`.
const DARK: [f32; 2] = [0.62, 0.3];
const HIGH: f64 = 0.45;
/// How much lighter than the ground a dark floor is, and how much of walls' colour a light one has `[1]`.
const FILL: [f32; 2] = [0.085, 0.05];
/// A plane is a floor where its normal points up so far `[1]`.
const LEVEL: f64 = 0.5;
/// Sides of the polygon that a ball throws its shadow as.
const ROUND: u32 = 20;

/// A rectangle of a level plane: a corner, two sides, and up `[m]`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ground {
    corner: DVec3,
    sides: [DVec3; 2],
    up: DVec3,
}

impl Ground {
    /// Of a scene: the floor of its walls, or the first plane that is level enough.
    fn of(view: &View<'_>, patches: &[Patch]) -> Option<Self> {
        let level = patches.iter().find_map(|patch| {
            let [corner, along] = *patch.lines.first()?;
            let [_, across] = *patch.lines.get(1)?;
            Ground::new(corner, [across - corner, along - corner])
        });
        let walls = || {
            let [low, high] = view.bounds?.map(DVec3::from);
            Ground::new(low, [DVec3::X * (high.x - low.x), DVec3::Z * (high.z - low.z)])
        };
        level.or_else(walls)
    }

    fn new(corner: DVec3, sides: [DVec3; 2]) -> Option<Self> {
        let normal = sides[0].cross(sides[1]).try_normalize()?;
        let up = if normal.y < 0.0 { -normal } else { normal };
        (up.y > LEVEL).then_some(Ground { corner, sides, up })
    }

    /// Where the light throws a place to, along both sides, and how high it was `[m]`; `None`: it lies below.
    fn thrown(&self, place: DVec3) -> Option<[f64; 3]> {
        let off = place - self.corner;
        let high = off.dot(self.up);
        let foot = off - LIGHT * (high / LIGHT.dot(self.up));
        let along = self.sides.map(|side| foot.dot(side) / side.length());
        (high > -1e-3 * self.width() && along[0].is_finite()).then_some([along[0], along[1], high.max(0.0)])
    }

    fn width(&self) -> f64 {
        self.sides[0].length().max(self.sides[1].length())
    }
}

/// The floor of a scene in space, a place on it `[m]` and its unit normal: its first plane that is level enough, with a point and the normal
/// each, else the floor of its walls.
pub(crate) fn level(planes: &[[[f64; 3]; 2]], bounds: Option<[[f64; 3]; 2]>) -> Option<[DVec3; 2]> {
    let plane = |[point, normal]: &[[f64; 3]; 2]| {
        let normal = DVec3::from(*normal).try_normalize()?;
        (normal.y > LEVEL).then_some([DVec3::from(*point), normal])
    };
    planes.iter().find_map(plane).or(bounds.map(|[low, _]| [DVec3::from(low), DVec3::Y]))
}

/// A shape that throws a shadow: its corners on the floor and how high they were; convex.
type Thrown = Vec<[f64; 3]>;

/// What throws a shadow.
fn casters(view: &View<'_>, ground: &Ground) -> Vec<Thrown> {
    let at = |point: u32| {
        let first = 3 * point as usize;
        DVec3::from_array(std::array::from_fn(|axis| view.current.get(first + axis)))
    };
    let thrown = |places: &[DVec3]| places.iter().map(|&place| ground.thrown(place)).collect::<Option<Thrown>>();
    let mut list: Vec<Thrown> = Vec::new();
    if view.triangles.len().max(view.bonds.len()) <= MOST {
        list.extend(view.triangles.iter().filter_map(|corners| thrown(&corners.map(|corner| at(corner.0)))));
        list.extend(view.bonds.iter().filter_map(|bond| thrown(&[bond.a, bond.b].map(|end| at(end.0)))));
    }
    for convex in view.convex {
        match (convex.figure, convex.figure.frame()) {
            (_, Some(frame)) => {
                let center = DVec3::from(convex.figure.center());
                let side = |k: usize| DVec3::from(frame.axes[k]) * frame.half[k];
                let [x, y, z] = [0, 1, 2].map(side);
                for [normal, u, v] in [[x, y, z], [-x, y, z], [y, x, z], [-y, x, z], [z, x, y], [-z, x, y]] {
                    list.extend(thrown(&[u + v, u - v, -u - v, v - u].map(|corner| center + normal + corner)));
                }
            }
            (Figure::Ball { radius, .. }, None) => {
                let center = DVec3::from(convex.figure.center());
                let [u, v] = ground.sides.map(|side| side.normalize_or_zero());
                let rim = (0..ROUND).map(|k| std::f64::consts::TAU * f64::from(k) / f64::from(ROUND));
                let rim: Vec<DVec3> = rim.map(|angle| center + radius * (u * angle.cos() + v * angle.sin())).collect();
                list.extend(thrown(&rim));
            }
            (Figure::Box { .. }, None) => {}
        }
    }
    list
}

/// How dark the floor is, cell by cell, along its first side first.
#[derive(Clone, Debug, PartialEq)]
struct Shadow {
    /// Where the first cell begins along both sides, and how wide cells are `[m]`.
    from: [f64; 2],
    cell: f64,
    size: [usize; 2],
    dark: Vec<f32>,
}

impl Shadow {
    fn of(list: &[Thrown], width: f64) -> Option<Self> {
        let all = || list.iter().flatten();
        let low = [0, 1].map(|axis| all().map(|at| at[axis]).fold(f64::INFINITY, f64::min));
        let high = [0, 1].map(|axis| all().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max));
        let longest = (high[0] - low[0]).max(high[1] - low[1]).max(1e-3 * width);
        if !(low.iter().chain(&high).all(|end| end.is_finite()) && longest < 1e3 * width) {
            return None;
        }
        // By powers of two from the corner on: as bodies move, cells stay where they are.
        let cell = 2_f64.powf((longest / CELLS).log2().floor());
        let first = low.map(|low| (low / cell).floor() as i64 - ROOM);
        let size = [0, 1].map(|axis| ((high[axis] / cell).ceil() as i64 + ROOM - first[axis]).max(1) as usize);
        let from = first.map(|first| first as f64 * cell);
        let mut shadow = Shadow { from, cell, size, dark: vec![0.0; size[0] * size[1]] };
        list.iter().for_each(|shape| shadow.throw(shape, width));
        (0..TIMES).for_each(|_| shadow.smooth());
        Some(shadow)
    }

    /// Darkens what a shape covers: the cells whose middles it holds, and those that its sides go through.
    fn throw(&mut self, shape: &[[f64; 3]], width: f64) {
        let high = shape.iter().map(|at| at[2]).sum::<f64>() / shape.len() as f64;
        let dark = (1.0 + (HIGH - 1.0) * (2.0 * high / width).min(1.0)) as f32;
        let own: Vec<[f64; 2]> =
            shape.iter().map(|at| [0, 1].map(|axis| (at[axis] - self.from[axis]) / self.cell)).collect();
        for (k, a) in own.iter().enumerate() {
            let b = own[(k + 1) % own.len()];
            let steps = (b[0] - a[0]).abs().max((b[1] - a[1]).abs()).ceil().max(1.0) as usize;
            for step in 0..steps {
                let share = step as f64 / steps as f64;
                self.darken([0, 1].map(|axis| (a[axis] + share * (b[axis] - a[axis])) as usize), dark);
            }
        }
        let ends = [0, 1].map(|axis| {
            let all = || own.iter().map(|at| at[axis]);
            [all().fold(f64::INFINITY, f64::min) as usize, all().fold(0.0, f64::max) as usize]
        });
        for y in ends[1][0]..=ends[1][1] {
            for x in ends[0][0]..=ends[0][1] {
                if holds(&own, [x as f64 + 0.5, y as f64 + 0.5]) {
                    self.darken([x, y], dark);
                }
            }
        }
    }

    fn darken(&mut self, [x, y]: [usize; 2], dark: f32) {
        if x < self.size[0] && y < self.size[1] {
            let cell = &mut self.dark[y * self.size[0] + x];
            *cell = cell.max(dark);
        }
    }

    /// Each cell becomes the mean of those about it, along one side, then along the other.
    fn smooth(&mut self) {
        let [columns, rows] = self.size;
        for (count, step, lines, apart) in [(columns, 1, rows, columns), (rows, columns, columns, 1)] {
            let mut line = vec![0.0; count];
            for first in (0..lines).map(|line| line * apart) {
                for (k, cell) in line.iter_mut().enumerate() {
                    let beside = k.saturating_sub(REACH)..(k + REACH + 1).min(count);
                    let sum: f32 = beside.map(|k| self.dark[first + k * step]).sum();
                    *cell = sum / (2 * REACH + 1) as f32;
                }
                line.iter().enumerate().for_each(|(k, cell)| self.dark[first + k * step] = *cell);
            }
        }
    }
}

/// Whether a convex outline holds a place, whichever way it goes round.
fn holds(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let side = |k: usize| {
        let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
        (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
    };
    let sides = || (0..outline.len()).map(side);
    outline.len() > 2 && (sides().all(|side| side > 0.0) || sides().all(|side| side < 0.0))
}

/// The floor as the shader reads it, `rows` in floor.wgsl; positions relative to `origin` `[m]`. Empty where there is none.
pub(super) fn rows(view: &View<'_>, patches: &[Patch], origin: DVec3, look: &Look) -> Vec<[f32; 4]> {
    let Some(ground) = (view.dimensions == 3).then(|| Ground::of(view, patches)).flatten() else { return Vec::new() };
    let row = |x: DVec3, w: f64| [x.x as f32, x.y as f32, x.z as f32, w as f32];
    let lengths = ground.sides.map(DVec3::length);
    let is_light = usize::from(luminance(look.ground) > 0.5);
    let fill = if look.has_grid { FILL[is_light] } else { 0.0 };
    let mut rows = vec![
        row(ground.corner - origin, f64::from(fill)),
        row(ground.sides[0], lengths[0]),
        row(ground.sides[1], lengths[1]),
    ];
    match Shadow::of(&casters(view, &ground), ground.width()) {
        Some(Shadow { from, cell, size, dark }) => {
            rows.push([from[0] as f32, from[1] as f32, cell as f32, DARK[is_light]]);
            rows.push([size[0] as f32, size[1] as f32, 0.0, 0.0]);
            let (fours, rest) = dark.as_chunks::<4>();
            rows.extend(fours);
            let mut last = [0.0; 4];
            last[..rest.len()].copy_from_slice(rest);
            rows.push(last);
        }
        None => rows.extend([[0.0; 4]; 3]),
    }
    rows
}

/// Whether there is a shadow among those rows: it has cells.
pub(super) fn has_shadow(rows: &[[f32; 4]]) -> bool {
    rows.get(4).is_some_and(|[columns, lines, ..]| *columns > 0.0 && *lines > 0.0)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    fn ground() -> Ground {
        Ground::new(DVec3::new(-2.0, 1.0, -2.0), [DVec3::X * 4.0, DVec3::Z * 4.0]).unwrap()
    }

    #[test]
    fn what_lies_on_the_floor_is_thrown_where_it_lies_and_what_is_high_goes_along_the_light() {
        assert_eq!(ground().thrown(DVec3::new(0.0, 1.0, 1.0)), Some([2.0, 3.0, 0.0]));
        let [x, z, high] = ground().thrown(DVec3::new(0.0, 2.0, 1.0)).unwrap();
        assert!(x < 2.0 && z < 3.0 && (high - 1.0).abs() < 1e-12, "{x} {z} {high}");
        assert_eq!(ground().thrown(DVec3::new(0.0, 0.0, 1.0)), None, "it is below");
        assert!(Ground::new(DVec3::ZERO, [DVec3::X, DVec3::Y]).is_none(), "a wall is no floor");
    }

    #[test]
    fn a_shadow_is_dark_below_a_body_soft_at_its_edge_and_nowhere_else() {
        let square = vec![[1.0, 1.0, 0.0], [3.0, 1.0, 0.0], [3.0, 3.0, 0.0], [1.0, 3.0, 0.0]];
        let shadow = Shadow::of(&[square], 4.0).unwrap();
        let at = |x: f64, y: f64| {
            let [column, row] = [x - shadow.from[0], y - shadow.from[1]].map(|x| (x / shadow.cell) as usize);
            shadow.dark[row * shadow.size[0] + column]
        };
        assert!((at(2.0, 2.0) - 1.0).abs() < 1e-4);
        assert!((0.2..0.8).contains(&at(1.0, 2.0)), "{}", at(1.0, 2.0));
        assert!(shadow.dark[0] == 0.0 && shadow.dark.iter().all(|dark| dark.is_finite()));
        assert_eq!(Shadow::of(&[], 4.0), None);
        assert_eq!(Shadow::of(&[vec![[f64::NAN; 3]]], 4.0), None);
    }

    #[test]
    fn a_floor_with_nothing_above_it_has_no_shadow() {
        let bonds = crate::sim::Bonds::default();
        let view = View { bounds: Some([[-1.0; 3], [1.0; 3]]), ..View::empty(&bonds, 3) };
        let bare = rows(&view, &[], DVec3::ZERO, &Look::default());
        assert_eq!((bare.len(), has_shadow(&bare)), (6, false));
        let figure = Figure::Ball { center: [0.0; 3], radius: 0.2 };
        let ball = crate::sim::Convex { figure, restitution: 0.0, friction: 0.0 };
        assert!(has_shadow(&rows(&View { convex: &[ball], ..view }, &[], DVec3::ZERO, &Look::default())));
        assert!(!has_shadow(&[]));
    }

    #[test]
    fn a_rope_throws_a_line() {
        let shadow = Shadow::of(&[vec![[0.0, 0.0, 0.5], [2.0, 0.0, 0.5]]], 4.0).unwrap();
        assert!(shadow.dark.iter().any(|dark| *dark > 0.05));
    }
}
