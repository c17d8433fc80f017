//! Implicit steps for stiff springs: the midpoint rule and backward Euler, by Newton's method on a sparse system.
//!
//! Unknown is the place u where forces are taken: with v = rate (u - x0) the points obey
//!
//! ```text
//! m rate^2 (u - x0 - v0/rate) = F(u, v),   rigid bonds hold at the end x0 + reach (u - x0)
//! ```
//!
//! Midpoint rule: rate = 2/h, reach = 2; order 2, stable at any substep, does not damp; springs keep energy exactly (`force/mean.rs`).
//! Backward Euler: rate = 1/h, reach = 1; order 1, stable at any substep, damps what it does not resolve.
//! Source: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed. 2006, II.1 and VIII.6.
//!
//! Points that touch surfaces are part of the system, with the law of `touch.rs`.

mod gain;
mod touch;

use crate::sim::bond::PointId;
use crate::sim::contact::Contacts;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::force::area;
use crate::sim::force::form::{Block, Form};
use crate::sim::force::mean::{amendment, mean};
use crate::sim::force::spring::Springs;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::solve::blocks::{Blocks, NOWHERE};
use crate::sim::vector::{accumulate, add, convert, dot, length, scale, sub, zero};
pub(crate) use gain::{Energy, is_left_alone};
use touch::{Pace, Touches};

/// Rounds of Newton's method after which a step has not converged.
const MOST_ROUNDS: u32 = 40;
/// The same where something touches a surface: friction follows what presses, a round behind.
const MOST_RUBBED_ROUNDS: u32 = 120;
/// How far places may be off, relative to their size, where it is decided who touches surfaces, and in the end: what rounding leaves.
const ROUGH: f64 = 1e-5;
const FINE: f64 = 0.0;
/// Shift, relative to the size of places, below which the system of the round before serves once more where something touches.
const STALE: f64 = 1e-4;
/// The same beyond which springs that are pressed together are left out of the system where something touches.
const FAR: f64 = 1e-3;
/// Rounds that a step usually takes.
pub(crate) const USUAL_ROUNDS: u64 = 5;

/// An implicit method with its system.
#[derive(Clone, Debug)]
pub(crate) struct Implicit<S: Real, const D: usize> {
    system: Blocks<S, D>,
    /// Points that have a block in common.
    pairs: Vec<[u32; 2]>,
    /// Ends and rest lengths of rigid bonds.
    rigid: Vec<(u32, u32, S)>,
    /// Corners and sizes of areas that are held.
    areas: Vec<([u32; 3], S)>,
    is_midpoint: bool,
    /// What surfaces do in the step under way.
    pub(crate) touches: Touches<S, D>,
    place: Vec<[S; D]>,
    force: Vec<[S; D]>,
    speed: Vec<[S; D]>,
    error: Vec<S>,
    work: Vec<S>,
    /// Rounds of the last step with a system of their own, and without.
    rounds: [u64; 2],
    /// Rounds after which a step is given up, counted as [`Implicit::rounds`] counts them.
    pub(crate) most_rounds: u64,
    has_converged: bool,
}

/// Places and velocities where forces are taken, and at which share of the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stage<'a, S, const D: usize> {
    pub(crate) place: &'a [[S; D]],
    pub(crate) speed: &'a [[S; D]],
    pub(crate) share: f64,
    /// Springs pull by their mean lengths.
    pub(crate) is_mean: bool,
}

/// What is held: rigid bonds with their lengths `[m]`, and corners of triangles with their areas `[m^2]`.
type Held<S> = (Vec<(PointId, PointId, S)>, Vec<([u32; 3], S)>);

