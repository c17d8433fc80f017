//! Time that passes, and what gives way where steps take too much of it.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::super::movers::{EXACT, exact};
use super::super::order::Note;
use super::super::pace::SINGLE_STEP;
use super::super::rungs::{Load, Rung};
use super::Stage;
use crate::history::Do;
use crate::sim::Cursor;

/// What is dragged is dragged on for so long after it was sent on its way last, in time of the wall `[s]`.
const DRAGS: f64 = 0.5;
/// What gave way is given back once the scene was paused for so long: who pauses for a moment goes on as before.
const PAUSED: Duration = Duration::from_secs(2);

impl Stage {
    /// Lets time pass.
    pub(super) fn advance(&mut self, wall: f64, cursor: Option<Cursor>) {
        let (start, before) = (Instant::now(), self.history.world().time());
        let substeps = self.pace.advance(&mut self.history, wall, cursor, || start.elapsed().as_secs_f64());
        self.substeps += u64::from(substeps);
        let beside = self.escort.come(&mut self.history, &mut self.pace, wall);
        let (steps, gone) = (start.elapsed().as_secs_f64(), self.history.world().time() - before);
        if substeps > 0 {
            self.steps.push(steps);
            let work = SINGLE_STEP * (steps - beside) * self.pace.rate / gone;
            let world = self.history.world();
            self.works.push(work);
            self.costs.push(work / (world.point_count() - world.gone().len()).max(1) as f64);
        }
        if wall > 0.0 && self.pace.is_moving(&self.history) {
            self.reached.push(gone / (wall * self.pace.rate));
            self.give_way(Load { wall, steps, is_late: self.pace.is_late, work: self.works.value() });
        }
        // It fell asleep or came to its end.
        if substeps > 0 && !self.pace.is_moving(&self.history) && !self.is_dragging() {
            self.give_back();
        }
    }

    /// Another rate or another end is gone by at once.
    pub(super) fn keep_time(&mut self) {
        let clock = self.history.clock();
        self.pace.follow(std::mem::replace(&mut self.clock, clock), clock);
    }

    /// Where time passes no more, what gave way is given back. Returns whether anything was.
    fn give_back(&mut self) -> bool {
        let Some((act, name)) = self.rungs.rest(&self.history) else { return false };
        self.give_aside(act, name);
        true
    }

    /// Notes when what gave way is to be given back, should nothing be asked for until then and no time pass.
    pub(super) fn note_pause(&mut self) {
        let waits = !self.pace.is_moving(&self.history) && self.rungs.yielded(&self.history).is_some();
        self.gives_back_at = waits.then(|| Instant::now() + PAUSED);
    }

    /// How long until something is to be done though nothing is asked for; `None`: nothing is.
    pub fn patience(&self) -> Option<Duration> {
        let next = self.gives_back_at.into_iter().chain(self.relaxed.due()).min();
        next.map(|at| at.saturating_duration_since(Instant::now()))
    }

    /// Nothing was asked for until `now`. Returns whether something was done.
    pub fn idle(&mut self, now: Instant) -> bool {
        // Figures are looked at anew when the moment is shown.
        let looks = self.relaxed.due().is_some_and(|at| at <= now);
        if looks {
            self.figures_at = None;
        }
        if self.gives_back_at.is_none_or(|at| now < at) {
            return looks;
        }
        self.gives_back_at = None;
        self.give_back() || looks
    }

    /// Where steps took too long for a while, something gives way; it is given back where they do no more.
    pub(in crate::app::player) fn give_way(&mut self, load: Load) {
        // Companions wait first.
        if self.escort.gives_way(&self.history, load) {
            return;
        }
        // An edit of its own would part the drag in two.
        if self.is_dragging() {
            return;
        }
        let Some((act, name)) = self.rungs.look(&self.history, load) else { return };
        self.give_aside(act, name);
    }

    fn give_aside(&mut self, act: Do, name: &'static str) {
        // Nobody asked for it: it is in the log, and no step of undo.
        if self.history.give_aside(act, name).is_err() {
            // A world that cannot be moved so goes on as it is.
            Rung::of(name).into_iter().for_each(|rung| self.rungs.refuse(rung));
        }
        self.pace.motion += 1;
        self.figures_at = None;
    }

    /// Whether obstacles or pins were sent on their way just now.
    pub(super) fn is_dragging(&self) -> bool {
        let now = self.history.world().time();
        self.led_at.is_some_and(|last| (0.0..DRAGS * self.pace.rate).contains(&(now - last)))
    }

    /// Every island is moved by its own method from now on.
    pub(super) fn make_exact(&mut self) -> Option<Note> {
        let note = self.give(vec![exact(&self.history)], Some(EXACT));
        (self.figures_at, self.movers) = (None, Arc::default());
        note.or(Some(Note::Exact))
    }

    /// What gave way is taken back.
    pub(super) fn take_back(&mut self) -> Option<Note> {
        self.rungs.yielded(&self.history)?;
        let (act, name) = self.rungs.back(&self.history);
        self.rungs.refuse_all();
        self.figures_at = None;
        self.give(vec![act], Some(name))
    }
}
