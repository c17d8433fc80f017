//! Time and counted work of the frames of a run.

use serde::Serialize;

/// Frames a second of the scene [1/s].
pub(super) const RATE: f64 = 60.0;

/// Where the steps of a run went: each belongs to the frame (k/60, (k+1)/60] of the scene that it ends in.
#[derive(Clone, Debug, Default)]
pub(super) struct Frames {
    /// Time of each frame [ms].
    time: Vec<f64>,
    /// Counted work of each [ms].
    work: Vec<f64>,
}

/// What frames of 1/60 s of the scene cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct FrameCost {
    /// Frames that were run.
    pub count: usize,
    /// Time, in the median [ms].
    pub median_ms: f64,
    /// Of a hundred frames the second slowest is about as slow [ms].
    pub p99_ms: f64,
    /// The slowest [ms].
    pub worst_ms: f64,
}

impl Frames {
    /// A step that ended at `end` [s] of the scene and took `time` and `work` [ms].
    pub(super) fn step(&mut self, end: f64, time: f64, work: f64) {
        // What ends at the end of a frame but for rounding belongs to it.
        let frame = (end * RATE - 1e-6).max(0.0) as usize;
        if self.time.len() <= frame {
            self.time.resize(frame + 1, 0.0);
            self.work.resize(frame + 1, 0.0);
        }
        self.time[frame] += time;
        self.work[frame] += work;
    }

    /// What they cost.
    pub(super) fn cost(&self) -> FrameCost {
        let sorted = sorted(&self.time);
        FrameCost {
            count: sorted.len(),
            median_ms: quantile(&sorted, 0.5),
            p99_ms: quantile(&sorted, 0.99),
            worst_ms: quantile(&sorted, 1.0),
        }
    }

    /// Counted work of the dearest frame [ms].
    pub(super) fn worst_work(&self) -> f64 {
        self.work.iter().copied().fold(0.0, f64::max)
    }

    /// Counted work of all [ms].
    pub(super) fn work(&self) -> f64 {
        self.work.iter().sum()
    }

    /// Time of all [s].
    pub(super) fn seconds(&self) -> f64 {
        1e-3 * self.time.iter().sum::<f64>()
    }
}

/// Ascending.
pub(super) fn sorted(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// The value that a share of an ascending list does not exceed; 0 of an empty one.
pub(super) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(place.clamp(1, sorted.len().max(1)) - 1).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_belong_to_the_frame_that_they_end_in() {
        let mut frames = Frames::default();
        for k in 1..=8 {
            frames.step(f64::from(k) / 240.0, 1.0, f64::from(k));
        }
        assert_eq!((frames.time.as_slice(), frames.work.as_slice()), (&[4.0, 4.0][..], &[10.0, 26.0][..]));
        frames.step(0.1, 7.0, 1.0);
        let cost = frames.cost();
        assert_eq!(
            (cost.count, cost.median_ms, cost.worst_ms),
            (6, 0.0, 7.0),
            "a step over several frames ends in one"
        );
        assert_eq!((frames.worst_work(), frames.work()), (26.0, 37.0));
    }

    #[test]
    fn quantiles_are_values_of_the_list() {
        assert_eq!([0.0, 0.5, 0.99, 1.0].map(|share| quantile(&[1.0, 2.0, 3.0, 4.0], share)), [1.0, 2.0, 4.0, 4.0]);
        assert_eq!(quantile(&[], 0.5), 0.0);
    }
}
