//! The pattern of a set of rigid bonds: their order of elimination, and which bonds share a point.

use crate::sim::bond::Limit;
use crate::sim::real::Real;
use crate::sim::solve::elimination;

/// A rigid bond as the direct solver reads it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<S> {
    pub(crate) a: u32,
    pub(crate) b: u32,
    pub(crate) w_a: S,
    pub(crate) w_b: S,
    pub(crate) rest_length: S,
    /// 1/rest_length^2 [1/m^2]; 1 at rest length 0.
    pub(crate) inverse_square: S,
    pub(crate) limit: Limit,
    /// It acts: always, unless it has a limit.
    pub(crate) is_taut: bool,
}

/// Two bonds that share one point or two.
#[derive(Clone, Debug)]
pub(crate) struct Coupling<S> {
    pub(crate) row: u32,
    pub(crate) column: u32,
    /// Sum over the shared points of inverse mass, with a minus where one bond starts there and the other ends.
    pub(crate) weight: S,
    /// The shared points, each with its part of the weight.
    pub(crate) shared: Vec<(u32, S)>,
}

/// Bonds in their order of elimination with what couples them.
pub(crate) struct Shape<S> {
    pub(crate) rows: Vec<Row<S>>,
    /// Row by row, columns ascending.
    pub(crate) couplings: Vec<Coupling<S>>,
    /// The columns of the couplings of every row.
    pub(crate) lower: Vec<Vec<u32>>,
}

impl<S: Real> Shape<S> {
    /// The pattern of some bonds over `points` points.
    pub(crate) fn new(bonds: Vec<Row<S>>, points: usize) -> Self {
        let pairs = neighbours(&bonds, points);
        let order = elimination::order(bonds.len(), &pairs, &[]);
        let mut place = vec![0_u32; bonds.len()];
        for (k, &bond) in order.iter().enumerate() {
            place[bond as usize] = k as u32;
        }
        let rows: Vec<Row<S>> = order.iter().map(|&bond| bonds[bond as usize]).collect();
        let mut lower: Vec<Vec<u32>> = vec![Vec::new(); rows.len()];
        for [i, j] in pairs {
            let (k, l) = (place[i as usize], place[j as usize]);
            lower[k.max(l) as usize].push(k.min(l));
        }
        let mut couplings = Vec::new();
        for (k, columns) in lower.iter_mut().enumerate() {
            columns.sort_unstable();
            columns.dedup();
            couplings.extend(columns.iter().map(|&l| couple(k as u32, l, &rows)));
        }
        Shape { rows, couplings, lower }
    }
}

/// Pairs of bonds that share a point that can move.
fn neighbours<S: Real>(bonds: &[Row<S>], points: usize) -> Vec<[u32; 2]> {
    let mut at: Vec<Vec<u32>> = vec![Vec::new(); points];
    for (k, bond) in bonds.iter().enumerate() {
        for (point, weight) in [(bond.a, bond.w_a), (bond.b, bond.w_b)] {
            if weight != S::ZERO {
                at[point as usize].push(k as u32);
            }
        }
    }
    let mut pairs = Vec::new();
    for list in at {
        for (i, &k) in list.iter().enumerate() {
            pairs.extend(list[..i].iter().map(|&l| [l, k]));
        }
    }
    pairs
}

fn couple<S: Real>(row: u32, column: u32, rows: &[Row<S>]) -> Coupling<S> {
    let (k, l) = (rows[row as usize], rows[column as usize]);
    let mut shared = Vec::new();
    for (p, w, sign_k) in [(k.a, k.w_a, S::ONE), (k.b, k.w_b, -S::ONE)] {
        for (q, sign_l) in [(l.a, S::ONE), (l.b, -S::ONE)] {
            if p == q && w != S::ZERO {
                shared.push((p, sign_k * sign_l * w));
            }
        }
    }
    let weight = shared.iter().fold(S::ZERO, |sum, part| sum + part.1);
    Coupling { row, column, weight, shared }
}
