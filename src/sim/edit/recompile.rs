//! Islands that a command touches are compiled anew, from the state that they have.

use std::sync::Arc;

use crate::sim::bond::{Bond, PointId};
use crate::sim::bonds::Bonds;
use crate::sim::bulk::kernel::Kernel;
use crate::sim::bulk::mover::Mover;
use crate::sim::force::angle::{Angle, Angles};
use crate::sim::group::Group;
use crate::sim::group::engine::Engine;
use crate::sim::model::Model;
use crate::sim::moved::Moved;
use crate::sim::plan::{self, NOWHERE, OWN};
use crate::sim::plan_part::PlanPart;
use crate::sim::points::State;
use crate::sim::real::Real;
use crate::sim::vector::{convert, length, sub, widen};
use crate::sim::world::World;

/// Points whose groups were taken out of a world, with their state.
pub(crate) struct Detached<S, const D: usize> {
    /// By their numbers, ascending: all that can move of the groups, their pins, and what was named beside.
    pub(super) points: Vec<u32>,
    /// One entry a point.
    pub(super) state: State<S, D>,
    groups: Vec<usize>,
    /// Who moved each of the groups, and which of these moved each of the points that were there.
    pub(crate) moved: Vec<Moved>,
    moved_of: Vec<u32>,
    /// What the live step is to move of them is to go together.
    pub(crate) are_together: bool,
    /// Of these left is right now, ascending: what was known of the sides that they touch is of another world.
    pub(super) mirrored: Vec<u32>,
    /// When `[s]`.
    time: f64,
}

/// What moved points in the live step before they were compiled anew.
struct Heritage<S: Real, const D: usize> {
    mover: Box<dyn Mover<S, D>>,
    /// Its points by their numbers, each with its place there.
    points: Vec<(u32, u32)>,
}

/// Points compiled anew, not in a world yet.
struct Remade<S: Real, const D: usize> {
    plan: plan::Plan<S, D>,
    /// The pins that they are fastened to among them.
    points: Vec<u32>,
    state: State<S, D>,
    model: Model<D>,
    bonds: (Bonds, Vec<u32>),
    /// Rigid bonds could be held.
    is_held: bool,
}

impl<S: Real, const D: usize> Detached<S, D> {
    /// The place of a point, if it is among them.
    pub(super) fn place(&self, point: u32) -> Option<usize> {
        self.points.binary_search(&point).ok()
    }

    /// The places of those points that are among them.
    pub(super) fn places(&self, points: impl IntoIterator<Item = u32>) -> Vec<usize> {
        points.into_iter().filter_map(|point| self.place(point)).collect()
    }
}

impl<S: Real, const D: usize> World<S, D> {
    /// The groups that points belong to, and those of free points that bonds fasten to pins among them; ascending.
    fn groups_of(&self, points: &[u32]) -> Vec<usize> {
        let mut is_pin = Vec::new();
        let mut groups = Vec::new();
        for &point in points {
            let i = point as usize;
            match self.slot(i) {
                Some([group, _]) if self.inverse_mass[i] > 0.0 => groups.push(group),
                Some(_) => {
                    is_pin.resize(self.count(), false);
                    is_pin[i] = true;
                }
                None => {}
            }
        }
        if !is_pin.is_empty() {
            for &[a, b] in self.bonds.ends() {
                for (pin, other) in [(a, b), (b, a)] {
                    if is_pin[pin.index()] && self.inverse_mass[other.index()] > 0.0 {
                        groups.extend(self.slot(other.index()).map(|[group, _]| group));
                    }
                }
            }
            for points in self.model.ties().filter(|points| points.iter().any(|point| is_pin[point.index()])) {
                let free = points.into_iter().filter(|other| self.inverse_mass[other.index()] > 0.0);
                groups.extend(free.filter_map(|other| self.slot(other.index())).map(|[group, _]| group));
            }
        }
        groups.sort_unstable();
        groups.dedup();
        groups
    }

    /// Takes out the groups that points belong to, these points included; of all where `is_all`.
    pub(super) fn detach(&mut self, touched: &[u32], is_all: bool) -> Detached<S, D> {
        self.detach_at(touched, is_all, self.timeline.time())
    }

