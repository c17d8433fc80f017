//! Points, bonds and obstacles go: deleted, or torn.

use std::sync::Arc;

use super::{done, invalid};
use crate::sim::bond::{PointId, lower_first};
use crate::sim::command::{Applied, CommandError, Selection};
use crate::sim::contact::obstacles::Obstacles;
use crate::sim::model::Model;
use crate::sim::plan_part::PlanPart;
use crate::sim::real::Real;
use crate::sim::triangles::borne;
use crate::sim::world::World;

impl<S: Real, const D: usize> World<S, D> {
    pub(super) fn delete(&mut self, selection: &Selection) -> Result<Applied, CommandError> {
        let Selection { points, bonds, obstacles, forces, angles } = selection;
        self.check_points(points)?;
        self.check_obstacles(obstacles)?;
        let forces = self.force_places(forces)?;
        let places = self.angle_places(angles)?;
        let mut goes = vec![false; self.bonds.len()];
        self.bond_places(bonds)?.into_iter().for_each(|place| goes[place] = true);
        if points.is_empty() && bonds.is_empty() && obstacles.is_empty() && forces.is_empty() && angles.is_empty() {
            return Ok(done(false));
        }
        let mut is_gone = vec![false; self.count()];
        points.iter().for_each(|point| is_gone[point.index()] = true);
        for (goes, ends) in goes.iter_mut().zip(self.bonds.ends()) {
            *goes |= ends.iter().any(|end| is_gone[end.index()]);
        }
        if points.is_empty() && obstacles.is_empty() && forces.is_empty() && angles.is_empty() {
            self.part(&goes, self.timeline.time());
            return Ok(done(true));
        }
        let mut touched: Vec<u32> = points.iter().map(|point| point.0).collect();
        touched.extend(self.free_ends(&goes));
        touched.extend(self.pushed_by(&forces));
        touched.extend(self.free_points_of(&places));
        let named: Vec<u32> = places.iter().map(|&place| self.model.angles.list[place].number).collect();
        let detached = self.detach(&self.with_mates(touched), !obstacles.is_empty());
        self.remove_forces(&forces);
        if !named.is_empty() {
            Arc::make_mut(&mut self.model).angles.list.retain(|angle| !named.contains(&angle.number));
        }
        self.remove_bonds(&goes);
        self.remove_points(points);
        if !obstacles.is_empty() {
            self.remove_obstacles(obstacles);
        }
        self.attach(detached);
        Ok(done(true))
    }

    /// Bonds that are overstretched at time `t` `[s]`, by their numbers, are gone. Returns the places of the groups of what they held.
    pub(crate) fn tear(&mut self, torn: &[u32], t: f64) -> Vec<usize> {
        let mut goes = vec![false; self.bonds.len()];
        for place in torn.iter().filter_map(|&number| self.numbers.place_of_bond(number)) {
            self.counters.bonds_torn += u64::from(!goes[place]);
            goes[place] = true;
        }
        self.part(&goes, t)
    }

    /// Bonds go at time `t` `[s]`. What they held is compiled anew, but for large bodies that leave their lanes idle. Returns the places
    /// of the groups that come of it.
    pub(super) fn part(&mut self, goes: &[bool], t: f64) -> Vec<usize> {
        let torn = (0..goes.len()).filter(|&place| goes[place]).map(|place| self.bonds.get(place));
        Arc::make_mut(&mut self.numbers.torn).extend(torn);
        let rest = self.leave_idle(goes);
        let touched = self.free_ends(&rest);
        if touched.is_empty() {
            self.remove_bonds(goes);
            self.weigh_held();
            self.plan.parts = PlanPart::sum(&self.plan.own);
            self.topology += 1;
            return Vec::new();
        }
        let detached = self.detach_at(&touched, false, t);
        self.remove_bonds(goes);
        self.attach(detached)
    }

    /// Leaves the lanes of bonds idle that belong to large bodies which can. Returns which of the bonds do not.
    fn leave_idle(&mut self, goes: &[bool]) -> Vec<bool> {
        let mut left = goes.to_vec();
        for k in (0..goes.len()).filter(|&k| goes[k]) {
            let bond = self.bonds.get(k);
            let slots = [bond.a, bond.b].map(|end| self.slot(end.index()));
            let [Some([group, a]), Some([other, b])] = slots else { continue };
            // The place of a pin may be that in another group.
            if group != other
                || !self.plan.groups[group].lose([a as u32, b as u32], bond.rest_length, self.numbers.of_bond(k))
            {
                continue;
            }
            left[k] = false;
            self.plan.own[group].bonds -= 1;
            self.touch(group);
        }
        left
    }

