//! A figure between two heights: the ragdoll of scene files, as tall in the pose that it is made in.

use glam::DVec2;

use crate::body::{Body, Maker, Ragdoll};
use crate::sim::triangles::outer_sides;

/// A figure that stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Figure {
    /// Below its hip, where its lower foot is `[m]`.
    pub(super) feet: DVec2,
    /// From there to its crown `[m]`.
    pub(super) tall: f64,
}

/// A figure of the usual height about its hip, and how high its lowest and its highest points are `[m]`.
fn usual() -> (Body, [f64; 2]) {
    let body = Maker::Ragdoll(Ragdoll::default()).make().unwrap_or_default();
    let heights = body.positions.iter().map(|x| x[1]);
    let reach = heights.fold([0.0_f64; 2], |[low, high], y| [low.min(y), high.max(y)]);
    (body, reach)
}

impl Figure {
    /// It stands where a drag begins, its feet as high as the lower end of that, its crown as high as the upper one `[m]`.
    pub(super) fn between(from: DVec2, to: DVec2) -> Self {
        Figure { feet: DVec2::new(from.x, from.y.min(to.y)), tall: (to.y - from.y).abs() }
    }

    /// Its size in that of the usual one `[1]`.
    fn scale(&self, [low, high]: [f64; 2]) -> f64 {
        self.tall / (high - low).max(f64::MIN_POSITIVE)
    }

    /// Its height if it stood upright `[m]`: it strides.
    pub(super) fn height(&self) -> f64 {
        self.scale(usual().1) * Ragdoll::default().height
    }

    /// `[m]`
    pub(super) fn hip(&self) -> DVec2 {
        let reach = usual().1;
        self.feet - DVec2::new(0.0, reach[0] * self.scale(reach))
    }

    /// What its limbs cover, each for itself `[m^2]`.
    pub(super) fn area(&self) -> f64 {
        let (body, reach) = usual();
        let at = |point: u32| DVec2::from_slice(&body.positions[point as usize][..2]);
        let areas = body.triangles.iter().map(|&[a, b, c]| 0.5 * (at(b) - at(a)).perp_dot(at(c) - at(a)));
        areas.sum::<f64>() * self.scale(reach).powi(2)
    }

    /// The outlines of its limbs `[m]`: the sides that one triangle has alone.
    pub(super) fn sides(&self) -> Vec<[DVec2; 2]> {
        let (body, reach) = usual();
        let (hip, scale) = (self.hip(), self.scale(reach));
        let at = |point: u32| hip + scale * DVec2::from_slice(&body.positions[point as usize][..2]);
        outer_sides(body.triangles).into_iter().map(|side| side.ends.map(at)).collect()
    }
}
