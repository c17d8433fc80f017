//! The pattern of a set of rigid bonds: their order of elimination, and which bonds share a point.

use crate::sim::bond::Limit;
use crate::sim::real::Real;
use crate::sim::solve::elimination::{self, Pattern};

/// A rigid bond as the direct solver reads it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<S> {
    pub(crate) a: u32,
    pub(crate) b: u32,
    pub(crate) w_a: S,
    pub(crate) w_b: S,
    pub(crate) rest_length: S,
    /// 1/rest_length^2 `[1/m^2]`; 1 at rest length 0.
    pub(crate) inverse_square: S,
    pub(crate) limit: Limit,
    /// It acts: always, unless it has a limit.
    pub(crate) is_taut: bool,
}

/// The second leg of a row that holds the area of a triangle: its corners q, p are the ends of the row, and r, p those of the leg.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg<S> {
    /// The row.
    pub(crate) row: u32,
    /// The third corner, and its inverse mass `[1/kg]`.
    pub(crate) c: u32,
    pub(crate) w_c: S,
    /// The area `[m^2]`.
    pub(crate) area: S,
}

/// What couples two rows beside their first legs.
#[derive(Clone, Debug)]
pub(crate) struct Crossing<S> {
    /// Which coupling it adds to.
    pub(crate) coupling: u32,
    /// The legs: first ones by their rows, second ones counted behind all rows.
    pub(crate) legs: [u32; 2],
    /// The shared points, each with its part of the weight.
    pub(crate) shared: Vec<(u32, S)>,
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
    /// Second legs of rows that hold areas, and what they couple.
    pub(crate) legs: Vec<Leg<S>>,
    pub(crate) crossings: Vec<Crossing<S>>,
}

impl<S: Real> Shape<S> {
    /// The pattern of some bonds over `points` points; of rows that hold areas the second legs are beside.
    pub(crate) fn new(bonds: Vec<Row<S>>, mut legs: Vec<Leg<S>>, points: usize) -> Self {
        let pairs = neighbours(&bonds, &legs, points);
        let Pattern { order, place, lower } = elimination::pattern(bonds.len(), &pairs);
        let rows: Vec<Row<S>> = order.iter().map(|&bond| bonds[bond as usize]).collect();
        let entries = lower.iter().zip(0..).flat_map(|(columns, k)| columns.iter().map(move |&l| (k, l)));
        let couplings: Vec<Coupling<S>> = entries.map(|(k, l)| couple(k, l, &rows)).collect();
        legs.iter_mut().for_each(|leg| leg.row = place[leg.row as usize]);
        let crossings = crossings(&rows, &legs, &couplings);
        Shape { rows, couplings, lower, legs, crossings }
    }
}

/// What second legs couple.
fn crossings<S: Real>(rows: &[Row<S>], legs: &[Leg<S>], couplings: &[Coupling<S>]) -> Vec<Crossing<S>> {
    if legs.is_empty() {
        return Vec::new();
    }
    let mut second = vec![u32::MAX; rows.len()];
    legs.iter().zip(rows.len() as u32..).for_each(|(leg, name)| second[leg.row as usize] = name);
    let ends = |leg: u32| match legs.get((leg as usize).wrapping_sub(rows.len())) {
        Some(leg) => [(leg.c, leg.w_c, S::ONE), (rows[leg.row as usize].b, rows[leg.row as usize].w_b, -S::ONE)],
        None => {
            let row = rows[leg as usize];
            [(row.a, row.w_a, S::ONE), (row.b, row.w_b, -S::ONE)]
        }
    };
    let mut list = Vec::new();
    for (coupling, &Coupling { row, column, .. }) in couplings.iter().enumerate() {
        let of = |row: u32| [row, second[row as usize]].into_iter().filter(|&leg| leg != u32::MAX);
        for (k, l) in of(row).flat_map(|k| of(column).map(move |l| (k, l))).filter(|&pair| pair != (row, column)) {
            let mut shared = Vec::new();
            for (p, w, sign_k) in ends(k) {
                for (q, _, sign_l) in ends(l) {
                    if p == q && w != S::ZERO {
                        shared.push((p, sign_k * sign_l * w));
                    }
                }
            }
            if !shared.is_empty() {
                list.push(Crossing { coupling: coupling as u32, legs: [k, l], shared });
            }
        }
    }
    list
}

/// Pairs of bonds that share a point that can move.
fn neighbours<S: Real>(bonds: &[Row<S>], legs: &[Leg<S>], points: usize) -> Vec<[u32; 2]> {
    let mut at: Vec<Vec<u32>> = vec![Vec::new(); points];
    for (k, bond) in bonds.iter().enumerate() {
        for (point, weight) in [(bond.a, bond.w_a), (bond.b, bond.w_b)] {
            if weight != S::ZERO {
                at[point as usize].push(k as u32);
            }
        }
    }
    for leg in legs.iter().filter(|leg| leg.w_c != S::ZERO) {
        at[leg.c as usize].push(leg.row);
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
