//! Work on large bodies, and on many bodies, that is shared by threads. The bits of a run do not depend on how many there are: work is cut by
//! what it is, never by who does it.

use std::cell::Cell;
use std::num::NonZero;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::sizes::{LEAST_SHARE, LEAST_TOGETHER, LEAST_WORK};

/// Looks at what others have left to do before one lets the machine do something else.
const MOST_LOOKS: u32 = 20_000;

/// How many threads were asked for.
static COUNT: OnceLock<usize> = OnceLock::new();
/// The others, once a large body has moved.
static OTHERS: OnceLock<Option<ThreadPool>> = OnceLock::new();

thread_local! {
    /// Whether others stand by to help this thread.
    static IS_HELPED: Cell<bool> = const { Cell::new(false) };
    /// How often this thread waited for others, and how often they were late.
    static WAITS: Cell<[u32; 2]> = const { Cell::new([0; 2]) };
    /// Whether this thread does one task of several that go at once: it asks nobody for help with it.
    static IS_BUSY: Cell<bool> = const { Cell::new(false) };
    /// Passes that this thread has shared.
    static SHARED: Cell<u64> = const { Cell::new(0) };
}

/// How many passes over large bodies this thread has shared with others so far: it proves that what runs alike on any number of
/// threads ran on more than one. No result depends on it.
pub fn shared_passes() -> u64 {
    SHARED.get()
}

/// Threads are in use already.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("threads are in use already")]
pub struct ThreadsInUse;

/// Makes the program use so many threads, once and before any large body, or many bodies, move; all processors otherwise.
///
/// The thread that moves the first of these is one of them, and the only one that the others help.
/// Errors: their number is settled already.
pub fn use_threads(count: usize) -> Result<(), ThreadsInUse> {
    COUNT.set(count).map_err(|_| ThreadsInUse)
}

/// Whether other threads help this one: they are started when they are first asked for.
fn has_help() -> bool {
    let start = || {
        let count = *COUNT.get_or_init(|| std::thread::available_parallelism().map_or(1, NonZero::get));
        // The thread itself goes on working: handing work over and waiting would cost more than small work takes.
        let pool = ThreadPoolBuilder::new().num_threads(count).use_current_thread();
        if count > 1 { pool.build().ok() } else { None }
    };
    if rayon::current_thread_index().is_none() {
        OTHERS.get_or_init(start);
    }
    rayon::current_thread_index().is_some() && rayon::current_num_threads() > 1
}

/// Share of the waits for others in which they may be late.
const MOST_LATE: f64 = 0.1;
/// Steps that are taken alone when they were late more often.
const PATIENCE: u32 = 64;

/// Whether help is worth it: where other programs keep the processors busy it comes late, and waiting for it takes longer than
/// doing the work alone.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Help {
    /// Steps that are still to be taken alone.
    alone: u32,
}

impl Help {
    /// Does the work of a step (in bonds that are swept), with other threads standing by where that is worth it.
    pub(crate) fn with<R: Send>(&mut self, work: usize, does: impl FnOnce() -> R + Send) -> R {
        if work < LEAST_WORK || IS_BUSY.get() || !has_help() {
            return does();
        }
        if self.alone > 0 {
            self.alone -= 1;
            return does();
        }
        WAITS.set([0; 2]);
        let result = together(does);
        let [all, late] = WAITS.get().map(f64::from);
        if late > MOST_LATE * all {
            self.alone = PATIENCE;
        }
        result
    }
}

