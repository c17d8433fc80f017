//! A panel: a frame with scales, a faint grid and labels, and the map from data into it.

use super::figure::{Anchor, Figure};
use super::style::{LABEL, MAJOR, MINOR, SMALL, TEXT};

/// From a quantity to a share of a side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Scale {
    /// Between two values, a labelled line every `step`, decimals in a label.
    Linear { from: f64, to: f64, step: f64, decimals: usize },
    /// Between two powers of ten.
    Log { from: i32, to: i32 },
}

impl Scale {
    /// A logarithmic scale of whole decades about those values that are > 0; at least one decade.
    pub(super) fn decades(values: impl Iterator<Item = f64>) -> Self {
        let values = values.filter(|v| *v > 0.0 && v.is_finite());
        let (least, most) = values.fold((f64::INFINITY, 0.0_f64), |(least, most), v| (least.min(v), most.max(v)));
        if most <= 0.0 {
            return Scale::Log { from: 0, to: 1 };
        }
        // A value on a decade but for rounding is on it.
        let from = (least.log10() + 1e-9).floor() as i32;
        let to = (most.log10() - 1e-9).ceil() as i32;
        Scale::Log { from, to: to.max(from + 1) }
    }

    /// 0 at the start of the scale, 1 at its end; not cut off.
    pub(super) fn share(&self, value: f64) -> f64 {
        match *self {
            Scale::Linear { from, to, .. } => (value - from) / (to - from),
            Scale::Log { from, to } => (value.log10() - f64::from(from)) / f64::from(to - from),
        }
    }
}

/// A frame in a figure.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
    pub(super) x: Scale,
    pub(super) y: Scale,
}

impl Panel {
    /// Where a pair of values lies.
    pub(super) fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.left + (self.right - self.left) * self.x.share(x),
            self.bottom - (self.bottom - self.top) * self.y.share(y),
        ]
    }

    /// A vertical line at x.
    pub(super) fn upright(&self, x: f64) -> [[f64; 2]; 2] {
        let at = self.left + (self.right - self.left) * self.x.share(x);
        [[at, self.top], [at, self.bottom]]
    }

    /// A horizontal line at y.
    pub(super) fn level(&self, y: f64) -> [[f64; 2]; 2] {
        let at = self.bottom - (self.bottom - self.top) * self.y.share(y);
        [[self.left, at], [self.right, at]]
    }

    /// Draws the grid and the numbers of both sides.
    pub(super) fn grid(&self, figure: &mut Figure) {
        self.grid_x(figure);
        for tick in ticks(&self.y, self.bottom - self.top) {
            let line = self.level(tick.value);
            figure.line(line.to_vec(), if tick.label.is_some() { MAJOR } else { MINOR }, 0.75);
            if let Some(label) = tick.label {
                number(figure, [self.left - 7.0, line[0][1]], &label, Anchor::End);
            }
        }
    }

    /// Draws the grid and the numbers of the lower side alone.
    pub(super) fn grid_x(&self, figure: &mut Figure) {
        for tick in ticks(&self.x, self.right - self.left) {
            let line = self.upright(tick.value);
            figure.line(line.to_vec(), if tick.label.is_some() { MAJOR } else { MINOR }, 0.75);
            if let Some(label) = tick.label {
                number(figure, [line[1][0], self.bottom + 13.0], &label, Anchor::Middle);
            }
        }
    }

    /// Draws the frame and the titles of both sides, over what has been drawn.
    pub(super) fn frame(&self, figure: &mut Figure, x: &str, y: &str) {
        let (l, t, r, b) = (self.left, self.top, self.right, self.bottom);
        figure.line(vec![[l, t], [r, t], [r, b], [l, b], [l, t]], TEXT, 1.0);
        figure.text([(l + r) / 2.0, b + 34.0], x, LABEL, Anchor::Middle, TEXT);
        if !y.is_empty() {
            figure.climbing_text([l - 48.0, (t + b) / 2.0], y, LABEL, TEXT);
        }
    }
}

/// A line of the grid.
struct Tick {
    value: f64,
    label: Option<Label>,
}

/// A number beside a grid line.
enum Label {
    Plain(String),
    /// A power of ten.
    Power(i32),
}

/// Room that a label takes along its side.
const LABEL_ROOM: f64 = 30.0;

/// The lines of the grid along a side of some length: unlabelled ones first, so that the others lie over them.
fn ticks(scale: &Scale, length: f64) -> Vec<Tick> {
    match *scale {
        Scale::Linear { from, to, step, decimals } => {
            let count = ((to - from) / step).round() as u32;
            let value = |i: u32| from + f64::from(i) * step;
            // Not -0.
            let label = |v: f64| Label::Plain(format!("{:.decimals$}", v + 0.0).replace('-', "−"));
            let minor = (0..count).map(|i| Tick { value: value(i) + step / 2.0, label: None });
            minor.chain((0..=count).map(|i| Tick { value: value(i), label: Some(label(value(i))) })).collect()
        }
        Scale::Log { from, to } => {
            let decade = length / f64::from(to - from);
            let every = (LABEL_ROOM / decade).ceil().max(1.0) as i32;
            let mut list = Vec::new();
            // Closer lines would be a grey area.
            if decade > 25.0 {
                let within = |power: i32| (2..10).map(move |i| f64::from(i) * 10_f64.powi(power));
                list.extend((from..to).flat_map(within).map(|value| Tick { value, label: None }));
            }
            for power in from..=to {
                let label = (power.rem_euclid(every) == 0).then_some(Label::Power(power));
                list.push(Tick { value: 10_f64.powi(power), label });
            }
            list
        }
    }
}

/// A number; powers of ten with their exponent raised.
fn number(figure: &mut Figure, [x, y]: [f64; 2], label: &Label, anchor: Anchor) {
    match label {
        Label::Plain(text) => figure.text([x, y], text.as_str(), SMALL, anchor, TEXT),
        Label::Power(power) => {
            let exponent = power.to_string().replace('-', "−");
            let raised = 5.2 * exponent.chars().count() as f64;
            let joint = if anchor == Anchor::End { x - raised } else { x + 6.0 - raised / 2.0 };
            figure.text([joint, y], "10", SMALL, Anchor::End, TEXT);
            figure.text([joint + 0.5, y - 5.0], exponent, 0.78 * SMALL, Anchor::Start, TEXT);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_span_their_values() {
        let scale = Scale::decades([3e-7, 2e-2].into_iter());
        assert_eq!(scale, Scale::Log { from: -7, to: -1 });
        assert_eq!(Scale::decades([0.0, 3e-7, 2e-2, f64::INFINITY].into_iter()), scale);
        assert!((scale.share(1e-4) - 0.5).abs() < 1e-12);
        assert_eq!(Scale::decades([1e-3, 1e-3].into_iter()), Scale::Log { from: -3, to: -2 });
        assert_eq!(Scale::decades(std::iter::empty()), Scale::Log { from: 0, to: 1 });
        let linear = Scale::Linear { from: -1.0, to: 1.0, step: 0.5, decimals: 1 };
        assert_eq!(linear.share(0.0), 0.5);
    }

    #[test]
    fn labels_have_room() {
        let labels = |scale: &Scale, length: f64| ticks(scale, length).iter().filter(|t| t.label.is_some()).count();
        assert_eq!(labels(&Scale::Log { from: -12, to: 0 }, 120.0), 5);
        assert_eq!(labels(&Scale::Log { from: -3, to: 0 }, 300.0), 4);
        assert_eq!(labels(&Scale::Linear { from: 0.0, to: 3.0, step: 0.5, decimals: 1 }, 300.0), 7);
    }
}
