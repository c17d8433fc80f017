//! Rigid bodies in space that meet nothing: free, on one pin, on two, on three. What is right comes from closed forms, and from the same bonds
//! by a method of order 8 that knows of no bodies.

use std::f64::consts::PI;

use serde_json::{Value, json};
use wobble::sim::{Dynamics, PointId, Sample, Solver};

use super::{cross, dot, length, sub, world};

/// Points with all bonds between them.
pub(super) fn body(position: &[[f64; 3]], velocity: &[[f64; 3]]) -> Value {
    let ends = (0..position.len()).flat_map(|a| (a + 1..position.len()).map(move |b| json!({"a": a, "b": b})));
    json!({"wobble": 1, "dimensions": 3, "points": {"position": position, "velocity": velocity},
        "bonds": ends.collect::<Vec<_>>()})
}

/// The corners of a box with these half sides about a place.
pub(super) fn corners(half: [f64; 3], [x, y, z]: [f64; 3]) -> Vec<[f64; 3]> {
    let side = |n: u32, k: u32| if n >> k & 1 == 1 { 1.0 } else { -1.0 };
    (0..8).map(|n| [x + side(n, 0) * half[0], y + side(n, 1) * half[1], z + side(n, 2) * half[2]]).collect()
}

/// Velocities of what goes along and spins about the middle of its points.
pub(super) fn moving(position: &[[f64; 3]], along: [f64; 3], spin: [f64; 3]) -> Vec<[f64; 3]> {
    let middle = mean(position);
    let of = |x: &[f64; 3]| {
        let turned = cross(spin, sub(*x, middle));
        std::array::from_fn(|k| along[k] + turned[k])
    };
    position.iter().map(of).collect()
}

/// The state at a time to the last digit, and what it was reached with.
pub(super) fn run(scene: &Value, t: f64) -> (Sample, Box<dyn Dynamics>) {
    let mut world = world(scene);
    while world.time() + world.substep() <= t {
        world.step();
    }
    (world.sample(t), world)
}

pub(super) fn mean(list: &[[f64; 3]]) -> [f64; 3] {
    std::array::from_fn(|k| list.iter().map(|x| x[k]).sum::<f64>() / list.len() as f64)
}

pub(super) fn is_a_body(world: &dyn Dynamics) -> bool {
    world.moved_by().iter().all(|moved| moved.method == Solver::Rigid)
}

/// Angular momentum about the middle of points of 1 kg [kg m^2/s].
fn turning(sample: &Sample) -> [f64; 3] {
    let [x, v] = [&sample.position, &sample.velocity].map(|list| mean(list));
    let of = |(p, u): (&[f64; 3], &[f64; 3])| cross(sub(*p, x), sub(*u, v));
    sample.position.iter().zip(&sample.velocity).map(of).fold([0.0; 3], |sum, l| std::array::from_fn(|k| sum[k] + l[k]))
}

fn farthest(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| length(sub(*a, *b))).fold(0.0, f64::max)
}

#[test]
fn a_box_that_tumbles_about_its_middle_axis_keeps_energy_and_momentum_over_100_turns() {
    for precision in ["f64", "f32"] {
        let position = corners([0.6, 0.4, 0.1], [2.0, -1.0, 0.5]);
        let velocity = moving(&position, [0.4, 0.1, -0.2], [1e-3, 6.0, 0.0]);
        let mut scene = body(&position, &velocity);
        scene["method"] = json!({"precision": precision, "sleep": false});
        let start = world(&scene);
        let (before, energy) = (turning(&start.sample(0.0)), start.energy());
        let (end, world) = run(&scene, 100.0 * 2.0 * PI / 6.0);
        assert!(is_a_body(&*world));
        // 42 m away 32 bits tell places to some micrometres.
        let most = if precision == "f64" { 1e-9 } else { 1e-4 };
        let off = length(sub(turning(&end), before)) / length(before);
        assert!(off < most, "{precision}: momentum {off}");
        let off = (world.energy() / energy - 1.0).abs();
        assert!(off < most, "{precision}: energy {off}");
        assert!(world.sample(world.time()).max_strain < most);
    }
}

