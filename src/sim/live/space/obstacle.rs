//! Balls and boxes as bodies meet them: by points, by edges and by triangles, so that none pokes through between points.

use super::geometry::{lines, nearest};
use crate::sim::contact::convex::{BOX_EDGES, Convex, Figure};
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, cross3, dot, scale, sub, zero};

/// A ball or a box.
#[derive(Clone, Debug)]
pub(super) struct Solid<S> {
    pub(super) shape: Shape<S>,
    /// The box along the axes around it `[m]`.
    pub(super) extent: [[S; 3]; 2],
    pub(super) friction: S,
    pub(super) restitution: S,
}

/// Its shape `[m]`.
#[derive(Clone, Debug)]
pub(super) enum Shape<S> {
    Ball { center: [S; 3], radius: S },
    Box { center: [S; 3], half: [S; 3], axes: [[S; 3]; 3], corners: [[S; 3]; 8] },
}

/// Where something is beside an obstacle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Off<S> {
    /// Shares of its points `[1]`: the nearest place is their mean.
    pub(super) shares: [S; 3],
    /// Away from the obstacle.
    pub(super) normal: [S; 3],
    /// Below 0 inside `[m]`.
    pub(super) gap: S,
}

/// The box along the axes around places `[m]`.
fn around<S: Real>(places: impl Iterator<Item = [S; 3]>) -> [[S; 3]; 2] {
    places.fold([[S::INFINITY; 3], [-S::INFINITY; 3]], |[low, high], x| {
        let of = |k: usize| (low[k].min(x[k]), high[k].max(x[k]));
        let each = [of(0), of(1), of(2)];
        [each.map(|pair| pair.0), each.map(|pair| pair.1)]
    })
}

impl<S: Real> Solid<S> {
    pub(super) fn new(convex: &Convex) -> Self {
        let shape = match (convex.figure, convex.figure.frame()) {
            (Figure::Ball { center, radius }, _) => {
                Shape::Ball { center: convert(center), radius: S::from_f64(radius) }
            }
            (Figure::Box { .. }, frame) => {
                let frame = frame.unwrap_or_default();
                Shape::Box {
                    center: convert(frame.center),
                    half: convert(frame.half),
                    axes: frame.axes.map(convert),
                    corners: frame.corners().map(convert),
                }
            }
        };
        Solid {
            shape,
            extent: convex.figure.extent().map(convert),
            friction: S::from_f64(convex.friction),
            restitution: S::from_f64(convex.restitution),
        }
    }

    /// Whether a box comes nearer than `reach` `[m]` to the box around it.
    pub(super) fn is_near(&self, [low, high]: [[S; 3]; 2], reach: S) -> bool {
        (0..3).all(|k| low[k] - reach <= self.extent[1][k] && high[k] + reach >= self.extent[0][k])
    }

    /// Where a point on its way is beside it.
    #[inline(always)]
    pub(super) fn of_point(&self, start: [S; 3], now: [S; 3]) -> Option<Off<S>> {
        let shares = [S::ONE, S::ZERO, S::ZERO];
        match &self.shape {
            Shape::Ball { center, radius } => of_ball((*center, *radius), start, now).map(|off| Off { shares, ..off }),
            Shape::Box { center, half, axes, .. } => {
                let within = |x: [S; 3]| axes.map(|axis| dot(axis, sub(x, *center)));
                let (from, to) = (within(start), within(now));
                let (axis, is_up) = match side(*half, from, to) {
                    Some(face) => face,
                    None => return Some(Off { shares, ..beside_box(*half, axes, to) }),
                };
                let sign = if is_up { S::ONE } else { -S::ONE };
                Some(Off { shares, normal: scale(axes[axis], sign), gap: sign * to[axis] - half[axis] })
            }
        }
    }

