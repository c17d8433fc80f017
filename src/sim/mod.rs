//! The world and its step. Nothing here knows of files, windows or clocks.

pub(crate) mod account;
pub mod bond;
pub mod bonds;
pub(crate) mod build;
pub(crate) mod bulk;
pub(crate) mod colour;
pub mod command;
pub(crate) mod constrain;
pub mod contact;
pub mod counters;
pub mod drive;
pub mod dynamics;
mod edit;
pub(crate) mod environment;
pub mod force;
pub(crate) mod group;
mod handover;
pub(crate) mod integrate;
pub(crate) mod kernels;
pub mod ledger;
pub(crate) mod live;
pub(crate) mod measure;
pub mod model;
mod moved;
pub(crate) mod plan;
mod plan_part;
pub(crate) mod points;
pub(crate) mod pull;
pub mod real;
pub(crate) mod rigid;
mod saved;
pub(crate) mod sets;
pub(crate) mod shared;
pub(crate) mod solve;
pub mod solver;
mod step;
pub(crate) mod swept;
pub(crate) mod threads;
pub(crate) mod timeline;
pub(crate) mod triangles;
pub mod vector;
pub mod world;

pub use bond::{Bond, BondId, BondKind, Limit, PointId};
pub use bonds::Bonds;
pub use build::build;
pub use command::{
    Addition, AngleChange, Applied, BondChange, BoundsChange, Change, Command, CommandError, Kind, Knots, Motion,
    MouseChange, Obstacle, Reach, SceneChange, Selection, Values,
};
pub use contact::bounds::Bounds;
pub use contact::convex::{BOX_EDGES, Convex, Figure, Frame};
pub use contact::polygon::Polygon;
pub use contact::skin::{Contact, SkinMaterial, SkinMaterials};
pub use contact::surface::Plane;
pub use counters::Counters;
pub use drive::{AngleDrive, Drive, Held, Key, Keys, Ramp, Signal, Wave};
pub use dynamics::{Dynamics, ForceView, GrabView, Sample};
pub use force::angle::{Angle, Angles};
pub use force::area::Areas;
pub use force::mouse::{Cursor, MouseForce, Profile, Region, Track};
pub use force::steady::Force;
pub use force::wind::Wind;
pub use kernels::level::InstructionSet;
pub use ledger::{Book, Energies, Ledger, MOST_GAIN, MOST_LOSS, Verdict, judge};
pub use model::{MOST_ITERATIONS, Method, Model, ModelError, angle_at};
pub use moved::{HandedOver, MovedBy, Why};
pub use plan_part::PlanPart;
pub use real::{Positions, Precision, Real};
pub use saved::{Saved, SavedWorld};
pub use solver::{Order, Solver};
pub use threads::{ThreadsInUse, shared_passes, use_threads};
pub use timeline::frame_of;
pub use triangles::borne;
#[cfg(test)]
pub(crate) use world::World;
pub use world::saved::resume;
