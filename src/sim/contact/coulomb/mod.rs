//! Coulomb's law where bodies touch surfaces: all impulses of a moment together.
//!
//! ```text
//! v+ = v- + W P        W: how all velocities at the touching points answer to the impulses at them
//! v_n+ >= target,  P_n >= 0,  P_n (v_n+ - target) = 0        |P_t| <= friction P_n, against the sliding
//! ```
//!
//! What slides on when the moment begins is rubbed against its way; what does not is held, as far as friction goes. The tangential impulse
//! is limited by the normal impulse of the same moment. Gone through contact by contact (Gauss and Seidel's method) until nothing
//! changes: of a line of touching points the two ends are enough, so there are few. Those without friction that answer strongly to each other are
//! gone through as one (`smooth.rs`). What one contact gives, the others as they are, is all that the plane (`line.rs`) and space (`disc.rs`)
//! find in ways of their own.

pub(crate) mod coupled;
pub(crate) mod disc;
pub(crate) mod line;
mod smooth;

use std::borrow::Cow;

use crate::sim::vector::{add, scale, sub};

/// Share of an energy that is rounding.
const ROUNDING: f64 = 1e-13;
/// Change of a motion, relative to the fastest, that is none.
const NOTHING: f64 = 1e-15;
/// Share of what a contact gives across and along below which two of its directions are one.
const REPEATED: f64 = 1e-9;
/// Halvings in which the restitution is found that adds no energy, and how often in them all contacts are gone through at most, in what a
/// single one may take.
const HALVINGS: u32 = 30;
const HALVED: u32 = 4;
/// Shares of friction with which an impact is looked for, one after the other, until there is one.
const EASED: [f64; 3] = [1.0, 0.25, 0.0];
/// Share of the speed that is to come back below which impulses that find no end have failed `[1]`.
const RETURNED: f64 = 0.5;
/// Share of the fastest hit by which such impulses may leave a contact slower off its surface than that `[1]`.
const SLIGHT: f64 = 1e-3;

/// Impulses of a contact in the plane, along its normal and across it `[kg m/s]`.
pub(crate) type Impulse = [f64; 2];

/// What the law asks of a contact: vectors are along its normal, then along its tangents, of which there is one in the plane, (-n_y, n_x).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rub<const N: usize = 2> {
    pub(crate) friction: f64,
    /// Share of the speed across that comes back: 0 of what lies there or is slow.
    pub(crate) restitution: f64,
    /// Which way it slides for all of the moment, as a unit vector along its tangents; 0: friction may hold it.
    pub(crate) slides: [f64; N],
    /// The least speed across afterwards, and the velocity along where friction holds it `[m/s]`.
    pub(crate) target: [f64; N],
}

impl<const N: usize> Rub<N> {
    /// Nothing rubs, and nothing comes back.
    pub(crate) const SMOOTH: Self = Rub { friction: 0.0, restitution: 0.0, slides: [0.0; N], target: [0.0; N] };

    /// Whether it slides for all of the moment.
    #[inline]
    pub(crate) fn is_sliding(&self) -> bool {
        self.slides.iter().any(|x| *x != 0.0)
    }
}

/// Friction at one contact: what it gives, the others as they are.
pub(crate) trait Friction<const N: usize> {
    /// Most times that all contacts are gone through.
    const MOST_PASSES: u32;
    /// Operations of a contact that is gone through once, about.
    const OF_A_CONTACT: u64;

    /// The impulse of one contact: it is free, held or slides.
    ///
    /// Shapes: what impulses of 1 change of its own velocity, row by row `[1/kg]`; its impulse up to now `[kg m/s]` and its velocity with that
    /// `[m/s]`.
    fn solve(gives: &[[f64; N]; N], rub: &Rub<N>, old: [f64; N], speed: [f64; N]) -> [f64; N];
}

/// What impulses at contacts move.
pub(crate) trait Answers<const N: usize>: Sized {
    type Motion: Clone;
    type Friction: Friction<N>;

    /// Velocity of a contact, by its number, across and along its surface `[m/s]`.
    fn speeds(&self, contact: usize, motion: &Self::Motion) -> [f64; N];

    /// What impulses of 1 change of the contact's own velocity, row by row `[1/kg]`.
    fn gives(&self, contact: usize) -> [[f64; N]; N];

    /// The motion after an impulse.
    fn pushed(&self, contact: usize, impulse: [f64; N], motion: Self::Motion) -> Self::Motion;

