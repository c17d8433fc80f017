//! Bonds of a cluster: forces where a substep resolves them, projections where it does not.

use super::body::{Body, Link};
use super::cluster::{Cluster, Common};
use super::rigid::{Change, goes_with_frame};
use super::strap::stretches;
use super::{FRAMES, areas, part, tree};
use crate::sim::bond::Limit;
use crate::sim::kernels::level::vectorized;
use crate::sim::kernels::links::{self, Entry, Links, Moved, Turned};
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub};

/// Most of (w h)^2 at which springs are forces where dampers take the fastest oscillations away within a frame, and where they go on: 4 would be the
/// edge of stability, what is squeezed to half swings half as much again, and the energy of what swings so fast is a quarter of (w h)^2 less
/// than it seems. Most of that and twice the decay in a substep, and of the decay where there is work for that many substeps.
const MOST_PHASE: [f64; 2] = [2.0, 1.0];
const MOST_OF_BOTH: f64 = 2.7;
const FINE_DECAY: f64 = 0.25;
/// Decay from which on oscillations are away within a frame `[1/s]`.
const GONE: f64 = 2.0 * FRAMES;
/// Share of the points of a body that is to swing by forces: where some are so light that they would need many more substeps, the springs at
/// these are projected.
pub(super) const MOST_BY_FORCES: f64 = 0.9;
/// Share of its length at rest down to which a spring is a force.
const BORNE: f64 = 0.5;
/// Share of its springs that may be shorter until all of a body with an inside are projected; of others none may.
const MOST_CRUSHED: f64 = 0.05;
/// Angle by which a bond may turn in a substep, about, without being asked what that takes: less than 1e-3 of the speed in a second.
const TURNED: f64 = 5e-4;
/// Share of an error that a bond takes away at once from which on it is hard; and where some points are much heavier than others: what bears them
/// is pressed short by each pass.
const HARD: [f64; 2] = [0.99, 0.5];

/// Whether a spring whose ends swing like this may be a force in substeps of `h` `[s]`: by bounds on the square of the fastest oscillation
/// `[1/s^2]` and on the fastest decay `[1/s]`.
pub(super) fn bears<S: Real>([stiffness, decay]: [S; 2], h: S) -> bool {
    let phase = stiffness * h * h;
    phase <= S::from_f64(most_phase(decay.to_f64())) && phase + (decay + decay) * h <= S::from_f64(MOST_OF_BOTH)
}

fn most_phase(decay: f64) -> f64 {
    MOST_PHASE[usize::from(decay < GONE)]
}

/// Substeps of a frame that springs whose ends swing like this need to be forces, and to be exact ones.
pub(super) fn substeps([stiffness, decay]: [f64; 2]) -> [f64; 2] {
    // The longest substep h has stiffness h^2 + 2 decay h = MOST_OF_BOTH.
    let both = (decay + (decay * decay + MOST_OF_BOTH * stiffness).sqrt()) / MOST_OF_BOTH;
    let [few, fine] = [most_phase(decay), MOST_PHASE[1]].map(|phase| (stiffness / phase).sqrt().max(both));
    [few, fine.max(decay / FINE_DECAY)].map(|rate| (rate / FRAMES).ceil())
}

/// What springs that are forces give to velocities in `h` `[s]`.
pub(super) fn pull<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    let pulls = std::mem::take(&mut state.pulls);
    let Cluster { now, velocity, w, .. } = &mut *state;
    let mut moved = Moved { now, rate: velocity, w };
    vectorized!(m => links::sweep::<_, _, false>(m, &pulls, &mut moved, None));
    let count = (pulls.len() + state.odd_pulls.len()) as u64;
    state.pulls = pulls;
    state.counts.bonds += count;
    state.counts.work += 30 * count;
    for k in 0..state.odd_pulls.len() {
        let (body, link) = state.odd_pulls[k];
        pull_one(state, &common.bodies.springs[link as usize], (state.bases[body as usize] as usize, h));
    }
}

fn pull_one<S: Real>(state: &mut Cluster<S>, link: &Link<S>, (base, h): (usize, S)) {
    let (a, b) = (base + link.a as usize, base + link.b as usize);
    let d = sub(state.now[a], state.now[b]);
    let length = dot(d, d).sqrt();
    let v = sub(state.velocity[a], state.velocity[b]);
    let force = match link.rest == S::ZERO {
        true => add(scale(d, link.stiffness), scale(v, link.damping)),
        false if length == S::ZERO || is_slack(link, length) => return,
        false => {
            let along = scale(d, S::ONE / length);
            scale(along, link.stiffness * (length - link.rest) + link.damping * dot(v, along))
        }
    };
    state.velocity[a] = sub(state.velocity[a], scale(force, h * state.w[a]));
    state.velocity[b] = add(state.velocity[b], scale(force, h * state.w[b]));
}