#[test]
fn what_turns_about_its_middle_axis_turns_over_when_jacobis_functions_say() {
    let half = [0.6, 0.4, 0.1];
    let position = corners(half, [0.0; 3]);
    let spin = [0.0, 6.0, 0.01];
    // Of eight points of 1 kg.
    let [x, y, z] = half.map(|side| 8.0 * side * side);
    let [a, b, c] = [y + z, x + z, x + y];
    let energy = b * spin[1] * spin[1] + c * spin[2] * spin[2];
    let square = (b * spin[1]).powi(2) + (c * spin[2]).powi(2);
    assert!(square > energy * b);
    // Landau and Lifshitz, Mechanics, section 37.
    let rate = ((c - b) * (square - energy * a) / (a * b * c)).sqrt();
    let modulus = ((b - a) * (energy * c - square) / ((c - b) * (square - energy * a))).sqrt();
    let quarter = quarter(modulus) / rate;
    // Spin about the middle axis as the body sees it: full, none after a quarter of the period, and the other way round after a half.
    let spin_after = |t: f64| {
        let mut scene = body(&position, &moving(&position, [0.0; 3], spin));
        scene["method"] = json!({"substep": t / 100.0});
        let (end, world) = run(&scene, t);
        assert!(is_a_body(&*world));
        let p = &end.position;
        let third = sub(p[4], p[0]).map(|x| x / length(sub(p[4], p[0])));
        let w = &end.velocity;
        // v_1 - v_0 = spin x (x_1 - x_0): its part along the third axis is less the spin about the second one.
        -dot(sub(w[1], w[0]), third) / length(sub(p[1], p[0]))
    };
    assert!(spin_after(quarter).abs() < 1e-6, "{}", spin_after(quarter));
    assert!((spin_after(2.0 * quarter) + 6.0).abs() < 1e-6, "{}", spin_after(2.0 * quarter));
}

/// The complete elliptic integral of the first kind, by the arithmetic-geometric mean.
fn quarter(modulus: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - modulus * modulus).sqrt());
    for _ in 0..40 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * PI / a
}

const TETRAHEDRON: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 1.1, 0.0], [0.4, 0.3, 0.9]];

/// A tetrahedron that is pinned so, thrown and spun, and where it is after `t` as a body, and bond by bond at order 8. A spring of next to nothing to a pin
/// keeps it from being a body.
fn both(pins: &[usize], spin: [f64; 3], t: f64) -> [Sample; 2] {
    let along = cross(spin, mean(&TETRAHEDRON)).map(|x| if pins.is_empty() { x + 0.3 } else { x });
    let mut scene = body(&TETRAHEDRON, &moving(&TETRAHEDRON, along, spin));
    scene["gravity"] = json!([0.5, -9.81, 1.0]);
    scene["drag_rate"] = json!(0.2);
    scene["points"]["pinned"] = json!(pins);
    let (end, world) = run(&scene, t);
    assert!(is_a_body(&*world));
    let mut points = TETRAHEDRON.to_vec();
    points.push([3.0, 3.0, 3.0]);
    let mut velocity = moving(&TETRAHEDRON, along, spin);
    velocity.push([0.0; 3]);
    let pinned = [pins, &[4]].concat();
    scene["points"] = json!({"position": points, "velocity": velocity, "pinned": pinned});
    scene["bonds"].as_array_mut().unwrap().push(json!({"a": 3, "b": 4, "kind": "spring", "stiffness": 1e-12}));
    scene["method"] = json!({"solver": "rk8", "substep": 1e-3});
    let (mut other, world) = run(&scene, t);
    assert!(!is_a_body(&*world));
    other.position.pop();
    other.velocity.pop();
    [end, other]
}

#[test]
fn bodies_go_where_their_bonds_lead_them_free_and_on_pins() {
    for pins in [&[][..], &[1], &[0, 2]] {
        // On two pins it spins about their line alone.
        let spin = if pins.len() == 2 { [0.3, 1.1, 0.0].map(|x| 2.0 * x) } else { [2.0, -1.0, 3.0] };
        let spin = if pins == [1] { [0.0; 3] } else { spin };
        let [end, other] = both(pins, spin, 2.0);
        let off = farthest(&end.position, &other.position);
        assert!(off < 1e-8, "{pins:?}: {off}");
        let off = farthest(&end.velocity, &other.velocity);
        assert!(off < 1e-7, "{pins:?}: {off}");
    }
}

