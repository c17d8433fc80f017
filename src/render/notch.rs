//! Notches that a cut leaves: triangles that lost a side are not drawn, so that an edge along a stroke has teeth and steps. Triangles between points that are
//! there close them: the edge goes on straight, and moves with the body.
//!
//! ```text
//!   p ───── q     closed first  Points p and q of the outline beside v are joined by a brace of triangles that are
//!    ╲     ╱                    gone; or the point that lay before v was cut off from p, v and q.
//!     ╲   ╱       then          It is shallow, and p to v or v to q is a side of what was closed: the steps of a
//!       v                       stroke that goes along no row of the mesh.
//! ```

use std::collections::BTreeSet;

use super::view::View;
use crate::sim::Bond;
use crate::sim::bond::lower_first;
use crate::sim::triangles::{self, Side};
use crate::sim::vector::{add, cross3, dot, length, sub};

/// Both ends of a bond, or from which to which a side goes.
type Ends = [u32; 2];

/// Triangles from which on teeth are too small to be seen.
const MOST: usize = 1 << 15;
/// Depth of a notch beside its shorter side: what is less is straight, and what is more is none of the steps of a straight stroke `[1]`. Those of a
/// triangular lattice are 0.33, the end of a slit is 0.87.
const DEPTHS: [f64; 2] = [0.01, 0.5];
/// The longest side that closes steps beside the shorter one there `[1]`.
const LONGEST: f64 = 6.0;
/// Where the outline comes back so near to a point after the one beside it, it goes round the end of a slit, beside the shorter side there `[1]`: of a straight
/// edge it is no nearer than 1.73.
const NEAR: f64 = 1.3;
/// How often steps are closed at most: each time makes a side one step longer.
const PASSES: usize = 8;

/// Triangles that close the notches of what is left of a mesh, each gone along as those beside it are.
///
/// Shapes: corners are points of the world. Valid range: points that the outline passes more than once have no notch, nor has one that is convex where the
/// points are now. A brace across a hole, which has two, closes neither: a bond alone tore there.
pub(super) fn closing(view: &View<'_>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    if triangles.len() > MOST {
        return Vec::new();
    }
    let mut edge = Edge::of(view, triangles);
    let mut notches = edge.notches();
    if notches.is_empty() {
        return Vec::new();
    }
    let corners: Vec<[u32; 3]> = notches.iter().map(|notch| notch.corner).collect();
    let braces = Braces::new(triangles, &corners, view.bonds.ends().iter().map(|ends| ends.map(|end| end.0)));
    let torn = Torn::new(&corners, view.torn);
    notches.retain(|notch| braces.span(notch.corner) || torn.is_cut_off(notch.corner));
    let mut closed = edge.close(notches);
    for _ in 0..PASSES {
        if edge.chords.is_empty() {
            break;
        }
        let mut notches = edge.notches();
        notches.retain(|notch| notch.is_shallow && edge.is_closed_beside(notch.corner));
        let more = edge.close(notches);
        if more.is_empty() {
            break;
        }
        closed.extend(more);
    }
    closed
}

/// Where what is covered goes round a point by more than half.
struct Notch {
    /// The point between those before and after it.
    corner: [u32; 3],
    is_shallow: bool,
}

/// The outline of what is covered, as far as it is closed.
struct Edge<'a> {
    view: &'a View<'a>,
    /// Of the triangles that there were.
    sides: Vec<Side>,
    /// Sides with what is covered at their left, ascending.
    outline: Vec<Ends>,
    /// Points of the outline, ascending, each with where the triangles at it face, by their areas.
    facing: Vec<(u32, [f64; 3])>,
    /// Sides that closed a notch, the lower end first.
    chords: BTreeSet<Ends>,
}

impl<'a> Edge<'a> {
    fn of(view: &'a View<'a>, triangles: &[[u32; 3]]) -> Self {
        let sides = triangles::sides(triangles.iter().copied());
        let mut outline: Vec<Ends> = triangles::alone(&sides).map(|side| side.way).collect();
        outline.sort_unstable();
        let mut facing: Vec<(u32, [f64; 3])> = outline.iter().map(|way| (way[0], [0.0; 3])).collect();
        facing.dedup_by_key(|entry| entry.0);
        let mut edge = Edge { view, sides, outline, facing, chords: BTreeSet::new() };
        for &corners in triangles {
            let area = edge.area(corners);
            for point in corners {
                if let Ok(at) = edge.facing.binary_search_by_key(&point, |entry| entry.0) {
                    edge.facing[at].1 = add(edge.facing[at].1, area);
                }
            }
        }
        edge
    }

    /// Where a point is `[m]`: nowhere if it is not there.
    fn place(&self, point: u32) -> [f64; 3] {
        let (dimensions, at) = (self.view.dimensions, self.view.current);
        let first = dimensions * point as usize;
        if first + dimensions > at.len() {
            return [f64::NAN; 3];
        }
        std::array::from_fn(|axis| if axis < dimensions { at.get(first + axis) } else { 0.0 })
    }

    /// Twice the area of a triangle `[m²]`, along its normal.
    fn area(&self, corners: [u32; 3]) -> [f64; 3] {
        let [a, b, c] = corners.map(|corner| self.place(corner));
        cross3(sub(b, a), sub(c, a))
    }

