//! What turned inside out is led back to its shape: piece by piece, each as a rigid body whose errors shrink.
//!
//! Springs alone may hold a fold for ever. So the points of a piece go, whatever its bonds say, towards the rest shape that fits them
//! best, evenly and within [`TIME`]; the piece as a whole goes on and turns as before. Contacts come after that.
//! Source of the fit: M. Müller and others, Meshless Deformations Based on Shape Matching, 2005; in the plane the rotation is closed form.

use super::cluster::Cluster;
use super::layout::Shape;
use super::pair::wedge;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// How long a piece takes to get its shape `[s]`.
const TIME: f64 = 0.4;
/// Share of the largest sum that a fit says nothing below.
const LEAST_FIT: f64 = 1e-4;

/// Points that are led to a shape.
#[derive(Clone, Debug)]
pub(super) struct Piece<S> {
    /// Points of the body.
    points: Vec<u32>,
    /// Where each is at rest, about the middle of all `[m]`.
    shape: Vec<[S; 2]>,
    mass: Vec<S>,
    /// How fast the largest error shrinks `[m/s]`.
    speed: S,
    /// Cosine and sine of the shape's angle, which goes on as the points turn: the fit of what is crumpled would jump.
    turn: [S; 2],
}

/// Where a shape lies: its middle, cosine and sine of its angle.
#[derive(Clone, Copy)]
struct Place<S> {
    middle: [S; 2],
    turn: [S; 2],
}

impl<S: Real> Place<S> {
    fn out(&self, q: [S; 2]) -> [S; 2] {
        let [c, s] = self.turn;
        add(self.middle, [c * q[0] - s * q[1], s * q[0] + c * q[1]])
    }

    fn back(&self, x: [S; 2]) -> [S; 2] {
        let ([c, s], r) = (self.turn, sub(x, self.middle));
        [c * r[0] + s * r[1], c * r[1] - s * r[0]]
    }
}

impl<S: Real> Piece<S> {
    /// The points of a body that begins at `base` which are free, led to the shape in which they were laid out; `None`: none is. What is
    /// held stays where it is, and would only throw about what is led to it: its bonds and areas do that. `haste`: how many times as fast
    /// as in [`TIME`] what bears nothing would go.
    pub(super) fn new(state: &Cluster<S>, (base, (points, shape)): (usize, Shape<S>), haste: f64) -> Option<Self> {
        let w = |point: u32| state.w[base + point as usize];
        let free = points.into_iter().zip(shape).filter(|&(point, _)| w(point) > S::ZERO);
        let (points, mut shape): Shape<S> = free.unzip();
        if points.is_empty() {
            return None;
        }
        let mass: Vec<S> = points.iter().map(|&point| S::ONE / w(point)).collect();
        let middle = mean(&mass, shape.iter().copied());
        shape.iter_mut().for_each(|q| *q = sub(*q, middle));
        let mut piece = Piece { points, shape, mass, speed: S::ZERO, turn: [S::ONE, S::ZERO] };
        let place = piece.fit(&state.now, base);
        piece.turn = place.turn;
        piece.speed = piece.farthest(&state.now, base, &place) * S::from_f64(haste / TIME);
        Some(piece)
    }

    pub(super) fn points(&self) -> &[u32] {
        &self.points
    }

    fn farthest(&self, x: &[[S; 2]], base: usize, place: &Place<S>) -> S {
        let off = |(&point, &q): (&u32, &[S; 2])| sub(place.back(x[base + point as usize]), q);
        let square = |off: [S; 2]| dot(off, off);
        self.points.iter().zip(&self.shape).map(off).map(square).fold(S::ZERO, S::max).sqrt()
    }

    /// Where the shape fits places best.
    fn fit(&self, x: &[[S; 2]], base: usize) -> Place<S> {
        let at = |&point: &u32| x[base + point as usize];
        let middle = mean(&self.mass, self.points.iter().map(at));
        let (mut along, mut across, mut most) = (S::ZERO, S::ZERO, S::ZERO);
        for ((point, &q), &mass) in self.points.iter().zip(&self.shape).zip(&self.mass) {
            let r = sub(at(point), middle);
            along += mass * dot(q, r);
            across += mass * wedge(q, r);
            most += mass * (dot(q, q) * dot(r, r)).sqrt();
        }
        let length = (along * along + across * across).sqrt();
        // What is its own mirror image has no angle.
        let says = length > S::from_f64(LEAST_FIT) * most;
        let turn = if says { [along / length, across / length] } else { [S::ONE, S::ZERO] };
        Place { middle, turn }
    }

    /// Leads the points on by a substep of `h` `[s]`.
    fn lead(&mut self, state: &mut Cluster<S>, base: usize, h: S) {
        let middle = |x: &[[S; 2]]| mean(&self.mass, self.points.iter().map(|&point| x[base + point as usize]));
        let before = Place { middle: middle(&state.start), turn: self.turn };
        let after = middle(&state.now);
        let (mut along, mut across) = (S::ZERO, S::ZERO);
        for (&point, &mass) in self.points.iter().zip(&self.mass) {
            let i = base + point as usize;
            let (from, to) = (sub(state.start[i], before.middle), sub(state.now[i], after));
            along += mass * dot(from, to);
            across += mass * wedge(from, to);
        }
        let length = (along * along + across * across).sqrt();
        if length > S::ZERO {
            let ([c, s], [x, y]) = (self.turn, [along / length, across / length]);
            let turn = [c * x - s * y, s * x + c * y];
            self.turn = scale(turn, S::ONE / dot(turn, turn).sqrt());
        }
        let after = Place { middle: after, turn: self.turn };
        let farthest = self.farthest(&state.start, base, &before);
        let kept = if farthest > S::ZERO { (S::ONE - self.speed * h / farthest).max(S::ZERO) } else { S::ZERO };
        for (&point, &q) in self.points.iter().zip(&self.shape) {
            let i = base + point as usize;
            let off = sub(before.back(state.start[i]), q);
            let shift = sub(after.out(add(q, scale(off, kept))), state.now[i]);
            state.now[i] = add(state.now[i], shift);
            state.way[i] = add(state.way[i], shift);
        }
    }
}

fn mean<S: Real>(mass: &[S], places: impl Iterator<Item = [S; 2]>) -> [S; 2] {
    let (mut sum, mut total, mut first) = (zero::<S, 2>(), S::ZERO, None);
    for (x, &mass) in places.zip(mass) {
        let origin = *first.get_or_insert(x);
        sum = add(sum, scale(sub(x, origin), mass));
        total += mass;
    }
    add(first.unwrap_or(zero()), scale(sum, S::ONE / total))
}

impl<S: Real> Cluster<S> {
    /// Whether all of three points are led to their shape.
    #[inline(always)]
    pub(super) fn is_led(&self, points: [usize; 3]) -> bool {
        let list = &self.tangle.is_led;
        !list.is_empty() && points.iter().all(|&point| list[point])
    }
}

/// Leads all pieces of a cluster on by a substep of `h` `[s]`.
pub(super) fn lead<S: Real>(state: &mut Cluster<S>, h: S) {
    let mut knots = std::mem::take(&mut state.tangle.knots);
    for knot in &mut knots {
        let base = state.bases[knot.body as usize] as usize;
        for piece in &mut knot.pieces {
            piece.lead(state, base, h);
            state.counts.mended += piece.points.len() as u64;
            state.counts.work += 60 * piece.points.len() as u64;
        }
    }
    state.tangle.knots = knots;
}
