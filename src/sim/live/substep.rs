//! One substep of a cluster, from top to bottom.

use super::FRAMES;
use super::areas;
use super::bear;
use super::bend;
use super::bonds;
use super::calm;
use super::cluster::{Cluster, Common};
use super::detect;
use super::drives;
use super::fields;
use super::given::Giver;
use super::mend;
use super::part;
use super::shape;
use super::tree;
use crate::sim::environment::Environment;
use crate::sim::force::mouse::Push;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{accumulate, add, convert, dot, scale, zero};

/// Passes over areas and contacts.
pub(super) const PASSES: u32 = 3;
/// Speeds below which nothing bounces, in what gravity gives within a substep.
pub(super) const LEAST_BOUNCE: f64 = 2.0;

/// Rigid bonds that a blow which is given back goes through in a substep of 1/32 of a frame, about, in a shorter one as many as its share, and how
/// many times it may go through one.
const BOUNCED: u64 = 8_192;
const FEW: f64 = 32.0;
const MOST_ROUNDS: u64 = 128;

/// How far contacts and areas may push a point beyond its way within a substep, in the least promise: pairs further apart are left out.
pub(super) const PUSHED: f64 = 0.2;
/// How fast skins that overlap are parted at most `[m/s]`.
pub(super) const GENTLE: f64 = 1.0;

/// Counted work of a substep for each point.
const OF_A_POINT: u64 = 70;

/// Substeps up to which velocities are left as forces made them `[s]`: what bonds and contacts still lack of the step before is made good, but is
/// no speed, which it would be beyond all bounds over so short a time.
pub(super) const SHORT: f64 = 1.5e-6;

/// What acts from outside, the same for all clusters.
#[derive(Clone, Copy)]
pub(super) struct Outside<'a, S: Real> {
    pub(super) pull: &'a Pull<S, 2>,
    pub(super) around: &'a Environment<2>,
    /// What points keep of their velocities in a second, as a rate `[1/s]`, one a body of the group.
    pub(super) settling: &'a [S],
}

/// Advances by `h` from `t` `[s]`.
pub(super) fn advance<S: Real>(state: &mut Cluster<S>, common: &Common<S>, outside: Outside<S>, (t, h): (f64, f64)) {
    let time = S::from_f64(h);
    kick(state, common, outside, (t, h));
    if state.may_leave(time) {
        detect::look(state, common);
    }
    part::drift(state, time, outside.around.gravity);
    state.predict(time);
    shape::resist(state, common, time);
    drives::turn(state, outside.around, (t + h, time));
    bonds::hold(state, common);
    drives::hold(state, false);
    state.close_rigs();
    state.follow_rigs();
    mend::lead(state, time);
    areas::look(state, common);
    let (passes, pushed) = tree::passes(state, common);
    let (pushed, longest) = state.choose(pushed);
    state.note_near();
    state.touch(common, (time, pushed, longest), outside.around.gravity);
    let passes = if state.touches.is_alone { 1 } else { passes };
    for pass in 0..passes {
        shape::hold(state, common);
        drives::stop(state);
        areas::unfold(state, common);
        if pass > 0 {
            bend::again(state, common, time);
            tree::straighten(state, common, pass + 1 == passes);
            bonds::hold_again(state);
            drives::hold(state, true);
        }
        state.press(common, pushed);
        state.straighten_rigs();
    }
    state.end_touches(common);
    bear::stop(state, common);
    super::truncate::cut(state);
    super::circle::cut(state, common);
    state.follow_sides();
    state.finish(h, common, outside.pull.gravity);
    state.pressed_in = time;
    state.counts.substeps += 1;
    state.counts.points += state.busy() as u64;
}

/// What forces, gravity and drag over `h` make of velocities.
fn kick<S: Real>(state: &mut Cluster<S>, common: &Common<S>, outside: Outside<S>, (t, h): (f64, f64)) {
    let Outside { pull, around, settling } = outside;
    let time = S::from_f64(h);
    let own = state.own();
    state.begun[..own].copy_from_slice(&state.velocity[..own]);
    if let Some(tally) = &mut state.tally {
        tally.begin();
    }
    let gives = !state.thrusts.is_empty() || pull.air.is_some() || around.mouse_at(t + h).is_some();
    state.given.begin(&state.velocity[..own], gives);
    bonds::pull(state, common, time);
    drives::begin(state, around, (t, h));
    state.given.note_answers(&state.velocity);
    let fall: [S; 2] = convert(around.gravity.map(|g| g * h));
    for (k, &body) in state.bodies.iter().enumerate() {
        let kept = S::from_f64(libm::exp(-h * (pull.drag_rate + settling[body].to_f64())));
        for i in state.bases[k] as usize..state.bases[k + 1] as usize {
            if state.w[i] != S::ZERO {
                let falls = add(state.velocity[i], fall);
                if let Some(tally) = state.tally.as_mut().filter(|_| kept < S::ONE) {
                    tally.slow((falls, state.w[i], kept));
                }
                state.velocity[i] = scale(falls, kept);
            }
        }
        if let Some(number) = state.whole_number(k as u32) {
            state.frames[number].fall(around.gravity.map(|g| g * h), kept.to_f64());
        }
    }
    fields::blow(state, outside, (t, h));
    if let Some((force, cursor)) = around.mouse_at(t + h) {
        let push = Push::<S, 2>::new(force, cursor);
        state.counts.mouse_points += own as u64;
        for i in 0..own {
            if state.w[i] != S::ZERO
                && let Some(a) = push.acceleration(state.now[i])
            {
                let gain = scale(a, time);
                state.given.give(&mut state.velocity, i, Giver::Mouse, [gain, gain]);
            }
        }
    }
}

