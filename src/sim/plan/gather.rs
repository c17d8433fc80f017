//! From islands to groups: points, forces, rigid bonds and the engine of each.

use super::drive::Drives;
use super::island::{Patched, Ties};
use super::lot::Lot;
use super::make::Maker;
use super::taut::{self, Stand};
use super::{Plan, PlanPart};
use crate::sim::bond::{Bond, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::bulk::kernel::Kernel;
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::force::angle::Angle;
use crate::sim::force::mouse::Track;
use crate::sim::model::Model;
use crate::sim::points::State;
use crate::sim::real::Real;
use crate::sim::solver::Solver;
use crate::sim::vector::{add, length, scale, sub, widen, zero};

/// Place of a point that is in no group.
pub(crate) const NOWHERE: [u32; 2] = [u32::MAX; 2];

/// Points with welds merged, and the bonds between them.
pub(super) struct Gathered<S, const D: usize> {
    /// For every point of the model the one that stands for it.
    pub(super) stand_ins: Vec<u32>,
    /// Of the points that stand for others: with all of their mass.
    pub(super) w: Vec<f64>,
    pub(super) state: State<S, D>,
    pub(super) bonds: Bonds,
    /// Which bond of the world each is.
    pub(super) names: Vec<u32>,
    /// Forces and the wind.
    pub(super) drives: Drives<D>,
    pub(super) ties: Ties,
    /// Pins that may be met, where what is live has to know of them.
    fixtures: Vec<u32>,
    /// Triangles between the points that stand for others, without those that welds leave no area: their places in the model, by the lowest
    /// corner of each, and where those of every point begin.
    by_corner: (Vec<u32>, Vec<u32>),
}

impl<S: Real, const D: usize> Gathered<S, D> {
    pub(super) fn new(
        model: &Model<D>,
        (bonds, numbers): (&Bonds, Option<&[u32]>),
        w: &[f64],
        stand_ins: &[u32],
        state: &State<S, D>,
    ) -> Self {
        let mut gathered = Gathered {
            stand_ins: stand_ins.to_vec(),
            w: w.to_vec(),
            state: state.clone(),
            bonds: Bonds::with_capacity(bonds.len()),
            names: Vec::with_capacity(bonds.len()),
            drives: Drives::new(model, w, stand_ins),
            ties: ties(model, stand_ins, |i| widen(state.position[i])),
            by_corner: by_corner(&model.triangles, stand_ins),
            fixtures: if model.meets_on_demand() {
                fixtures(&model.triangles, bonds, &model.pinned)
            } else {
                Vec::new()
            },
        };
        gathered.merge(model, w);
        for (k, bond) in bonds.iter().enumerate() {
            let [a, b] = [bond.a, bond.b].map(|end| PointId(stand_ins[end.index()]));
            if a != b {
                gathered.bonds.push(Bond { a, b, ..bond });
                gathered.names.push(numbers.map_or(k as u32, |numbers| numbers[k]));
            }
        }
        gathered
    }

    /// Gives points that stand for others their mass, and the place and velocity of the whole.
    fn merge(&mut self, model: &Model<D>, w: &[f64]) {
        let mut members: Vec<Vec<usize>> = vec![Vec::new(); w.len()];
        for (i, &stand_in) in self.stand_ins.iter().enumerate() {
            if stand_in as usize != i {
                members[stand_in as usize].push(i);
            }
        }
        for (i, others) in members.into_iter().enumerate().filter(|(_, others)| !others.is_empty()) {
            let all = || std::iter::once(i).chain(others.iter().copied());
            for &other in &others {
                self.w[other] = 0.0;
            }
            if let Some(pin) = all().find(|&j| w[j] == 0.0) {
                self.w[i] = 0.0;
                self.state.position[i] = self.state.position[pin];
                self.state.velocity[i] = zero();
                continue;
            }
            let mass: f64 = all().map(|j| model.mass[j]).sum();
            let mean =
                |list: &[[S; D]]| all().fold([0.0; D], |sum, j| add(sum, scale(widen(list[j]), model.mass[j] / mass)));
            let (x, v) = (mean(&self.state.position), mean(&self.state.velocity));
            self.w[i] = 1.0 / mass;
            self.state.position[i] = x.map(S::from_f64);
            self.state.velocity[i] = v.map(S::from_f64);
        }
    }

    /// Points that taut rows hold stand still.
    pub(super) fn hold_taut(&mut self, model: &Model<D>) {
        let mut kinds: Vec<Stand> = self.w.iter().map(|&w| if w == 0.0 { Stand::Still } else { Stand::Free }).collect();
        let place = |pin: &PointId| widen(self.state.position[pin.index()]);
        let goes = |(pin, track): &&(PointId, Track<D>)| track.knots.iter().any(|knot| knot.1 != place(pin));
        for (pin, _) in model.pin_motion.iter().filter(goes) {
            kinds[self.stand_ins[pin.index()] as usize] = Stand::Led;
        }
        let State { position, velocity, .. } = &mut self.state;
        for point in taut::held(&self.bonds, |i| widen(position[i as usize]), kinds, S::EPSILON.to_f64()) {
            self.w[point as usize] = 0.0;
            velocity[point as usize] = zero();
        }
    }

    /// The triangles whose lowest corner is a point.
    pub(super) fn triangles_at(&self, point: u32) -> &[u32] {
        let (list, starts) = &self.by_corner;
        starts.get(point as usize..point as usize + 2).map_or(&[], |ends| &list[ends[0] as usize..ends[1] as usize])
    }

    /// The groups of the lots.
    pub(super) fn plan(&self, (model, obstacles): (&Model<D>, &Obstacles<S, D>), lots: Vec<Lot>) -> Plan<S, D> {
        let mut slots = vec![NOWHERE; self.w.len()];
        let mut groups = Vec::with_capacity(lots.len());
        let mut parts: Vec<PlanPart> = Vec::new();
        let mut own = Vec::with_capacity(lots.len());
        let mut kernels: Vec<Option<Kernel>> = Vec::new();
        let mut place = vec![u32::MAX; self.w.len()];
        for (g, lot) in lots.iter().enumerate() {
            let points = self.points_of(lot, g == 0, &lots);
            for (slot, &point) in points.iter().enumerate() {
                place[point as usize] = slot as u32;
                if slots[point as usize] == NOWHERE {
                    slots[point as usize] = [g as u32, slot as u32];
                }
            }
            let mut group = Maker { gathered: self, model, obstacles, lot, points: &points, place: &place }.make();
            group.work = super::cost::work(&group);
            points.iter().for_each(|&point| place[point as usize] = u32::MAX);
            let part = PlanPart {
                points: lot.islands.iter().map(|island| island.points.len()).sum(),
                bonds: lot.islands.iter().map(|island| island.bonds.len()).sum(),
                islands: lot.islands.len(),
                work: super::cost::of(&group),
                kernel: group.kernel().map_or(String::new(), |kernel| kernel.to_string()),
                ..PlanPart::of(lot)
            };
            if lot.class == parts.len() {
                parts.push(PlanPart::of(lot));
                kernels.push(None);
            }
            parts[lot.class].include(&part);
            let kernel = &mut kernels[lot.class];
            *kernel = group.kernel().map(|of| kernel.map_or(of, |sum| sum.and(of)));
            own.push(part);
            groups.push(group);
        }
        for (part, kernel) in parts.iter_mut().zip(kernels) {
            part.kernel = kernel.map_or(String::new(), |kernel| kernel.to_string());
        }
        for i in 0..slots.len() {
            slots[i] = slots[self.stand_ins[i] as usize];
        }
        if parts.iter().any(|part| part.points > 0) {
            parts.retain(|part| part.points > 0);
        }
        let is_plain = groups.len() == 1 && slots.iter().enumerate().all(|(i, slot)| *slot == [0, i as u32]);
        let longest = lots.iter().map(|lot| lot.choice.substep).fold(0.0, f64::max);
        let substep = model.method.substep.unwrap_or(longest);
        if is_plain {
            slots = Vec::new();
        }
        Plan { groups, slots, is_plain, substep, parts, own }
    }

    /// The points of a lot, ascending: those of its islands, the pins that they are fastened to or, where they are live, may meet, and in
    /// the first lot the pins that nothing is fastened to.
    fn points_of(&self, lot: &Lot, is_first: bool, lots: &[Lot]) -> Vec<u32> {
        let mut points: Vec<u32> = lot.islands.iter().flat_map(|island| island.points.iter().copied()).collect();
        let pins_of = |lot: &Lot| -> Vec<u32> {
            let bonds = lot.islands.iter().flat_map(|island| &island.bonds).map(|&k| &self.bonds.ends()[k as usize]);
            let ends = bonds.flatten().filter(|end| self.w[end.index()] == 0.0);
            let angles = lot.islands.iter().flat_map(|island| &island.angles);
            let angles = angles.map(|&k| self.ties.angles[k as usize].points);
            let patches = lot.islands.iter().flat_map(|island| &island.patches);
            let tied = angles.chain(patches.map(|&k| self.ties.patches[k as usize].corners)).flatten();
            ends.copied().chain(tied.filter(|point| self.w[point.index()] == 0.0)).map(|end| end.0).collect()
        };
        points.extend(pins_of(lot));
        if lot.choice.solver == Solver::Live {
            points.extend(self.fixtures.iter().map(|&pin| self.stand_ins[pin as usize]));
        }
        if is_first {
            let mut fastened = vec![false; self.w.len()];
            for pin in lots.iter().flat_map(pins_of) {
                fastened[pin as usize] = true;
            }
            let loose =
                |&i: &u32| self.w[i as usize] == 0.0 && !fastened[i as usize] && self.stand_ins[i as usize] == i;
            points.extend((0..self.w.len() as u32).filter(loose));
        }
        points.sort_unstable();
        points.dedup();
        points
    }
}

fn by_corner(triangles: &[[PointId; 3]], stand_ins: &[u32]) -> (Vec<u32>, Vec<u32>) {
    if triangles.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let mut list: Vec<(u32, u32)> = Vec::with_capacity(triangles.len());
    for (corners, k) in triangles.iter().zip(0..) {
        let [a, b, c] = corners.map(|corner| stand_ins[corner.index()]);
        if a != b && b != c && c != a {
            list.push((a.min(b).min(c), k));
        }
    }
    list.sort_unstable();
    let starts = (0..=stand_ins.len() as u32).map(|point| list.partition_point(|entry| entry.0 < point) as u32);
    let starts = starts.collect();
    (list.into_iter().map(|entry| entry.1).collect(), starts)
}

/// What is there to be met and does not move by itself: the corners of triangles and the ends of bonds that are pinned all over, and pins that
/// nothing hangs on.
pub(crate) fn fixtures(triangles: &[[PointId; 3]], bonds: &Bonds, pins: &[PointId]) -> Vec<u32> {
    let mut pins: Vec<PointId> = pins.to_vec();
    pins.sort_unstable();
    let is_pinned = |point: &PointId| pins.binary_search(point).is_ok();
    let is_fixed = |corners: &&[PointId; 3]| corners.iter().all(is_pinned);
    let mut found: Vec<PointId> = triangles.iter().filter(is_fixed).flatten().copied().collect();
    let lines = bonds.ends().iter().filter(|ends| ends.iter().all(is_pinned));
    found.extend(lines.flatten());
    let mut fastened: Vec<PointId> = bonds
        .ends()
        .iter()
        .flatten()
        .chain(triangles.iter().flatten())
        .filter(|point| is_pinned(point))
        .copied()
        .collect();
    fastened.sort_unstable();
    found.extend(pins.iter().filter(|pin| fastened.binary_search(pin).is_err()));
    found.sort_unstable();
    found.dedup();
    found.into_iter().map(|point| point.0).collect()
}

/// Angles and areas between the points that stand for others, which are at these places; what a weld leaves no angle or area of is left out.
pub(crate) fn ties<const D: usize>(model: &Model<D>, stand_ins: &[u32], place: impl Fn(usize) -> [f64; D]) -> Ties {
    let merged = |points: [PointId; 3]| {
        let [a, b, c] = points.map(|point| PointId(stand_ins[point.index()]));
        (a != b && b != c && c != a).then_some([a, b, c])
    };
    let angle = |angle: &Angle| merged(angle.points).map(|points| Angle { points, ..*angle });
    let patch = |(corners, rest): ([PointId; 3], f64)| {
        let corners = merged(corners)?;
        let [a, b, c] = corners.map(|corner| place(corner.index()));
        let sides = [[a, b], [b, c], [c, a]].map(|[from, to]| length(sub(to, from)));
        let longest = sides.into_iter().fold(0.0, f64::max);
        Some(Patched { corners, rest, slender: 0.25 * longest * sides.iter().sum::<f64>() / rest })
    };
    Ties {
        angles: model.angles.list.iter().filter_map(angle).collect(),
        patches: model.patches().filter_map(patch).collect(),
        stiffness: model.areas.map_or(0.0, |areas| areas.stiffness),
    }
}
