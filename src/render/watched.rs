//! The points that one looks at first: free ends, weights, and the middles of discs.

use std::collections::BTreeSet;

use super::view::View;
use crate::sim::PointId;

/// So many times as heavy as the middle one of the free points is a weight `[1]`.
const HEAVY: f64 = 4.0;
/// The middle of a disc has so many bonds at least, and so many times as many as those about it have `[1]`.
const SPOKES: usize = 6;
const HUB: f64 = 1.5;

/// Of the points that are `free` to move: ends that one bond holds, then weights, then middles.
pub(super) fn watched(view: &View<'_>, free: &[PointId]) -> [Vec<PointId>; 3] {
    let count = view.current.len() / view.dimensions.max(1);
    let mut about: Vec<Vec<usize>> = vec![Vec::new(); count];
    for &[a, b] in view.bonds.ends() {
        let [a, b] = [a, b].map(PointId::index);
        if a.max(b) < count {
            about[a].push(b);
            about[b].push(a);
        }
    }
    let of = |is_one: &dyn Fn(usize) -> bool| {
        free.iter().copied().filter(|point| is_one(point.index())).collect::<Vec<PointId>>()
    };
    let heavy = heavy(view.masses, free);
    let is_hub = |point: usize| {
        let near: BTreeSet<usize> = about[point].iter().copied().collect();
        let bonds: usize = near.iter().map(|&other| about[other].len()).sum();
        near.len() >= SPOKES && near.len() as f64 * near.len() as f64 >= HUB * bonds as f64
    };
    [of(&|point| about[point].len() == 1), heavy, of(&is_hub)]
}

/// Those that are much heavier than most.
fn heavy(masses: &[f64], free: &[PointId]) -> Vec<PointId> {
    let mass = |point: &PointId| masses.get(point.index()).copied().unwrap_or(0.0);
    let mut all: Vec<f64> = free.iter().map(mass).collect();
    all.sort_by(f64::total_cmp);
    let Some(&middle) = all.get(all.len() / 2) else { return Vec::new() };
    free.iter().copied().filter(|point| mass(point) >= HEAVY * middle && middle > 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Trails;
    use crate::sim::{Bond, Bonds, Positions};

    #[test]
    fn a_tip_a_weight_and_the_middle_of_a_disc_have_trails_before_others() {
        // A rope of ten points, whose fifth is a weight, hangs on the first; beside it a disc of eight spokes.
        let rope = (0..9).map(|i| [i, i + 1]);
        let rim = (0..8).map(|i| [11 + i, 11 + (i + 1) % 8]);
        let spokes = (0..8).map(|i| [10, 11 + i]);
        let ends = rope.chain(rim).chain(spokes);
        let bonds: Bonds = ends.map(|[a, b]| Bond::new(PointId(a), PointId(b), 1.0)).collect();
        let (x, mut masses) = ([0.0; 38], [1.0; 19]);
        masses[5] = 9.0;
        let at = Positions::F64(&x);
        let view = View { current: at, previous: at, pinned: &[PointId(0)], masses: &masses, ..View::empty(&bonds, 2) };
        assert_eq!(Trails::choose(&view, &[], 3), [9, 5, 10].map(PointId));
        assert_eq!(Trails::choose(&view, &[&[PointId(2)]], 2), [2, 9].map(PointId), "what is probed or selected first");
        assert_eq!(Trails::choose(&view, &[], 8).len(), 8, "then others");
    }
}
