//! Bonds of large bodies that go: their lanes are idle, and nothing pulls across them.

use wobble::sim::{BondId, BondKind, Command, Cursor, Dynamics, Method, Model, Selection, Solver, build};

use super::models::{bonded, cells, disc, places};

/// Where a body is parted: what lies beyond the line goes off at another velocity.
const VELOCITIES: [[f64; 2]; 2] = [[0.5, 0.2], [-0.3, -0.4]];

/// The body parted along a line, which is not pinned and does not fall, and the bonds across it.
fn parted(mut model: Model<2>, is_beyond: impl Fn([f64; 2]) -> bool, method: Method) -> (Model<2>, Vec<BondId>) {
    model.pinned.clear();
    model.gravity = [0.0; 2];
    model.method = method;
    let side: Vec<bool> = model.position.iter().map(|&x| is_beyond(x)).collect();
    model.velocity = side.iter().map(|&beyond| VELOCITIES[usize::from(beyond)]).collect();
    let is_across = |k: &usize| {
        let [a, b] = model.bonds.ends()[*k].map(|end| side[end.index()]);
        a != b
    };
    let across = (0..model.bonds.len()).filter(is_across).map(|k| BondId(k as u32)).collect();
    (model, across)
}

fn kernel(world: &dyn Dynamics) -> String {
    world.parts()[0].kernel.clone()
}

fn delete(world: &mut dyn Dynamics, bonds: Vec<BondId>) {
    world.apply(&Command::Delete(Selection { bonds, ..Selection::default() })).unwrap();
}

#[test]
fn halves_whose_bonds_are_gone_fly_apart_undisturbed() {
    let spring = BondKind::Spring { stiffness: 2e4, damping: 1.0 };
    let paths = Method { solver: Solver::Path, max_strain: Some(0.01), ..Method::default() };
    let [swept, forces] = [Solver::Xpbd, Solver::Verlet].map(|solver| Method { solver, ..Method::default() });
    for kind in [BondKind::Rigid, spring] {
        for diagonals in [[false, false], [true, true]] {
            let size = [36, 34];
            let sheet = || bonded(places::<2>(size), &cells(size, diagonals), kind);
            for method in [if kind == BondKind::Rigid { paths } else { forces }, swept] {
                flies_apart(parted(sheet(), |[x, _]| x > 1.75, method), "a sheet");
                flies_apart(parted(sheet(), |[_, y]| y < -1.65, method), "a sheet");
            }
        }
    }
}

#[test]
fn halves_of_a_mesh_fly_apart_undisturbed() {
    let paths = Method { solver: Solver::Path, max_strain: Some(0.01), ..Method::default() };
    let swept = Method { solver: Solver::Xpbd, ..Method::default() };
    for method in [paths, swept] {
        flies_apart(parted(disc(1.6), |[x, y]| x + 0.3 * y > 0.01, method), "a mesh");
    }
}

fn flies_apart((model, across): (Model<2>, Vec<BondId>), form: &str) {
    let mut world = build(&model).unwrap();
    let before = kernel(&*world);
    let (bonds, count) = (world.bonds().len(), across.len());
    assert!(count > 10 && before.starts_with(form), "{before}, {count} across");
    delete(&mut *world, across);
    assert_eq!((kernel(&*world), world.bonds().len()), (before.clone(), bonds - count), "nothing is compiled anew");
    while world.time() < 0.5 {
        world.step();
    }
    let now = world.sample(world.time());
    let off = (0..model.position.len())
        .map(|i| {
            let [x, v] = [model.position[i], model.velocity[i]];
            let meant = [0, 1].map(|k| x[k] + v[k] * world.time());
            (now.position[i][0] - meant[0]).hypot(now.position[i][1] - meant[1])
        })
        .fold(0.0, f64::max);
    assert!(off < 2e-4, "{before}: {off:e} m off");
}

#[test]
fn a_body_with_too_many_idle_lanes_is_compiled_anew() {
    let size = [36, 34];
    let mut model = bonded(places::<2>(size), &cells(size, [false, false]), BondKind::Rigid);
    model.method.max_strain = Some(0.01);
    let mut world = build(&model).unwrap();
    let sheet = kernel(&*world);
    let all = world.bonds().len() as u32;
    for k in 0..all / 4 {
        delete(&mut *world, vec![BondId(4 * k)]);
        if k < all / 10 {
            assert_eq!(kernel(&*world), sheet, "after {k}");
        }
    }
    assert_ne!(kernel(&*world), sheet);
    assert_eq!(world.bonds().len() as u32, all - all / 4);
}

#[test]
fn what_hangs_on_by_less_still_hangs() {
    // A net on its upper corners, cut along half of a row: what is left holds, within the strain that large bodies are held to.
    let size = [40, 40];
    let mut model = bonded(places::<2>(size), &cells(size, [false, false]), BondKind::Rigid);
    model.pinned = [0, 39].map(wobble::sim::PointId).to_vec();
    model.method.max_strain = Some(0.02);
    let mut world = build(&model).unwrap();
    let cut = Command::Cut { from: Cursor::at([-0.05, -0.95]), to: Cursor::at([1.95, -0.95]) };
    world.apply(&cut).unwrap();
    assert_eq!(world.bonds().len(), model.bonds.len() - 20);
    while world.time() < 1.5 {
        world.step();
    }
    let now = world.sample(world.time());
    assert!(now.max_strain < 0.03, "{}", now.max_strain);
    let [free, held] = [10 * 40, 10 * 40 + 39].map(|i: usize| now.position[i][1]);
    assert!(free < held - 0.3, "the free corner of the flap hangs lower: {free} {held}");
}
