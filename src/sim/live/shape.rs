//! Angles and areas in the live step: compliant projections along their slopes, as bonds are; limits of joints and areas that are kept.

use super::bend;
use super::body::{Area, Body};
use super::cluster::{Cluster, Common};
use super::rigid::Change;
use crate::sim::force::angle::{Hinge, Stand};
use crate::sim::force::area::{Patch, size, slopes};
use crate::sim::force::form::at;
use crate::sim::kernels::links;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale};

/// Most that a substep turns an angle by `[rad]`: further on its slopes are others.
pub(super) const MOST_TURN: f64 = 0.5;
/// Share of what a joint was beyond its range before a substep that comes back in a pass, without speed.
const MENDED: f64 = 0.1 / 3.0;
/// Share of what turns two bodies alone that is taken to be left of it by their joints at least.
const LEAST_LEFT: f64 = 0.05;
/// By how much it may stay beyond it `[rad]`: what is led back into it without end, against what it lies on, pushes its body about.
const SLACK: f64 = 0.01;

/// Angles and areas that are springs, each once in a substep of `h` `[s]`.
///
/// Model: with C what is off, slopes g and the way of the points since the start of the substep, the multiplier is
/// -(k h^2 C + c h g . way)/(1 + (k h^2 + c h) sum of w |g|^2), c the damper: implicit Euler, linear in C.
pub(super) fn resist<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    bend::bend(state, common, h);
    let areas = &common.resist;
    let is_spring = areas.stiffness > 0.0 && !areas.is_rigid();
    for (k, (body, base)) in state.members(common).enumerate() {
        let are_together = state.bends.get(k).and_then(Option::as_ref).is_some_and(|bends| !bends.is_soft);
        if !are_together {
            let hinges = common.hinges(body);
            state.counts.work += 60 * hinges.len() as u64;
            hinges.iter().for_each(|hinge| bend(state, hinge, (base, h)));
        }
        if is_spring {
            let firm = S::from_f64(areas.stiffness) * h * h;
            let areas = common.areas(body);
            state.counts.work += 20 * areas.len() as u64;
            for area in areas {
                let points = places(base, area.corners);
                let x = at(&state.now, points);
                let by = firm / area.rest;
                let g = slopes(x);
                push(state, points, g, -by * (size(x) - area.rest) / (S::ONE + by * weight(state, points, g)));
            }
        }
    }
}

/// One pass over the limits of joints and over areas that are kept, at once.
pub(super) fn hold<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    for (body, base) in state.members(common) {
        for hinge in common.hinges(body).iter().filter(|hinge| hinge.stop > S::ZERO) {
            stop(state, hinge, base);
        }
        if common.resist.is_rigid() {
            let areas = common.areas(body);
            state.counts.work += 20 * areas.len() as u64;
            areas.iter().for_each(|area| keep(state, area, base));
        }
    }
}

/// Energy of the angles and areas of a body `[J]`.
pub(super) fn energy<S: Real>(state: &Cluster<S>, common: &Common<S>, (body, base): (&Body<S>, usize)) -> S {
    let mut sum = S::ZERO;
    for hinge in common.hinges(body) {
        sum += hinge.energy_within(at(&state.now, places(base, hinge.points)));
    }
    if common.resist.stiffness > 0.0 && !common.resist.is_rigid() {
        let stiffness = S::from_f64(common.resist.stiffness);
        for area in common.areas(body) {
            let patch = Patch { corners: area.corners, rest: area.rest, stiffness };
            sum += patch.energy(at(&state.now, places(base, area.corners)));
        }
    }
    sum
}

fn places(base: usize, points: [u32; 3]) -> [u32; 3] {
    points.map(|point| base as u32 + point)
}

pub(super) fn bend<S: Real>(state: &mut Cluster<S>, hinge: &Hinge<S>, (base, h): (usize, S)) {
    let points = places(base, hinge.points);
    let Some(stand) = hinge.stand(at(&state.now, points)) else { return };
    let firm = stand.share() * hinge.stiffness * h * h;
    let slow = stand.share() * hinge.damping * h;
    let weight = weight(state, points, stand.slopes);
    if weight == S::ZERO || firm + slow == S::ZERO {
        return;
    }
    let way = stand.rate(at(&state.way, points));
    let multiplier = -(firm * hinge.off_rest(stand.angle) + slow * way) / (S::ONE + (firm + slow) * weight);
    push_turning(state, hinge, points, stand.slopes, (bounded(multiplier, weight), weight));
}

