//! Commands that change what a world is made of, between two of its steps.
//!
//! A command is looked at first and done afterwards: one that cannot be done leaves the world whole. Islands that it touches are compiled
//! anew from the state that they have ([`recompile`]); all others stay as they are, bit for bit.

mod add;
mod carry;
mod caught;
mod check;
mod crowd;
mod cut;
mod delete;
mod drives;
mod fit;
mod forces;
mod freeze;
mod grab;
mod overlap;
mod pins;
mod push;
#[cfg(test)]
mod push_tests;
mod recompile;
mod round;
mod segments;
mod set;
mod settings;
mod shift;
mod split;
mod whole;

use super::bond::PointId;
use super::command::{Applied, Command, CommandError, Selection};
use super::environment::CursorPath;
use super::force::mouse::Cursor;
use super::real::Real;
use super::world::World;
pub(crate) use round::blocked;
pub(crate) use segments::{segments_meet, segments_pass};

/// A command that was done, and changed something or had nothing to do.
fn done(is_something: bool) -> Applied {
    Applied { is_something, ..Applied::default() }
}

fn invalid(message: impl Into<String>) -> CommandError {
    CommandError::Invalid(message.into())
}

impl<S: Real, const D: usize> World<S, D> {
    /// Does a command, or says why it cannot be done: see [`Dynamics::apply`](super::dynamics::Dynamics::apply).
    pub(crate) fn edit(&mut self, command: &Command) -> Result<Applied, CommandError> {
        if self.frozen.is_empty() {
            return self.do_command(command);
        }
        let before = self.clone();
        self.thaw_for(command);
        self.do_command(command).inspect_err(|_| *self = before)
    }

    fn do_command(&mut self, command: &Command) -> Result<Applied, CommandError> {
        match command {
            Command::Cursor { to, by } => self.lead_cursor(*to, *by),
            Command::Mouse(change) => self.change_mouse(change),
            Command::Grab(reach) => self.take_hold(reach),
            Command::Release => Ok(self.release()),
            Command::Key { key, down } => Ok(self.press(*key, *down)),
            Command::Pin(points) => self.pin(points),
            Command::Unpin(points) => self.unpin(points),
            Command::Cut { from, to } => self.cut([*from, *to]),
            Command::Split { points, bonds } => self.split(points, bonds),
            Command::Add(addition) => self.add(addition),
            Command::Delete(selection) => self.delete(selection),
            Command::Clear => self.delete(&self.everything()),
            Command::Move(motion) => self.shift(motion),
            Command::Set(change) => self.set(change),
        }
    }

    fn everything(&self) -> Selection {
        Selection {
            points: (0..self.count() as u32).filter(|&i| !self.numbers.is_gone(i)).map(PointId).collect(),
            bonds: Vec::new(),
            obstacles: self.numbers.obstacles.iter().flatten().copied().collect(),
            forces: self.numbers.forces.clone(),
            angles: Vec::new(),
        }
    }

    fn lead_cursor(&mut self, to: Option<Cursor>, by: f64) -> Result<Applied, CommandError> {
        let t = self.timeline.time();
        let numbers = to.iter().flat_map(|to| to.origin.iter().chain(&to.direction));
        if by.is_nan() || !numbers.copied().all(f64::is_finite) {
            return Err(invalid("`to` and `by` must be finite numbers"));
        }
        let was_reached = self.kept_in_reach();
        self.around.cursor = to.map(|to| CursorPath::onwards(self.around.cursor, to, t, by));
        self.refresh(was_reached);
        Ok(done(true))
    }

    /// The cursor or its force changed: nothing that was worked out before belongs to the present. `was_reached`: the kept groups that
    /// the mouse could reach before.
    fn refresh(&mut self, was_reached: Vec<usize>) {
        let t = self.timeline.time();
        was_reached.into_iter().chain(self.kept_in_reach()).for_each(|place| self.touch(place));
        self.tell_kept();
        for group in &mut self.plan.groups {
            group.wake_if_reached(&self.around, t);
            group.mark_inside(&self.around, t);
        }
    }
}
