//! The order in which unknowns are eliminated: least degree first, so that a factor stays sparse.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

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
    let mut queue = Queue::new(&neighbours, waits_for);
    let mut merged = Vec::new();
    while count - queue.result.len() > DENSE
        && let Some(next) = queue.pop()
    {
        let around = std::mem::take(&mut neighbours[next as usize]);
        for &j in &around {
            let list = &mut neighbours[j as usize];
            join(list, &around, [j, next], &mut merged);
            std::mem::swap(list, &mut merged);
            queue.touch(j, list.len());
        }
        queue.free(next, |j| neighbours[j as usize].len());
    }
    // Rows get shorter as there are fewer.
    let mut left = count - queue.result.len();
    while left > 0 {
        let end = if left > 64 { left / 2 } else { 0 };
        eliminate_dense(&mut neighbours, &mut queue, end);
        let before = std::mem::replace(&mut left, count - queue.result.len());
        if left == before {
            break;
        }
    }
    queue.result
}

/// What a factorisation is analysed by, of unknowns of which none waits for others.
pub(crate) struct Pattern {
    /// The unknowns in their order of elimination, and the place of each in it.
    pub(crate) order: Vec<u32>,
    pub(crate) place: Vec<u32>,
    /// For each place those before it that it shares an equation with, ascending, each once.
    pub(crate) lower: Vec<Vec<u32>>,
}

/// The pattern of so many unknowns; `pairs` as for [`order`].
pub(crate) fn pattern(count: usize, pairs: &[[u32; 2]]) -> Pattern {
    let order = order(count, pairs, &[]);
    let mut place = vec![0_u32; count];
    order.iter().zip(0..).for_each(|(&unknown, at)| place[unknown as usize] = at);
    let mut lower: Vec<Vec<u32>> = vec![Vec::new(); count];
    for [i, j] in pairs {
        let (k, l) = (place[*i as usize], place[*j as usize]);
        lower[k.max(l) as usize].push(k.min(l));
    }
    for columns in &mut lower {
        columns.sort_unstable();
        columns.dedup();
    }
    Pattern { order, place, lower }
}

/// Of so many unknowns and fewer, neighbours are bits of a row each.
const DENSE: usize = 4096;

/// Eliminates unknowns until so many are left: what is near the end has many neighbours, which are joined 64 at a time.
fn eliminate_dense(neighbours: &mut [Vec<u32>], queue: &mut Queue, end: usize) {
    let left: Vec<u32> = (0..neighbours.len() as u32).filter(|&i| !queue.is_gone(i)).collect();
    let mut place = vec![0; neighbours.len()];
    left.iter().zip(0..).for_each(|(&i, at)| place[i as usize] = at);
    let words = left.len().div_ceil(64);
    let mut rows = vec![0_u64; words * left.len()];
    for (at, &i) in left.iter().enumerate() {
        for &j in &neighbours[i as usize] {
            let bit: usize = place[j as usize];
            rows[at * words + bit / 64] |= 1 << (bit % 64);
        }
    }
    let degree = |row: &[u64]| row.iter().map(|word| word.count_ones() as usize).sum::<usize>();
    let last = neighbours.len() - end;
    while queue.result.len() < last
        && let Some(next) = queue.pop()
    {
        let at = place[next as usize];
        let own = rows[at * words..(at + 1) * words].to_vec();
        for bit in bits(&own) {
            let row = &mut rows[bit * words..(bit + 1) * words];
            row.iter_mut().zip(&own).for_each(|(to, from)| *to |= from);
            row[at / 64] &= !(1 << (at % 64));
            row[bit / 64] &= !(1 << (bit % 64));
            queue.touch(left[bit], degree(row));
        }
        queue.free(next, |j| degree(&rows[place[j as usize] * words..(place[j as usize] + 1) * words]));
    }
    for (&i, row) in left.iter().zip(rows.chunks(words.max(1))).filter(|(i, _)| !queue.is_gone(**i)) {
        neighbours[i as usize] = bits(row).map(|bit| left[bit]).collect();
    }
}

/// The bits of a row that are set, ascending.
fn bits(row: &[u64]) -> impl Iterator<Item = usize> + '_ {
    row.iter().enumerate().flat_map(|(word, &bits)| {
        let next = move |left: &u64| (left & (left - 1) != 0).then(|| left & (left - 1));
        std::iter::successors((bits != 0).then_some(bits), next)
            .map(move |left| 64 * word + left.trailing_zeros() as usize)
    })
}

/// The unknowns that can go, the next one first.
struct Queue {
    /// By degree, when they were last touched, and index. What was touched since is passed over: it came again.
    ready: BinaryHeap<Reverse<(usize, usize, u32)>>,
    /// When an unknown was last touched, counted in changes; of what is gone the end of counting.
    since: Vec<usize>,
    changes: usize,
    /// How many others each waits for, and who waits for it.
    waiting: Vec<usize>,
    frees: Vec<Vec<u32>>,
    result: Vec<u32>,
}

