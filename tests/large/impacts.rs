//! Bodies that keep their shape meet a floor as rigid bodies do.

use wobble::sim::{Bond, Bounds, Model, Sample};

use super::models::{G, disc, fastest, frames, hung, kernel, path, rims, sheet, single, to_strain, world};

/// Free, above a floor that is so far below the lowest point, to a strain of 0.02.
fn dropped(model: Model<2>, height: f64, (restitution, friction): (f64, f64)) -> Model<2> {
    let lowest = model.position.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
    let bounds = Bounds { min: [-1e3, lowest - height], max: [1e3; 2], restitution, friction };
    to_strain(&Model { pinned: Vec::new(), bounds: Some(bounds), ..model }, 0.02)
}

/// Mean of a list of vectors, one entry a point.
fn mean(vectors: &[[f64; 3]]) -> [f64; 2] {
    [0, 1].map(|k| vectors.iter().map(|v| v[k]).sum::<f64>() / vectors.len() as f64)
}

/// Moment of inertia about the centre, and angular velocity, of points of mass 1.
fn turning(sample: &Sample) -> (f64, f64) {
    let (c, u) = (mean(&sample.position), mean(&sample.velocity));
    let (mut inertia, mut momentum) = (0.0, 0.0);
    for (x, v) in sample.position.iter().zip(&sample.velocity) {
        let arm = [x[0] - c[0], x[1] - c[1]];
        inertia += arm[0] * arm[0] + arm[1] * arm[1];
        momentum += arm[0] * (v[1] - u[1]) - arm[1] * (v[0] - u[0]);
    }
    (inertia, momentum / inertia)
}

/// A braced sheet of so many columns and rows, turned by an angle.
fn turned(size: [u32; 2], angle: f64) -> Model<2> {
    let mut model = sheet::<2>(size, [true; 2]);
    for x in &mut model.position {
        *x = [x[0] * angle.cos() - x[1] * angle.sin(), x[0] * angle.sin() + x[1] * angle.cos()];
    }
    model
}

#[test]
fn without_restitution_nothing_bounces() {
    let bodies = [disc(2.05), sheet::<2>([50, 25], [true, false])];
    for body in bodies.iter().cloned().chain(bodies.iter().map(single)) {
        let mut world = world(&dropped(body, 1.0, (0.0, 0.3)));
        let left = fastest(&frames(&mut *world, 120, |_| {}));
        assert!(left < 1e-3, "{}: {left} m/s", kernel(&*world));
    }
}

/// They rock from corner to corner, and lose a share of their motion with each.
#[test]
fn each_of_a_crowd_is_struck_for_itself() {
    let mut model = path(&dropped(rims(20), 1.0, (0.0, 0.3)));
    for (i, v) in model.velocity.iter_mut().enumerate() {
        v[0] = 0.1 * (i / 26) as f64;
    }
    let mut world = world(&model);
    let mut energies = Vec::new();
    frames(&mut *world, 360, |sample| energies.push(sample.energy));
    assert_eq!(kernel(&*world), "a crowd by paths");
    let fall = energies[0] - energies[40];
    assert!(fall > 0.5 * 20.0 * 26.0 * G && energies[359] < energies[60]);
    let most = energies.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    assert!(most < 0.002 * fall, "a gain of {most} J of {fall}");
}

#[test]
fn a_disc_bounces_to_the_square_of_the_restitution() {
    for restitution in [0.3, 0.6, 1.0] {
        let mut world = world(&dropped(disc(2.05), 1.0, (restitution, 0.0)));
        let fall = (2.0 / G).sqrt();
        let mut top = f64::NEG_INFINITY;
        frames(&mut *world, (60.0 * fall * (1.0 + 1.5 * restitution)) as usize, |sample| {
            if sample.time > fall + 0.02 {
                top = top.max(mean(&sample.position)[1] + 1.0);
            }
        });
        let truth = restitution * restitution;
        assert!((top - truth).abs() < 0.01, "{top} m for {truth}");
    }
}

