//! The thread that steps: takes orders, hands out what there is to see, and never waits for the window.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::LONG;
use super::keep::Keeper;
use super::order::{Note, Order};
use super::save;
use super::share::Share;
use super::shown::Shown;
use super::stage::{Folded, Stage};
use crate::history::{HistoryError, Start};
use crate::scene::Scene;

/// So much of what an order waits for that goes to another time of what was folded is its being worked out again: copies are kept on the way.
const UNFOLDING: f32 = 0.9;

/// What thread and window share: the last state, and what is to be said.
#[derive(Default)]
pub(super) struct Desk {
    papers: Mutex<Papers>,
    answered: Condvar,
    /// What writes the log. It is held while it writes, never while a step is taken.
    keeper: Mutex<Keeper>,
    /// The window has done with the history: nothing of it need be left.
    is_dismissed: AtomicBool,
    /// Orders before this one are not wanted any more, but for files: what is being worked out anew for them is left.
    given_up: AtomicU64,
    /// Another time is gone to by an order that is not the first of its kind: those before are not wanted, once they take long.
    superseded: AtomicU64,
    /// How much of a history is worked out that was folded, or of another time that is gone to.
    worked_out: Share,
}

/// What lies on the desk.
#[derive(Default)]
pub(super) struct Papers {
    /// The last state, until the window takes it.
    pub(super) fresh: Option<Box<Shown>>,
    /// One that the window has done with.
    pub(super) spare: Option<Box<Shown>>,
    /// What became of orders.
    pub(super) notes: Vec<Note>,
    /// The start scene, once the history is there.
    pub(super) scene: Option<Arc<Scene>>,
    /// Why there is none.
    pub(super) failure: Option<HistoryError>,
    /// The last order that was done.
    pub(super) done: u64,
    /// How long it took, with what was asked beside it.
    pub(super) took: Duration,
    /// Orders that were refused, until the window knows.
    pub(super) refused: Vec<u64>,
}

impl Desk {
    pub(super) fn new(keeper: Keeper) -> Self {
        Desk { keeper: Mutex::new(keeper), ..Desk::default() }
    }

    pub(super) fn keeper(&self) -> MutexGuard<'_, Keeper> {
        self.keeper.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn dismiss(&self) {
        self.is_dismissed.store(true, Ordering::Release);
    }

    /// What was asked before this order is not wanted any more, but for files, where it would have to be worked out anew.
    pub(super) fn give_up_before(&self, serial: u64) {
        self.given_up.store(serial, Ordering::Release);
    }

    fn is_given_up(&self, serial: u64) -> bool {
        self.is_dismissed.load(Ordering::Acquire) || serial < self.given_up.load(Ordering::Acquire)
    }

    /// How much of a history that was folded is worked out again, or of another time that is gone to, 0 to 1.
    pub(super) fn worked_out(&self) -> f32 {
        self.worked_out.read()
    }

    /// Something else is to be worked out: nothing of it is there yet.
    pub(super) fn begin_anew(&self) {
        self.worked_out.begin(1.0);
    }

    /// Times that orders before this one go to are not wanted any more.
    pub(super) fn supersede_before(&self, serial: u64) {
        self.superseded.store(serial, Ordering::Release);
    }

    /// Works out what was folded, for an order. `Ok(None)`: that was given up meanwhile.
    fn unfold(&self, folded: &Folded, (serial, order): (u64, &Order)) -> Result<Option<Stage>, HistoryError> {
        self.worked_out.begin(if order.going().is_some() { UNFOLDING } else { 1.0 });
        let stage = Stage::unfolded(folded, |share| {
            self.worked_out.tell(share);
            !self.is_given_up(serial)
        });
        self.worked_out.go_on();
        stage
    }

