//! Where each method holds, degrades and breaks: one line a sweep and method.

use serde::Serialize;

use super::{Outcome, Sweep, SweepRun};

/// A method over a sweep: from where to where it holds, going out from the value nearest to the most harmless one at which it does, and
/// what fails first beyond.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LimitRow {
    /// The sweep.
    pub sweep: &'static str,
    /// The solver.
    pub method: &'static str,
    /// The smallest value up to which it holds, coming down; empty where it holds nowhere.
    pub holds_from: Option<f64>,
    /// The largest.
    pub holds_to: Option<f64>,
    /// The first value below at which something fails.
    pub fails_below: Option<f64>,
    /// The first value above.
    pub fails_above: Option<f64>,
    /// The first value below at which it breaks.
    pub breaks_below: Option<f64>,
    /// The first value above.
    pub breaks_above: Option<f64>,
    /// What failed first, above or else below; of a refusal its reason.
    pub why: String,
}

/// The lines of a sweep's runs, a method each in the order in which they come.
pub fn limits(sweep: &Sweep, runs: &[SweepRun]) -> Vec<LimitRow> {
    let mut methods: Vec<&'static str> = Vec::new();
    for run in runs.iter().filter(|run| run.sweep == sweep.name) {
        if !methods.contains(&run.method) {
            methods.push(run.method);
        }
    }
    methods.into_iter().map(|method| row(sweep, method, runs)).collect()
}

fn row(sweep: &Sweep, method: &'static str, runs: &[SweepRun]) -> LimitRow {
    let own: Vec<&SweepRun> = runs.iter().filter(|run| run.sweep == sweep.name && run.method == method).collect();
    let home = home(sweep, &own);
    let up: Vec<&SweepRun> = own.iter().copied().filter(|run| run.value >= home).collect();
    let down: Vec<&SweepRun> = own.iter().rev().copied().filter(|run| run.value <= home).collect();
    let (holds_to, above) = walk(&up);
    let (holds_from, below) = walk(&down);
    let breaks = |side: &[&SweepRun]| side.iter().find(|run| run.outcome == Outcome::Breaks).map(|run| run.value);
    LimitRow {
        sweep: sweep.name,
        method,
        holds_from,
        holds_to,
        fails_below: below.map(|run| run.value),
        fails_above: above.map(|run| run.value),
        breaks_below: breaks(&down),
        breaks_above: breaks(&up),
        why: above.or(below).map_or(String::new(), why),
    }
}

/// The value that a method holds at nearest to the most harmless one, the smaller of two; where it holds nowhere the most harmless one.
fn home(sweep: &Sweep, own: &[&SweepRun]) -> f64 {
    let place = |value: f64| sweep.values.iter().position(|other| *other == value).unwrap_or_default();
    let holds = own.iter().filter(|run| run.outcome == Outcome::Holds).map(|run| run.value);
    let nearest = holds.min_by_key(|&value| place(value).abs_diff(sweep.home));
    nearest.unwrap_or(sweep.values[sweep.home])
}

/// The last value that holds on a way out from home, and the first run that does not.
fn walk<'a>(side: &[&'a SweepRun]) -> (Option<f64>, Option<&'a SweepRun>) {
    let count = side.iter().take_while(|run| run.outcome == Outcome::Holds).count();
    (count.checked_sub(1).map(|last| side[last].value), side.get(count).copied())
}

fn why(run: &SweepRun) -> String {
    use crate::study::stability::Ended;
    match &run.found.ended {
        Ended::Refused(reason) => format!("refused: {reason}"),
        _ => run.found.faults.iter().map(|fault| fault.name()).collect::<Vec<_>>().join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::stability::sweeps::find_sweep;

    #[test]
    fn limits_are_found_going_out_from_home() {
        let sweep = find_sweep("stiffness").unwrap();
        let solver = crate::scene::SolverName::Auto;
        let bounds = crate::study::stability::Bounds { work: 0.1, seconds: 60.0 };
        let one = sweep.run(sweep.values[sweep.home], solver, bounds).unwrap();
        let outcomes =
            [Outcome::Breaks, Outcome::Holds, Outcome::Holds, Outcome::Degrades, Outcome::Holds, Outcome::Breaks];
        let first = sweep.home - 2;
        let runs: Vec<SweepRun> = (0..outcomes.len())
            .map(|k| SweepRun { value: sweep.values[first + k], outcome: outcomes[k], ..one.clone() })
            .collect();
        let row = limits(sweep, &runs).remove(0);
        let value = |k: usize| Some(sweep.values[first + k]);
        assert_eq!((row.holds_from, row.holds_to), (value(1), value(2)));
        assert_eq!((row.fails_below, row.fails_above), (value(0), value(3)));
        assert_eq!((row.breaks_below, row.breaks_above), (value(0), value(5)));
    }

    #[test]
    fn what_holds_beside_the_most_harmless_value_alone_is_no_none() {
        let sweep = find_sweep("stiffness").unwrap();
        let solver = crate::scene::SolverName::Auto;
        let bounds = crate::study::stability::Bounds { work: 0.1, seconds: 60.0 };
        let one = sweep.run(sweep.values[sweep.home], solver, bounds).unwrap();
        let outcomes = [Outcome::Holds, Outcome::Holds, Outcome::Degrades, Outcome::Breaks];
        let first = sweep.home - 2;
        let runs = |outcomes: &[Outcome]| -> Vec<SweepRun> {
            let run =
                |(k, &outcome): (usize, &Outcome)| SweepRun { value: sweep.values[first + k], outcome, ..one.clone() };
            outcomes.iter().enumerate().map(run).collect()
        };
        let row = limits(sweep, &runs(&outcomes)).remove(0);
        let value = |k: usize| Some(sweep.values[first + k]);
        assert_eq!((row.holds_from, row.holds_to), (value(0), value(1)));
        assert_eq!((row.fails_below, row.fails_above, row.breaks_above), (None, value(2), value(3)));
        let row = limits(sweep, &runs(&[Outcome::Breaks; 4])).remove(0);
        assert_eq!((row.holds_from, row.holds_to, row.fails_above), (None, None, value(2)));
    }
}
