//! Where methods break, what is wrong in the battery, and what its cases cost.

use plotters::prelude::RGBColor;

use super::axes::{Panel, Scale};
use super::figure::{Anchor, Figure};
use super::style::{BLACK, BLUE, GREEN, GREY, LABEL, Look, MAJOR, Marker, ORANGE, SMALL, TEXT, TITLE, VERMILION, mark};
use super::work::entry;
use crate::study::stability::{Cause, Ended, Fault, Group, Judged, Outcome, SweepRun, short};

/// Height of a row `[units of the figure]`.
const ROW: f64 = 22.0;

/// A row a sweep, a column a method; in each cell a stripe a value, in the order of the values.
pub(crate) fn outcomes(runs: &[SweepRun]) -> Figure {
    const CELL: f64 = 62.0;
    let (mut sweeps, mut methods): (Vec<&str>, Vec<&str>) = (Vec::new(), Vec::new());
    for run in runs {
        if !sweeps.contains(&run.sweep) {
            sweeps.push(run.sweep);
        }
        if !methods.contains(&run.method) {
            methods.push(run.method);
        }
    }
    let (left, top) = (286.0, 162.0);
    // The line above the columns is to fit, however few there are.
    let width = (left + CELL * methods.len() as f64 + 24.0).max(LEGEND);
    let mut figure = Figure::new(width, top + ROW * sweeps.len() as f64 + 24.0);
    figure.text([18.0, 24.0], "Where methods hold, degrade and break", TITLE, Anchor::Start, TEXT);
    legend(&mut figure, [18.0, 50.0]);
    for (column, method) in methods.iter().enumerate() {
        figure.climbing_text([left + CELL * (column as f64 + 0.5), top - 56.0], method, SMALL, TEXT);
    }
    for (row, sweep) in sweeps.iter().enumerate() {
        let y = top + ROW * row as f64;
        let values = runs.iter().filter(|run| run.sweep == *sweep).map(|run| run.value);
        let [least, most] =
            values.fold([f64::INFINITY, 0.0], |[least, most], value| [value.min(least), value.max(most)]);
        let name = format!("{sweep}, {} to {}", short(least), short(most));
        figure.text([left - 10.0, y + 0.5 * ROW], name, SMALL, Anchor::End, TEXT);
        for (column, method) in methods.iter().enumerate() {
            let x = left + CELL * column as f64;
            let own: Vec<&SweepRun> = runs.iter().filter(|run| run.sweep == *sweep && run.method == *method).collect();
            let width = (CELL - 4.0) / own.len().max(1) as f64;
            for (k, run) in own.iter().enumerate() {
                let from = x + 2.0 + width * k as f64;
                figure.block([from, y + 2.0], [from + width - 0.5, y + ROW - 2.0], colour(run.outcome));
            }
        }
    }
    figure
}

fn colour(outcome: Outcome) -> RGBColor {
    match outcome {
        Outcome::Holds => GREEN,
        Outcome::Degrades => ORANGE,
        Outcome::Breaks => VERMILION,
        Outcome::Refused => MAJOR,
    }
}

/// Width of a figure that its legend fits in.
const LEGEND: f64 = 760.0;

fn legend(figure: &mut Figure, [mut x, y]: [f64; 2]) {
    for outcome in [Outcome::Holds, Outcome::Degrades, Outcome::Breaks, Outcome::Refused] {
        figure.block([x, y - 6.0], [x + 20.0, y + 6.0], colour(outcome));
        figure.text([x + 26.0, y], outcome.name(), LABEL, Anchor::Start, TEXT);
        x += 104.0;
    }
    figure.text(
        [x, y],
        "in each cell values from the least on the left to the largest on the right",
        SMALL,
        Anchor::Start,
        TEXT,
    );
}

/// Room between rows of two kinds, of a row's height `[1]`.
const GAP: f64 = 0.5;

