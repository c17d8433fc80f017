//! What a tool asks for.

use crate::app::matter::Among;
use crate::history::Do;
use crate::sim::PointId;

/// Commands, and what they are called when they are undone.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::app) struct Deed {
    pub(in crate::app) commands: Vec<Do>,
    pub(in crate::app) edit: Option<&'static str>,
    /// Why there are none, where that is not seen; or how what they do is taken back.
    pub(in crate::app) words: Option<String>,
    /// The hub of a wheel that comes without a motor, and is offered one.
    pub(in crate::app) motor_for: Option<PointId>,
    /// What is to be of the matter that the brush paints with.
    pub(in crate::app) painted: Option<Among>,
}

impl Deed {
    pub(super) fn edit(name: &'static str, command: Do) -> Self {
        Deed { commands: vec![command], edit: Some(name), ..Deed::default() }
    }

    /// What the hand does on the way, which is no edit.
    pub(super) fn plain(commands: Vec<Do>) -> Self {
        Deed { commands, ..Deed::default() }
    }

    pub(super) fn words(words: String) -> Self {
        Deed { words: Some(words), ..Deed::default() }
    }

    /// Whether there is nothing to do.
    pub(in crate::app) fn is_empty(&self) -> bool {
        self.commands.is_empty()
    }
}
