//! Equilibrium by Newton's method on the energy, with rigid bonds as constraints.
//!
//! Every round solves
//!
//! ```text
//! [ H + shift  G^T ] [ step   ]   [ -gradient ]
//! [ G          0   ] [ lambda ] = [ -C        ]
//! ```
//!
//! H is the Hessian of springs and of the constraints with their multipliers. Where its part along the constraints is not
//! positive the pivots show it, and the shift is raised: a step leads to a minimum, not to a saddle. Steps that do not
//! lower the merit (energy plus a penalty on C) are shortened. Points on surfaces are held to them while they press.
//! Source: J. Nocedal and S. J. Wright, Numerical Optimization, 2nd ed. 2006, 16.1, 18.4 and 15.4.

use super::bond::{Bond, BondKind, Limit};
use super::contact::surface::{Surface, surfaces};
use super::force::spring::{self, Spring};
use super::measure;
use super::model::{Model, ModelError};
use super::plan::{inverse_masses, nudge, reconcile, weld};
use super::solve::blocks::Blocks;
use super::vector::{add, dot, length, scale, sub};

/// Rounds after which an equilibrium is given up.
const MOST_ROUNDS: u32 = 500;
/// Force per weight at which a point counts as at rest, relative to the largest force on any.
const BALANCED: f64 = 1e-13;
/// Times that a shape is pushed off a saddle, and how far, as a share of its extent.
const MOST_PUSHES: u32 = 3;
const PUSH: f64 = 1e-3;
/// Times that the shift is raised in one round: the last is beyond any stiffness.
const MOST_SHIFTS: u32 = 12;
/// Longest step, as a share of the diagonal of the box around all points: further out the model of the energy is none.
const REACH: f64 = 0.25;

/// A shape in which all forces balance.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium<const D: usize> {
    /// Positions [m].
    pub position: Vec<[f64; D]>,
    /// Springs' and gravity's energy of the points that are not pinned [J].
    pub energy: f64,
    /// Largest |length/rest - 1| over the bonds [1] (rest 0 left out).
    pub max_strain: f64,
    /// Largest force that is left on a point, as a share of the largest single force on one [1].
    pub residual: f64,
    /// Rounds of Newton's method.
    pub rounds: u32,
    /// Whether forces balance to rounding.
    pub is_settled: bool,
}

/// Finds the equilibrium that the start rolls down to, with damping that is strong.
///
/// Model: the least energy of springs and gravity under rigid bonds, pins and surfaces; mouse force and drag are left
/// out. Points that nothing holds fall for ever: they are left where they are, and the result is not settled.
/// Errors: as [`Model::check`]; relaxed bonds are refused, for they have no energy.
pub fn settle<const D: usize>(model: &Model<D>) -> Result<Equilibrium<D>, ModelError> {
    model.check()?;
    if let Some(bond) = model.bonds.iter().position(|bond| matches!(bond.kind, BondKind::Relaxed { .. })) {
        return Err(ModelError::NoEnergy { bond });
    }
    let mut descent = Descent::new(model);
    let mut rounds = 0;
    while rounds < MOST_ROUNDS && !descent.is_done {
        descent.round();
        rounds += 1;
    }
    let position: Vec<[f64; D]> = descent.stand_ins.iter().map(|&i| descent.x[i as usize]).collect();
    let at_rest = vec![[0.0; D]; position.len()];
    Ok(Equilibrium {
        energy: measure::energy(&position, &at_rest, &inverse_masses(model), &model.bonds, model.gravity),
        max_strain: measure::max_strain(&position, &model.bonds),
        position,
        residual: descent.residual,
        rounds,
        is_settled: descent.is_done && descent.residual <= BALANCED.sqrt() && !descent.has_loose,
    })
}

/// A rigid bond, or a surface that a point is pressed onto.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Hold {
    Bond { a: usize, b: usize, rest: f64 },
    Surface { point: usize, surface: usize },
}

