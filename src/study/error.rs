//! What can stop a study.

use crate::output::OutputError;
use crate::scene::SceneError;

/// A study that could not be made or written.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// A problem's scene is out of order.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A problem's truth is out of order.
    #[error("truth of {problem}: {reason}")]
    Truth {
        /// The problem.
        problem: &'static str,
        /// What is wrong.
        reason: String,
    },
    /// A plot could not be drawn.
    #[error("{plot} cannot be drawn: {reason}")]
    Plot {
        /// The plot.
        plot: String,
        /// Why.
        reason: String,
    },
    /// The folder could not be made.
    #[error("{folder}: cannot be made: {reason}")]
    Folder {
        /// The folder.
        folder: String,
        /// Why.
        reason: std::io::Error,
    },
    /// A file could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}
