//! Islands that move as rigid bodies, alone or in joints, and the group of one.

use std::sync::Arc;

use super::choice;
use super::gather::Gathered;
use super::island::Island;
use super::make::{Maker, breakable};
use crate::sim::bond::{Bond, BondKind, Limit, PointId};
use crate::sim::bulk::control::FRAME;
use crate::sim::bulk::mover::Mover;
use crate::sim::force::angle::Angle;
use crate::sim::group::Group;
use crate::sim::model::Model;
use crate::sim::real::Real;
use crate::sim::rigid::blueprint::{Blueprint, BodyPlan};
use crate::sim::rigid::link::End;
use crate::sim::rigid::shape::{FITS, Held, Shape};
use crate::sim::rigid::ties::Ties;
use crate::sim::rigid::{Rigid, space};
use crate::sim::sizes::{MOST_CORNERS, MOST_RODS, MOST_SOUGHT};
use crate::sim::solver::Solver;
use crate::sim::vector::{add, embed, flat, length, sub, widen};

/// Longest step of a world in which bodies in space are followed `[s]`: they spin part by part.
const LONGEST_IN_SPACE: f64 = 1.0;

/// What an island is as rigid bodies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pieces {
    plan: Plan,
    /// Its points in the order of that, pins included.
    points: Vec<u32>,
}

/// Bodies of an island, alone or in joints; in space a body alone.
#[derive(Clone, Debug, PartialEq)]
enum Plan {
    Plane(Arc<Blueprint>),
    Space(Arc<space::shape::Shape>),
}

impl Pieces {
    /// Whether all of its points are of one body.
    pub(crate) fn is_one(&self) -> bool {
        match &self.plan {
            Plan::Plane(plan) => plan.bodies.len() == 1 && plan.seats.is_empty(),
            Plan::Space(_) => true,
        }
    }

    /// Whether two points are on one body.
    fn share(&self, points: [PointId; 2]) -> bool {
        let places = self.places(points);
        let Plan::Plane(plan) = &self.plan else { return !places.contains(&u32::MAX) };
        // A point of two bodies has its seat on one of them, which need not be that of the other point.
        let on_seat = |place: &u32| match plan.seats.get(*place as usize) {
            Some(&End::On { body, .. }) => has_all(&plan.bodies[body as usize], &places),
            _ => false,
        };
        if self.is_one() { has_all(&plan.bodies[0], &places) } else { places.iter().any(on_seat) }
    }

    /// Whether points stay as far from each other as they are: on one body, or standing still.
    fn keep(&self, points: [PointId; 3]) -> bool {
        let places = self.places(points);
        let Plan::Plane(plan) = &self.plan else { return !places.contains(&u32::MAX) };
        let is_fixed = |&place: &u32| matches!(plan.seats.get(place as usize), Some(End::Fixed(_)));
        plan.bodies.iter().any(|body| has_all(body, &places)) || places.iter().all(is_fixed)
    }

    /// Where points stand in the plan.
    fn places<const N: usize>(&self, points: [PointId; N]) -> [u32; N] {
        points.map(|point| self.points.binary_search(&point.0).map_or(u32::MAX, |place| place as u32))
    }
}

/// Whether all of these points are on a body.
fn has_all(body: &BodyPlan, places: &[u32]) -> bool {
    places.iter().all(|place| body.points.binary_search(place).is_ok())
}

/// Marks the islands that move as rigid bodies where the rules choose.
pub(super) fn mark<S: Real, const D: usize>(
    gathered: &Gathered<S, D>,
    (model, has_surfaces): (&Model<D>, bool),
    islands: &mut [Island],
) {
    let solver = model.method.solver;
    // In space what meets more than planes is live from the start.
    let is_met = D == 3 && model.is_live();
    if is_met || !(solver == Solver::Auto || moves_bodies(solver)) || model.has_penalties() {
        return;
    }
    for island in islands {
        island.pieces = pieces(gathered, (model, has_surfaces), island);
    }
}

/// Whether a method that is asked for by its name moves what is one rigid body as such: its flight is exact, so that no order shows. Those
/// that are there to show what sweeps do move its bonds.
pub(super) fn moves_bodies(solver: Solver) -> bool {
    use Solver::{BackwardEuler, BlanesMoan4, BlanesMoan6, ImplicitMidpoint, Pefrl, Rk2, Rk4, Rk8, VelocityVerlet};
    matches!(
        solver,
        VelocityVerlet | Pefrl | BlanesMoan4 | BlanesMoan6 | Rk2 | Rk4 | Rk8 | ImplicitMidpoint | BackwardEuler
    )
}

