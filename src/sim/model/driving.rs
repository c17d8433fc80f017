//! What of a scene can have a drive: asked by the check of models, and by whoever offers one.

use std::fmt;

use super::Model;
use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::solver::Solver;

/// Solvers that move what is driven.
const OTHERS: &str = "auto, verlet, velocity-verlet, pefrl, rk4 or live";

/// What of a model decides whether its bonds and angles can have drives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Driving {
    /// The method that is asked for.
    pub solver: Solver,
    /// It is held to a tolerance.
    pub has_tolerance: bool,
    /// It is in space.
    pub is_in_space: bool,
    /// Bodies, balls or boxes are met.
    pub meets: bool,
}

/// Why something cannot have a drive; as text in the words of scene files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoDrive {
    /// A relaxed bond.
    Relaxed,
    /// A bond that acts on one side.
    OneSided,
    /// A bond of no length.
    Weld,
    /// A rigid bond under a solver that moves none by a drive.
    RigidBy(Solver),
    /// A rigid bond where a tolerance is held to.
    RigidToTolerance,
    /// A rigid bond in space.
    RigidInSpace,
    /// Any bond in space where bodies, balls or boxes are met.
    MeetsInSpace,
    /// Any bond under this solver.
    By(Solver),
    /// Motors under this solver.
    MotorBy(Solver),
}

impl fmt::Display for NoDrive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoDrive::Relaxed => f.write_str("a relaxed bond has none: make it a spring or rigid"),
            NoDrive::OneSided | NoDrive::Weld => {
                f.write_str("a bond needs a length, and to act both ways: give it `rest` above 0 and no `limit`")
            }
            NoDrive::RigidBy(solver) => {
                write!(f, "solver {solver} moves no rigid bond by a drive: use auto or live, or make it a spring")
            }
            NoDrive::RigidToTolerance => {
                f.write_str("no tolerance is held to where a rigid bond has a drive: make it a spring")
            }
            NoDrive::RigidInSpace | NoDrive::MeetsInSpace => {
                f.write_str("in space springs alone have drives, where no bodies, balls or boxes are met: leave it out")
            }
            NoDrive::By(solver) => write!(f, "solver {solver} knows no drives: use {OTHERS}"),
            NoDrive::MotorBy(solver) => write!(f, "solver {solver} knows no motors: use {OTHERS}"),
        }
    }
}

impl Driving {
    /// Why a bond cannot have a drive, if it cannot.
    pub fn of_bond(&self, bond: &Bond) -> Option<NoDrive> {
        let is_rigid = bond.kind == BondKind::Rigid;
        let solver = self.solver;
        let cases = [
            (NoDrive::Relaxed, matches!(bond.kind, BondKind::Relaxed { .. })),
            (NoDrive::OneSided, bond.limit != Limit::Both),
            (NoDrive::Weld, bond.rest_length == 0.0),
            (NoDrive::RigidBy(solver), is_rigid && !matches!(solver, Solver::Auto | Solver::Live)),
            (NoDrive::RigidToTolerance, is_rigid && self.has_tolerance),
            (NoDrive::RigidInSpace, is_rigid && self.is_in_space),
        ];
        cases.into_iter().find_map(|(why, is_so)| is_so.then_some(why)).or_else(|| self.of_any())
    }

    /// Why no bond can have a drive, whatever it is; `None`: some can.
    pub fn of_any(&self) -> Option<NoDrive> {
        let solver = self.solver;
        let knows_none = matches!(solver, Solver::Relaxation | Solver::Xpbd | Solver::Path | Solver::Flight);
        let meets = self.is_in_space && (self.meets || solver == Solver::Live);
        meets.then_some(NoDrive::MeetsInSpace).or_else(|| knows_none.then_some(NoDrive::By(solver)))
    }

    /// Why no angle can have a motor, if none can.
    pub fn of_motor(&self) -> Option<NoDrive> {
        let knows_none = matches!(self.solver, Solver::ImplicitMidpoint | Solver::BackwardEuler);
        knows_none.then_some(NoDrive::MotorBy(self.solver))
    }
}

impl<const D: usize> Model<D> {
    /// What decides whether its bonds and angles can have drives.
    pub(crate) fn driving(&self) -> Driving {
        Driving {
            solver: self.method.solver,
            has_tolerance: self.method.tolerance.is_some(),
            is_in_space: D == 3,
            meets: self.contact.is_some() || !self.convex.is_empty(),
        }
    }
}
