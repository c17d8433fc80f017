//! Springs that get stiffer are led there: what they bear is lifted, not thrown.

use super::extent::place;
use crate::history::{Do, OneOrEach, SetKeys};
use crate::scene::KindName;
use crate::sim::vector::{length, sub};
use crate::sim::{BondKind, Dynamics};

/// So long stiffer springs take to be there, and the mass of what becomes another matter with them `[s]`.
const OVER: f64 = 0.5;

/// Springs that are no longer or shorter than this share of their lengths at rest store next to nothing `[1]`: they are as stiff at once.
const STILL: f64 = 0.01;

/// Commands of one change: where springs that are loaded get stiffer by it, they and the masses are led there. What was only just built is
/// what it becomes before time goes on.
pub(in crate::app) fn led(world: &dyn Dynamics, mut commands: Vec<Do>) -> Vec<Do> {
    let is_loaded = |act: &Do| matches!(act, Do::Set(keys) if gets_stiffer(world, keys, STILL));
    if !commands.iter().any(is_loaded) {
        return commands;
    }
    for act in &mut commands {
        if let Do::Set(keys) = act
            && keys.over.is_none()
            && (keys.mass.is_some() || gets_stiffer(world, keys, 0.0))
        {
            keys.over = Some(OVER);
        }
    }
    commands
}

/// Whether any spring gets stiffer, or rigid, of those that are longer or shorter than at rest by a share or more.
fn gets_stiffer(world: &dyn Dynamics, keys: &SetKeys, share: f64) -> bool {
    let Some(bonds) = &keys.bonds else { return false };
    let bond = |number: u32| world.bond_place(number).map(|place| world.bonds().get(place));
    let is_stiffer = |(k, number): (usize, &u32)| {
        let Some(bond) = bond(*number) else { return false };
        let BondKind::Spring { stiffness, .. } = bond.kind else { return false };
        let long = length(sub(place(world, bond.b), place(world, bond.a)));
        if (long - bond.rest_length).abs() < share * bond.rest_length {
            return false;
        }
        match (&keys.stiffness, keys.kind) {
            (_, Some(KindName::Rigid)) => true,
            (Some(OneOrEach::One(one)), _) => *one > stiffness,
            (Some(OneOrEach::Each(list)), _) => list.get(k).is_some_and(|own| *own > stiffness),
            (None, _) => false,
        }
    };
    bonds.iter().enumerate().any(is_stiffer)
}
