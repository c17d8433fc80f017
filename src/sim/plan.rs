//! What a scene needs, compiled: a phase that is not in the plan costs nothing.

use super::bond::BondKind;
use super::constrain::order::Sweeper;
use super::constrain::relaxed::RelaxedBond;
use super::constrain::rigid::RigidBond;
use super::force::spring::Spring;
use super::model::{Model, Solver};
use super::real::Real;

/// Bonds sorted by what moves them, and the substep. Made anew when topology or method changes, not in a step.
#[derive(Clone, Debug)]
pub(crate) struct Plan<S> {
    /// Bonds that are forces.
    pub(crate) springs: Vec<Spring<S>>,
    /// Whether any spring has a damper, so that forces depend on velocities.
    pub(crate) is_damped: bool,
    /// Bonds that are swept `iterations` times, in the order of `relaxed_order`.
    pub(crate) relaxed: Vec<RelaxedBond<S>>,
    pub(crate) relaxed_order: Sweeper,
    /// Sweeps over the relaxed bonds in a substep.
    pub(crate) iterations: u32,
    /// Bonds that are swept until they hold.
    pub(crate) rigid: Vec<RigidBond<S>>,
    pub(crate) rigid_order: Sweeper,
    /// Longest substep [s].
    pub(crate) substep: f64,
}

impl<S: Real> Plan<S> {
    /// Compiles the plan of a model whose points have these inverse masses.
    pub(crate) fn new<const D: usize>(model: &Model<D>, inverse_mass: &[S]) -> Self {
        let (method, points) = (&model.method, inverse_mass.len());
        let sweeps_all = method.solver == Solver::Relaxation;
        let springs: Vec<Spring<S>> = model.bonds.iter().filter_map(Spring::of).collect();
        let mut relaxed = Vec::new();
        let mut rigid = Vec::new();
        for bond in &model.bonds {
            match bond.kind {
                BondKind::Rigid if !sweeps_all => rigid.extend(RigidBond::of(bond, inverse_mass)),
                _ => relaxed.extend(RelaxedBond::of(bond, inverse_mass)),
            }
        }
        let (order, seed) = (method.order, method.seed);
        Plan {
            is_damped: springs.iter().any(Spring::is_damped),
            relaxed_order: Sweeper::new(order, seed, &mut relaxed, RelaxedBond::ends, points),
            rigid_order: Sweeper::new(order, seed, &mut rigid, RigidBond::ends, points),
            iterations: method.iterations.unwrap_or(1),
            substep: method.substep.unwrap_or_else(|| automatic_substep(model)),
            springs,
            relaxed,
            rigid,
        }
    }

    /// Whether anything moves points other than forces and velocities.
    pub(crate) fn projects(&self) -> bool {
        !self.relaxed.is_empty() || !self.rigid.is_empty()
    }
}

/// The frame that automatic substeps divide [s].
const FRAME: f64 = 1.0 / 60.0;
/// Largest substep where nothing is fast [s]: what a thrown point or a swinging rope needs to look smooth.
const LONGEST: f64 = FRAME / 4.0;
/// Largest substep with rigid bonds [s]: a rope stays within 1e-3 of its path for a second or two.
const LONGEST_RIGID: f64 = FRAME / 16.0;
/// Largest angle in radians that the fastest oscillation may turn in a substep. Verlet's period is then off by
/// 0.25^2/24 = 0.26 %; 2 would be the edge of stability.
const PHASE: f64 = 0.25;
/// Most substeps that one frame is cut into: beyond, a scene is stiffer than explicit steps can serve.
const MOST_SUBSTEPS: f64 = 100_000.0;

/// The substep that resolves the fastest motion of the scene: a whole part of 1/60 s.
///
/// The fastest oscillation is bounded by Gershgorin's circles, omega^2 <= max over points of 2 w_i sum of stiffness,
/// w_i = 1/m_i; the fastest decay likewise with damping.
fn automatic_substep<const D: usize>(model: &Model<D>) -> f64 {
    let mut stiffness = vec![0.0; model.mass.len()];
    let mut damping = vec![0.0; model.mass.len()];
    let mut has_rigid = false;
    for bond in &model.bonds {
        match bond.kind {
            BondKind::Spring { stiffness: k, damping: c } => {
                for end in [bond.a, bond.b] {
                    stiffness[end.index()] += k;
                    damping[end.index()] += c;
                }
            }
            _ => has_rigid = true,
        }
    }
    let fastest = |sums: &[f64]| sums.iter().zip(&model.mass).map(|(sum, m)| 2.0 * sum / m).fold(0.0, f64::max);
    let push = model.mouse.as_ref().map_or(0.0, |mouse| mouse.strength.abs());
    let rate = fastest(&stiffness).max(push).sqrt().max(fastest(&damping));
    let longest = if has_rigid { LONGEST_RIGID } else { LONGEST };
    let wanted = if rate > 0.0 { longest.min(PHASE / rate) } else { longest };
    FRAME / (FRAME / wanted).ceil().min(MOST_SUBSTEPS)
}
