//! What bodies cover: triangles between points, which go with what bears them.

use super::bond::{PointId, lower_first};
use super::vector::sub;

/// The triangles none of whose corners is gone and along none of whose sides a bond went; `None`: all are left.
///
/// Shapes: `gone` ascends; `cut` has the ends of the bonds that went, in any order.
pub fn borne(
    triangles: &[[PointId; 3]],
    gone: &[PointId],
    cut: impl IntoIterator<Item = [PointId; 2]>,
) -> Option<Vec<[PointId; 3]>> {
    let mut cut: Vec<[PointId; 2]> = cut.into_iter().map(lower_first).collect();
    cut.sort_unstable();
    let is_cut = |a: PointId, b: PointId| cut.binary_search(&lower_first([a, b])).is_ok();
    let is_gone = |corner: &PointId| gone.binary_search(corner).is_ok();
    let is_borne = |corners: &&[PointId; 3]| {
        let [a, b, c] = **corners;
        !(corners.iter().any(is_gone) || is_cut(a, b) || is_cut(b, c) || is_cut(c, a))
    };
    let is_whole = triangles.iter().all(|corners| is_borne(&corners));
    (!is_whole).then(|| triangles.iter().filter(is_borne).copied().collect())
}

/// The numbers of the triangles that have the corners of one before them, in any order, ascending.
pub(crate) fn repeats(triangles: &[[PointId; 3]]) -> Vec<usize> {
    let sorted = |(mut corners, k): ([PointId; 3], u32)| {
        corners.sort_unstable();
        (corners, k)
    };
    let mut list: Vec<([PointId; 3], u32)> = triangles.iter().copied().zip(0..).map(sorted).collect();
    list.sort_unstable();
    let again = |pair: &[([PointId; 3], u32)]| (pair[0].0 == pair[1].0).then_some(pair[1].1 as usize);
    let mut found: Vec<usize> = list.windows(2).filter_map(again).collect();
    found.sort_unstable();
    found
}

/// A list without the entries of these numbers, which ascend.
pub(crate) fn without<T: Copy>(list: &[T], numbers: &[usize]) -> Vec<T> {
    let is_left = |&(k, _): &(usize, &T)| numbers.binary_search(&k).is_err();
    list.iter().enumerate().filter(is_left).map(|(_, entry)| *entry).collect()
}

/// The triangles with their corners anticlockwise, in the plane; `None`: they are.
///
/// Shapes: `place` says where every corner is `[m]`.
pub(crate) fn turned<const D: usize>(
    triangles: &[[PointId; 3]],
    place: impl Fn(PointId) -> [f64; D],
) -> Option<Vec<[PointId; 3]>> {
    let is_clockwise = |corners: &[PointId; 3]| {
        let [a, b, c] = corners.map(&place);
        let (u, v) = (sub(b, a), sub(c, a));
        D == 2 && u[0] * v[1] - u[1] * v[0] < 0.0
    };
    let turn = |corners: &[PointId; 3]| {
        let [a, b, c] = *corners;
        if is_clockwise(corners) { [a, c, b] } else { [a, b, c] }
    };
    triangles.iter().any(is_clockwise).then(|| triangles.iter().map(turn).collect())
}

