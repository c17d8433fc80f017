//! How many substeps a frame bears: what is crumpled and fast would ask for more than there is time for.
//!
//! What a substep takes is known once it is done. Where those that are left would take more than a frame may, they are fewer and longer:
//! nothing passes through anything for that, for ways across what is near are cut, but what is that fast is slowed down.

use super::FRAMES;
use super::gather::SUBSTEPS;
use crate::sim::counters::operations;

/// Counted work of a frame of a cluster beyond which its substeps are fewer than speeds and springs ask for `[ms]`.
const BEARABLE: f64 = 20.0;
/// Substeps after which that is looked at, and the share of them that has to go where any do.
const LOOK: u32 = 4;
const SHARE: f64 = 0.75;

/// The substeps of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    /// Where those of this length begin, and their length `[s]`.
    from: f64,
    pub(super) length: f64,
    taken: u32,
    left: u32,
    /// The longest that there may be `[s]`.
    longest: f64,
    /// Counted work that is left, and that of those that were taken.
    room: u64,
    spent: u64,
}

impl Pace {
    /// `h` from `t` on `[s]` in so many substeps; something asks for `least` of them in any case.
    pub(super) fn new((t, h): (f64, f64), count: u32, least: u32) -> Self {
        let longest = (1.0 / (FRAMES * f64::from(SUBSTEPS[0]))).min(h / f64::from(least.max(1)));
        let room = operations(BEARABLE * h * FRAMES);
        Pace { from: t, length: h / f64::from(count), taken: 0, left: count, longest, room, spent: 0 }
    }

    /// Where the next one begins `[s]`; `None`: all are done.
    pub(super) fn next(&self) -> Option<f64> {
        (self.left > 0).then(|| self.from + f64::from(self.taken) * self.length)
    }

    /// One is done, and took so much work. Returns whether those that are left are longer.
    pub(super) fn note(&mut self, work: u64) -> bool {
        self.taken += 1;
        self.left -= 1;
        self.spent += work;
        if !self.taken.is_multiple_of(LOOK) {
            return false;
        }
        let (each, rest) = (self.spent / u64::from(self.taken), f64::from(self.left) * self.length);
        let borne = self.room.saturating_sub(self.spent) / each.max(1);
        let least = (rest / self.longest * (1.0 - 1e-9)).ceil().max(1.0) as u32;
        let count = (borne.min(u64::from(u32::MAX)) as u32).max(least);
        if f64::from(count) > SHARE * f64::from(self.left) {
            return false;
        }
        self.from += f64::from(self.taken) * self.length;
        self.room = self.room.saturating_sub(self.spent);
        (self.taken, self.left, self.length, self.spent) = (0, count, rest / f64::from(count), 0);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many substeps there are of a frame, each of which takes so much of what a frame may, and where the last one ends.
    fn frame(count: u32, share: f64, least: u32) -> (u32, f64) {
        let mut pace = Pace::new((1.0, 1.0 / FRAMES), count, least);
        let (mut taken, mut end) = (0, 1.0);
        while let Some(start) = pace.next() {
            assert!((start - end).abs() < 1e-12, "{start} after {end}");
            (taken, end) = (taken + 1, start + pace.length);
            pace.note((share * operations(BEARABLE) as f64) as u64);
        }
        (taken, end)
    }

    #[test]
    fn a_frame_takes_what_it_bears_and_is_whole() {
        for (count, share, least, taken) in [
            (128, 1.0 / 256.0, 1, 128),
            (128, 1.0 / 64.0, 1, 64),
            (128, 1.0, 1, 20),
            (128, 1.0, 64, 66),
            (16, 1.0, 1, 16),
        ] {
            let (found, end) = frame(count, share, least);
            assert!(found.abs_diff(taken) <= 2, "{found} of {count} at {share}, {taken} expected");
            assert!((end - 1.0 - 1.0 / FRAMES).abs() < 1e-12);
        }
    }
}
