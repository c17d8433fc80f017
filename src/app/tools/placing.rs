//! What a number does to where what is selected is fits into the world as what a drag does.

use glam::{DVec2, DVec3};

use super::Deed;
use super::chosen::Chosen;
use super::handles::Change;
use super::pick::Scope;
use crate::app::matter::{Fit, Placed, Placing};
use crate::history::Do;
use crate::sim::PointId;

impl Chosen {
    /// How it fits where a number puts it, and what is to be said of it.
    ///
    /// Errors: in words, why it cannot be there; none where it is there already.
    pub(in crate::app) fn fit(
        &self,
        scope: Scope<'_>,
        placing: Placing,
    ) -> Result<(Fit, Option<String>), Option<String>> {
        let placed = scope.shown.figures.placed.ok_or(None)?;
        let Placed { middle, .. } = placed;
        let (change, by) = match placing {
            Placing::At(axis, to) if to == middle[axis] => return Err(None),
            Placing::At(axis, to) => {
                let mut by = [0.0; 3];
                by[axis] = to - middle[axis];
                (Change::Shift(DVec3::from(by)), DVec3::from(by))
            }
            Placing::Angle(to) => (Change::Turn(placed.turn_to(to).ok_or(None)?), DVec3::ZERO),
            Placing::TurnBy(turn) => (Change::Turn(turn), DVec3::ZERO),
            // What lies around it is put aside by the world.
            Placing::Side(..) | Placing::Radius(_) => return Ok((Fit::default(), None)),
        };
        let chosen = self.left(scope);
        let Deed { commands, words, .. } = change.fitted(scope, &chosen, DVec2::new(middle[0], middle[1]));
        let Some(Do::Move(keys)) = commands.into_iter().next() else { return Err(words) };
        let lift = DVec3::from(keys.by.map_or([0.0; 3], |by| by.embed())) - by;
        let is_own = |point: &PointId| chosen.points.binary_search(point).is_ok();
        let along = keys.points.into_iter().map(PointId).filter(|point| !is_own(point)).collect();
        Ok((Fit { along, lift: lift.to_array() }, words))
    }
}
