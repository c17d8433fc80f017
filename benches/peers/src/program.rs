//! wobble itself, as a program: it expands scene files to points for all engines, and runs them on one thread.

use std::ffi::OsStr;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use serde::Deserialize;
use serde_json::Value;
use tempfile::TempDir;

use crate::times::Times;

/// The program, and a folder for what goes to it and comes from it.
pub(crate) struct Program {
    path: PathBuf,
    folder: TempDir,
}

impl Program {
    /// The program at a path.
    pub(crate) fn new(path: &Path) -> Result<Self> {
        let path = path.canonicalize().with_context(|| format!("no program {}", path.display()))?;
        Ok(Program { path, folder: TempDir::with_prefix("peers-")? })
    }

    /// Its version, as it says it.
    pub(crate) fn version(&self) -> Result<String> {
        let text = String::from_utf8(self.call(["--version".as_ref()])?)?;
        Ok(text.trim().trim_start_matches("wobble ").to_owned())
    }

    /// A scene file with its bodies as points and bonds.
    pub(crate) fn expand(&self, scene: &Value) -> Result<Vec<u8>> {
        let file = self.file(scene)?;
        self.call(["scenes".as_ref(), file.as_os_str(), "--json".as_ref(), "--expanded".as_ref()])
    }

    /// Runs a scene file on one thread to the last of the ascending `times` [s], with a sample at each.
    pub(crate) fn simulate(&self, scene: &Value, times: &[f64]) -> Result<Run> {
        let times = times.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let (file, out) = (self.file(scene)?, self.folder.path().join("out.json"));
        let words: [&OsStr; 9] = [
            "simulate".as_ref(),
            file.as_ref(),
            "--samples".as_ref(),
            times.as_ref(),
            "--threads".as_ref(),
            "1".as_ref(),
            "--quiet".as_ref(),
            "--out".as_ref(),
            out.as_ref(),
        ];
        self.call(words)?;
        serde_json::from_reader(BufReader::new(File::open(&out)?)).context("what wobble wrote")
    }

    /// Writes a scene file.
    fn file(&self, scene: &Value) -> Result<PathBuf> {
        let path = self.folder.path().join("scene.json");
        std::fs::write(&path, scene.to_string()).with_context(|| format!("cannot write {}", path.display()))?;
        Ok(path)
    }

    /// What the program prints.
    fn call<const N: usize>(&self, words: [&OsStr; N]) -> Result<Vec<u8>> {
        let output = Command::new(&self.path).args(words).output()?;
        let error = String::from_utf8_lossy(&output.stderr);
        ensure!(output.status.success(), "{} {:?}: {}", self.path.display(), words[0], error.trim());
        Ok(output.stdout)
    }
}

/// What is read of a simulation.
#[derive(Deserialize)]
pub(crate) struct Run {
    /// In the order of time.
    pub(crate) samples: Vec<Sample>,
    /// All stepping [s].
    seconds: f64,
    frames: Frames,
}

/// All points at one time.
#[derive(Deserialize)]
pub(crate) struct Sample {
    /// When [s].
    pub(crate) t: f64,
    /// Place of each point [m].
    pub(crate) position: Vec<[f64; 2]>,
    /// Velocity of each point [m/s].
    pub(crate) velocity: Vec<[f64; 2]>,
}

#[derive(Deserialize)]
struct Frames {
    count: usize,
    median_ms: f64,
    worst_ms: f64,
}

impl Run {
    /// Times of the frames.
    ///
    /// Errors: their number is not `count`.
    pub(crate) fn times(&self, count: usize) -> Result<Times> {
        ensure!(self.frames.count == count, "{} frames, not {count}", self.frames.count);
        let Frames { median_ms, worst_ms, .. } = self.frames;
        Ok(Times { median_ms, worst_ms, mean_ms: 1e3 * self.seconds / count as f64 })
    }

    /// Whether all stood still at each sample; wobble doesn't write who sleeps, but sleepers alone do to the last bit.
    pub(crate) fn is_asleep(&self) -> Vec<bool> {
        let mut before: &[[f64; 2]] = &[];
        let look = |sample: &Sample| sample.velocity.iter().flatten().all(|&v| v == 0.0);
        let mut asleep = Vec::with_capacity(self.samples.len());
        for sample in &self.samples {
            asleep.push(sample.position == before && look(sample));
            before = &sample.position;
        }
        asleep
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_stands_still_to_the_last_bit_sleeps() -> Result<()> {
        let sample = |t: f64, y: f64, vy: f64| json!({"t": t, "position": [[1.0, y]], "velocity": [[0.0, vy]]});
        let run: Run = serde_json::from_value(json!({
            "samples": [sample(0.1, 2.0, 1e-9), sample(0.2, 2.0, 0.0), sample(0.3, 1.0, 0.0), sample(0.4, 1.0, 0.0)],
            "seconds": 0.6, "frames": {"count": 300, "median_ms": 1.5, "p99_ms": 3.0, "worst_ms": 4.0}}))?;
        assert_eq!(run.is_asleep(), [false, true, false, true]);
        let times = run.times(300)?;
        assert_eq!((times.median_ms, times.worst_ms, times.mean_ms), (1.5, 4.0, 2.0));
        assert!(run.times(301).is_err());
        Ok(())
    }
}
