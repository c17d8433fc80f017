//! What is grabbed: which points, of which groups, and where the cursor leads them.

use super::{Applied, CommandError, done, invalid};
use crate::sim::bond::{Bond, BondKind, PointId};
use crate::sim::command::Reach;
use crate::sim::dynamics::GrabView;
use crate::sim::environment::Lead;
use crate::sim::group::grab::Grabbed;
use crate::sim::plan::Sets;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, embed, length, scale, sub, zero};
use crate::sim::world::World;

/// What is grabbed is led no faster than this share of the speed that a pin may have.
const GRAB_LEAD: f64 = 0.5;

impl<S: Real, const D: usize> World<S, D> {
    pub(super) fn take_hold(&mut self, reach: &Reach) -> Result<Applied, CommandError> {
        let Some(cursor) = self.around.cursor.map(|path| path.at(self.timeline.time())) else {
            return Err(invalid("there is no cursor to lead what is grabbed: give a `cursor` command first"));
        };
        let mut points = match reach {
            Reach::Points(points) | Reach::Patch { points, .. } => {
                self.check_points(points)?;
                points.clone()
            }
            Reach::Within(radius) if *radius > 0.0 && radius.is_finite() => self.points_within(*radius),
            Reach::Within(radius) => return Err(invalid(format!("`within` is {radius}: it must be finite and > 0"))),
        };
        if points.is_empty() {
            return Err(invalid("nothing is in reach"));
        }
        let torn_beyond = match reach {
            Reach::Patch { torn_beyond, .. } if !(*torn_beyond > 0.0 && torn_beyond.is_finite()) => {
                return Err(invalid(format!("`torn_beyond` is {torn_beyond}: it must be finite and > 0")));
            }
            Reach::Patch { torn_beyond, .. } => *torn_beyond,
            _ => 0.0,
        };
        // A pin holds, and what is taut between pins.
        points.retain(|point| self.can_move(point.index()));
        points.sort_unstable();
        points.dedup();
        if points.is_empty() {
            return Err(CommandError::Held);
        }
        self.release();
        if D == 3 {
            let middle = self.middle(&points);
            self.around.lead = Some(Lead { point: middle, normal: cursor.direction });
        }
        (self.grabbed, self.torn_beyond) = (points, torn_beyond);
        self.hold_on();
        Ok(done(true))
    }

    /// The points that are no further from the cursor, in space from its ray, than this `[m]`; none without a cursor.
    pub(super) fn points_within(&self, radius: f64) -> Vec<PointId> {
        let Some(cursor) = self.around.cursor.map(|path| path.at(self.timeline.time())) else { return Vec::new() };
        let is_near = |i: &u32| {
            let from = sub(embed(self.place(*i as usize)), cursor.origin);
            let across = match D {
                2 => [from[0], from[1], 0.0],
                _ => sub(from, scale(cursor.direction, dot(from, cursor.direction))),
            };
            length(across) <= radius
        };
        (0..self.count() as u32).filter(is_near).map(PointId).collect()
    }

    pub(super) fn release(&mut self) -> Applied {
        let was_held = !self.grabbed.is_empty();
        self.grabbed.clear();
        self.torn_beyond = 0.0;
        self.around.lead = None;
        for place in 0..self.plan.groups.len() {
            if self.plan.groups[place].grabbed.is_some() {
                self.touch(place);
                self.plan.groups[place].let_go();
            }
        }
        done(was_held)
    }

