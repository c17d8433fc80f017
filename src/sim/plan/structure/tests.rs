//! What islands are taken for.

use super::Structure;
use crate::sim::bond::{Bond, BondKind, Limit, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::plan::island::{Ties, islands};

fn bond(a: u32, b: u32, rest: f64) -> Bond {
    Bond::new(PointId(a), PointId(b), rest)
}

/// The structure of the only island that has bonds.
fn of(bonds: &[Bond], w: &[f64]) -> Structure {
    let bonds: Bonds = bonds.iter().copied().collect();
    let mut found = islands(&bonds, &Ties::default(), w);
    found.retain(|island| !island.bonds.is_empty());
    assert_eq!(found.len(), 1);
    Structure::of(&found[0], &bonds, w)
}

/// A chain of 70 bonds along these points.
fn links(names: impl Fn(u32) -> u32) -> Vec<Bond> {
    (0..70).map(|i| bond(names(i), names(i + 1), 1.0 + f64::from(i))).collect()
}

#[test]
fn a_chain_goes_from_its_lowest_pin_or_loose_end_whatever_the_numbers() {
    // 27 has no factor in common with 71: every number once.
    let name = |i: u32| i * 27 % 71;
    let mut bonds = links(name);
    bonds.reverse();
    bonds.iter_mut().step_by(2).for_each(|bond| std::mem::swap(&mut bond.a, &mut bond.b));
    let along: Vec<u32> = (0..71).map(name).collect();
    let rising: Vec<f64> = (0..70).map(|i| 1.0 + f64::from(i)).collect();
    for pins in [vec![], vec![0], vec![70], vec![0, 70]] {
        let mut w = [1.0; 71];
        pins.iter().for_each(|&pin: &u32| w[name(pin) as usize] = 0.0);
        let Structure::Chain { points, rests, .. } = of(&bonds, &w) else { panic!("{pins:?} is no chain") };
        let from_far = pins == [70];
        let turned =
            |forward: bool, list: &[u32]| if forward { list.to_vec() } else { list.iter().rev().copied().collect() };
        assert_eq!(points, turned(!from_far, &along), "{pins:?}");
        assert_eq!(rests[0], if from_far { 70.0 } else { 1.0 });
        assert_eq!(rests.len(), rising.len());
    }
}

#[test]
fn rings_branches_short_and_mixed_chains_are_meshes() {
    let w = [1.0; 73];
    let mut ring = links(|i| i);
    ring.push(bond(70, 0, 1.0));
    assert_eq!(of(&ring, &w[..71]), Structure::Mesh, "a ring");
    let mut pinned = w;
    pinned[9] = 0.0;
    let Structure::Chain { points, .. } = of(&ring, &pinned[..71]) else { panic!("a ring with a pin is a chain") };
    assert_eq!((points.len(), points[0], points[71]), (72, 9, 9), "cut at the pin");
    let mut branch = links(|i| i);
    branch.push(bond(40, 71, 1.0));
    assert_eq!(of(&branch, &w[..72]), Structure::Mesh, "a branch");
    let mut twice = links(|i| i);
    twice.push(bond(0, 1, 1.0));
    assert_eq!(of(&twice, &w[..71]), Structure::Mesh, "a bond twice");
    assert_eq!(of(&links(|i| i)[..63], &w[..64]), Structure::Mesh, "short");
    for change in [
        |bond: &mut Bond| bond.kind = BondKind::Spring { stiffness: 1.0, damping: 0.0 },
        |bond: &mut Bond| bond.limit = Limit::Max,
        |bond: &mut Bond| bond.rest_length = 0.0,
    ] {
        let mut mixed = links(|i| i);
        change(&mut mixed[30]);
        assert_eq!(of(&mixed, &w[..71]), Structure::Mesh, "{:?}", mixed[30]);
    }
}

/// A sheet of 5 columns and 4 rows from point 2 on, with falling and rising diagonals of their own lengths.
fn sheet(columns: u32, [falling, rising]: [bool; 2]) -> Vec<Bond> {
    let mut bonds = Vec::new();
    for i in 0..columns * 4 {
        let (at, has_right, has_below) = (i + 2, i % columns + 1 < columns, i / columns < 3);
        let wanted = [
            (has_right, at, at + 1, 1.0),
            (has_below, at, at + columns, 2.0),
            (falling && has_right && has_below, at, at + columns + 1, 3.0),
            (rising && has_right && has_below, at + 1, at + columns, 4.0),
        ];
        bonds.extend(wanted.iter().filter(|bond| bond.0).map(|&(_, a, b, rest)| bond(a, b, rest)));
    }
    bonds
}

#[test]
fn a_sheet_has_the_same_bonds_in_every_cell() {
    let w = [1.0; 22];
    for diagonals in [[false; 2], [true, false], [false, true], [true; 2]] {
        let Structure::Sheet { first, columns, rows, specs } = of(&sheet(5, diagonals), &w) else {
            panic!("{diagonals:?} is no sheet")
        };
        assert_eq!((first, columns, rows), (2, 5, 4));
        assert_eq!((specs.along.rest, specs.down.rest), (1.0, 2.0));
        let rests = [specs.falling, specs.rising].map(|spec| spec.map(|spec| spec.rest));
        assert_eq!(rests, [diagonals[0].then_some(3.0), diagonals[1].then_some(4.0)]);
    }
}

#[test]
fn whatever_one_bond_is_off_by_it_is_no_sheet() {
    let whole = sheet(5, [true; 2]);
    let w = [1.0; 22];
    for k in 0..whole.len() {
        let mut bonds = whole.clone();
        bonds.remove(k);
        assert_eq!(of(&bonds, &w), Structure::Mesh, "without bond {k}");
        bonds.push(whole[k]);
        assert!(matches!(of(&bonds, &w), Structure::Sheet { .. }), "bond {k} last");
        bonds.push(whole[k]);
        assert_eq!(of(&bonds, &w), Structure::Mesh, "bond {k} twice");
        let mut longer = whole.clone();
        longer[k].rest_length *= 1.0 + 1e-9;
        assert_eq!(of(&longer, &w), Structure::Mesh, "bond {k} longer");
        longer[k].rest_length = whole[k].rest_length * (1.0 + 2e-16);
        assert!(matches!(of(&longer, &w), Structure::Sheet { .. }), "bond {k} off by rounding");
    }
    let mut across = whole;
    across.push(bond(6, 7, 1.0));
    assert_eq!(of(&across, &w), Structure::Mesh, "from the end of a row to the next");
    assert_eq!(of(&sheet(2, [true; 2]), &w[..10]), Structure::Mesh, "two columns");
}

#[test]
fn bonds_between_pins_may_be_missing() {
    let mut w = [1.0; 22];
    w[2..7].fill(0.0);
    let mut bonds = sheet(5, [true; 2]);
    bonds.retain(|bond| bond.a.0.max(bond.b.0) > 6);
    assert!(matches!(of(&bonds, &w), Structure::Sheet { columns: 5, rows: 4, .. }));
}
