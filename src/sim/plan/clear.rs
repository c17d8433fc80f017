//! Bodies that start inside obstacles are put beside them, each as a whole: put out point by point they would be crushed.

use std::borrow::Cow;

use crate::sim::bonds::Bonds;
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::measure;
use crate::sim::sets::Sets;
use crate::sim::vector::{add, dot, length, scale, sub, zero};

/// Depth, as a share of the body's extent, that is left to the first step.
const SHALLOW: f64 = 1e-6;
/// Steps in which a way out is looked for, in each direction, along a way as long as the body; further out they grow with the way.
const STEPS: f64 = 128.0;
/// Shortest body whose extent says how long the steps are, as a share of all polygons' extent.
const LEAST_STEP: f64 = 1e-3;
/// Directions that are tried, beside those of the walls that points are behind.
const DIRECTIONS: u32 = 32;
/// Most of the walls that points are behind whose directions are tried.
const MOST_NORMALS: usize = 16;
/// Halvings of the last step to where the way out ends.
const HALVINGS: u32 = 12;
/// Points and bonds that are looked at for a way out, at most: so many take a second.
const MOST_LOOKS: usize = 10_000_000;
/// How much further than the first place that is free, but for bonds through walls, another one is looked for.
const BEYOND: f64 = 2.0;
/// Rounds in which the shortest way out of planes is found.
const MOST_ROUNDS: u32 = 400;

/// What was done about bodies that start inside obstacles.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Cleared<const D: usize> {
    /// Bodies that are to be moved: their points, and how far `[m]`.
    pub(crate) moves: Vec<(Vec<u32>, [f64; D])>,
    /// Bodies that are held by pins, or for which there is no way out: of each a point that can move.
    pub(crate) stuck: Vec<u32>,
    /// Those of them of which more is inside than pins and the bonds at them.
    pub(crate) caught: Vec<u32>,
}

impl<const D: usize> Cleared<D> {
    /// The longest way `[m]`.
    pub(crate) fn furthest(&self) -> f64 {
        self.moves.iter().map(|(_, way)| length(*way)).fold(0.0, f64::max)
    }

    /// These places `[m]` as they are once the bodies are moved.
    pub(crate) fn moved<'a>(&self, position: &'a [[f64; D]]) -> Cow<'a, [[f64; D]]> {
        let mut moved = Cow::Borrowed(position);
        for (points, way) in &self.moves {
            points.iter().map(|&i| i as usize).for_each(|i| moved.to_mut()[i] = add(position[i], *way));
        }
        moved
    }
}

/// How what hangs together by bonds gets out of the obstacles, each body by the shortest way found and without turning it: to where
/// none of its points is inside and, if there is such a place, no bond goes through a wall.
///
/// Shapes: `position` and `w` have one entry a point; w = 0 is pinned, and what hangs on a pin stays, unless the pin was put there: `placed`.
/// Such pins go with their body if it was placed as a whole, else together. Points without bonds are left to the first step.
pub(crate) fn clear<const D: usize>(
    obstacles: &Obstacles<f64, D>,
    bonds: &Bonds,
    (position, w): (&[[f64; D]], &[f64]),
    placed: impl Fn(u32) -> bool,
) -> Cleared<D> {
    let mut cleared = Cleared::default();
    let is_none = obstacles.is_empty() && obstacles.convex().is_empty();
    if is_none || !measure::extent(position).is_some_and(|around| obstacles.may_touch(around)) {
        return cleared;
    }
    for body in bodies(bonds, w) {
        let search = |moved: &[u32], way: [f64; D]| {
            let own = |i: u32| if moved.binary_search(&i).is_ok() { way } else { zero() };
            let places = body.points.iter().map(|&i| add(position[i as usize], own(i))).collect();
            Search::new(obstacles, places, &body.bonds)
        };
        let Some(whole) = search(&[], zero()) else { continue };
        let may_go = !body.is_pinned || body.points.iter().all(|&i| placed(i));
        if let Some(way) = if may_go { whole.way_out() } else { None } {
            cleared.moves.push((body.points, way));
            continue;
        }
        let pins: Vec<u32> = body.points.iter().copied().filter(|&i| w[i as usize] == 0.0 && placed(i)).collect();
        let places = pins.iter().map(|&pin| position[pin as usize]).collect();
        let way = Search::new(obstacles, places, &[]).and_then(|search| search.way_out());
        if search(&pins, way.unwrap_or(zero())).is_some() {
            let first = body.points.iter().copied().find(|&i| w[i as usize] != 0.0);
            cleared.stuck.extend(first);
            let free = body.without_pins(w);
            let places = free.points.iter().map(|&i| position[i as usize]).collect();
            cleared.caught.extend(first.filter(|_| Search::new(obstacles, places, &free.bonds).is_some()));
        }
        cleared.moves.extend(way.map(|way| (pins, way)));
    }
    cleared
}

