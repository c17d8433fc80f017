//! The ledger of a world against closed forms: where energy comes from, where it goes, and what the method itself makes.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]

use crate::common;

use common::physics::{rim, run_to, spring};
use wobble::scene::record::{hash, ledgers};
use wobble::sim::{
    Bond, BondKind, Dynamics, Ledger, Limit, Method, Model, MouseForce, Plane, PointId, Profile, Region, Solver, Track,
    build, judge,
};

/// One point of 2 kg with a ledger, by a method with this substep [s].
fn point(solver: Solver, h: f64) -> Model<2> {
    Model {
        position: vec![[0.0, 0.0]],
        velocity: vec![[0.0, 0.0]],
        mass: vec![2.0],
        method: method(solver, h),
        ..Model::default()
    }
}

fn method(solver: Solver, h: f64) -> Method {
    Method { solver, substep: Some(h), ledger: true, ..Method::default() }
}

/// The ledger at a time.
fn ledger<const D: usize>(model: &Model<D>, t: f64) -> Ledger {
    run_to(&mut *build(model).unwrap(), t).ledger.unwrap()
}

/// Asserts that two energies are as near as `share` of the second.
fn near(found: f64, truth: f64, share: f64, what: &str) {
    assert!((found - truth).abs() <= share * truth.abs(), "{what}: {found} for {truth}");
}

#[test]
fn a_point_that_falls_keeps_its_energy() {
    let model = Model { gravity: [0.0, -9.81], velocity: vec![[1.0, 3.0]], ..point(Solver::VelocityVerlet, 0.01) };
    let ledger = ledger(&model, 2.0);
    near(ledger.now.kinetic, 1.0 + (3.0_f64 - 19.62).powi(2), 1e-12, "kinetic energy");
    near(ledger.now.gravity, 2.0 * 9.81 * (6.0 - 19.62), 1e-12, "gravity's");
    assert!(ledger.left_over().abs() < 1e-10 && ledger.start == 10.0, "{ledger:?}");
    assert_eq!((ledger.book.brought(), ledger.book.taken()), (0.0, 0.0));
    assert!(ledger.most_kinetic >= ledger.now.kinetic);
}

/// A rigid pendulum let go level, of 1 kg and 1 m.
fn pendulum(h: f64) -> Model<2> {
    Model {
        position: vec![[0.0, 0.0], [1.0, 0.0]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0; 2],
        pinned: vec![PointId(0)],
        bonds: [Bond::new(PointId(0), PointId(1), 1.0)].into(),
        gravity: [0.0, -9.81],
        method: method(Solver::VelocityVerlet, h),
        ..Model::default()
    }
}

#[test]
fn what_is_left_over_of_a_pendulum_is_of_the_methods_order() {
    let [coarse, fine] = [0.01, 0.005].map(|h| ledger(&pendulum(h), 0.4).left_over());
    assert!(coarse.abs() > 1e-6, "there is an error to see: {coarse}");
    assert!((3.5..4.5).contains(&(coarse / fine)), "order 2: {coarse} {fine}");
}

#[test]
fn a_damper_takes_what_the_oscillator_loses() {
    let (k, c, m) = (100.0, 0.8, 1.0);
    let model = |solver: Solver, h: f64| Model::<2> {
        position: vec![[0.0, 0.0], [1.5, 0.0]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0, m],
        pinned: vec![PointId(0)],
        bonds: [spring(0, 1, 1.0, k, c)].into(),
        method: method(solver, h),
        ..Model::default()
    };
    // x'' = -k x - c x': under the envelope exp(-c t/2).
    let (rate, t) = (0.5 * c / m, 1.7_f64);
    let w = (k / m - rate * rate).sqrt();
    let fall = 0.5 * (-rate * t).exp();
    let x = fall * ((w * t).cos() + rate / w * (w * t).sin());
    let v = -fall * (k / m / w) * (w * t).sin();
    let taken = 0.5 * k * 0.25 - 0.5 * (m * v * v + k * x * x);
    for (solver, h, share) in
        [(Solver::Rk4, 1e-3, 1e-8), (Solver::Pefrl, 1e-3, 1e-4), (Solver::VelocityVerlet, 1e-3, 1e-4)]
    {
        let ledger = ledger(&model(solver, h), t);
        near(ledger.book.dampers, taken, share, solver.name());
        assert!(ledger.left_over().abs() <= 2.0 * share * taken, "{solver}: {ledger:?}");
    }
    let error = |h: f64| {
        (ledger(&model(Solver::Rk8, h), 1.6).book.dampers - ledger(&model(Solver::Rk8, 1e-4), 1.6).book.dampers).abs()
    };
    let ratio = error(0.02) / error(0.01);
    assert!((12.0..20.0).contains(&ratio), "line integrals are of order 4: {ratio}");
}

