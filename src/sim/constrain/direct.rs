//! Rigid bonds solved together: Lagrange's multipliers by a sparse factorisation of G W G^T.
//!
//! G has a row for every bond, d = x_a - x_b at its ends; W holds inverse masses, projected where points rest on
//! surfaces. Bonds are kept in their order of elimination: chains and trees fill nothing in, so that they cost O(n).
//! Bonds that repeat each other have zero pivots, which are skipped.

use super::shape::{Coupling, Row, Shape};
use crate::sim::bond::Limit;
use crate::sim::contact::Contacts;
use crate::sim::integrate::verlet::accumulate;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::solve::ldl::Ldl;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// The rigid bonds of a group.
#[derive(Clone, Debug)]
pub(crate) struct Direct<S: Real, const D: usize> {
    pub(super) rows: Vec<Row<S>>,
    couplings: Vec<Coupling<S>>,
    ldl: Ldl<S>,
    /// Directions of the rows: x_a - x_b where they were aimed [m].
    pub(super) aims: Vec<[S; D]>,
    diagonal: Vec<S>,
    lower: Vec<S>,
    pub(super) lambda: Vec<S>,
    /// Sum of the multipliers of the last projection of velocities.
    pub(super) total: Vec<S>,
    /// Positions before a projection, to go back to.
    start: Vec<[S; D]>,
    has_limits: bool,
    /// Solves decide which bonds with a limit act; where events are located those do.
    pub(super) chooses: bool,
}

/// What became of holding bonds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Held {
    /// Solves taken.
    pub(crate) iterations: u32,
    /// Whether all lengths are right to the tolerance.
    pub(crate) is_held: bool,
}

/// |length^2/rest^2 - 1| / 2 at which a bond counts as held: what rounding leaves of it.
fn tolerance<S: Real>() -> S {
    S::EPSILON * S::from_f64(64.0)
}

/// A bond that is off by less than this counts as held when solving further does not help: 1e-9 in `f64`, 1e-5 in `f32`.
fn enough<S: Real>() -> S {
    S::from_f64(1e-9).max(S::EPSILON * S::from_f64(100.0))
}

/// Pivots below this share of their diagonal are skipped: what rounding leaves of a bond that repeats others.
fn least_pivot<S: Real>() -> S {
    S::EPSILON * S::from_f64(512.0)
}

/// Times that bonds with a limit are let go or taken in within a substep.
const MOST_CHANGES: u32 = 16;

/// Solves after which a substep goes on with what it has.
const MOST_SOLVES: u32 = 24;

impl<S: Real, const D: usize> Direct<S, D> {
    /// The solver of a set of bonds, of which none has two pinned ends.
    pub(crate) fn new(shape: Shape<S>) -> Self {
        let count = shape.rows.len();
        let has_limits = shape.rows.iter().any(|row| row.limit != Limit::Both);
        Direct {
            ldl: Ldl::analyse(&shape.lower),
            has_limits,
            chooses: has_limits,
            aims: vec![zero(); count],
            diagonal: vec![S::ZERO; count],
            lower: vec![S::ZERO; shape.couplings.len()],
            lambda: vec![S::ZERO; count],
            total: vec![S::ZERO; count],
            start: Vec::new(),
            rows: shape.rows,
            couplings: shape.couplings,
        }
    }

    /// How many bonds there are.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Multiplications of one factorisation and solve, about.
    pub(crate) fn work(&self) -> usize {
        self.rows.len() * (4 + 2 * D) + 4 * self.ldl.fill()
    }

    /// Points the rows along the bonds as they lie now.
    pub(crate) fn aim(&mut self, x: &[[S; D]]) {
        for (aim, row) in self.aims.iter_mut().zip(&self.rows) {
            *aim = sub(x[row.a as usize], x[row.b as usize]);
        }
    }

    /// Decides which bonds act, aims at them where they are and factors: what all solves at this state need.
    pub(crate) fn make_ready(&mut self, points: &Points<S, D>, contacts: &Contacts<S, D>) {
        self.tighten(&points.position, &points.velocity);
        self.aim(&points.position);
        self.factor(contacts);
    }

    /// Factors G W G^T along the aims.
    pub(crate) fn factor(&mut self, contacts: &Contacts<S, D>) {
        self.fill(contacts);
        self.ldl.factor(&self.diagonal, &self.lower, least_pivot());
    }

    /// G W G^T along the aims.
    fn fill(&mut self, contacts: &Contacts<S, D>) {
        if contacts.is_idle() {
            for (diagonal, (row, aim)) in self.diagonal.iter_mut().zip(self.rows.iter().zip(&self.aims)) {
                *diagonal = (row.w_a + row.w_b) * dot(*aim, *aim);
            }
            for (lower, coupling) in self.lower.iter_mut().zip(&self.couplings) {
                *lower = coupling.weight * dot(self.aims[coupling.row as usize], self.aims[coupling.column as usize]);
            }
        } else {
            self.fill_with(contacts);
        }
        if self.has_limits {
            self.leave_slack_out();
        }
    }

