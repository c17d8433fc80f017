//! Large bodies as the plan describes them.

use super::Way;
use super::body::{AnyBody, Body, Members};
use super::chain::Chain;
use super::control::Control;
use super::crowd::Crowd;
use super::mesh::Mesh;
use super::sheet::Sheet;
use super::spec::Spec;
use super::trails::Segment;
use crate::sim::kernels::rows::Kinds;
use crate::sim::real::Real;
use crate::sim::sizes::SHORTEST_TRAILS;

/// The structure of a body.
#[derive(Clone, Debug)]
pub(crate) enum Shape<const D: usize> {
    /// Rows and columns; rows are solved last where they bear the load.
    Sheet { columns: usize, rows: usize, specs: Kinds<Spec>, rows_last: bool },
    /// One path, with its rest lengths `[m]`.
    Chain { spec: Spec, rests: Vec<f64> },
    /// So many equal bodies of so many points, and the bonds of one; whether these are swept one way in every substep.
    Crowd { bodies: usize, points: usize, links: Vec<([u32; 2], Spec)>, is_steady: bool },
    /// Any mesh; with positions `[m]` and the direction of gravity where long paths are looked for.
    Mesh { points: usize, segments: Vec<Segment>, trails: Option<(Vec<[f64; D]>, [f64; D])> },
}

/// A body and its points in the group.
#[derive(Clone, Debug)]
pub(crate) struct Draft<const D: usize> {
    pub(crate) shape: Shape<D>,
    pub(crate) members: Members,
    /// How many points make one piece each, that bonds hold in shape; `None` where surfaces strike point by point.
    pub(crate) piece: Option<usize>,
}

/// All that large bodies are made from.
pub(crate) struct Order<S, const D: usize> {
    pub(crate) bodies: Vec<Draft<D>>,
    /// Inverse mass of every point of the group `[1/kg]`; 0 = pinned.
    pub(crate) inverse_mass: Vec<S>,
    pub(crate) way: Way,
    pub(crate) control: Control,
    /// Gravity `[m/s^2]`.
    pub(crate) gravity: f64,
    /// The substep that relaxed bonds are relative to `[s]`.
    pub(crate) nominal: f64,
}

impl<const D: usize> Draft<D> {
    /// The body.
    pub(super) fn make<S: Real>(self, w: &[S]) -> AnyBody<S, D> {
        let (members, piece) = (self.members, self.piece);
        match self.shape {
            Shape::Sheet { columns, rows, specs, rows_last } => {
                AnyBody::Sheet(Box::new(Body::new(Sheet::new(columns, rows, specs, rows_last), (members, piece), w)))
            }
            Shape::Chain { spec, rests } => {
                AnyBody::Chain(Box::new(Body::new(Chain::new(spec, &rests), (members, piece), w)))
            }
            Shape::Crowd { bodies, points, links, is_steady } => {
                AnyBody::Crowd(Box::new(Body::new(Crowd::new(bodies, points, links, is_steady), (members, piece), w)))
            }
            Shape::Mesh { points, segments, trails } => {
                let mut mesh = Mesh::new(points, segments);
                if let Some((position, down)) = trails
                    && mesh.lay_trails(&position, down) < SHORTEST_TRAILS
                {
                    mesh.forget_trails();
                }
                AnyBody::Mesh(Box::new(Body::new(mesh, (members, piece), w)))
            }
        }
    }
}
