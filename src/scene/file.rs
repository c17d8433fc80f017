//! The scene file, version 1: its keys as they are written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::maker::BodyFile;
use super::numbers::{Masses, Vector};

/// A scene file. Vectors have two numbers, in space three; metres, seconds, kilograms, radians; y is up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "wobble scene")]
pub struct SceneFile {
    /// Version of the format: 1.
    pub wobble: u32,
    /// Name of the scene.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Words to find it by.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tags: Vec<String>,
    /// 2 in the plane, 3 in space.
    #[serde(default = "two", skip_serializing_if = "is_two")]
    pub dimensions: u32,
    /// Points listed one by one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<PointsFile>,
    /// Bonds listed one by one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bonds: Vec<BondFile>,
    /// Bodies, appended in order after the listed points and bonds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<BodyFile>,
    /// Triangles between points.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub triangles: Vec<[u32; 3]>,
    /// How triangles resist a change of area.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub areas: Option<AreasFile>,
    /// The picture on the triangles.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<TextureFile>,
    /// Gravity [m/s^2]; zero if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<Vector>,
    /// Rate at which velocities decay [1/s].
    #[serde(default, skip_serializing_if = "is_zero")]
    pub drag_rate: f64,
    /// Wind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wind: Option<WindFile>,
    /// The force around the cursor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mouse: Option<MouseFile>,
    /// Where pinned points go.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pin_motion: Vec<PinMotionFile>,
    /// Walls around the world.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bounds: Option<BoundsFile>,
    /// Things in the way.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub obstacles: Vec<ObstacleFile>,
    /// How the motion is computed.
    #[serde(default, skip_serializing_if = "is_default")]
    pub method: MethodFile,
    /// Seconds of the scene a second of wall time.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub rate: f64,
    /// When the motion ends [s]; endless if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub duration: Option<f64>,
    /// Times to sample at [s], ascending; the duration if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub samples: Option<Vec<f64>>,
    /// Where the camera starts; fits the scene if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<ViewFile>,
}

/// Points listed one by one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointsFile {
    /// Positions [m].
    pub position: Vec<Vector>,
    /// Velocities [m/s]; zero if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<Vec<Vector>>,
    /// Masses [kg], or one mass for all; 1 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<Masses>,
    /// Indices of the points that never move.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pinned: Vec<u32>,
}

/// How a bond resists.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum KindFile {
    /// Keeps its length.
    #[default]
    Rigid,
    /// A force.
    Spring,
    /// Swept by the relaxation method.
    Relaxed,
}

/// On which side of its rest length a bond acts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LimitFile {
    /// Always.
    #[default]
    Both,
    /// Only when longer.
    Max,
    /// Only when shorter.
    Min,
}

/// A bond.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BondFile {
    /// One end.
    pub a: u32,
    /// The other end.
    pub b: u32,
    /// How it resists.
    #[serde(default)]
    pub kind: KindFile,
    /// Rest length [m]; the distance at the start if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest: Option<f64>,
    /// Stiffness of a spring [N/m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<f64>,
    /// 1/stiffness [m/N].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compliance: Option<f64>,
    /// Damping of a spring along the bond [N s/m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<f64>,
    /// Relaxation of a relaxed bond [1].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relaxation: Option<f64>,
    /// Largest correction of a relaxed bond in one sweep [1].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_correction: Option<f64>,
    /// Strain at which it breaks [1].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub break_strain: Option<f64>,
    /// On which side of its rest length it acts.
    #[serde(default, skip_serializing_if = "is_default")]
    pub limit: LimitFile,
}

/// How triangles resist a change of area.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AreasFile {
    /// Rigid or spring.
    #[serde(default)]
    pub kind: KindFile,
    /// Stiffness [N/m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<f64>,
}

/// The picture on the triangles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TextureFile {
    /// A relative path, or the picture itself as a data URL.
    pub image: String,
    /// Texture coordinates, one a point.
    pub uv: Vec<[f64; 2]>,
}

/// Wind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WindFile {
    /// Velocity [m/s].
    pub velocity: Vector,
    /// Turbulence [1].
    #[serde(default)]
    pub turbulence: f64,
    /// Seed of the gusts.
    #[serde(default)]
    pub seed: u64,
}

/// Shape of the region that the mouse force acts in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum RegionFile {
    /// Within the radius.
    #[default]
    Round,
    /// Within the radius along either axis; in the plane only.
    Square,
}

/// How the mouse force falls off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ProfileFile {
    /// Smoothly to zero at the edge.
    #[default]
    Smooth,
    /// Not at all, up to the edge.
    Linear,
}

