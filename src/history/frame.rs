//! A world at a place of the log, with what belongs to it: what keyframes are copies of.

use super::command::{Do, Entry};
use super::dress::Dress;
use super::effort::Effort;
use super::resolve::{Resolved, resolve};
use crate::scene::Scene;
use crate::sim::{Applied, Command, Dynamics};

/// A step that ends this share of its length beside a time still ends at it.
const SLACK: f64 = 1e-9;

/// A world with its dress, after so many commands of its branch.
pub(super) struct Frame {
    pub(super) world: Box<dyn Dynamics>,
    pub(super) dress: Dress,
    pub(super) place: usize,
    /// What the steps to here cost.
    pub(super) effort: Effort,
}

impl Clone for Frame {
    fn clone(&self) -> Self {
        let Frame { world, dress, place, effort } = self;
        Frame { world: world.boxed_clone(), dress: dress.clone(), place: *place, effort: effort.clone() }
    }
}

impl Frame {
    /// A world before the first command of its branch.
    pub(super) fn new(world: Box<dyn Dynamics>, dress: Dress) -> Self {
        Frame { world, dress, place: 0, effort: Effort::default() }
    }

    /// Whether what is to be done at `at` `[s]` is to be done now.
    pub(super) fn is_due(&self, at: f64) -> bool {
        at <= self.world.time() + SLACK * self.world.substep()
    }

    /// Whether a step from here ends at or before `time` `[s]`.
    pub(super) fn ends_by(&self, time: f64) -> bool {
        self.world.time() + self.world.substep() * (1.0 - SLACK) <= time
    }

    /// Whether a step towards `at` `[s]` is cut short there.
    pub(super) fn is_cut_at(&self, at: f64) -> bool {
        let (t, h) = (self.world.time(), self.world.substep());
        t + h > at + SLACK * h
    }

    /// Does a command; one of the log is not counted yet.
    ///
    /// Errors: in words, why it cannot be done; the world is as it was.
    pub(super) fn apply(&mut self, act: &Do, scene: &Scene) -> Result<Applied, String> {
        match resolve(act, scene, &*self.world)? {
            Resolved::Engine(command) => self.world.apply(&command).map_err(|error| error.to_string()),
            Resolved::Made(made) => {
                let command = Command::Add(Box::new(made.addition));
                let applied = self.world.apply(&command).map_err(|error| error.to_string())?;
                self.dress.wear(made.skins);
                self.dress.tint((made.tints, made.names), &made.coats);
                Ok(Applied { is_something: applied.is_something || !made.coats.is_empty(), ..applied })
            }
            Resolved::Group => {
                if let Do::Group { points, name } = act {
                    self.dress.group(name, points);
                }
                Ok(Applied { is_something: true, ..Applied::default() })
            }
        }
    }

    /// Does the next command of the log.
    ///
    /// Errors: in words, why it cannot be done; it is passed over.
    pub(super) fn follow(&mut self, entry: &Entry, scene: &Scene) -> Result<Applied, String> {
        self.place += 1;
        self.apply(&entry.act, scene)
    }

    /// Takes a step, which ends at the time of the next command `[s]` where it would go beyond.
    pub(super) fn step(&mut self, next: Option<f64>) {
        let before = *self.world.counters();
        match next {
            Some(at) => self.world.step_until(at),
            None => self.world.step(),
        }
        self.effort.add(&before, &*self.world);
    }
}
