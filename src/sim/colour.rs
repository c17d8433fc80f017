//! Colours: a sweep over bonds of one colour touches no point twice.

/// Bonds grouped by colour, so that neighbours in the list are independent of each other.
///
/// Returns the indices of `ends`, colour by colour; within a colour they stay in the order they had, and with it the
/// locality of the points. Greedy: each bond takes the first colour that is free at both ends, in rounds of 64 colours.
/// Shapes: `ends` holds point indices below `point_count`. Cost: O(bonds) for each 64 bonds at the fullest point.
pub(crate) fn by_colour(ends: &[[u32; 2]], point_count: usize) -> Vec<u32> {
    colours(ends, point_count).0
}

/// As [`by_colour`], and where each colour ends in the list.
pub(crate) fn colours(ends: &[[u32; 2]], point_count: usize) -> (Vec<u32>, Vec<usize>) {
    let (mut result, mut stops) = (Vec::with_capacity(ends.len()), Vec::new());
    let mut waiting: Vec<u32> = (0..ends.len() as u32).collect();
    let mut taken = vec![0_u64; point_count];
    while !waiting.is_empty() {
        let mut colours: Vec<Vec<u32>> = vec![Vec::new(); 64];
        waiting.retain(|&bond| {
            let [a, b] = ends[bond as usize].map(|point| point as usize);
            let free = (taken[a] | taken[b]).trailing_ones();
            if free == 64 {
                return true;
            }
            taken[a] |= 1 << free;
            taken[b] |= 1 << free;
            colours[free as usize].push(bond);
            false
        });
        for colour in colours.into_iter().filter(|colour| !colour.is_empty()) {
            result.extend(colour);
            stops.push(result.len());
        }
        taken.fill(0);
    }
    (result, stops)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many stretches of independent bonds the list falls into when cut greedily.
    fn stretches(order: &[u32], ends: &[[u32; 2]]) -> usize {
        let (mut seen, mut count) = (Vec::new(), 1);
        for &bond in order {
            let [a, b] = ends[bond as usize];
            if seen.contains(&a) || seen.contains(&b) {
                seen.clear();
                count += 1;
            }
            seen.extend([a, b]);
        }
        count
    }

    #[test]
    fn a_rope_has_two_colours() {
        let ends: Vec<[u32; 2]> = (0..100).map(|i| [i, i + 1]).collect();
        let order = by_colour(&ends, 101);
        assert_eq!(stretches(&order, &ends), 2);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..100).collect::<Vec<u32>>(), "every bond once");
    }

    #[test]
    fn a_point_of_a_thousand_bonds_is_coloured_too() {
        let ends: Vec<[u32; 2]> = (1..=1000).map(|i| [0, i]).collect();
        assert_eq!(by_colour(&ends, 1001).len(), 1000);
    }

    #[test]
    fn no_bonds_no_colours() {
        assert!(by_colour(&[], 0).is_empty());
    }
}
