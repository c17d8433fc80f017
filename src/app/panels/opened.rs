//! Panels that stay open beside the world, in the order in which they were opened: which of them are seen where there is no room for all, and
//! which one Esc closes.

use egui::Rect;

use super::{GAP, PanelState, lessons, palette, settings};
use crate::app::action::Tool;
use crate::app::plots::Plots;

/// A panel that stays open until it is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app) enum Opened {
    Settings,
    Plots,
    Lessons,
    /// What belongs to the tool that is taken: it closes with that.
    Tool,
    /// What is selected has one, in place of that of its tool: it closes with the selection.
    Selection,
}

/// Narrower windows, and lower ones, have room for one panel beside the world `[points]`.
const ROOMY: [f32; 2] = [860.0, 480.0];
/// Narrower ones have no room for settings beside what is selected: both would take more than a third of the world `[points]`.
const WIDE: f32 = 1560.0;
/// Those that are higher than wide have room for several below the world from this height on `[points]`.
const HIGH: f32 = 960.0;

/// For which panels a window has room at once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) enum Room {
    /// All of them.
    #[default]
    All,
    /// All, but not settings beside what is selected.
    Most,
    /// Nor settings beside lessons.
    NotBoth,
    /// One.
    One,
}

impl Room {
    /// In a room, which may be one that is higher than wide.
    pub(super) fn of(room: Rect, is_upright: bool) -> Self {
        let is_roomy = match is_upright {
            true => room.height() >= HIGH,
            false => room.width() >= ROOMY[0] && room.height() >= ROOMY[1],
        };
        match is_roomy {
            false => Room::One,
            true if !lessons::has_room(room, settings::WIDTH + GAP) => Room::NotBoth,
            // Where it is higher than wide settings lie below.
            true if is_upright || room.width() >= WIDE => Room::All,
            true => Room::Most,
        }
    }

    /// Whether a panel has room beside one that was opened later.
    fn fits(self, [panel, later]: [Opened; 2]) -> bool {
        use Opened::{Lessons, Selection, Settings, Tool};
        match self {
            Room::All => true,
            Room::Most => !matches!([panel, later], [Settings, Selection] | [Selection, Settings]),
            Room::NotBoth => {
                !matches!([panel, later], [Settings, Lessons | Selection] | [Lessons, Settings] | [Selection, Settings])
            }
            // They are one panel.
            Room::One => matches!([panel, later], [Tool, Selection] | [Selection, Tool]),
        }
    }
}

/// Which panels are seen.
pub(super) struct Seen {
    pub(super) has_settings: bool,
    pub(super) has_lessons: bool,
    pub(super) has_plots: bool,
    /// What belongs to the tool that is taken, or is selected by it, if anything is.
    pub(super) has_tool: bool,
}

impl PanelState {
    fn is_open(&self, panel: Opened) -> bool {
        match panel {
            Opened::Settings => self.has_settings,
            Opened::Plots => self.plots.is_some(),
            Opened::Lessons => self.lessons.is_open,
            Opened::Tool => palette::has_panel(self.tool),
            Opened::Selection => self.has_selection,
        }
    }

    /// Those that were closed since go out of the list, those that were opened come to its end.
    pub(super) fn keep_order(&mut self) {
        let mut list = std::mem::take(&mut self.opened);
        list.retain(|panel| self.is_open(*panel));
        for panel in [Opened::Lessons, Opened::Plots, Opened::Settings, Opened::Tool, Opened::Selection] {
            if self.is_open(panel) && !list.contains(&panel) {
                list.push(panel);
            }
        }
        self.opened = list;
    }

    /// A panel that is open is the one that was opened last.
    pub(in crate::app) fn bring(&mut self, panel: Opened) {
        self.opened.retain(|other| *other != panel);
        self.keep_order();
        self.opened.retain(|other| *other != panel);
        if self.is_open(panel) {
            self.opened.push(panel);
        }
    }

    /// Something else is selected: its panel is the one that was opened last.
    pub(in crate::app) fn select(&mut self) {
        self.has_selection = true;
        self.bring(Opened::Selection);
    }

