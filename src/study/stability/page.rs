//! The page that a study leaves beside its tables: what was found, in Markdown.

use std::fmt::Write;

use super::Judged;
use super::counted::Counted;
use super::judge::Fault;
use super::report::StabilityReport;
use super::summary::Group;
use super::sweeps::{LimitRow, find_sweep};

/// The page.
pub(super) fn page(report: &StabilityReport) -> String {
    let mut text = head(report);
    if !report.faults.is_empty() {
        faults(report, &mut text);
    }
    if !report.groups.is_empty() {
        groups(report, &mut text);
        counters(report, &mut text);
    }
    if !report.limits.is_empty() {
        limits(report, &mut text);
    }
    text
}

/// A line; writing to a text cannot fail.
macro_rules! line {
    ($to:expr, $($word:tt)*) => { let _ = writeln!($to, $($word)*); };
}

fn head(report: &StabilityReport) -> String {
    let mut text = String::from("# Stability\n\n");
    let commit = report.commit.as_deref().map_or(String::new(), |commit| format!(", commit {commit}"));
    line!(text, "wobble {}{commit}, on {}, by `{}`.", report.version, report.machine.processor, report.command);
    if cfg!(debug_assertions) {
        line!(text, "The program was built with assertions: it takes longer, and judges alike.");
    }
    if !report.is_finished {
        line!(text, "The study was not finished.");
    }
    line!(
        text,
        "Judgements go by counted work and by the motion, and are the same on every machine; times are of this one. A case \
         runs for {} s of its scene, and is stopped after {} s of counted work.",
        report.settings.case_seconds,
        report.settings.case_bounds.work
    );
    text
}

fn faults(report: &StabilityReport, text: &mut String) {
    line!(text, "\n## What fails\n");
    line!(text, "Of {} scenes:\n", report.judged.len());
    line!(
        text,
        "| fault | what is measured | at most | scenes | share | worst | measured |\n|---|---|---|---|---|---|---|"
    );
    for row in &report.faults {
        let (share, measured) = (100.0 * row.share, short(row.measured));
        line!(
            text,
            "| {} | {} | {} | {} | {share:.1} % | {} | {measured} |",
            row.fault,
            row.figure,
            short(row.most),
            row.cases,
            row.worst
        );
    }
}

fn groups(report: &StabilityReport, text: &mut String) {
    line!(text, "\n## By family, by path, by what moved them and by cause\n");
    line!(
        text,
        "Moved: whether the live step took over, and why. Rate: stepping time a simulated second; slow frame: of a hundred frames the second slowest, in the median over scenes.\n"
    );
    line!(
        text,
        "| by | | scenes | with a fault | rate p50 / p90 / p99 | by counted work | slow frame, worst p99 [ms] | faults |"
    );
    line!(text, "|---|---|---|---|---|---|---|---|");
    for group in &report.groups {
        let Group { by, name, cases, .. } = group;
        let rates = [group.rate_p50, group.rate_p90, group.rate_p99].map(short).join(" / ");
        let work = [group.work_rate_p50, group.work_rate_p90, group.work_rate_p99].map(short).join(" / ");
        let frames = [group.slow_frame_p50_ms, group.worst_frame_p99_ms].map(short).join(", ");
        let counted = Fault::ALL.iter().zip(&group.faults).filter(|(_, count)| **count > 0);
        let faults = counted.map(|(fault, count)| format!("{} {count}", fault.name())).collect::<Vec<_>>().join(", ");
        line!(
            text,
            "| {by} | {name} | {cases} | {:.0} % | {rates} | {work} | {frames} | {faults} |",
            100.0 * group.faulty
        );
    }
}

/// A row a counter: how many scenes have any, and which the most.
fn counters(report: &StabilityReport, text: &mut String) {
    line!(text, "\n## What was counted\n");
    line!(text, "| counter | scenes that have any | in all | most | in |\n|---|---|---|---|---|");
    for (place, (name, _)) in Counted::default().list().into_iter().enumerate() {
        let of = |one: &Judged| one.found.counters.list()[place].1;
        let with = report.judged.iter().filter(|one| of(one) > 0).count();
        let sum: u64 = report.judged.iter().map(of).sum();
        // Of equals the first.
        let most = report.judged.iter().rev().max_by_key(|one| of(one)).filter(|one| of(one) > 0);
        let (most, case) = most.map_or((0, ""), |one| (of(one), &one.name));
        line!(text, "| {} | {with} | {sum} | {most} | {case} |", name.replace('_', " "));
    }
}

