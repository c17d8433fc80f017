//! Points on circles, balls and boxes, against closed forms; what commands, files and copies keep of them; what is refused.

use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::sim::{Command, Convex, Figure, Motion, Selection};

use super::{G, cross, dot, length, run, sub, world};

/// A bead on a smooth circle of radius 1, or a ball, `from` the top [rad], and its velocity after it has left.
fn off_a_dome(dimensions: u64, from: f64) -> [f64; 3] {
    let (x, y) = (from.sin(), from.cos());
    let at = if dimensions == 2 { json!([x, y]) } else { json!([x, y, 0]) };
    let center = if dimensions == 2 { json!([0, 0]) } else { json!([0, 0, 0]) };
    let gravity = if dimensions == 2 { json!([0, -G]) } else { json!([0, -G, 0]) };
    let scene = json!({"wobble": 1, "dimensions": dimensions, "gravity": gravity, "points": {"position": [at]},
        "obstacles": [{"circle": {"center": center, "radius": 1}}]});
    let mut world = world(&scene);
    while world.sample(world.time()).position[0][1] > 0.0 {
        world.step();
        assert!(world.time() < 5.0);
    }
    let sample = world.sample(world.time());
    assert!(length(sample.position[0]) > 1.0, "{sample:?}");
    sample.velocity[0]
}

#[test]
fn a_bead_leaves_a_smooth_dome_at_two_thirds_of_its_height() {
    for (dimensions, most) in [(2, 1e-3), (3, 1e-3)] {
        let from: f64 = 0.2;
        let v = off_a_dome(dimensions, from);
        // It leaves where v^2 = g cos, with v^2 = 2 g (cos of the start - cos): from then on it keeps v cos.
        let cos = 2.0 / 3.0 * from.cos();
        let left = (v[0] * v[0] / G).cbrt();
        assert!((left - cos).abs() < most * cos, "in {dimensions}: it left at a cosine of {left} for {cos}");
    }
}

#[test]
fn a_bead_rests_between_two_circles_and_on_a_rough_one() {
    let valley = json!({"wobble": 1, "gravity": [0, -G], "points": {"position": [[0.1, 2]]}, "obstacles": [
        {"circle": {"center": [-0.8, 0], "radius": 1}, "friction": 0.3},
        {"circle": {"center": [0.8, 0], "radius": 1}, "friction": 0.3}]});
    let (rest, _) = run(&valley, 5.0);
    let [x, y, _] = rest.position[0];
    assert!(x.abs() < 1e-3 && (y - 0.6).abs() < 1e-3 && length(rest.velocity[0]) < 1e-6, "{rest:?}");
    for (angle, holds) in [(25.0_f64.to_radians(), true), (28.0_f64.to_radians(), false)] {
        let dome = json!({"wobble": 1, "gravity": [0, -G], "points": {"position": [[angle.sin(), angle.cos()]]},
            "obstacles": [{"circle": {"center": [0, 0], "radius": 1}, "friction": 0.5}]});
        let (later, _) = run(&dome, 2.0);
        let moved = length(sub(later.position[0], [angle.sin(), angle.cos(), 0.0]));
        assert_eq!(moved < 1e-3, holds, "at {angle}: {moved} m");
    }
}

/// The directions of a box that is turned about z.
fn ramp(angle: f64) -> [[f64; 3]; 2] {
    [[angle.cos(), angle.sin(), 0.0], [-angle.sin(), angle.cos(), 0.0]]
}

/// A block of eight points and all the bonds between them on a ramp, after a second.
fn on_a_ramp(angle: f64, friction: f64, contact: bool) -> f64 {
    let [along, up] = ramp(angle);
    let corner = |k: u32| -> Vec<f64> {
        let [x, y, z] = [0, 1, 2].map(|axis| 0.3 * f64::from(k >> axis & 1));
        (0..3).map(|axis| along[axis] * x + up[axis] * (y + 0.5) + if axis == 2 { z } else { 0.0 }).collect()
    };
    let bonds: Vec<Value> = (0..8).flat_map(|b| (0..b).map(move |a| json!({"a": a, "b": b}))).collect();
    let mut scene = json!({"wobble": 1, "dimensions": 3, "gravity": [0, -G, 0], "bonds": bonds,
        "points": {"position": (0..8).map(corner).collect::<Vec<_>>()},
        "obstacles": [{"box": {"min": [-20, -0.5, -5], "max": [20, 0.5, 5], "rotation": {"axis": [0, 0, 2], "angle": angle}},
            "friction": friction}]});
    if contact {
        scene["contact"] = json!(true);
    }
    let (later, _) = run(&scene, 1.0);
    let middle = |at: &[[f64; 3]]| at.iter().map(|x| dot(*x, along)).sum::<f64>() / at.len() as f64;
    assert!(later.position.iter().all(|x| dot(*x, up) > 0.5 - 1e-6));
    middle(&later.position) - 0.15
}

