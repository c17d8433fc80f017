//! Points that reach surfaces: when they do, which ones hit, and how those that went through come back.

use super::{Event, Group, at_edge};
use crate::sim::contact::passage::Passage;
use crate::sim::contact::place;
use crate::sim::contact::surface::Surface;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::group::impact::{self, Hit};
use crate::sim::measure::extent;
use crate::sim::real::Real;
use crate::sim::vector::{dot, zero};

/// Flight, in substeps, that counts as rest where it begins with no time gone since the last.
const REST: f64 = 0.05;
/// Rounds in which points outside are put back to surfaces, and their bonds to their lengths.
const MOST_ROUNDS: u32 = 4;

impl<S: Real, const D: usize> Group<S, D> {
    /// How far points are from surfaces. A surface that the box around all points does not reach has no events.
    pub(super) fn see_surfaces(&self, asked: Option<Event>, see: &mut impl FnMut(Event, f64)) {
        let obstacles = &self.pull.contacts.obstacles;
        if obstacles.is_empty() {
            return;
        }
        let Some(bounds) = extent(&self.points.position) else { return };
        self.see_walls(bounds, asked, see);
        for (s, surface) in obstacles.planes().iter().enumerate() {
            let slack = surface.slack();
            let is_asked = matches!(asked, Some(Event::Hit { surface, .. }) if surface == s);
            if !is_asked && surface.least_gap(bounds) > slack + slack {
                continue;
            }
            for (i, &x) in self.points.position.iter().enumerate() {
                if self.can_hit(i, s) {
                    see(Event::Hit { point: i, surface: s }, self.margin_at(i, x, surface));
                }
            }
        }
    }

    /// How far a point at `x` is from hitting. Within the slack is on the surface: there it counts where the point goes.
    pub(super) fn margin_at(&self, point: usize, x: [S; D], surface: &Surface<S, D>) -> f64 {
        at_edge(surface.gap(x).to_f64(), surface.slack().to_f64(), self.comes(point, surface))
    }

    /// Whether a point moves into a surface, faster than rounding does.
    pub(super) fn comes(&self, point: usize, surface: &Surface<S, D>) -> bool {
        let off = dot(self.points.velocity[point], surface.normal);
        off * S::from_f64(self.substep) < -surface.slack()
    }

    /// Whether a point moves off a surface, faster than rounding does and for longer than a small part of a substep.
    pub(super) fn goes(&self, point: usize, surface: usize) -> bool {
        let surface = &self.pull.contacts.obstacles.surfaces[surface];
        let off = dot(self.points.velocity[point], surface.normal);
        let pull = self.acceleration.get(point).map_or(S::ZERO, |&pull| dot(pull, surface.normal));
        let shortest = S::from_f64(REST * self.substep);
        off * S::from_f64(self.substep) > surface.slack() && off + off > -(pull * shortest)
    }

    pub(super) fn can_hit(&self, point: usize, surface: usize) -> bool {
        self.points.inverse_mass[point] != S::ZERO && !self.pull.contacts.rests_on(point, surface)
    }

    /// At the start: points outside come back to the surface, those that stand on one rest there.
    pub(in crate::sim::group) fn meet_start(&mut self, around: &Environment<D>, t: f64, counters: &mut Counters) {
        let mut hits = self.walls_at_start();
        for (s, surface) in self.pull.contacts.obstacles.planes().iter().enumerate() {
            for (i, &x) in self.points.position.iter().enumerate() {
                if self.points.inverse_mass[i] != S::ZERO && surface.gap(x) <= surface.slack() {
                    hits.push(Hit { point: i, surface: s });
                }
            }
        }
        if hits.is_empty() {
            return;
        }
        self.push_out(&mut hits, zero());
        if self.stay_inside(&hits) {
            hits = self.hits(true);
        }
        let rigid = self.pull.rigid.as_mut();
        impact::strike(&mut self.points, &mut self.pull.contacts, rigid, (&hits, false), |_, _| false, None);
        for hit in hits {
            let off = dot(self.points.velocity[hit.point], self.pull.contacts.obstacles.surfaces[hit.surface].normal);
            if off == S::ZERO {
                self.pull.contacts.touch(hit.point, hit.surface);
            }
        }
        self.points.save(&mut self.before);
        self.review(around, t, counters);
    }

