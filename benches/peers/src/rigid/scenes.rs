//! The scenes, as scene files of wobble, with what is known of their motion.

use std::f64::consts::{FRAC_PI_2, PI};

use serde_json::{Value, json};

use super::bodies::{Body, Shape};
use super::truth::Truth;
use super::vector::{Vector, add, minus, times, turned};
use crate::peer::FRAMES_A_SECOND;

/// Downward acceleration of all scenes [m/s^2].
pub(super) const GRAVITY: f64 = 9.81;
/// Radius of the discs [m].
const RADIUS: f64 = 0.5;
/// Corners of the discs of [`RADIUS`] and [`SPACING`].
pub(super) const SIDES: usize = 36;
/// Distance of the discs' points [m].
const SPACING: f64 = 2.0 * PI * RADIUS / SIDES as f64;
/// Columns and rows of points of the boxes.
const BOX: [usize; 2] = [13, 8];
/// Distance of the boxes' points [m].
const BOX_SPACING: f64 = 0.08;
/// Bodies of each scene on a plane: alike, side by side, so that a frame takes a time that can be measured.
const COPIES: usize = 20;
/// Distance of the copies [m].
const APART: f64 = 1.5;

/// Half the length and the thickness of the box that is a plane to other engines [m].
pub(super) const HALF: [f64; 2] = [60.0, 1.0];

/// A half-space that nothing enters.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    /// A point of its border [m].
    pub(super) point: Vector,
    /// Leads out of it, of length 1.
    pub(super) normal: Vector,
}

/// Equal bodies and planes.
pub(super) struct Scene {
    /// How tables and the command line call it.
    pub(super) name: &'static str,
    /// How long it lasts [s].
    pub(super) seconds: f64,
    /// Frames between two looks.
    pub(super) frames_a_look: usize,
    /// Number of its bodies.
    pub(super) bodies: usize,
    /// What the bodies meet, each other excepted.
    pub(super) planes: Vec<Plane>,
    /// Of bodies and planes.
    pub(super) friction: f64,
    /// Of bodies and planes.
    pub(super) restitution: f64,
    /// Whether bodies meet each other.
    pub(super) has_contact: bool,
    /// By how much a circle starts higher above the first plane than the outline that it goes around [m].
    pub(super) lift: f64,
    /// What other engines take for its bodies.
    pub(super) shapes: &'static [Shape],
    /// What is known of the motion.
    pub(super) truth: Truth,
    /// Whether all are to be at rest at the end.
    pub(super) rests: bool,
    /// The scene file.
    pub(super) file: Value,
}

impl Scene {
    /// Frames of a run.
    pub(super) fn frames(&self) -> usize {
        (self.seconds * FRAMES_A_SECOND as f64).round() as usize
    }

    /// When it is looked at [s].
    pub(super) fn looks(&self) -> Vec<f64> {
        let frame = |k: usize| (k * self.frames_a_look) as f64 / FRAMES_A_SECOND as f64;
        (1..=self.frames() / self.frames_a_look).map(frame).collect()
    }

    /// The scene file with contact: wobble then says what is solid, of which outlines are made.
    pub(super) fn solid(&self) -> Value {
        let mut file = self.file.clone();
        file["contact"] = json!(true);
        file
    }

    /// The scene file in double precision, where wobble would take single precision for so many points.
    pub(super) fn in_f64(&self) -> Value {
        let mut file = self.file.clone();
        file["method"] = json!({"precision": "f64"});
        file
    }

    /// How often it is run where `runs` are asked for: with contact, where wobble takes long, just once.
    pub(super) fn runs(&self, runs: u32) -> u32 {
        if self.has_contact { 1 } else { runs }
    }

    /// The bodies where they begin with a shape.
    pub(super) fn placed(&self, bodies: &[Body], shape: Shape) -> Vec<Body> {
        let lift = match self.planes.first() {
            Some(plane) if shape == Shape::Circle => times(plane.normal, self.lift),
            _ => [0.0; 2],
        };
        bodies.iter().map(|body| body.shifted(lift)).collect()
    }

    /// A scene of bodies, to be changed.
    fn new(name: &'static str, seconds: f64, truth: Truth, bodies: &[Value]) -> Self {
        Scene {
            name,
            seconds,
            frames_a_look: 2,
            bodies: bodies.len(),
            planes: Vec::new(),
            friction: 0.0,
            restitution: 0.0,
            has_contact: false,
            lift: 0.0,
            shapes: &[Shape::Outline],
            truth,
            rests: false,
            file: json!({"wobble": 1, "gravity": [0, -GRAVITY], "bodies": bodies}),
        }
    }