    /// The ends of these bonds that can move: what else is fastened to their pins is not touched.
    pub(super) fn free_ends(&self, goes: &[bool]) -> Vec<u32> {
        let ends = self.bonds.ends().iter().zip(goes).filter(|(_, goes)| **goes);
        let free = |end: &PointId| self.inverse_mass[end.index()] > 0.0;
        ends.flat_map(|(ends, _)| *ends).filter(free).map(|end| end.0).collect()
    }

    fn remove_bonds(&mut self, goes: &[bool]) {
        if !goes.contains(&true) {
            return;
        }
        let left = |place: &usize| !goes[*place];
        let numbers = (0..goes.len()).filter(left).map(|place| self.numbers.of_bond(place)).collect();
        self.numbers.bonds = Some(Arc::new(numbers));
        let cut = self.bonds.ends().iter().zip(goes).filter(|(_, goes)| **goes).map(|(ends, _)| *ends);
        let cut: Vec<[PointId; 2]> = cut.collect();
        let borne = borne(&self.model.triangles, &[], cut.iter().copied());
        self.keep_triangles(borne);
        self.remove_angles_along(cut);
        let mut place = 0;
        Arc::make_mut(&mut self.bonds).retain(|_| {
            place += 1;
            !goes[place - 1]
        });
    }

    fn remove_points(&mut self, points: &[PointId]) {
        if points.is_empty() {
            return;
        }
        let gone = Arc::make_mut(&mut self.numbers.gone);
        gone.extend(points);
        gone.sort_unstable();
        gone.dedup();
        let borne = borne(&self.model.triangles, &self.numbers.gone, []);
        self.keep_triangles(borne);
        let numbers = &self.numbers;
        let model = Arc::make_mut(&mut self.model);
        model.angles.list.retain(|angle| !angle.points.iter().any(|point| numbers.is_gone(point.0)));
        model.pinned.retain(|pin| !numbers.is_gone(pin.0));
        model.pin_motion.retain(|(pin, _)| !numbers.is_gone(pin.0));
        self.weigh(points.iter().map(|point| point.0));
        self.free_forces();
    }

    /// Of triangles those are left which these are, if not all.
    fn keep_triangles(&mut self, left: Option<Vec<[PointId; 3]>>) {
        let Some(left) = left else { return };
        let model = Arc::make_mut(&mut self.model);
        let mut next = left.iter().peekable();
        let mut of = model.triangles.iter();
        // What is left is in the order of all.
        model.rest_areas.retain(|_| of.next().is_some_and(|corners| next.next_if(|left| *left == corners).is_some()));
        model.triangles = left;
    }

    /// Angles with an arm along a bond that went go with it.
    fn remove_angles_along(&mut self, mut cut: Vec<[PointId; 2]>) {
        if self.model.angles.list.is_empty() {
            return;
        }
        cut.iter_mut().for_each(|ends| *ends = lower_first(*ends));
        cut.sort_unstable();
        let is_cut = |a: PointId, b: PointId| cut.binary_search(&lower_first([a, b])).is_ok();
        let is_borne = |[i, j, k]: [PointId; 3]| !(is_cut(i, j) || is_cut(j, k));
        if !self.model.angles.list.iter().all(|angle| is_borne(angle.points)) {
            Arc::make_mut(&mut self.model).angles.list.retain(|angle| is_borne(angle.points));
        }
    }

    fn remove_obstacles(&mut self, obstacles: &[u32]) {
        let model = Arc::make_mut(&mut self.model);
        let [planes, others] = &mut self.numbers.obstacles;
        keep(&mut model.planes, planes, obstacles);
        // In space there are no polygons, in the plane nothing else.
        match D {
            2 => keep(&mut model.polygons, others, obstacles),
            _ => keep(&mut model.convex, others, obstacles),
        }
        // Fewer outlines cross no more often.
        if let Ok(left) = Obstacles::of(&*model) {
            self.obstacles = left;
        }
    }
}

impl<S: Real, const D: usize> World<S, D> {
    /// The obstacles that a changed model has.
    ///
    /// Errors: outlines of polygons cross too often.
    pub(super) fn obstacles_of(model: &Model<D>) -> Result<Obstacles<S, D>, CommandError> {
        let message =
            "the outlines of the polygons cross each other or themselves more than 200000 times: make them simpler";
        Obstacles::of(model).map_err(|_| invalid(message))
    }
}

/// Leaves out what has one of these numbers.
fn keep<T>(list: &mut Vec<T>, numbers: &mut Vec<u32>, without: &[u32]) {
    let mut of = numbers.iter();
    list.retain(|_| of.next().is_none_or(|number| !without.contains(number)));
    numbers.retain(|number| !without.contains(number));
}
