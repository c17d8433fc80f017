//! What rigid bonds hold in its shape moves as one: exactly in flight, and by the laws of impact and friction where it meets something.

use serde_json::{Value, json};
use wobble::sim::Sample;

use super::rigid::strain;
use super::{run, world};

fn rigid() -> Value {
    json!({"kind": "rigid", "mass": 2})
}

fn lattice(origin: [f64; 2]) -> Value {
    json!({"make": "lattice", "columns": 7, "rows": 5, "spacing": 0.1, "origin": origin, "material": rigid()})
}

fn disc() -> Value {
    json!({"make": "disc", "radius": 0.3, "spacing": 0.1, "origin": [0, 0], "material": rigid()})
}

fn scene(bodies: &[Value]) -> Value {
    json!({"wobble": 1, "contact": true, "method": {"solver": "live"}, "bodies": bodies})
}

/// Mass, middle, velocity of the middle, moment of inertia and spin of all points that are given.
struct Motion {
    mass: f64,
    middle: [f64; 2],
    velocity: [f64; 2],
    inertia: f64,
    spin: f64,
}

fn motion(sample: &Sample, masses: &[f64]) -> Motion {
    let mass: f64 = masses.iter().sum();
    let mean = |list: &[[f64; 3]]| {
        [0, 1].map(|axis| list.iter().zip(masses).map(|(x, mass)| mass * x[axis]).sum::<f64>() / mass)
    };
    let (middle, velocity) = (mean(&sample.position), mean(&sample.velocity));
    let (mut inertia, mut turning) = (0.0, 0.0);
    for ((x, v), mass) in sample.position.iter().zip(&sample.velocity).zip(masses) {
        let r = [x[0] - middle[0], x[1] - middle[1]];
        inertia += mass * (r[0] * r[0] + r[1] * r[1]);
        turning += mass * (r[0] * v[1] - r[1] * v[0]);
    }
    Motion { mass, middle, velocity, inertia, spin: turning / inertia }
}

#[test]
fn it_flies_and_spins_as_a_rigid_body_does() {
    for body in [disc(), lattice([0.0, 0.0])] {
        let mut body = body;
        (body["spin"], body["velocity"]) = (json!(7), json!([1, 2]));
        let mut world = world(&scene(&[body]));
        let begins = motion(&world.sample(0.0), world.masses());
        let (energy, from) = (world.energy(), world.sample(0.0));
        while world.time() < 10.0 - 1e-9 {
            world.step();
        }
        let end = world.sample(world.time());
        let found = motion(&end, world.masses());
        assert!((world.energy() / energy - 1.0).abs() < 1e-9, "{} of {energy} J", world.energy());
        assert!(strain(&*world, &end) < 1e-12 && (found.spin - 7.0).abs() < 1e-9);
        // Turned by 70 rad about a middle that went straight on.
        let (sin, cos) = (7.0 * world.time()).sin_cos();
        for (x, now) in from.position.iter().zip(&end.position) {
            let r = [x[0] - begins.middle[0], x[1] - begins.middle[1]];
            let at = [
                begins.middle[0] + begins.velocity[0] * world.time() + cos * r[0] - sin * r[1],
                begins.middle[1] + begins.velocity[1] * world.time() + sin * r[0] + cos * r[1],
            ];
            assert!((now[0] - at[0]).hypot(now[1] - at[1]) < 1e-9, "{now:?}, not {at:?}");
        }
    }
}

#[test]
fn flat_on_a_floor_it_returns_as_restitution_says() {
    for restitution in [0.0, 0.3, 0.8, 1.0] {
        let mut body = lattice([-0.3, 0.3]);
        body["velocity"] = json!([0, -3]);
        let mut scene = scene(&[body]);
        scene["bounds"] = json!({"min": [-3, 0], "max": [3, 9], "restitution": restitution});
        let (end, world) = run(&scene, 0.3);
        let found = motion(&end, world.masses());
        assert!((found.velocity[1] / 3.0 - restitution).abs() < 0.01, "{restitution}: {:?}", found.velocity);
        assert!(found.spin.abs() < 0.02, "{restitution}: {} rad/s", found.spin);
    }
}

#[test]
fn on_a_corner_it_is_turned_as_the_impulse_says() {
    let falling = |restitution: f64| {
        let mut body = lattice([-0.3, 0.5]);
        (body["velocity"], body["angle"]) = (json!([0, -3]), json!(0.5));
        let mut scene = scene(&[body]);
        scene["bounds"] = json!({"min": [-3, 0], "max": [3, 9], "restitution": restitution, "friction": 0});
        scene
    };
    for restitution in [0.0, 0.5, 1.0] {
        let mut world = world(&falling(restitution));
        let begins = world.sample(0.0);
        let (before, masses) = (motion(&begins, world.masses()), world.masses().to_vec());
        let lowest = begins.position.iter().min_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
        let lever = lowest[0] - before.middle[0];
        while (motion(&world.sample(world.time()), &masses).velocity[1] + 3.0).abs() < 1e-6 && world.time() < 1.0 {
            world.step();
        }
        let after = motion(&world.sample(world.time()), &masses);
        // J = (1 + e) v/(1/m + x^2/I), at the lever x of the corner.
        let impulse = (1.0 + restitution) * 3.0 / (1.0 / before.mass + lever * lever / before.inertia);
        let (up, spin) = (impulse / before.mass - 3.0, lever * impulse / before.inertia);
        assert!((after.velocity[1] - up).abs() < 0.05, "{restitution}: {:?}, not {up} m/s", after.velocity);
        assert!((after.spin - spin).abs() < 0.02 * spin.abs() + 0.05, "{restitution}: {}, not {spin}", after.spin);
    }
}

