//! Rigid bodies by the rules of `auto`: three degrees of freedom, Coulomb's law, and no energy from nowhere.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod between;
mod breaks;
mod corner;
mod digits;
mod odd;
mod swings;

use std::f64::consts::PI;

use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::scene::record::ledgers;
use wobble::sim::{Command, Dynamics, Sample, Selection, Solver, judge};

pub(super) fn world(scene: &Value) -> Box<dyn Dynamics> {
    Scene::parse(&scene.to_string(), "scene").unwrap().world(None).unwrap()
}

/// Runs to a time; the rigid method moves all of it to the end.
pub(super) fn run(world: &mut dyn Dynamics, t: f64) -> Sample {
    while world.time() + world.substep() <= t + 1e-9 {
        world.step();
    }
    assert!(world.moved_by().iter().all(|moved| moved.method == Solver::Rigid), "{:?}", world.moved_by());
    world.sample(t)
}

fn rigid() -> Value {
    json!({"kind": "rigid", "mass": 2})
}

fn a_box(origin: [f64; 2], velocity: [f64; 2]) -> Value {
    json!({"make": "box", "width": 1, "height": 1, "origin": origin, "velocity": velocity, "material": rigid()})
}

fn on_floor(gravity: [f64; 2], body: &Value, [friction, restitution]: [f64; 2]) -> Value {
    json!({"wobble": 1, "gravity": gravity, "bodies": [body],
        "bounds": {"min": [-900, 0], "max": [900, 900], "friction": friction, "restitution": restitution}})
}

fn middle(sample: &Sample, masses: &[f64]) -> [f64; 2] {
    let mass: f64 = masses.iter().sum();
    [0, 1].map(|axis| sample.position.iter().zip(masses).map(|(x, m)| m * x[axis]).sum::<f64>() / mass)
}

/// A triangle of three points of 1 kg, its lower side on the floor.
fn triangle(speed: f64) -> Value {
    json!({"points": {"position": [[0, 0], [1, 0], [0.5, 0.8]], "velocity": [[speed, 0], [speed, 0], [speed, 0]], "mass": [1, 1, 1]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 0}]})
}

#[test]
fn what_slides_stops_after_v_square_over_2_mu_g() {
    let expected = 1.0 / (2.0 * 0.3 * 9.81);
    let mut boxed = world(&on_floor([0.0, -9.81], &a_box([0.0, 0.5], [1.0, 0.0]), [0.3, 0.0]));
    let way = middle(&run(&mut *boxed, 2.0), boxed.masses())[0];
    assert!((way - expected).abs() < 1e-9, "{way} {expected}");
    let mut scene = triangle(1.0);
    scene["wobble"] = json!(1);
    scene["gravity"] = json!([0, -9.81]);
    scene["bounds"] = json!({"min": [-9, 0], "max": [9, 9], "friction": 0.3, "restitution": 0});
    let mut three = world(&scene);
    let way = middle(&run(&mut *three, 2.0), three.masses())[0] - 0.5;
    assert!((way - expected).abs() < 1e-9, "{way} {expected}");
}

#[test]
fn on_a_slope_it_slides_by_coulombs_law_or_stays_where_it_is() {
    let angle: f64 = 0.35;
    let gravity = [9.81 * angle.sin(), -9.81 * angle.cos()];
    let mut slides = world(&on_floor(gravity, &a_box([0.0, 0.5], [0.0; 2]), [0.2, 0.0]));
    let way = middle(&run(&mut *slides, 3.0), slides.masses())[0];
    let expected = 0.5 * 9.81 * (angle.sin() - 0.2 * angle.cos()) * 9.0;
    assert!((way - expected).abs() < 1e-9 * expected, "{way} {expected}");
    let mut scene = on_floor(gravity, &a_box([0.0, 0.5], [0.0; 2]), [0.5, 0.0]);
    scene["method"] = json!({"sleep": false});
    let mut holds = world(&scene);
    let way = middle(&run(&mut *holds, 10.0), holds.masses())[0];
    assert!(way.abs() < 1e-10, "{way}");
}