/// The triangles of folded bodies with the sides that two of them share gone along in opposite directions, so that what is inside out
/// at the start is known as such: of each body the larger area is right. `None`: no body is folded.
///
/// Shapes: `turned`: the triangles if they were turned, else `triangles` hold.
pub(crate) fn aligned<const D: usize>(
    turned: Option<Vec<[PointId; 3]>>,
    triangles: &[[PointId; 3]],
    place: impl Fn(PointId) -> [f64; D],
) -> Option<Vec<[PointId; 3]>> {
    let list = turned.as_deref().unwrap_or(triangles);
    let mut sides: Vec<([PointId; 2], bool, u32)> = Vec::with_capacity(3 * list.len());
    for (&[a, b, c], k) in list.iter().zip(0..) {
        sides.extend([(a, b), (b, c), (c, a)].map(|(from, to)| ([from.min(to), from.max(to)], from < to, k)));
    }
    sides.sort_unstable();
    // Sides that two triangles share, and whether these agree.
    let shared: Vec<([u32; 2], bool)> = sides
        .chunk_by(|a, b| a.0 == b.0)
        .filter_map(|group| if let [a, b] = group { Some(([a.2, b.2], a.1 != b.1)) } else { None })
        .collect();
    if D != 2 || shared.iter().all(|side| side.1) {
        return turned;
    }
    let mut beside: Vec<(u32, u32, bool)> =
        shared.iter().flat_map(|&([a, b], agrees)| [(a, b, agrees), (b, a, agrees)]).collect();
    beside.sort_unstable();
    let mut list = list.to_vec();
    let size = |&[a, b, c]: &[PointId; 3]| {
        let [a, b, c] = [a, b, c].map(&place);
        let (u, v) = (sub(b, a), sub(c, a));
        u[0] * v[1] - u[1] * v[0]
    };
    let mut is_flipped: Vec<Option<bool>> = vec![None; list.len()];
    for seed in 0..list.len() as u32 {
        if is_flipped[seed as usize].is_some() {
            continue;
        }
        is_flipped[seed as usize] = Some(false);
        let mut body = vec![(seed, false)];
        let mut done = 0;
        while let Some(&(at, flip)) = body.get(done) {
            done += 1;
            let first = beside.partition_point(|entry| entry.0 < at);
            for &(_, other, agrees) in beside[first..].iter().take_while(|entry| entry.0 == at) {
                if is_flipped[other as usize].is_none() {
                    is_flipped[other as usize] = Some(flip == agrees);
                    body.push((other, flip == agrees));
                }
            }
        }
        let total: f64 = body.iter().map(|&(k, flip)| if flip { -1.0 } else { 1.0 } * size(&list[k as usize])).sum();
        for (k, flip) in body {
            if flip == (total >= 0.0) {
                list[k as usize].swap(1, 2);
            }
        }
    }
    Some(list)
}

/// Whether a place is within a triangle in the plane, its sides apart.
pub(crate) fn holds<const D: usize>([a, b, c]: [[f64; D]; 3], x: [f64; D]) -> bool {
    let turn = |from: [f64; D], to: [f64; D]| {
        let (u, v) = (sub(to, from), sub(x, from));
        u[0] * v[1] - u[1] * v[0]
    };
    let turns = [turn(a, b), turn(b, c), turn(c, a)];
    turns.iter().all(|&turn| turn > 0.0) || turns.iter().all(|&turn| turn < 0.0)
}

/// A side of a triangle.
///
/// Ordered by its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    /// The lower one first.
    pub(crate) ends: [u32; 2],
    /// From which to which, as the corners of its triangle follow each other: anticlockwise ones have their inside on its left.
    pub(crate) way: [u32; 2],
}

/// All sides of triangles, one for each triangle that has it, ascending.
pub(crate) fn sides(triangles: impl IntoIterator<Item = [u32; 3]>) -> Vec<Side> {
    let of = |[a, b, c]: [u32; 3]| {
        [[a, b], [b, c], [c, a]].map(|way: [u32; 2]| Side { ends: [way[0].min(way[1]), way[0].max(way[1])], way })
    };
    let mut list: Vec<Side> = triangles.into_iter().flat_map(of).collect();
    list.sort_unstable();
    list
}

/// The sides that one triangle has alone, of all of them, in their order.
pub(crate) fn alone(sides: &[Side]) -> impl Iterator<Item = Side> {
    sides.chunk_by(|a, b| a.ends == b.ends).filter(|same| same.len() == 1).map(|same| same[0])
}

/// The sides that one of some triangles has alone, ascending: where what they cover ends.
///
/// Valid range: any corners, turned either way. A side of three triangles is none of one alone, nor are those of a triangle that is said
/// twice; of a triangle with a corner twice, a, a and b, the side from a to a is alone.
pub(crate) fn outer_sides(triangles: impl IntoIterator<Item = [u32; 3]>) -> Vec<Side> {
    alone(&sides(triangles)).collect()
}

/// The far corners of every two triangles that share a side, the lower one first, ascending.
pub(crate) fn far_corners(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let with_far =
        |&[a, b, c]: &[u32; 3]| [(lower_first([a, b]), c), (lower_first([b, c]), a), (lower_first([c, a]), b)];
    let mut sides: Vec<([u32; 2], u32)> = triangles.iter().flat_map(with_far).collect();
    sides.sort_unstable();
    let pairs = sides.array_windows().filter(|[p, q]| p.0 == q.0);
    let mut far: Vec<[u32; 2]> = pairs.map(|[p, q]| lower_first([p.1, q.1])).collect();
    far.sort_unstable();
    far
}

/// The edges of the skins of bodies.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Edges {
    /// Sides that one triangle has alone, its inside on their right.
    pub(crate) closed: Vec<[u32; 2]>,
    /// Bonds at points of no triangle.
    pub(crate) open: Vec<[u32; 2]>,
}

