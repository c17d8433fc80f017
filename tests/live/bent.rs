//! Angles that bend together: chains and rings give as their closed forms say, however finely they are divided.

use std::f64::consts::{PI, TAU};

use serde_json::{Value, json};

use super::world;

/// Points in these places with equal shares of a mass [kg], bonds along them and angles at all inner ones: B/spacing [N m] each, so that
/// B [N m^2] is what the whole bends with.
fn chain(places: &[[f64; 2]], (mass, bending): (f64, f64), bond: &Value, is_closed: bool) -> Value {
    let count = places.len();
    let spacing = (places[1][0] - places[0][0]).hypot(places[1][1] - places[0][1]);
    let next = |i: usize, k: usize| (i + k) % count;
    let [bonds, angles] = if is_closed { [count, count] } else { [count - 1, count - 2] };
    let bonds: Vec<Value> = (0..bonds)
        .map(|i| {
            let mut bond = bond.clone();
            (bond["a"], bond["b"]) = (json!(i), json!(next(i, 1)));
            bond
        })
        .collect();
    let angles: Vec<Value> =
        (0..angles).map(|i| json!({"points": [i, next(i, 1), next(i, 2)], "stiffness": bending / spacing})).collect();
    json!({"wobble": 1, "contact": true, "drag_rate": 6, "method": {"solver": "live"},
        "points": {"position": places, "mass": vec![mass / count as f64; count]}, "bonds": bonds, "angles": angles})
}

fn kinds() -> [(&'static str, Value); 2] {
    [("rigid", json!({"kind": "rigid"})), ("spring", json!({"kind": "spring", "stiffness": 2e4, "damping": 1}))]
}

/// Where the points are after so long [s].
fn after(scene: &Value, t: f64) -> Vec<[f64; 3]> {
    let mut world = world(scene);
    while world.time() < t - 1e-9 {
        world.step();
    }
    world.sample(world.time()).position
}

#[test]
fn a_beam_of_any_number_of_points_sags_as_it_should() {
    // Nearly straight, angle j turns by M_j/k, the moment of all weights beyond it, and lowers the tip by that times its distance.
    for (count, (kind, bond)) in [6_usize, 21, 81].into_iter().flat_map(|count| kinds().map(|kind| (count, kind))) {
        let (mass, bending, g) = (0.4, 30.0, 9.81);
        let spacing = 1.0 / (count - 1) as f64;
        let places: Vec<[f64; 2]> = (0..count).map(|i| [i as f64 * spacing, 0.0]).collect();
        let mut scene = chain(&places, (mass, bending), &bond, false);
        scene["gravity"] = json!([0, -g]);
        scene["points"]["pinned"] = json!([0, 1]);
        let sag: f64 = (1..count - 1)
            .map(|j| {
                let moment: f64 = (j + 1..count).map(|i| mass / count as f64 * g * (i - j) as f64 * spacing).sum();
                moment / (bending / spacing) * (count - 1 - j) as f64 * spacing
            })
            .sum();
        let tip = -after(&scene, 4.0)[count - 1][1];
        assert!((tip - sag).abs() < 0.02 * sag, "{count} points, {kind}: {tip} m, where it should be {sag}");
    }
}

#[test]
fn a_ring_that_is_pinched_gives_as_it_should() {
    // Across it gives (pi/4 - 2/pi) F R^3/B: S. Timoshenko, Strength of Materials, part 1, thin rings. Its bonds are swept, and give some more.
    for (count, (kind, bond)) in [60_usize, 120].into_iter().flat_map(|count| kinds().map(|kind| (count, kind))) {
        let (radius, bending, force) = (0.5, 2.0, 2.0);
        let at = |i: usize| TAU * i as f64 / count as f64;
        let places: Vec<[f64; 2]> = (0..count).map(|i| [radius * at(i).cos(), radius * at(i).sin()]).collect();
        let mut scene = chain(&places, (0.5, bending), &bond, true);
        scene["forces"] = json!([{"points": [0], "force": [-force, 0]}, {"points": [count / 2], "force": [force, 0]}]);
        let gives = (PI / 4.0 - 2.0 / PI) * force * radius.powi(3) / bending;
        let end = after(&scene, 4.0);
        let given = 2.0 * radius - (end[0][0] - end[count / 2][0]);
        assert!((given - gives).abs() < 0.18 * gives, "{count} points, {kind}: {given} m, where it should be {gives}");
    }
}

#[test]
fn a_rod_that_strikes_a_floor_gains_nothing() {
    for ((kind, bond), bending) in kinds().into_iter().flat_map(|kind| [0.05, 1.0, 50.0].map(|b| (kind.clone(), b))) {
        let places: Vec<[f64; 2]> = (0..30).map(|i| [0.04 * f64::from(i), 1.0 + 0.03 * f64::from(i)]).collect();
        let mut scene = chain(&places, (0.4, bending), &bond, false);
        (scene["gravity"], scene["drag_rate"]) = (json!([0, -9.81]), json!(0));
        scene["points"]["velocity"] = json!(vec![[10, -10]; 30]);
        scene["bounds"] = json!({"min": [-4, 0], "max": [4, 6], "friction": 0.3, "restitution": 0.5});
        let mut world = world(&scene);
        let start = world.energy();
        while world.time() < 2.0 {
            world.step();
            let velocity = world.sample(world.time()).velocity;
            let square = |v: &[f64; 3]| v[0] * v[0] + v[1] * v[1];
            let kinetic: f64 = velocity.iter().zip(world.masses()).map(|(v, mass)| 0.5 * mass * square(v)).sum();
            assert!(kinetic < 1.05 * start, "{kind}, {bending} N m^2: {kinetic} J of {start} at {} s", world.time());
        }
        assert!(world.energy() < start, "{kind}, {bending} N m^2: {} J of {start} J", world.energy());
    }
}
