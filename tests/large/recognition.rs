//! What a body is taken for, and that it moves as it does when it is taken for something else.

use wobble::sim::{Bond, BondKind, Model, PointId};

use super::models::{Draw, G, apart, bonded, cells, frames, hung, kernel, path, rims, rope, to_strain, world};

const SIZE: [u32; 2] = [40, 30];
const STRAIN: f64 = 1e-3;

fn with_bonds(model: &Model<2>, change: impl FnOnce(&mut Vec<Bond>)) -> Model<2> {
    let mut bonds: Vec<Bond> = model.bonds.iter().collect();
    change(&mut bonds);
    Model { bonds: bonds.into(), ..model.clone() }
}

fn taken_for(model: &Model<2>) -> String {
    kernel(&*world(&path(model))).to_owned()
}

/// A hung cloth that swings.
fn cloth() -> Model<2> {
    let mut model = to_strain(&hung(SIZE, [true; 2]), STRAIN);
    for (v, x) in model.velocity.iter_mut().zip(&model.position) {
        *v = [-0.3 * x[1], 0.0];
    }
    model
}

#[test]
fn a_sheet_is_one_in_whatever_order_its_bonds_are_listed() {
    for diagonals in [[true; 2], [true, false], [false, true], [false; 2]] {
        let model = hung([60, 41], diagonals);
        assert_eq!(taken_for(&model), "a sheet by paths", "{diagonals:?}");
        let shuffled = with_bonds(&model, |bonds| Draw(3).shuffle(bonds));
        assert_eq!(taken_for(&shuffled), "a sheet by paths", "{diagonals:?}");
        let swapped = with_bonds(&shuffled, |bonds| {
            bonds.iter_mut().step_by(3).for_each(|bond| std::mem::swap(&mut bond.a, &mut bond.b));
        });
        assert_eq!(taken_for(&swapped), "a sheet by paths", "{diagonals:?}");
        // A kind's rest length is that of its first bond: lists in another order differ by rounding.
        let end = |model: &Model<2>| frames(&mut *world(model), 10, |_| {});
        let off = apart(&end(&swapped), &end(&model));
        assert!(off < 1e-9, "{diagonals:?}: {off:e} m");
    }
}

/// Cloths that are not quite one.
fn nearly() -> Vec<(&'static str, Model<2>)> {
    let cloth = cloth();
    let columns = SIZE[0];
    let find = |a: u32, b: u32| move |bond: &Bond| (bond.a, bond.b) == (PointId(a), PointId(b));
    let (along, falling) = (find(617, 618), find(617, 618 + columns));
    let across = [columns - 1, columns];
    let distance = 0.1 * f64::from(columns - 1).hypot(1.0);
    vec![
        ("a bond missing", with_bonds(&cloth, |bonds| bonds.retain(|bond| !along(bond)))),
        ("a diagonal missing", with_bonds(&cloth, |bonds| bonds.retain(|bond| !falling(bond)))),
        ("a bond twice", with_bonds(&cloth, |bonds| bonds.push(bonds[1000]))),
        ("a bond a little longer", with_bonds(&cloth, |bonds| bonds[1000].rest_length *= 1.0 + 1e-6)),
        (
            "a bond across the end of a row",
            with_bonds(&cloth, |bonds| {
                bonds.push(Bond::new(PointId(across[0]), PointId(across[1]), distance));
            }),
        ),
    ]
}

#[test]
fn a_cloth_that_is_not_quite_one_is_a_mesh_and_moves_as_one() {
    let truth = frames(&mut *world(&cloth()), 30, |_| {});
    for (what, model) in nearly() {
        assert_eq!(taken_for(&model), "a mesh by paths", "{what}");
        let mut world = world(&model);
        let end = frames(&mut *world, 30, |sample| {
            assert!(sample.max_strain < 1.2 * STRAIN, "{what}: {}", sample.max_strain)
        });
        let off = apart(&truth, &end);
        assert!(off < 1e-3, "{what}: {off:e} m of 2.9 m");
    }
}

#[test]
fn rows_that_do_not_fit_two_columns_and_single_rows_are_no_sheets() {
    let mut short = cloth();
    let last = short.position.len() as u32 - 1;
    short = with_bonds(&short, |bonds| bonds.retain(|bond| bond.a.0.max(bond.b.0) != last));
    for list in [&mut short.position, &mut short.velocity] {
        list.pop();
    }
    short.mass.pop();
    assert_eq!(taken_for(&short), "a mesh by paths");
    for size in [[2, 900], [900, 2]] {
        assert_eq!(taken_for(&hung(size, [true; 2])), "a mesh by paths", "{size:?}");
    }
    let sheet = with_bonds(&hung([60, 41], [true; 2]), |_| {});
    let moved: Vec<[f64; 2]> = sheet.position.iter().map(|x| [x[0], x[1] - 1e-3 * x[0]]).collect();
    let sheared = bonded(moved, &cells([60, 41], [true; 2]), BondKind::Rigid);
    assert_eq!(taken_for(&sheared), "a sheet by paths", "rest lengths of each kind may differ");
}

