//! What is wrong with a model, in words.

use crate::sim::solver::Solver;
use crate::sim::source::Source;

/// How many entries a list has for so many points, in words.
pub(crate) fn entries_for(found: usize, points: usize) -> String {
    let entries = if found == 1 { "entry" } else { "entries" };
    format!("{found} {entries} for {points} {}", if points == 1 { "point" } else { "points" })
}

/// A model that no world can be made from.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ModelError {
    /// Lists of different lengths.
    #[error("{list} has {}: give one a point", entries_for(*found, *points))]
    Length {
        /// The list.
        list: &'static str,
        /// Its length.
        found: usize,
        /// The number of positions.
        points: usize,
    },
    /// An index that no point has.
    #[error("{place} names point {point}, but there are {points} points")]
    NoSuchPoint {
        /// The bond or the pin.
        place: String,
        /// The index.
        point: u32,
        /// The number of points.
        points: usize,
    },
    /// A number outside its range.
    #[error("{place} is {value}: it must be {range}")]
    OutOfRange {
        /// What the number is of.
        place: String,
        /// The number.
        value: String,
        /// Its range in words.
        range: &'static str,
    },
    /// A bond between a point and itself.
    #[error("bond {bond} joins point {point} to itself")]
    Loop {
        /// The bond.
        bond: usize,
        /// The point.
        point: u32,
    },
    /// Something of the plane in space.
    #[error("`{what}` is of the plane: leave it out in space")]
    Planar {
        /// What it is.
        what: &'static str,
    },
    /// A solver that does not meet balls and boxes in space.
    #[error("solver {solver} does not meet balls and boxes in space: leave `solver` out")]
    NoConvex {
        /// The solver.
        solver: Solver,
    },
    /// Something that the loop of a source has not.
    #[error("the loop of source {of} has no {what}: leave that out, or use another solver")]
    NotPrinted {
        /// What it is.
        what: &'static str,
        /// The source.
        of: Source,
    },
    /// A solver by which bodies cannot meet.
    #[error("solver {solver} knows no contact: leave `solver` out")]
    NoContact {
        /// The solver.
        solver: Solver,
    },
    /// A solver that knows no angles or no areas.
    #[error("solver {solver} knows no {what}: use {others}")]
    NoForm {
        /// "angles" or "areas".
        what: &'static str,
        /// The solver.
        solver: Solver,
        /// Solvers that would do.
        others: &'static str,
    },
    /// More areas to be held, with rigid bonds, than are solved together.
    #[error(
        "`areas` are rigid in a body of {found} rigid bonds and areas: give `stiffness`, or hold no more than {most}"
    )]
    TooManyHeld {
        /// How many there are.
        found: usize,
        /// How many are solved together.
        most: usize,
    },
    /// Areas that are held, for which no equilibrium is looked for.
    #[error("an equilibrium is not looked for with rigid `areas`: give a `stiffness`")]
    HeldAreas,
    /// A tolerance where bodies meet.
    #[error("no tolerance is held to where bodies meet, or among balls and boxes: leave `tolerance` out")]
    Unbounded,
    /// A surface that pushes by depth, under a method or in a scene that knows none.
    #[error("`penalty` is not known to {what}: leave one of them out")]
    NoPenalty {
        /// What does not know it.
        what: &'static str,
    },
    /// A bond that has no error, where a tolerance is asked for.
    #[error("bond {bond} is relaxed: it is defined by its sweeps and has no error to bound: leave `tolerance` out")]
    NoError {
        /// The bond.
        bond: usize,
    },
    /// A bond that has no energy, where an equilibrium is asked for.
    #[error("bond {bond} is relaxed and has no energy to settle: make it a spring or rigid")]
    NoEnergy {
        /// The bond.
        bond: usize,
    },
    /// A drive that its bond or angle cannot have.
    #[error("{place}: {why}")]
    Drive {
        /// The bond or the angle.
        place: String,
        /// What is wrong, and what to do.
        why: String,
    },
    /// Outlines of obstacles that cross so often that they are no drawing.
    #[error("the outlines of the polygons cross each other or themselves more than 200000 times: make them simpler")]
    Crossings,
    /// Obstacles among which no equilibrium is looked for.
    #[error("an equilibrium is not looked for among polygons, balls and boxes: leave them out")]
    Polygons,
    /// Bodies that meet, for which no equilibrium is looked for.
    #[error("an equilibrium is not looked for where bodies meet: leave `contact` out")]
    Meets,
    /// A solver and a kind of bond that do not go together.
    #[error("bond {bond} is {kind}, which solver {solver} refuses: use {others}")]
    Refused {
        /// The bond.
        bond: usize,
        /// Its kind.
        kind: &'static str,
        /// The solver.
        solver: Solver,
        /// Solvers that would do.
        others: &'static str,
    },
}