impl<S: Real, const D: usize> Implicit<S, D> {
    /// The method for these springs and rigid bonds.
    pub(crate) fn new(
        is_midpoint: bool,
        w: &[S],
        (springs, form): (&Springs<S>, &Form<S>),
        (rigid, areas): Held<S>,
    ) -> Self {
        let is_free: Vec<bool> = w.iter().map(|&w| w != S::ZERO).collect();
        let mut pairs: Vec<[u32; 2]> = springs.iter().map(|spring| [spring.a, spring.b]).collect();
        pairs.extend(form.pairs());
        let rigid: Vec<(u32, u32, S)> = rigid.into_iter().map(|(a, b, rest)| (a.0, b.0, rest)).collect();
        let mut ends: Vec<[u32; 3]> = rigid.iter().map(|&(a, b, _)| [a, b, NOWHERE]).collect();
        ends.extend(areas.iter().map(|(corners, _)| *corners));
        Implicit {
            system: Blocks::new(&is_free, &pairs, &ends),
            pairs,
            is_midpoint,
            touches: Touches::default(),
            place: vec![zero(); w.len()],
            force: vec![zero(); w.len()],
            speed: vec![zero(); w.len()],
            error: vec![S::ZERO; ends.len()],
            work: Vec::new(),
            rounds: [0; 2],
            most_rounds: u64::MAX,
            has_converged: false,
            rigid,
            areas,
        }
    }

