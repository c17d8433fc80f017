//! How finely what is filled is built: of how many points, whatever its size.

use super::grid::Fineness;

/// How many points what is filled is built of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) enum Grain {
    /// Few: for crowds.
    Coarse,
    /// Enough to bend, few enough for many of them.
    #[default]
    Medium,
    /// Small folds and dents are seen.
    Fine,
    /// As fine as is of use.
    VeryFine,
}

impl Grain {
    /// All of them, from the fewest points on.
    pub(in crate::app) const ALL: [Grain; 4] = [Grain::Coarse, Grain::Medium, Grain::Fine, Grain::VeryFine];

    /// What it is called.
    pub(in crate::app) fn name(self) -> &'static str {
        match self {
            Grain::Coarse => "coarse",
            Grain::Medium => "medium",
            Grain::Fine => "fine",
            Grain::VeryFine => "very fine",
        }
    }

    /// Cells along the shorter side of a box, or of a square as large as a loop.
    fn across(self) -> u32 {
        match self {
            Grain::Coarse => 3,
            Grain::Medium => 5,
            Grain::Fine => 10,
            Grain::VeryFine => 20,
        }
    }

    /// Cells of a box.
    pub(super) fn of_box(self) -> Fineness {
        Fineness { across: 1..=self.across(), most: 8 * self.across() }
    }

    /// Sides of triangles in the side of a square as large as a loop `[1]`.
    pub(super) fn of_loop(self) -> f64 {
        f64::from(self.across())
    }

    /// Points on the rim of a disc, or on each ring of a rim: multiples of six, so that a disc is a mirror image of itself and rolls to no side.
    pub(super) fn around(self) -> u32 {
        match self {
            Grain::Coarse => 12,
            Grain::Medium => 18,
            Grain::Fine => 36,
            Grain::VeryFine => 72,
        }
    }

    /// How many times as stiff each bond of a rim is as one of medium fineness, so that the rim is as stiff `[1]`.
    ///
    /// Model: a ring bends by what its sides give, which stand one behind another: with n times as many of them each has to be n times as
    /// stiff. What is filled evenly needs no such factor: of springs of one stiffness the plane has one modulus, however long they are.
    pub(super) fn of_rim(self) -> f64 {
        f64::from(self.around()) / f64::from(Grain::Medium.around())
    }
}
