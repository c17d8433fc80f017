//! Drawing points and bonds on a GPU, in a window or off-screen.
//!
//! Shaders pull positions from the buffer that the simulation fills, and bonds from one that changes with the topology
//! only; edges are anti-aliased by their signed distance. Of large scenes only what is in view is drawn, and where bonds
//! are too short to be told apart, fewer stand for all. Nothing here steps a world.

mod buffers;
pub mod camera;
mod capture;
mod chunks;
mod counters;
mod cover;
mod detail;
mod ensemble;
mod error;
mod fills;
mod floor;
mod forms;
mod frame;
mod gpu;
mod gpu_bond;
mod growing;
mod guides;
mod kept;
mod look;
mod notch;
mod numerals;
mod obstacles;
mod order;
mod own;
mod passes;
mod places;
mod quads;
mod renderer;
mod seen_forms;
mod sight;
mod skin;
mod tiles;
mod trails;
mod veil;
pub mod view;
mod watched;

pub use camera::{Camera, Pose};
pub use capture::Capture;
pub use counters::RenderCounters;
pub use ensemble::{Ensemble, Pane};
pub use error::RenderError;
pub use fills::{body_color, color_of as palette_color};
pub(crate) use floor::level as level_floor;
pub use gpu::{Gpu, backends};
pub use look::{Color, Look, Overlay, Palette, STRAIN_COLORS, contrast, in_bytes};
pub use passes::SHADERS;
pub use renderer::Renderer;
pub use tiles::Tiles;
pub use trails::Trails;
pub use view::{Hinge, View, Ways, joints};
