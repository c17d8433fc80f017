//! What cannot be done: commands that are refused, files that cannot be read, histories that cannot begin.

use crate::scene::SceneError;
use crate::scene::record::RecordError;
use crate::sim::CommandError;

/// A command that cannot be done where it stands; the world before it is whole.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("commands[{number}] at t = {at:?} s: {reason}")]
pub struct Refusal {
    /// Its place in the list that it was given in, from 0.
    pub number: usize,
    /// Its time `[s]`.
    pub at: f64,
    /// Why, and what to do.
    pub reason: Why,
}

/// Why a command cannot be done.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Why {
    /// The world refuses it.
    #[error(transparent)]
    World(#[from] CommandError),
    /// What it says cannot be, in words: as of a file.
    #[error("{0}")]
    Words(String),
}

impl From<String> for Why {
    fn from(words: String) -> Self {
        Why::Words(words)
    }
}

/// A history that cannot begin or go on as its file says.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HistoryError {
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The motion.
    #[error(transparent)]
    Motion(#[from] RecordError),
    /// The file, or what it says.
    #[error("{label}: {message}")]
    File {
        /// The file, or what stands for it.
        label: String,
        /// What is wrong and what to do.
        message: String,
    },
    /// A file that ends in the middle of something, after something that can be replayed.
    #[error("{label}: {how}: {whole} commands are whole; `wobble replay --partial` replays those")]
    Cut {
        /// The file.
        label: String,
        /// How it ends.
        how: String,
        /// How many commands are whole.
        whole: usize,
    },
    /// The same before there is a scene.
    #[error("{label}: {how}, before its scene is whole: there is nothing to replay")]
    CutAtOnce {
        /// The file.
        label: String,
        /// How it ends.
        how: String,
    },
    /// A command that cannot be done.
    #[error("{label}: {refusal}")]
    Refused {
        /// The file.
        label: String,
        /// Which, and why.
        refusal: Refusal,
    },
}

impl HistoryError {
    /// Something about a file.
    pub(super) fn file(label: &str, message: impl Into<String>) -> Self {
        HistoryError::File { label: label.to_owned(), message: message.into() }
    }
}