/// A spring that is a force, as the kernel takes it; `None`: it is slack on one side, or has no length or stiffness.
fn plain_pull<S: Real>(link: &Link<S>, base: usize, h: S) -> Option<Entry<S>> {
    let is_plain = link.limit == Limit::Both && link.rest > S::ZERO && link.stiffness > S::ZERO;
    is_plain.then(|| Entry {
        ends: [base as u32 + link.a, base as u32 + link.b],
        rest: link.rest,
        gain: link.stiffness * h,
        drag: link.damping / link.stiffness,
    })
}

fn is_slack<S: Real>(link: &Link<S>, length: S) -> bool {
    match link.limit {
        Limit::Both => false,
        Limit::Max => length <= link.rest,
        Limit::Min => length >= link.rest,
    }
}

/// What a bond that is projected needs, worked out once for all substeps of `h` `[s]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hold<S> {
    a: u32,
    b: u32,
    rest: S,
    /// Of an error what the multiplier is.
    inverse: S,
    /// What the damper adds to an error for each metre of the way.
    drag: S,
    most: S,
    limit: Limit,
    is_rigid: bool,
    /// A rigid one with a limit: it gets taut with a jerk, which gives nothing back.
    jerks: bool,
    /// It takes but a share of the error, or a limited one.
    is_relaxed: bool,
    /// Which member of the cluster it is of, if the rest lengths of that are stretched where pins are led too far apart.
    strapped: Option<u32>,
    /// What the inverse masses of its ends are added to, where some end goes with a frame: it feels those in its direction; and the share of the
    /// error.
    framed: Option<[S; 2]>,
}

impl<S: Real> Hold<S> {
    /// `None` of a bond that cannot pull.
    fn new(
        link: &Link<S>,
        (base, strapped): (usize, Option<u32>),
        (w, frame_of): (&[S], &[[u32; 2]]),
        h: S,
    ) -> Option<Self> {
        let (a, b) = (base as u32 + link.a, base as u32 + link.b);
        let sum = w[a as usize] + w[b as usize];
        let is_rigid = !link.stiffness.is_finite();
        let softness = if is_rigid { S::ZERO } else { S::ONE / (link.stiffness * h * h) };
        let drag = if is_rigid { S::ZERO } else { link.damping / (link.stiffness * h) };
        let [share, most] = link.relaxed.map_or([S::ONE, S::INFINITY], |relaxed| relaxed.within(h));
        let inverse = share / ((S::ONE + drag) * sum + softness);
        let is_framed = [a, b].iter().any(|&i| goes_with_frame(frame_of, i as usize));
        (sum > S::ZERO && link.stiffness > S::ZERO).then_some(Hold {
            a,
            b,
            rest: link.rest,
            inverse,
            drag,
            most,
            limit: link.limit,
            is_rigid,
            jerks: is_rigid && link.limit != Limit::Both,
            is_relaxed: share < S::ONE || most.is_finite(),
            strapped: strapped.filter(|_| is_rigid),
            framed: is_framed.then_some([softness, share]),
        })
    }

    /// It acts both ways and without bounds, as the kernel does.
    fn is_plain(&self) -> bool {
        self.limit == Limit::Both && !self.most.is_finite() && self.framed.is_none() && self.strapped.is_none()
    }

    /// It gives hardly at all: what moves its ends again is to be answered in the same substep.
    fn is_hard(&self, w: &[S], least: S) -> bool {
        (S::ONE + self.drag) * (w[self.a as usize] + w[self.b as usize]) * self.inverse >= least
    }

    fn entry(&self) -> Entry<S> {
        Entry { ends: [self.a, self.b], rest: self.rest, gain: self.inverse, drag: self.drag }
    }
}

/// Notes the points at which springs are squeezed beyond what forces bear; all where that is so of many.
fn note_crushed<S: Real>((body, springs): (&Body<S>, &[Link<S>]), now: &[[S; 2]], crushed: &mut [bool]) {
    let squeezed = springs.iter().filter(|link| is_crushed(link, now));
    let mut count = 0;
    for link in squeezed {
        count += 1;
        (crushed[link.a as usize], crushed[link.b as usize]) = (true, true);
    }
    let most = if body.areas.len() > 0 { MOST_CRUSHED } else { 0.0 };
    if count as f64 > most * springs.len() as f64 {
        crushed.fill(true);
    }
}

