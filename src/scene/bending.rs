//! The angles of a body: what `bending` of its material makes of it, along its chains of bonds and around what it covers, and its joints.

use crate::body::{Body, Joint};
use crate::sim::triangles;
use crate::sim::vector::{length, sub};

/// An angle of a body, counted within it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bend {
    /// At the second point, from the arm to the first to the arm to the third, anticlockwise.
    pub(super) points: [u32; 3],
    /// `[N m]`
    pub(super) stiffness: f64,
    /// Where its stops are, if it has any `[rad]`.
    pub(super) range: Option<[f64; 2]>,
}

/// The joints of a body: angles with stops, free between them.
pub(super) fn joints(body: &Body) -> impl Iterator<Item = Bend> {
    body.joints.iter().map(|&Joint { points, range }| Bend { points, stiffness: 0.0, range: Some(range) })
}

/// The angles of a body that resists bending by `bending` = E I `[N m^2]`.
///
/// Model: a rod that is bent to the curvature c over a length l has the energy E I c^2 l/2, and an angle between two pieces of it turns by
/// c l: its stiffness is E I/l, with l the mean of both pieces. Where three pieces or more meet, neighbours all around share it; where a
/// chain begins at what has an area, it is held against both sides of the skin there.
/// Skins are the sides that one triangle has alone; chains are the bonds of points that are no corner of a triangle. Where a body has
/// chains, they bend and its skin does not: what it covers holds that.
pub(super) fn bends(body: &Body, bending: f64) -> Vec<Bend> {
    if bending == 0.0 {
        return Vec::new();
    }
    let at = arms(body);
    let has_chains = at.iter().any(|arm| !arm.is_skin);
    let place = |point: u32| body.positions[point as usize];
    let distance = |a: u32, b: u32| length(sub(place(a), place(b)));
    let mut list = Vec::new();
    for middle in 0..body.positions.len() as u32 {
        let start = at.partition_point(|arm| arm.at < middle);
        let own: Vec<Arm> = at[start..].iter().take_while(|arm| arm.at == middle).copied().collect();
        let (skin, chain): (Vec<Arm>, Vec<Arm>) = own.iter().partition(|arm| arm.is_skin);
        let pairs = match (&skin[..], &chain[..]) {
            ([_, _], []) if has_chains => Vec::new(),
            ([a, b], []) | ([], [a, b]) => vec![([a.to, b.to], 1.0)],
            ([a, b], chain) => chain.iter().flat_map(|arm| [([a.to, arm.to], 0.5), ([arm.to, b.to], 0.5)]).collect(),
            ([], chain) if chain.len() > 2 => around(chain, middle, &body.positions),
            _ => Vec::new(),
        };
        for ([from, to], share) in pairs {
            let mean = 0.5 * (distance(from, middle) + distance(middle, to));
            if mean > 0.0 && distance(from, middle) > 0.0 && distance(middle, to) > 0.0 {
                list.push(Bend { points: [from, middle, to], stiffness: share * bending / mean, range: None });
            }
        }
    }
    list
}

/// What leads from a point along a skin or a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Arm {
    at: u32,
    to: u32,
    is_skin: bool,
}

/// All arms, by the points that they begin at.
fn arms(body: &Body) -> Vec<Arm> {
    let skin = triangles::skin(&body.triangles, body.links.iter().map(|link| [link.a, link.b]));
    let closed = skin.closed.into_iter().map(|ends| (ends, true));
    let edges = closed.chain(skin.open.into_iter().map(|ends| (ends, false)));
    let mut list: Vec<Arm> =
        edges.flat_map(|([a, b], is_skin)| [Arm { at: a, to: b, is_skin }, Arm { at: b, to: a, is_skin }]).collect();
    list.sort_unstable();
    list
}

/// The pairs of neighbours around a point at which chains meet, each with its share.
fn around(chain: &[Arm], middle: u32, positions: &[[f64; 3]]) -> Vec<([u32; 2], f64)> {
    let turn = |arm: &Arm| {
        let d = sub(positions[arm.to as usize], positions[middle as usize]);
        libm::atan2(d[1], d[0])
    };
    let mut ends: Vec<(f64, u32)> = chain.iter().map(|arm| (turn(arm), arm.to)).collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    (0..ends.len()).map(|n| ([ends[n].1, ends[(n + 1) % ends.len()].1], 0.5)).collect()
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
    }
}
