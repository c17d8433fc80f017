//! Islands that rigid bonds hold in their shape, and the group of one.

use std::sync::Arc;

use super::gather::Gathered;
use super::island::Island;
use super::make::Maker;
use crate::sim::bond::{Bond, BondKind};
use crate::sim::group::Group;
use crate::sim::model::Model;
use crate::sim::real::Real;
use crate::sim::rigid::Rigid;
use crate::sim::rigid::shape::{Held, Shape};
use crate::sim::solver::Solver;
use crate::sim::vector::{flat, widen};

/// Marks the islands that move as rigid bodies where the rules choose.
pub(super) fn mark<S: Real, const D: usize>(gathered: &Gathered<S, D>, model: &Model<D>, islands: &mut [Island]) {
    if D != 2 || model.method.solver != Solver::Auto {
        return;
    }
    for island in islands {
        island.piece = shape(gathered, model, island);
    }
}

/// The shape of an island that is a rigid body, and its points in the order of that, pins included.
fn shape<S: Real, const D: usize>(
    gathered: &Gathered<S, D>,
    model: &Model<D>,
    island: &Island,
) -> Option<(Arc<Shape>, Vec<u32>)> {
    // Of a graph with fewer bonds something is loose.
    if island.relaxed > 0 || island.rigid + 3 < 2 * island.points.len() || island.points.len() < 2 {
        return None;
    }
    let bonds: Vec<Bond> = island.bonds.iter().map(|&k| gathered.bonds.get(k as usize)).collect();
    let (rigid, springs): (Vec<&Bond>, Vec<&Bond>) = bonds.iter().partition(|bond| bond.kind == BondKind::Rigid);
    let breaks = |bond: &&Bond| bond.break_strain.is_finite();
    if !rigid.iter().all(|bond| bond.holds()) || springs.iter().any(breaks) {
        return None;
    }
    let w = |point: u32| gathered.w[point as usize];
    let ends = || bonds.iter().flat_map(|bond| [bond.a.0, bond.b.0]);
    let mut points: Vec<u32> = island.points.iter().copied().chain(ends().filter(|&end| w(end) == 0.0)).collect();
    points.sort_unstable();
    points.dedup();
    let is_led = |point: &u32| model.pin_motion.iter().any(|(pin, _)| gathered.stand_ins[pin.index()] == *point);
    if points.iter().any(|point| w(*point) == 0.0 && is_led(point)) {
        return None;
    }
    let place = |point: u32| points.binary_search(&point).map_or(u32::MAX, |place| place as u32);
    let shape = Shape::of(Held {
        now: points.iter().map(|&point| flat(widen(gathered.state.position[point as usize]))).collect(),
        masses: points.iter().map(|&point| 1.0 / w(point)).collect(),
        bonds: rigid.iter().map(|bond| ([bond.a.0, bond.b.0].map(place), bond.rest_length)).collect(),
        surface: &[],
    })?;
    Some((Arc::new(shape), points))
}

impl<S: Real, const D: usize> Maker<'_, S, D> {
    /// `None` where some island is no rigid body.
    pub(super) fn make_rigid(&self) -> Option<Group<S, D>> {
        let islands = &self.lot.islands;
        let bonds = islands.iter().map(|island| island.bonds.len()).sum();
        let of = |island: &Island| {
            let (shape, points) = island.piece.as_ref()?;
            Some((shape.clone(), points.iter().map(|&point| self.place[point as usize]).collect()))
        };
        let shapes = islands.iter().map(of).collect::<Option<Vec<_>>>()?;
        let w: Vec<f64> = self.points.iter().map(|&i| self.gathered.w[i as usize]).collect();
        // Bodies move in `f64`: of what their points lose by rounding only single precision has to know.
        let points = if size_of::<S>() < size_of::<f64>() { self.state(&w) } else { self.batched_state() };
        let mover = Box::new(Rigid::new(shapes, bonds));
        Some(self.batched(points, self.batched_pull(), mover, Vec::new()))
    }
}
