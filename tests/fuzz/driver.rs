//! Runs cases by number, one at a time: what panics, takes too much memory or does not end is named.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::HEAP;

/// Time after which a case counts as one that does not end [s]: far above what any takes on a busy machine.
const HANG: u64 = 300;

/// Processor time of a case, and of processes that it waits for, above which it fails [s].
pub(crate) const SLOW: f64 = 5.0;
/// Times of processes in `/proc` are in these [1/s].
const TICKS: f64 = 100.0;

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
        let Found { ended, failed, peak, slowest } = found;
        eprintln!(
            "{}: {ended:?}, at most {} KiB (case {}), {} s, of processor time at most {slowest:?}",
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
    /// The most processor time of a case [s], and which it is.
    slowest: (f64, u64),
}

/// Processor time of this thread, and of processes that were waited for [s]; 0 where the system does not tell.
pub(crate) fn spent() -> f64 {
    let read = |path: &str| std::fs::read_to_string(path).unwrap_or_default();
    let own = read("/proc/thread-self/schedstat");
    let own: f64 = own.split_whitespace().next().and_then(|time| time.parse().ok()).unwrap_or(0.0);
    // The name, in brackets, may hold anything; the times of others are the 14th and 15th number after it.
    let all = read("/proc/self/stat");
    let numbers = all.rsplit(')').next().unwrap_or_default().split_whitespace().skip(13).take(2);
    let others: f64 = numbers.filter_map(|time| time.parse::<f64>().ok()).sum();
    1e-9 * own + others / TICKS
}

fn run_all(trial: &Trial, cases: std::ops::Range<u64>, now: &AtomicU64, case: &impl Fn(u64) -> &'static str) -> Found {
    let mut found = Found::default();
    for number in cases {
        now.store(number, Ordering::Relaxed);
        HEAP.reset_peak_usage();
        let (before, start) = (HEAP.current_usage(), spent());
        match catch_unwind(AssertUnwindSafe(|| case(number))) {
            Ok(how) => *found.ended.entry(how).or_default() += 1,
            Err(panic) => found.failed.push((number, said(&*panic))),
        }
        let bytes = HEAP.peak_usage().saturating_sub(before);
        found.peak = found.peak.max((bytes, number));
        if bytes > trial.most_bytes {
            found.failed.push((number, format!("{bytes} bytes at once")));
        }
        let seconds = spent() - start;
        found.slowest = if seconds > found.slowest.0 { (seconds, number) } else { found.slowest };
        if seconds > SLOW {
            found.failed.push((number, format!("{seconds} s of processor time")));
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

#[test]
fn processor_time_is_counted_of_this_thread_and_of_others_that_were_waited_for() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let own = |before: f64| spent() - before;
    let (before, start) = (spent(), Instant::now());
    while own(before) < 0.05 && start.elapsed() < Duration::from_secs(60) {
        std::hint::black_box(start);
    }
    assert!(own(before) >= 0.05 || !cfg!(target_os = "linux"));
    let before = spent();
    let loops = "i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done";
    let ended = std::process::Command::new("sh").args(["-c", loops]).status();
    assert!(ended.is_err() || own(before) >= 0.02 || !cfg!(target_os = "linux"), "{}", own(before));
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
