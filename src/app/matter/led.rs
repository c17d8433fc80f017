//! Springs that get stiffer are led there: what they bear is lifted, not thrown.

use crate::history::{Do, OneOrEach, SetKeys};
use crate::scene::KindName;
use crate::sim::{BondKind, Dynamics};

/// So long stiffer springs take to be there, and the mass of what becomes another matter with them `[s]`.
const OVER: f64 = 0.5;

/// Commands of one change: where springs get stiffer by it, they and the masses are led there.
pub(in crate::app) fn led(world: &dyn Dynamics, mut commands: Vec<Do>) -> Vec<Do> {
    let is_stiffer = |act: &Do| matches!(act, Do::Set(keys) if gets_stiffer(world, keys));
    if !commands.iter().any(is_stiffer) {
        return commands;
    }
    for act in &mut commands {
        if let Do::Set(keys) = act
            && (keys.mass.is_some() || gets_stiffer(world, keys))
        {
            keys.over = Some(OVER);
        }
    }
    commands
}

/// Whether any spring gets stiffer, or rigid.
fn gets_stiffer(world: &dyn Dynamics, keys: &SetKeys) -> bool {
    let Some(bonds) = &keys.bonds else { return false };
    let bond = |number: u32| world.bond_place(number).map(|place| world.bonds().get(place));
    let is_stiffer = |(k, number): (usize, &u32)| {
        let Some(BondKind::Spring { stiffness, .. }) = bond(*number).map(|bond| bond.kind) else { return false };
        match (&keys.stiffness, keys.kind) {
            (_, Some(KindName::Rigid)) => true,
            (Some(OneOrEach::One(one)), _) => *one > stiffness,
            (Some(OneOrEach::Each(list)), _) => list.get(k).is_some_and(|own| *own > stiffness),
            (None, _) => false,
        }
    };
    bonds.iter().enumerate().any(is_stiffer)
}
