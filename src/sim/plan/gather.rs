//! From islands to groups: points, forces, rigid bonds and the engine of each.

use super::{Lot, Plan, PlanPart, is_rigid};
use crate::sim::bond::{Bond, BondKind, PointId};
use crate::sim::constrain::direct::Direct;
use crate::sim::constrain::order::Sweeper;
use crate::sim::constrain::relaxed::RelaxedBond;
use crate::sim::constrain::rigid::RigidBond;
use crate::sim::constrain::shape::{Row, Shape};
use crate::sim::constrain::xpbd::CompliantBond;
use crate::sim::contact::Contacts;
use crate::sim::contact::surface::surfaces;
use crate::sim::force::spring::Springs;
use crate::sim::group::engine::{COMPOSED_4, COMPOSED_6, Engine, SINGLE};
use crate::sim::group::events::edge::Edges;
use crate::sim::group::guard::{Guard, Watched};
use crate::sim::group::{Breakable, Group};
use crate::sim::integrate::implicit::Implicit;
use crate::sim::integrate::kick_drift::{KickDrift, Swept};
use crate::sim::integrate::runge_kutta::Stages;
use crate::sim::integrate::splitting::{self, Part, Splitting};
use crate::sim::integrate::tableau::{EULER, RK2, RK4, RK8, Tableau};
use crate::sim::model::{Model, Order};
use crate::sim::points::{Points, State};
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::solver::Solver;
use crate::sim::vector::{add, scale, widen, zero};

/// Place of a point that is in no group yet.
const NOWHERE: [u32; 2] = [u32::MAX; 2];

/// Points with welds merged, and the bonds between them.
pub(super) struct Gathered<S, const D: usize> {
    /// For every point of the model the one that stands for it.
    stand_ins: Vec<u32>,
    /// Of the points that stand for others: with all of their mass.
    pub(super) w: Vec<f64>,
    state: State<S, D>,
    pub(super) bonds: Vec<Bond>,
    /// Which bond of the world each is.
    names: Vec<u32>,
}

