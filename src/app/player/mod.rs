//! A history on a thread of its own, and the window's side of it.
//!
//! The window asks ([`Order`]) and draws the last state that it was handed ([`Shown`]); it never waits for a step. What it
//! gave up on (another scene, a reset while a step takes long) runs out by itself and is not looked at any more.

mod acts;
mod beside;
#[cfg(test)]
mod beside_tests;
mod keep;
#[cfg(test)]
mod keep_tests;
#[cfg(test)]
mod led_tests;
mod movers;
mod named;
mod order;
mod pace;
mod rungs;
#[cfg(test)]
mod rungs_tests;
mod save;
mod share;
mod shown;
mod softness;
mod stage;
mod stretch;
#[cfg(test)]
mod tests;
mod thread;
#[cfg(test)]
mod warning_tests;
mod watch;
#[cfg(test)]
mod watch_tests;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

pub use acts::Acts;
pub use beside::{Beside, Companions};
pub use keep::Keeping;
pub use movers::{Moved, Movers};
pub use order::{Coming, MethodSetting, Note, Order};
pub use pace::{LONGEST_FRAME, Pace, SINGLE_STEP, STEPPING_BUDGET};
pub use rungs::{Rung, Yielded};
pub(crate) use shown::driven;
pub use shown::{Figures, Latest, Places, Scenery, Shown};
pub use stage::{Stage, too_many_to_meet};
pub use watch::{Apart, EVERY, Measured, Probe, Probed, Probes, REACH};

use crate::history::{Called, Do, HistoryError, Start};
use crate::scene::Scene;
use crate::sim::Cursor;
use keep::Keeper;
use stage::Folded;
use thread::{Beginning, Desk};

/// The window waits so long for a frame's steps before it draws what there was: most are done by then, and the picture is of
/// this frame instead of the last one. Those that take longer are taken while the picture is drawn.
const PATIENCE: Duration = Duration::from_millis(5);
/// An order that is not done by then: a step takes long.
const LONG: Duration = Duration::from_millis(100);
/// A program that ends waits so long for the step under way, after which its files are written.
const LAST: Duration = Duration::from_secs(60);

/// What is new of a history.
#[derive(Debug, Default)]
pub struct News {
    /// There is another state to draw.
    pub is_new: bool,
    /// The history is there now.
    pub opened: Option<Arc<Scene>>,
    /// What became of orders.
    pub notes: Vec<Note>,
    /// Why there is no history.
    pub failure: Option<HistoryError>,
}

/// A history that is played on a thread of its own.
pub struct Player {
    start: Start,
    /// What it is recorded to.
    record: Option<PathBuf>,
    /// What it was saved as last.
    called: Option<String>,
    /// Where its scene lies.
    file: Option<PathBuf>,
    thread: JoinHandle<()>,
    orders: Sender<(u64, Order)>,
    desk: Arc<Desk>,
    shown: Box<Shown>,
    /// The last order, and since when one has not been done.
    serial: u64,
    waiting_since: Option<Instant>,
    /// What leads to another time and is not done yet.
    going: Option<Leaving>,
    /// The last file that was asked for, and by which order.
    written: Option<(u64, PathBuf)>,
    /// Only its start and its log are kept; the order by which that was so last.
    is_folded: bool,
    folded_by: Option<u64>,
    /// Whether it is to play, and the order that said so last.
    playing: bool,
    played_by: u64,
    advances: u64,
    /// The orders of edits that are not known to be saved, and the last one that asked for a file with all of them.
    edits: Vec<u64>,
    saving: u64,
    /// Something was done in it, or undone, since it was opened.
    is_used: bool,
    /// It goes on with a session that was cut off.
    goes_on: bool,
}

/// An order that leads to another time.
struct Leaving {
    serial: u64,
    words: String,
    since: Instant,
    /// The time `[s]`, if nothing else was done since another time was to be gone to that is not there yet.
    to: Option<f64>,
}

/// Another time that is gone to and is not there yet.
#[derive(Clone, Debug, PartialEq)]
pub struct Going {
    /// What is done, in words.
    pub words: String,
    /// For how long already.
    pub since: Duration,
    /// How much of it is worked out, 0 to 1.
    pub share: f32,
    /// The time `[s]`, where it is known before it is there.
    pub to: Option<f64>,
}

