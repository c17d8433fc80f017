//! What cannot be done: commands that are refused, histories that cannot begin.

use crate::scene::SceneError;

/// A command that cannot be done where it stands; the world before it is whole.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("commands[{number}] at t = {at:?} s: {reason}")]
pub struct Refusal {
    /// Its place in the list that it was given in, from 0.
    pub number: usize,
    /// Its time [s].
    pub at: f64,
    /// Why, and what to do.
    pub reason: String,
}

/// A history that cannot begin.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HistoryError {
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The state of a snapshot.
    #[error("{0}")]
    State(String),
}
