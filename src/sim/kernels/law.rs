//! How a bond moves its ends: what a kernel is specialised for.

use fearless_simd::{Select, Simd, SimdBase, SimdFloat};

use super::lanes::{Lanes, splat};
use crate::sim::real::Real;

/// A way to correct the length of a bond.
///
/// With e = x_a - x_b at the end of the substep (of a force: at its start) the ends move by w_a f e and -w_b f e; the law says f.
pub(crate) trait Law<S: Real>: Copy + Send + Sync {
    /// Whether the law looks at `closing`.
    const IS_DAMPED: bool;

    /// Whether the bond is looked at as it was at the start of the substep: its law is a force.
    #[inline(always)]
    fn is_force(&self) -> bool {
        false
    }

    /// f, lane by lane.
    ///
    /// Lanes with a bond of length 0 have no direction: whatever f they get that is finite moves nothing.
    fn factor<M: Simd>(&self, m: M, bond: &Measured<M, S>) -> Lanes<M, S>;
}

/// What a law looks at, lane by lane.
pub(crate) struct Measured<M: Simd, S: Real> {
    /// Rest length `[m]`.
    pub(crate) rest: Lanes<M, S>,
    /// e . e `[m^2]`.
    pub(crate) square: Lanes<M, S>,
    /// w_a + w_b > 0.
    pub(crate) sum: Lanes<M, S>,
    /// e . (d_a - d_b) `[m^2]`; only where the law is damped.
    pub(crate) closing: Lanes<M, S>,
}

/// |e| = rest.
///
/// f = (rest^2 - e.e)/((rest^2 + e.e)(w_a + w_b)): Newton's step for the square root, from the rest length. It leaves a
/// strain of about half the square of the one that it finds, and needs one division and no root.
/// Source: T. Jakobsen, Advanced Character Physics, GDC 2001, with masses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rigid;

impl<S: Real> Law<S> for Rigid {
    const IS_DAMPED: bool = false;

    #[inline(always)]
    fn factor<M: Simd>(&self, _: M, bond: &Measured<M, S>) -> Lanes<M, S> {
        let rest = bond.rest * bond.rest;
        (rest - bond.square) / ((rest + bond.square) * bond.sum)
    }
}

/// A share of the error, held to limits, as [`BondKind::Relaxed`](crate::sim::BondKind::Relaxed) is defined:
/// f (w_a + w_b) = relaxation (rest/|e| - 1) in [least, most].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Relaxed<S> {
    pub(crate) relaxation: S,
    pub(crate) least: S,
    pub(crate) most: S,
    /// Share of the correction that a substep cut short takes `[1]`.
    pub(crate) share: S,
}

impl<S: Real> Law<S> for Relaxed<S> {
    const IS_DAMPED: bool = false;

    #[inline(always)]
    fn factor<M: Simd>(&self, m: M, bond: &Measured<M, S>) -> Lanes<M, S> {
        let error = splat(m, self.relaxation) * (bond.rest / bond.square.sqrt() - splat(m, S::ONE));
        let held = error.max(splat(m, self.least)).min(splat(m, self.most)) * splat(m, self.share);
        let zero = splat(m, S::ZERO);
        bond.square.simd_gt(zero).select(held / bond.sum, zero)
    }
}

/// A spring by compliant projection, one sweep a substep: lambda = -(C + gamma n . (d_a - d_b))/((1 + gamma)(w_a + w_b)
/// + alpha), C = |e| - rest, f = lambda/|e|.
///
/// Source: M. Macklin, M. Mueller, N. Chentanez, XPBD, Motion in Games 2016, eq. (26) with lambda = 0 at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Compliant<S> {
    /// 1/(stiffness h^2 w_0) `[1]`.
    pub(crate) alpha: S,
    /// damping/(stiffness h) `[1]`.
    pub(crate) gamma: S,
}

impl<S: Real> Law<S> for Compliant<S> {
    const IS_DAMPED: bool = true;

    #[inline(always)]
    fn factor<M: Simd>(&self, m: M, bond: &Measured<M, S>) -> Lanes<M, S> {
        let (zero, one, gamma) = (splat(m, S::ZERO), splat(m, S::ONE), splat(m, self.gamma));
        let top = bond.square - bond.rest * bond.square.sqrt() + gamma * bond.closing;
        let bottom = ((one + gamma) * bond.sum + splat(m, self.alpha)) * bond.square;
        bond.square.simd_gt(zero).select(-top / bottom, zero)
    }
}

/// The force of a spring and its damper for the time of a kick t: f = -h t (stiffness (1 - rest/|e|) + damping v_n/|e|),
/// v_n = n . (d_a - d_b)/h as the displacements are when the bond's turn comes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spring<S> {
    /// stiffness h t w_0 `[1]`.
    pub(crate) strength: S,
    /// damping t w_0 `[1]`.
    pub(crate) drag: S,
}

impl<S: Real> Law<S> for Spring<S> {
    const IS_DAMPED: bool = true;

    #[inline(always)]
    fn is_force(&self) -> bool {
        true
    }

    #[inline(always)]
    fn factor<M: Simd>(&self, m: M, bond: &Measured<M, S>) -> Lanes<M, S> {
        let (zero, one) = (splat(m, S::ZERO), splat(m, S::ONE));
        let pull = splat(m, self.strength) * (one - bond.rest / bond.square.sqrt());
        let brake = splat(m, self.drag) * bond.closing / bond.square;
        bond.square.simd_gt(zero).select(-(pull + brake), zero)
    }
}

/// A bond that is not rigid: of all such laws one kernel is compiled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Elastic<S> {
    Relaxed(Relaxed<S>),
    Compliant(Compliant<S>),
    Spring(Spring<S>),
}

impl<S: Real> Law<S> for Elastic<S> {
    const IS_DAMPED: bool = true;

    #[inline(always)]
    fn is_force(&self) -> bool {
        matches!(self, Elastic::Spring(_))
    }

    #[inline(always)]
    fn factor<M: Simd>(&self, m: M, bond: &Measured<M, S>) -> Lanes<M, S> {
        match self {
            Elastic::Relaxed(law) => law.factor(m, bond),
            Elastic::Compliant(law) => law.factor(m, bond),
            Elastic::Spring(law) => law.factor(m, bond),
        }
    }
}
