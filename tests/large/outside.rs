//! What acts on large bodies: the mouse, led pins, bonds that break.

use wobble::sim::{Bond, Command, Cursor, Dynamics, Model, MouseForce, PointId, Profile, Region, Track};

use super::models::{fastest, frames, hung, path, sheet, to_strain, world};

#[test]
fn the_mouse_pushes_a_sheet_as_it_pushes_loose_points() {
    let mut model = Model { gravity: [0.0; 2], ..sheet::<2>([50, 41], [true; 2]) };
    let track = Track { knots: vec![(0.0, [0.1, -2.0])] };
    model.mouse =
        Some(MouseForce { strength: 30.0, radius: 0.9, region: Region::Round, profile: Profile::Smooth, track });
    // At an edge of the sheet, where the push is not balanced.
    let loose = Model { bonds: Default::default(), ..model.clone() };
    let momentum = |model: &Model<2>| {
        let sample = frames(&mut *world(model), 2, |_| {});
        sample.velocity.iter().fold([0.0; 2], |sum, v| [sum[0] + v[0], sum[1] + v[1]])
    };
    let (bound, free) = (momentum(&model), momentum(&loose));
    let off = (bound[0] - free[0]).hypot(bound[1] - free[1]);
    assert!(free[0] > 1.0 && off < 0.01 * free[0], "{bound:?} for {free:?}");
}

#[test]
fn pins_on_tracks_lead_a_sheet() {
    for (strain, columns, rows) in [(0.02, 40, 19), (1e-3, 24, 11)] {
        let mut model = to_strain(&hung::<2>([columns, rows], [true; 2]), strain);
        let columns = columns as usize;
        model.drag_rate = 1.0;
        for i in 0..columns {
            let start = model.position[i];
            let knots = vec![(0.0, start), (0.5, [start[0], start[1] + 1.0]), (1.0, [start[0] + 0.5, start[1] + 1.0])];
            model.pin_motion.push((PointId(i as u32), Track { knots }));
        }
        let mut world = world(&model);
        let mut most = 0.0_f64;
        let sample = frames(&mut *world, 180, |sample| {
            most = most.max(sample.max_strain);
            let t = sample.time;
            let rise = if t < 0.5 { 2.0 * t } else { 1.0 };
            let way = (t - 0.5).clamp(0.0, 0.5);
            for i in 0..columns {
                let truth = [model.position[i][0] + way, model.position[i][1] + rise];
                let off = (sample.position[i][0] - truth[0]).hypot(sample.position[i][1] - truth[1]);
                assert!(off < 1e-9, "pin {i} at {t}: {off:e} m");
            }
        });
        assert!(most < strain && fastest(&sample) < 0.1, "{most:e}, {:e} m/s", fastest(&sample));
        for (x, start) in sample.position.iter().zip(&model.position).skip(columns) {
            let off = (x[0] - start[0] - 0.5).hypot(x[1] - start[1] - 1.0);
            assert!(off < 0.5, "{off} m from where it was led");
        }
    }
}

#[test]
fn a_cloth_tears_and_falls_apart_without_a_jump() {
    for diagonals in [[true; 2], [false; 2]] {
        let mut model = to_strain(&sheet::<2>([40, 30], diagonals), 0.02);
        model.pinned = vec![PointId(0), PointId(39)];
        // A net is held to less.
        let break_strain = if diagonals[0] { 0.004 } else { 5e-4 };
        let bonds: Vec<Bond> = model.bonds.iter().map(|bond| Bond { break_strain, ..bond }).collect();
        model.bonds = bonds.into();
        for (i, v) in model.velocity.iter_mut().enumerate() {
            if i >= 960 && i % 40 < 15 && diagonals[0] {
                *v = [0.0, -12.0];
            }
        }
        let mut world = world(&model);
        let start = world.sample(0.0).energy;
        let mut most = start;
        frames(&mut *world, 60, |sample| most = most.max(sample.energy));
        assert!(world.is_finite());
        assert!(world.counters().bonds_torn > 50, "{}", world.counters().bonds_torn);
        assert!(most <= start + 1.0, "{most} J of {start} J");
    }
}

/// Two sheets far apart come to rest; the mouse wakes the one that it reaches.
#[test]
fn what_rests_sleeps_and_is_woken_alone() {
    let one = Model { drag_rate: 4.0, ..hung::<2>([40, 37], [true; 2]) };
    let points = one.position.len();
    let mut model = path(&to_strain(&one, 0.02));
    let far = |[x, y]: [f64; 2]| [x + 100.0, y];
    model.position.extend(one.position.iter().map(|&x| far(x)));
    model.velocity.extend(&one.velocity);
    model.mass.extend(&one.mass);
    let of = |point: PointId| PointId(point.0 + points as u32);
    model.pinned.extend(one.pinned.iter().map(|&pin| of(pin)));
    one.bonds.iter().for_each(|bond| model.bonds.push(Bond { a: of(bond.a), b: of(bond.b), ..bond }));
    let (region, profile) = (Region::Round, Profile::Smooth);
    model.mouse = Some(MouseForce { strength: 30.0, radius: 0.9, region, profile, track: Track::default() });
    let mut world = world(&model);
    assert_eq!(world.parts().len(), 1);
    let moved = |world: &mut dyn Dynamics, steps: u32| {
        let before = *world.counters();
        for _ in 0..steps {
            world.step();
        }
        (world.counters().points_moved - before.points_moved, world.counters().substeps - before.substeps)
    };
    let (mut rest, mut tries) = (moved(&mut *world, 60), 0);
    while !world.is_asleep() && tries < 20 {
        (rest, tries) = (moved(&mut *world, 60), tries + 1);
    }
    assert!(rest.0 > 0 && world.is_asleep(), "after {tries} s");
    assert_eq!(moved(&mut *world, 60), (0, 0), "asleep");
    world.apply(&Command::Cursor { to: Some(Cursor::at([50.0, 0.0])), by: 0.0 }).unwrap();
    assert!(world.is_asleep(), "the cursor is between them");
    world.apply(&Command::Cursor { to: Some(Cursor::at([102.0, -3.5])), by: 0.0 }).unwrap();
    let (awake, substeps) = moved(&mut *world, 30);
    assert!(!world.is_asleep() && awake > 0);
    assert_eq!(awake, substeps * points as u64, "only one of them");
    world.apply(&Command::Cursor { to: None, by: 0.0 }).unwrap();
    tries = 0;
    while !world.is_asleep() && tries < 20 {
        (rest, tries) = (moved(&mut *world, 60), tries + 1);
    }
    assert!(rest.0 > 0 && world.is_asleep(), "again after {tries} s");
}