    /// The same at a time `t` `[s]` within a step.
    pub(crate) fn detach_at(&mut self, touched: &[u32], is_all: bool, t: f64) -> Detached<S, D> {
        self.spread();
        // Bodies that may meet move together.
        let is_all = is_all || self.model.is_live();
        let groups = if is_all { (0..self.plan.groups.len()).collect() } else { self.groups_of(touched) };
        let mut is_out = vec![false; self.plan.groups.len()];
        for &group in &groups {
            is_out[group] = true;
            self.touch(group);
            // Velocities of large bodies are behind: what comes next starts with those of now.
            self.plan.groups[group].centre_velocity(&self.around, t);
            self.plan.groups[group].hold_velocity();
        }
        let mut points: Vec<u32> = if groups.is_empty() {
            Vec::new()
        } else {
            let slots = self.plan.slots.iter().zip(0..);
            slots.filter(|([group, _], _)| is_out.get(*group as usize) == Some(&true)).map(|(_, i)| i).collect()
        };
        points.extend(touched.iter().copied().filter(|&point| !self.numbers.is_gone(point)));
        points.sort_unstable();
        points.dedup();
        let state = self.state_of(points.iter().map(|&i| i as usize));
        let moved = groups.iter().map(|&group| self.plan.groups[group].moved).collect();
        let number = |group: usize| groups.binary_search(&group).map_or(u32::MAX, |found| found as u32);
        let of = |&point: &u32| self.slot(point as usize).map_or(u32::MAX, |[group, _]| number(group));
        let moved_of = points.iter().map(of).collect();
        Detached { points, state, groups, moved, moved_of, are_together: false, mirrored: Vec::new(), time: t }
    }

    /// Every point has a slot of its own, and every new one none.
    pub(crate) fn spread(&mut self) {
        if self.plan.is_plain {
            self.plan.slots = (0..self.plan.groups[0].points.len() as u32).map(|slot| [0, slot]).collect();
            self.plan.is_plain = false;
        }
        self.plan.slots.resize(self.count(), NOWHERE);
    }

    /// Compiles what was taken out, as model and bonds are now, and puts it in place of it. Returns the places of the groups.
    pub(crate) fn attach(&mut self, detached: Detached<S, D>) -> Vec<usize> {
        self.topology += 1;
        self.is_fresh = true;
        self.put_back(detached)
    }

    /// The same where nothing came, went or changed but who moves it.
    pub(crate) fn put_back(&mut self, detached: Detached<S, D>) -> Vec<usize> {
        let Detached { mut points, state, groups, moved, moved_of, are_together, mirrored, time: t } = detached;
        let mut heritage = Vec::new();
        for &group in &groups {
            heritage.extend(self.heritage(group, (&points, &mirrored)));
        }
        for &group in &groups {
            self.vacate(group);
        }
        let mut movers = vec![u32::MAX; self.count()];
        points.iter().zip(moved_of).for_each(|(&point, mover)| movers[point as usize] = mover);
        let mover = |point: u32| moved.get(movers[point as usize] as usize).copied();
        let state = self.keep_living(&mut points, state);
        let has_live = self.model.budget().is_some() && moved.iter().any(Moved::is_handed_over);
        let number = |point: u32| match mover(point) {
            Some(moved) if has_live && moved.is_handed_over() && are_together => 0,
            Some(moved) if has_live && moved.is_handed_over() => movers[point as usize],
            _ => OWN,
        };
        let mut made = self.remake((points, state), number, t);
        if !made.is_held {
            self.reconcile_part(&mut made, number, t);
        }
        let Remade { plan, points, .. } = made;
        let places = self.put_in(plan, &points);
        self.bequeath(&heritage, &places);
        self.note_movers((&places, &points), mover, t);
        self.hold_on();
        self.gather();
        places
    }

    /// Pins that may be met, though they move nobody by themselves.
    pub(crate) fn fixtures(&self) -> Vec<u32> {
        let frozen = self.frozen.iter().flat_map(|frozen| frozen.points.iter().map(|&point| PointId(point)));
        let pins: Vec<PointId> =
            self.model.pinned.iter().copied().chain(frozen).filter(|pin| !self.numbers.is_gone(pin.0)).collect();
        if pins.is_empty() {
            return Vec::new();
        }
        plan::fixtures(&self.model.triangles, &self.bonds, &pins)
    }

