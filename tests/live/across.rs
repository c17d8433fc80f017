//! What is pinned across a wall, some of it above and some below: led out only as far as its bonds yield, and no energy from that.

use serde_json::{Value, json};
use wobble::sim::{Command, Dynamics, Motion, PointId};

use super::world;

/// The energy at the start, the most that it is and the largest strain in three seconds.
fn held(bodies: &Value) -> [f64; 3] {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "bodies": bodies,
        "bounds": {"min": [-90, 0], "max": [90, 90], "friction": 0.5, "restitution": 0.3}});
    let mut world = world(&scene);
    let start = world.energy();
    let (mut most, mut strain) = (start, 0.0_f64);
    while world.time() < 3.0 {
        world.step();
        assert!(world.is_finite(), "{bodies} at {} s", world.time());
        most = most.max(world.energy());
        strain = strain.max(world.sample(world.time()).max_strain);
    }
    [start, most, strain]
}

fn spring() -> Value {
    json!({"kind": "spring", "stiffness": 1e4, "mass": 2})
}

#[test]
fn a_soft_body_that_is_pinned_across_a_floor_is_held() {
    // By one point above, by points on both sides, and by points below.
    for pinned in [json!([60]), json!([0, 7, 56, 63]), json!([0, 7])] {
        let lattice = json!([{"make": "lattice", "columns": 8, "rows": 8, "spacing": 0.2, "origin": [-0.7, -0.7],
            "pinned": pinned, "material": spring()}]);
        let [start, most, strain] = held(&lattice);
        assert!(most < start + 0.1, "{pinned}: from {start} J to {most} J");
        assert!(strain < 0.01, "{pinned}: {strain}");
    }
}

#[test]
fn ropes_that_are_pinned_below_a_floor_keep_their_lengths() {
    for kind in [spring(), json!({"kind": "rigid", "mass": 2})] {
        let rope = json!([{"make": "rope", "count": 10, "spacing": 0.2, "origin": [0, -1], "angle": 1.57,
            "pinned": [0], "material": kind}]);
        let [start, most, strain] = held(&rope);
        // What bonds yield is some joules of springs of 10 kN/m, and lifts the rope by a little.
        assert!(most < start + 3.0, "{kind}: from {start} J to {most} J");
        assert!(strain < 0.06, "{kind}: {strain}");
    }
}

/// Its lowest points are right below the pin that is left: by no turn are they put out at once.
#[test]
fn a_board_that_loses_one_of_its_pins_is_turned_out_of_a_floor_slowly() {
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "method": {"solver": "live"},
        "bodies": [{"make": "lattice", "columns": 5, "rows": 12, "spacing": 0.3, "origin": [0, -0.4],
            "pinned": [55, 59], "material": {"kind": "rigid", "mass": 1}}],
        "bounds": {"min": [-90, 0], "max": [90, 90], "friction": 0.3, "restitution": 1}});
    let mut world = world(&scene);
    let steps = |world: &mut Box<dyn Dynamics>, end: f64| {
        let mut fastest = 0.0_f64;
        while world.time() < end {
            let (t, before) = (world.time(), world.sample(world.time()).position);
            world.step();
            let after = world.sample(world.time()).position;
            let ways = before.iter().zip(&after).map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1]));
            fastest = fastest.max(ways.fold(0.0, f64::max) / (world.time() - t));
        }
        fastest
    };
    assert_eq!(steps(&mut world, 0.2), 0.0, "it stands on two pins");
    world.apply(&Command::Unpin(vec![PointId(55)])).unwrap();
    let fastest = steps(&mut world, 3.0);
    let lowest = world.sample(world.time()).position.iter().fold(f64::INFINITY, |least, x| least.min(x[1]));
    assert!(lowest > -1e-3, "it lies {lowest} m deep");
    assert!(fastest < 20.0, "{fastest} m/s");
}

/// A disc that hangs on two threads lies across those of another one: contacts alone would push what is on both sides of a thread back and
/// forth for ever, and no body can be led away from the other, for both hang on pins.
#[test]
fn what_hangs_across_the_thread_of_another_comes_down_beside_it() {
    let disc = |x: f64| {
        json!({"make": "disc", "radius": 0.2, "spacing": 0.1, "origin": [x, 0],
            "material": {"kind": "spring", "stiffness": 5000, "damping": 0.2, "mass": 1}})
    };
    let thread = |a: u32, b: u32| json!({"a": a, "b": b, "kind": "spring", "stiffness": 5000, "limit": "max"});
    let scene = json!({"wobble": 1, "gravity": [0, -9.81], "contact": {"friction": 0, "radius": 0.005},
        "points": {"position": [[0, 1.5], [0.415, 1.5]], "pinned": [0, 1]},
        "bonds": [thread(0, 4), thread(0, 6), thread(1, 24), thread(1, 26)],
        "bodies": [disc(0.0), disc(0.415)], "method": {"settle": false}});
    let mut world = world(&scene);
    // The second one is lifted onto the threads of the first.
    let lift = Motion { points: (22..42).map(PointId).collect(), by: [-0.35, 0.35, 0.0], ..Motion::default() };
    world.apply(&Command::Move(lift)).unwrap();
    let start = world.energy();
    while world.time() < 12.0 {
        world.step();
        // They are parted as far as their threads yield at first.
        assert!(world.energy() < start + 2.0, "{} J at {} s, {start} at first", world.energy(), world.time());
    }
    assert!(world.energy() < start, "it came down: {} J", world.energy());
    let sample = world.sample(world.time());
    let middle = |points: std::ops::Range<usize>| points.map(|i| sample.position[i][0]).sum::<f64>() / 20.0;
    let [one, other] = [middle(2..22), middle(22..42)];
    assert!(other - one > 0.35, "side by side: at {one} and {other} m");
}
