//! What every engine is given: mass, inertia, outline and start of the bodies that wobble makes of a scene.

use anyhow::{Result, ensure};
use serde::Deserialize;

use super::vector::{Vector, add, cross, dot, length, minus, times, turned};
use crate::heaps::mesh::{anticlockwise, skins};

/// Corners of a circle where depths are measured: 0.3 mm from a circle of 1 m.
const CIRCLE_CORNERS: usize = 128;

/// What an engine takes for the outline of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// Nothing: the scene has nothing to meet.
    None,
    /// The corners around its points.
    Outline,
    /// The circle through the corners.
    Circle,
}

impl Shape {
    /// How tables call it.
    pub(super) fn name(self) -> &'static str {
        match self {
            Shape::None => "none",
            Shape::Outline => "outline",
            Shape::Circle => "circle",
        }
    }
}

/// A rigid body at its start, when its angle is 0.
#[derive(Clone)]
pub(super) struct Body {
    /// [kg]
    pub(super) mass: f64,
    /// Moment of inertia about the centre of mass [kg m^2], that of its points.
    pub(super) inertia: f64,
    /// Centre of mass [m].
    pub(super) centre: Vector,
    /// Velocity of it [m/s].
    pub(super) velocity: Vector,
    /// Angular velocity [rad/s].
    pub(super) spin: f64,
    /// Corners anticlockwise, seen from the centre [m]; none where two sides are in line.
    pub(super) corners: Vec<Vector>,
    points: Vec<(f64, Vector)>,
}

/// Where a body is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    /// Centre of mass [m].
    pub(super) centre: Vector,
    /// By how much it has turned since the start [rad], up to whole turns.
    pub(super) angle: f64,
}

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct State {
    /// Where.
    pub(super) pose: Pose,
    /// Velocity of the centre [m/s].
    pub(super) velocity: Vector,
    /// Angular velocity [rad/s].
    pub(super) spin: f64,
}

impl Body {
    /// A body of points with their masses, places and velocities.
    fn new(points: &[(f64, Vector, Vector)], corners: &[Vector]) -> Self {
        let mass = points.iter().map(|point| point.0).sum::<f64>();
        let mean = |of: fn(&(f64, Vector, Vector)) -> Vector| {
            points.iter().fold([0.0; 2], |sum, point| add(sum, times(of(point), point.0 / mass)))
        };
        let (centre, velocity) = (mean(|point| point.1), mean(|point| point.2));
        let own: Vec<_> = points.iter().map(|&(mass, place, _)| (mass, minus(place, centre))).collect();
        let inertia = own.iter().map(|&(mass, arm)| mass * dot(arm, arm)).sum();
        let corners = corners.iter().map(|&corner| minus(corner, centre)).collect();
        let mut body = Body { mass, inertia, centre, velocity, spin: 0.0, corners, points: own };
        body.spin = body.spin_of(points.iter().map(|point| point.2));
        body
    }

    /// Angular velocity of its points where it is at the start [rad/s].
    fn spin_of(&self, velocities: impl Iterator<Item = Vector>) -> f64 {
        let momenta = self.points.iter().zip(velocities).map(|(&(mass, arm), v)| mass * cross(arm, v));
        momenta.sum::<f64>() / self.inertia
    }

    /// The state of its points.
    pub(super) fn state(&self, places: &[Vector], velocities: &[Vector]) -> State {
        let mean = |values: &[Vector]| {
            let weighted = self.points.iter().zip(values).map(|(point, &value)| times(value, point.0 / self.mass));
            weighted.fold([0.0; 2], add)
        };
        let (centre, velocity) = (mean(places), mean(velocities));
        let (mut sine, mut cosine, mut momentum) = (0.0, 0.0, 0.0);
        for ((&(mass, arm), &place), &own) in self.points.iter().zip(places).zip(velocities) {
            let now = minus(place, centre);
            sine += mass * cross(arm, now);
            cosine += mass * dot(arm, now);
            momentum += mass * cross(now, own);
        }
        State { pose: Pose { centre, angle: sine.atan2(cosine) }, velocity, spin: momentum / self.inertia }
    }

    /// The same that begins elsewhere.
    pub(super) fn shifted(&self, by: Vector) -> Self {
        Body { centre: add(self.centre, by), ..self.clone() }
    }

    /// Number of its points.
    pub(super) fn points(&self) -> usize {
        self.points.len()
    }

    /// Distance of the farthest corner from the centre [m].
    pub(super) fn radius(&self) -> f64 {
        self.corners.iter().map(|&corner| length(corner)).fold(0.0, f64::max)
    }

    /// The corners of a shape where a pose has them [m].
    pub(super) fn placed(&self, shape: Shape, pose: Pose) -> Vec<Vector> {
        let place = |corner: Vector| add(pose.centre, turned(corner, pose.angle));
        match shape {
            Shape::None => Vec::new(),
            Shape::Outline => self.corners.iter().map(|&corner| place(corner)).collect(),
            Shape::Circle => {
                let (radius, step) = (self.radius(), std::f64::consts::TAU / CIRCLE_CORNERS as f64);
                (0..CIRCLE_CORNERS).map(|k| place(turned([radius, 0.0], step * k as f64))).collect()
            }
        }
    }

    /// How it is at the start.
    pub(super) fn start(&self) -> State {
        State { pose: Pose { centre: self.centre, angle: 0.0 }, velocity: self.velocity, spin: self.spin }
    }
}

