//! Points that reach the walls of polygons, rest on them and come to their ends.
//!
//! A wall is met by a point whose way since the start of the step crosses it, however short or fast.

use super::{Event, Group, at_edge};
use crate::sim::group::impact::Hit;
use crate::sim::measure::extent;
use crate::sim::real::Real;
use crate::sim::vector::{flat, sub, widen, zero};

/// Slacks within which a point that hits is on a wall.
const TOUCH: f64 = 16.0;
/// Slacks beyond the end of a wall where a point that rests on it leaves.
const BEYOND: f64 = 32.0;

impl<S: Real, const D: usize> Group<S, D> {
    /// How far points are from walls that their ways went into; `now` is the box around all points.
    pub(super) fn see_walls(&self, now: [[S; D]; 2], asked: Option<Event>, see: &mut impl FnMut(Event, f64)) {
        let obstacles = &self.pull.contacts.obstacles;
        let mut look = |point: usize, surface: usize| {
            let margin = self.margin_at(point, self.points.position[point], &obstacles.surfaces[surface]);
            see(Event::Hit { point, surface }, margin);
        };
        if let Some(Event::Hit { point, surface }) = asked
            && obstacles.wall(surface).is_some()
            && self.can_hit(point, surface)
        {
            look(point, surface);
        }
        for hit in self.entered(now) {
            look(hit.point, hit.surface);
        }
    }

    /// Points whose ways since the start of the step went into walls, and those inside of polygons, with the nearest one.
    fn entered(&self, [low, high]: [[S; D]; 2]) -> Vec<Hit> {
        let obstacles = &self.pull.contacts.obstacles;
        let now = &self.points.position;
        let before = if self.before.position.len() == now.len() { &self.before.position } else { now };
        let around = extent(before).map_or([low, high], |[from, to]| {
            [std::array::from_fn(|k| low[k].min(from[k])), std::array::from_fn(|k| high[k].max(to[k]))]
        });
        if !obstacles.has_walls_near(around) {
            return Vec::new();
        }
        let meets = |point: usize| {
            let met = obstacles.meeting(before[point], now[point], |surface| self.can_hit(point, surface))?;
            Some(Hit { point, surface: met.surface })
        };
        (0..now.len()).filter(|&point| self.points.inverse_mass[point] != S::ZERO).filter_map(meets).collect()
    }

    /// Points at the start that are on walls or inside of polygons.
    pub(super) fn walls_at_start(&self) -> Vec<Hit> {
        let obstacles = &self.pull.contacts.obstacles;
        let mut hits = Vec::new();
        for (point, &x) in self.points.position.iter().enumerate() {
            if self.points.inverse_mass[point] == S::ZERO {
                continue;
            }
            obstacles.touching(x, 1.0, |surface| hits.push(Hit { point, surface }));
            hits.extend(obstacles.nearest(x, 0.0).map(|surface| Hit { point, surface }));
        }
        hits
    }

    /// Points that went into walls, or where the step was cut, came to them.
    pub(super) fn wall_hits(&self, is_located: bool) -> Vec<Hit> {
        let obstacles = &self.pull.contacts.obstacles;
        let Some(now) = extent(&self.points.position) else { return Vec::new() };
        let mut hits = self.entered(now);
        let gap = |hit: &Hit| {
            let surface = &obstacles.surfaces[hit.surface];
            (surface.gap(self.points.position[hit.point]), surface.slack())
        };
        if !is_located {
            hits.retain(|hit| {
                let (gap, slack) = gap(hit);
                gap <= -slack
            });
            return hits;
        }
        hits.retain(|hit| self.comes(hit.point, &obstacles.surfaces[hit.surface]));
        if obstacles.has_walls_near(now) {
            for (point, &x) in self.points.position.iter().enumerate() {
                obstacles.touching(x, TOUCH, |surface| {
                    let hit = Hit { point, surface };
                    if self.can_hit(point, surface)
                        && self.comes(point, &obstacles.surfaces[surface])
                        && !hits.contains(&hit)
                    {
                        hits.push(hit);
                    }
                });
            }
        }
        hits
    }

    /// Whether a point is behind a wall by more than locating an event leaves.
    pub(super) fn is_sunk(&self, hits: &[Hit]) -> bool {
        let obstacles = &self.pull.contacts.obstacles;
        hits.iter().any(|hit| {
            let surface = &obstacles.surfaces[hit.surface];
            let least = -(surface.slack() * S::from_f64(TOUCH));
            obstacles.wall(hit.surface).is_some() && surface.gap(self.points.position[hit.point]) < least
        })
    }

