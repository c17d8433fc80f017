//! What points cannot pass, as a scene says it.

use super::bounds::Bounds;
use super::convex::Convex;
use super::polygon::Polygon;
use super::surface::{Plane, Surface};
use crate::sim::real::Real;

/// Borrowed walls and obstacles of a scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Geometry<'a, const D: usize> {
    /// The walls around the world, if any.
    pub(crate) bounds: Option<&'a Bounds<D>>,
    pub(crate) planes: &'a [Plane<D>],
    /// None in space.
    pub(crate) polygons: &'a [Polygon],
    /// None in the plane.
    pub(crate) convex: &'a [Convex],
}

impl<const D: usize> Geometry<'_, D> {
    /// All surfaces without an end that are met: the walls of the bounds, then the planes.
    pub(crate) fn surfaces<S: Real>(&self) -> Vec<Surface<S, D>> {
        let walls = self.bounds.into_iter().flat_map(walls);
        let planes = self.planes.iter().copied().filter(|plane| plane.penalty.is_none());
        walls.chain(planes).map(|plane| Surface::new(&plane)).collect()
    }
}

/// The walls of the bounds, as planes.
fn walls<const D: usize>(bounds: &Bounds<D>) -> Vec<Plane<D>> {
    let mut planes = Vec::with_capacity(2 * D);
    for k in 0..D {
        for (point, side) in [(bounds.min, 1.0), (bounds.max, -1.0)] {
            let mut normal = [0.0; D];
            normal[k] = side;
            planes.push(Plane {
                point,
                normal,
                restitution: bounds.restitution,
                friction: bounds.friction,
                penalty: None,
            });
        }
    }
    planes
}
