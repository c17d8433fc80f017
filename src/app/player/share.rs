//! How much of something long is done: told by the thread that does it, read by the window.

use std::sync::atomic::{AtomicU32, Ordering};

/// A share, 0 to 1, by its bits.
#[derive(Debug, Default)]
pub struct Share(AtomicU32);

impl Share {
    /// So much is done.
    pub(super) fn tell(&self, share: f64) {
        self.0.store((share as f32).to_bits(), Ordering::Relaxed);
    }

    pub(super) fn read(&self) -> f32 {
        f32::from_bits(self.0.load(Ordering::Relaxed))
    }
}