struct Descent<const D: usize> {
    /// For every point of the model the one that it is welded to.
    stand_ins: Vec<u32>,
    x: Vec<[f64; D]>,
    /// Masses of free points, 0 for pinned ones.
    mass: Vec<f64>,
    is_free: Vec<bool>,
    gravity: [f64; D],
    bonds: Vec<Bond>,
    springs: Vec<Spring<f64>>,
    pairs: Vec<[u32; 2]>,
    rigid: Vec<Hold>,
    /// Rigid bonds that act one way: those that do are among the pressed.
    limited: Vec<(Hold, Limit)>,
    surfaces: Vec<Surface<f64, D>>,
    pressed: Vec<Hold>,
    system: Blocks<f64, D>,
    lambda: Vec<f64>,
    work: Vec<f64>,
    shift: f64,
    penalty: f64,
    residual: f64,
    is_done: bool,
    /// Some point falls for ever.
    has_loose: bool,
    /// Times that it was pushed off a saddle.
    pushes: u32,
}

impl<const D: usize> Descent<D> {
    fn new(model: &Model<D>) -> Self {
        let w = inverse_masses(model);
        let stand_ins = weld::merge(&model.bonds, &w);
        let mut mass = vec![0.0; w.len()];
        let mut is_pinned = vec![false; w.len()];
        for (i, &stand_in) in stand_ins.iter().enumerate() {
            mass[stand_in as usize] += model.mass[i];
            is_pinned[stand_in as usize] |= w[i] == 0.0;
        }
        let mut x = model.position.clone();
        for (i, &stand_in) in stand_ins.iter().enumerate() {
            if w[i] == 0.0 {
                x[stand_in as usize] = model.position[i];
            }
        }
        let stands = |bond: &Bond| Bond {
            a: super::PointId(stand_ins[bond.a.index()]),
            b: super::PointId(stand_ins[bond.b.index()]),
            ..*bond
        };
        let mut bonds: Vec<Bond> = model.bonds.iter().map(stands).filter(|bond| bond.a != bond.b).collect();
        // Points that no bond holds have no equilibrium unless a surface stops them: they stay out of the system.
        let mut is_free = vec![false; w.len()];
        for end in bonds.iter().flat_map(|bond| [bond.a, bond.b]) {
            is_free[end.index()] = !is_pinned[end.index()];
        }
        let is_loose = |i: usize| stand_ins[i] as usize == i && !is_pinned[i] && !is_free[i];
        let has_loose = model.gravity.iter().any(|&g| g != 0.0) && (0..w.len()).any(is_loose);
        let held: Vec<f64> = is_free.iter().map(|&free| f64::from(u8::from(free))).collect();
        reconcile(&mut bonds, &mut x.clone(), &held);
        let of = |bond: &Bond| match bond.kind {
            BondKind::Rigid if is_free[bond.a.index()] || is_free[bond.b.index()] => {
                let hold = Hold::Bond { a: bond.a.index(), b: bond.b.index(), rest: bond.rest_length };
                Some((hold, bond.limit))
            }
            _ => None,
        };
        let holds: Vec<(Hold, Limit)> = bonds.iter().filter_map(of).collect();
        let rigid = holds.iter().filter(|hold| hold.1 == Limit::Both).map(|hold| hold.0).collect();
        let limited: Vec<(Hold, Limit)> = holds.into_iter().filter(|hold| hold.1 != Limit::Both).collect();
        let springs: Vec<Spring<f64>> = bonds.iter().filter_map(Spring::of).collect();
        let pairs: Vec<[u32; 2]> = springs.iter().map(|spring| [spring.a, spring.b]).collect();
        let mut descent = Descent {
            surfaces: surfaces(model),
            system: Blocks::new(&is_free, &[], &[]),
            gravity: model.gravity,
            pressed: Vec::new(),
            lambda: Vec::new(),
            work: Vec::new(),
            shift: 0.0,
            penalty: 0.0,
            residual: f64::INFINITY,
            is_done: false,
            has_loose,
            pushes: 0,
            stand_ins,
            x,
            mass,
            is_free,
            bonds,
            springs,
            pairs,
            rigid,
            limited,
        };
        descent.arrange();
        // Without tensions yet nothing tells a chain which way is down: the first steps go along the gradient.
        descent.shift = if descent.rigid.is_empty() { 0.0 } else { descent.stiffest() };
        descent
    }

