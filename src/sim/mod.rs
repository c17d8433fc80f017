//! The world and its step. Nothing here knows of files, windows or clocks.

pub mod bond;
pub mod command;
pub mod contact;
pub mod counters;
pub mod dynamics;
pub mod force;
pub mod model;
pub mod real;
pub mod vector;

pub use bond::{Bond, BondId, BondKind, Limit, PointId};
pub use command::Command;
pub use contact::bounds::Bounds;
pub use counters::Counters;
pub use dynamics::{Dynamics, Positions, Sample};
pub use force::mouse::{Cursor, MouseForce, Profile, Region, Track};
pub use model::{Method, Model, Order, Precision, Solver};
pub use real::Real;
