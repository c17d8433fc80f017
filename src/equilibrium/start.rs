//! A model is taken apart: welds merged, lengths that contradict each other made to agree, islands numbered anew.

use super::hold::{Grip, Hold};
use super::part::Part;
use crate::sim::bond::{Bond, BondKind, Limit, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::contact::geometry::Geometry;
use crate::sim::force::angle::Hinge;
use crate::sim::force::area::Patch;
use crate::sim::force::form::Form;
use crate::sim::force::spring::Spring;
use crate::sim::force::steady::{Force, Thrust};
use crate::sim::model::Model;
use crate::sim::plan::island::{Island, Patched, Ties, islands_joined};
use crate::sim::plan::{inverse_masses, reconcile, ties, weld};
use crate::sim::vector::{add, scale};

/// A model in parts.
pub(super) struct Start<const D: usize> {
    /// For every point of the model the one that it is welded to.
    pub(super) representatives: Vec<u32>,
    /// Positions of those at the start `[m]`.
    pub(super) position: Vec<[f64; D]>,
    /// The islands.
    pub(super) parts: Vec<Part<D>>,
}

impl<const D: usize> Start<D> {
    pub(super) fn new(model: &Model<D>) -> Self {
        let w = inverse_masses(model);
        let representatives = weld::merge(&model.bonds, &w);
        let mut mass = vec![0.0; w.len()];
        let mut is_pinned = vec![false; w.len()];
        let mut position = model.position.clone();
        for (i, &representative) in representatives.iter().enumerate() {
            mass[representative as usize] += model.mass[i];
            if w[i] == 0.0 {
                is_pinned[representative as usize] = true;
                position[representative as usize] = model.position[i];
            }
        }
        let merged = |bond: Bond| Bond {
            a: PointId(representatives[bond.a.index()]),
            b: PointId(representatives[bond.b.index()]),
            ..bond
        };
        let mut bonds: Bonds = model.bonds.iter().filter(acts).map(merged).collect();
        bonds.retain(|bond| bond.a != bond.b);
        // Pins, and points that another one stands for, are in no island.
        let is_in = |i: usize| representatives[i] as usize == i && !is_pinned[i];
        let held: Vec<f64> = (0..w.len()).map(|i| f64::from(u8::from(is_in(i)))).collect();
        reconcile(&mut bonds, &mut position.clone(), &held);
        let (drives, pairs) = drives(model, &w, &representatives);
        let ties = ties(model, &representatives, |i| position[i]);
        let list = islands_joined(&bonds, &ties, &held, &pairs);
        let parts = list
            .iter()
            .map(|island| part((model, &drives), island, (&bonds, &ties), &mass, &position, &held))
            .collect();
        Start { parts, representatives, position }
    }
}

/// A constant force: on the masses `[kg]` of these points `[m/s^2]`, and its torque `[N m]`.
struct Drive<const D: usize> {
    masses: Vec<(u32, f64)>,
    acceleration: [f64; D],
    torque: f64,
}

/// The constant forces, on points that stand for others, and which of these torques hold together.
fn drives<const D: usize>(model: &Model<D>, w: &[f64], representatives: &[u32]) -> (Vec<Drive<D>>, Vec<[u32; 2]>) {
    let of = |force: &Force<D>| {
        let members = force.members();
        let free = members.iter().map(|point| point.index()).filter(|&i| w[i] > 0.0);
        let mut masses: Vec<(u32, f64)> = free.map(|i| (representatives[i], model.mass[i])).collect();
        masses.sort_unstable_by_key(|entry| entry.0);
        masses.dedup_by(|other, kept| {
            let is_one = other.0 == kept.0;
            kept.1 += if is_one { other.1 } else { 0.0 };
            is_one
        });
        let mass: f64 = masses.iter().map(|entry| entry.1).sum();
        let acceleration = if mass > 0.0 { scale(force.force, 1.0 / mass) } else { [0.0; D] };
        Drive { masses, acceleration, torque: force.torque }
    };
    let drives: Vec<Drive<D>> = model.forces.iter().map(of).collect();
    let turned = drives.iter().filter(|drive| drive.torque != 0.0);
    let pairs = turned.flat_map(|drive| drive.masses.windows(2).map(|pair| [pair[0].0, pair[1].0])).collect();
    (drives, pairs)
}

/// Whether a bond does anything at some length.
fn acts(bond: &Bond) -> bool {
    match bond.kind {
        BondKind::Spring { stiffness, .. } => stiffness > 0.0,
        _ => bond.limit != Limit::Min || bond.rest_length > 0.0,
    }
}

/// One island: its free points first, then the pins that it hangs from.
fn part<const D: usize>(
    (model, drives): (&Model<D>, &[Drive<D>]),
    island: &Island,
    (bonds, ties): (&Bonds, &Ties),
    mass: &[f64],
    position: &[[f64; D]],
    held: &[f64],
) -> Part<D> {
    let mut pins: Vec<u32> = Vec::new();
    let own = || island.bonds.iter().map(|&k| bonds.get(k as usize));
    let angles = || island.angles.iter().map(|&k| &ties.angles[k as usize]);
    let patches = || island.patches.iter().map(|&k| &ties.patches[k as usize]);
    let tied = angles().map(|angle| angle.points).chain(patches().map(|patch| patch.corners)).flatten();
    let ends = own().flat_map(|bond| [bond.a, bond.b]).chain(tied).map(|point| point.0);
    pins.extend(ends.filter(|&i| held[i as usize] == 0.0));
    pins.sort_unstable();
    pins.dedup();
    let place = |i: PointId| {
        let list = if held[i.index()] > 0.0 { (&island.points, 0) } else { (&pins, island.points.len()) };
        PointId((list.1 + list.0.binary_search(&i.0).unwrap_or(0)) as u32)
    };
    let placed = |points: [PointId; 3]| points.map(|point| place(point).0);
    let patch = |patch: &Patched| Patch { corners: placed(patch.corners), rest: patch.rest, stiffness: ties.stiffness };
    let form = Form {
        hinges: angles().map(|angle| Hinge::new(angle, placed(angle.points))).collect(),
        patches: patches().map(patch).collect(),
    };
    let bonds = own().map(|bond| Bond { a: place(bond.a), b: place(bond.b), ..bond });
    let (rigid, springs): (Bonds, Bonds) = bonds.partition(|bond| bond.kind == BondKind::Rigid);
    let surfaces = Geometry::from(model).surfaces();
    let bond = |bond: Bond| {
        let grip = Grip::Bond { a: bond.a.index(), b: bond.b.index(), rest: bond.rest_length };
        Hold::new(grip, bond.limit)
    };
    let touch =
        |point: usize| (0..surfaces.len()).map(move |surface| Hold::new(Grip::Surface { point, surface }, Limit::Min));
    let holds = rigid.iter().map(bond).chain((0..island.points.len()).flat_map(touch)).collect();
    let members: Vec<u32> = island.points.iter().chain(&pins).copied().collect();
    let mut pushes = vec![[0.0; D]; members.len()];
    let mut torques = Vec::new();
    for drive in drives {
        let mut torque = Thrust { slots: vec![], shares: vec![], acceleration: [0.0; D], torque: drive.torque };
        for &(point, own) in &drive.masses {
            if let Ok(place) = island.points.binary_search(&point) {
                pushes[place] = add(pushes[place], scale(drive.acceleration, own));
                torque.slots.push(place as u32);
                torque.shares.push(own / mass[point as usize]);
            }
        }
        torques.extend((torque.torque != 0.0 && !torque.slots.is_empty()).then_some(torque));
    }
    Part {
        pushes,
        torques,
        position: members.iter().map(|&i| position[i as usize]).collect(),
        mass: members.iter().map(|&i| mass[i as usize]).collect(),
        is_free: members.iter().map(|&i| held[i as usize] > 0.0).collect(),
        gravity: model.field(),
        springs: springs.iter().filter_map(|bond| Spring::of(&bond)).collect(),
        bonds: springs,
        form,
        holds,
        surfaces,
        members,
    }
}