/// A rigid body that hits with one point, at a distance x from its centre along the floor, gets the impulse
/// (1 + e) v/(1/m + x^2/I) there.
#[test]
fn a_corner_strikes_as_the_closed_form_says() {
    for (restitution, angle) in [(0.3, 0.3), (0.5, 0.6), (1.0, 0.9)] {
        let model = dropped(turned([45, 25], angle), 1.0, (restitution, 0.0));
        let mut world = world(&model);
        let mut before = world.sample(0.0);
        let after = loop {
            world.step();
            let sample = world.sample(world.time());
            if turning(&sample).1.abs() > 1e-3 {
                // Velocities of now are the mean of those before and after.
                world.step();
                break world.sample(world.time());
            }
            assert!(sample.time < 1.0, "it never hit");
            before = sample;
        };
        let m = before.position.len() as f64;
        let lowest = before.position.iter().min_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
        let (x, inertia) = (lowest[0] - mean(&before.position)[0], turning(&before).0);
        let speed = (2.0 * G).sqrt();
        let impulse = (1.0 + restitution) * speed / (1.0 / m + x * x / inertia);
        let turn = turning(&after).1;
        let truth = x * impulse / inertia;
        assert!((turn - truth).abs() < 0.02 * truth.abs(), "{turn} 1/s for {truth}");
        let hit = (2.0 / G).sqrt();
        let truth = impulse / m - speed - G * (after.time - hit);
        let rise = mean(&after.velocity)[1];
        assert!((rise - truth).abs() < 0.02 * speed, "{rise} m/s for {truth}");
    }
}

#[test]
fn a_block_slides_to_a_stop_as_friction_says() {
    let mut model = dropped(sheet::<2>([50, 25], [true; 2]), 0.0, (0.0, 0.2));
    model.velocity.fill([1.0, 0.0]);
    let mut world = world(&model);
    let (mut slid, mut most) = (0.0_f64, 0.0_f64);
    frames(&mut *world, 60, |sample| {
        let truth = (1.0 - 0.2 * G * sample.time).max(0.0);
        most = most.max((mean(&sample.velocity)[0] - truth).abs());
        slid = mean(&sample.position)[0] - 2.45;
    });
    assert!(most < 0.02, "{most} m/s off");
    assert!((slid - 0.5 / (0.2 * G)).abs() < 0.01, "{slid} m");
}

#[test]
fn what_bends_or_breaks_is_struck_point_by_point() {
    let net = dropped(sheet::<2>([40, 30], [false; 2]), 1.0, (0.0, 0.0));
    let mut brittle = dropped(disc(2.05), 1.0, (0.0, 0.0));
    brittle.velocity.fill([0.0, -30.0]);
    brittle.bonds = brittle.bonds.iter().map(|bond| Bond { break_strain: 1e-4, ..bond }).collect();
    for (model, breaks) in [(net, false), (brittle, true)] {
        let mut world = world(&model);
        let start = world.sample(0.0).energy;
        let mut most = start;
        frames(&mut *world, 90, |sample| most = most.max(sample.energy));
        assert!(world.is_finite() && most < start + 1.0, "{most} J of {start}");
        assert_eq!(world.counters().bonds_torn > 0, breaks);
    }
}

/// What strain a step leaves is not mended within the time from it to a sample just after it.
#[test]
fn a_sample_a_hair_after_a_step_is_that_of_the_step() {
    let turning = {
        let mut model = dropped(disc(2.05), 1.0, (0.5, 0.3));
        model.velocity.iter_mut().zip(&model.position).for_each(|(v, x)| *v = [-9.0 * x[1], 9.0 * x[0]]);
        model
    };
    for model in [turning, to_strain(&hung::<2>([40, 37], [true; 2]), 0.02)] {
        let mut world = world(&model);
        for _ in 0..40 {
            world.step();
            let [at, after] = [0.0, 1e-9].map(|late| world.sample(world.time() + late));
            let jump = at.velocity.iter().zip(&after.velocity).map(|(u, v)| (u[0] - v[0]).hypot(u[1] - v[1]));
            let jump = jump.fold(0.0, f64::max);
            assert!(jump < 0.01 * fastest(&at).max(0.1), "{jump} m/s at {}", at.time);
        }
    }
}
