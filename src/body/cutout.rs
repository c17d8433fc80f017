//! The mesh of a picture, as large as it is to be in the world.

use std::sync::Arc;

use super::{Body, BodyError, MAX_POINTS, length};
use crate::picture::PictureMesh;

/// A picture's mesh about the middle of the picture, y up: points along its boundary first, then those inside, then those of
/// strokes.
#[derive(Clone, Debug, PartialEq)]
pub struct Cutout {
    /// The mesh, in pixels.
    pub mesh: Arc<PictureMesh>,
    /// Height of the picture [m].
    pub height: f64,
}

/// Least share of the mean area that a point counts for: the corner of one small triangle would be so light that the springs
/// at it cut the substep of the whole body.
const LEAST_SHARE: f64 = 0.25;

impl Cutout {
    /// How many points it makes.
    ///
    /// Errors: a height that is not positive; more points than [`MAX_POINTS`].
    pub fn point_count(&self) -> Result<u32, BodyError> {
        length("height", self.height)?;
        match u32::try_from(self.mesh.points.len()) {
            Ok(count) if u64::from(count) <= MAX_POINTS => Ok(count),
            _ => Err(BodyError::new("spacing", format!("makes more than {MAX_POINTS} points: give a wider one"))),
        }
    }

    pub(super) fn make(&self) -> Body {
        let mesh = &*self.mesh;
        let [width, height] = mesh.picture.map(f64::from);
        let scale = self.height / height;
        let place = |&[x, y]: &[f64; 2]| [scale * (x - 0.5 * width), scale * (0.5 * height - y), 0.0];
        let mut body = Body {
            positions: mesh.points.iter().map(place).collect(),
            links: Vec::with_capacity(mesh.bonds.len()),
            weights: weights(&mesh.areas),
            area: scale * scale * mesh.areas.iter().sum::<f64>(),
            triangles: mesh.triangles.clone(),
            texture: mesh.texture.clone(),
        };
        mesh.bonds.iter().for_each(|&[a, b]| body.link(a, b));
        for (link, is_edge) in body.links.iter_mut().zip(mesh.edges()) {
            link.share = if is_edge { 0.5 } else { 1.0 };
        }
        body
    }
}

/// What points count for, by their areas.
fn weights(areas: &[f64]) -> Vec<f64> {
    let mean = areas.iter().sum::<f64>() / areas.len().max(1) as f64;
    areas.iter().map(|area| area.max(LEAST_SHARE * mean)).collect()
}
