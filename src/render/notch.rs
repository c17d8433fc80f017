//! Notches that a cut leaves: triangles that lost a side are not drawn, so that an edge along a stroke has teeth. Where what lay in a notch was parted from
//! all that is about it, a triangle between its three points closes it: the edge goes on straight, and moves with the body.
//!
//! ```text
//!   p ───── q     closed        Points p and q of the outline beside v are joined
//!    ╲     ╱                    by a brace of triangles that are gone; or, where
//!     ╲   ╱                     a mesh has no braces, the point that lay before
//!       v                       v was cut off from p, v and q.
//! ```

use std::collections::BTreeSet;

use super::view::View;
use crate::sim::Bond;
use crate::sim::bond::lower_first;
use crate::sim::triangles::{self, Side};
use crate::sim::vector::{add, cross3, dot, sub};

/// Both ends of a bond.
type Ends = [u32; 2];

/// Triangles that close the notches of what is left of a mesh, each gone along as those beside it are.
///
/// Shapes: corners are points of the world. Valid range: points that the outline passes more than once have no notch, nor has one that is convex where the
/// points are now. A brace across a hole, which has two, closes neither: a bond alone tore there.
pub(super) fn closing(view: &View<'_>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let sides = triangles::sides(triangles.iter().copied());
    let is_side = |ends: Ends| sides.binary_search_by_key(&lower_first(ends), |side| side.ends).is_ok();
    let mut corners = corners(&sides);
    corners.retain(|&[p, _, q]| p != q && !is_side([p, q]));
    let mut hollow = hollow(view, triangles, &corners).into_iter();
    corners.retain(|_| hollow.next() == Some(true));
    if corners.is_empty() {
        return Vec::new();
    }
    let braces = Braces::new(triangles, &corners, view.bonds.ends().iter().map(|ends| ends.map(|end| end.0)));
    let torn = Torn::new(&corners, view.torn);
    corners.retain(|&corner| match braces.are_at(corner) {
        true => braces.span(corner),
        false => torn.is_cut_off(corner),
    });
    let mut taken = BTreeSet::new();
    // Two notches that share a side are not both closed.
    corners.retain(|&[p, v, q]| {
        let is_free = !taken.contains(&[p, v]) && !taken.contains(&[v, q]);
        if is_free {
            taken.extend([[p, v], [v, q]]);
        }
        is_free
    });
    corners.into_iter().map(|[p, v, q]| [q, v, p]).collect()
}

/// Of each corner whether what is covered goes round it by more than half: a triangle across it faces as those at it do.
fn hollow(view: &View<'_>, triangles: &[[u32; 3]], corners: &[[u32; 3]]) -> Vec<bool> {
    let dimensions = view.dimensions;
    let place = |point: u32| -> [f64; 3] {
        let at = |axis: usize| Some(dimensions * point as usize + axis).filter(|at| *at < view.current.len());
        std::array::from_fn(
            |axis| if axis < dimensions { at(axis).map_or(f64::NAN, |at| view.current.get(at)) } else { 0.0 },
        )
    };
    let area = |corners: [u32; 3]| {
        let [a, b, c] = corners.map(place);
        cross3(sub(b, a), sub(c, a))
    };
    let mut facing = vec![[0.0; 3]; corners.len()];
    for &triangle in triangles {
        for point in triangle {
            if let Ok(at) = corners.binary_search_by_key(&point, |corner| corner[1]) {
                facing[at] = add(facing[at], area(triangle));
            }
        }
    }
    corners.iter().zip(facing).map(|(&[p, v, q], facing)| dot(facing, area([q, v, p])) > 0.0).collect()
}

/// The points that the outline passes once, each between those before and after it, ascending by the middle ones.
fn corners(sides: &[Side]) -> Vec<[u32; 3]> {
    let mut from: Vec<Ends> = triangles::alone(sides).map(|side| side.way).collect();
    let mut to: Vec<Ends> = from.iter().map(|&[a, b]| [b, a]).collect();
    from.sort_unstable();
    to.sort_unstable();
    let only = |list: &[Ends], point: u32| {
        let first = list.partition_point(|way| way[0] < point);
        match list[first..] {
            [[a, other], [b, _], ..] if a == point && b != point => Some(other),
            [[a, other]] if a == point => Some(other),
            _ => None,
        }
    };
    from.iter().filter_map(|&[v, _]| Some([only(&to, v)?, v, only(&from, v)?])).collect()
}

/// Bonds between far corners of two triangles that share a side.
struct Braces {
    /// Ends of those whose triangles are both there, ascending, without repeats.
    ends: Vec<u32>,
    /// Those between the points beside corners whose triangles are gone, ascending, but for those that two corners have.
    orphans: Vec<Ends>,
}

