//! The outline of a plane: a line across the view, hatched on its solid side.

use glam::DVec2;

use super::outline::{line, pixel};
use crate::app::tools::marks::{Mark, Role};
use crate::app::tools::pick::Scope;

/// From stroke to stroke, and how deep each goes `[logical px]`.
const APART: f64 = 18.0;
const DEEP: f64 = 10.0;
/// Width of the strokes `[logical px]`.
const WIDTH: f64 = 1.0;

/// What of it is seen: the strokes stand where the plane is whatever part of it is in view.
pub(super) fn marks(scope: Scope<'_>, [point, along]: [DVec2; 2]) -> Vec<Mark> {
    let Some(from) = pixel(scope, point) else { return Vec::new() };
    let along = along.normalize_or(DVec2::X);
    // Pixels count downwards.
    let way = DVec2::new(along.x, -along.y);
    let solid = way.perp();
    let [low, high] = scope.seen();
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    let far = corners.map(|corner| (corner - from).dot(way));
    // Of what is seen alone: the point that it goes through may be far off.
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    let [least, most] = far.into_iter().fold(none, |[least, most], far| [least.min(far), most.max(far)]);
    let (apart, deep) = (APART * scope.scale, DEEP * scope.scale);
    let strokes = ((least / apart).ceil() as i64..=(most / apart).floor() as i64).map(|k| {
        let foot = from + k as f64 * apart * way;
        Mark::Line(Role::Come, foot, foot + deep * (solid - way), WIDTH * scope.scale)
    });
    let whole = line(scope, Role::Come, [from + least * way, from + most * way]);
    let in_view = |mark: &Mark| match mark {
        Mark::Line(_, foot, end, _) => [foot, end].into_iter().any(|at| at.cmpge(low).all() && at.cmple(high).all()),
        _ => true,
    };
    std::iter::once(whole).chain(strokes.filter(in_view)).collect()
}

#[cfg(test)]
#[allow(clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::tools::build::tests::room;
    use crate::app::tools::tests::scope;

    #[test]
    fn of_a_plane_through_a_point_far_off_the_view_alone_is_drawn() {
        let seen = room();
        for (point, along) in [([1e5, 0.0], [1.0, 0.0]), ([0.0, -1e5], [0.0, 1.0])] {
            let marks = marks(scope(&seen), [point, along].map(DVec2::from));
            let Some(Mark::Line(_, from, to, _)) = marks.first() else { panic!("{marks:?}") };
            let [low, high] = scope(&seen).seen();
            assert!(from.distance(*to) < 1.01 * low.distance(high), "{from} to {to}");
            assert!(marks.len() > 10, "it is hatched");
        }
    }
}
