//! The setting that a scene's tolerance asks for.

use crate::scene::{BudgetKeys, Scene, SceneError};
use crate::search::{Found, search};
use crate::sim::Model;

/// Puts the cheapest setting that reaches the `tolerance` of the scene's method at every one of `times` `[s]` in its
/// place. A scene without a tolerance stays as it is.
///
/// Errors: those of [`Scene::model`]; relaxed bonds, which have no error, being defined by their algorithm.
pub fn tune(scene: &mut Scene, times: &[f64]) -> Result<Option<Found>, SceneError> {
    let Some(tolerance) = scene.method.tolerance else { return Ok(None) };
    let duration = times.last().copied();
    let found = match scene.dimensions() {
        2 => search(&Model { duration, ..scene.model::<2>()? }, tolerance, times),
        _ => search(&Model { duration, ..scene.model::<3>()? }, tolerance, times),
    };
    let found = found.map_err(|error| scene.refused(&error))?;
    // Closed form has no name of its own: it is what `auto` takes where nothing but gravity and drag acts.
    scene.method.solver = found.method.solver.name().parse().ok();
    scene.method.substep = found.method.substep;
    scene.method.tolerance = None;
    // What was searched for was found without.
    scene.method.sleep = scene.method.sleep.or(Some(false));
    scene.method.budget = Some(BudgetKeys::None);
    Ok(Some(found))
}
