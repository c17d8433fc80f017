//! What bonds are drawn as: bars, coils, ropes, dashes.

use crate::sim::{Bond, BondKind, Bonds, Limit};

/// Kinds as the shader knows them: `ROD`, `COIL`, `ROPE`, `RELAXED`, `STRING`, `STRUT`, `MUSCLE` in bonds.wgsl; 0 is a plain stroke. A string and a
/// strut act on one side only, as a rope and a rod that show no strain on the other.
pub(super) const ROD: u32 = 1;
pub(super) const COIL: u32 = 2;
const ROPE: u32 = 3;
const RELAXED: u32 = 4;
const STRING: u32 = 5;
pub(super) const STRUT: u32 = 6;
pub(super) const MUSCLE: u32 = 7;
/// Between pins on which something hangs: drawn as a rod as thick as any, which has no length at rest, also over what
/// covers other bonds.
pub(super) const BAR: u32 = 8;

/// A rope, and a string, that keep their length: drawn as others, and coloured where they are stretched all the same.
pub(super) const RIGID_ROPE: u32 = 9;
pub(super) const RIGID_STRING: u32 = 10;

/// Bonds in a row, without a branch, from which on they are a rope.
const ROPE_FROM: usize = 6;

/// What a bond is drawn as by itself: what is driven is a muscle, what only pulls a piece of rope.
pub(super) fn form(bond: &Bond) -> u32 {
    if bond.drive.is_some() {
        return MUSCLE;
    }
    match (bond.limit, bond.kind) {
        (Limit::Max, BondKind::Rigid) => RIGID_STRING,
        (Limit::Max, _) => STRING,
        (Limit::Min, _) => STRUT,
        (_, BondKind::Rigid) => ROD,
        (_, BondKind::Spring { .. }) => COIL,
        (_, BondKind::Relaxed { .. }) => RELAXED,
    }
}

/// Whether a form is drawn as a rope.
pub(super) fn is_rope(form: u32) -> bool {
    matches!(form, ROPE | STRING | RIGID_ROPE | RIGID_STRING)
}

/// A strain, as a bond of a form acts against it `[1]`.
pub(super) fn acting(form: u32, strain: f32) -> f32 {
    match form {
        STRING | RIGID_STRING => strain.max(0.0),
        STRUT => strain.min(0.0),
        _ => strain,
    }
}

/// What a bond of a form is drawn as where it is of a rope.
pub(super) fn in_a_row(form: u32) -> u32 {
    if form == ROD { RIGID_ROPE } else { ROPE }
}

/// A form as the shader knows it, and a length at rest `[m]`: below 0 of ropes that keep theirs, and of a bar, which has none.
pub(super) fn packed(form: u32, rest_length: f32) -> (u32, f32) {
    match form {
        BAR => (ROD, -1.0),
        RIGID_ROPE => (ROPE, -rest_length.abs()),
        RIGID_STRING => (STRING, -rest_length.abs()),
        form => (form, rest_length),
    }
}

/// Which bonds are of a rope: those of a row of [`ROPE_FROM`] or more of one kind and about one length, from one point of three or more
/// bonds, or of one, to the next such.
pub(super) fn ropes(bonds: &Bonds, point_count: usize) -> Vec<bool> {
    let ends: Vec<[usize; 2]> = bonds.iter().map(|bond| [bond.a.index(), bond.b.index()]).collect();
    // Up to two bonds of each point, and how many it has.
    let mut at = vec![([0_usize; 2], 0_usize); point_count];
    for (number, pair) in ends.iter().enumerate() {
        for &end in pair {
            let (list, count) = &mut at[end];
            if *count < 2 {
                list[*count] = number;
            }
            *count += 1;
        }
    }
    let mut is_seen = vec![false; ends.len()];
    let mut is_rope = vec![false; ends.len()];
    for start in 0..ends.len() {
        if is_seen[start] {
            continue;
        }
        is_seen[start] = true;
        let mut row = vec![start];
        for mut point in ends[start] {
            let mut bond = start;
            while let (list, 2) = at[point] {
                bond = if list[0] == bond { list[1] } else { list[0] };
                if std::mem::replace(&mut is_seen[bond], true) {
                    break;
                }
                row.push(bond);
                point = if ends[bond][0] == point { ends[bond][1] } else { ends[bond][0] };
            }
        }
        if row.len() >= ROPE_FROM {
            row.into_iter().for_each(|bond| is_rope[bond] = true);
        }
    }
    is_rope
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::PointId;

    #[test]
    fn a_long_row_is_a_rope_and_what_it_hangs_on_is_not() {
        // A triangle with a tail of seven bonds, and a row of three by itself.
        let triangle = [[0, 1], [1, 2], [2, 0]];
        let tail = (2..9).map(|i| [i, i + 1]);
        let row = (20..23).map(|i| [i, i + 1]);
        let ends: Vec<[u32; 2]> = triangle.into_iter().chain(tail).chain(row).collect();
        let bonds: Bonds = ends.iter().map(|&[a, b]| Bond::new(PointId(a), PointId(b), 1.0)).collect();
        let found = ropes(&bonds, 24);
        assert_eq!(found.iter().filter(|is| **is).count(), 7);
        assert!(found[3..10].iter().all(|is| *is));
    }

    #[test]
    fn what_acts_on_one_side_shows_strain_there_alone() {
        let of = |limit| form(&Bond { limit, ..Bond::new(PointId(0), PointId(1), 1.0) });
        let [string, strut, both] = [Limit::Max, Limit::Min, Limit::Both].map(of);
        assert!(is_rope(string) && !is_rope(strut) && !is_rope(both));
        let shown = |form| [-0.2, 0.3].map(|strain| acting(form, strain));
        assert_eq!([string, strut, both].map(shown), [[0.0, 0.3], [-0.2, 0.0], [-0.2, 0.3]]);
    }

    #[test]
    fn what_is_driven_is_a_muscle() {
        use crate::sim::{Drive, Signal, Wave};
        let signal = Signal { wave: Some(Wave { period: 1.0, phase: 0.0 }), held: None };
        let drive = Some(Drive { amplitude: 0.2, signal });
        assert_eq!(form(&Bond { drive, ..Bond::new(PointId(0), PointId(1), 1.0) }), MUSCLE);
    }

    #[test]
    fn a_ring_of_bonds_ends() {
        let bonds: Bonds = (0..8).map(|i| Bond::new(PointId(i), PointId((i + 1) % 8), 1.0)).collect();
        assert_eq!(ropes(&bonds, 8), [true; 8]);
    }
}
