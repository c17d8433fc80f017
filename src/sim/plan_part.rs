//! What a plan tells of its groups.

use super::solver::Solver;

/// Islands of one method and substep: what they are and what moves them.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanPart {
    /// The method.
    pub solver: Solver,
    /// Longest substep `[s]`.
    pub substep: f64,
    /// Points that can move.
    pub points: usize,
    /// Bonds.
    pub bonds: usize,
    /// Islands.
    pub islands: usize,
    /// Multiplications of one substep, about: what settings are compared by.
    pub work: f64,
    /// What large bodies are made of and how their bonds are taken, in words; empty for others.
    pub kernel: String,
    /// Largest strain that substeps follow `[1]`, if they do.
    pub max_strain: Option<f64>,
}