    /// The place of a group is free.
    fn vacate(&mut self, group: usize) {
        self.close_account(group);
        self.plan.groups[group] = self.plan.groups[group].emptied();
        self.plan.own[group].points = 0;
    }

    /// What moved a group in the live step or by the loop of a source, whose points are among these; its place is to be vacated.
    /// Of points that were `mirrored`, which are ascending, nothing is known any more where they are live.
    fn heritage(&mut self, group: usize, (points, mirrored): (&[u32], &[u32])) -> Option<Heritage<S, D>> {
        let kernel = self.plan.groups[group].kernel()?;
        let is_live = matches!(kernel, Kernel::Live);
        if !is_live && !matches!(kernel, Kernel::Printed(_)) {
            return None;
        }
        let forgets = |point: &u32| is_live && mirrored.binary_search(point).is_ok();
        let own = |&point: &u32| {
            self.slot(point as usize).filter(|slot| slot[0] == group).map(|slot| (point, slot[1] as u32))
        };
        let points = points.iter().filter(|point| !forgets(point)).filter_map(own).collect();
        let engine = std::mem::replace(&mut self.plan.groups[group].engine, Engine::Projected);
        let Engine::Bulk(mover) = engine else { return None };
        Some(Heritage { mover, points })
    }

    /// What is live in these places knows of its points what was known of them.
    fn bequeath(&mut self, heritage: &[Heritage<S, D>], places: &[usize]) {
        for Heritage { mover, points } in heritage {
            for &place in places {
                let slots: Vec<(u32, u32)> = points
                    .iter()
                    .filter_map(|&(point, old)| self.slot(point as usize).map(|slot| (old, slot)))
                    .filter(|(_, slot)| slot[0] == place)
                    .map(|(old, slot)| (old, slot[1] as u32))
                    .collect();
                if let Engine::Bulk(heir) = &mut self.plan.groups[place].engine {
                    heir.inherit(&**mover, &slots);
                }
            }
        }
    }

    /// Compiles points in this state as model and bonds are now, and makes them ready at `t` `[s]`.
    fn remake(
        &self,
        (mut points, mut state): (Vec<u32>, State<S, D>),
        number: impl Fn(u32) -> u32,
        t: f64,
    ) -> Remade<S, D> {
        let mut local = vec![u32::MAX; self.count()];
        points.iter().zip(0..).for_each(|(&point, place)| local[point as usize] = place);
        let has_met = self.model.meets_on_demand() && points.iter().any(|&point| number(point) != OWN);
        self.include_pins((&mut points, &mut state, &mut local), has_met);
        let model = self.part_of_model(&points, &local);
        let bonds = self.bonds_among(&points, &local);
        let live: Vec<u32> = points.iter().map(|&point| number(point)).collect();
        let mut plan = self.compile_part(&model, (&bonds.0, &bonds.1), &state, &live);
        let is_held = plan.groups.iter_mut().fold(true, |is_held, group| is_held & group.resume(&self.around, t));
        Remade { plan, points, state, model, bonds, is_held }
    }

    /// Notes who moves new groups: who moved their points before, or since `t` `[s]` their plan.
    fn note_movers(&mut self, (places, points): (&[usize], &[u32]), mover: impl Fn(u32) -> Option<Moved>, t: f64) {
        let mut known: Vec<Option<Moved>> = vec![None; places.len()];
        for &point in points.iter().filter(|&&point| self.inverse_mass[point as usize] > 0.0) {
            let Some([group, _]) = self.slot(point as usize) else { continue };
            let (Some(at), Some(moved)) = (places.iter().position(|&place| place == group), mover(point)) else {
                continue;
            };
            if known[at].is_none_or(|before| moved.is_handed_over() && !before.is_handed_over()) {
                known[at] = Some(moved);
            }
        }
        for (&place, known) in places.iter().zip(known) {
            let group = &mut self.plan.groups[place];
            let is_live = matches!(group.kernel(), Some(Kernel::Live));
            let fits = |moved: &Moved| moved.is_handed_over() == is_live || self.model.is_live();
            group.moved = known.filter(fits).unwrap_or(Moved::by_plan(t));
        }
    }