    /// Where an edge is beside a ball, if it is nearest between its ends.
    #[inline(always)]
    pub(super) fn of_edge(&self, [a0, b0]: [[S; 3]; 2], [a, b]: [[S; 3]; 2]) -> Option<Off<S>> {
        let Shape::Ball { center, radius } = &self.shape else { return None };
        let u = sub(b, a);
        let (along, square) = (dot(sub(*center, a), u), dot(u, u));
        if along <= S::ZERO || along >= square {
            return None;
        }
        let t = along / square;
        let at = |a: [S; 3], b: [S; 3]| add(scale(a, S::ONE - t), scale(b, t));
        let off = of_ball((*center, *radius), at(a0, b0), at(a, b))?;
        Some(Off { shares: [S::ONE - t, t, S::ZERO], ..off })
    }

    /// Where a triangle is beside a ball, if it is nearest within.
    #[inline(always)]
    pub(super) fn of_triangle(&self, before: [[S; 3]; 3], [a, b, c]: [[S; 3]; 3]) -> Option<Off<S>> {
        let Shape::Ball { center, radius } = &self.shape else { return None };
        let found = nearest([*center, a, b, c]);
        let mean = |x: [[S; 3]; 3]| (0..3).fold(zero(), |sum, k| add(sum, scale(x[k], found.shares[k])));
        if !found.is_within {
            return None;
        }
        let off = of_ball((*center, *radius), mean(before), mean([a, b, c]))?;
        Some(Off { shares: found.shares, ..off })
    }

    /// How far a triangle, or an edge whose first end is told twice, is from a ball `[m]`.
    pub(super) fn gap_of_ball(&self, [a, b, c]: [[S; 3]; 3]) -> S {
        let Shape::Ball { center, radius } = &self.shape else { return S::ZERO };
        let from = nearest([*center, a, b, c]).from;
        dot(from, from).sqrt() - *radius
    }

    /// How far a triangle or an edge is from corners of a box, or from what is between them, at least `[m]`: boxes along the axes around
    /// both.
    pub(super) fn gap_of_corners(&self, numbers: &[u32], places: [[S; 3]; 3]) -> S {
        let Shape::Box { corners, .. } = &self.shape else { return S::ZERO };
        let own = numbers.iter().map(|&number| corners[number as usize]);
        let [low, high] = around(own);
        let [from, to] = around(places.into_iter());
        let along = |k: usize| (low[k] - to[k]).max(from[k] - high[k]).max(S::ZERO);
        let d = [0, 1, 2].map(along);
        dot(d, d).sqrt()
    }

    /// Where a triangle is beside a corner of a box, if the corner lies over its inside and is what of the box reaches furthest.
    #[inline(always)]
    pub(super) fn of_corner(&self, number: u32, before: [[S; 3]; 3], [a, b, c]: [[S; 3]; 3]) -> Option<Off<S>> {
        let Shape::Box { center, axes, corners, .. } = &self.shape else { return None };
        let corner = corners[number as usize];
        let normal = self.outward(cross3(sub(b, a), sub(c, a)), cross_of(before), (before[0], *center))?;
        let is_furthest = (0..3).all(|k| dot(normal, axes[k]) * sign::<S>(number, k) >= S::ZERO);
        let found = nearest([corner, a, b, c]);
        (is_furthest && found.is_within).then(|| Off { shares: found.shares, normal, gap: dot(normal, sub(a, corner)) })
    }

    /// Where an edge is beside an edge of a box, if they cross between their ends and the box reaches furthest there.
    #[inline(always)]
    pub(super) fn of_box_edge(&self, number: u32, [a0, b0]: [[S; 3]; 2], [a, b]: [[S; 3]; 2]) -> Option<Off<S>> {
        let Shape::Box { center, axes, corners, .. } = &self.shape else { return None };
        let ends = BOX_EDGES[number as usize];
        let [c, d] = ends.map(|end| corners[end as usize]);
        let [s, _] = lines([a, b], [c, d])?;
        let along = sub(d, c);
        let normal = self.outward(cross3(sub(b, a), along), cross3(sub(b0, a0), along), (a0, *center))?;
        let own = ends[0] ^ ends[1];
        let is_furthest =
            (0..3).filter(|k| own >> k & 1 == 0).all(|k| dot(normal, axes[k]) * sign::<S>(ends[0], k) >= S::ZERO);
        is_furthest.then(|| Off { shares: [S::ONE - s, s, S::ZERO], normal, gap: dot(normal, sub(a, c)) })
    }

