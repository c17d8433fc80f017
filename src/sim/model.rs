//! What a world is made from: points, bonds, forces, walls and a method, in `f64` and checked.

use super::bond::{Bond, PointId};
use super::contact::bounds::Bounds;
use super::force::mouse::MouseForce;

/// A start: everything that decides a motion. The same model runs bit for bit as it did before.
///
/// Shapes: `position`, `velocity` and `mass` have one entry a point; `bonds` and `pinned` hold indices below that.
/// Valid range: every number finite, masses > 0, no bond between a point and itself. A scene file is checked when it
/// is read; [`Model::check`] holds hand-made models to the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Model<const D: usize> {
    /// Positions at the start [m].
    pub position: Vec<[f64; D]>,
    /// Velocities at the start [m/s]; those of pinned points are ignored.
    pub velocity: Vec<[f64; D]>,
    /// Masses [kg], > 0.
    pub mass: Vec<f64>,
    /// The points that never move, in any order.
    pub pinned: Vec<PointId>,
    /// The bonds, in the order that [`Order::Fixed`] sweeps them.
    pub bonds: Vec<Bond>,
    /// Gravity [m/s^2].
    pub gravity: [f64; D],
    /// Rate at which velocities decay [1/s], >= 0.
    pub drag_rate: f64,
    /// The force around the cursor, if the scene has one.
    pub mouse: Option<MouseForce>,
    /// The walls around the world, if any.
    pub bounds: Option<Bounds<D>>,
    /// When the motion ends [s]: a substep ends there. `None`: never.
    pub duration: Option<f64>,
    /// How the motion is computed.
    pub method: Method,
}

impl<const D: usize> Default for Model<D> {
    /// No points, no forces, the automatic method.
    fn default() -> Self {
        Model {
            position: Vec::new(),
            velocity: Vec::new(),
            mass: Vec::new(),
            pinned: Vec::new(),
            bonds: Vec::new(),
            gravity: [0.0; D],
            drag_rate: 0.0,
            mouse: None,
            bounds: None,
            duration: None,
            method: Method::default(),
        }
    }
}

/// How a motion is computed: the keys of `method` in a scene file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Method {
    /// The integrator and the way bonds are held.
    pub solver: Solver,
    /// Substep h [s], > 0; `None`: chosen from the fastest motion of the scene.
    pub substep: Option<f64>,
    /// Sweeps over the bonds in a substep, >= 1.
    pub iterations: Option<u32>,
    /// The order in which a sweep takes the bonds.
    pub order: Order,
    /// Seed of [`Order::Shuffled`].
    pub seed: u64,
    /// The scalar of the world.
    pub precision: Precision,
}

/// The integrator and the way bonds are held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Springs as forces under Verlet's method, other bonds by sweeps.
    #[default]
    Auto,
    /// Position Verlet with the right start: springs as forces, rigid bonds projected along their direction at the
    /// start of the substep until they hold, relaxed bonds swept.
    Verlet,
    /// Every bond swept along its present direction, rigid ones as relaxed with relaxation 1; springs are refused.
    Relaxation,
}

/// The order in which a sweep takes the bonds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// As [`Order::Coloured`].
    #[default]
    Auto,
    /// As listed, every sweep: feeds energy into over-determined meshes, and exists to show that.
    Fixed,
    /// As listed and backwards, sweep by sweep in turn.
    Symmetric,
    /// By colours: no two bonds of one colour share a point.
    Coloured,
    /// Shuffled anew for every sweep, from the seed.
    Shuffled,
}

/// The scalar of a world.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// `f64` for small scenes, `f32` for large ones.
    #[default]
    Auto,
    /// 32 bits, compensated.
    F32,
    /// 64 bits.
    F64,
}
