//! What can be set of the scene, as it stands.

use crate::sim::command::{BoundsChange, SceneChange};
use crate::sim::force::wind::Wind;
use crate::sim::real::Real;
use crate::sim::vector::embed;
use crate::sim::world::World;

impl<S: Real, const D: usize> World<S, D> {
    /// The change that would leave everything as it is: all its keys are said.
    pub(in crate::sim) fn scene_now(&self) -> SceneChange {
        let model = &*self.model;
        let wind = model.wind.map(|wind| Wind {
            velocity: embed(wind.velocity),
            turbulence: wind.turbulence,
            seed: wind.seed,
        });
        let bounds = model.bounds.map(|bounds| BoundsChange {
            min: embed(bounds.min),
            max: embed(bounds.max),
            restitution: bounds.restitution,
            friction: bounds.friction,
        });
        SceneChange {
            gravity: Some(embed(model.gravity)),
            drag_rate: Some(model.drag_rate),
            wind: Some(wind),
            bounds: Some(bounds),
            contact: Some(model.contact),
            areas: Some(model.areas),
            method: Some(model.method),
        }
    }
}
