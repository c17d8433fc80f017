//! What an island is made of: rows and columns, one path, or anything else.
//!
//! Recognised from bonds and numbering alone, so that a body from a maker and the same body listed point by point are
//! taken alike; whatever does not fit to the last bond is anything else.

mod chain;
mod crowd;
pub(crate) mod piece;
mod sheet;
pub(crate) mod steady;
#[cfg(test)]
mod tests;

use super::island::Island;
use crate::sim::bonds::Bonds;
use crate::sim::bulk::spec::Spec;
use crate::sim::kernels::rows::Kinds;

pub(crate) use chain::chain;
pub(crate) use crowd::{crowds, members};
pub(crate) use sheet::sheet;

/// The structure of an island.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Structure {
    /// Points `first`, `first` + 1, … row by row.
    Sheet { first: u32, columns: usize, rows: usize, specs: Kinds<Spec> },
    /// One path along these points, with these rest lengths `[m]`.
    Chain { points: Vec<u32>, spec: Spec, rests: Vec<f64> },
    /// Anything else.
    Mesh,
}

impl Structure {
    /// The structure of an island among `bonds`; w = 0 is pinned.
    pub(crate) fn of(island: &Island, bonds: &Bonds, w: &[f64]) -> Self {
        sheet(island, bonds, w).or_else(|| chain(island, bonds, w)).unwrap_or(Structure::Mesh)
    }
}