    /// Bodies meet each other.
    fn meeting(mut self) -> Self {
        self.has_contact = true;
        self.file["contact"] = json!({"friction": self.friction, "restitution": self.restitution});
        self
    }

    /// With a plane through the origin that goes down to the right by an angle [rad].
    fn on_slope(mut self, slope: f64, friction: f64, restitution: f64) -> Self {
        let normal = turned([0.0, 1.0], -slope);
        (self.friction, self.restitution) = (friction, restitution);
        self.planes = vec![Plane { point: [0.0; 2], normal }];
        let plane = json!({"point": [0, 0], "normal": normal});
        self.file["obstacles"] = json!([{"plane": plane, "friction": friction, "restitution": restitution}]);
        self
    }

    /// In a box without a lid.
    fn in_box(mut self, width: f64, height: f64, friction: f64) -> Self {
        self.friction = friction;
        let plane = |point: Vector, normal: Vector| Plane { point, normal };
        self.planes = vec![plane([0.0; 2], [0.0, 1.0]), plane([0.0; 2], [1.0, 0.0]), plane([width, 0.0], [-1.0, 0.0])];
        self.file["bounds"] = json!({"min": [0, 0], "max": [width, height], "friction": friction});
        self
    }
}

/// All scenes; each takes seconds.
pub(super) fn all() -> Vec<Scene> {
    vec![
        flight("flight"),
        flight("flight, may meet").may_meet(),
        slide("slide", 2.0, 0.1, 0.0),
        slide("stop", 5.0, 0.6, 3.0),
        roll(),
        land(),
        topple(),
        bounce(),
        pile("pile of discs", disc, &[Shape::Outline, Shape::Circle]),
        pile("pile of boxes", rectangle, &[Shape::Outline]),
    ]
}

impl Scene {
    /// The bodies could meet, and don't.
    fn may_meet(self) -> Self {
        Scene { shapes: &[Shape::Outline, Shape::Circle], ..self.meeting() }
    }
}

/// 1,000 discs, thrown up and apart with spin.
fn flight(name: &'static str) -> Scene {
    let (columns, rows) = (40, 25);
    let body = |k: usize| {
        let from_middle = [(k % columns) as f64 - 19.5, (k / columns) as f64 - 12.0];
        let spin = (2.0 + (k % 9) as f64) * if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let mut body = disc(times(from_middle, APART), 0.0);
        body["velocity"] = json!(add([3.0, 8.0], times(from_middle, 0.3)));
        body["spin"] = json!(spin);
        body
    };
    let bodies: Vec<_> = (0..columns * rows).map(body).collect();
    let scene = Scene::new(name, 3.0, Truth::Flight, &bodies);
    Scene { frames_a_look: 30, shapes: &[Shape::None], ..scene }
}

/// Boxes on a slope of 0.3 rad, which begin with a speed [m/s].
fn slide(name: &'static str, seconds: f64, friction: f64, speed: f64) -> Scene {
    const SLOPE: f64 = 0.3;
    let down = turned([1.0, 0.0], -SLOPE);
    let above = times(turned([0.0, 1.0], -SLOPE), 0.5 * box_size()[1]);
    let body = |k: usize| {
        let mut body = rectangle(add(times(down, place(k)), above), -SLOPE);
        body["velocity"] = json!(times(down, speed));
        body
    };
    let bodies: Vec<_> = (0..COPIES).map(body).collect();
    let truth = Truth::Slide { slope: SLOPE, friction };
    let scene = Scene::new(name, seconds, truth, &bodies).on_slope(SLOPE, friction, 0.0);
    Scene { rests: speed > 0.0, ..scene }
}

/// Discs that begin to roll at rest on a side, on a slope of 0.15 rad: steeper than half a side's angle.
fn roll() -> Scene {
    const SLOPE: f64 = 0.15;
    let (down, normal) = (turned([1.0, 0.0], -SLOPE), turned([0.0, 1.0], -SLOPE));
    let half = PI / SIDES as f64;
    let above = times(normal, RADIUS * half.cos());
    // The middle of the first side points into the slope.
    let angle = -FRAC_PI_2 - SLOPE - half;
    let bodies: Vec<_> = (0..COPIES).map(|k| disc(add(times(down, place(k)), above), angle)).collect();
    let scene = Scene::new("roll", 1.5, Truth::Roll { slope: SLOPE }, &bodies).on_slope(SLOPE, 1.0, 0.0);
    Scene { lift: RADIUS * (1.0 - half.cos()), shapes: &[Shape::Outline, Shape::Circle], ..scene }
}

