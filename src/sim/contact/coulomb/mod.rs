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
//! gone through as one (`smooth.rs`).

pub(crate) mod coupled;
pub(crate) mod disc;
mod smooth;

use crate::sim::vector::sub;

/// Most times that all contacts are gone through.
const MOST_PASSES: u32 = 100;
/// Share of an energy that is rounding.
const ROUNDING: f64 = 1e-13;
/// Change of a motion, relative to the fastest, that is none.
const NOTHING: f64 = 1e-15;
/// Share of what a contact gives across and along below which both are one direction.
const REPEATED: f64 = 1e-9;
/// Operations of a contact that is gone through once, about.
pub(crate) const OF_A_CONTACT: u64 = 40;
/// Halvings in which the restitution is found that adds no energy, and how often in them all contacts are gone through at most, in what a
/// single one may take.
const HALVINGS: u32 = 30;
const HALVED: u32 = 4;

/// Impulses of a contact, along its normal and across it `[kg m/s]`.
pub(crate) type Impulse = [f64; 2];

/// What the law asks of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rub {
    pub(crate) friction: f64,
    /// Share of the speed across that comes back: 0 of what lies there or is slow.
    pub(crate) restitution: f64,
    /// Which way it slides along (-n_y, n_x) for all of the moment, -1 or 1; 0: friction may hold it.
    pub(crate) slides: f64,
    /// The least speed across afterwards, and the speed along where friction holds it `[m/s]`.
    pub(crate) target: [f64; 2],
}

/// What impulses at contacts move.
pub(crate) trait Answers: Sized {
    type Motion: Clone;

    /// Velocities of a contact, by its number, across and along its surface `[m/s]`.
    fn speeds(&self, contact: usize, motion: &Self::Motion) -> [f64; 2];

    /// What an impulse of 1 changes of the contact's own velocity: across by across, along by along, and one by the other `[1/kg]`.
    fn gives(&self, contact: usize) -> [f64; 3];

    /// The motion after an impulse.
    fn pushed(&self, contact: usize, impulse: Impulse, motion: Self::Motion) -> Self::Motion;

    /// The velocity of a contact along its surface after an impulse across it.
    fn along_after(&self, contact: usize, push: f64, motion: &Self::Motion) -> f64 {
        self.speeds(contact, &self.pushed(contact, [push, 0.0], motion.clone()))[1]
    }

    /// Kinetic energy, but for what cannot move `[J]`.
    fn energy(&self, motion: &Self::Motion) -> f64;

    /// It stands still.
    fn stopped(&self, motion: &Self::Motion) -> Self::Motion;

    /// A mass and a moment of inertia that are no less than those of what moves.
    fn heaviest(&self) -> f64;