/// The largest speed `[m/s]`.
pub(super) fn fastest<S: Real>(state: &Cluster<S>) -> S {
    longest(&state.velocity[..state.own()])
}

/// The largest length in a list: four at once, which do not wait for each other.
fn longest<S: Real>(list: &[[S; 2]]) -> S {
    let mut most = [S::ZERO; 4];
    for four in list.chunks(4) {
        for (most, &v) in most.iter_mut().zip(four) {
            *most = most.max(dot(v, v));
        }
    }
    most[0].max(most[1]).max(most[2].max(most[3])).sqrt()
}

impl<S: Real> Cluster<S> {
    /// Where velocities take the points.
    fn predict(&mut self, h: S) {
        self.given.close(&self.velocity);
        self.gentle = h * S::from_f64(GENTLE);
        for i in 0..self.own() {
            let way = scale(self.velocity[i], h);
            self.start[i] = self.now[i];
            self.way[i] = way;
            self.now[i] = add(self.start[i], way);
        }
        self.predict_rigid(h);
        let last = (self.load_of_a_push(), self.least_bounce);
        for &number in &self.chosen {
            self.pairs[number as usize].contact.clear(last);
        }
        self.on_planes.iter_mut().for_each(|on| on.contact.clear(last));
    }

    /// Whether a point may get further within `h` `[s]` than it was looked at.
    fn may_leave(&self, h: S) -> bool {
        let own = self.own();
        let (velocity, promised, gone) = (&self.velocity[..own], &self.promised[..own], &self.gone[..own]);
        (0..own).any(|i| {
            let left = promised[i] - gone[i];
            // NaN is looked at.
            let stays = left >= S::ZERO && h * h * dot(velocity[i], velocity[i]) <= left * left;
            !stays
        })
    }

    /// Which pairs may touch in this substep: those whose points cannot have gone so far, and will not, are left out. Others push them by
    /// `slack` `[m]`, or as far as the fastest goes. Returns the larger one, and how far the fastest
    /// goes.
    fn choose(&mut self, slack: S) -> (S, S) {
        let own = self.own();
        let (goes, gone, way) = (&mut self.goes[..own], &self.gone[..own], &self.way[..own]);
        // Four largest that do not wait for each other.
        let (mut farthest, mut fastest) = ([S::ZERO; 4], [S::ZERO; 4]);
        for ((goes, gone), way) in goes.chunks_mut(4).zip(gone.chunks(4)).zip(way.chunks(4)) {
            for (j, (goes, (&gone, &way))) in goes.iter_mut().zip(gone.iter().zip(way)).enumerate() {
                let length = dot(way, way).sqrt();
                *goes = gone + length;
                farthest[j] = farthest[j].max(*goes);
                fastest[j] = fastest[j].max(length);
            }
        }
        let [farthest, fastest] = [farthest, fastest].map(|most| most[0].max(most[1]).max(most[2].max(most[3])));
        let slack = slack.max(fastest);
        let reach = farthest + farthest + slack;
        let Cluster { pairs, goes, rooms, chosen, active, .. } = self;
        let may_touch = |number: u32, room: S| {
            let pair = &pairs[number as usize];
            room <= goes[pair.p as usize] + goes[pair.a as usize].max(goes[pair.b as usize]) + slack
        };
        let near = rooms.iter().zip(0..).filter(|&(&room, number)| room <= reach && may_touch(number, room));
        chosen.clear();
        chosen.extend(near.map(|(_, number)| number));
        active.clone_from(chosen);
        (slack, fastest)
    }

    /// One pass over all contacts; pairs that are too far apart to touch by what is still to come are left out from then on, but cut and
    /// followed.
    fn press(&mut self, common: &Common<S>, slack: S) {
        self.press_touches();
        let mut pairs = std::mem::take(&mut self.pairs);
        let mut active = std::mem::take(&mut self.active);
        self.counts.work += 25 * active.len() as u64;
        active.retain(|&number| pairs[number as usize].press(self, slack));
        let mut on_planes = std::mem::take(&mut self.on_planes);
        on_planes.iter_mut().for_each(|on| on.press(self, common));
        super::circle::press_again(self, common, (&mut pairs, &active), &mut on_planes);
        (self.pairs, self.active, self.on_planes) = (pairs, active, on_planes);
    }