    /// The unit vector along `normal` that leads outward: as, before the substep, from the middle to a place.
    #[inline(always)]
    fn outward(&self, normal: [S; 3], before: [S; 3], (place, center): ([S; 3], [S; 3])) -> Option<[S; 3]> {
        let square = dot(normal, normal);
        let side = dot(before, sub(place, center));
        if square == S::ZERO || side == S::ZERO {
            return None;
        }
        let length = square.sqrt();
        Some(scale(normal, if side > S::ZERO { S::ONE / length } else { -S::ONE / length }))
    }
}

fn cross_of<S: Real>([a, b, c]: [[S; 3]; 3]) -> [S; 3] {
    cross3(sub(b, a), sub(c, a))
}

/// On which side along an axis a corner of a box lies.
#[inline(always)]
fn sign<S: Real>(corner: u32, axis: usize) -> S {
    if corner >> axis & 1 == 1 { S::ONE } else { -S::ONE }
}

/// Where a place on its way is beside a ball. What got beyond the middle stays on the side that it came from.
#[inline(always)]
fn of_ball<S: Real>((center, radius): ([S; 3], S), start: [S; 3], now: [S; 3]) -> Option<Off<S>> {
    let (before, from) = (sub(start, center), sub(now, center));
    let shares = [S::ZERO; 3];
    let far = dot(from, from).sqrt();
    if dot(before, from) > S::ZERO && far > S::ZERO {
        return Some(Off { shares, normal: scale(from, S::ONE / far), gap: far - radius });
    }
    let way = sub(from, before);
    let square = dot(way, way);
    let share = if square > S::ZERO { -dot(before, way) / square } else { S::ZERO };
    let closest = add(before, scale(way, share));
    let length = dot(before, before).sqrt();
    if dot(closest, closest) >= radius * radius {
        return None;
    }
    let normal = if length > S::ZERO { scale(before, S::ONE / length) } else { [S::ZERO, S::ONE, S::ZERO] };
    Some(Off { shares, normal, gap: dot(normal, from) - radius })
}

/// The face of a box that what is inside now, or went through, came in by: its axis, and whether it is the upper one. What began inside
/// belongs to the nearest.
#[inline(always)]
fn side<S: Real>(half: [S; 3], from: [S; 3], to: [S; 3]) -> Option<(usize, bool)> {
    if (0..3).all(|k| from[k].abs() < half[k]) {
        if (0..3).any(|k| to[k].abs() >= half[k]) && (0..3).all(|k| (to[k] > S::ZERO) == (from[k] > S::ZERO)) {
            return None;
        }
        let mut nearest = 0;
        for k in 1..3 {
            if half[k] - from[k].abs() < half[nearest] - from[nearest].abs() {
                nearest = k;
            }
        }
        return Some((nearest, from[nearest] > S::ZERO));
    }
    let (mut enters, mut leaves) = (-S::ONE, S::ONE);
    let mut face = None;
    for k in 0..3 {
        let way = to[k] - from[k];
        if way == S::ZERO {
            if from[k].abs() > half[k] {
                return None;
            }
            continue;
        }
        let [near, far] = [-half[k], half[k]].map(|plane| (plane - from[k]) / way);
        let (near, far) = (near.min(far), near.max(far));
        if near > enters {
            (enters, face) = (near, Some((k, way < S::ZERO)));
        }
        leaves = leaves.min(far);
    }
    (enters < leaves && enters >= S::ZERO).then_some(face).flatten()
}

/// Where a place outside a box is beside it.
#[inline(always)]
fn beside_box<S: Real>(half: [S; 3], axes: &[[S; 3]; 3], to: [S; 3]) -> Off<S> {
    let over: [S; 3] = std::array::from_fn(|k| (to[k].abs() - half[k]).max(S::ZERO));
    let gap = dot(over, over).sqrt();
    let mut normal = zero();
    for k in 0..3 {
        let sign = if to[k] < S::ZERO { -S::ONE } else { S::ONE };
        normal = add(normal, scale(axes[k], sign * over[k]));
    }
    let unit = if gap > S::ZERO { scale(normal, S::ONE / gap) } else { axes[1] };
    Off { shares: zero(), normal: unit, gap }
}
