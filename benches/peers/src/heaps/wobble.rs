//! wobble itself, as a program: it makes the meshes of all engines, and runs the scenes on one thread.

use std::ffi::OsStr;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use serde::Deserialize;
use tempfile::TempDir;

use super::judge::{Look, Verdict};
use super::mesh::Mesh;
use super::run::{Outcome, Times};
use super::scenes::{FRAMES_A_LOOK, FRAMES_A_SECOND, Scene};

/// The program, and a folder for what goes to it and comes from it.
pub(crate) struct Wobble {
    program: PathBuf,
    folder: TempDir,
}

impl Wobble {
    /// The program at a path.
    pub(crate) fn new(program: &Path) -> Result<Self> {
        let program = program.canonicalize().with_context(|| format!("no program {}", program.display()))?;
        Ok(Wobble { program, folder: TempDir::with_prefix("peers-")? })
    }

    /// Its version, as it says it.
    pub(crate) fn version(&self) -> Result<String> {
        let text = String::from_utf8(self.call(["--version".as_ref()])?)?;
        Ok(text.trim().trim_start_matches("wobble ").to_owned())
    }

    /// The points and bonds of a scene.
    pub(crate) fn mesh(&self, scene: &Scene) -> Result<Mesh> {
        let file = self.file(scene)?;
        let text = self.call(["scenes".as_ref(), file.as_os_str(), "--json".as_ref(), "--expanded".as_ref()])?;
        Mesh::parse(&text, scene.bodies)
    }

    /// Runs a scene to its end, on one thread, with a sample at each look.
    pub(crate) fn run(&self, scene: &Scene, mesh: &Mesh) -> Result<Outcome> {
        let looks = (1..=scene.frames() / FRAMES_A_LOOK).map(|k| (k * FRAMES_A_LOOK) as f64 / FRAMES_A_SECOND as f64);
        let times = looks.map(|time| time.to_string()).collect::<Vec<_>>().join(",");
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
        let run: Run = serde_json::from_reader(BufReader::new(File::open(&out)?)).context("what wobble wrote")?;
        ensure!(run.frames.count == scene.frames(), "{} frames, not {}", run.frames.count, scene.frames());
        Ok(run.outcome(mesh))
    }

    /// Writes the scene file.
    fn file(&self, scene: &Scene) -> Result<PathBuf> {
        let path = self.folder.path().join("scene.json");
        std::fs::write(&path, scene.file.to_string()).with_context(|| format!("cannot write {}", path.display()))?;
        Ok(path)
    }

    /// What the program prints.
    fn call<const N: usize>(&self, words: [&OsStr; N]) -> Result<Vec<u8>> {
        let output = Command::new(&self.program).args(words).output()?;
        let error = String::from_utf8_lossy(&output.stderr);
        ensure!(output.status.success(), "{} {:?}: {}", self.program.display(), words[0], error.trim());
        Ok(output.stdout)
    }
}

/// What is read of a simulation.
#[derive(Deserialize)]
struct Run {
    samples: Vec<Sample>,
    /// All stepping [s].
    seconds: f64,
    frames: Frames,
}

#[derive(Deserialize)]
struct Sample {
    t: f64,
    position: Vec<[f64; 2]>,
    velocity: Vec<[f64; 2]>,
}

#[derive(Deserialize)]
struct Frames {
    count: usize,
    median_ms: f64,
    worst_ms: f64,
}

impl Run {
    /// Judged by its samples; wobble doesn't write who sleeps, but sleepers alone stand still to the last bit.
    fn outcome(&self, mesh: &Mesh) -> Outcome {
        let mut verdict = Verdict::default();
        let mut before: &[[f64; 2]] = &[];
        for Sample { t, position, velocity } in &self.samples {
            let is_asleep = position == before && velocity.iter().flatten().all(|&v| v == 0.0);
            verdict.look(mesh, &Look { time: *t, positions: position, velocities: velocity, is_asleep });
            before = position;
        }
        let Frames { count, median_ms, worst_ms } = self.frames;
        Outcome { times: Times { median_ms, worst_ms, mean_ms: 1e3 * self.seconds / count as f64 }, verdict }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_heap_sleeps_once_it_stands_still_to_the_last_bit() -> Result<()> {
        let mesh = crate::heaps::mesh::wheel(1.0, 2.0)?;
        let sample = |t: f64, vy: f64| json!({"t": t, "position": mesh.positions, "velocity": vec![[0.0, vy]; 17]});
        let run: Run = serde_json::from_value(json!({
            "samples": [sample(0.1, 1e-9), sample(0.2, 0.0), sample(0.3, 0.0)],
            "seconds": 0.6, "frames": {"count": 300, "median_ms": 1.5, "p99_ms": 3.0, "worst_ms": 4.0}}))?;
        let Outcome { times, verdict } = run.outcome(&mesh);
        assert_eq!((verdict.calm_after, verdict.asleep_after), (Some(0.1), Some(0.2)));
        assert_eq!((times.median_ms, times.worst_ms, times.mean_ms), (1.5, 4.0, 2.0));
        Ok(())
    }
}
