//! The order in which unknowns are eliminated: least degree first, so that a factor stays sparse.

use std::collections::BTreeSet;

/// An order of elimination of the unknowns 0..count: the unknown with the fewest neighbours goes first, ties to the one
/// that was left alone for longest, at the start to the lowest index.
///
/// A chain is eliminated from both its ends in turn, a tree from all its leaves, where nothing fills in; a ring at every
/// other unknown. What is eliminated next seldom waits for what was eliminated last. Neighbours of an eliminated
/// unknown become neighbours of each other.
/// Shapes: `pairs` holds unknowns that share an equation, in any order, repeats allowed.
/// `waits_for[i]` lists unknowns that must go before i: the multipliers of constraints come after the points that they
/// hold, for their own diagonal is zero. It may be empty.
/// Source: W. F. Tinney and J. W. Walker, Proc. IEEE 55, 1801 (1967), scheme 2.
pub(crate) fn order(count: usize, pairs: &[[u32; 2]], waits_for: &[Vec<u32>]) -> Vec<u32> {
    let mut neighbours = adjacency(count, pairs);
    let mut waiting: Vec<usize> = (0..count).map(|i| waits_for.get(i).map_or(0, Vec::len)).collect();
    let mut frees: Vec<Vec<u32>> = vec![Vec::new(); count];
    for (i, list) in waits_for.iter().enumerate() {
        for &before in list {
            frees[before as usize].push(i as u32);
        }
    }
    // When an unknown was last touched, counted in changes.
    let mut since: Vec<usize> = (0..count).collect();
    let mut changes = count;
    let mut ready: BTreeSet<(usize, usize, u32)> =
        (0..count).filter(|&i| waiting[i] == 0).map(|i| (neighbours[i].len(), i, i as u32)).collect();
    let mut result = Vec::with_capacity(count);
    while let Some((_, _, next)) = ready.pop_first() {
        let i = next as usize;
        let around = std::mem::take(&mut neighbours[i]);
        for &j in &around {
            let was = neighbours[j as usize].len();
            let merged = join(&neighbours[j as usize], &around, j, next);
            ready.remove(&(was, since[j as usize], j));
            since[j as usize] = changes;
            changes += 1;
            if waiting[j as usize] == 0 {
                ready.insert((merged.len(), since[j as usize], j));
            }
            neighbours[j as usize] = merged;
        }
        for &j in &frees[i] {
            waiting[j as usize] -= 1;
            if waiting[j as usize] == 0 {
                ready.insert((neighbours[j as usize].len(), since[j as usize], j));
            }
        }
        result.push(next);
    }
    result
}

fn adjacency(count: usize, pairs: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut lists: Vec<Vec<u32>> = vec![Vec::new(); count];
    for &[a, b] in pairs {
        if a != b {
            lists[a as usize].push(b);
            lists[b as usize].push(a);
        }
    }
    for list in &mut lists {
        list.sort_unstable();
        list.dedup();
    }
    lists
}

/// The union of two ascending lists without two of their members.
fn join(one: &[u32], other: &[u32], but: u32, and: u32) -> Vec<u32> {
    let mut result = Vec::with_capacity(one.len() + other.len());
    let (mut i, mut j) = (0, 0);
    while i < one.len() || j < other.len() {
        let next = match (one.get(i), other.get(j)) {
            (Some(&a), Some(&b)) => a.min(b),
            (Some(&a), None) => a,
            (None, Some(&b)) => b,
            (None, None) => break,
        };
        i += usize::from(one.get(i) == Some(&next));
        j += usize::from(other.get(j) == Some(&next));
        if next != but && next != and {
            result.push(next);
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_is_eliminated_from_both_ends() {
        let pairs: Vec<[u32; 2]> = (0..9).map(|i| [i, i + 1]).collect();
        assert_eq!(order(10, &pairs, &[]), [0, 9, 1, 8, 2, 7, 3, 6, 4, 5]);
    }

    #[test]
    fn a_star_keeps_its_middle_for_last() {
        let pairs: Vec<[u32; 2]> = (1..8).map(|i| [0, i]).collect();
        let found = order(8, &pairs, &[]);
        assert!(found.iter().position(|&i| i == 0).is_some_and(|at| at >= 6), "{found:?}");
    }

    #[test]
    fn a_multiplier_waits_for_its_points() {
        let found = order(3, &[[0, 2], [1, 2]], &[vec![], vec![], vec![0, 1]]);
        assert_eq!(found, [0, 1, 2]);
    }
}
