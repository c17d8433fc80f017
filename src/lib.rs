//! **wobble**: a soft-body sandbox in the plane, with space as a guest.
//!
//! Points and bonds are moved by Verlet's method and others; forces, walls and the mouse act on them. Metres, kilograms,
//! seconds and radians throughout; y is up. The library simulates, makes bodies and measures without a GPU or a window;
//! drawing and the program stand on top.
//!
//! # Build, step, read
//! A world is built from a [`sim::Model`], number by number, or from a [`scene::Scene`], which has the keys of a scene
//! file. Behind [`sim::Dynamics`] it steps, is sampled, and takes commands.
//!
//! ```
//! use wobble::scene::Scene;
//! use wobble::sim::{Bond, Model, PointId, build};
//!
//! // A pendulum: 1 kg on a rigid bond of 1 m, let go 0.1 m beside its lowest point.
//! let (pin, weight) = (PointId(0), PointId(1));
//! let model = Model::<2> {
//!     position: vec![[0.0, 0.0], [0.1, -0.99_f64.sqrt()]],
//!     velocity: vec![[0.0; 2]; 2],
//!     mass: vec![1.0; 2],
//!     pinned: vec![pin],
//!     bonds: [Bond::new(pin, weight, 1.0)].into_iter().collect(),
//!     gravity: [0.0, -9.81],
//!     ..Model::default()
//! };
//! let mut world = build(&model)?;
//! while world.time() < 0.5 {
//!     world.step();
//! }
//! // A sample has the state at any time within the next substep, and changes nothing.
//! let sample = world.sample(world.time());
//! let swing = 0.1 * (9.81_f64.sqrt() * sample.time).cos();
//! assert!((sample.position[1][0] - swing).abs() < 1e-3, "{:?}", sample.position);
//!
//! // The same by a scene, from a file, from the gallery or from text.
//! let scene = Scene::parse(r#"{"wobble": 1, "points": {"position": [[0, 1]]}, "gravity": [0, -9.81]}"#, "my scene")?;
//! let mut world = scene.world(None)?;
//! world.step();
//! assert!(world.sample(world.time()).velocity[0][1] < 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Modules
//! [`sim`] has the world and its step, [`equilibrium`] the shape at rest, [`search`] the cheapest setting within a
//! tolerance; [`body`] makes bodies, [`picture`] turns pictures into meshes; [`scene`] reads and writes scene files,
//! [`history`] keeps recordings and undo, [`lessons`] teach, [`output`] writes files whole or not at all; [`render`] draws, [`study`]
//! measures; [`app`] is the window and [`cli`] the command line.

pub mod app;
pub mod body;
pub mod cli;
pub mod equilibrium;
pub mod history;
pub mod lessons;
pub mod output;
pub mod picture;
pub mod render;
pub mod scene;
pub mod search;
pub mod sim;
pub mod study;
