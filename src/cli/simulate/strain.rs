//! Whether large bodies kept to the strain that was asked for, and the live step to one that nobody sees.

use crate::sim::{Bond, BondKind, Dynamics, Limit, Sample, Solver};

/// Strain of rigid bonds that the live step moves from which on it is told of `[1]`.
const SEEN: f64 = 0.05;

/// The sample that went furthest beyond what was asked for.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Strain(Option<Beyond>);

#[derive(Clone, Copy, Debug)]
struct Beyond {
    /// `[s]`
    time: f64,
    /// Largest strain of the rigid bonds `[1]`.
    found: f64,
    /// What it is not to be beyond `[1]`.
    most: f64,
    /// That was asked for: substeps follow it.
    is_asked: bool,
}

impl Strain {
    /// Looks at a sample of a world.
    pub(super) fn look(&mut self, world: &dyn Dynamics, sample: &Sample) {
        // Where parts are to keep different strains, no bond says whose it is.
        let asked = world.parts().iter().filter_map(|part| part.max_strain).reduce(f64::max);
        let is_live = || world.moved_by().iter().any(|mover| mover.method == Solver::Live);
        let Some(most) = asked.or_else(|| is_live().then_some(SEEN)) else { return };
        let found = world.bonds().iter().map(|bond| strain(&bond, sample)).fold(0.0, f64::max);
        if found > most && self.0.is_none_or(|before| found / most > before.found / before.most) {
            self.0 = Some(Beyond { time: sample.time, found, most, is_asked: asked.is_some() });
        }
    }

    /// What is to be said, where a sample was beyond.
    pub(super) fn warning(self) -> Option<String> {
        let Beyond { time, found, most, is_asked } = self.0?;
        Some(match is_asked {
            true => format!(
                "at t = {time:?} s rigid bonds of large bodies have a strain of {found:.1e} where {most:?} was asked for: ask for a larger max_strain, or lead them less violently"
            ),
            false => format!(
                "at t = {time:?} s rigid bonds that the live step moves have a strain of {found:.1e}: what lies on them or is caught in them is too heavy for them"
            ),
        })
    }
}

/// The strain of a rigid bond that acts `[1]`, else 0.
fn strain(bond: &Bond, sample: &Sample) -> f64 {
    if bond.kind != BondKind::Rigid || bond.rest_length <= 0.0 {
        return 0.0;
    }
    let [a, b] = [bond.a, bond.b].map(|end| sample.position[end.index()]);
    let square: f64 = a.iter().zip(&b).map(|(a, b)| (a - b) * (a - b)).sum();
    let strain = square.sqrt() / bond.rest_length - 1.0;
    match bond.limit {
        Limit::Both => strain.abs(),
        Limit::Max => strain.max(0.0),
        Limit::Min => (-strain).max(0.0),
    }
}
