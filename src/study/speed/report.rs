//! What a study of speed leaves behind: one JSON file with everything, tables, plots.

use std::path::Path;

use serde::Serialize;

use super::super::error::StudyError;
use super::super::machine::Machine;
use super::super::plot;
use super::super::report::make_folder;
use super::SpeedSettings;
use super::growth::GrowthRow;
use super::kernels::KernelRow;
use super::peers::{self, PeerRatio};
use super::reference::ReferenceRow;
use super::rules::RuleRow;
use super::run::SpeedRun;
use super::scenes::speed_scenes;
use super::second::ThreadRow;
use super::skipping::SkipRow;
use super::targets::TargetRow;
use crate::output::replace;

/// A study of speed.
#[derive(Clone, Debug, Serialize)]
pub struct SpeedReport {
    /// Version of the program.
    pub version: &'static str,
    /// Commit of its source, if the caller said it.
    pub commit: Option<String>,
    /// The call.
    pub command: String,
    /// What it ran on.
    pub machine: Machine,
    /// What was measured, and for how long.
    pub settings: SpeedSettings,
    /// Scenes, and what a frame of each costs.
    pub frames: Vec<SpeedRun>,
    /// Sweeps, and what one costs beside the plain program.
    pub kernels: Vec<KernelRow>,
    /// Whether the rules chose well.
    pub rules: Vec<RuleRow>,
    /// How cost grows with the number of points.
    pub growth: Vec<GrowthRow>,
    /// A rope of 50 bonds whose motion is known.
    pub rope50: Vec<ReferenceRow>,
    /// What is not needed, and what it costs.
    pub skipping: Vec<SkipRow>,
    /// The same on all cores.
    pub threads: Vec<ThreadRow>,
    /// Other engines at the same strain or error.
    pub ratios: Vec<PeerRatio>,
    /// What is to be reached.
    pub targets: Vec<TargetRow>,
}

impl SpeedReport {
    /// Writes all files into a folder, which is made if need be. A table without a row is not written.
    ///
    /// Errors: the folder cannot be made, a plot cannot be drawn or a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        make_folder(folder)?;
        replace(&folder.join("speed.json"), |to| {
            serde_json::to_writer_pretty(&mut *to, self)?;
            to.write_all(b"\n")
        })?;
        table(folder, "frames", &self.frames)?;
        table(folder, "kernels", &self.kernels)?;
        table(folder, "rules", &self.rules)?;
        table(folder, "growth", &self.growth)?;
        table(folder, "rope50", &self.rope50)?;
        table(folder, "skipping", &self.skipping)?;
        table(folder, "threads", &self.threads)?;
        table(folder, "ratios", &self.ratios)?;
        table(folder, "targets", &self.targets)?;
        self.draw(folder)
    }

    fn draw(&self, folder: &Path) -> Result<(), StudyError> {
        let others = peers::read(&folder.join("peers.csv"))?;
        for scene in speed_scenes() {
            let runs: Vec<&SpeedRun> = self.frames.iter().filter(|run| run.scene == scene.name).collect();
            let peers: Vec<_> = others.iter().filter(|run| Some(run.scene.as_str()) == scene.peer).collect();
            let has_rivals = !peers.is_empty() || runs.iter().any(|run| run.max_strain_asked.is_none());
            if !runs.is_empty() && has_rivals {
                plot::write(folder, &format!("cost-strain-{}", scene.name), &plot::frames(scene.name, &runs, &peers))?;
            }
        }
        if !self.kernels.is_empty() {
            plot::write(folder, "sweeps", &plot::sweeps(&self.kernels))?;
        }
        Ok(())
    }
}

/// Writes rows as NAME.csv, a column a field.
fn table<T: Serialize>(folder: &Path, name: &str, rows: &[T]) -> Result<(), StudyError> {
    if rows.is_empty() {
        return Ok(());
    }
    let write = |to: &mut dyn std::io::Write| {
        let mut table = csv::Writer::from_writer(to);
        rows.iter().try_for_each(|row| table.serialize(row))?;
        table.flush()
    };
    Ok(replace(&folder.join(format!("{name}.csv")), |to| write(to))?)
}
