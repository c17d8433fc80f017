//! The force in a rigid bond, from the state as it is: what keeps its length.

use super::World;
use crate::sim::bond::{Bond, BondKind, Limit, PointId};
use crate::sim::constrain::direct::Direct;
use crate::sim::constrain::shape::{Row, Shape};
use crate::sim::contact::Contacts;
use crate::sim::counters::Counters;
use crate::sim::force::spring::Springs;
use crate::sim::group::engine::Engine;
use crate::sim::real::Real;
use crate::sim::sizes::MOST_DIRECT;
use crate::sim::solver::Solver;
use crate::sim::vector::zero;

impl<S: Real, const D: usize> World<S, D> {
    /// The force by which a rigid bond, by its place in the list, pulls its ends together `[N]`; below 0 it pushes.
    ///
    /// Model: G W G^T lambda = -(G a + |v_a - v_b|^2), a by all forces but those of rigid bonds; the force is -lambda |d|. `None` where that is
    /// not known: of bodies that meet or lie on something, of methods that sweep, of bonds that are driven or act on one side, and of
    /// a frame that is braced more than it takes, whose bonds share a force in ways that no state tells.
    pub(super) fn tension(&self, place: usize) -> Option<f64> {
        let bond = self.bonds.iter().nth(place)?;
        let [group, _] = self.slot(bond.a.index())?;
        let own = self.plan.groups.get(group)?;
        let solver = self.plan.own.get(group)?.solver;
        let swept = matches!(solver, Solver::Live | Solver::Relaxation | Solver::AsPrinted(_) | Solver::Xpbd);
        if bond.kind != BondKind::Rigid || swept || own.is_live() || !own.pull.contacts.is_idle() {
            return None;
        }
        if let Engine::Bulk(bulk) = &own.engine {
            // What it knows of surfaces, angles and grabs by itself is not seen from here.
            let is_apart =
                own.pull.contacts.obstacles.has_walls() || own.grabbed.is_some() || !self.model.angles.list.is_empty();
            if is_apart || self.model.areas.is_some() || bulk.lag() != 0.0 {
                return None;
            }
        }
        let bonds: Vec<Bond> = self.bonds.iter().filter_map(|bond| self.between_slots(bond, group)).collect();
        let is_odd = |bond: &Bond| {
            let is_rigid = bond.kind == BondKind::Rigid && (bond.limit != Limit::Both || bond.drive.is_some());
            is_rigid || matches!(bond.kind, BondKind::Relaxed { .. })
        };
        let w = &own.points.inverse_mass;
        let rows: Vec<Row<S>> = bonds.iter().filter_map(|bond| row(bond, w)).collect();
        if bonds.iter().any(is_odd) || rows.len() > MOST_DIRECT {
            return None;
        }
        let ends = self.between_slots(bond, group).map(|bond| [bond.a.0, bond.b.0])?;
        let (x, v) = (&own.points.position, &own.points.velocity);
        let mut pull = own.pull.clone();
        pull.springs = Springs::new(bonds.iter(), own.points.len());
        let mut a = vec![zero(); own.points.len()];
        pull.act(&self.around, self.timeline.time(), (x, v, w), &mut a, &mut Counters::default());
        let mut direct = Direct::new(Shape::new(rows, Vec::new(), own.points.len()));
        let contacts = Contacts::new(&own.pull.contacts.obstacles, own.points.len());
        direct.bond_force(ends, (x, v), &mut a, &contacts)
    }

    /// A bond between places of a group, if it is of it.
    fn between_slots(&self, bond: Bond, group: usize) -> Option<Bond> {
        let slot = |point: PointId| self.slot(point.index()).filter(|slot| slot[0] == group);
        let place = |slot: [usize; 2]| PointId(slot[1] as u32);
        Some(Bond { a: place(slot(bond.a)?), b: place(slot(bond.b)?), ..bond })
    }
}

fn row<S: Real>(bond: &Bond, w: &[S]) -> Option<Row<S>> {
    let [w_a, w_b] = [bond.a, bond.b].map(|end| w[end.index()]);
    let rest = S::from_f64(bond.rest_length);
    (bond.kind == BondKind::Rigid && bond.a != bond.b && w_a + w_b > S::ZERO && rest > S::ZERO).then(|| Row {
        a: bond.a.0,
        b: bond.b.0,
        w_a,
        w_b,
        rest_length: rest,
        inverse_square: S::ONE / (rest * rest),
        limit: Limit::Both,
        is_taut: true,
    })
}
