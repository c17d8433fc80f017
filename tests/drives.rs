//! Drives against closed forms: muscles, motors and servos, their work, their keys and their sleep.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use crate::common;

use common::physics::{angular_momentum, momentum, run_to, spring};
use wobble::sim::{
    Angle, AngleDrive, Angles, Bond, Command, Drive, Dynamics, Held, Key, Method, Model, PointId, Signal, Solver, Wave,
    angle_at, build,
};

fn wave(period: f64) -> Signal {
    Signal { wave: Some(Wave { period, phase: 0.0 }), held: None }
}

fn key(name: &str) -> Key {
    Key::of(name).unwrap()
}

fn held(name: &str, rate: f64) -> Signal {
    Signal { held: Some(Held { forth: key(name), back: None, rate }), wave: None }
}

fn method(solver: Solver, substep: f64) -> Method {
    Method { solver, substep: Some(substep), ledger: true, ..Method::default() }
}

const STIFFNESS: f64 = 90.0;
const MASS: f64 = 2.0;
const PERIOD: f64 = 1.3;
const AMPLITUDE: f64 = 0.2;
const REST: f64 = 1.5;

/// A mass on a muscle that hangs from a pin, in the plane without gravity.
fn oscillator(method: Method) -> Model<2> {
    let drive = Some(Drive { amplitude: AMPLITUDE, signal: wave(PERIOD) });
    Model {
        position: vec![[0.3, 0.1], [0.3 + REST, 0.1]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0, MASS],
        pinned: vec![PointId(0)],
        bonds: [Bond { drive, ..spring(0, 1, REST, STIFFNESS, 0.0) }].into(),
        method,
        ..Model::default()
    }
}

/// Where the mass is at a time, from its start [m]: u'' = -w^2 (u - A sin(f t)), u = u' = 0 at 0.
fn forced(t: f64) -> f64 {
    let (w, f) = ((STIFFNESS / MASS).sqrt(), std::f64::consts::TAU / PERIOD);
    AMPLITUDE * REST * w * w / (w * w - f * f) * ((f * t).sin() - f / w * (w * t).sin())
}

#[test]
fn a_mass_on_a_muscle_is_a_forced_oscillator_to_the_order_of_each_method() {
    let t = 2.0;
    let error = |solver: Solver, h: f64| {
        let sample = run_to(&mut *build(&oscillator(method(solver, h))).unwrap(), t);
        (sample.position[1][0] - 0.3 - REST - forced(t)).abs()
    };
    for (solver, h, most, order) in [
        (Solver::SymplecticEuler, 1e-3, 5e-3, 1.0),
        (Solver::Euler, 1e-4, 5e-3, 1.0),
        (Solver::BackwardEuler, 1e-4, 5e-3, 1.0),
        (Solver::Live, 1e-3, 5e-3, 1.0),
        (Solver::Verlet, 4e-3, 2e-4, 2.0),
        (Solver::VelocityVerlet, 4e-3, 2e-4, 2.0),
        (Solver::Rk2, 4e-3, 2e-4, 2.0),
        (Solver::ImplicitMidpoint, 4e-3, 2e-4, 2.0),
        (Solver::Pefrl, 0.02, 1e-5, 4.0),
        (Solver::BlanesMoan4, 0.02, 1e-5, 4.0),
        (Solver::Rk4, 0.02, 1e-5, 4.0),
        (Solver::BlanesMoan6, 0.05, 1e-6, 6.0),
        (Solver::Rk8, 0.1, 1e-6, 8.0),
    ] {
        let [coarse, fine] = [h, 0.5 * h].map(|h| error(solver, h));
        let found = (coarse / fine).log2();
        assert!(coarse < most && found > 0.75 * order, "{solver}: {coarse} {fine}, order {found}");
    }
    let usual = Method { sleeps: false, ..Method::default() };
    let sample = run_to(&mut *build(&oscillator(usual)).unwrap(), t);
    assert!((sample.position[1][0] - 0.3 - REST - forced(t)).abs() < 1e-4);
}

