//! Roots of functions of one variable.

/// A bracketed root, found step by step: ask for [`Root::guess`], evaluate there, and [`Root::narrow`].
///
/// Secants with the Illinois rule: an end that stays twice loses half of its value, so that both ends close in.
/// Order 1.44; the bracket never loses the root. Source: M. Dowell and P. Jarratt, BIT 11, 168 (1971).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Root {
    low: (f64, f64),
    high: (f64, f64),
    side: i8,
}

impl Root {
    /// A root between `low` and `high`, where the function has these values of opposite sign.
    pub(crate) fn between(low: (f64, f64), high: (f64, f64)) -> Self {
        Root { low, high, side: 0 }
    }

    /// Where to look next.
    pub(crate) fn guess(&self) -> f64 {
        let ((a, fa), (b, fb)) = (self.low, self.high);
        let x = (a * fb - b * fa) / (fb - fa);
        if x > a && x < b { x } else { 0.5 * (a + b) }
    }

    /// Whether a place lies within the bracket.
    pub(crate) fn contains(&self, x: f64) -> bool {
        x > self.low.0 && x < self.high.0
    }

    /// The function is `value` at `x`.
    pub(crate) fn narrow(&mut self, x: f64, value: f64) {
        if (value > 0.0) == (self.low.1 > 0.0) {
            self.low = (x, value);
            if self.side == -1 {
                self.high.1 *= 0.5;
            }
            self.side = -1;
        } else {
            self.high = (x, value);
            if self.side == 1 {
                self.low.1 *= 0.5;
            }
            self.side = 1;
        }
    }

    /// Width of the bracket.
    pub(crate) fn width(&self) -> f64 {
        self.high.0 - self.low.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_solved_in_a_few_steps() {
        let f = |x: f64| 2.0 - x * x;
        let mut root = Root::between((0.0, f(0.0)), (2.0, f(2.0)));
        let mut last = 0.0;
        for _ in 0..10 {
            last = root.guess();
            root.narrow(last, f(last));
        }
        assert!((last - 2.0_f64.sqrt()).abs() < 1e-14, "{last}");
    }
}
