//! What is drawn beside the window: on a thread of its own, which is not left behind.

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
}

impl Drop for Aside {
    fn drop(&mut self) {
        self.is_left.store(true, Ordering::Relaxed);
        // What panicked has said so, and is nothing to wait for.
        let _ = self.thread.take().map(JoinHandle::join);
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
