//! Points that rest on surfaces: when they lift, slip or stop, and who sticks.

use super::{Event, Group, at_edge};
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::points::Points;
use crate::sim::real::Real;
use crate::sim::vector::{dot, length, sub};

/// Share of its acceleration that presses a point so little that it counts as let go.
const LOOSE: f64 = 1e-12;

impl<S: Real, const D: usize> Group<S, D> {
    /// How firmly resting points are pressed, sticking ones held, and how much sliding ones have kept of their speed.
    pub(super) fn see_rests(&self, see: &mut impl FnMut(Event, f64)) {
        self.see_ends(see);
        let contacts = &self.pull.contacts;
        for rest in &contacts.rests {
            let (point, size) = (rest.point, length(rest.pressing));
            let along = rest.along(rest.pressing);
            let grip = rest.grip(&contacts.obstacles.surfaces);
            if size > S::ZERO {
                for &surface in rest.surfaces() {
                    let press =
                        -(dot(rest.pressing, contacts.obstacles.surfaces[surface as usize].normal) / size).to_f64();
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

    /// An event of a contact that is due where a step begins happens whatever rounding says: a point whose flight ends
    /// there rests, unless it has bounced off, others lift off or slip.
    pub(super) fn take_due(&mut self, event: Option<Event>) {
        match event {
            Some(Event::Hit { point, surface }) if self.is_beside(point, surface) && !self.goes(point, surface) => {
                self.pull.contacts.touch(point, surface);
                self.pull.contacts.settle(&mut self.points);
                self.capture();
            }
            Some(Event::Lift { point: lifted, surface }) => self.pull.contacts.retain(|rest, surfaces| {
                if rest.point == lifted {
                    rest.keep(surfaces, |s| s != surface as usize);
                }
            }),
            Some(Event::Slip { point: slips }) => self.pull.contacts.retain(|rest, _| {
                rest.sticks &= rest.point != slips;
            }),
            _ => {}
        }
    }

    /// Lets go of points that are no longer pressed, and decides who sticks and who slides.
    pub(super) fn review(&mut self, around: &Environment<D>, t: f64, counters: &mut Counters) {
        if self.pull.contacts.is_idle() && self.edges.is_empty() {
            return;
        }
        self.decide_strings(around, t, counters);
        let Points { velocity, velocity_lost, .. } = &mut self.points;
        let before = &self.before.velocity;
        self.pull.contacts.retain(|rest, surfaces| {
            let pressing = rest.pressing;
            let least = length(pressing) * S::from_f64(LOOSE);
            rest.keep(surfaces, |s| dot(pressing, surfaces[s].normal) < -least);
            let grip = rest.grip(surfaces);
            let along = rest.along(pressing);
            let most = grip * length(sub(pressing, along));
            let i = rest.point as usize;
            let (old, new) = (rest.along(before[i]), rest.along(velocity[i]));
            let scale = dot(old, old).max(S::EPSILON * S::EPSILON);
            let is_still = dot(new, new) <= S::EPSILON * scale;
            if grip == S::ZERO || length(along) >= most * S::from_f64(1.0 - LOOSE) {
                rest.sticks = false;
                if grip > S::ZERO && is_still {
                    // What rounding leaves of its velocity must not say which way it slides.
                    (velocity[i], velocity_lost[i]) = ([S::ZERO; D], [S::ZERO; D]);
                }
                return;
            }
            if !rest.sticks && (dot(old, new) <= S::ZERO || is_still) {
                rest.sticks = true;
                (velocity[i], velocity_lost[i]) = ([S::ZERO; D], [S::ZERO; D]);
            }
        });
        self.engine.refresh();
    }
}