#[test]
fn up_a_slope_and_down_again_each_way_takes_its_own_friction() {
    let (angle, mu, speed): (f64, f64, f64) = (0.4, 0.2, 3.0);
    let gravity = [-9.81 * angle.sin(), -9.81 * angle.cos()];
    let mut up = world(&on_floor(gravity, &a_box([0.0, 0.5], [speed, 0.0]), [mu, 0.0]));
    let [slow, fast] = [1.0, -1.0].map(|sign| 9.81 * (angle.sin() + sign * mu * angle.cos()));
    let (turn, top) = (speed / slow, speed * speed / (2.0 * slow));
    let expected = top - 0.5 * fast * (2.0 - turn) * (2.0 - turn);
    let way = middle(&run(&mut *up, 2.0), up.masses())[0];
    assert!((way - expected).abs() < 1e-8, "{way} {expected}");
}

#[test]
fn restitution_1_neither_gains_nor_loses() {
    let tilted = json!({"make": "box", "width": 1, "height": 0.6, "angle": 0.3, "origin": [0, 3], "velocity": [1, 0], "material": rigid()});
    let lattice = json!({"make": "lattice", "columns": 6, "rows": 4, "spacing": 0.2, "angle": 0.2, "origin": [0, 2], "material": rigid()});
    let bodies =
        [(a_box([0.0, 2.0], [0.0; 2]), 9.81), (a_box([0.0, 2.0], [0.0; 2]), 1000.0), (tilted, 9.81), (lattice, 1000.0)];
    for (body, g) in bodies {
        for friction in [0.0, 0.4] {
            let mut scene = on_floor([0.0, -g], &body, [friction, 1.0]);
            scene["bounds"]["max"] = json!([900, 4]);
            let mut world = world(&scene);
            let (start, mut bounces) = (world.energy(), 0);
            while bounces < 20 && world.time() < 60.0 {
                world.step();
                bounces = world.counters().events;
            }
            let gain = world.energy() / start - 1.0;
            assert!(bounces >= 20 && gain < 1e-12, "{body} {g}: {gain} after {bounces} bounces");
            assert!(friction > 0.0 || gain > -1e-12, "{body} {g}: {gain}");
        }
    }
}

#[test]
fn in_flight_it_spins_in_closed_form_at_no_cost_of_its_bonds() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "drag_rate": 0.3,
        "bodies": [{"make": "disc", "radius": 0.5, "spacing": 0.05, "material": rigid(), "spin": 40, "velocity": [3, 8]}]});
    let mut world = world(&scene);
    let (from, masses) = (world.sample(0.0), world.masses().to_vec());
    let start = middle(&from, &masses);
    let end = run(&mut *world, 5.0);
    let (rate, t): (f64, f64) = (0.3, 5.0);
    let kept = (-rate * t).exp();
    let turned = 40.0 * (1.0 - kept) / rate;
    // Terminal velocity is g/rate.
    let fall = 9.81 / rate;
    let middle = [start[0] + 3.0 * (1.0 - kept) / rate, start[1] - fall * t + (8.0 + fall) * (1.0 - kept) / rate];
    for (a, b) in from.position.iter().zip(&end.position) {
        let (r, (sin, cos)) = ([a[0] - start[0], a[1] - start[1]], turned.sin_cos());
        let expected = [middle[0] + cos * r[0] - sin * r[1], middle[1] + sin * r[0] + cos * r[1]];
        assert!((0..2).all(|k| (b[k] - expected[k]).abs() < 1e-10), "{b:?} {expected:?}");
    }
    assert_eq!(world.counters().bonds_solved, 0);
    let strain = world.bonds().iter().map(|bond| {
        let [a, b] = [bond.a, bond.b].map(|at| end.position[at.index()]);
        ((a[0] - b[0]).hypot(a[1] - b[1]) / bond.rest_length - 1.0).abs()
    });
    // Four roundings of places 100 m away, over bonds of 0.05 m.
    assert!(strain.fold(0.0, f64::max) < 4.0 * f64::EPSILON * 100.0 / 0.05);
}

/// Half a swing by the arithmetic and geometric mean.
fn half_period(length: f64, amplitude: f64, g: f64) -> f64 {
    let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    PI * (length / g).sqrt() / a
}

