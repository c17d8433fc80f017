//! The pointer in the window: over a panel, over the world, pressing, dragging.

use std::time::{Duration, Instant};

use egui::Order;
use glam::DVec2;
use winit::event::{ElementState, MouseButton, MouseScrollDelta};

use super::marking::MOST_MARKED;
use super::{Framing, Session};
use crate::app::action::Tool;
use crate::app::player;
use crate::app::pointer::Pointer;
use crate::app::resting::{Pointing, Way};
use crate::app::starting;
use crate::app::tools::{Deed, Hand, Scope};
use crate::history::Do;
use crate::render::{Camera, level_floor};
use crate::scene::Scene;
use crate::sim::{Cursor, PointId};

/// Two presses within this time are a double click.
const DOUBLE: Duration = Duration::from_millis(400);

impl Session {
    /// The pointer moved `[px]`.
    pub(in crate::app) fn point_at(&mut self, at: [f64; 2]) {
        let before = self.camera;
        if self.pointer.move_to(at, &mut self.camera) {
            self.keep_above_floor(before);
            (self.framing, self.follows) = (Framing::Free, false);
        }
        self.find_cell();
        self.panels_dirty |= self.pointer.is_dragging() && self.worlds() > 1;
        let is_over = self.is_over_panels();
        if is_over || self.was_over_panels || self.wants_hint || self.egui.egui_ctx().egui_is_using_pointer() {
            self.panels_dirty = true;
        }
        self.place_hint();
        self.find_hinge();
        self.was_over_panels = is_over;
        self.with_scope(|hand, scope| hand.trace(scope, DVec2::from(at)));
        self.show_cursor();
        self.dirty = true;
    }

    /// In space the view, led by hand from where it was before, stays above the floor.
    fn keep_above_floor(&mut self, before: Camera) {
        let scenery = &self.shown().scenery;
        let floor = level_floor(&scenery.planes, scenery.bounds).filter(|_| self.scene.dimensions() == 3);
        self.camera = floor.map_or(self.camera, |floor| self.camera.kept_above(floor, &before));
    }

    /// The pointer left the window.
    pub(in crate::app) fn point_away(&mut self) {
        self.pointer.leave();
        self.place_hint();
        self.find_hinge();
        self.touch();
    }

    /// A button went down or up.
    pub(in crate::app) fn press(&mut self, button: MouseButton, state: ElementState) {
        self.panels_dirty = true;
        self.dirty = true;
        let is_pressed = state == ElementState::Pressed;
        if is_pressed && (self.is_over_panels() || self.is_covered()) {
            return;
        }
        if is_pressed && self.is_writing() {
            // A field has what is written in it before what is selected changes, and with that what the field is of.
            self.show_panels();
        }
        if is_pressed {
            self.panels.notes.go_on();
        }
        let cuts = button == MouseButton::Right && self.cuts_by_right(is_pressed);
        match cuts {
            true => self.hand.hold_cut(true),
            false => self.pointer.press(button, state),
        }
        // While one button cuts the other does nothing.
        if !cuts && (button != MouseButton::Left || self.hand.cuts()) {
            return;
        }
        let Some(at) = self.pixel() else {
            self.hand.hold_cut(false);
            return;
        };
        // Also on what it would have led.
        let starts = !is_pressed && self.with_scope(|hand, scope| hand.has_clicked(scope, at));
        let deed = if is_pressed { self.press_down(at) } else { self.let_go(at) };
        self.do_deed(deed);
        if starts {
            self.start_at(at);
        }
        self.show_cursor();
    }

    /// The left button went down at a pixel. Returns what is done there.
    fn press_down(&mut self, at: DVec2) -> Deed {
        self.used();
        self.hand.stand_still(!self.player.is_playing());
        let last = self.pressed_at.replace(Instant::now());
        self.hand.hasten(last.is_some_and(|last| last.elapsed() < DOUBLE));
        let label = self.label_under(at);
        let mut deed = self.with_scope(|hand, scope| match label {
            Some(number) => hand.press_label(scope, number, at),
            None => hand.press(scope, at),
        });
        self.resting.press(at.to_array());
        if self.hand.is_grabbing() {
            // What is grabbed follows the cursor, so it is there first.
            let way = Way { to: Some(self.camera_here().cursor(at.to_array())), jumps: true };
            self.resting.tell(Some(at.to_array()), way);
            let to = self.led_to(way);
            deed.commands.insert(0, Do::Cursor { to, by: None });
            self.told = to;
        }
        if deed.is_empty() && self.hand.is_pushing() {
            self.start_at(at);
        }
        deed
    }

