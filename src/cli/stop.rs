//! Ctrl+C: the program ends at once, but for a file that is being written, which is finished first.

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
            let _whole = crate::output::pause();
            let _ = writeln!(std::io::stderr(), "\nwobble: stopped: what was not written yet is lost");
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