impl<S: Real, const D: usize> Gathered<S, D> {
    pub(super) fn new(model: &Model<D>, bonds: &[Bond], w: &[f64], stand_ins: &[u32], state: &State<S, D>) -> Self {
        let mut gathered = Gathered {
            stand_ins: stand_ins.to_vec(),
            w: w.to_vec(),
            state: state.clone(),
            bonds: Vec::with_capacity(bonds.len()),
            names: Vec::with_capacity(bonds.len()),
        };
        gathered.merge(model, w);
        for (name, bond) in bonds.iter().enumerate() {
            let [a, b] = [bond.a, bond.b].map(|end| PointId(stand_ins[end.index()]));
            if a != b {
                gathered.bonds.push(Bond { a, b, ..*bond });
                gathered.names.push(name as u32);
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

    /// The groups of the lots.
    pub(super) fn plan(&self, model: &Model<D>, lots: Vec<Lot>) -> Plan<S, D> {
        let mut slots = vec![NOWHERE; self.w.len()];
        let mut groups = Vec::with_capacity(lots.len());
        let mut parts = Vec::with_capacity(lots.len());
        for (g, lot) in lots.iter().enumerate() {
            let points = self.points_of(lot, g == 0, &lots);
            let mut place = vec![u32::MAX; self.w.len()];
            for (slot, &point) in points.iter().enumerate() {
                place[point as usize] = slot as u32;
                if slots[point as usize] == NOWHERE {
                    slots[point as usize] = [g as u32, slot as u32];
                }
            }
            let group = Maker { gathered: self, model, lot, points: &points, place: &place }.make();
            parts.push(PlanPart {
                solver: lot.choice.solver,
                substep: lot.choice.substep,
                points: lot.islands.iter().map(|island| island.points.len()).sum(),
                bonds: lot.islands.iter().map(|island| island.bonds.len()).sum(),
                islands: lot.islands.len(),
                work: super::super::cost::of(&group),
            });
            groups.push(group);
        }
        for i in 0..slots.len() {
            slots[i] = slots[self.stand_ins[i] as usize];
        }
        let is_plain = groups.len() == 1 && slots.iter().enumerate().all(|(i, slot)| *slot == [0, i as u32]);
        let longest = lots.iter().map(|lot| lot.choice.substep).fold(0.0, f64::max);
        let substep = model.method.substep.unwrap_or(longest);
        Plan { groups, slots, is_plain, substep, parts }
    }

    /// The points of a lot, ascending: those of its islands, the pins that they are fastened to, and in the first lot
    /// the pins that nothing is fastened to.
    fn points_of(&self, lot: &Lot, is_first: bool, lots: &[Lot]) -> Vec<u32> {
        let mut points: Vec<u32> = lot.islands.iter().flat_map(|island| island.points.iter().copied()).collect();
        let pins_of = |lot: &Lot| -> Vec<u32> {
            let bonds = lot.islands.iter().flat_map(|island| &island.bonds).map(|&k| &self.bonds[k as usize]);
            let ends = bonds.flat_map(|bond| [bond.a, bond.b]).filter(|end| self.w[end.index()] == 0.0);
            ends.map(|end| end.0).collect()
        };
        points.extend(pins_of(lot));
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

/// Makes one group.
struct Maker<'a, S, const D: usize> {
    gathered: &'a Gathered<S, D>,
    model: &'a Model<D>,
    lot: &'a Lot,
    /// Points of the model, in the order of the group.
    points: &'a [u32],
    /// Place of every point of the model in the group.
    place: &'a [u32],
}

impl<S: Real, const D: usize> Maker<'_, S, D> {
    fn make(&self) -> Group<S, D> {
        let choice = self.lot.choice;
        let w: Vec<f64> = self.points.iter().map(|&i| self.gathered.w[i as usize]).collect();
        let bonds = self.bonds();
        let mut points = self.state(&w);
        let rigid = (choice.is_direct && choice.solver.solves_directly())
            .then(|| rows(&bonds, &points.inverse_mass))
            .filter(|rows: &Vec<Row<S>>| !rows.is_empty())
            .map(|rows| Direct::new(Shape::new(rows, self.points.len())));
        let springs = match choice.solver {
            Solver::Xpbd => Springs::none(),
            _ => Springs::new(bonds.iter().map(|(_, bond)| bond), self.points.len()),
        };
        let pull = Pull {
            springs,
            contacts: Contacts::new(surfaces(self.model), self.points.len()),
            rigid,
            inside: None,
            gravity: self.model.gravity,
            drag_rate: self.model.drag_rate,
        };
        self.allocate(&mut points, &pull);
        let engine = self.engine(choice.solver, &bonds, &points, &pull);
        let robust = self.robust(&bonds, &points, &pull).map(Box::new);
        let locates = choice.solver.locates_events() && self.points.len() <= MOST_LOCATED;
        Group {
            guard: self.guard(&bonds),
            breakable: breakable(&bonds, |_| true),
            edges: if locates { Edges::of(&pull, &breakable(&bonds, is_elastic)) } else { Edges::none() },
            tracks: self.tracks(),
            substep: choice.substep,
            locates,
            before: State::default(),
            acceleration: Vec::new(),
            points,
            pull,
            engine,
            robust,
        }
    }

    /// The bonds of the lot as listed, between points of the group, with their names.
    fn bonds(&self) -> Vec<(u32, Bond)> {
        let mut list: Vec<u32> = self.lot.islands.iter().flat_map(|island| island.bonds.iter().copied()).collect();
        list.sort_unstable();
        let moved = |k: u32| {
            let bond = self.gathered.bonds[k as usize];
            let [a, b] = [bond.a, bond.b].map(|end| PointId(self.place[end.index()]));
            (self.gathered.names[k as usize], Bond { a, b, ..bond })
        };
        list.into_iter().map(moved).collect()
    }

    fn state(&self, w: &[f64]) -> Points<S, D> {
        let state = &self.gathered.state;
        let pick = |list: &[[S; D]]| -> Vec<[S; D]> { self.points.iter().map(|&i| list[i as usize]).collect() };
        let picked = State {
            position: pick(&state.position),
            velocity: pick(&state.velocity),
            position_lost: pick(&state.position_lost),
            velocity_lost: pick(&state.velocity_lost),
        };
        Points::new(picked, w.iter().map(|&w| S::from_f64(w)).collect())
    }

    fn tracks(&self) -> Vec<(u32, crate::sim::force::mouse::Track<D>)> {
        let of = |(point, track): &(PointId, _)| {
            let stand_in = self.gathered.stand_ins[point.index()] as usize;
            let slot = self.place[stand_in];
            (slot != u32::MAX).then(|| (slot, Clone::clone(track)))
        };
        self.model.pin_motion.iter().filter_map(of).collect()
    }

    /// Gives the group the lists that its phases need, and no others.
    fn allocate(&self, points: &mut Points<S, D>, pull: &Pull<S, D>) {
        let count = points.len();
        let has_forces = !pull.springs.is_empty() || self.model.mouse.is_some() || pull.contacts.has_surfaces();
        if has_forces {
            points.acceleration = vec![zero(); count];
        }
        if pull.springs.is_damped() {
            points.velocity_ahead = vec![zero(); count];
        }
        points.displacement = vec![zero(); count];
    }

    /// Bonds whose turns and moves are watched: those of methods that a large substep can break.
    fn guard(&self, bonds: &[(u32, Bond)]) -> Guard<S> {
        let follows_turns = self.lot.choice.solver.order() > 2;
        if matches!(self.lot.choice.solver, Solver::Relaxation | Solver::Xpbd) {
            return Guard { bonds: Vec::new(), follows_turns };
        }
        let is_watched = |bond: &Bond| !matches!(bond.kind, BondKind::Relaxed { .. }) && bond.rest_length > 0.0;
        let of = |bond: &Bond| Watched {
            a: bond.a.0,
            b: bond.b.0,
            rest_square: S::from_f64(bond.rest_length * bond.rest_length),
        };
        let bonds = bonds.iter().map(|(_, bond)| bond).filter(|bond| is_watched(bond)).map(of).collect();
        Guard { bonds, follows_turns }
    }

    fn engine(&self, solver: Solver, bonds: &[(u32, Bond)], points: &Points<S, D>, pull: &Pull<S, D>) -> Engine<S, D> {
        let has_rigid = bonds.iter().any(|(_, bond)| bond.kind == BondKind::Rigid);
        let has_relaxed = bonds.iter().any(|(_, bond)| matches!(bond.kind, BondKind::Relaxed { .. }));
        let projects = has_rigid || has_relaxed;
        let split = |parts: Vec<Part>| Engine::Splitting(Splitting::new(parts));
        let kick_drift = |shares| Engine::KickDrift(self.kick_drift(bonds, points, pull, solver), shares);
        let runge_kutta = |table: &'static Tableau| {
            let sweeps = has_relaxed || (has_rigid && pull.rigid.is_none());
            let sweeps = sweeps.then(|| self.kick_drift(bonds, points, pull, solver));
            Engine::RungeKutta(table, Stages::new(points.len() * D, table.stages.len()), sweeps)
        };
        match solver {
            Solver::Euler => runge_kutta(&EULER),
            Solver::Rk2 => runge_kutta(&RK2),
            Solver::Rk4 => runge_kutta(&RK4),
            Solver::Rk8 => runge_kutta(&RK8),
            Solver::SymplecticEuler if !projects => split(splitting::symplectic_euler()),
            Solver::Flight if !projects => split(splitting::flight()),
            Solver::Auto | Solver::Verlet | Solver::VelocityVerlet if !projects => split(splitting::verlet()),
            Solver::Pefrl if !projects => split(splitting::pefrl()),
            Solver::BlanesMoan4 if !projects => split(splitting::blanes_moan_4()),
            Solver::BlanesMoan6 if !projects => split(splitting::blanes_moan_6()),
            Solver::Pefrl | Solver::BlanesMoan4 => kick_drift(&COMPOSED_4),
            Solver::BlanesMoan6 => kick_drift(&COMPOSED_6),
            Solver::ImplicitMidpoint | Solver::BackwardEuler => {
                let midpoint = solver == Solver::ImplicitMidpoint;
                Engine::Implicit(Box::new(implicit(midpoint, bonds, points, pull)))
            }
            Solver::Xpbd => {
                let compliant = bonds.iter().filter_map(|(_, bond)| CompliantBond::of(bond, &points.inverse_mass));
                let mut compliant: Vec<CompliantBond<S>> = compliant.collect();
                let order = match self.model.method.order {
                    Order::Fixed | Order::Symmetric => self.model.method.order,
                    _ => Order::Coloured,
                };
                Sweeper::new(order, 0, &mut compliant, CompliantBond::ends, points.len());
                let sweeps = self.model.method.iterations.unwrap_or(1);
                Engine::Xpbd(compliant, sweeps, self.kick_drift(bonds, points, pull, solver))
            }
            _ => kick_drift(&SINGLE),
        }
    }

    fn kick_drift(
        &self,
        bonds: &[(u32, Bond)],
        points: &Points<S, D>,
        pull: &Pull<S, D>,
        solver: Solver,
    ) -> KickDrift<S> {
        let (method, w) = (&self.model.method, &points.inverse_mass);
        let sweeps_all = solver == Solver::Relaxation;
        let mut relaxed = Vec::new();
        let mut rigid = Vec::new();
        for (_, bond) in bonds {
            match bond.kind {
                BondKind::Rigid if !sweeps_all => rigid.extend(RigidBond::of(bond, w)),
                _ => relaxed.extend(RelaxedBond::of(bond, w)),
            }
        }
        if pull.rigid.is_some() || solver == Solver::Xpbd {
            rigid.clear();
        }
        KickDrift {
            swept: Swept {
                relaxed_order: Sweeper::new(method.order, method.seed, &mut relaxed, RelaxedBond::ends, w.len()),
                rigid_order: Sweeper::new(method.order, method.seed, &mut rigid, RigidBond::ends, w.len()),
                iterations: method.iterations.unwrap_or(1),
                nominal: self.lot.choice.substep,
                relaxed,
                rigid,
            },
            kicks: if solver == Solver::SymplecticEuler { [1.0, 0.0] } else { [0.5, 0.5] },
            holds_velocity: pull.rigid.is_some(),
            fresh: false,
            aimed: false,
        }
    }

    /// The next more robust method: for rigid bonds projection along their new directions, for springs backward Euler,
    /// which nothing makes unstable.
    fn robust(&self, bonds: &[(u32, Bond)], points: &Points<S, D>, pull: &Pull<S, D>) -> Option<Engine<S, D>> {
        let is_robust = matches!(self.lot.choice.solver, Solver::BackwardEuler | Solver::Xpbd | Solver::Relaxation);
        if pull.rigid.is_some() {
            return Some(Engine::Projected);
        }
        let is_spring = |(_, bond): &(u32, Bond)| matches!(bond.kind, BondKind::Spring { .. });
        let is_fit = !bonds.is_empty() && bonds.iter().all(is_spring) && points.len() <= MOST_LOCATED;
        (is_fit && !is_robust).then(|| Engine::Implicit(Box::new(implicit(false, bonds, points, pull))))
    }
}

/// Points of the largest group in which events are located and violent substeps go to an implicit method.
const MOST_LOCATED: usize = 1_000;

fn implicit<S: Real, const D: usize>(
    is_midpoint: bool,
    bonds: &[(u32, Bond)],
    points: &Points<S, D>,
    pull: &Pull<S, D>,
) -> Implicit<S, D> {
    let w: Vec<f64> = points.inverse_mass.iter().map(|w| w.to_f64()).collect();
    let rigid = bonds.iter().filter(|(_, bond)| is_rigid(bond, &w));
    let rigid = rigid.map(|(_, bond)| (bond.a, bond.b, S::from_f64(bond.rest_length))).collect();
    Implicit::new(is_midpoint, &points.inverse_mass, &pull.springs, rigid)
}

/// The rigid bonds of a group, for the direct solver.
fn rows<S: Real>(bonds: &[(u32, Bond)], w: &[S]) -> Vec<Row<S>> {
    let of = |(_, bond): &(u32, Bond)| {
        let (w_a, w_b) = (w[bond.a.index()], w[bond.b.index()]);
        let rest = S::from_f64(bond.rest_length);
        (bond.kind == BondKind::Rigid && w_a + w_b > S::ZERO).then(|| Row {
            a: bond.a.0,
            b: bond.b.0,
            w_a,
            w_b,
            rest_length: rest,
            inverse_square: if rest > S::ZERO { S::ONE / (rest * rest) } else { S::ONE },
            limit: bond.limit,
            is_taut: true,
        })
    };
    bonds.iter().filter_map(of).collect()
}

fn is_elastic(bond: &Bond) -> bool {
    matches!(bond.kind, BondKind::Spring { .. })
}

fn breakable<S: Real>(bonds: &[(u32, Bond)], is_meant: impl Fn(&Bond) -> bool) -> Vec<Breakable<S>> {
    let of = |(name, bond): &(u32, Bond)| {
        let scale = if bond.rest_length > 0.0 { bond.rest_length } else { 1.0 };
        let most = if bond.rest_length > 0.0 { scale * (1.0 + bond.break_strain) } else { bond.break_strain };
        (bond.break_strain.is_finite() && is_meant(bond)).then(|| Breakable {
            a: bond.a.0,
            b: bond.b.0,
            most_square: S::from_f64(most * most),
            bond: *name,
        })
    };
    bonds.iter().filter_map(of).collect()
}