    /// The pattern of the system, for the holds that there are now.
    fn arrange(&mut self) {
        let mut pairs = self.pairs.clone();
        let mut ends = Vec::new();
        for hold in self.holds() {
            match hold {
                Hold::Bond { a, b, .. } => {
                    pairs.push([a as u32, b as u32]);
                    ends.push([a as u32, b as u32]);
                }
                // The other end of a surface's row is a point that is not in the system: any pinned or left-out one.
                Hold::Surface { point, .. } => ends.push([point as u32, self.nowhere()]),
            }
        }
        self.system = Blocks::new(&self.free(), &pairs, &ends);
        self.lambda.resize(ends.len(), 0.0);
    }

    /// Whether points are in the system, with one more that is not.
    fn free(&self) -> Vec<bool> {
        self.is_free.iter().copied().chain([false]).collect()
    }

    fn nowhere(&self) -> u32 {
        self.is_free.len() as u32
    }

    fn holds(&self) -> Vec<Hold> {
        self.rigid.iter().chain(&self.pressed).copied().collect()
    }

    /// How far a hold is off [m^2 for bonds, m for surfaces], and its gradient at its first end.
    fn off(&self, hold: Hold, x: &[[f64; D]]) -> (f64, [f64; D]) {
        match hold {
            Hold::Bond { a, b, rest } => {
                let d = sub(x[a], x[b]);
                (0.5 * (dot(d, d) - rest * rest), d)
            }
            Hold::Surface { point, surface } => {
                let surface = &self.surfaces[surface];
                (surface.gap(x[point]), surface.normal)
            }
        }
    }

    /// Energy of springs and gravity [J].
    fn energy(&self, x: &[[f64; D]]) -> f64 {
        let lift =
            |(i, x): (usize, &[f64; D])| if self.is_free[i] { -self.mass[i] * dot(self.gravity, *x) } else { 0.0 };
        spring::energy(&self.bonds, |i| x[i]) + x.iter().enumerate().map(lift).sum::<f64>()
    }

    fn merit(&self, x: &[[f64; D]]) -> f64 {
        let off: f64 = self.holds().into_iter().map(|hold| self.off(hold, x).0.abs()).sum();
        let inside: f64 = self.depths(x);
        self.energy(x) + self.penalty * (off + inside)
    }

    /// Sum of how deep free points are in surfaces [m].
    fn depths(&self, x: &[[f64; D]]) -> f64 {
        let deep = |x: &[f64; D]| self.surfaces.iter().map(|surface| (-surface.gap(*x)).max(0.0)).sum::<f64>();
        let surfaces: f64 = x.iter().zip(&self.is_free).filter(|(_, free)| **free).map(|(x, _)| deep(x)).sum();
        let over = |&(hold, limit): &(Hold, Limit)| match limit {
            Limit::Max => self.off(hold, x).0.max(0.0),
            _ => (-self.off(hold, x).0).max(0.0),
        };
        surfaces + self.limited.iter().map(over).sum::<f64>()
    }

    /// One step of Newton's method, shortened where it has to be.
    fn round(&mut self) {
        let holds = self.holds();
        let (mut force, largest) = self.forces();
        let stiffest = self.stiffest();
        let mut system = std::mem::replace(&mut self.system, Blocks::new(&[], &[], &[]));
        let mut error: Vec<f64> = holds.iter().map(|&hold| -self.off(hold, &self.x).0).collect();
        let wanted = force.clone();
        for _ in 0..MOST_SHIFTS {
            self.fill(&mut system, &holds, stiffest);
            let inertia = system.factor();
            // One negative pivot for every constraint, none for points: H is positive along the constraints.
            if inertia.negative as usize + inertia.skipped as usize <= holds.len() {
                break;
            }
            self.shift = (10.0 * self.shift).max(1e-4 * stiffest);
        }
        force.push([0.0; D]);
        system.solve(&mut force, &mut error, &mut self.work);
        self.residual = self.balance(&wanted, &holds, &error) / largest.max(f64::MIN_POSITIVE);
        self.take(&system, force, &error, stiffest);
        self.system = system;
        self.revise(&error);
    }

