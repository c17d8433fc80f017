//! What holds in a scene all the while it is played, worked out here from places and velocities.

use std::f64::consts::PI;

use serde::Deserialize;
use wobble::sim::{BondKind, Dynamics, Limit, Sample};

use crate::common::inside::{deepest, length, sub};

/// A law, and by how much it may be missed.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum Law {
    /// Rigid bonds have their length, strings are no longer, struts no shorter: |length/rest - 1| `[1]`.
    Lengths { within: f64 },
    /// No joint is beyond its stops by more `[rad]`.
    Stops { within: f64 },
    /// No point is deeper in walls, planes, polygons, balls or boxes `[m]`.
    Walls { within: f64 },
    /// While hands are off, energy only goes: it is never so much above what it was at its least `[J]`.
    Loses { within: f64 },
    /// While hands are off, energy stays what it is `[J]`.
    Keeps { within: f64 },
    /// From 2 s on what wind, muscles and motors brought less what drag, dampers and friction took is what the energy changed by, to this
    /// share of the larger `[1]`.
    Books { within: f64 },
    /// From a time on `[s]`, until it is played with again, no point goes further in a second `[m/s]`.
    Rests { by: f64, to: Option<f64>, within: f64 },
    /// From a time on `[s]` no triangle is inside out: how many are.
    Whole { by: f64, within: f64 },
}

/// What is known of a run so far.
#[derive(Default)]
pub(super) struct Past {
    /// Twice the areas of the triangles at the start `[m^2]`.
    areas: Vec<f64>,
    /// The energy since hands are off: at first, and the least `[J]`.
    energy: Option<[f64; 2]>,
    /// When it was looked at last `[s]`, and where all points were `[m]`.
    last: (f64, Vec<[f64; 3]>),
}

impl Past {
    pub(super) fn of(world: &dyn Dynamics) -> Self {
        Past { areas: areas(world, &world.sample(world.time())), ..Past::default() }
    }

    /// Hands are on it.
    pub(super) fn forget(&mut self) {
        self.energy = None;
    }

    /// Notes a state that nobody leads.
    pub(super) fn note(&mut self, sample: &Sample) {
        let [start, least] = self.energy.unwrap_or([sample.energy; 2]);
        self.energy = Some([start, least.min(sample.energy)]);
    }

    /// The next state comes.
    pub(super) fn leave(&mut self, sample: &Sample) {
        self.last = (sample.time, sample.position.clone());
    }
}

impl Law {
    pub(super) fn within(self) -> f64 {
        match self {
            Law::Lengths { within }
            | Law::Stops { within }
            | Law::Walls { within }
            | Law::Loses { within }
            | Law::Keeps { within }
            | Law::Books { within }
            | Law::Rests { within, .. }
            | Law::Whole { within, .. } => within,
        }
    }

    /// By how much a state misses it.
    pub(super) fn missed(self, world: &dyn Dynamics, sample: &Sample, past: &Past) -> f64 {
        match self {
            Law::Rests { by, .. } | Law::Whole { by, .. } if sample.time < by => 0.0,
            Law::Rests { to: Some(to), .. } if sample.time > to => 0.0,
            Law::Lengths { .. } => strained(world, sample),
            Law::Stops { .. } => beyond_stops(world, sample),
            Law::Walls { .. } => deepest(world, sample),
            Law::Loses { .. } => past.energy.map_or(0.0, |[_, least]| sample.energy - least),
            Law::Keeps { .. } => past.energy.map_or(0.0, |[start, _]| (sample.energy - start).abs()),
            Law::Books { .. } => {
                let share = |ledger: &wobble::sim::Ledger| {
                    ledger.left_over().abs() / ledger.book.brought().abs().max(ledger.book.taken())
                };
                sample.ledger.as_ref().filter(|_| sample.time >= 2.0).map_or(0.0, share)
            }
            Law::Rests { .. } => {
                let (when, places) = &past.last;
                let way = |(now, before): (&[f64; 3], &[f64; 3])| length(sub(*now, *before)) / (sample.time - when);
                sample.position.iter().zip(places).map(way).fold(0.0, f64::max)
            }
            Law::Whole { .. } => {
                let now = areas(world, sample);
                past.areas.iter().zip(&now).filter(|(before, now)| *before * **now < 0.0).count() as f64
            }
        }
    }
}

/// The largest |length/rest - 1| of rigid bonds, where they act.
fn strained(world: &dyn Dynamics, sample: &Sample) -> f64 {
    let mut most = 0.0_f64;
    for bond in world.bonds().iter().filter(|bond| bond.kind == BondKind::Rigid && bond.rest_length > 0.0) {
        let [a, b] = [bond.a, bond.b].map(|end| sample.position[end.index()]);
        let strain = length(sub(a, b)) / bond.rest_length - 1.0;
        most = most.max(match bond.limit {
            Limit::Both => strain.abs(),
            Limit::Max => strain,
            Limit::Min => -strain,
        });
    }
    most
}

/// How far the farthest joint is beyond its stops [rad].
fn beyond_stops(world: &dyn Dynamics, sample: &Sample) -> f64 {
    let off = |angle: &wobble::sim::Angle| {
        let [least, most] = angle.range?;
        let [from, at, to] = angle.points.map(|point| sample.position[point.index()]);
        let turn = |x: [f64; 3]| (x[1] - at[1]).atan2(x[0] - at[0]);
        let turned = (turn(to) - turn(from) - 0.5 * (least + most) + PI).rem_euclid(2.0 * PI) - PI;
        Some(turned.abs() - 0.5 * (most - least))
    };
    world.angles().iter().filter_map(off).fold(0.0, f64::max)
}

/// Twice the signed areas of the triangles, by their numbers; none in space, and none where some went [m^2].
fn areas(world: &dyn Dynamics, sample: &Sample) -> Vec<f64> {
    if world.dimensions() != 2 {
        return Vec::new();
    }
    let size = |corners: &[wobble::sim::PointId; 3]| {
        let [a, b, c] = corners.map(|corner| sample.position[corner.index()]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    world.triangles().iter().map(size).collect()
}
