//! The skin of a body: the sides that only one of its triangles has.

use super::pick::Scope;
use crate::sim::PointId;
use crate::sim::triangles::outer_sides;

/// The sides of the skin of a body, whose points are ascending; none where it covers nothing.
pub(super) fn sides(scope: Scope<'_>, body: &[PointId]) -> Vec<[PointId; 2]> {
    let sides = outer_sides(own(scope, body).map(|corners| corners.map(|corner| corner.0)));
    sides.into_iter().map(|side| side.ends.map(PointId)).collect()
}

/// The corners of its triangles, ascending.
pub(super) fn corners(scope: Scope<'_>, body: &[PointId]) -> Vec<PointId> {
    let mut corners: Vec<PointId> = own(scope, body).flatten().copied().collect();
    corners.sort_unstable();
    corners.dedup();
    corners
}

fn own<'a>(scope: Scope<'a>, body: &'a [PointId]) -> impl Iterator<Item = &'a [PointId; 3]> {
    let has = |corner: &PointId| body.binary_search(corner).is_ok();
    scope.shown.scenery.triangles.iter().filter(move |corners| corners.iter().all(has))
}

/// The loops that directed sides make, each from a corner to the next; sides that lead nowhere are in none.
///
/// Valid range: any sides. Where loops meet in a corner each goes on by any of the sides from there, and all of them close.
pub(super) fn loops(sides: impl IntoIterator<Item = [u32; 2]>) -> Vec<Vec<u32>> {
    let mut sides: Vec<[u32; 2]> = sides.into_iter().collect();
    sides.sort_unstable();
    // Of the sides from a corner, those before this one are gone.
    let mut next: Vec<usize> = (0..sides.len()).collect();
    let first = |corner: u32| sides.partition_point(|side| side[0] < corner);
    let mut take = |corner: u32| {
        let from = first(corner);
        let place = *next.get(from)?;
        let side = sides.get(place).filter(|side| side[0] == corner)?;
        next[from] += 1;
        Some(side[1])
    };
    let mut loops = Vec::new();
    for &[start, _] in &sides {
        let mut way = vec![start];
        while let Some(to) = way.last().and_then(|&at| take(at)) {
            if to == start {
                if way.len() > 2 {
                    loops.push(std::mem::take(&mut way));
                }
                break;
            }
            way.push(to);
        }
    }
    loops
}

#[cfg(test)]
mod tests {
    use super::loops;

    #[test]
    fn sides_make_loops_and_what_leads_nowhere_is_in_none() {
        assert_eq!(loops([[0, 1], [1, 2], [2, 0]]), [[0, 1, 2]]);
        let two = loops([[0, 1], [1, 2], [2, 0], [5, 6], [6, 7], [7, 8], [8, 5]]);
        assert_eq!(two, [vec![0, 1, 2], vec![5, 6, 7, 8]]);
        // Two that touch in a corner.
        let mut touching = loops([[0, 1], [1, 2], [2, 0], [0, 3], [3, 4], [4, 0]]);
        touching.sort();
        assert_eq!(touching, [vec![0, 1, 2], vec![0, 3, 4]]);
        assert!(loops([[0, 1], [1, 2]]).is_empty());
    }
}
