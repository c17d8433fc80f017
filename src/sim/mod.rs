//! The world and its step. Nothing here knows of files, windows or clocks.

pub mod bond;
pub mod command;
pub(crate) mod constrain;
pub mod contact;
pub mod counters;
pub mod dynamics;
pub mod force;
pub(crate) mod integrate;
pub(crate) mod measure;
pub mod model;
pub(crate) mod plan;
pub(crate) mod points;
pub mod real;
pub mod sleep;
mod step;
pub(crate) mod timeline;
pub mod vector;
pub mod world;

pub use bond::{Bond, BondId, BondKind, Limit, PointId};
pub use command::Command;
pub use contact::bounds::Bounds;
pub use counters::Counters;
pub use dynamics::{Dynamics, Positions, Sample};
pub use force::mouse::{Cursor, MouseForce, Profile, Region, Track};
pub use model::{Method, Model, ModelError, Order, Precision, Solver};
pub use real::Real;
pub use sleep::Sleep;
pub use world::{World, build};
