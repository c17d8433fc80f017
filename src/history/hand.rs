//! What a log leaves in a hand: a grab that nobody leads any more, keys that nobody holds, and the hover force that it put away.

use super::command::Do;
use super::session::History;
use crate::sim::MouseChange;

impl History {
    /// The branch that the world is on, as [`History::to_branch`] takes it.
    pub fn branch(&self) -> usize {
        self.branch
    }

    /// Strength of the hover force `[1/s^2]` when nothing is led: the last that was given and is not 0, for that is what a grab puts it
    /// to, else the scene's. `None`: there is none, or it goes along a track of its own.
    pub fn base_strength(&self) -> Option<f64> {
        let scene = self.scene.mouse_force();
        let has_track = scene.as_ref().is_some_and(|force| !force.track.knots.is_empty());
        if has_track && !self.changes().any(|change| change.ends_track) {
            return None;
        }
        let given = self.changes().filter_map(|change| change.strength).find(|&strength| strength != 0.0);
        given.or(scene.map(|force| force.strength))
    }

    /// What lets go of all that a hand held at this moment, and brings the hover force back that it put away. Empty where nothing is
    /// held.
    pub fn letting_go(&self) -> Vec<Do> {
        let mut commands = Vec::new();
        if self.world().grab().is_some() {
            commands.push(Do::Release);
        }
        commands.extend(self.world().held_keys().iter().map(|&key| Do::Key { key, down: false }));
        // A state of a moment like this knows the force as it was then.
        let at_first = self.state.is_some().then(|| self.world().mouse().map(|(force, _)| force.strength)).flatten();
        let present = self.changes().find_map(|change| change.strength).or(at_first);
        if present == Some(0.0)
            && let Some(base) = self.base_strength().filter(|&base| base != 0.0)
        {
            commands.push(Do::Mouse(MouseChange { strength: Some(base), ..MouseChange::default() }));
        }
        commands
    }

    /// Changes of the hover force that were done, the last first.
    fn changes(&self) -> impl Iterator<Item = &MouseChange> {
        let places = (0..self.frame.place).rev();
        places.filter_map(|place| match self.tree.entry(self.branch, place).map(|entry| &entry.act) {
            Some(Do::Mouse(change)) => Some(change),
            _ => None,
        })
    }
}
