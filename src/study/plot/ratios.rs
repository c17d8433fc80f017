//! All problems at once: how many times cheaper the best method is than the baseline, beside what is to be reached.

use super::axes::{Panel, Scale};
use super::figure::{Anchor, Figure};
use super::style::{BLACK, BLUE, LABEL, ORANGE, SMALL, TEXT, TITLE};
use crate::study::accuracy::ProblemReport;
use crate::study::equal::EqualError;
use crate::study::targets::LEVELS;

/// Height of a problem's two bars.
const ROW: f64 = 26.0;

/// Height of one bar.
const BAR: f64 = 9.0;

/// The plot of all problems.
pub(crate) fn ratios(problems: &[ProblemReport]) -> Figure {
    let height = 118.0 + ROW * problems.len() as f64;
    let mut figure = Figure::new(860.0, height);
    let finite = |ratio: Option<f64>| ratio.filter(|ratio| ratio.is_finite() && *ratio > 0.0);
    let levels = || problems.iter().flat_map(|problem| &problem.equal_error);
    let shown = levels().flat_map(|level| [finite(level.ratio), finite(level.target)]).flatten();
    let panel = Panel {
        left: 170.0,
        top: 62.0,
        right: 560.0,
        bottom: height - 56.0,
        x: Scale::decades(shown.chain([1.0, 10.0])),
        y: Scale::Linear { from: 0.0, to: 1.0, step: 1.0, decimals: 0 },
    };
    panel.grid_x(&mut figure);
    for (i, problem) in problems.iter().enumerate() {
        let middle = panel.top + ROW * (i as f64 + 0.5);
        figure.text([panel.left - 8.0, middle], problem.name, SMALL, Anchor::End, TEXT);
        for (k, level) in problem.equal_error.iter().enumerate() {
            let top = middle + if k == 0 { -BAR } else { 0.0 };
            bar(&mut figure, &panel, top, level, colour(k));
            let column = panel.right + 70.0 + 150.0 * k as f64;
            figure.text([column, middle], measured(level), SMALL, Anchor::End, TEXT);
            let target = level.target.map_or(String::new(), |target| format!("of {}", short(target)));
            figure.text([column + 6.0, middle], target, SMALL, Anchor::Start, TEXT);
        }
    }
    figure.line(panel.upright(1.0).to_vec(), TEXT, 1.0);
    panel.frame(&mut figure, "cost of the sources' method over cost of the best method, at equal error", "");
    figure.text([panel.left, 20.0], "How many times cheaper", TITLE, Anchor::Start, TEXT);
    draw_legend(&mut figure, &panel);
    figure
}

fn colour(level: usize) -> plotters::prelude::RGBColor {
    [BLUE, ORANGE][level % 2]
}

/// A bar from 1 to the ratio, with a tick where the target is; an infinite one goes to the edge.
fn bar(figure: &mut Figure, panel: &Panel, top: f64, level: &EqualError, colour: plotters::prelude::RGBColor) {
    let across = |ratio: f64| panel.left + (panel.right - panel.left) * panel.x.share(ratio).clamp(0.0, 1.0);
    if let Some(ratio) = level.ratio {
        let (from, to) = (across(1.0), across(ratio));
        figure.block([from.min(to), top + 0.5], [from.max(to), top + BAR - 0.5], colour);
    }
    if let Some(target) = level.target {
        let x = across(target);
        figure.line(vec![[x, top - 0.5], [x, top + BAR + 0.5]], BLACK, 2.0);
    }
}

fn measured(level: &EqualError) -> String {
    let is_guess = level.baseline.as_ref().is_some_and(|priced| priced.cost.is_extrapolated);
    match level.ratio {
        None => "–".to_owned(),
        Some(ratio) if is_guess => format!("~{}", short(ratio)),
        Some(ratio) => short(ratio),
    }
}

/// Two digits, with thousands apart.
fn short(ratio: f64) -> String {
    if ratio.is_infinite() {
        return "∞".to_owned();
    }
    if ratio < 10.0 {
        return if ratio < 0.1 { format!("{ratio:.1e}") } else { format!("{ratio:.1}") };
    }
    let unit = 10_f64.powf(ratio.log10().floor() - 1.0);
    let digits = format!("{:.0}", (ratio / unit).round() * unit);
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

fn draw_legend(figure: &mut Figure, panel: &Panel) {
    const Y: f64 = 46.0;
    let mut x = panel.left;
    for (k, level) in LEVELS.into_iter().enumerate() {
        figure.block([x, Y - 5.0], [x + 18.0, Y + 5.0], colour(k));
        let name = if level == 1e-3 { "error 1 mm" } else { "error 1 µm" };
        figure.text([x + 24.0, Y], name, LABEL, Anchor::Start, TEXT);
        figure.text([panel.right + 70.0 + 150.0 * k as f64, Y], name, SMALL, Anchor::End, TEXT);
        x += 116.0;
    }
    figure.line(vec![[x + 6.0, Y - 6.0], [x + 6.0, Y + 6.0]], BLACK, 2.0);
    figure.text([x + 16.0, Y], "to reach", LABEL, Anchor::Start, TEXT);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_are_short() {
        for (ratio, text) in
            [(0.84, "0.8"), (0.0153, "1.5e-2"), (35.4, "35"), (2345.0, "2,300"), (617_000.0, "620,000"), (99.7, "100")]
        {
            assert_eq!(short(ratio), text);
        }
        assert_eq!(short(f64::INFINITY), "∞");
    }
}
