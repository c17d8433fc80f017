//! Events that come and go within one step: a margin that falls below 0 and rises again shows at neither end.

use super::edge::Gap;
use super::{Event, Group};
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::force::mouse;
use crate::sim::measure::extent;
use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale};

/// Share of the margins at the ends of a step that a cubic between them may be wrong by.
const ROUGH: f64 = 0.05;
/// Times that the lowest point of a margin is looked for anew between two states.
const MOST_LOOKS: u32 = 5;

/// Positions and velocities at a time `[s]`.
type At<'a, S, const D: usize> = (f64, &'a [[S; D]], &'a [[S; D]]);

impl<S: Real, const D: usize> Group<S, D> {
    /// The event whose margin, at no end of a step of `h` below 0, seems to come nearest to it first, and when: by the
    /// cubics through margins and rates at both ends.
    pub(super) fn graze(&self, around: &Environment<D>, (t, h): (f64, f64)) -> Option<(Event, f64)> {
        let mut first: Option<(Event, f64)> = None;
        let mut look = |event: Event, share: f64| {
            let (Some(old), Some(new)) = (self.gap_before(around, t, event), self.gap_now(around, t + h, event)) else {
                return;
            };
            let turns = old.rate < 0.0 && new.rate > 0.0 && old.margin > old.slack && new.margin > new.slack;
            if turns
                && let Some((at, value)) = lowest((old, new), h)
                && value < share * old.margin.max(new.margin)
                && first.is_none_or(|(_, time)| at < time)
            {
                first = Some((event, at));
            }
        };
        for edge in 0..self.edges.list.len() {
            if self.is_awaited(&self.edges.list[edge]) {
                look(Event::Reach { edge }, 0.0);
            }
        }
        for surface in self.surfaces_near(h) {
            let points = (0..self.points.len()).filter(|&i| self.can_hit(i, surface));
            points.for_each(|point| look(Event::Hit { point, surface }, ROUGH));
        }
        self.near_walls(h, |point, surface| look(Event::Hit { point, surface }, ROUGH));
        if let (Some(inside), Some((force, cursor))) = (&self.pull.inside, around.mouse_at(t + h))
            && (inside.count > 0 || mouse::reaches(&self.points, force, cursor))
        {
            let is_free = |&i: &usize| self.points.inverse_mass[i] != S::ZERO;
            (0..self.points.len()).filter(is_free).for_each(|point| look(Event::Cross { point }, ROUGH));
        }
        first
    }

    /// Surfaces that a step of `h` may have touched: the box around all points, gone on with as fast as the fastest, tells.
    fn surfaces_near(&self, h: f64) -> impl Iterator<Item = usize> {
        let surfaces = self.pull.contacts.obstacles.planes().iter().enumerate();
        let boxes = self
            .pull
            .contacts
            .has_surfaces()
            .then(|| Some((extent(&self.points.position)?, extent(&self.before.velocity)?)));
        let boxes = boxes.flatten();
        surfaces.filter_map(move |(s, surface)| {
            let (places, speeds) = boxes?;
            let reach = -h * surface.least_rate(speeds).to_f64();
            (surface.least_gap(places).to_f64() < reach).then_some(s)
        })
    }

    /// Takes the step to a time between its ends where an event seems to have been passed, looks around there, and
    /// locates it; takes the whole of the step where it was not.
    pub(super) fn look_between(
        &mut self,
        around: &Environment<D>,
        (t, h): (f64, f64),
        (event, mut at): (Event, f64),
        counters: &mut Counters,
    ) -> (f64, Option<Event>) {
        let mut low = (0.0, self.gap_before(around, t, event));
        let mut high = (h, self.gap_now(around, t + h, event));
        for _ in 0..MOST_LOOKS {
            let value = self.retake(around, (t, at), event, counters).asked;
            if value < 0.0 {
                return self.locate(around, (t, h), (event, (at, value)), counters);
            }
            let gap = self.gap_now(around, t + at, event);
            let side = if gap.is_some_and(|gap| gap.rate < 0.0) { &mut low } else { &mut high };
            *side = (at, gap);
            let ((begin, Some(old)), (end, Some(new))) = (low, high) else { break };
            let Some((ahead, value)) = lowest((old, new), end - begin) else { break };
            let moves = (begin + ahead - at).abs();
            if value > ROUGH * old.margin.min(new.margin) || moves < 1e-9 * h {
                break;
            }
            at = begin + ahead;
        }
        self.retake(around, (t, h), event, counters);
        (h, None)
    }

