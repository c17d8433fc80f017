//! Muscles among rigid bonds that hold their ends without them: no motion fits what they ask for, so they are rigid bonds like the others.
//!
//! A soft body, or a truss of just as many bonds as hold its shape, gives way to each muscle; in one of more, muscles would work against each
//! other and against the rest, with energy from nowhere.

use crate::sim::bond::{Bond, BondKind, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::rigid::holding::RigidPieces;
use crate::sim::rigid::shape::FITS;
use crate::sim::vector::{flat, length, sub};

/// Bonds that are looked at for muscles, at most, for each of these all of its piece; more are looked at for the first one alone.
const MOST: usize = 100_000;

/// Rigid bonds with drives whose ends others hold, of those with an end `among` some points, with all points where they are `[m]`: their
/// places, and what they are without their drives. Such a bond is as long as its ends are apart from then on.
pub(crate) fn idle_drives<const D: usize>(
    bonds: &Bonds,
    among: impl Fn(PointId) -> bool,
    place: impl Fn(PointId) -> [f64; D],
) -> Vec<(usize, Bond)> {
    // In space no rigid bond has a drive.
    if D != 2 || bonds.drives().next().is_none() {
        return Vec::new();
    }
    let is_muscle = |(_, bond): &(usize, Bond)| {
        bond.kind == BondKind::Rigid && bond.drive.is_some() && (among(bond.a) || among(bond.b))
    };
    let muscles: Vec<(usize, Bond)> = bonds.iter().enumerate().filter(is_muscle).collect();
    if muscles.is_empty() {
        return Vec::new();
    }
    let pieces = RigidPieces::of(bonds.iter(), |point| flat(place(point)));
    let mut looked = 0;
    let asked = muscles.into_iter().take_while(|(_, bond)| {
        let own = pieces.bonds_about([bond.a, bond.b]);
        let is_first = looked == 0;
        looked += own;
        is_first || looked <= MOST
    });
    let idle = asked.filter(|(_, bond)| pieces.holds_without_bond([bond.a, bond.b]));
    let without = |(k, bond): (usize, Bond)| {
        let apart = length(sub(place(bond.a), place(bond.b)));
        debug_assert!(apart.is_finite(), "its ends are somewhere");
        let fits = (apart - bond.rest_length).abs() <= FITS * bond.rest_length;
        let rest_length = if fits { bond.rest_length } else { apart };
        (k, Bond { rest_length, drive: None, ..bond })
    };
    idle.map(without).collect()
}
