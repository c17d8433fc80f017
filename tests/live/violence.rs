//! Whatever a player does, a second later no triangle is inside out and no skin crosses another.

use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::sim::Dynamics;

use super::tangle::faults;
use super::{disc, fastest, soft, world};

fn until(world: &mut dyn Dynamics, t: f64) {
    while world.time() < t - 1e-9 {
        world.step();
    }
}

/// The scene as points and bonds, with other places.
fn with_places(scene: &Value, place: impl Fn(usize, [f64; 2]) -> [f64; 2]) -> Value {
    let expanded = Scene::parse(&scene.to_string(), "scene").unwrap().expanded().unwrap();
    let mut text: Value = serde_json::from_str(&expanded.to_json().unwrap()).unwrap();
    let places: Vec<Value> = text["points"]["position"]
        .as_array()
        .unwrap()
        .iter()
        .enumerate()
        .map(|(k, x)| json!(place(k, [x[0].as_f64().unwrap(), x[1].as_f64().unwrap()])))
        .collect();
    text["points"]["position"] = json!(places);
    text
}

fn block(at: [f64; 2], [columns, rows]: [u32; 2], stiffness: f64) -> Value {
    json!({"make": "lattice", "columns": columns, "rows": rows, "spacing": 0.1, "origin": at,
        "material": {"kind": "spring", "stiffness": stiffness, "damping": 0.5, "mass": 1}})
}

/// A scene on a floor between walls.
fn room(bodies: &[Value]) -> Value {
    json!({"wobble": 1, "gravity": [0, -9.81], "contact": true, "method": {"solver": "live"}, "bodies": bodies,
        "bounds": {"min": [-3, 0], "max": [3, 20], "friction": 0.5}})
}

/// Rows of discs side by side.
fn heap(columns: u32, rows: u32) -> Vec<Value> {
    let at = |k: u32| [0.6 * f64::from(k % columns) - 0.3 * f64::from(columns - 1), 0.3 + 0.6 * f64::from(k / columns)];
    (0..columns * rows).map(|k| disc(at(k), [0.0; 2])).collect()
}

/// Strength of a mouse of 0.3 m that gives a point of `mass` [kg] so much force at most [N]: 0.286 strength radius mass.
fn strength(force: f64, mass: f64) -> f64 {
    force / (0.286 * 0.3 * mass)
}

/// Mean mass of a point of the first body [kg].
fn point_mass(scene: &Value) -> f64 {
    let world = world(scene);
    world.masses().iter().sum::<f64>() / world.point_count() as f64
}

/// Force of a fist on a point at most [N].
const FIST: f64 = 4_000.0;

/// Runs until `t` [s]; returns the largest speed on the way [m/s].
fn struck(world: &mut dyn Dynamics, t: f64) -> f64 {
    let mut most: f64 = 0.0;
    while world.time() < t - 1e-9 {
        world.step();
        most = most.max(fastest(&world.sample(world.time())));
    }
    most
}

#[test]
fn a_fist_leaves_nothing_inside_out() {
    for x in [0.0, 0.3, 0.55] {
        let mut scene = room(&heap(3, 3));
        scene["mouse"] = json!({"strength": strength(FIST, point_mass(&scene)), "radius": 0.3,
            "track": [[1.0, x, 3.0], [1.3, x, 0.4], [1.8, x, 0.4], [1.9, x + 0.3, 0.3], [1.95, 9.0, 9.0]]});
        let mut world = world(&scene);
        assert!(struck(&mut *world, 1.9) > 5.0, "at {x}");
        until(&mut *world, 2.95);
        assert_eq!(faults(&*world), [0, 0], "at {x}");
    }
}

