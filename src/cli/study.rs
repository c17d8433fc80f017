//! `wobble study`: measures the program's methods.

mod stability;

use std::path::PathBuf;

use anyhow::Context;
use clap::{Args, Subcommand};

use super::progress;
use crate::study::speed::{Part, SpeedScene, SpeedSettings};
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
    /// What a frame costs at a strain, and a sweep beside a plain program.
    Speed(Speed),
    /// Where each method breaks, how often and why: sweeps, and a battery of random scenes.
    Stability(stability::Stability),
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

/// What to measure and where to write it.
#[derive(Args)]
#[command(after_help = after_speed_help())]
struct Speed {
    /// Built-in scenes; all if none is named.
    #[arg(value_name = "SCENE", value_parser = speed_scene)]
    scenes: Vec<&'static SpeedScene>,
    /// Folder to write to; it is made if need be. Other engines' times are read from peers.csv there.
    #[arg(long, value_name = "DIR", default_value = "speed")]
    out: PathBuf,
    /// Small scenes and short readings, for a look.
    #[arg(long)]
    quick: bool,
    /// A part of the study; may be given several times. All if none is named.
    #[arg(long, value_name = "PART", value_parser = part)]
    part: Vec<Part>,
    /// Commit of the source, to be noted; the variable WOBBLE_COMMIT if not said.
    #[arg(long, value_name = "HASH")]
    commit: Option<String>,
    /// Threads that this process uses, with the chosen instruction set only; if left out, one thread and all sets, then
    /// large scenes again on all processors.
    // The program's own option under the same name: its value is needed here.
    #[arg(long, value_name = "N", env = "RAYON_NUM_THREADS", value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: Option<u32>,
}

fn after_speed_help() -> String {
    let names: Vec<&str> = study::speed::speed_scenes().iter().map(|scene| scene.name).collect();
    format!(
        "Writes speed.json, a table each for frames, sweeps (kernels.csv), rules, growth, rope50, skipping, threads,\n\
         ratios to other engines and targets, and plots as SVG and PNG. Parts: {}.\n\n\
         Examples:\n  wobble study speed --out speed\n  \
         wobble study speed hard-100 net-316 --part frames --out speed\n  \
         wobble study speed --part sweeps --quick --out look\n\n\
         Built-in scenes:\n  {}",
        Part::ALL.map(Part::name).join(", "),
        names.join("\n  ")
    )
}

fn speed_scene(text: &str) -> Result<&'static SpeedScene, String> {
    study::speed::find_speed_scene(text)
}

fn part(text: &str) -> Result<Part, String> {
    let found = Part::ALL.into_iter().find(|part| part.name() == text);
    found.ok_or_else(|| format!("give one of {}", Part::ALL.map(Part::name).join(", ")))
}

fn after_help() -> String {
    let names: Vec<&str> = study::problems().iter().map(|problem| problem.name).collect();
    format!(
        "Writes accuracy.json, runs.csv, equal-error.csv, asked.csv (the default, and errors asked for), orders.csv, slides.csv, and plots as SVG and PNG.\n\n\
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
        Subject::Speed(speed) => speed.run(quiet),
        Subject::Stability(stability) => stability.run(quiet),
    }
}

impl Accuracy {
    fn run(&self, quiet: bool) -> anyhow::Result<()> {
        study::ready_folder(&self.out)?;
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
            commit: commit(&self.commit),
            command: command(),
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

impl Speed {
    fn run(&self, quiet: bool) -> anyhow::Result<()> {
        study::ready_folder(&self.out)?;
        let settings = self.settings()?;
        let scenes = if self.scenes.is_empty() { settings.scenes() } else { self.scenes.clone() };
        let bar = progress::tasks(quiet);
        let mut report = study::speed::measure_speed(&scenes, &settings, &self.out, &mut |now| {
            bar.set_length(now.total);
            bar.set_position(now.done);
            bar.set_message(now.problem.to_owned());
        })?;
        bar.finish_and_clear();
        report.commit = commit(&self.commit);
        report.command = command();
        Ok(report.write(&self.out)?)
    }

    /// Where no number of threads is said this process takes one, and starts itself again for the others.
    fn settings(&self) -> anyhow::Result<SpeedSettings> {
        let mut settings = SpeedSettings::new(self.quick, self.threads.unwrap_or(1) as usize);
        match self.threads {
            Some(_) => settings.all_sets = false,
            None => {
                crate::sim::use_threads(1).context("one thread could not be started")?;
                settings.program = Some(std::env::current_exe().context("this program's own file is not to be found")?);
            }
        }
        if !self.part.is_empty() {
            settings.parts.clone_from(&self.part);
        }
        Ok(settings)
    }
}

fn commit(said: &Option<String>) -> Option<String> {
    said.clone().or_else(|| std::env::var("WOBBLE_COMMIT").ok())
}

/// The call as it may be typed again: the program by its name, words that a shell would take apart in quotes.
fn command() -> String {
    let words = std::env::args_os().skip(1).map(|word| quoted(&word.to_string_lossy()));
    std::iter::once("wobble".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}

fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./=:,+%@".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_are_quoted_where_a_shell_would_take_them_apart() {
        let words = [
            ("--case", "--case"),
            ("mass ratio", "'mass ratio'"),
            ("", "''"),
            ("it's", "'it'\\''s'"),
            ("a;b", "'a;b'"),
        ];
        for (word, expected) in words {
            assert_eq!(quoted(word), expected);
        }
    }
}
