//! What the live step does beside moving bodies: what it cut, took, mended and slowed down of late.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use crate::sim::Counters;

/// What was done within this time is of late.
const OF_LATE: Duration = Duration::from_secs(1);

/// What was done within the last second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Acts {
    /// Motions that were cut where a point would have passed an edge.
    pub cut: u64,
    /// Steps after which energy from nowhere was taken out.
    pub guarded: u64,
    /// Something that was inside out was led back to its shape.
    pub mends: bool,
    /// Bodies in each other were parted.
    pub parts: bool,
    /// What touches something and is slow was slowed down.
    pub settles: bool,
}

/// Looks at the counters of a world.
#[derive(Clone, Debug, Default)]
pub(super) struct Deeds {
    looks: VecDeque<(Instant, Counters)>,
}

impl Deeds {
    /// Looks at the counters `now`.
    pub(super) fn look(&mut self, counters: &Counters, now: Instant) -> Acts {
        // Another past: its counters are others.
        if self.looks.back().is_some_and(|(_, last)| last.substeps > counters.substeps) {
            self.looks.clear();
        }
        self.looks.push_back((now, *counters));
        while self.looks.len() > 2 && self.looks.get(1).is_some_and(|(at, _)| now - *at >= OF_LATE) {
            self.looks.pop_front();
        }
        self.looks.front().map_or_else(Acts::default, |(_, before)| since(before, counters))
    }
}

fn since(before: &Counters, now: &Counters) -> Acts {
    let more = |of: fn(&Counters) -> u64| of(now).saturating_sub(of(before));
    Acts {
        cut: more(|counters| counters.truncations),
        guarded: more(|counters| counters.guarded),
        mends: more(|counters| counters.mended) > 0,
        parts: more(|counters| counters.parted) > 0,
        settles: more(|counters| counters.settled) > 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_done_is_told_for_a_second_and_another_past_has_its_own() {
        let mut deeds = Deeds::default();
        let start = Instant::now();
        let at = |ms: u64| start + Duration::from_millis(ms);
        let of = |substeps: u64, truncations: u64, settled: u64| Counters {
            substeps,
            truncations,
            settled,
            ..Counters::default()
        };
        assert_eq!(deeds.look(&of(10, 5, 0), at(0)), Acts::default());
        assert_eq!(deeds.look(&of(20, 8, 0), at(100)), Acts { cut: 3, ..Acts::default() });
        for k in 2..=11 {
            assert_eq!(deeds.look(&of(10 + 10 * k, 8, 0), at(100 * k)).cut, if k < 11 { 3 } else { 0 }, "{k}");
        }
        assert!(deeds.look(&of(200, 8, 1), at(1200)).settles);
        assert_eq!(deeds.look(&of(30, 0, 0), at(1300)), Acts::default());
        assert_eq!(deeds.look(&of(40, 2, 0), at(1400)).cut, 2);
    }
}