    /// This tool is taken: its panel, if it has one, is the one that was opened last.
    pub(in crate::app) fn take(&mut self, tool: Tool) {
        self.tool = tool;
        self.bring(Opened::Tool);
    }

    /// Whether a panel is open and has room beside those that were opened later.
    pub(in crate::app) fn is_seen(&self, panel: Opened) -> bool {
        let mut later = self.opened.iter().rev().take_while(|other| **other != panel);
        self.is_open(panel) && later.all(|later| self.room.fits([panel, *later]))
    }

    /// Which panels are seen, where any of them is.
    pub(super) fn seen(&self, has_panels: bool) -> Seen {
        let is_seen = |panel| has_panels && self.is_seen(panel);
        let waits = self.has_selection && !self.is_seen(Opened::Selection);
        let has_tool = match self.room {
            Room::One => is_seen(Opened::Tool) || is_seen(Opened::Selection),
            _ => has_panels && !waits,
        };
        Seen {
            has_settings: is_seen(Opened::Settings),
            has_lessons: is_seen(Opened::Lessons),
            has_plots: is_seen(Opened::Plots),
            has_tool,
        }
    }

    /// Opens the settings, or closes them; where something else was opened in their place, they come back.
    pub(in crate::app) fn toggle_settings(&mut self) {
        self.has_settings = !self.is_seen(Opened::Settings);
        self.bring(Opened::Settings);
    }

    /// The same of the lessons.
    pub(in crate::app) fn toggle_lessons(&mut self) {
        self.lessons.is_open = !self.is_seen(Opened::Lessons);
        self.lessons.left = None;
        self.bring(Opened::Lessons);
    }

    /// Opens the plots, or closes them: opened again, they are of what they were of. The scene plays so many of its seconds a second of wall
    /// time. Where something else was opened in their place, they come back.
    pub(in crate::app) fn toggle_plots(&mut self, rate: f64) {
        if self.plots.is_some() && !self.is_seen(Opened::Plots) {
            return self.bring(Opened::Plots);
        }
        match self.plots.take() {
            Some(plots) => self.plots_left = Some(plots.emptied(rate)),
            None => {
                self.plots = Some(self.plots_left.take().unwrap_or_else(|| Plots::new(rate)));
                self.bring(Opened::Plots);
            }
        }
    }