/// The force around the cursor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MouseFile {
    /// Strength [1/s^2]: positive repels.
    pub strength: f64,
    /// Radius [m].
    pub radius: f64,
    /// Shape of the region.
    #[serde(default, skip_serializing_if = "is_default")]
    pub region: RegionFile,
    /// Fall-off.
    #[serde(default, skip_serializing_if = "is_default")]
    pub profile: ProfileFile,
    /// Where the cursor goes by itself: [t, x, y], times ascending. The live cursor if left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub track: Vec<[f64; 3]>,
}

/// Where a pinned point goes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PinMotionFile {
    /// The point; it must be pinned.
    pub point: u32,
    /// [t, x, y] (in space [t, x, y, z]), times ascending.
    pub track: Vec<Vec<f64>>,
}

/// Walls around the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoundsFile {
    /// Lower corner [m].
    pub min: Vector,
    /// Upper corner [m].
    pub max: Vector,
    /// Restitution [1].
    #[serde(default, skip_serializing_if = "is_zero")]
    pub restitution: f64,
    /// Friction [1].
    #[serde(default, skip_serializing_if = "is_zero")]
    pub friction: f64,
}

/// Something in the way: exactly one shape.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ObstacleFile {
    /// A half-space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plane: Option<PlaneFile>,
    /// A box.
    #[serde(default, rename = "box", skip_serializing_if = "Option::is_none")]
    pub block: Option<BlockFile>,
    /// A circle, a ball in space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub circle: Option<CircleFile>,
    /// A polygon with holes: the outline, then the holes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub polygon: Option<Vec<Vec<[f64; 2]>>>,
    /// Restitution [1].
    #[serde(default, skip_serializing_if = "is_zero")]
    pub restitution: f64,
    /// Friction [1].
    #[serde(default, skip_serializing_if = "is_zero")]
    pub friction: f64,
}

/// A half-space: free where the normal points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneFile {
    /// A point of the plane [m].
    pub point: Vector,
    /// Its normal, of any length but zero.
    pub normal: Vector,
}

/// A box, turned about its centre.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BlockFile {
    /// Lower corner [m].
    pub min: Vector,
    /// Upper corner [m].
    pub max: Vector,
    /// Angle [rad]; in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
    /// Rotation; in space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<RotationFile>,
}

/// A rotation about an axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RotationFile {
    /// The axis, of any length but zero.
    pub axis: [f64; 3],
    /// The angle [rad].
    pub angle: f64,
}

/// A circle, a ball in space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CircleFile {
    /// Centre [m].
    pub center: Vector,
    /// Radius [m].
    pub radius: f64,
}

/// Order of the bonds in a sweep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum OrderFile {
    /// Coloured.
    #[default]
    Auto,
    /// As listed.
    Fixed,
    /// As listed and backwards in turn.
    Symmetric,
    /// By colours.
    Coloured,
    /// Shuffled for every sweep.
    Shuffled,
}

/// Scalar of the world.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum PrecisionFile {
    /// By size.
    #[default]
    Auto,
    /// 32 bits.
    F32,
    /// 64 bits.
    F64,
}

/// How the motion is computed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MethodFile {
    /// Name of the solver; `auto` if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solver: Option<String>,
    /// Longest substep [s].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub substep: Option<f64>,
    /// Sweeps in a substep.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub iterations: Option<u32>,
    /// Order of the bonds in a sweep.
    #[serde(default, skip_serializing_if = "is_default")]
    pub order: OrderFile,
    /// Seed of the shuffles.
    #[serde(default, skip_serializing_if = "is_default")]
    pub seed: u64,
    /// Scalar of the world.
    #[serde(default, skip_serializing_if = "is_default")]
    pub precision: PrecisionFile,
    /// Largest error asked for [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Largest strain asked for [1].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_strain: Option<f64>,
}

/// Where the camera starts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ViewFile {
    /// Middle of the picture [m]; in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub center: Option<[f64; 2]>,
    /// Height of the picture [m]; in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
    /// What the camera looks at [m]; in space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<[f64; 3]>,
    /// Its distance from there [m]; in space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    /// Its angle about the vertical [rad]; in space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yaw: Option<f64>,
    /// Its angle above the level [rad]; in space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitch: Option<f64>,
}

pub(super) fn two() -> u32 {
    2
}

fn is_two(value: &u32) -> bool {
    *value == 2
}

fn one() -> f64 {
    1.0
}

fn is_one(value: &f64) -> bool {
    *value == 1.0
}

pub(super) fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

pub(super) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}
