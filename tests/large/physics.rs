//! How large bodies move: closed forms, conservation, reference runs.

use wobble::sim::{Bond, BondKind, Bounds, Method, Model, PointId, Sample, Solver};

use super::models::{
    Draw, FRAME, G, apart, disc, fastest, frames, hung, kernel, rims, rope, sheet, single, to_strain, world,
};

fn end(model: &Model<2>, count: usize) -> Sample {
    frames(&mut *world(model), count, |_| {})
}

/// One method at a substep of h [s].
fn by(model: &Model<2>, solver: Solver, h: f64) -> Model<2> {
    Model { method: Method { solver, substep: Some(h), ..model.method }, ..model.clone() }
}

fn kinetic(sample: &Sample) -> f64 {
    sample.velocity.iter().map(|v| 0.5 * (v[0] * v[0] + v[1] * v[1])).sum()
}

#[test]
fn a_sheet_falls_freely_as_the_closed_form_says() {
    let mut model = sheet::<2>([40, 37], [true; 2]);
    model.velocity.fill([1.5, 2.0]);
    let t = 1.0;
    let sample = end(&model, 60);
    for (x, start) in sample.position.iter().zip(&model.position) {
        let truth = [start[0] + 1.5 * t, start[1] + 2.0 * t - 0.5 * G * t * t];
        let off = (x[0] - truth[0]).hypot(x[1] - truth[1]);
        assert!(off < 1e-10, "{off:e} m");
    }
    let off = sample.velocity.iter().map(|v| (v[1] - (2.0 - G * t)).abs()).fold(0.0, f64::max);
    assert!(off < 1e-9, "{off:e} m/s");
}

