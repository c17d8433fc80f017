//! Where bodies truly are: closed forms, and the pivots of a polygon that rolls.

use std::f64::consts::PI;

use super::bodies::{Body, Pose, Shape};
use super::scenes::GRAVITY;
use super::vector::{add, dot, times, turned};

/// Steps in which a polygon's pivots are integrated [s]: errors are below 1e-8 m.
const STEP: f64 = 2e-5;

/// What is known of a motion.
#[derive(Clone, Copy)]
pub(super) enum Truth {
    /// A parabola, and a constant spin.
    Flight,
    /// Flat on a slope [rad] that goes down to the right: constant friction until it stops, for good if the slope bears it.
    Slide {
        /// [rad]
        slope: f64,
        /// Of the slope.
        friction: f64,
    },
    /// Rolls from rest down a slope without slipping: a circle evenly, a polygon from corner to corner.
    Roll {
        /// [rad]
        slope: f64,
    },
    /// Falls by so much, and keeps so much of its speed at each impact.
    Bounce {
        /// [m]
        drop: f64,
        /// Of each impact.
        restitution: f64,
    },
    /// Lies flat in the end, straight below where it began.
    Flat {
        /// By how much it has turned [rad].
        turn: f64,
        /// Of its centre [m].
        height: f64,
    },
    /// Nothing.
    Unknown,
}

impl Truth {
    /// Where a body of a shape is at ascending times [s], where that is known.
    pub(super) fn poses(self, body: &Body, shape: Shape, looks: &[f64]) -> Vec<Option<Pose>> {
        let moved = |by, angle| Pose { centre: add(body.centre, by), angle };
        let each = |pose: &dyn Fn(f64) -> Pose| looks.iter().map(|&time| Some(pose(time))).collect();
        match self {
            Truth::Flight => each(&|t| {
                let by = add(times(body.velocity, t), [0.0, -0.5 * GRAVITY * t * t]);
                moved(by, body.spin * t)
            }),
            Truth::Slide { slope, friction } => each(&|t| {
                let down = turned([1.0, 0.0], -slope);
                moved(times(down, slid(slope, friction, dot(body.velocity, down), t)), 0.0)
            }),
            Truth::Roll { slope } if shape == Shape::Circle => each(&|t| {
                let radius = body.radius();
                let way = 0.5 * GRAVITY * slope.sin() / (1.0 + body.inertia / (body.mass * radius * radius)) * t * t;
                moved(times(turned([1.0, 0.0], -slope), way), -way / radius)
            }),
            Truth::Roll { slope } => rolled(body, slope, looks, STEP).into_iter().map(Some).collect(),
            Truth::Bounce { drop, restitution } => each(&|t| moved([0.0, height(drop, restitution, t) - drop], 0.0)),
            Truth::Flat { turn, height } => {
                let rest = Pose { centre: [body.centre[0], height], angle: turn };
                (1..=looks.len()).map(|k| (k == looks.len()).then_some(rest)).collect()
            }
            Truth::Unknown => vec![None; looks.len()],
        }
    }
}

/// Way down a slope after a time [m], begun with a speed >= 0.
fn slid(slope: f64, friction: f64, speed: f64, time: f64) -> f64 {
    let acceleration = GRAVITY * (slope.sin() - friction * slope.cos());
    let moving = if acceleration < 0.0 { time.min(-speed / acceleration) } else { time };
    speed * moving + 0.5 * acceleration * moving * moving
}

/// Height above the floor after a time [m], of what falls by `drop`.
fn height(drop: f64, restitution: f64, time: f64) -> f64 {
    let fall = (2.0 * drop / GRAVITY).sqrt();
    if time < fall {
        return drop - 0.5 * GRAVITY * time * time;
    }
    let (mut since, mut speed) = (time - fall, restitution * GRAVITY * fall);
    while speed > 1e-9 && since > 2.0 * speed / GRAVITY {
        since -= 2.0 * speed / GRAVITY;
        speed *= restitution;
    }
    if speed > 1e-9 { since * (speed - 0.5 * GRAVITY * since) } else { 0.0 }
}