#[test]
fn drag_takes_a_known_share() {
    let model = Model { drag_rate: 0.7, velocity: vec![[3.0, 4.0]], ..point(Solver::VelocityVerlet, 0.01) };
    near(ledger(&model, 1.0).book.drag, 25.0 * (1.0 - (-1.4_f64).exp()), 1e-9, "drag");
    assert!(ledger(&model, 1.0).left_over().abs() < 1e-8);
}

fn floor(restitution: f64, friction: f64, normal: [f64; 2]) -> Plane<2> {
    Plane { point: [0.0, 0.0], normal, restitution, friction, penalty: None }
}

#[test]
fn a_bounce_takes_what_restitution_leaves_out() {
    let e: f64 = 0.8;
    let drop = |e: f64| Model {
        position: vec![[0.0, 1.0]],
        gravity: [0.0, -10.0],
        planes: vec![floor(e, 0.0, [0.0, 1.0])],
        ..point(Solver::VelocityVerlet, 0.01)
    };
    // Hits at 0.447, 1.163, 1.735 s, …; 20 J before the first.
    for (t, bounces) in [(0.4, 0), (1.0, 1), (1.5, 2), (1.8, 3)] {
        let ledger = ledger(&drop(e), t);
        let taken = 20.0 * (1.0 - e.powi(2 * bounces));
        assert!((ledger.book.impacts - taken).abs() < 1e-4, "{t}: {} for {taken}", ledger.book.impacts);
        assert!(ledger.left_over().abs() < 1e-4, "{t}: {ledger:?}");
    }
    assert_eq!(ledger(&drop(1.0), 1.8).book.impacts, 0.0);
}

/// A point on a relaxed bond that swings about a pin, and one more that hangs on it.
#[test]
fn sweeps_over_relaxed_bonds_take_what_is_missing() {
    for (solver, most) in [(Solver::Verlet, 1e-9), (Solver::Xpbd, 0.01), (Solver::Live, 0.01)] {
        for gravity in [0.0, -9.81] {
            let kind = BondKind::Relaxed { relaxation: 0.3, max_correction: f64::INFINITY };
            let bond = |k: u32| Bond { kind, ..Bond::new(PointId(k), PointId(k + 1), [1.0, 0.5][k as usize]) };
            let model = Model::<2> {
                position: vec![[0.0, 0.0], [1.0, 0.0], [1.4, 0.3]],
                velocity: vec![[0.0, 0.0], [0.0, 2.0], [1.0, 0.0]],
                mass: vec![1.0; 3],
                pinned: vec![PointId(0)],
                bonds: [bond(0), bond(1)].into(),
                gravity: [0.0, gravity],
                method: Method { iterations: Some(4), ..method(solver, 0.002) },
                ..Model::default()
            };
            let ledger = ledger(&model, 2.0);
            let left = ledger.left_over().abs() / ledger.most_kinetic;
            assert!(left < most, "{solver:?}, {gravity}: {left} left over");
            assert!(ledger.book.relaxation > 0.01 || gravity != 0.0, "{solver:?}: {:?}", ledger.book);
        }
    }
}

