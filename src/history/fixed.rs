//! What is fixed when a history begins: another one begins at the present state with other numbers.

use super::effort::Effort;
use super::frame::Frame;
use super::session::History;
use super::start::Recording;
use crate::scene::{MethodKeys, PrecisionName, Scene};
use crate::sim::{SavedWorld, resume};

impl History {
    /// A recording that begins at the present state with this precision and this tolerance `[m]`, and all else of the method as it is.
    ///
    /// Errors: in words, why the scene cannot be run so.
    pub fn begun_with(&self, precision: PrecisionName, tolerance: Option<f64>) -> Result<Recording, String> {
        let precision = Some(precision).filter(|name| *name != PrecisionName::Auto);
        let scene = Scene { method: MethodKeys { precision, tolerance, ..self.method() }, ..self.scene.clone() };
        scene.check().map_err(|error| error.to_string())?;
        // The rules that choose a precision go by the scene.
        let first = scene.world(scene.duration).map_err(|error| error.to_string())?;
        let method = scene.engine_method().map_err(|error| error.to_string())?;
        let mut saved = self.frame.world.save().ok_or("a world of these dimensions cannot be kept")?;
        match &mut saved {
            SavedWorld::Plane(saved) => (saved.precision, saved.model.method) = (first.precision(), method),
            SavedWorld::Space(saved) => (saved.precision, saved.model.method) = (first.precision(), method),
        }
        let world = resume(&saved).map_err(|error| error.to_string())?;
        let (dress, eased, said) = (self.frame.dress.clone(), self.frame.eased.clone(), self.frame.said);
        Recording::snapshot(&scene, &Frame { world, dress, place: 0, effort: Effort::default(), eased, said })
    }
}
