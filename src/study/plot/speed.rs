//! What a frame costs at a strain, beside other engines; and what a sweep costs, beside the plain program.

use plotters::prelude::RGBColor;

use super::axes::{Panel, Scale};
use super::figure::{Anchor, Figure};
use super::style::{
    BLACK, BLUE, GREEN, GREY, LABEL, Look, Marker, ORANGE, PURPLE, SKY, SMALL, TEXT, TITLE, VERMILION, mark,
};
use super::work::entry;
use crate::sim::InstructionSet;
use crate::study::speed::peers::PeerRun;
use crate::study::speed::{KernelRow, SpeedRun};

/// Strains that are shown `[1]`: above, a scene is no longer itself; below, `f32` ends.
const SHOWN: std::ops::RangeInclusive<f64> = 1e-7..=2.0;
/// Strains that engines are compared at `[1]`.
const LEVELS: [f64; 2] = [0.02, 1e-3];
/// Height of a line of a legend.
const ROW: f64 = 22.0;

/// A line of a plot.
struct Series {
    name: String,
    look: Look,
    points: Vec<[f64; 2]>,
    /// Whether the points are joined.
    is_line: bool,
}

/// Time a frame against strain: what follows one, other settings of this program, and other engines.
pub(crate) fn frames(scene: &str, runs: &[&SpeedRun], peers: &[&PeerRun]) -> Figure {
    let mut series = vec![ours("paths, held to a strain", "strain", runs, BLUE, Marker::Disc)];
    series.push(ours("paths, given substeps", "paths", runs, SKY, Marker::Square));
    series.push(ours("sweeps, given substeps", "sweeps", runs, VERMILION, Marker::Cross));
    let mut engines: Vec<&str> = peers.iter().map(|run| run.engine.as_str()).collect();
    engines.dedup();
    let looks = [ORANGE, GREEN, PURPLE, GREY, BLACK].into_iter().cycle();
    for (engine, colour) in engines.into_iter().zip(looks) {
        series.push(peer(engine, peers, colour));
    }
    series.retain(|series| !series.points.is_empty());
    let title = format!("{scene}: cost of a frame at a strain");
    draw(&title, &series, LEVELS, ["largest strain", "a frame [ms]"])
}

fn is_shown(point: &[f64; 2]) -> bool {
    SHOWN.contains(&point[0]) && point[1] > 0.0
}

fn ours(name: &str, start: &str, runs: &[&SpeedRun], colour: RGBColor, marker: Marker) -> Series {
    let same = runs.iter().filter(|run| run.is_finished && run.method.starts_with(start));
    let points = same.map(|run| [run.max_strain, run.median_ms]).filter(is_shown).collect();
    Series { name: name.to_owned(), look: Look { colour, marker, width: 1.6 }, points, is_line: true }
}

/// Every setting of an engine that was run to its end.
fn peer(engine: &str, peers: &[&PeerRun], colour: RGBColor) -> Series {
    let same = peers.iter().filter(|run| run.is_finished && run.engine == engine);
    let points = same.map(|run| [run.max_strain, run.ms_per_frame]).filter(is_shown).collect();
    let look = Look { colour, marker: Marker::Up, width: 1.0 };
    Series { name: engine.to_owned(), look, points, is_line: false }
}

/// Time a bond and sweep against the number of points, in `f32` with the widest instructions that were measured.
pub(crate) fn sweeps(rows: &[KernelRow]) -> Figure {
    let mut sets = InstructionSet::ALL.into_iter().rev().map(InstructionSet::name);
    let widest = sets.find(|set| rows.iter().any(|row| row.instruction_set == *set));
    let shown: Vec<&KernelRow> =
        rows.iter().filter(|row| row.precision == "f32" && Some(row.instruction_set) == widest).collect();
    let looks = [
        ("net", "net", SKY, Marker::Square),
        ("hard", "hard grid", BLUE, Marker::Disc),
        ("rope", "rope", GREEN, Marker::Diamond),
        ("rims", "rims", PURPLE, Marker::Up),
        ("disc", "mesh of triangles", VERMILION, Marker::Down),
    ];
    let mut series = Vec::new();
    for (family, name, colour, marker) in looks {
        let same = || shown.iter().filter(move |row| row.family == family);
        let of = |cost: fn(&KernelRow) -> f64| {
            same().map(|row| [row.points as f64, cost(row)]).filter(|point| point[1] > 0.0).collect::<Vec<_>>()
        };
        let look = Look { colour, marker, width: 1.6 };
        series.push(Series { name: name.to_owned(), look, points: of(|row| row.sweep_ns), is_line: true });
        let look = Look { colour: GREY, width: 0.8, ..look };
        let name = format!("{name}, plain program");
        series.push(Series { name, look, points: of(|row| row.naive_ns), is_line: true });
    }
    series.retain(|series| !series.points.is_empty());
    let title = format!("A sweep over the bonds, f32, {}", widest.unwrap_or("no instruction set"));
    draw(&title, &series, [], ["points", "a bond [ns]"])
}

fn draw<const N: usize>(title: &str, series: &[Series], levels: [f64; N], [x, y]: [&str; 2]) -> Figure {
    let height = f64::max(430.0, ROW * series.len() as f64 + 130.0);
    let mut figure = Figure::new(784.0, height);
    let all = || series.iter().flat_map(|series| &series.points);
    let panel = Panel {
        left: 78.0,
        top: 46.0,
        right: 530.0,
        bottom: height - 58.0,
        x: Scale::decades(all().map(|point| point[0]).chain(levels)),
        y: Scale::decades(all().map(|point| point[1])),
    };
    panel.grid(&mut figure);
    for level in levels {
        figure.dashes(panel.upright(level), GREY, 1.0);
    }
    for series in series.iter().rev() {
        let line: Vec<[f64; 2]> = series.points.iter().map(|&point| panel.place(point)).collect();
        if series.is_line {
            figure.line(line.clone(), series.look.colour, series.look.width);
        }
        line.into_iter().for_each(|at| mark(&mut figure, at, series.look));
    }
    figure.text([panel.left, 24.0], title, TITLE, Anchor::Start, TEXT);
    panel.frame(&mut figure, x, y);
    for (i, series) in series.iter().enumerate() {
        let at = [panel.right + 22.0, panel.top + 8.0 + ROW * i as f64];
        if series.is_line {
            entry(&mut figure, at, &series.name, series.look);
        } else {
            mark(&mut figure, [at[0] + 12.0, at[1]], series.look);
            figure.text([at[0] + 32.0, at[1]], series.name.as_str(), LABEL, Anchor::Start, TEXT);
        }
    }
    if N > 0 {
        let below = panel.bottom + 34.0;
        figure.text([panel.right + 22.0, below], "further down and left is better", SMALL, Anchor::Start, TEXT);
    }
    figure
}
