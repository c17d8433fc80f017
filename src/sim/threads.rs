//! Work on large bodies that is shared by threads. The bits of a run do not depend on how many there are: work is cut by
//! what it is, never by who does it.

use rayon::prelude::*;

/// Work below which one thread is as quick, in bonds that are swept (about 0.3 ns each): others have to be woken and
/// waited for, which takes some microseconds, and more where the machine is busy.
const LEAST_WORK: usize = 1_000_000;

/// Makes the program use so many threads, once and before any large body moves; all processors otherwise.
///
/// Errors: threads are in use already, or cannot be started.
pub fn use_threads(count: usize) -> Result<(), rayon::ThreadPoolBuildError> {
    rayon::ThreadPoolBuilder::new().num_threads(count).build_global()
}

/// Does something with every part, one after another or at once, as `work` makes it worth (bonds that are swept). Parts do not touch each other.
pub(crate) fn with_each<T: Send>(work: usize, parts: impl IntoIterator<Item = T>, does: impl Fn(T) + Sync + Send) {
    if is_worth(work) {
        parts.into_iter().collect::<Vec<_>>().into_par_iter().for_each(does);
    } else {
        parts.into_iter().for_each(does);
    }
}

/// As [`with_each`], with room for what the work needs: `own` for one thread, a new one for each of more.
pub(crate) fn with_each_in<T: Send, R: Send>(
    work: usize,
    parts: impl IntoIterator<Item = T>,
    own: &mut R,
    room: impl Fn() -> R + Sync + Send,
    does: impl Fn(&mut R, T) + Sync + Send,
) {
    if is_worth(work) {
        parts.into_iter().collect::<Vec<_>>().into_par_iter().for_each_init(room, does);
    } else {
        parts.into_iter().for_each(|part| does(own, part));
    }
}

/// The largest of what `of` finds for every part.
pub(crate) fn largest_of<T: Send, S: PartialOrd + Send + Sync + Copy>(
    work: usize,
    parts: Vec<T>,
    least: S,
    of: impl Fn(T) -> S + Sync + Send,
) -> S {
    let larger = |a: S, b: S| if b > a { b } else { a };
    if is_worth(work) {
        parts.into_par_iter().map(of).reduce(|| least, larger)
    } else {
        parts.into_iter().map(of).fold(least, larger)
    }
}

/// Whether so much work is worth more than one thread.
pub(crate) fn is_worth(work: usize) -> bool {
    work >= LEAST_WORK && rayon::current_num_threads() > 1
}