#[test]
fn a_string_that_gets_taut_takes_what_its_ends_have_of_each_other() {
    // 2 kg fly at 2 m/s past a pin at 0.6 m: at the end of 1 m of string 1.6 m/s of that lead along it.
    let string = Bond { limit: Limit::Max, ..Bond::new(PointId(0), PointId(1), 1.0) };
    for (solver, left) in [
        (Solver::Auto, 1e-6),
        (Solver::VelocityVerlet, 1e-6),
        (Solver::Rk4, 1e-6),
        (Solver::Rk8, 1e-6),
        (Solver::Live, 0.05),
    ] {
        let flies = Model {
            position: vec![[0.0; 2], [0.6, 0.0]],
            velocity: vec![[0.0; 2], [0.0, 2.0]],
            mass: vec![1.0, 2.0],
            pinned: vec![PointId(0)],
            bonds: [string].into_iter().collect(),
            ..point(solver, 0.003)
        };
        let ledger = ledger(&flies, 1.0);
        near(ledger.book.impacts, 2.56, 2e-2, "what the string took");
        assert!(ledger.left_over().abs() < left, "{solver:?}: {ledger:?}");
    }
}

#[test]
fn friction_takes_its_force_times_the_way() {
    let (mu, angle) = (0.3, 0.5_f64);
    let normal = [-angle.sin(), angle.cos()];
    let down = [-angle.cos(), -angle.sin()];
    let model = Model {
        gravity: [0.0, -9.81],
        planes: vec![floor(0.0, mu, normal)],
        velocity: vec![down],
        ..point(Solver::VelocityVerlet, 0.01)
    };
    let sample = run_to(&mut *build(&model).unwrap(), 1.0);
    let [x, y, _] = sample.position[0];
    let ledger = sample.ledger.unwrap();
    let way = 1.0 + 0.5 * 9.81 * (angle.sin() - mu * angle.cos());
    near(x.hypot(y), way, 1e-9, "the way");
    near(ledger.book.friction, mu * 2.0 * 9.81 * angle.cos() * way, 1e-6, "friction");
    assert!(ledger.left_over().abs() < 1e-6 && ledger.book.impacts.abs() < 1e-12, "{ledger:?}");
    // Upwards it stops, and then stays: tan 0.2 is below the friction.
    let (mu, angle) = (0.5, 0.2_f64);
    let model = Model {
        planes: vec![floor(0.0, mu, [-angle.sin(), angle.cos()])],
        velocity: vec![[2.0 * angle.cos(), 2.0 * angle.sin()]],
        method: method(Solver::Auto, 0.01),
        ..model
    };
    let ledger = self::ledger(&model, 2.0);
    let way = 2.0 / (9.81 * (angle.sin() + mu * angle.cos()));
    near(ledger.book.friction, mu * 2.0 * 9.81 * angle.cos() * way, 1e-5, "friction until it stops");
    assert!(ledger.left_over().abs() < 1e-4, "{ledger:?}");
}

/// A mouse at the origin that pushes with 40/s^2 within 2 m.
fn mouse(knots: Vec<(f64, [f64; 2])>) -> MouseForce {
    MouseForce { strength: 40.0, radius: 2.0, region: Region::Round, profile: Profile::Smooth, track: Track { knots } }
}

#[test]
fn the_mouse_works_as_its_potential_falls() {
    for (solver, share) in [(Solver::VelocityVerlet, 1e-4), (Solver::Rk4, 1e-7)] {
        let model =
            Model { position: vec![[0.6, 0.8]], mouse: Some(mouse(vec![(0.0, [0.0, 0.0])])), ..point(solver, 0.002) };
        let ledger = ledger(&model, 1.0);
        // The integral of m S r (1 - r^2/R^2)^2 from 1 m to 2 m: m S R^2 (3/4)^3/6.
        let work = 2.0 * 40.0 * 4.0 * 0.75_f64.powi(3) / 6.0;
        near(ledger.book.mouse, work, share, solver.name());
        near(ledger.now.kinetic, work, 3.0 * share, "all of it is kinetic");
    }
}

/// A pin that is led at 2 m/s along x from 0.1 s on, and 3 kg behind it on a bond of 1 m.
fn towed(bond: Bond, solver: Solver) -> Model<2> {
    Model {
        position: vec![[0.0, 0.0], [-1.0, 0.0]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0, 3.0],
        pinned: vec![PointId(0)],
        bonds: [bond].into(),
        pin_motion: vec![(PointId(0), Track { knots: vec![(0.1, [0.0, 0.0]), (10.1, [20.0, 0.0])] })],
        method: method(solver, 0.002),
        ..Model::default()
    }
}

