//! Worlds made of models.
//!
//! The engine is compiled for its scalars and dimensions here: behind a generic function every crate that calls it would compile all of
//! it again.

use std::any::Any;

use super::dynamics::Dynamics;
use super::model::{Model, ModelError};
use super::plan;
use super::world::World;

type Made = Result<Box<dyn Dynamics>, ModelError>;

/// A world for a model of the plane or of space, its scalar as the method says.
///
/// Errors: as [`Model::check`].
pub fn build<const D: usize>(model: &Model<D>) -> Made {
    let model: &dyn Any = model;
    match (model.downcast_ref(), model.downcast_ref()) {
        (Some(plane), _) => in_the_plane(plane),
        (_, Some(space)) => in_space(space),
        _ => Err(ModelError::OutOfRange { place: "dimensions".into(), value: D.to_string(), range: "2 or 3" }),
    }
}

fn in_the_plane(model: &Model<2>) -> Made {
    made(model)
}

fn in_space(model: &Model<3>) -> Made {
    made(model)
}

fn made<const D: usize>(model: &Model<D>) -> Made {
    Ok(if plan::is_single(model) {
        Box::new(World::<f32, D>::new(model)?)
    } else {
        Box::new(World::<f64, D>::new(model)?)
    })
}
