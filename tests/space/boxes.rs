//! Rigid bodies in space among planes: Coulomb's law, and no energy from nowhere.

use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::scene::record::ledgers;
use wobble::sim::judge;

use super::tops::{body, corners, is_a_body, mean, moving, run};
use super::{G, length, sub, world};

/// A box on or above a level floor.
fn on_floor(half: [f64; 3], [height, friction, restitution]: [f64; 3], (along, spin): ([f64; 3], [f64; 3])) -> Value {
    let position = corners(half, [0.0, height, 0.0]);
    let mut scene = body(&position, &moving(&position, along, spin));
    scene["gravity"] = json!([0, -G, 0]);
    scene["obstacles"] =
        json!([{"plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}, "friction": friction, "restitution": restitution}]);
    scene
}

const HALF: [f64; 3] = [0.5, 0.5, 0.4];

#[test]
fn what_slides_stops_after_v_square_over_2_mu_g_whichever_way_it_goes() {
    for way in [[1.0, 0.0, 0.0], [0.6, 0.0, -0.8]] {
        let mut scene = on_floor(HALF, [0.5, 0.3, 0.0], (way, [0.0; 3]));
        scene["method"] = json!({"sleep": false});
        let (end, world) = run(&scene, 2.0);
        assert!(is_a_body(&*world));
        let gone = 1.0 / (2.0 * 0.3 * G);
        let expected = [gone * way[0], 0.5, gone * way[2]];
        let off = length(sub(mean(&end.position), expected));
        assert!(off < 1e-9, "{way:?}: {off}");
    }
}

#[test]
fn on_a_slope_it_slides_by_coulombs_law_or_stays_where_it_is() {
    let angle: f64 = 0.35;
    let down = [0.6, -0.8];
    let gravity = [G * angle.sin() * down[0], -G * angle.cos(), G * angle.sin() * down[1]];
    let mut scene = on_floor(HALF, [0.5, 0.2, 0.0], ([0.0; 3], [0.0; 3]));
    scene["gravity"] = json!(gravity);
    let (end, _) = run(&scene, 3.0);
    let gone = 0.5 * G * (angle.sin() - 0.2 * angle.cos()) * 9.0;
    let off = length(sub(mean(&end.position), [gone * down[0], 0.5, gone * down[1]]));
    assert!(off < 1e-8 * gone, "{off} of {gone}");
    let mut scene = on_floor(HALF, [0.5, 0.5, 0.0], ([0.0; 3], [0.0; 3]));
    scene["gravity"] = json!(gravity);
    scene["method"] = json!({"sleep": false});
    let start = world(&scene).sample(0.0);
    let (end, _) = run(&scene, 5.0);
    let crept = start.position.iter().zip(&end.position).map(|(a, b)| length(sub(*a, *b))).fold(0.0, f64::max);
    assert!(crept < 1e-11, "{crept}");
}

#[test]
fn a_box_that_is_dropped_gains_nothing_and_comes_to_rest_flat() {
    for (spin, friction) in [([0.0; 3], 0.5), ([1.0, 0.3, -2.0], 0.5), ([1.0, 0.3, -2.0], 0.0), ([0.0, 8.0, 0.0], 0.3)]
    {
        let scene = on_floor(HALF, [2.0, friction, 0.4], ([0.5, 0.0, 0.2], spin));
        let mut world = world(&scene);
        let mut last = world.energy();
        let mut most: f64 = 0.0;
        while world.time() < 6.0 {
            world.step();
            most = most.max(world.energy() - last);
            last = world.energy();
            let low = world.sample(world.time()).position.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
            assert!(low > -1e-9, "{spin:?}: {low}");
        }
        assert!(is_a_body(&*world));
        assert!(most < 1e-6 * 8.0 * G * 2.0, "{spin:?} {friction}: {most}");
        let end = world.sample(world.time());
        let height = mean(&end.position)[1];
        let is_flat = HALF.iter().any(|half| (height - half).abs() < 1e-8);
        assert!(is_flat, "{spin:?} {friction}: {height}");
        assert!(friction == 0.0 || world.is_asleep(), "{spin:?} {friction}");
    }
}

#[test]
fn restitution_1_keeps_energy_over_20_bounces() {
    for (spin, friction) in [([0.0; 3], 0.0), ([0.0; 3], 0.5), ([1.0, 0.3, -2.0], 0.0)] {
        let scene = on_floor(HALF, [1.5, friction, 1.0], ([0.0; 3], spin));
        let mut world = world(&scene);
        let start = world.energy();
        while world.counters().events < 20 {
            world.step();
            assert!((world.energy() / start - 1.0).abs() < 1e-3, "{spin:?} at {} s", world.time());
            assert!(world.time() < 60.0);
        }
        assert!((world.energy() / start - 1.0).abs() < 1e-6, "{spin:?}: {}", world.energy() / start - 1.0);
    }
}

/// How far a wheel with so many corners at 1 m, as heavy there as it is, gets in a time down a slope: it turns about one corner, then about the
/// next, and each impact leaves (1 + cos a)/2 of its spin, a being the angle between them.
fn rolled(corners: f64, (speed, slope): (f64, f64), t: f64) -> f64 {
    let side = 2.0 * std::f64::consts::PI / corners;
    let h = 1e-5;
    // From where it lies on a side and hits the next corner at once.
    let (mut lean, mut spin) = (-0.5 * side, 0.5 * speed * (1.0 + (0.5 * side).cos()));
    let mut pivot = (0.5 * side).sin();
    for _ in 0..(t / h).round() as u32 {
        let push = |lean: f64| 0.5 * G * (lean + slope).sin();
        let middle = spin + 0.5 * h * push(lean);
        lean += h * middle;
        spin = middle + 0.5 * h * push(lean);
        if lean > 0.5 * side {
            lean -= side;
            spin *= 0.5 * (1.0 + side.cos());
            pivot += 2.0 * (0.5 * side).sin();
        }
    }
    pivot + lean.sin()
}

#[test]
fn a_wheel_of_points_rolls_from_corner_to_corner() {
    // Two rings of six points, on a slope.
    let (count, angle) = (6, 0.25_f64);
    let ring = |z: f64| {
        (0..count).map(move |k| {
            let turn = 2.0 * std::f64::consts::PI * (f64::from(k) + 0.5) / f64::from(count);
            [turn.sin(), (std::f64::consts::PI / f64::from(count)).cos() - turn.cos(), z]
        })
    };
    let position: Vec<[f64; 3]> = ring(-0.3).chain(ring(0.3)).collect();
    let mut scene = body(&position, &moving(&position, [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]));
    scene["gravity"] = json!([G * angle.sin(), -G * angle.cos(), 0]);
    scene["obstacles"] = json!([{"plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}, "friction": 0.8}]);
    for (t, most) in [(0.5, 1e-5), (1.0, 2e-4)] {
        let (end, world) = run(&scene, t);
        assert!(is_a_body(&*world));
        let (gone, expected) = (mean(&end.position)[0], rolled(6.0, (2.0, angle), t));
        assert!((gone - expected).abs() < most, "{gone} {expected} at {t} s");
    }
}

#[test]
fn a_tall_box_tips_beyond_its_edge_and_not_before() {
    let half = [0.3, 0.9, 0.3];
    for (angle, tips) in [(0.30_f64, false), (0.34, true)] {
        // It stands as long as tan(angle) < 1/3.
        let mut scene = on_floor(half, [0.9, 2.0, 0.0], ([0.0; 3], [0.0; 3]));
        scene["gravity"] = json!([G * angle.sin(), -G * angle.cos(), 0]);
        let (end, _) = run(&scene, 4.0);
        let height = mean(&end.position)[1];
        assert_eq!(height < 0.5, tips, "{angle}: {height}");
    }
}

#[test]
fn a_ledger_says_where_the_energy_went() {
    let mut scene = on_floor(HALF, [2.0, 0.5, 0.4], ([0.5, 0.0, 0.2], [1.0, 0.3, -2.0]));
    scene["method"] = json!({"ledger": true});
    scene["drag_rate"] = json!(0.1);
    scene["duration"] = json!(3);
    let scene = Scene::parse(&scene.to_string(), "scene").unwrap();
    let mut world = scene.world(None).unwrap();
    let found = judge(&ledgers(&mut *world, 3.0).unwrap());
    assert!(found.passes(), "{found:?}");
}

#[test]
fn among_planes_neither_pins_nor_many_corners_make_a_body() {
    let position = [[0.0, 0.5, 0.0], [1.0, 0.6, 0.0], [0.9, 0.5, 0.3], [0.9, 0.5, -0.2], [0.8, 0.4, 0.0]];
    let mut scene = body(&position, &[[0.0; 3]; 5]);
    scene["gravity"] = json!([0, -G, 0]);
    scene["obstacles"] = json!([{"plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}, "friction": 0.4}]);
    assert!(is_a_body(&*world(&scene)));
    scene["points"]["pinned"] = json!([0]);
    assert!(!is_a_body(&*world(&scene)), "what a pin holds against friction may have no way out of a plane");
    let wheel = |k: u32| {
        let turn = 0.25 * std::f64::consts::PI * f64::from(k);
        [turn.cos(), 2.0 + turn.sin(), if k < 8 { -0.3 } else { 0.3 }]
    };
    let many: Vec<[f64; 3]> = (0..16).map(wheel).collect();
    let mut scene = body(&many, &[[0.0; 3]; 16]);
    assert!(is_a_body(&*world(&scene)));
    scene["bounds"] = json!({"min": [-9, 0, -9], "max": [9, 9, 9]});
    assert!(!is_a_body(&*world(&scene)));
}