    /// The matrix where points rest on surfaces.
    fn fill_with(&mut self, contacts: &Contacts<S, D>) {
        let free = |point: u32, aim: [S; D]| dot(aim, contacts.free(point as usize, aim));
        for (diagonal, (row, &aim)) in self.diagonal.iter_mut().zip(self.rows.iter().zip(&self.aims)) {
            *diagonal = row.w_a * free(row.a, aim) + row.w_b * free(row.b, aim);
        }
        for (lower, coupling) in self.lower.iter_mut().zip(&self.couplings) {
            let (d, e) = (self.aims[coupling.row as usize], self.aims[coupling.column as usize]);
            *lower = S::ZERO;
            for &(point, weight) in &coupling.shared {
                *lower += weight * dot(d, contacts.free(point as usize, e));
            }
        }
    }

    /// Bonds with a limit that do not act take no part.
    fn leave_slack_out(&mut self) {
        for (diagonal, row) in self.diagonal.iter_mut().zip(&self.rows) {
            if !row.is_taut {
                *diagonal = S::ONE;
            }
        }
        for (lower, coupling) in self.lower.iter_mut().zip(&self.couplings) {
            if !self.rows[coupling.row as usize].is_taut || !self.rows[coupling.column as usize].is_taut {
                *lower = S::ZERO;
            }
        }
    }

    /// Adds to accelerations what the bonds answer: d . (a_a - a_b) + |v_a - v_b|^2 = 0 for what points can follow.
    pub(crate) fn multiply(&mut self, v: &[[S; D]], a: &mut [[S; D]], contacts: &Contacts<S, D>) {
        let idle = contacts.is_idle();
        for (lambda, (row, aim)) in self.lambda.iter_mut().zip(self.rows.iter().zip(&self.aims)) {
            let (i, j) = (row.a as usize, row.b as usize);
            let closing = sub(v[i], v[j]);
            let apart = if idle { sub(a[i], a[j]) } else { sub(contacts.free(i, a[i]), contacts.free(j, a[j])) };
            *lambda = if row.is_taut { -(dot(*aim, apart) + dot(closing, closing)) } else { S::ZERO };
        }
        self.ldl.solve(&mut self.lambda);
        for ((&lambda, row), &aim) in self.lambda.iter().zip(&self.rows).zip(&self.aims) {
            let (i, j) = (row.a as usize, row.b as usize);
            a[i] = add(a[i], scale(aim, lambda * row.w_a));
            a[j] = sub(a[j], scale(aim, lambda * row.w_b));
        }
    }

    /// Bound on the fastest oscillation that the tension of the bonds makes [rad/s], by the last multipliers.
    ///
    /// A bond under the force lambda d is across as stiff as |lambda|: omega^2 <= max of 2 |lambda| (w_a + w_b), as of a
    /// taut string. Explicit methods are unstable beyond their limit of omega h, though every bond keeps its length.
    pub(crate) fn frequency(&self) -> S {
        let square = |(lambda, row): (&S, &Row<S>)| lambda.abs() * (row.w_a + row.w_b);
        let most = self.lambda.iter().zip(&self.rows).map(square).fold(S::ZERO, S::max);
        (most + most).sqrt()
    }

    /// Puts bonds back to their lengths, along their directions where the step ended.
    ///
    /// Newton's method with the matrix of its first round, made anew when that converges slowly; with a shifted matrix
    /// (least squares) where bonds contradict each other.
    pub(crate) fn project(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) -> Held {
        let mut before = S::INFINITY;
        self.start.clone_from(&points.position);
        self.make_ready(points, contacts);
        for iterations in 0..MOST_SOLVES {
            let error = self.residual(|row| sub(points.position[row.a as usize], points.position[row.b as usize]));
            if error <= tolerance() {
                return Held { iterations, is_held: true };
            }
            if !error.is_finite() || (iterations > 4 && error > before) {
                break;
            }
            if iterations > 2 && error <= enough() && error > S::HALF * before {
                return Held { iterations, is_held: true };
            }
            if iterations > 0 && error > S::from_f64(0.1) * before {
                self.aim(&points.position);
                self.factor(contacts);
            }
            before = error;
            self.ldl.solve(&mut self.lambda);
            self.shift(contacts, |i, way| accumulate(&mut points.position[i], &mut points.position_lost[i], way));
        }
        let error = self.residual(|row| sub(points.position[row.a as usize], points.position[row.b as usize]));
        if error <= enough() {
            return Held { iterations: MOST_SOLVES, is_held: true };
        }
        points.position.copy_from_slice(&self.start);
        self.draw_near(points, contacts);
        Held { iterations: 2 * MOST_SOLVES, is_held: false }
    }