/// The rigid bodies that an island is made of; `None`: it moves bond by bond.
fn pieces<S: Real, const D: usize>(
    gathered: &Gathered<S, D>,
    (model, has_surfaces): (&Model<D>, bool),
    island: &Island,
) -> Option<Pieces> {
    let most_alone = if has_surfaces { MOST_RODS } else { 0 };
    // A body has three bonds, in space six, of which pins need not have all.
    let is_too_little = island.rigid < 3 && (D == 3 || island.rigid == 0 || island.rigid > most_alone);
    if island.relaxed > 0 || is_too_little {
        return None;
    }
    let bonds: Vec<Bond> = island.bonds.iter().map(|&k| gathered.bonds.get(k as usize)).collect();
    let rigid: Vec<&Bond> = bonds.iter().filter(|bond| bond.holds()).collect();
    // What may break or acts one way only makes no body; within one it never does, and what may break joins bodies.
    let is_doubtful = |bond: &&Bond| !bond.holds() && (bond.kind == BondKind::Rigid || bond.break_strain.is_finite());
    let doubtful: Vec<&Bond> = bonds.iter().filter(is_doubtful).collect();
    let w = |point: u32| gathered.w[point as usize];
    let of_angles = island.angles.iter().flat_map(|&k| gathered.ties.angles[k as usize].points);
    let ends = || bonds.iter().flat_map(|bond| [bond.a, bond.b]).chain(of_angles.clone()).map(|end| end.0);
    let mut points: Vec<u32> = island.points.iter().copied().chain(ends().filter(|&end| w(end) == 0.0)).collect();
    points.sort_unstable();
    points.dedup();
    let is_led = |point: &u32| model.pin_motion.iter().any(|(pin, _)| gathered.stand_ins[pin.index()] == *point);
    let place = |point: u32| points.binary_search(&point).map_or(u32::MAX, |place| place as u32);
    let masses = || points.iter().map(|&point| 1.0 / w(point)).collect();
    let lengths = || rigid.iter().map(|bond| ([bond.a.0, bond.b.0].map(place), bond.rest_length)).collect();
    let held = || Held {
        now: points.iter().map(|&point| flat(widen(gathered.state.position[point as usize]))).collect(),
        masses: masses(),
        bonds: lengths(),
        surface: &[],
    };
    let is_loose = |bond: &&&Bond| bond.kind == BondKind::Rigid && bond.rest_length > 0.0;
    let among = |bond: &&Bond| Bond { a: PointId(place(bond.a.0)), b: PointId(place(bond.b.0)), ..**bond };
    let loose: Vec<Bond> = doubtful.iter().filter(is_loose).map(among).collect();
    let is_led = |k: u32| w(points[k as usize]) == 0.0 && is_led(&points[k as usize]);
    let is_led_any = (0..points.len() as u32).any(is_led);
    let is_braced = island.rigid + 3 >= 2 * island.points.len() && !is_led_any;
    let one = (D == 2 && is_braced).then(|| Shape::of(held())).flatten().map(Blueprint::alone);
    // A step of hours would be gone through part by part; and what swings in joints shows the order of a method that is asked for.
    let may_swing = model.method.solver == Solver::Auto && model.method.substep.is_none_or(|h| h <= FRAME);
    let plan = if D == 3 {
        let is_short = model.method.substep.is_none_or(|h| h <= LONGEST_IN_SPACE);
        let now = points.iter().map(|&point| embed(state_of(gathered, point))).collect();
        let held = || space::layout::Held { now, masses: masses(), bonds: lengths() };
        // What a pin holds against surfaces that rub may have no way out of them, and each corner that lies on them feels all others.
        let is_hindered = has_surfaces && points.iter().any(|&point| w(point) == 0.0);
        let shape = (is_short && !is_led_any && !is_hindered).then(held).and_then(space::shape::Shape::of)?;
        let shape = if has_surfaces { shape.with_corners(MOST_CORNERS)? } else { shape };
        Plan::Space(Arc::new(shape))
    } else {
        let joined = || may_swing.then(|| joined(island, (held(), &loose, most_alone), is_led)).flatten();
        Plan::Plane(Arc::new(one.or_else(joined)?))
    };
    let pieces = Pieces { plan, points };
    let corners = |&k: &u32| gathered.ties.patches[k as usize].corners;
    let is_fine = island.patches.iter().map(corners).all(|corners| pieces.keep(corners))
        && doubtful.iter().all(|bond| {
            let is_fit = bond.drive.is_none() || bond.kind != BondKind::Rigid;
            if is_fit { is_borne(gathered, bond) } else { !pieces.keep([bond.a, bond.b, bond.b]) }
        });
    is_fine.then_some(pieces)
}

/// Where a point is, with what rounding took from that.
fn state_of<S: Real, const D: usize>(gathered: &Gathered<S, D>, point: u32) -> [f64; D] {
    let (i, state) = (point as usize, &gathered.state);
    let lost = state.position_lost.get(i).map_or([0.0; D], |lost| widen(*lost));
    add(widen(state.position[i]), lost)
}

/// Whether a bond that may break or acts one way only does neither at the length that it has now: that of a rigid one is its own.
fn is_borne<S: Real, const D: usize>(gathered: &Gathered<S, D>, bond: &Bond) -> bool {
    let [a, b] = [bond.a, bond.b].map(|end| widen(gathered.state.position[end.index()]));
    let far = length(sub(a, b));
    let strain = if bond.rest_length > 0.0 { far / bond.rest_length - 1.0 } else { far };
    let is_fit = match bond.limit {
        _ if bond.kind != BondKind::Rigid => true,
        Limit::Both => strain.abs() <= FITS,
        Limit::Max => strain <= FITS,
        Limit::Min => strain >= -FITS,
    };
    is_fit && strain.is_finite() && (strain.abs() <= bond.break_strain)
}