#[test]
fn a_led_pin_does_the_work_of_what_holds_it() {
    let (k, u, m) = (75.0, 2.0, 3.0);
    for solver in [Solver::Rk4, Solver::VelocityVerlet] {
        let ledger = ledger(&towed(spring(0, 1, 1.0, k, 0.0), solver), 1.1);
        // The pull of k u/w sin w t times u.
        let work = m * u * u * (1.0 - (k / m).sqrt().cos());
        near(ledger.book.pins, work, 1e-3, solver.name());
        assert!(ledger.left_over().abs() < 1e-3 * work);
    }
    let jerked = ledger(&towed(Bond::new(PointId(0), PointId(1), 1.0), Solver::VelocityVerlet), 1.0);
    near(jerked.book.pins, 0.5 * m * u * u, 1e-9, "a rod passes its velocity on at once");
    // A rod that hangs from a pin that goes sideways: what holds it works through the swing.
    let swung = |h: f64| {
        let mut model = towed(Bond::new(PointId(0), PointId(1), 1.0), Solver::VelocityVerlet);
        (model.position[1], model.gravity, model.method.substep) = ([0.0, -1.0], [0.0, -9.81], Some(h));
        ledger(&model, 0.5)
    };
    let [coarse, fine] = [0.004, 0.002].map(swung);
    // In the frame of the pin, where it does no work, energy is kept: m (v - u)^2/2 + m g y. So the work is m u times the change of v_x.
    assert!(fine.book.pins.abs() > 1.0, "{fine:?}");
    let ratio = coarse.left_over() / fine.left_over();
    assert!(fine.left_over().abs() < 1e-3 * fine.book.pins.abs() && (3.0..5.0).contains(&ratio), "{ratio} {fine:?}");
}

/// No group has what joins pins alone.
#[test]
fn a_led_pin_stretches_what_joins_it_to_a_pin() {
    let mut model = towed(spring(0, 1, 1.0, 75.0, 4.0), Solver::Rk4);
    model.pinned.push(PointId(1));
    let ledger = ledger(&model, 1.1);
    // From 1 m to 3 m.
    near(ledger.book.pins, 0.5 * 75.0 * 4.0, 1e-9, "half of the stiffness times the stretch squared");
    assert!(ledger.left_over().abs() < 1e-9, "{ledger:?}");
}

#[test]
fn a_ledger_changes_nothing_of_the_motion_and_nobody_pays_for_one_who_has_none() {
    let soft = BondKind::Spring { stiffness: 2e3, damping: 2.0 };
    for (kind, solver) in
        [(soft, Solver::Auto), (BondKind::Rigid, Solver::Auto), (soft, Solver::Xpbd), (BondKind::Rigid, Solver::Path)]
    {
        let mut model = rim(12, kind);
        model.gravity = [0.0, -9.81];
        model.planes =
            vec![Plane { point: [0.0, -2.5], normal: [0.1, 1.0], restitution: 0.4, friction: 0.3, penalty: None }];
        model.mouse = Some(mouse(vec![(0.0, [-3.0, 0.0]), (1.0, [3.0, 0.0])]));
        model.method = Method { solver, ..Method::default() };
        let run = |is_kept: bool| {
            let model = Model { method: Method { ledger: is_kept, ..model.method }, ..model.clone() };
            let mut world = build(&model).unwrap();
            let sample = run_to(&mut *world, 0.8);
            assert_eq!(sample.ledger.is_some(), is_kept);
            (hash(&[sample], 2), *world.counters())
        };
        assert_eq!(run(false), run(true), "{solver}: the same bits by the same work");
    }
}

