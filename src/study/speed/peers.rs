//! Other engines on the same scenes, from the table that `benches/peers` leaves.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::super::error::StudyError;
use super::reference::{self, ReferenceRow};
use super::run::SpeedRun;
use super::scenes::find_speed_scene;

/// Strains that engines are compared at `[1]`.
const STRAINS: [f64; 3] = [0.15, 0.02, 1e-3];
/// Errors that they are compared at where the truth is known `[m]`.
const ERRORS: [f64; 3] = [1e-2, 1e-3, 5e-5];

/// A run of another engine: what is read of a row of `peers.csv`.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct PeerRun {
    pub(crate) engine: String,
    pub(crate) scene: String,
    pub(crate) setting: String,
    pub(crate) ms_per_frame: f64,
    pub(crate) max_strain: f64,
    pub(crate) max_error_m: Option<f64>,
    pub(crate) is_finished: bool,
}

/// A row of `ratios.csv`: an engine and this program at the same bound.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PeerRatio {
    /// The scene, by its name here.
    pub scene: String,
    /// The bound: of strain `[1]`, or of the error where the truth is known `[m]`.
    pub bound: f64,
    /// The engine.
    pub engine: String,
    /// Its cheapest setting within the bound; empty: it never got there.
    pub setting: Option<String>,
    /// What a frame costs with it `[ms]`.
    pub peer_ms: Option<f64>,
    /// Our cheapest way within the bound.
    pub ours: String,
    /// What a frame costs with it `[ms]`.
    pub our_ms: f64,
    /// How many times cheaper we are; empty where the engine never got there.
    pub ratio: Option<f64>,
}

/// Reads a table of peers; none if there is no such file.
///
/// Errors: a file that is no such table.
pub(super) fn read(path: &Path) -> Result<Vec<PeerRun>, StudyError> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    let failed = |error: csv::Error| StudyError::Table { file: path.display().to_string(), reason: error.to_string() };
    let mut table = csv::Reader::from_path(path).map_err(failed)?;
    table.deserialize().collect::<Result<_, _>>().map_err(failed)
}

/// A way of ours: what it is, what a frame costs `[ms]`, and its strain or error.
type Way = (String, f64, f64);

/// Compares every engine with the cheapest way of ours at each bound that we reached.
pub(super) fn compare(peers: &[PeerRun], runs: &[SpeedRun], reference: &[ReferenceRow]) -> Vec<PeerRatio> {
    let mut scenes: Vec<&'static str> = runs.iter().map(|run| run.scene).collect();
    scenes.dedup();
    scenes.sort_unstable();
    scenes.dedup();
    let mut rows = Vec::new();
    for scene in scenes {
        let Some(peer) = find_speed_scene(scene).ok().and_then(|scene| scene.peer) else { continue };
        let autos = runs.iter().filter(|run| run.scene == scene && run.is_finished && run.max_strain_asked.is_some());
        let ways: Vec<Way> = autos.map(|run| (run.method.clone(), run.median_ms, run.max_strain)).collect();
        rows.extend(compare_scene(scene, peers, peer, &ways, &STRAINS, |run| Some(run.max_strain)));
    }
    let ways =
        reference.iter().map(|row| (format!("{}, {} substeps", row.solver, row.substeps), row.mean_ms, row.error_m));
    let ways: Vec<Way> = ways.collect();
    rows.extend(compare_scene("rope-50", peers, reference::PEER, &ways, &ERRORS, |run| run.max_error_m));
    rows
}

fn compare_scene(
    scene: &str,
    peers: &[PeerRun],
    name: &str,
    ways: &[Way],
    bounds: &[f64],
    judged: impl Fn(&PeerRun) -> Option<f64>,
) -> Vec<PeerRatio> {
    let peers: Vec<&PeerRun> = peers.iter().filter(|run| run.scene == name).collect();
    let mut engines: Vec<&str> = peers.iter().map(|run| run.engine.as_str()).collect();
    engines.dedup();
    let mut rows = Vec::new();
    for &bound in bounds {
        let within = ways.iter().filter(|way| way.2 <= bound);
        let Some((ours, our_ms, _)) = within.min_by(|a, b| a.1.total_cmp(&b.1)) else { continue };
        for &engine in &engines {
            let meets = |run: &&&PeerRun| {
                run.engine == engine && run.is_finished && judged(run).is_some_and(|value| value <= bound)
            };
            let best = peers.iter().filter(meets).min_by(|a, b| a.ms_per_frame.total_cmp(&b.ms_per_frame));
            rows.push(PeerRatio {
                scene: scene.to_owned(),
                bound,
                engine: engine.to_owned(),
                setting: best.map(|run| run.setting.clone()),
                peer_ms: best.map(|run| run.ms_per_frame),
                ours: ours.clone(),
                our_ms: *our_ms,
                ratio: best.map(|run| run.ms_per_frame / our_ms),
            });
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cheapest_within_the_bound_counts_on_both_sides() {
        let text = "engine,scene,setting,ms_per_frame,max_strain,max_error_m,is_finished,more\n\
                    a,rope 50 (F4),cheap,0.1,9,0.5,true,x\n\
                    a,rope 50 (F4),good,0.4,9,0.005,true,x\n\
                    a,rope 50 (F4),better,0.6,9,0.004,true,x\n\
                    a,rope 50 (F4),given up,0.2,9,,false,x\n";
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("peers.csv");
        std::fs::write(&file, text).unwrap();
        let peers = read(&file).unwrap();
        let ours = |mean_ms, error_m| ReferenceRow { solver: "rk8", substeps: 1, mean_ms, error_m };
        let rows = compare(&peers, &[], &[ours(0.01, 1.0), ours(0.02, 2e-3), ours(0.04, 1e-4)]);
        assert_eq!(rows.len(), 2, "5e-5 m is not reached");
        assert_eq!((rows[0].bound, rows[0].setting.as_deref(), rows[0].ratio), (1e-2, Some("good"), Some(20.0)));
        assert_eq!((rows[1].bound, rows[1].ratio), (1e-3, None));
        assert!(read(Path::new("/no/such/peers.csv")).unwrap().is_empty());
        std::fs::write(&file, "engine\na\n").unwrap();
        assert!(read(&file).is_err());
    }
}