/// Boxes that fall flat by 1 m and lie.
fn land() -> Scene {
    let bodies: Vec<_> = (0..COPIES).map(|k| rectangle([place(k), 1.0 + 0.5 * box_size()[1]], 0.0)).collect();
    let truth = Truth::Bounce { drop: 1.0, restitution: 0.0 };
    Scene { rests: true, ..Scene::new("land", 4.0, truth, &bodies).on_slope(0.0, 0.5, 0.0) }
}

/// Boxes that fall onto a corner without friction and topple: their centres go straight down.
fn topple() -> Scene {
    const TILT: f64 = 0.4;
    let bodies: Vec<_> = (0..COPIES).map(|k| rectangle([place(k), 1.5], TILT)).collect();
    let truth = Truth::Flat { turn: -TILT, height: 0.5 * box_size()[1] };
    Scene { rests: true, ..Scene::new("topple", 5.0, truth, &bodies).on_slope(0.0, 0.0, 0.0) }
}

/// Discs that fall by 1 m onto a corner below their centre and bounce.
fn bounce() -> Scene {
    const RESTITUTION: f64 = 0.8;
    let bodies: Vec<_> = (0..COPIES).map(|k| disc([place(k), 1.0 + RADIUS], -FRAC_PI_2)).collect();
    let truth = Truth::Bounce { drop: 1.0, restitution: RESTITUTION };
    let scene = Scene::new("bounce", 2.8, truth, &bodies).on_slope(0.0, 0.5, RESTITUTION);
    Scene { shapes: &[Shape::Outline, Shape::Circle], ..scene }
}

/// 100 bodies, each at another angle, that fall in rows of 8 into a box 10 m wide.
fn pile(name: &'static str, body: fn(Vector, f64) -> Value, shapes: &'static [Shape]) -> Scene {
    let body = |k: usize| {
        let (row, column) = (k / 8, k % 8);
        let shift = 0.4 * (row % 2) as f64;
        let mut body = body([0.7 + 1.15 * column as f64 + shift, 0.7 + 1.2 * row as f64], 0.7 * (k % 9) as f64);
        body["velocity"] = json!([0, -2]);
        body
    };
    let bodies: Vec<_> = (0..100).map(body).collect();
    let scene = Scene::new(name, 10.0, Truth::Unknown, &bodies).in_box(10.0, 40.0, 0.5).meeting();
    Scene { frames_a_look: 6, shapes, rests: true, ..scene }
}

/// Where the copy `k` stands on its plane [m].
fn place(k: usize) -> f64 {
    APART * (k as f64 - 0.5 * (COPIES - 1) as f64)
}

/// Width and height of a box [m].
fn box_size() -> [f64; 2] {
    BOX.map(|points| (points - 1) as f64 * BOX_SPACING)
}

/// A rigid disc of 1 kg.
fn disc(centre: Vector, angle: f64) -> Value {
    json!({"make": "disc", "radius": RADIUS, "spacing": SPACING, "origin": centre, "angle": angle, "material": rigid()})
}

/// A rigid box of 1 kg.
fn rectangle(centre: Vector, angle: f64) -> Value {
    let corner = minus(centre, turned(times(box_size(), 0.5), angle));
    json!({"make": "lattice", "columns": BOX[0], "rows": BOX[1], "spacing": BOX_SPACING, "origin": corner,
        "angle": angle, "material": rigid()})
}

fn rigid() -> Value {
    json!({"kind": "rigid", "mass": 1})
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_on_planes_don_t_begin_in_them() {
        for scene in all().iter().filter(|scene| scene.file["obstacles"].is_array()) {
            let origins = scene.file["bodies"].as_array().expect("every scene has bodies");
            assert_eq!(origins.len(), scene.bodies, "{}", scene.name);
            let [plane] = scene.planes[..] else { panic!("{}: one plane", scene.name) };
            for body in origins {
                let origin = [0, 1].map(|axis| body["origin"][axis].as_f64().unwrap_or(f64::NAN));
                let above = super::super::vector::dot(minus(origin, plane.point), plane.normal);
                let least = if body["make"] == "disc" { RADIUS * (PI / SIDES as f64).cos() } else { 0.0 };
                assert!(above > least - 1e-9, "{}: {above} m", scene.name);
            }
        }
    }

    #[test]
    fn the_last_look_is_at_the_end() {
        for scene in all() {
            let last = scene.looks().last().copied().unwrap_or(0.0);
            assert!((last - scene.seconds).abs() < 1e-9, "{}: {last} s", scene.name);
        }
    }
}
