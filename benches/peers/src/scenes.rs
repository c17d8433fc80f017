//! The scenes that every engine runs: points, rigid bonds, pins, and what to measure at the end.

use anyhow::{Context, Result, ensure};
use serde::{Deserialize, Serialize};

/// Distance between neighbours in ropes and sheets [m].
const SPACING: f64 = 0.1;
/// Gravity of every scene made here [m/s^2].
const GRAVITY: f64 = 9.8;

/// What a run is judged by.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) enum Measure {
    /// Largest |length / rest - 1| over all bonds.
    #[serde(rename = "strain")]
    Strain,
    /// Largest distance from the true position at the end [m].
    #[serde(rename = "error_m")]
    Error,
}

impl Measure {
    /// The bounds to reach, loosest first: a ladder ends at the rung that meets the last.
    pub(crate) fn bounds(self) -> &'static [f64] {
        match self {
            Measure::Strain => &[0.15, 0.02, 1e-3],
            Measure::Error => &[1e-2, 1e-3, 5e-5],
        }
    }
}

/// A bond of fixed length between two points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bond {
    /// Its ends.
    pub(crate) ends: [usize; 2],
    /// Its length [m].
    pub(crate) rest: f64,
}

/// Points under gravity joined by rigid bonds, at rest at the start.
pub(crate) struct Scene {
    /// How tables and the command line call it.
    pub(crate) name: &'static str,
    /// Position of each point [m].
    pub(crate) positions: Vec<[f64; 2]>,
    /// Mass of each point [kg].
    pub(crate) mass: f64,
    /// Downward acceleration [m/s^2].
    pub(crate) gravity: f64,
    /// Points that never move.
    pub(crate) pinned: Vec<usize>,
    /// In the order in which an engine is given them.
    pub(crate) bonds: Vec<Bond>,
    /// True positions after 2 s, if they are known.
    pub(crate) truth: Option<Vec<[f64; 2]>>,
    /// True if every bond i joins the points i and i + 1.
    pub(crate) is_chain: bool,
}

impl Scene {
    /// What runs of this scene are judged by.
    pub(crate) fn measure(&self) -> Measure {
        if self.truth.is_some() { Measure::Error } else { Measure::Strain }
    }

    /// Whether point `i` is pinned; `pinned` is in ascending order.
    pub(crate) fn is_pinned(&self, i: usize) -> bool {
        self.pinned.binary_search(&i).is_ok()
    }

    /// An empty scene of unit masses, to be filled.
    fn named(name: &'static str) -> Self {
        Scene {
            name,
            positions: Vec::new(),
            mass: 1.0,
            gravity: GRAVITY,
            pinned: Vec::new(),
            bonds: Vec::new(),
            truth: None,
            is_chain: false,
        }
    }

    /// Joins two points at the distance that they have now.
    fn link(&mut self, a: usize, b: usize) {
        let [p, q] = [self.positions[a], self.positions[b]];
        self.bonds.push(Bond { ends: [a, b], rest: (p[0] - q[0]).hypot(p[1] - q[1]) });
    }
}

/// All scenes from small to large, or only the small ones.
pub(crate) fn all(quick: bool) -> Result<Vec<Scene>> {
    let mut scenes = vec![rope_50()?, hung("hung 32^2", 32)];
    if quick {
        scenes.push(rims("50 rims", 50));
    } else {
        scenes.extend([rope(1000), rims("1,000 rims", 1000), hung("hung 100^2", 100), hung("hung 316^2", 316)]);
    }
    Ok(scenes)
}

/// `count` points in a level row, the first pinned.
fn rope(count: usize) -> Scene {
    let mut scene = Scene { pinned: vec![0], is_chain: true, ..Scene::named("rope 1,000") };
    scene.positions = (0..count).map(|i| [SPACING * i as f64, 0.0]).collect();
    (1..count).for_each(|i| scene.link(i - 1, i));
    scene
}

/// A vertical sheet of `n` x `n` points, bonds listed cell by cell with both diagonals, the top row pinned.
fn hung(name: &'static str, n: usize) -> Scene {
    let mut scene = Scene { pinned: (0..n).collect(), ..Scene::named(name) };
    scene.positions = (0..n * n).map(|i| [SPACING * (i % n) as f64, -SPACING * (i / n) as f64]).collect();
    for i in 0..n * n {
        let (right, below) = (i % n + 1 < n, i / n + 1 < n);
        if right {
            scene.link(i, i + 1);
        }
        if below {
            scene.link(i, i + n);
        }
        if right && below {
            scene.link(i, i + n + 1);
            scene.link(i + 1, i + n);
        }
    }
    scene
}