    /// Islands that the live step moves for a while are moved by their own methods again, if these take them as they are: `may` is told how
    /// they stand and how they would be put. `parts` says which slots stay with which, or go, [`OWN`]; none: all go. Returns whether it was so.
    pub(crate) fn put_back_exactly(
        &mut self,
        place: usize,
        parts: &[u32],
        may: impl Fn(&Group<S, D>, &[Group<S, D>], f64) -> bool,
    ) -> bool {
        self.spread();
        let t = self.timeline.time();
        let points: Vec<u32> = self
            .plan
            .slots
            .iter()
            .zip(0..)
            .filter(|([group, _], _)| *group as usize == place)
            .map(|(_, i)| i)
            .collect();
        let state = self.state_of(points.iter().map(|&i| i as usize));
        let number = |point: u32| {
            let slot = self.slot(point as usize).filter(|slot| slot[0] == place);
            slot.and_then(|slot| parts.get(slot[1])).copied().unwrap_or(OWN)
        };
        let made = self.remake((points.clone(), state), number, t);
        let way = self.furthest(&made);
        let group = &self.plan.groups[place];
        if !made.is_held || !may(group, &made.plan.groups, way) {
            return false;
        }
        let moved = group.moved;
        self.touch(place);
        let heritage = self.heritage(place, (&points, &[]));
        self.vacate(place);
        let places = self.put_in(made.plan, &made.points);
        self.bequeath(heritage.as_slice(), &places);
        for &place in &places {
            let group = &mut self.plan.groups[place];
            group.moved = moved;
            match group.kernel() {
                Some(Kernel::Live) => group.moved.put_off(t),
                _ => group.moved = moved.handed_back(t),
            }
        }
        self.hold_on();
        self.gather();
        true
    }

    /// How far points would be put from where they are `[m]`.
    fn furthest(&self, made: &Remade<S, D>) -> f64 {
        let plan = &made.plan;
        let place = |k: usize| {
            let [group, slot] = if plan.is_plain { [0, k as u32] } else { plan.slots[k] };
            plan.groups.get(group as usize).map(|group| widen(group.points.position[slot as usize]))
        };
        let way = |(k, &point): (usize, &u32)| place(k).map_or(0.0, |x| length(sub(x, self.place(point as usize))));
        made.points.iter().enumerate().map(way).fold(0.0, f64::max)
    }

    /// Leaves out points that are gone.
    fn keep_living(&mut self, points: &mut Vec<u32>, state: State<S, D>) -> State<S, D> {
        let keeps: Vec<bool> = points.iter().map(|&point| !self.numbers.is_gone(point)).collect();
        for (&point, keeps) in points.iter().zip(&keeps) {
            if !keeps {
                self.plan.slots[point as usize] = NOWHERE;
            }
        }
        let pick =
            |list: Vec<[S; D]>| list.into_iter().zip(&keeps).filter(|(_, keeps)| **keeps).map(|(x, _)| x).collect();
        let State { position, velocity, position_lost, velocity_lost } = state;
        let state = State {
            position: pick(position),
            velocity: pick(velocity),
            position_lost: pick(position_lost),
            velocity_lost: pick(velocity_lost),
        };
        points.retain(|&point| !self.numbers.is_gone(point));
        state
    }

    /// Pins that free points here are fastened to come along, though others may be fastened to them too; where bodies here `have_met`
    /// something, those of bodies that do not move as well.
    fn include_pins(&self, (points, state, local): (&mut Vec<u32>, &mut State<S, D>, &mut [u32]), have_met: bool) {
        if points.is_empty() {
            return;
        }
        let w = &self.inverse_mass;
        let mut include = |pin: u32, local: &mut [u32]| {
            local[pin as usize] = points.len() as u32;
            points.push(pin);
            let own = self.state_of(std::iter::once(pin as usize));
            state.position.extend(own.position);
            state.velocity.extend(own.velocity);
            state.position_lost.extend(own.position_lost);
            state.velocity_lost.extend(own.velocity_lost);
        };
        let fixtures = if have_met { self.fixtures() } else { Vec::new() };
        for pin in fixtures {
            if local[pin as usize] == u32::MAX {
                include(pin, local);
            }
        }
        let ends = self.bonds.ends().iter().copied();
        let tied = self.model.ties().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        for [a, b] in ends.chain(tied) {
            for (pin, other) in [(a, b), (b, a)] {
                let is_missing = w[pin.index()] == 0.0 && local[pin.index()] == u32::MAX;
                if is_missing && local[other.index()] != u32::MAX && w[other.index()] > 0.0 {
                    include(pin.0, local);
                }
            }
        }
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_unstable_by_key(|&place| points[place]);
        let sorted = |list: &[[S; D]]| order.iter().map(|&place| list[place]).collect();
        *state = State {
            position: sorted(&state.position),
            velocity: sorted(&state.velocity),
            position_lost: sorted(&state.position_lost),
            velocity_lost: sorted(&state.velocity_lost),
        };
        points.sort_unstable();
        points.iter().zip(0..).for_each(|(&point, place)| local[point as usize] = place);
    }

