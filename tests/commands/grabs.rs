//! What a hand takes hold of, leads and lets go.

use super::*;

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

/// How many bonds of the cloth in space a hand tears that takes hold of what is about its middle and goes down by a metre, and the force at the
/// end `[N]`.
fn torn_in_space(reach: impl Fn(Vec<PointId>) -> Reach) -> (u64, f64) {
    let mut world = Scene::load("cloth-space").unwrap().world(None).unwrap();
    run_to(&mut *world, 5.0);
    let points: Vec<PointId> = [48, 49, 50, 59, 60, 61, 70, 71, 72].map(PointId).to_vec();
    let place = now(&*world).position;
    let middle = |axis: usize| points.iter().map(|point| place[point.index()][axis]).sum::<f64>() / 9.0;
    let [x, y] = [0, 1].map(middle);
    let cursor = |down: f64, by: f64| {
        let to = Cursor { origin: [x, y - down, 9.0], direction: [0.0, 0.0, -1.0] };
        Command::Cursor { to: Some(to), by }
    };
    world.apply(&cursor(0.0, 5.0)).unwrap();
    world.apply(&Command::Grab(reach(points.clone()))).unwrap();
    world.apply(&cursor(1.0, 5.5)).unwrap();
    run_to(&mut *world, 6.5);
    let [x, y, z] = world.grab().unwrap().force;
    (world.counters().bonds_torn, x.hypot(y).hypot(z))
}

/// 32 bonds hold nine points to others, and tear at 1,128 N together.
#[test]
fn a_patch_bears_less_than_tears_it_until_the_cursor_is_far_from_it() {
    let patch = |torn_beyond: f64| move |points: Vec<PointId>| Reach::Patch { points, torn_beyond };
    let (torn, force) = torn_in_space(patch(0.9));
    assert_eq!(torn, 0, "led by {force} N");
    assert!((30.0..0.0601 * 1128.0).contains(&force), "{force} N");
    let (torn, _) = torn_in_space(patch(0.1));
    assert!(torn > 0, "ten times as far as it is to be torn");
    let (torn, _) = torn_in_space(Reach::Points);
    assert!(torn > 0, "and a grab of points, however near it is");
    let mut world = Scene::load("cloth-space").unwrap().world(None).unwrap();
    world.apply(&Command::Cursor { to: Some(Cursor::at([0.0, 0.0])), by: 0.0 }).unwrap();
    for torn_beyond in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = world.apply(&Command::Grab(patch(torn_beyond)(vec![PointId(60)]))).unwrap_err();
        assert!(error.to_string().contains("torn_beyond"), "{error}");
    }
    assert!(world.grab().is_none());
}
