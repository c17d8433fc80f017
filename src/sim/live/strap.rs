//! Rigid bonds between pins that are led further apart than these bonds reach: all of the body are stretched alike, by as much as that takes.
//!
//! No motion keeps lengths that the pins contradict. Asked for one by one they throw what hangs between the pins about, for a straight
//! row can only give way across. With one stretch for all they agree, and what is taut is straight.

use super::Draft;
use crate::sim::bond::{Bond, PointId};
use crate::sim::reach::{Reach, reaches};
use crate::sim::real::Real;
use crate::sim::vector::{length, sub, widen};

/// Bonds that are gone along from all led pins of a body, about: of a large body with many of these the first are looked at.
const MOST_WAYS: usize = 50_000;

/// Share of its reach from which on a strap is as good as taut `[1]`.
const NEARLY: f64 = 0.98;

/// Two pins of a body, of which one at least is led, and how far apart its rigid bonds let them be `[m]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strap<S> {
    ends: [u32; 2],
    most: S,
}

/// The straps of a body of these bonds and points: the first are numbered as in the group, `local` says which number they have in it.
pub(super) fn straps<S: Real>(
    bonds: &[Bond],
    (points, local): (&[u32], &[u32]),
    led: &[u32],
    is_pinned: impl Fn(u32) -> bool,
) -> Vec<Strap<S>> {
    let is_led = |point: &&u32| led.binary_search(point).is_ok();
    let mut from: Vec<PointId> = points.iter().filter(is_led).map(|&point| PointId(point)).collect();
    if from.is_empty() || bonds.is_empty() {
        return Vec::new();
    }
    let mut held: Vec<PointId> =
        points.iter().filter(|&&point| is_pinned(point)).map(|&point| PointId(point)).collect();
    from.sort_unstable();
    from.truncate((MOST_WAYS / bonds.len()).max(1));
    held.sort_unstable();
    let strap = |reach: Reach| {
        let [a, b] = reach.pins.map(|pin| local[pin.index()]);
        Strap { ends: [a, b], most: S::from_f64(reach.most) }
    };
    reaches(bonds.iter().copied(), &from, &held).into_iter().map(strap).filter(|strap| strap.most > S::ZERO).collect()
}

/// Whether tracks lead pins of a body further apart than its bonds reach, or almost; `points` are numbered as in the group.
pub(super) fn is_led_apart<S: Real, const D: usize>(
    straps: &[Strap<S>],
    (points, place): (&[u32], impl Fn(u32) -> [S; D]),
    draft: &Draft<S>,
) -> bool {
    let places = |end: u32| -> Vec<[f64; D]> {
        let point = points[end as usize];
        let now = widen(place(point));
        let knots = draft.led.binary_search(&point).map_or(&[][..], |k| &draft.knots[k]);
        knots.iter().map(|knot| std::array::from_fn(|k| knot[k])).chain([now]).collect()
    };
    straps.iter().any(|strap| {
        let [first, second] = strap.ends.map(places);
        let most = NEARLY * strap.most.to_f64();
        first.iter().any(|a| second.iter().any(|b| length(sub(*a, *b)) > most))
    })
}

/// What the rest lengths of a body whose points are at `now` `[m]` are to be multiplied by `[1]`: 1, where its pins are near enough.
#[inline]
pub(super) fn stretch<S: Real, const D: usize>(straps: &[Strap<S>], now: &[[S; D]]) -> S {
    tautness(straps, now).max(S::ONE)
}

/// How far apart pins are, as a share of what is between them, at most `[1]`: above 1 that is to be stretched.
#[inline]
pub(super) fn tautness<S: Real, const D: usize>(straps: &[Strap<S>], now: &[[S; D]]) -> S {
    straps.iter().fold(S::ZERO, |most, strap| {
        let [a, b] = strap.ends.map(|end| now[end as usize]);
        most.max(length(sub(a, b)) / strap.most)
    })
}

/// The same of each of several bodies, with the places at which their points begin: up to the last that has straps.
pub(super) fn stretches<'a, S: Real, const D: usize>(
    bodies: impl Iterator<Item = (&'a [Strap<S>], usize)>,
    now: &[[S; D]],
) -> Vec<S> {
    let mut list = Vec::new();
    for (place, (straps, base)) in bodies.enumerate().filter(|(_, (straps, _))| !straps.is_empty()) {
        list.resize(place, S::ONE);
        list.push(stretch(straps, &now[base..]));
    }
    list
}