impl Player {
    /// Begins; `wake` is called from the thread when there is something new.
    pub fn open(start: Start, keeping: Keeping, wake: impl Fn() + Send + 'static) -> Self {
        let beginning = Beginning::Start(start.clone());
        Player::begin((start, beginning), keeping, wake)
    }

    /// Goes on with a session that was cut off: it is folded, stands at its end once something is asked of it, and was not saved.
    pub fn resume(start: Start, keeping: Keeping, wake: impl Fn() + Send + 'static) -> Self {
        let beginning = Beginning::Folded(Folded::at_end(&start));
        let mut player = Player::begin((start, beginning), keeping, wake);
        (player.is_folded, player.folded_by, player.playing) = (true, Some(0), false);
        (player.edits, player.goes_on) = (vec![0], true);
        player
    }

    fn begin((start, beginning): (Start, Beginning), keeping: Keeping, wake: impl Fn() + Send + 'static) -> Self {
        let (orders, asked) = channel();
        let record = keeping.record.clone();
        let desk = Arc::new(Desk::new(Keeper::new(keeping)));
        let called = start.name().map(str::to_owned);
        desk.keeper().call(Called { name: called, file: None });
        let its = Arc::clone(&desk);
        let playing = !start.recording().paused;
        let thread = std::thread::spawn(move || thread::run(beginning, &asked, &its, wake));
        Player {
            start,
            record,
            called: None,
            file: None,
            thread,
            orders,
            desk,
            shown: Box::default(),
            serial: 0,
            waiting_since: None,
            going: None,
            written: None,
            is_folded: false,
            folded_by: None,
            playing,
            played_by: 0,
            advances: 0,
            edits: Vec::new(),
            saving: 0,
            is_used: false,
            goes_on: false,
        }
    }

    /// Whether it goes on with a session that was cut off, in which nothing was done since.
    pub fn is_resumed(&self) -> bool {
        self.goes_on && !self.is_used
    }

    /// What it began with.
    pub fn start(&self) -> &Start {
        &self.start
    }

