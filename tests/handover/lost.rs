//! Islands that leave the finite numbers stand still where they last were among them, are told of, and go on once a command touches
//! them; all others go on as if they were alone.

use serde_json::{Value, json};
use wobble::history::{Do, History, SetKeys, VectorOrEach};
use wobble::scene::Vector;
use wobble::sim::{Command, Dynamics, PointId, Reach, Solver, Why};

use super::{scene, world};

/// So fast that what follows from it is no number [m/s].
const TOO_FAST: f64 = 1e200;

/// Two triangles far from each other, the first with a point that leaves the numbers.
fn triangles(kind: &str) -> Value {
    let material = match kind {
        "spring" => json!({"kind": "spring", "stiffness": 500, "damping": 0.1}),
        _ => json!({"kind": "rigid"}),
    };
    let bond = |a: u32, b: u32| {
        let mut bond = material.clone();
        (bond["a"], bond["b"]) = (json!(a), json!(b));
        bond
    };
    json!({"wobble": 1, "gravity": [0, -9.81],
        "points": {"position": [[0, 0], [1, 0], [0, 1], [50, 0], [51, 0], [50, 1]],
            "velocity": [[TOO_FAST, 0], [0, 0], [0, 0], [1, 2], [1, 2], [1, 2.5]]},
        "bonds": [bond(0, 1), bond(1, 2), bond(2, 0), bond(3, 4), bond(4, 5), bond(5, 3)]})
}

/// The same without the first triangle.
fn alone(scene: &Value) -> Value {
    let mut other = scene.clone();
    for list in ["position", "velocity"] {
        let points: Vec<Value> = scene["points"][list].as_array().unwrap()[3..].to_vec();
        other["points"][list] = json!(points);
    }
    let first: Vec<Value> = scene["bonds"].as_array().unwrap()[..3].to_vec();
    other["bonds"] = json!(first);
    other
}

/// The same with bonds that would break: they are no rigid body, which bears any speed.
fn breakable(scene: &Value) -> Value {
    let mut other = scene.clone();
    other["bonds"].as_array_mut().unwrap().iter_mut().for_each(|bond| bond["break_strain"] = json!(1e9));
    other
}

fn in_space(scene: &Value) -> Value {
    let mut other = scene.clone();
    for list in ["position", "velocity"] {
        for vector in other["points"][list].as_array_mut().unwrap() {
            vector.as_array_mut().unwrap().push(json!(0));
        }
    }
    other["gravity"] = json!([0, -9.81, 0]);
    other["dimensions"] = json!(3);
    other
}

fn with(scene: &Value, key: &str, value: Value) -> Value {
    let mut other = scene.clone();
    other[key] = value;
    other
}

fn place(world: &dyn Dynamics, point: usize) -> [f64; 3] {
    world.sample(world.time()).position[point]
}

fn run(world: &mut dyn Dynamics, until: f64) {
    while world.time() < until - 1e-9 {
        world.step();
    }
}