/// Points that hang together.
#[derive(Default)]
struct Hanging {
    /// Ascending.
    points: Vec<u32>,
    /// Its bonds, their ends counted within it.
    bonds: Vec<[u32; 2]>,
    is_pinned: bool,
}

impl Hanging {
    /// What can move of it, and the bonds between.
    fn without_pins(&self, w: &[f64]) -> Self {
        let is_free = |place: u32| w[self.points[place as usize] as usize] != 0.0;
        let places: Vec<u32> = (0..self.points.len() as u32).filter(|&place| is_free(place)).collect();
        let within = |place: u32| places.binary_search(&place).ok().map(|place| place as u32);
        let bonds = self.bonds.iter().filter_map(|&[a, b]| Some([within(a)?, within(b)?])).collect();
        Hanging { points: places.iter().map(|&place| self.points[place as usize]).collect(), bonds, is_pinned: false }
    }
}

/// All that hangs together by bonds, in the order of the lowest points.
fn bodies(bonds: &Bonds, w: &[f64]) -> Vec<Hanging> {
    let mut sets = Sets::new(w.len());
    bonds.ends().iter().for_each(|[a, b]| sets.join(a.0, b.0));
    let mut place = vec![[u32::MAX; 2]; w.len()];
    let mut list: Vec<Hanging> = Vec::new();
    for [a, b] in bonds.ends() {
        let root = sets.find(a.0) as usize;
        if place[root][0] == u32::MAX {
            place[root][0] = list.len() as u32;
            list.push(Hanging::default());
        }
        // Here the bonds still name the points of the scene.
        list[place[root][0] as usize].bonds.push([a.0, b.0]);
    }
    for i in 0..w.len() as u32 {
        let body = place[sets.find(i) as usize][0];
        if let Some(body) = list.get_mut(body as usize) {
            place[i as usize][1] = body.points.len() as u32;
            body.points.push(i);
            body.is_pinned |= w[i as usize] == 0.0;
        }
    }
    let within = |end: &mut u32| *end = place[*end as usize][1];
    list.iter_mut().for_each(|body| body.bonds.iter_mut().flatten().for_each(within));
    list
}

/// The end of the way that halving finds between one that is not far enough and one that is.
fn last_step([mut short, mut far]: [f64; 2], mut is_out: impl FnMut(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (short + far);
        *(if is_out(middle) { &mut far } else { &mut short }) = middle;
    }
    far
}

/// What stood in the way last, and is looked at first the next time: a point that was inside, and a bond that went through a wall.
#[derive(Default)]
struct Blocking {
    last: [usize; 2],
    looks: usize,
}

impl Blocking {
    /// Whether something stands in the way: of points (0) or bonds (1), so many.
    fn finds(&mut self, kind: usize, count: usize, stands: impl Fn(usize) -> bool) -> bool {
        let found = std::iter::once(self.last[kind]).filter(|&last| last < count).chain(0..count).find(|&k| {
            self.looks += 1;
            stands(k)
        });
        self.last[kind] = found.unwrap_or(self.last[kind]);
        found.is_some()
    }
}

/// A body that starts inside, and what it must get out of.
struct Search<'a, const D: usize> {
    obstacles: &'a Obstacles<f64, D>,
    points: Vec<[f64; D]>,
    bonds: &'a [[u32; 2]],
    /// Of each plane its normal, and how far the body has to go along it `[m]`.
    planes: Vec<([f64; D], f64)>,
    /// Length of the diagonal of the box around it `[m]`.
    extent: f64,
}

impl<'a, const D: usize> Search<'a, D> {
    /// `None` where the body is free.
    fn new(obstacles: &'a Obstacles<f64, D>, points: Vec<[f64; D]>, bonds: &'a [[u32; 2]]) -> Option<Self> {
        let around = measure::extent(&points)?;
        if !obstacles.may_touch(around) {
            return None;
        }
        let extent = length(sub(around[1], around[0]));
        let least = |of: &dyn Fn([f64; D]) -> f64| points.iter().fold(f64::INFINITY, |least, &x| least.min(of(x)));
        let planes: Vec<_> = obstacles.planes().iter().map(|plane| (plane.normal, -least(&|x| plane.gap(x)))).collect();
        let shallow = SHALLOW * extent + obstacles.slack();
        let is_deep = planes.iter().any(|(_, depth)| *depth > shallow)
            || points.iter().any(|&x| obstacles.nearest(x, shallow).is_some())
            || points.iter().any(|&x| obstacles.depth_in_convex(x).is_some_and(|(depth, _)| depth > shallow));
        is_deep.then_some(Search { obstacles, points, bonds, planes, extent })
    }

