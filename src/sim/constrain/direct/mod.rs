//! Rigid bonds solved together: Lagrange's multipliers by a sparse factorisation of G W G^T.
//!
//! G has a row for every bond, d = x_a - x_b at its ends; W holds inverse masses, projected where points rest on
//! surfaces. Bonds are kept in their order of elimination: chains and trees fill nothing in, so that they cost O(n).
//! Bonds that repeat each other have zero pivots, which are skipped.

mod answer;
mod area;
mod bend;
mod limits;
mod project;
mod strings;

use super::shape::{Coupling, Crossing, Leg, Row, Shape};
use crate::sim::bond::Limit;
use crate::sim::contact::Contacts;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::solve::ldl::Ldl;
use crate::sim::vector::{dot, scale, sub, zero};

/// The rigid bonds of a group.
#[derive(Clone, Debug)]
pub(crate) struct Direct<S: Real, const D: usize> {
    rows: Vec<Row<S>>,
    couplings: Vec<Coupling<S>>,
    ldl: Ldl<S>,
    /// Directions of the rows: x_a - x_b where they were aimed `[m]`.
    aims: Vec<[S; D]>,
    diagonal: Vec<S>,
    lower: Vec<S>,
    lambda: Vec<S>,
    /// Multipliers of lengths and of their rates, solved together.
    both: Vec<[S; 2]>,
    /// Sum of the multipliers of the last projection of velocities.
    total: Vec<S>,
    /// Positions before a projection, to go back to.
    start: Vec<[S; D]>,
    /// Second legs of rows that hold areas, their aims, and what they couple.
    legs: Vec<Leg<S>>,
    leg_aims: Vec<[S; D]>,
    crossings: Vec<Crossing<S>>,
    has_limits: bool,
    /// Solves decide which bonds with a limit act; where events are located those do.
    chooses: bool,
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
            both: vec![[S::ZERO; 2]; count],
            total: vec![S::ZERO; count],
            start: Vec::new(),
            leg_aims: vec![zero(); shape.legs.len()],
            legs: shape.legs,
            crossings: shape.crossings,
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
        self.aim_legs(x);
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
        self.eliminate();
    }

    /// Factors the matrix as it is.
    fn eliminate(&mut self) {
        self.ldl.factor(&self.diagonal, &self.lower, least_pivot());
    }

    /// G W G^T along the aims.
    fn fill(&mut self, contacts: &Contacts<S, D>) {
        if contacts.is_idle() {
            for (diagonal, (row, aim)) in self.diagonal.iter_mut().zip(self.rows.iter().zip(&self.aims)) {
                *diagonal = (row.w_a + row.w_b) * dot(*aim, *aim);
            }
            self.fill_lower();
        } else {
            self.fill_with(contacts);
        }
        if !self.legs.is_empty() {
            self.fill_legs(contacts);
        }
        if self.has_limits {
            self.leave_slack_out();
        }
    }

    /// What is left of the diagonal, where no point rests.
    #[inline(always)]
    fn fill_lower(&mut self) {
        for (lower, coupling) in self.lower.iter_mut().zip(&self.couplings) {
            *lower = coupling.weight * dot(self.aims[coupling.row as usize], self.aims[coupling.column as usize]);
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

    /// lambda = -(|d|^2 - rest^2)/2 of every bond; the largest |error| relative to rest^2, in m^2 at rest length 0.
    #[inline(always)]
    fn residual(&mut self, direction: impl Fn(&Row<S>) -> [S; D]) -> S {
        let mut largest = S::ZERO;
        for (lambda, row) in self.lambda.iter_mut().zip(&self.rows) {
            let d = direction(row);
            let rest = row.rest_length * row.rest_length;
            let error = if row.is_taut { S::HALF * (dot(d, d) - rest) } else { S::ZERO };
            *lambda = -error;
            let relative = error.abs() * row.inverse_square;
            // A comparison that is false for NaN would hide it.
            largest = if relative <= largest { largest } else { relative };
        }
        if self.legs.is_empty() { largest } else { self.area_residual(direction, largest) }
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
        for (point, way) in self.leg_shifts(&self.lambda) {
            add_to(point as usize, if idle { way } else { contacts.free(point as usize, way) });
        }
    }
}
