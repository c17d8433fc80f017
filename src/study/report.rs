//! What a study leaves behind: one JSON file with everything, tables, plots.

use std::path::Path;

use serde::Serialize;

use super::accuracy::ProblemReport;
use super::error::StudyError;
use super::machine::Machine;
use super::plot;
use super::run::Settings;
use super::slides::Slides;
use super::tables;
use crate::output::{probe, replace};

/// A study of accuracy.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Version of the program.
    pub version: &'static str,
    /// Commit of its source, if the caller said it.
    pub commit: Option<String>,
    /// The call.
    pub command: String,
    /// What it ran on.
    pub machine: Machine,
    /// How long and how close.
    pub settings: Settings,
    /// What was measured, problem by problem.
    pub problems: Vec<ProblemReport>,
    /// The lectures' experiments.
    pub slides: Slides,
}

impl Report {
    /// Writes all files into a folder, which is made if need be.
    ///
    /// Errors: the folder cannot be made, a plot cannot be drawn or a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        make_folder(folder)?;
        replace(&folder.join("accuracy.json"), |to| {
            serde_json::to_writer_pretty(&mut *to, self)?;
            to.write_all(b"\n")
        })?;
        replace(&folder.join("runs.csv"), |to| tables::runs(&self.problems, to))?;
        replace(&folder.join("equal-error.csv"), |to| tables::equal_error(&self.problems, to))?;
        replace(&folder.join("asked.csv"), |to| tables::asked(&self.problems, to))?;
        replace(&folder.join("orders.csv"), |to| tables::orders(&self.problems, to))?;
        replace(&folder.join("slides.csv"), |to| tables::slides(&self.slides, to))?;
        self.draw(folder)
    }

    fn draw(&self, folder: &Path) -> Result<(), StudyError> {
        for problem in &self.problems {
            plot::write(folder, &format!("error-cost-{}", problem.name), &plot::work(problem))?;
        }
        plot::write(folder, "ratios", &plot::ratios(&self.problems))?;
        plot::write(folder, "slides-circle", &plot::circle(&self.slides))?;
        plot::write(folder, "slides-decay", &plot::decay(&self.slides))?;
        plot::write(folder, "slides-orders", &plot::orders(&self.slides))
    }
}

/// Makes a folder and those that it lies in.
///
/// Errors: it cannot be made.
pub fn make_folder(folder: &Path) -> Result<(), StudyError> {
    let error = |reason| StudyError::Folder { folder: folder.display().to_string(), reason };
    std::fs::create_dir_all(folder).map_err(error)
}

/// Makes a folder if need be, and sees that files can be made in it: better known before the work than after it.
///
/// Errors: it cannot be made, or no file in it.
pub fn ready_folder(folder: &Path) -> Result<(), StudyError> {
    make_folder(folder)?;
    Ok(probe(folder)?)
}
