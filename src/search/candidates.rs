//! Methods that fit what a scene is made of.

use crate::sim::bond::{BondKind, Limit};
use crate::sim::build::build;
use crate::sim::dynamics::Dynamics;
use crate::sim::model::Model;
use crate::sim::plan::islands_of;
use crate::sim::sizes::MOST_DIRECT;
use crate::sim::solver::Solver;

/// What a search tries.
pub(super) struct Candidates {
    /// What makes the reference: the second where the first fails.
    pub(super) references: Vec<Solver>,
    /// What is compared, the likeliest first.
    pub(super) solvers: Vec<Solver>,
}

/// What rigid bonds are held by: the first where the rules cut its steps by their errors.
const FOR_RIGID: [Solver; 6] =
    [Solver::Auto, Solver::Rk8, Solver::Rk4, Solver::VelocityVerlet, Solver::Pefrl, Solver::BlanesMoan6];

/// The candidates for a model; a solver that it says is the only one.
pub(super) fn of<const D: usize>(model: &Model<D>) -> Candidates {
    if model.method.solver != Solver::Auto {
        return Candidates { references: vec![model.method.solver], solvers: vec![model.method.solver] };
    }
    let is = |of: fn(&BondKind) -> bool| model.bonds.iter().any(|bond| of(&bond.kind));
    let holds_areas = model.areas.is_some_and(|areas| areas.is_rigid()) && !model.triangles.is_empty();
    let is_rigid = is(|kind| *kind == BondKind::Rigid) || holds_areas;
    let is_damped = is(|kind| matches!(kind, BondKind::Spring { damping, .. } if *damping > 0.0))
        || model.angles.list.iter().any(|angle| angle.damping > 0.0);
    let has_limits = model.bonds.iter().any(|bond| bond.limit != Limit::Both);
    let has_surfaces = model.has_surfaces();
    let (references, solvers): (&[Solver], &[Solver]) = if model.bonds.is_empty()
        && model.ties().next().is_none()
        && !has_surfaces
        && model.mouse.is_none()
        && !model.has_fields()
    {
        (&[Solver::Flight], &[Solver::Flight])
    } else if is_rigid {
        of_rigid(model)
    } else if is_damped || has_surfaces || model.mouse.is_some() || has_limits {
        (
            &[Solver::Rk8, Solver::ImplicitMidpoint],
            &[Solver::Rk8, Solver::Rk4, Solver::VelocityVerlet, Solver::ImplicitMidpoint],
        )
    } else {
        (
            &[Solver::BlanesMoan6, Solver::ImplicitMidpoint],
            &[
                Solver::BlanesMoan6,
                Solver::BlanesMoan4,
                Solver::Pefrl,
                Solver::VelocityVerlet,
                Solver::Rk8,
                Solver::ImplicitMidpoint,
            ],
        )
    };
    Candidates { references: references.to_vec(), solvers: solvers.to_vec() }
}

/// The candidates where bonds or areas are rigid.
fn of_rigid<const D: usize>(model: &Model<D>) -> (&'static [Solver], &'static [Solver]) {
    let solvers = |world: Box<dyn Dynamics>| world.parts().iter().map(|part| part.solver).collect::<Vec<_>>();
    let moved = build(model).ok().map(solvers);
    let is_all = |solver: Solver| moved.as_ref().is_some_and(|all| all.iter().all(|by| *by == solver));
    let is_there = |solver: Solver| moved.as_ref().is_some_and(|all| all.contains(&solver));
    // No other method has the friction of rigid bodies.
    if is_all(Solver::Rigid) {
        (&[Solver::Auto], &[Solver::Auto])
    } else if islands_of(model).iter().any(|island| island.rigid > MOST_DIRECT) {
        (&[Solver::Verlet], &[Solver::Verlet])
    } else if is_there(Solver::Rk8) {
        // What `auto` moves by order 8 is cut by its errors too.
        (&[Solver::Auto, Solver::Rk8, Solver::Pefrl], &FOR_RIGID)
    } else {
        (&[Solver::Rk8, Solver::Pefrl], &FOR_RIGID[1..])
    }
}
