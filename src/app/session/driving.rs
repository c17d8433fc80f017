//! The keys that drives of the scene have, and the camera that follows what they drive.

use winit::event::{ElementState, KeyEvent};
use winit::keyboard::{Key as Pressed, NamedKey};

use super::{Framing, Session};
use crate::app::keys::taken;
use crate::history::Do;
use crate::sim::Key;

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
        let held = self.driving.iter().position(|(key, _)| *key == event.physical_key);
        if event.state == ElementState::Released {
            let Some(place) = held else { return false };
            let (_, key) = self.driving.swap_remove(place);
            self.give_key(key, false);
            return true;
        }
        let drives = |key: &Key| self.shown().scenery.keys.binary_search(key).is_ok();
        let Some(key) = meant(&event.logical_key).filter(drives) else { return false };
        if self.held.command || self.is_writing() || self.is_covered() {
            return false;
        }
        if held.is_none() && !event.repeat {
            self.driving.push((event.physical_key, key));
            self.follows = true;
            self.panels.notes.has_caption = false;
            self.give_key(key, true);
        }
        true
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
        for (_, key) in std::mem::take(&mut self.driving) {
            self.give_key(key, false);
        }
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
