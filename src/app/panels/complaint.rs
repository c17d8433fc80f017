//! What went wrong, or should be known: it is of something that lies over the world or of what was done there, and goes with that.

use std::time::Instant;

use super::Sheet;

/// What lies over the world.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) enum Cover {
    #[default]
    Nothing,
    Sheet(Sheet),
    /// A picture on its way into the world, or a canvas.
    Import,
}

impl Cover {
    /// A sheet lies over all else.
    pub(in crate::app) fn of(sheet: Option<Sheet>, has_import: bool) -> Self {
        match sheet {
            Some(sheet) => Cover::Sheet(sheet),
            None if has_import => Cover::Import,
            None => Cover::Nothing,
        }
    }
}

/// A line that is said until it is closed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Complaint {
    pub(super) line: String,
    /// What lay over the world when it was said; `None`: it is of the scene, which waits below whatever comes over it.
    over: Option<Cover>,
    /// When it was said, where it is of something that was refused and goes by itself.
    pub(super) refused: Option<Instant>,
}

impl Complaint {
    /// Of what was done while this lay over the world.
    pub(super) fn of_deed(line: String, over: Cover, refused: Option<Instant>) -> Self {
        Complaint { line, over: Some(over), refused }
    }

    /// Of the scene, or of all that is done in it.
    pub(super) fn of_scene(line: String) -> Self {
        Complaint { line, over: None, refused: None }
    }

    /// Whether it is done with where this lies over the world: something else does than when it was said.
    pub(super) fn is_past(&self, over: Cover) -> bool {
        self.over.is_some_and(|own| own != over)
    }

    /// Whether it is said where this lies over the world.
    pub(super) fn is_said(&self, over: Cover) -> bool {
        self.over.unwrap_or_default() == over
    }
}
