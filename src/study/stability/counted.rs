//! The counters of a run, with the names that tables have.

use serde::Serialize;

use crate::sim::Counters;

/// The counters of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counted {
    /// Substeps taken.
    pub substeps: u64,
    /// Bonds evaluated or swept.
    pub bonds_solved: u64,
    /// Points advanced.
    pub points_moved: u64,
    /// Sweeps, and rounds of Newton's method.
    pub iterations: u64,
    /// Touches and other events.
    pub events: u64,
    /// Substeps that were split.
    pub guard_splits: u64,
    /// Substeps that went to a more robust method.
    pub fallbacks: u64,
    /// Bonds that broke.
    pub bonds_torn: u64,
    /// Points and edges of bodies that pressed each other, once a substep.
    pub contacts: u64,
    /// Motions that were cut where a point would have passed an edge.
    pub truncations: u64,
    /// Steps after which energy was taken from bodies that had got it from nowhere.
    pub guarded: u64,
    /// Points that were led back to the shape of their body, once a substep.
    pub mended: u64,
    /// Couples of bodies that were parted, once a substep.
    pub parted: u64,
    /// Groups of islands that were handed over to the live step.
    pub hand_overs: u64,
    /// Those that went back.
    pub returns: u64,
}

impl From<&Counters> for Counted {
    fn from(counters: &Counters) -> Self {
        let &Counters { substeps, bonds_solved, points_moved, iterations, .. } = counters;
        let &Counters { events, guard_splits, fallbacks, bonds_torn, hand_overs, returns, .. } = counters;
        let &Counters { contacts, truncations, guarded, mended, parted, .. } = counters;
        Counted {
            substeps,
            bonds_solved,
            points_moved,
            iterations,
            events,
            guard_splits,
            fallbacks,
            bonds_torn,
            contacts,
            truncations,
            guarded,
            mended,
            parted,
            hand_overs,
            returns,
        }
    }
}

impl Counted {
    /// All with their names, in the order of tables.
    pub fn list(&self) -> [(&'static str, u64); 15] {
        [
            ("substeps", self.substeps),
            ("bonds_solved", self.bonds_solved),
            ("points_moved", self.points_moved),
            ("iterations", self.iterations),
            ("events", self.events),
            ("guard_splits", self.guard_splits),
            ("fallbacks", self.fallbacks),
            ("bonds_torn", self.bonds_torn),
            ("contacts", self.contacts),
            ("truncations", self.truncations),
            ("guarded", self.guarded),
            ("mended", self.mended),
            ("parted", self.parted),
            ("hand_overs", self.hand_overs),
            ("returns", self.returns),
        ]
    }
}
