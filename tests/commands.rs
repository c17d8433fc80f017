//! What commands do to a running world: what they name changes, all else keeps its bits, and a refused one changes nothing.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod grabs;
mod hovering;
mod islands;
mod meeting;
mod moves;
mod rest;
mod splits;

use crate::common::commands as random;
use crate::common::physics::run_to;

use random::Generator;
use wobble::scene::Scene;
use wobble::sim::{
    Addition, Bond, BondChange, BondId, BondKind, Bounds, BoundsChange, Change, Command, CommandError, Cursor,
    Dynamics, Method, Model, Motion, MouseChange, MouseForce, Obstacle, PointId, Polygon, Profile, Reach, Region,
    Sample, SceneChange, Selection, SkinMaterial, Track, Values, build,
};

fn spring(a: u32, b: u32, rest: f64) -> Bond {
    Bond { kind: BondKind::Spring { stiffness: 400.0, damping: 2.0 }, ..Bond::new(PointId(a), PointId(b), rest) }
}

/// Braced squares of side 1 side by side, 4 m apart: springs, rigid ones in turn.
fn boxes(count: u32) -> Model<2> {
    let mut model = Model {
        gravity: [0.0, -9.81],
        bounds: Some(Bounds { min: [-10.0, 0.0], max: [100.0, 20.0], restitution: 0.3, friction: 0.4 }),
        ..Model::default()
    };
    for k in 0..count {
        let (x, first) = (4.0 * f64::from(k), 4 * k);
        model.position.extend([[x, 1.0], [x + 1.0, 1.1], [x + 1.0, 2.1], [x, 2.0]]);
        for (a, b) in [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3)] {
            let rest = if a + 2 == b { 2.0_f64.sqrt() } else { 1.0 };
            let bond = spring(first + a, first + b, rest);
            let is_rigid = k % 2 == 1 && (a, b) != (1, 3);
            model.bonds.push(if is_rigid { Bond { kind: BondKind::Rigid, ..bond } } else { bond });
        }
    }
    model.velocity = vec![[0.5, 0.0]; model.position.len()];
    model.mass = vec![1.0; model.position.len()];
    model
}

fn steps(world: &mut dyn Dynamics, seconds: f64) {
    let end = world.time() + seconds;
    while world.time() + 0.5 * world.substep() < end {
        world.step();
    }
}

fn now(world: &dyn Dynamics) -> Sample {
    assert!(world.is_finite(), "the motion left the finite numbers");
    world.sample(world.time())
}

/// Bits of points' positions and velocities.
fn bits(sample: &Sample, points: std::ops::Range<usize>) -> Vec<[u64; 3]> {
    let both = points.clone().map(|i| sample.position[i]).chain(points.map(|i| sample.velocity[i]));
    both.map(|x| x.map(f64::to_bits)).collect()
}

fn numbers(range: std::ops::Range<u32>) -> Vec<PointId> {
    range.map(PointId).collect()
}

/// A braced square as an addition.
fn square(first: u32, [x, y]: [f64; 2]) -> Command {
    let bonds = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)];
    let length = |a: u32, b: u32| if a + 2 == b { 2.0_f64.sqrt() } else { 1.0 };
    Command::Add(Box::new(Addition {
        position: vec![[x, y, 0.0], [x + 1.0, y, 0.0], [x + 1.0, y + 1.0, 0.0], [x, y + 1.0, 0.0]],
        velocity: vec![[0.0; 3]; 4],
        mass: vec![1.0; 4],
        bonds: bonds.iter().map(|&(a, b)| spring(first + a, first + b, length(a, b))).collect(),
        ..Addition::default()
    }))
}

#[test]
fn numbers_are_stable_and_never_used_again() {
    let mut world = build(&boxes(2)).unwrap();
    world
        .apply(&Command::Delete(Selection { points: vec![PointId(1)], bonds: vec![BondId(4)], ..Selection::default() }))
        .unwrap();
    assert_eq!(world.gone(), [PointId(1)]);
    // Three bonds ended at the point.
    let left = [2, 3, 6, 7, 8, 9, 10, 11];
    assert_eq!(world.bond_numbers().unwrap(), left);
    assert!(world.bonds().iter().all(|bond| bond.a != PointId(1) && bond.b != PointId(1)));
    let applied = world.apply(&square(8, [20.0, 5.0])).unwrap();
    assert_eq!((applied.points, applied.bonds), (8..12, 12..17));
    assert_eq!(world.next_numbers(), [12, 17, 0]);
    assert!(world.positions().get(2).is_nan() && world.positions().get(4).is_finite());
    steps(&mut *world, 0.5);
    assert!(world.is_finite());
    let gone = world.apply(&Command::Pin(vec![PointId(1)]));
    assert_eq!(gone, Err(CommandError::NoSuch { kind: "point", number: 1 }));
    let gone = world.apply(&Command::Delete(Selection { bonds: vec![BondId(4)], ..Selection::default() }));
    assert_eq!(gone, Err(CommandError::NoSuch { kind: "bond", number: 4 }));
}