    /// Most times that so many contacts are gone through.
    fn most_passes(&self, _contacts: usize) -> u32 {
        MOST_PASSES
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
    fn give_up(&self, before: &Self::Motion, found: Pressed<Self::Motion>) -> Pressed<Self::Motion> {
        stop(self, before, found.impulses.len())
    }
}

/// What impulses made of a motion.
#[derive(Clone, Debug)]
pub(crate) struct Pressed<M> {
    pub(crate) motion: M,
    /// Of each contact.
    pub(crate) impulses: Vec<Impulse>,
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
pub(crate) fn strike<A: Answers>(body: &A, before: &A::Motion, rubs: &[Rub]) -> Pressed<A::Motion> {
    let most = body.energy(before) * (1.0 + body.rounding());
    let mut passes = 0;
    let mut with = |share: f64| {
        let aimed = |(contact, rub): (usize, &Rub)| {
            let closing = (-body.speeds(contact, before)[0]).max(0.0);
            Rub { target: [share * rub.restitution * closing, 0.0], ..*rub }
        };
        let pressed = press(body, before, &rubs.iter().enumerate().map(aimed).collect::<Vec<_>>(), &[]);
        let is_fine = body.energy(&pressed.motion) <= most;
        passes += pressed.passes;
        (Pressed { passes, ..pressed }, is_fine)
    };
    let (whole, is_fine) = with(1.0);
    if is_fine {
        return whole;
    }
    // Newton's law of restitution together with friction may add energy: so much of it as does not.
    let (plastic, is_fine) = with(0.0);
    if !is_fine {
        return body.give_up(before, plastic);
    }
    let (mut low, mut high, mut found) = (0.0, 1.0, plastic);
    for _ in 0..HALVINGS {
        let share = 0.5 * (low + high);
        let (next, is_fine) = with(share);
        let is_over = next.passes > HALVED * body.most_passes(rubs.len());
        match is_fine {
            true => (low, found) = (share, next),
            false => high = share,
        }
        if is_over {
            break;
        }
    }
    Pressed { passes, ..found }
}

/// As [`press`], with no more energy than before and what targets ask for; where what slides on two surfaces at once has no
/// answer by that law, friction may hold it there, and if that has none either it is stopped.
pub(crate) fn press_or_stop<A: Answers>(
    body: &A,
    before: &A::Motion,
    rubs: &[Rub],
    guess: &[Impulse],
) -> Pressed<A::Motion> {
    let asked = rubs.iter().flat_map(|rub| rub.target).fold(0.0, |most: f64, speed| most.max(speed.abs()));
    // What comes to rest has the speed of its targets, at most about twice.
    let most = body.energy(before) * (1.0 + 1e-9) + 2.0 * body.heaviest() * asked * asked;
    let is_fine = |pressed: &Pressed<A::Motion>| body.energy(&pressed.motion) <= most;
    let pressed = press(body, before, rubs, guess);
    let slides = rubs.iter().any(|rub| rub.slides != 0.0);
    if is_fine(&pressed) && (pressed.has_converged || !slides) {
        return pressed;
    }
    let held: Vec<Rub> = rubs.iter().map(|rub| Rub { slides: 0.0, ..*rub }).collect();
    let mut other = press(body, before, &held, &[]);
    other.passes += pressed.passes;
    if is_fine(&other) { other } else { body.give_up(before, other) }
}

/// It stands still.
pub(crate) fn stop<A: Answers>(body: &A, before: &A::Motion, contacts: usize) -> Pressed<A::Motion> {
    Pressed {
        motion: body.stopped(before),
        impulses: vec![[0.0; 2]; contacts],
        taken: [body.energy(before), 0.0],
        passes: 1,
        has_converged: true,
        is_stopped: true,
        share: 1.0,
    }
}

/// The impulses that leave no contact slower off its surface than its target, and the motion that they make. They are looked for from
/// `guess` on, one entry a contact; empty: from none.
fn press<A: Answers>(body: &A, before: &A::Motion, rubs: &[Rub], guess: &[Impulse]) -> Pressed<A::Motion> {
    let mut motion = before.clone();
    let mut impulses = vec![[0.0; 2]; rubs.len()];
    for (contact, (impulse, guess)) in impulses.iter_mut().zip(guess).enumerate() {
        motion = body.pushed(contact, *guess, motion);
        *impulse = *guess;
    }
    let speeds = rubs.iter().enumerate().flat_map(|(contact, rub)| [body.speeds(contact, before), rub.target]);
    // What lies still on a body that turns is no more exact than the body is fast.
    let own = (2.0 * body.energy(before) / body.heaviest()).sqrt();
    let fastest = speeds.flatten().fold(own, |most: f64, speed| most.max(speed.abs()));
    let (mut passes, mut has_converged) = (0, false);
    while passes < body.most_passes(rubs.len()) && !has_converged {
        let mut largest: f64 = 0.0;
        let together = pressed_together(body, (rubs, NOTHING * fastest), &impulses, &motion);
        for (&contact, new) in body.smooth().iter().zip(together) {
            let change = new - impulses[contact][0];
            if change != 0.0 {
                motion = body.pushed(contact, [change, 0.0], motion);
                impulses[contact][0] = new;
                largest = largest.max((change * body.gives(contact)[0]).abs());
            }
        }
        // By themselves they are found at once.
        largest = if body.smooth().len() < rubs.len() { largest } else { 0.0 };
        for (contact, (rub, impulse)) in rubs.iter().zip(&mut impulses).enumerate() {
            if body.smooth().contains(&contact) {
                continue;
            }
            let new = solve(body, (contact, rub), *impulse, &motion);
            let change = sub(new, *impulse);
            motion = body.pushed(contact, change, motion);
            *impulse = new;
            let gives = body.gives(contact);
            largest = largest.max((change[0] * gives[0]).abs()).max((change[1] * gives[1]).abs());
        }
        passes += 1;
        has_converged = largest <= NOTHING * fastest;
    }
    let mut taken = [0.0; 2];
    for (contact, impulse) in impulses.iter().enumerate() {
        let (from, to) = (body.speeds(contact, before), body.speeds(contact, &motion));
        for k in 0..2 {
            taken[k] -= 0.5 * impulse[k] * (from[k] + to[k]);
        }
    }
    Pressed { motion, impulses, taken, passes, has_converged, is_stopped: false, share: 1.0 }
}

/// The impulses across of contacts without friction, the others as they are; those that there are, where nothing is off by more than `nothing`
/// `[m/s]`.
fn pressed_together<A: Answers>(
    body: &A,
    (rubs, nothing): (&[Rub], f64),
    impulses: &[Impulse],
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

/// One contact, the others as they are: it is free, held or slides.
fn solve<A: Answers>(body: &A, (contact, rub): (usize, &Rub), old: Impulse, motion: &A::Motion) -> Impulse {
    let [across, along, both] = body.gives(contact);
    if across <= 0.0 {
        return old;
    }
    let [target, hold] = rub.target;
    let [normal, speed] = body.speeds(contact, motion);
    let rubbed = rub.slides * rub.friction;
    // Where friction that goes along with what presses lifts the point more than that does, it is held instead (Painlevé).
    let eased = across - rubbed * both;
    if rub.slides != 0.0 && eased > 0.0 {
        let push = (old[0] + (target - normal) / eased).max(0.0);
        return [push, -rubbed * push];
    }
    // What it lacks without an impulse of its own.
    let lacks = [target - normal + across * old[0] + both * old[1], hold - speed + both * old[0] + along * old[1]];
    if lacks[0] <= 0.0 {
        return [0.0; 2];
    }
    let held = across * along - both * both;
    if held > REPEATED * across * along {
        let stuck = [along * lacks[0] - both * lacks[1], across * lacks[1] - both * lacks[0]].map(|x| x / held);
        if stuck[0] >= 0.0 && stuck[1].abs() <= rub.friction * stuck[0] {
            return stuck;
        }
        for side in [stuck[1].signum(), -stuck[1].signum()] {
            let push = lacks[0] / (across + side * rub.friction * both);
            let slip = (both + side * rub.friction * along) * push - lacks[1];
            if push >= 0.0 && push.is_finite() && slip * side <= 0.0 {
                return [push, side * rub.friction * push];
            }
        }
    }
    let push = (old[0] + (target - normal) / across).max(0.0);
    let after = body.along_after(contact, push - old[0], motion);
    let most = rub.friction * push;
    let wanted = if along > 0.0 { old[1] + (hold - after) / along } else { 0.0 };
    // What is no number stays none, and is seen as that.
    [push, wanted.max(-most).min(most)]
}
