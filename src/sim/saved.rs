//! A running world that is kept: what it is made of and the state of its points, not what moves them.

use super::bond::PointId;
use super::drive::Keys;
use super::force::mouse::Cursor;
use super::model::{Model, ModelError};
use super::moved::HandedOver;
use super::real::Precision;

/// A running world as it stands.
#[derive(Clone, Debug, PartialEq)]
pub enum SavedWorld {
    /// In the plane.
    Plane(Saved<2>),
    /// In space.
    Space(Saved<3>),
}

/// The same of one dimension.
///
/// Shapes: `model` has the positions and velocities of now, of points that are gone 0; `lost` has two vectors a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Saved<const D: usize> {
    /// What is left of the model, with the state of now.
    pub model: Model<D>,
    /// The scalar of the world.
    pub precision: Precision,
    /// Time reached `[s]`.
    pub time: f64,
    /// The world's longest substep `[s]`.
    pub substep: f64,
    /// Points of the scene when the world began, which rules go by.
    pub scene_points: usize,
    /// What rounding has taken from positions `[m]` and velocities `[m/s]`.
    pub lost: [Vec<[f64; D]>; 2],
    /// Points that are gone, ascending.
    pub gone: Vec<PointId>,
    /// Numbers of the bonds that are left; `None`: each has its own place.
    pub bond_numbers: Option<Vec<u32>>,
    /// What the next bond and the next obstacle get.
    pub next_numbers: [u32; 2],
    /// Numbers of the constant forces that are left, ascending, and what the next one gets.
    pub force_numbers: Vec<u32>,
    /// See [`Saved::force_numbers`].
    pub next_force: u32,
    /// Where the live cursor goes: from, to, and from when to when `[s]`.
    pub cursor: Option<([Cursor; 2], [f64; 2])>,
    /// What is grabbed.
    pub grabbed: Vec<PointId>,
    /// What is grabbed is torn off only by a cursor that is farther from it than this `[m]`; 0: by any.
    pub torn_beyond: f64,
    /// The plane that a grab leads in, in space: a point of it `[m]` and its normal.
    pub lead: Option<[[f64; 3]; 2]>,
    /// Islands that are moved by the live step for a while, by their lowest points.
    pub handed_over: Vec<HandedOver>,
    /// The keys that players hold.
    pub keys: Keys,
}

impl<const D: usize> Saved<D> {
    /// Errors: lists that do not fit each other, numbers outside their ranges.
    pub(crate) fn check(&self) -> Result<(), ModelError> {
        self.model.check()?;
        let (points, bonds) = (self.model.position.len(), self.model.bonds.len());
        for (list, found) in [("lost positions", self.lost[0].len()), ("lost velocities", self.lost[1].len())] {
            if found != points {
                return Err(ModelError::Length { list, found, points });
            }
        }
        let range = |fine: bool, place: &str, range: &'static str| match fine {
            true => Ok(()),
            false => Err(ModelError::OutOfRange { place: place.to_owned(), value: "out of order".to_owned(), range }),
        };
        let ascends = |list: &[u32], below: u32| {
            list.windows(2).all(|pair| pair[0] < pair[1]) && list.last().is_none_or(|&last| last < below)
        };
        let gone: Vec<u32> = self.gone.iter().map(|point| point.0).collect();
        range(ascends(&gone, points as u32), "gone", "ascending numbers of points")?;
        let is_gone = |point: &PointId| self.gone.binary_search(point).is_ok();
        range(!self.model.bonds.ends().iter().flatten().any(is_gone), "bonds", "between points that are left")?;
        range(!self.model.triangles.iter().flatten().any(is_gone), "triangles", "between points that are left")?;
        let angles = &self.model.angles.list;
        range(!angles.iter().flat_map(|angle| &angle.points).any(is_gone), "angles", "between points that are left")?;
        range(!self.model.pinned.iter().any(is_gone), "pinned", "of points that are left")?;
        let pushed = self.model.forces.iter().flat_map(|force| &force.points);
        range(!pushed.into_iter().any(is_gone), "forces", "on points that are left")?;
        let fits = self.force_numbers.len() == self.model.forces.len() && ascends(&self.force_numbers, self.next_force);
        range(fits, "force_numbers", "ascending, one a force")?;
        let numbers = self.bond_numbers.as_ref();
        let fits = numbers.is_none_or(|numbers| numbers.len() == bonds && ascends(numbers, self.next_numbers[0]));
        range(fits, "bond_numbers", "ascending, one a bond")?;
        let [next_bond, next_obstacle] = self.next_numbers;
        let is_bond = if numbers.is_none() { next_bond as usize == bonds } else { next_bond as usize >= bonds };
        let obstacles = self.model.planes.len() + self.model.polygons.len() + self.model.convex.len();
        let given = self.model.obstacle_numbers.iter().flatten();
        let is_obstacle = next_obstacle as usize >= obstacles && given.max().is_none_or(|&last| last < next_obstacle);
        range(is_bond && is_obstacle, "next_numbers", "above those that were given")?;
        let finite = self.lost.iter().flatten().flatten().all(|x| x.is_finite());
        range(finite && self.time.is_finite() && self.substep > 0.0 && self.substep.is_finite(), "time", "finite")?;
        range(self.keys.is_fine(), "keys", "within their ranges")?;
        range(self.grabbed.iter().all(|point| point.index() < points), "grabbed", "numbers of points")?;
        let is_length = self.torn_beyond >= 0.0 && self.torn_beyond.is_finite();
        range(is_length, "torn_beyond", "finite and >= 0")?;
        let is_known =
            |handed: &HandedOver| handed.first.index() < points && handed.since.is_finite() && handed.until.is_finite();
        range(self.handed_over.iter().all(is_known), "handed_over", "numbers of points and finite times")
    }
}
