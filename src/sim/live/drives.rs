//! Driven bonds and angles of a cluster: muscles, servos and motors.
//!
//! Rest lengths and angles at rest are those at the end of a substep. What a drive does within it is the energy that its moved rest gives
//! what it drives, which the guard is told, and by the spring of its own rest length what the ledger has.

use super::bonds;
use super::build::Bodies;
use super::cluster::{Cluster, Common};
use super::rigid::{Change, goes_with_frame};
use super::shape;
use crate::sim::bond::{Bond, BondKind};
use crate::sim::drive::{AngleDrive, Drive, Keys, Signal};
use crate::sim::environment::Environment;
use crate::sim::force::angle::Hinge;
use crate::sim::force::form::at;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, length, scale, sub, zero};

/// A driven bond between two points of a body, then of a cluster.
#[derive(Clone, Copy, Debug)]
pub(super) struct Muscle<S> {
    pub(super) ends: [u32; 2],
    /// Its own rest length, and that of now `[m]`.
    own: S,
    rest: S,
    /// `[N/m]`; infinite: rigid.
    stiffness: S,
    /// `[N s/m]`
    damping: S,
    drive: Drive,
    /// Bounds on what its ends do, as springs have them (`Bodies::swings`).
    swing: [S; 2],
    /// It is a force in this step, not projected.
    is_force: bool,
    /// How much its rest length grew in this substep `[m]`.
    grown: S,
    /// What pushed its first end in this substep `[kg m]`.
    pushed: [S; 2],
}

/// A driven angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn<S> {
    /// As it is made, and with its rest as it is now.
    own: Hinge<S>,
    pub(super) now: Hinge<S>,
    /// How far its rest is moved now `[rad]`, and by how much that grew in this substep.
    by: S,
    grown: S,
    /// What a motor turned it by in this substep `[N m s^2]`.
    turned: S,
}

impl<S: Real> Muscle<S> {
    /// `None` of a bond that nothing drives, or that cannot be.
    pub(super) fn of(bond: &Bond, ends: [u32; 2], swing: [S; 2]) -> Option<Self> {
        let drive = bond.drive?;
        let (stiffness, damping) = match bond.kind {
            BondKind::Spring { stiffness, damping } => (stiffness, damping),
            BondKind::Rigid => (f64::INFINITY, 0.0),
            BondKind::Relaxed { .. } => return None,
        };
        let own = S::from_f64(bond.rest_length);
        Some(Muscle {
            ends,
            own,
            rest: own,
            stiffness: S::from_f64(stiffness),
            damping: S::from_f64(damping),
            drive,
            swing,
            is_force: false,
            grown: S::ZERO,
            pushed: zero(),
        })
    }

    fn rest_at(&self, t: f64, keys: &Keys) -> S {
        self.own * S::from_f64(1.0 + self.drive.amplitude * self.drive.signal.level(t, keys))
    }

    fn is_rigid(&self) -> bool {
        !self.stiffness.is_finite()
    }

    /// What it is from its rest length of now `[m]`.
    fn error(&self, x: &[[S; 2]]) -> S {
        length(self.along(x)) - self.rest
    }

    fn along(&self, x: &[[S; 2]]) -> [S; 2] {
        sub(x[self.ends[0] as usize], x[self.ends[1] as usize])
    }
}

impl<S: Real> Turn<S> {
    pub(super) fn of(hinge: Hinge<S>) -> Self {
        Turn { own: hinge, now: hinge, by: S::ZERO, grown: S::ZERO, turned: S::ZERO }
    }

    fn by_at(&self, t: f64, keys: &Keys) -> S {
        match self.own.drive {
            Some(AngleDrive::Servo { amplitude, .. }) => S::from_f64(amplitude) * self.own.level(t, keys),
            _ => S::ZERO,
        }
    }
}

/// What moves bodies of a group by itself.
#[derive(Clone, Debug)]
pub(super) struct Source {
    body: u32,
    drive: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Bond(Signal),
    Angle(AngleDrive),
}

impl Source {
    /// All of a group.
    pub(super) fn list<S: Real>(bodies: &Bodies<S>) -> Vec<Source> {
        let mut list = Vec::new();
        for (body, number) in bodies.list.iter().zip(0..) {
            let muscles = bodies.muscles[body.muscles.range()].iter().map(|muscle| Kind::Bond(muscle.drive.signal));
            let turns = bodies.turns[body.turns.range()].iter().filter_map(|turn| turn.own.drive).map(Kind::Angle);
            list.extend(muscles.chain(turns).map(|drive| Source { body: number, drive }));
        }
        list
    }

    /// The body that it moves after time `t` `[s]`, if it does.
    pub(super) fn moves(&self, t: f64, keys: &Keys) -> Option<usize> {
        let moves = match &self.drive {
            Kind::Bond(signal) => signal.moves_after(t, keys),
            Kind::Angle(drive) => drive.moves_after(t, keys),
        };
        moves.then_some(self.body as usize)
    }
}

