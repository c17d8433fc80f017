//! What a step of a cluster is written into the ledger as: what the mouse and drag did, and the rest.
//!
//! Where something touched, dampers act or bodies settle, what is missing otherwise was taken by those, and by the method, which damps
//! what it does not resolve: both stand as losses of impacts. In flight without dampers what is missing stays unexplained.

use super::cluster::{Cluster, Common};
use super::guard;
use crate::sim::ledger::Book;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{dot, zero};

/// Energies before a step [J].
#[derive(Clone, Copy, Debug)]
pub(super) struct Before {
    kinetic: f64,
    all: f64,
}

impl Before {
    pub(super) fn of<S: Real>(state: &Cluster<S>, common: &Common<S>, gravity: [f64; 2]) -> Self {
        Before { kinetic: kinetic(state), all: guard::energy(state, common, gravity).to_f64() }
    }
}

/// Books a step of `h` [s].
pub(super) fn book<S: Real>(
    state: &Cluster<S>,
    common: &Common<S>,
    (before, pull, h): (Before, &Pull<S, 2>, f64),
    book: &mut Book,
) {
    let is_led = |i: usize| state.w[i] == S::ZERO && state.velocity[i] != zero();
    if (0..state.own()).any(is_led) || pull.has_fields() || pull.air.is_some() {
        // Nobody knows what led pins did, and forces and wind are not told from the mouse.
        book.untold += 1;
        return;
    }
    let now = Before::of(state, common, pull.gravity);
    let mouse = state.work.to_f64();
    let missing = before.all + mouse - now.all;
    // m rate v^2 is twice the kinetic energy times the rate.
    let drag = (pull.drag_rate * h * (before.kinetic + now.kinetic)).min(missing.max(0.0));
    let damps = state.members(common).any(|(body, _)| body.decay > S::ZERO);
    book.mouse += mouse;
    book.drag += drag;
    if damps || state.has_pressed || state.touches.contains(&true) {
        book.impacts += (missing - drag).max(0.0);
    }
}

fn kinetic<S: Real>(state: &Cluster<S>) -> f64 {
    let of = |i: usize| {
        let (v, w) = (state.velocity[i].map(S::to_f64), state.w[i].to_f64());
        if w > 0.0 { 0.5 * dot(v, v) / w } else { 0.0 }
    };
    (0..state.own()).map(of).sum()
}