#[test]
fn on_a_pin_it_is_a_physical_pendulum() {
    // A square of four points of 1 kg with a side of 1 m, pinned at one corner: the pin takes one mass away.
    let scene = json!({"wobble": 1, "gravity": [0, -9.81],
        "points": {"position": [[0, 0], [1, 0], [1, 1], [0, 1]], "mass": [1, 1, 1, 1], "pinned": [0]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 0}, {"a": 0, "b": 2}]});
    let mut world = world(&scene);
    // I = 1 + 2 + 1 and m d = 3 |(2/3, 2/3)|.
    let (inertia, lever) = (4.0, 8.0_f64.sqrt());
    let length = inertia / lever;
    // Its middle begins 135 degrees from below.
    let half = half_period(length, 0.75 * PI, 9.81);
    let there = run(&mut *world, half);
    let back = run(&mut *world, 2.0 * half);
    assert!(
        (there.position[2][0] + 1.0).abs() < 1e-6 && (there.position[2][1] - 1.0).abs() < 1e-6,
        "{:?}",
        there.position[2]
    );
    assert!(
        (back.position[2][0] - 1.0).abs() < 1e-6 && (back.position[2][1] - 1.0).abs() < 1e-6,
        "{:?}",
        back.position[2]
    );
}

#[test]
fn a_box_tips_over_its_corner_as_the_equation_says() {
    // It starts on a corner, its middle leaning by `lean` from above it: I theta'' = m g d sin(theta).
    let lean: f64 = 0.2;
    let body = json!({"make": "box", "width": 1, "height": 1, "angle": 0.25 * PI - lean, "origin": [0, 0.5_f64.sqrt() * lean.cos()], "material": rigid()});
    let mut world = world(&on_floor([0.0, -9.81], &body, [20.0, 0.0]));
    let (mass, square) = (2.0, 0.5);
    let inertia = mass * square + mass * square;
    let (d, t) = (0.5_f64.sqrt(), 0.5);
    let push = |theta: f64| mass * 9.81 * d * theta.sin() / inertia;
    let (mut theta, mut omega) = (lean, 0.0);
    let h = 1e-5;
    for _ in 0..50_000 {
        // Leapfrog: its error is 1e-10.
        omega += 0.5 * h * push(theta);
        theta += h * omega;
        omega += 0.5 * h * push(theta);
    }
    let end = run(&mut *world, t);
    let found = middle(&end, world.masses());
    let height = d * theta.cos();
    assert!((found[1] - height).abs() < 1e-4, "{found:?} {height}");
}

#[test]
fn it_goes_on_with_the_same_bits_from_any_copy_and_is_what_is_left_after_a_cut() {
    let body = json!({"make": "disc", "radius": 0.5, "spacing": 0.12, "material": rigid(), "spin": 5, "velocity": [3, 1], "origin": [0, 1]});
    let mut world = world(&on_floor([0.0, -9.81], &body, [0.4, 0.5]));
    let first = run(&mut *world, 0.7);
    let mut copy = world.boxed_clone();
    let ends = [&mut *world, &mut *copy].map(|world| run(world, 2.0).position);
    assert_eq!(ends[0], ends[1]);
    assert_ne!(first.position, ends[0]);
    // One bond less leaves it rigid; all bonds of a point let that go.
    let energy = world.energy();
    let at_0: Vec<_> = world
        .bonds()
        .iter()
        .enumerate()
        .filter(|(_, bond)| bond.a.0 == 0 || bond.b.0 == 0)
        .map(|(k, _)| wobble::sim::BondId(k as u32))
        .collect();
    world.apply(&Command::Delete(Selection { bonds: at_0, ..Selection::default() })).unwrap();
    assert!((world.energy() / energy - 1.0).abs() < 1e-9);
    world.step();
    let solvers: Vec<Solver> = world.moved_by().iter().map(|moved| moved.method).collect();
    assert!(solvers.contains(&Solver::Rigid) && solvers.len() == 2, "{solvers:?}");
}

