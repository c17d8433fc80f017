//! Error against cost on one problem: a line a method, further down and to the left is better.

use super::axes::{Panel, Scale};
use super::figure::{Anchor, Figure};
use super::style::{GREY, LABEL, Look, MAJOR, SMALL, TEXT, TITLE, look, mark};
use crate::study::accuracy::{MethodReport, ProblemReport};
use crate::study::fit::cost_beyond;
use crate::study::problems::Kind;
use crate::study::targets::LEVELS;

/// Errors that are shown `[m]`: above, nothing is resolved; below, the truth's own digits end.
const SHOWN: std::ops::RangeInclusive<f64> = 1e-14..=10.0;

/// The plot of a problem.
pub(crate) fn work(problem: &ProblemReport) -> Figure {
    let series = series(problem);
    let legend = 22.0 * (series.len() as f64 + 1.0) + 40.0;
    let height = f64::max(430.0, legend + 70.0);
    let mut figure = Figure::new(824.0, height);
    let shown = || series.iter().flat_map(|report| points(report));
    let panel = Panel {
        left: 78.0,
        top: 46.0,
        right: 490.0,
        bottom: height - 58.0,
        x: Scale::decades(shown().map(|[cost, _]| cost)),
        y: Scale::decades(shown().map(|[_, error]| error).chain(LEVELS)),
    };
    panel.grid(&mut figure);
    for level in LEVELS {
        figure.dashes(panel.level(level), GREY, 1.0);
    }
    for other in problem.baseline.iter().filter(|report| !series.iter().any(|drawn| drawn.method == report.method)) {
        let line = points(other).map(|point| panel.place(point)).collect();
        figure.line(line, MAJOR, 1.0);
    }
    // The baseline last, over the rest.
    for report in series.iter().rev() {
        draw(&mut figure, &panel, report);
    }
    let kind = if problem.kind == Kind::Static { ", at rest" } else { "" };
    figure.text([panel.left, 24.0], format!("{}{kind}", problem.name), TITLE, Anchor::Start, TEXT);
    panel.frame(&mut figure, "cost [wall seconds a simulated second]", "error at the end [m]");
    draw_legend(&mut figure, &series, [panel.right + 22.0, panel.top]);
    figure
}

/// The baseline and every solver that ran, each by its best variant.
fn series(problem: &ProblemReport) -> Vec<&MethodReport> {
    let mut list: Vec<&MethodReport> = Vec::new();
    for report in problem.baseline.iter().chain(&problem.methods).filter(|report| points(report).next().is_some()) {
        match list.iter_mut().find(|other| other.solver == report.solver) {
            Some(other) if is_better(report, other) => *other = report,
            Some(_) => {}
            None => list.push(report),
        }
    }
    list
}

/// Whether a variant is cheaper at the first of the errors that either of the two gets to.
fn is_better(one: &MethodReport, other: &MethodReport) -> bool {
    for level in LEVELS {
        let cost = |report: &MethodReport| cost_beyond(&report.runs, level).map_or(f64::INFINITY, |cost| cost.cost);
        if cost(one) != cost(other) {
            return cost(one) < cost(other);
        }
    }
    let least = |report: &MethodReport| report.runs.iter().map(|run| run.error).fold(f64::INFINITY, f64::min);
    least(one) < least(other)
}

/// Cost and error of the runs that are shown; an exact one is drawn at the edge.
fn points(report: &MethodReport) -> impl Iterator<Item = [f64; 2]> {
    let (least, most) = SHOWN.into_inner();
    report.runs.iter().filter(move |run| run.error <= most).map(move |run| [run.cost, run.error.max(least)])
}

fn draw(figure: &mut Figure, panel: &Panel, report: &MethodReport) {
    let look = look(report.solver);
    let line: Vec<[f64; 2]> = points(report).map(|point| panel.place(point)).collect();
    figure.line(line.clone(), look.colour, look.width);
    for at in line {
        mark(figure, at, look);
    }
}

/// A line a method with its marker, its name and its observed order, beside the panel.
fn draw_legend(figure: &mut Figure, series: &[&MethodReport], [left, top]: [f64; 2]) {
    const ROW: f64 = 22.0;
    let column = left + 292.0;
    figure.text([column, top + 8.0], "order", SMALL, Anchor::End, TEXT);
    for (i, report) in series.iter().enumerate() {
        let y = top + 8.0 + ROW * (i as f64 + 1.0);
        entry(figure, [left, y], &report.method, look(report.solver));
        let order = report.observed_order.map_or("–".to_owned(), |order| format!("{order:.1}"));
        figure.text([column, y], order, LABEL, Anchor::End, TEXT);
    }
}

/// A piece of a line with its marker, and its name.
pub(super) fn entry(figure: &mut Figure, [x, y]: [f64; 2], name: &str, look: Look) {
    figure.line(vec![[x, y], [x + 24.0, y]], look.colour, look.width);
    mark(figure, [x + 12.0, y], look);
    figure.text([x + 32.0, y], name, LABEL, Anchor::Start, TEXT);
}
