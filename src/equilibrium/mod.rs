//! Equilibrium by Newton's method on the energy, with rigid bonds and surfaces as constraints.
//!
//! Islands don't feel each other: each is settled by itself. Every round solves
//!
//! ```text
//! (H + shift + G^T G/e) step = force - G^T (lambda + C/e),     lambda <- lambda + (C + G step)/e
//! ```
//!
//! H is the Hessian of springs and of the constraints with their multipliers, C what the constraints are off, G their
//! gradients, e a compliance so small that lambda needs no more than a round or two. The matrix is as large as there are
//! free coordinates, has one pattern whatever presses, and takes constraints that repeat each other. Where H is not positive
//! along the constraints the pivots show it, and the shift is raised: a step leads to a minimum, not to a saddle. One
//! that ends on a saddle all the same is pushed off it along the direction that falls away. Steps that do not lower the
//! merit (energy plus a penalty on C) are bent back to the constraints, then shortened.
//! Source: J. Nocedal and S. J. Wright, Numerical Optimization, 2nd ed. 2006, 16.5, 17.4, 18.3 and 15.4; the multipliers
//! as in S. J. Wright, Comput. Optim. Appl. 11, 253 (1998).

mod descent;
mod fall;
mod force;
mod friction;
mod hold;
mod merit;
mod part;
mod press;
mod saddle;
mod softness;
mod start;
mod stride;
mod system;
#[cfg(test)]
mod tests;

use crate::sim::bond::{BondKind, PointId};
use crate::sim::drive::Keys;
use crate::sim::measure;
use crate::sim::model::{Model, ModelError};
use crate::sim::plan::inverse_masses;
use descent::Descent;
pub use softness::{MOST_SOFT, Softness, softness};
use start::Start;

/// Force left on a point, as a share of the largest single one on any, that counts as none: what rounding leaves.
const BALANCED: f64 = 1e-13;
/// Force left, as a share of the largest, beyond which a shape is not settled: forces of bad condition don't get lower.
const BALANCED_ENOUGH: f64 = 3e-7;

/// A shape in which all forces balance.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium<const D: usize> {
    /// Positions `[m]`.
    pub position: Vec<[f64; D]>,
    /// Springs' and gravity's energy of the points that are not pinned `[J]`.
    pub energy: f64,
    /// Largest |length/rest - 1| over the bonds `[1]` (rest 0 left out).
    pub max_strain: f64,
    /// Largest force that is left on a point, as a share of the largest single force on one `[1]`: pulls of rigid bonds and
    /// pushes of surfaces are such forces too.
    pub residual: f64,
    /// Rounds of Newton's method, of all islands.
    pub rounds: u32,
    /// Points that fall for ever, ascending: no bond holds them to a pin, and no surface stops them.
    pub falling: Vec<PointId>,
    /// Whether forces balance to rounding, at a minimum of the energy, and nothing falls.
    pub is_settled: bool,
}

/// Finds the equilibrium that the start rolls down to, with damping that is strong.
///
/// Model: the least energy of springs and gravity under rigid bonds, pins and surfaces; constant forces and what the mean wind gives by drag push too; the mouse force, gusts and drives are left out.
/// A torque turns with its points, and has no energy: it is taken as it is when a round begins.
/// Islands that hang from no pin drop along gravity to the first surface, and go on from there. What can slide without a
/// change of energy stays where it slid to. Points stick to rough surfaces where they come to touch them, as long as
/// friction can hold them there: of the many shapes that are at rest with friction it is one. Islands that fall or slide
/// for ever are left where they are and named, and the result is not settled.
/// Errors: as [`Model::check`]; relaxed bonds are refused, for they have no energy; polygons are, and bodies that meet.
pub fn settle<const D: usize>(model: &Model<D>) -> Result<Equilibrium<D>, ModelError> {
    model.check()?;
    if let Some((rest_areas, angles)) = model.form_missing() {
        return settle(&Model { rest_areas, angles, ..model.clone() });
    }
    if let Some(bond) = model.bonds.iter().position(|bond| matches!(bond.kind, BondKind::Relaxed { .. })) {
        return Err(ModelError::NoEnergy { bond });
    }
    if !(model.polygons.is_empty() && model.convex.is_empty()) {
        return Err(ModelError::Polygons);
    }
    if model.contact.is_some() {
        return Err(ModelError::Meets);
    }
    if model.areas.is_some_and(|areas| areas.is_rigid()) && !model.triangles.is_empty() {
        return Err(ModelError::HeldAreas);
    }
    let mut start = Start::new(model);
    let mut falls = vec![false; model.position.len()];
    let (mut rounds, mut residual, mut is_settled) = (0, 0.0_f64, true);
    for part in start.parts {
        let members = part.members.clone();
        let mut descent = Descent::new(part);
        descent.run();
        for ((&i, &x), _) in members.iter().zip(&descent.x).zip(&descent.part.is_free).filter(|(_, free)| **free) {
            falls[i as usize] = descent.falls;
            if !descent.falls {
                start.position[i as usize] = x;
            }
        }
        rounds += descent.rounds;
        residual = residual.max(if descent.falls { 0.0 } else { descent.residual });
        is_settled &= descent.is_settled();
    }
    let position: Vec<[f64; D]> = start.representatives.iter().map(|&i| start.position[i as usize]).collect();
    let falling = (0..position.len()).filter(|&i| falls[start.representatives[i] as usize]);
    Ok(Equilibrium {
        energy: measure::energies(|i| position[i], |_| [0.0; D], &inverse_masses(model), &model.bonds, model.gravity)
            .sum()
            + model.form_energy(|i| position[i], |_| true),
        max_strain: measure::max_strain(|i| position[i], &model.bonds, (0.0, &Keys::default())),
        falling: falling.map(|i| PointId(i as u32)).collect(),
        position,
        residual,
        rounds,
        is_settled,
    })
}
