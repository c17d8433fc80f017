//! Points that cross the edge of the mouse region.

use super::{Event, Group, at_edge};
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::force::mouse;
use crate::sim::real::Real;
use crate::sim::vector::{add, scale};

impl<S: Real, const D: usize> Group<S, D> {
    /// The depth of points that count as inside the mouse region, and of those outside with a minus.
    pub(super) fn see_mouse(&self, around: &Environment<D>, t: f64, see: &mut impl FnMut(Event, f64)) {
        let (Some(inside), Some((force, cursor))) = (&self.pull.inside, around.mouse_at(t)) else { return };
        if inside.count == 0 && !mouse::reaches(&self.points, force, cursor) {
            return;
        }
        let slack = S::EPSILON.to_f64() * 64.0 * (1.0 + force.radius);
        let depth_of = mouse::gauge(force, cursor);
        for (i, &x) in self.points.position.iter().enumerate() {
            if self.points.inverse_mass[i] != S::ZERO {
                let depth = depth_of(x);
                let margin = if inside.points[i] { depth } else { -depth };
                let crosses = margin.abs() <= slack && self.goes_in(around, t, i, depth) != inside.points[i];
                see(Event::Cross { point: i }, at_edge(margin, slack, crosses));
            }
        }
    }

    /// Whether a point gets deeper into the mouse region.
    fn goes_in(&self, around: &Environment<D>, t: f64, point: usize, depth: f64) -> bool {
        let ahead = 1e-6 * self.substep;
        let soon = add(self.points.position[point], scale(self.points.velocity[point], S::from_f64(ahead)));
        around.mouse_at(t + ahead).is_some_and(|(force, cursor)| mouse::gauge(force, cursor)(soon) > depth)
    }

    /// Points that crossed the edge of the mouse region count as on its other side.
    pub(super) fn cross(&mut self, around: &Environment<D>, t: f64, counters: &mut Counters) {
        let (Some(inside), Some((force, cursor))) = (&self.pull.inside, around.mouse_at(t)) else { return };
        let slack = S::EPSILON.to_f64() * 1024.0 * (1.0 + force.radius);
        let depth_of = mouse::gauge(force, cursor);
        let mut crossed = Vec::new();
        for (i, &x) in self.points.position.iter().enumerate() {
            let depth = depth_of(x);
            // A point that is well across was not caught at the edge: it counts as where it is.
            let is_inside = if depth.abs() <= slack { self.goes_in(around, t, i, depth) } else { depth > 0.0 };
            if is_inside != inside.points[i] {
                crossed.push(i);
            }
        }
        counters.events += crossed.len() as u64;
        if let Some(inside) = &mut self.pull.inside {
            crossed.into_iter().for_each(|point| inside.toggle(point));
        }
    }
}
