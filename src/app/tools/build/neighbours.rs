//! The points that a new point is bonded to at once, beside the one that the chain comes from: so trusses are drawn, each point by one click.

use glam::DVec2;

use super::chain::Node;
use crate::app::tools::pick::Scope;
use crate::app::tools::segments::distance_to_segment;
use crate::sim::PointId;

/// How far it reaches at least, at most, and at first `[logical px]`.
pub(in crate::app) const REACHES: [u32; 2] = [30, 400];
pub(super) const REACH: u32 = 120;
/// A point is bonded to so many at most, the nearest: those around it in a net of triangles.
const MOST: usize = 6;
/// A point so near to a bond stands in its way `[logical px]`: of points in a row the nearest alone is bonded.
const IN_THE_WAY: f64 = 8.0;

/// The nodes within so many pixels of a pixel that a point there is bonded to, the nearest first, none of them behind another or behind `last`,
/// where the chain comes from. They are those of the chain, each with where it is seen, and points of the world where no triangles meet: within a
/// body there are too many, and its skin is for the pointer itself.
pub(super) fn about(
    scope: Scope<'_>,
    (at, reach): (DVec2, f64),
    of_chain: &[(Node, DVec2)],
    last: Option<(Node, DVec2)>,
) -> Vec<Node> {
    let mut all: Vec<(f64, Node, DVec2)> =
        of_chain.iter().map(|&(node, there)| (there.distance(at), node, there)).collect();
    let world = free(scope, scope.about(at, reach)).into_iter();
    all.extend(world.filter_map(|point| {
        let there = scope.pixel(point)?;
        Some((there.distance(at), Node::World(point), there))
    }));
    all.retain(|(far, node, _)| *far <= reach && last.is_none_or(|(last, _)| last != *node));
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut in_the_way: Vec<DVec2> = last.map(|(_, there)| there).into_iter().collect();
    let mut found = Vec::new();
    for (_, node, there) in all {
        let is_behind = |other: &DVec2| distance_to_segment(*other, at, there) < IN_THE_WAY * scope.scale;
        if found.len() < MOST && !in_the_way.iter().any(is_behind) {
            found.push(node);
            in_the_way.push(there);
        }
    }
    found
}

/// Those of some points where no triangles meet.
fn free(scope: Scope<'_>, mut points: Vec<PointId>) -> Vec<PointId> {
    if points.is_empty() {
        return points;
    }
    // Triangles are gone through once for all of them.
    points.sort_unstable();
    let mut is_covered = vec![false; points.len()];
    let corners = scope.shown.scenery.triangles.iter().flatten();
    corners.filter_map(|corner| points.binary_search(corner).ok()).for_each(|place| is_covered[place] = true);
    let free = points.into_iter().zip(is_covered).filter(|(_, is_covered)| !is_covered);
    free.map(|(point, _)| point).collect()
}
