//! Equilibrium by Newton's method on the energy, with rigid bonds as constraints.
//!
//! Every round solves
//!
//! ```text
//! [ H + shift  G^T ] [ step   ]   [ -gradient ]
//! [ G          0   ] [ lambda ] = [ -C        ]
//! ```
//!
//! H is the Hessian of springs and of the constraints with their multipliers. Where its part along the constraints is not
//! positive the pivots show it, and the shift is raised: a step leads to a minimum, not to a saddle. Steps that do not
//! lower the merit (energy plus a penalty on C) are shortened. Points on surfaces are held to them while they press.
//! Source: J. Nocedal and S. J. Wright, Numerical Optimization, 2nd ed. 2006, 16.1, 18.4 and 15.4.

mod balance;
mod descent;
mod hold;
mod merit;
mod press;
mod start;
mod system;

use super::bond::BondKind;
use super::measure;
use super::model::{Model, ModelError};
use super::plan::inverse_masses;
use descent::Descent;

/// Rounds after which an equilibrium is given up.
const MOST_ROUNDS: u32 = 500;
/// Force per weight at which a point counts as at rest, relative to the largest force on any.
const BALANCED: f64 = 1e-13;

/// A shape in which all forces balance.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium<const D: usize> {
    /// Positions [m].
    pub position: Vec<[f64; D]>,
    /// Springs' and gravity's energy of the points that are not pinned [J].
    pub energy: f64,
    /// Largest |length/rest - 1| over the bonds [1] (rest 0 left out).
    pub max_strain: f64,
    /// Largest force that is left on a point, as a share of the largest single force on one [1].
    pub residual: f64,
    /// Rounds of Newton's method.
    pub rounds: u32,
    /// Whether forces balance to rounding.
    pub is_settled: bool,
}

/// Finds the equilibrium that the start rolls down to, with damping that is strong.
///
/// Model: the least energy of springs and gravity under rigid bonds, pins and surfaces; mouse force and drag are left
/// out. Points that nothing holds fall for ever: they are left where they are, and the result is not settled.
/// Errors: as [`Model::check`]; relaxed bonds are refused, for they have no energy.
pub fn settle<const D: usize>(model: &Model<D>) -> Result<Equilibrium<D>, ModelError> {
    model.check()?;
    if let Some(bond) = model.bonds.iter().position(|bond| matches!(bond.kind, BondKind::Relaxed { .. })) {
        return Err(ModelError::NoEnergy { bond });
    }
    let mut descent = Descent::new(model);
    let mut rounds = 0;
    while rounds < MOST_ROUNDS && !descent.is_done {
        descent.round();
        rounds += 1;
    }
    let position: Vec<[f64; D]> = descent.stand_ins.iter().map(|&i| descent.x[i as usize]).collect();
    let at_rest = vec![[0.0; D]; position.len()];
    Ok(Equilibrium {
        energy: measure::energy(&position, &at_rest, &inverse_masses(model), &model.bonds, model.gravity),
        max_strain: measure::max_strain(&position, &model.bonds),
        position,
        residual: descent.residual,
        rounds,
        is_settled: descent.is_done && descent.residual <= BALANCED.sqrt() && !descent.has_loose,
    })
}