/// That the first triangle stands where it was, is told of, and all else goes on as if it were alone, but for so much [m].
fn check(what: &str, value: &Value, most: f64) {
    let mut both = world(value);
    run(&mut *both, 1.0);
    assert!(both.is_finite(), "{what}");
    let found = both.moved_by();
    let still: Vec<_> = found.iter().filter(|moved| moved.why == Why::NotFinite).collect();
    assert_eq!(still.len(), 1, "{what}: {found:?}");
    assert_eq!((still[0].first, still[0].count, still[0].islands), (PointId(0), 3, 1), "{what}");
    assert!(still[0].since < 0.1, "{what}: {found:?}");
    assert_eq!(both.counters().frozen, 1, "{what}");
    assert!(found.iter().any(|moved| moved.first == PointId(3) && moved.why != Why::NotFinite), "{what}: {found:?}");
    let sample = both.sample(both.time());
    assert_eq!(sample.position[..3], [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "{what}");
    assert_eq!(sample.velocity[..3], [[0.0; 3]; 3], "{what}");

    let mut other = world(&alone(value));
    run(&mut *other, 1.0);
    for point in 0..3 {
        let (a, b) = (place(&*both, 3 + point), place(&*other, point));
        let off = (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
        assert!(off <= most, "{what}: {off}");
    }
    assert!(place(&*other, 0)[1] < -2.0, "{what}: it falls");
}

#[test]
fn what_leaves_the_numbers_stands_still_and_the_rest_goes_on() {
    let springs = triangles("spring");
    check("springs in free space", &springs, 0.0);
    // One ends its steps a substep later than the other.
    check("rigid bonds", &breakable(&triangles("rigid")), 0.01);
    let room = json!({"min": [-100, -100], "max": [100, 100]});
    check("among walls", &with(&springs, "bounds", room), 0.0);
    check("by the live step", &with(&springs, "method", json!({"solver": "live"})), 0.0);
    check("in space", &in_space(&springs), 0.0);
    check("rigid in space", &in_space(&triangles("rigid")), 0.0);
    check("in space by the live step", &with(&in_space(&springs), "method", json!({"solver": "live"})), 0.0);
    // What may touch it begins the step anew in which it was lost.
    check("bodies that meet", &with(&springs, "contact", json!(true)), 0.3);
    check("in space, that meet", &with(&in_space(&springs), "contact", json!(true)), 0.3);
}

#[test]
fn a_method_that_was_asked_for_fails_as_it_does() {
    for method in [json!({"solver": "rk4"}), json!({"budget": "none"})] {
        let mut world = world(&with(&triangles("spring"), "method", method.clone()));
        run(&mut *world, 0.5);
        assert!(!world.is_finite() && world.counters().frozen == 0, "{method}");
    }
}

#[test]
fn it_is_in_the_way_of_others() {
    // Above the triangle that stands falls a disc.
    let mut value = with(&triangles("spring"), "contact", json!(true));
    value["bodies"] = json!([{"make": "disc", "radius": 0.3, "spacing": 0.15, "origin": [0.35, 1.5],
        "material": {"kind": "spring", "stiffness": 2000, "damping": 1, "mass": 0.1}}]);
    let triangle = json!([[0, 1, 2]]);
    value["triangles"] = triangle;
    let mut world = world(&value);
    run(&mut *world, 2.0);
    let sample = world.sample(world.time());
    assert_eq!(sample.position[1], [1.0, 0.0, 0.0]);
    let touched = world.counters().contacts > 0;
    assert!(touched, "the disc fell through it");
}

#[test]
fn a_command_that_touches_it_lets_it_go() {
    let names: [(&str, Command); 4] = [
        ("pin", Command::Pin(vec![PointId(1)])),
        ("grab", Command::Grab(Reach::Points(vec![PointId(1)]))),
        ("cut", Command::Cut { from: wobble::sim::Cursor::at([0.5, -1.0]), to: wobble::sim::Cursor::at([0.5, 0.2]) }),
        (
            "gravity",
            Command::Set(wobble::sim::Change::Scene(Box::new(wobble::sim::SceneChange {
                gravity: Some([0.0, -5.0, 0.0]),
                ..Default::default()
            }))),
        ),
    ];
    for (name, command) in names {
        let mut world = world(&triangles("spring"));
        run(&mut *world, 0.5);
        let cursor = wobble::sim::Cursor::at([1.0, 0.0]);
        world.apply(&Command::Cursor { to: Some(cursor), by: world.time() }).unwrap();
        assert_eq!(world.moved_by().iter().filter(|moved| moved.why == Why::NotFinite).count(), 1, "{name}");
        world.apply(&command).unwrap();
        assert!(world.moved_by().iter().all(|moved| moved.why != Why::NotFinite), "{name}");
        run(&mut *world, 0.8);
        assert!(world.is_finite() && place(&*world, 2)[1] < 0.9, "{name}: it falls on");
    }
    let mut world = world(&triangles("spring"));
    run(&mut *world, 0.5);
    // Another body is another one's affair; and a command that is refused lets nothing go.
    world.apply(&Command::Pin(vec![PointId(4)])).unwrap();
    world.apply(&Command::Pin(vec![PointId(1), PointId(99)])).unwrap_err();
    assert!(world.moved_by().iter().any(|moved| moved.why == Why::NotFinite));
}

#[test]
fn a_kept_world_knows_of_it_and_a_log_replays_it() {
    let mut world = world(&triangles("spring"));
    run(&mut *world, 0.5);
    let mut again = wobble::sim::resume(&world.save().unwrap()).unwrap();
    let list = |world: &dyn Dynamics| -> Vec<(PointId, usize, f64, Why)> {
        world.moved_by().iter().map(|moved| (moved.first, moved.count, moved.since, moved.why)).collect()
    };
    assert_eq!(list(&*again)[0], list(&*world)[0]);
    run(&mut *again, 1.0);
    assert_eq!(place(&*again, 1), [1.0, 0.0, 0.0]);

    let mut history = History::new(scene(&triangles("spring")).into()).unwrap();
    let step = |history: &mut History, until: f64| {
        while history.world().time() < until - 1e-9 {
            history.step();
        }
    };
    step(&mut history, 0.5);
    let slow = SetKeys {
        points: Some(vec![0, 1, 2]),
        velocity: Some(VectorOrEach::One(Vector::Plane([0.0, 1.0]))),
        ..SetKeys::default()
    };
    history.give(vec![Do::Set(Box::new(slow))], Some("thrown up")).unwrap();
    step(&mut history, 1.0);
    let x = place(history.world(), 0);
    assert!(x[1] < 0.0 && x[1] > -2.0, "it was thrown up and falls: {x:?}");
    let mut replayed = History::new(history.recording().into()).unwrap();
    step(&mut replayed, 1.0);
    assert_eq!(place(replayed.world(), 0), x);
    history.undo().unwrap();
    assert_eq!(place(history.world(), 0), [0.0; 3]);
    assert!(history.world().moved_by().iter().any(|moved| moved.why == Why::NotFinite));
    assert_ne!(history.world().moved_by()[0].method, Solver::Auto);
}
