//! From wall time to whole substeps: how many are due, and where the cursor goes meanwhile.

use crate::history::{Clock, Do, GivenUp, GoneBack, History};
use crate::sim::{Cursor, Dynamics};

use super::shown::Places;
use super::watch::Watch;

/// Longest wall time that one frame makes up for `[s]`: after a hitch (a dragged window, a laptop that slept) the rest is
/// dropped, so that nothing is thrown about.
pub const LONGEST_FRAME: f64 = 0.1;
/// Wall time that one frame may spend on stepping `[s]`: a scene too slow for real time plays slower, at a usable frame
/// rate, instead of falling behind ever more.
pub const STEPPING_BUDGET: f64 = 0.025;
/// What a single step by hand advances `[s of wall time at the scene's rate]`.
pub const SINGLE_STEP: f64 = 1.0 / 60.0;
/// A substep is due when all but this share of it has passed: sums of frame times round.
const ROUNDING: f64 = 1e-9;

/// The clock of a history: it plays or not, at some rate, until an end if it has one.
///
/// The physics does not depend on the frame rate: frames only decide how many substeps are due.
#[derive(Clone, Debug)]
pub struct Pace {
    /// Scene time that is due but not stepped yet `[s]`.
    due: f64,
    /// Seconds of the scene a second of wall time.
    pub rate: f64,
    /// Where the scene ends by itself `[s]`.
    duration: Option<f64>,
    /// Whether it has ended there: from then on it goes on without end.
    pub ended: bool,
    /// Whether time passes.
    pub playing: bool,
    /// Where the live cursor was told to go last.
    told: Option<Option<Cursor>>,
    /// It is elsewhere in the world than it was told last: it is where it goes at once.
    jumps: bool,
    /// The hand presses: what was done before is not followed any more when the cursor moves.
    pub presses: bool,
    /// The hand leads since the history came here: nothing that it held in the log is held any more.
    pub is_taken: bool,
    /// Positions before the last substep.
    pub previous: Places,
    /// When that was `[s]`.
    previous_time: f64,
    /// Time that was due in the last frame was dropped.
    pub is_late: bool,
    /// What is measured as time is stepped.
    pub(super) watch: Watch,
    /// Changes whenever positions did.
    pub motion: u64,
}

impl Pace {
    /// Plays `history` from where it is at `rate` seconds a second, until `duration` `[s]` if there is one.
    pub fn new(history: &History, rate: f64, duration: Option<f64>) -> Self {
        let mut previous = Places::default();
        previous.copy(history.world().positions());
        Pace {
            due: 0.0,
            rate,
            duration,
            ended: false,
            playing: true,
            told: None,
            jumps: false,
            presses: false,
            is_taken: false,
            previous,
            previous_time: history.world().time(),
            is_late: false,
            watch: Watch::default(),
            motion: 1,
        }
    }

    /// Lets `wall` seconds pass while the cursor goes to where it is now, and takes the substeps that are due; returns how many.
    ///
    /// The cursor's way is that of the frame's own time, the part of it included that is shorter than a substep: so the way
    /// does not depend on where frames cut it.
    /// `elapsed` tells the wall time `[s]` spent since the frame began: past [`STEPPING_BUDGET`] the rest is dropped.
    pub fn advance(
        &mut self,
        history: &mut History,
        wall: f64,
        cursor: Option<Cursor>,
        mut elapsed: impl FnMut() -> f64,
    ) -> u32 {
        self.is_late = false;
        if !self.playing {
            return 0;
        }
        let wall = wall.clamp(0.0, LONGEST_FRAME) * self.rate;
        self.take_over(history);
        let is_told = self.tell(history, cursor, history.world().time() + self.due + wall);
        if history.rests() {
            // A world that did not move does not make up for the pause.
            self.due = 0.0;
            self.motion += u64::from(is_told);
            return 0;
        }
        self.due += wall;
        let mut substeps = 0;
        while self.is_due(history) {
            if substeps > 0 && elapsed() > STEPPING_BUDGET {
                self.is_late = true;
                self.settle(history);
                break;
            }
            self.step_once(history);
            substeps += 1;
            if history.rests() {
                self.settle(history);
            } else if !self.ended && self.duration.is_some_and(|end| history.world().time() >= end) {
                self.playing = false;
                self.ended = true;
                self.settle(history);
            }
        }
        substeps
    }

    /// The hand leads from here on, unless the log is followed: what was led when it was done first is led by nobody now.
    pub fn take_over(&mut self, history: &mut History) {
        if !self.is_taken && !history.has_future() {
            self.is_taken = true;
            // A world that refuses it goes on as it is.
            self.motion += u64::from(history.give(history.letting_go(), None).is_ok_and(|done| !done.is_empty()));
        }
    }

    /// It is played at another rate, and ends elsewhere `[s]`: where that has passed, with the next step.
    pub(super) fn follow(&mut self, from: Clock, to: Clock) {
        self.rate *= to.rate / from.rate;
        if to.duration != self.duration {
            (self.duration, self.ended) = (to.duration, false);
        }
    }

    /// Sends the cursor on its way, unless it has been told to. Returns whether it was told something new. A log that is followed has
    /// the cursor of its own, until the hand presses.
    fn tell(&mut self, history: &mut History, cursor: Option<Cursor>, by: f64) -> bool {
        if history.has_future() && !self.presses {
            self.jumps = true;
            return false;
        }
        if self.told == Some(cursor) {
            return false;
        }
        self.told = Some(cursor);
        if cursor.is_none() && history.world().cursor().is_none() {
            return false;
        }
        let by = (!std::mem::take(&mut self.jumps)).then(|| by.max(history.world().time()));
        let mut commands = if history.has_future() { history.letting_go() } else { Vec::new() };
        commands.push(Do::Cursor { to: cursor, by: by.filter(|_| cursor.is_some()) });
        self.is_taken = true;
        // A world that refuses a cursor goes on without.
        history.give(commands, None).is_ok()
    }

