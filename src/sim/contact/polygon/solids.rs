//! The polygons of a world, ready to be met: their sides in a grid.
//!
//! A point meets a side that its way crosses from the free side to the solid one. What bonds pulled inside all the same belongs to
//! the nearest side, as long as that is near; what is deep inside, where bodies are put over obstacles, is left alone until it is
//! out.

use super::grid::{Grid, extent};
use super::outline::sides;
use super::{Polygon, Segment, TooManyCrossings};
use crate::sim::contact::surface::Plane;
use crate::sim::vector::{cross, dot, sub};

/// A side of a solid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    start: [f64; 2],
    end: [f64; 2],
    /// Unit vector along it; the solid is on the right.
    along: [f64; 2],
    length: f64,
    polygon: u32,
}

/// Where a way meets a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Meeting {
    /// The wall.
    pub(crate) wall: usize,
    /// Share of the way that was gone until then `[1]`.
    pub(crate) share: f64,
}

/// Share by which squares of distances may differ that are one.
const TIE: f64 = 1e-9;

/// All sides of all polygons.
#[derive(Clone, Debug)]
pub(crate) struct Solids {
    walls: Vec<Wall>,
    grid: Grid,
    /// For every cell without walls whether it is solid.
    solid: Vec<bool>,
    extent: Segment,
    /// Largest coordinate `[m]`.
    reach: f64,
}

impl Wall {
    fn of([start, end]: Segment, polygon: u32) -> Self {
        let way = sub(end, start);
        let length = libm::hypot(way[0], way[1]);
        Wall { start, end, along: way.map(|w| w / length), length, polygon }
    }

    /// From where to where it goes `[m]`; the solid is on the right.
    pub(crate) fn ends(&self) -> [[f64; 2]; 2] {
        [self.start, self.end]
    }

    /// Which polygon it is a side of.
    pub(crate) fn polygon(&self) -> usize {
        self.polygon as usize
    }

    /// Unit normal, towards the free side.
    #[inline(always)]
    fn normal(&self) -> [f64; 2] {
        [-self.along[1], self.along[0]]
    }

    /// How far a point is from the wall's line `[m]`; below 0 on the solid side.
    #[inline(always)]
    fn gap(&self, x: [f64; 2]) -> f64 {
        cross(self.along, sub(x, self.start))
    }

    /// How far within its ends a point lies beside it `[m]`; below 0 beyond them.
    #[inline(always)]
    pub(crate) fn within(&self, x: [f64; 2]) -> f64 {
        let at = dot(self.along, sub(x, self.start));
        at.min(self.length - at)
    }

    /// How much further within its ends a point gets by going `way` `[m]`.
    pub(crate) fn goes_within(&self, x: [f64; 2], way: [f64; 2]) -> f64 {
        let at = dot(self.along, sub(x, self.start));
        let on = dot(self.along, way);
        if at < self.length - at { on } else { -on }
    }

    /// The place on it that is nearest to a point.
    pub(crate) fn nearest(&self, x: [f64; 2]) -> [f64; 2] {
        match dot(self.along, sub(x, self.start)) {
            at if at <= 0.0 => self.start,
            at if at >= self.length => self.end,
            at => [self.start[0] + self.along[0] * at, self.start[1] + self.along[1] * at],
        }
    }

    /// Square of the distance of a point `[m^2]`.
    pub(super) fn square_distance(&self, x: [f64; 2]) -> f64 {
        let off = sub(x, self.nearest(x));
        dot(off, off)
    }
}

impl Solids {
    /// `None` where there is no side.
    ///
    /// Errors: outlines cross too often.
    pub(crate) fn new(polygons: &[Polygon]) -> Result<Option<Self>, TooManyCrossings> {
        let sides = sides(polygons)?;
        if sides.is_empty() {
            return Ok(None);
        }
        let segments: Vec<Segment> = sides.iter().map(|side| side.ends).collect();
        let walls = sides.iter().map(|side| Wall::of(side.ends, side.polygon)).collect();
        let extent = extent(&segments);
        let reach = extent.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        let mut solids = Solids { walls, grid: Grid::new(&segments), solid: Vec::new(), extent, reach };
        solids.solid = solids.solid_cells();
        Ok(Some(solids))
    }

