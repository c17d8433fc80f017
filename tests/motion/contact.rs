//! Points that rest, slide and pass from one surface to another: against closed forms, at any substep.

use super::common::physics::{run_to, spring};
use wobble::sim::{Bounds, Method, Model, Plane, PointId, Sample, Solver, build};

const G: f64 = 9.81;

fn at(model: &Model<2>, solver: Solver, h: f64, t: f64) -> Sample {
    let method = Method { solver, substep: Some(h), ..Method::default() };
    let model = Model { method, duration: Some(t), ..model.clone() };
    run_to(&mut *build(&model).unwrap(), t)
}

/// A point 1 m up a smooth slope of 30 degrees that ends on a floor.
fn slide_onto(restitution: f64) -> Model<2> {
    let (sin, cos) = (0.5, 0.75_f64.sqrt());
    Model {
        position: vec![[-cos, sin]],
        velocity: vec![[0.0; 2]],
        mass: vec![1.0],
        gravity: [0.0, -G],
        planes: vec![
            Plane { point: [0.0, 0.0], normal: [sin, cos], restitution: 0.0, friction: 0.0, penalty: None },
            Plane { point: [0.0, 0.0], normal: [0.0, 1.0], restitution, friction: 0.0, penalty: None },
        ],
        ..Model::default()
    }
}

#[test]
fn a_point_slides_from_a_slope_on_along_the_floor() {
    let speed = G.sqrt();
    let arrival = 2.0 / speed;
    for restitution in [0.0, 0.5] {
        for solver in [Solver::Rk4, Solver::VelocityVerlet] {
            let end = at(&slide_onto(restitution), solver, 0.01, arrival + 0.1);
            let (along, up) = (speed * 0.75_f64.sqrt(), 0.5 * restitution * speed);
            let truth = [0.1 * along, if up > 0.0 { 0.1 * up - 0.5 * G * 0.01 } else { 0.0 }];
            let off = (end.position[0][0] - truth[0]).hypot(end.position[0][1] - truth[1]);
            let allowed = if solver == Solver::Rk4 { 1e-12 } else { 0.05 };
            assert!(off < allowed, "{solver:?}, restitution {restitution}: off by {off:e} m");
        }
    }
}

/// A slider on a spring turns back and forth about middles that friction shifts, until it sticks.
///
/// With omega^2 = k/m every half period is a cosine about rest + shift against the motion, shift = friction m g/k.
#[test]
fn a_slider_turns_back_where_its_velocity_is_zero() {
    const STIFFNESS: f64 = 100.0;
    const FRICTION: f64 = 0.3;
    let model = Model {
        position: vec![[0.0, 0.0], [1.5, 0.0]],
        velocity: vec![[0.0; 2]; 2],
        mass: vec![1.0; 2],
        pinned: vec![PointId(0)],
        bonds: [spring(0, 1, 1.0, STIFFNESS, 0.0)].into(),
        gravity: [0.0, -G],
        bounds: Some(Bounds { min: [-9.0, 0.0], max: [9.0, 9.0], restitution: 0.0, friction: FRICTION }),
        ..Model::default()
    };
    let (omega, shift) = (STIFFNESS.sqrt(), FRICTION * G / STIFFNESS);
    let half = std::f64::consts::PI / omega;
    let truth = |t: f64| {
        let (mut off, mut begins) = (0.5_f64, 0.0);
        while off.abs() > shift && t > begins + half {
            // The next turning point lies as far on the other side of the shifted middle.
            off = -(off - 2.0 * shift * off.signum());
            begins += half;
        }
        let middle = shift * off.signum();
        let moves = off.abs() > shift;
        1.0 + if moves { middle + (off - middle) * (omega * (t - begins)).cos() } else { off }
    };
    for (h, allowed) in [(0.03, 1e-5), (0.0123, 1e-8), (0.005, 1e-11)] {
        for t in [0.4, 0.9, 1.4, 1.9, 2.9] {
            let end = at(&model, Solver::Rk8, h, t);
            let off = (end.position[1][0] - truth(t)).abs();
            assert!(off < allowed, "substep {h}, t = {t}: off by {off:e} m");
        }
    }
}

/// Two points that are mirror images of each other meet their events at the same moment, but for rounding.
#[test]
fn events_of_mirror_images_happen_together() {
    let model = Model {
        position: vec![[-1.0, 0.5], [1.0, 0.5], [0.0, 1.5]],
        velocity: vec![[0.0, -1.0]; 3],
        mass: vec![1.0; 3],
        bonds: [spring(0, 1, 1.5, 3000.0, 5.0), spring(0, 2, 1.2, 3000.0, 5.0), spring(1, 2, 1.2, 3000.0, 5.0)].into(),
        gravity: [0.0, -G],
        bounds: Some(Bounds { min: [-9.0, 0.0], max: [9.0, 9.0], restitution: 0.1, friction: 0.3 }),
        ..Model::default()
    };
    let ends = [4e-4, 2.1e-4, 1.03e-4].map(|h| at(&model, Solver::Rk8, h, 0.8));
    for end in &ends {
        let [left, right] = [end.position[0], end.position[1]];
        assert!((left[0] + right[0]).abs() < 1e-9 && (left[1] - right[1]).abs() < 1e-9, "{left:?} {right:?}");
        let off = (end.position[2][1] - ends[2].position[2][1]).abs();
        assert!(off < 1e-8, "off by {off:e} m");
    }
}

/// y = sin t against an elastic ceiling just below its top: it comes back as sin(2 arrival - t).
#[test]
fn a_touch_within_one_step_is_not_missed() {
    for depth in [1e-2, 1e-4, 1e-6] {
        let model = Model {
            position: vec![[0.0, 0.0], [0.0, 0.0]],
            velocity: vec![[0.0; 2], [0.0, 1.0]],
            mass: vec![1.0; 2],
            pinned: vec![PointId(0)],
            bonds: [spring(0, 1, 0.0, 1.0, 0.0)].into(),
            planes: vec![Plane {
                point: [0.0, 1.0 - depth],
                normal: [0.0, -1.0],
                restitution: 1.0,
                friction: 0.0,
                penalty: None,
            }],
            ..Model::default()
        };
        let arrival = f64::asin(1.0 - depth);
        let truth = (2.0 * arrival - 2.5).sin();
        for h in [0.25, 0.11] {
            let end = at(&model, Solver::Rk8, h, 2.5);
            let off = (end.position[1][1] - truth).abs();
            assert!(off < 1e-8, "depth {depth}, substep {h}: off by {off:e} m");
        }
    }
}
