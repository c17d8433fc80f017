//! The order that the points and bonds of a large scene are drawn in: along a curve that keeps neighbours together, so
//! that a stretch of a buffer is a patch of the scene.

use super::chunks::CHUNK;
use super::gpu_bond::GpuBond;
use crate::sim::Positions;

/// Cells of the curve along each axis, as a power of two: as many as give a key of 32 bits in the plane, 30 in space.
const BITS: [u32; 2] = [16, 10];

/// Place of a cell on Hilbert's curve through 2^`bits` cells each way: cells that follow each other touch.
///
/// Source: J. Skilling, Programming the Hilbert curve, AIP Conference Proceedings 707 (2004), 381.
fn hilbert<const D: usize>(mut cell: [u32; D], bits: u32) -> u64 {
    for bit in (1..bits).rev() {
        let (q, below) = (1 << bit, (1 << bit) - 1);
        for i in 0..D {
            if cell[i] & q != 0 {
                cell[0] ^= below;
            } else {
                let swap = (cell[0] ^ cell[i]) & below;
                cell[0] ^= swap;
                cell[i] ^= swap;
            }
        }
    }
    for i in 1..D {
        cell[i] ^= cell[i - 1];
    }
    let turns = (1..bits).filter(|bit| (cell[D - 1] >> bit) & 1 == 1);
    let flip = turns.fold(0, |flip, bit| flip ^ ((1 << bit) - 1));
    let bit_of = |key: u64, bit: u32, axis: u32| (key << 1) | u64::from(((axis ^ flip) >> bit) & 1);
    (0..bits).rev().fold(0, |key, bit| cell.iter().fold(key, |key, &axis| bit_of(key, bit, axis)))
}

/// The points along the curve.
///
/// Valid range: points whose position is not a number come first; where all are in one place they stay as they are.
pub(super) fn along_curve(positions: Positions<'_>, dimensions: usize) -> Vec<u32> {
    if dimensions == 2 { order::<2>(positions) } else { order::<3>(positions) }
}

fn order<const D: usize>(positions: Positions<'_>) -> Vec<u32> {
    let bits = BITS[D - 2];
    let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for i in 0..positions.len() {
        let (x, axis) = (positions.get(i), i % D);
        low[axis] = low[axis].min(x);
        high[axis] = high[axis].max(x);
    }
    let extent = (0..D).fold(0.0_f64, |most, axis| most.max(high[axis] - low[axis]));
    let scale = f64::from((1_u32 << bits) - 1) / extent;
    // Not a number is cell 0, and what lies beyond the last cell is in it.
    let cell =
        |point: usize| std::array::from_fn(|axis| ((positions.get(point * D + axis) - low[axis]) * scale) as u32);
    let most = (1 << bits) - 1;
    let key = |point: usize| (hilbert::<D>(cell(point).map(|x: u32| x.min(most)), bits) << 32) | point as u64;
    let mut keys: Vec<u64> = (0..positions.len() / D).map(key).collect();
    keys.sort_unstable();
    keys.into_iter().map(|key| key as u32).collect()
}

/// The first so many multiples of it, taken modulo [`CHUNK`], lie evenly whatever their number is: the widest gap is at
/// most 2.2 times what it would be at even distances. Of all odd numbers that do not bunch at either end it has the
/// smallest such gap; the one nearest to the golden ratio has 5.7.
const STRIDE: usize = 463;
/// [`STRIDE`] times this is 1 modulo [`CHUNK`]: from a bond to the next one on the curve, `NEIGHBOR` in bonds.wgsl.
pub(super) const INVERSE: usize = 303;

const _: () = assert!((STRIDE * INVERSE) % CHUNK == 1);