    /// Groups that were compiled anew hold on to what is grabbed of them.
    pub(crate) fn hold_on(&mut self) {
        if self.grabbed.is_empty() {
            return;
        }
        let living = |point: &PointId| !self.numbers.is_gone(point.0) && self.inverse_mass[point.index()] > 0.0;
        let points: Vec<PointId> = self.grabbed.iter().copied().filter(living).collect();
        let is_less = points.len() < self.grabbed.len();
        let middle = self.middle(&points);
        let mut parts: Vec<(usize, Vec<PointId>)> = Vec::new();
        for &point in &points {
            let Some([group, _]) = self.slot(point.index()) else { continue };
            match parts.iter_mut().find(|part| part.0 == group) {
                Some(part) => part.1.push(point),
                None => parts.push((group, vec![point])),
            }
        }
        for (group, own) in &parts {
            let is_only = parts.len() == 1;
            let offset = if is_only { zero() } else { sub(self.middle(own), middle) };
            if let Some(grabbed) = &mut self.plan.groups[*group].grabbed {
                // Of several bodies that were grabbed one may be gone.
                if is_less {
                    grabbed.offset = crate::sim::vector::truncate(offset);
                }
                continue;
            }
            let free = own.iter().filter(|point| self.can_move(point.index()));
            let mut slots: Vec<u32> = free.filter_map(|point| Some(self.slot(point.index())?[1] as u32)).collect();
            slots.sort_unstable();
            slots.dedup();
            if slots.is_empty() {
                continue;
            }
            let (body_mass, tearing) = (self.mass_around(own), self.tearing_at(own));
            let lead = |slot: &u32| self.plan.groups[*group].most_lead(*slot);
            let most_lead = slots.first().and_then(lead).map_or(f64::INFINITY, |most| GRAB_LEAD * most);
            self.touch(*group);
            self.plan.groups[*group].grabbed = Some(Grabbed {
                slots,
                body_mass,
                tearing,
                torn_beyond: self.torn_beyond,
                offset: crate::sim::vector::truncate(offset),
                most_lead,
                lead: None,
                steady: zero(),
                acceleration: zero(),
            });
        }
        self.grabbed = points;
    }

    /// What hangs together with what is grabbed may have become less.
    pub(super) fn weigh_held(&mut self) {
        for place in 0..self.plan.groups.len() {
            let slot = |point: &PointId| self.slot(point.index()).is_some_and(|[group, _]| group == place);
            if self.plan.groups[place].grabbed.is_some() {
                let own: Vec<PointId> = self.grabbed.iter().copied().filter(slot).collect();
                let (mass, tearing) = (self.mass_around(&own), self.tearing_at(&own));
                if let Some(grabbed) = &mut self.plan.groups[place].grabbed {
                    (grabbed.body_mass, grabbed.tearing) = (mass, tearing);
                }
            }
        }
    }

    /// Mean place of points `[m]`.
    fn middle(&self, points: &[PointId]) -> [f64; 3] {
        let sum = points.iter().fold([0.0; 3], |sum, point| add(sum, embed(self.place(point.index()))));
        scale(sum, 1.0 / points.len().max(1) as f64)
    }

    /// Mass of all that hangs together with points by bonds, but for pins `[kg]`.
    fn mass_around(&self, points: &[PointId]) -> f64 {
        let w = &self.inverse_mass;
        let mut sets = Sets::new(self.count());
        for [a, b] in self.bonds.ends() {
            if w[a.index()] > 0.0 && w[b.index()] > 0.0 {
                sets.join(a.0, b.0);
            }
        }
        let mut roots: Vec<u32> = points.iter().map(|point| sets.find(point.0)).collect();
        roots.sort_unstable();
        roots.dedup();
        let is_of = |&i: &usize| w[i] > 0.0 && roots.binary_search(&sets.find(i as u32)).is_ok();
        (0..self.count()).filter(is_of).map(|i| self.model.mass[i]).sum()
    }

    /// What breaks all springs that hold points to others, of those springs that may break `[N]`.
    fn tearing_at(&self, points: &[PointId]) -> f64 {
        let mut own = points.to_vec();
        own.sort_unstable();
        let is_held = |end: PointId| own.binary_search(&end).is_ok();
        let of = |bond: Bond| match bond.kind {
            BondKind::Spring { stiffness, .. } => stiffness * bond.rest_length * bond.break_strain,
            _ => 0.0,
        };
        let held = self.bonds.iter().filter(|bond| bond.break_strain.is_finite() && is_held(bond.a) != is_held(bond.b));
        held.map(of).sum()
    }

    /// What is grabbed, to be drawn.
    pub(crate) fn grab_view(&self) -> Option<GrabView> {
        if self.grabbed.is_empty() {
            return None;
        }
        let target = self.around.target(self.timeline.time()).map_or([f64::NAN; 3], embed);
        let mut force = [0.0; D];
        for group in &self.plan.groups {
            if let Some(grabbed) = &group.grabbed {
                let (.., mass) = grabbed.middle(&group.points);
                force = add(force, scale(grabbed.acceleration, mass));
            }
        }
        Some(GrabView { points: self.grabbed.clone(), middle: self.middle(&self.grabbed), target, force: embed(force) })
    }
}
