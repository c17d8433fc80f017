//! Implicit steps for stiff springs: the midpoint rule and backward Euler, by Newton's method on a sparse system.
//!
//! Unknown is the place u where forces are taken: with v = rate (u - x0) the points obey
//!
//! ```text
//! m rate^2 (u - x0 - v0/rate) = F(u, v),   rigid bonds hold at the end x0 + reach (u - x0)
//! ```
//!
//! Midpoint rule: rate = 2/h, reach = 2; order 2, symplectic, stable at any substep, does not damp.
//! Backward Euler: rate = 1/h, reach = 1; order 1, stable at any substep, damps what it does not resolve.
//! Source: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed. 2006, II.1 and VIII.6.

use crate::sim::bond::PointId;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::force::area;
use crate::sim::force::form::{Block, Form};
use crate::sim::force::spring::Springs;
use crate::sim::points::Points;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::solve::blocks::{Blocks, NOWHERE};
use crate::sim::vector::{accumulate, add, convert, dot, scale, sub, zero};

/// Rounds of Newton's method after which a step has not converged.
const MOST_ROUNDS: u32 = 40;
/// Rounds that a step usually takes.
pub(crate) const USUAL_ROUNDS: u64 = 5;

/// An implicit method with its system.
#[derive(Clone, Debug)]
pub(crate) struct Implicit<S: Real, const D: usize> {
    system: Blocks<S, D>,
    /// Ends and rest lengths of rigid bonds.
    rigid: Vec<(u32, u32, S)>,
    /// Corners and sizes of areas that are held.
    areas: Vec<([u32; 3], S)>,
    is_midpoint: bool,
    place: Vec<[S; D]>,
    force: Vec<[S; D]>,
    speed: Vec<[S; D]>,
    error: Vec<S>,
    work: Vec<S>,
}

/// What is held: rigid bonds with their lengths [m], and corners of triangles with their areas [m^2].
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
            is_midpoint,
            place: vec![zero(); w.len()],
            force: vec![zero(); w.len()],
            speed: vec![zero(); w.len()],
            error: vec![S::ZERO; ends.len()],
            work: Vec::new(),
            rigid,
            areas,
        }
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
        let (rate, reach) = if self.is_midpoint { (2.0 / h, S::ONE + S::ONE) } else { (1.0 / h, S::ONE) };
        let time = if self.is_midpoint { t + 0.5 * h } else { t + h };
        let rate = S::from_f64(rate);
        let ahead = S::ONE / rate;
        for (u, (&x, &v)) in self.place.iter_mut().zip(points.position.iter().zip(&points.velocity)) {
            *u = add(x, scale(v, ahead));
        }
        let mut is_converged = false;
        let mut last = S::INFINITY;
        for round in 0..MOST_ROUNDS {
            self.balance(points, pull, around, time, (rate, reach), counters);
            if round == 0 || last > S::ZERO {
                self.assemble(points, pull, rate, round > 8);
                self.system.factor();
            }
            self.system.solve(&mut self.force, &mut self.error, &mut self.work);
            let mut largest = S::ZERO;
            for (u, shift) in self.place.iter_mut().zip(&self.force) {
                *u = add(*u, *shift);
                let size = dot(*shift, *shift) / (S::ONE + dot(*u, *u));
                largest = if size <= largest { largest } else { size };
            }
            counters.iterations += 1;
            let small = S::EPSILON * S::from_f64(16.0);
            if largest <= small * small {
                is_converged = true;
                break;
            }
            if !largest.is_finite() {
                break;
            }
            last = largest;
        }
        self.finish(points, rate);
        pull.restore(points, counters) && is_converged
    }

    /// What is left of the balance of forces, and of the rigid bonds.
    fn balance(
        &mut self,
        points: &Points<S, D>,
        pull: &Pull<S, D>,
        around: &Environment<D>,
        time: f64,
        (rate, reach): (S, S),
        counters: &mut Counters,
    ) {
        let (x, w) = (&points.position, &points.inverse_mass);
        for i in 0..x.len() {
            self.speed[i] = scale(sub(self.place[i], x[i]), rate);
        }
        pull.forces(around, time, (&self.place, &self.speed, w), (zero(), &mut self.force), counters);
        let gravity: [S; D] = convert(pull.gravity);
        let drag = S::from_f64(pull.drag_rate);
        for i in 0..x.len() {
            if w[i] == S::ZERO {
                self.force[i] = zero();
                continue;
            }
            let inertia = scale(sub(self.speed[i], points.velocity[i]), rate);
            let pulled = sub(add(self.force[i], gravity), scale(self.speed[i], drag));
            self.force[i] = scale(sub(pull.contacts.free(i, pulled), inertia), S::ONE / w[i]);
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
        for (pair, spring) in pull.springs.iter().enumerate() {
            let d = sub(self.place[spring.a as usize], self.place[spring.b as usize]);
            let block = spring.stiffness_block(d, rate, is_cautious);
            self.system.add_own(spring.a as usize, &block);
            self.system.add_own(spring.b as usize, &block);
            self.system.add_pair(pair, &block.map(|row| row.map(|k| -k)));
        }
        let (system, first) = (&mut self.system, pull.springs.len());
        pull.form.stiffen((&self.place, rate, is_cautious), |place, block| match place {
            Block::Own(point) => system.add_own(point, &block),
            Block::Pair(pair) => system.add_block(first + pair, &block),
        });
        for (c, &(a, b, rest)) in self.rigid.iter().enumerate() {
            let d = sub(self.place[a as usize], self.place[b as usize]);
            // Where bonds repeat each other the corner keeps the system regular.
            self.system.set_line(c, d, -(rest * rest) * S::EPSILON / own);
        }
        self.set_areas(own);
    }

    /// The rows of areas that are held.
    fn set_areas(&mut self, own: S) {
        for (k, &(corners, area)) in self.areas.iter().enumerate() {
            let slopes = area::slopes(corners.map(|corner| self.place[corner as usize]));
            let wide = slopes.map(|slope| std::array::from_fn(|k| if k < 2 { slope[k] } else { S::ZERO }));
            self.system.set_three(self.rigid.len() + k, wide, -area * S::EPSILON / own);
        }
    }

    /// From the place where forces were taken to the end of the step.
    fn finish(&mut self, points: &mut Points<S, D>, rate: S) {
        for i in 0..points.len() {
            let way = sub(self.place[i], points.position[i]);
            let speed = scale(way, rate);
            let (x, v) = if self.is_midpoint {
                (add(way, way), sub(add(speed, speed), points.velocity[i]))
            } else {
                (way, speed)
            };
            accumulate(&mut points.position[i], &mut points.position_lost[i], x);
            if points.inverse_mass[i] != S::ZERO {
                points.velocity[i] = v;
                points.velocity_lost[i] = zero();
            }
        }
    }
}