/// A regular polygon that begins at rest on a side and rolls down without slipping or leaving the slope: the rimless wheel.
///
/// Between impacts it is a pendulum about the corner on the slope: J theta'' = m g r sin(theta + slope), with theta the
/// angle from the slope's normal to the centre and J the inertia about the corner. At theta = pi/n the next corner strikes
/// without a bounce, the angular momentum about it is kept, and theta is -pi/n again (McGeer, Passive dynamic walking,
/// 1990). In steps of `step` [s] of order 4; an impact is at the step's share at which theta is reached.
fn rolled(body: &Body, slope: f64, looks: &[f64], step: f64) -> Vec<Pose> {
    let (radius, half) = (body.radius(), PI / body.corners.len() as f64);
    let squared = body.mass * radius * radius;
    let about_corner = body.inertia + squared;
    let kept = (body.inertia + squared * (2.0 * half).cos()) / about_corner;
    let pull = body.mass * GRAVITY * radius / about_corner;
    let acceleration = |theta: f64| pull * (theta + slope).sin();
    let advanced = |[theta, omega]: [f64; 2], h: f64| {
        // Runge and Kutta's steps for theta'' = a(theta).
        let k1 = acceleration(theta);
        let k2 = acceleration(theta + 0.5 * h * omega);
        let k3 = acceleration(theta + 0.5 * h * omega + 0.25 * h * h * k1);
        let k4 = acceleration(theta + h * omega + 0.5 * h * h * k2);
        [theta + h * omega + h * h * (k1 + k2 + k3) / 6.0, omega + h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0]
    };
    let (down, normal) = (turned([1.0, 0.0], -slope), turned([0.0, 1.0], -slope));
    // Where the centre is along the slope and above it, seen from the first corner.
    let seen =
        |corners: f64, theta: f64| [2.0 * radius * half.sin() * corners + radius * theta.sin(), radius * theta.cos()];
    let [start, above] = seen(0.0, -half);
    let (mut time, mut corners, mut state) = (0.0, 0.0, [-half, 0.0]);
    let mut poses = Vec::with_capacity(looks.len());
    for &look in looks {
        while time < look {
            let mut h = step.min(look - time);
            let mut next = advanced(state, h);
            if next[0] >= half {
                h *= (half - state[0]) / (next[0] - state[0]);
                next = [-half, kept * advanced(state, h)[1]];
                corners += 1.0;
            }
            time = if look - time <= h { look } else { time + h };
            state = next;
        }
        let [along, height] = seen(corners, state[0]);
        let by = add(times(down, along - start), times(normal, height - above));
        poses.push(Pose { centre: add(body.centre, by), angle: -(2.0 * half * corners + state[0] + half) });
    }
    poses
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::bodies::square;
    use crate::rigid::vector::{length, minus};

    #[test]
    fn a_box_slides_until_friction_has_stopped_it() {
        let way = |time| slid(0.0, 0.5, 9.81, time);
        assert!((way(1.0) - (9.81 - 0.25 * 9.81)).abs() < 1e-12);
        assert!((way(2.0) - 9.81).abs() < 1e-12 && way(2.0) == way(7.0));
        assert_eq!(slid(0.3, 0.6, 0.0, 1.0), 0.0);
    }

    #[test]
    fn bounces_are_as_high_as_restitution_says() {
        let fall = (2.0 / GRAVITY).sqrt();
        assert!((height(1.0, 0.5, 1.5 * fall) - 0.25).abs() < 1e-12, "the first one at its top");
        assert!((height(1.0, 0.5, 2.25 * fall) - 0.0625).abs() < 1e-12, "the second one");
        assert_eq!((height(1.0, 0.0, 2.0 * fall), height(1.0, 0.5, 10.0 * fall)), (0.0, 0.0));
    }

    #[test]
    fn a_polygon_keeps_its_energy_about_a_corner_and_loses_some_at_the_next() {
        let body = square([0.0, 1.0], [0.0; 2], 0.0);
        // Steeper than half a side's angle: it tips by itself.
        let looks: Vec<f64> = (1..=40).map(|k| 0.05 * f64::from(k)).collect();
        let poses = rolled(&body, 1.0, &looks, STEP);
        let turned_by = |k: usize| -poses[k].angle;
        let speed = |k: usize| (turned_by(k + 1) - turned_by(k - 1)) / 0.1;
        let energy = |k: usize| 0.5 * (body.inertia + 2.0 * body.mass) * speed(k).powi(2);
        let fallen = |k: usize| body.mass * GRAVITY * (1.0 - poses[k].centre[1]);
        let before = (1..39).take_while(|&k| turned_by(k + 1) < PI / 2.0).last().expect("it turns");
        assert!((energy(before) / fallen(before) - 1.0).abs() < 0.02, "{} {}", energy(before), fallen(before));
        // (I + m r^2 cos 90 degrees) / (I + m r^2) of the spin is left: 8 of 20.
        let after = (1..39).find(|&k| turned_by(k - 1) > PI / 2.0).expect("it gets to the next corner");
        let [left, had] = [speed(after), speed(before)];
        assert!((0.4..0.7).contains(&(left / had)), "{left} of {had} rad/s");
    }

    #[test]
    fn pivots_are_integrated_to_a_hundredth_of_a_micrometre() {
        let body = square([0.0, 1.0], [0.0; 2], 0.0);
        let looks: Vec<f64> = (1..=40).map(|k| 0.05 * f64::from(k)).collect();
        let [coarse, fine] = [STEP, STEP / 4.0].map(|step| rolled(&body, 1.0, &looks, step));
        let worst = coarse.iter().zip(&fine).map(|(a, b)| length(minus(a.centre, b.centre))).fold(0.0, f64::max);
        assert!(worst < 1e-8, "{worst} m");
    }

    #[test]
    fn many_corners_roll_nearly_as_a_circle_does() {
        let mut body = square([0.0, 1.0], [0.0; 2], 0.0);
        body.corners = (0..720).map(|k| turned([1.0, 0.0], PI / 360.0 * f64::from(k))).collect();
        let (slope, looks) = (0.2, [1.0]);
        let [polygon, circle] = [Shape::Outline, Shape::Circle]
            .map(|shape| Truth::Roll { slope }.poses(&body, shape, &looks)[0].map(|pose| pose.angle).unwrap_or(0.0));
        assert!(circle < -0.3 && (polygon / circle - 1.0).abs() < 0.02, "{polygon} and {circle}");
    }
}
