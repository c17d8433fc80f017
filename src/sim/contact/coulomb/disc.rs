//! Coulomb's law in space, where friction acts in two directions.
//!
//! ```text
//! v+ = v- + W P        v_n+ >= target,  P_n >= 0,  P_n (v_n+ - target) = 0        |P_t| <= friction P_n, against the sliding
//! ```
//!
//! As in the plane ([`super`]) what slides on when a moment begins is rubbed against its way, and what does not is held, as far as friction
//! goes: in a disc as wide as friction times what presses. Gone through contact by contact.

use super::{HALVINGS, NOTHING, ROUNDING};
use crate::sim::vector::{add, dot, scale, sub};

/// Most times that all contacts are gone through.
const MOST_PASSES: u32 = 300;
/// Rounds in which the direction is found in which one contact starts to slide, by turns of it and by steps.
const TURNS: u32 = 12;
const ROUNDS: u32 = 60;
/// Share of what a contact gives of which the rest counts as none.
const REPEATED: f64 = 1e-9;
/// Operations of a contact that is gone through once, about.
pub(crate) const OF_A_CONTACT: u64 = 150;

/// Along the normal of a contact and the two tangents of it: impulses `[kg m/s]` or velocities `[m/s]`.
pub(crate) type Trio = [f64; 3];

/// What the law asks of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grip {
    pub(crate) friction: f64,
    /// Share of the speed across that comes back: 0 of what lies there or is slow.
    pub(crate) restitution: f64,
    /// Which way it slides along its tangents for all of the moment, as a unit vector; `None`: friction may hold it.
    pub(crate) slides: Option<[f64; 2]>,
    /// The least speed across afterwards, and the velocity along where friction holds it `[m/s]`.
    pub(crate) target: Trio,
}

/// What impulses at contacts in space move.
pub(crate) trait Yields {
    type Motion: Copy;

    /// Velocity of a contact, by its number `[m/s]`.
    fn speeds(&self, contact: usize, motion: &Self::Motion) -> Trio;

    /// What impulses of 1 change of the contact's own velocity, row by row `[1/kg]`.
    fn gives(&self, contact: usize) -> [Trio; 3];

    /// The motion after an impulse.
    fn pushed(&self, contact: usize, impulse: Trio, motion: &Self::Motion) -> Self::Motion;

    /// Kinetic energy `[J]`.
    fn energy(&self, motion: &Self::Motion) -> f64;

    /// It stands still.
    fn stopped(&self) -> Self::Motion;

    /// All of the mass `[kg]`.
    fn mass(&self) -> f64;
}

/// What impulses made of a motion.
#[derive(Clone, Debug)]
pub(crate) struct Pressed<M> {
    pub(crate) motion: M,
    /// Of each contact.
    pub(crate) impulses: Vec<Trio>,
    /// What impulses across and along took `[J]`.
    pub(crate) taken: [f64; 2],
    /// How often all contacts were gone through, and whether nothing changed any more.
    pub(crate) passes: u32,
    pub(crate) has_converged: bool,
}

/// An impact: contacts that close give back what their restitution says, with no more energy than there was.
pub(crate) fn strike<Y: Yields>(body: &Y, before: &Y::Motion, grips: &[Grip]) -> Pressed<Y::Motion> {
    let most = body.energy(before) * (1.0 + ROUNDING);
    let mut passes = 0;
    let mut with = |share: f64| {
        let aimed = |(contact, grip): (usize, &Grip)| {
            let closing = (-body.speeds(contact, before)[0]).max(0.0);
            Grip { target: [share * grip.restitution * closing, 0.0, 0.0], ..*grip }
        };
        let pressed = press(body, before, &grips.iter().enumerate().map(aimed).collect::<Vec<_>>(), &[]);
        passes += pressed.passes;
        let is_fine = body.energy(&pressed.motion) <= most;
        (pressed, is_fine)
    };
    let (mut found, is_fine) = with(1.0);
    if !is_fine {
        // Newton's law of restitution together with friction may add energy: so much of it as does not.
        let (plastic, is_fine) = with(0.0);
        if !is_fine {
            return stopped(body, before, grips.len());
        }
        let (mut low, mut high) = (0.0, 1.0);
        found = plastic;
        for _ in 0..HALVINGS {
            let share = 0.5 * (low + high);
            let (next, is_fine) = with(share);
            match is_fine {
                true => (low, found) = (share, next),
                false => high = share,
            }
        }
    }
    Pressed { passes, ..found }
}

