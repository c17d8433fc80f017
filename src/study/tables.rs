//! The tables of a study, as CSV.

use std::io::{Result, Write};

use super::accuracy::{MethodReport, ProblemReport};
use super::equal::{EqualError, Priced};
use super::slides::Slides;

/// A row a run.
pub(super) fn runs(problems: &[ProblemReport], to: impl Write) -> Result<()> {
    let mut rows = csv::Writer::from_writer(to);
    rows.write_record([
        "problem",
        "method",
        "steps",
        "substep_s",
        "seconds",
        "cost",
        "error_m",
        "largest_error_m",
        "energy_drift",
        "substeps",
        "bonds_solved",
        "points_moved",
        "iterations",
        "events",
        "fallbacks",
    ])?;
    for (problem, report) in reports(problems) {
        for run in &report.runs {
            let work = &run.work;
            let counts =
                [work.substeps, work.bonds_solved, work.points_moved, work.iterations, work.events, work.fallbacks];
            rows.write_field(problem)?;
            rows.write_field(&report.method)?;
            rows.write_field(run.steps.to_string())?;
            for value in [run.substep, run.seconds, run.cost, run.error, run.largest_error] {
                rows.write_field(number(value))?;
            }
            rows.write_field(run.energy_drift.map_or(String::new(), number))?;
            for count in counts {
                rows.write_field(count.to_string())?;
            }
            rows.write_record(None::<&[u8]>)?;
        }
    }
    rows.flush()
}

/// A row a problem and error, with the best method and what is to be reached, then a row a method.
pub(super) fn equal_error(problems: &[ProblemReport], to: impl Write) -> Result<()> {
    let mut rows = csv::Writer::from_writer(to);
    rows.write_record([
        "problem",
        "error_m",
        "rank",
        "method",
        "cost",
        "baseline",
        "baseline_cost",
        "ratio",
        "target",
        "reached",
    ])?;
    for problem in problems {
        for level in &problem.equal_error {
            if level.methods.is_empty() {
                rows.write_record(equal_error_row(problem.name, level, None))?;
            }
            for ranked in level.methods.iter().enumerate() {
                rows.write_record(equal_error_row(problem.name, level, Some(ranked)))?;
            }
        }
    }
    rows.flush()
}

/// A row a problem and what was asked: nothing, or an error.
pub(super) fn asked(problems: &[ProblemReport], to: impl Write) -> Result<()> {
    let mut rows = csv::Writer::from_writer(to);
    rows.write_record([
        "problem",
        "asked_m",
        "method",
        "substep_s",
        "expected_error_m",
        "error_m",
        "size_m",
        "error_of_size",
        "holds",
        "seconds",
        "search_seconds",
        "refused",
    ])?;
    for (problem, report) in problems.iter().flat_map(|problem| problem.tolerance.iter().map(|one| (problem.name, one)))
    {
        let maybe = |value: Option<f64>| value.map_or(String::new(), number);
        let error = report.errors.iter().copied().reduce(f64::max);
        rows.write_record([
            problem,
            &report.tolerance.map_or("default".to_owned(), number),
            report.solver.as_deref().unwrap_or(""),
            &maybe(report.substep),
            &maybe(report.expected_error),
            &maybe(error),
            &number(report.size),
            &maybe(error.map(|error| error / report.size)),
            &report.holds.map_or(String::new(), |holds| holds.to_string()),
            &maybe(report.seconds),
            &maybe(report.search_seconds),
            report.refused.as_deref().unwrap_or(""),
        ])?;
    }
    rows.flush()
}

/// The row of a method; target and whether it is reached stand with the best one.
fn equal_error_row(problem: &str, level: &EqualError, ranked: Option<(usize, &Priced)>) -> [String; 10] {
    let (baseline, baseline_cost) = match &level.baseline {
        Some(priced) => (priced.method.clone(), priced.cost.cost),
        None => ("never".to_owned(), f64::INFINITY),
    };
    let is_first = ranked.is_none_or(|(i, _)| i == 0);
    let is_guess = level.baseline.as_ref().is_some_and(|priced| priced.cost.is_extrapolated);
    let (rank, method, cost, ratio) = match ranked {
        None => (String::new(), "none".to_owned(), String::new(), String::new()),
        Some((i, priced)) => {
            let ratio = level.ratio.map_or(String::new(), |_| number(baseline_cost / priced.cost.cost));
            ((i + 1).to_string(), priced.method.clone(), number(priced.cost.cost), ratio)
        }
    };
    [
        problem.to_owned(),
        number(level.error),
        rank,
        method,
        cost,
        baseline,
        format!("{}{}", if is_guess { "~" } else { "" }, number(baseline_cost)),
        ratio,
        level.target.filter(|_| is_first).map_or(String::new(), number),
        level.is_reached.filter(|_| is_first).map_or(String::new(), |reached| reached.to_string()),
    ]
}

/// A row a problem and method: its observed order and how far it came.
pub(super) fn orders(problems: &[ProblemReport], to: impl Write) -> Result<()> {
    let mut rows = csv::Writer::from_writer(to);
    rows.write_record(["problem", "method", "order", "runs", "least_error_m", "refused"])?;
    for (problem, report) in reports(problems) {
        let least = report.runs.iter().map(|run| run.error).reduce(f64::min);
        rows.write_record([
            problem,
            &report.method,
            &report.observed_order.map_or(String::new(), |order| format!("{order:.3}")),
            &report.runs.len().to_string(),
            &least.map_or(String::new(), number),
            report.refused.as_deref().unwrap_or(""),
        ])?;
    }
    rows.flush()
}

/// A row a value of the lectures' experiments, beside its closed form where there is one.
pub(super) fn slides(slides: &Slides, to: impl Write) -> Result<()> {
    let mut rows = csv::Writer::from_writer(to);
    rows.write_record(["experiment", "method", "parameter", "value", "expected"])?;
    let mut row = |experiment: &str, method: &str, parameter: f64, value: f64, expected: Option<f64>| {
        let expected = expected.map_or(String::new(), number);
        rows.write_record([experiment, method, &number(parameter), &number(value), &expected])
    };
    for circle in &slides.circle {
        row("circle: growth a step", "Euler", circle.h, circle.growth_step, Some(circle.expected_step))?;
        row("circle: growth a turn", "Euler", circle.h, circle.growth_turn, Some(circle.expected_turn))?;
    }
    for decay in &slides.decay {
        row("decay: factor a step", decay.method, decay.hk, decay.factor, Some(decay.expected))?;
    }
    for error in &slides.errors {
        row("order: error after 1 s", error.method, error.h, error.error, None)?;
    }
    for order in &slides.orders {
        row("order: observed", order.method, 0.0, order.order, Some(order.expected))?;
    }
    rows.flush()
}

fn reports(problems: &[ProblemReport]) -> impl Iterator<Item = (&'static str, &MethodReport)> {
    problems.iter().flat_map(|problem| {
        let all = problem.baseline.iter().chain(&problem.methods);
        all.map(|report| (problem.name, report))
    })
}

/// The shortest digits that read back as the same number.
fn number(value: f64) -> String {
    format!("{value:?}")
}
