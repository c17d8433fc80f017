//! What is tangled in live bodies: triangles inside out, skins that cross. Looked for once a step, where something pressed.
//!
//! ```text
//! couples   bodies whose skins cross for a while, or from the start: parted (`part.rs`)
//! knots     bodies with triangles inside out, or that cross themselves: led back to their shape (`mend.rs`)
//! ```

use super::cluster::{Cluster, Common};
use super::cross::{self, Crossing};
use super::layout::Sheet;
use super::mend::Piece;
use super::part::{self, Couple};
use crate::sim::force::area::size;
use crate::sim::real::Real;
use crate::sim::vector::zero;

/// Steps in which something presses after which crossings are looked for.
const EVERY: u8 = 8;
/// How long two bodies cross each other before they are parted `[s]`: contacts undo most by themselves.
const PATIENCE: f64 = 0.1;
/// Share of its area from which on a triangle is mended, and after how long `[s]`.
const LEAST: f64 = 0.02;
const FOLDED: f64 = 0.15;
/// Rings of triangles about those that go with them at first, and how long they are given before more do `[s]`.
const RINGS: u32 = 3;
const TRIED: f64 = 0.5;
/// How many times as fast they are led then, and at most.
const HASTE: f64 = 3.0;
const MOST_HASTE: f64 = 81.0;
/// How long all is right before a piece is let go `[s]`; what took longer than that to come right is held as long as it took: what lies on it
/// crushes it again.
const CALM: f64 = 0.1;
const LONG: f64 = 0.5;
/// How long a body is mended that crosses itself `[s]`: thin limbs that a body lies on are crushed again as soon as they are let go.
const MOST_MENDED: f64 = 2.0;
/// How quickly it is forgotten how long a body was mended, once it is right, where something presses and where nothing does `[s/s]`.
const FORGOTTEN: [f64; 2] = [0.2, 10.0];
/// How long a body that is inside out is led back before it may sleep so `[s]`: what lies on it is too heavy.
const MOST_AWAKE: f64 = 10.0;

/// A body with triangles inside out, or that crosses itself.
#[derive(Clone, Debug)]
pub(super) struct Knot<S> {
    /// Its number in the cluster, or in the group.
    pub(super) body: u32,
    /// What is led back to its shape.
    pub(super) pieces: Vec<Piece<S>>,
    /// How long it is so, how long ago its pieces were cut out, how long it is right again `[s]`.
    time: f64,
    tried: f64,
    calm: f64,
    rings: u32,
    /// It is inside out, not only across itself.
    is_folded: bool,
    /// How much faster than at first it is led: what lies on it may have been too heavy.
    haste: f64,
}

impl<S> Knot<S> {
    pub(super) fn is_mended(&self) -> bool {
        !self.pieces.is_empty()
    }
}

/// What is tangled in a cluster, or in all bodies.
#[derive(Clone, Debug)]
pub(super) struct Tangle<S> {
    pub(super) couples: Vec<Couple<S>>,
    pub(super) knots: Vec<Knot<S>>,
    /// Steps in which something pressed since crossings were looked for, one a body; [`u8::MAX`]: never looked.
    since: Vec<u8>,
    /// How long each body was mended of late `[s]`.
    mended: Vec<f64>,
    /// Bodies that led pins tore at, as long as they hold them or these are strained: what is in what there comes right by itself, but not against
    /// its skins.
    pub(super) torn: Vec<bool>,
    /// Points of the cluster that are led to their shapes; empty without any.
    pub(super) is_led: Vec<bool>,
}

impl<S> Default for Tangle<S> {
    fn default() -> Self {
        Tangle {
            couples: Vec::new(),
            knots: Vec::new(),
            since: Vec::new(),
            mended: Vec::new(),
            torn: Vec::new(),
            is_led: Vec::new(),
        }
    }
}

impl<S: Real> Tangle<S> {
    /// Of so many bodies that nothing is known of.
    pub(super) fn new(count: usize) -> Self {
        Tangle { since: vec![u8::MAX; count], mended: vec![0.0; count], torn: vec![false; count], ..Tangle::default() }
    }

