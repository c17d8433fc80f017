//! How much of something long is done: told by the thread that does it, read by the window.

use std::sync::atomic::{AtomicU32, Ordering};

/// A share, 0 to 1, of a whole that may be done in parts: each of them is told of from 0 to 1, and the share of the whole never falls.
#[derive(Debug, Default)]
pub(super) struct Share {
    /// How much of the whole is done.
    all: Number,
    /// Where the present part begins and ends in the whole.
    part: [Number; 2],
}

/// A number that two threads share, by its bits.
#[derive(Debug, Default)]
struct Number(AtomicU32);

impl Number {
    fn put(&self, number: f32) {
        self.0.store(number.to_bits(), Ordering::Relaxed);
    }

    fn get(&self) -> f32 {
        f32::from_bits(self.0.load(Ordering::Relaxed))
    }
}

impl Share {
    /// Nothing of another whole is done, of which what comes first is so much.
    pub(super) fn begin(&self, first: f32) {
        self.all.put(0.0);
        self.part[0].put(0.0);
        self.part[1].put(first);
    }

    /// The rest of the whole comes next.
    pub(super) fn go_on(&self) {
        self.part[0].put(self.all.get());
        self.part[1].put(1.0);
    }

    /// So much of the present part is done.
    pub(super) fn tell(&self, share: f64) {
        let [from, to] = [0, 1].map(|end: usize| self.part[end].get());
        self.all.put((from + (to - from) * share as f32).max(self.all.get()));
    }

    pub(super) fn read(&self) -> f32 {
        self.all.get()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_of_one_whole_make_one_share() {
        let share = Share::default();
        let mut seen = Vec::new();
        share.begin(0.9);
        for part in 0..2 {
            for told in [0.0, 0.5, 1.0] {
                share.tell(told);
                seen.push((100.0 * share.read()).round());
            }
            assert_eq!(part == 1, share.read() == 1.0);
            share.go_on();
        }
        assert_eq!(seen, [0.0, 45.0, 90.0, 90.0, 95.0, 100.0]);
        share.begin(1.0);
        assert_eq!(share.read(), 0.0);
    }
}
