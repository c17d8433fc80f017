//! Polygons that points cannot enter.

mod cut;
mod grid;
mod outline;
pub(crate) mod round;
pub(crate) mod solids;
#[cfg(test)]
mod tests;

pub(crate) use cut::TooManyCrossings;

/// What lies inside its outlines by the even-odd rule is solid, in the plane.
///
/// Valid range: three corners or more in each outline, all finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// Outlines and holes, in any direction; the last corner is joined to the first `[m]`.
    pub loops: Vec<Vec<[f64; 2]>>,
    /// v_n -> -restitution v_n on touching `[1]`, >= 0.
    pub restitution: f64,
    /// |change of v_t| <= friction |change of v_n| `[1]`, >= 0.
    pub friction: f64,
}

/// From one corner to the next `[m]`.
type Segment = [[f64; 2]; 2];

/// One side: a segment with the solid on its right.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Side {
    ends: Segment,
    /// Which polygon it is of.
    polygon: u32,
}