/// `count` braced rims, 3 m apart on a square lattice, each pinned at its rightmost point, from which it swings down.
///
/// A square, not a row: in a row of 1,000 the engines' f32 would resolve no better than 0.2 mm at the far end.
fn rims(name: &'static str, count: usize) -> Scene {
    /// Points on each ring.
    const SECTORS: usize = 13;
    let mut scene = Scene::named(name);
    let side = count.isqrt().max(1);
    for k in 0..count {
        let centre = [3.0 * (k % side) as f64, 3.0 * (k / side) as f64];
        let outer = scene.positions.len();
        let inner = outer + SECTORS;
        scene.pinned.push(outer);
        for radius in [1.0, 0.7] {
            for i in 0..SECTORS {
                let (sin, cos) = (std::f64::consts::TAU * i as f64 / SECTORS as f64).sin_cos();
                scene.positions.push([centre[0] + radius * cos, centre[1] + radius * sin]);
            }
        }
        for i in 0..SECTORS {
            let next = (i + 1) % SECTORS;
            scene.link(outer + i, outer + next);
            scene.link(inner + i, inner + next);
            scene.link(outer + i, inner + i);
            scene.link(outer + i, inner + next);
            if i < 10 {
                scene.link(outer + i, outer + (i + 2) % SECTORS);
            }
        }
    }
    scene
}

/// The reference problem F4: a straight rope of 50 rigid bonds, released 30 degrees below the level.
fn rope_50() -> Result<Scene> {
    let problem: Problem = serde_json::from_str(include_str!("../../../assets/problems/F4_rope50.scene.json"))
        .context("the scene of problem F4")?;
    let truth: Truth = serde_json::from_str(include_str!("../../../assets/problems/F4_rope50.truth.json"))
        .context("the truth of problem F4")?;
    let end = truth.samples.into_iter().find(|sample| sample.t == 2.0).context("no truth at 2 s")?;
    let mass = problem.points.mass[0];
    ensure!(problem.points.mass.iter().all(|&m| m == mass), "masses of problem F4 differ");
    let mut scene = Scene { mass, gravity: -problem.gravity[1], is_chain: true, ..Scene::named("rope 50 (F4)") };
    scene.positions = problem.points.position;
    scene.pinned = problem.points.pinned;
    scene.bonds = problem.bonds.iter().map(|bond| Bond { ends: [bond.a, bond.b], rest: bond.rest }).collect();
    scene.truth = Some(end.position);
    Ok(scene)
}

#[derive(Deserialize)]
struct Problem {
    points: ProblemPoints,
    gravity: [f64; 2],
    bonds: Vec<ProblemBond>,
}

#[derive(Deserialize)]
struct ProblemPoints {
    position: Vec<[f64; 2]>,
    mass: Vec<f64>,
    pinned: Vec<usize>,
}

#[derive(Deserialize)]
struct ProblemBond {
    a: usize,
    b: usize,
    rest: f64,
}

#[derive(Deserialize)]
struct Truth {
    samples: Vec<Sample>,
}

#[derive(Deserialize)]
struct Sample {
    t: f64,
    position: Vec<[f64; 2]>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hung_sheet_has_rows_columns_and_both_diagonals() {
        let scene = hung("hung 100^2", 100);
        assert_eq!((scene.positions.len(), scene.bonds.len(), scene.pinned.len()), (10_000, 39_402, 100));
    }

    #[test]
    fn a_rim_has_26_points_62_bonds_and_one_pin() {
        let scene = rims("3 rims", 3);
        assert_eq!((scene.positions.len(), scene.bonds.len()), (3 * 26, 3 * 62));
        assert_eq!(scene.pinned, [0, 26, 52]);
        assert!(scene.bonds.iter().all(|bond| bond.ends[0] / 26 == bond.ends[1] / 26));
    }

    #[test]
    fn bonds_have_their_rest_lengths_at_the_start() -> Result<()> {
        for scene in all(false)? {
            for bond in &scene.bonds {
                let [p, q] = bond.ends.map(|i| scene.positions[i]);
                assert!(((p[0] - q[0]).hypot(p[1] - q[1]) / bond.rest - 1.0).abs() < 1e-12, "{}", scene.name);
            }
        }
        Ok(())
    }
}
