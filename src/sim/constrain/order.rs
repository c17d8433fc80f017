//! The order in which a sweep takes the bonds.

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg32;

use crate::sim::colour::by_colour;
use crate::sim::solver::Order;

/// Hands out the bonds of a sweep one by one.
///
/// Holds what the order must remember from sweep to sweep: the direction, or the generator of the shuffles.
#[derive(Clone, Debug)]
pub(crate) struct Sweeper {
    order: Order,
    /// Indices of the bonds; only for shuffles.
    shuffled: Vec<u32>,
    generator: Pcg32,
    backward: bool,
}

impl Sweeper {
    /// A sweeper over `bonds`, which it arranges in memory for the order asked for.
    ///
    /// `ends` tells a bond's points, all below `point_count`.
    pub(crate) fn new<B: Copy>(
        order: Order,
        seed: u64,
        bonds: &mut Vec<B>,
        ends: impl Fn(&B) -> [u32; 2],
        point_count: usize,
    ) -> Self {
        let order = if order == Order::Auto { Order::Coloured } else { order };
        if order == Order::Coloured {
            let pairs: Vec<[u32; 2]> = bonds.iter().map(ends).collect();
            *bonds = by_colour(&pairs, point_count).into_iter().map(|i| bonds[i as usize]).collect();
        }
        let shuffled = if order == Order::Shuffled { (0..bonds.len() as u32).collect() } else { Vec::new() };
        Sweeper { order, shuffled, generator: Pcg32::seed_from_u64(seed), backward: false }
    }

    /// One sweep: calls `visit` once for every bond.
    pub(crate) fn sweep<B>(&mut self, bonds: &[B], mut visit: impl FnMut(&B)) {
        match self.order {
            Order::Shuffled => {
                self.shuffled.shuffle(&mut self.generator);
                for &i in &self.shuffled {
                    visit(&bonds[i as usize]);
                }
            }
            Order::Symmetric if self.backward => bonds.iter().rev().for_each(visit),
            _ => bonds.iter().for_each(visit),
        }
        self.backward = !self.backward;
    }

    /// One sweep against the direction of the last, whatever the order: what converges fastest.
    pub(crate) fn sweep_to_and_fro<B>(&mut self, bonds: &[B], mut visit: impl FnMut(&B)) {
        match self.order {
            Order::Shuffled => self.sweep(bonds, visit),
            _ => {
                if self.backward {
                    bonds.iter().rev().for_each(&mut visit);
                } else {
                    bonds.iter().for_each(&mut visit);
                }
                self.backward = !self.backward;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweeps(order: Order, count: usize) -> Vec<Vec<u32>> {
        let mut bonds = vec![[0, 1], [1, 2], [2, 3], [3, 4]];
        let mut sweeper = Sweeper::new(order, 5, &mut bonds, |&b| b, 5);
        let mut sweep = || {
            let mut seen = Vec::new();
            sweeper.sweep(&bonds, |b| seen.push(b[0]));
            seen
        };
        (0..count).map(|_| sweep()).collect()
    }

    #[test]
    fn orders_are_what_their_names_say() {
        assert_eq!(sweeps(Order::Fixed, 2), [[0, 1, 2, 3], [0, 1, 2, 3]]);
        assert_eq!(sweeps(Order::Symmetric, 2), [[0, 1, 2, 3], [3, 2, 1, 0]]);
        assert_eq!(sweeps(Order::Coloured, 2), [[0, 2, 1, 3], [0, 2, 1, 3]]);
        assert_eq!(sweeps(Order::Auto, 1), sweeps(Order::Coloured, 1));
    }

    #[test]
    fn shuffles_take_every_bond_and_repeat_with_the_seed() {
        let first = sweeps(Order::Shuffled, 8);
        assert_eq!(first, sweeps(Order::Shuffled, 8));
        assert!(first.iter().any(|sweep| sweep != &first[0]), "every sweep is shuffled anew");
        for mut sweep in first {
            sweep.sort_unstable();
            assert_eq!(sweep, [0, 1, 2, 3]);
        }
    }
}
