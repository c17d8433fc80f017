//! Forces, what of them is left, and the scales that they are compared with.

use super::descent::Descent;
use super::hold::Hold;
use crate::sim::force::spring;
use crate::sim::measure;
use crate::sim::vector::{add, length, scale, sub};

impl<const D: usize> Descent<D> {
    /// Forces on free points, and the largest single force on one.
    pub(super) fn forces(&self) -> (Vec<[f64; D]>, f64) {
        let mut force = vec![[0.0; D]; self.x.len()];
        let ones = vec![1.0; self.x.len()];
        spring::pull(&self.springs, false, &self.x, &self.x, &ones, &mut force);
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

    /// The largest force that holds do not balance [N].
    pub(super) fn balance(&self, force: &[[f64; D]], holds: &[Hold], lambda: &[f64]) -> f64 {
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

    /// The scale of stiffness [N/m]: of springs, of tensions, and of all weight on the shortest rigid bond.
    pub(super) fn stiffest(&self) -> f64 {
        let springs = self.springs.iter().map(|spring| spring.stiffness).fold(0.0, f64::max);
        let tensions = self.lambda.iter().map(|lambda| lambda.abs()).fold(0.0, f64::max);
        let rests = self.rigid.iter().map(|hold| match hold {
            Hold::Bond { rest, .. } => *rest,
            Hold::Surface { .. } => f64::INFINITY,
        });
        springs.max(tensions).max(self.weight() / rests.fold(self.extent(), f64::min)).max(f64::MIN_POSITIVE)
    }

    /// Weight of all points in the system [N].
    pub(super) fn weight(&self) -> f64 {
        let mass: f64 = self.mass.iter().zip(&self.is_free).filter(|(_, free)| **free).map(|(m, _)| m).sum();
        mass * length(self.gravity)
    }

    /// Diagonal of the box around all points [m].
    pub(super) fn extent(&self) -> f64 {
        let size = measure::extent(&self.x).map_or(0.0, |[low, high]| length(sub(high, low)));
        if size > 0.0 && size.is_finite() { size } else { 1.0 }
    }
}
