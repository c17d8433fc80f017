//! Points that rest on surfaces: when they lift, slip or stop, and who sticks.

use super::{Event, Group, at_edge};
use crate::sim::counters::Counters;
use crate::sim::real::Real;
use crate::sim::surroundings::Surroundings;
use crate::sim::vector::{dot, length, sub};

/// Share of its acceleration that presses a point so little that it counts as let go.
const LOOSE: f64 = 1e-12;

impl<S: Real, const D: usize> Group<S, D> {
    /// How firmly resting points are pressed, sticking ones held, and how much sliding ones have kept of their speed.
    pub(super) fn see_rests(&self, see: &mut impl FnMut(Event, f64)) {
        let contacts = &self.pull.contacts;
        for rest in &contacts.rests {
            let (point, size) = (rest.point, length(rest.pressing));
            let along = rest.along(rest.pressing);
            let grip = rest.grip(&contacts.surfaces);
            if size > S::ZERO {
                for &surface in rest.surfaces() {
                    let press = -(dot(rest.pressing, contacts.surfaces[surface as usize].normal) / size).to_f64();
                    see(Event::Lift { point, surface }, at_edge(press, LOOSE, true));
                }
                if rest.sticks {
                    let most = grip * length(sub(rest.pressing, along));
                    let margin = ((most - length(along)) / size).to_f64();
                    see(Event::Slip { point }, at_edge(margin, LOOSE, true));
                }
            }
            let square = dot(rest.heading, rest.heading);
            if !rest.sticks && grip > S::ZERO && square > S::ZERO {
                let kept = dot(rest.heading, self.points.velocity[point as usize]) / square;
                see(Event::Stop { point }, at_edge(kept.to_f64(), LOOSE, true));
            }
        }
    }

    /// Lets go of points that are no longer pressed, and decides who sticks and who slides.
    pub(super) fn review(&mut self, around: &Surroundings<D>, t: f64, counters: &mut Counters) {
        if self.pull.contacts.is_idle() && self.edges.is_empty() {
            return;
        }
        self.decide_strings(around, t, counters);
        let (velocity, before) = (&mut self.points.velocity, &self.before.velocity);
        self.pull.contacts.retain(|rest, surfaces| {
            let pressing = rest.pressing;
            let least = length(pressing) * S::from_f64(LOOSE);
            rest.keep(surfaces, |s| dot(pressing, surfaces[s].normal) < -least);
            let grip = rest.grip(surfaces);
            let along = rest.along(pressing);
            let most = grip * length(sub(pressing, along));
            if grip == S::ZERO || length(along) >= most * S::from_f64(1.0 - LOOSE) {
                rest.sticks = false;
                return;
            }
            let i = rest.point as usize;
            let (old, new) = (rest.along(before[i]), rest.along(velocity[i]));
            let scale = dot(old, old).max(S::EPSILON * S::EPSILON);
            if !rest.sticks && (dot(old, new) <= S::ZERO || dot(new, new) <= S::EPSILON * scale) {
                rest.sticks = true;
                velocity[i] = [S::ZERO; D];
            }
        });
        self.engine.refresh();
    }
}
