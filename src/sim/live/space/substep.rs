//! One substep of a cluster in space, from top to bottom.

use super::bonds;
use super::calm;
use super::cluster::{Cluster, Common};
use super::detect::{self, farthest};
use super::truncate;
use crate::sim::environment::Environment;
use crate::sim::force::mouse::Push;
use crate::sim::live::given::Giver;
use crate::sim::live::substep::{LEAST_BOUNCE, PASSES, SHORT};
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{accumulate, add, convert, dot, length, scale, sub, widen, zero};

/// What acts from outside, the same for all clusters.
#[derive(Clone, Copy)]
pub(super) struct Outside<'a, S: Real> {
    pub(super) pull: &'a Pull<S, 3>,
    pub(super) around: &'a Environment<3>,
    /// What what settles loses of its velocity, as a rate `[1/s]`, one a body of the group.
    pub(super) settling: &'a [S],
}

/// Advances by `h` from `t` `[s]`.
pub(super) fn advance<S: Real>(state: &mut Cluster<S>, common: &Common<S>, outside: Outside<S>, (t, h): (f64, f64)) {
    let time = S::from_f64(h);
    calm::look(state, common);
    kick(state, common, outside, (t, h));
    let [obstacles, skins] = detect::is_due(state, time);
    if obstacles {
        detect::look_at_obstacles(state, common);
    }
    if skins {
        let old = detect::known(&state.pairs);
        detect::look_at_skins(state, common, &old);
    }
    state.predict(time);
    bonds::hold(state, common);
    state.choose();
    for _ in 0..PASSES {
        state.press(common);
    }
    truncate::cut(state);
    state.follow_sides();
    detect::count_ways(state);
    calm::keep(state, time);
    state.finish(common, h, outside.around.gravity);
    state.counts.substeps += 1;
    state.counts.points += state.now.len() as u64;
}

/// What forces, gravity and drag over `h` make of velocities.
fn kick<S: Real>(state: &mut Cluster<S>, common: &Common<S>, outside: Outside<S>, (t, h): (f64, f64)) {
    let Outside { pull, around, settling } = outside;
    let time = S::from_f64(h);
    let gives = !state.thrust.is_empty() || pull.air.is_some() || around.mouse_at(t + h).is_some();
    state.given.begin(&state.velocity, gives);
    bonds::pull(state, common, time);
    state.given.note_answers(&state.velocity);
    let fall: [S; 3] = convert(around.gravity.map(|g| g * h));
    for (k, &body) in state.bodies.iter().enumerate() {
        let kept = S::from_f64(libm::exp(-h * (pull.drag_rate + settling[body].to_f64())));
        for i in state.bases[k] as usize..state.bases[k + 1] as usize {
            if state.w[i] != S::ZERO {
                state.velocity[i] = scale(add(state.velocity[i], fall), kept);
            }
        }
    }
    blow(state, pull, (t, h));
    let Some((force, cursor)) = around.mouse_at(t + h) else { return };
    let push = Push::<S, 3>::new(force, cursor);
    state.counts.mouse_points += state.now.len() as u64;
    for i in (0..state.now.len()).filter(|&i| state.w[i] != S::ZERO) {
        if let Some(a) = push.acceleration(state.now[i]) {
            let gain = scale(a, time);
            state.given.give(&mut state.velocity, i, Giver::Mouse, [gain, gain]);
        }
    }
}

/// What constant forces and wind make of velocities, after drag: it is exact in the drag towards the wind.
fn blow<S: Real>(state: &mut Cluster<S>, pull: &Pull<S, 3>, (t, h): (f64, f64)) {
    let share = -libm::expm1(-h * pull.drag_rate);
    if pull.air.is_none() && state.thrust.is_empty() {
        return;
    }
    for i in 0..state.now.len() {
        if state.w[i] == S::ZERO {
            continue;
        }
        if let Some(&push) = state.thrust.get(i) {
            let gain = scale(push, S::from_f64(h));
            state.given.give(&mut state.velocity, i, Giver::Forces, [gain, gain]);
        }
        if let Some(air) = &pull.air {
            let gust = air.gust(widen(state.now[i]), t + 0.5 * h);
            let gain = convert(scale(add(air.mean, gust), share));
            state.given.give(&mut state.velocity, i, Giver::Wind, [gain, gain]);
        }
    }
}

impl<S: Real> Cluster<S> {
    /// Where velocities take the points.
    fn predict(&mut self, h: S) {
        self.given.close(&self.velocity);
        for i in 0..self.now.len() {
            let way = scale(self.velocity[i], h);
            self.start[i] = self.now[i];
            self.way[i] = way;
            self.now[i] = add(self.start[i], way);
        }
        for &number in &self.chosen {
            self.pairs[number as usize].clear();
        }
        for &number in &self.near {
            self.touches[number as usize].clear();
        }
    }