#[test]
fn energy_less_the_work_of_a_muscle_stays() {
    for (solver, h, share) in
        [(Solver::Rk4, 2e-3, 1e-8), (Solver::Pefrl, 2e-3, 1e-6), (Solver::VelocityVerlet, 1e-3, 1e-4), (Solver::Live, 2.5e-4, 7e-3)]
    {
        let ledger = run_to(&mut *build(&oscillator(method(solver, h))).unwrap(), 3.2).ledger.unwrap();
        // Of u = forced(t) against the spring of its own rest length.
        let speed = (forced(3.2 + 1e-6) - forced(3.2 - 1e-6)) / 2e-6;
        let truth = 0.5 * MASS * speed * speed + 0.5 * STIFFNESS * forced(3.2) * forced(3.2);
        let size = ledger.most_kinetic;
        assert!((ledger.book.drives - truth).abs() < 2.0 * share * size, "{solver}: {ledger:?}, work {truth}");
        assert!(size > 1.0 && ledger.left_over().abs() < share * size, "{solver}: {ledger:?}");
    }
}

/// Two masses on a rigid muscle that turn about their middle.
fn skaters(substep: f64, signal: Signal) -> Model<2> {
    let drive = Some(Drive { amplitude: -0.4, signal });
    Model {
        position: vec![[-1.0, 0.0], [1.0, 0.0]],
        velocity: vec![[0.0, -1.5], [0.0, 1.5]],
        mass: vec![2.0; 2],
        bonds: [Bond { drive, ..Bond::new(PointId(0), PointId(1), 2.0) }].into(),
        method: Method { budget: Some(6.0), ..method(Solver::Auto, substep) },
        ..Model::default()
    }
}

#[test]
fn skaters_that_draw_each_other_near_turn_faster_and_their_work_is_booked() {
    let run = |substep: f64| {
        let mut world = build(&skaters(substep, held("space", 2.0))).unwrap();
        world.apply(&Command::Key { key: key("space"), down: true }).unwrap();
        let sample = run_to(&mut *world, 1.5);
        let [a, b] = [0, 1].map(|i| sample.position[i]);
        let length = (a[0] - b[0]).hypot(a[1] - b[1]);
        assert!((length - 1.2).abs() < 1e-4 && sample.max_strain < 1e-4, "{length} m");
        assert!(momentum(&sample, &[2.0; 2]).iter().all(|p| p.abs() < 1e-9));
        let spin = angular_momentum(&sample, &[2.0; 2])[2];
        (spin, sample.ledger.unwrap())
    };
    let [(spin, ledger), (finer, fine)] = [1e-3, 5e-4].map(run);
    // 2 m r v = 6 kg m^2/s stays, so the energy grows by (2/1.2)^2.
    assert!((spin - 6.0).abs() < 0.15 && (finer - 6.0).abs() < 0.6 * (spin - 6.0).abs(), "{spin} {finer}");
    let work = 0.5 * 4.0 * 1.5 * 1.5 * ((2.0_f64 / 1.2).powi(2) - 1.0);
    assert!((ledger.book.drives - work).abs() < 0.05 * work, "{} J of {work} J", ledger.book.drives);
    assert!(ledger.left_over().abs() < 0.01 * work, "{ledger:?}");
    assert!(fine.left_over().abs() < 0.6 * ledger.left_over().abs(), "{} {}", fine.left_over(), ledger.left_over());
}

/// A wheel of one point on a bond about a pin, and a motor between it and another pin.
fn wheel(method: Method, motor: AngleDrive, bond: Bond) -> Model<2> {
    let position = vec![[1.0, 0.0], [0.0, 0.0], [0.0, -0.5]];
    let points = [0, 1, 2].map(PointId);
    let angle = angle_at(points, points.map(|point| position[point.index()]));
    Model {
        position,
        velocity: vec![[0.0; 2]; 3],
        mass: vec![1.0, 1.0, 3.0],
        pinned: vec![PointId(0), PointId(1)],
        bonds: [bond].into(),
        angles: Angles::of(vec![Angle { drive: Some(motor), ..angle }]),
        method,
        ..Model::default()
    }
}

