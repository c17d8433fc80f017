//! Ctrl+C: the program ends at once, but for a file that is being written, which is finished first, and for what long work keeps of
//! what it has done.

use std::sync::{Mutex, PoisonError};

/// Keeps what there is, and says where; `None`: there is nothing.
type Keep = Box<dyn FnMut() -> Option<String> + Send>;

/// What an interrupt does before the program ends.
static KEEP: Mutex<Option<Keep>> = Mutex::new(None);

/// From now on an interrupt does this before the program ends; none from when what is returned is dropped on.
pub(super) fn keeping(keep: impl FnMut() -> Option<String> + Send + 'static) -> Keeping {
    *KEEP.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(keep));
    Keeping
}

/// While this lives an interrupt keeps what there is.
pub(super) struct Keeping;

impl Drop for Keeping {
    fn drop(&mut self) {
        *KEEP.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }
}

/// From now on an interrupt ends the program cleanly: no half of a file is left, and a line says so.
///
/// Errors: the system takes no handler.
#[cfg(unix)]
pub(super) fn on_interrupt() -> anyhow::Result<()> {
    use std::io::Write;

    use signal_hook::consts::SIGINT;

    let mut signals = signal_hook::iterator::Signals::new([SIGINT])?;
    std::thread::spawn(move || {
        if signals.forever().next().is_some() {
            let keep = || KEEP.lock().unwrap_or_else(PoisonError::into_inner).as_mut().and_then(|keep| keep());
            let kept = std::panic::catch_unwind(std::panic::AssertUnwindSafe(keep)).unwrap_or_default();
            let _whole = crate::output::pause();
            let words = kept.unwrap_or_else(|| "what was not written yet is lost".to_owned());
            let _ = writeln!(std::io::stderr(), "\nwobble: stopped: {words}");
            // As shells have it: 128 and the number of the signal.
            std::process::exit(128 + SIGINT);
        }
    });
    Ok(())
}

/// Elsewhere an interrupt ends the program as it always does.
///
/// Errors: none.
#[cfg(not(unix))]
pub(super) fn on_interrupt() -> anyhow::Result<()> {
    Ok(())
}
