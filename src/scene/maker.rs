//! Bodies in a scene file: which maker, its parameters, where it stands and what it is made of.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::Problem;
use super::file::{KindFile, is_default, is_zero};
use super::numbers::Vector;
use crate::body::{
    Body, BodyError, Bracing, Cloth, Diagonals, Frame, Lattice, RandomGraph, Rim, Rope, ScatteredPoints,
};

/// A body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BodyFile {
    /// The maker and its parameters.
    #[serde(flatten)]
    pub make: MakerFile,
    /// Where its origin stands [m]; the world's origin if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub origin: Option<Vector>,
    /// Angle that it is turned by about its origin, in space about z [rad].
    #[serde(default, skip_serializing_if = "is_zero")]
    pub angle: f64,
    /// Velocity [m/s]; zero if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<Vector>,
    /// Angular velocity about its origin, in space about z [rad/s].
    #[serde(default, skip_serializing_if = "is_zero")]
    pub spin: f64,
    /// What it is made of.
    #[serde(default, skip_serializing_if = "is_default")]
    pub material: MaterialFile,
    /// Its points that never move, counted within the body.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pinned: Vec<u32>,
}

/// What a body is made of: its bonds and its mass.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MaterialFile {
    /// How its bonds resist.
    #[serde(default)]
    pub kind: KindFile,
    /// Stiffness of springs [N/m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<f64>,
    /// 1/stiffness [m/N].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compliance: Option<f64>,
    /// Damping of springs [N s/m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<f64>,
    /// Relaxation of relaxed bonds [1].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relaxation: Option<f64>,
    /// Largest correction of relaxed bonds in one sweep [1].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_correction: Option<f64>,
    /// Strain at which bonds break [1].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub break_strain: Option<f64>,
    /// Mass of the body [kg], shared among its points by length or area.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<f64>,
    /// Mass of each point [kg]; 1 if neither is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point_mass: Option<f64>,
}

/// The makers of bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "make", rename_all = "kebab-case")]
pub enum MakerFile {
    /// Points drawn at random.
    Points(PointsMaker),
    /// Points and bonds drawn at random.
    RandomGraph(RandomGraphMaker),
    /// Two rings.
    Rim(RimMaker),
    /// Four corners.
    Box(BoxMaker),
    /// A row.
    Rope(RopeMaker),
    /// A grid, first row at the top.
    Cloth(ClothMaker),
    /// A braced block.
    Lattice(LatticeMaker),
    /// A meshed disc.
    Disc(DiscMaker),
    /// A mesh made from a picture.
    Picture(PictureMaker),
    /// A figure.
    Ragdoll(RagdollMaker),
}

