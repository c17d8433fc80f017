//! The plain program that kernels are compared with: an array of structs, bonds one after another as listed.
//!
//! It is what one writes first, optimised by the compiler alone, and shares no code with the simulation.

use std::ops::{Add, AddAssign, Div, Mul, Sub, SubAssign};

use crate::sim::Model;

/// A scalar of the plain program.
pub trait Number:
    Copy
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
{
    /// The nearest to a value.
    fn of(value: f64) -> Self;
    /// Its square root.
    fn root(self) -> Self;
}

impl Number for f32 {
    fn of(value: f64) -> Self {
        value as f32
    }

    fn root(self) -> Self {
        self.sqrt()
    }
}

impl Number for f64 {
    fn of(value: f64) -> Self {
        value
    }

    fn root(self) -> Self {
        self.sqrt()
    }
}

/// Points and rigid bonds, moved by 2x - x_prev and sweeps.
#[derive(Clone, Debug)]
pub struct Naive<F> {
    points: Vec<Point<F>>,
    bonds: Vec<Link<F>>,
    /// Gravity times the square of the substep `[m]`.
    fall: [F; 2],
}

#[derive(Clone, Copy, Debug)]
struct Point<F> {
    x: [F; 2],
    previous: [F; 2],
    inverse_mass: F,
}

#[derive(Clone, Copy, Debug)]
struct Link<F> {
    a: u32,
    b: u32,
    rest: F,
}

impl<F: Number> Naive<F> {
    /// The start of a model, for substeps of `h` `[s]`.
    pub fn new(model: &Model<2>, h: f64) -> Self {
        let point = |(x, mass): (&[f64; 2], &f64)| {
            let x = x.map(F::of);
            Point { x, previous: x, inverse_mass: F::of(1.0 / mass) }
        };
        let mut points: Vec<Point<F>> = model.position.iter().zip(&model.mass).map(point).collect();
        for pin in &model.pinned {
            points[pin.index()].inverse_mass = F::of(0.0);
        }
        let bonds = model.bonds.iter().map(|bond| Link { a: bond.a.0, b: bond.b.0, rest: F::of(bond.rest_length) });
        Naive { points, bonds: bonds.collect(), fall: model.gravity.map(|g| F::of(g * h * h)) }
    }

    /// Points go on as they went, and fall.
    pub fn advance(&mut self) {
        for point in &mut self.points {
            if point.inverse_mass == F::of(0.0) {
                continue;
            }
            let now = point.x;
            for k in 0..2 {
                point.x[k] = F::of(2.0) * now[k] - point.previous[k] + self.fall[k];
            }
            point.previous = now;
        }
    }

    /// Gives every bond its length, one after another, at the cost of those before.
    pub fn sweep(&mut self) {
        for link in &self.bonds {
            let (a, b) = (self.points[link.a as usize], self.points[link.b as usize]);
            let d = [a.x[0] - b.x[0], a.x[1] - b.x[1]];
            let length = (d[0] * d[0] + d[1] * d[1]).root();
            let weight = a.inverse_mass + b.inverse_mass;
            if length == F::of(0.0) || weight == F::of(0.0) {
                continue;
            }
            let c = (link.rest / length - F::of(1.0)) / weight;
            for k in 0..2 {
                self.points[link.a as usize].x[k] += c * a.inverse_mass * d[k];
                self.points[link.b as usize].x[k] -= c * b.inverse_mass * d[k];
            }
        }
    }

    /// Where a point is `[m]`.
    pub fn position(&self, point: usize) -> [F; 2] {
        self.points[point].x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{Bond, PointId};

    #[test]
    fn a_pendulum_falls_and_keeps_its_length() {
        let mut model = Model::<2> {
            position: vec![[0.0, 0.0], [1.0, 0.0]],
            velocity: vec![[0.0; 2]; 2],
            mass: vec![1.0; 2],
            pinned: vec![PointId(0)],
            gravity: [0.0, -9.8],
            ..Model::default()
        };
        model.bonds.push(Bond::new(PointId(0), PointId(1), 1.0));
        let mut naive = Naive::<f64>::new(&model, 1e-3);
        for _ in 0..500 {
            naive.advance();
            naive.sweep();
        }
        let [x, y] = naive.position(1);
        assert!(y < -0.8 && (x.hypot(y) - 1.0).abs() < 1e-12, "{x} {y}");
        assert_eq!(naive.position(0), [0.0, 0.0]);
    }
}
