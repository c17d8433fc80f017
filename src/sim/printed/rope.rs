//! 002: a rope on the cursor.
//!
//! ```text
//! x' = x + (x - x_old) + g h^2       of what is not locked
//! 50 times: rods in their order, half of a correction to each end, all of it where the other is locked
//! ```
//!
//! Fault: x_old of what is locked stays where it was when it was locked: let go, it flies off with all of the way since then as the
//! way of one step.

use super::State;
use super::link::Sweep;
use crate::sim::real::Real;
use crate::sim::vector::scale;

pub(super) fn step<S: Real, const D: usize>(
    state: &mut State<'_, S, D>,
    (links, sweeper, sweeps): Sweep<'_, S>,
    h: f64,
    stale: &mut [Option<[S; D]>],
) {
    for (i, place) in stale.iter_mut().enumerate() {
        if state.is_free(i)
            && let Some(place) = place.take()
        {
            state.old[i] = place;
        }
    }
    state.move_points(1.0, (1.0, h));
    for _ in 0..sweeps {
        sweeper.sweep(links, |link| {
            let (d, size) = link.span(state.x);
            if size == S::ZERO {
                return;
            }
            let correction = scale(d, (link.rest - size) / size);
            let are_free = link.ends().iter().all(|&end| state.is_free(end as usize));
            state.part(link, if are_free { correction } else { scale(correction, S::from_f64(2.0)) });
        });
    }
}