    /// The button that was held was let go at a pixel. Returns what is done there.
    fn let_go(&mut self, at: DVec2) -> Deed {
        self.lead(f64::INFINITY);
        self.probe(at);
        let deed = self.with_scope(|hand, scope| hand.release(scope, at));
        self.hand.hold_cut(false);
        deed
    }

    /// Whether the right button cuts, as it goes down or up: in cloths of the plane, where it goes down while the hand has nothing else to do.
    fn cuts_by_right(&self, is_pressed: bool) -> bool {
        match is_pressed {
            true => cuts_by_right(&self.scene) && !self.hand.is_busy() && !self.pointer.is_dragging(),
            false => self.hand.cuts(),
        }
    }

    /// A motion starts where a click was, in scenes that have one for that.
    fn start_at(&mut self, at: DVec2) {
        let place = self.camera_here().world_from_screen(at.to_array());
        if let Some(commands) = starting::start(&self.scene, place.truncate()) {
            self.player.give(commands, Some("start"));
            self.say("it starts here, by each method; Ctrl+Z takes it back".to_owned());
        }
    }

    /// What is led goes after the cursor, `seconds` after the last time: pins, and while time runs what is dragged of what is selected.
    pub(super) fn lead(&mut self, seconds: f64) {
        self.lead_on_cursor(seconds);
        let Some(at) = self.pixel() else { return };
        if let Some(commands) = self.with_scope(|hand, scope| hand.lead_bodies(scope, at)) {
            self.told = self.world_cursor();
            self.player.give(commands, None);
        }
        if let Some(way) = self.with_scope(|hand, scope| hand.haul(scope, at, seconds)) {
            self.player.ask(player::Order::Haul(way));
            self.dirty = true;
        }
        if let Some(way) = self.with_scope(|hand, scope| hand.lead(scope, at, seconds)) {
            self.player.ask(player::Order::LeadPins(way));
            self.dirty = true;
        }
    }

    /// The pin that the scene has on the cursor goes after it, while time runs and the pointer is over the world.
    fn lead_on_cursor(&mut self, seconds: f64) {
        let Some(pin) = self.scene.cursor_pin.filter(|_| self.player.is_playing()) else { return };
        let is_over_world = !self.pointer.is_dragging() && !self.is_covered() && !self.is_over_panels();
        let Some(at) = self.pixel().filter(|_| is_over_world && !self.shown().figures.follows) else { return };
        if let Some(way) = self.with_scope(|hand, scope| hand.lead_on_cursor(scope, (PointId(pin), at), seconds)) {
            self.player.ask(player::Order::LeadPins(way));
            self.dirty = true;
        }
    }

    /// The wheel turned.
    pub(in crate::app) fn scroll(&mut self, delta: MouseScrollDelta) {
        self.panels_dirty = true;
        let up = match delta {
            MouseScrollDelta::LineDelta(_, y) => f64::from(y),
            MouseScrollDelta::PixelDelta(by) => by.y,
        };
        let steps = if up == 0.0 { 0 } else { up.signum() as i32 };
        if self.hand.turn_wheel(steps) {
            self.dirty = true;
            return;
        }
        if !self.is_over_panels() && !self.is_covered() {
            let at = self.pointer.at.map(|at| self.in_first(at));
            let before = self.camera;
            at.iter().for_each(|at| Pointer::scroll(*at, delta, &mut self.camera));
            self.keep_above_floor(before);
            self.framing = Framing::Free;
        }
        self.dirty = true;
    }

    /// Someone has found out what to do: nothing more is said of it.
    fn used(&mut self) {
        self.framed.hold();
        (self.wants_hint, self.panels.notes.hint) = (false, None);
        self.panels.notes.has_caption = false;
    }

    /// Where the pointer is on the world `[px]`.
    pub(super) fn pixel(&self) -> Option<DVec2> {
        self.pointer.at.map(DVec2::from)
    }

