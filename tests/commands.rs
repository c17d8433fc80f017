//! What commands do to a running world: what they name changes, all else keeps its bits, and a refused one changes nothing.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod meeting;
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
fn islands_that_an_edit_does_not_name_keep_their_bits() {
    let edits: Vec<(&str, Command)> = vec![
        ("pin", Command::Pin(vec![PointId(9)])),
        ("cut", Command::Cut { from: Cursor::at([7.5, 1.2]), to: Cursor::at([10.0, 1.3]) }),
        ("delete a point", Command::Delete(Selection { points: vec![PointId(10)], ..Selection::default() })),
        ("delete a bond", Command::Delete(Selection { bonds: vec![BondId(13)], ..Selection::default() })),
        ("add", square(24, [40.0, 3.0])),
        (
            "move",
            Command::Move(Motion {
                points: numbers(8..12),
                by: [0.3, 2.0, 0.0],
                turn: 0.4,
                scale: [1.2; 3],
                ..Motion::default()
            }),
        ),
        (
            "mass",
            Command::Set(Change::Points {
                points: vec![PointId(8)],
                mass: Some(Values::Same(3.0)),
                velocity: None,
                skin: SkinMaterial::default(),
            }),
        ),
        (
            "stiffness",
            Command::Set(Change::Bonds {
                bonds: vec![BondId(12)],
                to: Box::new(BondChange { stiffness: Some(Values::Same(50.0)), ..BondChange::default() }),
            }),
        ),
    ];
    let model = boxes(6);
    for (name, edit) in edits {
        let mut plain = build(&model).unwrap();
        let mut edited = build(&model).unwrap();
        steps(&mut *plain, 0.3);
        steps(&mut *edited, 0.3);
        assert!(edited.apply(&edit).unwrap().is_something, "{name}");
        steps(&mut *plain, 0.7);
        steps(&mut *edited, 0.7);
        let (plain, edited) = (now(&*plain), now(&*edited));
        for far in [0..8, 12..24] {
            assert_eq!(bits(&plain, far.clone()), bits(&edited, far), "{name}");
        }
        if name != "add" {
            assert_ne!(bits(&plain, 8..12), bits(&edited, 8..12), "{name} does something");
        }
    }
}

/// Two fifths of the way through the step under way.
fn within_a_step(world: &mut dyn Dynamics) {
    let time = world.time() + 0.4 * world.substep();
    world.step_until(time);
    assert_eq!(world.time().to_bits(), time.to_bits());
}

#[test]
fn a_command_within_a_step_cuts_the_step_of_what_it_touches_alone() {
    let cursor = |x: f64, by: f64| Command::Cursor { to: Some(Cursor::at([x, 1.5])), by };
    let mut model = boxes(6);
    model.mouse = hovered(0.8).mouse;
    type Edit = Box<dyn Fn(&dyn Dynamics) -> Vec<Command>>;
    let edits: Vec<(&str, Edit)> = vec![
        ("nothing", Box::new(|_| vec![Command::Cut { from: Cursor::at([50.0, 1.0]), to: Cursor::at([51.0, 1.0]) }])),
        ("pin", Box::new(|_| vec![Command::Pin(vec![PointId(9)])])),
        ("cut", Box::new(|_| vec![Command::Cut { from: Cursor::at([7.5, 1.2]), to: Cursor::at([10.0, 1.3]) }])),
        ("add", Box::new(|_| vec![square(24, [40.0, 3.0])])),
        ("cursor", Box::new(move |world| vec![cursor(8.5, world.time()), cursor(9.0, world.time() + 0.001)])),
        (
            "grab",
            Box::new(move |world| vec![cursor(8.5, world.time()), Command::Grab(Reach::Points(vec![PointId(9)]))]),
        ),
        (
            "stronger mouse",
            Box::new(move |world| {
                let stronger = MouseChange { strength: Some(30.0), ..MouseChange::default() };
                vec![cursor(8.5, world.time()), Command::Mouse(stronger)]
            }),
        ),
    ];
    for (name, edit) in edits {
        let mut plain = build(&model).unwrap();
        let mut edited = build(&model).unwrap();
        let grid = plain.substep();
        steps(&mut *plain, 0.3);
        steps(&mut *edited, 0.3);
        let start = edited.time();
        within_a_step(&mut *edited);
        edit(&*edited).iter().for_each(|command| assert!(edited.apply(command).is_ok(), "{name}"));
        // Once more in the same step, elsewhere.
        within_a_step(&mut *edited);
        edited.apply(&Command::Pin(vec![PointId(17)])).unwrap();
        edited.step();
        plain.step();
        assert_eq!(edited.time().to_bits(), plain.time().to_bits(), "{name}: the grid stays");
        assert!((edited.time() - start - grid).abs() < 1e-12);
        steps(&mut *plain, 0.2);
        steps(&mut *edited, 0.2);
        let (plain, edited) = (now(&*plain), now(&*edited));
        for far in [0..8, 12..16, 20..24] {
            assert_eq!(bits(&plain, far.clone()), bits(&edited, far), "{name}");
        }
        assert_ne!(bits(&plain, 16..20), bits(&edited, 16..20), "{name}: what was pinned");
        let is_same = bits(&plain, 8..12) == bits(&edited, 8..12);
        assert_eq!(is_same, name == "nothing" || name == "add", "{name}");
    }
}

