//! A descent is made from a model: welds merged, lengths that contradict each other made to agree.

use super::descent::Descent;
use super::hold::Hold;
use crate::sim::bond::{Bond, BondKind, Limit, PointId};
use crate::sim::contact::surface::surfaces;
use crate::sim::force::spring::Spring;
use crate::sim::model::Model;
use crate::sim::plan::{inverse_masses, reconcile, weld};
use crate::sim::solve::blocks::Blocks;

impl<const D: usize> Descent<D> {
    pub(super) fn new(model: &Model<D>) -> Self {
        let w = inverse_masses(model);
        let stand_ins = weld::merge(&model.bonds, &w);
        let mut mass = vec![0.0; w.len()];
        let mut is_pinned = vec![false; w.len()];
        for (i, &stand_in) in stand_ins.iter().enumerate() {
            mass[stand_in as usize] += model.mass[i];
            is_pinned[stand_in as usize] |= w[i] == 0.0;
        }
        let mut x = model.position.clone();
        for (i, &stand_in) in stand_ins.iter().enumerate() {
            if w[i] == 0.0 {
                x[stand_in as usize] = model.position[i];
            }
        }
        let stands = |bond: &Bond| Bond {
            a: PointId(stand_ins[bond.a.index()]),
            b: PointId(stand_ins[bond.b.index()]),
            ..*bond
        };
        let mut bonds: Vec<Bond> = model.bonds.iter().map(stands).filter(|bond| bond.a != bond.b).collect();
        // Points that no bond holds have no equilibrium unless a surface stops them: they stay out of the system.
        let mut is_free = vec![false; w.len()];
        for end in bonds.iter().flat_map(|bond| [bond.a, bond.b]) {
            is_free[end.index()] = !is_pinned[end.index()];
        }
        let is_loose = |i: usize| stand_ins[i] as usize == i && !is_pinned[i] && !is_free[i];
        let has_loose = model.gravity.iter().any(|&g| g != 0.0) && (0..w.len()).any(is_loose);
        let held: Vec<f64> = is_free.iter().map(|&free| f64::from(u8::from(free))).collect();
        reconcile(&mut bonds, &mut x.clone(), &held);
        let of = |bond: &Bond| match bond.kind {
            BondKind::Rigid if is_free[bond.a.index()] || is_free[bond.b.index()] => {
                let hold = Hold::Bond { a: bond.a.index(), b: bond.b.index(), rest: bond.rest_length };
                Some((hold, bond.limit))
            }
            _ => None,
        };
        let holds: Vec<(Hold, Limit)> = bonds.iter().filter_map(of).collect();
        let rigid = holds.iter().filter(|hold| hold.1 == Limit::Both).map(|hold| hold.0).collect();
        let limited: Vec<(Hold, Limit)> = holds.into_iter().filter(|hold| hold.1 != Limit::Both).collect();
        let springs: Vec<Spring<f64>> = bonds.iter().filter_map(Spring::of).collect();
        let pairs: Vec<[u32; 2]> = springs.iter().map(|spring| [spring.a, spring.b]).collect();
        let mut descent = Descent {
            surfaces: surfaces(model),
            system: Blocks::new(&is_free, &[], &[]),
            gravity: model.gravity,
            pressed: Vec::new(),
            lambda: Vec::new(),
            work: Vec::new(),
            shift: 0.0,
            penalty: 0.0,
            residual: f64::INFINITY,
            is_done: false,
            has_loose,
            pushes: 0,
            stand_ins,
            x,
            mass,
            is_free,
            bonds,
            springs,
            pairs,
            rigid,
            limited,
        };
        descent.arrange();
        // Without tensions yet nothing tells a chain which way is down: the first steps go along the gradient.
        descent.shift = if descent.rigid.is_empty() { 0.0 } else { descent.stiffest() };
        descent
    }
}
