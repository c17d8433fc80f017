//! How long things take, smoothed so that it can be read.

/// A moving average of times `[s]`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meter {
    average: Option<f64>,
}

/// Share of the newest value: at 60 frames a second the average follows within a third of a second.
const NEWEST: f64 = 0.08;

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