/// Whether a spring is squeezed beyond what forces bear.
fn is_crushed<S: Real>(link: &Link<S>, now: &[[S; 2]]) -> bool {
    let d = sub(now[link.a as usize], now[link.b as usize]);
    let (square, rest) = (dot(d, d), link.rest * link.rest);
    link.limit == Limit::Both && rest > S::ZERO && (square < S::from_f64(BORNE * BORNE) * rest || !square.is_finite())
}

/// Works out what the bonds of a cluster need in substeps of `h` `[s]`, in lists of their own: those that pull and those that are
/// projected, what kernels take and what they do not.
pub(super) fn prepare<S: Real>(state: &mut Cluster<S>, common: &Common<S>, h: S) {
    let members = state.members(common);
    let may_swing = !state.is_violent && !part::owes(state);
    let least_hard = S::from_f64(HARD[usize::from(state.is_uneven)]);
    let Cluster {
        pulls, odd_pulls, firm, slow, is_all_rigid, hard, holds, w, settles, by_forces, now, frame_of, ..
    } = state;
    pulls.clear(w.len());
    slow.clear(w.len());
    hard.clear(w.len());
    odd_pulls.clear();
    firm.clear(w.len());
    holds.clear();
    by_forces.clear();
    // Springs that are projected give and take: turned back they would gain.
    *is_all_rigid = true;
    let mut crushed = Vec::new();
    for (k, (body, base)) in members.enumerate() {
        // What settles or owes energy is to come to rest, and what is squeezed or struck hard is to stay whole.
        let may_swing = may_swing && !settles[k];
        let first = by_forces.len();
        crushed.clear();
        crushed.resize(body.points.len(), false);
        if may_swing {
            note_crushed((body, common.springs(body)), &now[base..], &mut crushed);
        }
        for ((link, &swing), number) in common.springs(body).iter().zip(common.swings(body)).zip(body.springs.first..) {
            let is_whole = !crushed[link.a as usize] && !crushed[link.b as usize];
            let is_force = may_swing && bears(swing, h) && is_whole;
            by_forces.push(is_force);
            if is_force {
                match plain_pull(link, base, h) {
                    Some(entry) => pulls.push(entry),
                    None => odd_pulls.push((k as u32, number)),
                }
            }
        }
        let springs = common.springs(body).iter().zip(&by_forces[first..]).filter(|(_, is_force)| !**is_force);
        let rigid = common.holds(body)[body.tree as usize..].iter();
        let own = (base, (!body.straps.is_empty()).then_some(k as u32));
        for hold in springs.map(|(link, _)| link).chain(rigid).filter_map(|link| Hold::new(link, own, (w, frame_of), h))
        {
            if !hold.is_plain() {
                holds.push(hold);
                continue;
            }
            *is_all_rigid &= hold.is_rigid;
            let list = if hold.is_relaxed { &mut *slow } else { &mut *firm };
            list.push(hold.entry());
            if hold.is_hard(w, least_hard) {
                hard.push(hold.entry());
            }
        }
    }
    *is_all_rigid &= firm.len() + slow.len() > 0;
    pulls.finish();
    slow.finish();
    firm.finish();
    hard.finish();
}

/// One sweep over the bonds that are held, and over springs too stiff to be forces, each along its present direction.
pub(super) fn hold<S: Real>(state: &mut Cluster<S>, common: &Common<S>) {
    for (k, (body, base)) in state.members(common).enumerate().filter(|(_, (body, _))| body.tree > 0) {
        let phase = tree::solve(state, &common.holds(body)[..body.tree as usize], (body, base));
        state.swings[k].seen += (phase / state.span).to_f64();
    }
    state.does_turn = state.is_all_rigid && turns(state);
    let firm = std::mem::take(&mut state.firm);
    sweep(state, &firm);
    state.firm = firm;
    let slow = std::mem::take(&mut state.slow);
    if slow.len() > 0 {
        state.relax(|state| sweep(state, &slow));
    }
    state.slow = slow;
    let stretches = stretches(state.members(common).map(|(body, base)| (&body.straps[..], base)), &state.now);
    let holds = std::mem::take(&mut state.holds);
    project(state, &holds, &stretches);
    state.holds = holds;
}

/// Whether points of a body go so far against each other in this substep that bonds may turn.
fn turns<S: Real>(state: &Cluster<S>) -> bool {
    let least = state.least_promise * S::from_f64(TURNED / super::gather::PROMISE);
    state.bases.windows(2).any(|ends| areas::spread(&state.way[ends[0] as usize..ends[1] as usize]) > least)
}

