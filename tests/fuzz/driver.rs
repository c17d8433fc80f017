//! Runs cases by number, one at a time: what panics, takes too much memory or does not end is named.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::HEAP;

/// Time after which a case counts as one that does not end [s]: far above what any takes on a busy machine.
const HANG: u64 = 300;

/// Time that no case should take on a machine that has nothing else to do: those that do are listed [s].
const SLOW: f64 = 5.0;

/// Failures after which a run stops.
const ENOUGH: usize = 20;

/// The heap is counted for the whole program, so that one test at a time has it.
pub(crate) static TURN: Mutex<()> = Mutex::new(());

/// What is tried.
pub(crate) struct Trial {
    pub(crate) name: &'static str,
    /// Cases that always run.
    pub(crate) few: u64,
    /// Most that a case may take on the heap at once [bytes].
    pub(crate) most_bytes: usize,
}

/// A number of the environment.
pub(crate) fn number(variable: &str) -> Option<u64> {
    std::env::var(variable).ok().map(|text| text.parse().unwrap())
}

/// Whether cases are to be printed.
pub(crate) fn shows() -> bool {
    std::env::var_os("WOBBLE_FUZZ_SHOW").is_some_and(|text| !text.is_empty())
}

/// Runs the cases; each says in a word how it ended. How many ended how comes back.
pub(crate) fn run(trial: &Trial, case: impl Fn(u64) -> &'static str) -> BTreeMap<&'static str, u64> {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let from = number("WOBBLE_FUZZ_FROM").unwrap_or(0);
    let cases = number("WOBBLE_FUZZ_CASES").unwrap_or(trial.few);
    let now = AtomicU64::new(from);
    let start = Instant::now();
    let is_done = std::sync::Condvar::new();
    let done = Mutex::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| watch(trial.name, &now, &done, &is_done));
        let found = run_all(trial, from..from + cases, &now, &case);
        *done.lock().unwrap_or_else(PoisonError::into_inner) = true;
        is_done.notify_all();
        let Found { ended, failed, peak, slow } = found;
        eprintln!(
            "{}: {ended:?}, at most {} KiB (case {}), {} s; slow: {slow:?}",
            trial.name,
            peak.0 >> 10,
            peak.1,
            start.elapsed().as_secs()
        );
        assert!(failed.is_empty(), "{}: {failed:#?}", trial.name);
        ended
    })
}

#[derive(Default)]
struct Found {
    ended: BTreeMap<&'static str, u64>,
    failed: Vec<(u64, String)>,
    peak: (usize, u64),
    slow: Vec<(u64, f64)>,
}

fn run_all(trial: &Trial, cases: std::ops::Range<u64>, now: &AtomicU64, case: &impl Fn(u64) -> &'static str) -> Found {
    let mut found = Found::default();
    for number in cases {
        now.store(number, Ordering::Relaxed);
        HEAP.reset_peak_usage();
        let (before, start) = (HEAP.current_usage(), Instant::now());
        match catch_unwind(AssertUnwindSafe(|| case(number))) {
            Ok(how) => *found.ended.entry(how).or_default() += 1,
            Err(panic) => found.failed.push((number, said(&*panic))),
        }
        let bytes = HEAP.peak_usage().saturating_sub(before);
        found.peak = found.peak.max((bytes, number));
        if bytes > trial.most_bytes {
            found.failed.push((number, format!("{bytes} bytes at once")));
        }
        let seconds = start.elapsed().as_secs_f64();
        if seconds > SLOW {
            found.slow.push((number, seconds));
        }
        if number % 10_000 == 9_999 {
            eprintln!("{}: to {number}: {:?}, failed: {:?}", trial.name, found.ended, found.failed);
        }
        if found.failed.len() >= ENOUGH {
            break;
        }
    }
    found
}

fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("a panic").to_owned()
}

/// Ends the program, with the number of the case, where one does not end.
fn watch(name: &str, now: &AtomicU64, done: &Mutex<bool>, is_done: &std::sync::Condvar) {
    let mut last = (now.load(Ordering::Relaxed), Instant::now());
    let mut guard = done.lock().unwrap_or_else(PoisonError::into_inner);
    while !*guard {
        guard = is_done.wait_timeout(guard, Duration::from_secs(1)).unwrap_or_else(PoisonError::into_inner).0;
        let number = now.load(Ordering::Relaxed);
        if number != last.0 {
            last = (number, Instant::now());
        } else if last.1.elapsed() > Duration::from_secs(HANG) {
            eprintln!("{name}: case {number} does not end");
            std::process::exit(101);
        }
    }
}