/// A braced block of cells of 0.5 m, each point of 0.5 kg.
fn block([columns, rows]: [u32; 2], kind: BondKind, solver: Solver) -> Model<2> {
    let mut model = Model::<2> { gravity: [0.0, -9.81], ..Model::default() };
    for row in 0..rows {
        for column in 0..columns {
            model.position.push([0.5 * f64::from(column), 0.5 * f64::from(row)]);
        }
    }
    let mut join = |a: u32, b: u32| {
        let [p, q] = [model.position[a as usize], model.position[b as usize]];
        model.bonds.push(Bond { kind, ..Bond::new(PointId(a), PointId(b), (p[0] - q[0]).hypot(p[1] - q[1])) });
    };
    for row in 0..rows {
        for column in 0..columns {
            let i = row * columns + column;
            let (has_right, has_upper) = (column + 1 < columns, row + 1 < rows);
            if has_right {
                join(i, i + 1);
            }
            if has_upper {
                join(i, i + columns);
            }
            if has_right && has_upper {
                join(i, i + columns + 1);
                join(i + 1, i + columns);
            }
        }
    }
    model.velocity = vec![[0.0; 2]; model.position.len()];
    model.mass = vec![0.5; model.position.len()];
    model.method = Method { solver, ledger: true, ..Method::default() };
    model
}

fn is_large(world: &dyn Dynamics) -> bool {
    world.parts().iter().all(|part| !part.kernel.is_empty())
}

/// A rigid block of 12 kg, a large body, on a floor.
fn block_on_floor(restitution: f64, friction: f64) -> Model<2> {
    let mut model = block([8, 3], BondKind::Rigid, Solver::Path);
    model.method.max_strain = Some(1e-3);
    model.planes = vec![floor(restitution, friction, [0.0, 1.0])];
    assert!(is_large(&*build(&model).unwrap()));
    model
}

#[test]
fn friction_of_a_large_body_is_booked() {
    let mut model = block_on_floor(0.0, 0.2);
    model.velocity.iter_mut().for_each(|v| *v = [2.0, 0.0]);
    let sample = run_to(&mut *build(&model).unwrap(), 0.25);
    let way = sample.position[0][0];
    near(way, 2.0 * 0.25 - 0.5 * 0.2 * 9.81 * 0.0625, 0.05, "the way");
    near(sample.ledger.unwrap().book.friction, 0.2 * 12.0 * 9.81 * way, 0.05, "friction of a block");
}

#[test]
fn an_impact_of_a_large_body_is_booked() {
    let mut model = block_on_floor(0.5, 0.0);
    model.position.iter_mut().for_each(|x| x[1] += 0.2);
    let ledger = ledger(&model, 0.25);
    near(ledger.book.impacts, 0.75 * 0.2 * 12.0 * 9.81, 0.1, "the first bounce of a block");
}

#[test]
fn a_soft_large_body_that_lies_still_takes_nothing() {
    let kind = BondKind::Spring { stiffness: 2e4, damping: 60.0 };
    let mut model = block([18, 14], kind, Solver::Auto);
    model.planes = vec![floor(0.25, 0.6, [0.0, 1.0])];
    let mut world = build(&model).unwrap();
    assert!(is_large(&*world));
    let [early, late] = [4.0, 6.0].map(|t| run_to(&mut *world, t).ledger.unwrap());
    assert!(late.now.kinetic < 1e-3, "it lies still: {late:?}");
    // It sank by some millimetres: 126 kg fell that far.
    let taken = late.book.taken() - early.book.taken();
    assert!(taken < 0.01, "{taken} J in 2 s");
    let sank = early.start - early.now.gravity;
    assert!(late.left_over().abs() < 0.08 * sank, "{} J of {sank} J: {late:?}", late.left_over());
}

#[test]
fn a_large_body_is_towed() {
    let mut model = block([5, 3], BondKind::Rigid, Solver::Path);
    (model.gravity, model.pinned) = ([0.0; 2], vec![PointId(0)]);
    model.method.max_strain = Some(1e-3);
    model.pin_motion =
        vec![(PointId(0), Track { knots: vec![(0.0, [0.0, 0.0]), (0.5, [0.5, 0.0]), (1.0, [2.5, 0.0])] })];
    model.velocity.iter_mut().for_each(|v| *v = [1.0, 0.0]);
    let mut world = build(&model).unwrap();
    assert!(is_large(&*world));
    let early = run_to(&mut *world, 0.4).ledger.unwrap();
    assert!(early.book.pins.abs() < 1e-3 * early.now.kinetic, "as fast as the block: {early:?}");
    let late = run_to(&mut *world, 0.9).ledger.unwrap();
    assert!(late.book.pins > late.now.kinetic - early.now.kinetic - 0.02 * late.now.kinetic, "{late:?}");
    assert_eq!(late.book.untold, 0);
    (model.pinned, model.method.substep) = (vec![PointId(0), PointId(4)], None);
    assert!(ledger(&model, 0.6).book.untold > 0, "two pins that go different ways");
}