/// One more sweep over bonds that hardly give, where contacts moved their ends: without it a body that is stiff is dented by what presses
/// it, though only by a thousandth of its size.
pub(super) fn hold_again<S: Real>(state: &mut Cluster<S>) {
    if state.hard.len() == 0 || !state.is_pressed() {
        return;
    }
    let hard = std::mem::take(&mut state.hard);
    sweep(state, &hard);
    state.hard = hard;
}

/// Takes from velocities what would change the length of rigid bonds, trees apart, in one sweep. Returns how many there are.
pub(super) fn stiffen<S: Real>(state: &mut Cluster<S>, common: &Common<S>) -> u64 {
    let mut count = 0;
    for (body, base) in state.members(common) {
        let rigid = &common.holds(body)[body.tree as usize..];
        for link in rigid
            .iter()
            .filter(|link| !link.stiffness.is_finite() && link.limit == Limit::Both && link.relaxed.is_none())
        {
            let (a, b) = (base + link.a as usize, base + link.b as usize);
            let d = sub(state.now[a], state.now[b]);
            let weight = dot(d, d) * (state.w[a] + state.w[b]);
            if weight > S::ZERO {
                let push = scale(d, dot(sub(state.velocity[a], state.velocity[b]), d) / weight);
                state.velocity[a] = sub(state.velocity[a], scale(push, state.w[a]));
                state.velocity[b] = add(state.velocity[b], scale(push, state.w[b]));
                count += 1;
            }
        }
    }
    state.counts.bonds += count;
    state.counts.work += 30 * count;
    count
}

/// One sweep over bonds that kernels take.
fn sweep<S: Real>(state: &mut Cluster<S>, links: &Links<S>) {
    let does_turn = state.does_turn;
    let Cluster { now, way, w, start, turned, .. } = &mut *state;
    let mut moved = Moved { now, rate: way, w };
    let mut turned = Turned { start, turned };
    vectorized!(m => links::sweep::<_, _, true>(m, links, &mut moved, does_turn.then_some(&mut turned)));
    state.counts.bonds += links.len() as u64;
    state.counts.work += 30 * links.len() as u64;
}

/// Bonds that no kernel takes: each in turn as a compliant constraint whose multiplier starts at 0, its rest length stretched as its member
/// asks.
fn project<S: Real>(state: &mut Cluster<S>, holds: &[Hold<S>], stretches: &[S]) {
    state.counts.bonds += holds.len() as u64;
    state.counts.work += 30 * holds.len() as u64;
    for hold in holds {
        let Cluster { now, way, w, start, turned, .. } = &mut *state;
        let (a, b) = (hold.a as usize, hold.b as usize);
        let d = sub(now[a], now[b]);
        let length = dot(d, d).sqrt();
        let rest = hold.strapped.map_or(hold.rest, |member| hold.rest * stretches[member as usize]);
        let is_slack = match hold.limit {
            Limit::Both => false,
            Limit::Max => length <= rest,
            Limit::Min => length >= rest,
        };
        if length == S::ZERO || is_slack {
            continue;
        }
        let along = scale(d, S::ONE / length);
        let mut error = length - rest;
        if hold.drag != S::ZERO {
            error += hold.drag * dot(sub(way[a], way[b]), along);
        }
        if hold.most.is_finite() {
            let most = hold.most * length;
            error = error.max(-most).min(most);
        }
        if let Some([softness, share]) = hold.framed {
            let felt = state.felt(a, along) + state.felt(b, along);
            let push = scale(along, error * share / ((S::ONE + hold.drag) * felt + softness));
            state.push_point(a, scale(push, -S::ONE), Change::Way);
            state.push_point(b, push, Change::Way);
            for (i, goes) in [(a, -S::ONE), (b, S::ONE)] {
                let way = scale(push, goes * state.w[i]);
                match hold.is_relaxed {
                    true => state.note_relaxed(i, way),
                    false if hold.jerks => state.note_stop(i, way),
                    false => {}
                }
            }
            continue;
        }
        let shift = scale(along, error * hold.inverse);
        let before = [turned[a], turned[b]];
        if hold.is_rigid {
            Turned { start, turned }.note([a, b], [w[a], w[b]], shift);
        }
        let shifts = [(a, scale(shift, -w[a])), (b, scale(shift, w[b]))];
        let changes = [sub(turned[a], before[0]), sub(turned[b], before[1])];
        for (i, own) in shifts {
            now[i] = add(now[i], own);
            way[i] = add(way[i], own);
        }
        if hold.is_relaxed {
            shifts.into_iter().zip(changes).for_each(|((i, own), change)| state.note_relaxed(i, add(own, change)));
        } else if hold.jerks {
            shifts.into_iter().for_each(|(i, own)| state.note_stop(i, own));
        }
    }
}