    /// The scale of stiffness [N/m]: of springs, of tensions, and of all weight on the shortest rigid bond.
    fn stiffest(&self) -> f64 {
        let springs = self.springs.iter().map(|spring| spring.stiffness).fold(0.0, f64::max);
        let tensions = self.lambda.iter().map(|lambda| lambda.abs()).fold(0.0, f64::max);
        let rests = self.rigid.iter().map(|hold| match hold {
            Hold::Bond { rest, .. } => *rest,
            Hold::Surface { .. } => f64::INFINITY,
        });
        springs.max(tensions).max(self.weight() / rests.fold(self.extent(), f64::min)).max(f64::MIN_POSITIVE)
    }

    /// Weight of all points in the system [N].
    fn weight(&self) -> f64 {
        let mass: f64 = self.mass.iter().zip(&self.is_free).filter(|(_, free)| **free).map(|(m, _)| m).sum();
        mass * length(self.gravity)
    }

    /// Diagonal of the box around all points [m].
    fn extent(&self) -> f64 {
        let size = measure::extent(&self.x).map_or(0.0, |[low, high]| length(sub(high, low)));
        if size > 0.0 && size.is_finite() { size } else { 1.0 }
    }

    /// Forces on free points, and the largest single force on one.
    fn forces(&self) -> (Vec<[f64; D]>, f64) {
        let mut force = vec![[0.0; D]; self.x.len()];
        let ones = vec![1.0; self.x.len()];
        spring::pull_at_rest(&self.springs, &self.x, &ones, &mut force);
        let mut largest = 0.0_f64;
        for spring in &self.springs {
            let d = length(sub(self.x[spring.a as usize], self.x[spring.b as usize]));
            largest = largest.max(spring.stiffness * (d - spring.rest_length).abs());
        }
        for i in 0..self.x.len() {
            let weight = scale(self.gravity, self.mass[i]);
            force[i] = if self.is_free[i] { add(force[i], weight) } else { [0.0; D] };
            largest = if self.is_free[i] { largest.max(length(weight)) } else { largest };
        }
        (force, largest)
    }

    /// The matrix, with the shift.
    fn fill(&self, system: &mut Blocks<f64, D>, holds: &[Hold], stiffest: f64) {
        system.clear();
        system.shift(self.shift + 1e-12 * stiffest);
        let mut couple = |pair: usize, [a, b]: [usize; 2], block: [[f64; D]; D]| {
            system.add_own(a, &block);
            system.add_own(b, &block);
            system.add_pair(pair, &block.map(|row| scale(row, -1.0)));
        };
        for (pair, spring) in self.springs.iter().enumerate() {
            let (a, b) = (spring.a as usize, spring.b as usize);
            couple(pair, [a, b], spring.stiffness_block(sub(self.x[a], self.x[b]), 0.0, false));
        }
        let mut pair = self.springs.len();
        for (c, &hold) in holds.iter().enumerate() {
            if let Hold::Bond { a, b, .. } = hold {
                let mut block = [[0.0; D]; D];
                for (k, row) in block.iter_mut().enumerate() {
                    row[k] = self.lambda[c];
                }
                couple(pair, [a, b], block);
                pair += 1;
            }
        }
        for (c, &hold) in holds.iter().enumerate() {
            let (_, direction) = self.off(hold, &self.x);
            system.set_line(c, direction, -1e-14 * dot(direction, direction) / stiffest.max(f64::MIN_POSITIVE));
        }
    }

    /// The largest force that holds do not balance [N].
    fn balance(&self, force: &[[f64; D]], holds: &[Hold], lambda: &[f64]) -> f64 {
        let mut left = force.to_vec();
        for (&hold, &lambda) in holds.iter().zip(lambda) {
            let (_, direction) = self.off(hold, &self.x);
            let pull = scale(direction, lambda);
            match hold {
                Hold::Bond { a, b, .. } => {
                    left[a] = sub(left[a], pull);
                    left[b] = add(left[b], pull);
                }
                Hold::Surface { point, .. } => left[point] = sub(left[point], pull),
            }
        }
        left.iter().zip(&self.is_free).filter(|(_, free)| **free).map(|(f, _)| length(*f)).fold(0.0, f64::max)
    }