    /// The shortest way out that is found.
    fn way_out(&self) -> Option<[f64; D]> {
        let start = self.out_of_planes()?;
        let mut blocking = Blocking::default();
        if self.is_free(start, &mut blocking) && !self.crosses(start, &mut blocking) {
            return Some(start);
        }
        let step = self.extent.max(LEAST_STEP * self.obstacles.breadth()) / STEPS;
        let most = self.extent + self.obstacles.breadth();
        let directions = self.directions();
        let mut second = None;
        let (mut before, mut end) = (0.0, most);
        while before < end && blocking.looks < MOST_LOOKS {
            let way = before + step.max(before / STEPS);
            for &direction in &directions {
                let out = add(start, scale(direction, way));
                if !self.is_free(out, &mut blocking) {
                    continue;
                }
                if !self.crosses(out, &mut blocking) {
                    let is_out = |way| {
                        let out = add(start, scale(direction, way));
                        self.is_free(out, &mut blocking) && !self.crosses(out, &mut blocking)
                    };
                    return Some(add(start, scale(direction, last_step([before, way], is_out))));
                }
                if second.is_none() {
                    (second, end) = (Some(out), most.min(BEYOND * way + self.extent));
                }
            }
            before = way;
        }
        second
    }

    /// The shortest way to where all planes have the body on their free side (Hildreth's method).
    fn out_of_planes(&self) -> Option<[f64; D]> {
        let margin = SHALLOW * self.extent;
        let mut way = zero::<f64, D>();
        let mut pushes = vec![0.0; self.planes.len()];
        for _ in 0..MOST_ROUNDS {
            for (push, &(normal, depth)) in pushes.iter_mut().zip(&self.planes) {
                let more = (depth + margin.min(depth.max(0.0)) - dot(normal, way)).max(-*push);
                *push += more;
                way = add(way, scale(normal, more));
            }
            if self.keeps_planes(way) {
                return Some(way);
            }
        }
        None
    }

    fn keeps_planes(&self, way: [f64; D]) -> bool {
        self.planes.iter().all(|&(normal, depth)| dot(normal, way) >= depth - self.obstacles.slack())
    }

    /// Whether no point is inside anything.
    fn is_free(&self, way: [f64; D], blocking: &mut Blocking) -> bool {
        let is_inside = |i: usize| {
            let x = add(self.points[i], way);
            self.obstacles.is_inside(x) || self.obstacles.depth_in_convex(x).is_some()
        };
        self.keeps_planes(way) && !blocking.finds(0, self.points.len(), is_inside)
    }

    /// Whether a bond goes through a wall.
    fn crosses(&self, way: [f64; D], blocking: &mut Blocking) -> bool {
        let is_crossed = |k: usize| {
            let [a, b] = self.bonds[k].map(|end| add(self.points[end as usize], way));
            let met = self.obstacles.meeting(a, b, |_| true);
            met.is_some_and(|met| self.obstacles.surfaces[met.surface].gap(b) < -self.obstacles.slack())
                || self.obstacles.pierces_convex(a, b)
        };
        (self.obstacles.has_walls() || !self.obstacles.convex().is_empty())
            && blocking.finds(1, self.bonds.len(), is_crossed)
    }

    /// Unit vectors in the plane, all around, and off the walls that points are behind.
    fn directions(&self) -> Vec<[f64; D]> {
        let turn = std::f64::consts::TAU / f64::from(DIRECTIONS);
        let around = (0..DIRECTIONS).map(|k| {
            let angle = turn * f64::from(k);
            let mut direction = zero();
            // Upwards first: of two ways that are equally long that one is taken.
            (direction[0], direction[1]) = (libm::sin(angle), libm::cos(angle));
            direction
        });
        let mut normals: Vec<[f64; D]> = Vec::new();
        for &x in &self.points {
            let wall = self.obstacles.nearest(x, 0.0).map(|wall| self.obstacles.surfaces[wall].normal);
            let normal = wall.or_else(|| self.obstacles.depth_in_convex(x).map(|(_, out)| out));
            match normal {
                Some(normal) if normals.len() < MOST_NORMALS && !normals.contains(&normal) => normals.push(normal),
                _ => {}
            }
        }
        normals.into_iter().chain(around).collect()
    }
}
