//! The public texts whose loops can be run as they are printed.

use std::fmt;

use super::bond::BondKind;

/// A loop of one of the five texts, with its faults; `docs/sources.md` has each beside what is right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Position Verlet that starts with a h^2, one sweep, corrections limited on one side, walls before the sweep.
    Notebook,
    /// The same with walls after the sweep.
    NotebookGraph,
    /// Six moves of the points to one sweep, walls after it.
    Segments,
    /// Fifty sweeps; the place that a locked point had is never brought up to date.
    Rope,
    /// Springs by the loop that is called explicit Euler there.
    Spring,
    /// The same with the spring's force relative to its rest length.
    SpringRelative,
    /// Points are put out of boxes, then swept fifteen times; a step as long as the frame took.
    Cloth,
}

impl Source {
    /// All, in the order of their names.
    pub const ALL: [Source; 7] = [
        Source::Notebook,
        Source::NotebookGraph,
        Source::Segments,
        Source::Rope,
        Source::Spring,
        Source::SpringRelative,
        Source::Cloth,
    ];

    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Source::Notebook => "000",
            Source::NotebookGraph => "000-graph",
            Source::Segments => "001",
            Source::Rope => "002",
            Source::Spring => "003",
            Source::SpringRelative => "003-relative",
            Source::Cloth => "004",
        }
    }

    /// Time from one sweep to the next where nothing is said `[s]`.
    pub(crate) fn substep(self) -> f64 {
        match self {
            Source::Notebook => 0.006,
            Source::NotebookGraph => 0.05,
            Source::Segments | Source::Cloth => 1.0 / 60.0,
            // What its engine takes where nothing is said.
            Source::Rope => 1.0 / 64.0,
            Source::Spring | Source::SpringRelative => 1e-3,
        }
    }

    /// Sweeps in a step where nothing is said.
    pub(crate) fn sweeps(self) -> u32 {
        match self {
            Source::Rope => 50,
            Source::Cloth => 15,
            _ => 1,
        }
    }

    /// Whether bonds are forces, not swept.
    pub(crate) fn has_springs(self) -> bool {
        matches!(self, Source::Spring | Source::SpringRelative)
    }

    /// Whether points are kept within walls.
    pub(crate) fn has_walls(self) -> bool {
        matches!(self, Source::Notebook | Source::NotebookGraph | Source::Segments)
    }

    /// Whether the text has no such bonds: the kind in words, and solvers that would do.
    pub(crate) fn refusal(self, kind: BondKind) -> Option<(&'static str, &'static str)> {
        let is_notebook = matches!(self, Source::Notebook | Source::NotebookGraph);
        match kind {
            BondKind::Spring { .. } if self.has_springs() => None,
            BondKind::Spring { .. } => Some(("a spring", "auto, or source 003")),
            _ if self.has_springs() => Some(("no spring", "auto, or another source")),
            BondKind::Relaxed { .. } if !is_notebook => Some(("relaxed", "relaxation, or source 000")),
            _ => None,
        }
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