/// Reads a scene file whose bodies are points and bonds, as many points each.
///
/// Errors: what is missing, bodies that aren't equal, and an outline that isn't convex: Box2D could not have it as it is.
pub(super) fn parse(text: &[u8], bodies: usize) -> Result<Vec<Body>> {
    let File { points, triangles } = serde_json::from_slice(text)?;
    let count = points.position.len();
    ensure!(bodies > 0 && count % bodies == 0, "{count} points don't make {bodies} equal bodies");
    let each = count / bodies;
    let triangles: Vec<_> = triangles.into_iter().map(|corners| anticlockwise(corners, &points.position)).collect();
    let skins = skins(&triangles, each);
    ensure!(skins.len() == bodies, "{} skins around {bodies} bodies", skins.len());
    let velocity = |i: usize| points.velocity.as_ref().map_or([0.0; 2], |velocities| velocities[i]);
    let all = skins.iter().enumerate().map(|(k, skin)| {
        let own: Vec<_> =
            (k * each..(k + 1) * each).map(|i| (points.mass[i], points.position[i], velocity(i))).collect();
        Body::new(&own, &bare(&skin.iter().map(|&i| points.position[i]).collect::<Vec<_>>()))
    });
    let all: Vec<_> = all.collect();
    for body in &all {
        let turns = around(&body.corners).all(|[a, b, c]| cross(minus(b, a), minus(c, b)) > 0.0);
        ensure!(turns, "an outline of {} corners isn't convex", body.corners.len());
    }
    Ok(all)
}

/// Each corner with the ones before and after it.
fn around(corners: &[Vector]) -> impl Iterator<Item = [Vector; 3]> {
    let count = corners.len();
    (0..count).map(move |i| [corners[(i + count - 1) % count], corners[i], corners[(i + 1) % count]])
}

/// An outline without the corners at which it goes straight on.
fn bare(outline: &[Vector]) -> Vec<Vector> {
    let is_corner = |[a, b, c]: &[Vector; 3]| {
        let (u, v) = (minus(*b, *a), minus(*c, *b));
        cross(u, v).abs() > 1e-9 * length(u) * length(v)
    };
    around(outline).filter(is_corner).map(|[_, corner, _]| corner).collect()
}

/// What is read of a scene file.
#[derive(Deserialize)]
struct File {
    points: Points,
    triangles: Vec<[usize; 3]>,
}

#[derive(Deserialize)]
struct Points {
    position: Vec<Vector>,
    velocity: Option<Vec<Vector>>,
    mass: Vec<f64>,
}

/// A square of side 2 about a centre, of four points of 1 kg and a hub of 2 kg, for tests that have no wobble to ask.
#[cfg(test)]
pub(super) fn square(centre: Vector, velocity: Vector, spin: f64) -> Body {
    let arms = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [0.0, 0.0]];
    let moving = |arm: Vector| add(velocity, [-spin * arm[1], spin * arm[0]]);
    let points: Vec<_> =
        arms.iter().map(|&arm| (if arm == [0.0; 2] { 2.0 } else { 1.0 }, add(centre, arm), moving(arm))).collect();
    Body::new(&points, &points[..4].iter().map(|point| point.1).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_body_has_the_mass_inertia_and_spin_of_its_points() {
        let body = square([3.0, 4.0], [1.0, -2.0], 5.0);
        assert_eq!((body.mass, body.inertia, body.centre), (6.0, 8.0, [3.0, 4.0]));
        assert!(length(minus(body.velocity, [1.0, -2.0])) < 1e-12 && (body.spin - 5.0).abs() < 1e-12);
        assert!((body.radius() - 2.0_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn points_say_where_a_body_is_and_how_it_moves() {
        let body = square([3.0, 4.0], [0.0; 2], 0.0);
        let moved = |arm: Vector| (add([-1.0, 7.0], turned(arm, 2.5)), turned(arm, 2.5));
        let (places, velocities): (Vec<_>, Vec<_>) = body
            .points
            .iter()
            .map(|&(_, arm)| moved(arm))
            .map(|(place, arm)| (place, add([0.5, 0.0], [-3.0 * arm[1], 3.0 * arm[0]])))
            .unzip();
        let state = body.state(&places, &velocities);
        assert!(length(minus(state.pose.centre, [-1.0, 7.0])) < 1e-12 && (state.pose.angle - 2.5).abs() < 1e-12);
        assert!(length(minus(state.velocity, [0.5, 0.0])) < 1e-12 && (state.spin - 3.0).abs() < 1e-12);
        let corners = body.placed(Shape::Outline, state.pose);
        assert!((0..4).all(|i| length(minus(corners[i], places[i])) < 1e-12));
    }

    #[test]
    fn straight_sides_have_no_corners_and_bays_are_refused() -> Result<()> {
        let file = |middle: f64| {
            json!({"points": {"position": [[0, 0], [1, middle], [2, 0], [2, 1], [0, 1]], "mass": [1, 1, 1, 1, 1]},
                "triangles": [[0, 1, 4], [1, 3, 4], [1, 2, 3]]})
        };
        let bodies = parse(&serde_json::to_vec(&file(0.0))?, 1)?;
        assert_eq!(bodies[0].corners.len(), 4);
        assert!(parse(&serde_json::to_vec(&file(0.5))?, 1).is_err());
        Ok(())
    }
}