    /// Does what is asked, as long as it is wanted: another time that takes long to be worked out can be given up.
    fn obey(&self, stage: &mut Stage, (serial, order): (u64, Order), notes: &mut Vec<Note>) {
        let (begun, is_time) = (Instant::now(), order.goes_to().is_some());
        let is_superseded = || is_time && serial < self.superseded.load(Ordering::Acquire);
        // One that is under way may soon be there.
        let patience = if is_superseded() { Duration::ZERO } else { LONG };
        let is_left = || self.is_given_up(serial) || is_superseded() && begun.elapsed() >= patience;
        let note = stage.obey_while(order, &mut |share| {
            self.worked_out.tell(share);
            !is_left()
        });
        let is_told = note != Some(Note::GivenUp) || self.is_given_up(serial);
        notes.extend(note.filter(|_| is_told));
        notes.extend(stage.take_warnings());
    }

    pub(super) fn lock(&self) -> MutexGuard<'_, Papers> {
        self.papers.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until an order is done, so long at most.
    pub(super) fn wait_for(&self, serial: u64, most: Duration) -> MutexGuard<'_, Papers> {
        let is_open = |papers: &mut Papers| papers.done < serial && papers.failure.is_none();
        let waited = self.answered.wait_timeout_while(self.lock(), most, is_open);
        waited.unwrap_or_else(PoisonError::into_inner).0
    }

    /// The same, but not at all for one that was asked for so long ago and would take longer, as the last one did.
    pub(super) fn wait_if_soon(&self, serial: u64, asked: Duration, most: Duration) -> MutexGuard<'_, Papers> {
        let papers = self.lock();
        if papers.took > asked + most {
            return papers;
        }
        drop(papers);
        self.wait_for(serial, most)
    }

    /// Tells of a history that is there now, or of why there is none.
    fn open(&self, stage: Result<Stage, HistoryError>) -> Option<Stage> {
        let mut papers = self.lock();
        match stage {
            Ok(stage) => {
                papers.scene = Some(Arc::new(stage.history().scene().clone()));
                Some(stage)
            }
            Err(error) => {
                papers.failure = Some(error);
                drop(papers);
                self.answered.notify_all();
                None
            }
        }
    }

    /// Lays a state down, if there is one, of orders that were begun then. Returns whether the one before had been taken: else the window knows already that there is
    /// something.
    fn lay(&self, seat: &mut Seat, (done, notes): (u64, Vec<Note>), begun: Option<Instant>) -> bool {
        let mut shown = match seat {
            Seat::Played(stage) => {
                let mut shown = self.lock().spare.take().unwrap_or_default();
                stage.show(&mut shown);
                shown.serial = done;
                Some(shown)
            }
            Seat::Folded(_) => None,
        };
        let mut papers = self.lock();
        if let (Some(shown), Some(unseen)) = (&mut shown, &papers.fresh) {
            shown.follow_unseen(unseen);
        }
        papers.done = done;
        papers.took = begun.map_or(papers.took, |begun| begun.elapsed());
        let is_news = shown.is_some() && papers.fresh.is_none() || !notes.is_empty();
        papers.notes.extend(notes);
        papers.spare = if shown.is_some() { std::mem::replace(&mut papers.fresh, shown) } else { None };
        drop(papers);
        self.answered.notify_all();
        is_news
    }
}

/// What a history begins with.
pub(super) enum Beginning {
    Start(Start),
    /// It is worked out once something is asked of it.
    Folded(Folded),
}

