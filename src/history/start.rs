//! What a history begins with: a scene, or a recording.

use super::command::Entry;
use super::mark::Mark;
use crate::scene::Scene;

/// A start scene and the commands that were given, with their times.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// The start.
    pub scene: Scene,
    /// The commands, times ascending.
    pub commands: Vec<Entry>,
    /// How far it goes [s]: to the last command if not said.
    pub end: Option<f64>,
    /// What the motion came to, to be compared with.
    pub marks: Vec<Mark>,
}

impl Recording {
    /// How far it goes [s].
    pub fn end(&self) -> f64 {
        let last = self.commands.last().map_or(0.0, |entry| entry.at);
        self.end.unwrap_or(last)
    }
}

/// What a history begins with.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// What it is a recording of, with the commands that are followed until something new is given.
    pub(super) recording: Recording,
}

impl Start {
    /// The scene that it begins with.
    pub fn scene(&self) -> &Scene {
        &self.recording.scene
    }
}

impl From<Scene> for Start {
    fn from(scene: Scene) -> Self {
        Start { recording: Recording { scene, commands: Vec::new(), end: None, marks: Vec::new() } }
    }
}

impl From<Recording> for Start {
    fn from(recording: Recording) -> Self {
        Start { recording }
    }
}