#[test]
fn two_that_meet_head_on_share_their_momenta_as_restitution_says() {
    for restitution in [0.0, 0.5, 1.0] {
        let [mut left, mut right] = [lattice([-1.0, 0.0]), lattice([0.4, 0.0])];
        (left["velocity"], right["velocity"]) = (json!([2, 0]), json!([-1, 0]));
        right["material"]["mass"] = json!(6);
        let mut scene = scene(&[left, right]);
        scene["contact"] = json!({"restitution": restitution, "friction": 0});
        let (end, world) = run(&scene, 0.5);
        let (half, masses) = (end.position.len() / 2, world.masses());
        let of = |range: std::ops::Range<usize>| {
            let own = Sample {
                position: end.position[range.clone()].to_vec(),
                velocity: end.velocity[range.clone()].to_vec(),
                ..end.clone()
            };
            motion(&own, &masses[range])
        };
        let [left, right] = [of(0..half), of(half..2 * half)];
        let momentum = left.mass * left.velocity[0] + right.mass * right.velocity[0];
        assert!((momentum - (2.0 * left.mass - right.mass)).abs() < 1e-9, "{momentum} kg m/s");
        let apart = right.velocity[0] - left.velocity[0];
        assert!((apart / 3.0 - restitution).abs() < 0.01, "{restitution}: {apart} m/s apart");
        assert!(strain(&*world, &end) < 1e-12);
    }
}

#[test]
fn on_a_slope_it_slides_and_holds_by_coulombs_law() {
    let angle = 20.0_f64.to_radians();
    let g = [9.81 * angle.sin(), -9.81 * angle.cos()];
    for share in [0.5, 0.9, 1.1] {
        let mut scene = scene(&[lattice([0.0, 0.0])]);
        scene["gravity"] = json!(g);
        scene["obstacles"] = json!([{"plane": {"point": [0, 0], "normal": [0, 1]}, "friction": share * angle.tan()}]);
        let mut world = world(&scene);
        let mut at = Vec::new();
        for t in [1.0, 2.0, 3.0] {
            while world.time() < t - 1e-9 {
                world.step();
            }
            at.push(motion(&world.sample(world.time()), world.masses()).middle[0]);
        }
        let found = at[2] - 2.0 * at[1] + at[0];
        let right = (g[0] * (1.0 - share)).max(0.0);
        assert!((found - right).abs() < 0.02 * right + 1e-4, "at {share} of the limit: {found} m/s^2, not {right}");
    }
}

#[test]
fn a_pile_of_them_comes_to_rest_without_strain() {
    let bodies: Vec<Value> = (0..6)
        .map(|k| {
            if k % 2 == 0 {
                lattice([-0.3, 0.1 + 0.7 * f64::from(k)])
            } else {
                let mut disc = disc();
                disc["origin"] = json!([0.02 * f64::from(k), 0.4 + 0.7 * f64::from(k)]);
                disc
            }
        })
        .collect();
    let mut scene = scene(&bodies);
    scene["gravity"] = json!([0, -9.81]);
    scene["bounds"] = json!({"min": [-1, 0], "max": [1, 9], "friction": 0.5});
    scene["contact"] = json!({"friction": 0.5});
    let (end, world) = run(&scene, 8.0);
    assert!(world.is_asleep() && strain(&*world, &end) < 1e-9, "{}", strain(&*world, &end));
    assert!(world.counters().bonds_solved == 0, "no bond is asked");
}

/// Three equal discs in a row, the last with this much room before it: a blow goes through the middle one within a step.
#[test]
fn a_blow_goes_on_to_what_is_near() {
    for (solver, gap, speed) in [("auto", 0.02, 2.0), ("auto", 0.03, 4.0), ("auto", 0.04, 7.0), ("live", 0.3, 20.0)] {
        let disc = |x: f64, speed: f64| {
            let material = json!({"kind": "rigid", "mass": 1});
            let at = json!({"make": "disc", "radius": 0.25, "spacing": 0.1, "origin": [x, 1], "velocity": [speed, 0]});
            let mut disc = at;
            disc["material"] = material;
            disc
        };
        let scene = json!({
            "wobble": 1, "contact": {"restitution": 1, "friction": 0}, "method": {"solver": solver},
            "bodies": [disc(-1.5, speed), disc(0.0, 0.0), disc(0.5 + gap, 0.0)]
        });
        let mut world = world(&scene);
        // In each state that is seen, none is in another one.
        let count = world.masses().len() / 3;
        let middles = |list: &[[f64; 3]]| {
            [0, 1, 2].map(|k| list[k * count..(k + 1) * count].iter().map(|x| x[0]).sum::<f64>() / count as f64)
        };
        let end = 1.0 / speed + 0.5;
        while world.time() < end {
            let half = world.sample(world.time() + 0.5 * world.substep());
            let [a, b, c] = middles(&half.position);
            assert!(b - a > 0.48 && c - b > 0.48, "{solver}, {gap} m: {a}, {b}, {c} m");
            world.step();
        }
        let found = middles(&world.sample(world.time()).velocity).map(|v| v / speed);
        assert!(found[0].abs() < 1e-6 && found[1].abs() < 1e-6 && (found[2] - 1.0).abs() < 1e-6, "{solver}: {found:?}");
    }
}
