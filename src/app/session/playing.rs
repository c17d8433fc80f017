//! Time as it is played: it goes on or stands still, fast or slowly, and begins anew.

use super::Session;
use super::acts::OPENING;
use crate::app::panels::at_end;
use crate::app::player::{Order, Player};

/// The least and the greatest pace, in seconds of the scene itself.
const PACES: [f64; 2] = [0.125, 4.0];

impl Session {
    /// Time stands still or goes on: not past the end, unless what was done there already is followed.
    pub(super) fn toggle_play(&mut self) {
        let figures = &self.shown().figures;
        let end = at_end(figures).filter(|_| !figures.follows && !self.player.is_playing());
        match end {
            Some(words) => self.say(format!("{words}; without \"ends\" in the settings it goes on")),
            None => self.player.play(!self.player.is_playing()),
        }
    }

    /// Back to the start. While a step takes long it is left to itself, and the start is played anew at once.
    pub(super) fn reset(&mut self) {
        if !self.player.is_open() {
            return self.say(OPENING.to_owned());
        }
        // What was built would not be in what is played anew.
        if self.player.is_busy() && !self.player.is_used() {
            let start = self.player.start().clone();
            let playing = self.player.is_playing();
            let camera = self.camera;
            let keeping = self.keeping();
            self.teaches = self.taught;
            self.put_on(Player::open(start, keeping, self.wake_up()));
            self.player.play(playing);
            self.camera = camera;
        } else {
            let held = std::mem::take(&mut self.driving);
            self.go(Order::Reset);
            // Keys that are held down drive on.
            for (key, drives) in held {
                self.driving.push((key, drives));
                self.give_key(drives, true);
            }
        }
    }

    /// Seconds of the scene a second of wall time, in those of the scene itself.
    pub(super) fn pace(&self) -> f64 {
        let figures = &self.shown().figures;
        figures.rate / figures.clock.rate
    }

    pub(super) fn set_pace(&mut self, pace: f64) {
        let pace = pace.clamp(PACES[0], PACES[1]);
        let own = if self.player.is_open() { self.shown().figures.clock.rate } else { self.scene.rate() };
        self.player.ask(Order::Rate(pace * own));
        self.say(format!("pace: {pace} x"));
    }
}
