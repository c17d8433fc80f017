//! Box2D 3: a body for each body, with its outline cut into polygons of eight corners, or its circle.
#![allow(
    unsafe_code,
    reason = "Box2D is a C library; this file, ../box2d.rs and ../heaps/box2d.rs have all that is unsafe"
)]

use boxdd_sys::ffi;

use super::bodies::{Body, Pose, Shape, State};
use super::run;
use super::scenes::{GRAVITY, HALF, Plane, Scene};
use super::vector::{Vector, add, times};
use crate::box2d::create_world;
use crate::peer::FRAME;

/// Substeps of a frame that Box2D advises.
const SUBSTEPS: i32 = 4;
/// Corners that a polygon can have.
const MOST_CORNERS: usize = 8;

/// A scene in Box2D, whose settings are its own.
pub(super) struct World {
    world: ffi::b2WorldId,
    bodies: Vec<ffi::b2BodyId>,
}

impl World {
    /// The scene at its start.
    pub(super) fn new(scene: &Scene, bodies: &[Body], shape: Shape) -> Self {
        let world = create_world(GRAVITY, 0, |_| {});
        for plane in &scene.planes {
            create_plane(world, scene, plane);
        }
        let bodies = bodies.iter().map(|body| create_body(world, scene, body, shape)).collect();
        World { world, bodies }
    }
}

impl run::World for World {
    fn step(&mut self) {
        // SAFETY: the world lives until this value is dropped, and nothing else steps it meanwhile.
        unsafe { ffi::b2World_Step(self.world, FRAME, SUBSTEPS) }
    }

    fn states(&self) -> Vec<State> {
        let state = |&body| {
            // SAFETY: the bodies live as long as their world, which lives until this value is dropped.
            let (place, rotation, velocity, spin) = unsafe {
                let (place, rotation) = (ffi::b2Body_GetPosition(body), ffi::b2Body_GetRotation(body));
                (place, rotation, ffi::b2Body_GetLinearVelocity(body), ffi::b2Body_GetAngularVelocity(body))
            };
            let angle = f64::from(rotation.s).atan2(f64::from(rotation.c));
            let pose = Pose { centre: [f64::from(place.x), f64::from(place.y)], angle };
            State { pose, velocity: [f64::from(velocity.x), f64::from(velocity.y)], spin: f64::from(spin) }
        };
        self.bodies.iter().map(state).collect()
    }

    fn is_asleep(&self) -> bool {
        // SAFETY: the world lives until this value is dropped.
        unsafe { ffi::b2World_GetAwakeBodyCount(self.world) == 0 }
    }
}

impl Drop for World {
    fn drop(&mut self) {
        // SAFETY: made by `create_world`, destroyed once; its bodies go with it and are not used again.
        unsafe { ffi::b2DestroyWorld(self.world) }
    }
}

/// A shape with the friction and restitution of the scene, in a group: shapes of one negative group don't meet.
fn surface(scene: &Scene, group: i32) -> ffi::b2ShapeDef {
    // SAFETY: takes and touches nothing.
    let mut shape = unsafe { ffi::b2DefaultShapeDef() };
    shape.material.friction = scene.friction as f32;
    shape.material.restitution = scene.restitution as f32;
    shape.filter.groupIndex = group;
    shape
}

/// A box whose upper side is the plane's border.
fn create_plane(world: ffi::b2WorldId, scene: &Scene, plane: &Plane) {
    let shape = surface(scene, 0);
    let middle = add(plane.point, times(plane.normal, -HALF[1]));
    // SAFETY: the world is alive, definitions come from Box2D itself and are only read during the calls.
    unsafe {
        let mut body = ffi::b2DefaultBodyDef();
        body.position = ffi::b2Pos { x: middle[0] as f32, y: middle[1] as f32 };
        body.rotation = ffi::b2Rot { c: plane.normal[1] as f32, s: -plane.normal[0] as f32 };
        let body = ffi::b2CreateBody(world, &body);
        ffi::b2CreatePolygonShape(body, &shape, &ffi::b2MakeBox(HALF[0] as f32, HALF[1] as f32));
    }
}

/// A body of the mass and inertia of its points; what can't meet others is in one group with them.
fn create_body(world: ffi::b2WorldId, scene: &Scene, body: &Body, shape: Shape) -> ffi::b2BodyId {
    let centre = vector([0.0; 2]);
    let place = vector(body.centre);
    let surface = surface(scene, if scene.has_contact { 0 } else { -1 });
    let mass = ffi::b2MassData { mass: body.mass as f32, center: centre, rotationalInertia: body.inertia as f32 };
    // SAFETY: the world is alive, definitions come from Box2D itself and are only read during the calls; the corners
    // of a hull are as many as are said, and at most eight.
    unsafe {
        let mut definition = ffi::b2DefaultBodyDef();
        definition.type_ = ffi::b2BodyType_b2_dynamicBody;
        definition.position = ffi::b2Pos { x: place.x, y: place.y };
        definition.linearVelocity = vector(body.velocity);
        definition.angularVelocity = body.spin as f32;
        let id = ffi::b2CreateBody(world, &definition);
        match shape {
            Shape::None => {}
            Shape::Circle => {
                let circle = ffi::b2Circle { center: centre, radius: body.radius() as f32 };
                ffi::b2CreateCircleShape(id, &surface, &circle);
            }
            Shape::Outline => {
                for piece in pieces(&body.corners) {
                    let corners: Vec<_> = piece.into_iter().map(vector).collect();
                    let hull = ffi::b2ComputeHull(corners.as_ptr(), corners.len() as i32);
                    ffi::b2CreatePolygonShape(id, &surface, &ffi::b2MakePolygon(&hull, 0.0));
                }
            }
        }
        // Last: a shape brings its own mass.
        ffi::b2Body_SetMassData(id, mass);
        id
    }
}

/// A convex outline cut into a fan of polygons of at most [`MOST_CORNERS`] about its first corner.
fn pieces(corners: &[Vector]) -> Vec<Vec<Vector>> {
    let rest = &corners[1..];
    let step = MOST_CORNERS - 2;
    let starts = (0..rest.len() - 1).step_by(step);
    let piece = |start: usize| {
        let end = (start + step + 1).min(rest.len());
        std::iter::once(corners[0]).chain(rest[start..end].iter().copied()).collect()
    };
    starts.map(piece).collect()
}

fn vector([x, y]: Vector) -> ffi::b2Vec2 {
    ffi::b2Vec2 { x: x as f32, y: y as f32 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::vector::{cross, turned};

    #[test]
    fn the_pieces_of_an_outline_cover_it_once() {
        let area = |corners: &[Vector]| -> f64 {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(&a, &b)| 0.5 * cross(a, b)).sum()
        };
        for count in [3, 4, 8, 9, 14, 15, 36] {
            let step = std::f64::consts::TAU / f64::from(count);
            let corners: Vec<_> = (0..count).map(|k| turned([1.0, 0.0], step * f64::from(k))).collect();
            let pieces = pieces(&corners);
            assert!(pieces.iter().all(|piece| (3..=MOST_CORNERS).contains(&piece.len())), "{count} corners");
            let sum: f64 = pieces.iter().map(|piece| area(piece)).sum();
            assert!((sum - area(&corners)).abs() < 1e-12, "{count} corners: {sum}");
        }
    }
}
