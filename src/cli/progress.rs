//! Progress bars on long work: on a terminal only, and not with `--quiet`.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Steps of the bar a second of the scene.
pub(super) const SCALE: f64 = 1000.0;

/// A bar over `seconds` of a scene.
pub(super) fn bar(quiet: bool, seconds: f64) -> ProgressBar {
    counted(quiet, (seconds * SCALE) as u64, "{wide_bar} {percent} % {eta}")
}

/// A bar over `count` frames.
pub(super) fn frames(quiet: bool, count: u64) -> ProgressBar {
    counted(quiet, count, "{wide_bar} {pos}/{len} {eta}")
}

/// A bar over tasks whose number its user sets, with a word on the one at hand.
pub(super) fn tasks(quiet: bool) -> ProgressBar {
    counted(quiet, 0, "{wide_bar} {pos}/{len} {msg} {elapsed}")
}

/// Says what is being done, for how long it has been, where nobody can say for how long it will be.
pub(super) fn waiting(quiet: bool, words: &str) -> ProgressBar {
    let bar = counted(quiet, 0, "{spinner} {msg} {elapsed}").with_message(words.to_owned());
    bar.enable_steady_tick(TICK);
    bar
}

/// Time between two looks of a bar that turns.
const TICK: std::time::Duration = std::time::Duration::from_millis(120);

fn counted(quiet: bool, length: u64, template: &str) -> ProgressBar {
    // A bar on standard error hides itself where that is no terminal.
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::with_draw_target(Some(length), target).with_style(style)
}