    fn gap_before(&self, around: &Environment<D>, t: f64, event: Event) -> Option<Gap> {
        self.gap_of(around, event, (t, &self.before.position, &self.before.velocity))
    }

    fn gap_now(&self, around: &Environment<D>, t: f64, event: Event) -> Option<Gap> {
        self.gap_of(around, event, (t, &self.points.position, &self.points.velocity))
    }

    /// The margin of an event that depends on places alone, and how it changes.
    fn gap_of(&self, around: &Environment<D>, event: Event, (t, x, v): At<'_, S, D>) -> Option<Gap> {
        match event {
            Event::Reach { edge } => Some(self.edges.list[edge].gap(x, v)),
            Event::Hit { point, surface } => {
                let surface = &self.pull.contacts.obstacles.surfaces[surface];
                let rate = dot(surface.normal, v[point]).to_f64();
                Some(Gap { margin: surface.gap(x[point]).to_f64(), rate, slack: surface.slack().to_f64() })
            }
            Event::Cross { point } => {
                let (force, cursor) = around.mouse_at(t)?;
                let ahead = 1e-6 * self.substep;
                let (force_soon, cursor_soon) = around.mouse_at(t + ahead)?;
                let soon = add(x[point], scale(v[point], S::from_f64(ahead)));
                let (now, soon) = (mouse::gauge(force, cursor)(x[point]), mouse::gauge(force_soon, cursor_soon)(soon));
                let side = if self.pull.inside.as_ref()?.points[point] { 1.0 } else { -1.0 };
                let slack = S::EPSILON.to_f64() * 64.0 * (1.0 + force.radius);
                Some(Gap { margin: side * now, rate: side * (soon - now) / ahead, slack })
            }
            _ => None,
        }
    }
}

/// Time and value of the lowest point of the cubic with these values and slopes at 0 and `h`, if that lies between.
fn lowest((old, new): (Gap, Gap), h: f64) -> Option<(f64, f64)> {
    // In s = t/h: old + p s + q s^2 + r s^3.
    let (p, end, rise) = (old.rate * h, new.rate * h, new.margin - old.margin);
    let (q, r) = (3.0 * rise - 2.0 * p - end, p + end - 2.0 * rise);
    let root = (q * q - 3.0 * p * r).max(0.0).sqrt();
    // The minimum, in the form that does not cancel: p < 0, so that q + root > 0 where there is one.
    let s = -p / (q + root);
    let value = old.margin + s * (p + s * (q + s * r));
    (s > 0.0 && s < 1.0).then_some((s * h, value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_point_of_a_parabola_is_found() {
        let gap = |margin, rate| Gap { margin, rate, slack: 0.0 };
        // (t - 0.3)^2 - 0.01 from 0 to 1.
        let (at, value) = lowest((gap(0.08, -0.6), gap(0.48, 1.4)), 1.0).unwrap();
        assert!((at - 0.3).abs() < 1e-12 && (value + 0.01).abs() < 1e-12, "{at} {value}");
        let (at, value) = lowest((gap(0.1, -0.6), gap(0.5, 1.4)), 1.0).unwrap();
        assert!((at - 0.3).abs() < 1e-12 && (value - 0.01).abs() < 1e-12, "{at} {value}");
    }
}