    /// What bonds hold over an obstacle stays there until it is out by itself: all of it where they are rigid, for one moves the
    /// other, or would be stretched by far. Returns whether there is any.
    fn stay_inside(&mut self, hits: &[Hit]) -> bool {
        let is_stretched = !self.guard.passes(&self.before.position, &self.points.position);
        let is_sunk = self.is_sunk(hits);
        if is_stretched || is_sunk && self.pull.rigid.is_some() {
            self.points.restore(&self.before);
        } else if is_sunk {
            for hit in hits {
                if self.is_sunk(std::slice::from_ref(hit)) {
                    self.points.position[hit.point] = self.before.position[hit.point];
                }
            }
        }
        is_stretched || is_sunk
    }

    /// The hit that an event is, where the point comes: whatever else it meets there, and rounding says.
    pub(super) fn due(&self, event: Option<Event>) -> Option<Hit> {
        let Some(Event::Hit { point, surface }) = event else { return None };
        let comes = self.comes(point, &self.pull.contacts.obstacles.surfaces[surface]);
        (comes && self.can_hit(point, surface) && self.is_beside(point, surface)).then_some(Hit { point, surface })
    }

    /// Points at or beyond a surface on their way into it.
    pub(super) fn hits(&self, is_located: bool) -> Vec<Hit> {
        let mut hits = self.wall_hits(is_located);
        for (s, surface) in self.pull.contacts.obstacles.planes().iter().enumerate() {
            let slack = surface.slack();
            let reach = if is_located { slack * S::from_f64(16.0) } else { -slack };
            for (i, &x) in self.points.position.iter().enumerate() {
                let comes = self.comes(i, surface);
                if surface.gap(x) <= reach && self.can_hit(i, s) && (comes || !is_located) {
                    hits.push(Hit { point: i, surface: s });
                }
            }
        }
        hits
    }

    /// Where events are not located: points that went through a surface spend the rest of the way on the way back, at
    /// `restitution` of their speed, as far as their bonds let them. Adds the walls that they hit then; returns of points that
    /// bounced what share of the step was left.
    ///
    /// `fall` is what gravity adds to a motion in the step `[m]`.
    pub(super) fn push_out(&mut self, hits: &mut Vec<Hit>, fall: [S; D]) -> Vec<(usize, S)> {
        let mut late = Vec::new();
        for at in 0..hits.len() {
            let hit = hits[at];
            if self.pull.contacts.obstacles.wall(hit.surface).is_some() {
                let left = self.lead_back(hit, Some(fall), |more| hits.push(more));
                late.extend(left.map(|left| (hit.point, left)));
                continue;
            }
            let surface = &self.pull.contacts.obstacles.surfaces[hit.surface];
            let end = self.points.position[hit.point];
            let start = self.before.position.get(hit.point).copied().unwrap_or(end);
            let (before, gap) = (surface.gap(start), surface.gap(end));
            if gap < S::ZERO && before >= S::ZERO {
                let passage = Passage::new(surface, [start, end], fall, (before / (before - gap)).to_f64());
                late.push((hit.point, passage.left));
                [_, self.points.position[hit.point]] = passage.turned([S::ONE, surface.restitution]);
            }
        }
        for _ in 0..MOST_ROUNDS {
            let out = self.hits(false);
            if out.is_empty() {
                break;
            }
            let mut held = self.pull.contacts.clone();
            for hit in out {
                match self.pull.contacts.obstacles.wall(hit.surface) {
                    Some(_) => {
                        self.lead_back(hit, None, |_| {});
                    }
                    None => place(&mut self.points, hit.point, &self.pull.contacts.obstacles.surfaces[hit.surface]),
                }
                held.touch(hit.point, hit.surface);
            }
            if let Some(rigid) = &mut self.pull.rigid {
                rigid.project(&mut self.points, &held);
            }
        }
        late
    }
}
