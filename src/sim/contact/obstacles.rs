//! All that the points of a world cannot enter, shared by its groups.

use std::sync::Arc;

use super::convex::Convex;
use super::geometry::Geometry;
use super::passage::Passage;
use super::polygon::TooManyCrossings;
use super::polygon::round::Round;
use super::polygon::solids::{Solids, Wall};
use super::surface::Surface;
use crate::sim::real::Real;
use crate::sim::vector::{embed, flat, length, scale, sub, truncate, widen};

/// Depth inside a polygon, in ways of one step, that a point may have got to by its bonds.
const DEEP: f64 = 4.0;
/// Walls that a point may bounce off within one way; after so many it stays where it is.
const MOST_BOUNCES: u32 = 8;

/// Surfaces, by number: walls of the bounds, planes, then the walls of polygons, each as the half-plane of its line.
#[derive(Clone, Debug)]
pub(crate) struct Obstacles<S, const D: usize> {
    pub(crate) surfaces: Arc<[Surface<S, D>]>,
    /// How many surfaces have no end.
    planes: usize,
    solids: Option<Arc<Solids>>,
    /// The circles that polygons are, one entry a polygon: the live step meets them instead of their sides.
    rounds: Arc<[Option<Round>]>,
    /// Balls and boxes in space, which have no surfaces by number: the live step alone meets them.
    convex: Arc<[Convex]>,
    /// The corners of polygons, ascending along the first axis.
    corners: Arc<[[f64; D]]>,
}

/// A point that meets the wall of a polygon on its way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Met {
    pub(crate) surface: usize,
    /// Share of the way that was gone until then `[1]`; 1 where it is found inside without having met a wall.
    pub(crate) share: f64,
    /// It is found inside.
    is_inside: bool,
}

