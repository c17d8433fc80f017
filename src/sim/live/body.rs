//! Bodies as the live step knows them: each one's points, bonds, triangles and skin, one after the other.

use std::sync::Arc;

use super::bend::Bends;
use super::rig::Rig;
use super::rigid::Shape;
use super::strap::Strap;
use crate::sim::bond::Limit;
use crate::sim::real::Real;

/// Where the things of one body lie in the lists of all.
#[derive(Clone, Debug, Default)]
pub(super) struct Span {
    pub(super) first: u32,
    pub(super) end: u32,
}

impl Span {
    pub(super) fn range(&self) -> std::ops::Range<usize> {
        self.first as usize..self.end as usize
    }

    pub(super) fn len(&self) -> usize {
        (self.end - self.first) as usize
    }
}

/// One body. Its points are numbered within it.
#[derive(Clone, Debug)]
pub(super) struct Body<S> {
    pub(super) points: Span,
    pub(super) springs: Span,
    pub(super) holds: Span,
    pub(super) areas: Span,
    pub(super) edges: Span,
    pub(super) corners: Span,
    pub(super) hinges: Span,
    pub(super) muscles: Span,
    pub(super) turns: Span,
    /// How its angles are bent together; `None`: one by one.
    pub(super) bends: Option<Arc<Bends>>,
    /// Bonds at the front of those that are held that make trees, from the roots on.
    pub(super) tree: u32,
    /// Some of the others are rigid, and no angles give way to them.
    pub(super) is_swept: bool,
    /// Mean length of its edges at the start `[m]`; 0 without any.
    pub(super) edge_length: S,
    /// Distance that its skin keeps `[m]`.
    pub(super) radius: S,
    /// Fewest substeps in a frame in which most of its springs may be forces, and all of them exact ones.
    pub(super) least_substeps: [u32; 2],
    /// Pins of it that its rigid bonds keep near each other, where some are led.
    pub(super) straps: Vec<Strap<S>>,
    /// Its shape, where rigid bonds hold all of its points: none of its bonds, angles and areas is asked then.
    pub(super) rigid: Option<Arc<Shape>>,
    /// What rigid bonds hold of it, where that is several bodies in joints: none of these bonds is asked then.
    pub(super) rig: Option<Arc<Rig>>,
}

/// A bond between two points of a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link<S> {
    pub(super) a: u32,
    pub(super) b: u32,
    pub(super) rest: S,
    /// `[N/m]`; infinite: rigid.
    pub(super) stiffness: S,
    /// `[N s/m]`
    pub(super) damping: S,
    /// What takes errors away where that is a relaxation; `None` of all others.
    pub(super) relaxed: Option<Relaxed<S>>,
    pub(super) limit: Limit,
}

/// A relaxed bond in substeps of any length: it gives way by as much as by the sweeps of its own method.
///
/// Source: of an error D the substep h that these sweeps are made for leaves q D, which is a spring of stiffness K = (1 - q)/(q h^2 (w_a + w_b)):
/// `docs/sources.md`, "What a relaxation amounts to".
#[derive(Clone, Copy, Debug)]
pub(super) struct Relaxed<S> {
    /// (1 - q)/(q h^2) `[1/s^2]`; infinite, where nothing is left.
    pace: S,
    /// Most that the sweeps of a second take of a length `[1/s]`.
    most: S,
}

impl<S: Real> Relaxed<S> {
    /// Of a share of the error that each of `sweeps` in `h` `[s]` takes, and most of the length.
    pub(super) fn new((share, most): (f64, f64), (h, sweeps): (f64, u32)) -> Self {
        let left = (1.0 - share).powi(sweeps as i32);
        let pace = if left > 0.0 { (1.0 - left) / (left * h * h) } else { f64::INFINITY };
        Relaxed { pace: S::from_f64(pace), most: S::from_f64(most * f64::from(sweeps) / h) }
    }

    /// The share of an error that one sweep in `h` `[s]` takes, and the most of the length, both `[1]`.
    pub(super) fn within(&self, h: S) -> [S; 2] {
        let eager = self.pace * h * h;
        let share = if eager.is_finite() { eager / (S::ONE + eager) } else { S::ONE };
        [share, self.most * h]
    }
}

/// A triangle that must not turn inside out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area<S> {
    pub(super) corners: [u32; 3],
    /// Its area at the start `[m^2]`.
    pub(super) rest: S,
}

/// An edge of a skin, the free side on its left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) ends: [u32; 2],
    /// There is something on its right: otherwise both sides are free.
    pub(super) is_closed: bool,
}
