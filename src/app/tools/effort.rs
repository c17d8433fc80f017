//! How much torque a motor needs to move what it is on.

use glam::DVec2;

use super::hinge::place;
use super::pick::Scope;
use crate::sim::PointId;

/// Least torque that is proposed `[N m]`: it turns what is light at once.
const LEAST: f64 = 30.0;
/// What is proposed is so much more than is needed `[1]`: the load is an estimate, and what barely turns is no motor.
const RESERVE: f64 = 2.0;
/// A wheel gets to its speed within about so long `[s]`.
const RISE: f64 = 1.0;
/// Friction of planes and obstacles, of which none is shown `[1]`: their default.
const FRICTION: f64 = 0.5;

/// The torque that turns some points about a place `[N m]`, at least: against their weight at their arm, against friction at their rim under all
/// that weighs on it if it `rubs` on anything, and so that they have the speed `[rad/s]` within a second.
///
/// Model: W d + friction (W + W') r + I |speed|/[`RISE`], W and W' the weights of what turns and of what holds it `[N]`, d the arm of the
/// middle of mass across gravity at its worst and r that of the farthest point `[m]`, I the moment of inertia `[kg m^2]`.
pub(super) fn needed(
    scope: Scope<'_>,
    at: DVec2,
    [turning, holder]: [&[PointId]; 2],
    (speed, rubs): (f64, bool),
) -> f64 {
    let settings = &scope.shown.settings;
    let gravity = settings.gravity.map_or(0.0, |[x, y, _]| x.hypot(y));
    let masses = &scope.shown.scenery.masses;
    // What is held fast bears itself.
    let mass = |point: &PointId| {
        if scope.is_pinned(*point) { 0.0 } else { masses.get(point.index()).copied().unwrap_or(0.0) }
    };
    let [own, held] = [turning, holder].map(|points| points.iter().map(mass).sum::<f64>());
    let arm = |point: &PointId| place(scope, *point) - at;
    let moment: DVec2 = turning.iter().map(|point| mass(point) * arm(point)).sum();
    let inertia: f64 = turning.iter().map(|point| mass(point) * arm(point).length_squared()).sum();
    let radius = turning.iter().map(|point| arm(point).length()).fold(0.0, f64::max);
    let walls = settings.bounds.flatten().map_or(0.0, |walls| walls.friction);
    let skins = settings.contact.flatten().map_or(0.0, |contact| contact.friction);
    let friction = if rubs { FRICTION.max(walls).max(skins) } else { 0.0 };
    gravity * (moment.length() + friction * (own + held) * radius) + inertia * speed.abs() / RISE
}

/// The torque that is proposed where so much is needed `[N m]`, in round figures.
pub(super) fn proposed(needed: f64) -> f64 {
    rounded((RESERVE * needed).max(LEAST))
}

/// The torque that is said to be needed where so much is `[N m]`, in round figures.
pub(super) fn said(needed: f64) -> f64 {
    rounded((RESERVE * needed).max(1.0))
}

/// The next number of two figures.
fn rounded(wanted: f64) -> f64 {
    let step = 10_f64.powf(wanted.log10().floor() - 1.0);
    (wanted / step).ceil() * step
}
