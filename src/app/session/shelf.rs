//! Histories that were left for another scene: undo goes back to them, redo forth again.

use super::{Framing, Session};
use crate::app::player::Player;
use crate::render::Camera;

/// So many are kept: each may hold its keyframes.
const MOST: usize = 3;

/// Histories before the present one and after it, the nearest last.
#[derive(Default)]
pub(super) struct Shelf {
    before: Vec<(Player, Camera)>,
    after: Vec<(Player, Camera)>,
}

impl Shelf {
    /// The present history was left for a new one.
    pub(super) fn keep(&mut self, player: Player, camera: Camera) {
        self.after.clear();
        self.before.push((player, camera));
        if self.before.len() > MOST {
            self.before.remove(0);
        }
    }

    /// The history before.
    pub(super) fn back(&mut self) -> Option<(Player, Camera)> {
        self.before.pop()
    }

    /// All that are kept.
    pub(super) fn players(&self) -> impl Iterator<Item = &Player> {
        self.before.iter().chain(&self.after).map(|(player, _)| player)
    }

    /// The same, to be ended.
    pub(super) fn players_mut(&mut self) -> impl Iterator<Item = &mut Player> {
        self.before.iter_mut().chain(&mut self.after).map(|(player, _)| player)
    }

    /// The history after.
    fn on(&mut self) -> Option<(Player, Camera)> {
        self.after.pop()
    }
}

impl Session {
    /// There is nothing to undo in this history: it was opened, so that is undone.
    pub(super) fn go_back(&mut self) {
        let name = self.scene.name().to_owned();
        match self.shelf.back() {
            Some((player, camera)) => {
                let left = self.bring_back(player, camera);
                self.shelf.after.push(left);
                self.say(format!("Undid: open {name}"));
            }
            None => self.say("there is nothing to undo".to_owned()),
        }
    }

    /// There is nothing to redo in this history: another was opened from it.
    pub(super) fn go_on(&mut self) {
        match self.shelf.on() {
            Some((player, camera)) => {
                let left = self.bring_back(player, camera);
                self.shelf.before.push(left);
                self.say(format!("Redid: open {}", self.scene.name()));
            }
            None => self.say("there is nothing to redo".to_owned()),
        }
    }

    /// Plays a history that was left, as it was left; returns the one before it.
    pub(super) fn bring_back(&mut self, player: Player, camera: Camera) -> (Player, Camera) {
        let playing = self.player.is_playing();
        let its = self.camera;
        self.take_leave();
        let mut last = std::mem::replace(&mut self.player, player);
        last.play(false);
        let scene = self.player.start().scene().clone();
        self.begin();
        self.arrive(std::sync::Arc::new(scene));
        self.import = None;
        (self.camera, self.framing) = (camera, Framing::Free);
        self.camera.resize(self.area);
        self.player.play(playing);
        (last, its)
    }
}