/// A row a sweep, a column a method.
fn limits(report: &StabilityReport, text: &mut String) {
    let mut methods: Vec<&str> = Vec::new();
    let mut sweeps: Vec<&str> = Vec::new();
    for row in &report.limits {
        if !methods.contains(&row.method) {
            methods.push(row.method);
        }
        if !sweeps.contains(&row.sweep) {
            sweeps.push(row.sweep);
        }
    }
    line!(text, "\n## Where methods hold, degrade and break\n");
    line!(
        text,
        "The last value that holds, going out from the most harmless one at which the method does, then the first that fails, and the first that breaks (not \
         finite, twice the energy, bonds of twice their length, or no end), where that is another one. Where smaller values fail too \
         both ends are given, and the first that fails below. `all`: nothing fails; `none`: all that were tried fail.\n"
    );
    line!(text, "| sweep | {} |", methods.join(" | "));
    line!(text, "|---|{}", "---|".repeat(methods.len()));
    for sweep in sweeps {
        let quantity = find_sweep(sweep).map_or("", |sweep| sweep.quantity);
        let of = |method: &&str| report.limits.iter().find(|row| row.sweep == sweep && row.method == *method);
        let cells: Vec<String> = methods.iter().map(|method| of(method).map_or(String::new(), cell)).collect();
        line!(text, "| {sweep}: {quantity} | {} |", cells.join(" | "));
    }
}

fn cell(row: &LimitRow) -> String {
    if row.why.starts_with("refused") {
        return "refused".to_owned();
    }
    let holds = match (row.holds_from, row.holds_to, row.fails_below, row.fails_above) {
        (None, ..) | (_, None, ..) => "none".to_owned(),
        (_, _, None, None) => return "all".to_owned(),
        (_, Some(to), None, _) => short(to),
        (Some(from), Some(to), Some(_), _) if from == to => short(to),
        (Some(from), Some(to), Some(_), _) => format!("{} to {}", short(from), short(to)),
    };
    // Where the most harmless value fails it is the first on both sides.
    let below = row.fails_below.filter(|below| Some(*below) != row.fails_above);
    let side = |fails: Option<f64>, breaks: Option<f64>| match (fails, breaks) {
        (Some(fails), Some(breaks)) if fails == breaks => format!("; breaks {}", short(breaks)),
        (Some(fails), Some(breaks)) => format!("; fails {}, breaks {}", short(fails), short(breaks)),
        (Some(fails), None) => format!("; fails {}", short(fails)),
        (None, _) => String::new(),
    };
    holds + &side(below, row.breaks_below) + &side(row.fails_above, row.breaks_above)
}

/// Two digits.
pub(in crate::study) fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    if (0.01..1000.0).contains(&size) {
        let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
        return format!("{rounded}");
    }
    let text = format!("{value:.1e}");
    text.replace(".0e", "e")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_names_what_holds_what_fails_and_what_breaks() {
        let row = LimitRow {
            sweep: "stiffness",
            method: "auto",
            holds_from: Some(1.0),
            holds_to: Some(1e3),
            fails_below: None,
            fails_above: None,
            breaks_below: None,
            breaks_above: None,
            why: String::new(),
        };
        assert_eq!(cell(&row), "all");
        let row = LimitRow { fails_above: Some(1e4), breaks_above: Some(1e6), ..row };
        assert_eq!(cell(&row), "1e3; fails 1e4, breaks 1e6");
        let row = LimitRow { fails_below: Some(0.1), breaks_above: Some(1e4), ..row };
        assert_eq!(cell(&row), "1 to 1e3; fails 0.1; breaks 1e4");
        let none = LimitRow { holds_from: None, holds_to: None, fails_below: Some(1e4), ..row };
        assert_eq!(cell(&none), "none; breaks 1e4");
    }

    #[test]
    fn numbers_are_short() {
        for (value, text) in
            [(0.0, "0"), (0.25, "0.25"), (1.0 / 60.0, "0.017"), (1e12, "1e12"), (2.5e-4, "2.5e-4"), (123.0, "120")]
        {
            assert_eq!(short(value), text);
        }
        assert_eq!(short(f64::INFINITY), "inf");
    }
}
