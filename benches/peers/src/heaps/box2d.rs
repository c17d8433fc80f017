//! Box2D 3: a body for each point, circles around points; a distance joint with its spring on for each bond.
#![allow(unsafe_code, reason = "Box2D is a C library; this file and ../box2d.rs have all that is unsafe")]

use boxdd_sys::ffi;

use super::mesh::{FRICTION, Mesh, Spring};
use super::run::Heap;
use super::scenes::Scene;
use crate::box2d::create_world;
use crate::peer::FRAME;

/// Radius of the circles in mean edges of a skin: neighbours touch, so that nothing gets between them.
pub(crate) const CIRCLE: f64 = 0.5;

/// Which points have one.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Circles {
    /// Those of the skins.
    Skins,
    /// All: what gets through a skin meets more of them.
    All,
}

/// Substeps of a frame that Box2D advises.
const SUBSTEPS: i32 = 4;

/// A scene in Box2D, whose settings are its own.
pub(crate) struct World {
    world: ffi::b2WorldId,
    points: Vec<ffi::b2BodyId>,
}

impl World {
    /// The scene at its start.
    pub(crate) fn new(scene: &Scene, mesh: &Mesh, circles: Circles) -> Self {
        let world = create_world(mesh.gravity, mesh.springs.len(), |_| {});
        let radius = CIRCLE * mesh.edge;
        create_walls(world, mesh, radius);
        let positions = mesh.raised(radius, scene.gap);
        let mut radii = vec![(circles == Circles::All).then_some(radius); positions.len()];
        mesh.skins.iter().flatten().for_each(|&i| radii[i] = Some(radius));
        let points: Vec<_> =
            (0..positions.len()).map(|i| create_point(world, mesh, i, positions[i], radii[i])).collect();
        for spring in &mesh.springs {
            create_spring(world, &points, spring, spring.softness(&mesh.masses));
        }
        World { world, points }
    }
}

impl Heap for World {
    fn step(&mut self) {
        // SAFETY: the world lives until this value is dropped, and nothing else steps it meanwhile.
        unsafe { ffi::b2World_Step(self.world, FRAME, SUBSTEPS) }
    }

    fn positions(&self) -> Vec<[f64; 2]> {
        // SAFETY: the bodies live as long as their world, which lives until this value is dropped.
        let position = |&body| unsafe { ffi::b2Body_GetPosition(body) };
        self.points.iter().map(position).map(|p| [f64::from(p.x), f64::from(p.y)]).collect()
    }

    fn velocities(&self) -> Vec<[f64; 2]> {
        // SAFETY: as above.
        let velocity = |&body| unsafe { ffi::b2Body_GetLinearVelocity(body) };
        self.points.iter().map(velocity).map(|v| [f64::from(v.x), f64::from(v.y)]).collect()
    }

    fn is_asleep(&self) -> bool {
        // SAFETY: the world lives until this value is dropped.
        unsafe { ffi::b2World_GetAwakeBodyCount(self.world) == 0 }
    }
}

impl Drop for World {
    fn drop(&mut self) {
        // SAFETY: made by `create_world`, destroyed once; its bodies and joints go with it and are not used again.
        unsafe { ffi::b2DestroyWorld(self.world) }
    }
}

/// A shape of a friction, in a group: shapes of one negative group don't meet.
fn shape(friction: f64, group: i32) -> ffi::b2ShapeDef {
    // SAFETY: takes and touches nothing.
    let mut shape = unsafe { ffi::b2DefaultShapeDef() };
    shape.material.friction = friction as f32;
    shape.filter.groupIndex = group;
    shape
}

/// The floor and both walls.
fn create_walls(world: ffi::b2WorldId, mesh: &Mesh, radius: f64) {
    // Box2D takes the geometric mean of two frictions: on a wall that has to be the wall's.
    let shape = shape(mesh.walls.friction.powi(2) / FRICTION, 0);
    for ([x, y], half) in mesh.walls.slabs(radius) {
        // SAFETY: the world is alive, definitions come from Box2D itself and are only read during the calls.
        unsafe {
            let mut body = ffi::b2DefaultBodyDef();
            body.position = ffi::b2Pos { x: x as f32, y: y as f32 };
            let body = ffi::b2CreateBody(world, &body);
            ffi::b2CreatePolygonShape(body, &shape, &ffi::b2MakeBox(half[0] as f32, half[1] as f32));
        }
    }
}

/// The point `i`: mass without inertia, so it never turns; a circle of a radius meets those of other bodies.
fn create_point(world: ffi::b2WorldId, mesh: &Mesh, i: usize, [x, y]: [f64; 2], radius: Option<f64>) -> ffi::b2BodyId {
    let [vx, vy] = mesh.velocities[i].map(|v| v as f32);
    let centre = ffi::b2Vec2 { x: 0.0, y: 0.0 };
    let shape = shape(FRICTION, -1 - (i / mesh.points_a_body()) as i32);
    // SAFETY: the world is alive, definitions come from Box2D itself and are only read during the calls.
    unsafe {
        let mut body = ffi::b2DefaultBodyDef();
        body.type_ = ffi::b2BodyType_b2_dynamicBody;
        body.position = ffi::b2Pos { x: x as f32, y: y as f32 };
        body.linearVelocity = ffi::b2Vec2 { x: vx, y: vy };
        let body = ffi::b2CreateBody(world, &body);
        if let Some(radius) = radius {
            ffi::b2CreateCircleShape(body, &shape, &ffi::b2Circle { center: centre, radius: radius as f32 });
        }
        // Last: a shape brings its own mass.
        let mass = ffi::b2MassData { mass: mesh.masses[i] as f32, center: centre, rotationalInertia: 0.0 };
        ffi::b2Body_SetMassData(body, mass);
        body
    }
}

/// A spring between two points, of a frequency [Hz] and a damping ratio.
fn create_spring(world: ffi::b2WorldId, points: &[ffi::b2BodyId], spring: &Spring, softness: [f64; 2]) {
    let [a, b] = spring.ends();
    // SAFETY: world and bodies are alive, the definition comes from Box2D itself and is only read during the call.
    unsafe {
        let mut joint = ffi::b2DefaultDistanceJointDef();
        joint.base.bodyIdA = points[a];
        joint.base.bodyIdB = points[b];
        joint.length = spring.rest as f32;
        joint.enableSpring = true;
        joint.hertz = softness[0] as f32;
        joint.dampingRatio = softness[1] as f32;
        ffi::b2CreateDistanceJoint(world, &joint);
    }
}