#[test]
fn a_fist_on_a_block_leaves_nothing_inside_out() {
    for stiffness in [3_000.0, 30_000.0] {
        let mut scene = room(&[block([-0.5, 0.01], [11, 7], stiffness)]);
        scene["mouse"] = json!({"strength": strength(FIST, point_mass(&scene)), "radius": 0.3,
            "track": [[0.2, 0.1, 2.0], [0.4, 0.1, 0.3], [1.0, 0.1, 0.3], [1.01, 9.0, 9.0]]});
        let mut world = world(&scene);
        assert!(struck(&mut *world, 1.0) > 5.0, "at {stiffness} N/m");
        until(&mut *world, 2.01);
        assert_eq!(faults(&*world), [0, 0], "at {stiffness} N/m");
    }
}

fn pressed(share: f64) {
    // A plate of pinned points that comes down, stays and goes.
    let (mut top, height) = (Vec::new(), 0.6);
    for k in 0..15 {
        let x = -0.75 + 0.1 * f64::from(k);
        let low = height * share;
        let track = json!([[0.0, x, 0.7], [0.5, x, low], [1.0, x, low], [1.2, x, 1.5]]);
        top.push(json!({"point": k, "track": track}));
    }
    let plate = json!({"make": "rope", "count": 15, "spacing": 0.1, "origin": [-0.75, 0.7],
            "pinned": (0..15).collect::<Vec<u32>>(), "material": {"kind": "rigid"}});
    let mut scene = room(&[plate, block([-0.5, 0.01], [11, 7], 3_000.0)]);
    scene["pin_motion"] = json!(top);
    let mut world = world(&scene);
    until(&mut *world, 2.0);
    assert_eq!(faults(&*world), [0, 0], "to {share} of its height");
}

#[test]
fn a_press_to_six_tenths_of_its_height_leaves_a_block_whole() {
    pressed(0.6);
}

#[test]
fn a_press_to_a_third_of_its_height_leaves_a_block_whole() {
    pressed(0.35);
}

#[test]
fn a_flick_of_100_metres_a_second_tangles_nothing() {
    for turn in 0..3 {
        let mut bodies = heap(4, 3);
        bodies.push(disc([-2.5, 0.4 + 0.4 * f64::from(turn)], [100.0, -5.0 * f64::from(turn)]));
        let mut world = world(&room(&bodies));
        until(&mut *world, 1.0);
        assert_eq!(faults(&*world), [0, 0], "flick {turn}");
    }
}

#[test]
fn a_rim_that_starts_as_an_eight_opens() {
    for kind in [soft(), json!({"kind": "spring", "stiffness": 300, "damping": 0.2, "mass": 1})] {
        let rim = json!({"wobble": 1, "contact": true,
        "method": {"solver": "live"}, "bodies": [{"make": "rim", "radius": 1, "inner_radius": 0.8, "sectors": 24,
            "material": kind}]});
        let scene = with_places(&rim, |_, [x, y]| {
            let (angle, off) = (y.atan2(x), x.hypot(y) - 0.9);
            // Along an eight, `off` to its left, or right.
            let at = [1.0 * angle.cos(), 0.5 * (2.0 * angle).sin()];
            let along = [-angle.sin(), (2.0 * angle).cos()];
            let length = along[0].hypot(along[1]);
            [at[0] + off * along[1] / length, at[1] - off * along[0] / length]
        });
        let mut world = world(&scene);
        assert!(faults(&*world)[1] > 0, "it starts crossed");
        until(&mut *world, 1.0);
        assert_eq!(faults(&*world), [0, 0]);
    }
}

#[test]
fn a_bow_tie_opens() {
    let scene = json!({"wobble": 1, "contact": true,
        "method": {"solver": "live"}, "bodies": [block([-0.45, -0.35], [10, 8], 3_000.0)]});
    // Turned over more and more from one side to the other.
    let twisted = with_places(&scene, |_, [x, y]| [x, y * x / 0.45]);
    let swapped = with_places(&scene, |k, x| match k {
        0 => [0.45, 0.35],
        79 => [-0.45, -0.35],
        _ => x,
    });
    let turned = with_places(&scene, |_, [x, y]| [-x, y]);
    for (what, scene) in [("twisted", twisted), ("corners swapped", swapped), ("mirrored", turned)] {
        let mut world = world(&scene);
        let begins = faults(&*world);
        until(&mut *world, 1.0);
        assert_eq!(faults(&*world), [0, 0], "{what}, which began with {begins:?}");
    }
}

