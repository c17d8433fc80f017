//! Impacts of points that rigid bonds hold together.

use super::{Hit, Target, give, join_rests, note, rub};
use crate::sim::account::kinetic;
use crate::sim::constrain::direct::Direct;
use crate::sim::contact::Contacts;
use crate::sim::contact::coulomb::coupled::{Coupled, Speeds};
use crate::sim::contact::coulomb::{Pressed, Rub, strike};
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::sizes::MOST_STRUCK;
use crate::sim::vector::{add, dot, scale, zero};

/// Share of what a point alone would give below which its bonds hold it there, and share of an energy that is rounding; no less than so many
/// roundings.
const HELD: f64 = 1e-10;
const ROUNDING: f64 = 1e-9;
const ROUNDINGS: f64 = 64.0;

/// A share that may be rounding.
fn rounded<S: Real>(share: f64) -> f64 {
    share.max(ROUNDINGS * S::EPSILON.to_f64())
}

/// With rigid bonds, strings among them, of which events decide which act: by Coulomb's law where something is rough, in the plane. Not where
/// points are put out of surfaces at the end of a step: both ends of a bond would be held there at a wrong length.
pub(super) fn strike_bonded<S: Real, const D: usize>(
    (points, contacts): (&mut Points<S, D>, &mut Contacts<S, D>),
    rigid: &mut Direct<S, D>,
    (targets, is_located): (&mut Vec<Target<S>>, bool),
    pressed: &mut Option<f64>,
) {
    for point in contacts.rests.iter().map(|rest| rest.point as usize).collect::<Vec<_>>() {
        join_rests(contacts, point, targets);
    }
    contacts.clear();
    let is_rough = targets.iter().any(|target| contacts.obstacles.surfaces[target.hit.surface].friction > S::ZERO);
    if is_located && is_rough && D == 2 && targets.len() <= MOST_STRUCK && !rigid.chooses_itself() {
        strike_rough(points, contacts, rigid, targets, pressed);
    } else {
        strike_smooth(points, contacts, rigid, targets, pressed);
    }
}

/// Hits that would have to pull are left out, most of all first, until none is left; so are strings that would have to push. What friction
/// there is takes of each point by itself.
fn strike_smooth<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    contacts: &Contacts<S, D>,
    rigid: &mut Direct<S, D>,
    targets: &mut Vec<Target<S>>,
    pressed: &mut Option<f64>,
) {
    let before = points.velocity.clone();
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
            let normal = contacts.obstacles.surfaces[target.hit.surface].normal;
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
            note(points, pressed);
            rub(points, contacts, targets);
            rigid.project_velocity(points, &held);
            return;
        }
        targets.remove(worst.1);
    }
}

/// The impulses of all contacts at once, by Coulomb's law; strings that would have to push are left out, most of all first.
fn strike_rough<S: Real, const D: usize>(
    points: &mut Points<S, D>,
    contacts: &Contacts<S, D>,
    rigid: &mut Direct<S, D>,
    targets: &mut Vec<Target<S>>,
    pressed: &mut Option<f64>,
) {
    let before = points.velocity.clone();
    let ways: Vec<[[S; D]; 2]> = targets.iter().map(|target| ways(contacts, target.hit)).collect();
    let found = loop {
        points.velocity.copy_from_slice(&before);
        rigid.aim(&points.position);
        rigid.factor(contacts);
        rigid.project_velocity(points, contacts);
        let coupled = coupled((points, contacts), rigid, (targets, &ways));
        let found = struck(&coupled, points, contacts, (targets, &ways));
        points.velocity.copy_from_slice(&before);
        for ((target, ways), impulse) in targets.iter().zip(&ways).zip(&found.impulses) {
            let i = target.hit.point;
            for (way, push) in ways.iter().zip(impulse) {
                points.velocity[i] = add(points.velocity[i], scale(*way, S::from_f64(*push) * points.inverse_mass[i]));
            }
        }
        rigid.project_velocity(points, contacts);
        if found.share < 1.0 {
            let share = S::from_f64(found.share);
            points.velocity.iter_mut().for_each(|v| *v = scale(*v, share));
        }
        let Some((_, string)) = rigid.most_wrong() else { break found };
        rigid.set_taut(string, false);
    };
    let fastest = found.motion.speeds.iter().flatten().fold(0.0, |most: f64, speed| most.max(speed.abs()));
    let slow = fastest * rounded::<S>(HELD);
    let mut results = found.motion.speeds.iter().zip(&found.impulses);
    targets.retain(|target| {
        results.next().is_some_and(|(speed, impulse)| !target.rests || impulse[0] > 0.0 || speed[0] <= slow)
    });
    // What lies there has no speed across, to rounding, nor have bonds.
    let mut held = contacts.clone();
    targets.iter().filter(|target| target.rests).for_each(|target| held.touch(target.hit.point, target.hit.surface));
    for rest in &held.rests {
        points.velocity[rest.point as usize] = rest.free(points.velocity[rest.point as usize]);
    }
    rigid.factor(&held);
    rigid.project_velocity(points, &held);
    if let Some(energy) = pressed {
        *energy = kinetic(&points.velocity, &points.inverse_mass) + found.taken[1].max(0.0);
    }
}