    /// A point that went into a wall goes on along it from where it met it, and back from it if it `bounces`: then gravity adds
    /// so much to a motion in the step `[m]`. Calls `see` for other walls that it meets then; returns what share of the way was left.
    pub(super) fn lead_back(&mut self, hit: Hit, bounces: Option<[S; D]>, mut see: impl FnMut(Hit)) -> Option<S> {
        let obstacles = &self.pull.contacts.obstacles;
        let now = self.points.position[hit.point];
        let before = self.before.position.get(hit.point).copied().unwrap_or(now);
        let mut first = None;
        let turn = |surface: usize, left: S| {
            if surface != hit.surface {
                see(Hit { point: hit.point, surface });
            }
            first.get_or_insert(left);
            [S::ONE, if bounces.is_some() { obstacles.surfaces[surface].restitution } else { S::ZERO }]
        };
        let end = obstacles.led(before, now, bounces.unwrap_or(zero()), turn);
        self.points.position[hit.point] = end.unwrap_or_else(|| obstacles.onto(hit.surface, now));
        if let Some(lost) = self.points.position_lost.get_mut(hit.point) {
            *lost = zero();
        }
        first
    }

    /// How far points that rest on walls are from leaving them at their ends.
    pub(super) fn see_ends(&self, see: &mut impl FnMut(Event, f64)) {
        let obstacles = &self.pull.contacts.obstacles;
        if !obstacles.has_walls() {
            return;
        }
        for rest in self.pull.contacts.rests.iter().filter(|rest| !rest.sticks) {
            for &surface in rest.surfaces() {
                let Some(wall) = obstacles.wall(surface as usize) else { continue };
                let i = rest.point as usize;
                let [x, v] = [self.points.position[i], self.points.velocity[i]].map(flat);
                let slack = obstacles.slack();
                let leaves = wall.goes_within(x, v) < 0.0;
                let margin = if leaves { at_edge(wall.within(x) + BEYOND * slack, slack, true) } else { slack };
                see(Event::Leave { point: rest.point, surface }, margin);
            }
        }
    }

    /// Points that went beyond the ends of walls rest on them no more.
    pub(in crate::sim::group) fn leave_ends(&mut self) {
        if !self.pull.contacts.is_idle() {
            self.leave(None);
        }
    }

    /// A point that came to the end of a wall rests on it no more; nor do those that went on beyond.
    pub(super) fn leave(&mut self, event: Option<Event>) {
        if self.pull.contacts.is_idle() || !self.pull.contacts.obstacles.has_walls() {
            return;
        }
        let obstacles = self.pull.contacts.obstacles.clone();
        let (x, v) = (&self.points.position, &self.points.velocity);
        self.pull.contacts.retain(|rest, surfaces| {
            let (point, i) = (rest.point, rest.point as usize);
            let is_on = |surface: usize| {
                let Some(wall) = obstacles.wall(surface) else { return true };
                let is_due = event == Some(Event::Leave { point, surface: surface as u32 });
                let is_beyond = wall.within(flat(x[i])) < -BEYOND * obstacles.slack();
                !(is_due || is_beyond && wall.goes_within(flat(x[i]), flat(v[i])) < 0.0)
            };
            rest.keep(surfaces, is_on);
        });
    }

    /// Whether a point is beside a wall, so that it may rest there.
    pub(super) fn is_beside(&self, point: usize, surface: usize) -> bool {
        let obstacles = &self.pull.contacts.obstacles;
        let x = flat(self.points.position[point]);
        obstacles.wall(surface).is_none_or(|wall| wall.within(x) >= -TOUCH * obstacles.slack())
    }

    /// The walls that a point may have touched within a step: near its way, by as much as that may be bent.
    pub(super) fn near_walls(&self, h: f64, mut see: impl FnMut(usize, usize)) {
        let obstacles = &self.pull.contacts.obstacles;
        if !obstacles.has_walls() {
            return;
        }
        for point in (0..self.points.len()).filter(|&i| self.points.inverse_mass[i] != S::ZERO) {
            let bend = sub(self.points.velocity[point], self.before.velocity[point]);
            let bend = 0.25 * h * widen(bend).iter().fold(0.0, |most: f64, b| most.max(b.abs()));
            let [a, b] = [self.before.position[point], self.points.position[point]];
            obstacles.near(a, b, bend, |surface| {
                if self.can_hit(point, surface) {
                    see(point, surface);
                }
            });
        }
    }
}
