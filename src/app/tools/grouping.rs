//! Bodies that are selected as one: a group is made of what is selected, and ends.

use super::selecting::NOTHING;
use super::{Deed, Hand, Scope};
use crate::history::{Do, Group};

/// Said where a group would have one point or none.
const FEW: &str = "a group is made of bodies: select some more with Shift, or a box around them";
/// Said where no group ends.
const NONE: &str = "what is selected is in no group";

impl Hand {
    /// What is selected is selected as one from now on, by a name that no other group has.
    pub(in crate::app) fn group(&self, scope: Scope<'_>) -> Deed {
        let Some(chosen) = self.chosen(scope) else { return Deed::words(NOTHING.to_owned()) };
        if chosen.points.len() < 2 {
            return Deed::words(FEW.to_owned());
        }
        let groups = &scope.shown.scenery.groups;
        let is_free = |name: &String| groups.iter().all(|group| group.points.is_empty() || group.name != *name);
        let Some(name) = (1..).map(|k| format!("group {k}")).find(is_free) else { return Deed::default() };
        let words = format!("{name}: a click on one of its bodies selects all of it; Ctrl+Shift+G ends that");
        Deed { words: Some(words), ..Deed::edit("group", Do::Group { points: chosen.points, name }) }
    }

    /// The groups of what is selected are none any more.
    pub(in crate::app) fn ungroup(&self, scope: Scope<'_>) -> Deed {
        let Some(chosen) = self.chosen(scope) else { return Deed::words(NOTHING.to_owned()) };
        let has = |group: &&Group| group.points.iter().any(|point| chosen.points.binary_search(point).is_ok());
        let ended = |group: &Group| Do::Group { points: Vec::new(), name: group.name.clone() };
        let commands: Vec<Do> = scope.shown.scenery.groups.iter().filter(has).map(ended).collect();
        if commands.is_empty() {
            return Deed::words(NONE.to_owned());
        }
        let words = Some("each body is selected by itself again".to_owned());
        Deed { commands, edit: Some("ungroup"), words, ..Deed::default() }
    }
}
