//! Judges a heap while it comes to rest, by the same rules in every engine.

use super::depth::deepest;
use super::mesh::{Mesh, double_area};

/// Speed below which a point rests [m/s].
const CALM: f64 = 1e-2;

/// A heap at one moment.
pub(crate) struct Look<'a> {
    /// When [s].
    pub(crate) time: f64,
    /// Place of each point [m].
    pub(crate) positions: &'a [[f64; 2]],
    /// Velocity of each point [m/s].
    pub(crate) velocities: &'a [[f64; 2]],
    /// Whether the engine has put all bodies to sleep.
    pub(crate) is_asleep: bool,
}

/// How good a heap was.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Verdict {
    /// Deepest that a skin's point ever was inside another skin, in mean edges of a skin.
    pub(crate) deepest: f64,
    /// Triangles that are inside out at the end.
    pub(crate) inverted: usize,
    /// From when on no speed was 1e-2 m/s or more until the end [s].
    pub(crate) calm_after: Option<f64>,
    /// From when on all slept until the end [s].
    pub(crate) asleep_after: Option<f64>,
}

impl Verdict {
    /// Takes one more look into account; looks come in the order of time.
    pub(crate) fn look(&mut self, mesh: &Mesh, look: &Look) {
        let is_calm = look.velocities.iter().all(|v| v[0].hypot(v[1]) < CALM);
        let since = |before: Option<f64>, holds: bool| if holds { before.or(Some(look.time)) } else { None };
        self.calm_after = since(self.calm_after, is_calm);
        self.asleep_after = since(self.asleep_after, look.is_asleep);
        self.deepest = self.deepest.max(deepest(look.positions, &mesh.skins) / mesh.edge);
        // Not "<= 0": a corner that is nowhere counts too.
        let is_whole = |&&corners: &&[usize; 3]| double_area(corners, look.positions) > 0.0;
        self.inverted = mesh.triangles.len() - mesh.triangles.iter().filter(is_whole).count();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rest_counts_from_the_last_time_that_it_began() -> anyhow::Result<()> {
        let mesh = crate::heaps::mesh::wheel(1.0, 2.0)?;
        let mut verdict = Verdict::default();
        let moments = [(0.1, 0.0, false), (0.2, 1.0, false), (0.3, 0.009, false), (0.4, 0.0, true)];
        for (time, speed, is_asleep) in moments {
            let velocities = vec![[0.0, speed]; mesh.positions.len()];
            verdict.look(&mesh, &Look { time, positions: &mesh.positions, velocities: &velocities, is_asleep });
        }
        assert_eq!((verdict.calm_after, verdict.asleep_after), (Some(0.3), Some(0.4)));
        assert_eq!((verdict.deepest, verdict.inverted), (0.0, 0));
        let mirrored: Vec<_> = mesh.positions.iter().map(|p| [-p[0], p[1]]).collect();
        verdict.look(&mesh, &Look { time: 0.5, positions: &mirrored, velocities: &[[f64::NAN; 2]], is_asleep: true });
        assert_eq!((verdict.calm_after, verdict.inverted), (None, 16));
        Ok(())
    }
}
