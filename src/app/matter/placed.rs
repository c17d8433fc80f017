//! Where what is selected is, in figures, and the commands that put it elsewhere: those of the tool that moves, turns and scales.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Among;
use super::extent::place;
use crate::history::{Do, Factors, MoveKeys};
use crate::scene::Vector;
use crate::sim::vector::{embed, length, scale, sub};
use crate::sim::{Dynamics, Obstacle, PointId, Polygon};

/// Sides of a box are at right angles, and corners on a circle, to this share of their size `[1]`.
const ROUNDING: f64 = 1e-8;
/// An outline of fewer corners is no circle.
const ROUND: usize = 16;
/// A box that is turned is so small on its way to other sides that it touches nothing `[1]`.
const SMALL: f64 = 1.0 / 1024.0;

/// Where a selection is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// The middle of the box around it; of nothing but planes the point that the first is given by `[m]`.
    pub(in crate::app) middle: [f64; 3],
    /// How one box or one plane in the plane is turned, anticlockwise `[rad]`: a plane between -pi and pi, a box, which looks the same after half a
    /// turn, in (-pi/2, pi/2].
    pub(in crate::app) angle: Option<f64>,
    /// How large one box or one circle in the plane is.
    pub(in crate::app) size: Option<Size>,
}

/// How large an obstacle is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) enum Size {
    /// Width and height, as long as it is not turned `[m]`.
    Box([f64; 2]),
    /// Its radius `[m]`.
    Circle(f64),
}

/// Where a number puts a selection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Placing {
    /// Its middle along an axis `[m]`.
    At(usize, f64),
    /// One box or one plane stands at this angle `[rad]`.
    Angle(f64),
    /// It is turned from how it was, as a number that is dragged on began, `[rad]`.
    TurnBy(f64),
    /// The width of one box, or its height, about its middle `[m]`.
    Side(usize, f64),
    /// The radius of one circle `[m]`.
    Radius(f64),
}

/// How much of a turn that is dragged on was taken `[rad]`; `None`: nothing yet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::app) struct Turned(Option<f64>);

impl Turned {
    /// What a turn is from how it is now, and whether it goes on with what was taken; another number is as it is.
    pub(in crate::app) fn more(&mut self, placing: Placing, goes_on: bool) -> (Placing, bool) {
        let Placing::TurnBy(all) = placing else { return (placing, goes_on) };
        self.0 = self.0.filter(|_| goes_on);
        (Placing::TurnBy(all - self.0.unwrap_or(0.0)), self.0.is_some())
    }

    /// It was taken, so far.
    pub(in crate::app) fn take(&mut self, placing: Placing) {
        if let Placing::TurnBy(all) = placing {
            self.0 = Some(all);
        }
    }
}

impl Placing {
    /// What it is called when it is undone.
    pub(in crate::app) fn name(self) -> &'static str {
        match self {
            Placing::At(..) => "move",
            Placing::Angle(_) | Placing::TurnBy(_) => "turn",
            Placing::Side(..) | Placing::Radius(_) => "scale",
        }
    }
}

impl Placed {
    /// The turn to an angle `[rad]`: the nearest one of a box, which goes on as it is dragged past a right angle.
    pub(in crate::app) fn turn_to(&self, to: f64) -> Option<f64> {
        let turn = to - self.angle?;
        Some(if self.size.is_some() { half_turned(turn) } else { turn })
    }

    /// Of what is meant in a world; `None` where nothing of it has a place.
    pub(in crate::app) fn of(world: &dyn Dynamics, among: &Among) -> Option<Self> {
        let points = among.points_of(world);
        let mut obstacles = if among.obstacles.is_empty() { Vec::new() } else { world.obstacles() };
        obstacles.retain(|(number, _)| among.obstacles.contains(number));
        let ends = obstacles.iter().flat_map(|(_, obstacle)| corners(obstacle));
        let places = points.iter().map(|&point| place(world, point)).chain(ends);
        let around = places.filter(|x| x.iter().all(|x| x.is_finite())).fold(None, |around: Option<[_; 2]>, x| {
            let [low, high] = around.unwrap_or([x; 2]);
            let both = |choose: fn(f64, f64) -> f64, a: [f64; 3]| std::array::from_fn(|axis| choose(a[axis], x[axis]));
            Some([both(f64::min, low), both(f64::max, high)])
        });
        let plane = obstacles.iter().find_map(|(_, obstacle)| match obstacle {
            Obstacle::Plane { point, .. } => Some(*point),
            _ => None,
        });
        let middle = around.map(|[low, high]| std::array::from_fn(|axis| 0.5 * (low[axis] + high[axis]))).or(plane)?;
        let one = match &obstacles[..] {
            [(_, one)] if points.is_empty() && world.dimensions() == 2 => Some(one),
            _ => None,
        };
        let (angle, size) = one.map_or((None, None), formed);
        Some(Placed { middle, angle, size })
    }
}

/// How an obstacle of the plane is turned and how large it is, where it is of a form that has these.
fn formed(obstacle: &Obstacle) -> (Option<f64>, Option<Size>) {
    match obstacle {
        Obstacle::Plane { normal: [x, y, _], .. } => (Some((-x).atan2(*y)), None),
        Obstacle::Polygon(polygon) => match (rectangle(polygon), radius(polygon)) {
            (Some((angle, sides)), _) => (Some(angle), Some(Size::Box(sides))),
            (None, radius) => (None, radius.map(Size::Circle)),
        },
        Obstacle::Convex(_) => (None, None),
    }
}

