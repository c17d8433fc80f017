//! Keys by what people do with them, and which of them a search finds.

use super::table::{TABLE, by_mouse};
use crate::app::action::Action;

/// What people do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Opens, saves and begins scenes.
    Files,
    /// Lets time run, stand still and go back.
    Time,
    /// Takes a tool, or changes what it does.
    Tools,
    /// Takes back, copies, takes away.
    Edit,
    /// What is done to what is selected.
    Selection,
    /// How the world is looked at.
    View,
    /// What is shown beside the world, and the window.
    Panels,
    /// What the mouse does.
    Mouse,
}

impl Group {
    /// All of them, in the order in which they are listed.
    pub const ALL: [Group; 8] = [
        Group::Mouse,
        Group::Time,
        Group::Tools,
        Group::Edit,
        Group::Selection,
        Group::View,
        Group::Panels,
        Group::Files,
    ];

    /// What it is called above its keys.
    pub fn heading(self) -> &'static str {
        match self {
            Group::Files => "Scenes and files",
            Group::Time => "Time",
            Group::Tools => "Tools",
            Group::Edit => "Edit",
            Group::Selection => "Selection",
            Group::View => "View",
            Group::Panels => "Panels and window",
            Group::Mouse => "Mouse",
        }
    }

    /// That of an action.
    fn of(action: Action) -> Self {
        use Action::{
            Cancel, Clear, Clip, Copy, Delete, Dice, Duplicate, Faster, FindSetting, Finish, Fit, FlipAcross, FlipOver,
            FullScreen, Gallery, Help, Hide, Home, Import, LargerRegion, Lessons, New, NextScene, NextShowing, Open,
            Paint, Palette, Paste, PinWhileHeld, Plots, PreviousScene, Quit, Redo, Reset, Rewind, Save, Screenshot,
            SelectAll, Settings, Show, ShowHidden, Slower, SmallerRegion, Step, StepBack, Stronger, Take, ToggleGrid,
            ToggleHud, ToggleMesh, TogglePanels, TogglePlay, ToggleTrails, Undo, Ungroup, Weaker, Wind,
        };
        match action {
            PreviousScene | NextScene | Gallery | New | Dice | Open | Save | Screenshot | Clip | Import | Paint
            | Quit => Group::Files,
            TogglePlay | Step | Rewind | Reset | Slower | Faster => Group::Time,
            Take(_) | Wind | PinWhileHeld | Finish | StepBack | SmallerRegion | LargerRegion | Weaker | Stronger => {
                Group::Tools
            }
            Undo | Redo | Delete | Duplicate | Copy | FlipAcross | FlipOver | Paste | Clear | Cancel => Group::Edit,
            SelectAll | Action::Group | Ungroup | Hide | ShowHidden => Group::Selection,
            Fit | Home | NextShowing | Show(_) | ToggleMesh | ToggleGrid | ToggleTrails | Palette => Group::View,
            Settings | FindSetting | Plots | Lessons | TogglePanels | ToggleHud | Help | FullScreen => Group::Panels,
        }
    }
}

/// Keys and what they do, as they are printed.
pub type Row = [&'static str; 2];

/// The groups with those of their rows in which all words of a search are, or above which; none that is left empty.
pub fn found(search: &str) -> Vec<(Group, Vec<Row>)> {
    let words: Vec<String> = search.split_whitespace().map(str::to_lowercase).collect();
    let rows = |group: Group| -> Vec<Row> {
        let is_its = |action: Option<&Action>| action.is_some_and(|action| Group::of(*action) == group);
        let keys = TABLE.iter().filter(|binding| is_its(binding.strokes.first().map(|(_, action)| action)));
        match group {
            Group::Mouse => by_mouse().to_vec(),
            _ => keys.map(|binding| [binding.keys, binding.words]).collect(),
        }
    };
    let has_all = |group: Group, row: &Row| {
        let text = [group.heading(), row[0], row[1]].join(" ").to_lowercase();
        words.iter().all(|word| text.contains(word))
    };
    let of = |group: Group| (group, rows(group).into_iter().filter(|row| has_all(group, row)).collect::<Vec<Row>>());
    Group::ALL.into_iter().map(of).filter(|(_, rows)| !rows.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_is_in_one_group_and_no_group_is_empty() {
        let all = found("");
        assert_eq!(all.len(), Group::ALL.len());
        let listed: Vec<Row> = all.iter().flat_map(|(_, rows)| rows.clone()).collect();
        assert_eq!(listed.len(), TABLE.len() + by_mouse().len());
        for binding in TABLE {
            assert_eq!(listed.iter().filter(|row| row[1] == binding.words).count(), 1, "{}", binding.words);
        }
        assert!(all.iter().all(|(_, rows)| rows.len() > 1), "{all:?}");
    }

    #[test]
    fn a_search_finds_keys_by_what_they_do_by_their_names_and_by_their_heading() {
        let only = |search: &str| {
            let found = found(search);
            found.into_iter().flat_map(|(group, rows)| rows.into_iter().map(move |row| (group, row[0]))).collect()
        };
        let screenshot: Vec<(Group, &str)> = only("screen shot");
        assert_eq!(screenshot, [(Group::Files, "F2")]);
        let gallery: Vec<(Group, &str)> = only("Ctrl+K");
        assert_eq!(gallery, [(Group::Files, "Ctrl+K")]);
        let time: Vec<(Group, &str)> = only("time frame");
        assert_eq!(time, [(Group::Time, ".")]);
        assert!(found("no such key").is_empty());
    }
}