#[test]
fn what_is_pinned_across_a_wall_makes_no_energy() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81],
        "points": {"position": [[0, -0.5], [1, -0.4], [0.2, 0.9]], "mass": [1, 1, 1], "pinned": [0]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 0}],
        "bounds": {"min": [-9, 0], "max": [9, 9], "restitution": 1}});
    let mut world = world(&scene);
    let mut most = f64::NEG_INFINITY;
    let start = world.energy();
    while world.time() < 3.0 {
        world.step();
        most = most.max(world.energy());
        assert!(world.is_finite());
    }
    assert!(most - start < 30.0 * 1e-2 + 3.0 * 9.81, "{most} of {start}");
}

#[test]
fn a_box_that_is_pinned_across_a_floor_is_held() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81],
        "bodies": [{"make": "box", "width": 2, "height": 1, "supports": 2, "origin": [0, 0], "pinned": [3]}],
        "bounds": {"min": [-50, 0], "max": [50, 50], "friction": 0.5, "restitution": 0.3}});
    let mut world = world(&scene);
    let (start, energy) = (world.sample(0.0), world.energy());
    while world.time() < 1.0 {
        world.step();
        assert!(world.energy() <= energy + 1e-9, "{} J of {energy} at {} s", world.energy(), world.time());
    }
    let end = world.sample(world.time());
    let gone = |(a, b): (&[f64; 3], &[f64; 3])| (a[0] - b[0]).hypot(a[1] - b[1]);
    let most = start.position.iter().zip(&end.position).map(gone).fold(0.0, f64::max);
    assert!(most < 1e-9, "{most} m");
}

#[test]
fn a_bead_on_a_spring_keeps_its_energy_as_it_bounces() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81],
        "points": {"position": [[0, 2], [0.8, 2.6]], "velocity": [[1, 0], [-1, 0]]},
        "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 1e4}],
        "bounds": {"min": [-1e4, 0], "max": [1e4, 1e6], "restitution": 1}});
    let mut world = world(&scene);
    let start = world.energy();
    while world.time() < 20.0 {
        world.step();
    }
    let off = (world.energy() / start - 1.0).abs();
    assert!(off < 1e-3, "off by {off} after 20 s");
}

#[test]
fn a_thrown_disc_among_polygons_costs_little_whatever_its_speed() {
    for speed in [5.0, 50.0, 200.0] {
        let scene = json!({"wobble": 1, "gravity": [0, -9.81],
            "bodies": [{"make": "disc", "radius": 0.5, "spacing": 0.05, "material": rigid(), "velocity": [speed, 0.3 * speed], "origin": [0, 2]}],
            "bounds": {"min": [-6, 0], "max": [6, 8], "friction": 0.4, "restitution": 0.5},
            "obstacles": [{"polygon": [[[-3, 1], [-2, 3], [-4, 3]]]}, {"polygon": [[[2, 4], [4, 4], [3, 6]]]}]});
        let mut world = world(&scene);
        let start = world.energy();
        while world.time() < 2.0 {
            world.step();
            assert!(world.energy() <= start * (1.0 + 1e-9));
        }
        assert!(world.counters().work_ms() < 200.0, "{} ms at {speed} m/s", world.counters().work_ms());
        let sample = world.sample(world.time());
        let is_in = |x: &[f64; 3]| x[0].abs() <= 6.0 + 1e-9 && x[1] >= -1e-9 && x[1] <= 8.0 + 1e-9;
        assert!(sample.position.iter().all(is_in));
    }
}

#[test]
fn what_hangs_on_a_spring_from_a_pin_alone_swings_on_it() {
    let (stiffness, mass, g) = (300.0_f64, 3.0, 9.81);
    let scene = json!({"wobble": 1, "gravity": [0, -g], "points": {"position": [[0, 0], [-0.5, -0.8], [0.5, -0.8], [0, 1]],
        "mass": [1, 1, 1, 1], "pinned": [3]}, "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 0},
        {"a": 0, "b": 3, "kind": "spring", "stiffness": stiffness, "rest": 1}]});
    let mut world = world(&scene);
    for t in [0.1, 0.5, 2.0] {
        let expected = mass * g / stiffness * ((stiffness / mass).sqrt() * t).cos() - mass * g / stiffness;
        let found = run(&mut *world, t).position[0][1];
        assert!((found - expected).abs() < 1e-4, "{t}: {found} {expected}");
    }
}

