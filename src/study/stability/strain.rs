//! How far rigid bonds are from their lengths, by what holds them.

use serde::Serialize;

use super::pieces::Pieces;
use crate::sim::reach::{Reach, reaches};
use crate::sim::{BondKind, Dynamics, Limit, Precision, Sample, Solver};

/// Largest strains of rigid bonds at the ends of frames `[1]`, by what moved them there; what rounding makes counts as none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Strains {
    /// Of islands that are small enough to be solved.
    pub solved: f64,
    /// The same in frames in which a substep was split or went to a more robust method.
    pub guarded: f64,
    /// Of islands that are swept, as a share of what they may have: `max_strain`, 0.02 unless stated.
    pub swept: f64,
    /// Of what the live step moves.
    pub live: f64,
}

/// Most bonds of an island that is held to be solved.
const MOST_SOLVED: u32 = 2_000;
/// Strain of larger ones where none is stated `[1]`.
const SWEPT: f64 = 0.02;
/// How many times the strain that tracks force on the way between two pins something on it may have: ways that are shorter, and what is led
/// sideways, share it unevenly.
const FORCED: f64 = 2.0;
/// Roundings of the places of both ends that a length may be off by.
const ROUNDINGS: f64 = 4.0;

/// The strains of a run.
#[derive(Clone, Debug)]
pub(super) struct Strain {
    pieces: Pieces,
    /// How far apart bonds let pins be, of the world as it stood when that was looked at last.
    reaches: (Option<u64>, Vec<Reach>),
    /// What swept bonds may have `[1]`.
    may: f64,
    /// Splits and fallbacks until the last look.
    guards: u64,
    /// Largest of all `[1]`.
    pub(super) largest: f64,
    pub(super) most: Strains,
}

impl Strain {
    /// Of a scene that states what large bodies may have, or does not.
    pub(super) fn new(max_strain: Option<f64>) -> Self {
        let may = max_strain.unwrap_or(SWEPT);
        Strain {
            pieces: Pieces::default(),
            reaches: (None, Vec::new()),
            may,
            guards: 0,
            largest: 0.0,
            most: Strains::default(),
        }
    }

    /// The end of a frame.
    pub(super) fn look(&mut self, world: &dyn Dynamics, sample: &Sample) {
        self.pieces.follow(world);
        let forced = FORCED * self.forced(world, sample);
        let counters = world.counters();
        let is_guarded = counters.guard_splits + counters.fallbacks > self.guards;
        self.guards = counters.guard_splits + counters.fallbacks;
        let epsilon = if world.precision() == Precision::F32 { f64::from(f32::EPSILON) } else { f64::EPSILON };
        for bond in world.bonds().iter().filter(|bond| bond.kind == BondKind::Rigid && bond.rest_length > 0.0) {
            let Some(free) = self.pieces.free_end([bond.a, bond.b]) else { continue };
            let ends = [bond.a, bond.b].map(|end| sample.position[end.index()]);
            let strain = strain(ends, bond.rest_length, bond.limit);
            let farthest = ends.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            if strain.is_nan() || strain <= ROUNDINGS * epsilon * farthest / bond.rest_length {
                continue;
            }
            self.largest = self.largest.max(strain);
            let strain = (strain - forced).max(0.0);
            let solver = world.mover_of(free).map_or(Solver::Auto, |part| part.solver);
            let is_large = || self.pieces.piece([bond.a, bond.b]).is_some_and(|p| self.pieces.bonds(p) > MOST_SOLVED);
            let (most, strain) = match solver {
                Solver::Live => (&mut self.most.live, strain),
                Solver::Xpbd | Solver::Relaxation => (&mut self.most.swept, strain / self.may),
                _ if is_large() => (&mut self.most.swept, strain / self.may),
                _ if is_guarded => (&mut self.most.guarded, strain),
                _ => (&mut self.most.solved, strain),
            };
            *most = most.max(strain);
        }
    }
}

impl Strain {
    /// What pins that are led further apart than the bonds between them reach strain these by, at the least `[1]`.
    fn forced(&mut self, world: &dyn Dynamics, sample: &Sample) -> f64 {
        if self.reaches.0 != Some(world.topology()) {
            self.reaches = (Some(world.topology()), reaches(world.bonds().iter(), world.pinned(), world.pinned()));
        }
        let of = |reach: &Reach| {
            let [a, b] = reach.pins.map(|pin| sample.position[pin.index()]);
            (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt() / reach.most - 1.0
        };
        self.reaches.1.iter().map(of).filter(|strain| *strain > 1e-6).fold(0.0, f64::max)
    }
}

/// How much longer or shorter a bond is than it may be `[1]`.
fn strain([a, b]: [[f64; 3]; 2], rest: f64, limit: Limit) -> f64 {
    let length = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
    let stretch = length / rest - 1.0;
    match limit {
        Limit::Both => stretch.abs(),
        Limit::Max => stretch.max(0.0),
        Limit::Min => (-stretch).max(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    /// A rope of two bonds of 1 m under a method, looked at with its end off by so much `[m]`.
    fn strains(method: &str, off: f64) -> Strains {
        let text = format!(
            r#"{{"wobble": 1, "points": {{"position": [[0, 0], [1, 0], [2, 0]], "pinned": [0]}},
            "bonds": [{{"a": 0, "b": 1}}, {{"a": 1, "b": 2}}], "method": {method}}}"#
        );
        let world = Scene::parse(&text, "test").unwrap().world(None).unwrap();
        let mut sample = world.sample(0.0);
        sample.position[2][0] += off;
        let mut strain = Strain::new(None);
        strain.look(&*world, &sample);
        strain.most
    }

    #[test]
    fn a_strain_is_judged_by_what_holds_the_bond() {
        let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-9, "{found} for {expected}");
        near(strains(r#"{"solver": "velocity-verlet"}"#, 1e-3).solved, 1e-3);
        near(strains(r#"{"solver": "auto"}"#, 1e-3).solved, 1e-3);
        near(strains(r#"{"solver": "live"}"#, 1e-3).live, 1e-3);
        near(strains(r#"{"solver": "xpbd", "substep": 0.01, "iterations": 4}"#, 1e-3).swept, 0.05);
    }

    #[test]
    fn what_tracks_force_is_no_fault() {
        let text = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0], [2, 0]], "pinned": [0, 2]},
            "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}], "method": {"solver": "live"}}"#;
        let world = Scene::parse(text, "test").unwrap().world(None).unwrap();
        let judged = |middle: f64| {
            let mut sample = world.sample(0.0);
            (sample.position[1][0], sample.position[2][0]) = (middle, 2.2);
            let mut strain = Strain::new(None);
            strain.look(&*world, &sample);
            (strain.most.live, strain.largest)
        };
        let (beyond, largest) = judged(1.1);
        assert!(beyond == 0.0 && (largest - 0.1).abs() < 1e-9, "a tenth each is what it takes: {beyond}, {largest}");
        assert!((judged(1.4).0 - 0.2).abs() < 1e-9, "{:?}", judged(1.4));
    }

    #[test]
    fn what_rounding_makes_is_no_strain() {
        assert_eq!(strains(r#"{"solver": "verlet", "precision": "f64"}"#, 1e-15), Strains::default());
        let stretch = strain([[0.0; 3], [1.5, 0.0, 0.0]], 1.0, Limit::Min);
        assert_eq!((stretch, strain([[0.0; 3], [1.5, 0.0, 0.0]], 1.0, Limit::Max)), (0.0, 0.5));
    }
}
