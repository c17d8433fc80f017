//! On either side of each size at which another method takes over.

use wobble::sim::{Bond, BondKind, Bounds, Method, Model, Order, Precision, Solver, build};

use super::models::{bonded, hub, rope, sheet, single, to_strain, tree};

/// What moves all of a scene: the method, and whether it is one for large bodies.
fn moved_by(model: &Model<2>) -> (Solver, bool) {
    let world = build(model).unwrap();
    let [part] = world.parts() else { panic!("{:?}", world.parts()) };
    (part.solver, !part.kernel.is_empty())
}

/// So many springs in a row, held by nothing.
fn springs(count: u32, stiffness: f64) -> Model<2> {
    let position = (0..=count).map(|i| [0.1 * f64::from(i), 0.0]).collect();
    let ends: Vec<[u32; 2]> = (0..count).map(|i| [i, i + 1]).collect();
    bonded(position, &ends, BondKind::Spring { stiffness, damping: 0.0 })
}

/// The same scene in a room that it does not touch.
fn in_a_room(model: Model<2>) -> Model<2> {
    Model { bounds: Some(Bounds { min: [-1e4; 2], max: [1e4; 2], restitution: 0.0, friction: 0.0 }), ..model }
}

fn by(model: Model<2>, solver: Solver) -> Model<2> {
    Model { method: Method { solver, substep: Some(0.001), iterations: Some(2), ..model.method }, ..model }
}

const SOLVED_TOGETHER: (Solver, bool) = (Solver::VelocityVerlet, false);
const BY_PATHS: (Solver, bool) = (Solver::Path, true);

#[test]
fn rigid_bonds_are_solved_together_up_to_two_thousand() {
    assert_eq!(moved_by(&rope(2_001)), SOLVED_TOGETHER);
    assert_eq!(moved_by(&rope(2_002)), BY_PATHS);
}

#[test]
fn rigid_bonds_are_followed_by_order_8_up_to_two_hundred_and_fifty() {
    assert_eq!(moved_by(&rope(251)), (Solver::Rk8, false));
    assert_eq!(moved_by(&rope(252)), SOLVED_TOGETHER);
}

#[test]
fn a_star_is_solved_together_up_to_sixty_thousand_pairs_of_spokes() {
    assert_eq!(moved_by(&hub(346, false)), SOLVED_TOGETHER);
    assert_eq!(moved_by(&hub(347, false)), BY_PATHS);
}

#[test]
fn a_tree_with_a_strain_goes_by_paths_up_to_four_hundred_bonds() {
    // Without its pin, which would part it into three.
    let free = |points| Model { pinned: Vec::new(), ..tree(3, points) };
    assert_eq!(moved_by(&to_strain(&free(401), 0.01)), BY_PATHS);
    assert_eq!(moved_by(&to_strain(&free(402), 0.01)), SOLVED_TOGETHER);
}

#[test]
fn impacts_of_rigid_bonds_are_located_up_to_sixty() {
    assert_eq!(moved_by(&in_a_room(rope(61))), SOLVED_TOGETHER);
    assert_eq!(moved_by(&in_a_room(rope(62))), BY_PATHS);
}

#[test]
fn touches_of_springs_are_located_up_to_eight_hundred() {
    assert_eq!(moved_by(&in_a_room(springs(800, 100.0))), (Solver::Pefrl, false));
    assert_eq!(moved_by(&in_a_room(springs(801, 100.0))), (Solver::VelocityVerlet, true));
}

#[test]
fn stiff_springs_in_a_row_are_implicit_up_to_twenty_thousand_points() {
    assert_eq!(moved_by(&springs(19_999, 1e9)), (Solver::ImplicitMidpoint, false));
    assert_eq!(moved_by(&springs(20_000, 1e9)), (Solver::VelocityVerlet, true));
}

#[test]
fn springs_have_order_four_and_double_precision_up_to_twenty_thousand_points() {
    for (count, method, precision) in
        [(19_999, (Solver::Pefrl, false), Precision::F64), (20_000, (Solver::VelocityVerlet, true), Precision::F32)]
    {
        let model = springs(count, 10.0);
        assert_eq!(moved_by(&model), method);
        assert_eq!(build(&model).unwrap().precision(), precision);
    }
}

#[test]
fn large_meshes_of_rods_are_of_single_precision_from_a_thousand_and_one_points_on() {
    assert_eq!(build(&sheet::<3>([40, 25], [true; 2])).unwrap().precision(), Precision::F64);
    assert_eq!(build(&sheet::<3>([77, 13], [true; 2])).unwrap().precision(), Precision::F32);
    assert_eq!(build(&sheet::<2>([90, 13], [false; 2])).unwrap().precision(), Precision::F32, "a net");
    assert_eq!(
        build(&sheet::<2>([77, 13], [true; 2])).unwrap().precision(),
        Precision::F64,
        "a rigid body of the plane"
    );
    // Whatever is asked for is given.
    assert_eq!(build(&single(&rope::<2>(3))).unwrap().precision(), Precision::F32);
}

#[test]
fn named_methods_move_more_than_two_thousand_bonds_as_one_body() {
    let relaxed = BondKind::Relaxed { relaxation: 0.5, max_correction: f64::INFINITY };
    let row = |count: u32, kind| {
        let model = springs(count, 10.0);
        Model { bonds: model.bonds.iter().map(|bond| Bond { kind, ..bond }).collect(), ..model }
    };
    let spring = BondKind::Spring { stiffness: 10.0, damping: 0.0 };
    for (kind, solver) in [
        (spring, Solver::Verlet),
        (relaxed, Solver::Auto),
        (relaxed, Solver::Verlet),
        (BondKind::Rigid, Solver::Xpbd),
        (BondKind::Rigid, Solver::Relaxation),
    ] {
        for (count, is_large) in [(2_000, false), (2_001, true)] {
            let model = by(row(count, kind), solver);
            assert_eq!(moved_by(&model).1, is_large, "{count} bonds, {kind:?} by {solver}");
            // An order of their own is kept one bond after another, however many there are.
            let ordered = Model { method: Method { order: Order::Shuffled, ..model.method }, ..model };
            assert!(!moved_by(&ordered).1, "{count} bonds in order, {kind:?} by {solver}");
        }
    }
}