    /// Kinetic energy, but for what cannot move `[J]`.
    fn energy(&self, motion: &Self::Motion) -> f64;

    /// It stands still.
    fn stopped(&self, motion: &Self::Motion) -> Self::Motion;

    /// It goes back as it came, at this share of its speed; `None` of what cannot be led so.
    fn reversed(&self, _motion: &Self::Motion, _share: f64) -> Option<Self::Motion> {
        None
    }

    /// A mass and a moment of inertia that are no less than those of what moves.
    fn heaviest(&self) -> f64;

    /// Most times that so many contacts are gone through.
    fn most_passes(&self, _contacts: usize) -> u32 {
        Self::Friction::MOST_PASSES
    }

    /// Contacts without friction whose impulses are found together, by their numbers.
    fn smooth(&self) -> &[usize] {
        &[]
    }

    /// What an impulse of 1 across one of those changes of the velocity across another `[1/kg]`.
    fn crosses(&self, _contact: usize, _other: usize) -> f64 {
        0.0
    }

    /// Share of an energy that is rounding.
    fn rounding(&self) -> f64 {
        ROUNDING
    }

    /// What becomes of a motion where the law has no answer, and the nearest that was found has more energy than there was.
    fn give_up(&self, before: &Self::Motion, found: Pressed<Self::Motion, N>) -> Pressed<Self::Motion, N> {
        stop(self, before, found.impulses.len())
    }
}

/// What impulses made of a motion.
#[derive(Clone, Debug)]
pub(crate) struct Pressed<M, const N: usize = 2> {
    pub(crate) motion: M,
    /// Of each contact.
    pub(crate) impulses: Vec<[f64; N]>,
    /// What impulses across and along took `[J]`.
    pub(crate) taken: [f64; 2],
    /// How often all contacts were gone through, and whether nothing changed any more: of what is held on all sides it may go on for ever.
    pub(crate) passes: u32,
    pub(crate) has_converged: bool,
    /// The law had no answer: it was stopped.
    pub(crate) is_stopped: bool,
    /// Share of the motion that was left to it, so that it has no more energy than there was.
    pub(crate) share: f64,
}

/// An impact: contacts that close give back what their restitution says, with no more energy than there was.
///
/// Where friction wedges what is to come back, so that no impulse does both, as a lever that meets a surface all but below its pin, the law
/// has no answer: with less friction it has one. What is caught between surfaces that all but face each other goes back as it came. Bodies in
/// joints, which cannot, are taken as the law leaves them.
pub(crate) fn strike<A: Answers<N>, const N: usize>(
    body: &A,
    before: &A::Motion,
    rubs: &[Rub<N>],
) -> Pressed<A::Motion, N> {
    let back = rubs.iter().fold(1.0, |least: f64, rub| least.min(rub.restitution));
    let reversed = body.reversed(before, back);
    let is_one = reversed.is_some();
    let mut passes = 0;
    for &friction in if is_one { &EASED[..] } else { &EASED[..1] } {
        let ease = |rub: &Rub<N>| Rub { friction: friction * rub.friction, ..*rub };
        let eased: Cow<'_, [Rub<N>]> = if friction == 1.0 { rubs.into() } else { rubs.iter().map(ease).collect() };
        match restored(body, (before, is_one), &eased) {
            Ok(found) => return Pressed { passes: passes + found.passes, ..found },
            Err(found) if !is_one => return body.give_up(before, found),
            Err(found) => passes += found.passes,
        }
        if rubs.iter().all(|rub| rub.friction == 0.0) {
            break;
        }
    }
    // What comes off a surface is not led back to it.
    let goes = |motion: &A::Motion| {
        let speeds =
            |motion: &A::Motion| (0..rubs.len()).map(|contact| body.speeds(contact, motion)[0]).collect::<Vec<_>>();
        let fastest = speeds(before).into_iter().fold(0.0, |most: f64, speed| most.max(-speed));
        speeds(motion).into_iter().all(|speed| speed >= -SLIGHT * fastest)
    };
    if let Some(motion) = reversed.filter(|motion| back > 0.0 && goes(motion)) {
        let taken = [body.energy(before) - body.energy(&motion), 0.0];
        return Pressed { motion, taken, passes, is_stopped: false, ..stop(body, before, rubs.len()) };
    }
    let plastic = press(body, before, rubs, &[]);
    passes += plastic.passes;
    Pressed { passes, ..body.give_up(before, plastic) }
}

