//! The thread that steps: takes orders, hands out what there is to see, and never waits for the window.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::keep::Keeper;
use super::order::{Note, Order};
use super::shown::Shown;
use super::stage::Stage;
use crate::history::{HistoryError, Start};
use crate::scene::Scene;

/// What thread and window share: the last state, and what is to be said.
#[derive(Default)]
pub(super) struct Desk {
    papers: Mutex<Papers>,
    answered: Condvar,
    /// What writes the log. It is held while it writes, never while a step is taken.
    keeper: Mutex<Keeper>,
    /// The window has done with the history: nothing of it need be left.
    is_dismissed: AtomicBool,
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

    pub(super) fn lock(&self) -> MutexGuard<'_, Papers> {
        self.papers.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until an order is done, so long at most.
    pub(super) fn wait_for(&self, serial: u64, most: Duration) -> MutexGuard<'_, Papers> {
        let is_open = |papers: &mut Papers| papers.done < serial && papers.failure.is_none();
        let waited = self.answered.wait_timeout_while(self.lock(), most, is_open);
        waited.unwrap_or_else(PoisonError::into_inner).0
    }

    /// Lays a state down. Returns whether the one before had been taken: else the window knows already that there is something.
    fn lay(&self, stage: &mut Stage, (done, notes): (u64, Vec<Note>)) -> bool {
        let mut shown = self.lock().spare.take().unwrap_or_default();
        stage.show(&mut shown);
        shown.serial = done;
        let mut papers = self.lock();
        papers.done = done;
        let is_news = papers.fresh.is_none() || !notes.is_empty();
        papers.notes.extend(notes);
        papers.spare = papers.fresh.replace(shown);
        drop(papers);
        self.answered.notify_all();
        is_news
    }
}

/// Makes the history and plays it until nobody asks any more.
pub(super) fn run(start: Start, orders: &Receiver<(u64, Order)>, desk: &Desk, wake: impl Fn()) {
    let mut stage = match Stage::new(start) {
        Ok(stage) => stage,
        Err(error) => {
            desk.lock().failure = Some(error);
            desk.answered.notify_all();
            return wake();
        }
    };
    desk.lock().scene = Some(Arc::new(stage.history().scene().clone()));
    let mut done = 0;
    desk.lay(&mut stage, (done, Vec::new()));
    wake();
    loop {
        let note = desk.keeper().keep(stage.history());
        if note.is_some() && desk.lay(&mut stage, (done, note.into_iter().collect())) {
            wake();
        }
        let wait = desk.keeper().wait();
        let list = match next(orders, wait) {
            Next::Orders(list) => list,
            Next::Late => continue,
            Next::Nobody => break,
        };
        let mut notes = Vec::new();
        for (serial, order) in list {
            desk.keeper().hear(&order);
            notes.extend(stage.obey(order));
            done = serial;
        }
        if desk.lay(&mut stage, (done, notes)) {
            wake();
        }
    }
    if desk.is_dismissed.load(Ordering::Acquire) {
        // A file that cannot be removed is offered at the next start: nobody is there to be told now.
        let _ = desk.keeper().end();
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

/// Waits for orders, so long at most. What was left undone for too long is not all made up for: of several frames' time the last
/// frame has all.
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
            // A window that has gone sees no more of it.
            Err(TryRecvError::Disconnected) => return Next::Nobody,
        }
    }
}

/// The same orders with one frame's time at most, the last one.
fn merged(list: Vec<(u64, Order)>) -> Vec<(u64, Order)> {
    let frames = list.iter().filter(|(_, order)| matches!(order, Order::Advance { .. })).count();
    if frames < 2 {
        return list;
    }
    let (mut left, mut passed) = (frames, 0.0);
    let last_one = |(serial, order)| match order {
        Order::Advance { wall, cursor, back } => {
            left -= 1;
            passed += wall;
            (left == 0).then_some((serial, Order::Advance { wall: passed, cursor, back }))
        }
        order => Some((serial, order)),
    };
    list.into_iter().filter_map(last_one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_that_came_too_late_are_one() {
        let frame = |serial, wall| (serial, Order::Advance { wall, cursor: None, back: false });
        let list = merged(vec![frame(1, 0.25), (2, Order::Reset), frame(3, 0.5), (4, Order::Rate(2.0))]);
        let serials: Vec<u64> = list.iter().map(|(serial, _)| *serial).collect();
        assert_eq!(serials, [2, 3, 4]);
        assert!(matches!(list[1].1, Order::Advance { wall: 0.75, .. }));
    }
}