/// As [`press`], with no more energy than before and what targets ask for; where what slides has no answer, friction may hold it, and if that has
/// none either it is stopped.
pub(crate) fn press_or_stop<Y: Yields>(
    body: &Y,
    before: &Y::Motion,
    grips: &[Grip],
    guess: &[Trio],
) -> Pressed<Y::Motion> {
    let asked = grips.iter().flat_map(|grip| grip.target).fold(0.0, |most: f64, speed| most.max(speed.abs()));
    // What comes to rest has the speed of its targets, at most about twice.
    let most = body.energy(before) * (1.0 + 1e-9) + 2.0 * body.mass() * asked * asked;
    let is_fine = |pressed: &Pressed<Y::Motion>| body.energy(&pressed.motion) <= most;
    let pressed = press(body, before, grips, guess);
    let slides = grips.iter().any(|grip| grip.slides.is_some());
    if is_fine(&pressed) && (pressed.has_converged || !slides) {
        return pressed;
    }
    let held: Vec<Grip> = grips.iter().map(|grip| Grip { slides: None, ..*grip }).collect();
    let mut other = press(body, before, &held, &[]);
    other.passes += pressed.passes;
    if is_fine(&other) { other } else { stopped(body, before, grips.len()) }
}

/// It stands still.
fn stopped<Y: Yields>(body: &Y, before: &Y::Motion, contacts: usize) -> Pressed<Y::Motion> {
    let impulses = vec![[0.0; 3]; contacts];
    Pressed { motion: body.stopped(), impulses, taken: [body.energy(before), 0.0], passes: 1, has_converged: true }
}

/// The impulses that leave no contact slower off its surface than its target, and the motion that they make. They are looked for from
/// `guess` on, one entry a contact; empty: from none.
fn press<Y: Yields>(body: &Y, before: &Y::Motion, grips: &[Grip], guess: &[Trio]) -> Pressed<Y::Motion> {
    let mut motion = *before;
    let mut impulses = vec![[0.0; 3]; grips.len()];
    for (contact, (impulse, guess)) in impulses.iter_mut().zip(guess).enumerate() {
        motion = body.pushed(contact, *guess, &motion);
        *impulse = *guess;
    }
    let gives: Vec<[Trio; 3]> = (0..grips.len()).map(|contact| body.gives(contact)).collect();
    let speeds = grips.iter().enumerate().flat_map(|(contact, grip)| [body.speeds(contact, before), grip.target]);
    let own = (2.0 * body.energy(before) / body.mass()).sqrt();
    let fastest = speeds.flatten().fold(own, |most: f64, speed| most.max(speed.abs()));
    let (mut passes, mut has_converged) = (0, false);
    while passes < MOST_PASSES && !has_converged {
        let mut largest: f64 = 0.0;
        for (contact, (grip, impulse)) in grips.iter().zip(&mut impulses).enumerate() {
            let new = solve(&gives[contact], grip, *impulse, body.speeds(contact, &motion));
            let change = sub(new, *impulse);
            motion = body.pushed(contact, change, &motion);
            *impulse = new;
            (0..3).for_each(|k| largest = largest.max((change[k] * gives[contact][k][k]).abs()));
        }
        passes += 1;
        has_converged = largest <= NOTHING * fastest;
    }
    let mut taken = [0.0; 2];
    for (contact, impulse) in impulses.iter().enumerate() {
        let mean = scale(add(body.speeds(contact, before), body.speeds(contact, &motion)), 0.5);
        taken[0] -= impulse[0] * mean[0];
        taken[1] -= impulse[1] * mean[1] + impulse[2] * mean[2];
    }
    Pressed { motion, impulses, taken, passes, has_converged }
}

