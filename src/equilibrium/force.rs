//! Forces on an island, and what of them the holds leave.

use super::descent::Descent;
use super::hold::Grip;
use crate::sim::force::spring;
use crate::sim::vector::{add, length, scale, sub};

impl<const D: usize> Descent<D> {
    /// Forces of springs, gravity and tools on free points `[N]`, and the largest single force on one.
    pub(super) fn forces(&self, x: &[[f64; D]]) -> (Vec<[f64; D]>, f64) {
        let part = &self.part;
        let mut force = vec![[0.0; D]; x.len()];
        spring::pull_at_rest(&part.springs, x, &mut force);
        let mut largest = 0.0_f64;
        for spring in &part.springs {
            let d = length(sub(x[spring.a as usize], x[spring.b as usize]));
            if !spring.is_slack(d) {
                largest = largest.max(spring.stiffness * (d - spring.rest_length).abs());
            }
        }
        part.form.pull_at_rest(x, &mut force);
        largest = largest.max(part.form.largest(x));
        for i in 0..x.len() {
            let weight = scale(part.gravity, part.mass[i]);
            let push = add(part.pushes[i], self.twist[i]);
            force[i] = if part.is_free[i] { add(add(force[i], weight), push) } else { [0.0; D] };
            largest = if part.is_free[i] { largest.max(length(weight)).max(length(push)) } else { largest };
        }
        (force, largest)
    }

    /// Takes from the forces what holds of these multipliers balance. Shapes: `lambda` has one entry a hold.
    pub(super) fn left(&self, mut force: Vec<[f64; D]>, lambda: &[f64], x: &[[f64; D]]) -> Vec<[f64; D]> {
        for (hold, &lambda) in self.holds.iter().zip(lambda).filter(|(_, lambda)| **lambda != 0.0) {
            let pull = scale(hold.off(&self.part.surfaces, x).gradient, lambda);
            match hold.grip {
                Grip::Bond { a, b, .. } => {
                    force[a] = sub(force[a], pull);
                    force[b] = add(force[b], pull);
                }
                Grip::Surface { point, .. } => force[point] = sub(force[point], pull),
            }
        }
        force
    }

    /// Takes from the forces what friction takes. Shapes: `rubs` has one entry a point and rough surface.
    pub(super) fn rubbed(&self, mut force: Vec<[f64; D]>, rubs: &[[f64; D]]) -> Vec<[f64; D]> {
        for (rub, &taken) in self.rubs.iter().zip(rubs) {
            force[rub.point] = sub(force[rub.point], taken);
        }
        force
    }

    /// The largest force on a free point `[N]`.
    pub(super) fn largest(&self, force: &[[f64; D]]) -> f64 {
        force.iter().zip(&self.part.is_free).filter(|(_, free)| **free).map(|(f, _)| length(*f)).fold(0.0, f64::max)
    }
}