/// Makes the history and plays it until nobody asks any more.
pub(super) fn run(beginning: Beginning, orders: &Receiver<(u64, Order)>, desk: &Desk, wake: impl Fn()) {
    let mut seat = match beginning {
        Beginning::Start(start) => {
            let Some(stage) = desk.open(Stage::new(start)) else { return wake() };
            Seat::Played(Box::new(stage))
        }
        Beginning::Folded(folded) => Seat::Folded(Box::new(folded)),
    };
    let mut done = 0;
    desk.lay(&mut seat, (done, Vec::new()), None);
    wake();
    loop {
        if let Seat::Played(stage) = &mut seat {
            let note = desk.keeper().keep(stage.history());
            if note.is_some() && desk.lay(&mut seat, (done, note.into_iter().collect()), None) {
                wake();
            }
        }
        let patience = if let Seat::Played(stage) = &seat { stage.patience() } else { None };
        let wait = desk.keeper().wait().into_iter().chain(patience).min();
        let list = match next(orders, wait) {
            Next::Orders(list) => list,
            Next::Late => {
                let is_news = match &mut seat {
                    Seat::Played(stage) => stage.idle(Instant::now()),
                    Seat::Folded(_) => false,
                };
                if is_news && desk.lay(&mut seat, (done, Vec::new()), None) {
                    wake();
                }
                continue;
            }
            Next::Nobody => break,
        };
        let (mut notes, begun) = (Vec::new(), Instant::now());
        for (serial, order) in list {
            desk.keeper().hear(&order);
            let is_edit = order.is_edit();
            let told = notes.len();
            let Some(next) = seat.obey((serial, order), desk, &mut notes) else { return wake() };
            let is_refused = notes[told..].iter().any(|note| matches!(note, Note::Refused(_) | Note::Held));
            if is_refused || matches!(next, Seat::Folded(_)) && is_edit {
                desk.lock().refused.push(serial);
            }
            seat = next;
            done = serial;
        }
        if desk.lay(&mut seat, (done, notes), Some(begun)) {
            wake();
        }
    }
    if desk.is_dismissed.load(Ordering::Acquire) {
        // A file that cannot be removed is offered at the next start: nobody is there to be told now.
        let _ = desk.keeper().end();
    }
}

/// A history on its thread.
enum Seat {
    Played(Box<Stage>),
    Folded(Box<Folded>),
}

impl Seat {
    /// Does what is asked. `None`: what was folded cannot be played any more.
    fn obey(self, (serial, order): (u64, Order), desk: &Desk, notes: &mut Vec<Note>) -> Option<Seat> {
        let mut stage = match (self, &order) {
            (seat @ Seat::Folded(_), Order::Fold) => return Some(seat),
            (Seat::Folded(folded), Order::Save(path)) => {
                notes.push(save::recording(folded.start.recording(), path.clone()));
                return Some(Seat::Folded(folded));
            }
            (Seat::Played(stage), Order::Fold) => {
                notes.extend(desk.keeper().keep_now(stage.history()));
                desk.lock().fresh = None;
                return Some(Seat::Folded(Box::new(stage.folded())));
            }
            (Seat::Folded(folded), _) if desk.is_given_up(serial) => return Some(Seat::Folded(folded)),
            (Seat::Folded(folded), order) => match desk.unfold(&folded, (serial, order)) {
                Ok(None) => return Some(Seat::Folded(folded)),
                Ok(Some(stage)) => Box::new(desk.open(Ok(stage))?),
                Err(error) => Box::new(desk.open(Err(error))?),
            },
            (Seat::Played(stage), order) => {
                if order.going().is_some() {
                    desk.begin_anew();
                }
                stage
            }
        };
        desk.obey(&mut stage, (serial, order), notes);
        Some(Seat::Played(stage))
    }
}

/// What comes next.
enum Next {
    Orders(Vec<(u64, Order)>),
    /// Nothing came in the time given.
    Late,
    /// Nobody asks any more.
    Nobody,
}

/// Waits for orders, so long at most.
fn next(orders: &Receiver<(u64, Order)>, most: Option<Duration>) -> Next {
    let first = match most {
        None => orders.recv().map_err(|_| RecvTimeoutError::Disconnected),
        Some(most) => orders.recv_timeout(most),
    };
    let mut list = match first {
        Ok(order) => vec![order],
        Err(RecvTimeoutError::Timeout) => return Next::Late,
        Err(RecvTimeoutError::Disconnected) => return Next::Nobody,
    };
    loop {
        match orders.try_recv() {
            Ok(order) => list.push(order),
            Err(TryRecvError::Empty) => return Next::Orders(merged(list)),
            Err(TryRecvError::Disconnected) => {
                // A window that has gone sees no more of it, but its files are wanted.
                let writes = |(_, order): &(u64, Order)| {
                    matches!(order, Order::Save(_) | Order::Moment(_) | Order::Picture(..) | Order::Table(..))
                };
                list.truncate(list.iter().rposition(writes).map_or(0, |last| last + 1));
                return if list.is_empty() { Next::Nobody } else { Next::Orders(merged(list)) };
            }
        }
    }
}