    /// The one that was opened last, of those that are seen and can be closed.
    pub(in crate::app) fn opened_last(&mut self) -> Option<Opened> {
        self.keep_order();
        // What is selected is marked in the world too, and a tool is put down by another one.
        let can_close = |panel: &&Opened| match **panel {
            Opened::Selection => true,
            Opened::Tool => false,
            panel => !self.hides_panels && self.is_seen(panel),
        };
        self.opened.iter().rev().find(can_close).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::PointId;

    #[test]
    fn the_panel_that_was_opened_last_is_closed_first() {
        let mut state = PanelState { has_settings: true, ..PanelState::default() };
        assert_eq!(state.opened_last(), Some(Opened::Settings));
        state.plots = Some(Plots::new(1.0));
        assert_eq!(state.opened_last(), Some(Opened::Plots));
        state.lessons.is_open = true;
        state.plots = None;
        assert_eq!(state.opened_last(), Some(Opened::Lessons), "what was closed is none of them");
        state.hides_panels = true;
        assert_eq!(state.opened_last(), None, "what is not seen stays");
        state.hides_panels = false;
        state.lessons.is_open = false;
        assert_eq!(state.opened_last(), Some(Opened::Settings));
        state.has_selection = true;
        assert_eq!(state.opened_last(), Some(Opened::Selection));
        state.hides_panels = true;
        assert_eq!(state.opened_last(), Some(Opened::Selection), "it is seen in the world");
        (state.hides_panels, state.has_selection) = (false, false);
        assert_eq!(state.opened_last(), Some(Opened::Settings), "what another tool keeps selected is not in its way");
        state.has_settings = false;
        assert_eq!(state.opened_last(), None);
    }

    #[test]
    fn where_there_is_room_for_one_panel_the_one_that_was_opened_last_is_seen() {
        let all = [Opened::Settings, Opened::Lessons, Opened::Plots, Opened::Tool];
        let seen = |state: &PanelState| all.into_iter().filter(|panel| state.is_seen(*panel)).collect::<Vec<_>>();
        let mut state = PanelState { room: Room::One, ..PanelState::default() };
        state.toggle_settings();
        assert_eq!(seen(&state), [Opened::Settings]);
        state.take(Tool::Build);
        assert_eq!(seen(&state), [Opened::Tool], "its panel opens with a tool");
        assert_eq!(state.opened_last(), None, "what is not seen is not closed");
        state.toggle_settings();
        assert_eq!(seen(&state), [Opened::Settings], "they are not closed by a button that would show them");
        state.toggle_plots(1.0);
        state.toggle_lessons();
        assert_eq!(seen(&state), [Opened::Lessons]);
        state.toggle_plots(1.0);
        assert_eq!(seen(&state), [Opened::Plots]);
        state.toggle_plots(1.0);
        state.keep_order();
        assert_eq!(seen(&state), [Opened::Lessons], "what was opened before comes back");
        state.toggle_lessons();
        assert_eq!(seen(&state), [Opened::Settings]);
        state.room = Room::All;
        state.toggle_lessons();
        assert_eq!(seen(&state), [Opened::Settings, Opened::Lessons, Opened::Tool]);
        state.room = Room::NotBoth;
        assert_eq!(seen(&state), [Opened::Lessons, Opened::Tool], "these have no room beside settings");
    }

    #[test]
    fn what_is_selected_and_settings_take_turns_but_in_wide_windows() {
        let window = |width: f32| Room::of(Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(width, 720.0)), false);
        assert_eq!([900.0, 1280.0, 1600.0].map(window), [Room::NotBoth, Room::Most, Room::All]);
        for (room, both) in [(Room::NotBoth, false), (Room::Most, false), (Room::All, true)] {
            let mut state = PanelState { room, tool: Tool::Select, ..PanelState::default() };
            state.toggle_settings();
            assert!(state.seen(true).has_settings && state.seen(true).has_tool, "how to select lies beside the tools");
            state.select();
            assert_eq!([state.seen(true).has_settings, state.seen(true).has_tool], [both, true], "{room:?}");
            if both {
                continue;
            }
            state.toggle_settings();
            assert!(state.seen(true).has_settings && !state.seen(true).has_tool, "{room:?}: their button brings them");
            state.select();
            assert!(!state.seen(true).has_settings && state.seen(true).has_tool, "{room:?}: another body does");
            state.has_selection = false;
            state.keep_order();
            assert!(state.seen(true).has_settings && state.seen(true).has_tool, "{room:?}: they were never closed");
        }
    }

    #[test]
    fn what_is_selected_comes_before_the_panel_of_another_button_until_that_is_pressed() {
        let mut state = PanelState { room: Room::One, ..PanelState::default() };
        state.take(Tool::Select);
        state.toggle_settings();
        assert!(state.is_seen(Opened::Settings) && !state.is_seen(Opened::Tool));
        state.has_selection = true;
        state.keep_order();
        assert!(state.is_seen(Opened::Selection) && !state.is_seen(Opened::Settings));
        state.toggle_settings();
        assert!(state.is_seen(Opened::Settings) && !state.is_seen(Opened::Selection));
        (state.has_settings, state.has_selection) = (false, false);
        state.keep_order();
        assert!(state.is_seen(Opened::Tool), "it says how to select");
    }

    #[test]
    fn plots_that_are_closed_and_opened_again_have_their_probes() {
        let mut state = PanelState::default();
        state.toggle_plots(1.0);
        let probes = |state: &PanelState| state.plots.as_ref().map(Plots::probes);
        if let Some(plots) = &mut state.plots {
            plots.toggle(PointId(3), |_| false);
        }
        let before = probes(&state);
        state.toggle_plots(1.0);
        assert_eq!(probes(&state), None);
        state.toggle_plots(1.0);
        assert!(before.is_some_and(|probes| probes[0].is_some()) && probes(&state) == before);
    }
}