/// Points 0.1 m apart along a part of a circle.
fn arc(count: u32, turn: f64) -> Vec<[f64; 2]> {
    let step = turn / f64::from(count - 1);
    let radius = 0.05 / (0.5 * step).sin();
    (0..count).map(|i| (f64::from(i) * step).sin_cos()).map(|(sin, cos)| [radius * cos, -radius * sin]).collect()
}

/// The same rope with its points in another order.
fn renumbered(model: &Model<2>, seed: u64) -> (Model<2>, Vec<u32>) {
    let count = model.position.len() as u32;
    let mut name: Vec<u32> = (0..count).collect();
    Draw(seed).shuffle(&mut name);
    let mut other = model.clone();
    for i in 0..count as usize {
        other.position[name[i] as usize] = model.position[i];
    }
    other.pinned = model.pinned.iter().map(|pin| PointId(name[pin.index()])).collect();
    let mut bonds: Vec<Bond> = model.bonds.iter().collect();
    for bond in &mut bonds {
        (bond.a, bond.b) = (PointId(name[bond.b.index()]), PointId(name[bond.a.index()]));
    }
    Draw(seed + 1).shuffle(&mut bonds);
    (Model { bonds: bonds.into(), ..other }, name)
}

#[test]
fn a_chain_moves_alike_in_any_numbering() {
    let mut both = Model { pinned: vec![PointId(0), PointId(2099)], ..rope(2_100) };
    both.position = arc(2_100, 0.6 * std::f64::consts::TAU);
    for (what, model) in [("one end", rope(2_100)), ("both ends", both)] {
        let model = to_strain(&model, STRAIN);
        let truth = frames(&mut *world(&model), 20, |_| {});
        let (other, name) = renumbered(&model, 9);
        let mut world = world(&other);
        assert_eq!(kernel(&*world), "a chain by paths", "{what}");
        let end = frames(&mut *world, 20, |_| {});
        let off = |i: usize| {
            let (p, q) = (truth.position[i], end.position[name[i] as usize]);
            (p[0] - q[0]).hypot(p[1] - q[1])
        };
        let most = (0..2_100).map(off).fold(0.0, f64::max);
        assert!(most < 2e-3, "{what}: {most:e} m");
    }
}

#[test]
fn a_ring_is_a_mesh_a_pinned_one_is_a_chain_and_what_branches_is_eliminated() {
    let mut ends: Vec<[u32; 2]> = (1..2_200).map(|i| [i - 1, i]).collect();
    ends.push([2_199, 0]);
    let whole = arc(2_201, std::f64::consts::TAU)[..2_200].to_vec();
    let ring = bonded(whole, &ends, BondKind::Rigid);
    let pinned = Model { pinned: vec![PointId(3)], ..ring.clone() };
    let mut branch = rope(2_200);
    branch.position.push([100.0, 0.1]);
    branch.velocity.push([0.0; 2]);
    branch.mass.push(1.0);
    let branch = with_bonds(&branch, |bonds| bonds.push(Bond::new(PointId(1000), PointId(2200), 0.1)));
    for (form, model) in [("a mesh by paths", ring), ("a chain by paths", pinned), ("", branch)] {
        let mut world = world(&model);
        assert_eq!(kernel(&*world), form);
        let mut most = 0.0_f64;
        frames(&mut *world, 20, |sample| most = most.max(sample.max_strain));
        assert!(world.is_finite() && most < 0.02, "{form}: {most}");
    }
}

#[test]
fn bodies_that_differ_by_rounding_are_a_crowd_and_another_one_is_not() {
    let crowd = to_strain(&rims(60), 1e-3);
    assert_eq!(taken_for(&crowd), "a crowd by paths");
    let other = with_bonds(&crowd, |bonds| bonds[5].rest_length *= 1.001);
    assert_eq!(taken_for(&other), "a crowd and a mesh by paths");
    let seven = to_strain(&rims(7), 1e-3);
    assert_eq!(taken_for(&seven), "7 meshes by paths");
}

/// A loose point is no part of a large body, wherever it is listed.
#[test]
fn a_loose_point_falls_beside_a_rope_by_paths() {
    let rope = to_strain(&path(&rope::<2>(200)), STRAIN);
    let mut last = rope.clone();
    last.position.push([0.0, 5.0]);
    last.velocity.push([0.0; 2]);
    last.mass.push(1.0);
    let mut first = last.clone();
    first.position.rotate_right(1);
    first.pinned = vec![PointId(1)];
    first = with_bonds(&first, |bonds| {
        bonds.iter_mut().for_each(|bond| (bond.a.0, bond.b.0) = (bond.a.0 + 1, bond.b.0 + 1))
    });
    for (place, model) in [(200, last), (0, first)] {
        let mut world = world(&model);
        let sample = frames(&mut *world, 60, |sample| assert!(sample.max_strain <= STRAIN, "{}", sample.max_strain));
        let off = (sample.position[place][1] - (5.0 - 0.5 * G)).abs();
        // What moves it is of order 1: off by G h t/2.
        assert!(off < 0.03, "point {place}: {off:e} m");
    }
}
