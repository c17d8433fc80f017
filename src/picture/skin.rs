//! A picture on the triangles of a body.

use std::sync::Arc;

use super::Picture;

/// What is drawn on some triangles of a world.
#[derive(Clone, Debug, PartialEq)]
pub struct Skin {
    /// The picture.
    pub picture: Arc<Picture>,
    /// The point that the first entry of `texture` is of.
    pub first: u32,
    /// Corners of triangles, by the points of the world; each has an entry in `texture`.
    pub triangles: Vec<[u32; 3]>,
    /// Where points lie in the picture, (0, 0) to (1, 1) from the upper left.
    pub texture: Vec<[f32; 2]>,
}
