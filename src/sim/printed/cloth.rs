//! 004: a cloth in space that hangs from a bar.
//!
//! ```text
//! x' = x + 0.9985 (x - x_old) + g h^2            h is what the frame took; x - x_old is taken as it is
//! a point in a box goes to the nearest face
//! 15 times: bonds in their order, half of a correction to each end, also where the other is anchored
//! ```
//!
//! Faults: another h than the last is another speed; bonds at the bar leave half of their error; sweeps come after the box, and take points
//! into it again.

use super::State;
use super::link::Sweep;
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, scale, sub};

/// What is left of a displacement after a step.
const DAMPING: f64 = 0.9985;

pub(super) fn step<S: Real, const D: usize>(
    state: &mut State<'_, S, D>,
    (links, sweeper, sweeps): Sweep<'_, S>,
    h: f64,
) {
    state.move_points(DAMPING, (1.0, h));
    for i in (0..state.x.len()).filter(|&i| state.w[i] != S::ZERO) {
        keep_out(state, i);
    }
    for _ in 0..sweeps {
        sweeper.sweep(links, |link| {
            let (d, size) = link.span(state.x);
            state.part(link, scale(d, (link.rest - size) / size));
        });
    }
}

/// A point inside a box or behind a plane is put on the nearest face; where it was before stays as it is.
fn keep_out<S: Real, const D: usize>(state: &mut State<'_, S, D>, i: usize) {
    if let Some((depth, out)) = state.obstacles.depth_in_convex(state.x[i]) {
        state.x[i] = add(state.x[i], scale(convert(out), S::from_f64(depth)));
    }
    for surface in state.obstacles.planes() {
        let gap = surface.gap(state.x[i]);
        if gap < S::ZERO {
            state.x[i] = sub(state.x[i], scale(surface.normal, gap));
        }
    }
}