#[test]
fn what_starts_pierced_comes_apart_gently() {
    let bar = |at: [f64; 2]| block(at, [12, 2], 3_000.0);
    let at_rest = |mut scene: Value| {
        scene["gravity"] = json!([0, 0]);
        scene
    };
    let large = json!({"make": "disc", "radius": 0.4, "spacing": 0.1, "origin": [0, 1], "material": soft()});
    let scenes = [
        ("a bar through a disc", at_rest(room(&[large.clone(), bar([-0.55, 1.0])]))),
        ("a bar in a disc", at_rest(room(&[large.clone(), bar([0.1, 1.0])]))),
        ("two discs", at_rest(room(&[disc([0.0, 1.0], [0.0; 2]), disc([0.2, 1.1], [0.0; 2])]))),
        ("two discs in one place", at_rest(room(&[disc([0.0, 1.0], [0.0; 2]), disc([0.0, 1.0], [0.0; 2])]))),
        (
            "a disc in a disc",
            at_rest(room(&[
                large.clone(),
                json!({"make": "disc", "radius": 0.15, "spacing": 0.1,
            "origin": [0.02, 1.0], "material": soft()}),
            ])),
        ),
        ("on a floor", room(&[disc([0.0, 0.26], [0.0; 2]), disc([0.05, 0.5], [0.0; 2])])),
    ];
    for (what, scene) in scenes {
        let mut world = world(&scene);
        let (mut most, rests) = (0.0_f64, scene["gravity"] == json!([0, 0]));
        while world.time() < 1.0 - 1e-9 {
            world.step();
            most = most.max(fastest(&world.sample(world.time())));
        }
        assert_eq!(faults(&*world), [0, 0], "{what}");
        assert!(!rests || most < 1.1, "{what}: {most} m/s");
    }
}

#[test]
fn a_heap_of_discs_deep_in_each_other_comes_apart() {
    let at = |k: u32| [0.25 * f64::from(k % 6) - 0.6 + 0.01 * f64::from(k % 5), 0.3 + 0.25 * f64::from(k / 6)];
    let discs: Vec<Value> = (0..24).map(|k| disc(at(k), [0.0; 2])).collect();
    let mut world = world(&room(&discs));
    let begins = faults(&*world);
    until(&mut *world, 3.0);
    assert_eq!(faults(&*world), [0, 0], "after 3 s, of {begins:?}");
}

#[test]
fn limbs_that_do_not_meet_their_own_body_may_cross_it() {
    let place = [[0, 0], [30, -10], [30, 10], [100, 0], [30, -20], [40, 5], [90, -30]]
        .map(|x: [i32; 2]| x.map(|x| f64::from(x) / 100.0));
    let ends = [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3], [0, 4], [0, 5], [4, 5], [4, 6], [5, 6]];
    let bonds = ends.map(|[a, b]| json!({"a": a, "b": b}));
    let scene = json!({"wobble": 1, "contact": {"self": false}, "method": {"solver": "live"}, "gravity": [0, -9.81],
        "points": {"position": place}, "bonds": bonds,
        "triangles": [[0, 1, 2], [1, 3, 2], [0, 4, 5], [4, 6, 5]],
        "bounds": {"min": [-3, -1], "max": [3, 4], "friction": 0.5}});
    let mut world = world(&scene);
    until(&mut *world, 2.0);
    assert_eq!(world.counters().mended, 0);
}

#[test]
fn nothing_is_looked_for_where_nothing_presses() {
    let scene = json!({"wobble": 1, "contact": true, "method": {"solver": "live"},
        "bodies": [disc([0.0, 0.0], [0.1, 0.0]), disc([2.0, 0.0], [0.0, 0.0])]});
    let mut world = world(&scene);
    until(&mut *world, 0.5);
    let early = world.counters().looks;
    until(&mut *world, 2.0);
    // One at the start, of each.
    assert_eq!((early, world.counters().looks, world.counters().mended, world.counters().parted), (2, 2, 0, 0));
}