#[test]
fn what_the_mouse_gives_is_in_the_ledger() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "method": {"ledger": true},
        "mouse": {"strength": 300, "radius": 1, "track": [[0, -2, 0.2], [1, 2, 0.2]]},
        "bodies": [{"make": "disc", "radius": 0.4, "spacing": 0.1, "material": rigid(), "origin": [0, 0.4]}],
        "bounds": {"min": [-6, 0], "max": [6, 8], "friction": 0.4, "restitution": 0.5}});
    let list = ledgers(&mut *world(&scene), 2.0).unwrap();
    let (verdict, last) = (judge(&list), list.last().unwrap());
    assert!(verdict.passes() && verdict.is_told && last.book.mouse > 1.0, "{verdict:?} {:?}", last.book);
    let left = last.excess() + last.book.friction + last.book.impacts;
    assert!(left.abs() < 1e-4 * last.book.mouse, "{left} J of {:?}", last.book);
}

/// Between two planes that lean against each other, each by `slope` [rad].
fn in_a_groove(slope: f64, friction: f64, body: &Value) -> Value {
    let plane = |side: f64| json!({"plane": {"point": [0, 0], "normal": [side * slope.sin(), slope.cos()]}, "friction": friction});
    json!({"wobble": 1, "gravity": [0, -9.81], "bodies": [body], "obstacles": [plane(1.0), plane(-1.0)]})
}

