//! rapier2d's rigid bodies: one without a collider for each point, a spring of unbounded stiffness for each bond.
//!
//! rapier has no rigid distance joint. Its rope joint only pulls; its spring joint holds a distance from both
//! sides and is solved implicitly, so as the stiffness grows it becomes the rigid constraint.

use std::fmt;

use rapier2d::prelude::*;

use crate::peer::{FRAME, Peer, Setting, World};
use crate::scenes::Scene;

/// Stiffness of a bond [N/m]: so large that what is left of its softness is lost in f32 at any substep used here.
const STIFFNESS: Real = 1e18;

/// rapier2d with joints between rigid bodies.
pub(crate) struct RapierJoints;

/// How a substep is solved.
#[derive(Clone, Copy)]
pub(crate) struct Passes {
    /// Sweeps over the joints before positions move.
    iterations: usize,
    /// Sweeps after positions moved.
    relaxations: usize,
}

impl fmt::Display for Passes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} + {} sweeps", self.iterations, self.relaxations)
    }
}

impl Peer for RapierJoints {
    type Way = Passes;

    const NAME: &'static str = "rapier2d joints";
    const WAYS: &'static [Passes] = &[
        Passes { iterations: 4, relaxations: 0 },
        Passes { iterations: 1, relaxations: 1 },
        Passes { iterations: 1, relaxations: 0 },
        Passes { iterations: 4, relaxations: 1 },
    ];
    const DEFAULT: Setting<Passes> = Setting { substeps: 4, way: Passes { iterations: 1, relaxations: 1 } };

    fn version() -> String {
        rapier2d::VERSION.to_owned()
    }

    fn world(scene: &Scene, setting: Setting<Passes>) -> Box<dyn World> {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, -scene.gravity as Real);
        let parameters = &mut world.integration_parameters;
        parameters.dt = FRAME;
        parameters.num_solver_iterations = setting.substeps;
        parameters.num_internal_pgs_iterations = setting.way.iterations;
        parameters.num_internal_stabilization_iterations = setting.way.relaxations;
        parameters.max_ccd_substeps = 0;
        let bodies: Vec<_> = (0..scene.positions.len()).map(|i| world.insert_body(rigid_body(scene, i))).collect();
        for bond in &scene.bonds {
            let joint = SpringJointBuilder::new(bond.rest as Real, STIFFNESS, 0.0).contacts_enabled(false);
            world.insert_impulse_joint(bodies[bond.ends[0]], bodies[bond.ends[1]], joint);
        }
        Box::new(JointWorld { world, bodies })
    }
}

struct JointWorld {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
}

impl World for JointWorld {
    fn step(&mut self) {
        self.world.step();
    }

    fn positions(&self) -> Vec<[f64; 2]> {
        let position = |&body: &RigidBodyHandle| self.world.bodies[body].translation();
        self.bodies.iter().map(position).map(|p| [f64::from(p.x), f64::from(p.y)]).collect()
    }
}

/// The point `i`: mass without a collider, not free to turn; fixed if pinned.
fn rigid_body(scene: &Scene, i: usize) -> RigidBodyBuilder {
    let [x, y] = scene.positions[i].map(|coordinate| coordinate as Real);
    let body = if scene.is_pinned(i) {
        RigidBodyBuilder::fixed()
    } else {
        RigidBodyBuilder::dynamic().additional_mass(scene.mass as Real).lock_rotations().can_sleep(false)
    };
    body.translation(Vector::new(x, y))
}