    /// Waits for the first state, so long at most.
    pub fn wait_until_open(&mut self, most: Duration) -> News {
        let deadline = Instant::now() + most;
        while Instant::now() < deadline {
            let news = self.poll();
            if news.opened.is_some() || news.failure.is_some() {
                return news;
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        News::default()
    }

    /// Takes what is new.
    pub fn poll(&mut self) -> News {
        let desk = Arc::clone(&self.desk);
        let mut papers = desk.lock();
        self.take(&mut papers)
    }

    /// The same, after a little patience with what was asked last.
    pub fn poll_patiently(&mut self) -> News {
        let desk = Arc::clone(&self.desk);
        let asked = self.waiting_since.map_or(Duration::ZERO, |since| since.elapsed());
        let mut papers = desk.wait_if_soon(self.serial, asked, PATIENCE);
        self.take(&mut papers)
    }

    fn take(&mut self, papers: &mut thread::Papers) -> News {
        // What was laid down before it was folded is not there any more.
        let fresh = papers.fresh.take().filter(|fresh| self.folded_by.is_none_or(|fold| fresh.serial >= fold));
        let is_new = fresh.is_some();
        if let Some(fresh) = fresh {
            papers.spare = Some(std::mem::replace(&mut self.shown, fresh));
        }
        if papers.done >= self.serial {
            self.waiting_since = None;
        }
        self.going.take_if(|going| papers.done >= going.serial || papers.failure.is_some());
        // What could not be done is nothing to save.
        let refused = std::mem::take(&mut papers.refused);
        self.edits.retain(|edit| !refused.contains(edit));
        if is_new && self.shown.serial >= self.played_by {
            self.playing = self.shown.figures.playing;
        }
        let notes = std::mem::take(&mut papers.notes);
        self.is_used |= notes.iter().any(|note| matches!(note, Note::Undone(..) | Note::Redone(..)));
        // The scene is told of when there is something of it to draw.
        let opened = if self.is_open() { papers.scene.take() } else { None };
        News { is_new, opened, notes, failure: papers.failure.take() }
    }

    /// Asks for something. What is folded is worked out again for it, but for the bytes that copies of its world may take, and for
    /// what it is called.
    pub fn ask(&mut self, order: Order) {
        if self.is_folded && matches!(order, Order::Bound(_) | Order::Called) {
            return;
        }
        self.serial += 1;
        let was_unfolding = self.is_unfolding();
        // A file needs no world.
        self.is_folded = matches!(order, Order::Fold) || self.is_folded && matches!(order, Order::Save(_));
        self.waiting_since.get_or_insert_with(Instant::now);
        self.note_going(&order, was_unfolding);
        if let Order::Play(_) | Order::Step(_) | Order::Reset = order {
            self.played_by = self.serial;
        }
        if let Order::Save(path) | Order::Moment(path) | Order::Picture(path, _) | Order::Table(path, _) = &order {
            self.written = Some((self.serial, path.clone()));
        }
        if order.is_edit() {
            self.edits.push(self.serial);
        }
        self.is_used |= order.is_deed();
        if let Order::Save(_) | Order::Moment(_) = order {
            self.saving = self.serial;
        }
        // One whose history could not begin does nothing.
        let _ = self.orders.send((self.serial, order));
    }

    /// A frame's time passes: once for every animation frame.
    pub fn advance(&mut self, wall: f64, cursor: Option<Cursor>, back: bool) {
        self.advances += 1;
        self.ask(Order::Advance { wall, cursor, back });
    }

    /// Commands at the time reached, undone as one if they have a name.
    pub fn give(&mut self, commands: Vec<Do>, edit: Option<&'static str>) {
        self.ask(Order::Give(commands, edit));
    }

    /// Something is set by an edit of this name; if `goes_on`, of the last one.
    pub fn set(&mut self, act: Do, name: &'static str, goes_on: bool) {
        self.ask(if goes_on { Order::GiveOn(act, name) } else { Order::Give(vec![act], Some(name)) });
    }

    /// Plays, or pauses: at once, whatever step is under way.
    pub fn play(&mut self, playing: bool) {
        self.playing = playing;
        self.ask(Order::Play(playing));
    }

    /// It is left: it pauses, and stays folded if it is.
    pub fn stand_still(&mut self) {
        self.playing = false;
        if !self.is_folded {
            self.play(false);
        }
    }

    /// The number of the last order: what is shown is after it once it has that number.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    /// It is left for long: only its start and its log are kept until something is asked of it again.
    pub fn fold(&mut self) {
        if !self.is_folded {
            self.ask(Order::Fold);
            self.folded_by = Some(self.serial);
            let figures = self.shown.figures.clone();
            *self.shown = Shown { figures, ..Shown::default() };
        }
    }

    /// Whether it was folded and is worked out again, or is to be.
    pub fn is_unfolding(&self) -> bool {
        !self.is_folded && self.folded_by.is_some() && !self.is_open()
    }

    /// What leads to another time is shown until it is there. Of times that are gone to one after the other the last one is wanted.
    fn note_going(&mut self, order: &Order, is_unfolding: bool) {
        let Some(words) = order.going() else {
            if let Some(going) = self.going.as_mut().filter(|_| order.is_deed()) {
                going.to = None;
            }
            return;
        };
        let (to, last) = (order.goes_to(), self.going.take());
        if last.is_none() && !is_unfolding {
            self.desk.begin_anew();
        }
        if to.is_some() && last.as_ref().is_some_and(|last| last.to.is_some()) {
            self.desk.supersede_before(self.serial);
        }
        let since = last.as_ref().map_or_else(Instant::now, |last| last.since);
        let to = to.filter(|_| last.is_none_or(|last| last.to.is_some()));
        self.going = Some(Leaving { serial: self.serial, words, since, to });
    }

    /// Another time that is gone to and is not there yet.
    pub fn going(&self) -> Option<Going> {
        let Leaving { words, since, to, .. } = self.going.as_ref()?;
        Some(Going { words: words.clone(), since: since.elapsed(), share: self.worked_out(), to: *to })
    }

    /// Another time is not to be gone to: all stays as it is.
    pub fn stay(&mut self) {
        if let Some(going) = &self.going {
            self.desk.give_up_before(going.serial + 1);
        }
    }

    /// How much of it is worked out again, 0 to 1.
    pub fn worked_out(&self) -> f32 {
        self.desk.worked_out()
    }

    /// It is not to be worked out again: it stays folded until something else is asked of it.
    pub fn stay_folded(&mut self) {
        self.desk.give_up_before(self.serial + 1);
        self.fold();
    }

    /// The last state.
    pub fn shown(&self) -> &Shown {
        &self.shown
    }

    /// Whether it plays, asleep or not.
    pub fn is_playing(&self) -> bool {
        self.playing
    }

    /// Whether time passes: playing and awake; or what stands beside the world is on its way.
    pub fn is_moving(&self) -> bool {
        self.is_open() && (self.playing && !self.shown.figures.asleep || self.shown.figures.behind)
    }

    /// Whether there is a state to draw.
    pub fn is_open(&self) -> bool {
        self.shown.dimensions > 0
    }

    /// Whether something that was asked for has not been done for long.
    pub fn is_busy(&self) -> bool {
        self.waiting_since.is_some_and(|since| since.elapsed() > LONG)
    }

    /// Whether something was built or changed since it was saved last. What is recorded to a file is saved as it is done.
    pub fn is_unsaved(&self) -> bool {
        !self.edits.is_empty() && self.record.is_none()
    }

    /// Whether something was done in it since it was opened, or since this was said of it.
    pub fn is_used(&self) -> bool {
        self.is_used
    }

    /// Says whether something was done in it.
    pub fn say_used(&mut self, is_used: bool) {
        self.is_used = is_used;
    }

    /// What was to be saved last is.
    pub fn note_saved(&mut self) {
        self.edits.retain(|edit| *edit > self.saving);
    }

    /// All of it was saved to a file, by which it is called from now on.
    pub fn call(&mut self, file: &Path) {
        self.called = file.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        self.keep_called();
    }

    /// It is called as the session was that it goes on with.
    pub fn be_called(&mut self, called: Called) {
        self.called = called.name.or(self.called.take());
        if let Some(file) = called.file {
            self.lie_in(&file);
        }
        self.keep_called();
    }

    /// What it is called outlives a killed program too.
    fn keep_called(&mut self) {
        let name = self.called.clone().or_else(|| self.start.name().map(str::to_owned));
        // What no text can hold is not kept.
        let file = self.file.clone().filter(|file| file.to_str().is_some());
        self.desk.keeper().call(Called { name, file });
        self.ask(Order::Called);
    }

    /// What it is called since it was saved.
    pub fn called(&self) -> Option<&str> {
        self.called.as_deref()
    }

    /// Its scene lies in this file: it was opened from there, or saved there. A file that is no scene is not written over with one.
    pub fn lie_in(&mut self, file: &Path) {
        if file.extension().is_some_and(|ending| ending == "json") {
            self.file = std::path::absolute(file).ok();
            self.keep_called();
        }
    }

    /// Where its scene lies: where it is to be saved again.
    pub fn file(&self) -> Option<&Path> {
        self.file.as_deref()
    }

    /// What it is recorded to.
    pub fn record(&self) -> Option<&Path> {
        self.record.as_deref()
    }

    /// The program ends as it should: what it is recorded to is made whole, what was to be written is, and nothing is left behind.
    ///
    /// Errors: a file that is not whole, and in words why.
    pub fn end(&mut self) -> Result<(), (PathBuf, String)> {
        if let Some(path) = self.record.clone() {
            self.ask(Order::Save(path));
        }
        let written = self.wait_for_files();
        // A thread that came to grief left something that may be wanted.
        if !self.thread.is_finished() {
            // A file that cannot be removed is offered at the next start.
            let _ = self.desk.keeper().end();
        }
        written
    }

    /// Waits until the last file that was asked for is written. What came of those before it was told, or is now.
    fn wait_for_files(&mut self) -> Result<(), (PathBuf, String)> {
        let Some((serial, path)) = self.written.take() else { return Ok(()) };
        let papers = self.desk.wait_for(serial, LAST);
        let failed = papers.notes.iter().rev().find_map(|note| match note {
            Note::NotWritten(why) => Some(why.clone()),
            _ => None,
        });
        match failed {
            Some(why) => Err((path, why)),
            None if papers.done < serial && papers.failure.is_none() => Err((path, "a step takes too long".to_owned())),
            None => Ok(()),
        }
    }

    /// The program gives up: what was written of the session stays.
    pub fn leave(&self) {
        self.desk.keeper().leave();
    }

    /// Frames' times that were asked for.
    pub fn advances(&self) -> u64 {
        self.advances
    }
}

impl Drop for Player {
    /// Nobody goes back to it any more; a program that breaks down leaves it as it is.
    fn drop(&mut self) {
        if !std::thread::panicking() {
            self.desk.dismiss();
        }
    }
}
