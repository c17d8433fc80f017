//! What can stop a study.

use crate::body::BodyError;
use crate::output::OutputError;
use crate::scene::SceneError;
use crate::sim::{CommandError, ModelError};

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
    /// A scene of the study of speed cannot be made.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// No world can be made of it.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A world did not take a command.
    #[error(transparent)]
    Command(CommandError),
    /// A table could not be read.
    #[error("{file}: cannot be read: {reason}")]
    Table {
        /// The file.
        file: String,
        /// Why.
        reason: String,
    },
    /// This program, started again with more threads, failed.
    #[error("{program} on more threads: {reason}")]
    Program {
        /// The program.
        program: String,
        /// Why.
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