/// One contact, the others as they are: it is free, held or slides.
fn solve(gives: &[Trio; 3], grip: &Grip, old: Trio, speed: Trio) -> Trio {
    let across = gives[0][0];
    if across <= 0.0 {
        return old;
    }
    // What it lacks without an impulse of its own.
    let lacks: Trio = std::array::from_fn(|k| grip.target[k] - speed[k] + dot(gives[k], old));
    if let Some([x, y]) = grip.slides {
        let eased = across - grip.friction * (gives[0][1] * x + gives[0][2] * y);
        // Where friction that goes along with what presses lifts the point more than that does, it is held instead (Painlevé).
        if eased > 0.0 {
            let push = (lacks[0] / eased).max(0.0);
            return [push, -grip.friction * push * x, -grip.friction * push * y];
        }
    }
    if lacks[0] <= 0.0 {
        return [0.0; 3];
    }
    if grip.friction == 0.0 {
        return [lacks[0] / across, 0.0, 0.0];
    }
    if let Some(stuck) = solved(gives, lacks)
        && stuck[0] >= 0.0
        && along(stuck) <= grip.friction * stuck[0]
    {
        return stuck;
    }
    turning(gives, grip.friction, lacks, old).unwrap_or_else(|| slipping(gives, grip.friction, lacks, old))
}

/// The impulse at the rim of the disc that is against the sliding which it leaves, by Newton's method on its direction, from the one that it had or
/// against what slides by itself; `None`: not found so.
fn turning(gives: &[Trio; 3], friction: f64, lacks: Trio, [_, u, v]: Trio) -> Option<Trio> {
    let start = if u != 0.0 || v != 0.0 { [u, v] } else { [lacks[1], lacks[2]] };
    let size = dot(start, start).sqrt();
    let mut f = if size > 0.0 { scale(start, 1.0 / size) } else { return None };
    let tangential = |p: [f64; 2]| [gives[1][1] * p[0] + gives[1][2] * p[1], gives[2][1] * p[0] + gives[2][2] * p[1]];
    let (both, aside) = ([gives[0][1], gives[0][2]], |f: [f64; 2]| [-f[1], f[0]]);
    for _ in 0..TURNS {
        let weight = gives[0][0] + friction * dot(both, f);
        let push = lacks[0] / weight;
        let rub = scale(f, friction * push);
        let slip = sub(add(scale(both, push), tangential(rub)), [lacks[1], lacks[2]]);
        let g = aside(f);
        let off = dot(g, slip);
        if off.abs() <= NOTHING * (dot(slip, slip).sqrt() + lacks[0].abs()) {
            let is_fine = push >= 0.0 && push.is_finite() && dot(f, slip) <= 0.0;
            return is_fine.then_some([push, rub[0], rub[1]]);
        }
        // How push, slip and what is left change as the direction turns.
        let eased = -push * friction * dot(both, g) / weight;
        let turned = add(scale(both, eased), tangential(scale(add(scale(f, eased), scale(g, push)), friction)));
        let by = off / (dot(f, slip) - dot(g, turned));
        // Half a radian at most; NaN is no turn.
        let by = if by.abs() < 0.5 { by } else { 0.5_f64.copysign(by) };
        f = add(f, scale(g, by));
        f = scale(f, 1.0 / dot(f, f).sqrt());
    }
    None
}

/// The impulse at the rim of the disc that is against the sliding which it leaves, or within it where nothing slides: by steps against that
/// sliding, put back on the disc.
fn slipping(gives: &[Trio; 3], friction: f64, lacks: Trio, old: Trio) -> Trio {
    let stiff = gives[1][1] + gives[2][2];
    let mut p = old;
    for _ in 0..ROUNDS {
        let push = ((lacks[0] - gives[0][1] * p[1] - gives[0][2] * p[2]) / gives[0][0]).max(0.0);
        let mut next = [push, p[1], p[2]];
        if stiff > 0.0 {
            let slip = [1, 2].map(|k| dot(gives[k], next) - lacks[k]);
            next = [push, p[1] - slip[0] / stiff, p[2] - slip[1] / stiff];
        }
        let (size, most) = (along(next), friction * push);
        // What is no number stays none, and is seen as that.
        if size > most {
            next = [push, next[1] * (most / size), next[2] * (most / size)];
        }
        let change = sub(next, p);
        p = next;
        if dot(change, change) <= f64::EPSILON * f64::EPSILON * dot(p, p) {
            break;
        }
    }
    p
}

