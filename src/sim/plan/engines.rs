//! The engine of a group: the integrator that its method asks for, and the more robust one behind it.

use super::choice::LONGEST_FINE;
use super::is_rigid;
use super::make::Maker;
use crate::sim::bond::{Bond, BondKind};
use crate::sim::constrain::order::Sweeper;
use crate::sim::constrain::relaxed::RelaxedBond;
use crate::sim::constrain::rigid::RigidBond;
use crate::sim::constrain::xpbd::CompliantBond;
use crate::sim::group::engine::Engine;
use crate::sim::integrate::composed::{COMPOSED_4, COMPOSED_6, SINGLE};
use crate::sim::integrate::implicit::Implicit;
use crate::sim::integrate::kick_drift::{KickDrift, Swept};
use crate::sim::integrate::runge_kutta::Stages;
use crate::sim::integrate::splitting::{self, Part, Splitting};
use crate::sim::integrate::tableau::{EULER, RK2, RK4, RK8, Tableau};
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::sizes::MOST_LOCATED;
use crate::sim::solver::Order;
use crate::sim::solver::Solver;

/// Share of the mean length of its bonds that a step of a checked method may be off by, and the same in roundings.
const MOST_ERROR: f64 = 1e-6;
const ROUNDED: f64 = 64.0;

