//! The angles of a body: what `bending` of its material makes of it, along its chains of bonds and around what it covers, and its joints.

use crate::body::{Body, Joint};
use crate::sim::triangles::{self, Edges};
use crate::sim::vector::{length, sub};

/// An angle of a body, counted within it, or of a running world by its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bend {
    /// At the second point, from the arm to the first to the arm to the third, anticlockwise.
    pub(crate) points: [u32; 3],
    /// `[N m]`
    pub(crate) stiffness: f64,
    /// Where its stops are, if it has any `[rad]`.
    pub(crate) range: Option<[f64; 2]>,
}

/// The joints of a body: angles with stops, free between them.
pub(super) fn joints(body: &Body) -> impl Iterator<Item = Bend> {
    body.joints.iter().map(|&Joint { points, range }| Bend { points, stiffness: 0.0, range: Some(range) })
}

/// The angles of a body that resists bending by `bending` = E I `[N m^2]`: see [`bends_along`].
pub(super) fn bends(body: &Body, bending: f64) -> Vec<Bend> {
    if bending == 0.0 {
        return Vec::new();
    }
    let edges = triangles::skin(&body.triangles, body.links.iter().map(|link| [link.a, link.b]));
    bends_along(edges, |point| body.positions[point as usize], bending)
}

/// The angles along the skins and chains of one body that resists bending by `bending` = E I `[N m^2]`.
///
/// Model: a rod that is bent to the curvature c over a length l has the energy E I c^2 l/2, and an angle between two pieces of it turns by
/// c l: its stiffness is E I/l, with l the mean of both pieces. Where three pieces or more meet, neighbours all around share it; where a
/// chain begins at what has an area, it is held against both sides of the skin there.
/// Skins are the sides that one triangle has alone; chains are the bonds of points that are no corner of a triangle. Where a body has
/// chains, they bend and its skin does not: what it covers holds that.
///
/// Shapes: `place` says where every end of an edge is `[m]`; angles ascend by their middle points.
/// Valid range: arms without a length have no angle.
pub(crate) fn bends_along(edges: Edges, place: impl Fn(u32) -> [f64; 3], bending: f64) -> Vec<Bend> {
    let at = arms(edges);
    let has_chains = at.iter().any(|arm| !arm.is_skin);
    let distance = |a: u32, b: u32| length(sub(place(a), place(b)));
    let mut list = Vec::new();
    for own in at.chunk_by(|a, b| a.at == b.at) {
        let middle = own[0].at;
        let (skin, chain): (Vec<Arm>, Vec<Arm>) = own.iter().partition(|arm| arm.is_skin);
        let pairs = match (&skin[..], &chain[..]) {
            ([_, _], []) if has_chains => Vec::new(),
            ([a, b], []) | ([], [a, b]) => vec![[a.to, b.to]],
            ([a, b], chain) => chain.iter().flat_map(|arm| [[a.to, arm.to], [arm.to, b.to]]).collect(),
            ([], chain) if chain.len() > 2 => around(chain, middle, &place),
            _ => Vec::new(),
        };
        let share = share_of(pairs.len());
        for [from, to] in pairs {
            let arms = [distance(from, middle), distance(middle, to)];
            if arms.iter().all(|&arm| arm > 0.0) {
                let stiffness = stiffness_of(bending, share, arms);
                list.push(Bend { points: [from, middle, to], stiffness, range: None });
            }
        }
    }
    list
}

/// The share of E I that each of so many angles at one point has `[1]`: one has all of it, of several each has half, for each arm is
/// one of two of them.
pub(crate) fn share_of(angles_there: usize) -> f64 {
    if angles_there > 1 { 0.5 } else { 1.0 }
}

/// The stiffness `[N m]` of an angle that has a share of `bending` = E I `[N m^2]` between arms of these lengths `[m]`.
pub(crate) fn stiffness_of(bending: f64, share: f64, [p, q]: [f64; 2]) -> f64 {
    share * bending / (0.5 * (p + q))
}

/// What leads from a point along a skin or a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Arm {
    at: u32,
    to: u32,
    is_skin: bool,
}

/// All arms, by the points that they begin at.
fn arms(Edges { closed, open }: Edges) -> Vec<Arm> {
    let edges = closed.into_iter().map(|ends| (ends, true)).chain(open.into_iter().map(|ends| (ends, false)));
    let mut list: Vec<Arm> =
        edges.flat_map(|([a, b], is_skin)| [Arm { at: a, to: b, is_skin }, Arm { at: b, to: a, is_skin }]).collect();
    list.sort_unstable();
    list
}

/// The pairs of neighbours around a point at which chains meet.
fn around(chain: &[Arm], middle: u32, place: impl Fn(u32) -> [f64; 3]) -> Vec<[u32; 2]> {
    let turn = |arm: &Arm| {
        let d = sub(place(arm.to), place(middle));
        libm::atan2(d[1], d[0])
    };
    let mut ends: Vec<(f64, u32)> = chain.iter().map(|arm| (turn(arm), arm.to)).collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    (0..ends.len()).map(|n| [ends[n].1, ends[(n + 1) % ends.len()].1]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Link;

    fn body(positions: &[[f64; 2]], links: &[[u32; 2]], triangles: &[[u32; 3]]) -> Body {
        Body {
            positions: positions.iter().map(|&[x, y]| [x, y, 0.0]).collect(),
            links: links.iter().map(|&[a, b]| Link { a, b, rest_length: 1.0, share: 1.0 }).collect(),
            triangles: triangles.to_vec(),
            ..Body::default()
        }
    }

    #[test]
    fn a_rope_bends_between_its_ends_and_a_finer_one_alike() {
        let rope = body(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [4.0, 0.0]], &[[0, 1], [1, 2], [2, 3]], &[]);
        let bend = |points, stiffness| Bend { points, stiffness, range: None };
        let expected = [bend([0, 1, 2], 6.0), bend([1, 2, 3], 4.0)];
        assert_eq!(bends(&rope, 6.0), expected);
        assert!(bends(&rope, 0.0).is_empty());
    }

    #[test]
    fn a_skin_bends_all_around_and_where_chains_begin_it_holds_them_alone() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 1.0], [3.0, 1.0]];
        let links = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [2, 4], [4, 5]];
        let found = |links: &[[u32; 2]], points: usize| -> (Vec<u32>, f64) {
            let found = bends(&body(&square[..points], links, &[[0, 1, 2], [0, 2, 3]]), 1.0);
            (found.iter().map(|bend| bend.points[1]).collect(), found.iter().map(|bend| bend.stiffness).sum())
        };
        assert_eq!(found(&links[..5], 4), (vec![0, 1, 2, 3], 4.0));
        assert_eq!(found(&links, 6), (vec![2, 2, 4], 2.0));
    }

    #[test]
    fn chains_that_meet_hold_each_other() {
        let star = body(&[[0.0, 0.0], [1.0, 0.0], [-1.0, 1.0], [-1.0, -1.0]], &[[0, 1], [0, 2], [0, 3]], &[]);
        let mut pairs: Vec<[u32; 3]> = bends(&star, 1.0).iter().map(|bend| bend.points).collect();
        pairs.sort_unstable();
        assert_eq!(pairs, [[1, 0, 2], [2, 0, 3], [3, 0, 1]]);
        // Arms of 1 m and 2^(1/2) m: each of the three has half of E I.
        let other = 2.0_f64.sqrt();
        let expected = 0.5 / (0.5 * (1.0 + other)) * 2.0 + 0.5 / other;
        let found: f64 = bends(&star, 1.0).iter().map(|bend| bend.stiffness).sum();
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
}