#[test]
fn a_command_within_a_step_counts_from_its_time() {
    // A free point under gravity is stopped within a step: from there it falls anew.
    let model = Model { position: vec![[0.0; 2]; 2], velocity: vec![[0.0; 2]; 2], mass: vec![1.0; 2], ..boxes(0) };
    let model = Model { bounds: None, ..model };
    let mut world = build(&model).unwrap();
    steps(&mut *world, 0.5);
    within_a_step(&mut *world);
    let t = world.time();
    let place = now(&*world).position[0][1];
    assert!((place + 0.5 * 9.81 * t * t).abs() < 1e-9, "{place}");
    let stop = Change::Points {
        points: vec![PointId(0)],
        mass: None,
        velocity: Some(vec![[0.0; 3]]),
        skin: SkinMaterial::default(),
    };
    world.apply(&Command::Set(stop)).unwrap();
    steps(&mut *world, 0.5);
    let fallen = world.time() - t;
    let after = now(&*world);
    assert!((after.position[0][1] - place + 0.5 * 9.81 * fallen * fallen).abs() < 1e-9);
    assert!((after.velocity[0][1] + 9.81 * fallen).abs() < 1e-9);
}

#[test]
fn a_fast_cursor_and_a_break_cut_the_steps_of_what_they_touch_alone() {
    let mut model = boxes(4);
    model.mouse = hovered(0.5).mouse;
    model.gravity = [0.0; 2];
    // The third body flies apart: one of its bonds breaks within a step.
    let brittle = Bond { break_strain: 0.05, ..model.bonds.get(12) };
    model.bonds.set(12, brittle);
    let mut plain = build(&model).unwrap();
    model.velocity[8] = [-3.0, 0.0];
    let mut torn = build(&model).unwrap();
    for world in [&mut plain, &mut torn] {
        world.apply(&Command::Cursor { to: Some(Cursor::at([50.0, 1.5])), by: 0.0 }).unwrap();
    }
    for step in 0..60 {
        let x = if step % 2 == 0 { 90.0 } else { 40.0 };
        let by = torn.time() + torn.substep();
        torn.apply(&Command::Cursor { to: Some(Cursor::at([x, 1.5])), by }).unwrap();
        torn.step();
        plain.step();
    }
    assert_eq!(torn.counters().bonds_torn, 1);
    assert_eq!(plain.counters().bonds_torn, 0);
    let (plain, torn) = (now(&*plain), now(&*torn));
    for far in [0..8, 12..16] {
        assert_eq!(bits(&plain, far.clone()), bits(&torn, far));
    }
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

/// A point with a cursor at the origin, grabbed.
fn grabbed(model: &Model<2>, points: Vec<PointId>, at: [f64; 2]) -> Box<dyn Dynamics> {
    let mut world = build(model).unwrap();
    world.apply(&Command::Cursor { to: Some(Cursor::at(at)), by: 0.0 }).unwrap();
    world.apply(&Command::Grab(Reach::Points(points))).unwrap();
    world
}

#[test]
fn a_grab_leads_to_the_cursor_without_overshoot_and_holds_without_sag() {
    let rope = |pinned: Vec<PointId>, kind: BondKind| {
        let mut model = Model { gravity: [0.0, -9.81], drag_rate: 0.5, pinned, ..Model::default() };
        for i in 0..8_u32 {
            model.position.push([0.25 * f64::from(i), 0.0]);
            if i > 0 {
                model.bonds.push(Bond { kind, ..Bond::new(PointId(i - 1), PointId(i), 0.25) });
            }
        }
        model.velocity = vec![[0.0; 2]; 8];
        model.mass = vec![1.0; 8];
        model
    };
    let loose = Model {
        position: vec![[0.0, 0.0]],
        velocity: vec![[0.0; 2]],
        mass: vec![2.0],
        gravity: [0.0, -9.81],
        ..Model::default()
    };
    let spring = BondKind::Spring { stiffness: 2000.0, damping: 20.0 };
    let cases = [
        ("a loose point", loose.clone(), 0, [0.5, 0.5]),
        ("a hung rope's end", rope(vec![PointId(0)], BondKind::Rigid), 7, [1.2, -0.3]),
        ("a loose rope's end", rope(Vec::new(), BondKind::Rigid), 7, [1.75, 1.0]),
        ("a soft rope's end", rope(vec![PointId(0)], spring), 7, [1.4, -0.3]),
        ("a box on the floor", boxes(1), 0, [0.0, 3.0]),
        (
            "a rigid box",
            Model { bonds: boxes(2).bonds.iter().filter(|bond| bond.a.0 >= 4).collect(), ..boxes(2) },
            4,
            [4.0, 4.0],
        ),
    ];
    for (name, model, point, at) in cases {
        let mut world = grabbed(&model, vec![PointId(point)], at);
        steps(&mut *world, 6.0);
        let mut worst = 0.0_f64;
        for _ in 0..60 {
            steps(&mut *world, 1.0 / 60.0);
            let place = now(&*world).position[point as usize];
            worst = worst.max((place[0] - at[0]).hypot(place[1] - at[1]));
        }
        let force = world.grab().unwrap().force;
        assert!(worst < 0.02, "{name}: {worst} m off the cursor, force {force:?}");
    }
    // A loose point follows the closed form of the critically damped spring, gravity fed forward once it is known.
    let still = Model { gravity: [0.0; 2], ..loose };
    let mut world = grabbed(&still, vec![PointId(0)], [0.2, 0.0]);
    let mut furthest = 0.0_f64;
    for _ in 0..120 {
        steps(&mut *world, 1.0 / 60.0);
        furthest = furthest.max(now(&*world).position[0][0]);
    }
    assert!(furthest < 0.2 * 1.2, "it overshoots to {furthest}");
}

#[test]
fn what_is_let_go_keeps_its_velocity_and_flies() {
    let mut world = grabbed(&boxes(1), numbers(0..4), [0.5, 1.55]);
    steps(&mut *world, 0.5);
    world.apply(&Command::Cursor { to: Some(Cursor::at([4.5, 3.55])), by: world.time() + 0.5 }).unwrap();
    steps(&mut *world, 0.5);
    let before = now(&*world).velocity;
    assert!(world.apply(&Command::Release).unwrap().is_something);
    assert_eq!(now(&*world).velocity, before);
    let speed = before.iter().map(|v| v[0]).sum::<f64>() / 4.0;
    assert!((speed - 8.0).abs() < 1.0, "it goes with the hand, 8 m/s: {speed}");
    assert!(world.grab().is_none() && !world.apply(&Command::Release).unwrap().is_something);
    let from = now(&*world).position[0][0];
    steps(&mut *world, 0.3);
    assert!(now(&*world).position[0][0] - from > 1.5, "it flies");
}

#[test]
fn a_grab_is_bounded_and_holds_on_through_edits() {
    let mut world = grabbed(&boxes(2), vec![PointId(0)], [500.0, 0.5]);
    steps(&mut *world, 0.05);
    let force = world.grab().unwrap().force;
    assert!(force[0].hypot(force[1]) <= 50.0 * 9.81 + 1e-6, "{force:?}");
    world.apply(&Command::Cursor { to: Some(Cursor::at([1.0, 3.0])), by: 0.0 }).unwrap();
    world.apply(&Command::Delete(Selection { bonds: vec![BondId(1)], ..Selection::default() })).unwrap();
    steps(&mut *world, 5.0);
    let place = now(&*world).position[0];
    assert!((place[0] - 1.0).hypot(place[1] - 3.0) < 0.05, "{place:?}");
    world.apply(&Command::Delete(Selection { points: vec![PointId(0)], ..Selection::default() })).unwrap();
    assert!(world.grab().is_none(), "what is grabbed is gone");
    steps(&mut *world, 0.5);
    assert!(world.is_finite());
}

fn hovered(radius: f64) -> Model<2> {
    let mouse =
        MouseForce { strength: 60.0, radius, region: Region::Round, profile: Profile::Smooth, track: Track::default() };
    Model { mouse: Some(mouse), gravity: [0.0; 2], bounds: None, ..boxes(1) }
}

#[test]
fn the_cursor_goes_along_a_line_so_that_frame_rates_agree() {
    let ends: Vec<Sample> = [30_u32, 60, 120]
        .into_iter()
        .map(|rate| {
            let mut world = build(&hovered(1.0)).unwrap();
            world.apply(&Command::Cursor { to: Some(Cursor::at([-3.0, 1.2])), by: 0.0 }).unwrap();
            for frame in 1..=rate {
                let t = f64::from(frame) / f64::from(rate);
                world.apply(&Command::Cursor { to: Some(Cursor::at([-3.0 + 6.0 * t, 1.2])), by: t }).unwrap();
                steps(&mut *world, 1.0 / f64::from(rate));
            }
            now(&*world)
        })
        .collect();
    let apart = |a: &Sample, b: &Sample| {
        let of = |(x, y): (&[f64; 3], &[f64; 3])| (x[0] - y[0]).hypot(x[1] - y[1]);
        a.position.iter().zip(&b.position).map(of).fold(0.0, f64::max)
    };
    assert!(apart(&ends[0], &ends[1]) < 1e-9 && apart(&ends[0], &ends[2]) < 1e-9, "{}", apart(&ends[0], &ends[1]));
    let still = now(&*build(&hovered(1.0)).unwrap());
    assert!(apart(&ends[0], &still) > 0.3, "it moved");
}

#[test]
fn the_mouse_force_is_so_from_now_on_and_its_track_may_end() {
    let mut model = hovered(1.0);
    model.mouse.as_mut().unwrap().track = Track { knots: vec![(0.0, [-3.0, 1.2]), (10.0, [9.0, 1.2])] };
    let mut world = build(&model).unwrap();
    steps(&mut *world, 1.0);
    let stronger = MouseChange { strength: Some(200.0), ..MouseChange::default() };
    world.apply(&Command::Mouse(stronger)).unwrap();
    let (force, at) = world.mouse().unwrap();
    assert_eq!((force.strength, force.radius), (200.0, 1.0));
    assert!((at.origin[0] + 3.0 - 1.2 * world.time()).abs() < 1e-9, "it goes on along its track");
    world.apply(&Command::Mouse(MouseChange { ends_track: true, ..MouseChange::default() })).unwrap();
    assert!(world.mouse().is_none(), "there is no live cursor");
    let mut plain = build(&boxes(1)).unwrap();
    assert!(plain.apply(&Command::Mouse(stronger)).is_err(), "without a radius there is none");
    let whole = MouseChange { radius: Some(0.5), ..stronger };
    assert!(plain.apply(&Command::Mouse(whole)).unwrap().is_something && plain.mouse_force().is_some());
}

#[test]
fn a_fast_cursor_is_swept() {
    // Across the body within one step: with the cursor's ends alone looked at, nothing would be pushed.
    let mut model = hovered(0.4);
    model.method = Method { substep: Some(1.0 / 60.0), ..Method::default() };
    let mut world = build(&model).unwrap();
    world.apply(&Command::Cursor { to: Some(Cursor::at([-4.0, 1.2])), by: 0.0 }).unwrap();
    steps(&mut *world, 1.0 / 60.0);
    let before = now(&*world).velocity;
    world.apply(&Command::Cursor { to: Some(Cursor::at([6.0, 1.2])), by: world.time() + 1.0 / 60.0 }).unwrap();
    steps(&mut *world, 1.0 / 60.0);
    assert!(world.counters().mouse_points > 0);
    let after = now(&*world).velocity;
    assert!((0..4).any(|i| (after[i][1] - before[i][1]).abs() > 1e-3), "{after:?}");
}

#[test]
fn a_ray_that_turns_fast_is_swept_too() {
    // A point in space, 5 m from the eye, between the rays of two frames.
    let mouse = MouseForce {
        strength: 60.0,
        radius: 0.3,
        region: Region::Round,
        profile: Profile::Smooth,
        track: Track::default(),
    };
    let model = Model::<3> {
        position: vec![[0.1, 0.0, 0.0]],
        velocity: vec![[0.0; 3]],
        mass: vec![1.0],
        mouse: Some(mouse),
        method: Method { substep: Some(1.0 / 60.0), ..Method::default() },
        ..Model::default()
    };
    let ray = |x: f64| {
        let length = x.hypot(5.0);
        Some(Cursor { origin: [0.0, 0.0, 5.0], direction: [x / length, 0.0, -5.0 / length] })
    };
    let mut world = build(&model).unwrap();
    world.apply(&Command::Cursor { to: ray(-4.0), by: 0.0 }).unwrap();
    world.step();
    assert_eq!(world.counters().mouse_points, 0, "out of reach");
    world.apply(&Command::Cursor { to: ray(4.5), by: world.time() + 1.0 / 60.0 }).unwrap();
    world.step();
    assert!(world.counters().mouse_points > 0, "it is passed on the way");
    assert!(now(&*world).velocity[0].iter().any(|v| v.abs() > 1e-5), "{:?}", now(&*world).velocity);
}

#[test]
fn of_two_bodies_that_are_grabbed_the_one_that_is_left_goes_to_the_cursor() {
    let mut model = boxes(2);
    model.bounds = None;
    let mut world = grabbed(&model, vec![PointId(0), PointId(4)], [0.5, 1.5]);
    steps(&mut *world, 1.0);
    let apart = now(&*world).position[4][0] - now(&*world).position[0][0];
    assert!(apart > 3.0, "each keeps its side: {apart}");
    world.apply(&Command::Delete(Selection { points: numbers(4..8), ..Selection::default() })).unwrap();
    steps(&mut *world, 2.0);
    let at = now(&*world).position[0];
    assert!((at[0] - 0.5).hypot(at[1] - 1.5) < 1e-2, "{at:?}");
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
fn a_body_that_an_obstacle_is_put_onto_is_moved_out_as_a_whole() {
    let mut model = boxes(2);
    model.gravity = [0.0; 2];
    model.velocity.fill([0.0; 2]);
    let floor = Obstacle::Plane {
        point: [0.0, 1.6, 0.0],
        normal: [0.0, 1.0, 0.0],
        restitution: 0.0,
        friction: 0.0,
        penalty: None,
    };
    let walls = BoundsChange { min: [-10.0, 1.6, 0.0], max: [100.0, 20.0, 0.0], restitution: 0.0, friction: 0.0 };
    let bounds = Change::Scene(Box::new(SceneChange { bounds: Some(Some(walls)), ..SceneChange::default() }));
    let put: [Command; 2] =
        [Command::Add(Box::new(Addition { obstacles: vec![floor], ..Addition::default() })), Command::Set(bounds)];
    for command in put {
        let mut world = build(&model).unwrap();
        steps(&mut *world, 0.1);
        let start = now(&*world);
        world.apply(&command).unwrap();
        let after = now(&*world);
        for i in 0..8 {
            let [dx, dy] = [0, 1].map(|k| after.position[i][k] - start.position[i][k]);
            let body = 4 * (i / 4);
            let first = after.position[body][1] - start.position[body][1];
            assert!(dx.abs() < 1e-9 && (dy - first).abs() < 1e-9 && dy > 0.4, "{dx} {dy}");
            assert!(after.position[i][1] > 1.6 - 1e-3);
        }
        assert!(world.warnings().iter().any(|warning| warning.contains("moved out")));
        steps(&mut *world, 0.5);
        assert_eq!(world.counters().fallbacks, 0);
        let velocity = now(&*world).velocity;
        for body in [0..4, 4..8] {
            let mean = velocity[body].iter().map(|v| v[1]).sum::<f64>() / 4.0;
            assert!(mean.abs() < 0.3, "nothing is thrown: {mean}");
        }
    }
}

#[test]
fn a_part_of_a_rigid_body_is_not_moved_against_its_lengths() {
    // A strip of rigid braced cells; some points of its middle are to go far to the side.
    let mut model = Model { bounds: None, ..boxes(0) };
    for column in 0..12 {
        model.position.extend([[f64::from(column), 0.0], [f64::from(column), 1.0]]);
        let first = 2 * column;
        model.bonds.push(Bond::new(PointId(first), PointId(first + 1), 1.0));
        if column > 0 {
            for (a, b) in [(first - 2, first), (first - 1, first + 1), (first - 2, first + 1), (first - 1, first)] {
                model.bonds.push(Bond::new(
                    PointId(a),
                    PointId(b),
                    if (a + b) % 2 == 0 { 1.0 } else { 2.0_f64.sqrt() },
                ));
            }
        }
    }
    model.velocity = vec![[0.0; 2]; 24];
    model.mass = vec![1.0; 24];
    let mut world = build(&model).unwrap();
    steps(&mut *world, 0.1);
    let (before, lengths) = (now(&*world), world.bonds().rest_lengths().to_vec());
    let mut refusals = 0;
    for (points, by) in [(8..14, [0.3, 0.8, 0.0]), (8..14, [-3.0, 2.0, 0.0]), (0..9, [6.0, 0.5, 0.0])] {
        let motion = Motion { points: numbers(points), by, ..Motion::default() };
        let mut copy = world.boxed_clone();
        match copy.apply(&Command::Move(motion)) {
            Err(CommandError::Invalid(why)) => {
                refusals += 1;
                assert!(why.contains("move the whole body"), "{why}");
                assert_eq!(bits(&now(&*copy), 0..24), bits(&before, 0..24), "the world is whole");
            }
            other => assert!(other.is_ok() && now(&*copy).max_strain < 1e-6, "the rest follows"),
        }
        assert_eq!(copy.bonds().rest_lengths(), lengths, "no length gives way");
    }
    assert!(refusals > 0);
    world
        .apply(&Command::Move(Motion {
            points: numbers(0..24),
            by: [5.0, 1.0, 0.0],
            turn: 1.0,
            scale: [1.5; 3],
            ..Motion::default()
        }))
        .unwrap();
    assert!(now(&*world).max_strain < 1e-6, "the whole body may be moved");
}

#[test]
fn small_motions_of_small_things_are_no_rest() {
    // Two points 1 mm apart on a spring that swings by a hundredth of it, once a second: x = 1 mm + 10 um cos(2 pi t).
    let k = 0.5 * std::f64::consts::TAU.powi(2);
    let model = Model::<2> {
        position: vec![[0.0; 2], [1.01e-3, 0.0]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0; 2],
        bonds: [Bond {
            kind: BondKind::Spring { stiffness: k, damping: 0.0 },
            ..Bond::new(PointId(0), PointId(1), 1e-3)
        }]
        .into_iter()
        .collect(),
        ..Model::default()
    };
    let mut world = build(&model).unwrap();
    for half in 1..=6 {
        steps(&mut *world, 0.5);
        let now = now(&*world);
        let meant = 1e-3 + 1e-5 * (std::f64::consts::TAU * world.time()).cos();
        let found = now.position[1][0] - now.position[0][0];
        assert!((found - meant).abs() < 1e-7, "after {half} halves: {found:e} {meant:e}");
    }
    assert!(!world.is_asleep());
}

#[test]
fn a_turning_point_is_no_rest_and_what_rests_sleeps() {
    // A pendulum of 4 s starts at its turning point, where it has no speed; one that hangs, still.
    let swing = |angle: f64| Model {
        position: vec![[0.0, 0.0], [4.0 * angle.sin(), -4.0 * angle.cos()]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0; 2],
        pinned: vec![PointId(0)],
        bonds: [Bond::new(PointId(0), PointId(1), 4.0)].into(),
        gravity: [0.0, -9.81],
        method: Method { sleeps: true, ..Method::default() },
        ..Model::default()
    };
    let mut world = build(&swing(0.01)).unwrap();
    for _ in 0..600 {
        steps(&mut *world, 1.0 / 60.0);
        assert!(!world.is_asleep(), "at {} s", world.time());
    }
    let mut world = build(&swing(0.0)).unwrap();
    steps(&mut *world, 1.0);
    assert!(world.is_asleep());
    let (substeps, place) = (world.counters().substeps, now(&*world).position);
    steps(&mut *world, 1.0);
    assert_eq!((world.counters().substeps, now(&*world).position), (substeps, place));
    world.apply(&Command::Cursor { to: Some(Cursor::at([1.0, -4.0])), by: 0.0 }).unwrap();
    assert!(world.is_asleep(), "there is no mouse force");
    world.apply(&Command::Grab(Reach::Points(vec![PointId(1)]))).unwrap();
    steps(&mut *world, 0.5);
    assert!(now(&*world).position[1][0] > 0.5, "a grab wakes it");
}

#[test]
fn bodies_of_springs_at_rest_on_the_floor_sleep_and_report_no_speed() {
    let scene = r#"{ "wobble": 1, "gravity": [0, -9.81], "drag_rate": 2,
        "bodies": [{ "make": "disc", "radius": 0.5, "spacing": 0.08, "origin": [0, 0.7],
            "material": { "kind": "spring", "stiffness": 4000, "damping": 2, "mass": 3 } }],
        "bounds": { "min": [-4, 0], "max": [4, 5], "restitution": 0.3, "friction": 0.6 } }"#;
    let mut world = Scene::parse(scene, "disc.json").unwrap().world(None).unwrap();
    let mut seconds = 0;
    while !world.is_asleep() {
        assert!(seconds < 20, "it is awake after {seconds} s");
        steps(&mut *world, 1.0);
        seconds += 1;
    }
    let sample = now(&*world);
    assert!(sample.velocity.iter().flatten().all(|&v| v == 0.0), "{:?}", sample.velocity);
    assert!(sample.position.iter().any(|x| x[1].abs() < 1e-3), "it lies on the floor");
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

/// Three points with springs and an angle that pull nothing, one spring that is strained, a plane, a polygon.
fn drawn() -> Model<2> {
    let position = vec![[0.0, 0.0], [1.0, 0.5], [2.0, 0.0], [5.0, 5.0]];
    let far = |a: usize, b: usize| (position[b][0] - position[a][0] as f64).hypot(position[b][1] - position[a][1]);
    let bonds = [spring(0, 1, far(0, 1)), spring(1, 2, far(1, 2)), spring(0, 2, 1.5)];
    let bends = [0, 1, 2].map(|point: usize| position[point]);
    let angle = wobble::sim::Angle { stiffness: 30.0, ..wobble::sim::angle_at([0, 1, 2].map(PointId), bends) };
    Model {
        velocity: vec![[1.0, 2.0]; 4],
        mass: vec![1.0; 4],
        bonds: bonds.into_iter().collect(),
        angles: wobble::sim::Angles::of(vec![angle]),
        planes: vec![wobble::sim::Plane {
            point: [0.0, -9.0],
            normal: [1.0, 1.0],
            restitution: 0.0,
            friction: 0.0,
            penalty: None,
        }],
        polygons: vec![Polygon {
            loops: vec![vec![[8.0, 8.0], [9.0, 8.0], [9.0, 9.0]]],
            restitution: 0.0,
            friction: 0.0,
        }],
        position,
        ..Model::default()
    }
}

#[test]
fn a_scale_along_each_axis_and_a_turn_are_one_map_of_points_bonds_angles_and_obstacles() {
    let model = drawn();
    let (turn, factors, about, by) = (0.7_f64, [2.0, 0.5], [1.0, 1.0], [0.3, -0.2]);
    let (sin, cos) = turn.sin_cos();
    let turned = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    let placed = |x: [f64; 2]| {
        let [x, y] = turned([factors[0] * (x[0] - about[0]), factors[1] * (x[1] - about[1])]);
        [x + about[0] + by[0], y + about[1] + by[1]]
    };
    let mut world = build(&model).unwrap();
    let motion = Motion {
        points: numbers(0..3),
        obstacles: vec![0, 1],
        by: [by[0], by[1], 0.0],
        turn,
        scale: [factors[0], factors[1], 1.0],
        about: Some([about[0], about[1], 0.0]),
        ..Motion::default()
    };
    assert!(world.apply(&Command::Move(motion.clone())).unwrap().is_something);
    let sample = now(&*world);
    let near = |found: [f64; 3], expected: [f64; 2]| {
        assert!((found[0] - expected[0]).hypot(found[1] - expected[1]) < 1e-6, "{found:?} {expected:?}");
    };
    for k in 0..3 {
        near(sample.position[k], placed(model.position[k]));
        near(sample.velocity[k], turned(model.velocity[k]));
    }
    near(sample.position[3], model.position[3]);
    let far = |a: usize, b: usize| {
        let [p, q] = [placed(model.position[a]), placed(model.position[b])];
        (q[0] - p[0]).hypot(q[1] - p[1])
    };
    let rests: Vec<f64> = world.bonds().iter().map(|bond| bond.rest_length).collect();
    // The third is strained as it was: its length was 2 m, its rest 1.5 m.
    let expected = [far(0, 1), far(1, 2), 0.75 * far(0, 2)];
    assert!(
        rests.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9),
        "{rests:?} {expected:?}"
    );
    let angle = world.angles()[0];
    let now_at =
        wobble::sim::angle_at([0, 1, 2].map(PointId), [0, 1, 2].map(|point| placed(model.position[point]))).rest;
    let was_at = wobble::sim::angle_at([0, 1, 2].map(PointId), [0, 1, 2].map(|point| model.position[point])).rest;
    assert!((angle.rest - now_at).abs() < 1e-6 && (now_at - was_at).abs() > 0.1, "{angle:?}");
    assert!((angle.arms[0] - far(0, 1)).abs() < 1e-9);
    let [point, normal] = world.planes()[0];
    for along in [0.0, 3.0] {
        let on = placed([along, -9.0 - along]);
        let off = (on[0] - point[0]) * normal[0] + (on[1] - point[1]) * normal[1];
        assert!(off.abs() < 1e-9, "what lay on the plane lies on it: {off}");
    }
    for (corner, was) in world.polygons()[0].loops[0].iter().zip(&model.polygons[0].loops[0]) {
        near([corner[0], corner[1], 0.0], placed(*was));
    }
    let mut space =
        build(&Model::<3> { position: vec![[0.0; 3]], velocity: vec![[0.0; 3]], mass: vec![1.0], ..Model::default() })
            .unwrap();
    let motion = Motion { points: numbers(0..1), obstacles: Vec::new(), ..motion };
    assert!(space.apply(&Command::Move(motion)).is_err(), "of the plane alone");
}

/// A scene whose hand takes hold of a point and goes from one place to another within half a second, and how many bonds it tore after six.
fn torn_by_hand(scene: &Scene, point: u32, [from, to]: [[f64; 2]; 2]) -> u64 {
    let mut world = scene.world(None).unwrap();
    run_to(&mut *world, 0.5);
    let now = world.time();
    let cursor = |to: [f64; 2], by: f64| Command::Cursor { to: Some(Cursor::at(to)), by };
    world.apply(&cursor(from, now)).unwrap();
    world.apply(&Command::Grab(Reach::Points(vec![PointId(point)]))).unwrap();
    world.apply(&cursor(to, now + 0.5)).unwrap();
    run_to(&mut *world, now + 6.0);
    assert!(world.is_finite());
    world.counters().bonds_torn
}

/// A point weighs ten grams: what its weight bounds would never tear the thread that it hangs by.
#[test]
fn a_hand_that_pulls_far_enough_tears_what_can_tear() {
    let pinned: Vec<u32> = (0..11).collect();
    let cloth = |breaks: &str| {
        let text = format!(
            r#"{{"wobble": 1, "gravity": [0, -9.81], "contact": true, "bounds": {{"min": [-4, -4], "max": [4, 3]}},
            "bodies": [{{"make": "cloth", "columns": 11, "rows": 11, "spacing": 0.2, "origin": [-1, 2], "pinned": {pinned:?},
            "material": {{"kind": "spring", "stiffness": 720, "damping": 22, "mass": 1.2{breaks}}}}}]}}"#
        );
        Scene::parse(&text, "cloth").unwrap()
    };
    let (thin, far, near) = (r#", "break_strain": 0.3"#, [[1.0, 0.0], [2.5, -2.5]], [[1.0, 0.0], [1.3, -0.3]]);
    assert!(torn_by_hand(&cloth(thin), 120, far) > 0);
    assert_eq!(torn_by_hand(&cloth(thin), 120, near), 0, "a hand that plays with it tears nothing");
    // What cannot tear is pulled by no more than fifty weights of the point.
    let mut world = cloth("").world(None).unwrap();
    for command in [
        Command::Cursor { to: Some(Cursor::at(far[0])), by: 0.0 },
        Command::Grab(Reach::Points(vec![PointId(120)])),
        Command::Cursor { to: Some(Cursor::at(far[1])), by: 0.5 },
    ] {
        world.apply(&command).unwrap();
    }
    run_to(&mut *world, 2.0);
    let [x, y, _] = world.grab().unwrap().force;
    assert!((1.0..1.01 * 50.0 * 9.81 * 1.2 / 121.0).contains(&x.hypot(y)), "{x}, {y} N");
    let space = Scene::load("cloth-space").unwrap();
    assert!(torn_by_hand(&space, 120, [[-1.0, -0.4], [-3.5, -2.5]]) > 0, "as its caption says");
    assert_eq!(torn_by_hand(&space, 120, [[-1.0, -0.4], [-1.2, -0.5]]), 0, "nor there by one that plays with it");
}