    fn follow_sides(&mut self) {
        let mut pairs = std::mem::take(&mut self.pairs);
        let chosen = std::mem::take(&mut self.chosen);
        chosen.iter().for_each(|&number| pairs[number as usize].follow(self));
        (self.pairs, self.chosen) = (pairs, chosen);
    }

    /// Velocities from what was gone, and positions summed up; then what bounces.
    fn finish(&mut self, h: f64, common: &Common<S>, gravity: [f64; 2]) {
        let rate = S::from_f64(1.0 / h);
        let own = self.own();
        let is_long = h > SHORT;
        self.follow_rigid();
        calm::keep(self, common, S::from_f64(h));
        let (gone, way) = (&mut self.gone[..own], &self.way[..own]);
        for i in 0..own {
            gone[i] += dot(way[i], way[i]).sqrt();
        }
        let (now, velocity) = (&mut self.now[..own], &mut self.velocity[..own]);
        let (start, way, lost, w) = (&self.start[..own], &self.way[..own], &mut self.lost[..own], &self.w[..own]);
        let turned = &mut self.turned[..own];
        for i in 0..own {
            if w[i] != S::ZERO && is_long {
                velocity[i] = scale(add(way[i], turned[i]), rate);
            }
            turned[i] = zero();
            now[i] = start[i];
            accumulate(&mut now[i], &mut lost[i], way[i]);
        }
        self.finish_rigid(h);
        if is_long && self.stiffen_rigs() > 0 {
            self.turn_rigid();
        }
        for (thin, ends) in self.thin.iter_mut().zip(self.bases.windows(2)) {
            thin.go(&self.way[ends[0] as usize..ends[1] as usize]);
        }
        drives::count(self, h);
        self.book_given();
        if is_long {
            self.tally(common, h);
        }
        let (mut pairs, mut on_planes) = (std::mem::take(&mut self.pairs), std::mem::take(&mut self.on_planes));
        let numbers = std::mem::take(&mut self.chosen);
        let least = S::from_f64(LEAST_BOUNCE * h * crate::sim::vector::length(gravity));
        self.least_bounce = least;
        self.rebound(common, |state| {
            let mut gave = Gave::default();
            for &number in &numbers {
                let pair = &mut pairs[number as usize];
                gave.note(pair.bounce(state, least), pair.restitution);
            }
            for on in &mut on_planes {
                let [_, restitution] = on.surface(common);
                gave.note(on.bounce(state, restitution, least), restitution);
            }
            gave
        });
        let pressed = numbers.iter().filter(|&&number| pairs[number as usize].contact.pressed > S::ZERO).count();
        self.counts.contacts += pressed as u64;
        let lies = on_planes.iter().any(|on| on.contact.pressed > S::ZERO);
        self.has_pressed |= pressed > 0 || lies;
        self.counts.work += 45 * numbers.len() as u64 + 4 * pairs.len() as u64;
        self.counts.work += 20 * on_planes.len() as u64 + OF_A_POINT * self.busy() as u64;
        (self.pairs, self.chosen, self.on_planes) = (pairs, numbers, on_planes);
        self.has_leaned |= (pressed > 0 || lies) && self.leans();
    }

    /// Gives what restitution asks for, by `give`, which goes through rigid bonds at once: again and again, until no more is lacking.
    fn rebound(&mut self, common: &Common<S>, mut give: impl FnMut(&mut Self) -> Gave) {
        let started = self.kinetic();
        let (mut solved, mut takes) = (0, false);
        let share = (self.span.to_f64() * FRAMES * FEW).min(1.0);
        let most = (BOUNCED as f64 * share) as u64;
        while solved < most {
            let gave = give(self);
            takes |= gave.takes;
            let count =
                if gave.any { bonds::stiffen(self, common) + self.stiffen_rigs() + self.rigid_count() } else { 0 };
            if count == 0 {
                break;
            }
            solved += count.max(most / MOST_ROUNDS);
        }
        if solved > 0 {
            self.turn_rigid();
        }
        if let (Some(started), Some(ended)) = (started, self.kinetic())
            && takes
            && let Some(tally) = &mut self.tally
        {
            tally.give_back(ended - started);
        }
    }
}

/// What restitution gave: any speed, and any that is less than what came in.
#[derive(Clone, Copy, Default)]
struct Gave {
    any: bool,
    takes: bool,
}

impl Gave {
    fn note<S: Real>(&mut self, gave: bool, restitution: S) {
        self.any |= gave;
        self.takes |= gave && restitution < S::ONE;
    }
}