#[test]
fn a_motor_winds_a_wheel_up_with_all_its_torque_then_holds_its_speed() {
    let motor = AngleDrive::Motor { speed: -8.0, torque: 1.5, signal: Signal::default() };
    let inertia = 3.0 * 0.25;
    let rate = |x: [f64; 3], v: [f64; 3]| (x[0] * v[1] - x[1] * v[0]) / (x[0] * x[0] + x[1] * x[1]);
    for (solver, h, tolerance) in [
        (Solver::Auto, None, 1e-3),
        (Solver::VelocityVerlet, Some(1e-3), 1e-4),
        (Solver::Rk4, Some(2e-3), 1e-7),
        (Solver::Live, Some(1e-3), 6e-3),
    ] {
        let method = Method { solver, substep: h, ledger: true, ..Method::default() };
        let mut world = build(&wheel(method, motor, Bond::new(PointId(1), PointId(2), 0.5))).unwrap();
        // Until 95 % of 8 rad/s are reached, after 3.8 s.
        let early = run_to(&mut *world, 2.0);
        let omega = rate(early.position[2], early.velocity[2]);
        assert!((omega + 1.5 / inertia * 2.0).abs() < 8.0 * tolerance, "{solver}: {omega}");
        let late = run_to(&mut *world, 8.0);
        let omega = rate(late.position[2], late.velocity[2]);
        assert!((omega + 8.0).abs() < 8.0 * tolerance, "{solver}: {omega}");
        let ledger = late.ledger.unwrap();
        let energy = 0.5 * inertia * 64.0;
        assert!((ledger.book.drives - energy).abs() < 10.0 * tolerance * energy, "{solver}: {ledger:?}");
        assert!(ledger.left_over().abs() < 10.0 * tolerance * energy, "{solver}: {ledger:?}");
    }
}

#[test]
fn a_servo_brings_its_angle_along_and_a_motor_lifts_no_more_than_it_can() {
    let servo = AngleDrive::Servo { amplitude: 0.7, signal: held("d", 3.0) };
    let mut model = wheel(Method::default(), servo, spring(1, 2, 0.5, 4000.0, 40.0));
    model.angles.list[0] = Angle { stiffness: 60.0, damping: 6.0, ..model.angles.list[0] };
    let mut world = build(&model).unwrap();
    world.apply(&Command::Key { key: key("d"), down: true }).unwrap();
    let turned = |x: [f64; 3]| x[1].atan2(x[0]) + std::f64::consts::FRAC_PI_2;
    let found = turned(run_to(&mut *world, 6.0).position[2]);
    assert!((found - 0.7).abs() < 1e-3, "{found} rad");
    world.apply(&Command::Key { key: key("d"), down: false }).unwrap();
    let found = turned(run_to(&mut *world, 12.0).position[2]);
    assert!(found.abs() < 1e-3, "{found} rad");
    // A weight of 3 kg at 0.5 m asks for 14.7 N m at the most: 10 hold it where they balance.
    let motor = AngleDrive::Motor { speed: 2.0, torque: 10.0, signal: Signal::default() };
    let stalled = Model { drag_rate: 3.0, gravity: [0.0, -9.81], ..wheel(Method::default(), motor, Bond::new(PointId(1), PointId(2), 0.5)) };
    let found = turned(run_to(&mut *build(&stalled).unwrap(), 8.0).position[2]);
    assert!((found - (10.0_f64 / (3.0 * 0.5 * 9.81)).asin()).abs() < 1e-3, "{found} rad");
}

#[test]
fn a_keyed_muscle_sleeps_until_its_key_and_one_that_moves_never() {
    let sleepy = Method { sleeps: true, budget: Some(6.0), ..Method::default() };
    let mut model = oscillator(sleepy);
    model.bonds = [Bond { drive: Some(Drive { amplitude: 0.2, signal: held("right", 5.0) }), ..spring(0, 1, REST, STIFFNESS, 60.0) }].into();
    let mut world = build(&model).unwrap();
    run_to(&mut *world, 1.0);
    assert!(world.is_asleep(), "at rest");
    world.apply(&Command::Key { key: key("right"), down: true }).unwrap();
    assert!(!world.is_asleep(), "the key wakes it");
    let sample = run_to(&mut *world, 8.0);
    assert!((sample.position[1][0] - 0.3 - 1.2 * REST).abs() < 1e-3 && world.is_asleep(), "{:?}", sample.position[1]);
    let mut moving = build(&oscillator(Method { sleeps: true, ..sleepy })).unwrap();
    run_to(&mut *moving, 3.0);
    assert!(!moving.is_asleep());
}
