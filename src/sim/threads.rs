//! Work on large bodies that is shared by threads. The bits of a run do not depend on how many there are: work is cut by
//! what it is, never by who does it.

use rayon::prelude::*;

/// Bonds of a pass below which one thread is as quick: waking another takes some microseconds.
const LEAST_BONDS: usize = 40_000;

/// Makes the program use so many threads, once and before any large body moves; all processors otherwise.
///
/// Errors: threads are in use already, or cannot be started.
pub fn use_threads(count: usize) -> Result<(), rayon::ThreadPoolBuildError> {
    rayon::ThreadPoolBuilder::new().num_threads(count).build_global()
}

/// Does something with every part, one after another or at once, as `bonds` make it worth. Parts do not touch each other.
pub(crate) fn with_each<T: Send>(bonds: usize, parts: impl IntoIterator<Item = T>, work: impl Fn(T) + Sync + Send) {
    if is_worth(bonds) {
        parts.into_iter().collect::<Vec<_>>().into_par_iter().for_each(work);
    } else {
        parts.into_iter().for_each(work);
    }
}

/// As [`with_each`], with room for what the work needs: `own` for one thread, a new one for each of more.
pub(crate) fn with_each_in<T: Send, R: Send>(
    bonds: usize,
    parts: impl IntoIterator<Item = T>,
    own: &mut R,
    room: impl Fn() -> R + Sync + Send,
    work: impl Fn(&mut R, T) + Sync + Send,
) {
    if is_worth(bonds) {
        parts.into_iter().collect::<Vec<_>>().into_par_iter().for_each_init(room, work);
    } else {
        parts.into_iter().for_each(|part| work(own, part));
    }
}

/// The largest of what `of` finds for every part.
pub(crate) fn largest_of<T: Send, S: PartialOrd + Send + Sync + Copy>(
    bonds: usize,
    parts: Vec<T>,
    least: S,
    of: impl Fn(T) -> S + Sync + Send,
) -> S {
    let larger = |a: S, b: S| if b > a { b } else { a };
    if is_worth(bonds) {
        parts.into_par_iter().map(of).reduce(|| least, larger)
    } else {
        parts.into_iter().map(of).fold(least, larger)
    }
}

/// Whether a pass over so many bonds is worth more than one thread.
pub(crate) fn is_worth(bonds: usize) -> bool {
    bonds >= LEAST_BONDS && rayon::current_num_threads() > 1
}
