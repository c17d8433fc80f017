//! How long things take: smoothed so that it can be read, and without what a busy machine adds.

use std::collections::VecDeque;

/// A moving average of times `[s]`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meter {
    average: Option<f64>,
}

/// Share of the newest value: at 60 frames a second the average follows within a third of a second.
const NEWEST: f64 = 0.08;
/// Values of which the least is known: what else runs on a machine seldom takes its time from all frames of a second.
const LAST: usize = 60;

impl Meter {
    /// Takes a value.
    pub fn push(&mut self, value: f64) {
        self.average = Some(self.average.map_or(value, |average| average + NEWEST * (value - average)));
    }

    /// The average, 0 before the first value.
    pub fn value(&self) -> f64 {
        self.average.unwrap_or(0.0)
    }
}

/// The least of the last values: what a thing takes at least, however busy the machine was meanwhile.
#[derive(Clone, Debug, Default)]
pub struct Lowest {
    last: VecDeque<f64>,
}

impl Lowest {
    /// Takes a value.
    pub fn push(&mut self, value: f64) {
        if self.last.len() == LAST {
            self.last.pop_front();
        }
        self.last.push_back(value);
    }

    /// The least of them, 0 before the first value.
    pub fn value(&self) -> f64 {
        self.last.iter().copied().min_by(f64::total_cmp).unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_busy_moment_is_in_the_average_and_not_in_the_least() {
        let (mut meter, mut lowest) = (Meter::default(), Lowest::default());
        assert_eq!(lowest.value(), 0.0);
        for time in std::iter::once(0.001).chain(std::iter::repeat_n(0.02, LAST - 1)) {
            meter.push(time);
            lowest.push(time);
        }
        assert!(meter.value() > 0.019);
        assert_eq!(lowest.value(), 0.001);
        lowest.push(0.02);
        assert_eq!(lowest.value(), 0.02, "after a second it is no moment");
    }
}
