//! The mesh of a picture, as large as it is to be in the world.

use std::sync::Arc;

use super::{Body, BodyError, MAX_POINTS, length};
use crate::picture::{Brace, PictureMesh};
use crate::sim::vector::embed;

/// Which points of a picture's mesh are bonded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pattern {
    /// The sides of triangles.
    #[default]
    Edges,
    /// Those, and the far corners of every two triangles that share a side: the body resists being folded.
    Braced,
}

/// A picture's mesh about the middle of the picture, y up: points along its boundary first, then those inside, then those of
/// strokes.
///
/// Bonds are the sides of triangles, then braces, then those of strokes.
#[derive(Clone, Debug, PartialEq)]
pub struct Cutout {
    /// The mesh, in pixels.
    pub mesh: Arc<PictureMesh>,
    /// Height of the picture `[m]`.
    pub height: f64,
    /// Which points are bonded.
    pub pattern: Pattern,
}

/// Least share of the mean area that a point counts for: the corner of one small triangle would be so light that the springs
/// at it cut the substep of the whole body.
const LEAST_SHARE: f64 = 0.25;

/// Share of a braced body's stiffness that its braces bear. With a half, fewest triangles of a square that is thrown down stay folded;
/// with more, the sides are too weak.
const BRACED: f64 = 0.5;

/// Share of the material's stiffness that a brace has.
///
/// Model: in a triangular lattice springs k between neighbours, h apart, make Young's modulus 2/sqrt(3) k, and springs k' between
/// next neighbours, sqrt(3) h apart, of which there are as many, 2/sqrt(3) 3 k': both are isotropic with Poisson's ratio 1/3, so they
/// add. For k' to bear its part of k, it is a third of that.
const BRACE_SHARE: f64 = BRACED / 3.0;

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
        let scale = self.height / f64::from(mesh.picture[1]);
        let to_metres = in_metres(mesh.picture, self.height);
        let place = |&pixel: &[f64; 2]| embed(to_metres(pixel));
        let braces = match self.pattern {
            Pattern::Edges => Vec::new(),
            Pattern::Braced => mesh.braces(),
        };
        let mut body = Body {
            positions: mesh.points.iter().map(place).collect(),
            links: Vec::with_capacity(mesh.bonds.len() + braces.len()),
            weights: weights(&mesh.areas),
            area: scale * scale * mesh.areas.iter().sum::<f64>(),
            triangles: mesh.triangles.clone(),
            texture: mesh.texture.clone(),
            ..Body::default()
        };
        let (sides, ropes) = mesh.bonds.split_at(mesh.mesh_bonds);
        let mut link = |&[a, b]: &[u32; 2], share: f64| body.link_in_part(a, b, share);
        sides.iter().zip(side_shares(mesh, &braces)).for_each(|(side, share)| link(side, share));
        braces.iter().for_each(|brace| link(&brace.ends, BRACE_SHARE));
        ropes.iter().for_each(|rope| link(rope, 1.0));
        body
    }
}

/// From places of a picture `[px]`, y down, to the body's own `[m]`: about the middle of the picture, y up.
pub fn in_metres(picture: [u32; 2], height: f64) -> impl Fn([f64; 2]) -> [f64; 2] {
    let [columns, rows] = picture.map(f64::from);
    let scale = height / rows;
    move |[x, y]| [scale * (x - 0.5 * columns), scale * (0.5 * rows - y)]
}

/// The share of the material's stiffness that each side of a triangle has: half for each triangle that it belongs to, less what
/// braces across the triangle's sides bear of it. What a triangle at the boundary has no brace for, its sides bear.
fn side_shares(mesh: &PictureMesh, braces: &[Brace]) -> Vec<f64> {
    let mut left = vec![1.0; mesh.triangles.len()];
    braces.iter().flat_map(|brace| brace.triangles).for_each(|triangle| left[triangle as usize] -= BRACED / 3.0);
    let share = |pair: [Option<u32>; 2]| pair.into_iter().flatten().map(|triangle| 0.5 * left[triangle as usize]).sum();
    mesh.beside().into_iter().map(share).collect()
}

/// What points count for, by their areas.
fn weights(areas: &[f64]) -> Vec<f64> {
    let mean = areas.iter().sum::<f64>() / areas.len().max(1) as f64;
    areas.iter().map(|area| area.max(LEAST_SHARE * mean)).collect()
}
