//! Impacts: points that reach a surface get their velocities back from it, at once, bonds and all.

mod bonded;

use crate::sim::account::kinetic;
use crate::sim::constrain::direct::Direct;
use crate::sim::contact::Contacts;
use crate::sim::ledger::Book;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, length, scale, sub};

/// A point that meets a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Hit {
    pub(crate) point: usize,
    pub(crate) surface: usize,
}

/// Velocities after an impact: v_n -> -restitution v_n where points hit, with rigid bonds kept.
///
/// Model: the impulse of least energy that keeps the bonds, gives every hit point its velocity off the surface, and
/// never pulls. Friction takes at most `friction` times the change across the surface from the velocity along it; of points in
/// bonds it is found together with what presses, where hits are located in time. Points that rest already take part: they are not pushed
/// into their surface.
/// What the impact and its friction take is written into `book`, if there is one.
/// `gentle(hit, speed)` tells which hits are too slow to bounce: those points come to rest.
pub(crate) fn strike<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    contacts: &mut Contacts<S, D>,
    rigid: Option<&mut Direct<S, D>>,
    (hits, is_located): (&[Hit], bool),
    gentle: impl Fn(Hit, S) -> bool,
    book: Option<&mut Book>,
) {
    let start = book.is_some().then(|| kinetic(&points.velocity, &points.inverse_mass));
    // The kinetic energy before friction.
    let mut pressed = start;
    let mut targets = Vec::with_capacity(hits.len());
    for &hit in hits {
        let surface = &contacts.obstacles.surfaces[hit.surface];
        let speed = dot(points.velocity[hit.point], surface.normal);
        if speed < S::ZERO {
            let rests = surface.restitution == S::ZERO || gentle(hit, -(surface.restitution * speed));
            let target = if rests { S::ZERO } else { -(surface.restitution * speed) };
            targets.push(Target { hit, target, change: target - speed, rests });
        }
    }
    match rigid {
        Some(rigid) => bonded::strike_bonded((points, contacts), rigid, (&mut targets, is_located), &mut pressed),
        None => strike_loose(points, contacts, &mut targets, &mut pressed),
    }
    if let (Some(book), Some(start), Some(pressed)) = (book, start, pressed) {
        // Where nothing hits strings do, which get taut and give nothing back.
        let gives_back = |hit: &Hit| contacts.obstacles.surfaces[hit.surface].restitution >= S::ONE;
        let takes = hits.is_empty() || !hits.iter().all(gives_back);
        // What an elastic impact takes, or any gives, is the method's own.
        book.impacts += if takes { (start - pressed).max(0.0) } else { 0.0 };
        book.friction += (pressed - kinetic(&points.velocity, &points.inverse_mass)).max(0.0);
    }
    for target in targets.iter().filter(|target| target.rests) {
        contacts.touch(target.hit.point, target.hit.surface);
    }
    contacts.settle(points);
}

#[derive(Clone, Copy, Debug)]
struct Target<S> {
    hit: Hit,
    /// Velocity off the surface afterwards `[m/s]`.
    target: S,
    /// Change of the velocity across the surface that the surface itself gives `[m/s]`.
    change: S,
    rests: bool,
}

/// Without rigid bonds every point is for itself.
fn strike_loose<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    contacts: &mut Contacts<S, D>,
    targets: &mut Vec<Target<S>>,
    pressed: &mut Option<f64>,
) {
    let mut struck: Vec<usize> = targets.iter().map(|target| target.hit.point).collect();
    struck.sort_unstable();
    struck.dedup();
    for point in struck {
        let (mut own, others) = std::mem::take(targets).into_iter().partition(|target| target.hit.point == point);
        *targets = others;
        join_rests(contacts, point, &mut own);
        contacts.release(point);
        push_off(points, contacts, &mut own);
        targets.append(&mut own);
    }
    note(points, pressed);
    rub(points, contacts, targets);
}

/// Notes the kinetic energy, where that is kept.
fn note<S: Real, const D: usize>(points: &Points<S, D>, energy: &mut Option<f64>) {
    if let Some(energy) = energy {
        *energy = kinetic(&points.velocity, &points.inverse_mass);
    }
}

