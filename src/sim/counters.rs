//! Counts of the work that was done: they prove what was skipped.

/// Work done since a world was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Substeps taken.
    pub substeps: u64,
    /// Bonds taken by sweeps and solves, or evaluated as springs.
    pub bonds_solved: u64,
    /// Points advanced.
    pub points_moved: u64,
    /// Sweeps over the bonds, and rounds of Newton's method.
    pub iterations: u64,
    /// Points that the mouse force was evaluated for.
    pub mouse_points: u64,
    /// Touches of surfaces, and crossings of the mouse region's edge and turns of bonds that were located.
    pub events: u64,
    /// Substeps that a guard split in two.
    pub guard_splits: u64,
    /// Substeps that went to the next more robust method, or on with bonds that do not hold.
    pub fallbacks: u64,
    /// Bonds that broke.
    pub bonds_torn: u64,
}

impl Counters {
    /// Counts `sweeps` over `bonds`.
    pub(crate) fn sweep(&mut self, sweeps: u32, bonds: usize) {
        self.iterations += u64::from(sweeps);
        self.bonds_solved += u64::from(sweeps) * bonds as u64;
    }
}
