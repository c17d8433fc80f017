//! One substep of a cluster, from top to bottom.

use super::areas;
use super::bonds;
use super::cluster::{Cluster, Common};
use super::detect;
use super::fields;
use super::mend;
use super::part;
use super::shape;
use super::tree;
use crate::sim::environment::Environment;
use crate::sim::force::mouse::Push;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{accumulate, add, convert, dot, scale};

/// Passes over areas and contacts.
pub(super) const PASSES: u32 = 3;
/// Speeds below which nothing bounces, in what gravity gives within a substep.
pub(super) const LEAST_BOUNCE: f64 = 2.0;

/// How fast skins that overlap are parted at most [m/s].
const GENTLE: f64 = 1.0;

/// What acts from outside, the same for all clusters.
#[derive(Clone, Copy)]
pub(super) struct Outside<'a, S: Real> {
    pub(super) pull: &'a Pull<S, 2>,
    pub(super) around: &'a Environment<2>,
    /// What points keep of their velocities in a second, as a rate [1/s], one a body of the group.
    pub(super) settling: &'a [S],
}

/// Advances by `h` from `t` [s].
pub(super) fn advance<S: Real>(state: &mut Cluster<S>, common: &Common<S>, outside: Outside<S>, (t, h): (f64, f64)) {
    let time = S::from_f64(h);
    kick(state, common, outside, (t, h));
    if state.gone + time * fastest(state) > state.promise {
        detect::look(state, common);
    }
    part::drift(state, time);
    part::suspend(state);
    state.predict(time);
    shape::resist(state, common, time);
    bonds::hold(state, common);
    mend::lead(state, time);
    for pass in 0..tree::passes(state, common) {
        shape::hold(state, common);
        areas::unfold(state, common);
        if pass > 0 {
            tree::straighten(state, common);
        }
        state.press(outside.pull.contacts.obstacles.planes());
    }
    super::truncate::cut(state);
    state.follow_sides();
    state.finish(h, outside.pull.contacts.obstacles.planes(), outside.pull.gravity);
    state.counts.substeps += 1;
    state.counts.points += state.own() as u64;
}

/// What forces, gravity and drag over `h` make of velocities.
fn kick<S: Real>(state: &mut Cluster<S>, common: &Common<S>, outside: Outside<S>, (t, h): (f64, f64)) {
    let Outside { pull, around, settling } = outside;
    let time = S::from_f64(h);
    bonds::pull(state, common, time);
    let fall: [S; 2] = convert(around.gravity.map(|g| g * h));
    for (k, &body) in state.bodies.iter().enumerate() {
        let kept = S::from_f64(libm::exp(-h * (pull.drag_rate + settling[body].to_f64())));
        for i in state.bases[k] as usize..state.bases[k + 1] as usize {
            if state.w[i] != S::ZERO {
                state.velocity[i] = scale(add(state.velocity[i], fall), kept);
            }
        }
    }
    fields::blow(state, outside, (t, h));
    if let Some((force, cursor)) = around.mouse_at(t + h) {
        let push = Push::<S, 2>::new(force, cursor);
        let own = state.own();
        state.counts.mouse_points += own as u64;
        for i in 0..own {
            if state.w[i] != S::ZERO
                && let Some(a) = push.acceleration(state.now[i])
            {
                let gain = scale(a, time);
                let middle = add(state.velocity[i], scale(gain, S::HALF));
                state.work += dot(gain, middle) / state.w[i];
                state.velocity[i] = add(state.velocity[i], gain);
            }
        }
    }
}

/// The largest speed [m/s].
pub(super) fn fastest<S: Real>(state: &Cluster<S>) -> S {
    let square = state.velocity[..state.own()].iter().fold(S::ZERO, |most, &v| most.max(dot(v, v)));
    square.sqrt()
}

impl<S: Real> Cluster<S> {
    /// Where velocities take the points.
    fn predict(&mut self, h: S) {
        self.gentle = h * S::from_f64(GENTLE);
        for i in 0..self.own() {
            let way = scale(self.velocity[i], h);
            self.start[i] = self.now[i];
            self.way[i] = way;
            self.now[i] = add(self.start[i], way);
        }
        self.pairs.iter_mut().for_each(super::pair::Pair::clear);
        self.on_planes.iter_mut().for_each(super::pair::OnPlane::clear);
    }

    /// One pass over all contacts.
    fn press(&mut self, planes: &[crate::sim::contact::surface::Surface<S, 2>]) {
        let mut pairs = std::mem::take(&mut self.pairs);
        pairs.iter_mut().for_each(|pair| pair.press(self));
        self.pairs = pairs;
        let mut on_planes = std::mem::take(&mut self.on_planes);
        on_planes.iter_mut().for_each(|on| on.press(self, &planes[on.surface as usize]));
        self.on_planes = on_planes;
    }

    fn follow_sides(&mut self) {
        let mut pairs = std::mem::take(&mut self.pairs);
        pairs.iter_mut().for_each(|pair| pair.follow(self));
        self.pairs = pairs;
    }

    /// Velocities from what was gone, and positions summed up; then what bounces.
    fn finish(&mut self, h: f64, planes: &[crate::sim::contact::surface::Surface<S, 2>], gravity: [f64; 2]) {
        let rate = S::from_f64(1.0 / h);
        let mut farthest = S::ZERO;
        for i in 0..self.own() {
            let way = self.way[i];
            farthest = farthest.max(dot(way, way));
            if self.w[i] != S::ZERO {
                self.velocity[i] = scale(way, rate);
            }
            self.now[i] = self.start[i];
            accumulate(&mut self.now[i], &mut self.lost[i], way);
        }
        self.gone += farthest.sqrt();
        let least = S::from_f64(LEAST_BOUNCE * h * crate::sim::vector::length(gravity));
        let (pairs, on_planes) = (std::mem::take(&mut self.pairs), std::mem::take(&mut self.on_planes));
        for pair in &pairs {
            pair.bounce(self, least);
        }
        for on in &on_planes {
            on.bounce(self, &planes[on.surface as usize], least);
        }
        let pressed = pairs.iter().filter(|pair| pair.pressed > S::ZERO).count();
        self.counts.contacts += pressed as u64;
        self.has_pressed |= pressed > 0 || on_planes.iter().any(|on| on.pressed > S::ZERO);
        self.counts.work += 40 * pairs.len() as u64 + 20 * on_planes.len() as u64 + 20 * self.own() as u64;
        (self.pairs, self.on_planes) = (pairs, on_planes);
    }
}