/// Places between which an obstacle lies; none of a plane.
fn corners(obstacle: &Obstacle) -> Vec<[f64; 3]> {
    match obstacle {
        Obstacle::Plane { .. } => Vec::new(),
        Obstacle::Polygon(polygon) => polygon.loops.iter().flatten().map(|&corner| embed(corner)).collect(),
        Obstacle::Convex(convex) => convex.figure.extent().to_vec(),
    }
}

/// The angle in (-pi/2, pi/2] that is as many half turns from this one as it takes `[rad]`.
fn half_turned(angle: f64) -> f64 {
    angle - PI * ((angle - FRAC_PI_2) / PI).ceil()
}

/// How a box is turned `[rad]`, and its sides `[m]`; `None` of what is none.
fn rectangle(polygon: &Polygon) -> Option<(f64, [f64; 2])> {
    let [outline] = &polygon.loops[..] else { return None };
    let &[a, b, c, d] = &outline[..] else { return None };
    let [along, up] = [sub(b, a), sub(c, b)];
    let sides = [length(along), length(up)];
    let least = ROUNDING * (sides[0] + sides[1]);
    let is_closed = length(sub(sub(c, d), along)) <= least;
    let is_square = (along[0] * up[0] + along[1] * up[1]).abs() <= ROUNDING * sides[0] * sides[1];
    (is_closed && is_square && sides[0] > 0.0 && sides[1] > 0.0).then(|| (half_turned(along[1].atan2(along[0])), sides))
}

/// The radius of a circle `[m]`; `None` of what is none.
fn radius(polygon: &Polygon) -> Option<f64> {
    let [outline] = &polygon.loops[..] else { return None };
    let count = outline.len();
    if count < ROUND {
        return None;
    }
    let sum = outline.iter().fold([0.0; 2], |[x, y], corner| [x + corner[0], y + corner[1]]);
    let middle = scale(sum, 1.0 / count as f64);
    let radius = length(sub(outline[0], middle));
    // Corners that are as far from each other as from the middle go around it once.
    let side = length(sub(outline[1], outline[0]));
    let is_on = |k: usize| {
        let [from, to] = [outline[k], outline[(k + 1) % count]];
        let off = (length(sub(from, middle)) - radius).abs().max((length(sub(to, from)) - side).abs());
        off <= ROUNDING * radius
    };
    (radius > 0.0 && (0..count).all(is_on)).then_some(radius)
}

/// What fits what is put somewhere into the world: pins that are stuck in its obstacles go along with it, and it goes so far aside `[m]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fit {
    pub(in crate::app) along: Vec<PointId>,
    pub(in crate::app) lift: [f64; 3],
}

/// The commands that put what is meant where a number says, from where it is in the world now.
///
/// Errors: in words, why there is nothing that could be put so.
pub(in crate::app) fn placed(
    world: &dyn Dynamics,
    (among, fit): (&Among, &Fit),
    placing: Placing,
) -> Result<Vec<Do>, &'static str> {
    const NOTHING: &str = "nothing of what is selected can be changed so";
    let placed = Placed::of(world, among).ok_or(NOTHING)?;
    let Placed { middle, angle, size } = placed;
    let vector = |x: [f64; 3]| Some(Vector::new(x, world.dimensions()));
    let mut points: Vec<u32> = among.points_of(world).iter().chain(&fit.along).map(|point| point.0).collect();
    points.sort_unstable();
    points.dedup();
    let obstacles = among.obstacles.clone();
    let keys = MoveKeys { points, obstacles, about: vector(middle), ..MoveKeys::default() };
    // What changes its size leaves where it is what is stuck in it.
    let alone = MoveKeys { points: Vec::new(), ..keys.clone() };
    let lift = (fit.lift != [0.0; 3]).then(|| vector(fit.lift)).flatten();
    let all = match (placing, size) {
        (Placing::At(axis, to), _) => {
            let mut by = fit.lift;
            by[axis] += to - middle[axis];
            vec![MoveKeys { by: vector(by), about: None, ..keys }]
        }
        (Placing::Angle(to), _) => vec![MoveKeys { turn: Some(placed.turn_to(to).ok_or(NOTHING)?), by: lift, ..keys }],
        (Placing::TurnBy(turn), _) => vec![MoveKeys { turn: Some(turn), by: lift, ..keys }],
        (Placing::Radius(to), Some(Size::Circle(radius))) => {
            vec![MoveKeys { scale: Some(Factors::One(to / radius)), ..alone }]
        }
        (Placing::Side(side, to), Some(Size::Box(sides))) => {
            let mut factors = [1.0; 2];
            factors[side] = to / sides[side];
            let each = |factors| Some(Factors::Each(factors));
            match angle {
                // A scale is along x and y: it is turned there, and back by the move that draws it out.
                Some(turn) if turn != 0.0 => vec![
                    MoveKeys { scale: Some(Factors::One(SMALL)), turn: Some(-turn), ..alone.clone() },
                    MoveKeys { scale: each(factors.map(|factor| factor / SMALL)), turn: Some(turn), ..alone },
                ],
                _ => vec![MoveKeys { scale: each(factors), ..alone }],
            }
        }
        _ => return Err(NOTHING),
    };
    Ok(all.into_iter().map(|keys| Do::Move(Box::new(keys))).collect())
}
