//! What the window's events come to beside actions: keys for panels, keys that are held, a focus that is lost.

use winit::event::WindowEvent;

use super::Session;
use crate::app::action::{Action, Tool};
use crate::app::keyboard::Keyboard;
use crate::app::keys::{Down, Held};
use crate::app::panels::{self, settings_search_id};

impl Session {
    /// Hands an event to the panels: keys only where they write or nothing else is meant by them.
    pub(in crate::app) fn tell_panels(&mut self, event: &WindowEvent) {
        if let WindowEvent::KeyboardInput { event, .. } = event
            && !self.keyboard().tells_panels(&event.logical_key)
        {
            return;
        }
        let response = self.egui.on_window_event(&self.window, event);
        let is_move = matches!(event, WindowEvent::CursorMoved { .. });
        self.panels_dirty |= response.repaint && !is_move;
    }

    /// Whether what is typed goes into a field: also into one that is only about to be shown.
    pub(in crate::app) fn is_writing(&self) -> bool {
        let is_coming = self.panels.is_fresh && self.panels.sheet.is_some();
        is_coming || self.egui.egui_ctx().text_edit_focused()
    }

    /// Whether what is typed looks for a setting.
    pub(super) fn is_searching_settings(&self) -> bool {
        self.egui.egui_ctx().memory(|memory| memory.has_focus(settings_search_id()))
    }

    /// Closes the sheet that is open.
    pub(super) fn close_sheet(&mut self) {
        if self.panels.sheet.take().is_some() {
            self.leave_field();
        }
    }

    /// A sheet was closed: its field would have the focus until panels are drawn again, and with it the keys that are pressed until then.
    pub(super) fn leave_field(&self) {
        self.egui.egui_ctx().memory_mut(|memory| {
            if let Some(field) = memory.focused() {
                memory.surrender_focus(field);
            }
        });
    }

    /// Who has the keyboard now.
    pub(in crate::app) fn keyboard(&self) -> Keyboard {
        let context = self.egui.egui_ctx();
        // Lines to read are no menu: nothing in them is chosen by keys.
        let has_menu = egui::Popup::is_any_open(context) && !panels::are_lines_open(context);
        let is_on_sheet = self.panels.sheet.is_some() && context.memory(|memory| memory.focused().is_some());
        Keyboard::of((self.is_writing(), is_on_sheet), has_menu)
    }

    /// A key is pressed: lines that were opened to be read close. Returns whether that is all that it does.
    pub(in crate::app) fn closes_lines(&mut self, action: Action) -> bool {
        let was_open = panels::close_lines(self.egui.egui_ctx());
        self.panels_dirty |= was_open;
        was_open && action == Action::Cancel
    }

    /// Whether the tool that builds is taken, where it can be.
    pub(in crate::app) fn builds(&self) -> bool {
        self.hand.tool() == Tool::Build && self.scene.dimensions() == 2
    }

    /// Keys and buttons that were held down are let go elsewhere.
    pub(in crate::app) fn lose_focus(&mut self) {
        self.stop_driving();
        self.rewinds = false;
        self.hand.hold_pins(false);
        self.down = Down::default();
        self.hold(Held::default());
        self.touch();
    }

    /// Ctrl and Shift go down or up.
    pub(in crate::app) fn hold(&mut self, held: Held) {
        self.held = held;
        self.hand.hold([held.shift, held.alt]);
        self.hand.hold_command(held.command);
        self.dirty = true;
    }
}
