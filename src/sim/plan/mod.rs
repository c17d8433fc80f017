//! What a scene needs, compiled when bonds or the method change, never in a step: welds, islands, groups of islands
//! that one method moves, and where every point is found.

mod bulk;
pub(crate) mod choice;
mod clear;
mod cost;
mod drive;
mod engines;
mod fit;
mod gather;
mod idle;
pub(crate) mod island;
mod live;
mod lot;
mod make;
mod precision;
mod printed;
mod reconcile;
mod rigid;
pub(crate) mod structure;
mod taut;
pub(crate) mod weld;

use super::bond::{Bond, BondKind};
use super::bonds::Bonds;
use super::contact::obstacles::Obstacles;
use super::group::Group;
use super::model::Model;
use super::plan_part::PlanPart;
use super::points::State;
use super::real::Real;
use super::sizes::MOST_DIRECT;
use super::solver::Solver;
use gather::Gathered;
use lot::Lot;

pub(crate) use super::sets::Sets;
pub(crate) use clear::{Cleared, clear};
pub(crate) use drive::gust_rate;
pub(crate) use fit::{Fitted, fit_rest_lengths};
pub(crate) use gather::{NOWHERE, fixtures, ties};
pub(crate) use idle::idle_drives;
pub(crate) use lot::OWN;
pub(crate) use precision::is_single;
pub(crate) use reconcile::reconcile;

/// Groups with what moves them, and where every point of the model is.
#[derive(Clone, Debug)]
pub(crate) struct Plan<S: Real, const D: usize> {
    pub(crate) groups: Vec<Group<S, D>>,
    /// For every point of the model: its group and its place there; empty where the plan is plain.
    pub(crate) slots: Vec<[u32; 2]>,
    /// Every point lies in the first group at its own index.
    pub(crate) is_plain: bool,
    /// Longest substep of the world `[s]`; groups with shorter ones take several.
    pub(crate) substep: f64,
    /// What the groups are, for those who ask.
    pub(crate) parts: Vec<PlanPart>,
    /// The same of each group by itself.
    pub(crate) own: Vec<PlanPart>,
}

impl PlanPart {
    /// The class of a lot, whose bonds and islands are still to be counted.
    fn of(lot: &Lot) -> Self {
        PlanPart {
            solver: lot.choice.solver,
            substep: lot.choice.substep,
            points: 0,
            bonds: 0,
            islands: 0,
            work: 0.0,
            kernel: String::new(),
            max_strain: lot.choice.bulk.and_then(|scheme| scheme.target),
        }
    }

    /// Counts another part of the same class in.
    fn include(&mut self, other: &PlanPart) {
        self.points += other.points;
        self.bonds += other.bonds;
        self.islands += other.islands;
        self.work += other.work;
    }

    fn is_like(&self, other: &PlanPart) -> bool {
        (self.solver, &self.kernel, self.max_strain) == (other.solver, &other.kernel, other.max_strain)
            && self.substep.to_bits() == other.substep.to_bits()
    }

    /// The parts of groups, those that are alike as one, in the order of the first of each.
    pub(crate) fn sum(own: &[PlanPart]) -> Vec<PlanPart> {
        let mut parts: Vec<PlanPart> = Vec::new();
        for part in own.iter().filter(|part| part.points > 0) {
            match parts.iter_mut().find(|sum| sum.is_like(part)) {
                Some(sum) => sum.include(part),
                None => parts.push(part.clone()),
            }
        }
        parts
    }
}

/// Compiles the plan of a model whose bonds (those that are left, with their numbers in the world) and state are these.
///
/// Shapes: `state` has one entry a point of the model, `numbers` one a bond; `None`: a bond has its own place for a number. `live`
/// says of every point whether the live step has to move its island, whatever the rules say, [`lot::OWN`]: it has not; islands with the
/// same number go together where bodies may meet. Empty: of none.
pub(crate) fn compile<S: Real, const D: usize>(
    (model, obstacles, scene_points): (&Model<D>, &Obstacles<S, D>, usize),
    (bonds, numbers): (&Bonds, Option<&[u32]>),
    state: &State<S, D>,
    live: &[u32],
) -> Plan<S, D> {
    let w = inverse_masses(model);
    let stand_ins = match model.method.solver {
        Solver::Relaxation | Solver::AsPrinted(_) => (0..w.len() as u32).collect(),
        _ => weld::merge(bonds, &w),
    };
    let mut gathered = Gathered::new(model, (bonds, numbers), &w, &stand_ins, state);
    let pairs = gathered.drives.pairs(model);
    let mut islands = island::islands_joined(&gathered.bonds, &gathered.ties, &gathered.w, &pairs);
    // An island stays whole: what holds its points may go.
    if model.is_live() || model.method.solver.solves_directly() {
        gathered.hold_taut(model);
    }
    gathered.drives.mark(&mut islands);
    drive::press(model, &mut islands);
    rigid::mark(&gathered, (model, !obstacles.is_empty()), &mut islands);
    gathered.plan((model, obstacles), lot::lots(model, (!obstacles.is_empty(), scene_points), islands, live))
}

/// The islands of a model.
pub(crate) fn islands_of<const D: usize>(model: &Model<D>) -> Vec<island::Island> {
    if let Some((rest_areas, angles)) = model.form_missing() {
        return islands_of(&Model { rest_areas, angles, ..model.clone() });
    }
    let own: Vec<u32> = (0..model.mass.len() as u32).collect();
    island::islands(&model.bonds, &ties(model, &own, |i| model.position[i]), &inverse_masses(model))
}

/// The largest number of rigid bonds and areas of a body whose areas are to be held and cannot be, and how many could be.
pub(crate) fn too_many_held<const D: usize>(model: &Model<D>) -> Option<[usize; 2]> {
    if model.is_live() || !model.areas.is_some_and(|areas| areas.is_rigid()) {
        return None;
    }
    let is_over = |island: &island::Island| island.holds_areas && !choice::can_be_direct(island);
    islands_of(model).iter().filter(|island| is_over(island)).map(|island| [island.rigid, MOST_DIRECT]).max()
}

/// Whether a body of so many rigid bonds is solved for directly, which keeps their lengths to rounding.
pub(crate) const fn is_direct(rigid: usize) -> bool {
    rigid <= MOST_DIRECT
}

/// 1/m of every point, 0 where it is pinned.
pub(crate) fn inverse_masses<const D: usize>(model: &Model<D>) -> Vec<f64> {
    let mut w: Vec<f64> = model.mass.iter().map(|m| 1.0 / m).collect();
    for point in &model.pinned {
        w[point.index()] = 0.0;
    }
    w
}

/// Whether a bond is a rigid one of a group that moves: not between two points that cannot.
fn is_rigid(bond: &Bond, w: &[f64]) -> bool {
    bond.kind == BondKind::Rigid && w[bond.a.index()] + w[bond.b.index()] > 0.0
}