#[test]
fn drag_slows_a_falling_sheet_to_second_order() {
    let (rate, t) = (1.7, 1.0);
    let off = |h: f64| {
        let model = Model { drag_rate: rate, ..sheet::<2>([40, 37], [true; 2]) };
        let sample = end(&by(&model, Solver::Path, h), 60);
        // v' = -g - rate v from rest: y = -g/rate (t - (1 - e^(-rate t))/rate).
        let fall = -G / rate * (t + (-rate * t).exp_m1() / rate);
        sample.position.iter().zip(&model.position).map(|(x, start)| (x[1] - start[1] - fall).abs()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (off(FRAME), off(FRAME / 2.0));
    assert!(coarse < 2e-3 && (3.5..4.5).contains(&(coarse / fine)), "{coarse:e} {fine:e}");
}

#[test]
fn a_free_sheet_keeps_its_momentum() {
    for diagonals in [[true; 2], [false; 2]] {
        let mut model = Model { gravity: [0.0; 2], ..sheet::<2>([40, 37], diagonals) };
        let mut draw = Draw(5);
        model.velocity.iter_mut().for_each(|v| *v = [draw.next() + 0.3, draw.next()]);
        let mass: Vec<f64> = (0..model.mass.len()).map(|i| 1.0 + (i % 3) as f64).collect();
        model.mass.clone_from(&mass);
        let sum = |velocity: &mut dyn Iterator<Item = [f64; 2]>| {
            velocity.zip(&mass).fold([0.0; 2], |sum, (v, m)| [sum[0] + m * v[0], sum[1] + m * v[1]])
        };
        let before = sum(&mut model.velocity.iter().copied());
        let sample = end(&model, 60);
        let after = sum(&mut sample.velocity.iter().map(|v| [v[0], v[1]]));
        let off = (after[0] - before[0]).hypot(after[1] - before[1]) / before[0].hypot(before[1]);
        assert!(off < 1e-9, "{diagonals:?}: {off:e}");
    }
}

/// A chain of 120 links that hangs down and swings a little: against all bonds solved together with an order of 8.
#[test]
fn a_chain_swings_as_the_direct_solver_says() {
    let count = 121_u32;
    let mut model = rope::<2>(count);
    for (i, x) in model.position.iter_mut().enumerate() {
        let tilt = 0.05_f64;
        *x = [0.1 * i as f64 * tilt.sin(), -0.1 * i as f64 * tilt.cos()];
    }
    let truth = end(&by(&model, Solver::Rk8, FRAME / 8.0), 120);
    let off = |h: f64| apart(&truth, &end(&by(&model, Solver::Path, h), 120));
    // Of order 1: bonds are taken in the directions that they have at the end of a substep.
    let [coarse, fine, finest] = [1.0, 2.0, 4.0].map(|parts| off(FRAME / parts));
    assert!(coarse < 0.02 && fine < 0.65 * coarse && finest < 0.65 * fine, "{coarse:e} {fine:e} {finest:e} m");
    let followed = apart(&truth, &end(&to_strain(&model, 1e-3), 120));
    assert!(followed < 0.02, "{followed:e} m");
}

/// Largest energy above the start's, and the largest kinetic energy [J].
fn gain(model: &Model<2>, count: usize) -> (f64, f64, f64) {
    let mut world = world(model);
    let start = world.sample(0.0).energy;
    let (mut most, mut moved, mut strain) = (0.0_f64, 0.0_f64, 0.0_f64);
    frames(&mut *world, count, |sample| {
        most = most.max(sample.energy - start);
        moved = moved.max(kinetic(sample));
        strain = strain.max(sample.max_strain);
    });
    (most, moved, strain)
}

#[test]
fn energy_does_not_grow() {
    let one = Model { pinned: vec![PointId(0)], ..sheet([40, 37], [true; 2]) };
    let two = Model { pinned: vec![PointId(0), PointId(39)], ..sheet([40, 37], [true; 2]) };
    let scenes = [
        ("rope", rope(1_000)),
        ("one corner", one),
        ("two corners", two),
        ("hung", hung([40, 37], [true; 2])),
        ("disc", disc(1.3)),
        ("rims", rims(40)),
    ];
    for (what, model) in scenes {
        for strain in [0.02, 1e-3] {
            let (most, moved, stretched) = gain(&to_strain(&model, strain), 300);
            assert!(most < 0.01 * moved + 1e-3, "{what} at {strain}: gains {most:e} J of {moved:e} J");
            assert!(stretched <= strain, "{what} at {strain}: {stretched:e}");
        }
    }
}

#[test]
fn a_rope_of_ten_thousand_keeps_its_strain_at_every_frame() {
    for (strain, model) in [(0.02, rope::<2>(10_000)), (1e-3, rope(10_000)), (1e-3, single(&rope(10_000)))] {
        let mut most = 0.0_f64;
        frames(&mut *world(&to_strain(&model, strain)), 120, |sample| {
            most = most.max(sample.max_strain);
        });
        assert!(most <= strain, "{most:e} for {strain}");
    }
}

#[test]
fn a_sheet_that_hangs_at_rest_stays_at_rest() {
    let kinds = [[true; 2], [true, false], [false, true], [false; 2]];
    for (diagonals, strain) in kinds.into_iter().flat_map(|kind| [(kind, 0.02), (kind, 1e-3)]) {
        for model in [hung::<2>([60, 50], diagonals), single(&hung([60, 50], diagonals))] {
            let mut most = 0.0_f64;
            let mut world = world(&to_strain(&model, strain));
            frames(&mut *world, 150, |sample| most = most.max(if sample.time > 1.0 { fastest(sample) } else { 0.0 }));
            assert!(most < 1e-4, "{diagonals:?} at {strain} in {:?}: {most:e} m/s", world.precision());
        }
    }
}

#[test]
fn samples_do_not_change_the_motion_and_their_velocities_are_those_of_the_positions() {
    for model in [rope::<2>(1_000), Model { pinned: vec![PointId(0)], ..sheet([40, 37], [true; 2]) }] {
        for (model, allowed) in [(to_strain(&model, 1e-3), 0.1), (by(&model, Solver::Path, FRAME / 8.0), 1e-10)] {
            let plain = {
                let mut world = world(&model);
                while world.time() < 20.5 * FRAME {
                    world.step();
                }
                world.sample(world.time())
            };
            let mut looked = world(&model);
            let mut samples = Vec::new();
            while looked.time() < 20.5 * FRAME {
                samples.push(looked.sample(looked.time()));
                looked.sample(looked.time() + 0.3 * looked.substep());
                looked.step();
            }
            assert!(plain == looked.sample(looked.time()));
            let h = looked.substep();
            let scale = fastest(&plain);
            let mut most = 0.0_f64;
            for three in samples.windows(3) {
                for i in 0..three[0].position.len() {
                    for k in 0..2 {
                        let slope = (three[2].position[i][k] - three[0].position[i][k]) / (2.0 * h);
                        most = most.max((slope - three[1].velocity[i][k]).abs() / scale);
                    }
                }
            }
            assert!(most < allowed, "{}: velocities off by {most:e} of themselves", kernel(&*looked));
        }
    }
}

/// A level rope that falls flat: no bond is loaded, so that every point is a free one.
#[test]
fn what_falls_flat_bounces_and_slides_as_a_free_point() {
    let level = |restitution, friction| {
        let mut model = Model { pinned: Vec::new(), ..rope::<2>(2_500) };
        model.velocity.fill([2.0, 0.0]);
        model.bounds = Some(Bounds { min: [-10.0, -1.0], max: [400.0, 5.0], restitution, friction });
        model
    };
    // Falls 1 m in t_1, bounces to restitution^2 of it.
    let t_1 = (2.0 / G).sqrt();
    let mut world = world(&level(0.5, 0.0));
    let mut top = f64::NEG_INFINITY;
    frames(&mut *world, 60, |sample| {
        if sample.time > t_1 + 0.02 && sample.time < 2.0 * t_1 {
            top = top.max(sample.position[1_234][1]);
        }
    });
    assert!((top + 0.75).abs() < 0.02, "{top}");
    // The impact takes friction G t_1 of the 2 m/s, sliding friction G a second.
    let sample = end(&level(0.0, 0.1), 60);
    let slowed = 2.0 - 0.1 * G * t_1 - 0.1 * G * (1.0 - t_1);
    assert!((sample.velocity[1_234][0] - slowed).abs() < 0.02);
    assert!((sample.position[1_234][1] + 1.0).abs() < 1e-9);
}

#[test]
fn a_sheet_dropped_on_a_floor_comes_to_rest_and_does_not_sink() {
    for model in [sheet::<2>([50, 25], [true; 2]), single(&sheet([50, 25], [true; 2]))] {
        let bounds = Bounds { min: [-5.0, -3.0], max: [10.0, 5.0], restitution: 0.0, friction: 0.5 };
        let mut world = world(&to_strain(&Model { bounds: Some(bounds), ..model }, 0.02));
        let (mut lowest, mut strain) = (f64::INFINITY, 0.0_f64);
        let sample = frames(&mut *world, 150, |sample| {
            lowest = sample.position.iter().map(|x| x[1]).fold(lowest, f64::min);
            strain = strain.max(sample.max_strain);
        });
        assert!(lowest > -3.0 - 1e-5, "{lowest}");
        // A blow may take more than the most substeps that there are.
        assert!(strain < 0.025 && fastest(&sample) < 5e-3, "{strain:e}, {:e} m/s", fastest(&sample));
    }
}

#[test]
fn springs_move_by_paths_as_by_verlet() {
    let spring = BondKind::Spring { stiffness: 400.0, damping: 0.0 };
    let mut model = rope::<2>(1_000);
    let bonds: Vec<Bond> = model.bonds.iter().map(|bond| Bond { kind: spring, ..bond }).collect();
    model.bonds = bonds.into();
    model.gravity = [0.0; 2];
    model.velocity[999] = [1.0, 0.0];
    let truth = end(&by(&model, Solver::VelocityVerlet, FRAME / 64.0), 60);
    let [coarse, fine] = [16.0, 32.0].map(|parts| apart(&truth, &end(&by(&model, Solver::Path, FRAME / parts), 60)));
    assert!(coarse < 4e-3 && fine < 0.65 * coarse, "{coarse:e} {fine:e} m");
}

/// A soft sheet that swings from two corners: by forces against the general solver of order 4.
#[test]
fn springs_move_by_forces_as_by_runge_kutta() {
    let spring = BondKind::Spring { stiffness: 400.0, damping: 0.3 };
    for (what, mut model) in [("sheet", sheet::<2>([30, 26], [true; 2])), ("mesh", disc(1.6)), ("crowd", rims(770))] {
        let bonds: Vec<Bond> = model.bonds.iter().map(|bond| Bond { kind: spring, ..bond }).collect();
        model.bonds = bonds.into();
        if model.pinned.is_empty() {
            model.pinned = vec![PointId(0), PointId(29)];
        }
        // Drawn out at the start: no spring is to be given its length.
        model.position.iter_mut().for_each(|x| x[0] *= 1.1);
        let truth = end(&by(&model, Solver::Rk4, FRAME / 32.0), 60);
        let off = |parts: f64| {
            let model = by(&model, Solver::VelocityVerlet, FRAME / parts);
            assert!(kernel(&*world(&model)).ends_with("by forces"), "{what}: {}", kernel(&*world(&model)));
            let sample = end(&model, 60);
            let faster = sample.velocity.iter().zip(&truth.velocity).map(|(v, u)| (v[0] - u[0]).hypot(v[1] - u[1]));
            (apart(&truth, &sample), faster.fold(0.0, f64::max), (sample.energy - truth.energy).abs())
        };
        let (coarse, fine) = (off(32.0), off(64.0));
        assert!(coarse.0 < 2e-3 && fine.0 < 0.6 * coarse.0, "{what}: {coarse:?} {fine:?}");
        assert!(fine.1 < 0.01, "{what}: {fine:?}");
    }
}

/// Twenty thousand points and more on springs: `auto` pushes them in substeps that resolve the fastest oscillation.
#[test]
fn large_springy_sheets_swing_with_their_energy_kept() {
    let mut model = hung::<2>([150, 140], [true; 2]);
    let spring = BondKind::Spring { stiffness: 2e4, damping: 0.0 };
    let bonds: Vec<Bond> = model.bonds.iter().map(|bond| Bond { kind: spring, ..bond }).collect();
    model.bonds = bonds.into();
    let mut world = world(&model);
    assert_eq!(kernel(&*world), "a sheet by forces");
    let start = world.sample(0.0).energy;
    let (mut most, mut moved) = (0.0_f64, 0.0_f64);
    frames(&mut *world, 30, |sample| {
        most = most.max((sample.energy - start).abs());
        moved = moved.max(kinetic(sample));
    });
    assert!(moved > 1e3 && most < 5e-3 * moved, "{most:e} of {moved:e} J");
    assert!(world.counters().substeps > 30 * 8, "{}", world.counters().substeps);
}

/// One spring too stiff for explicit steps, in a scene so large that others are pushed by forces.
#[test]
fn stiff_springs_stay_implicit_in_large_scenes() {
    let mut model = sheet::<2>([150, 140], [false; 2]);
    let spring = |stiffness| BondKind::Spring { stiffness, damping: 0.0 };
    let bonds: Vec<Bond> = model.bonds.iter().map(|bond| Bond { kind: spring(100.0), ..bond }).collect();
    model.bonds = bonds.into();
    for x in [[40.0, 0.0], [41.0, 0.0]] {
        model.position.push(x);
        model.velocity.push([0.0; 2]);
        model.mass.push(1.0);
    }
    let pair = Bond { kind: spring(3.1e7), ..Bond::new(PointId(21_000), PointId(21_001), 0.9) };
    model.bonds.push(pair);
    let sample = end(&model, 4);
    let length = sample.position[21_001][0] - sample.position[21_000][0];
    assert!((0.75..1.05).contains(&length), "{length}");
}

/// Pieces that other substeps fit fall on as one: breaking gives and takes no momentum.
#[test]
fn a_springy_sheet_that_tears_keeps_its_momentum() {
    let mut model = sheet::<2>([150, 140], [true; 2]);
    let spring = BondKind::Spring { stiffness: 500.0, damping: 1.0 };
    let bonds = model.bonds.iter().map(|bond| Bond { kind: spring, break_strain: 0.2, ..bond });
    model.bonds = bonds.collect::<Vec<_>>().into();
    let mut draw = Draw(3);
    model.velocity.iter_mut().for_each(|v| *v = [2.0 * draw.next(), 2.0 * draw.next()]);
    let mean = |list: &[[f64; 3]]| list.iter().map(|v| v[1]).sum::<f64>() / list.len() as f64;
    let start = model.velocity.iter().map(|v| v[1]).sum::<f64>() / model.velocity.len() as f64;
    let mut world = world(&single(&model));
    let sample = frames(&mut *world, 18, |_| {});
    assert!(world.counters().bonds_torn > 100, "{}", world.counters().bonds_torn);
    let off = mean(&sample.velocity) - (start - G * sample.time);
    assert!(off.abs() < 1e-3, "{off:e} m/s");
}