#[test]
fn a_heavy_top_precesses_steadily() {
    // Four points of 1 kg on a circle about an axis through the pin, which leans by an angle from the vertical, y.
    let (height, radius, lean, rate) = (0.8, 0.3, 0.5_f64, 1.5);
    let g = 9.81;
    let axis = [lean.sin(), lean.cos(), 0.0];
    let across = [lean.cos(), -lean.sin(), 0.0];
    let place = |k: i32| {
        let angle = 0.5 * PI * f64::from(k);
        let r: [f64; 3] = std::array::from_fn(|i| height * axis[i] + radius * angle.cos() * across[i]);
        [r[0], r[1], radius * angle.sin()]
    };
    let position: Vec<[f64; 3]> = std::iter::once([0.0; 3]).chain((0..4).map(place)).collect();
    let (own, other) = (4.0 * radius * radius, 4.0 * height * height + 2.0 * radius * radius);
    let moment = 4.0 * g * height;
    // A steady lean: other rate^2 cos(lean) - own spin rate + m g l = 0, with all of the spin about the axis.
    let spin = (other * rate * rate * lean.cos() + moment) / (own * rate);
    let own_spin = spin - rate * lean.cos();
    let turn: [f64; 3] = std::array::from_fn(|k| own_spin * axis[k] + if k == 1 { rate } else { 0.0 });
    let velocity: Vec<[f64; 3]> = position.iter().map(|x| cross(turn, *x)).collect();
    let mut scene = body(&position, &velocity);
    scene["gravity"] = json!([0, -g, 0]);
    scene["points"]["pinned"] = json!([0]);
    let t = 10.0;
    let (end, world) = run(&scene, t);
    assert!(is_a_body(&*world));
    let found = mean(&end.position[1..]).map(|x| x / height);
    // About y by rate t: x goes towards -z.
    let expected = [lean.sin() * (rate * t).cos(), lean.cos(), -lean.sin() * (rate * t).sin()];
    assert!(length(sub(found, expected)) < 1e-9, "{found:?} {expected:?}");
}

#[test]
fn what_two_pins_hold_swings_with_the_period_of_a_physical_pendulum() {
    // A box on a level axis along z beneath which its middle hangs, let go at an angle.
    let (half, arm, angle, g) = ([0.3, 0.2, 0.4], 0.5, 2.0_f64, 9.81);
    let mut position = corners(half, [0.0, -arm, 0.0]);
    position.extend([[0.0, 0.0, -0.4], [0.0, 0.0, 0.4]]);
    let turned = |[x, y, z]: [f64; 3]| [angle.cos() * x - angle.sin() * y, angle.sin() * x + angle.cos() * y, z];
    let start: Vec<[f64; 3]> = position.iter().map(|&x| turned(x)).collect();
    let mut scene = body(&start, &vec![[0.0; 3]; 10]);
    scene["gravity"] = json!([0, -g, 0]);
    scene["points"]["pinned"] = json!([8, 9]);
    let inertia = 8.0 * (half[0] * half[0] + half[1] * half[1] + arm * arm);
    let quarter = quarter((0.5 * angle).sin()) * (inertia / (8.0 * g * arm)).sqrt();
    scene["method"] = json!({"substep": quarter / 40.0});
    for (quarters, lean) in [(1.0, 0.0), (2.0, -angle), (8.0, angle)] {
        let (end, world) = run(&scene, quarters * quarter);
        assert!(is_a_body(&*world));
        let middle = mean(&end.position[..8]);
        let expected = [arm * f64::sin(lean), -arm * f64::cos(lean), 0.0];
        assert!(length(sub(middle, expected)) < 1e-9, "{quarters}: {middle:?} {expected:?}");
    }
}