    /// The model of some points alone.
    fn part_of_model(&self, points: &[u32], local: &[u32]) -> Model<D> {
        let within = |point: &PointId| local[point.index()];
        let pinned: Vec<PointId> = points
            .iter()
            .zip(0..)
            .filter(|(i, _)| self.inverse_mass[**i as usize] == 0.0)
            .map(|(_, k)| PointId(k))
            .collect();
        let tracks = self.model.pin_motion.iter().filter(|(point, _)| within(point) != u32::MAX);
        let (triangles, rest_areas) = self.triangles_among(local);
        let angle = |angle: &Angle| {
            let points = angle.points.map(|point| PointId(within(&point)));
            (!points.contains(&PointId(u32::MAX))).then_some(Angle { points, ..*angle })
        };
        let Angles { list, next } = &self.model.angles;
        let angles = Angles { list: list.iter().filter_map(angle).collect(), next: *next };
        Model {
            position: Vec::new(),
            velocity: Vec::new(),
            mass: points.iter().map(|&i| self.model.mass[i as usize]).collect(),
            pinned,
            bonds: Bonds::new(),
            triangles,
            areas: self.model.areas,
            rest_areas,
            angles,
            contact: self.model.contact,
            skins: self.model.skins.among(points.iter().map(|&point| PointId(point))),
            forces: self.forces_among(local),
            gravity: self.model.gravity,
            drag_rate: self.model.drag_rate,
            wind: self.model.wind,
            mouse: self.model.mouse.clone(),
            bounds: self.model.bounds,
            duration: None,
            // What pushes by depth is felt by groups; all else that is solid is the world's.
            planes: self.model.planes.iter().filter(|plane| plane.penalty.is_some()).copied().collect(),
            polygons: Vec::new(),
            convex: self.model.convex.clone(),
            obstacle_numbers: Default::default(),
            pin_motion: tracks.map(|(point, track)| (PointId(within(point)), track.clone())).collect(),
            method: self.model.method,
        }
    }

    /// The triangles whose corners are all among some points, and their areas at rest, where triangles resist.
    fn triangles_among(&self, local: &[u32]) -> (Vec<[PointId; 3]>, Vec<f64>) {
        let Model { triangles, rest_areas, .. } = &*self.model;
        let of = |corners: &[PointId; 3]| {
            let own = corners.map(|corner| PointId(local[corner.index()]));
            (!own.contains(&PointId(u32::MAX))).then_some(own)
        };
        let is_in = |corners: &[PointId; 3]| of(corners).is_some();
        let areas = rest_areas.iter().zip(triangles).filter(|(_, corners)| is_in(corners)).map(|(area, _)| *area);
        (triangles.iter().filter_map(of).collect(), areas.collect())
    }

    /// The bonds with a free end among some points, and their numbers.
    fn bonds_among(&self, points: &[u32], local: &[u32]) -> (Bonds, Vec<u32>) {
        let (mut bonds, mut numbers) = (Bonds::new(), Vec::new());
        if points.is_empty() {
            return (bonds, numbers);
        }
        for (k, ends) in self.bonds.ends().iter().enumerate() {
            let [a, b] = ends.map(|end| local[end.index()]);
            if a != u32::MAX && b != u32::MAX {
                bonds.push(Bond { a: PointId(a), b: PointId(b), ..self.bonds.get(k) });
                numbers.push(self.numbers.of_bond(k));
            }
        }
        (bonds, numbers)
    }

    fn compile_part(
        &self,
        model: &Model<D>,
        (bonds, numbers): (&Bonds, &[u32]),
        state: &State<S, D>,
        live: &[u32],
    ) -> plan::Plan<S, D> {
        plan::compile((model, &self.obstacles, self.scene_points), (bonds, Some(numbers)), state, live)
    }

