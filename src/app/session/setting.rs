//! What is set of a running scene.

use super::Session;
use crate::app::panels::Setting;
use crate::app::tools::strength;
use crate::history::Do;
use crate::sim::{MouseChange, PointId};

impl Session {
    /// Something is set of the scene. The strength of the hover force is the hand's to give, which may hold it away now.
    pub(super) fn set(&mut self, Setting { act, name, goes_on }: Setting) {
        if let Do::Mouse(MouseChange { strength: Some(strength), radius, .. }) = act {
            self.hand.set_strength(Some(strength));
            // One that is only just to be is there at once.
            if self.hand.is_calm() && radius.is_none() {
                return;
            }
        }
        self.player.set(self.of_what_is_left(act), name, goes_on);
        self.dirty = true;
    }

    /// The same without bonds and points that were cut or taken away since: numbers that a scene names are of those that are left.
    fn of_what_is_left(&self, act: Do) -> Do {
        let Do::Set(mut keys) = act else { return act };
        let scenery = &self.shown().scenery;
        if let Some(bonds) = &keys.bonds {
            let mut there: Vec<u32> = (0..scenery.bonds.len()).map(|place| scenery.bond_number(place)).collect();
            there.sort_unstable();
            let stays: Vec<bool> = bonds.iter().map(|bond| there.binary_search(bond).is_ok()).collect();
            *keys = keys.among(&stays);
        } else if let Some(points) = &keys.points {
            let stays: Vec<bool> = points.iter().map(|i| scenery.gone.binary_search(&PointId(*i)).is_err()).collect();
            *keys = keys.among(&stays);
        }
        Do::Set(keys)
    }

    /// The hover force gets stronger and larger by these factors.
    pub(super) fn change_force(&mut self, stronger: f64, larger: f64) {
        let Some(force) = self.live_force() else {
            return self.say("this scene has no push of the mouse: the settings (G) add one".to_owned());
        };
        let radius = force.radius * larger;
        let base = self.hand.strength().unwrap_or(force.strength) * stronger;
        self.hand.set_strength(Some(base));
        let is_calm = self.hand.is_calm();
        let mut commands = vec![Do::Mouse(MouseChange { radius: Some(radius), ..MouseChange::default() })];
        if !is_calm {
            commands.push(strength(base));
        }
        self.player.give(commands, None);
        self.say(format!("push: {base:.0} /s² within {radius:.2} m"));
    }
}
