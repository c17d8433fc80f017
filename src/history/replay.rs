//! A recording run again, without a past of its own.

use std::sync::Arc;

use super::command::Entry;
use super::error::{HistoryError, Refusal};
use super::frame::Frame;
use super::log::Log;
use super::mark::{Difference, difference};
use super::start::Recording;
use crate::picture::{Skin, Tint};
use crate::scene::record::RecordError;
use crate::scene::{LabelKeys, Scene};
use crate::sim::Dynamics;

/// Steps between two looks at whether the motion is finite.
const LOOK_EVERY: u32 = 256;

/// A world that is led by commands, one after another.
pub struct Replay {
    frame: Frame,
    scene: Scene,
    label: String,
    steps: u32,
    /// Whether commands that cannot be done are passed over.
    is_lenient: bool,
}

impl Replay {
    /// The world at the start of a recording, whatever its commands; `label` stands for the file in messages.
    ///
    /// Errors: a scene that cannot be run, a state that cannot be gone on from.
    pub fn new(head: &Recording, label: &str) -> Result<Self, HistoryError> {
        let (frame, scene) = (head.begin(label)?, head.scene.clone());
        Ok(Replay { frame, scene, label: label.to_owned(), steps: 0, is_lenient: false })
    }

    /// A world of a scene that has followed commands to somewhere, and passes over those that cannot be done, as a [`super::History`] does.
    pub(super) fn of(frame: Frame, scene: &Scene) -> Self {
        Replay { frame, scene: scene.clone(), label: scene.name().to_owned(), steps: 0, is_lenient: true }
    }

    /// The world as it is now.
    pub fn world(&self) -> &dyn Dynamics {
        &*self.frame.world
    }

    /// What is drawn on triangles now.
    pub fn skins(&self) -> Vec<Skin> {
        self.frame.dress.skins(&*self.frame.world)
    }

    /// Which body points are of, and what colour it has.
    pub fn tints(&self) -> &[Tint] {
        self.frame.dress.tints()
    }

    /// The words that stand in the world now, those of points that are gone too.
    pub fn labels(&self) -> &Arc<Vec<LabelKeys>> {
        self.frame.dress.labels()
    }

    /// A recording that begins at the present state.
    ///
    /// Errors: in words, why the state cannot be kept.
    pub fn snapshot(&self) -> Result<Recording, String> {
        Recording::snapshot(&self.scene, &self.frame)
    }

    /// Steps to the time of a command, which ends a step, and does it.
    ///
    /// Errors: it cannot be done; the motion leaves the finite numbers.
    pub fn follow(&mut self, number: usize, entry: &Entry) -> Result<(), HistoryError> {
        while !self.frame.is_due(entry.at) {
            self.frame.step(Some(entry.at), &self.scene);
            self.look(LOOK_EVERY)?;
        }
        match self.frame.follow(entry, &self.scene) {
            Err(reason) if !self.is_lenient => {
                let refusal = Refusal { number, at: entry.at, reason };
                Err(HistoryError::Refused { label: self.label.clone(), refusal })
            }
            _ => Ok(()),
        }
    }

    /// Takes the steps that end at or before `time` `[s]`, the next command being at `next` `[s]`: what is at `time` is then within
    /// the next step.
    ///
    /// Errors: the motion leaves the finite numbers.
    pub fn reach(&mut self, time: f64, next: Option<f64>) -> Result<(), HistoryError> {
        while self.frame.ends_by(time) {
            self.frame.step(next, &self.scene);
            self.look(LOOK_EVERY)?;
        }
        self.look(1)
    }

    /// Does the commands up to `time` `[s]`, that one's too, and takes the steps that end by then.
    ///
    /// Errors: those of [`Replay::follow`].
    pub fn advance(&mut self, commands: &[Entry], time: f64) -> Result<(), HistoryError> {
        while let Some(entry) = commands.get(self.frame.place).filter(|entry| entry.at <= time) {
            self.follow(self.frame.place, entry)?;
        }
        self.reach(time, commands.get(self.frame.place).map(|entry| entry.at))
    }

    /// Whether what is to be done at `at` `[s]` is to be done now.
    pub fn is_due(&self, at: f64) -> bool {
        self.frame.is_due(at)
    }

    /// Takes one step; where it would go beyond the next command, at `next` `[s]`, it ends there.
    pub fn step(&mut self, next: Option<f64>) {
        self.frame.step(next, &self.scene);
    }

    /// Looks whether the motion is finite, every so many times.
    fn look(&mut self, every: u32) -> Result<(), HistoryError> {
        self.steps = self.steps.wrapping_add(1);
        if self.steps.is_multiple_of(every) && !self.frame.world.is_finite() {
            return Err(RecordError::NotFinite { time: self.frame.world.time() }.into());
        }
        Ok(())
    }
}

/// What is done with a world at a time that was asked for, which lies within its next step; true to go on.
pub type Visit<'a> = &'a mut dyn FnMut(&Replay, f64) -> Result<bool, HistoryError>;

/// Runs a recording and visits it at `times` `[s]`, which ascend: after all commands of each. Commands are read one by one from
/// `commands`, those of `head` are not looked at.
///
/// Errors: those of [`Replay::follow`], and of `visit`.
pub fn replay(head: &Recording, commands: &Log, times: &[f64], visit: Visit<'_>) -> Result<(), HistoryError> {
    let mut run = Replay::new(head, commands.label())?;
    let mut left = times;
    let mut goes_on = true;
    commands.each(&mut |number, entry| {
        while let Some((&time, after)) = left.split_first().filter(|(time, _)| **time < entry.at) {
            run.reach(time, Some(entry.at))?;
            left = after;
            goes_on = visit(&run, time)? && !left.is_empty();
            if !goes_on {
                return Ok(false);
            }
        }
        run.follow(number, &entry)?;
        Ok(true)
    })?;
    for &time in left {
        if !goes_on {
            break;
        }
        run.reach(time, None)?;
        goes_on = visit(&run, time)?;
    }
    Ok(())
}

/// Runs a session's file to where its last state was kept beside it: when that was `[s]`, and where the two differ most, if they do.
/// `None`: there is no such state.
///
/// Errors: those of [`replay`].
pub fn apart_from_last(log: &Log) -> Result<Option<(f64, Option<Difference>)>, HistoryError> {
    let Some((last, place)) = log.last() else { return Ok(None) };
    let time = last.world().time();
    let mut run = Replay::new(log.head()?, log.label())?;
    let mut next = None;
    log.each(&mut |number, entry| {
        if number < place {
            run.follow(number, &entry)?;
        } else {
            next = Some(entry.at);
        }
        Ok(number < place)
    })?;
    run.reach(time, next)?;
    Ok(Some((time, difference(run.world(), last.world()))))
}