    /// Which pairs, and which of what is near obstacles, may touch in this substep: those whose points cannot have gone so far, and will not,
    /// are left out. What may touch something is pushed by as much as it goes against that, and pushes others.
    fn choose(&mut self) {
        let length = |way: [S; 3]| dot(way, way).sqrt();
        let mut slack = self.pushed();
        self.list_touches(slack);
        self.chosen.clear();
        if self.pairs.is_empty() {
            return;
        }
        let means = self.patches.means(&self.way);
        self.patches.part(&means);
        for i in 0..self.now.len() {
            self.ways[i] = length(sub(self.way[i], means[self.patches.of(i)]));
            self.goes[i] = self.gone_apart[i] + self.ways[i];
        }
        self.list_near(slack);
        for &number in &self.chosen {
            let [p, a, b, c] = self.pairs[number as usize].points;
            let of = |i: u32| means[self.patches.of(i as usize)];
            let common = length(sub(of(p), of(a))).max(length(sub(of(p), of(b)))).max(length(sub(of(p), of(c))));
            slack = slack.max(self.ways[p as usize] + farthest(&self.ways, [a, b, c]) + common);
        }
        for i in self.near.iter().flat_map(|&number| self.touches[number as usize].points) {
            slack = slack.max(length(self.way[i as usize]));
        }
        self.list_near(slack);
        self.list_touches(slack);
    }

    /// What may touch obstacles where points get so far beyond their ways.
    fn list_touches(&mut self, slack: S) {
        let Cluster { touches, touch_rooms, near, gone_far, way, .. } = self;
        let reach = |i: u32| gone_far[i as usize] + dot(way[i as usize], way[i as usize]).sqrt();
        near.clear();
        for (number, &room) in (0..).zip(touch_rooms.iter()) {
            let [p, q, r] = touches[number as usize].points;
            if room <= reach(p).max(reach(q)).max(reach(r)) + slack {
                near.push(number);
            }
        }
    }

    /// Pairs that may touch where points get so far beyond their ways.
    fn list_near(&mut self, slack: S) {
        let Cluster { pairs, rooms, goes, chosen, patches, .. } = self;
        chosen.clear();
        for (number, &room) in (0..).zip(rooms.iter()) {
            let [p, a, b, c] = pairs[number as usize].points;
            if room <= goes[p as usize] + farthest(goes, [a, b, c]) + patches.apart(p, [a, b, c]) + slack {
                chosen.push(number);
            }
        }
    }

    /// One pass over all contacts: obstacles last, which do not give way.
    fn press(&mut self, common: &Common<S>) {
        let (mut pairs, mut touches) = (std::mem::take(&mut self.pairs), std::mem::take(&mut self.touches));
        let chosen = std::mem::take(&mut self.chosen);
        chosen.iter().for_each(|&number| pairs[number as usize].press(self));
        self.chosen = chosen;
        let near = std::mem::take(&mut self.near);
        near.iter().for_each(|&number| touches[number as usize].press(self, common));
        (self.pairs, self.touches, self.near) = (pairs, touches, near);
    }

    /// Of all pairs: what goes around a triangle does so far from it, too.
    fn follow_sides(&mut self) {
        let mut pairs = std::mem::take(&mut self.pairs);
        pairs.iter_mut().for_each(|pair| pair.follow(self));
        self.pairs = pairs;
    }

    /// Velocities from what was gone, and positions summed up; then what bounces.
    fn finish(&mut self, common: &Common<S>, h: f64, gravity: [f64; 3]) {
        let rate = S::from_f64(1.0 / h);
        for i in 0..self.now.len() {
            let way = self.way[i];
            if self.w[i] != S::ZERO && h > SHORT {
                self.velocity[i] = scale(add(way, self.turned[i]), rate);
            }
            self.turned[i] = zero();
            self.now[i] = self.start[i];
            accumulate(&mut self.now[i], &mut self.lost[i], way);
        }
        self.work += self.given.works(&self.velocity, &self.w).seen;
        let least = S::from_f64(LEAST_BOUNCE * h * length(gravity));
        let (pairs, touches) = (std::mem::take(&mut self.pairs), std::mem::take(&mut self.touches));
        let chosen = std::mem::take(&mut self.chosen);
        chosen.iter().for_each(|&number| pairs[number as usize].bounce(self, least));
        let near = std::mem::take(&mut self.near);
        near.iter().for_each(|&number| touches[number as usize].bounce(self, common, least));
        let pressed = chosen.iter().filter(|&&number| pairs[number as usize].pressed > S::ZERO).count();
        self.counts.contacts += pressed as u64;
        self.has_pressed |= pressed > 0 || near.iter().any(|&number| touches[number as usize].pressed > S::ZERO);
        self.counts.work += 120 * chosen.len() as u64 + 2 * pairs.len() as u64;
        self.counts.work += 4 * touches.len() as u64 + 150 * near.len() as u64 + 30 * self.now.len() as u64;
        (self.pairs, self.touches, self.chosen, self.near) = (pairs, touches, chosen, near);
    }
}