impl<S: Real, const D: usize> Maker<'_, S, D> {
    pub(super) fn engine(
        &self,
        solver: Solver,
        bonds: &[(u32, Bond)],
        points: &Points<S, D>,
        pull: &Pull<S, D>,
    ) -> Engine<S, D> {
        let has_rigid = pull.rigid.is_some() || bonds.iter().any(|(_, bond)| bond.kind == BondKind::Rigid);
        let has_relaxed = bonds.iter().any(|(_, bond)| matches!(bond.kind, BondKind::Relaxed { .. }));
        let projects = has_rigid || has_relaxed;
        let split = |parts: Vec<Part>| Engine::Splitting(Splitting::new(parts));
        let kick_drift = |shares| Engine::KickDrift(self.kick_drift(bonds, points, pull, solver), shares);
        let runge_kutta = |table: &'static Tableau| {
            let sweeps = has_relaxed || (has_rigid && pull.rigid.is_none());
            let sweeps = sweeps.then(|| self.kick_drift(bonds, points, pull, solver));
            let stages = Stages::new(points.len() * D, table.stages.len());
            let stages = if self.lot.choice.plain.is_some() {
                stages.checked(self.most_error(bonds), self.lot.choice.substep)
            } else {
                stages
            };
            Engine::RungeKutta(table, stages, sweeps)
        };
        match solver {
            Solver::Euler => runge_kutta(&EULER),
            Solver::Rk2 => runge_kutta(&RK2),
            Solver::Rk4 => runge_kutta(&RK4),
            Solver::Rk8 => runge_kutta(&RK8),
            Solver::SymplecticEuler if !projects => split(splitting::symplectic_euler()),
            Solver::Flight if !projects && !pull.has_fields() => split(splitting::flight()),
            Solver::Auto | Solver::Flight | Solver::Verlet | Solver::VelocityVerlet if !projects => {
                split(splitting::verlet())
            }
            Solver::Pefrl if !projects => split(splitting::pefrl()),
            Solver::BlanesMoan4 if !projects => split(splitting::blanes_moan_4()),
            Solver::BlanesMoan6 if !projects => split(splitting::blanes_moan_6()),
            Solver::Pefrl | Solver::BlanesMoan4 => kick_drift(&COMPOSED_4),
            Solver::BlanesMoan6 => kick_drift(&COMPOSED_6),
            Solver::ImplicitMidpoint | Solver::BackwardEuler => {
                let midpoint = solver == Solver::ImplicitMidpoint;
                Engine::Implicit(Box::new(self.implicit(midpoint, bonds, points, pull)))
            }
            Solver::Xpbd | Solver::Path | Solver::Live => {
                let compliant = bonds.iter().filter_map(|(_, bond)| CompliantBond::of(bond, &points.inverse_mass));
                let mut compliant: Vec<CompliantBond<S>> = compliant.collect();
                let order = match self.model.method.order {
                    Order::Fixed | Order::Symmetric => self.model.method.order,
                    _ => Order::Coloured,
                };
                Sweeper::new(order, 0, &mut compliant, CompliantBond::ends, points.len());
                let sweeps = self.model.method.iterations.unwrap_or(1);
                Engine::Xpbd(compliant, sweeps, self.kick_drift(bonds, points, pull, solver))
            }
            _ => kick_drift(&SINGLE),
        }
    }

    fn kick_drift(
        &self,
        bonds: &[(u32, Bond)],
        points: &Points<S, D>,
        pull: &Pull<S, D>,
        solver: Solver,
    ) -> KickDrift<S, D> {
        let (method, w) = (&self.model.method, &points.inverse_mass);
        let sweeps_all = solver == Solver::Relaxation;
        let mut relaxed = Vec::new();
        let mut rigid = Vec::new();
        for (_, bond) in bonds {
            match bond.kind {
                BondKind::Rigid if !sweeps_all => rigid.extend(RigidBond::of(bond, w)),
                _ => relaxed.extend(RelaxedBond::of(bond, w)),
            }
        }
        if pull.rigid.is_some() || solver == Solver::Xpbd {
            rigid.clear();
        }
        KickDrift {
            swept: Swept {
                relaxed_order: Sweeper::new(method.order, method.seed, &mut relaxed, RelaxedBond::ends, w.len()),
                rigid_order: Sweeper::new(method.order, method.seed, &mut rigid, RigidBond::ends, w.len()),
                iterations: method.iterations.unwrap_or(1),
                nominal: self.lot.choice.substep,
                relaxed,
                rigid,
            },
            tally: None,
            kicks: if matches!(solver, Solver::SymplecticEuler | Solver::Xpbd) { [1.0, 0.0] } else { [0.5, 0.5] },
            holds_velocity: pull.rigid.is_some(),
            fresh: false,
            aimed: false,
        }
    }

    /// The largest error of a step that is let pass `[m]`, where it is asked for: a share of what the bonds are long, or what rounding makes; less
    /// of it where shorter substeps are asked for.
    fn most_error(&self, bonds: &[(u32, Bond)]) -> S {
        let total: f64 = bonds.iter().map(|(_, bond)| bond.rest_length).sum();
        let asked = self.model.method.substep.map_or(1.0, |h| (h / LONGEST_FINE).min(1.0).powi(4));
        let share = (asked * MOST_ERROR).max(ROUNDED * S::EPSILON.to_f64());
        S::from_f64(share * total / bonds.len().max(1) as f64)
    }

    /// The next more robust method: for rigid bonds projection along their new directions, for springs backward Euler,
    /// which nothing makes unstable.
    pub(super) fn robust(
        &self,
        bonds: &[(u32, Bond)],
        points: &Points<S, D>,
        pull: &Pull<S, D>,
    ) -> Option<Engine<S, D>> {
        let is_robust =
            matches!(self.lot.choice.solver, Solver::BackwardEuler | Solver::Xpbd | Solver::Relaxation | Solver::Live);
        if pull.rigid.is_some() {
            return Some(Engine::Projected);
        }
        let is_spring = |(_, bond): &(u32, Bond)| matches!(bond.kind, BondKind::Spring { .. });
        let is_bare = bonds.is_empty() && pull.form.is_empty();
        let is_fit =
            !(is_bare || pull.driven.has_motors()) && bonds.iter().all(is_spring) && points.len() <= MOST_LOCATED;
        (is_fit && !is_robust && pull.cushions.is_empty())
            .then(|| Engine::Implicit(Box::new(self.implicit(false, bonds, points, pull))))
    }

    fn implicit(
        &self,
        is_midpoint: bool,
        bonds: &[(u32, Bond)],
        points: &Points<S, D>,
        pull: &Pull<S, D>,
    ) -> Implicit<S, D> {
        let w: Vec<f64> = points.inverse_mass.iter().map(|w| w.to_f64()).collect();
        let rigid = bonds.iter().filter(|(_, bond)| is_rigid(bond, &w));
        let rigid = rigid.map(|(_, bond)| (bond.a, bond.b, S::from_f64(bond.rest_length))).collect();
        let areas = if self.holds_areas() { self.patches() } else { Vec::new() };
        let areas = areas.into_iter().map(|(corners, area)| (corners, S::from_f64(area))).collect();
        Implicit::new(is_midpoint, &points.inverse_mass, (&pull.springs, &pull.form), (rigid, areas))
    }
}