    /// Where forces were taken in the last step, and at which share of it; `None`: nowhere.
    pub(crate) fn stage(&self) -> Option<Stage<'_, S, D>> {
        let share = if self.is_midpoint { 0.5 } else { 1.0 };
        self.has_converged.then_some(Stage { place: &self.place, speed: &self.speed, share, is_mean: self.is_midpoint })
    }

    /// Rounds of the last step, those with a system of the round before as a quarter.
    pub(crate) fn rounds(&self) -> u64 {
        let [whole, short] = self.rounds;
        whole + short / 4
    }

    /// Multiplications of one round, about.
    pub(crate) fn work(&self) -> usize {
        self.system.work() + 4 * self.system.len()
    }

    /// Advances by `h` from time `t`. Returns whether Newton's method converged.
    pub(crate) fn step(
        &mut self,
        points: &mut Points<S, D>,
        pull: &mut Pull<S, D>,
        around: &Environment<D>,
        (t, h): (f64, f64),
        counters: &mut Counters,
    ) -> bool {
        let pace = Pace::new(self.is_midpoint, h);
        let time = t + pace.share * h;
        let ahead = S::ONE / pace.rate;
        for (u, (&x, &v)) in self.place.iter_mut().zip(points.position.iter().zip(&points.velocity)) {
            *u = add(x, scale(v, ahead));
        }
        let is_kept = pull.contacts.has_surfaces() && is_left_alone(points, pull, around, time);
        let before = is_kept.then(|| Energy::of(points, pull, h));
        self.touches.begin(points, pull);
        self.rounds = [0; 2];
        let mut close = if pull.contacts.has_surfaces() { ROUGH } else { FINE };
        let is_converged = loop {
            let is_converged = self.find(points, pull, around, (time, pace, close), counters);
            let has_changed = self.touches.decide((points, pull), &self.place, (pace, close == FINE));
            if close == FINE && !has_changed {
                break is_converged;
            }
            if self.rounds() >= self.most_rounds {
                break false;
            }
            close = if has_changed { close } else { FINE };
        };
        self.touches.end(points, pull, &self.place, pace);
        self.finish(points, pace);
        self.touches.give(points, &pull.contacts);
        let is_held = pull.restore(points, counters);
        let gains = before.is_some_and(|before| before.is_exceeded(Energy::of(points, pull, h)));
        self.has_converged = is_held && is_converged && !gains;
        self.has_converged
    }

    /// The places where forces balance to a share `close` of their size, with the points on surfaces that are on them now. Returns
    /// whether Newton's method converged.
    fn find(
        &mut self,
        points: &Points<S, D>,
        pull: &mut Pull<S, D>,
        around: &Environment<D>,
        (time, pace, close): (f64, Pace<S>, f64),
        counters: &mut Counters,
    ) -> bool {
        self.touches.put(points, &pull.contacts, &mut self.place, pace);
        let touches = !pull.contacts.is_idle();
        let (most, stale) = if touches { (MOST_RUBBED_ROUNDS, S::from_f64(STALE)) } else { (MOST_ROUNDS, S::ZERO) };
        let far = S::from_f64(FAR);
        let fine = S::EPSILON * S::from_f64(16.0);
        let small = fine.max(S::from_f64(close));
        let small = small * small;
        let mut last = S::INFINITY;
        for round in 0..most {
            if self.rounds() >= self.most_rounds {
                return false;
            }
            // Friction that does not settle is led there more slowly.
            let share = if round < MOST_ROUNDS / 2 || !self.error.is_empty() { S::ONE } else { S::HALF };
            self.balance((points, pull), around, (time, share), pace, counters);
            let is_whole = round == 0 || last > stale * stale;
            if is_whole {
                // What surfaces put elsewhere may be far from where it will be.
                let is_far = touches && last > far * far;
                self.assemble(points, pull, pace.rate, round > 8 || is_far);
                self.system.factor();
            }
            self.rounds[usize::from(!is_whole)] += 1;
            self.system.solve(&mut self.force, &mut self.error, &mut self.work);
            let mut largest = S::ZERO;
            for (u, shift) in self.place.iter_mut().zip(&self.force) {
                *u = add(*u, *shift);
                let size = dot(*shift, *shift) / (S::ONE + dot(*u, *u));
                largest = if size <= largest { largest } else { size };
            }
            self.note_bonds(points, pull);
            counters.iterations += 1;
            if largest <= small {
                return true;
            }
            if !largest.is_finite() {
                return false;
            }
            last = largest;
        }
        false
    }

    /// What presses points onto surfaces has the part that rigid bonds and areas pass on.
    fn note_bonds(&self, points: &Points<S, D>, pull: &mut Pull<S, D>) {
        if pull.contacts.is_idle() || self.error.is_empty() {
            return;
        }
        let w = &points.inverse_mass;
        let mut give = |end: u32, push: [S; D]| {
            if let Some(rest) = pull.contacts.of_mut(end as usize) {
                rest.pressing = sub(rest.pressing, scale(push, w[end as usize]));
            }
        };
        for (&(a, b, _), &lambda) in self.rigid.iter().zip(&self.error) {
            let push = scale(sub(self.place[a as usize], self.place[b as usize]), lambda);
            give(a, push);
            give(b, scale(push, -S::ONE));
        }
        for (&(corners, _), &lambda) in self.areas.iter().zip(&self.error[self.rigid.len()..]) {
            let slopes = area::slopes(corners.map(|corner| self.place[corner as usize]));
            for (corner, slope) in corners.into_iter().zip(slopes) {
                give(corner, scale(wide(slope), lambda));
            }
        }
    }

    /// What is left of the balance of forces, and of the rigid bonds.
    fn balance(
        &mut self,
        (points, pull): (&Points<S, D>, &mut Pull<S, D>),
        around: &Environment<D>,
        (time, share): (f64, S),
        Pace { rate, reach, .. }: Pace<S>,
        counters: &mut Counters,
    ) {
        let (x, w) = (&points.position, &points.inverse_mass);
        for i in 0..x.len() {
            self.speed[i] = scale(sub(self.place[i], x[i]), rate);
        }
        pull.forces(around, time, (&self.place, &self.speed, w), (zero(), &mut self.force), counters);
        if self.is_midpoint {
            for spring in pull.springs.iter() {
                let (a, b) = (spring.a as usize, spring.b as usize);
                let more = amendment(spring, sub(x[a], x[b]), sub(self.place[a], self.place[b]));
                self.force[a] = add(self.force[a], scale(more, w[a]));
                self.force[b] = sub(self.force[b], scale(more, w[b]));
            }
        }
        let gravity: [S; D] = convert(pull.gravity);
        let drag = S::from_f64(pull.drag_rate);
        for i in 0..x.len() {
            if w[i] == S::ZERO {
                self.force[i] = zero();
                continue;
            }
            let inertia = scale(sub(self.speed[i], points.velocity[i]), rate);
            let pulled = sub(add(self.force[i], gravity), scale(self.speed[i], drag));
            let total = sub(pulled, inertia);
            self.force[i] = scale(pull.contacts.rubbed(i, (total, share)), S::ONE / w[i]);
        }
        for (error, &(a, b, rest)) in self.error.iter_mut().zip(&self.rigid) {
            let (a, b) = (a as usize, b as usize);
            let (old, new) = (sub(x[a], x[b]), sub(self.place[a], self.place[b]));
            let end = add(old, scale(sub(new, old), reach));
            *error = S::HALF * (rest * rest - dot(end, end)) / reach;
        }
        for (error, &(corners, area)) in self.error[self.rigid.len()..].iter_mut().zip(&self.areas) {
            let end = |point: u32| {
                let i = point as usize;
                add(x[i], scale(sub(self.place[i], x[i]), reach))
            };
            *error = (area - area::size(corners.map(end))) / reach;
        }
    }

    /// The derivative: m rate^2 + m drag rate + K + rate C, with stiffness K and damping C of every spring.
    ///
    /// `is_cautious` leaves out what makes K indefinite: springs that are pressed together.
    fn assemble(&mut self, points: &Points<S, D>, pull: &Pull<S, D>, rate: S, is_cautious: bool) {
        self.system.clear();
        let own = rate * rate + rate * S::from_f64(pull.drag_rate);
        for (i, &w) in points.inverse_mass.iter().enumerate() {
            if w != S::ZERO {
                let mut block = [[S::ZERO; D]; D];
                for (k, row) in block.iter_mut().enumerate() {
                    row[k] = own / w;
                }
                self.system.add_own(i, &block);
            }
        }
        let (contacts, x) = (&pull.contacts, &points.position);
        for (pair, spring) in pull.springs.iter().enumerate() {
            let (a, b) = (spring.a as usize, spring.b as usize);
            let d = sub(self.place[a], self.place[b]);
            let long = if self.is_midpoint { mean(spring, sub(x[a], x[b]), d) } else { length(d) };
            let block = spring.stiffness_block((d, long), rate, is_cautious);
            if contacts.touches_any([a, b]) {
                self.system.add_own(a, &contacts.left_of([a, a], block));
                self.system.add_own(b, &contacts.left_of([b, b], block));
                self.system.add_block(pair, &contacts.left_of([a, b], block.map(|row| row.map(|k| -k))));
                continue;
            }
            self.system.add_own(a, &block);
            self.system.add_own(b, &block);
            self.system.add_pair(pair, &block.map(|row| row.map(|k| -k)));
        }
        let (system, first, pairs) = (&mut self.system, pull.springs.len(), &self.pairs);
        pull.form.stiffen((&self.place, rate, is_cautious), |place, block| match place {
            Block::Own(point) => system.add_own(point, &contacts.left_of([point; 2], block)),
            Block::Pair(pair) => {
                let ends = pairs[first + pair].map(|end| end as usize);
                system.add_block(first + pair, &contacts.left_of(ends, block));
            }
        });
        for (c, &(a, b, rest)) in self.rigid.iter().enumerate() {
            let (a, b) = (a as usize, b as usize);
            let d = sub(self.place[a], self.place[b]);
            // Where bonds repeat each other, or surfaces hold both ends, the corner keeps the system regular.
            let corner = -(rest * rest) * S::EPSILON / own;
            if contacts.touches_any([a, b]) {
                let ends = [contacts.free(a, d), scale(contacts.free(b, d), -S::ONE), zero()];
                self.system.set_three(c, ends, corner);
            } else {
                self.system.set_line(c, d, corner);
            }
        }
        self.set_areas(contacts, own);
    }

    /// The rows of areas that are held.
    fn set_areas(&mut self, contacts: &Contacts<S, D>, own: S) {
        for (k, &(corners, area)) in self.areas.iter().enumerate() {
            let slopes = area::slopes(corners.map(|corner| self.place[corner as usize]));
            let ends = std::array::from_fn(|m| contacts.free(corners[m] as usize, wide(slopes[m])));
            self.system.set_three(self.rigid.len() + k, ends, -area * S::EPSILON / own);
        }
    }

    /// From the place where forces were taken to the end of the step.
    fn finish(&mut self, points: &mut Points<S, D>, pace: Pace<S>) {
        for i in 0..points.len() {
            let way = sub(self.place[i], points.position[i]);
            let v = pace.velocity(way, points.velocity[i]);
            accumulate(&mut points.position[i], &mut points.position_lost[i], pace.way(way));
            if points.inverse_mass[i] != S::ZERO {
                points.velocity[i] = v;
                points.velocity_lost[i] = zero();
            }
        }
    }
}

fn wide<S: Real, const D: usize>(slope: [S; 2]) -> [S; D] {
    std::array::from_fn(|k| if k < 2 { slope[k] } else { S::ZERO })
}