/// An impact by the law as it is; an error, with what is nearest to one: it has no answer. `minds`: impulses that find no end are none.
fn restored<A: Answers<N>, const N: usize>(
    body: &A,
    (before, minds): (&A::Motion, bool),
    rubs: &[Rub<N>],
) -> Result<Pressed<A::Motion, N>, Pressed<A::Motion, N>> {
    let most = body.energy(before) * (1.0 + body.rounding());
    let fastest = (0..rubs.len()).fold(0.0, |most: f64, contact| most.max(-body.speeds(contact, before)[0]));
    let mut passes = 0;
    let mut with = |share: f64| {
        let aimed = |(contact, rub): (usize, &Rub<N>)| {
            let closing = (-body.speeds(contact, before)[0]).max(0.0);
            Rub { target: across(share * rub.restitution * closing), ..*rub }
        };
        let aimed: Vec<Rub<N>> = rubs.iter().enumerate().map(aimed).collect();
        let pressed = press(body, before, &aimed, &[]);
        let is_short = |(contact, rub): (usize, &Rub<N>)| {
            body.speeds(contact, &pressed.motion)[0] < RETURNED * rub.target[0] - SLIGHT * fastest
        };
        let is_wedged = minds && !pressed.has_converged && aimed.iter().enumerate().any(is_short);
        let is_fine = body.energy(&pressed.motion) <= most;
        passes += pressed.passes;
        (Pressed { passes, ..pressed }, is_fine, is_wedged)
    };
    let (whole, is_fine, is_wedged) = with(1.0);
    if is_wedged {
        return Err(whole);
    }
    if is_fine {
        return Ok(whole);
    }
    // Newton's law of restitution together with friction may add energy: so much of it as does not.
    let (plastic, is_fine, is_wedged) = with(0.0);
    if !is_fine || is_wedged {
        return Err(plastic);
    }
    let (mut low, mut high, mut found) = (0.0, 1.0, plastic);
    for _ in 0..HALVINGS {
        let share = 0.5 * (low + high);
        let (next, is_fine, is_wedged) = with(share);
        if is_wedged {
            return Err(next);
        }
        let is_over = next.passes > HALVED * body.most_passes(rubs.len());
        match is_fine {
            true => (low, found) = (share, next),
            false => high = share,
        }
        if is_over {
            if minds && low == 0.0 {
                return Err(found);
            }
            break;
        }
    }
    Ok(Pressed { passes, ..found })
}

/// As [`press`], with no more energy than before and what targets ask for; where what slides on two surfaces at once has no
/// answer by that law, friction may hold it there, and if that has none either it is stopped.
pub(crate) fn press_or_stop<A: Answers<N>, const N: usize>(
    body: &A,
    before: &A::Motion,
    rubs: &[Rub<N>],
    guess: &[[f64; N]],
) -> Pressed<A::Motion, N> {
    let asked = rubs.iter().flat_map(|rub| rub.target).fold(0.0, |most: f64, speed| most.max(speed.abs()));
    // What comes to rest has the speed of its targets, at most about twice.
    let most = body.energy(before) * (1.0 + 1e-9) + 2.0 * body.heaviest() * asked * asked;
    let is_fine = |pressed: &Pressed<A::Motion, N>| body.energy(&pressed.motion) <= most;
    let pressed = press(body, before, rubs, guess);
    let slides = rubs.iter().any(Rub::is_sliding);
    if is_fine(&pressed) && (pressed.has_converged || !slides) {
        return pressed;
    }
    let held: Vec<Rub<N>> = rubs.iter().map(|rub| Rub { slides: [0.0; N], ..*rub }).collect();
    let mut other = press(body, before, &held, &[]);
    other.passes += pressed.passes;
    if is_fine(&other) { other } else { body.give_up(before, other) }
}

/// It stands still.
pub(crate) fn stop<A: Answers<N>, const N: usize>(
    body: &A,
    before: &A::Motion,
    contacts: usize,
) -> Pressed<A::Motion, N> {
    Pressed {
        motion: body.stopped(before),
        impulses: vec![[0.0; N]; contacts],
        taken: [body.energy(before), 0.0],
        passes: 1,
        has_converged: true,
        is_stopped: true,
        share: 1.0,
    }
}