    /// Those that may be closed, ascending by their points: a triangle across one faces as what is at it does, and its third side is none yet. At the end
    /// of a slit there is none.
    fn notches(&self) -> Vec<Notch> {
        let is_side = |ends: Ends| {
            self.sides.binary_search_by_key(&ends, |side| side.ends).is_ok() || self.chords.contains(&ends)
        };
        let corners = corners(&self.outline);
        let at = |point: u32| corners.binary_search_by_key(&point, |corner| corner[1]).ok().map(|at| corners[at]);
        let long = |a: u32, b: u32| length(sub(self.place(b), self.place(a)));
        let found = corners.iter().filter_map(|&corner| {
            let [p, v, q] = corner;
            if p == q || is_side(lower_first([p, q])) {
                return None;
            }
            let facing = self.facing.binary_search_by_key(&v, |entry| entry.0).ok()?;
            let area = self.area([q, v, p]);
            let (shorter, across) = (long(p, v).min(long(v, q)), long(p, q));
            let depth = length(area) / across / shorter;
            let is_near = |point: u32| long(v, point) < NEAR * shorter;
            let is_end = at(q).is_some_and(|next| is_near(next[2])) || at(p).is_some_and(|before| is_near(before[0]));
            let is_notch = dot(self.facing[facing].1, area) > 0.0 && depth > DEPTHS[0] && !is_end;
            is_notch.then_some(Notch { corner, is_shallow: depth <= DEPTHS[1] && across <= LONGEST * shorter })
        });
        found.collect()
    }

    fn is_closed_beside(&self, [p, v, q]: [u32; 3]) -> bool {
        [[p, v], [v, q]].into_iter().any(|side| self.chords.contains(&lower_first(side)))
    }

    /// Closes notches, of two that share a side the first. Returns the triangles that do.
    fn close(&mut self, notches: Vec<Notch>) -> Vec<[u32; 3]> {
        let mut closed = Vec::new();
        let mut gone = BTreeSet::new();
        for Notch { corner: [p, v, q], .. } in notches {
            if gone.contains(&[p, v]) || gone.contains(&[v, q]) {
                continue;
            }
            gone.extend([[p, v], [v, q]]);
            self.chords.insert(lower_first([p, q]));
            closed.push([q, v, p]);
        }
        self.outline.retain(|way| !gone.contains(way));
        self.outline.extend(closed.iter().map(|&[q, _, p]| [p, q]));
        self.outline.sort_unstable();
        closed
    }
}

/// The points that an outline passes once, each between those before and after it, ascending by the middle ones.
///
/// Shapes: `from` ascends.
fn corners(from: &[Ends]) -> Vec<[u32; 3]> {
    let mut to: Vec<Ends> = from.iter().map(|&[a, b]| [b, a]).collect();
    to.sort_unstable();
    let only = |list: &[Ends], point: u32| {
        let first = list.partition_point(|way| way[0] < point);
        match list[first..] {
            [[a, other], [b, _], ..] if a == point && b != point => Some(other),
            [[a, other]] if a == point => Some(other),
            _ => None,
        }
    };
    from.iter().filter_map(|&[v, _]| Some([only(&to, v)?, v, only(from, v)?])).collect()
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

    /// Whether one that lost its triangles goes across a corner, of a mesh that has others there.
    fn span(&self, corner: [u32; 3]) -> bool {
        let [p, _, q] = corner;
        let is_braced = || corner.iter().any(|point| self.ends.binary_search(point).is_ok());
        self.orphans.binary_search(&lower_first([p, q])).is_ok() && is_braced()
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
        for (angle, before, after) in [
            (7.0, 0.7, 0.25),
            (15.0, 0.7, 0.4),
            (30.0, 0.4, 1e-9),
            (40.0, 0.7, 0.15),
            (50.0, 0.7, 0.4),
            (90.0, 0.4, 1e-9),
        ] {
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
    fn a_slit_stays_open_up_to_its_end() {
        let (places, triangles) = lattice();
        // A stroke along the middle of a row of triangles, from the left side to the middle.
        let is_torn = |[a, b]: &Ends| {
            let [[x, y], [u, v]] = [a, b].map(|end| places[*end as usize]);
            (y < 4.71) != (v < 4.71) && x + (4.71 - y) / (v - y) * (u - x) < 5.83
        };
        for is_braced in [false, true] {
            let (torn, kept): (Vec<Ends>, Vec<Ends>) = bonds(&triangles, is_braced).into_iter().partition(is_torn);
            let has = |[a, b]: Ends| torn.contains(&lower_first([a, b]));
            let whole = triangles.iter().copied().filter(|&[a, b, c]| !(has([a, b]) || has([b, c]) || has([c, a])));
            let closing = closed(&places, &whole.collect::<Vec<_>>(), &kept, &torn);
            let crosses = |corners: &[u32; 3]| {
                let is_above = corners.map(|corner| places[corner as usize][1] > 4.71);
                is_above != [is_above[0]; 3]
            };
            // At its end alone a side goes from one row to the next.
            assert!(closing.iter().filter(|corners| crosses(corners)).count() <= 1, "{closing:?}");
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
