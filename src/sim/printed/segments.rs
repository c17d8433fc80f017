//! 001: points and segments on a canvas.
//!
//! ```text
//! six times:  v = 0.99 (x - x_old + g h^2), x_old = x, x += v
//! once:       segments give their ends half of a correction each
//! once:       points outside are put on the walls, x_old by what they came with, times the bounce
//! ```
//!
//! Faults: a sweep after six moves leaves the speed of the last of them, and the error of a length grows by
//! -(0.99 + 0.99^2 + … + 0.99^5) = -4.85 a frame; a locked end leaves half of the error; ends in one place divide by 0; at the top and on
//! the right what went out goes on outwards.

use super::State;
use super::link::Sweep;
use crate::sim::real::Real;
use crate::sim::vector::{scale, sub};

/// Moves of the points in a frame.
pub(super) const MOVES: u32 = 6;
/// What is left of a velocity after a move.
const FRICTION: f64 = 0.99;

pub(super) fn step<S: Real, const D: usize>(
    state: &mut State<'_, S, D>,
    (links, sweeper, sweeps): Sweep<'_, S>,
    h: f64,
) {
    for _ in 0..MOVES {
        state.move_points(FRICTION, (FRICTION, h / f64::from(MOVES)));
    }
    for _ in 0..sweeps {
        sweeper.sweep(links, |link| {
            let (d, size) = link.span(state.x);
            state.part(link, scale(d, (link.rest - size) / size));
        });
    }
    for i in (0..state.x.len()).filter(|&i| state.w[i] != S::ZERO) {
        bounce(state, i);
    }
}

/// A point outside is put on the wall; of what it came with the bounce is left, turned at the bottom and on the left alone.
fn bounce<S: Real, const D: usize>(state: &mut State<'_, S, D>, i: usize) {
    let came = sub(state.x[i], state.old[i]);
    for surface in state.obstacles.planes() {
        if surface.gap(state.x[i]) >= S::ZERO {
            continue;
        }
        state.x[i] = surface.clamped(state.x[i]);
        for k in (0..D).filter(|&k| surface.normal[k] != S::ZERO) {
            let left = came[k] * surface.restitution;
            let is_turned = surface.normal[k] > S::ZERO;
            state.old[i][k] = if is_turned { state.x[i][k] + left } else { state.x[i][k] - left };
        }
    }
}
