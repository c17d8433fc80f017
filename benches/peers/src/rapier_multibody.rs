//! rapier2d's multibodies: a rope in the angles of its links, which cannot stretch.
//!
//! A link stands at its outer point with all of that point's mass and none of its own inertia, and turns about the
//! point before it. Only chains: a closed loop has no such coordinates. Only short ones: the solve is dense, so that a
//! rope of 1,000 would take seconds a frame.

use std::fmt;

use rapier2d::prelude::*;

use crate::peer::{FRAME, Peer, Setting, World};
use crate::scenes::Scene;

/// Most points of a chain that is tried.
const LONGEST: usize = 100;

/// rapier2d with joints in reduced coordinates.
pub(crate) struct RapierMultibody;

/// There is nothing to choose but the number of substeps.
#[derive(Clone, Copy)]
pub(crate) struct Direct;

impl fmt::Display for Direct {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("direct solve")
    }
}

impl Peer for RapierMultibody {
    type Way = Direct;

    const NAME: &'static str = "rapier2d multibody";
    const WAYS: &'static [Direct] = &[Direct];
    const DEFAULT: Setting<Direct> = Setting { substeps: 4, way: Direct };

    fn version() -> String {
        rapier2d::VERSION.to_owned()
    }

    fn suits(scene: &Scene) -> bool {
        scene.is_chain && scene.positions.len() <= LONGEST
    }

    fn world(scene: &Scene, setting: Setting<Direct>) -> Box<dyn World> {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, -scene.gravity as Real);
        let parameters = &mut world.integration_parameters;
        parameters.dt = FRAME;
        parameters.num_solver_iterations = setting.substeps;
        parameters.max_ccd_substeps = 0;
        let bodies: Vec<_> = (0..scene.positions.len()).map(|i| world.insert_body(link(scene, i))).collect();
        for bond in &scene.bonds {
            let [inner, outer] = bond.ends;
            let [p, q] = [scene.positions[inner], scene.positions[outer]];
            let back = Vector::new((p[0] - q[0]) as Real, (p[1] - q[1]) as Real);
            let joint = RevoluteJointBuilder::new().local_anchor2(back).contacts_enabled(false);
            let handle = world.insert_multibody_joint(bodies[inner], bodies[outer], joint);
            // A link's angle is damped unless one says otherwise.
            if let Some((multibody, _)) = handle.and_then(|handle| world.multibody_joints.get_mut(handle)) {
                multibody.damping_mut().fill(0.0);
            }
        }
        Box::new(MultibodyWorld { world, bodies })
    }
}

struct MultibodyWorld {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
}

impl World for MultibodyWorld {
    fn step(&mut self) {
        self.world.step();
    }

    fn positions(&self) -> Vec<[f64; 2]> {
        let position = |&body: &RigidBodyHandle| self.world.bodies[body].translation();
        self.bodies.iter().map(position).map(|p| [f64::from(p.x), f64::from(p.y)]).collect()
    }
}

/// The link that ends at point `i`; the pinned point carries the chain.
fn link(scene: &Scene, i: usize) -> RigidBodyBuilder {
    let [x, y] = scene.positions[i].map(|coordinate| coordinate as Real);
    let body = if scene.is_pinned(i) {
        RigidBodyBuilder::fixed()
    } else {
        let mass = MassProperties::new(Vector::ZERO, scene.mass as Real, 0.0);
        RigidBodyBuilder::dynamic().additional_mass_properties(mass).can_sleep(false)
    };
    body.translation(Vector::new(x, y))
}