    /// Lengths that contradict each other give way to those of the nearest shape.
    fn reconcile_part(&mut self, made: &mut Remade<S, D>, number: impl Fn(u32) -> u32, t: f64) {
        let Remade { plan, points, state, model, bonds: (bonds, numbers), .. } = made;
        let mut position: Vec<[f64; D]> = state.position.iter().map(|&x| widen(x)).collect();
        let changed = plan::reconcile(bonds, &mut position, &plan::inverse_masses(model));
        let own = Arc::make_mut(&mut self.bonds);
        for &k in &changed {
            if let Some(place) = self.numbers.place_of_bond(numbers[k]) {
                own.set(place, Bond { rest_length: bonds.rest_lengths()[k], ..own.get(place) });
            }
        }
        let names: Vec<usize> = changed.iter().map(|&k| numbers[k] as usize).collect();
        self.warn_of_lengths(&names);
        state.position = position.into_iter().map(convert).collect();
        let live: Vec<u32> = points.iter().map(|&point| number(point)).collect();
        *plan = self.compile_part(model, (bonds, numbers), state, &live);
        plan.groups.iter_mut().for_each(|group| _ = group.resume(&self.around, t));
    }

    /// New groups take the places of those that are empty. Returns which.
    fn put_in(&mut self, part: plan::Plan<S, D>, points: &[u32]) -> Vec<usize> {
        let mut places: Vec<usize> = Vec::with_capacity(part.groups.len());
        let mut free = (0..self.plan.groups.len()).filter(|&place| self.plan.groups[place].points.len() == 0);
        let taken: Vec<usize> = free.by_ref().take(part.groups.len()).collect();
        let slots: Vec<[u32; 2]> =
            if part.is_plain { (0..points.len() as u32).map(|slot| [0, slot]).collect() } else { part.slots };
        for (g, (group, own)) in part.groups.into_iter().zip(part.own).enumerate() {
            match taken.get(g) {
                Some(&place) => {
                    (self.plan.groups[place], self.plan.own[place]) = (group, own);
                    places.push(place);
                }
                None => {
                    places.push(self.plan.groups.len());
                    self.plan.groups.push(group);
                    self.plan.own.push(own);
                }
            }
        }
        for (&point, &[group, slot]) in points.iter().zip(&slots) {
            self.plan.slots[point as usize] = places.get(group as usize).map_or(NOWHERE, |&place| [place as u32, slot]);
        }
        self.plan.parts = PlanPart::sum(&self.plan.own);
        places
    }

    /// What of inverse masses follows from masses, pins and what is gone, of some points.
    pub(super) fn weigh(&mut self, points: impl IntoIterator<Item = u32>) {
        let mut is_pinned = vec![false; self.model.mass.len()];
        self.model.pinned.iter().for_each(|pin| is_pinned[pin.index()] = true);
        let is_frozen = |point: u32| self.frozen.iter().any(|frozen| frozen.points.binary_search(&point).is_ok());
        let w = Arc::make_mut(&mut self.inverse_mass);
        w.resize(self.model.mass.len(), 0.0);
        for point in points {
            let i = point as usize;
            let stands = is_pinned[i] || self.numbers.is_gone(point) || is_frozen(point);
            w[i] = if stands { 0.0 } else { 1.0 / self.model.mass[i] };
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::sim::contact::skin::Contact;

    #[test]
    fn a_part_has_the_triangles_between_its_points_and_how_they_meet() {
        let position: Vec<[f64; 2]> = (0..5).map(|i| [f64::from(i), f64::from(i * i)]).collect();
        let model = Model {
            velocity: vec![[0.0; 2]; 5],
            mass: vec![1.0; 5],
            triangles: [[0, 1, 3], [4, 2, 1], [0, 3, 4]].map(|corners| corners.map(PointId)).to_vec(),
            contact: Some(Contact { friction: 0.1, ..Contact::default() }),
            position,
            ..Model::default()
        };
        let world = World::<f64, 2>::new(&model).unwrap();
        let part = world.part_of_model(&[1, 2, 4], &[u32::MAX, 0, 1, u32::MAX, 2]);
        // It was clockwise.
        assert_eq!(part.triangles, [[2, 0, 1].map(PointId)]);
        assert_eq!(part.contact, model.contact);
    }
}
