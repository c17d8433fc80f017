//! rapier2d: a rigid body for each body, with its outline or circle as one convex collider.

use rapier2d::prelude::*;

use super::bodies::{Body, Pose, Shape, State};
use super::run;
use super::scenes::{GRAVITY, HALF, Plane, Scene};
use super::vector;
use crate::peer::FRAME;

/// A scene in rapier2d, whose settings are its own.
pub(super) struct World {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
}

impl World {
    /// The scene at its start.
    pub(super) fn new(scene: &Scene, bodies: &[Body], shape: Shape) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, -GRAVITY as Real);
        world.integration_parameters.dt = FRAME;
        for plane in &scene.planes {
            insert_plane(&mut world, scene, plane);
        }
        let bodies = bodies.iter().map(|body| insert_body(&mut world, scene, body, shape)).collect();
        World { world, bodies }
    }
}

impl run::World for World {
    fn step(&mut self) {
        self.world.step();
    }

    fn states(&self) -> Vec<State> {
        let state = |&handle: &RigidBodyHandle| {
            let body = &self.world.bodies[handle];
            let pose = Pose { centre: array(body.translation()), angle: f64::from(body.rotation().angle()) };
            State { pose, velocity: array(body.linvel()), spin: f64::from(body.angvel()) }
        };
        self.bodies.iter().map(state).collect()
    }

    fn is_asleep(&self) -> bool {
        self.bodies.iter().all(|&handle| self.world.bodies[handle].is_sleeping())
    }
}

/// A box whose upper side is the plane's border.
fn insert_plane(world: &mut PhysicsWorld, scene: &Scene, plane: &Plane) {
    let angle = (-plane.normal[0]).atan2(plane.normal[1]);
    let middle = vector::add(plane.point, vector::times(plane.normal, -HALF[1]));
    let collider = surface(ColliderBuilder::cuboid(HALF[0] as Real, HALF[1] as Real), scene);
    world.insert(RigidBodyBuilder::fixed().translation(converted(middle)).rotation(angle as Real), collider);
}

/// A body of the mass and inertia of its points; what can't meet others meets planes alone.
fn insert_body(world: &mut PhysicsWorld, scene: &Scene, body: &Body, shape: Shape) -> RigidBodyHandle {
    let builder = RigidBodyBuilder::dynamic()
        .translation(converted(body.centre))
        .linvel(converted(body.velocity))
        .angvel(body.spin as Real)
        .additional_mass_properties(MassProperties::new(Vector::ZERO, body.mass as Real, body.inertia as Real));
    let collider = match shape {
        Shape::None => None,
        Shape::Circle => Some(ColliderBuilder::ball(body.radius() as Real)),
        Shape::Outline => {
            ColliderBuilder::convex_polyline(body.corners.iter().map(|&corner| converted(corner)).collect())
        }
    };
    let handle = world.bodies.insert(builder);
    if let Some(collider) = collider {
        let mut collider = surface(collider, scene).density(0.0);
        if !scene.has_contact {
            let groups = InteractionGroups::new(Group::GROUP_1, !Group::GROUP_1, InteractionTestMode::And);
            collider = collider.collision_groups(groups);
        }
        world.insert_collider(collider, Some(handle));
    }
    handle
}

/// With the friction and the restitution of the scene.
fn surface(collider: ColliderBuilder, scene: &Scene) -> ColliderBuilder {
    collider.friction(scene.friction as Real).restitution(scene.restitution as Real)
}

fn converted([x, y]: vector::Vector) -> Vector {
    Vector::new(x as Real, y as Real)
}

fn array(v: Vector) -> vector::Vector {
    [f64::from(v.x), f64::from(v.y)]
}
