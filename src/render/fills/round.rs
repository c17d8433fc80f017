//! Which outlines may be round: discs are made of few points, and their sides are drawn as arcs of their circle (`bulge` in fill.wgsl, by
//! where the points are now).

use super::outline::Side;
use super::pieces::pieces;
use crate::picture::Tint;

/// Sides of an outline from which on they are too short to be seen as straight.
const MOST: usize = 256;

/// Whether the sides of what triangles cover may be drawn as arcs: where nothing has a hole. An arc about a hole would lie on what is covered.
pub(super) fn may_be_round(triangles: &[[u32; 3]], sides: &[Side]) -> bool {
    (3..=MOST).contains(&sides.len()) && loops(sides) == pieces(triangles).len()
}

/// How many closed lines sides make.
fn loops(sides: &[Side]) -> usize {
    let mut starts: Vec<(u32, u32)> = (0..).zip(sides).map(|(number, side)| (side.a, number)).collect();
    starts.sort_unstable();
    let next = |end: u32| starts.get(starts.partition_point(|start| start.0 < end)).filter(|start| start.0 == end);
    let pairs = (0..).zip(sides).filter_map(|(number, side)| Some([number, next(side.b)?.1]));
    Tint::hanging(sides.len(), pairs).into_iter().max().map_or(0, |last| last as usize + 1)
}

#[cfg(test)]
mod tests {
    use super::super::outline::outline;
    use super::*;

    /// A fan about point 0 with so many points around it.
    fn disc(count: u32) -> Vec<[u32; 3]> {
        (0..count).map(|k| [0, 1 + k, 1 + (k + 1) % count]).collect()
    }

    #[test]
    fn discs_may_be_round_and_what_has_a_hole_may_not() {
        let of = |triangles: &[[u32; 3]]| may_be_round(triangles, &outline(triangles));
        assert!(of(&disc(12)) && of(&disc(3)) && !of(&[]));
        let other = disc(8).into_iter().map(|corners| corners.map(|corner| corner + 100));
        assert!(of(&disc(12).into_iter().chain(other).collect::<Vec<_>>()), "two beside each other");
        // Points inside, and as many further out.
        let rim = (0..12).flat_map(|k| {
            let next = (k + 1) % 12;
            [[k, 12 + k, 12 + next], [k, 12 + next, next]]
        });
        assert!(!of(&rim.collect::<Vec<_>>()));
        assert!(!of(&disc(300)), "its sides are short");
    }
}
