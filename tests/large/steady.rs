//! What passes over the bonds could feed energy into, and must not.

use wobble::sim::{Method, Model, PointId};

use super::models::{FRAME, copies, fastest, frames, hub, kernel, path, rims, sheet, single, to_strain, tree, world};

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