#[test]
fn what_falls_into_a_groove_gains_nothing() {
    for degrees in [45.0_f64, 70.0] {
        for friction in [0.2, 0.6, 1.0, 3.0, 30.0] {
            for turn in [0.1, 0.9, 2.3] {
                let disc = json!({"make": "disc", "radius": 0.5, "spacing": 0.25, "material": rigid(), "origin": [0.03, 2], "spin": 9.0 * turn});
                let tilted = json!({"make": "box", "width": 1, "height": 1, "angle": turn, "material": rigid(), "origin": [0.03, 2.5]});
                for body in [disc, tilted] {
                    let mut world = world(&in_a_groove(degrees.to_radians(), friction, &body));
                    let start = world.energy();
                    while world.time() < 1.5 {
                        world.step();
                        assert!(
                            world.energy() < start * (1.0 + 1e-9),
                            "{body} {degrees} {friction}: {} of {start} J",
                            world.energy()
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn where_there_is_no_room_it_is_held() {
    let mut scene = on_floor([0.0, -9.81], &a_box([0.0, 0.6], [0.0, 0.0]), [0.5, 0.5]);
    scene["bounds"]["min"] = json!([-0.25, 0]);
    scene["bounds"]["max"] = json!([0.25, 9]);
    let mut world = world(&scene);
    let start = world.energy();
    while world.time() < 2.0 {
        world.step();
    }
    assert!(world.is_finite() && world.energy() <= start + 1e-9, "{} of {start} J", world.energy());
}

#[test]
fn strong_drag_leaves_the_speed_that_it_should() {
    // A pinned square of 1 m falls to the side: omega = m g d sin/(rate I), as slow as that is.
    let rate = 1e5;
    let points = json!({"position": [[0, 0], [1, 0], [1, 1], [0, 1]], "mass": [1, 1, 1, 1], "pinned": [0]});
    let bonds = json!([{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 0}, {"a": 0, "b": 2}]);
    let mut pinned =
        world(&json!({"wobble": 1, "gravity": [0, -9.81], "drag_rate": rate, "points": points, "bonds": bonds}));
    let end = run(&mut *pinned, 0.5);
    // Torque: the points at (1, 0) and (1, 1) have an arm of 1 m.
    let expected = 2.0 * 9.81 / (4.0 * rate);
    assert!((end.velocity[1][1] / -expected - 1.0).abs() < 1e-3, "{:?} {expected}", end.velocity[1]);
}

#[test]
fn in_a_narrow_slot_restitution_1_keeps_all() {
    let mut scene = on_floor([0.0, 0.0], &a_box([0.0, 0.5], [100.0, 0.0]), [0.0, 1.0]);
    scene["bounds"]["min"] = json!([-0.51, -5]);
    scene["bounds"]["max"] = json!([0.51, 9]);
    let mut world = world(&scene);
    let start = world.energy();
    while world.time() < 0.2 {
        world.step();
    }
    assert!(
        (world.energy() / start - 1.0).abs() < 1e-9 && world.counters().events > 500,
        "{} of {start} J",
        world.energy()
    );
}

#[test]
fn what_is_held_on_a_slope_pays_no_friction() {
    let angle: f64 = 0.3;
    let gravity = [9.81 * angle.sin(), -9.81 * angle.cos()];
    let mut scene = on_floor(gravity, &a_box([0.0, 0.5], [0.0; 2]), [0.9, 0.0]);
    scene["method"] = json!({"ledger": true, "sleep": false});
    let list = ledgers(&mut *world(&scene), 2.0).unwrap();
    let book = list.last().unwrap().book;
    assert!(book.friction.abs() + book.impacts.abs() < 1e-9, "{book:?}");
}

#[test]
fn far_from_the_origin_it_comes_to_rest() {
    let mut scene = on_floor([0.0, -9.81], &a_box([1e5, 2.0], [0.0; 2]), [0.5, 0.3]);
    scene["bounds"]["min"] = json!([9e4, 0]);
    scene["bounds"]["max"] = json!([2e5, 9]);
    let mut world = world(&scene);
    while world.time() < 6.0 {
        world.step();
    }
    assert!(world.is_asleep());
}

/// What cannot change its shape has areas that never resist: it moves as a rigid body all the same, among elastic walls and without a word.
#[test]
fn areas_of_what_is_rigid_change_nothing() {
    for kind in [json!({"kind": "spring", "stiffness": 2000}), json!({"kind": "rigid"})] {
        let body = json!({"make": "lattice", "columns": 5, "rows": 4, "spacing": 0.2, "origin": [-0.3, 1], "velocity": [20, -15],
            "spin": -7, "material": rigid()});
        let mut scene = on_floor([0.0, -1000.0], &body, [0.0, 1.0]);
        scene["bounds"]["min"] = json!([-2, 0]);
        scene["bounds"]["max"] = json!([2, 4]);
        scene["method"] = json!({"ledger": true});
        let without = run(&mut *world(&scene), 2.0);
        scene["areas"] = kind;
        let mut with = world(&scene);
        let end = run(&mut *with, 2.0);
        assert_eq!(end.position, without.position);
        let ledger = end.ledger.unwrap();
        assert!(ledger.left_over().abs() < 1e-6 * ledger.start, "{ledger:?}");
    }
}

#[test]
fn a_body_of_rigid_bonds_is_one_body_by_any_method_that_moves_states() {
    let scene = |solver: &str| {
        json!({"wobble": 1, "gravity": [0, -9.81], "method": {"solver": solver},
            "bodies": [{"make": "disc", "radius": 1, "spacing": 0.05, "velocity": [2, 5], "spin": 3}]})
    };
    let states =
        ["velocity-verlet", "pefrl", "blanes-moan-4", "blanes-moan-6", "rk2", "rk4", "rk8", "implicit-midpoint"];
    let moved = |solver: &str| {
        let mut world = world(&scene(solver));
        let start = world.sample(0.0).position[0];
        (0..60).for_each(|_| world.step());
        let method = world.moved_by()[0].method;
        (method, start, world.sample(1.0).position[0], world.counters().bonds_solved)
    };
    for solver in states {
        let (method, start, end, solved) = moved(solver);
        assert_eq!((method, solved), (Solver::Rigid, 0), "{solver}");
        // Its middle flies as a point does, and it turns by 3 rad.
        let (sin, cos) = 3.0_f64.sin_cos();
        let at = [2.0 + cos * start[0] - sin * start[1], 5.0 - 0.5 * 9.81 + sin * start[0] + cos * start[1]];
        let off = (end[0] - at[0]).hypot(end[1] - at[1]);
        assert!(off < 1e-7, "{solver}: {off} m");
    }
    assert_eq!(moved("xpbd").0, Solver::Xpbd);
}
