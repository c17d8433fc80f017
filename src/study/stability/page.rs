//! The page that a study leaves beside its tables: what was found, in Markdown.

use std::fmt::Write;

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
            row.most,
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
        "The last value that holds, going out from the most harmless one, and after a stroke the first that breaks (not finite, \
         twice the energy, bonds of twice their length, or no end). Where small values fail too the range is given. `all`: nothing \
         fails; `none`: the most harmless value fails.\n"
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
    let breaks = row.breaks_above.or(row.breaks_below).map_or(String::new(), |value| format!(" / {}", short(value)));
    let holds = match (row.holds_from, row.holds_to, row.fails_below, row.fails_above) {
        (None, ..) | (_, None, ..) => "none".to_owned(),
        (_, _, None, None) => "all".to_owned(),
        (_, Some(to), None, _) => short(to),
        (Some(from), Some(to), Some(_), _) => format!("{} to {}", short(from), short(to)),
    };
    holds + &breaks
}

/// Two digits.
fn short(value: f64) -> String {
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
    fn numbers_are_short() {
        for (value, text) in
            [(0.0, "0"), (0.25, "0.25"), (1.0 / 60.0, "0.017"), (1e12, "1e12"), (2.5e-4, "2.5e-4"), (123.0, "120")]
        {
            assert_eq!(short(value), text);
        }
        assert_eq!(short(f64::INFINITY), "inf");
    }
}