#[test]
fn what_grabs_breaks_and_commands_change_is_booked() {
    use wobble::sim::{Command, Cursor, Reach};
    let cursor = |x: f64| Command::Cursor { to: Some(Cursor::at([x, 0.0])), by: 0.3 };
    for solver in [Solver::VelocityVerlet, Solver::Auto] {
        let mut world = build(&point(solver, 0.002)).unwrap();
        world.apply(&cursor(0.0)).unwrap();
        world.apply(&Command::Grab(Reach::Points(vec![PointId(0)]))).unwrap();
        world.apply(&cursor(1.0)).unwrap();
        let ledger = run_to(&mut *world, 0.2).ledger.unwrap();
        assert!(ledger.now.kinetic > 1.0, "{ledger:?}");
        near(ledger.book.grab, ledger.now.kinetic, 1e-3, "all that it has is the grab's");
    }
    // A spring of 100 N/m that breaks at twice its length.
    let mut model = towed(Bond { break_strain: 1.0, ..spring(0, 1, 1.0, 100.0, 0.0) }, Solver::VelocityVerlet);
    (model.pin_motion, model.velocity[1]) = (Vec::new(), [-8.0, 0.0]);
    let ledger = ledger(&model, 1.0);
    near(ledger.book.breaks, 50.0, 0.01, "the spring's energy is gone");
    assert!(ledger.left_over().abs() < 0.05, "{ledger:?}");
    let mut world = build(&model).unwrap();
    run_to(&mut *world, 0.01);
    world.apply(&Command::Unpin(vec![PointId(0)])).unwrap();
    world.apply(&Command::Clear).unwrap();
    let cleared = run_to(&mut *world, 0.1).ledger.unwrap();
    near(cleared.book.commands, -cleared.start, 0.1, "what was deleted took all with it");
    assert!(cleared.left_over().abs() < 1e-3 * cleared.start, "{cleared:?}");
}

/// Its ledger once a frame, judged.
fn verdict(model: &Model<2>, end: f64) -> wobble::sim::Verdict {
    judge(&ledgers(&mut *build(model).unwrap(), end).unwrap())
}

#[test]
fn a_good_motion_is_told_from_a_bad_one() {
    assert!(verdict(&pendulum(1e-3), 3.0).passes());
    let circle = |solver: Solver| Model {
        position: vec![[0.0, 0.0], [1.0, 0.0]],
        velocity: vec![[0.0, 0.0], [0.0, 3.0]],
        mass: vec![1.0; 2],
        pinned: vec![PointId(0)],
        bonds: [spring(0, 1, 1.0, 30.0, 0.0)].into(),
        ..point(solver, 0.02)
    };
    let [gained, lost] = [Solver::Euler, Solver::BackwardEuler].map(|solver| verdict(&circle(solver), 3.0));
    assert!(gained.gains(), "{gained:?}");
    assert!(lost.loses() && !lost.gains(), "{lost:?}");
}

#[test]
fn losses_that_nothing_explains_show() {
    // Two beads on a rod that fall onto a floor which gives all back, by RATTLE, which meets surfaces at the ends of its substeps.
    let mut beads = pendulum(1e-3);
    (beads.position, beads.pinned) = (vec![[0.0, 1.2], [0.8, 1.8]], Vec::new());
    (beads.gravity, beads.planes) = ([0.0, -1000.0], vec![floor(1.0, 0.0, [0.0, 1.0])]);
    beads.method = Method { ledger: true, solver: Solver::VelocityVerlet, ..Method::default() };
    let found = verdict(&beads, 2.0);
    assert!(found.loses() && found.loss > 0.1, "{found:?}");
}
