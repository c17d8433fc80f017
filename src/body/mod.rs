//! Makers of points and bonds: each turns a few parameters into a [`Body`] about its own origin.
//!
//! | maker | its own origin |
//! |---|---|
//! | [`Points`], [`RandomGraph`] | the one that `min` and `max` count from |
//! | [`Rim`], [`BoxFrame`], [`Disc`], [`Cutout`] | the centre, of a cutout that of its picture |
//! | [`Rope`], [`Cloth`], [`Lattice`] | the first point |
//! | [`Ragdoll`] | the hip |
//!
//! [`Placement`] moves a body into the world. Every maker checks its parameters before it makes anything, and says how
//! many points there will be. Sines and cosines come from `libm`, so that a body has the same bits on every machine.

mod box_frame;
mod cloth;
mod cutout;
mod disc;
pub(crate) mod draw;
mod grid;
mod lattice;
mod place;
mod points;
mod ragdoll;
mod random_graph;
mod rim;
mod rope;

pub use box_frame::BoxFrame;
pub use cloth::{Cloth, Diagonals};
pub use cutout::{Cutout, Pattern, in_metres};
pub use disc::Disc;
pub use lattice::Lattice;
pub use place::{Placement, turned};
pub use points::Points;
pub use ragdoll::Ragdoll;
pub use random_graph::RandomGraph;
pub use rim::{Brace, Rim};
pub use rope::{Rope, Stretch, hanging};

/// Most points that one body may have: enough for a cloth of 4,000 by 4,000; beyond, a mistyped count would only fill
/// the memory.
pub const MAX_POINTS: u64 = 20_000_000;

/// Most bonds that one body may have: five for each of [`MAX_POINTS`], more than any grid makes.
pub const MAX_BONDS: u64 = 100_000_000;

/// Points and bonds about their own origin, not yet placed.
///
/// Shapes: `weights` has one entry a point; `links` hold indices below their number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// Positions `[m]`; z = 0 for what lies in the plane.
    pub positions: Vec<[f64; 3]>,
    /// The bonds, in the maker's order.
    pub links: Vec<Link>,
    /// Each point's share of the body's mass, up to a common factor: by length, by area, or all equal `[1]`, > 0.
    pub weights: Vec<f64>,
    /// Area that it covers `[m^2]`: its triangles, and its strokes by length and width; 0 of what has neither.
    pub area: f64,
    /// Corners of the triangles that it covers, anticlockwise; none of what is made of lines.
    pub triangles: Vec<[u32; 3]>,
    /// Its joints; none of what is in one piece.
    pub joints: Vec<Joint>,
    /// Where each point lies in the picture of the skin, (0, 0) to (1, 1) from the upper left; empty without one.
    pub texture: Vec<[f32; 2]>,
}

/// A bond of a body, without what it is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// One end, counted within the body.
    pub a: u32,
    /// The other end.
    pub b: u32,
    /// Distance of the ends as made `[m]`.
    pub rest_length: f64,
    /// Share of the material's stiffness and damping that it has, if it is a spring `[1]`: 1, but in a picture's mesh 1/2 for
    /// sides at the edge, which belong to one triangle where others belong to two, and less for braces and what is braced.
    pub share: f64,
}

/// An angle of a body that has stops, and no stiffness between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// At the second point, from the arm to the first to the arm to the third, anticlockwise; counted within the body.
    pub points: [u32; 3],
    /// The least angle and the largest `[rad]`.
    pub range: [f64; 2],
}

impl Body {
    /// Bonds the points `a` and `b` at their present distance.
    fn link(&mut self, a: u32, b: u32) {
        self.link_in_part(a, b, 1.0);
    }

    /// The same with a share of the material's stiffness.
    fn link_in_part(&mut self, a: u32, b: u32, share: f64) {
        let rest_length = distance(self.positions[a as usize], self.positions[b as usize]);
        self.links.push(Link { a, b, rest_length, share });
    }