#[test]
fn a_pin_holds_and_lets_go_at_rest() {
    let mut world = build(&boxes(1)).unwrap();
    steps(&mut *world, 0.1);
    world.apply(&Command::Pin(vec![PointId(3)])).unwrap();
    let place = now(&*world).position[3];
    assert_eq!(world.pinned(), [PointId(3)]);
    steps(&mut *world, 0.5);
    assert_eq!(now(&*world).position[3], place);
    assert!(!world.apply(&Command::Pin(vec![PointId(3)])).unwrap().is_something, "it is held already");
    world.apply(&Command::Unpin(vec![PointId(3)])).unwrap();
    assert_eq!(now(&*world).velocity[3], [0.0; 3]);
    steps(&mut *world, 0.5);
    assert!(now(&*world).position[3][1] < place[1] - 0.1, "it falls");
}

#[test]
fn a_cut_takes_what_it_crosses_and_leaves_the_mass() {
    // A rope of six, cut between the third and the fourth.
    let mut model = Model { gravity: [0.0, -9.81], ..Model::default() };
    for i in 0..6_u32 {
        model.position.push([f64::from(i), 0.0]);
        if i > 0 {
            model.bonds.push(Bond::new(PointId(i - 1), PointId(i), 1.0));
        }
    }
    model.velocity = vec![[0.0; 2]; 6];
    model.mass = vec![1.0; 6];
    model.pinned = vec![PointId(0)];
    let mut world = build(&model).unwrap();
    assert!(
        !world.apply(&Command::Cut { from: Cursor::at([2.5, 1.0]), to: Cursor::at([2.5, 0.5]) }).unwrap().is_something
    );
    world.apply(&Command::Cut { from: Cursor::at([2.5, 1.0]), to: Cursor::at([2.5, -1.0]) }).unwrap();
    assert_eq!(world.bond_numbers().unwrap(), [0, 1, 3, 4]);
    steps(&mut *world, 0.5);
    let sample = now(&*world);
    for i in 3..6 {
        assert!((sample.position[i][1] + 0.5 * 9.81 * 0.25).abs() < 1e-9, "{i} falls freely");
    }
    let apart =
        |i: usize, j: usize| (0..2).map(|k| (sample.position[i][k] - sample.position[j][k]).powi(2)).sum::<f64>();
    assert!((apart(0, 1) - 1.0).abs() < 1e-9 && (apart(1, 2) - 1.0).abs() < 1e-9, "the rest hangs on");
}

#[test]
fn obstacles_come_move_and_go() {
    let drop = Model {
        position: vec![[0.0, 2.0]],
        velocity: vec![[0.0; 2]],
        mass: vec![1.0],
        gravity: [0.0, -10.0],
        ..Model::default()
    };
    let slab = |y: f64| {
        let loops = vec![vec![[-1.0, y - 0.5], [1.0, y - 0.5], [1.0, y], [-1.0, y]]];
        Obstacle::Polygon(Polygon { loops, restitution: 0.0, friction: 0.5 })
    };
    let mut world = build(&drop).unwrap();
    let added =
        world.apply(&Command::Add(Box::new(Addition { obstacles: vec![slab(0.0)], ..Addition::default() }))).unwrap();
    assert_eq!((added.obstacles, world.obstacle_numbers()), (0..1, [&[][..], &[0][..]]));
    steps(&mut *world, 1.5);
    assert!(now(&*world).position[0][1].abs() < 1e-6, "it lies on the slab");
    let down = Motion { obstacles: vec![0], by: [0.0, -1.0, 0.0], ..Motion::default() };
    world.apply(&Command::Move(down)).unwrap();
    steps(&mut *world, 1.5);
    assert!((now(&*world).position[0][1] + 1.0).abs() < 1e-6, "and where that went");
    world.apply(&Command::Delete(Selection { obstacles: vec![0], ..Selection::default() })).unwrap();
    assert_eq!(world.polygons().len(), 0);
    steps(&mut *world, 1.0);
    assert!((now(&*world).position[0][1] + 6.0).abs() < 0.1, "then it falls freely: {:?}", now(&*world).position);
}

#[test]
fn what_is_set_counts_from_now_on() {
    let mut world = build(&boxes(1)).unwrap();
    let scene = SceneChange { gravity: Some([1.0, 2.0, 0.0]), bounds: Some(None), ..SceneChange::default() };
    world.apply(&Command::Set(Change::Scene(Box::new(scene)))).unwrap();
    assert_eq!(world.bounds(), None);
    let mean = |world: &dyn Dynamics, axis: usize| now(world).position.iter().map(|x| x[axis]).sum::<f64>() / 4.0;
    let (x, y) = (mean(&*world, 0), mean(&*world, 1));
    steps(&mut *world, 1.0);
    let (t, h) = (world.time(), 1e-3);
    assert!((mean(&*world, 0) - (x + 0.5 * t + 0.5 * t * t)).abs() < h && (mean(&*world, 1) - (y + t * t)).abs() < h);
    let refused = world.apply(&Command::Set(Change::Bonds {
        bonds: vec![BondId(0)],
        to: Box::new(BondChange { relaxation: Some(Values::Same(0.5)), ..BondChange::default() }),
    }));
    assert!(matches!(refused, Err(CommandError::Invalid(why)) if why.contains("not relaxed")));
}

