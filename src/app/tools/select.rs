//! The tool for selecting: a click chooses a body or an obstacle, a drag moves it.

use glam::{DVec2, DVec3};

use super::Deed;
use super::erase::{delete_obstacle, delete_points};
use super::marks::{self, Mark, Role};
use super::pick::Scope;
use crate::history::{Do, MoveKeys};
use crate::scene::Vector;
use crate::sim::PointId;

/// A press that moves less than this moves nothing `[logical px]`.
const CLICK: f64 = 4.0;
/// Said where a body of space is dragged.
const OF_THE_PLANE: &str = "bodies are moved in the plane only: this scene is in space";

/// Whether a press that ends elsewhere moves what it was on.
pub(super) fn is_drag(scope: Scope<'_>, [from, to]: [DVec2; 2]) -> bool {
    from.distance(to) >= CLICK * scope.scale
}

/// What is selected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Picked {
    /// All that bonds hold together with a point.
    Body(PointId),
    Obstacle(u32),
}

impl Picked {
    /// What lies under a pixel: a body before an obstacle.
    pub(super) fn at(scope: Scope<'_>, at: DVec2) -> Option<Self> {
        let body = scope.nearest(at).map(|hit| Picked::Body(hit.point));
        body.or_else(|| scope.solid(at).map(Picked::Obstacle))
    }

    /// Whether it is still there.
    pub(super) fn is_there(self, scope: Scope<'_>) -> bool {
        match self {
            Picked::Body(point) => {
                point.index() < scope.shown.point_count() && scope.shown.scenery.gone.binary_search(&point).is_err()
            }
            Picked::Obstacle(number) => scope.shown.scenery.solid_numbers.contains(&number),
        }
    }

    /// The points of a body; none of an obstacle.
    pub(super) fn points(self, scope: Scope<'_>) -> Vec<PointId> {
        match self {
            Picked::Body(point) => scope.body(point),
            Picked::Obstacle(_) => Vec::new(),
        }
    }

    /// It goes as far as a drag did `[px]`.
    pub(super) fn moved(self, scope: Scope<'_>, [from, to]: [DVec2; 2]) -> Deed {
        if !is_drag(scope, [from, to]) {
            return Deed::default();
        }
        if scope.shown.dimensions != 2 {
            return Deed::words(OF_THE_PLANE.to_owned());
        }
        let [from, to] = [from, to].map(|at| scope.camera.world_from_screen(at.to_array()).truncate());
        let keys = MoveKeys {
            by: Some(Vector::Plane((to - from).to_array())),
            points: self.points(scope).into_iter().map(|point| point.0).collect(),
            obstacles: if let Picked::Obstacle(number) = self { vec![number] } else { Vec::new() },
            ..MoveKeys::default()
        };
        Deed::edit("move", Do::Move(Box::new(keys)))
    }

    /// It goes away.
    pub(super) fn deleted(self, scope: Scope<'_>) -> Deed {
        match self {
            Picked::Body(_) => delete_points(self.points(scope)),
            Picked::Obstacle(number) => delete_obstacle(number),
        }
    }

    /// Its outline, so far from where it is `[px]`.
    pub(super) fn outline(self, scope: Scope<'_>, role: Role, off: DVec2) -> Vec<Mark> {
        let lines = match self {
            Picked::Body(_) => marks::body(role, scope, &self.points(scope)),
            Picked::Obstacle(number) => marks::obstacle(role, scope, number),
        };
        lines.into_iter().map(|mark| mark.shifted(off)).collect()
    }

    /// From where it is to a place beside it `[m]`, to the right as far as it is wide and a little more.
    pub(super) fn beside(self, scope: Scope<'_>) -> [f64; 3] {
        let places = self.points(scope).into_iter().map(|point| DVec3::from(scope.shown.place(point.index())).x);
        let [low, high] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        // A single point is as wide as a finger.
        let finger = 24.0 * scope.scale / scope.camera.pixels_per_metre();
        [1.1 * (high - low).max(finger), 0.0, 0.0]
    }
}