impl Braces {
    fn new(triangles: &[[u32; 3]], corners: &[[u32; 3]], bonds: impl Iterator<Item = Ends>) -> Self {
        let borne = triangles::far_corners(triangles);
        let mut across: Vec<Ends> = corners.iter().map(|&[p, _, q]| lower_first([p, q])).collect();
        across.sort_unstable();
        let (mut ends, mut orphans) = (Vec::new(), Vec::new());
        for bond in bonds.map(lower_first) {
            if borne.binary_search(&bond).is_ok() {
                ends.extend(bond);
            } else if across.binary_search(&bond).is_ok() {
                orphans.push(bond);
            }
        }
        ends.sort_unstable();
        ends.dedup();
        orphans.sort_unstable();
        orphans.dedup();
        let count =
            |bond: &Ends| across.partition_point(|other| other <= bond) - across.partition_point(|other| other < bond);
        orphans.retain(|bond| count(bond) == 1);
        Braces { ends, orphans }
    }

    /// Whether the mesh has braces at a corner.
    fn are_at(&self, corner: [u32; 3]) -> bool {
        corner.iter().any(|point| self.ends.binary_search(point).is_ok())
    }

    fn span(&self, [p, _, q]: [u32; 3]) -> bool {
        self.orphans.binary_search(&lower_first([p, q])).is_ok()
    }
}

/// Bonds at corners that went, from either end, ascending.
struct Torn(Vec<Ends>);

impl Torn {
    fn new(corners: &[[u32; 3]], torn: &[Bond]) -> Self {
        let mut at: Vec<u32> = corners.iter().flatten().copied().collect();
        at.sort_unstable();
        let both = torn.iter().map(|bond| [bond.a.0, bond.b.0]).flat_map(|[a, b]| [[a, b], [b, a]]);
        let mut list: Vec<Ends> = both.filter(|way| at.binary_search(&way[0]).is_ok()).collect();
        list.sort_unstable();
        Torn(list)
    }

    fn of(&self, point: u32) -> impl Iterator<Item = u32> {
        let first = self.0.partition_point(|way| way[0] < point);
        self.0[first..].iter().take_while(move |way| way[0] == point).map(|way| way[1])
    }