/// A point that rests takes part with its surfaces: they may have to push harder, or to let go.
fn join_rests<S: Real, const D: usize>(contacts: &Contacts<S, D>, point: usize, targets: &mut Vec<Target<S>>) {
    let Some(rest) = contacts.of(point) else { return };
    for surface in rest.surfaces().iter().map(|&surface| surface as usize) {
        let hit = Hit { point, surface };
        if !targets.iter().any(|target| target.hit == hit) {
            targets.push(Target { hit, target: S::ZERO, change: S::ZERO, rests: true });
        }
    }
}

/// Times that the impulses of one point are gone through, one surface after the other.
const MOST_PASSES: u32 = 200;

/// The velocity of one point after its impact: no surface pulls, and where one pushes the point has the velocity off it
/// that it should have (Gauss and Seidel's method on the impulses). Surfaces that the point leaves are struck off.
fn push_off<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    contacts: &Contacts<S, D>,
    targets: &mut Vec<Target<S>>,
) {
    let Some(first) = targets.first() else { return };
    let v = &mut points.velocity[first.hit.point];
    let speed = length(*v);
    targets.iter_mut().for_each(|target| target.change = S::ZERO);
    let several = targets.len() > 1 && targets.iter().any(|target| !target.rests);
    let bounced = if several { bounce_about(v, contacts, targets) } else { Vec::new() };
    for _ in 0..MOST_PASSES {
        let mut largest = S::ZERO;
        for target in targets.iter_mut() {
            let normal = contacts.obstacles.surfaces[target.hit.surface].normal;
            let change = (target.change + target.target - dot(*v, normal)).max(S::ZERO);
            let step = change - target.change;
            *v = add(*v, scale(normal, step));
            target.change = change;
            largest = largest.max(step.abs());
        }
        if largest <= S::EPSILON * speed {
            break;
        }
    }
    targets.iter_mut().zip(bounced).for_each(|(target, bounced)| target.change += bounced);
    let v = *v;
    let slow = speed * S::EPSILON * S::from_f64(64.0);
    targets.retain(|target| {
        let off = dot(v, contacts.obstacles.surfaces[target.hit.surface].normal);
        off <= target.target + slow || !target.rests && target.change > S::ZERO
    });
}

/// Bounces that one point makes in a corner at most.
const MOST_BOUNCES: u32 = 256;

/// A point that hits several surfaces at once bounces off one after the other, the one that it goes into most first: so it keeps
/// its energy where they do. What is left then is for those that it comes to rest on. Returns the change that each one gave.
fn bounce_about<S: Real, const D: usize>(
    v: &mut [S; D],
    contacts: &Contacts<S, D>,
    targets: &mut [Target<S>],
) -> Vec<S> {
    let mut changes = vec![S::ZERO; targets.len()];
    let surface = |target: &Target<S>| &contacts.obstacles.surfaces[target.hit.surface];
    for _ in 0..MOST_BOUNCES {
        let off = targets.iter().map(|target| dot(*v, surface(target).normal)).enumerate();
        let deepest = off.min_by(|a, b| a.1.to_f64().total_cmp(&b.1.to_f64()));
        let Some((at, off)) = deepest.filter(|(_, off)| *off < S::ZERO) else { break };
        let target = &targets[at];
        let restitution = if target.rests { S::ZERO } else { surface(target).restitution };
        let step = -(off + restitution * off);
        *v = add(*v, scale(surface(target).normal, step));
        changes[at] += step;
    }
    targets.iter_mut().for_each(|target| target.target = S::ZERO);
    changes
}

/// Gives a point its velocity off the surface.
fn give<S: Real, const D: usize>(points: &mut Points<S, D>, contacts: &Contacts<S, D>, target: &Target<S>) {
    let normal = contacts.obstacles.surfaces[target.hit.surface].normal;
    let v = &mut points.velocity[target.hit.point];
    let off = dot(*v, normal);
    *v = sub(*v, scale(normal, off - target.target));
}

/// Friction of the impact.
fn rub<S: Real, const D: usize>(points: &mut Points<S, D>, contacts: &Contacts<S, D>, targets: &[Target<S>]) {
    for target in targets {
        let surface = &contacts.obstacles.surfaces[target.hit.surface];
        let v = &mut points.velocity[target.hit.point];
        let way = sub(*v, scale(surface.normal, dot(*v, surface.normal)));
        let speed = length(way);
        if surface.friction > S::ZERO && speed > S::ZERO {
            let share = (surface.friction * target.change / speed).min(S::ONE);
            *v = sub(*v, scale(way, share));
        }
    }
}