/// The same orders, of which frames' times that follow on each other are one: what was left undone for too long is not all made up for.
/// What comes between two frames stays between them, but for a jump of the cursor, which is that of both.
fn merged(list: Vec<(u64, Order)>) -> Vec<(u64, Order)> {
    let mut orders: Vec<(u64, Order)> = Vec::with_capacity(list.len());
    for (serial, order) in list {
        if matches!(
            (&orders[..], &order),
            ([.., (_, Order::Advance { back: false, .. }), (_, Order::Jump)], Order::Advance { back: false, .. })
        ) {
            let last = orders.len() - 1;
            orders.swap(last - 1, last);
        }
        match (orders.last_mut(), order) {
            (
                Some((last, Order::Advance { wall, cursor, back })),
                Order::Advance { wall: more, cursor: to, back: goes_back },
            ) if *back == goes_back => {
                (*last, *wall, *cursor) = (serial, *wall + more, to);
            }
            (_, order) => orders.push((serial, order)),
        }
    }
    orders
}

#[cfg(test)]
#[allow(clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    fn frame(serial: u64, wall: f64, back: bool) -> (u64, Order) {
        (serial, Order::Advance { wall, cursor: None, back })
    }

    #[test]
    fn an_order_is_waited_for_unless_the_last_one_took_longer() {
        let (most, asked, start) = (Duration::from_secs(20), Duration::from_secs(1), Instant::now());
        let desk = Desk::default();
        desk.lock().took = most + 2 * asked;
        assert_eq!(desk.wait_if_soon(1, asked, most).done, 0);
        assert!(start.elapsed() < most, "nobody waits for it");
        desk.lock().took = most;
        std::thread::scope(|scope| {
            scope.spawn(|| {
                desk.lock().done = 1;
                desk.answered.notify_all();
            });
            assert_eq!(desk.wait_if_soon(1, asked, most).done, 1);
        });
    }

    #[test]
    fn frames_that_came_too_late_are_one_but_for_what_was_done_between_them() {
        let list = merged(vec![
            frame(1, 0.25, false),
            frame(2, 0.25, false),
            (3, Order::Reset),
            frame(4, 0.5, false),
            frame(5, 1.0, true),
            frame(6, 2.0, true),
        ]);
        let walls: Vec<(u64, f64)> = list
            .iter()
            .map(|(serial, order)| match order {
                Order::Advance { wall, .. } => (*serial, *wall),
                _ => (*serial, 0.0),
            })
            .collect();
        assert_eq!(walls, [(2, 0.5), (3, 0.0), (4, 0.5), (6, 3.0)]);
    }

    #[test]
    fn frames_between_which_the_cursor_jumped_are_one_that_it_jumps_in() {
        let list = merged(vec![
            frame(1, 0.25, false),
            (2, Order::Jump),
            frame(3, 0.25, false),
            (4, Order::Jump),
            frame(5, 0.5, false),
            (6, Order::Jump),
        ]);
        let walls: Vec<Option<f64>> = list
            .iter()
            .map(|(_, order)| match order {
                Order::Advance { wall, .. } => Some(*wall),
                _ => None,
            })
            .collect();
        assert_eq!(walls, [None, None, Some(1.0), None], "the last one is for the frame after it");
        assert_eq!(list[2].0, 5);
    }

    #[test]
    fn what_is_to_be_written_is_written_though_nobody_asks_any_more() {
        let (orders, asked) = std::sync::mpsc::channel();
        for order in [frame(1, 0.1, false), (2, Order::Save("x.json".into())), frame(3, 0.1, false)] {
            orders.send(order).unwrap_or_default();
        }
        drop(orders);
        let Next::Orders(list) = next(&asked, None) else { panic!("the file is forgotten") };
        assert_eq!(list.iter().map(|(serial, _)| *serial).collect::<Vec<_>>(), [1, 2]);
        assert!(matches!(next(&asked, None), Next::Nobody));
    }
}
