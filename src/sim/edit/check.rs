//! What every command asks first: whether there is what it names, and whether numbers are in their ranges.

use super::invalid;
use crate::sim::bond::{BondId, PointId};
use crate::sim::command::{CommandError, Values};
use crate::sim::real::Real;
use crate::sim::world::World;

impl<S: Real, const D: usize> World<S, D> {
    /// Errors: a number that no living point has.
    pub(super) fn check_points(&self, points: &[PointId]) -> Result<(), CommandError> {
        let missing = points.iter().find(|point| point.index() >= self.count() || self.numbers.is_gone(point.0));
        missing.map_or(Ok(()), |point| Err(CommandError::NoSuch { kind: "point", number: point.0 }))
    }

    /// The places of bonds among those that are left.
    ///
    /// Errors: a number that no bond has.
    pub(super) fn bond_places(&self, bonds: &[BondId]) -> Result<Vec<usize>, CommandError> {
        let of = |bond: &BondId| {
            let missing = CommandError::NoSuch { kind: "bond", number: bond.0 };
            self.numbers.place_of_bond(bond.0).ok_or(missing)
        };
        bonds.iter().map(of).collect()
    }

    /// The places of angles among those that are left.
    ///
    /// Errors: a number that no angle has.
    pub(super) fn angle_places(&self, angles: &[u32]) -> Result<Vec<usize>, CommandError> {
        let list = &self.model.angles.list;
        let of = |&number: &u32| {
            let place = list.binary_search_by_key(&number, |angle| angle.number);
            place.map_err(|_| CommandError::NoSuch { kind: "angle", number })
        };
        angles.iter().map(of).collect()
    }

    /// The points of these angles that can move.
    pub(super) fn free_points_of(&self, places: &[usize]) -> Vec<u32> {
        let points = places.iter().flat_map(|&place| self.model.angles.list[place].points);
        points.filter(|point| self.inverse_mass[point.index()] > 0.0).map(|point| point.0).collect()
    }

    /// Errors: a number that no obstacle has.
    pub(super) fn check_obstacles(&self, obstacles: &[u32]) -> Result<(), CommandError> {
        let is_there = |number: &u32| self.numbers.obstacles.iter().any(|list| list.contains(number));
        let missing = obstacles.iter().find(|number| !is_there(number));
        missing.map_or(Ok(()), |&number| Err(CommandError::NoSuch { kind: "obstacle", number }))
    }

    /// The places of constant forces among those that are left.
    ///
    /// Errors: a number that no force has.
    pub(super) fn force_places(&self, forces: &[u32]) -> Result<Vec<usize>, CommandError> {
        let of = |number: &u32| {
            let missing = CommandError::NoSuch { kind: "force", number: *number };
            self.numbers.forces.binary_search(number).map_err(|_| missing)
        };
        forces.iter().map(of).collect()
    }
}

/// Errors: a number that is not finite.
pub(super) fn finite<'a>(what: &str, numbers: impl IntoIterator<Item = &'a f64>) -> Result<(), CommandError> {
    if numbers.into_iter().all(|x| x.is_finite()) { Ok(()) } else { Err(invalid(format!("{what} must be finite"))) }
}

/// Errors: not as many values as things, or one that does not fit.
pub(super) fn values(
    what: &str,
    values: &Values,
    count: usize,
    (fits, range): (impl Fn(f64) -> bool, &str),
) -> Result<(), CommandError> {
    let list = match values {
        Values::Same(value) => std::slice::from_ref(value),
        Values::Each(list) if list.len() == count => &list[..],
        Values::Each(list) => {
            let found = list.len();
            return Err(invalid(format!(
                "{what} has {found} values for {count} that are named: give one, or one each"
            )));
        }
    };
    match list.iter().find(|value| !fits(**value)) {
        Some(value) => Err(invalid(format!("{what} is {value}: it must be {range}"))),
        None => Ok(()),
    }
}

/// The value of the k-th.
pub(super) fn value(values: &Values, k: usize) -> f64 {
    match values {
        Values::Same(value) => *value,
        Values::Each(list) => list[k],
    }
}