macro_rules! parameters {
    ($($(#[$doc:meta])* $name:ident { $($(#[$field_meta:meta])* $field:ident: $type:ty,)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub struct $name { $($(#[$field_meta])* pub $field: $type,)* }
    )*};
}

parameters! {
    /// Parameters of `points`.
    PointsMaker {
        /// How many.
        count: u64,
        /// Lower corner [m].
        min: Vector,
        /// Upper corner [m].
        max: Vector,
        /// Seed.
        #[serde(default)]
        seed: u64,
    }
    /// Parameters of `random-graph`.
    RandomGraphMaker {
        /// How many points.
        count: u64,
        /// How many bonds.
        bonds: u64,
        /// Lower corner [m].
        min: Vector,
        /// Upper corner [m].
        max: Vector,
        /// Seed.
        #[serde(default)]
        seed: u64,
    }
    /// Parameters of `rim`.
    RimMaker {
        /// Radius of the outer ring [m].
        #[serde(default = "radius")]
        radius: f64,
        /// Radius of the inner ring [m].
        #[serde(default = "inner_radius")]
        inner_radius: f64,
        /// Points on each ring.
        #[serde(default = "sectors")]
        sectors: u64,
        /// Which bonds there are.
        #[serde(default = "bracing")]
        bracing: Vec<Bracing>,
    }
    /// Parameters of `box`.
    BoxMaker {
        /// Width [m].
        width: f64,
        /// Height [m].
        height: f64,
        /// Diagonals: 0, 1 or 2.
        #[serde(default = "supports")]
        supports: u64,
    }
    /// Parameters of `rope`: `spacing` or `to`.
    RopeMaker {
        /// How many points.
        count: u64,
        /// Distance between neighbours [m]; the rope lies along x.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        spacing: Option<f64>,
        /// Where the last point is, seen from the first [m].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        to: Option<Vector>,
    }
    /// Parameters of `cloth`.
    ClothMaker {
        /// Points in a row.
        columns: u64,
        /// Points in a column.
        rows: u64,
        /// Distance between neighbours [m].
        spacing: f64,
        /// Which diagonals there are.
        #[serde(default)]
        diagonals: Diagonals,
        /// Direction of a row, of any length but zero; in space.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        u: Option<[f64; 3]>,
        /// Direction from row to row, of any length but zero; in space.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        v: Option<[f64; 3]>,
    }
    /// Parameters of `lattice`.
    LatticeMaker {
        /// Points in a row.
        columns: u64,
        /// Points in a column.
        rows: u64,
        /// Distance between neighbours [m].
        spacing: f64,
    }
    /// Parameters of `disc`.
    DiscMaker {
        /// Radius [m].
        radius: f64,
        /// Distance between neighbours [m].
        spacing: f64,
    }
    /// Parameters of `picture`.
    PictureMaker {
        /// The picture.
        file: String,
        /// Distance between neighbours [px].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        spacing: Option<f64>,
        /// What counts as ink [1].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        threshold: Option<f64>,
    }
    /// Parameters of `ragdoll`.
    RagdollMaker {
        /// Height [m].
        #[serde(default = "height")]
        height: f64,
    }
}

fn radius() -> f64 {
    2.0
}
fn inner_radius() -> f64 {
    1.8
}
fn sectors() -> u64 {
    12
}
fn bracing() -> Vec<Bracing> {
    vec![Bracing::Outer, Bracing::Inner, Bracing::Spoke, Bracing::Rising]
}
fn supports() -> u64 {
    1
}
fn height() -> f64 {
    1.7
}

impl From<BodyError> for Problem {
    fn from(error: BodyError) -> Self {
        Problem::new(error.key, error.problem)
    }
}

impl MakerFile {
    /// The body in its own frame, for a scene in `dimensions`.
    pub(crate) fn make(&self, dimensions: usize) -> Result<Body, Problem> {
        match self {
            MakerFile::Points(p) => Ok(scattered(p.count, &p.min, &p.max, p.seed, dimensions)?.make()?),
            MakerFile::RandomGraph(p) => {
                let points = scattered(p.count, &p.min, &p.max, p.seed, dimensions)?;
                Ok(RandomGraph { points, bonds: p.bonds }.make()?)
            }
            MakerFile::Rim(p) => Ok(Rim {
                radius: p.radius,
                inner_radius: p.inner_radius,
                sectors: p.sectors,
                bracing: p.bracing.clone(),
            }
            .make()?),
            MakerFile::Box(p) => Ok(Frame { width: p.width, height: p.height, supports: p.supports }.make()?),
            MakerFile::Rope(p) => p.make(dimensions),
            MakerFile::Cloth(p) => p.make(dimensions),
            MakerFile::Lattice(p) => Ok(Lattice { columns: p.columns, rows: p.rows, spacing: p.spacing }.make()?),
            MakerFile::Disc(_) => Err(absent("disc")),
            MakerFile::Picture(_) => Err(absent("picture")),
            MakerFile::Ragdoll(_) => Err(absent("ragdoll")),
        }
    }
}

fn absent(maker: &str) -> Problem {
    let problem =
        format!("`{maker}` is not in this version: use points, random-graph, rim, box, rope, cloth or lattice");
    Problem::new("make", problem)
}

fn scattered(count: u64, min: &Vector, max: &Vector, seed: u64, dimensions: usize) -> Result<ScatteredPoints, Problem> {
    let min = min.components(dimensions).map_err(|problem| problem.within("min"))?;
    let max = max.components(dimensions).map_err(|problem| problem.within("max"))?;
    Ok(ScatteredPoints { count, min, max, seed })
}

impl RopeMaker {
    fn make(&self, dimensions: usize) -> Result<Body, Problem> {
        let step = match (self.spacing, &self.to) {
            (Some(spacing), None) if spacing > 0.0 => [spacing, 0.0, 0.0],
            (Some(spacing), None) => {
                return Err(Problem::new("spacing", format!("{spacing} is no length: give a number above 0")));
            }
            (None, Some(to)) => {
                let links = self.count.saturating_sub(1).max(1) as f64;
                to.components(dimensions).map_err(|problem| problem.within("to"))?.map(|c| c / links)
            }
            (None, None) => return Err(Problem::new("", "a rope needs `spacing` or `to`: give one")),
            (Some(_), Some(_)) => return Err(Problem::new("to", "excludes `spacing`: give one of them")),
        };
        Ok(Rope { count: self.count, step }.make()?)
    }
}

impl ClothMaker {
    fn make(&self, dimensions: usize) -> Result<Body, Problem> {
        if dimensions == 2 && (self.u.is_some() || self.v.is_some()) {
            let key = if self.u.is_some() { "u" } else { "v" };
            return Err(Problem::new(key, "a cloth in the plane has no axes: leave it out, or set dimensions to 3"));
        }
        Ok(Cloth {
            columns: self.columns,
            rows: self.rows,
            spacing: self.spacing,
            diagonals: self.diagonals,
            u: unit("u", self.u.unwrap_or([1.0, 0.0, 0.0]))?,
            v: unit("v", self.v.unwrap_or([0.0, -1.0, 0.0]))?,
        }
        .make()?)
    }
}

fn unit(key: &str, axis: [f64; 3]) -> Result<[f64; 3], Problem> {
    let length = crate::body::distance(axis, [0.0; 3]);
    if length > 0.0 && length.is_finite() {
        return Ok(axis.map(|c| c / length));
    }
    Err(Problem::new(key, "has no direction: give a vector that is not zero"))
}
