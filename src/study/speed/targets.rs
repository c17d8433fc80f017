//! What is to be reached, and what was.

use serde::Serialize;

use super::SpeedReport;
use super::kernels::KernelRow;
use super::peers::PeerRatio;
use super::run::SpeedRun;

/// A row of `targets.csv`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TargetRow {
    /// What is measured, and its unit.
    pub what: String,
    /// At least this is to be reached; empty where there is a most.
    pub at_least: Option<f64>,
    /// At most this.
    pub at_most: Option<f64>,
    /// The worst that was measured; empty where nothing was.
    pub measured: Option<f64>,
    /// Whether it is reached.
    pub is_reached: Option<bool>,
}

fn at_most(what: impl Into<String>, most: f64, measured: impl Iterator<Item = f64>) -> TargetRow {
    let measured = measured.reduce(f64::max);
    let is_reached = measured.map(|value| value <= most);
    TargetRow { what: what.into(), at_least: None, at_most: Some(most), measured, is_reached }
}

fn at_least(what: impl Into<String>, least: f64, measured: impl Iterator<Item = f64>) -> TargetRow {
    let measured = measured.reduce(f64::min);
    let is_reached = measured.map(|value| value >= least);
    TargetRow { what: what.into(), at_least: Some(least), at_most: None, measured, is_reached }
}

/// Every target, with the worst of what a study measured for it.
pub(super) fn judge(report: &SpeedReport) -> Vec<TargetRow> {
    let mut rows = sweeps(&report.kernels);
    rows.extend(frames(&report.frames));
    rows.extend(peers(&report.ratios));
    rows.extend(others(report));
    rows
}

/// Sweeps in `f32`.
fn sweeps(kernels: &[KernelRow]) -> Vec<TargetRow> {
    let widest = |row: &&KernelRow| row.instruction_set == crate::sim::InstructionSet::chosen().name();
    let of = |families: &'static [&'static str]| {
        kernels.iter().filter(move |row| row.precision == "f32" && families.contains(&row.family))
    };
    let mesh = || of(&["disc"]).filter(widest);
    let (some, million) = (|row: &&KernelRow| row.points < 500_000, |row: &&KernelRow| row.points >= 500_000);
    let mut rows = vec![
        at_most("sweep of a mesh to 100 k points [ns a bond]", 3.0, mesh().filter(some).map(|row| row.sweep_ns)),
        at_most("sweep of a mesh of 1 M points [ns a bond]", 4.0, mesh().filter(million).map(|row| row.sweep_ns)),
        at_least("sweep of a mesh to 100 k points [plain program = 1]", 4.0, mesh().filter(some).map(|row| row.ratio)),
        at_least("sweep of a mesh of 1 M points [plain program = 1]", 3.0, mesh().filter(million).map(|row| row.ratio)),
        at_most("mesh of 1 M points, a step of one sweep [ms]", 12.0, mesh().filter(million).map(|row| row.step_ms)),
        at_most(
            "hard grid of 1 M points, a step of one sweep [ms]",
            2.6,
            of(&["hard"]).filter(widest).filter(million).map(|row| row.step_ms),
        ),
    ];
    for (set, ns, ratio) in [("avx512", 0.62, 15.0), ("avx2", 1.0, 12.0)] {
        for family in [&["net"], &["hard"], &["rope"], &["rims"]] {
            let large = || of(family).filter(|row| row.instruction_set == set && row.points >= 9_000);
            let name = format!("sweep of {} from 10 k points, {set}", family[0]);
            rows.push(at_most(format!("{name} [ns a bond]"), ns, large().map(|row| row.sweep_ns)));
            rows.push(at_least(format!("{name} [plain program = 1]"), ratio, large().map(|row| row.ratio)));
        }
    }
    rows
}

/// Frames on one core; a run that does not hold its strain counts as infinitely dear.
fn frames(runs: &[SpeedRun]) -> Vec<TargetRow> {
    const TARGETS: [(&str, f64, f64); 7] = [
        ("hard-100", 0.02, 0.12),
        ("net-316", 1e-3, 0.8),
        ("hard-corners-100", 0.02, 0.8),
        ("net-corners-100", 0.02, 0.6),
        ("rope-1000", 1e-3, 0.05),
        ("rope-10k", 1e-3, 0.7),
        ("rims-1000", 0.02, 0.3),
    ];
    let row = |(scene, strain, most)| {
        let same = runs.iter().filter(|run| run.scene == scene && run.max_strain_asked == Some(strain));
        let cost = |run: &SpeedRun| if run.is_within == Some(true) { run.median_ms } else { f64::INFINITY };
        at_most(format!("{scene}, strain {strain} [ms a frame]"), most, same.map(cost))
    };
    TARGETS.into_iter().map(row).collect()
}

fn peers(ratios: &[PeerRatio]) -> Vec<TargetRow> {
    let of = |scene: &'static str, bound: Option<f64>, engine: &'static str| {
        let same = move |row: &&PeerRatio| {
            row.scene == scene && bound.is_none_or(|bound| row.bound == bound) && row.engine.starts_with(engine)
        };
        ratios.iter().filter(same).filter_map(|row| row.ratio)
    };
    vec![
        at_least("hard-100, strain 0.02 [cheapest other engine = 1]", 40.0, of("hard-100", Some(0.02), "")),
        at_least("rope-50 at equal error [rapier2d = 1]", 10.0, of("rope-50", None, "rapier2d")),
    ]
}

fn others(report: &SpeedReport) -> Vec<TargetRow> {
    let skipped = |is_sleep: bool| {
        let same = report.skipping.iter().filter(move |row| (row.what == "asleep") == is_sleep);
        same.filter_map(|row| row.ratio)
    };
    let threads = |is_large: bool| report.threads.iter().filter(move |row| (row.points >= 99_000) == is_large);
    let all_ms = |family: &'static str, method: &'static str, least: usize| {
        let same = report.threads.iter().filter(move |row| row.scene == family && row.points >= least);
        same.filter(move |row| row.method.ends_with(method)).map(|row| row.all_ms)
    };
    vec![
        at_most("asleep [awake = 1]", 0.01, skipped(true)),
        at_most("mouse away or walls far [without = 1]", 1.02, skipped(false)),
        at_least("all cores, from 100 k points [one = 1]", 1.6, threads(true).map(|row| row.ratio)),
        at_least("all cores, fewer points [one = 1]", 1.0, threads(false).map(|row| row.ratio)),
        at_most("all cores: hard grid of 1 M points, a step of one sweep [ms]", 1.6, all_ms("hard", "f32", 500_000)),
        at_most("all cores: mesh of 1 M points, a step of one sweep [ms]", 7.0, all_ms("disc", "f32", 500_000)),
        at_most("all cores: rims-1000, strain 0.02 [ms a frame]", 0.16, all_ms("rims-1000", "0.02", 0)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_counts_and_nothing_is_neither() {
        assert_eq!(at_most("a", 2.0, [1.0, 3.0].into_iter()).is_reached, Some(false));
        assert_eq!(at_least("a", 2.0, [5.0, 3.0].into_iter()).measured, Some(3.0));
        assert_eq!(at_least("a", 2.0, std::iter::empty()).is_reached, None);
    }
}