/// The skins of what these triangles cover and these bonds hold, by their ends. Both lists ascend by the lower end, then by the other.
pub(crate) fn skin(triangles: &[[u32; 3]], bonds: impl Iterator<Item = [u32; 2]>) -> Edges {
    let mut covered: Vec<u32> = triangles.iter().flatten().copied().collect();
    covered.sort_unstable();
    covered.dedup();
    let is_bare = |ends: &[u32; 2]| ends.iter().any(|end| covered.binary_search(end).is_err());
    let mut open: Vec<[u32; 2]> = bonds.map(lower_first).filter(is_bare).collect();
    open.sort_unstable();
    open.dedup();
    let closed = outer_sides(triangles.iter().copied()).into_iter().map(|Side { way: [from, to], .. }| [to, from]);
    Edges { closed: closed.collect(), open }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_clockwise_is_turned_in_the_plane() {
        let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let of = |list: [u32; 3]| vec![list.map(PointId)];
        let found = |list: [u32; 3]| turned(&of(list), |point| places[point.index()]);
        assert_eq!((found([0, 1, 2]), found([1, 2, 0])), (None, None));
        assert_eq!(found([0, 2, 1]), Some(of([0, 1, 2])));
        assert_eq!(
            turned(&of([0, 2, 1]), |point| {
                let [x, y] = places[point.index()];
                [x, y, 0.0]
            }),
            None
        );
    }

    #[test]
    fn triangles_that_repeat_others_are_found_whatever_their_order() {
        let list = [[0, 1, 2], [3, 2, 1], [2, 1, 0], [1, 2, 3], [1, 2, 0], [4, 5, 6]].map(|c: [u32; 3]| c.map(PointId));
        assert_eq!(repeats(&list), [2, 3, 4]);
        assert_eq!(without(&list, &repeats(&list)), [list[0], list[1], list[5]]);
        assert!(repeats(&list[..2]).is_empty() && repeats(&[]).is_empty());
    }

    #[test]
    fn a_triangle_goes_with_a_corner_and_with_a_bond_along_a_side() {
        let of = |list: &[[u32; 3]]| -> Vec<[PointId; 3]> { list.iter().map(|corners| corners.map(PointId)).collect() };
        let all = of(&[[0, 1, 2], [0, 2, 3], [4, 5, 6], [7, 8, 9]]);
        let left = |gone: &[u32], cut: &[[u32; 2]]| {
            let gone: Vec<PointId> = gone.iter().map(|&point| PointId(point)).collect();
            borne(&all, &gone, cut.iter().map(|ends| ends.map(PointId)))
        };
        assert_eq!(left(&[], &[]), None);
        assert_eq!(left(&[], &[[2, 4], [0, 7]]), None, "no side");
        assert_eq!(left(&[], &[[2, 0]]).as_deref(), Some(&all[2..]), "both that share it");
        assert_eq!(left(&[1, 9], &[[6, 4]]).as_deref(), Some(&all[1..2]));
    }

    #[test]
    fn sides_of_one_triangle_alone_ascend_by_their_ends_and_go_as_it_does() {
        let found = |list: &[[u32; 3]]| -> Vec<[u32; 2]> {
            let sides = outer_sides(list.iter().copied());
            assert!(sides.is_sorted() && sides.iter().all(|side| side.ends.is_sorted()));
            sides.into_iter().map(|side| side.way).collect()
        };
        // A square; the same with its second triangle turned.
        assert_eq!(found(&[[0, 2, 3], [0, 1, 2]]), [[0, 1], [3, 0], [1, 2], [2, 3]]);
        assert_eq!(found(&[[0, 3, 2], [0, 1, 2]]), [[0, 1], [0, 3], [1, 2], [3, 2]]);
        assert!(found(&[]).is_empty() && found(&[[0, 1, 2], [2, 1, 0]]).is_empty(), "said twice");
        assert_eq!(found(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]).len(), 6, "a side of three is of none alone");
        assert_eq!(found(&[[5, 5, 7]]), [[5, 5]], "a corner twice");
    }

    #[test]
    fn skins_are_sides_of_one_triangle_and_bonds_at_bare_points() {
        // A square of two triangles with a rope at a corner; both are said twice by their bonds.
        let bonds = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 0], [4, 3], [3, 4], [4, 5]];
        let edges = skin(&[[0, 1, 2], [0, 2, 3]], bonds.into_iter());
        assert_eq!(edges.closed, [[1, 0], [0, 3], [2, 1], [3, 2]]);
        assert_eq!(edges.open, [[3, 4], [4, 5]]);
        assert_eq!(skin(&[], std::iter::empty()), Edges::default());
    }
}
