//! What the loop of a source has not, and refuses.

use super::{Model, ModelError};
use crate::sim::bond::{Bond, Limit};
use crate::sim::contact::convex::Figure;
use crate::sim::solver::Solver;
use crate::sim::source::Source;

impl<const D: usize> Model<D> {
    /// The loop that is asked for.
    fn printed(&self) -> Option<Source> {
        if let Solver::AsPrinted(source) = self.method.solver { Some(source) } else { None }
    }

    /// Errors: something around points and bonds that the loop asked for does not know.
    pub(super) fn check_printed(&self) -> Result<(), ModelError> {
        let Some(source) = self.printed() else { return Ok(()) };
        let is_cloth = source == Source::Cloth;
        let has_balls = self.convex.iter().any(|convex| matches!(convex.figure, Figure::Ball { .. }));
        let lacks = [
            ("contact", self.contact.is_some()),
            ("tolerance", self.method.tolerance.is_some()),
            ("max_strain", self.method.max_strain.is_some()),
            ("drag_rate", self.drag_rate != 0.0),
            ("wind", self.wind.is_some() && source != Source::Segments),
            ("forces", !self.forces.is_empty()),
            ("areas", self.areas.is_some()),
            ("angles", !self.angles.list.is_empty()),
            ("bounds", self.bounds.is_some() && !source.has_walls()),
            ("planes among its obstacles", !self.planes.is_empty() && !is_cloth),
            ("polygons among its obstacles", !self.polygons.is_empty()),
            ("boxes among its obstacles", !self.convex.is_empty() && !is_cloth),
            ("balls among its obstacles", has_balls),
        ];
        let lacking = lacks.into_iter().find(|(_, is_there)| *is_there);
        lacking.map_or(Ok(()), |(what, _)| Err(ModelError::NotPrinted { what, of: source }))
    }

    /// Errors: a bond that acts on one side, or whose rest length of 0 the loop divides by.
    pub(super) fn check_printed_bond(&self, bond: &Bond) -> Result<(), ModelError> {
        match self.printed() {
            Some(source) if bond.limit != Limit::Both => Err(ModelError::NotPrinted { what: "limit", of: source }),
            Some(source @ Source::SpringRelative) if bond.rest_length == 0.0 => {
                Err(ModelError::NotPrinted { what: "bond of rest length 0", of: source })
            }
            _ => Ok(()),
        }
    }
}
