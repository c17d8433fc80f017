//! Rest lengths that are written with few digits: those of a rigid body agree with each other but for rounding. Laid out one point after the
//! other that would pile up, so they are fitted to one shape, once.
//!
//! ```text
//! which      rigid bonds that hang together, each as long as its ends are apart but for some share of its length, which contradict each other
//! shape      that with the least sum of (|d| - rest)^2, from where the points are (`reconcile.rs`)
//! lengths    those of that shape: they agree to the last digits
//! ```

use super::reconcile::nearest;
use super::rigid::moves_bodies;
use super::{Sets, inverse_masses};
use crate::sim::bond::{Bond, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::model::Model;
use crate::sim::rigid::pieces::contradicts;
use crate::sim::rigid::shape::{FITS, Held, LEAST_HEIGHT};
use crate::sim::rigid::space;
use crate::sim::solver::Solver;
use crate::sim::vector::{embed, flat, length, sub};

/// Share of its length by which places in `f64` leave a bond off that is said exactly.
const EXACT: f64 = 1e-12;
/// Share of its length by which a bond may be off the shape. From that height of a triangle on it is said on which side of a bond a point is: what
/// is off by more is no rounding, and could be another shape.
const MOST_MISFIT: f64 = LEAST_HEIGHT;
/// Rounds of Gauss and Newton's method: whatever is left, lengths of one shape agree.
const ROUNDS: u32 = 8;

/// What was fitted.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Fitted {
    /// Bonds that got other lengths, and the largest share of a length by which one was off.
    pub(crate) bonds: Vec<usize>,
    pub(crate) most: f64,
}

impl Fitted {
    /// Whether more was off than a body bears without a word.
    pub(crate) fn is_told(&self) -> bool {
        self.most > FITS
    }
}

/// Moves `position` to the shapes nearest to what rigid bonds say, and gives these the lengths that they have there, where they contradict
/// each other by no more than [`MOST_MISFIT`]. What agrees stays as it is, to the bit.
///
/// Linear in bonds but for the shapes, each as dear as an elimination of its points.
pub(crate) fn fit_rest_lengths<const D: usize>(
    model: &Model<D>,
    bonds: &mut Bonds,
    position: &mut [[f64; D]],
) -> Fitted {
    let mut fitted = Fitted::default();
    let solver = model.method.solver;
    if !(solver == Solver::Auto || moves_bodies(solver)) || model.has_penalties() {
        return fitted;
    }
    // Most scenes say their lengths exactly.
    let is_off = |bond: Bond| bond.holds() && misfit(&bond, position) >= EXACT;
    if !bonds.iter().any(is_off) {
        return fitted;
    }
    let w = inverse_masses(model);
    for own in bodies(bonds, position.len()) {
        let most = own.iter().map(|&k| misfit(&bonds.get(k), position)).fold(0.0, f64::max);
        if !(EXACT..=MOST_MISFIT).contains(&most) || !is_contradicted(bonds, &own, position) {
            continue;
        }
        let (shape, _) = nearest(bonds, &own, (position, &w), ROUNDS);
        let most = own.iter().map(|&k| misfit(&bonds.get(k), &shape)).fold(0.0, f64::max);
        if most > MOST_MISFIT {
            continue;
        }
        for k in own {
            let bond = bonds.get(k);
            for end in [bond.a, bond.b] {
                position[end.index()] = shape[end.index()];
            }
            let rest_length = apart(&bond, &shape);
            if rest_length != bond.rest_length {
                bonds.set(k, Bond { rest_length, ..bond });
                fitted.bonds.push(k);
            }
        }
        fitted.most = fitted.most.max(most);
    }
    fitted.bonds.sort_unstable();
    fitted
}

/// Bonds that hold for ever and hang together, in lists of three and more.
fn bodies(bonds: &Bonds, points: usize) -> Vec<Vec<usize>> {
    let rigid: Vec<usize> = (0..bonds.len()).filter(|&k| bonds.get(k).holds()).collect();
    if rigid.len() < 3 {
        return Vec::new();
    }
    let mut sets = Sets::new(points);
    let ends = |k: usize| bonds.ends()[k].map(|end| end.0);
    for &k in &rigid {
        let [a, b] = ends(k);
        sets.join(a, b);
    }
    let mut lists = vec![Vec::new(); points];
    for k in rigid {
        lists[sets.find(ends(k)[0]) as usize].push(k);
    }
    lists.retain(|list| list.len() > 2);
    lists
}

/// Whether lengths of bonds contradict each other where they hold points in their places.
fn is_contradicted<const D: usize>(bonds: &Bonds, own: &[usize], position: &[[f64; D]]) -> bool {
    let mut points: Vec<u32> = own.iter().flat_map(|&k| bonds.ends()[k].map(|end| end.0)).collect();
    points.sort_unstable();
    points.dedup();
    let place = |end: PointId| points.binary_search(&end.0).map_or(u32::MAX, |place| place as u32);
    let masses = vec![1.0; points.len()];
    let at = |&point: &u32| position[point as usize];
    let bonds = own.iter().map(|&k| (bonds.ends()[k].map(place), bonds.rest_lengths()[k])).collect();
    if D == 3 {
        let now = points.iter().map(at).map(embed).collect();
        return space::shape::contradicts(&space::layout::Held { now, masses, bonds });
    }
    contradicts(&Held { now: points.iter().map(at).map(flat).collect(), masses, bonds, surface: &[] })
}

fn apart<const D: usize>(bond: &Bond, position: &[[f64; D]]) -> f64 {
    length(sub(position[bond.a.index()], position[bond.b.index()]))
}

/// The share of its length by which a bond is off.
fn misfit<const D: usize>(bond: &Bond, position: &[[f64; D]]) -> f64 {
    let found = (apart(bond, position) - bond.rest_length).abs() / bond.rest_length;
    // NaN fits nowhere.
    if found.is_nan() { f64::INFINITY } else { found }
}
