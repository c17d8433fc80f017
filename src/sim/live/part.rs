//! Bodies that lie in each other are parted as wholes, slowly and without speed; meanwhile they do not touch each other.
//!
//! A crossing that contacts do not undo by themselves: their points would come out on different sides. So both bodies go apart along
//! one direction, in which their common area shrinks fastest, or, where that says nothing (one goes right through, or lies inside the
//! other), along the one in which their shadows part soonest. What that does not part, or what is held and goes nowhere, only goes through each
//! other from then on.
//! Source of the first: the gradient of the common area is the sum of the chords between crossings, turned by a right angle, as of
//! intersection contours in P. Volino, N. Magnenat-Thalmann, Resolving Surface Collisions through Intersection Contour Minimization, 2006.

use super::cluster::Cluster;
use super::cross::Crossing;
use super::guard;
use super::pair::{Pair, beside, left};
use super::tangle::Knot;
use crate::sim::real::Real;
use crate::sim::vector::{add, convert, dot, scale, sub, widen, zero};

/// How fast two bodies go apart, and how fast one may go at most `[m/s]`.
const SPEED: f64 = 1.0;
/// How long two bodies are led apart `[s]`, and how long those cross that are both held, which nothing leads. From then on they only go through
/// each other, until they are apart by themselves: contacts of what lies on both sides of a thread would push it back and forth for ever.
const LED: f64 = 10.0;
const HELD: f64 = 1.0;
/// What is parted waits while more is owed than all would have at this speed `[m/s]`: others would be squeezed.
const OWED: f64 = 1.0;
/// Directions that shadows are looked at along.
const DIRECTIONS: u32 = 16;
/// Cosine from which on what presses a body bars its way.
const BARRED: f64 = 0.5;
/// Share of the lengths of the chords that their sum must have to say where out is.
const CLEAR: f64 = 0.5;

/// Two bodies whose skins cross.
#[derive(Clone, Copy, Debug)]
pub(super) struct Couple<S> {
    /// Their numbers in the cluster, or in the group, ascending.
    pub(super) bodies: [u32; 2],
    /// For how long `[s]`.
    pub(super) time: f64,
    /// Where the second one goes; 0: nowhere, for nobody asked yet, or both are held.
    pub(super) out: [S; 2],
}

impl<S: Real> Couple<S> {
    /// Whether they go through each other.
    pub(super) fn is_parted(&self) -> bool {
        self.out != zero() || self.time >= HELD
    }

    /// Whether they are led apart meanwhile.
    pub(super) fn is_led(&self) -> bool {
        self.out != zero() && self.may_be_led()
    }

    /// Whether they were not led for so long yet that it is given up.
    pub(super) fn may_be_led(&self) -> bool {
        self.time < LED
    }
}

/// How heavy a body is `[kg]`, and how fast `[m/s]`; infinite where something holds it.
fn motion<S: Real>(state: &Cluster<S>, body: u32) -> (S, [S; 2]) {
    let range = state.bases[body as usize] as usize..state.bases[body as usize + 1] as usize;
    if let Some(frame) = state.free_whole(body) {
        return (S::from_f64(frame.mass()), convert(frame.twist().velocity));
    }
    let (mut mass, mut momentum) = (S::ZERO, zero::<S, 2>());
    for i in range {
        if state.w[i] == S::ZERO {
            return (S::INFINITY, zero());
        }
        mass += S::ONE / state.w[i];
        momentum = add(momentum, scale(state.velocity[i], S::ONE / state.w[i]));
    }
    (mass, scale(momentum, S::ONE / mass))
}

/// Shares of a relative motion that fall to two bodies, the lighter one's the larger; `None`: both are held.
fn shares<S: Real>([a, b]: [S; 2]) -> Option<[S; 2]> {
    match [a.is_finite(), b.is_finite()] {
        [true, true] => Some([b / (a + b), a / (a + b)]),
        [true, false] => Some([S::ONE, S::ZERO]),
        [false, true] => Some([S::ZERO, S::ONE]),
        [false, false] => None,
    }
}