    /// What is known of some bodies, numbered among them.
    pub(super) fn of(&self, bodies: &[usize]) -> Self {
        let place = |body: u32| bodies.binary_search(&(body as usize)).ok().map(|place| place as u32);
        let couple = |couple: &Couple<S>| {
            let [a, b] = couple.bodies.map(place);
            Some(Couple { bodies: [a?, b?], ..*couple })
        };
        let knot = |knot: &Knot<S>| place(knot.body).map(|body| Knot { body, ..knot.clone() });
        Tangle {
            couples: self.couples.iter().filter_map(couple).collect(),
            knots: self.knots.iter().filter_map(knot).collect(),
            since: bodies.iter().map(|&body| self.since[body]).collect(),
            mended: bodies.iter().map(|&body| self.mended[body]).collect(),
            torn: bodies.iter().map(|&body| self.torn[body]).collect(),
            is_led: Vec::new(),
        }
    }

    /// Nothing is.
    pub(super) fn is_empty(&self) -> bool {
        self.couples.is_empty() && self.knots.is_empty()
    }

    /// Takes over what another list knew of bodies that have these numbers here.
    pub(super) fn take_over(&mut self, other: &Self, bodies: &[Option<u32>]) {
        for (k, body) in bodies.iter().enumerate().filter_map(|(k, body)| Some((k, (*body)? as usize))) {
            (self.since[body], self.mended[body], self.torn[body]) = (other.since[k], other.mended[k], other.torn[k]);
        }
        let of = |body: u32| bodies[body as usize];
        let couple = |couple: &Couple<S>| {
            let [a, b] = couple.bodies.map(of);
            let (a, b) = (a?, b?);
            let out = if a < b { couple.out } else { couple.out.map(|x| -x) };
            Some(Couple { bodies: [a.min(b), a.max(b)], out, ..*couple })
        };
        let knot = |knot: &Knot<S>| of(knot.body).map(|body| Knot { body, ..knot.clone() });
        self.couples.extend(other.couples.iter().filter_map(couple));
        self.knots.extend(other.knots.iter().filter_map(knot));
        self.sort();
    }

    /// Whether a body, by its number in the group, is inside out or led back to its shape, and may still be: what is led may stand as it could not
    /// by itself.
    pub(super) fn is_opened(&self, body: usize) -> bool {
        let knot =
            self.knots.binary_search_by_key(&(body as u32), |knot| knot.body).ok().map(|place| &self.knots[place]);
        knot.is_some_and(|knot| (knot.is_folded || knot.is_mended()) && knot.time < MOST_AWAKE)
    }

    fn sort(&mut self) {
        self.couples.sort_by_key(|couple| couple.bodies);
        self.knots.sort_by_key(|knot| knot.body);
    }

    /// Notes what became of the bodies of clusters.
    pub(super) fn note(&mut self, clusters: &mut [Cluster<S>], h: f64) {
        for cluster in clusters {
            let Cluster { tangle, bodies, has_pressed, .. } = cluster;
            let is_own = |body: u32| bodies.binary_search(&(body as usize)).is_ok();
            self.couples.retain(|couple| !couple.bodies.iter().any(|&body| is_own(body)));
            self.knots.retain(|knot| !is_own(knot.body));
            let number = |place: u32| bodies[place as usize] as u32;
            self.couples
                .extend(tangle.couples.iter().map(|couple| Couple { bodies: couple.bodies.map(number), ..*couple }));
            self.knots.extend(tangle.knots.drain(..).map(|knot| Knot { body: number(knot.body), ..knot }));
            for (k, &body) in bodies.iter().enumerate() {
                self.since[body] = tangle.since[k].saturating_add(u8::from(*has_pressed));
                let forgotten = if *has_pressed { 0.0 } else { h * FORGOTTEN[1] };
                self.mended[body] = (tangle.mended[k] - forgotten).max(0.0);
                self.torn[body] = tangle.torn[k];
            }
        }
        self.sort();
    }
}