/// The driven bonds and angles of a cluster as a step from `t` on `[s]` begins.
pub(super) fn prepare<S: Real>(state: &mut Cluster<S>, common: &Common<S>, (t, around): (f64, &Environment<2>), h: S) {
    state.muscles.clear();
    state.turns.clear();
    if common.bodies.muscles.is_empty() && common.bodies.turns.is_empty() {
        return;
    }
    let keys = &around.keys;
    for (k, (body, base)) in state.members(common).enumerate() {
        let may_swing = !state.is_violent && !state.settles[k];
        for muscle in &common.bodies.muscles[body.muscles.range()] {
            let ends = muscle.ends.map(|end| base as u32 + end);
            let is_force = may_swing && !muscle.is_rigid() && bonds::bears(muscle.swing, h);
            state.muscles.push(Muscle { ends, is_force, rest: muscle.rest_at(t, keys), ..*muscle });
        }
        for turn in &common.bodies.turns[body.turns.range()] {
            let own = turn.own.between(turn.own.points.map(|point| base as u32 + point));
            let by = turn.by_at(t, keys);
            state.turns.push(Turn { own, now: own.moved(by), by, ..*turn });
        }
    }
}

/// A substep of `h` from `t` on `[s]` begins: rests are moved, and muscles that are forces change velocities.
pub(super) fn begin<S: Real>(state: &mut Cluster<S>, around: &Environment<2>, (t, h): (f64, f64)) {
    let time = S::from_f64(h);
    for muscle in &mut state.muscles {
        let rest = muscle.rest_at(t + h, &around.keys);
        (muscle.grown, muscle.rest, muscle.pushed) = (rest - muscle.rest, rest, zero());
        if !muscle.is_force {
            continue;
        }
        let (d, [a, b]) = (muscle.along(&state.now), muscle.ends.map(|end| end as usize));
        let far = length(d);
        if far == S::ZERO {
            continue;
        }
        let along = scale(d, S::ONE / far);
        let closing = dot(sub(state.velocity[a], state.velocity[b]), along);
        let pull = scale(along, time * (muscle.stiffness * (far - rest) + muscle.damping * closing));
        state.velocity[a] = sub(state.velocity[a], scale(pull, state.w[a]));
        state.velocity[b] = add(state.velocity[b], scale(pull, state.w[b]));
    }
    for turn in &mut state.turns {
        let by = turn.by_at(t + h, &around.keys);
        (turn.grown, turn.by, turn.turned) = (by - turn.by, by, S::ZERO);
        turn.now = turn.own.moved(by);
    }
    state.counts.work += 60 * (state.muscles.len() + state.turns.len()) as u64;
}

/// Servos, as angles are; and motors: the torque of the speed that the substep of `h` ending at `t` `[s]` leaves, linear in it.
pub(super) fn turn<S: Real>(state: &mut Cluster<S>, around: &Environment<2>, (t, h): (f64, S)) {
    let mut turns = std::mem::take(&mut state.turns);
    for turn in &mut turns {
        shape::bend(state, &turn.now, (0, h));
        let Some(drive @ AngleDrive::Motor { speed, torque, .. }) = turn.own.drive else { continue };
        let hinge = &turn.now;
        let Some(stand) = hinge.stand(at(&state.now, hinge.points)) else { continue };
        let weight = shape::weight(state, hinge.points, stand.slopes);
        let slope = S::from_f64(drive.slope());
        let most = S::from_f64(torque);
        let rate = stand.rate(at(&state.way, hinge.points)) / h;
        let asked = slope * (S::from_f64(speed) * hinge.level(t, &around.keys) - rate) / (S::ONE + slope * h * weight);
        let push = asked.max(-most).min(most) * stand.share() * h * h;
        // What it presses beyond its stop turns nothing: both are within the body, and cancel.
        let is_stopped = hinge.stop > S::ZERO && weight > S::ZERO;
        turn.turned = if is_stopped { hinge.kept(stand.angle, push * weight) / weight } else { push };
        shape::push_turning(state, hinge, hinge.points, stand.slopes, (turn.turned, weight));
    }
    state.turns = turns;
}