/// Which bodies obstacles press, and which way: they do not go against that.
fn barriers<S: Real>(state: &Cluster<S>) -> Vec<(u32, [S; 2])> {
    let own = state.own();
    let on_planes = state.on_planes.iter().filter(|on| on.contact.pressed > S::ZERO);
    let mut found: Vec<(u32, [S; 2])> = on_planes.map(|on| (state.body_of[on.p as usize], on.normal)).collect();
    for pair in
        state.chosen.iter().map(|&number| &state.pairs[number as usize]).filter(|pair| pair.contact.pressed > S::ZERO)
    {
        let [p, a, b] = pair.places();
        if (p < own) != (a < own)
            && let Some(found_at) = beside([p, a, b].map(|i| state.now[i]), pair.side)
        {
            let (i, sign) = if p < own { (p, S::ONE) } else { (a, -S::ONE) };
            found.push((state.body_of[i], scale(found_at.normal, sign)));
        }
    }
    found
}

/// Masses of two bodies that go apart along `out`; infinite of one, not both, that something bars the way.
fn inertia<S: Real>(masses: [S; 2], (bodies, out): ([u32; 2], [S; 2]), barriers: &[(u32, [S; 2])]) -> [S; 2] {
    let is_barred = |body: u32, goes: S| {
        barriers.iter().any(|&(of, normal)| of == body && goes * dot(normal, out) < -S::from_f64(BARRED))
    };
    match [is_barred(bodies[0], -S::ONE), is_barred(bodies[1], S::ONE)] {
        [true, false] if masses[1].is_finite() => [S::INFINITY, masses[1]],
        [false, true] if masses[0].is_finite() => [masses[0], S::INFINITY],
        _ => masses,
    }
}

/// The way out for the second of two bodies that cross at these places; 0 where both are held.
pub(super) fn way_out<S: Real>(state: &Cluster<S>, bodies: [u32; 2], crossings: &[Crossing<S>]) -> [S; 2] {
    let held = bodies.map(|body| motion(state, body).0);
    if shares(held).is_none() {
        return zero();
    }
    along_chords(crossings).unwrap_or_else(|| along_shadows(state, bodies))
}

/// Against the gradient of the common area; `None`: it says nothing.
fn along_chords<S: Real>(crossings: &[Crossing<S>]) -> Option<[S; 2]> {
    let count = crossings.len();
    if count < 2 || crossings.iter().any(|crossing| !crossing.is_closed) {
        return None;
    }
    let sum = crossings.iter().fold(zero::<S, 2>(), |sum, crossing| add(sum, crossing.at));
    let mean = scale(sum, S::ONE / S::from_f64(count as f64));
    let (mut chords, mut lengths) = (zero::<S, 2>(), S::ZERO);
    for crossing in crossings {
        let from = sub(crossing.at, mean);
        chords = add(chords, scale(from, crossing.turn));
        lengths += dot(from, from).sqrt();
    }
    let length = dot(chords, chords).sqrt();
    (length > S::from_f64(CLEAR) * lengths).then(|| scale(left(chords), -S::ONE / length))
}

/// The direction in which the shadows of two bodies part soonest.
fn along_shadows<S: Real>(state: &Cluster<S>, [a, b]: [u32; 2]) -> [S; 2] {
    let mut best = (S::INFINITY, [S::ONE, S::ZERO]);
    for k in 0..DIRECTIONS {
        // Of equals another one comes first for each couple: what lies in a heap goes all ways.
        let turn = (k + 5 * a + 3 * b) % DIRECTIONS;
        let angle = std::f64::consts::TAU * f64::from(turn) / f64::from(DIRECTIONS);
        let along = [libm::cos(angle), libm::sin(angle)].map(S::from_f64);
        let of = |body: u32| state.bases[body as usize] as usize..state.bases[body as usize + 1] as usize;
        let far = state.now[of(a)].iter().fold(-S::INFINITY, |most, &x| most.max(dot(x, along)));
        let near = state.now[of(b)].iter().fold(S::INFINITY, |least, &x| least.min(dot(x, along)));
        if far - near < best.0 {
            best = (far - near, along);
        }
    }
    best.1
}