impl<S: Real, const D: usize> Obstacles<S, D> {
    /// Errors: outlines of polygons cross too often.
    pub(crate) fn of<'a>(geometry: impl Into<Geometry<'a, D>>) -> Result<Self, TooManyCrossings> {
        let geometry = geometry.into();
        Ok(Obstacles::around(geometry, Solids::new(geometry.polygons)?.map(Arc::new)))
    }

    /// The same for another scalar.
    pub(crate) fn widened<'a>(&self, geometry: impl Into<Geometry<'a, D>>) -> Obstacles<f64, D> {
        Obstacles::around(geometry.into(), self.solids.clone())
    }

    fn around(geometry: Geometry<D>, solids: Option<Arc<Solids>>) -> Self {
        let mut list = geometry.surfaces();
        let planes = list.len();
        if let Some(solids) = &solids {
            let walls = solids.planes(geometry.polygons);
            list.extend(walls.iter().map(|plane| Surface::within(plane, solids.reach())));
        }
        let mut obstacles = Obstacles {
            surfaces: list.into(),
            planes,
            solids,
            rounds: geometry.polygons.iter().map(Round::of).collect(),
            convex: geometry.convex.into(),
            corners: Arc::new([]),
        };
        let walls = (planes..obstacles.surfaces.len()).filter_map(|surface| obstacles.wall(surface));
        let mut corners: Vec<[f64; D]> = walls.map(|wall| truncate(embed(wall.ends()[0]))).collect();
        corners.sort_by(|a, b| a[0].total_cmp(&b[0]));
        obstacles.corners = corners.into();
        obstacles
    }

    /// Whether there are no surfaces.
    pub(crate) fn is_empty(&self) -> bool {
        self.surfaces.is_empty()
    }

    /// Balls and boxes.
    pub(crate) fn convex(&self) -> &[Convex] {
        &self.convex
    }

    /// Where a place is deepest inside of one of them `[m]`, and the way out.
    pub(crate) fn depth_in_convex(&self, x: [S; D]) -> Option<(f64, [f64; D])> {
        let x = embed(widen(x));
        let inside = self.convex.iter().filter_map(|convex| convex.figure.depth(x));
        inside.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(depth, out)| (depth, truncate(out)))
    }

    /// Whether the way from `a` to `b` leads through one of them.
    pub(crate) fn pierces_convex(&self, a: [S; D], b: [S; D]) -> bool {
        let ends = [a, b].map(|x| embed(widen(x)));
        self.convex.iter().any(|convex| convex.figure.is_pierced(ends, self.slack()))
    }

    /// The surfaces that have no end.
    pub(crate) fn planes(&self) -> &[Surface<S, D>] {
        &self.surfaces[..self.planes]
    }

    /// Whether a corner of a polygon is in a box.
    pub(crate) fn has_corner_in(&self, [low, high]: [[f64; D]; 2]) -> bool {
        let start = self.corners.partition_point(|corner| corner[0] < low[0]);
        let mut near = self.corners[start..].iter().take_while(|corner| corner[0] <= high[0]);
        near.any(|corner| (1..D).all(|k| low[k] <= corner[k] && corner[k] <= high[k]))
    }

    /// Whether there are polygons.
    pub(crate) fn has_walls(&self) -> bool {
        self.solids.is_some()
    }

    /// A surface's ends, if it is the wall of a polygon.
    pub(crate) fn wall(&self, surface: usize) -> Option<&Wall> {
        self.solids.as_ref().filter(|_| surface >= self.planes).map(|solids| solids.wall(surface - self.planes))
    }

    /// The polygon that a wall is a side of, and the circle that this is, if it is one.
    pub(crate) fn round(&self, wall: &Wall) -> Option<(usize, Round)> {
        self.rounds[wall.polygon()].map(|round| (wall.polygon(), round))
    }

    /// Whether a box may touch a polygon.
    pub(crate) fn has_walls_near(&self, [low, high]: [[S; D]; 2]) -> bool {
        self.solids.as_ref().is_some_and(|solids| solids.is_near([flat(low), flat(high)]))
    }

    /// The wall that the way from `a` to `b` goes into first, of those that `may` be met; else the nearest one of a point that
    /// ends inside a polygon, not much deeper than the way is long.
    pub(crate) fn meeting(&self, a: [S; D], b: [S; D], mut may: impl FnMut(usize) -> bool) -> Option<Met> {
        let solids = self.solids.as_ref()?;
        let (planes, slack) = (self.planes, self.slack());
        // Most ways are far from all polygons.
        let (from, to) = (flat(a), flat(b));
        let low = [0, 1].map(|k| from[k].min(to[k]) - 2.0 * slack);
        let high = [0, 1].map(|k| from[k].max(to[k]) + 2.0 * slack);
        if !solids.is_near([low, high]) {
            return None;
        }
        self.entering(a, b, &mut may).or_else(|| {
            let deep = DEEP * length(sub(b, a)).to_f64() + DEEP * slack;
            let surface = planes + solids.around(flat(b), slack, deep)?;
            may(surface).then_some(Met { surface, share: 1.0, is_inside: true })
        })
    }

    /// The wall that the way from `a` to `b` goes into first, of those that `may` be met.
    pub(crate) fn entering(&self, a: [S; D], b: [S; D], mut may: impl FnMut(usize) -> bool) -> Option<Met> {
        let met = self.solids.as_ref()?.meeting([flat(a), flat(b)], self.slack(), |wall| may(self.planes + wall));
        met.map(|met| Met { surface: self.planes + met.wall, share: met.share, is_inside: false })
    }

    /// The nearest wall of a point inside a polygon, deeper than `least` `[m]`.
    pub(crate) fn nearest(&self, x: [S; D], least: f64) -> Option<usize> {
        // That it is inside is found out sooner than what is nearest, however far.
        let solids = self.solids.as_ref().filter(|solids| solids.is_solid(flat(x)))?;
        let (wall, square) = solids.nearest(flat(x), f64::INFINITY)?;
        let least = least.max(self.slack());
        (square > least * least).then_some(self.planes + wall)
    }

    /// Whether a point is inside a polygon, not on a wall of it.
    pub(crate) fn is_inside(&self, x: [S; D]) -> bool {
        let (slack, x) = (self.slack(), flat(x));
        self.solids.as_ref().is_some_and(|solids| solids.is_solid(x) && !solids.is_on_a_wall(x, slack))
    }

    /// The place on a surface that is nearest to a point: of a wall, between its ends.
    pub(crate) fn onto(&self, surface: usize, x: [S; D]) -> [S; D] {
        match self.wall(surface) {
            None => sub(x, scale(self.surfaces[surface].normal, self.surfaces[surface].gap(x))),
            Some(wall) => {
                let place = wall.nearest(flat(x));
                std::array::from_fn(|k| if k < 2 { S::from_f64(place[k]) } else { x[k] })
            }
        }
    }

    /// Whether a box may be behind a plane or touch another obstacle.
    pub(crate) fn may_touch(&self, bounds: [[S; D]; 2]) -> bool {
        let [low, high] = bounds.map(|x| embed(widen(x)));
        let is_near = |convex: &Convex| {
            let [from, to] = convex.figure.extent();
            (0..3).all(|k| from[k] <= high[k] && to[k] >= low[k])
        };
        self.planes().iter().any(|plane| plane.least_gap(bounds) < S::ZERO)
            || self.has_walls_near(bounds)
            || self.convex.iter().any(is_near)
    }

    /// Length of the diagonal of the box around all polygons; of balls and boxes the sum of theirs `[m]`.
    pub(crate) fn breadth(&self) -> f64 {
        let convex = self.convex.iter().map(|convex| convex.figure.extent());
        let across = convex.fold(0.0, |sum, [low, high]| sum + length(sub(high, low)));
        self.solids.as_ref().map_or(across, |solids| solids.breadth())
    }

    /// Calls `see` for the walls that a point touches: nearer than `slacks` times what rounding cannot tell from 0.
    pub(crate) fn touching(&self, x: [S; D], slacks: f64, mut see: impl FnMut(usize)) {
        if let Some(solids) = &self.solids {
            solids.touching(flat(x), slacks * self.slack(), |wall| see(self.planes + wall));
        }
    }

    /// Calls `see` for the walls near a way, and a few more.
    pub(crate) fn near(&self, a: [S; D], b: [S; D], margin: f64, mut see: impl FnMut(usize)) {
        if let Some(solids) = &self.solids {
            solids.near([flat(a), flat(b)], margin).into_iter().for_each(|wall| see(self.planes + wall as usize));
        }
    }

    /// What rounding cannot tell from 0 near polygons `[m]`.
    pub(crate) fn slack(&self) -> f64 {
        let reach = self.solids.as_ref().map_or(0.0, |solids| solids.reach());
        S::EPSILON.to_f64() * 64.0 * (1.0 + reach)
    }

    /// Where the way from `a` to `b` leads among walls: at each one that it meets, the rest of it goes on with what `turn` says
    /// of its part along the wall, and turned back with what it says of the part across. `turn` is told the share of the way that
    /// is left. `None`: it meets none.
    ///
    /// `fall` is what gravity adds to a motion on such a way `[m]`.
    pub(crate) fn led(
        &self,
        a: [S; D],
        b: [S; D],
        fall: [S; D],
        mut turn: impl FnMut(usize, S) -> [S; 2],
    ) -> Option<[S; D]> {
        let mut met = self.meeting(a, b, |_| true)?;
        let (mut from, mut to, mut left) = (a, b, S::ONE);
        for _ in 0..MOST_BOUNCES {
            if met.is_inside {
                turn(met.surface, S::ZERO);
                return Some(self.onto(met.surface, to));
            }
            let passage = Passage::new(&self.surfaces[met.surface], [from, to], scale(fall, left * left), met.share);
            left *= passage.left;
            [from, to] = passage.turned(turn(met.surface, left));
            let last = met.surface;
            match self.meeting(from, to, |surface| surface != last) {
                Some(next) => met = next,
                None => return Some(to),
            }
        }
        Some(from)
    }
}