    /// Covers a quadrilateral by two triangles: corners anticlockwise, cut from the first one to the third.
    fn cover(&mut self, [a, b, c, d]: [u32; 4]) {
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// Masses `[kg]` that add up to `total`, shared by the weights.
    pub fn masses(&self, total: f64) -> Vec<f64> {
        let sum: f64 = self.weights.iter().sum();
        self.weights.iter().map(|w| total * (w / sum)).collect()
    }
}

/// Distance of two points `[m]`.
pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    crate::sim::vector::length(crate::sim::vector::sub(a, b))
}

/// A parameter that no body can be made with.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {message}")]
pub struct BodyError {
    /// The parameter, by its name in a scene file.
    pub key: &'static str,
    /// What is wrong with it and what to do.
    pub message: String,
}

impl BodyError {
    fn new(key: &'static str, message: impl Into<String>) -> Self {
        BodyError { key, message: message.into() }
    }
}

/// A maker with its parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum Maker {
    /// Loose points.
    Points(Points),
    /// Points with random bonds.
    RandomGraph(RandomGraph),
    /// Two rings with bracing between them.
    Rim(Rim),
    /// A rectangle of four points.
    Box(BoxFrame),
    /// A row of points.
    Rope(Rope),
    /// A hanging grid.
    Cloth(Cloth),
    /// A standing grid.
    Lattice(Lattice),
    /// A mesh of triangles.
    Disc(Disc),
    /// A picture's mesh.
    Cutout(Cutout),
    /// A figure.
    Ragdoll(Ragdoll),
}

impl Maker {
    /// How many points it makes.
    ///
    /// Errors: the first parameter that is out of its range.
    pub fn point_count(&self) -> Result<u32, BodyError> {
        match self {
            Maker::Points(maker) => maker.point_count(),
            Maker::RandomGraph(maker) => maker.point_count(),
            Maker::Rim(maker) => maker.point_count(),
            Maker::Box(maker) => maker.point_count(),
            Maker::Rope(maker) => maker.point_count(),
            Maker::Cloth(maker) => maker.point_count(),
            Maker::Lattice(maker) => maker.point_count(),
            Maker::Disc(maker) => maker.point_count(),
            Maker::Cutout(maker) => maker.point_count(),
            Maker::Ragdoll(maker) => maker.point_count(),
        }
    }

    /// Makes the body; the same parameters yield the same bits.
    ///
    /// Errors: those of [`Maker::point_count`], and positions too large for a number.
    pub fn make(&self) -> Result<Body, BodyError> {
        self.point_count()?;
        let body = match self {
            Maker::Points(maker) => maker.make(),
            Maker::RandomGraph(maker) => maker.make(),
            Maker::Rim(maker) => maker.make(),
            Maker::Box(maker) => maker.make(),
            Maker::Rope(maker) => maker.make(),
            Maker::Cloth(maker) => maker.make(),
            Maker::Lattice(maker) => maker.make(),
            Maker::Disc(maker) => maker.make()?,
            Maker::Cutout(maker) => maker.make(),
            Maker::Ragdoll(maker) => maker.make(),
        };
        let finite = body.positions.iter().flatten().all(|x| x.is_finite())
            && body.links.iter().all(|link| link.rest_length.is_finite());
        if finite {
            Ok(body)
        } else {
            Err(BodyError::new("make", "the body is too large for a number: make it smaller"))
        }
    }
}

/// A count of points, at least `least` and at most [`MAX_POINTS`].
fn count(key: &'static str, value: u64, least: u64) -> Result<u32, BodyError> {
    match u32::try_from(value) {
        Ok(count) if (least..=MAX_POINTS).contains(&value) => Ok(count),
        _ => Err(BodyError::new(key, format!("is {value}: give a number from {least} to {MAX_POINTS}"))),
    }
}

/// A length that must be finite and positive.
fn length(key: &'static str, value: f64) -> Result<(), BodyError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(BodyError::new(key, format!("is {value:?}: give a finite number above 0")))
    }
}
