//! Bodies whose bonds hold every point in its place, whatever else happens: triangles, side to side.

/// Whether the bonds `ends` among so many points, all of a length that is kept, make one piece in the plane: every bond is
/// the side of a triangle of bonds, and from each triangle every other can be reached across sides.
///
/// That is enough, but not all there is: pieces without such triangles are not found.
pub(crate) fn is_one_piece(points: usize, ends: &[[u32; 2]]) -> bool {
    let neighbours = Neighbours::new(points, ends);
    let mut root: Vec<u32> = (0..ends.len() as u32).collect();
    for (bond, &[a, b]) in ends.iter().enumerate() {
        neighbours.shared(a, b, |to_a, to_b| {
            join(&mut root, bond as u32, to_a);
            join(&mut root, bond as u32, to_b);
        });
    }
    let first = if ends.is_empty() { return false } else { find(&mut root, 0) };
    let is_held = |point: usize| !neighbours.of(point as u32).is_empty();
    (0..points).all(is_held) && (0..ends.len() as u32).all(|bond| find(&mut root, bond) == first)
}

/// The other ends of the bonds of every point, ascending, and those bonds.
struct Neighbours {
    starts: Vec<u32>,
    list: Vec<(u32, u32)>,
}

impl Neighbours {
    fn new(points: usize, ends: &[[u32; 2]]) -> Self {
        let mut starts = vec![0_u32; points + 1];
        ends.iter().flatten().for_each(|&end| starts[end as usize + 1] += 1);
        for i in 0..points {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut list = vec![(0, 0); 2 * ends.len()];
        for (bond, &[a, b]) in ends.iter().enumerate() {
            for (end, other) in [(a, b), (b, a)] {
                list[next[end as usize] as usize] = (other, bond as u32);
                next[end as usize] += 1;
            }
        }
        for i in 0..points {
            list[starts[i] as usize..starts[i + 1] as usize].sort_unstable();
        }
        Neighbours { starts, list }
    }

    fn of(&self, point: u32) -> &[(u32, u32)] {
        &self.list[self.starts[point as usize] as usize..self.starts[point as usize + 1] as usize]
    }

    /// Calls `visit` with the bonds from `a` and from `b` to each neighbour that both have.
    fn shared(&self, a: u32, b: u32, mut visit: impl FnMut(u32, u32)) {
        let (mut left, mut right) = (self.of(a), self.of(b));
        while let (Some(&(p, to_a)), Some(&(q, to_b))) = (left.first(), right.first()) {
            if p == q {
                visit(to_a, to_b);
            }
            if p <= q {
                left = &left[1..];
            }
            if q <= p {
                right = &right[1..];
            }
        }
    }
}

fn find(root: &mut [u32], mut bond: u32) -> u32 {
    while root[bond as usize] != bond {
        root[bond as usize] = root[root[bond as usize] as usize];
        bond = root[bond as usize];
    }
    bond
}

fn join(root: &mut [u32], a: u32, b: u32) {
    let (a, b) = (find(root, a), find(root, b));
    root[a.max(b) as usize] = a.min(b);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_side_to_side_are_one_piece() {
        assert!(is_one_piece(3, &[[0, 1], [1, 2], [2, 0]]));
        assert!(is_one_piece(4, &[[0, 1], [1, 2], [2, 0], [3, 1], [2, 3]]));
    }

    #[test]
    fn hinges_tails_frames_and_loose_points_are_not() {
        let two = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [4, 2]];
        assert!(!is_one_piece(5, &two), "two triangles on a hinge");
        assert!(!is_one_piece(4, &[[0, 1], [1, 2], [2, 0], [2, 3]]), "a tail");
        assert!(!is_one_piece(4, &[[0, 1], [1, 2], [2, 3], [3, 0]]), "a frame that folds");
        assert!(!is_one_piece(4, &[[0, 1], [1, 2], [2, 0]]), "a point that nothing holds");
        assert!(!is_one_piece(2, &[]));
    }

    #[test]
    fn bonds_that_repeat_each_other_hold_no_better() {
        assert!(!is_one_piece(3, &[[0, 1], [0, 1], [1, 2]]));
        assert!(is_one_piece(3, &[[0, 1], [1, 0], [1, 2], [2, 0]]));
    }
}