    /// Every wall as the half-plane of its line.
    pub(crate) fn planes<const D: usize>(&self, polygons: &[Polygon]) -> Vec<Plane<D>> {
        let spread = |x: [f64; 2]| std::array::from_fn(|k| x.get(k).copied().unwrap_or(0.0));
        let plane = |wall: &Wall| {
            let of = &polygons[wall.polygon as usize];
            let (point, normal) = (spread(wall.start), spread(wall.normal()));
            Plane { point, normal, restitution: of.restitution, friction: of.friction, penalty: None }
        };
        self.walls.iter().map(plane).collect()
    }

    /// A wall.
    pub(crate) fn wall(&self, wall: usize) -> &Wall {
        &self.walls[wall]
    }

    /// Largest coordinate `[m]`.
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    /// Length of the diagonal of the box around all `[m]`.
    pub(crate) fn breadth(&self) -> f64 {
        let way = sub(self.extent[1], self.extent[0]);
        libm::hypot(way[0], way[1])
    }

    /// Whether a box may touch any.
    pub(crate) fn is_near(&self, [low, high]: Segment) -> bool {
        let [from, to] = self.extent;
        (0..2).all(|k| low[k] <= to[k] && high[k] >= from[k])
    }

    /// The first wall that the way from `a` to `b` goes into, and where, of those that `may` be met; else one that it ends on.
    /// `slack` `[m]` is what rounding cannot tell from 0.
    pub(crate) fn meeting(&self, [a, b]: Segment, slack: f64, mut may: impl FnMut(usize) -> bool) -> Option<Meeting> {
        let way = sub(b, a);
        let tie = slack / dot(way, way).sqrt();
        let mut first: Option<(Meeting, f64, bool)> = None;
        self.grid.cells.along(a, b, slack, |cell| {
            for &k in self.grid.of(cell) {
                let wall = &self.walls[k as usize];
                let (from, to) = (wall.gap(a), wall.gap(b));
                let into = from - to;
                if !(from >= -slack && to < slack && into > 0.0) {
                    continue;
                }
                let share = (from / into).clamp(0.0, 1.0);
                let at = [a[0] + share * way[0], a[1] + share * way[1]];
                if wall.within(at) < -slack || !may(k as usize) {
                    continue;
                }
                let crosses = to < -slack;
                // Of walls that meet in a corner the one that the way goes into more.
                let is_first = first.is_none_or(|(first, steepest, crossed)| {
                    let is_before = share < first.share - tie || (share < first.share + tie && into > steepest);
                    if crosses == crossed { is_before } else { crosses }
                });
                if is_first {
                    first = Some((Meeting { wall: k as usize, share }, into, crosses));
                }
            }
        });
        first.map(|(meeting, ..)| meeting)
    }

    /// The walls that may be nearer to a way than `margin` `[m]`.
    pub(crate) fn near(&self, [a, b]: Segment, margin: f64) -> Vec<u32> {
        self.grid.near(a, b, margin)
    }

    /// Calls `see` for every wall that a point is nearer to than `reach` `[m]`, and beside.
    pub(crate) fn touching(&self, x: [f64; 2], reach: f64, mut see: impl FnMut(usize)) {
        for k in self.grid.near(x, x, reach) {
            let wall = &self.walls[k as usize];
            if wall.gap(x).abs() <= reach && wall.within(x) >= -reach {
                see(k as usize);
            }
        }
    }

    /// Whether a point is no further from some wall than `reach` `[m]`.
    pub(crate) fn is_on_a_wall(&self, x: [f64; 2], reach: f64) -> bool {
        self.nearest(x, reach).is_some_and(|(_, square)| square <= reach * reach)
    }