/// The impulses that leave no contact slower off its surface than its target, and the motion that they make. They are looked for from
/// `guess` on, one entry a contact; empty: from none.
fn press<A: Answers<N>, const N: usize>(
    body: &A,
    before: &A::Motion,
    rubs: &[Rub<N>],
    guess: &[[f64; N]],
) -> Pressed<A::Motion, N> {
    let mut motion = before.clone();
    let mut impulses = vec![[0.0; N]; rubs.len()];
    for (contact, (impulse, guess)) in impulses.iter_mut().zip(guess).enumerate() {
        motion = body.pushed(contact, *guess, motion);
        *impulse = *guess;
    }
    let gives: Vec<[[f64; N]; N]> = (0..rubs.len()).map(|contact| body.gives(contact)).collect();
    let speeds = rubs.iter().enumerate().flat_map(|(contact, rub)| [body.speeds(contact, before), rub.target]);
    // What lies still on a body that turns is no more exact than the body is fast.
    let own = (2.0 * body.energy(before) / body.heaviest()).sqrt();
    let fastest = speeds.flatten().fold(own, |most: f64, speed| most.max(speed.abs()));
    // Where nothing touches nothing changes, and of what left the numbers nobody knows when it does not.
    let (mut passes, mut has_converged) = (0, rubs.is_empty());
    while passes < body.most_passes(rubs.len()) && !has_converged && fastest.is_finite() {
        let mut largest: f64 = 0.0;
        let together = pressed_together(body, (rubs, NOTHING * fastest), &impulses, &motion);
        for (&contact, new) in body.smooth().iter().zip(together) {
            let change = new - impulses[contact][0];
            if change != 0.0 {
                motion = body.pushed(contact, across(change), motion);
                impulses[contact][0] = new;
                largest = largest.max((change * gives[contact][0][0]).abs());
            }
        }
        // By themselves they are found at once.
        largest = if body.smooth().len() < rubs.len() { largest } else { 0.0 };
        for (contact, (rub, impulse)) in rubs.iter().zip(&mut impulses).enumerate() {
            if body.smooth().contains(&contact) {
                continue;
            }
            let new = A::Friction::solve(&gives[contact], rub, *impulse, body.speeds(contact, &motion));
            let change = sub(new, *impulse);
            motion = body.pushed(contact, change, motion);
            *impulse = new;
            for k in 0..N {
                largest = largest.max((change[k] * gives[contact][k][k]).abs());
            }
        }
        passes += 1;
        has_converged = largest <= NOTHING * fastest;
    }
    let mut taken = [0.0; 2];
    for (contact, impulse) in impulses.iter().enumerate() {
        let mean = scale(add(body.speeds(contact, before), body.speeds(contact, &motion)), 0.5);
        taken[0] -= impulse[0] * mean[0];
        for k in 1..N {
            taken[1] -= impulse[k] * mean[k];
        }
    }
    Pressed { motion, impulses, taken, passes, has_converged, is_stopped: false, share: 1.0 }
}

/// The impulses across of contacts without friction, the others as they are; those that there are, where nothing is off by more than `nothing`
/// `[m/s]`.
fn pressed_together<A: Answers<N>, const N: usize>(
    body: &A,
    (rubs, nothing): (&[Rub<N>], f64),
    impulses: &[[f64; N]],
    motion: &A::Motion,
) -> Vec<f64> {
    let list = body.smooth();
    let old: Vec<f64> = list.iter().map(|&of| impulses[of][0]).collect();
    let off: Vec<f64> = list.iter().map(|&of| rubs[of].target[0] - body.speeds(of, motion)[0]).collect();
    let holds = |(old, off): (&f64, &f64)| *off <= nothing && (*old == 0.0 || *off >= -nothing);
    if old.iter().zip(&off).all(holds) {
        return old;
    }
    let gives: Vec<Vec<f64>> =
        list.iter().map(|&of| list.iter().map(|&other| body.crosses(of, other)).collect()).collect();
    let answer = |row: &Vec<f64>| row.iter().zip(&old).map(|(gives, push)| gives * push).sum::<f64>();
    let lacks: Vec<f64> = off.iter().zip(&gives).map(|(off, row)| off + answer(row)).collect();
    smooth::pressed(&gives, &lacks, nothing)
}

/// A vector along the normal of a contact.
fn across<const N: usize>(size: f64) -> [f64; N] {
    let mut vector = [0.0; N];
    vector[0] = size;
    vector
}
