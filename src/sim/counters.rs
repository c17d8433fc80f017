//! Counts of the work that was done: they prove what was skipped.

/// Work done since a world was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Substeps taken.
    pub substeps: u64,
    /// Bonds taken by sweeps or evaluated as springs.
    pub bonds_solved: u64,
    /// Points advanced.
    pub points_moved: u64,
    /// Sweeps over the bonds.
    pub iterations: u64,
    /// Points that the mouse force was evaluated for.
    pub mouse_points: u64,
    /// Points that touched a wall.
    pub events: u64,
    /// Substeps whose rigid bonds did not converge: it went on with what the last sweep left.
    pub fallbacks: u64,
}
