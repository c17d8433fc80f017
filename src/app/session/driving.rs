//! The keys that drives of the scene have, and the camera that follows what they drive.

use winit::event::{ElementState, KeyEvent};
use winit::keyboard::{Key as Pressed, NamedKey, PhysicalKey};

use super::{Framing, Session};
use crate::app::keyboard::Keyboard;
use crate::app::keys::taken;
use crate::app::tools::Scope;
use crate::history::Do;
use crate::sim::{Key, PointId};

/// What holds a key of drives down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Holder {
    /// A key of the keyboard.
    Keyboard(PhysicalKey),
    /// The mouse, on its cap at the lower edge.
    Mouse,
}

/// The key of drives that a key of the keyboard is.
fn meant(key: &Pressed) -> Option<Key> {
    match key {
        Pressed::Named(NamedKey::ArrowLeft) => Key::of("left"),
        Pressed::Named(NamedKey::ArrowRight) => Key::of("right"),
        Pressed::Named(NamedKey::ArrowUp) => Key::of("up"),
        Pressed::Named(NamedKey::ArrowDown) => Key::of("down"),
        Pressed::Named(NamedKey::Space) => Key::of("space"),
        Pressed::Character(text) if text == " " => Key::of("space"),
        Pressed::Character(text) => Key::of(&text.to_lowercase()),
        _ => None,
    }
}

impl Session {
    /// A key of the keyboard went down or up. Returns whether it is one of drives: then it means nothing else.
    pub(in crate::app) fn drive(&mut self, event: &KeyEvent) -> bool {
        let holder = Holder::Keyboard(event.physical_key);
        let is_held = self.driving.iter().any(|(by, _)| *by == holder);
        if event.state == ElementState::Released {
            self.release_key(holder);
            return is_held;
        }
        let drives = |key: &Key| self.shown().scenery.keys.binary_search(key).is_ok();
        let Some(key) = meant(&event.logical_key).filter(drives) else { return false };
        if self.held.command || self.keyboard() != Keyboard::Scene || self.is_covered() {
            return false;
        }
        if !is_held && !event.repeat {
            self.hold_key(holder, key);
        }
        true
    }

    /// The mouse holds this key from now on, or none.
    pub(super) fn hold_by_mouse(&mut self, key: Option<Key>) {
        self.release_key(Holder::Mouse);
        if let Some(key) = key {
            self.hold_key(Holder::Mouse, key);
        }
    }

    fn hold_key(&mut self, holder: Holder, key: Key) {
        let is_new = self.driving.iter().all(|(_, held)| *held != key);
        self.driving.push((holder, key));
        self.follows = true;
        self.panels.notes.has_caption = false;
        if is_new {
            self.give_key(key, true);
        }
    }

    /// What held a key lets it go: it comes up where nothing else holds it.
    fn release_key(&mut self, holder: Holder) {
        let Some(place) = self.driving.iter().position(|(by, _)| *by == holder) else { return };
        let (_, key) = self.driving.swap_remove(place);
        if self.driving.iter().all(|(_, held)| *held != key) {
            self.give_key(key, false);
        }
    }

    /// Which keys of the window mean something else here, because drives of the scene have them.
    pub(super) fn taken_keys(&self) -> Option<String> {
        let keys = self.shown().scenery.keys.iter();
        let taken = keys.filter_map(|&key| Some(format!("{} (else: {})", key.name().to_uppercase(), taken(key)?)));
        let taken: Vec<String> = taken.collect();
        let list = taken.join(", ");
        (!taken.is_empty()).then(|| format!("here keys of the window drive what is in the scene: {list}"))
    }

    /// All keys that are held are let go.
    pub(super) fn stop_driving(&mut self) {
        let mut keys: Vec<Key> = std::mem::take(&mut self.driving).into_iter().map(|(_, key)| key).collect();
        keys.sort_unstable();
        keys.dedup();
        keys.into_iter().for_each(|key| self.give_key(key, false));
    }

    pub(super) fn give_key(&mut self, key: Key, down: bool) {
        self.player.give(vec![Do::Key { key, down }], None);
        self.touch();
    }

    /// The keys that drives have, and whether each is held here.
    pub(super) fn keys_to_hold(&self) -> Vec<(Key, bool)> {
        let is_held = |key: &Key| self.driving.iter().any(|(_, held)| held == key);
        self.shown().scenery.keys.iter().map(|key| (*key, is_held(key))).collect()
    }

    /// The key that the mouse holds.
    pub(super) fn key_by_mouse(&self) -> Option<Key> {
        self.driving.iter().find(|(by, _)| *by == Holder::Mouse).map(|(_, key)| *key)
    }

    /// Where the bodies are seen that keys drive, as long as those have no place yet `[points]`.
    pub(super) fn driven_seen(&self) -> Option<egui::Rect> {
        if self.panels.held_at.is_found(&self.keys_to_hold()) {
            return None;
        }
        let camera = self.camera_here();
        let scope = Scope { shown: self.shown(), camera: &camera, scale: 1.0, free: Scope::ANYWHERE };
        let mut points: Vec<PointId> = Vec::new();
        for &point in &scope.shown.scenery.driven {
            if scope.is_there(point) && points.binary_search(&point).is_err() {
                points.extend(scope.body(point));
                points.sort_unstable();
            }
        }
        let seen =
            points.into_iter().filter_map(|point| scope.pixel(point)).map(|pixel| self.point_of(pixel.to_array()));
        let around = seen.fold(egui::Rect::NOTHING, |around, at| around.union(egui::Rect::from_min_max(at, at)));
        around.is_finite().then_some(around)
    }

    /// Looks which motors stall, which is said beside them.
    pub(super) fn look_for_stalls(&mut self) {
        let held: Vec<Key> = self.driving.iter().map(|(_, key)| *key).collect();
        self.dirty |= self.stalls.look(self.player.shown(), &held);
    }

    /// The camera goes along with what the scene says, or with what keys drive once one was pressed, as long as nobody leads it elsewhere.
    pub(super) fn follow_driven(&mut self) {
        if !self.follows || self.pointer.is_dragging() {
            return;
        }
        // What is in hand would run away from a view that goes along with it.
        let (shown, followed) = (self.shown(), &self.followed);
        let is_by_keys = followed.points.is_empty();
        if !is_by_keys && self.hand.is_busy() {
            return;
        }
        let points = followed.or_driven(|| shown.scenery.driven.to_vec());
        let mut own = self.tiles.own(&self.camera, self.area);
        if followed.lead(&mut own, points.into_iter().map(|point| shown.place(point.index()).into())) {
            // Where it does so from the start, the view is as it opens still, for a window of another size.
            let framing = if is_by_keys { Framing::Free } else { self.framing };
            (self.camera, self.framing) = (self.tiles.whole(&own, self.area), framing);
            self.dirty = true;
        }
    }
}
