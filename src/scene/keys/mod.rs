//! The keys of the scene file as types: what may stand where. Their ranges are held by `check`.

mod addition;
mod beside;
mod body;
mod bond;
mod bonds;
mod budget;
mod color;
mod contact;
mod drive;
pub(crate) mod macros;
mod method;
mod scene;
mod strict;
mod surroundings;
mod vector;
mod view;

pub use addition::{AddKeys, DrawnKeys, LookKeys};
pub use beside::BesideKeys;
pub use body::{BodyKeys, BraceName, DiagonalsName, MakerName, Material, PatternName, RepeatKeys, StrokesName};
pub use bond::{BondKeys, KindName, LimitName};
pub use bonds::BondList;
pub use budget::BudgetKeys;
pub use color::ColorKey;
pub use contact::{ContactKeys, Meeting, SkinKeys};
pub use drive::{DriveKeys, KeyName};
pub use method::{MethodKeys, OrderName, PrecisionName, SolverName, SourceName};
pub use scene::{
    AngleKeys, AreaKeys, AreaKindName, LabelKeys, MassKeys, ParameterKeys, PointGroupKeys, PointKeys, Scene,
    TextureKeys, Version,
};
pub use surroundings::{
    BoundsKeys, BoxKeys, CircleKeys, ForceKeys, MouseKeys, ObstacleKeys, PenaltyKeys, PictureKeys, PinMotionKeys,
    PlaneKeys, ProfileName, RegionName, RotationKeys, WindKeys,
};
pub use vector::{Row, Vector};
pub use view::ViewKeys;

pub(crate) use strict::{Name, ObjectOnly, present};
