//! What is drawn beside the window: on a thread of its own, which the program does not end without.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

/// A thread that draws. Whoever drops it waits until it has put away what it is at: a program that ends while one of its threads still draws takes
/// the driver from under it, which can end in a fault.
pub(super) struct Aside {
    is_left: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

/// Calls something as it goes, however the work beside it ended.
struct Wakes<F: Fn()>(F);

impl<F: Fn()> Drop for Wakes<F> {
    fn drop(&mut self) {
        (self.0)();
    }
}

impl Aside {
    /// Begins some work, which is told whether it is still wanted: it asks between two pictures. It calls `wake` where it has something to
    /// tell; once more that is called when all that it held is gone, also where it panicked: whoever waits for it looks then.
    pub(super) fn new(
        wake: impl Fn() + Send + 'static,
        work: impl FnOnce(&dyn Fn() -> bool, &dyn Fn()) + Send + 'static,
    ) -> Self {
        let is_left = Arc::<AtomicBool>::default();
        let told = Arc::clone(&is_left);
        let thread = std::thread::spawn(move || {
            let wakes = Wakes(wake);
            work(&|| !told.load(Ordering::Relaxed), &wakes.0);
        });
        Aside { is_left, thread: Some(thread) }
    }

    /// It is not wanted any more: that is told to it, and not waited for.
    fn give_up(&self) {
        self.is_left.store(true, Ordering::Relaxed);
    }

    /// Whether nothing is left to wait for.
    fn has_ended(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }
}

impl Drop for Aside {
    fn drop(&mut self) {
        self.give_up();
        // What panicked has said so, and is nothing to wait for.
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

/// Threads that draw what nobody wants any more: each ends as soon as it asks whether it is wanted. They are waited for where this is dropped alone,
/// at the end of the program.
#[derive(Default)]
pub(super) struct Unwanted(Vec<Aside>);

impl Unwanted {
    /// Takes one, without waiting for it; those that have ended are forgotten.
    pub(super) fn take(&mut self, aside: Aside) {
        aside.give_up();
        self.0.retain(|other| !other.has_ended());
        self.0.push(aside);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::{TryRecvError, channel};
    use std::time::Duration;

    #[test]
    fn what_is_dropped_has_put_away_what_it_was_at() {
        let at_work = Arc::<AtomicBool>::default();
        let its = Arc::clone(&at_work);
        let aside = Aside::new(
            || {},
            move |is_wanted, _| {
                while is_wanted() {
                    its.store(true, Ordering::Relaxed);
                    std::thread::sleep(Duration::from_millis(5));
                    its.store(false, Ordering::Relaxed);
                }
            },
        );
        std::thread::sleep(Duration::from_millis(12));
        drop(aside);
        assert!(!at_work.load(Ordering::Relaxed));
        assert_eq!(Arc::strong_count(&at_work), 1, "the thread has ended");
    }

    #[test]
    fn what_is_not_wanted_any_more_is_told_so_and_waited_for_at_the_end_alone() {
        let (lets_go, is_let_go) = channel::<()>();
        let (told, tells) = channel();
        let work = move |is_wanted: &dyn Fn() -> bool, _: &dyn Fn()| {
            // It is at something long, as one picture.
            let _ = is_let_go.recv();
            told.send(is_wanted()).unwrap_or_default();
        };
        let mut unwanted = Unwanted::default();
        // This thread lets it go on only after that: one that waited would wait for ever.
        unwanted.take(Aside::new(|| {}, work));
        assert_eq!(tells.try_recv(), Err(TryRecvError::Empty));
        drop(lets_go);
        assert_eq!(tells.recv(), Ok(false));
        while !unwanted.0[0].has_ended() {
            std::thread::sleep(Duration::from_millis(1));
        }
        unwanted.take(Aside::new(|| {}, |_, _| {}));
        assert_eq!(unwanted.0.len(), 1, "what has ended is forgotten");
    }

    #[test]
    fn work_that_fails_takes_nothing_with_it() {
        drop(Aside::new(|| {}, |_, _| std::panic::resume_unwind(Box::new("no GPU"))));
    }

    #[test]
    fn whoever_waits_is_woken_when_work_ends_and_when_it_fails() {
        for fails in [false, true] {
            let (sender, told) = channel::<u8>();
            let (woken, ends) = channel();
            let aside = Aside::new(
                // What is heard at that moment.
                move || woken.send(told.try_recv()).unwrap_or_default(),
                move |_, wake| {
                    sender.send(1).unwrap_or_default();
                    wake();
                    if fails {
                        std::panic::resume_unwind(Box::new("no GPU"));
                    }
                },
            );
            let heard: Vec<_> = ends.iter().collect();
            assert_eq!(heard, [Ok(1), Err(TryRecvError::Disconnected)], "{fails}: it is known that nothing more comes");
            drop(aside);
        }
    }
}