impl Queue {
    fn new(neighbours: &[Vec<u32>], waits_for: &[Vec<u32>]) -> Self {
        let count = neighbours.len();
        let waiting: Vec<usize> = (0..count).map(|i| waits_for.get(i).map_or(0, Vec::len)).collect();
        let mut frees: Vec<Vec<u32>> = vec![Vec::new(); count];
        for (i, list) in waits_for.iter().enumerate() {
            for &before in list {
                frees[before as usize].push(i as u32);
            }
        }
        let can_go = (0..count).filter(|&i| waiting[i] == 0);
        let ready = can_go.map(|i| Reverse((neighbours[i].len(), i, i as u32))).collect();
        Queue { ready, since: (0..count).collect(), changes: count, waiting, frees, result: Vec::with_capacity(count) }
    }

    fn is_gone(&self, i: u32) -> bool {
        self.since[i as usize] == usize::MAX
    }

    fn pop(&mut self) -> Option<u32> {
        while let Some(Reverse((_, touched, next))) = self.ready.pop() {
            if self.since[next as usize] == touched {
                self.since[next as usize] = usize::MAX;
                self.result.push(next);
                return Some(next);
            }
        }
        None
    }

    /// An unknown has other neighbours, so many.
    fn touch(&mut self, j: u32, degree: usize) {
        let at = j as usize;
        self.since[at] = self.changes;
        self.changes += 1;
        if self.waiting[at] == 0 {
            self.ready.push(Reverse((degree, self.since[at], j)));
        }
    }

    /// What waited for an unknown that is gone waits for one less.
    fn free(&mut self, gone: u32, degree: impl Fn(u32) -> usize) {
        for j in std::mem::take(&mut self.frees[gone as usize]) {
            let at = j as usize;
            self.waiting[at] -= 1;
            if self.waiting[at] == 0 {
                self.ready.push(Reverse((degree(j), self.since[at], j)));
            }
        }
    }
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
fn join(one: &[u32], other: &[u32], but: [u32; 2], result: &mut Vec<u32>) {
    result.clear();
    result.reserve(one.len() + other.len());
    let (mut i, mut j) = (0, 0);
    while i < one.len() && j < other.len() {
        let (a, b) = (one[i], other[j]);
        let next = a.min(b);
        i += usize::from(a == next);
        j += usize::from(b == next);
        if !but.contains(&next) {
            result.push(next);
        }
    }
    result.extend(one[i..].iter().chain(&other[j..]).filter(|next| !but.contains(next)));
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use rand::{RngExt, SeedableRng};

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

    /// The same by the words of the definition: all that is left is looked at for each unknown.
    fn by_definition(count: usize, pairs: &[[u32; 2]], waits_for: &[Vec<u32>]) -> Vec<u32> {
        let mut beside: Vec<BTreeSet<u32>> =
            adjacency(count, pairs).into_iter().map(|list| list.into_iter().collect()).collect();
        let (mut since, mut changes): (Vec<usize>, usize) = ((0..count).collect(), count);
        let (mut result, mut is_gone) = (Vec::new(), vec![false; count]);
        while result.len() < count {
            let is_ready =
                |i: &usize| waits_for.get(*i).is_none_or(|list| list.iter().all(|before| is_gone[*before as usize]));
            let left = (0..count).filter(|i| !is_gone[*i]).filter(is_ready);
            let Some(next) = left.min_by_key(|&i| (beside[i].len(), since[i])) else { break };
            result.push(next as u32);
            is_gone[next] = true;
            let around = std::mem::take(&mut beside[next]);
            for &j in &around {
                beside[j as usize].extend(around.iter().filter(|&&k| k != j));
                beside[j as usize].remove(&(next as u32));
                since[j as usize] = changes;
                changes += 1;
            }
        }
        result
    }

    #[test]
    fn nets_and_random_graphs_are_eliminated_as_the_definition_says() {
        let net = |side: u32| -> Vec<[u32; 2]> {
            let right = (0..side * side).filter(move |i| (i + 1) % side != 0).map(|i| [i, i + 1]);
            right.chain((0..side * (side - 1)).map(move |i| [i, i + side])).collect()
        };
        assert_eq!(order(144, &net(12), &[]), by_definition(144, &net(12), &[]));
        // What is first eliminated by lists goes on by bits.
        assert_eq!(order(4225, &net(65), &[]), by_definition(4225, &net(65), &[]));
        let mut generator = rand_pcg::Pcg32::seed_from_u64(1);
        for case in 0..200 {
            let count = generator.random_range(1..40_u32);
            let pairs: Vec<[u32; 2]> = (0..generator.random_range(0..3 * count))
                .map(|_| [0, 1].map(|_| generator.random_range(0..count)))
                .collect();
            // Later ones wait for earlier ones, in every second case.
            let waits: Vec<Vec<u32>> = (0..if case % 2 == 0 { 0 } else { count })
                .map(|i| (0..i).filter(|_| generator.random_range(0..9) == 0).collect())
                .collect();
            let found = order(count as usize, &pairs, &waits);
            assert_eq!(found, by_definition(count as usize, &pairs, &waits), "{case}");
        }
    }
}
