//! The method of a running world, as the log has it.

use super::command::Do;
use super::session::History;
use crate::scene::MethodKeys;

/// A change of the method that was done.
#[derive(Clone, Copy, Debug)]
pub struct MethodChange<'a> {
    /// When `[s]`.
    pub at: f64,
    /// What its edit is called, if it is one.
    pub name: Option<&'a str>,
    /// All keys of the method from then on.
    pub keys: &'a MethodKeys,
}

impl History {
    /// The changes of the method up to now, the last first.
    pub fn method_changes(&self) -> impl Iterator<Item = MethodChange<'_>> {
        let places = (0..self.frame.place).rev();
        places.filter_map(|place| {
            let entry = self.tree.entry(self.branch, place)?;
            let Do::Set(set) = &entry.act else { return None };
            let keys = set.method.as_ref()?;
            Some(MethodChange { at: entry.at, name: entry.name.as_deref(), keys })
        })
    }

    /// The keys of the method now, as a command may set them.
    pub fn method(&self) -> MethodKeys {
        let last = self.method_changes().next().map(|change| change.keys.clone());
        last.unwrap_or_else(|| self.first_method())
    }

    /// The same at the start: but for what is fixed when a history begins.
    pub fn first_method(&self) -> MethodKeys {
        MethodKeys { precision: None, tolerance: None, ..self.scene.method.clone() }
    }

    /// Whether something was undone that can be done again.
    pub fn has_undone(&self) -> bool {
        !self.undone.is_empty()
    }
}
