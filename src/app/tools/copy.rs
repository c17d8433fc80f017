//! A copy of a body of a running world, as it is now.

use crate::picture::Tint;
use crate::scene::{AddKeys, BondKeys, ColorKey, KindName, LimitName, MassKeys, PointKeys, Row, SkinKeys, Vector};
use crate::sim::{Bond, BondKind, Dynamics, Limit, PointId};

/// The keys that bring a copy of some points, ascending, `by` `[m]` from where they are: with velocities, masses, pins, the bonds among
/// them, what they cover and the colours that they have of their own; not what is painted on them.
pub(in crate::app) fn copy(world: &dyn Dynamics, tints: &[Tint], points: &[PointId], by: [f64; 3]) -> AddKeys {
    let (dimensions, [next, ..]) = (world.dimensions(), world.next_numbers());
    let sample = world.sample(world.time());
    let points: Vec<PointId> =
        points.iter().copied().filter(|point| world.gone().binary_search(point).is_err()).collect();
    let place = |point: PointId| points.binary_search(&point).ok().map(|place| next + place as u32);
    let moved = |x: [f64; 3]| Vector::new(std::array::from_fn(|axis| x[axis] + by[axis]), dimensions);
    let of = |point: &PointId| point.index();
    let bonds = world.bonds().iter().filter_map(|bond| Some(keys(bond, place(bond.a)?, place(bond.b)?))).collect();
    let covered = |corners: &[PointId; 3]| {
        let [a, b, c] = corners.map(place);
        Some(Row([a?, b?, c?]))
    };
    AddKeys {
        points: Some(PointKeys {
            position: points.iter().map(|point| moved(sample.position[of(point)])).collect(),
            velocity: Some(points.iter().map(|point| Vector::new(sample.velocity[of(point)], dimensions)).collect()),
            mass: Some(MassKeys::Each(points.iter().map(|point| world.masses()[of(point)]).collect())),
            pinned: world.pinned().iter().filter_map(|&pin| place(pin)).collect(),
        }),
        bonds,
        triangles: world.triangles().iter().filter_map(covered).collect(),
        skins: colors(tints, &points, next),
        ..AddKeys::default()
    }
}

/// The colours that points have of their own, for their copies from `next` on.
fn colors(tints: &[Tint], points: &[PointId], next: u32) -> Vec<SkinKeys> {
    let color = |point: &PointId| Tint::of(tints, point.0).and_then(|tint| tint.color);
    let colored = points.chunk_by(|a, b| color(a) == color(b)).scan(next, |first, same| {
        let copies = *first..*first + same.len() as u32;
        *first = copies.end;
        Some((color(&same[0]), copies))
    });
    let skin = |color, copies: std::ops::Range<u32>| SkinKeys {
        points: copies.collect(),
        color: Some(ColorKey(color)),
        ..SkinKeys::default()
    };
    colored.filter_map(|(color, copies)| Some(skin(color?, copies))).collect()
}

/// A bond between other points.
fn keys(bond: Bond, a: u32, b: u32) -> BondKeys {
    let keys = BondKeys { rest: Some(bond.rest_length), ..BondKeys::new(a, b) };
    let keys = match bond.kind {
        BondKind::Rigid => BondKeys { kind: Some(KindName::Rigid), ..keys },
        BondKind::Spring { stiffness, damping } => {
            BondKeys { kind: Some(KindName::Spring), stiffness: Some(stiffness), damping: Some(damping), ..keys }
        }
        BondKind::Relaxed { relaxation, max_correction } => BondKeys {
            kind: Some(KindName::Relaxed),
            relaxation: Some(relaxation),
            max_correction: max_correction.is_finite().then_some(max_correction),
            ..keys
        },
    };
    let limit = match bond.limit {
        Limit::Both => None,
        Limit::Max => Some(LimitName::Max),
        Limit::Min => Some(LimitName::Min),
    };
    let drive = bond.drive.map(Into::into);
    BondKeys { drive, break_strain: bond.break_strain.is_finite().then_some(bond.break_strain), limit, ..keys }
}
