//! What the frames of a run took.

/// Times of a frame [ms].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Times {
    /// The median frame.
    pub(crate) median_ms: f64,
    /// The worst frame.
    pub(crate) worst_ms: f64,
    /// All frames over their number.
    pub(crate) mean_ms: f64,
}

impl Times {
    /// Of the seconds that each frame took; there is at least one.
    pub(crate) fn of(mut seconds: Vec<f64>) -> Self {
        seconds.sort_by(f64::total_cmp);
        let total: f64 = seconds.iter().sum();
        let count = seconds.len();
        Times {
            median_ms: 1e3 * seconds[count / 2],
            worst_ms: 1e3 * seconds[count - 1],
            mean_ms: 1e3 * total / count as f64,
        }
    }

    /// The least of each time: runs do the same work, so what is more in one of them is the machine's.
    pub(crate) fn least(self, other: Self) -> Self {
        Times {
            median_ms: self.median_ms.min(other.median_ms),
            worst_ms: self.worst_ms.min(other.worst_ms),
            mean_ms: self.mean_ms.min(other.mean_ms),
        }
    }

    /// Time of all frames over those before all slept for good [ms]; a scene lasts `seconds`.
    pub(crate) fn awake_ms(self, asleep_after: Option<f64>, seconds: f64) -> f64 {
        self.mean_ms * seconds / asleep_after.unwrap_or(seconds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_in_milliseconds() {
        let times = Times::of(vec![4e-3, 1e-3, 1e-3]);
        assert_eq!((times.median_ms, times.worst_ms), (1.0, 4.0));
        assert!((times.mean_ms - 2.0).abs() < 1e-12);
        assert!((times.awake_ms(Some(2.0), 8.0) - 8.0).abs() < 1e-12 && times.awake_ms(None, 8.0) < 2.1);
    }
}