    /// Brings bonds that cannot all hold as near to their lengths as they get: a matrix with a larger diagonal makes
    /// every round a short step towards least squares, and never one into the distance.
    fn draw_near(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) {
        for _ in 0..MOST_SOLVES {
            self.aim(&points.position);
            self.fill(contacts);
            for diagonal in &mut self.diagonal {
                *diagonal *= S::from_f64(1.5);
            }
            self.ldl.factor(&self.diagonal, &self.lower, least_pivot());
            self.residual(|row| sub(points.position[row.a as usize], points.position[row.b as usize]));
            self.ldl.solve(&mut self.lambda);
            self.shift(contacts, |i, way| accumulate(&mut points.position[i], &mut points.position_lost[i], way));
        }
    }

    /// Bends the displacements of a substep along the directions at its start until bonds keep their lengths (SHAKE).
    ///
    /// Rows are aimed and factored at the start of the substep. Source: J.-P. Ryckaert, G. Ciccotti,
    /// H. J. C. Berendsen, J. Comput. Phys. 23, 327 (1977); all bonds at once in place of one after the other.
    ///
    /// Bonds with a limit that would have to push are let go, those that became too long are taken in, and all begins
    /// again.
    pub(crate) fn bend(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) -> Held {
        if !self.chooses {
            return self.bend_taut(points, contacts);
        }
        let free = points.displacement.clone();
        let mut held = self.bend_taut(points, contacts);
        for _ in 0..MOST_CHANGES {
            self.lambda.copy_from_slice(&self.total);
            if !self.slacken() && !self.take_in(points) {
                break;
            }
            points.displacement.copy_from_slice(&free);
            self.factor(contacts);
            let again = self.bend_taut(points, contacts);
            held = Held { iterations: held.iterations + again.iterations, ..again };
        }
        held
    }

    /// Slack bonds that the displacements make too long (or too short) act from now on. Returns whether there are any.
    fn take_in(&mut self, points: &Points<S, D>) -> bool {
        let mut any = false;
        for row in self.rows.iter_mut().filter(|row| !row.is_taut) {
            let (i, j) = (row.a as usize, row.b as usize);
            let (x, way) = (&points.position, &points.displacement);
            let d = add(sub(x[i], x[j]), sub(way[i], way[j]));
            let over = (dot(d, d) - row.rest_length * row.rest_length) * row.inverse_square;
            row.is_taut = match row.limit {
                Limit::Both => true,
                Limit::Max => over > tolerance::<S>() * S::from_f64(16.0),
                Limit::Min => over < -tolerance::<S>() * S::from_f64(16.0),
            };
            any |= row.is_taut;
        }
        any
    }

    fn bend_taut(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) -> Held {
        self.total.fill(S::ZERO);
        let Points { position, displacement, .. } = points;
        let mut before = S::INFINITY;
        for iterations in 0..MOST_SOLVES {
            let error = self.residual(|row| {
                let (i, j) = (row.a as usize, row.b as usize);
                add(sub(position[i], position[j]), sub(displacement[i], displacement[j]))
            });
            if error <= tolerance() || (error <= enough() && error > S::HALF * before) {
                return Held { iterations, is_held: true };
            }
            if !error.is_finite() || (iterations > 3 && error > before) {
                return Held { iterations, is_held: false };
            }
            before = error;
            self.ldl.solve(&mut self.lambda);
            for (total, lambda) in self.total.iter_mut().zip(&self.lambda) {
                *total += *lambda;
            }
            self.shift(contacts, |i, way| displacement[i] = add(displacement[i], way));
        }
        Held { iterations: MOST_SOLVES, is_held: false }
    }

    /// lambda = -(|d|^2 - rest^2)/2 of every bond; the largest |error| relative to rest^2, in m^2 at rest length 0.
    #[inline(always)]
    fn residual(&mut self, d: impl Fn(&Row<S>) -> [S; D]) -> S {
        let mut largest = S::ZERO;
        for (lambda, row) in self.lambda.iter_mut().zip(&self.rows) {
            let d = d(row);
            let rest = row.rest_length * row.rest_length;
            let error = if row.is_taut { S::HALF * (dot(d, d) - rest) } else { S::ZERO };
            *lambda = -error;
            let relative = error.abs() * row.inverse_square;
            // A comparison that is false for NaN would hide it.
            largest = if relative <= largest { largest } else { relative };
        }
        largest
    }

