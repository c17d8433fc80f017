//! Bonds that reach a length at which something happens to them.

use super::edge::{Change, Edge, Gap};
use super::{Event, Group, at_edge};
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::group::guard::Watched;
use crate::sim::real::Real;

/// Share of a substep over which it is told where a bond goes that is at its edge and does not move yet.
const AHEAD: f64 = 1e-3;

impl<S: Real, const D: usize> Group<S, D> {
    /// How far bonds are from their edges. Strings that are taut have none.
    pub(super) fn see_edges(&self, see: &mut impl FnMut(Event, f64)) {
        if !self.locates {
            return;
        }
        for (k, edge) in self.edges.list.iter().enumerate().filter(|(_, edge)| self.is_awaited(edge)) {
            let gap = edge.gap(&self.points.position, &self.points.velocity);
            see(Event::Reach { edge: k }, at_edge(gap.margin, gap.slack, self.nears(gap)));
        }
    }

    pub(super) fn is_awaited(&self, edge: &Edge<S>) -> bool {
        match edge.what {
            Change::Spring(..) => true,
            Change::String(row, _) => !self.pull.rigid.as_ref().is_some_and(|rigid| rigid.is_taut(row)),
            Change::Break(_) => self.edges.stops,
        }
    }

    /// Whether a bond comes to its edge, faster than rounding does.
    fn nears(&self, gap: Gap) -> bool {
        gap.rate * self.substep < -gap.slack
    }

    /// The margin at the start of the step, where it is clearly on its side.
    pub(super) fn margin_before(&self, event: Event) -> Option<f64> {
        let Event::Reach { edge } = event else { return None };
        let gap = self.edges.list[edge].gap_in(&self.before);
        (gap.margin > gap.slack).then_some(gap.margin)
    }

    /// How fast the margin changes at the state reached `[m/s]`, where that is known.
    pub(super) fn margin_rate(&self, event: Event) -> Option<f64> {
        let Event::Reach { edge } = event else { return None };
        Some(self.edges.list[edge].gap(&self.points.position, &self.points.velocity).rate)
    }

    /// Bonds that reached their edges are on the other side from now on. Returns whether any string got taut or slack.
    pub(super) fn turn_edges(
        &mut self,
        event: Option<Event>,
        is_located: bool,
        at: f64,
        counters: &mut Counters,
    ) -> bool {
        let mut any_string = false;
        for k in 0..self.edges.list.len() {
            let edge = self.edges.list[k];
            let lets_go = event == Some(Event::LetGo { edge: k });
            let mut turns = lets_go || event == Some(Event::Reach { edge: k });
            if !turns && self.is_awaited(&edge) {
                let gap = edge.gap(&self.points.position, &self.points.velocity);
                let reach = if is_located { 16.0 } else { -1.0 };
                turns = gap.margin <= reach * gap.slack && (self.nears(gap) || !is_located);
            }
            if !turns {
                continue;
            }
            counters.events += 1;
            any_string |= edge.row().is_some();
            match edge.what {
                Change::Break(bond) => self.snap(bond, at),
                _ => self.put(k, !edge.is_longer),
            }
        }
        any_string
    }

    /// A bond counts as on one side of its edge.
    fn put(&mut self, edge: usize, is_longer: bool) {
        let edge = &mut self.edges.list[edge];
        edge.is_longer = is_longer;
        match edge.what {
            Change::Spring(at, whole) => {
                self.pull.springs.set(at, whole.held(edge.acts()));
            }
            Change::String(row, _) => {
                if let Some(rigid) = &mut self.pull.rigid {
                    rigid.set_taut(row, edge.acts());
                }
            }
            Change::Break(_) => {}
        }
    }

    /// At the start: decides on which side of its edge every bond is. One that is just there is where it goes.
    pub(in crate::sim::group) fn begin_edges(&mut self, around: &Environment<D>, t: f64, counters: &mut Counters) {
        if self.edges.is_empty() {
            return;
        }
        if let Some(rigid) = self.pull.rigid.as_mut().filter(|_| self.edges.has_strings()) {
            rigid.leave_limits_to_events();
        }
        self.note_strings();
        let limited = |bond: &Watched<S>| self.edges.list.iter().any(|edge| edge.guards(bond));
        self.guard.bonds.retain(|bond| !limited(bond));
        self.edges.always_watched = self.guard.bonds.len();
        self.accelerations(around, t, counters);
        for k in 0..self.edges.list.len() {
            let edge = self.edges.list[k];
            if let Change::Spring(..) = edge.what {
                let gap = edge.gap(&self.points.position, &self.points.velocity);
                let ahead = AHEAD * self.substep;
                let bend = edge.bend(&self.points.position, &self.points.velocity, &self.acceleration);
                let soon = gap.rate * ahead + 0.5 * bend * ahead * ahead;
                // The side that edges start on is the shorter one, where a margin falls with the length.
                self.put(k, if gap.margin.abs() <= gap.slack { soon < 0.0 } else { gap.margin < 0.0 });
            }
        }
        self.review(around, t, counters);
        self.watch_taut();
    }

    /// Bonds with a limit are watched by the guard while they act: how a slack one turns is nothing to it.
    pub(super) fn watch_taut(&mut self) {
        if !self.edges.is_empty() {
            self.guard.bonds.truncate(self.edges.always_watched);
            self.guard.bonds.extend(self.edges.list.iter().filter(|edge| edge.acts()).map(Edge::watched));
        }
    }
}