#[test]
fn a_refused_command_leaves_the_world_whole() {
    let mut world = build(&boxes(2)).unwrap();
    steps(&mut *world, 0.2);
    let before = now(&*world);
    let bad = Addition {
        position: vec![[f64::NAN, 0.0, 0.0]],
        velocity: vec![[0.0; 3]],
        mass: vec![1.0],
        ..Addition::default()
    };
    let nowhere = Motion { points: vec![PointId(99)], ..Motion::default() };
    let flat = Motion { points: vec![PointId(0)], scale: [0.0; 3], ..nowhere.clone() };
    for command in [
        Command::Add(Box::new(bad)),
        Command::Move(nowhere),
        Command::Move(flat),
        Command::Grab(Reach::Within(1.0)),
        Command::Cursor { to: Some(Cursor::at([f64::INFINITY, 0.0])), by: 0.0 },
        Command::Delete(Selection { obstacles: vec![7], ..Selection::default() }),
        Command::Set(Change::Points {
            points: numbers(0..2),
            mass: Some(Values::Each(vec![1.0])),
            velocity: None,
            skin: SkinMaterial::default(),
        }),
    ] {
        assert!(world.apply(&command).is_err(), "{command:?}");
    }
    assert_eq!(now(&*world), before);
    assert_eq!(world.topology(), 0);
}

fn hovered(radius: f64) -> Model<2> {
    let mouse =
        MouseForce { strength: 60.0, radius, region: Region::Round, profile: Profile::Smooth, track: Track::default() };
    Model { mouse: Some(mouse), gravity: [0.0; 2], bounds: None, ..boxes(1) }
}

#[test]
fn what_is_set_to_what_it_was_or_to_a_little_more_makes_nothing_anew() {
    let mut world = build(&Model { bounds: boxes(0).bounds, gravity: [0.0, -9.81], ..hovered(0.5) }).unwrap();
    let before = world.topology();
    let same = Change::Scene(Box::new(SceneChange { drag_rate: Some(0.0), ..SceneChange::default() }));
    assert!(!world.apply(&Command::Set(same)).unwrap().is_something);
    let strength = |strength| Command::Mouse(MouseChange { strength: Some(strength), ..MouseChange::default() });
    world.apply(&strength(61.0)).unwrap();
    let after = world.topology();
    assert!(after > before, "made for a stronger one");
    world.apply(&strength(70.0)).unwrap();
    world.apply(&strength(100.0)).unwrap();
    assert_eq!(world.topology(), after, "there is room");
    assert_eq!(world.mouse_force().unwrap().strength, 100.0);
}

#[test]
fn random_commands_leave_a_world_that_agrees_with_itself() {
    for seed in 0..40 {
        let mut generator = Generator::new(seed);
        let mut world = build(&boxes(3)).unwrap();
        let (mut done, mut refused) = (0, 0);
        for _ in 0..60 {
            let command = generator.command(&*world);
            match world.apply(&command) {
                Ok(_) => done += 1,
                Err(_) => refused += 1,
            }
            steps(&mut *world, 1.0 / 120.0);
            agrees(&*world, &format!("seed {seed} after {command:?}"));
        }
        assert!(done > 20 && refused < 40, "seed {seed}: {done} done, {refused} refused");
    }
}

/// Lists of a world that must fit each other.
fn agrees(world: &dyn Dynamics, when: &str) {
    let (points, dimensions) = (world.point_count(), world.dimensions());
    assert_eq!(world.positions().len(), dimensions * points, "{when}");
    assert_eq!(world.masses().len(), points, "{when}");
    let is_gone = |i: usize| world.gone().binary_search(&PointId(i as u32)).is_ok();
    for i in 0..points {
        let is_number = (0..dimensions).all(|k| world.positions().get(dimensions * i + k).is_finite());
        assert_eq!(is_number, !is_gone(i), "point {i}, {when}");
    }
    assert!(world.bonds().ends().iter().flatten().all(|end| end.index() < points && !is_gone(end.index())), "{when}");
    assert!(world.pinned().iter().all(|pin| !is_gone(pin.index())), "{when}");
    assert!(world.triangles().iter().flatten().all(|corner| !is_gone(corner.index())), "{when}");
    if let Some(numbers) = world.bond_numbers() {
        assert_eq!(numbers.len(), world.bonds().len(), "{when}");
        assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]), "{when}");
    }
}