/// A joint comes back to its range: what was beyond it before slowly and without speed, what is new at once.
pub(super) fn stop<S: Real>(state: &mut Cluster<S>, hinge: &Hinge<S>, base: usize) {
    state.counts.work += 40;
    let points = places(base, hinge.points);
    let Some(stand) = hinge.stand(at(&state.now, points)) else { return };
    let beyond = hinge.beyond(stand.angle);
    if beyond == S::ZERO {
        return;
    }
    // Joints take back a part of what frames are turned by: all that is lacking is to be left. Where they take nearly all the angle stays.
    let through = state.felt_through_joints(points.map(|point| point as usize), stand.slopes);
    let alone = weight(state, points, stand.slopes);
    let weight = through.map_or(alone, |through| through.max(alone * S::from_f64(LEAST_LEFT)));
    if weight <= S::ZERO {
        return;
    }
    let before = |stand: Stand<S>| hinge.beyond(stand.angle);
    let missed = hinge.stand(at(&state.start, points)).map_or(S::ZERO, before);
    // Only what is on the same side.
    let missed = if beyond > S::ZERO { missed.max(S::ZERO).min(beyond) } else { missed.min(S::ZERO).max(beyond) };
    let far = missed - missed.max(-S::from_f64(SLACK)).min(S::from_f64(SLACK));
    let slow = -far * S::from_f64(MENDED) / weight;
    for (point, slope) in points.into_iter().zip(stand.slopes) {
        let (i, w) = (point as usize, state.w[point as usize]);
        if !state.frames.is_empty() {
            state.push_point(i, scale(slope, slow), Change::Place);
            continue;
        }
        let creep = scale(slope, w * slow);
        state.start[i] = add(state.start[i], creep);
        state.now[i] = add(state.now[i], creep);
    }
    let multiplier = bounded(-(beyond - missed) / weight, weight);
    for (point, slope) in points.into_iter().zip(stand.slopes) {
        state.note_stop(point as usize, scale(slope, multiplier * state.w[point as usize]));
    }
    push_turning(state, hinge, points, stand.slopes, (multiplier, weight));
}

fn keep<S: Real>(state: &mut Cluster<S>, area: &Area<S>, base: usize) {
    let points = places(base, area.corners);
    let x = at(&state.now, points);
    let g = slopes(x);
    let weight = weight(state, points, g);
    if weight > S::ZERO {
        push(state, points, g, -(size(x) - area.rest) / weight);
    }
}

/// A multiplier that turns an angle by no more than is linear.
fn bounded<S: Real>(multiplier: S, weight: S) -> S {
    let most = S::from_f64(MOST_TURN) / weight;
    multiplier.max(-most).min(most)
}

/// The sum of w |g|^2.
pub(super) fn weight<S: Real>(state: &Cluster<S>, points: [u32; 3], slopes: [[S; 2]; 3]) -> S {
    if !state.frames.is_empty() {
        return state.felt_by_three(points.map(|point| point as usize), slopes);
    }
    points.iter().zip(slopes).fold(S::ZERO, |sum, (&point, g)| sum + state.w[point as usize] * dot(g, g))
}

/// Moves the points of an angle along its slopes, so that bodies in joints keep what they turn with: by no more than that, where `weight` says
/// that it turns them little.
pub(super) fn push_turning<S: Real>(
    state: &mut Cluster<S>,
    hinge: &Hinge<S>,
    points: [u32; 3],
    slopes: [[S; 2]; 3],
    (multiplier, weight): (S, S),
) {
    let is_gentle = (multiplier * weight).abs() <= S::from_f64(links::MOST_TURN);
    if !state.frames.is_empty()
        && is_gentle
        && let Some(begun) = hinge.stand(at(&state.start, points))
    {
        for (k, &point) in points.iter().enumerate() {
            state.turn_point(point as usize, [slopes[k], begun.slopes[k]].map(|slope| scale(slope, multiplier)));
        }
    }
    push(state, points, slopes, multiplier);
}

/// Moves three points along their slopes.
pub(super) fn push<S: Real>(state: &mut Cluster<S>, points: [u32; 3], slopes: [[S; 2]; 3], multiplier: S) {
    for (point, slope) in points.into_iter().zip(slopes) {
        let i = point as usize;
        if !state.frames.is_empty() {
            state.push_point(i, scale(slope, multiplier), Change::Way);
            continue;
        }
        let way = scale(slope, multiplier * state.w[i]);
        state.now[i] = add(state.now[i], way);
        state.way[i] = add(state.way[i], way);
    }
}
