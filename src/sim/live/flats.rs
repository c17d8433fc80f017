//! Edges in one line of what is rigid are one edge: nothing gets to the points between, for what is straight stays so.

use super::body::Edge;
use crate::sim::vector::{cross, dot, sub};

/// Sine of the angle up to which two edges are in line `[1]`.
const IN_LINE: f64 = 1e-9;

/// The edges of a skin without the points that lie within a line. `place` says where a point is in the shape `[m]`, `is_alike` whether two are of one
/// material.
pub(super) fn joined(
    edges: &[Edge],
    place: impl Fn(u32) -> [f64; 2],
    is_alike: impl Fn(u32, u32) -> bool,
) -> Vec<Edge> {
    // Edges by their first ends, and where edges end.
    let mut next: Vec<[u32; 2]> = edges.iter().filter(|edge| edge.is_closed).map(|edge| edge.ends).collect();
    let mut last: Vec<[u32; 2]> = next.iter().map(|&[a, b]| [b, a]).collect();
    let mut open: Vec<u32> = edges.iter().filter(|edge| !edge.is_closed).flat_map(|edge| edge.ends).collect();
    next.sort_unstable();
    last.sort_unstable();
    open.sort_unstable();
    let only = |list: &[[u32; 2]], point: u32| {
        let from = list.partition_point(|ends| ends[0] < point);
        let [one, rest @ ..] = &list[from..] else { return None };
        (one[0] == point && rest.first().is_none_or(|other| other[0] != point)).then_some(one[1])
    };
    let beyond = |point: u32| {
        let (before, after) = (only(&last, point)?, only(&next, point)?);
        let [from, to] = [sub(place(point), place(before)), sub(place(after), place(point))];
        let most = IN_LINE * (dot(from, from) * dot(to, to)).sqrt();
        let is_between = dot(from, to) > 0.0 && cross(from, to).abs() <= most;
        let is_plain = is_alike(before, point) && is_alike(point, after) && open.binary_search(&point).is_err();
        (is_between && is_plain).then_some(after)
    };
    let kept = |edge: &&Edge| !edge.is_closed || beyond(edge.ends[0]).is_none();
    let whole = |edge: &Edge| {
        let [from, mut to] = edge.ends;
        while edge.is_closed
            && let Some(after) = beyond(to)
        {
            to = after;
        }
        Edge { ends: [from, to], ..*edge }
    };
    edges.iter().filter(kept).map(whole).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closed(ends: [u32; 2]) -> Edge {
        Edge { ends, is_closed: true }
    }

    /// A square of four sides of two edges each, and what is left of its edges.
    fn square(is_alike: impl Fn(u32, u32) -> bool) -> Vec<[u32; 2]> {
        let places = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0], [0.0, 1.1]];
        let edges: Vec<Edge> = (0..8).map(|k| closed([k, (k + 1) % 8])).collect();
        joined(&edges, |k| places[k as usize], is_alike).iter().map(|edge| edge.ends).collect()
    }

    #[test]
    fn a_square_has_four_edges() {
        assert_eq!(square(|_, _| true), [[0, 2], [2, 4], [4, 6], [6, 0]]);
        assert_eq!(square(|a, b| a.min(b) != 1), [[0, 1], [1, 2], [2, 4], [4, 6], [6, 0]], "of two materials");
    }

    #[test]
    fn where_something_hangs_on_a_side_its_point_stays() {
        let places = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0], [1.0, -1.0]];
        let mut edges: Vec<Edge> = [[0, 1], [1, 2], [2, 3], [3, 0]].map(closed).to_vec();
        let of = |edges: &[Edge]| joined(edges, |k| places[k as usize], |_, _| true).len();
        assert_eq!(of(&edges), 3);
        edges.push(Edge { ends: [1, 4], is_closed: false });
        assert_eq!(of(&edges), 5);
    }
}
