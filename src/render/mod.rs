//! Drawing points and bonds on a GPU, in a window or off-screen.
//!
//! Shaders pull positions from the buffer that the simulation fills, and bonds from one that changes with the topology
//! only; edges are anti-aliased by their signed distance. Nothing here steps a world.

mod buffers;
pub mod camera;
mod capture;
mod error;
mod frame;
mod gpu;
mod guides;
mod look;
mod passes;
mod renderer;
pub mod view;

pub use buffers::RenderCounters;
pub use camera::{Camera, Pose};
pub use capture::Capture;
pub use error::RenderError;
pub use gpu::{Gpu, backends};
pub use look::{Color, Look, Overlay};
pub use passes::SHADERS;
pub use renderer::Renderer;
pub use view::View;