/// What is crushed under a weight that leading it in its time would not lift: a layer of the gear lies flat on the floor.
#[test]
fn a_picture_too_soft_for_its_fall_opens_under_its_own_weight() {
    let gear = json!({"make": "picture", "file": "pictures/gear.png", "height": 1.2, "origin": [-0.6, 4.0], "pattern": "braced",
        "material": {"kind": "spring", "young": 400, "mass": 1}});
    let scene = json!({"wobble": 1, "contact": true, "gravity": [0, -9.81], "bodies": [gear],
        "bounds": {"min": [-3, 0], "max": [3, 6], "friction": 0.5}});
    let (_, world) = super::run(&scene, 1.0);
    assert!(faults(&*world)[0] > 0, "nothing was crushed");
    let (_, world) = super::run(&scene, 6.0);
    assert_eq!(faults(&*world), [0; 2]);
}

/// A picture of such stuff that it cannot stand, thrown at an angle, with a spin [rad, 1/s, m/s].
fn limp(file: &str, [angle, spin]: [f64; 2], velocity: [f64; 2]) -> Value {
    let picture = json!({"make": "picture", "file": file, "height": 2, "spacing": 0.08, "origin": [-1.6, 2.2],
        "angle": angle, "spin": spin, "velocity": velocity, "material": {"kind": "spring", "young": 400, "mass": 4}});
    json!({"wobble": 1, "contact": true, "gravity": [0, -9.81], "bodies": [picture],
        "bounds": {"min": [-4, 0], "max": [4, 4.6], "restitution": 0.3, "friction": 0.4}})
}

/// How long the triangle is inside out that is so longest, until `t`, and the largest speed in the last second before it [s, m/s].
fn limped(scene: &Value, t: f64) -> [f64; 2] {
    let mut world = world(scene);
    let (mut frame, mut longest, mut last): (u64, u32, f64) = (0, 0, 0.0);
    let mut since: Vec<u32> = Vec::new();
    while world.time() < t - 1e-9 {
        world.step();
        if wobble::sim::frame_of(world.time()) == frame {
            continue;
        }
        frame = wobble::sim::frame_of(world.time());
        let sample = world.sample(world.time());
        let areas = super::areas(&*world, &sample);
        since.resize(areas.len(), 0);
        for (since, area) in since.iter_mut().zip(&areas) {
            *since = if *area < 0.0 { *since + 1 } else { 0 };
            longest = longest.max(*since);
        }
        if world.time() > t - 1.0 {
            last = last.max(fastest(&sample));
        }
    }
    [f64::from(longest) / 60.0, last]
}

/// Where a limb is bent so far that its skin creases, it was led back to its shape, fell over, was led back again, and so on for ever.
#[test]
fn what_is_too_limp_to_stand_lies_still() {
    for (file, turns, velocity, t) in [
        ("pictures/jellyfish.png", [4.312_943_544, -0.327_010_936], [4.436_199_698, -8.962_149_979], 20.0),
        ("pictures/maze.png", [1.958_341_731, 2.383_390_444], [-2.383_035_159, -4.395_582_263], 6.0),
    ] {
        let [longest, speed] = limped(&limp(file, turns, velocity), t);
        assert!(longest < 0.5, "{file} was inside out for {longest} s");
        assert!(speed < 0.2, "{file} went {speed} m/s at the end");
    }
}

/// What presses a picture flat on a wall turns triangles about the flat ones inside out as well, unless they are held while those are led back.
#[test]
fn what_is_thrown_at_a_wall_is_soon_right_again() {
    let [longest, _] = limped(&limp("pictures/letter.png", [4.0, 3.0], [20.0, 4.0]), 2.0);
    assert!(longest < 0.3, "the letter was inside out for {longest} s");
}
