//! A world at a place of the log, with what belongs to it: what keyframes are copies of.

use super::clock::Said;
use super::command::{Do, Entry, SetKeys};
use super::dress::Dress;
use super::eased::{self, Eased};
use super::effort::Effort;
use super::error::Why;
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
    /// Numbers on their way.
    pub(super) eased: Vec<Eased>,
    /// What was said of its clock.
    pub(super) said: Said,
}

impl Clone for Frame {
    fn clone(&self) -> Self {
        let Frame { world, dress, place, effort, eased, said } = self;
        let (dress, effort, eased) = (dress.clone(), effort.clone(), eased.clone());
        Frame { world: world.boxed_clone(), dress, place: *place, effort, eased, said: *said }
    }
}

impl Frame {
    /// A world before the first command of its branch.
    pub(super) fn new(world: Box<dyn Dynamics>, dress: Dress) -> Self {
        Frame { world, dress, place: 0, effort: Effort::default(), eased: Vec::new(), said: Said::default() }
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
    pub(super) fn apply(&mut self, act: &Do, scene: &Scene) -> Result<Applied, Why> {
        let Do::Set(keys) = act else { return self.apply_now(act, scene) };
        if keys.over.is_some() {
            return self.ease(keys, scene);
        }
        let applied = self.apply_now(act, scene)?;
        self.eased.retain_mut(|eased| eased.yields(keys));
        Ok(applied)
    }

    /// Sends numbers on their way.
    fn ease(&mut self, keys: &SetKeys, scene: &Scene) -> Result<Applied, Why> {
        let parted = eased::part(keys, &*self.world)?;
        // What could not be done at once cannot be done later.
        let at_once = Do::Set(Box::new(SetKeys { over: None, ..keys.clone() }));
        let mut trial = Frame::new(self.world.boxed_clone(), self.dress.clone());
        let applied = trial.apply_now(&at_once, scene)?;
        if let Some(now) = parted.now {
            self.apply_now(&Do::Set(Box::new(now)), scene)?;
        }
        self.eased.retain_mut(|eased| eased.yields(keys));
        self.eased.extend(parted.eased);
        Ok(applied)
    }

    /// What is on its way gets the numbers of now.
    fn pass_eased(&mut self, scene: &Scene) {
        let time = self.world.time();
        if !self.eased.iter().any(|eased| eased.is_due(time)) {
            return;
        }
        for mut eased in std::mem::take(&mut self.eased) {
            if eased.is_due(time)
                && let Some(keys) = eased.pass(&*self.world)
            {
                // What has become impossible meanwhile is left as it is.
                let _ = self.apply_now(&Do::Set(Box::new(keys)), scene);
            }
            if !eased.is_over(time) {
                self.eased.push(eased);
            }
        }
    }

    /// The world as it will be made once all that is on its way is there; `None`: nothing is.
    pub(super) fn ahead(&self, scene: &Scene) -> Option<Box<dyn Dynamics>> {
        if self.eased.is_empty() {
            return None;
        }
        let mut ahead = Frame::new(self.world.boxed_clone(), self.dress.clone());
        for keys in self.eased.iter().filter_map(|eased| eased.end(&*self.world)) {
            let _ = ahead.apply_now(&Do::Set(Box::new(keys)), scene);
        }
        Some(ahead.world)
    }

    fn apply_now(&mut self, act: &Do, scene: &Scene) -> Result<Applied, Why> {
        match resolve(act, scene, &*self.world)? {
            Resolved::Engine(command) => {
                let applied = self.world.apply(&command)?;
                if let Do::Split { points, .. } = act {
                    self.dress.double(points, applied.points.start);
                }
                let is_told = matches!(act, Do::Set(keys) if self.hear(keys));
                Ok(Applied { is_something: applied.is_something || is_told, ..applied })
            }
            Resolved::Made(made) => {
                let command = Command::Add(Box::new(made.addition));
                let applied = self.world.apply(&command)?;
                let is_dressed = !(made.skins.is_empty() && made.coats.is_empty());
                self.dress.wear(made.skins);
                self.dress.tint((made.tints, made.known), &made.coats);
                Ok(Applied { is_something: applied.is_something || is_dressed, ..applied })
            }
            Resolved::Group => {
                if let Do::Group { points, name } = act {
                    self.dress.group(name, points);
                }
                Ok(Applied { is_something: true, ..Applied::default() })
            }
        }
    }

    /// Takes what no step knows of: clock and labels. Returns whether there is any of it.
    fn hear(&mut self, keys: &SetKeys) -> bool {
        let is_labelled = keys.labels.as_ref().is_some_and(|labels| self.dress.label(labels));
        self.said.hear(keys) || is_labelled
    }

    /// Does the next command of the log.
    ///
    /// Errors: in words, why it cannot be done; it is passed over.
    pub(super) fn follow(&mut self, entry: &Entry, scene: &Scene) -> Result<Applied, Why> {
        self.place += 1;
        self.apply(&entry.act, scene)
    }

    /// Takes a step, which ends at the time of the next command `[s]` where it would go beyond.
    pub(super) fn step(&mut self, next: Option<f64>, scene: &Scene) {
        let before = *self.world.counters();
        match next {
            Some(at) => self.world.step_until(at),
            None => self.world.step(),
        }
        self.effort.add(&before, &*self.world);
        self.pass_eased(scene);
    }
}