    /// The cursor is where it is told to go next at once.
    pub fn jump(&mut self) {
        self.jumps = true;
    }

    /// The cursor stays where the history has it until it moves again: what was done once is not done anew because a cursor
    /// rests elsewhere now.
    pub fn forget_cursor(&mut self, cursor: Option<Cursor>) {
        self.told = Some(cursor);
    }

    fn is_due(&self, history: &History) -> bool {
        self.due >= history.world().substep() * (1.0 - ROUNDING)
    }

    /// One substep. Only the last one of a frame needs the positions before it.
    fn step_once(&mut self, history: &mut History) {
        self.due -= history.world().substep();
        if self.due < history.world().substep() {
            self.previous.copy(history.world().positions());
            self.previous_time = history.world().time();
        }
        history.step();
        self.watch.note(history.world());
        self.motion += 1;
    }

    /// Nothing is due any more: what is drawn is the present state.
    pub fn settle(&mut self, history: &History) {
        self.due = 0.0;
        self.previous.copy(history.world().positions());
        self.previous_time = history.world().time();
        self.motion += 1;
    }

    /// Pauses and goes on by one frame's worth of substeps, at least one. Returns how many.
    pub fn step(&mut self, history: &mut History, cursor: Option<Cursor>) -> u64 {
        self.playing = false;
        let substeps = (SINGLE_STEP * self.rate / history.world().substep()).round().max(1.0) as u32;
        let span = f64::from(substeps) * history.world().substep();
        self.take_over(history);
        self.tell(history, cursor, history.world().time() + span);
        for _ in 0..substeps {
            history.step();
            self.watch.note(history.world());
        }
        self.settle(history);
        u64::from(substeps)
    }

    /// Time runs back by so much wall time.
    pub fn rewind(&mut self, history: &mut History, wall: f64, cursor: Option<Cursor>) {
        let back = wall.clamp(0.0, LONGEST_FRAME) * self.rate;
        self.go_to(history, history.world().time() - back.max(history.world().substep()), cursor);
    }

    /// The state at a time that was seen already.
    pub fn go_to(&mut self, history: &mut History, time: f64, cursor: Option<Cursor>) {
        _ = self.go_to_while((history, time), cursor, |_| true);
    }

    /// The same, as long as `goes_on` says so, as of [`History::go_to_while`].
    ///
    /// Errors: it was given up; all is as it was.
    pub fn go_to_while(
        &mut self,
        (history, time): (&mut History, f64),
        cursor: Option<Cursor>,
        goes_on: impl FnMut(f64) -> bool,
    ) -> Result<(), GivenUp> {
        history.go_to_while(time.max(0.0), goes_on)?;
        self.gone_to(history, cursor);
        Ok(())
    }

    /// The history went elsewhere: what is drawn is where it is now.
    pub fn gone_to(&mut self, history: &History, cursor: Option<Cursor>) {
        self.ended = self.duration.is_some_and(|end| history.world().time() >= end);
        self.forget_cursor(cursor);
        (self.jumps, self.is_taken) = (true, false);
        self.settle(history);
    }

    /// The history went elsewhere, and goes on by hand: the live cursor takes the place of the log's, though it rests.
    pub fn gone_for_good(&mut self, history: &History, cursor: Option<Cursor>) {
        self.gone_to(history, cursor);
        self.told = None;
    }

    /// Back to the start, as long as `goes_on` says so. What came to its end plays again. Returns what became of edits.
    ///
    /// Errors: it was given up.
    pub fn reset_while(
        &mut self,
        history: &mut History,
        goes_on: impl FnMut(f64) -> bool,
    ) -> Result<GoneBack, GivenUp> {
        let had_ended = self.ended || self.duration.is_some_and(|end| history.world().time() >= end);
        let edits = history.reset_while(goes_on)?;
        self.playing |= had_ended;
        self.ended = false;
        (self.told, self.jumps, self.is_taken) = (None, true, false);
        self.settle(history);
        Ok(edits)
    }

    /// Whether it stands where it ended by itself: not where it was paused later, for it goes on from there.
    pub fn is_at_end(&self, history: &History) -> bool {
        let world = history.world();
        self.ended && self.duration.is_some_and(|end| world.time() < end + world.substep())
    }

    /// Whether time passes: playing and awake.
    pub fn is_moving(&self, history: &History) -> bool {
        self.playing && !history.rests()
    }

    /// The times of the last two states, between which the picture lies; the same where nothing is between them `[s]`.
    pub fn states(&self, history: &History) -> [f64; 2] {
        [self.previous_time, history.world().time()]
    }

    /// The time of what is drawn, between the last two states `[s]`.
    pub fn shown_time(&self, history: &History) -> f64 {
        let time = history.world().time();
        self.previous_time + f64::from(self.mix(history.world())) * (time - self.previous_time)
    }

    /// How far between the last two states the picture lies, 0 to 1.
    pub fn mix(&self, world: &dyn Dynamics) -> f32 {
        let mix = if self.due > 0.0 { self.due / world.substep() } else { 1.0 };
        mix.clamp(0.0, 1.0) as f32
    }
}