/// Unit vectors off a surface and along it, in the plane.
fn ways<S: Real, const D: usize>(contacts: &Contacts<S, D>, hit: Hit) -> [[S; D]; 2] {
    let normal = contacts.obstacles.surfaces[hit.surface].normal;
    let mut along = zero();
    (along[0], along[1]) = (-normal[1], normal[0]);
    [normal, along]
}

/// The impulses that the law finds, from a motion that keeps the bonds.
fn struck<S: Real, const D: usize>(
    coupled: &Coupled,
    points: &Points<S, D>,
    contacts: &Contacts<S, D>,
    (targets, ways): (&[Target<S>], &[[[S; D]; 2]]),
) -> Pressed<Speeds> {
    let rub = |target: &Target<S>| {
        let surface = &contacts.obstacles.surfaces[target.hit.surface];
        let restitution = if target.rests { 0.0 } else { surface.restitution.to_f64() };
        Rub { friction: surface.friction.to_f64(), restitution, ..Rub::SMOOTH }
    };
    let rubs: Vec<Rub> = targets.iter().map(rub).collect();
    let energy = kinetic(&points.velocity, &points.inverse_mass);
    strike(coupled, &Speeds { speeds: speeds(&points.velocity, targets, ways), energy }, &rubs)
}

/// Velocities of all contacts, across and along `[m/s]`.
fn speeds<S: Real, const D: usize>(v: &[[S; D]], targets: &[Target<S>], ways: &[[[S; D]; 2]]) -> Vec<[f64; 2]> {
    let of = |(target, ways): (&Target<S>, &[[S; D]; 2])| ways.map(|way| dot(v[target.hit.point], way).to_f64());
    targets.iter().zip(ways).map(of).collect()
}

/// How all contacts answer to an impulse at each of them, bonds and all.
///
/// Bonds are aimed and factored before, for points that rest on nothing.
fn coupled<S: Real, const D: usize>(
    (points, contacts): (&Points<S, D>, &Contacts<S, D>),
    rigid: &mut Direct<S, D>,
    (targets, ways): (&[Target<S>], &[[[S; D]; 2]]),
) -> Coupled {
    let mut column = vec![zero(); points.len()];
    let mut gives = Vec::with_capacity(2 * targets.len());
    for (k, (target, ways_here)) in targets.iter().zip(ways).enumerate() {
        let alone = points.inverse_mass[target.hit.point];
        for (axis, way) in ways_here.iter().enumerate() {
            column.fill(zero());
            column[target.hit.point] = scale(*way, alone);
            // The second time takes what rounding left.
            rigid.project_ahead(&mut column, contacts);
            rigid.project_ahead(&mut column, contacts);
            let mut all = speeds(&column, targets, ways);
            if all[k][axis] <= alone.to_f64() * rounded::<S>(HELD) {
                all.fill([0.0; 2]);
            }
            gives.push(all);
        }
    }
    let mass = points.inverse_mass.iter().filter(|w| **w > S::ZERO).map(|w| 1.0 / w.to_f64()).sum();
    Coupled { gives, mass, rounding: rounded::<S>(ROUNDING), smooth: Vec::new() }
}
