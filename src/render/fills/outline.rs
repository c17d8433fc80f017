//! The outline of what triangles cover: its sides in order, each with the corners before and after it.

use crate::sim::triangles::outer_sides;

/// A side of the outline, from `a` to `b` with what is covered at its left, and where the outline comes from and goes on to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Side {
    pub(super) before: u32,
    pub(super) a: u32,
    pub(super) b: u32,
    pub(super) after: u32,
}

/// The sides that one triangle has alone, ascending by their lower ends.
///
/// Valid range: where outlines meet in a point any of them goes on; a side that nothing goes on from ends in itself.
pub(super) fn outline(triangles: &[[u32; 3]]) -> Vec<Side> {
    let alone = outer_sides(triangles.iter().copied());
    let alone: Vec<[u32; 2]> = alone.into_iter().map(|side| side.way).collect();
    let by_start = sorted(alone.iter().copied());
    let by_end = sorted(alone.iter().map(|&[a, b]| [b, a]));
    let beside = |list: &[[u32; 2]], end: u32, none: u32| {
        list.get(list.partition_point(|side| side[0] < end)).filter(|side| side[0] == end).map_or(none, |side| side[1])
    };
    alone.iter().map(|&[a, b]| Side { before: beside(&by_end, a, a), a, b, after: beside(&by_start, b, b) }).collect()
}

fn sorted(sides: impl Iterator<Item = [u32; 2]>) -> Vec<[u32; 2]> {
    let mut list: Vec<[u32; 2]> = sides.collect();
    list.sort_unstable();
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outline_of_a_square_goes_round_it() {
        let mut sides = outline(&[[0, 1, 2], [0, 2, 3]]);
        sides.sort_unstable_by_key(|side| side.a);
        let side = |before, a, b, after| Side { before, a, b, after };
        assert_eq!(sides, [side(3, 0, 1, 2), side(0, 1, 2, 3), side(1, 2, 3, 0), side(2, 3, 0, 1)]);
        assert!(outline(&[]).is_empty());
    }
}