/// Does something with other threads standing by: they look for parts all the time, since waking them for each would take
/// longer than the parts do.
fn together<R: Send>(does: impl FnOnce() -> R + Send) -> R {
    let others = rayon::current_num_threads() - 1;
    let is_done = AtomicBool::new(false);
    let stand_by = || {
        while !is_done.load(Ordering::Relaxed) {
            if rayon::yield_now() != Some(rayon::Yield::Executed) {
                std::hint::spin_loop();
            }
        }
    };
    rayon::scope(|scope| {
        (0..others).for_each(|_| scope.spawn(|_| stand_by()));
        // A panic must not leave them standing.
        IS_HELPED.set(true);
        let ended = std::panic::catch_unwind(std::panic::AssertUnwindSafe(does));
        IS_HELPED.set(false);
        is_done.store(true, Ordering::Relaxed);
        ended.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

/// Does something with every part, one after another, or several at once within [`Help::with`] as `work` makes it worth (bonds
/// that are swept). Parts do not touch each other. The same thread gets the same share every time: it has it in its cache.
pub(crate) fn with_each<T: Send>(work: usize, parts: impl IntoIterator<Item = T>, does: impl Fn(T) + Sync + Send) {
    with_each_in(work, parts, &mut Vec::new(), || (), |(), part| does(part));
}

/// As [`with_each`], with room for what the work needs: one for each thread, made where there are too few of them.
pub(crate) fn with_each_in<T: Send, R: Send>(
    work: usize,
    parts: impl IntoIterator<Item = T>,
    rooms: &mut Vec<R>,
    room: impl Fn() -> R,
    does: impl Fn(&mut R, T) + Sync + Send,
) {
    let mut all = |shares: usize| {
        let missing = shares.saturating_sub(rooms.len());
        rooms.extend((0..missing).map(|_| room()));
    };
    if !is_worth(work) {
        all(1);
        return parts.into_iter().for_each(|part| does(&mut rooms[0], part));
    }
    let mut parts: Vec<T> = parts.into_iter().collect();
    let (count, shares) = (parts.len(), rayon::current_num_threads().min(parts.len()).max(1));
    all(shares);
    SHARED.set(SHARED.get() + u64::from(shares > 1));
    let left = AtomicUsize::new(shares - 1);
    rayon::scope(|scope| {
        let (does, left) = (&does, &left);
        let (own, others) = rooms.split_at_mut(1);
        for (share, room) in (1..shares).zip(others).rev() {
            let some = parts.split_off(count * share / shares);
            scope.spawn(move |_| {
                some.into_iter().for_each(|part| does(room, part));
                left.fetch_sub(1, Ordering::Release);
            });
        }
        parts.into_iter().for_each(|part| does(&mut own[0], part));
        let is_done = || {
            std::hint::spin_loop();
            left.load(Ordering::Acquire) == 0
        };
        let is_late = !(0..MOST_LOOKS).any(|_| is_done());
        let [all, late] = WAITS.get();
        WAITS.set([all + 1, late + u32::from(is_late)]);
    });
}

/// Does tasks that know nothing of each other, each with its work (operations, about): the longest first, each by whoever is free, where
/// what is done beside the longest is worth it; else one after another, as they are listed. One of more than its share of the work comes
/// first and alone, and may have help of its own.
pub(crate) fn share_out<T: Send>(tasks: Vec<(u64, T)>, does: impl Fn(T) + Sync + Send) {
    let all: u64 = tasks.iter().map(|task| task.0).sum();
    let is_short = |task: &(u64, T)| task.0 <= all / 2;
    let short: u64 = tasks.iter().filter(|task| is_short(task)).map(|task| task.0).sum();
    if short < LEAST_TOGETHER || !has_help() {
        return tasks.into_iter().for_each(|(_, task)| does(task));
    }
    let (mut short, long): (Vec<_>, Vec<_>) = tasks.into_iter().partition(is_short);
    long.into_iter().for_each(|(_, task)| does(task));
    short.sort_by_key(|task| task.0);
    let left = Mutex::new(short);
    let next = || left.lock().unwrap_or_else(PoisonError::into_inner).pop();
    let work = || {
        let was_busy = IS_BUSY.replace(true);
        while let Some((_, task)) = next() {
            does(task);
        }
        IS_BUSY.set(was_busy);
    };
    SHARED.set(SHARED.get() + 1);
    rayon::scope(|scope| {
        (1..rayon::current_num_threads()).for_each(|_| scope.spawn(|_| work()));
        work();
    });
}

/// The largest of what `of` finds for every part.
pub(crate) fn largest_of<T: Send, S: PartialOrd + Send + Sync + Copy>(
    work: usize,
    parts: Vec<T>,
    least: S,
    of: impl Fn(T) -> S + Sync + Send,
) -> S {
    let mut found = vec![least; parts.len()];
    with_each(work, parts.into_iter().zip(&mut found), |(part, found)| *found = of(part));
    found.into_iter().fold(least, |a, b| if b > a { b } else { a })
}

/// Whether so much work is worth more than one thread, and others stand by.
fn is_worth(work: usize) -> bool {
    work >= LEAST_SHARE && IS_HELPED.get()
}