    /// Whether a point was cut off from all three of a corner.
    fn is_cut_off(&self, [p, v, q]: [u32; 3]) -> bool {
        let has = |way: Ends| self.0.binary_search(&way).is_ok();
        self.of(v).any(|far| has([p, far]) && has([q, far]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{Bonds, PointId, Positions};

    /// Places of a hexagonal lattice 1 apart, 12 by 12, with its triangles and their far corners.
    fn lattice() -> (Vec<[f64; 2]>, Vec<[u32; 3]>) {
        let wide = 12;
        let place =
            |k: u32| [f64::from(k % wide) + 0.5 * f64::from(k / wide % 2), f64::from(k / wide) * 0.75_f64.sqrt()];
        let cell = |k: u32| {
            let [a, b, c, d] = [k, k + 1, k + wide, k + wide + 1];
            if (k / wide).is_multiple_of(2) { [[a, b, c], [b, d, c]] } else { [[a, b, d], [a, d, c]] }
        };
        let first = (0..wide * (wide - 1)).filter(|k| k % wide + 1 < wide);
        ((0..wide * wide).map(place).collect(), first.flat_map(cell).collect())
    }

    fn bonds(triangles: &[[u32; 3]], is_braced: bool) -> Vec<Ends> {
        let mut list: Vec<Ends> = triangles::sides(triangles.iter().copied()).iter().map(|side| side.ends).collect();
        list.extend(triangles::far_corners(triangles).into_iter().filter(|_| is_braced));
        list.sort_unstable();
        list.dedup();
        list
    }

    fn made(ends: &[Ends]) -> Vec<Bond> {
        ends.iter().map(|&[a, b]| Bond::new(PointId(a), PointId(b), 1.0)).collect()
    }

    /// What closes triangles where points are there, with these bonds and those that tore.
    fn closed(places: &[[f64; 2]], triangles: &[[u32; 3]], bonds: &[Ends], torn: &[Ends]) -> Vec<[u32; 3]> {
        let (bonds, torn): (Bonds, _) = (made(bonds).into_iter().collect(), made(torn));
        let at = Positions::F64(places.as_flattened());
        closing(&View { previous: at, current: at, torn: &torn, ..View::empty(&bonds, 2) }, triangles)
    }

    /// How far a place is to the left of a line through a place in a direction.
    fn left([x, y]: [f64; 2], angle: f64) -> f64 {
        let (sin, cos) = angle.to_radians().sin_cos();
        (y - 4.71) * cos - (x - 5.83) * sin
    }

    /// The triangles that a cut along a line leaves of a lattice, then the bonds that it leaves, and those that it does not.
    fn cut(places: &[[f64; 2]], is_braced: bool, angle: f64) -> (Vec<[u32; 3]>, [Vec<Ends>; 2]) {
        let (_, triangles) = lattice();
        let is_left = |point: u32| left(places[point as usize], angle) > 0.0;
        let (torn, kept) = bonds(&triangles, is_braced).into_iter().partition(|&[a, b]| is_left(a) != is_left(b));
        let whole = triangles.into_iter().filter(|&[a, b, c]| is_left(a) == is_left(b) && is_left(b) == is_left(c));
        let whole = whole.collect();
        (whole, [kept, torn])
    }

    /// How far the outline at either side of the cut is out of line, away from its ends.
    fn unevenness(places: &[[f64; 2]], triangles: &[[u32; 3]], angle: f64) -> f64 {
        let points = triangles::outer_sides(triangles.iter().copied()).into_iter().flat_map(|side| side.ends);
        let near = points.map(|point| places[point as usize]).filter(|[x, y]| (x - 5.83).hypot(y - 4.71) < 3.5);
        let off: Vec<f64> = near.map(|place| left(place, angle)).collect();
        let spread = |sign: f64| {
            let of = || off.iter().map(|x| sign * x).filter(|x| *x > 0.0);
            of().fold(0.0, f64::max) - of().fold(f64::INFINITY, f64::min)
        };
        spread(1.0).max(spread(-1.0))
    }

    #[test]
    fn teeth_along_a_cut_are_closed_with_and_without_braces_and_what_was_torn_need_not_be_known_where_they_are() {
        let (places, _) = lattice();
        for (angle, before, after) in [(30.0, 0.4, 1e-9), (15.0, 0.7, 0.6), (40.0, 0.7, 0.55), (90.0, 0.4, 1e-9)] {
            for (is_braced, knows) in [(false, true), (true, true), (true, false)] {
                let (mut whole, [kept, torn]) = cut(&places, is_braced, angle);
                assert!(unevenness(&places, &whole, angle) > before, "{angle}");
                let closing = closed(&places, &whole, &kept, if knows { &torn } else { &[] });
                for corners in &closing {
                    let [[x, y], [u, v], [s, t]] = corners.map(|corner| places[corner as usize]);
                    assert!(
                        (u - x) * (t - y) - (s - x) * (v - y) > 0.1,
                        "{angle}: {corners:?} is gone along as others are"
                    );
                    let is_left = corners.map(|corner| left(places[corner as usize], angle) > 0.0);
                    assert!(is_left == [is_left[0]; 3], "{angle}: on one side of the cut");
                }
                whole.extend(closing);
                let found = unevenness(&places, &whole, angle);
                assert!(found < after, "{angle}, {is_braced}, {knows}: {found}");
            }
        }
    }

    #[test]
    fn what_is_whole_or_lost_one_bond_has_no_notches() {
        let (places, triangles) = lattice();
        for is_braced in [false, true] {
            let all = bonds(&triangles, is_braced);
            assert!(closed(&places, &triangles, &all, &[]).is_empty());
            let gone = [65, 66];
            let kept: Vec<Ends> = all.iter().copied().filter(|bond| *bond != gone).collect();
            let has_both = |corners: &[u32; 3]| gone.iter().all(|end| corners.contains(end));
            let whole: Vec<[u32; 3]> = triangles.iter().copied().filter(|corners| !has_both(corners)).collect();
            assert_eq!(whole.len(), triangles.len() - 2);
            assert!(closed(&places, &whole, &kept, &[gone]).is_empty(), "the hole stays, braced or not: {is_braced}");
        }
        assert!(closed(&places, &[], &[], &[]).is_empty());
    }

    #[test]
    fn a_bond_across_a_notch_of_what_has_no_braces_closes_nothing_nor_does_one_across_a_convex_corner() {
        // An arrowhead with a spring from barb to barb.
        let places = [[0.0, 0.0], [-1.0, -1.0], [0.0, 1.0], [1.0, -1.0]];
        let arrow = [[0, 2, 1], [0, 3, 2]];
        let all: Vec<Ends> = bonds(&arrow, false).into_iter().chain([[1, 3]]).collect();
        assert!(closed(&places, &arrow, &all, &[]).is_empty());
        // A pentagon that is covered from one corner, whose braces go all the way round.
        let at = |k: u32| {
            let (sin, cos) = (0.4 * std::f64::consts::PI * f64::from(k)).sin_cos();
            [cos, sin]
        };
        let places: Vec<[f64; 2]> = (0..5).map(at).collect();
        let all: Vec<Ends> = (0..5).flat_map(|k| [[k, (k + 1) % 5], [k, (k + 2) % 5]]).collect();
        assert!(closed(&places, &[[0, 1, 2], [0, 2, 3], [0, 3, 4]], &all, &[]).is_empty());
    }
}