/// A row a family, a column a fault: the share of cases that have it.
pub(crate) fn shares(groups: &[Group]) -> Figure {
    const CELL: f64 = 64.0;
    let shown: Vec<&Group> = groups.iter().filter(|group| matches!(group.by, "all" | "family" | "cause")).collect();
    let (left, top) = (196.0, 150.0);
    let columns = Fault::ALL.len() + 1;
    // All, families and causes stand apart.
    let gaps = |row: usize| (1..=row).filter(|&k| shown[k].by != shown[k - 1].by).count() as f64;
    let height = top + ROW * (shown.len() as f64 + GAP * gaps(shown.len().saturating_sub(1))) + 24.0;
    let mut figure = Figure::new(left + CELL * columns as f64 + 24.0, height);
    figure.text(
        [18.0, 24.0],
        "Share of cases with a fault [%], by family and by what a scene has",
        TITLE,
        Anchor::Start,
        TEXT,
    );
    let names = std::iter::once("any").chain(Fault::ALL.map(Fault::name));
    for (column, name) in names.enumerate() {
        figure.climbing_text([left + CELL * (column as f64 + 0.5), top - 56.0], name, SMALL, TEXT);
    }
    for (row, group) in shown.iter().enumerate() {
        let y = top + ROW * (row as f64 + GAP * gaps(row));
        let name = format!("{} ({})", group.name, group.cases);
        figure.text([left - 10.0, y + 0.5 * ROW], name, SMALL, Anchor::End, TEXT);
        let own = group.faults.iter().map(|&count| count as f64 / group.cases as f64);
        for (column, share) in std::iter::once(group.faulty).chain(own).enumerate() {
            let x = left + CELL * column as f64;
            figure.block([x + 1.0, y + 1.0], [x + CELL - 1.0, y + ROW - 1.0], shade(share));
            if share > 0.0 {
                let text = format!("{:.0}", (100.0 * share).max(0.51));
                figure.text([x + 0.5 * CELL, y + 0.5 * ROW], text, SMALL, Anchor::Middle, BLACK);
            }
        }
    }
    figure
}

/// From white to vermilion.
fn shade(share: f64) -> RGBColor {
    let mix = |full: u8| (255.0 - (255.0 - f64::from(full)) * share.clamp(0.0, 1.0).sqrt()) as u8;
    RGBColor(mix(VERMILION.0), mix(VERMILION.1), mix(VERMILION.2))
}

/// What share of cases costs more than a rate: all, and those with rigid bonds and with springs alone.
pub(crate) fn rates(judged: &[Judged]) -> Figure {
    let run = || judged.iter().filter(|one| !matches!(one.found.ended, Ended::Refused(_)) && one.timing.rate > 0.0);
    let with = |rigid: bool| run().filter(move |one| one.causes.contains(&Cause::Rigid) == rigid);
    let look = |colour, marker| Look { colour, marker, width: 1.8 };
    let series = [
        ("all", rising(run(), |one| one.timing.rate), look(BLACK, Marker::Disc)),
        ("rigid bonds", rising(with(true), |one| one.timing.rate), look(BLUE, Marker::Square)),
        ("others", rising(with(false), |one| one.timing.rate), look(ORANGE, Marker::Diamond)),
        ("all, by counted work", rising(run(), |one| one.found.work_rate), look(GREY, Marker::Up)),
    ];
    let mut figure = Figure::new(784.0, 430.0);
    let shown = series.iter().flat_map(|(_, points, _)| points.iter().map(|point| point[1])).filter(|rate| *rate > 0.0);
    let panel = Panel {
        left: 78.0,
        top: 46.0,
        right: 530.0,
        bottom: 372.0,
        x: Scale::Linear { from: 0.0, to: 100.0, step: 10.0, decimals: 0 },
        y: Scale::decades(shown.chain([0.1, 1.0])),
    };
    panel.grid(&mut figure);
    figure.dashes(panel.level(0.5), GREY, 1.0);
    for (_, points, look) in &series {
        let line: Vec<[f64; 2]> =
            points.iter().filter(|point| point[1] > 0.0).map(|&point| panel.place(point)).collect();
        figure.line(line.clone(), look.colour, look.width);
        line.iter().step_by((line.len() / 10).max(1)).for_each(|&at| mark(&mut figure, at, *look));
    }
    figure.text([panel.left, 24.0], "What the cases of the battery cost", TITLE, Anchor::Start, TEXT);
    panel.frame(&mut figure, "cases that cost no more [%]", "stepping time a simulated second [s]");
    for (i, (name, _, look)) in series.iter().enumerate() {
        entry(&mut figure, [panel.right + 22.0, panel.top + 8.0 + ROW * i as f64], name, *look);
    }
    figure
}

/// (share of the list `[%]`, value), ascending.
fn rising<'a>(judged: impl Iterator<Item = &'a Judged>, of: fn(&Judged) -> f64) -> Vec<[f64; 2]> {
    let mut values: Vec<f64> = judged.map(of).collect();
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    values.into_iter().enumerate().map(|(i, value)| [100.0 * (i as f64 + 1.0) / count, value]).collect()
}
