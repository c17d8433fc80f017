//! When a world has come to rest it sleeps: nothing is stepped until a command wakes it.

use super::dynamics::Dynamics;

/// Speed below which a point counts as still [m/s].
pub const STILL_SPEED: f64 = 1e-4;
/// How long all points must be still before the world falls asleep [s].
pub const STILL_TIME: f64 = 0.5;

/// Watches a world substep by substep.
///
/// A world sleeps when no point has been faster than [`STILL_SPEED`] for [`STILL_TIME`], no cursor was in reach and no
/// track moved. It counts the world's own time, so that it sleeps at the same substep at any frame rate.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sleep {
    still_since: Option<f64>,
    asleep: bool,
}

impl Sleep {
    /// Looks at the world after a substep. Costs one point where the first one moves.
    pub fn watch(&mut self, world: &dyn Dynamics) {
        if !world.is_still(STILL_SPEED) {
            *self = Sleep::default();
            return;
        }
        let since = *self.still_since.get_or_insert(world.time());
        self.asleep = world.time() - since >= STILL_TIME;
    }

    /// Whether the world sleeps.
    pub fn is_asleep(&self) -> bool {
        self.asleep
    }

    /// Any command, or a change of what the world is, wakes it.
    pub fn wake(&mut self) {
        *self = Sleep::default();
    }
}
