//! What large bodies are and how their bonds are taken, in words.

use std::fmt;

use super::Way;

/// How many large bodies there are of each form, and how their bonds are taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kernel {
    /// Sheets, chains, crowds and meshes.
    pub(crate) counts: [usize; 4],
    pub(crate) way: Way,
}

impl Kernel {
    /// Those of both.
    pub(crate) fn and(mut self, other: Kernel) -> Self {
        for (count, more) in self.counts.iter_mut().zip(other.counts) {
            *count += more;
        }
        self
    }
}

impl fmt::Display for Kernel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plurals = [("sheet", "sheets"), ("chain", "chains"), ("crowd", "crowds"), ("mesh", "meshes")];
        let some =
            plurals.iter().zip(self.counts).filter(|(_, count)| *count > 0).map(|((one, many), count)| match count {
                1 => format!("a {one}"),
                _ => format!("{count} {many}"),
            });
        write!(f, "{} by ", some.collect::<Vec<_>>().join(" and "))?;
        match self.way {
            Way::Paths => f.write_str("paths"),
            Way::Forces => f.write_str("forces"),
            Way::Sweeps(1) => f.write_str("a sweep a substep"),
            Way::Sweeps(sweeps) => write!(f, "{sweeps} sweeps a substep"),
        }
    }
}
