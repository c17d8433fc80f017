//! The arrow of a velocity: a body flies off as fast as it is drawn, a click stops it.

use glam::{DVec2, DVec3};

use super::Deed;
use super::build::short;
use super::chosen::Chosen;
use super::marks::{Mark, Role};
use super::pick::Scope;
use super::push::{NoPush, head};
use super::selecting::is_drag;
use crate::history::{Do, SetKeys, VectorOrEach};
use crate::scene::Vector;
use crate::sim::PointId;

/// The speed of an arrow of 100 px `[m/s]`, as of the wind.
const USUAL: f64 = 5.0;
const LONG: f64 = 100.0;
/// Width of an arrow `[logical px]`.
const WIDTH: f64 = 3.0;

/// A body whose velocity is being drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Throw {
    /// What of it is free.
    points: Vec<PointId>,
    /// `[px]`
    pressed: DVec2,
}

impl Throw {
    /// One begins on the body under a pixel.
    ///
    /// Errors: why there is none.
    pub(super) fn press(scope: Scope<'_>, at: DVec2) -> Result<Self, NoPush> {
        let Some(hit) = scope.nearest(at) else {
            return Err(if scope.solid(at).is_some() { NoPush::Solid } else { NoPush::NoBody });
        };
        let mut points = scope.body(hit.point);
        points.retain(|point| !scope.is_pinned(*point));
        if points.is_empty() { Err(NoPush::Pinned) } else { Ok(Throw { points, pressed: at }) }
    }

    /// The middle of its points as it is seen `[px]`, and in the world `[m]`.
    fn middle(&self, scope: Scope<'_>) -> Option<(DVec2, DVec3)> {
        let points = self.points.iter().copied().filter(|point| scope.is_there(*point)).collect();
        let middle = Chosen { points, ..Chosen::default() }.middle(scope);
        Some((scope.camera.screen_from_world(middle).map(DVec2::from)?, middle))
    }

    /// The velocity of an arrow that was drawn to a pixel `[m/s]`; a click is none.
    fn velocity(&self, scope: Scope<'_>, at: DVec2) -> DVec3 {
        let Some((from, middle)) = self.middle(scope).filter(|_| is_drag(scope, [self.pressed, at])) else {
            return DVec3::ZERO;
        };
        let way = at - self.pressed;
        let along = scope.facing(middle, from + way) - scope.facing(middle, from);
        let speed = USUAL * way.length() / (LONG * scope.scale);
        along.normalize_or_zero() * (100.0 * speed).round() / 100.0
    }

    pub(super) fn release(&self, scope: Scope<'_>, at: DVec2) -> Deed {
        let there = self.points.iter().filter(|point| scope.is_there(**point));
        let points: Vec<u32> = there.map(|point| point.0).collect();
        let velocity = Vector::new(self.velocity(scope, at).to_array(), scope.shown.dimensions);
        let velocity = Some(VectorOrEach::One(velocity));
        let keys = SetKeys { points: Some(points), velocity, ..SetKeys::default() };
        Deed::edit("velocity", Do::Set(Box::new(keys)))
    }

    /// The arrow with its speed.
    pub(super) fn marks(&self, scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
        let Some((from, _)) = self.middle(scope) else { return Vec::new() };
        let (to, width) = (from + at - self.pressed, WIDTH * scope.scale);
        let said = format!("{} m/s", short(self.velocity(scope, at).length()));
        let mut marks = vec![Mark::Line(Role::Come, from, to, width)];
        marks.extend(head(scope, [from, to]).map(|side| Mark::Line(Role::Come, to, side, width)));
        marks.push(Mark::Words(at + DVec2::new(16.0, -12.0) * scope.scale, said));
        marks
    }
}

/// What a press at a pixel would do.
pub(super) fn marks(scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
    let words = |words: &str| Mark::Words(at + DVec2::new(16.0, -12.0) * scope.scale, words.to_owned());
    match Throw::press(scope, at) {
        Ok(throw) => {
            let ring = throw.middle(scope).map(|(from, _)| Mark::Ring(Role::Come, from, 7.0 * scope.scale));
            ring.into_iter().chain([words("drag: it flies off so fast; a click stops it")]).collect()
        }
        Err(NoPush::Pinned) => vec![words(NoPush::Pinned.words())],
        Err(_) => Vec::new(),
    }
}
