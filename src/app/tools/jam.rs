//! What is in the way of obstacles that are dragged and has no room.

use glam::DVec2;

use super::marks::{self, Mark, Role};
use super::pick::Scope;
use crate::sim::NoRoom;

/// The outline of what is in the way, red, and why it gives no more way beside the pointer; nothing where there is room.
pub(super) fn marks(scope: Scope<'_>, at: Option<DVec2>) -> Vec<Mark> {
    let Some(jam) = &scope.shown.jam else { return Vec::new() };
    let points: Vec<_> = jam.points.iter().copied().filter(|&point| scope.is_there(point)).collect();
    let mut marks = marks::body(Role::Away, scope, &points);
    marks.extend(at.map(|at| Mark::Words(at + DVec2::new(16.0, -14.0) * scope.scale, words(jam.why).to_owned())));
    marks
}

fn words(why: NoRoom) -> &'static str {
    match why {
        NoRoom::Pinned => "no room: a pin holds the body in the way",
        NoRoom::Pressed => "no room: the body in the way is pressed as far as it goes",
        NoRoom::Crowded => "no room: the body in the way is pressed against another",
    }
}