    /// Goes along a step as far as that lowers the merit.
    ///
    /// A step that leaves curved constraints is bent back to them before it is shortened.
    fn take(&mut self, system: &Blocks<f64, D>, mut step: Vec<[f64; D]>, lambda: &[f64], stiffest: f64) {
        let most = lambda.iter().fold(self.weight(), |most, lambda| most.max(lambda.abs()));
        // It follows the multipliers down again: those of the first rounds may be far too large.
        self.penalty = (0.5 * self.penalty).max(2.0 * most);
        let (extent, holds) = (self.extent(), self.holds());
        let size = step.iter().map(|s| length(*s)).fold(0.0, f64::max);
        if size > REACH * extent {
            step.iter_mut().for_each(|s| *s = scale(*s, REACH * extent / size));
        }
        let off = holds.iter().map(|&hold| self.off(hold, &self.x).0.abs()).fold(0.0, f64::max);
        let before = self.merit(&self.x);
        let slack = 1e-13 * (before.abs() + self.energy_scale());
        let mut share = 1.0;
        while share > 1e-8 {
            let mut x: Vec<[f64; D]> = self.x.iter().zip(&step).map(|(&x, &s)| add(x, scale(s, share))).collect();
            if self.merit(&x) > before + slack {
                let mut force = vec![[0.0; D]; x.len() + 1];
                let mut error: Vec<f64> = holds.iter().map(|&hold| -self.off(hold, &x).0).collect();
                system.solve(&mut force, &mut error, &mut self.work);
                x.iter_mut().zip(&force).for_each(|(x, &back)| *x = add(*x, back));
            }
            if self.merit(&x) <= before + slack {
                self.x = x;
                break;
            }
            share *= 0.5;
        }
        for (old, new) in self.lambda.iter_mut().zip(lambda) {
            *old += share * (new - *old);
        }
        let is_still = size <= 1e-14 * extent || (self.residual <= BALANCED && off <= 1e-15 * extent * extent);
        // Balanced, but on a saddle: a push is all it needs.
        if is_still && self.shift > 1e-6 * stiffest && self.pushes < MOST_PUSHES {
            nudge(&mut self.x, &self.is_free, PUSH);
            self.pushes += 1;
            return;
        }
        self.is_done = (is_still && self.shift == 0.0) || (share <= 1e-8 && self.shift >= 1e3 * stiffest);
        self.shift = match share {
            1.0 if self.shift > 1e-6 * stiffest => 0.1 * self.shift,
            1.0 => 0.0,
            _ => (4.0 * self.shift).max(1e-4 * stiffest),
        };
    }

    /// The scale of the energy [J], for what rounding makes of its differences.
    fn energy_scale(&self) -> f64 {
        self.weight() * self.extent()
    }

    /// Points that went into a surface are held to it; those that it would have to pull are let go.
    fn revise(&mut self, lambda: &[f64]) {
        if self.surfaces.is_empty() && self.limited.is_empty() {
            return;
        }
        let before = self.pressed.len();
        let first = self.rigid.len();
        let mut kept = Vec::new();
        for (k, &hold) in self.pressed.iter().enumerate() {
            // lambda balances the force along the normal or the bond: a surface can only push, a string only pull.
            let limit = self.limited.iter().find(|limited| limited.0 == hold).map(|limited| limited.1);
            let is_right = if limit == Some(Limit::Max) { lambda[first + k] >= 0.0 } else { lambda[first + k] <= 0.0 };
            if is_right {
                kept.push(hold);
            }
        }
        let mut changed = kept.len() != before;
        for (surface, plane) in self.surfaces.iter().enumerate() {
            for point in (0..self.x.len()).filter(|&i| self.is_free[i]) {
                let holds = |hold: &Hold| matches!(hold, Hold::Surface { point: p, surface: s } if *p == point && *s == surface);
                if plane.gap(self.x[point]) < -plane.slack() && !kept.iter().any(holds) {
                    kept.push(Hold::Surface { point, surface });
                    changed = true;
                }
            }
        }
        for &(hold, limit) in &self.limited {
            let off = self.off(hold, &self.x).0;
            let is_over = if limit == Limit::Max { off > 1e-14 } else { off < -1e-14 };
            if is_over && !kept.contains(&hold) {
                kept.push(hold);
                changed = true;
            }
        }
        if changed {
            self.pressed = kept;
            self.lambda.truncate(first);
            self.arrange();
            self.is_done = false;
        }
    }
}
