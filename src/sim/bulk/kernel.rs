//! What large bodies are and how their bonds are taken, in words.

use std::fmt;

use super::Way;
use crate::sim::source::Source;

/// What a group of large bodies is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kernel {
    /// How many there are of each form (sheets, chains, crowds and meshes), and how their bonds are taken.
    Forms([usize; 4], Way),
    /// Rigid bodies, so many.
    Rigid(usize),
    /// Rigid bodies that joints hold together, so many in all.
    Joined(usize),
    /// Bodies of any form that may meet.
    Live,
    /// Points and bonds by the loop of a source.
    Printed(Source),
}

impl Kernel {
    /// Those of both.
    pub(crate) fn and(self, other: Kernel) -> Self {
        match (self, other) {
            (Kernel::Forms(counts, way), Kernel::Forms(more, _)) => {
                Kernel::Forms(std::array::from_fn(|form| counts[form] + more[form]), way)
            }
            (Kernel::Rigid(count), Kernel::Rigid(more)) => Kernel::Rigid(count + more),
            (Kernel::Rigid(count) | Kernel::Joined(count), Kernel::Rigid(more) | Kernel::Joined(more)) => {
                Kernel::Joined(count + more)
            }
            (Kernel::Printed(source), _) => Kernel::Printed(source),
            _ => Kernel::Live,
        }
    }
}

/// Operations of a bond that is taken once; of meshes by forces, whose points are gathered from everywhere.
pub(crate) const OF_A_BOND: u64 = 12;
const OF_A_GATHERED_BOND: u64 = 60;

impl Kernel {
    /// Whether what it moves is rigid bodies.
    pub(crate) fn is_of_rigid_bodies(self) -> bool {
        matches!(self, Kernel::Rigid(_) | Kernel::Joined(_))
    }

    /// Operations of a bond that is taken once, about.
    pub(crate) fn work_of_a_bond(self) -> u64 {
        if matches!(self, Kernel::Forms([_, _, _, meshes], Way::Forces) if meshes > 0) {
            OF_A_GATHERED_BOND
        } else {
            OF_A_BOND
        }
    }
}

impl fmt::Display for Kernel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (counts, way) = match *self {
            Kernel::Forms(counts, way) => (counts, way),
            Kernel::Rigid(1) => return f.write_str("a rigid body"),
            Kernel::Rigid(count) => return write!(f, "{count} rigid bodies"),
            Kernel::Joined(count) => return write!(f, "{count} rigid bodies in joints"),
            Kernel::Live => return f.write_str("live bodies"),
            Kernel::Printed(source) => return write!(f, "the loop of source {source}"),
        };
        let plurals = [("sheet", "sheets"), ("chain", "chains"), ("crowd", "crowds"), ("mesh", "meshes")];
        let some = plurals.iter().zip(counts).filter(|(_, count)| *count > 0).map(|((one, many), count)| match count {
            1 => format!("a {one}"),
            _ => format!("{count} {many}"),
        });
        write!(f, "{} by ", some.collect::<Vec<_>>().join(" and "))?;
        match way {
            Way::Paths => f.write_str("paths"),
            Way::Forces => f.write_str("forces"),
            Way::Sweeps(1) => f.write_str("a sweep a substep"),
            Way::Sweeps(sweeps) => write!(f, "{sweeps} sweeps a substep"),
        }
    }
}
