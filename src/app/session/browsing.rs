//! Scenes of the gallery: the one that is open, those beside it, and one by its name.

use super::Session;
use crate::scene::{EMPTY, Entry, gallery};

impl Session {
    /// What the gallery says of the scene.
    pub(super) fn entry(&self) -> Option<&'static Entry> {
        self.place.map(|place| &gallery()[place])
    }

    pub(super) fn open_beside(&mut self, by: isize) {
        // A canvas that lies over this one is put away with it.
        self.put_away();
        let count = gallery().len() as isize;
        let place = self.place.map_or(0, |place| (place as isize + by).rem_euclid(count));
        self.open_named(gallery()[place as usize].name);
    }

    pub(super) fn open_named(&mut self, name: &str) {
        if name == EMPTY.name {
            return self.open_empty();
        }
        let Some(entry) = gallery().iter().find(|entry| entry.name == name) else { return };
        match entry.scene() {
            Ok(scene) => self.open(scene.into()),
            Err(error) => self.complain(&error.to_string()),
        }
    }
}
