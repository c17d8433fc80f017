//! What an engine must offer to be measured.

use std::fmt::Display;

use crate::scenes::Scene;

/// Frames in a second.
pub(crate) const FRAMES_A_SECOND: usize = 60;
/// Duration of a frame [s].
pub(crate) const FRAME: f32 = 1.0 / 60.0;

/// An engine, or one of the ways in which an engine can hold a bond.
pub(crate) trait Peer {
    /// All but the number of substeps: iterations, stiffness, passes. Shown in tables.
    type Way: Copy + Display + 'static;

    /// How tables and the command line call it.
    const NAME: &'static str;
    /// The ways to climb, the best one first: only that one is climbed where a frame is very dear.
    const WAYS: &'static [Self::Way];
    /// Substeps a frame and the way of an untouched engine whose bonds are made rigid.
    const DEFAULT: Setting<Self::Way>;

    /// Version of the engine.
    fn version() -> String;

    /// Whether it can hold the bonds of this scene.
    fn suits(_scene: &Scene) -> bool {
        true
    }

    /// A scene at its start, ready to be stepped.
    fn world(scene: &Scene, setting: Setting<Self::Way>) -> Box<dyn World>;
}

/// One rung of a ladder.
#[derive(Clone, Copy)]
pub(crate) struct Setting<Way> {
    /// Substeps a frame, >= 1.
    pub(crate) substeps: usize,
    /// Everything else.
    pub(crate) way: Way,
}

impl<Way: Display> Display for Setting<Way> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} substeps, {}", self.substeps, self.way)
    }
}

/// A scene inside an engine.
pub(crate) trait World {
    /// Advances by one frame; this alone is timed.
    fn step(&mut self);

    /// Position of each point, in the order of the scene [m].
    fn positions(&self) -> Vec<[f64; 2]>;
}
