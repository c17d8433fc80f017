//! The battery by family, by path and by cause; and what its faults come to.

use serde::Serialize;

use super::Judged;
use super::judge::Fault;
use super::quantile::{quantile, sorted};
use super::run::Ended;
use super::subject::Cause;

/// Cases that have something in common.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Group {
    /// `all`, `family`, `path`, `moved` or `cause`.
    pub by: &'static str,
    /// What they have in common.
    pub name: String,
    /// How many they are.
    pub cases: usize,
    /// Share of them with a fault `[1]`.
    pub faulty: f64,
    /// Time of stepping a simulated second, in the median `[1]`.
    pub rate_p50: f64,
    /// What nine in ten do not exceed.
    pub rate_p90: f64,
    /// What 99 in a hundred do not exceed.
    pub rate_p99: f64,
    /// The same of counted work a simulated second `[s]`.
    pub work_rate_p50: f64,
    /// What nine in ten do not exceed.
    pub work_rate_p90: f64,
    /// What 99 in a hundred do not exceed.
    pub work_rate_p99: f64,
    /// Of the cases' median frames the median `[ms]`.
    pub frame_p50_ms: f64,
    /// Of their slow frames (99 in a hundred are faster) the median `[ms]`.
    pub slow_frame_p50_ms: f64,
    /// Of their worst frames what 99 in a hundred do not exceed `[ms]`.
    pub worst_frame_p99_ms: f64,
    /// Cases with each fault, in the order of [`Fault::ALL`].
    pub faults: Vec<usize>,
}

/// What a class of faults comes to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FaultRow {
    /// The fault.
    pub fault: &'static str,
    /// What is measured.
    pub figure: &'static str,
    /// What it must not exceed.
    pub most: f64,
    /// Cases that have it.
    pub cases: usize,
    /// Share of all cases `[1]`.
    pub share: f64,
    /// The case that has the most of it.
    pub worst: String,
    /// How much.
    pub measured: f64,
}

/// All, then by family, path, what moved them and cause; cases that were refused stand in none.
pub(super) fn groups(judged: &[Judged]) -> Vec<Group> {
    let run: Vec<&Judged> = judged.iter().filter(|one| !matches!(one.found.ended, Ended::Refused(_))).collect();
    let mut groups = Vec::new();
    if run.is_empty() {
        return groups;
    }
    groups.push(group("all", "all".to_owned(), &run));
    for (by, key) in [("family", family as fn(&Judged) -> String), ("path", path), ("moved", moved)] {
        let mut names: Vec<String> = run.iter().map(|one| key(one)).collect();
        names.sort();
        names.dedup();
        for name in names {
            let own: Vec<&Judged> = run.iter().copied().filter(|one| key(one) == name).collect();
            groups.push(group(by, name, &own));
        }
    }
    for cause in Cause::ALL {
        let own: Vec<&Judged> = run.iter().copied().filter(|one| one.causes.contains(&cause)).collect();
        if !own.is_empty() {
            groups.push(group("cause", cause.name().to_owned(), &own));
        }
    }
    groups
}

fn family(one: &Judged) -> String {
    one.family.clone()
}

fn path(one: &Judged) -> String {
    one.found.path.clone()
}

fn moved(one: &Judged) -> String {
    one.found.moved.clone()
}

fn group(by: &'static str, name: String, own: &[&Judged]) -> Group {
    let of = |figure: fn(&Judged) -> f64| sorted(&own.iter().map(|one| figure(one)).collect::<Vec<_>>());
    let (rate, work) = (of(|one| one.timing.rate), of(|one| one.found.work_rate));
    let faulty = own.iter().filter(|one| !one.found.faults.is_empty()).count();
    let with = |fault: &Fault| own.iter().filter(|one| one.found.faults.contains(fault)).count();
    Group {
        by,
        name,
        cases: own.len(),
        faulty: faulty as f64 / own.len() as f64,
        rate_p50: quantile(&rate, 0.5),
        rate_p90: quantile(&rate, 0.9),
        rate_p99: quantile(&rate, 0.99),
        work_rate_p50: quantile(&work, 0.5),
        work_rate_p90: quantile(&work, 0.9),
        work_rate_p99: quantile(&work, 0.99),
        frame_p50_ms: quantile(&of(|one| one.timing.frames.median_ms), 0.5),
        slow_frame_p50_ms: quantile(&of(|one| one.timing.frames.p99_ms), 0.5),
        worst_frame_p99_ms: quantile(&of(|one| one.timing.frames.worst_ms), 0.99),
        faults: Fault::ALL.iter().map(with).collect(),
    }
}

/// A row a class of faults that any case has.
pub(super) fn faults(judged: &[Judged]) -> Vec<FaultRow> {
    let row = |fault: Fault| {
        let own = judged.iter().filter(|one| one.found.faults.contains(&fault));
        let cases = own.clone().count();
        let worst = own.max_by(|a, b| fault.measured(&a.found).total_cmp(&fault.measured(&b.found)))?;
        let (figure, most) = fault.figure();
        let (share, measured) = (cases as f64 / judged.len() as f64, fault.measured(&worst.found));
        Some(FaultRow { fault: fault.name(), figure, most, cases, share, worst: worst.name.clone(), measured })
    };
    Fault::ALL.into_iter().filter_map(row).collect()
}

/// The places of the subjects that are worst, by the weight of their faults, ties by their order.
pub(super) fn worst(judged: &[Judged], count: usize) -> Vec<usize> {
    let mut list: Vec<usize> = (0..judged.len()).filter(|&one| !judged[one].found.faults.is_empty()).collect();
    list.sort_by(|&a, &b| weight(&judged[b]).total_cmp(&weight(&judged[a])));
    list.truncate(count);
    list
}

fn weight(one: &Judged) -> f64 {
    one.found.faults.iter().map(|fault| fault.weight(&one.found)).sum()
}
