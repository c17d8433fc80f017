//! What drag and a constant push make of a motion in a time, in closed form.

/// Under v' = a - rate v after a time.
pub(super) struct Fall {
    /// The share of a velocity that is kept `[1]`, and how far one of 1 m/s leads `[s]`: how fast a push of 1 m/s^2 makes it, too.
    pub(super) keep: f64,
    pub(super) time: f64,
    /// How far such a push leads `[s^2]`.
    pub(super) late: f64,
}

impl Fall {
    /// Drag of this rate `[1/s]` after `h` `[s]`, which may be below 0.
    pub(super) fn of(rate: f64, h: f64) -> Self {
        if rate == 0.0 {
            return Fall { keep: 1.0, time: h, late: 0.5 * h * h };
        }
        let time = -libm::expm1(-rate * h) / rate;
        Fall { keep: libm::exp(-rate * h), time, late: fallen(rate, h, time) }
    }
}

/// The integral of (1 - exp(-rate s))/rate over s from 0 to h, `time` its integrand at h: by its series where the difference rounds.
fn fallen(rate: f64, h: f64, time: f64) -> f64 {
    let x = rate * h;
    if x.abs() > 1e-2 {
        return (h - time) / rate;
    }
    h * h * (1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x * (1.0 / 720.0 - x / 5040.0)))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_falls_against_drag_is_in_closed_form_on_both_sides_of_the_series() {
        for rate in [1e-9, 0.3, 0.59, 0.61, 40.0] {
            let h = 1.0 / 60.0;
            let time = -libm::expm1(-rate * h) / rate;
            // Simpson's rule over many parts.
            let parts = 1000;
            let at = |k: i32| {
                let s = h * f64::from(k) / f64::from(2 * parts);
                -libm::expm1(-rate * s) / rate
            };
            let sum: f64 = (0..parts).map(|k| at(2 * k) + 4.0 * at(2 * k + 1) + at(2 * k + 2)).sum();
            let expected = sum * h / f64::from(6 * parts);
            assert!((fallen(rate, h, time) / expected - 1.0).abs() < 1e-11, "{rate}");
        }
    }
}
