//! What a body's material makes of its bonds.

use super::keys::{BodyKeys, Material};
use super::start::resistance;
use crate::body::Body;
use crate::sim::BondKind;

/// Share of the critical damping that the slowest wobble of a soft body has, where none is said.
const DAMPING_RATIO: f64 = 0.1;

/// Fastest decay that such a damper may give to a point `[1/s]`: a faster one is over within a thousandth of a second, and costs as many
/// substeps as it is fast.
const MOST_DECAY: f64 = 6_000.0;

/// How the bonds of a body resist; `mass` `[kg]` has an entry a point.
///
/// Springs by Young's modulus without `damping` are damped in proportion to their stiffness, so that the slowest wobble dies
/// away alike in any mesh: c = k 2 ratio/omega, omega = pi/L sqrt(E/density), with L the longer side of the body.
pub(super) fn kind(keys: &BodyKeys, body: &Body, mass: &[f64]) -> BondKind {
    let kind = resistance(keys).resolve();
    match (kind, keys.material.as_ref()) {
        (BondKind::Spring { stiffness, .. }, Some(Material { young: Some(young), damping: None, .. })) => {
            let density = mass.iter().sum::<f64>() / body.area.max(f64::MIN_POSITIVE);
            let omega = std::f64::consts::PI / longer_side(body) * (young / density).sqrt();
            let damping = stiffness * (2.0 * DAMPING_RATIO / omega).min(MOST_DECAY / fastest(body, mass, stiffness));
            BondKind::Spring { stiffness, damping: if damping.is_finite() { damping } else { 0.0 } }
        }
        _ => kind,
    }
}

/// A bound on the square of the fastest oscillation of points on these springs `[1/s^2]`.
fn fastest(body: &Body, mass: &[f64], stiffness: f64) -> f64 {
    let mut pull = vec![0.0; mass.len()];
    for link in &body.links {
        pull[link.a as usize] += stiffness * link.share;
        pull[link.b as usize] += stiffness * link.share;
    }
    pull.iter().zip(mass).map(|(pull, mass)| 2.0 * pull / mass).fold(f64::MIN_POSITIVE, f64::max)
}

fn longer_side(body: &Body) -> f64 {
    let side = |axis: usize| {
        let all = || body.positions.iter().map(move |x| x[axis]);
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    side(0).max(side(1))
}
