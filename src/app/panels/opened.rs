//! Panels that stay open beside the world, in the order in which they were opened: Esc closes the last of them.

use super::PanelState;
use crate::app::plots::Plots;

/// A panel that stays open until it is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app) enum Opened {
    Settings,
    Plots,
    Lessons,
    /// What is selected has one: it closes with that.
    Selection,
}

impl PanelState {
    fn is_open(&self, panel: Opened) -> bool {
        match panel {
            Opened::Settings => self.has_settings,
            Opened::Plots => self.plots.is_some(),
            Opened::Lessons => self.lessons.is_open,
            Opened::Selection => self.has_selection,
        }
    }

    /// Those that were closed since go out of the list, those that were opened come to its end.
    pub(super) fn keep_order(&mut self) {
        let mut list = std::mem::take(&mut self.opened);
        list.retain(|panel| self.is_open(*panel));
        for panel in [Opened::Lessons, Opened::Plots, Opened::Settings, Opened::Selection] {
            if self.is_open(panel) && !list.contains(&panel) {
                list.push(panel);
            }
        }
        self.opened = list;
    }

    /// Opens the plots, or closes them: opened again, they are of what they were of. The scene plays so many of its seconds a second of wall
    /// time.
    pub(in crate::app) fn toggle_plots(&mut self, rate: f64) {
        match self.plots.take() {
            Some(plots) => self.plots_left = Some(plots.emptied(rate)),
            None => self.plots = Some(self.plots_left.take().unwrap_or_else(|| Plots::new(rate))),
        }
    }

    /// The one that was opened last, of those that are seen.
    pub(in crate::app) fn opened_last(&mut self) -> Option<Opened> {
        self.keep_order();
        // What is selected is marked in the world too.
        let is_seen = |panel: &&Opened| !self.hides_panels || **panel == Opened::Selection;
        self.opened.iter().rev().find(is_seen).copied()
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