/// Looks what is tangled at the start of a step of `h` `[s]`.
pub(super) fn look<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: f64) {
    if common.contact.is_none() {
        return;
    }
    let mut tangle = std::mem::take(&mut state.tangle);
    let is_new = tangle.since.contains(&u8::MAX);
    let is_due = is_new || tangle.since.iter().any(|&since| since >= EVERY);
    let is_looked = is_due || !tangle.couples.is_empty() || !tangle.knots.is_empty();
    let crossings = if is_looked {
        state.counts.looks += 1;
        state.counts.work += 40 * state.edges.len() as u64;
        tangle.since.iter_mut().for_each(|since| *since = 0);
        cross::list(state, common.bodies)
    } else {
        Vec::new()
    };
    let first = if is_new { FOLDED.max(PATIENCE) } else { 0.0 };
    couples(state, &mut tangle, &crossings, (h, first));
    let folded = folded(state, common);
    if !crossings.is_empty() || !tangle.knots.is_empty() || !folded.is_empty() {
        knots(state, common, &mut tangle, (&crossings, &folded), (h, first));
    } else {
        tangle.mended.iter_mut().for_each(|mended| *mended = (*mended - h * FORGOTTEN[0]).max(0.0));
    }
    state.tangle = tangle;
}

/// Bodies that cross each other now.
fn couples<S: Real>(state: &mut Cluster<S>, tangle: &mut Tangle<S>, crossings: &[Crossing<S>], (h, first): (f64, f64)) {
    let old = std::mem::take(&mut tangle.couples);
    let are_asked = first > 0.0 || old.iter().any(Couple::is_parted);
    let swallowed = if are_asked { cross::swallowed(state) } else { Vec::new() };
    let state = &*state;
    let known = |bodies: [u32; 2]| old.binary_search_by_key(&bodies, |couple| couple.bodies).ok().map(|k| old[k]);
    let mut add = |bodies: [u32; 2], crossings: &[Crossing<S>]| {
        let mut couple = known(bodies).unwrap_or(Couple { bodies, time: first, out: zero() });
        couple.time += h;
        // What is led back to its shape is not to be held by what it lies in.
        let is_led = tangle.knots.iter().any(|knot| knot.is_mended() && bodies.contains(&knot.body));
        if (couple.time >= PATIENCE || is_led) && couple.may_be_led() {
            couple.out = part::way_out(state, bodies, crossings);
        }
        tangle.couples.push(couple);
    };
    for group in crossings.chunk_by(|a, b| a.bodies == b.bodies) {
        if group[0].bodies[0] != group[0].bodies[1] {
            add(group[0].bodies, group);
        }
    }
    if are_asked {
        let is_crossed = |bodies: &[u32; 2]| crossings.binary_search_by_key(bodies, |crossing| crossing.bodies).is_ok();
        for bodies in swallowed.into_iter().filter(|bodies| !is_crossed(bodies)) {
            add(bodies, &[]);
        }
        tangle.couples.sort_by_key(|couple| couple.bodies);
    }
}

/// Triangles that are too flat, by their bodies: body and number in it.
fn folded<S: Real>(state: &mut Cluster<S>, common: &Common<S>) -> Vec<(u32, u32)> {
    let least = S::from_f64(LEAST);
    let mut found = Vec::new();
    for (k, (body, base)) in state.members(common).enumerate() {
        let areas = common.areas(body);
        state.counts.work += 8 * areas.len() as u64;
        for (area, number) in areas.iter().zip(0..) {
            if size(area.corners.map(|corner| state.now[base + corner as usize])) <= least * area.rest {
                found.push((k as u32, number));
            }
        }
    }
    found
}

