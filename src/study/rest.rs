//! The equilibrium of a scene.

use crate::equilibrium;
use crate::scene::{Scene, SceneError};
use crate::sim::vector::embed;
use crate::sim::{Model, ModelError, PointId, Sample};

/// An equilibrium.
#[derive(Clone, Debug)]
pub struct Settled {
    /// The shape, at rest.
    pub sample: Sample,
    /// Largest force that is left on a point, as a share of the largest single force on one `[1]`.
    pub residual: f64,
    /// Rounds of Newton's method.
    pub rounds: u32,
    /// Points that fall for ever, ascending.
    pub falling: Vec<PointId>,
    /// Whether forces balance, at a minimum of the energy, and nothing falls.
    pub is_settled: bool,
}

/// The equilibrium that the start of a scene rolls down to, as a sample at time `t` `[s]` at rest.
///
/// Errors: those of [`Scene::model`]; relaxed bonds, which have no energy; polygons.
pub fn settle(scene: &Scene, t: f64) -> Result<Settled, SceneError> {
    let found = match scene.dimensions() {
        2 => settle_model(&scene.model::<2>()?, t),
        _ => settle_model(&scene.model::<3>()?, t),
    };
    found.map_err(|error| scene.refused(&error))
}

/// What the relaxed bonds of a scene amount to at its start.
///
/// Errors: those of [`Scene::model`].
pub fn softness(scene: &Scene) -> Result<Option<equilibrium::Softness>, SceneError> {
    Ok(match scene.dimensions() {
        2 => equilibrium::softness(&scene.model::<2>()?),
        _ => equilibrium::softness(&scene.model::<3>()?),
    })
}

fn settle_model<const D: usize>(model: &Model<D>, t: f64) -> Result<Settled, ModelError> {
    let found = equilibrium::settle(model)?;
    let sample = Sample {
        time: t,
        velocity: vec![[0.0; 3]; found.position.len()],
        position: found.position.into_iter().map(embed).collect(),
        energy: found.energy,
        max_strain: found.max_strain,
        ledger: None,
    };
    Ok(Settled {
        sample,
        residual: found.residual,
        rounds: found.rounds,
        falling: found.falling,
        is_settled: found.is_settled,
    })
}