/// The bonds in the order of their first point on the curve, and within each chunk so spread that its first few stand
/// for all of it. `rank` is the place of each point.
pub(super) fn sorted(bonds: &[GpuBond], rank: &[u32]) -> Vec<GpuBond> {
    let first = |bond: &GpuBond| rank[bond.a as usize].min(rank[bond.b as usize]) as usize;
    let mut next = vec![0_u32; rank.len() + 1];
    for bond in bonds {
        next[first(bond) + 1] += 1;
    }
    for i in 1..next.len() {
        next[i] += next[i - 1];
    }
    let mut list = bonds.to_vec();
    for bond in bonds {
        let place = &mut next[first(bond)];
        list[spread(*place as usize, bonds.len())] = *bond;
        *place += 1;
    }
    list
}

/// Where the bond at `place` on the curve goes within its chunk: to the k for which k times [`STRIDE`] is that place.
/// The last chunk of the `count` bonds stays as it is if it is not a whole one.
fn spread(place: usize, count: usize) -> usize {
    let chunk = place - place % CHUNK;
    if chunk + CHUNK > count { place } else { chunk + (place * INVERSE) % CHUNK }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of the curve in its order.
    fn curve<const D: usize>(bits: u32) -> Vec<[i64; D]> {
        let side = 1_u32 << bits;
        let cells = (0..side.pow(D as u32)).map(|i| std::array::from_fn(|axis| i / side.pow(axis as u32) % side));
        let mut keyed: Vec<(u64, [u32; D])> = cells.map(|cell| (hilbert(cell, bits), cell)).collect();
        keyed.sort_unstable();
        assert!(keyed.iter().enumerate().all(|(i, (key, _))| *key == i as u64), "every key once");
        keyed.into_iter().map(|(_, cell)| cell.map(i64::from)).collect()
    }

    fn steps_are_one<const D: usize>(curve: &[[i64; D]]) -> bool {
        curve.windows(2).all(|pair| (0..D).map(|axis| (pair[0][axis] - pair[1][axis]).abs()).sum::<i64>() == 1)
    }

    #[test]
    fn cells_that_follow_each_other_touch() {
        assert!(steps_are_one(&curve::<2>(1)) && steps_are_one(&curve::<2>(5)));
        assert!(steps_are_one(&curve::<3>(1)) && steps_are_one(&curve::<3>(4)));
    }

    #[test]
    fn every_point_has_a_place_whatever_its_position() {
        let wild = [f64::NAN, 1.0, f64::INFINITY, 0.0, 3.0, f64::NEG_INFINITY, 1e300, -1e300, 0.0, 0.0];
        let mut order = along_curve(Positions::F64(&wild), 2);
        order.sort_unstable();
        assert_eq!(order, [0, 1, 2, 3, 4]);
        assert_eq!(along_curve(Positions::F32(&[7.0; 12]), 3), [0, 1, 2, 3], "all in one place");
        assert!(along_curve(Positions::F32(&[]), 2).is_empty());
        assert_eq!(along_curve(Positions::F32(&[0.0, 0.0, 9.0, 0.0, 0.0, 1.0]), 2), [0, 2, 1]);
    }

    #[test]
    fn the_first_bonds_of_a_chunk_are_spread_over_it() {
        let count = 2 * CHUNK + 100;
        let bonds: Vec<GpuBond> = (0..count as u32).rev().map(|a| GpuBond::new(a, a + 1, 1.0)).collect();
        let rank: Vec<u32> = (0..=count as u32).collect();
        let list = sorted(&bonds, &rank);
        for some in [2, 5, 37, 300, CHUNK] {
            let mut places: Vec<u32> = list[CHUNK..CHUNK + some].iter().map(|bond| bond.a).collect();
            places.sort_unstable();
            assert!(places.iter().all(|place| (CHUNK as u32..2 * CHUNK as u32).contains(place)), "of this chunk");
            let gap = places.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap_or(0) as usize;
            assert!(gap * some <= 9 * CHUNK / 4, "{some} bonds, {gap} apart");
        }
        assert_eq!(list[2 * CHUNK + 7].a as usize, 2 * CHUNK + 7, "the rest is in order");
    }
}
