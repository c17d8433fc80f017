//! Rigid bonds whose lengths contradict each other get lengths that agree: those of the shape that is nearest.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg32;

use crate::sim::bond::{Bond, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::measure;
use crate::sim::solve::blocks::Blocks;
use crate::sim::vector::{add, dot, length, scale, sub};

/// Strain that is left unsaid: what solving to rounding leaves of bonds that agree.
const AGREES: f64 = 1e-8;
/// How far points are moved for another start, as a share of the extent.
const NUDGE: f64 = 0.05;
/// Rounds of Gauss and Newton's method.
const MOST_ROUNDS: u32 = 200;

/// Moves `position` to the least sum of (|d| - rest)^2 over the rigid bonds, and gives those that are still off the
/// length they have there. Returns their indices.
///
/// Shapes: `position` and `w` have one entry a point; w = 0 is pinned. Bonds with a limit are left out.
pub(crate) fn reconcile<const D: usize>(bonds: &mut Bonds, position: &mut [[f64; D]], w: &[f64]) -> Vec<usize> {
    let rigid: Vec<usize> = (0..bonds.len()).filter(|&k| bonds.get(k).is_held()).collect();
    let is_free: Vec<bool> = w.iter().map(|&w| w > 0.0).collect();
    let (mut best, mut least) = nearest(bonds, &rigid, (position, w), MOST_ROUNDS);
    if least > AGREES {
        // A straight row of bonds that are too long has no way to go: another start may have.
        let mut other = position.to_vec();
        nudge(&mut other, &is_free, NUDGE);
        let (other, found) = nearest(bonds, &rigid, (&other, w), MOST_ROUNDS);
        if found < 0.999 * least {
            (best, least) = (other, found);
        }
    }
    position.copy_from_slice(&best);
    let mut changed = Vec::new();
    for k in rigid {
        let bond = bonds.get(k);
        let found = length(sub(position[bond.a.index()], position[bond.b.index()]));
        let scale = if bond.rest_length > 0.0 { bond.rest_length } else { 1.0 };
        if least > AGREES && (found - bond.rest_length).abs() > AGREES * scale {
            bonds.set(k, Bond { rest_length: found, ..bond });
            changed.push(k);
        }
    }
    changed
}

/// Where the points of some rigid bonds have the least sum of (|d| - rest)^2, from `position` on in so many rounds, and the largest strain that is
/// left. Other points stay.
pub(super) fn nearest<const D: usize>(
    bonds: &Bonds,
    rigid: &[usize],
    (position, w): (&[[f64; D]], &[f64]),
    rounds: u32,
) -> (Vec<[f64; D]>, f64) {
    let mut is_free = vec![false; w.len()];
    let pairs: Vec<[u32; 2]> = rigid.iter().map(|&k| bonds.ends()[k].map(|end| end.0)).collect();
    pairs.iter().flatten().map(|&end| end as usize).for_each(|end| is_free[end] = w[end] > 0.0);
    let mut system = Blocks::<f64, D>::new(&is_free, &pairs, &[]);
    let mut found = position.to_vec();
    let strain = descend(bonds, rigid, &mut found, (&mut system, rounds));
    (found, strain)
}

/// Moves free points by up to `share` of the extent of all, each in a direction of its own, the same every time.
fn nudge<const D: usize>(position: &mut [[f64; D]], is_free: &[bool], share: f64) {
    let size = measure::extent(position).map_or(0.0, |[low, high]| length(sub(high, low)));
    let size = share * if size > 0.0 { size } else { 1.0 };
    let mut generator = Pcg32::seed_from_u64(1);
    for (x, _) in position.iter_mut().zip(is_free).filter(|(_, free)| **free) {
        for component in x.iter_mut() {
            *component += size * (f64::from(generator.next_u32()) / f64::from(u32::MAX) - 0.5);
        }
    }
}

/// Gauss and Newton's method from one start. Returns the largest strain that is left.
fn descend<const D: usize>(
    bonds: &Bonds,
    rigid: &[usize],
    position: &mut [[f64; D]],
    (system, rounds): (&mut Blocks<f64, D>, u32),
) -> f64 {
    let (mut force, mut work) = (vec![[0.0; D]; position.len()], Vec::new());
    for _ in 0..rounds {
        system.clear();
        system.shift(1e-6);
        force.fill([0.0; D]);
        for (pair, &k) in rigid.iter().enumerate() {
            let [a, b] = bonds.ends()[k].map(PointId::index);
            let d = sub(position[a], position[b]);
            let size = length(d);
            if size == 0.0 {
                continue;
            }
            let n = scale(d, 1.0 / size);
            let block: [[f64; D]; D] = std::array::from_fn(|r| scale(n, n[r]));
            system.add_own(a, &block);
            system.add_own(b, &block);
            system.add_pair(pair, &block.map(|row| scale(row, -1.0)));
            let pull = scale(n, bonds.rest_lengths()[k] - size);
            force[a] = add(force[a], pull);
            force[b] = sub(force[b], pull);
        }
        system.factor();
        system.solve(&mut force, &mut [], &mut work);
        let mut largest = 0.0_f64;
        for (x, step) in position.iter_mut().zip(&force) {
            *x = add(*x, *step);
            largest = largest.max(dot(*step, *step));
        }
        if largest.sqrt() < f64::EPSILON * 64.0 {
            break;
        }
    }
    let off = |&k: &usize| {
        let [a, b] = bonds.ends()[k].map(PointId::index);
        let rest = bonds.rest_lengths()[k];
        let found = length(sub(position[a], position[b]));
        (found - rest).abs() / if rest > 0.0 { rest } else { 1.0 }
    };
    rigid.iter().map(off).fold(0.0, f64::max)
}