    /// Adds W G^T lambda to something, point by point.
    #[inline(always)]
    fn shift(&self, contacts: &Contacts<S, D>, mut add_to: impl FnMut(usize, [S; D])) {
        let idle = contacts.is_idle();
        for ((&lambda, row), &aim) in self.lambda.iter().zip(&self.rows).zip(&self.aims) {
            for (point, weight) in [(row.a, row.w_a), (row.b, -row.w_b)] {
                if weight != S::ZERO {
                    let way = scale(aim, lambda * weight);
                    add_to(point as usize, if idle { way } else { contacts.free(point as usize, way) });
                }
            }
        }
    }

    /// Takes from velocities what would lengthen or shorten a bond: d . (v_a - v_b) = 0, weighted by mass.
    ///
    /// Rows are aimed and factored before. A bond with a limit holds velocities one way only, unless events decide
    /// whether it acts.
    pub(crate) fn project_velocity(&mut self, points: &mut Points<S, D>, contacts: &Contacts<S, D>) {
        self.total.fill(S::ZERO);
        for _ in 0..2 {
            let velocity = &points.velocity;
            for (lambda, (row, aim)) in self.lambda.iter_mut().zip(self.rows.iter().zip(&self.aims)) {
                let rate = dot(*aim, sub(velocity[row.a as usize], velocity[row.b as usize]));
                let parts = match row.limit {
                    _ if !self.chooses => true,
                    Limit::Both => true,
                    Limit::Max => rate > S::ZERO,
                    Limit::Min => rate < S::ZERO,
                };
                *lambda = if row.is_taut && parts { -rate } else { S::ZERO };
            }
            self.ldl.solve(&mut self.lambda);
            for (total, lambda) in self.total.iter_mut().zip(&self.lambda) {
                *total += *lambda;
            }
            self.shift(contacts, |i, way| accumulate(&mut points.velocity[i], &mut points.velocity_lost[i], way));
        }
    }

    /// As [`Direct::project_velocity`], for velocities that are only a look ahead.
    pub(crate) fn project_ahead(&mut self, v: &mut [[S; D]], contacts: &Contacts<S, D>) {
        for (lambda, (row, aim)) in self.lambda.iter_mut().zip(self.rows.iter().zip(&self.aims)) {
            let rate = dot(*aim, sub(v[row.a as usize], v[row.b as usize]));
            *lambda = if row.is_taut { -rate } else { S::ZERO };
        }
        self.ldl.solve(&mut self.lambda);
        self.shift(contacts, |i, way| v[i] = add(v[i], way));
    }

    /// The change of a point's velocity by the last projection of velocities, surfaces left aside [m/s].
    pub(crate) fn push_on(&self, point: usize) -> [S; D] {
        let mut sum = zero();
        for ((&lambda, row), &aim) in self.total.iter().zip(&self.rows).zip(&self.aims) {
            if row.a as usize == point {
                sum = add(sum, scale(aim, lambda * row.w_a));
            } else if row.b as usize == point {
                sum = sub(sum, scale(aim, lambda * row.w_b));
            }
        }
        sum
    }

    /// Lets go of bonds with a limit whose last multiplier would push where they pull, or pull where they push.
    ///
    /// Returns whether there were any: then everything has to be solved again.
    pub(crate) fn slacken(&mut self) -> bool {
        if !self.chooses {
            return false;
        }
        let mut any = false;
        for (row, &lambda) in self.rows.iter_mut().zip(&self.lambda) {
            // The force on end a is lambda d: below 0 the bond pulls.
            let wrong = match row.limit {
                Limit::Both => false,
                Limit::Max => lambda > S::ZERO,
                Limit::Min => lambda < S::ZERO,
            };
            any |= wrong && row.is_taut;
            row.is_taut &= !wrong;
        }
        any
    }

    /// Decides which bonds with a limit act: those that are at their rest length or beyond it, and do not come back from
    /// there by themselves.
    pub(crate) fn tighten(&mut self, x: &[[S; D]], v: &[[S; D]]) {
        if !self.chooses {
            return;
        }
        let slow = S::from_f64(1e-9).max(S::EPSILON * S::from_f64(64.0));
        for row in &mut self.rows {
            let (a, b) = (row.a as usize, row.b as usize);
            let d = sub(x[a], x[b]);
            let rate = dot(d, sub(v[a], v[b])) * row.inverse_square;
            let rest = row.rest_length * row.rest_length;
            let over = (dot(d, d) - rest) * row.inverse_square;
            row.is_taut = match row.limit {
                Limit::Both => true,
                Limit::Max => over > tolerance() || (over > -tolerance::<S>() * S::from_f64(16.0) && rate > -slow),
                Limit::Min => over < -tolerance::<S>() || (over < tolerance::<S>() * S::from_f64(16.0) && rate < slow),
            };
        }
    }
}
