//! `wobble study`: measures the program's methods.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::progress;
use crate::study::{self, Problem, Report, Settings};

/// What to study.
#[derive(Args)]
pub(super) struct Arguments {
    #[command(subcommand)]
    subject: Subject,
}

#[derive(Subcommand)]
enum Subject {
    /// What an error costs: every method and the sources' method against known motions.
    Accuracy(Accuracy),
}

/// What to run and where to write it.
#[derive(Args)]
#[command(after_help = after_help())]
struct Accuracy {
    /// Built-in problems; all if none is named.
    #[arg(value_name = "SCENE", value_parser = problem)]
    problems: Vec<&'static Problem>,
    /// Folder to write to; it is made if need be.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Fewer and shorter runs, for a look.
    #[arg(long)]
    quick: bool,
    /// Commit of the source, to be noted; the variable WOBBLE_COMMIT if not said.
    #[arg(long, value_name = "HASH")]
    commit: Option<String>,
}

fn after_help() -> String {
    let names: Vec<&str> = study::problems().iter().map(|problem| problem.name).collect();
    format!(
        "Writes accuracy.json, runs.csv, equal-error.csv, orders.csv, slides.csv, and plots as SVG and PNG.\n\n\
         Examples:\n  wobble study accuracy --out study\n  \
         wobble study accuracy B1_osc D1_pendulum90 --out study\n  \
         wobble study accuracy A2_drag --quick --out look\n\n\
         Built-in problems:\n  {}",
        names.join("\n  ")
    )
}

fn problem(text: &str) -> Result<&'static Problem, String> {
    study::find(text)
}

pub(super) fn run(arguments: &Arguments, quiet: bool) -> anyhow::Result<()> {
    match &arguments.subject {
        Subject::Accuracy(accuracy) => accuracy.run(quiet),
    }
}

impl Accuracy {
    fn run(&self, quiet: bool) -> anyhow::Result<()> {
        // A folder that cannot be had is better known before the work than after it.
        study::make_folder(&self.out)?;
        let problems = self.problems();
        let settings = if self.quick { Settings::QUICK } else { Settings::FULL };
        let bar = progress::tasks(quiet);
        let measured = study::measure(&problems, &settings, &mut |now| {
            bar.set_length(now.total);
            bar.set_position(now.done);
            bar.set_message(now.problem.to_owned());
        })?;
        bar.finish_and_clear();
        let report = Report {
            version: env!("CARGO_PKG_VERSION"),
            commit: self.commit.clone().or_else(|| std::env::var("WOBBLE_COMMIT").ok()),
            command: std::env::args().collect::<Vec<_>>().join(" "),
            machine: study::machine(),
            settings,
            problems: measured,
            slides: study::slides(),
        };
        Ok(report.write(&self.out)?)
    }

    /// Each once, in the order of the catalogue.
    fn problems(&self) -> Vec<&'static Problem> {
        let is_wanted = |problem: &&Problem| {
            self.problems.is_empty() || self.problems.iter().any(|wanted| wanted.name == problem.name)
        };
        study::problems().iter().filter(is_wanted).collect()
    }
}
