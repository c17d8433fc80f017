//! Impacts: points that reach a surface get their velocities back from it, at once, bonds and all.

use super::Contacts;
use crate::sim::constrain::direct::Direct;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{dot, length, scale, sub};

/// A point that meets a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Hit {
    pub(crate) point: usize,
    pub(crate) surface: usize,
}

/// Velocities after an impact: v_n -> -restitution v_n where points hit, with rigid bonds kept.
///
/// Model: the impulse of least energy that keeps the bonds, gives every hit point its velocity off the surface, and
/// never pulls; found by leaving out, one by one, the hits that would have to pull. Friction takes at most `friction`
/// times the change across the surface from the velocity along it. Points that rest already take part: they are not
/// pushed into their surface.
/// `gentle(hit, speed)` tells which hits are too slow to bounce: those points come to rest.
pub(crate) fn strike<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    contacts: &mut Contacts<S, D>,
    rigid: Option<&mut Direct<S, D>>,
    hits: &[Hit],
    gentle: impl Fn(Hit, S) -> bool,
) {
    let mut targets = Vec::with_capacity(hits.len());
    for &hit in hits {
        let surface = &contacts.surfaces[hit.surface];
        let speed = dot(points.velocity[hit.point], surface.normal);
        if speed < S::ZERO {
            let rests = surface.restitution == S::ZERO || gentle(hit, -(surface.restitution * speed));
            let target = if rests { S::ZERO } else { -(surface.restitution * speed) };
            targets.push(Target { hit, target, change: target - speed, rests });
        }
    }
    match rigid {
        Some(rigid) => strike_bonded(points, contacts, rigid, &mut targets),
        None => {
            for target in &targets {
                give(points, contacts, target);
            }
            rub(points, contacts, &targets);
        }
    }
    for target in targets.iter().filter(|target| target.rests) {
        contacts.touch(target.hit.point, target.hit.surface);
    }
    contacts.settle(points);
}

struct Target<S> {
    hit: Hit,
    /// Velocity off the surface afterwards [m/s].
    target: S,
    /// Change of the velocity across the surface that the surface itself gives [m/s].
    change: S,
    rests: bool,
}

/// Gives a point its velocity off the surface.
fn give<S: Real, const D: usize>(points: &mut Points<S, D>, contacts: &Contacts<S, D>, target: &Target<S>) {
    let normal = contacts.surfaces[target.hit.surface].normal;
    let v = &mut points.velocity[target.hit.point];
    let off = dot(*v, normal);
    *v = sub(*v, scale(normal, off - target.target));
}

/// Friction of the impact.
fn rub<S: Real, const D: usize>(points: &mut Points<S, D>, contacts: &Contacts<S, D>, targets: &[Target<S>]) {
    for target in targets {
        let surface = &contacts.surfaces[target.hit.surface];
        let v = &mut points.velocity[target.hit.point];
        let way = sub(*v, scale(surface.normal, dot(*v, surface.normal)));
        let speed = length(way);
        if surface.friction > S::ZERO && speed > S::ZERO {
            let share = (surface.friction * target.change / speed).min(S::ONE);
            *v = sub(*v, scale(way, share));
        }
    }
}

/// With rigid bonds: hits that would have to pull are left out, most of all first, until none is left; so are strings that
/// would have to push, where events decide which of them act.
fn strike_bonded<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    contacts: &mut Contacts<S, D>,
    rigid: &mut Direct<S, D>,
    targets: &mut Vec<Target<S>>,
) {
    let before = points.velocity.clone();
    // Points that rest are part of it: their surface may have to push harder, or to let go.
    for rest in &contacts.rests {
        let point = rest.point as usize;
        let is_hit = |target: &Target<S>, surface: usize| target.hit == Hit { point, surface };
        for surface in rest.surfaces().iter().map(|&surface| surface as usize) {
            if !targets.iter().any(|target| is_hit(target, surface)) {
                let hit = Hit { point, surface };
                targets.push(Target { hit, target: S::ZERO, change: S::ZERO, rests: true });
            }
        }
    }
    contacts.clear();
    loop {
        points.velocity.copy_from_slice(&before);
        let mut held = contacts.clone();
        for target in targets.iter() {
            give(points, contacts, target);
            held.touch(target.hit.point, target.hit.surface);
        }
        rigid.aim(&points.position);
        rigid.factor(&held);
        rigid.project_velocity(points, &held);
        let mut worst = (S::ZERO, usize::MAX);
        for (at, target) in targets.iter_mut().enumerate() {
            let i = target.hit.point;
            let normal = contacts.surfaces[target.hit.surface].normal;
            target.change = target.target - dot(before[i], normal) - dot(rigid.push_on(i), normal);
            if target.change < worst.0 {
                worst = (target.change, at);
            }
        }
        if let Some((push, string)) = rigid.most_wrong()
            && push < worst.0
        {
            rigid.set_taut(string, false);
            continue;
        }
        if worst.1 == usize::MAX {
            rub(points, contacts, targets);
            rigid.project_velocity(points, &held);
            return;
        }
        targets.remove(worst.1);
    }
}