    /// The nearest wall of a point that is inside a solid, deeper than `slack` but not than `deep` `[m]`.
    pub(crate) fn around(&self, x: [f64; 2], slack: f64, deep: f64) -> Option<usize> {
        let (wall, square) = self.nearest(x, deep)?;
        (square > slack * slack && square <= deep * deep && self.is_solid(x)).then_some(wall)
    }

    /// Whether a point is inside a solid; of one on a wall that is not sure.
    pub(crate) fn is_solid(&self, x: [f64; 2]) -> bool {
        let cells = self.grid.cells;
        let Some([column, row]) = cells.place(x) else { return false };
        let first = row * cells.counts[0];
        if self.grid.of(first + column).is_empty() {
            return self.solid[first + column];
        }
        // From the next cell on the left that is known the walls on the way are counted.
        let mut depth = 0;
        for place in (0..=column).rev() {
            if self.grid.of(first + place).is_empty() {
                depth += i32::from(self.solid[first + place]);
                break;
            }
            depth += self.entered(first + place, place, x);
        }
        depth > 0
    }

    /// Solids entered in a cell less those left, on the way along x that ends at a point or with the cell.
    fn entered(&self, cell: usize, column: usize, x: [f64; 2]) -> i32 {
        let cells = self.grid.cells;
        let count = |&k: &u32| {
            let wall = &self.walls[k as usize];
            let (from, rise) = (wall.start, wall.end[1] - wall.start[1]);
            if (wall.start[1] > x[1]) == (wall.end[1] > x[1]) {
                return 0;
            }
            let at = from[0] + (x[1] - from[1]) * (wall.along[0] / wall.along[1]);
            let place = ((at - cells.low[0]) / cells.side).max(0.0) as usize;
            // A wall that goes up has the solid on its right: there it is entered.
            let entered = if rise > 0.0 { 1 } else { -1 };
            if place.min(cells.counts[0] - 1) == column && at < x[0] { entered } else { 0 }
        };
        self.grid.of(cell).iter().map(count).sum()
    }

    /// For every cell whether its middle is solid.
    fn solid_cells(&self) -> Vec<bool> {
        let cells = self.grid.cells;
        let mut solid = Vec::with_capacity(cells.count());
        for row in 0..cells.counts[1] {
            let mut depth = 0;
            let y = cells.low[1] + (row as f64 + 0.5) * cells.side;
            for column in 0..cells.counts[0] {
                let cell = row * cells.counts[0] + column;
                solid.push(depth > 0);
                depth += self.entered(cell, column, [f64::INFINITY, y]);
            }
        }
        solid
    }

    /// The nearest wall of a point and the square of its distance `[m^2]`; of those further than `far` `[m]` any or none. Of walls
    /// whose common corner is nearest, the one whose line the point is further behind.
    pub(crate) fn nearest(&self, x: [f64; 2], far: f64) -> Option<(usize, f64)> {
        let side = self.grid.cells.side;
        let mut reach = far.min(side);
        loop {
            let mut nearest: Option<(usize, f64)> = None;
            let mut look = |k: usize| {
                let square = self.walls[k].square_distance(x);
                let is_nearer = nearest.is_none_or(|(other, least)| {
                    square < least * (1.0 - TIE)
                        || square <= least * (1.0 + TIE) && self.walls[k].gap(x) < self.walls[other].gap(x)
                });
                if is_nearer {
                    nearest = Some((k, square));
                }
            };
            if self.grid.cells.many(reach) > self.walls.len() {
                (0..self.walls.len()).for_each(look);
                return nearest;
            }
            self.grid.cells.around(x, reach, |cell| self.grid.of(cell).iter().for_each(|&k| look(k as usize)));
            let is_far = reach >= far || reach > side * (self.grid.cells.counts[0] + self.grid.cells.counts[1]) as f64;
            if is_far || nearest.is_some_and(|(_, least)| least <= reach * reach) {
                return nearest;
            }
            reach *= 2.0;
        }
    }
}
