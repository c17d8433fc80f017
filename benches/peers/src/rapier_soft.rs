//! rapier2d's soft bodies: particles and structural edges of no compliance.
//!
//! Separate pieces share one soft body: with one each, 1,000 rims cost about 15 % more.

use std::fmt;

use rapier2d::prelude::*;

use crate::peer::{FRAME, Peer, Setting, World};
use crate::scenes::Scene;

/// rapier2d with its soft bodies.
pub(crate) struct RapierSoft;

/// How a substep is solved.
#[derive(Clone, Copy)]
pub(crate) struct Passes {
    /// Sweeps over the edges.
    iterations: usize,
}

impl fmt::Display for Passes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} sweeps", self.iterations)
    }
}

impl Peer for RapierSoft {
    type Way = Passes;

    const NAME: &'static str = "rapier2d soft body";
    const WAYS: &'static [Passes] =
        &[Passes { iterations: 4 }, Passes { iterations: 1 }, Passes { iterations: 2 }, Passes { iterations: 8 }];
    const DEFAULT: Setting<Passes> = Setting { substeps: 4, way: Passes { iterations: 4 } };

    fn version() -> String {
        rapier2d::VERSION.to_owned()
    }

    fn world(scene: &Scene, setting: Setting<Passes>) -> Box<dyn World> {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, -scene.gravity as Real);
        let parameters = &mut world.integration_parameters;
        parameters.dt = FRAME;
        parameters.num_solver_iterations = setting.substeps;
        parameters.max_ccd_substeps = 0;
        // One more substep because something moves fast would make the setting a lie.
        parameters.soft_bodies.max_extra_substeps = 0;
        // The second sweep after contacts over overstretched edges: there are no contacts here.
        parameters.soft_bodies.resweep_strain = Real::MAX;
        let body = world.insert_soft_body(soft_body(scene, setting.way));
        Box::new(SoftWorld { world, body })
    }
}

struct SoftWorld {
    world: PhysicsWorld,
    body: SoftBodyHandle,
}

impl World for SoftWorld {
    fn step(&mut self) {
        self.world.step();
    }

    fn positions(&self) -> Vec<[f64; 2]> {
        let positions = self.world.soft_bodies[self.body].particle_positions();
        positions.map(|p| [f64::from(p.x), f64::from(p.y)]).collect()
    }
}

/// All points and bonds, without a collider; the edges take their rest lengths from the positions.
fn soft_body(scene: &Scene, way: Passes) -> SoftBodyBuilder {
    SoftBodyBuilder::new(scene.positions.iter().map(|p| Vector::new(p[0] as Real, p[1] as Real)).collect())
        .particle_mass(scene.mass as Real)
        .pinned_particles(scene.pinned.iter().map(|&i| i as u32))
        .edges(scene.bonds.iter().map(|bond| bond.ends.map(|i| i as u32)).collect())
        .softness(SpringCoefficients::joint_defaults())
        // In addition to the one iteration that the world makes.
        .additional_pgs_iterations(way.iterations - 1)
        .no_surface_collider()
        .can_sleep(false)
}
