//! 000: points, a random graph, rims and meshes in a notebook.
//!
//! ```text
//! x' = 2x - x_old + a h^2            from the first step on, where x_old = x
//! d (min(k (L/(|d| + 0.001) - 1), max_delta)), half to each end, once, shuffled
//! clip to the walls before the sweep, or after it
//! ```
//!
//! Faults: the start is a h^2/2 ahead of the motion, and stays a h t/2 ahead; a stretched bond is never limited; each bond ends 0.001
//! short; points that were clipped first are swept through the walls.

use super::State;
use super::link::Sweep;
use crate::sim::real::Real;
use crate::sim::vector::scale;

/// What is added to a length so that it divides `[m]`.
const NEVER_ZERO: f64 = 0.001;

pub(super) fn step<S: Real, const D: usize>(
    state: &mut State<'_, S, D>,
    (links, sweeper, sweeps): Sweep<'_, S>,
    h: f64,
    clips_first: bool,
) {
    state.move_points(1.0, (1.0, h));
    if clips_first {
        clip(state);
    }
    for _ in 0..sweeps {
        sweeper.sweep(links, |link| {
            let (d, size) = link.span(state.x);
            let share = link.stiffness * (link.rest / (size + S::from_f64(NEVER_ZERO)) - S::ONE);
            state.part(link, scale(d, share.min(link.most)));
        });
    }
    if !clips_first {
        clip(state);
    }
}

/// Points outside the walls are put on them; where they were before stays as it is.
fn clip<S: Real, const D: usize>(state: &mut State<'_, S, D>) {
    for i in (0..state.x.len()).filter(|&i| state.w[i] != S::ZERO) {
        for surface in state.obstacles.planes() {
            if surface.gap(state.x[i]) < S::ZERO {
                state.x[i] = surface.clamped(state.x[i]);
            }
        }
    }
}