/// Bodies that are inside out or cross themselves now.
fn knots<S: Real>(
    state: &Cluster<S>,
    common: &Common<S>,
    tangle: &mut Tangle<S>,
    (crossings, folded): (&[Crossing<S>], &[(u32, u32)]),
    (h, first): (f64, f64),
) {
    let mut old = std::mem::take(&mut tangle.knots).into_iter().peekable();
    for (k, (body, _)) in (0..).zip(state.members(common)) {
        let own = &folded[folded.partition_point(|entry| entry.0 < k)..folded.partition_point(|entry| entry.0 <= k)];
        let [from, to] = [[k, k], [k, k + 1]].map(|key| crossings.partition_point(|crossing| crossing.bodies < key));
        let before = old.next_if(|knot| knot.body == k);
        let mended = &mut tangle.mended[k as usize];
        let meets_itself = common.contact.is_some_and(|contact| contact.with_itself);
        let minds = meets_itself && body.areas.len() > 0 && *mended < MOST_MENDED;
        let own_crossings: Vec<Crossing<S>> = if minds {
            crossings[from..to].iter().filter(|crossing| !cross::is_crease(state, crossing)).copied().collect()
        } else {
            Vec::new()
        };
        let is_bad = !own_crossings.is_empty() || !own.is_empty();
        *mended += if is_bad && before.as_ref().is_some_and(Knot::is_mended) { h } else { 0.0 };
        if before.is_none() && !is_bad {
            continue;
        }
        let fresh = || Knot {
            body: k,
            pieces: Vec::new(),
            time: first,
            tried: TRIED,
            calm: 0.0,
            rings: RINGS,
            is_folded: false,
            haste: 1.0,
        };
        let mut knot = before.unwrap_or_else(fresh);
        knot.is_folded = !own.is_empty();
        knot.calm = if is_bad { 0.0 } else { knot.calm + h };
        knot.time += h;
        knot.tried += h;
        let held = if *mended > LONG { *mended } else { CALM };
        if knot.calm >= held || (knot.pieces.is_empty() && !is_bad) {
            continue;
        }
        let begins = knot.pieces.is_empty() && knot.time >= FOLDED;
        if is_bad && knot.tried >= TRIED && (begins || knot.is_mended()) {
            if !begins {
                (knot.rings, knot.haste) = (knot.rings.saturating_mul(4), (HASTE * knot.haste).min(MOST_HASTE));
            }
            knot.tried = 0.0;
            knot.cut_out(state, common, (own, &own_crossings));
        }
        tangle.knots.push(knot);
    }
    tangle.is_led.clear();
    if tangle.knots.iter().any(Knot::is_mended) {
        tangle.is_led.resize(state.own(), false);
        for knot in &tangle.knots {
            let base = state.bases[knot.body as usize];
            let points = knot.pieces.iter().flat_map(Piece::points);
            points.for_each(|point| tangle.is_led[(base + point) as usize] = true);
        }
    }
}

impl<S: Real> Knot<S> {
    /// Cuts out what is led back: what is folded or crosses, with some rings about it; all of a body that crosses itself far from there.
    fn cut_out(
        &mut self,
        state: &Cluster<S>,
        common: &Common<S>,
        (folded, crossings): (&[(u32, u32)], &[Crossing<S>]),
    ) {
        let body = &common.bodies.list[state.bodies[self.body as usize]];
        let base = state.bases[self.body as usize] as usize;
        let sheet = Sheet::new(state, common, (body, base));
        let mut points = vec![false; body.points.len()];
        let areas = common.areas(body);
        for &(_, number) in folded {
            areas[number as usize].corners.iter().for_each(|&corner| points[corner as usize] = true);
        }
        let ends = crossings.iter().flat_map(|crossing| crossing.ends).flatten();
        ends.for_each(|end| points[end as usize - base] = true);
        let mut shapes = sheet.shapes(&sheet.around(&points, self.rings));
        if shapes.len() > 1 && !crossings.is_empty() {
            shapes = sheet.shapes(&vec![true; body.points.len()]);
        }
        self.pieces = shapes.into_iter().filter_map(|shape| Piece::new(state, (base, shape), self.haste)).collect();
    }
}
