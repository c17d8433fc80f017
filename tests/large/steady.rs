//! What passes over the bonds could feed energy into, and must not.

use wobble::sim::{BondKind, Method, Model, PointId};

use super::models::{
    Draw, FRAME, bonded, copies, fastest, frames, hub, kernel, path, rims, rope, sheet, single, to_strain, tree, world,
};

/// The largest energy above the start's over so many frames, the scale that it is held against (what gravity gives to all
/// of the mass in a second), and the largest strain of the last half [J, J, 1].
fn gain(model: &Model<2>, count: usize) -> (f64, f64, f64) {
    let mut world = world(model);
    let start = world.sample(0.0).energy;
    let (mut most, mut strain) = (0.0_f64, 0.0_f64);
    frames(&mut *world, count, |sample| {
        most = most.max(sample.energy - start);
        assert!(sample.energy.is_finite());
        if sample.time > 0.5 * FRAME * count as f64 {
            strain = strain.max(sample.max_strain);
        }
    });
    (most, 48.0 * model.mass.len() as f64, strain)
}

#[test]
fn hubs_wheels_and_trees_gain_nothing() {
    let scenes = [
        ("hub of 10", path(&hub(10, false)), 1e-4),
        ("hub of 400", path(&hub(400, false)), 1e-4),
        ("wheel of 24", path(&hub(24, true)), 0.03),
        ("wheels", path(&copies(&hub(24, true), 20)), 0.03),
        ("hubs", path(&copies(&hub(10, false), 20)), 1e-4),
        ("tree of threes", path(&tree(3, 400)), 1e-4),
        ("tree of fives", path(&tree(5, 400)), 1e-4),
    ];
    for (what, model, allowed) in scenes {
        for strain in [0.02, 1e-3] {
            for model in [to_strain(&model, strain), single(&to_strain(&model, strain))] {
                let (most, scale, stretched) = gain(&model, 120);
                assert!(most <= allowed * scale, "{what} at {strain}: gains {most:e} J, scale {scale:e}");
                assert!(stretched <= strain, "{what} at {strain}: {stretched:e}");
            }
        }
    }
}

/// A net between two corners: its top row is exactly taut, so that no force of finite size holds it level.
#[test]
fn a_net_between_two_corners_gains_nothing_and_keeps_its_strain() {
    for size in [30, 60] {
        let net = Model { pinned: vec![PointId(0), PointId(size - 1)], ..sheet::<2>([size, size], [false; 2]) };
        for model in [to_strain(&net, 0.02), single(&to_strain(&net, 0.02))] {
            let (most, scale, strain) = gain(&model, 120);
            assert!(most <= 1e-3 * scale, "{size}: gains {most:e} J, scale {scale:e}");
            assert!(strain <= 0.02, "{size}: {strain:e}");
        }
    }
}

/// Its length cannot give way, and gravity would pull it without end: it sags to a share of the strain, and swings.
#[test]
fn a_taut_rope_between_two_pins_gains_nothing() {
    for points in [100, 1_000, 3_000] {
        let taut = Model { pinned: vec![PointId(0), PointId(points - 1)], ..rope::<2>(points) };
        for model in [to_strain(&taut, 0.02), single(&to_strain(&taut, 0.02))] {
            let (most, scale, strain) = gain(&model, 240);
            assert!(most <= 0.005 * scale && strain < 0.02, "{points} points gain {most:e} J of {scale:e}: {strain:e}");
        }
    }
}

#[test]
fn with_drag_everything_comes_to_rest() {
    let pinned =
        |pins: &[u32], model: Model<2>| Model { pinned: pins.iter().map(|&pin| PointId(pin)).collect(), ..model };
    let scenes = [
        ("two corners", pinned(&[0, 29], sheet([30, 30], [true; 2]))),
        ("one diagonal", pinned(&[0, 29], sheet([30, 30], [true, false]))),
        ("wheels", path(&copies(&hub(12, true), 10))),
        ("rims", path(&rims(20))),
    ];
    for (what, model) in scenes {
        let model = Model { drag_rate: 3.0, ..to_strain(&model, 0.02) };
        let sample = frames(&mut *world(&model), 900, |_| {});
        assert!(fastest(&sample) < 5e-3, "{what}: {:e} m/s", fastest(&sample));
    }
}

/// Hubs of even spokes that fold as they fly: how they start says nothing of where they get to.
#[test]
fn crowds_that_change_their_shape_gain_nothing() {
    let mut model = copies(&hub(8, false), 20);
    let mut draw = Draw(12);
    model.velocity.iter_mut().for_each(|v| *v = [2.0 * draw.next(), 2.0 * draw.next()]);
    model.gravity = [0.0; 2];
    let mut world = world(&to_strain(&path(&model), 0.02));
    assert!(kernel(&*world).starts_with("a crowd"));
    let start = world.sample(0.0).energy;
    frames(&mut *world, 300, |sample| assert!(sample.energy < 1.05 * start, "{} of {start} J", sample.energy));
}

/// A taut row between two pins with legs is singular: it is no tree that is eliminated.
#[test]
fn taut_combs_between_two_pins_are_moved_in_no_time() {
    let count = 1_100_u32;
    let row = (0..count).map(|i| [0.1 * f64::from(i), 0.0]);
    let legs = (1..count - 1).map(|i| [0.1 * f64::from(i), -0.1]);
    let ends: Vec<[u32; 2]> =
        (1..count).map(|i| [i - 1, i]).chain((1..count - 1).map(|i| [i, count + i - 1])).collect();
    let comb = bonded(row.chain(legs).collect(), &ends, BondKind::Rigid);
    let comb = Model { pinned: vec![PointId(0), PointId(count - 1)], ..comb };
    let mut world = world(&to_strain(&comb, 0.02));
    assert!(kernel(&*world).starts_with("a mesh"), "{}", kernel(&*world));
    assert!(frames(&mut *world, 6, |_| {}).energy.is_finite());
    // Counted: a frame takes some thousands of bonds some ten times.
    let passes = world.counters().bonds_solved as f64 / comb.bonds.len() as f64;
    assert!(passes < 6.0 * 600.0, "{passes} passes in six frames");
}

#[test]
fn large_trees_are_eliminated() {
    let model = tree(4, 5_000);
    let auto = Model { method: Method::default(), ..model };
    for model in [auto.clone(), to_strain(&auto, 1e-3)] {
        let mut world = world(&model);
        assert_eq!(kernel(&*world), "", "not a large body");
        assert!(frames(&mut *world, 6, |_| {}).max_strain < 1e-6);
    }
}