/// Moves what is parted on by a substep of `h` `[s]`, and lets it go no deeper.
pub(super) fn drift<S: Real>(state: &mut Cluster<S>, h: S, gravity: [f64; 2]) {
    if !state.tangle.couples.iter().any(Couple::is_led) {
        return;
    }
    let speed = if owes(state) { 0.0 } else { SPEED };
    let couples = std::mem::take(&mut state.tangle.couples);
    let barriers = barriers(state);
    let mut shifts = vec![zero::<S, 2>(); state.bodies.len()];
    for couple in couples.iter().filter(|couple| couple.is_led()) {
        let [(mass_a, v_a), (mass_b, v_b)] = couple.bodies.map(|body| motion(state, body));
        let Some(share) = shares([mass_a, mass_b]) else { continue };
        let Some(goes_by) = shares(inertia([mass_a, mass_b], (couple.bodies, couple.out), &barriers)) else { continue };
        let way = scale(couple.out, h * S::from_f64(speed));
        let closing = dot(sub(v_b, v_a), couple.out).min(S::ZERO);
        let [a, b] = couple.bodies.map(|body| body as usize);
        state.counts.parted += 1;
        for (body, (share, goes_by), goes) in
            [(a, (share[0], goes_by[0]), -S::ONE), (b, (share[1], goes_by[1]), S::ONE)]
        {
            shifts[body] = add(shifts[body], scale(way, goes * goes_by));
            let gain = scale(couple.out, -goes * share * closing);
            if let Some(number) = state.whole_number(body as u32) {
                state.frames[number].speed_up(widen(gain));
            }
            for i in state.bases[body] as usize..state.bases[body + 1] as usize {
                if state.w[i] != S::ZERO {
                    state.velocity[i] = add(state.velocity[i], gain);
                    if let Some(tally) = &mut state.tally {
                        tally.push(i, S::ZERO, (scale(gain, h), zero()));
                    }
                }
            }
        }
    }
    state.tangle.couples = couples;
    let (most, own, gravity) = (h * S::from_f64(SPEED), state.own(), gravity.map(S::from_f64));
    if shifts.iter().any(|shift| *shift != zero()) {
        state.gone[..own].iter_mut().for_each(|gone| *gone += most);
    }
    for (body, &shift) in shifts.iter().enumerate().filter(|(_, shift)| **shift != zero()) {
        let length = dot(shift, shift).sqrt();
        let shift = if length > most { scale(shift, most / length) } else { shift };
        state.carry(body, shift);
        for i in state.bases[body] as usize..state.bases[body + 1] as usize {
            if state.w[i] != S::ZERO {
                state.now[i] = add(state.now[i], shift);
                if !state.is_carried(i) {
                    state.lifted -= dot(gravity, shift) / state.w[i];
                }
            }
        }
        if let Some(frame) = state.free_whole(body as u32) {
            state.lifted -= dot(gravity, shift) * S::from_f64(frame.mass());
        }
    }
}

/// Whether springs were loaded by what was parted already.
pub(super) fn owes<S: Real>(state: &Cluster<S>) -> bool {
    if state.debt == S::ZERO {
        return false;
    }
    state.debt > S::HALF * guard::mass(state) * S::from_f64(OWED * OWED)
}

/// Takes contacts away between bodies that are parted, and with themselves of bodies that are mended or that led pins tore at.
pub(super) fn suspend<S: Real>(state: &Cluster<S>, pairs: &mut Vec<Pair<S>>) {
    let Cluster { body_of, tangle, .. } = state;
    let is_any = tangle.couples.iter().any(Couple::is_parted)
        || tangle.knots.iter().any(Knot::is_mended)
        || tangle.torn.contains(&true);
    if !is_any {
        return;
    }
    pairs.retain(|pair| {
        let [a, b] = [pair.p, pair.a].map(|i| body_of[i as usize]);
        let bodies = [a.min(b), a.max(b)];
        if a == b {
            let place = tangle.knots.binary_search_by_key(&a, |knot| knot.body);
            !tangle.torn[a as usize] && !place.is_ok_and(|k| tangle.knots[k].is_mended())
        } else {
            let place = tangle.couples.binary_search_by_key(&bodies, |couple| couple.bodies);
            !place.is_ok_and(|k| tangle.couples[k].is_parted())
        }
    });
}