    /// Calls a tool with what is drawn.
    pub(super) fn with_scope<T>(&mut self, call: impl FnOnce(&mut Hand, Scope<'_>) -> T) -> T {
        let scale = f64::from(self.look.scale_factor);
        let camera = self.camera_here();
        let scope = Scope { shown: self.player.shown(), camera: &camera, scale, free: self.free.map(DVec2::from) };
        call(&mut self.hand, scope)
    }

    /// The number of the label that a press at a pixel takes.
    pub(super) fn label_under(&self, at: DVec2) -> Option<usize> {
        let scale = f64::from(self.look.scale_factor);
        let camera = self.camera_here();
        let scope = Scope { shown: self.shown(), camera: &camera, scale, free: self.free.map(DVec2::from) };
        self.label_at(scope, at).map(|(number, _)| number)
    }

    /// Where the pointer is for the panels `[points]`.
    pub(super) fn place_of_pointer(&self) -> Option<egui::Pos2> {
        self.pointer.at.map(|at| self.point_of(at))
    }

    /// Where the panels have a pixel `[points]`.
    pub(super) fn point_of(&self, [x, y]: [f64; 2]) -> egui::Pos2 {
        let scale = f64::from(self.egui.egui_ctx().pixels_per_point());
        egui::pos2((x / scale) as f32, (y / scale) as f32)
    }

    /// The pixel at a place of the panels `[px]`.
    pub(super) fn pixel_of(&self, at: egui::Pos2) -> [f64; 2] {
        let scale = self.egui.egui_ctx().pixels_per_point();
        [at.x, at.y].map(|x| f64::from(x * scale))
    }

    /// The hint goes with the pointer, and says what a press would do there now.
    pub(super) fn place_hint(&mut self) {
        let is_wanted =
            self.wants_hint && self.hand.tool() == Tool::Hand && !self.is_over_panels() && !self.is_covered();
        let at = self.pixel().filter(|_| is_wanted);
        let words = at.and_then(|at| self.with_scope(|hand, scope| hand.hint(scope, at)));
        let hint = self.place_of_pointer().zip(words);
        self.panels_dirty |= self.panels.notes.hint != hint;
        self.panels.notes.hint = hint;
    }

    /// The panel of the tool for motors says what the hinge under the pointer has.
    pub(super) fn find_hinge(&mut self) {
        let is_wanted = self.hand.tool() == Tool::Motor && !self.is_over_panels() && !self.is_covered();
        let is_small = self.shown().point_count() <= MOST_MARKED;
        let at = self.pixel().filter(|_| is_wanted && is_small);
        let hinge = at.and_then(|at| self.with_scope(|hand, scope| hand.hinge_at(scope, at)));
        self.panels_dirty |= std::mem::replace(&mut self.panels.hinge, hinge) != hinge;
    }

    /// Whether the pointer is over a panel, or over what floats over the world.
    pub(super) fn is_over_panels(&self) -> bool {
        let Some(at) = self.place_of_pointer() else { return false };
        let area = self.area.map(f64::from);
        let is_beside = self.pointer.at.is_some_and(|at| at[0] >= area[0] || at[1] >= area[1]);
        let layer = self.egui.egui_ctx().layer_id_at(at);
        is_beside || layer.is_some_and(|layer| layer.order != Order::Background)
    }

    /// Where the cursor is in the world, with what is led beside it.
    pub(super) fn world_cursor(&self) -> Option<Cursor> {
        self.led_to(self.way_of_cursor())
    }

    /// Where what is led goes with the cursor.
    pub(super) fn led_to(&self, way: Way) -> Option<Cursor> {
        way.to.map(|cursor| self.hand.led_to(cursor))
    }

    /// Where the cursor goes in the world: nowhere while it is over a panel, drags the camera or has left. What is led follows it over
    /// panels too.
    pub(super) fn way_of_cursor(&self) -> Way {
        let leads = self.hand.is_busy();
        let is_free = !self.pointer.is_dragging() && !self.is_covered() && (leads || !self.is_over_panels());
        // A window that gets the focus is told of a pointer that may be anywhere.
        let [width, height] = self.area.map(f64::from);
        let is_inside = |[x, y]: [f64; 2]| (0.0..width).contains(&x) && (0.0..height).contains(&y);
        let is_free = is_free && (leads || self.pointer.at.is_some_and(is_inside));
        let pointing = Pointing { is_free, grabs: self.hand.is_grabbing() };
        self.resting.way(&self.camera_here(), self.pointer.at, pointing)
    }
}

/// The tag of scenes in which the right button cuts.
const CLOTH: &str = "cloth";

/// Whether the right button cuts in a scene, in place of panning: in space it orbits.
fn cuts_by_right(scene: &Scene) -> bool {
    scene.dimensions() == 2 && scene.tags.iter().any(|tag| tag == CLOTH)
}

#[cfg(test)]
mod tests {
    use super::cuts_by_right;
    use crate::scene::gallery;

    #[test]
    fn the_right_button_cuts_in_cloths_of_the_plane_alone() {
        let cuts = |name: &str| {
            let scene = gallery().iter().find(|entry| entry.name == name).and_then(|entry| entry.scene().ok());
            scene.is_some_and(|scene| cuts_by_right(&scene))
        };
        assert!(cuts("net") && cuts("tearable-net"));
        assert!(!cuts("cloth-ball") && !cuts("rim"));
    }
}