#[test]
fn what_three_pins_hold_stands_still_and_one_that_is_led_moves_bonds() {
    let mut scene = body(&TETRAHEDRON, &[[0.0; 3]; 4]);
    scene["gravity"] = json!([0, -9.81, 0]);
    scene["points"]["pinned"] = json!([0, 1, 3]);
    scene["method"] = json!({"sleep": false});
    let (end, still) = run(&scene, 1.0);
    assert!(is_a_body(&*still));
    assert!(farthest(&end.position, &TETRAHEDRON) < 1e-14);
    scene["pin_motion"] = json!([{"point": 0, "track": [[0, 0, 0, 0], [1, 0, 0, 0]]}]);
    assert!(!is_a_body(&*world(&scene)));
}

#[test]
fn what_stands_still_sleeps_and_a_hinge_of_two_triangles_is_no_body() {
    let (_, still) = run(&body(&TETRAHEDRON, &[[0.0; 3]; 4]), 1.0);
    assert!(is_a_body(&*still) && still.is_asleep());
    let mut hinge = body(&TETRAHEDRON, &[[0.0; 3]; 4]);
    hinge["bonds"].as_array_mut().unwrap().pop();
    assert!(!is_a_body(&*world(&hinge)));
    // Nor is what lies in one plane, whatever holds it there.
    let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 1.1, 0.0], [0.5, 0.4, 0.0]];
    assert!(!is_a_body(&*world(&body(&flat, &[[0.0; 3]; 4]))));
}

#[test]
fn springs_within_a_body_count_their_energy_and_do_nothing_else() {
    let position = corners([0.6, 0.4, 0.1], [0.0; 3]);
    let velocity = moving(&position, [0.0; 3], [1.0, 2.0, 3.0]);
    let plain = body(&position, &velocity);
    let mut sprung = plain.clone();
    sprung["bonds"]
        .as_array_mut()
        .unwrap()
        .push(json!({"a": 0, "b": 7, "kind": "spring", "stiffness": 50, "rest": 1, "damping": 5}));
    let (end, alone) = run(&plain, 1.0);
    let (other, world) = run(&sprung, 1.0);
    assert!(is_a_body(&*world));
    assert!(farthest(&end.position, &other.position) == 0.0);
    let far = length(sub(position[7], position[0]));
    assert!((world.energy() - alone.energy() - 25.0 * (far - 1.0).powi(2)).abs() < 1e-9);
}

#[test]
fn lengths_of_few_digits_make_a_body_and_are_told() {
    let round = |x: f64| (x * 1e4).round() * 1e-4;
    let position: Vec<[f64; 3]> =
        corners([0.613, 0.417, 0.123], [0.0, 5.0, 0.0]).into_iter().map(|x| x.map(round)).collect();
    let mut scene = body(&position, &moving(&position, [0.0; 3], [1.0, 2.0, 3.0]));
    for bond in scene["bonds"].as_array_mut().unwrap() {
        let [a, b] = ["a", "b"].map(|end| position[bond[end].as_u64().unwrap() as usize]);
        bond["rest"] = json!(round(length(sub(a, b))));
    }
    let (end, world) = run(&scene, 1.0);
    assert!(is_a_body(&*world), "{:?}", world.moved_by());
    assert!(end.max_strain < 1e-12);
    assert!(world.warnings().iter().any(|line| line.contains("contradict")), "{:?}", world.warnings());
    assert!(world.velocity(PointId(0)).iter().all(|v| v.is_finite()));
}

/// Where it may meet others its bonds are swept, which fed it: thirty times its energy after 40 s.
#[test]
fn a_box_among_others_that_tumbles_gains_nothing() {
    let position = corners([0.3, 0.2, 0.3], [0.0; 3]);
    let mut scene = body(&position, &moving(&position, [0.0; 3], [3.0, 12.0, 5.0]));
    (scene["contact"], scene["gravity"]) = (json!(true), json!([0, 0, 0]));
    let start = run(&scene, 0.0).0.energy;
    for t in [2.0, 10.0] {
        let (end, _) = run(&scene, t);
        assert!(end.energy < 1.001 * start, "{} J of {start} at {t} s", end.energy);
    }
}
