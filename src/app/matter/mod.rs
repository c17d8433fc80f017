//! What bodies are made of, as it is shown and changed: of what is selected, or of what a brush went over.

mod angles;
mod bending;
#[cfg(test)]
mod bending_tests;
mod borne;
mod called;
mod carried;
mod change;
mod common;
mod extent;
mod facts;
mod former;
mod hinges;
#[cfg(test)]
mod hinges_tests;
mod hubs;
mod hung;
#[cfg(test)]
mod hung_tests;
mod joints;
#[cfg(test)]
mod joints_tests;
mod led;
mod motors;
mod overload;
mod painted;
mod placed;
#[cfg(test)]
mod placed_tests;
mod preset;
#[cfg(test)]
mod servos_tests;
#[cfg(test)]
mod tests;
mod wear;

pub(super) use angles::AngleAs;
pub(super) use borne::Bearings;
pub(super) use change::{MatterChange, commands, mean_velocity};
pub(super) use common::Common;
pub(super) use facts::{Matter, NEVER, Pin, Span};
pub(super) use former::Former;
pub(super) use hubs::{Adjacency, is_broad};
pub(super) use hung::IN_HUB;
pub(super) use joints::{Joint, Stops};
pub(super) use led::led;
pub(super) use motors::{MotorChange, Motors};
pub(super) use overload::{Overload, overload};
pub(super) use painted::{Painted, Switched};
pub(super) use placed::{Fit, Placed, Placing, Size, Turned, placed};
pub(super) use preset::Preset;
pub(super) use wear::{but_for_pictures, worn};

use crate::sim::{Bond, Dynamics, PointId};

/// Points, bonds and obstacles whose matter is meant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Among {
    /// Ascending.
    pub points: Vec<PointId>,
    /// The numbers of bonds; `None`: all whose ends are among the points.
    pub bonds: Option<Vec<u32>>,
    /// Obstacles.
    pub obstacles: Vec<u32>,
}

impl Among {
    /// Whether nothing is meant.
    pub(super) fn is_empty(&self) -> bool {
        self.points.is_empty() && self.bonds.as_ref().is_none_or(Vec::is_empty) && self.obstacles.is_empty()
    }

    /// The points that are there.
    fn points_of(&self, world: &dyn Dynamics) -> Vec<PointId> {
        let is_there =
            |point: &PointId| point.index() < world.point_count() && world.gone().binary_search(point).is_err();
        self.points.iter().copied().filter(is_there).collect()
    }

    /// The bonds that are there, with their numbers.
    fn bonds_of(&self, world: &dyn Dynamics) -> Vec<(u32, Bond)> {
        let mut has = vec![false; world.point_count()];
        self.points_of(world).into_iter().for_each(|point| has[point.index()] = true);
        let number = |place: usize| world.bond_numbers().map_or(place as u32, |numbers| numbers[place]);
        let is_meant = |&(number, bond): &(u32, Bond)| match &self.bonds {
            Some(numbers) => numbers.binary_search(&number).is_ok(),
            None => has[bond.a.index()] && has[bond.b.index()],
        };
        world.bonds().iter().enumerate().map(|(place, bond)| (number(place), bond)).filter(is_meant).collect()
    }
}
