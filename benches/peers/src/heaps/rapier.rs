//! rapier2d: a soft body for each body, its springs as edges, its skin as a collider.

use rapier2d::prelude::*;

use super::mesh::{FRICTION, Mesh};
use super::run::Heap;
use super::scenes::Scene;
use crate::peer::FRAME;

/// Radius of the skin that rapier2d's own makers of soft bodies give, in mean edges.
pub(crate) const OWN_SKIN: f64 = 0.5;

/// A scene in rapier2d, whose settings are its own.
pub(crate) struct World {
    world: PhysicsWorld,
    bodies: Vec<SoftBodyHandle>,
}

impl World {
    /// The scene at its start; `skin` is in mean edges.
    pub(crate) fn new(scene: &Scene, mesh: &Mesh, skin: f64) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, -mesh.gravity as Real);
        world.integration_parameters.dt = FRAME;
        let radius = skin * mesh.edge;
        for ([x, y], half) in mesh.walls.slabs(radius) {
            // The smaller of two frictions: on a wall points have the wall's.
            let collider = ColliderBuilder::cuboid(half[0] as Real, half[1] as Real)
                .friction(mesh.walls.friction as Real)
                .friction_combine_rule(CoefficientCombineRule::Min);
            world.insert(RigidBodyBuilder::fixed().translation(vector([x, y])), collider);
        }
        let positions = mesh.raised(radius, scene.gap);
        let each = mesh.points_a_body();
        let bodies: Vec<_> = (0..mesh.skins.len())
            .map(|body| {
                let handle = world.insert_soft_body(soft_body(mesh, &positions, body, radius));
                for i in 0..each {
                    let velocity = vector(mesh.velocities[body * each + i]);
                    world.soft_bodies[handle].set_particle_velocity(i, velocity);
                }
                handle
            })
            .collect();
        World { world, bodies }
    }

    fn of_all<T>(&self, values: impl Fn(&SoftBody) -> Vec<T>) -> Vec<T> {
        self.bodies.iter().flat_map(|&body| values(&self.world.soft_bodies[body])).collect()
    }
}

impl Heap for World {
    fn step(&mut self) {
        self.world.step();
    }

    fn positions(&self) -> Vec<[f64; 2]> {
        self.of_all(|body| body.particle_positions().map(array).collect())
    }

    fn velocities(&self) -> Vec<[f64; 2]> {
        self.of_all(|body| body.particle_velocities().map(array).collect())
    }

    fn is_asleep(&self) -> bool {
        self.bodies.iter().all(|&body| self.world.soft_bodies[body].is_sleeping())
    }
}

/// One body: without cells, so that its springs alone hold its shape, as in the other engines.
fn soft_body(mesh: &Mesh, positions: &[[f64; 2]], body: usize, radius: f64) -> SoftBodyBuilder {
    let each = mesh.points_a_body();
    let range = body * each..(body + 1) * each;
    let own = |i: usize| (i - range.start) as u32;
    let springs: Vec<_> = mesh.springs.iter().filter(|spring| range.contains(&spring.ends()[0])).collect();
    let skin = &mesh.skins[body];
    let mut builder = SoftBodyBuilder::new(positions[range.clone()].iter().map(|&p| vector(p)).collect())
        .masses(mesh.masses[range.clone()].iter().map(|&mass| mass as Real).collect())
        .edges(springs.iter().map(|spring| spring.ends().map(own)).collect())
        .surface(skin.iter().zip(skin.iter().cycle().skip(1)).map(|(&i, &j)| [own(i), own(j)]).collect())
        .particle_radius(radius as Real)
        // Its shape is replaced by the skin's.
        .surface_collider(ColliderBuilder::ball(1.0).friction(FRICTION as Real));
    builder.edge_softness = (0..)
        .zip(springs)
        .map(|(edge, spring)| {
            let [frequency, ratio] = spring.softness(&mesh.masses);
            (edge, SpringCoefficients::new(frequency as Real, ratio as Real))
        })
        .collect();
    builder
}

fn vector([x, y]: [f64; 2]) -> Vector {
    Vector::new(x as Real, y as Real)
}

fn array(v: Vector) -> [f64; 2] {
    [f64::from(v.x), f64::from(v.y)]
}