/// One sweep over muscles that are projected: compliant constraints whose multiplier starts at 0, at the rest length of now.
pub(super) fn hold<S: Real>(state: &mut Cluster<S>, only_rigid: bool) {
    let mut muscles = std::mem::take(&mut state.muscles);
    let h = state.span;
    for muscle in muscles.iter_mut().filter(|muscle| !muscle.is_force && (!only_rigid || muscle.is_rigid())) {
        let (d, [a, b]) = (muscle.along(&state.now), muscle.ends.map(|end| end as usize));
        let far = length(d);
        if far == S::ZERO || muscle.stiffness == S::ZERO {
            continue;
        }
        let along = scale(d, S::ONE / far);
        let is_framed = [a, b].iter().any(|&i| goes_with_frame(&state.frame_of, i));
        let felt = match is_framed {
            true => state.felt(a, along) + state.felt(b, along),
            false => state.w[a] + state.w[b],
        };
        let (soft, drag) = match muscle.is_rigid() {
            true => (S::ZERO, S::ZERO),
            false => (S::ONE / (muscle.stiffness * h * h), muscle.damping / (muscle.stiffness * h)),
        };
        let sum = (S::ONE + drag) * felt + soft;
        if sum == S::ZERO {
            continue;
        }
        let error = far - muscle.rest + drag * dot(sub(state.way[a], state.way[b]), along);
        let push = scale(along, -error / sum);
        muscle.pushed = add(muscle.pushed, push);
        if is_framed {
            state.push_point(a, push, Change::Way);
            state.push_point(b, scale(push, -S::ONE), Change::Way);
            continue;
        }
        for (i, sign) in [(a, S::ONE), (b, -S::ONE)] {
            let own = scale(push, sign * state.w[i]);
            state.now[i] = add(state.now[i], own);
            state.way[i] = add(state.way[i], own);
        }
    }
    state.counts.bonds += muscles.len() as u64;
    state.counts.work += 30 * muscles.len() as u64;
    state.muscles = muscles;
}

/// Stops of driven joints.
pub(super) fn stop<S: Real>(state: &mut Cluster<S>) {
    let turns = std::mem::take(&mut state.turns);
    turns.iter().filter(|turn| turn.now.stop > S::ZERO).for_each(|turn| shape::stop(state, &turn.now, 0));
    state.turns = turns;
}

/// Energy of muscles and servos at their rests of now `[J]`, as the guard counts that of springs.
pub(super) fn elastic<S: Real>(state: &Cluster<S>) -> S {
    let muscles = state.muscles.iter().filter(|muscle| !muscle.is_rigid()).map(|muscle| {
        let error = muscle.error(&state.now);
        S::HALF * softened(state, muscle) * error * error
    });
    let turns = state.turns.iter().map(|turn| turn.now.energy_within(at(&state.now, turn.now.points)));
    muscles.chain(turns).fold(S::ZERO, |sum, energy| sum + energy)
}

/// The stiffness that it shows in a substep.
fn softened<S: Real>(state: &Cluster<S>, muscle: &Muscle<S>) -> S {
    let [a, b] = muscle.ends.map(|end| state.w[end as usize]);
    let slow = if muscle.is_force { S::ZERO } else { muscle.stiffness * state.span * state.span * (a + b) };
    muscle.stiffness / (S::ONE + slow)
}

/// Counts what drives did in a substep of `h` `[s]` that is over.
pub(super) fn count<S: Real>(state: &mut Cluster<S>, h: f64) {
    if state.muscles.is_empty() && state.turns.is_empty() {
        return;
    }
    let rate = S::from_f64(1.0 / h);
    // What the guard sees, and what the ledger has; dampers.
    let (mut seen, mut booked, mut damped) = (S::ZERO, S::ZERO, S::ZERO);
    for muscle in &state.muscles {
        let [a, b] = muscle.ends.map(|end| end as usize);
        let mean = |i: usize| scale(add(state.begun[i], state.velocity[i]), S::HALF);
        if muscle.is_rigid() {
            let done = rate * dot(muscle.pushed, sub(mean(a), mean(b)));
            (seen, booked) = (seen + done, booked + done);
            continue;
        }
        let (error, d) = (muscle.error(&state.now), muscle.along(&state.now));
        let before = length(muscle.along(&state.start));
        seen -= softened(state, muscle) * (error + S::HALF * muscle.grown) * muscle.grown;
        booked += muscle.stiffness * (muscle.rest - S::HALF * muscle.grown - muscle.own) * (length(d) - before);
        if muscle.damping > S::ZERO && length(d) > S::ZERO {
            let closing = |v: &[[S; 2]]| dot(sub(v[a], v[b]), d) / length(d);
            let [begun, now] = [&state.begun, &state.velocity].map(|v| closing(v));
            let acts = if muscle.is_force { begun } else { now };
            damped += muscle.damping * acts * (begun + now) * S::HALF * S::from_f64(h);
        }
    }
    for turn in &state.turns {
        let hinge = &turn.now;
        let Some(stand) = hinge.stand(at(&state.now, hinge.points)) else { continue };
        let [begun, now] = [&state.begun, &state.velocity].map(|v| stand.rate(at(v, hinge.points)));
        let mean = S::HALF * (begun + now);
        let motor = turn.turned * rate * mean;
        let off = hinge.off_rest(stand.angle);
        seen += motor - hinge.stiffness * (off + S::HALF * turn.grown) * turn.grown;
        let pull = hinge.stiffness * (turn.by - S::HALF * turn.grown) * stand.share();
        booked += motor + pull * mean * S::from_f64(h);
        damped += stand.share() * hinge.damping * now * mean * S::from_f64(h);
    }
    state.work += seen;
    state.book_drives(seen, booked, damped);
}
