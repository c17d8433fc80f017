//! How the bonds of a large body resist, and what that is in a substep of h.

use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::kernels::law::{Compliant, Elastic, Relaxed, Spring};
use crate::sim::kernels::path::PathLaw;
use crate::sim::kernels::store::Drift;
use crate::sim::real::Real;

/// What bonds of one kind have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spec {
    /// Rest length `[m]`.
    pub(crate) rest: f64,
    pub(crate) kind: BondKind,
    pub(crate) limit: Limit,
}

/// What a substep gives to bonds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Substep {
    /// Its length `[s]`.
    pub(crate) h: f64,
    /// The inverse mass that weights are relative to `[1/kg]`.
    pub(crate) reference: f64,
    /// Share of a relaxed bond's correction `[1]`: below 1 where the substep is cut short.
    pub(crate) share: f64,
    /// Strain above which a path gets another round `[1]`.
    pub(crate) tolerance: f64,
    /// Tension over strain at which rigid bonds give way `[N]`; infinite: they don't.
    pub(crate) tautness: f64,
    /// For how long springs push `[s]`; `None`: they are projected.
    pub(crate) kick: Option<f64>,
}

/// How a substep begins, and what it gives to bonds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start<S, const D: usize> {
    pub(crate) drift: Drift<S, D>,
    pub(crate) step: Substep,
}

/// How far two rest lengths may be apart to count as one, relative: what rounding makes of equal distances.
const SAME: f64 = 1e-12;

impl Spec {
    pub(crate) fn of(bond: &Bond) -> Self {
        Spec { rest: bond.rest_length, kind: bond.kind, limit: bond.limit }
    }

    /// Whether two bonds are alike but for rounding.
    pub(crate) fn is_like(&self, other: &Spec) -> bool {
        (self.rest - other.rest).abs() <= SAME * self.rest && self.is_of_kind(other)
    }

    /// Whether two bonds resist alike but for their rest lengths.
    pub(crate) fn is_of_kind(&self, other: &Spec) -> bool {
        self.kind == other.kind && self.limit == other.limit
    }

    /// Whether it keeps its length, neither less nor more.
    pub(crate) fn is_rod(&self) -> bool {
        self.kind == BondKind::Rigid && self.limit == Limit::Both
    }

    /// The law of a bond that is not rigid.
    pub(crate) fn elastic<S: Real>(&self, step: &Substep) -> Elastic<S> {
        match self.kind {
            BondKind::Spring { stiffness, damping } => match step.kick {
                Some(time) => Elastic::Spring(Spring {
                    strength: S::from_f64(stiffness * step.h * time * step.reference),
                    drag: S::from_f64(damping * time * step.reference),
                }),
                None => Elastic::Compliant(self.compliant(step)),
            },
            _ => Elastic::Relaxed(self.relaxed(step)),
        }
    }

    pub(crate) fn relaxed<S: Real>(&self, step: &Substep) -> Relaxed<S> {
        let (relaxation, limit) = match self.kind {
            BondKind::Relaxed { relaxation, max_correction } => (relaxation, max_correction),
            _ => (1.0, f64::INFINITY),
        };
        Relaxed {
            relaxation: S::from_f64(relaxation),
            least: S::from_f64(if self.limit == Limit::Min { 0.0 } else { -limit }),
            most: S::from_f64(if self.limit == Limit::Max { 0.0 } else { limit }),
            share: S::from_f64(step.share),
        }
    }

    pub(crate) fn compliant<S: Real>(&self, step: &Substep) -> Compliant<S> {
        let (alpha, gamma) = self.softness(step);
        Compliant { alpha: S::from_f64(alpha), gamma: S::from_f64(gamma) }
    }

    pub(crate) fn path<S: Real>(&self, step: &Substep) -> PathLaw<S> {
        let (alpha, gamma) = self.softness(step);
        PathLaw {
            alpha: S::from_f64(alpha / (1.0 + gamma)),
            share: S::from_f64(1.0 / (1.0 + gamma)),
            tolerance: S::from_f64(step.tolerance),
        }
    }

    /// alpha = 1/(stiffness h^2 w_0) and gamma = damping/(stiffness h).
    fn softness(&self, step: &Substep) -> (f64, f64) {
        match self.kind {
            BondKind::Spring { stiffness: 0.0, .. } => (f64::INFINITY, 0.0),
            BondKind::Spring { stiffness, damping } => {
                (1.0 / (stiffness * step.h * step.h * step.reference), damping / (stiffness * step.h))
            }
            _ => (self.rest / (step.tautness * step.h * step.h * step.reference), 0.0),
        }
    }
}
