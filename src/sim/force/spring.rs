//! Springs with a damper along the bond, as forces.

use crate::sim::bond::{Bond, BondKind, Limit};
use crate::sim::colour::by_colour;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, length, scale, sub};

/// A spring as the kernel reads it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spring<S> {
    pub(crate) a: u32,
    pub(crate) b: u32,
    pub(crate) rest_length: S,
    pub(crate) stiffness: S,
    pub(crate) damping: S,
    pub(crate) limit: Limit,
}

impl<S: Real> Spring<S> {
    /// The spring that a bond is, if it is one.
    pub(crate) fn of(bond: &Bond) -> Option<Self> {
        let BondKind::Spring { stiffness, damping } = bond.kind else { return None };
        Some(Spring {
            a: bond.a.0,
            b: bond.b.0,
            rest_length: S::from_f64(bond.rest_length),
            stiffness: S::from_f64(stiffness),
            damping: S::from_f64(damping),
            limit: bond.limit,
        })
    }

    /// Its energy `[J]`, its ends so far apart.
    pub(crate) fn energy<const D: usize>(&self, d: [S; D]) -> S {
        let off = length(d) - self.rest_length;
        if self.limit.acts(off, S::ZERO) { S::HALF * self.stiffness * off * off } else { S::ZERO }
    }

    /// The spring as it is while it acts, whatever its length, or while it does not: where events decide that.
    pub(crate) fn held(self, acts: bool) -> Self {
        let share = if acts { S::ONE } else { S::ZERO };
        Spring { stiffness: share * self.stiffness, damping: share * self.damping, limit: Limit::Both, ..self }
    }
}

/// Springs of a group, in an order in which neighbours share no point where that can be.
#[derive(Clone, Debug)]
pub(crate) struct Springs<S> {
    /// Those that have a rest length and act always come first.
    list: Vec<Spring<S>>,
    /// How many those are.
    plain: usize,
    is_damped: bool,
}

impl<S: Real> Springs<S> {
    /// The springs among `bonds`, between `points` points.
    pub(crate) fn new<'a>(bonds: impl Iterator<Item = &'a Bond>, points: usize) -> Self {
        let listed: Vec<Spring<S>> = bonds.filter_map(Spring::of).collect();
        let ends: Vec<[u32; 2]> = listed.iter().map(|spring| [spring.a, spring.b]).collect();
        let mut list: Vec<Spring<S>> = by_colour(&ends, points).into_iter().map(|k| listed[k as usize]).collect();
        let is_special = |spring: &Spring<S>| spring.limit != Limit::Both || spring.rest_length == S::ZERO;
        list.sort_by_key(is_special);
        Springs {
            plain: list.partition_point(|spring| !is_special(spring)),
            is_damped: list.iter().any(|spring| spring.damping > S::ZERO),
            list,
        }
    }

    /// No springs.
    pub(crate) fn none() -> Self {
        Springs { list: Vec::new(), plain: 0, is_damped: false }
    }

    /// The springs one by one.
    pub(crate) fn iter(&self) -> std::slice::Iter<'_, Spring<S>> {
        self.list.iter()
    }

    /// Puts another spring between the same points in the place of one that has a limit.
    pub(crate) fn set(&mut self, at: usize, spring: Spring<S>) {
        self.list[at] = spring;
    }

    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Whether any has a damper, so that forces depend on velocities.
    pub(crate) fn is_damped(&self) -> bool {
        self.is_damped
    }

    /// Adds the forces of all springs to `force` `[N]`.
    ///
    /// Model: d = x_a - x_b, f_a = -stiffness (|d| - rest) d/|d| - damping ((v_a - v_b).d) d/|d|^2, f_b = -f_a.
    /// At rest length 0 the force is linear: f_a = -stiffness d - damping (v_a - v_b). Coincident ends of a spring with
    /// a rest length have no direction: no force.
    /// Shapes: `x`, `v` and `force` have one entry a point.
    pub(crate) fn pull<const D: usize>(&self, x: &[[S; D]], v: &[[S; D]], force: &mut [[S; D]]) {
        let (plain, special) = self.list.split_at(self.plain);
        if self.is_damped {
            pull_plain::<S, D, true>(plain, x, v, force);
            pull_each::<S, D, true>(special, x, v, force);
        } else {
            pull_plain::<S, D, false>(plain, x, v, force);
            pull_each::<S, D, false>(special, x, v, force);
        }
    }
}

/// Adds the forces of all springs to `force` `[N]`, of points at rest.
pub(crate) fn pull_at_rest<S: Real, const D: usize>(springs: &[Spring<S>], x: &[[S; D]], force: &mut [[S; D]]) {
    pull_each::<S, D, false>(springs, x, x, force);
}

