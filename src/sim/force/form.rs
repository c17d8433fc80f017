//! What keeps the form of bodies, as forces: angles and areas.

use super::angle::Hinge;
use super::area::Patch;
use crate::sim::real::Real;
use crate::sim::vector::length;

/// The angles and areas of a group.
#[derive(Clone, Debug)]
pub(crate) struct Form<S> {
    pub(crate) hinges: Vec<Hinge<S>>,
    pub(crate) patches: Vec<Patch<S>>,
}

impl<S: Real> Form<S> {
    /// Neither.
    pub(crate) fn none() -> Self {
        Form { hinges: Vec::new(), patches: Vec::new() }
    }

    pub(crate) fn len(&self) -> usize {
        self.hinges.len() + self.patches.len()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.hinges.is_empty() && self.patches.is_empty()
    }

    /// Whether any has a damper, so that forces depend on velocities.
    pub(crate) fn is_damped(&self) -> bool {
        self.hinges.iter().any(|hinge| hinge.damping > S::ZERO)
    }

    /// Energy of joints that are beyond their ranges `[J]`, of points that are there.
    pub(crate) fn stopped<const D: usize>(&self, x: &[[S; D]]) -> S {
        let beyond = |hinge: &Hinge<S>| hinge.energy(at(x, hinge.points)) - hinge.energy_within(at(x, hinge.points));
        self.hinges.iter().filter(|hinge| hinge.stop > S::ZERO).fold(S::ZERO, |sum, hinge| sum + beyond(hinge))
    }

    /// The points of each, angles first.
    pub(crate) fn triples(&self) -> impl Iterator<Item = [u32; 3]> {
        self.hinges.iter().map(|hinge| hinge.points).chain(self.patches.iter().map(|patch| patch.corners))
    }

    /// The pairs of points that pull on each other, three for each.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        self.triples().flat_map(|points| PAIRS.map(|[m, n]| [points[m], points[n]]))
    }

    /// Adds the forces of all to `force` `[N]`. Shapes: `x`, `v` and `force` have one entry a point.
    pub(crate) fn pull<const D: usize>(&self, x: &[[S; D]], v: &[[S; D]], force: &mut [[S; D]]) {
        for hinge in &self.hinges {
            if let Some([_, damped]) = hinge.forces(at(x, hinge.points), at(v, hinge.points)) {
                push(hinge.points, damped, force);
            }
        }
        for patch in &self.patches {
            push(patch.corners, patch.forces(at(x, patch.corners)), force);
        }
    }

    /// The same of points at rest.
    pub(crate) fn pull_at_rest<const D: usize>(&self, x: &[[S; D]], force: &mut [[S; D]]) {
        for hinge in &self.hinges {
            if let Some([still, _]) = hinge.forces(at(x, hinge.points), [[S::ZERO; D]; 3]) {
                push(hinge.points, still, force);
            }
        }
        for patch in &self.patches {
            push(patch.corners, patch.forces(at(x, patch.corners)), force);
        }
    }

    /// The largest force of one on a point `[N]`, of points at rest.
    pub(crate) fn largest<const D: usize>(&self, x: &[[S; D]]) -> S {
        let still = [[S::ZERO; D]; 3];
        let hinges = self.hinges.iter().filter_map(|hinge| Some(hinge.forces(at(x, hinge.points), still)?[0]));
        let all = hinges.chain(self.patches.iter().map(|patch| patch.forces(at(x, patch.corners))));
        all.flatten().fold(S::ZERO, |most, force| most.max(length(force)))
    }

    /// How stiff the stiffest is at one of its points `[N/m]`.
    pub(crate) fn stiffest<const D: usize>(&self, x: &[[S; D]]) -> S {
        let mut most = S::ZERO;
        self.stiffen((x, S::ZERO, true), |place, block| {
            if let Block::Own(_) = place {
                most = most.max((0..D).fold(S::ZERO, |sum, k| sum + block[k][k]));
            }
        });
        most
    }

    /// Their energy `[J]`.
    pub(crate) fn energy<const D: usize>(&self, x: &[[S; D]]) -> S {
        let hinges = self.hinges.iter().fold(S::ZERO, |sum, hinge| sum + hinge.energy(at(x, hinge.points)));
        self.patches.iter().fold(hinges, |sum, patch| sum + patch.energy(at(x, patch.corners)))
    }

    /// Hands out minus the derivative of every force at these places, `rate` `[1/s]` times that by the velocities included `[N/m]`: a point and
    /// its own block, and the number of a pair as [`Form::pairs`] counts them with the block between its points, rows of the first.
    /// `is_cautious` leaves out what may be negative.
    pub(crate) fn stiffen<const D: usize>(
        &self,
        (x, rate, is_cautious): (&[[S; D]], S, bool),
        mut give: impl FnMut(Block, [[S; D]; D]),
    ) {
        let hinges = self.hinges.iter().map(|hinge| {
            let blocks = hinge.stiffness_blocks(at(x, hinge.points), rate, is_cautious);
            (hinge.points, blocks.unwrap_or([[[[S::ZERO; 2]; 2]; 3]; 3]))
        });
        let patches =
            self.patches.iter().map(|patch| (patch.corners, patch.stiffness_blocks(at(x, patch.corners), is_cautious)));
        for (k, (points, blocks)) in hinges.chain(patches).enumerate() {
            for m in 0..3 {
                give(Block::Own(points[m] as usize), wide(blocks[m][m]));
            }
            for (n, [m, l]) in PAIRS.into_iter().enumerate() {
                give(Block::Pair(3 * k + n), wide(blocks[m][l]));
            }
        }
    }
}

/// Where a block belongs.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Block {
    /// To a point itself.
    Own(usize),
    /// Between the points of a pair.
    Pair(usize),
}

fn wide<S: Real, const D: usize>(block: [[S; 2]; 2]) -> [[S; D]; D] {
    std::array::from_fn(|r| std::array::from_fn(|c| if r < 2 && c < 2 { block[r][c] } else { S::ZERO }))
}

/// The pairs among three points.
const PAIRS: [[usize; 2]; 3] = [[0, 1], [1, 2], [0, 2]];

/// The places or velocities of three points.
#[inline(always)]
pub(crate) fn at<S: Copy, const D: usize>(list: &[[S; D]], points: [u32; 3]) -> [[S; D]; 3] {
    points.map(|point| list[point as usize])
}

#[inline(always)]
fn push<S: Real, const D: usize>(points: [u32; 3], forces: [[S; 2]; 3], to: &mut [[S; D]]) {
    for (point, force) in points.into_iter().zip(forces) {
        let sum = &mut to[point as usize];
        sum[0] += force[0];
        sum[1] += force[1];
    }
}