/// How much of it is along the surface.
fn along([_, x, y]: Trio) -> f64 {
    (x * x + y * y).sqrt()
}

/// A symmetric system of three by Cholesky's method; `None` where two of its directions are one.
fn solved(m: &[Trio; 3], b: Trio) -> Option<Trio> {
    let x = m[0][0];
    let (u, v) = (m[1][0] / x, m[2][0] / x);
    let y = m[1][1] - u * m[1][0];
    if y <= REPEATED * m[1][1] {
        return None;
    }
    let w = (m[2][1] - v * m[1][0]) / y;
    let z = m[2][2] - v * m[2][0] - w * w * y;
    if z <= REPEATED * m[2][2] {
        return None;
    }
    let c = [b[0], b[1] - u * b[0], 0.0];
    let last = (b[2] - v * c[0] - w * c[1]) / z;
    let middle = c[1] / y - w * last;
    Some([c[0] / x - u * middle - v * last, middle, last])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_of_three_is_solved() {
        let m = [[4.0, 1.0, -0.5], [1.0, 3.0, 0.25], [-0.5, 0.25, 2.0]];
        let x = solved(&m, [1.0, 2.0, 3.0]).unwrap_or_default();
        for (row, b) in m.iter().zip([1.0, 2.0, 3.0]) {
            assert!((dot(*row, x) - b).abs() < 1e-14);
        }
        assert!(solved(&[[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [1.0; 3]).is_none());
    }

    #[test]
    fn one_contact_is_free_held_or_slides_against_its_friction() {
        let gives = [[2.0, 0.4, -0.3], [0.4, 1.5, 0.2], [-0.3, 0.2, 1.0]];
        for friction in [0.0, 0.1, 0.5, 2.0] {
            for turned in 0..16 {
                let angle = 0.4 * f64::from(turned);
                let speed = [-1.0, 2.0 * libm::cos(angle), 2.0 * libm::sin(angle)];
                let grip = Grip { friction, restitution: 0.0, slides: None, target: [0.0; 3] };
                let p = (0..40).fold([0.0; 3], |p, _| {
                    let now = std::array::from_fn(|k| speed[k] + dot(gives[k], p));
                    solve(&gives, &grip, p, now)
                });
                let after: Trio = std::array::from_fn(|k| speed[k] + dot(gives[k], p));
                let (rub, slip) = ([p[1], p[2]], [after[1], after[2]]);
                assert!(p[0] > 0.0 && after[0].abs() < 1e-12, "{friction} {angle}: {after:?}");
                assert!(dot(rub, rub).sqrt() <= friction * p[0] + 1e-12);
                let is_held = dot(slip, slip).sqrt() < 1e-9;
                // Against the way: a product as far below 0 as it can be.
                let most = friction * p[0] * dot(slip, slip).sqrt();
                assert!(is_held || (dot(rub, slip) + most).abs() < 1e-9, "{friction} {angle}: {rub:?} {slip:?}");
                let lacks: Trio = std::array::from_fn(|k| -speed[k]);
                let stepped = (0..40).fold([0.0; 3], |p, _| slipping(&gives, friction, lacks, p));
                assert!(along(sub(stepped, p)) < 1e-9, "{friction} {angle}: {stepped:?} {p:?}");
                let turned = turning(&gives, friction, lacks, [0.0; 3]);
                let is_it = |turned: Trio| along(sub(turned, p)) < 1e-9;
                assert!(
                    is_held || friction == 0.0 || turned.is_some_and(is_it),
                    "{friction} {angle}: {turned:?} {p:?}"
                );
            }
        }
    }
}
