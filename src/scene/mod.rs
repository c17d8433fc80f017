//! Scene files and the gallery.
//!
//! ```text
//! text --read--> Scene (keys, as said) --check--> in order --model--> sim::Model
//!                  |  \--expand--> Scene without bodies
//!                  \--write--> text
//! ```
//! [`Scene`] has the keys of the file as fields. Reading refuses what the file's form excludes, [`Scene::model`] what
//! this version cannot run; both say it in one line ([`SceneError`]).

mod add;
mod addition;
mod anew;
mod bending;
mod check;
mod error;
mod expand;
mod file;
mod fragment;
pub mod frames;
mod gallery;
mod keys;
mod keywords;
mod locate;
mod material;
mod model;
mod nearest;
mod obstacle;
mod of_picture;
mod one_line;
mod parameter;
mod pictures;
mod read;
pub mod record;
pub(crate) mod room;
mod schema;
mod skin;
mod start;
mod strokes;
mod support;
mod tint;
mod write;
mod young;

pub(crate) use addition::{Known, Made, Shape};
pub use anew::Cut;
pub(crate) use bending::{Bend, bends_along, share_of, stiffness_of};
pub(crate) use check::MOST_BESIDE;
pub use error::{SceneError, SceneErrorKind, Source};
pub use fragment::Fragment;
pub use gallery::{EMPTY, Entry, gallery};
pub(crate) use keys::macros::object;
pub use keys::{
    AddKeys, AngleKeys, AreaKeys, AreaKindName, BesideKeys, BodyKeys, BondKeys, BondList, BoundsKeys, BoxKeys,
    BraceName, BudgetKeys, CircleKeys, ColorKey, ContactKeys, DiagonalsName, DrawnKeys, DriveKeys, ForceKeys, KeyName,
    KindName, LabelKeys, LimitName, LookKeys, MakerName, MassKeys, Material, Meeting, MethodKeys, MouseKeys,
    ObstacleKeys, OrderName, ParameterKeys, PatternName, PenaltyKeys, PictureKeys, PinMotionKeys, PlaneKeys,
    PointGroupKeys, PointKeys, PrecisionName, ProfileName, RegionName, RepeatKeys, RotationKeys, Row, Scene, SkinKeys,
    SolverName, SourceName, StrokesName, TextureKeys, Vector, Version, ViewKeys, WindKeys,
};
pub(crate) use keys::{ObjectOnly, present};
pub use keywords::{keywords, topic_place};
pub(crate) use nearest::nearest;
pub use of_picture::Matter;
pub(crate) use of_picture::{MOST_BENT, MOST_MEETING};
pub(crate) use one_line::one_line;
pub use parameter::{BodyPart, OfBody, OfPenalty, Parameter, Target};
pub(crate) use pictures::picture_as_text;
pub(crate) use read::translate;
pub use schema::schema;
pub(crate) use support::LATER;
pub(crate) use young::{stiffness_of_young, young_of_stiffness};