/// Several bodies, where springs between them are not too stiff for explicit steps.
fn joined(
    island: &Island,
    (held, loose, most_alone): (Held<'_>, &[Bond], usize),
    is_led: impl Fn(u32) -> bool,
) -> Option<Blueprint> {
    if choice::is_stiff(island) || island.rigid > MOST_SOUGHT {
        return None;
    }
    Blueprint::of(&held, loose, most_alone, is_led)
}

/// Springs and angles between different bodies of a plan, whose points are these.
fn ties<S: Real, const D: usize>(gathered: &Gathered<S, D>, island: &Island, pieces: &Pieces) -> Ties {
    let Pieces { plan: Plan::Plane(plan), points } = pieces else { return Ties::none() };
    if pieces.is_one() {
        return Ties::none();
    }
    let place = |point: PointId| PointId(points.binary_search(&point.0).map_or(u32::MAX, |place| place as u32));
    let are_apart = |ends: &[PointId]| {
        // A point of two bodies has its seat on one of them: joints tell of the other.
        let bodies = |end: &PointId| plan.bodies.iter().filter(|body| body.points.contains(&end.0)).count();
        let seat = |end: &PointId| match plan.seats[end.index()] {
            End::On { body, .. } => body,
            End::Fixed(_) => u32::MAX,
        };
        ends.iter().any(|end| seat(end) != seat(&ends[0]) || bodies(end) > 1)
    };
    let of_bond = |&k: &u32| {
        let bond = gathered.bonds.get(k as usize);
        let ends = [bond.a, bond.b].map(place);
        let is_meant = bond.kind != BondKind::Rigid && are_apart(&ends);
        is_meant.then_some((gathered.names[k as usize], Bond { a: ends[0], b: ends[1], ..bond }))
    };
    let of_angle = |&k: &u32| {
        let angle = gathered.ties.angles[k as usize];
        let points = angle.points.map(place);
        are_apart(&points).then_some(Angle { points, ..angle })
    };
    let springs: Vec<(u32, Bond)> = island.bonds.iter().filter_map(of_bond).collect();
    let angles: Vec<Angle> = island.angles.iter().filter_map(of_angle).collect();
    if springs.is_empty() && angles.is_empty() {
        return Ties::none();
    }
    let w: Vec<f64> = points.iter().map(|&point| gathered.w[point as usize]).collect();
    let rates = [island.frequency.max(island.drive_rate), island.decay];
    Ties::new(plan.seats.clone(), &springs, &angles, (&w, rates))
}

impl<S: Real, const D: usize> Maker<'_, S, D> {
    /// `None` where some island is none of rigid bodies.
    pub(super) fn make_rigid(&self) -> Option<Group<S, D>> {
        let islands = &self.lot.islands;
        let bonds = islands.iter().map(|island| island.bonds.len()).sum();
        let (mut plans, mut shapes) = (Vec::new(), Vec::new());
        for island in islands {
            let pieces = island.pieces.as_ref()?;
            let slots = pieces.points.iter().map(|&point| self.place[point as usize]).collect();
            match &pieces.plan {
                Plan::Plane(plan) => plans.push((plan.clone(), slots, ties(self.gathered, island, pieces))),
                Plan::Space(shape) => shapes.push((shape.clone(), slots)),
            }
        }
        let w: Vec<f64> = self.points.iter().map(|&i| self.gathered.w[i as usize]).collect();
        // Bodies move in `f64`: of what their points lose by rounding only single precision has to know.
        let points = if size_of::<S>() < size_of::<f64>() { self.state(&w) } else { self.batched_state() };
        let mover: Box<dyn Mover<S, D>> = if shapes.is_empty() {
            Box::new(Rigid::new(plans, bonds))
        } else {
            Box::new(space::Rigid::new(shapes, bonds))
        };
        let between = self.fragile_between();
        let fragile = breakable(self.bonds().filter(|(name, _)| between.binary_search(name).is_ok()), |_| true);
        Some(self.batched(points, self.batched_pull(), mover, fragile))
    }

    /// The numbers in the world, ascending, of bonds between bodies that may break: within a body nothing is strained.
    fn fragile_between(&self) -> Vec<u32> {
        let mut list = Vec::new();
        for island in &self.lot.islands {
            let is_between = |bond: &Bond| !island.pieces.as_ref().is_some_and(|of| of.share([bond.a, bond.b]));
            for &k in &island.bonds {
                let bond = self.gathered.bonds.get(k as usize);
                if bond.break_strain.is_finite() && is_between(&bond) {
                    list.push(self.gathered.names[k as usize]);
                }
            }
        }
        list.sort_unstable();
        list
    }
}
