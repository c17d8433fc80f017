//! Points are doubled along a slit, so that what covers them parts there and nothing of it is lost.
//!
//! ```text
//!  l---p---q---l        l---p---q---l      p', q': copies, each with half of the mass and what was bonded to the other side
//!  |\  |\  |\  |         \  |\  |  /
//!  | \ | \ | \ |   ->     `-p'--q'-´       the bond from p to q lies along the slit: both lips have one
//!  r---r---r---r        r---r---r---r
//! ```

use std::sync::Arc;

use super::{Applied, CommandError, done, invalid};
use crate::sim::bond::{Bond, BondId, PointId, lower_first};
use crate::sim::command::{Addition, Change, Selection, Values};
use crate::sim::contact::skin::SkinMaterial;
use crate::sim::group::Group;
use crate::sim::real::Real;
use crate::sim::vector::{embed, widen};
use crate::sim::world::World;

impl<S: Real, const D: usize> World<S, D> {
    /// Points are doubled, and their copies take these bonds from them; triangles along these go with the copies.
    ///
    /// Errors: points or bonds that are not there; pins; bonds of none of these points.
    pub(super) fn split(&mut self, points: &[PointId], bonds: &[BondId]) -> Result<Applied, CommandError> {
        self.check_points(points)?;
        let mut points = points.to_vec();
        points.sort_unstable();
        points.dedup();
        if let Some(pin) = points.iter().find(|point| self.inverse_mass[point.index()] == 0.0) {
            return Err(invalid(format!("point {} is held, and what is held is not doubled", pin.0)));
        }
        let places = self.bond_places(bonds)?;
        let is_of = |place: &usize| self.bonds.ends()[*place].iter().any(|end| points.binary_search(end).is_ok());
        if let Some(place) = places.iter().find(|place| !is_of(place)) {
            let number = self.numbers.of_bond(*place);
            return Err(invalid(format!("bond {number} ends at none of the points that are doubled")));
        }
        if points.is_empty() || places.is_empty() {
            return Ok(done(false));
        }
        let copies = self.copies(&points, &places);
        let before = self.clone();
        self.part_along((&points, bonds), &copies).inspect_err(|_| *self = before)
    }

    /// What goes from points to their copies, which come.
    fn part_along(
        &mut self,
        (points, bonds): (&[PointId], &[BondId]),
        copies: &Addition,
    ) -> Result<Applied, CommandError> {
        // They did not tear: they are there, at other points.
        let torn = Arc::clone(&self.numbers.torn);
        self.delete(&Selection { bonds: bonds.to_vec(), ..Selection::default() })?;
        self.numbers.torn = torn;
        self.set(&Change::Points {
            points: points.to_vec(),
            mass: Some(Values::Each(copies.mass.clone())),
            velocity: None,
            skin: SkinMaterial::default(),
        })?;
        self.add(copies)
    }

    /// Copies of points, which ascend, with the bonds at these places and what lies along the slit.
    fn copies(&self, points: &[PointId], places: &[usize]) -> Addition {
        let first = self.count() as u32;
        let copy = |point: PointId| points.binary_search(&point).map_or(point, |k| PointId(first + k as u32));
        let ends = self.bonds.ends();
        let mut moved: Vec<[PointId; 2]> = places.iter().map(|&place| lower_first(ends[place])).collect();
        moved.sort_unstable();
        let is_moved = |side: [PointId; 2]| moved.binary_search(&lower_first(side)).is_ok();
        let sides = |[a, b, c]: [PointId; 3]| [[a, b], [b, c], [c, a]];
        let goes = |corners: &&[PointId; 3]| sides(**corners).into_iter().any(is_moved);
        let going: Vec<[PointId; 3]> = self.model.triangles.iter().filter(goes).copied().collect();
        // Sides of these that stay where they are, with an end that is doubled.
        let is_along = |side: &[PointId; 2]| !is_moved(*side) && side.iter().any(|&end| copy(end) != end);
        let mut along: Vec<[PointId; 2]> = going.iter().flat_map(|&corners| sides(corners)).filter(is_along).collect();
        along.iter_mut().for_each(|side| *side = lower_first(*side));
        along.sort_unstable();
        along.dedup();
        let is_doubled = |place: &usize| along.binary_search(&lower_first(ends[*place])).is_ok();
        let doubled = (0..ends.len()).filter(is_doubled);
        let bonds = places.iter().copied().chain(doubled).map(|place| self.bonds.get(place));
        let bonds = bonds.map(|bond| Bond { a: copy(bond.a), b: copy(bond.b), ..bond }).collect();
        let [position, velocity] = self.here(points);
        let skins = points.iter().map(|&point| (self.model.skins.of(point), vec![copy(point)]));
        Addition {
            position,
            velocity,
            mass: points.iter().map(|point| 0.5 * self.model.mass[point.index()]).collect(),
            bonds,
            triangles: going.into_iter().map(|corners| corners.map(copy)).collect(),
            skins: skins.filter(|(material, _)| *material != SkinMaterial::default()).collect(),
            ..Addition::default()
        }
    }

    /// Where points are `[m]`, and their velocities `[m/s]`.
    fn here(&self, points: &[PointId]) -> [Vec<[f64; 3]>; 2] {
        let (mut copy, t) = (self.clone(), self.timeline.time());
        for group in &mut copy.plan.groups {
            group.beyond_rounding(Group::hold_velocity);
            group.centre_velocity(&copy.around, t);
        }
        let state = copy.state_of(points.iter().map(|point| point.index()));
        [state.position, state.velocity].map(|list| list.into_iter().map(|x| embed(widen(x))).collect())
    }
}
