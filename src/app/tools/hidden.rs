//! Bodies that are hidden: the tool that selects shows where they are, so that none is lost.

use super::Chosen;
use super::marks::{self, Mark, Role};
use super::pick::Scope;
use crate::picture::Tint;
use crate::sim::PointId;

/// Bodies that are outlined each by itself at most.
const MOST: usize = 200;

/// The bodies that have hidden points, ascending points each.
pub(in crate::app) fn bodies(scope: Scope<'_>) -> Vec<Vec<PointId>> {
    let tints = &scope.shown.scenery.tints;
    if !tints.iter().any(|tint| tint.is_hidden) {
        return Vec::new();
    }
    let count = scope.shown.point_count();
    let pairs = scope.shown.scenery.bonds.ends().iter().copied().chain(scope.arms());
    let body = Tint::hanging(count, pairs.map(|ends| ends.map(|end| end.0)));
    let mut place_of = vec![usize::MAX; count];
    let mut list: Vec<Vec<PointId>> = Vec::new();
    for point in (0..count as u32).map(PointId).filter(|&point| scope.is_there(point)) {
        if !Tint::hides(tints, point.0) {
            continue;
        }
        let place = &mut place_of[body[point.index()] as usize];
        if *place == usize::MAX {
            *place = list.len();
            list.push(Vec::new());
        }
        list[*place].push(point);
    }
    list
}

/// Faint outlines of all of them.
pub(super) fn outlines(scope: Scope<'_>) -> Vec<Mark> {
    bodies(scope).iter().take(MOST).flat_map(|points| marks::body(Role::Ghost, scope, points)).collect()
}

impl Chosen {
    /// All that is hidden.
    pub(in crate::app) fn hidden(scope: Scope<'_>) -> Self {
        let mut points: Vec<PointId> = bodies(scope).concat();
        points.sort_unstable();
        Chosen { points, ..Chosen::default() }
    }
}
