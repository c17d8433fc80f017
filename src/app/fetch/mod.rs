//! What the user brings in from outside, fetched beside the window: a file chosen in the system's dialog, a picture from the
//! clipboard. Frames go on meanwhile.

mod clipboard;
mod dialog;

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use crate::picture::Picture;
use crate::scene::Fragment;

pub(super) use clipboard::{copy, paste};
pub(super) use dialog::{ENDINGS, LEAST_SHOWN, open};

/// What was brought.
#[derive(Debug, PartialEq)]
pub(super) enum Found {
    /// A file: a scene or a picture.
    File(PathBuf),
    /// A picture that is in no file.
    Picture(Picture),
    /// Bodies that were copied here or in another window.
    Bodies(Box<Fragment>),
    /// Text that says it is bodies, and why it cannot be read.
    Broken(String),
    /// What was copied in a window of this program, and is too much for a text.
    Copied,
    /// The user thought better of it.
    Nothing,
}

/// Something that is being fetched.
pub(super) struct Fetch {
    answer: Receiver<Result<Found, String>>,
}

impl Fetch {
    /// Begins with `find` on another thread, which calls `wake` when it has an answer.
    fn new(wake: impl Fn() + Send + 'static, find: impl FnOnce() -> Result<Found, String> + Send + 'static) -> Self {
        let (answers, answer) = channel();
        std::thread::spawn(move || {
            // A window that has been closed wants no answer.
            let _ = answers.send(find());
            wake();
        });
        Fetch { answer }
    }

    /// What was found, or in a line why nothing was; `None` while it is still being looked for.
    pub(super) fn take(&self) -> Option<Result<Found, String>> {
        match self.answer.try_recv() {
            Ok(answer) => Some(answer),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Ok(Found::Nothing)),
        }
    }
}

#[cfg(test)]
#[allow(clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    fn answer(fetch: &Fetch) -> Result<Found, String> {
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(10) {
            if let Some(answer) = fetch.take() {
                return answer;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        panic!("no answer");
    }

    #[test]
    fn an_answer_comes_once_and_wakes() {
        let (wake, woken) = channel();
        let (go, wait) = channel::<()>();
        let wake = move || wake.send(()).unwrap_or_default();
        let fetch = Fetch::new(wake, move || wait.recv().map(|()| Found::Nothing).map_err(|error| error.to_string()));
        assert_eq!(fetch.take(), None, "it waits");
        assert!(go.send(()).is_ok());
        assert_eq!(answer(&fetch), Ok(Found::Nothing));
        assert_eq!(woken.recv_timeout(Duration::from_secs(10)), Ok(()));
    }

    #[test]
    fn one_that_was_given_up_finds_nothing() {
        let fetch = Fetch::new(|| (), || std::panic::resume_unwind(Box::new("given up")));
        assert_eq!(answer(&fetch), Ok(Found::Nothing));
    }
}