/// Springs that have a rest length and act always.
fn pull_plain<S: Real, const D: usize, const DAMPED: bool>(
    springs: &[Spring<S>],
    x: &[[S; D]],
    v: &[[S; D]],
    force: &mut [[S; D]],
) {
    for spring in springs {
        let (i, j) = (spring.a as usize, spring.b as usize);
        let d = sub(x[i], x[j]);
        let closing = if DAMPED { dot(sub(v[i], v[j]), d) } else { S::ZERO };
        push(spring, scale(d, spring.share::<DAMPED>(closing, dot(d, d))), force);
    }
}

fn pull_each<S: Real, const D: usize, const DAMPED: bool>(
    springs: &[Spring<S>],
    x: &[[S; D]],
    v: &[[S; D]],
    force: &mut [[S; D]],
) {
    for spring in springs {
        let (i, j) = (spring.a as usize, spring.b as usize);
        let pull = spring.force::<D, DAMPED>(sub(x[i], x[j]), || sub(v[i], v[j]));
        push(spring, pull, force);
    }
}

/// The pull on end a, and its opposite on end b.
#[inline(always)]
fn push<S: Real, const D: usize>(spring: &Spring<S>, pull: [S; D], force: &mut [[S; D]]) {
    let (i, j) = (spring.a as usize, spring.b as usize);
    force[i] = add(force[i], pull);
    force[j] = sub(force[j], pull);
}

impl<S: Real> Spring<S> {
    /// The forces on end a `[N]`: with its damper, and without.
    pub(crate) fn forces<const D: usize>(&self, d: [S; D], closing: [S; D]) -> [[S; D]; 2] {
        [self.force::<D, true>(d, || closing), self.force::<D, false>(d, || closing)]
    }

    /// The force on end a `[N]`.
    #[inline(always)]
    fn force<const D: usize, const DAMPED: bool>(&self, d: [S; D], closing: impl Fn() -> [S; D]) -> [S; D] {
        if self.rest_length == S::ZERO {
            if self.limit == Limit::Min {
                return [S::ZERO; D];
            }
            let pull = scale(d, -self.stiffness);
            return if DAMPED { sub(pull, scale(closing(), self.damping)) } else { pull };
        }
        let square = dot(d, d);
        let length = square.sqrt();
        if self.is_slack(length) {
            return [S::ZERO; D];
        }
        let closing = if DAMPED { dot(closing(), d) } else { S::ZERO };
        scale(d, self.share::<DAMPED>(closing, square))
    }

    /// Force on end a over d, of ends that are the root of `square` apart `[N/m]`.
    #[inline(always)]
    fn share<const DAMPED: bool>(&self, closing: S, square: S) -> S {
        let inverse = S::ONE / square.sqrt();
        let mut share = self.stiffness * (self.rest_length * inverse - S::ONE);
        if DAMPED {
            share -= self.damping * closing * (inverse * inverse);
        }
        if square > S::ZERO { share } else { S::ZERO }
    }

    /// Minus the derivative of the force on end a: K + rate C `[N/m]`, by d and (times `rate` `[1/s]`) by velocity.
    ///
    /// K = stiffness (n n^T + (1 - rest/length) (1 - n n^T)), C = damping n n^T, n = d/|d|, with the length by which it pulls, which is |d| or
    /// near it. `is_cautious`: the second part of K is left out where it is below 0.
    pub(crate) fn stiffness_block<const D: usize>(
        &self,
        (d, length): ([S; D], S),
        rate: S,
        is_cautious: bool,
    ) -> [[S; D]; D] {
        let mut block = [[S::ZERO; D]; D];
        let square = dot(d, d);
        let (along, across) = if self.rest_length == S::ZERO {
            let all = if self.limit == Limit::Min { S::ZERO } else { self.stiffness + rate * self.damping };
            (S::ZERO, all)
        } else if square == S::ZERO || self.is_slack(length) {
            return block;
        } else {
            let tension = self.stiffness * (S::ONE - self.rest_length / length);
            let across = if is_cautious { tension.max(S::ZERO) } else { tension };
            (self.stiffness + rate * self.damping - across, across)
        };
        for r in 0..D {
            for c in 0..D {
                if square > S::ZERO {
                    block[r][c] = along * d[r] * d[c] / square;
                }
            }
            block[r][r] += across;
        }
        block
    }

    /// Whether a spring with a limit lets go at this length.
    #[inline(always)]
    pub(crate) fn is_slack(&self, length: S) -> bool {
        match self.limit {
            Limit::Both => false,
            Limit::Max => length <= self.rest_length,
            Limit::Min => length >= self.rest_length,
        }
    }
}