#[test]
fn a_block_on_a_ramp_holds_or_slides_as_friction_says() {
    let angle: f64 = 0.35;
    for contact in [false, true] {
        let held = on_a_ramp(angle, 1.05 * angle.tan(), contact);
        assert!(held.abs() < 2e-3, "it slid {held} m");
        for share in [0.0, 0.5, 0.9] {
            let way = -on_a_ramp(angle, share * angle.tan(), contact);
            let wanted = 0.5 * G * angle.sin() * (1.0 - share);
            assert!((way - wanted).abs() < 0.02 * wanted + 2e-3, "{share}: {way} m for {wanted}");
        }
    }
}

#[test]
fn a_point_bounces_off_a_ball_and_does_not_pass_a_thin_box_however_fast() {
    let bounce = json!({"wobble": 1, "dimensions": 3, "points": {"position": [[0, 3, 0]], "velocity": [[0, -2, 0]]},
        "obstacles": [{"circle": {"center": [0, 0, 0], "radius": 1}, "restitution": 0.5}]});
    let (later, _) = run(&bounce, 2.0);
    assert!((later.velocity[0][1] - 1.0).abs() < 1e-9, "{later:?}");
    for speed in [50.0, 200.0] {
        for turn in [0.0, 0.7] {
            let scene = json!({"wobble": 1, "dimensions": 3,
                "points": {"position": [[0, 3, 0], [0.4, 3, 0.3]], "velocity": [[0, -speed, 0], [3, -speed, 0]]},
                "obstacles": [{"box": {"min": [-9, -0.001, -9], "max": [9, 0.001, 9], "rotation": {"axis": [0, 0, 1], "angle": turn}}}]});
            let (later, _) = run(&scene, 0.5);
            let up = ramp(turn)[1];
            assert!(later.position.iter().all(|x| dot(*x, up) > 0.0), "{speed}: {:?}", later.position);
        }
    }
}

#[test]
fn what_starts_inside_a_ball_is_put_beside_it_with_a_word() {
    let scene = json!({"wobble": 1, "dimensions": 3, "points": {"position": [[0, 0.9, 0], [0.3, 0.95, 0]]}, "bonds": [{"a": 0, "b": 1}],
        "obstacles": [{"circle": {"center": [0, 0, 0], "radius": 1}}]});
    let (later, world) = run(&scene, 0.1);
    assert!(later.position.iter().all(|&x| length(x) >= 1.0 - 1e-9), "{later:?}");
    assert!(world.warnings().iter().any(|line| line.contains("inside an obstacle")), "{:?}", world.warnings());
    assert!(length(later.velocity[0]) < 1e-6, "without speed");
}

fn both() -> Value {
    json!({"wobble": 1, "dimensions": 3, "gravity": [0, -G, 0], "contact": true,
        "bodies": [{"make": "cloth", "columns": 5, "rows": 5, "spacing": 0.1, "v": [0, 0, 1], "origin": [-0.2, 1.2, -0.2]}],
        "obstacles": [{"plane": {"point": [0, -2, 0], "normal": [0, 1, 0]}},
            {"circle": {"center": [0, 0, 0], "radius": 1}, "friction": 0.4},
            {"box": {"min": [2, 0, 0], "max": [3, 1, 2], "rotation": {"axis": [1, 1, 0], "angle": 0.3}}, "restitution": 0.1}]})
}

#[test]
fn commands_and_saved_worlds_keep_balls_and_boxes() {
    let mut world = world(&both());
    assert_eq!(world.obstacle_numbers(), [&[0][..], &[1, 2][..]]);
    let before: Vec<Convex> = world.convex().to_vec();
    let motion = Motion {
        obstacles: vec![1, 2],
        by: [0.5, 0.0, 0.0],
        turn: std::f64::consts::FRAC_PI_2,
        scale: [2.0; 3],
        about: Some([0.0; 3]),
        ..Motion::default()
    };
    world.apply(&Command::Move(motion)).unwrap();
    let Figure::Ball { center, radius } = world.convex()[0].figure else { panic!("it was a ball") };
    assert_eq!((center, radius), ([0.5, 0.0, 0.0], 2.0));
    let (was, is) = (before[1].figure.frame().unwrap(), world.convex()[1].figure.frame().unwrap());
    let turned = |[x, y, z]: [f64; 3]| [-y, x, z];
    assert!((0..3).all(
        |k| length(sub(is.axes[k], turned(was.axes[k]))) < 1e-12 && (is.half[k] - 2.0 * was.half[k]).abs() < 1e-12
    ));
    assert!(length(sub(is.center, [0.5 - 2.0 * was.center[1], 2.0 * was.center[0], 2.0 * was.center[2]])) < 1e-12);
    assert!(dot(cross(is.axes[0], is.axes[1]), is.axes[2]) > 0.999_999);
    world.apply(&Command::Delete(Selection { obstacles: vec![1], ..Selection::default() })).unwrap();
    assert_eq!((world.obstacle_numbers(), world.convex().len()), ([&[0][..], &[2][..]], 1));
    let mut resumed = wobble::sim::resume(&world.save().unwrap()).unwrap();
    assert_eq!((resumed.convex(), resumed.obstacle_numbers()), (world.convex(), world.obstacle_numbers()));
    for _ in 0..30 {
        resumed.step();
    }
    assert!(resumed.is_finite());
}

#[test]
fn scenes_with_balls_and_boxes_read_the_same_again() {
    let scene = Scene::parse(&both().to_string(), "scene").unwrap();
    let again = Scene::parse(&scene.expanded().unwrap().to_json().unwrap(), "scene").unwrap();
    let [a, b] = [scene, again].map(|scene| scene.model::<3>().unwrap());
    assert_eq!((&a.convex, &a.triangles, &a.position), (&b.convex, &b.triangles, &b.position));
    assert_eq!((a.convex.len(), a.triangles.len()), (2, 32));
}

#[test]
fn what_is_no_ball_or_box_is_refused_with_its_place() {
    let refused = |dimensions: u64, obstacle: Value, more: &str| {
        let text = format!(r#"{{"wobble": 1, "dimensions": {dimensions}, "obstacles": [{obstacle}]{more}}}"#);
        let scene = Scene::parse(&text, "scene").and_then(|scene| scene.world(None).map(|_| ()));
        scene.expect_err("it is refused").to_string()
    };
    let ball = |radius: f64| json!({"circle": {"center": [0, 0, 0], "radius": radius}});
    for (obstacle, place) in [
        (ball(0.0), "obstacles[0].circle.radius"),
        (ball(-1.0), "obstacles[0].circle.radius"),
        (json!({"circle": {"center": [0, 0], "radius": 1}}), "obstacles[0].circle.center"),
        (json!({"box": {"min": [0, 0, 0], "max": [1, 0, 1]}}), "obstacles[0].box"),
        (json!({"box": {"min": [0, 0, 0], "max": [1, 1, 1], "angle": 1}}), "obstacles[0].box.angle"),
        (json!({"box": {"min": [0, 0, 0], "max": [1, 1, 1], "rotation": {"axis": [0, 0, 0], "angle": 1}}}), "axis"),
    ] {
        let message = refused(3, obstacle, "");
        assert!(message.contains(place), "{message}");
    }
    assert!(refused(3, ball(1.0), r#", "method": {"solver": "rk4"}"#).contains("does not meet balls and boxes"));
    assert!(refused(3, ball(1.0), r#", "method": {"tolerance": 1e-3}"#).contains("tolerance"));
    assert!(refused(3, json!({"polygon": [[[0, 0], [1, 0], [0, 1]]]}), "").contains("`box` or `circle`"));
}
