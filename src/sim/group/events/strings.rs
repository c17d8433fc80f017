//! Strings: rigid bonds with a limit, which get taut with a jerk and are let go when they no longer pull.

use super::{Event, Group};
use crate::sim::bond::Limit;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::group::impact;
use crate::sim::real::Real;
use crate::sim::vector::{dot, length, sub};

/// Share of the accelerations around it below which a tension counts as none, in units of the last place.
const LOOSE: f64 = 4096.0;
/// Slacks of a length within which a string rests there, and as many that it may change by in a substep.
const STILL: f64 = 64.0;

impl<S: Real, const D: usize> Group<S, D> {
    /// How firmly taut strings pull, as a share of the accelerations around them, by the last multipliers.
    pub(super) fn see_strings(&self, asked: Option<Event>, see: &mut impl FnMut(Event, f64)) {
        let loose = S::EPSILON.to_f64() * LOOSE;
        for (k, grip) in self.grips() {
            let event = Event::LetGo { edge: k };
            let margin = match grip.abs() <= loose {
                true if asked == Some(event) => 0.0,
                true => loose,
                false => grip,
            };
            see(event, margin);
        }
    }

    /// The edges of taut strings, and how firmly each pulls.
    fn grips(&self) -> impl Iterator<Item = (usize, f64)> {
        let gravity = self.pull.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
        let rows = self.edges.list.iter().enumerate().filter_map(|(k, edge)| Some((k, edge, edge.row()?.0)));
        let taut = rows.filter_map(|row| self.pull.rigid.as_ref().filter(|rigid| rigid.is_taut(row.2)).zip(Some(row)));
        taut.map(move |(rigid, (k, edge, row))| {
            let [i, j] = edge.ends();
            let (x, v, a) = (&self.points.position, &self.points.velocity, &self.acceleration);
            let closing = sub(v[i], v[j]);
            let turn = dot(closing, closing) / length(sub(x[i], x[j])).max(S::EPSILON);
            let around = gravity + (length(a[i]) + length(a[j]) + turn).to_f64();
            (k, if around > 0.0 { rigid.grip(row).to_f64() / around } else { 0.0 })
        })
    }

    /// Whether any string is taut.
    pub(super) fn has_taut(&self) -> bool {
        let is_taut = |row| self.pull.rigid.as_ref().is_some_and(|rigid| rigid.is_taut(row));
        self.edges.list.iter().any(|edge| edge.row().is_some_and(|(row, _)| is_taut(row)))
    }

    /// Strings are on the side of their edges where they were found to be: taut or slack.
    pub(super) fn note_strings(&mut self) {
        let Some(rigid) = &self.pull.rigid else { return };
        for edge in &mut self.edges.list {
            if let Some((row, limit)) = edge.row() {
                edge.is_longer = rigid.is_taut(row) == (limit == Limit::Max);
            }
        }
    }

    /// Works out accelerations, and which strings at their lengths act: none pushes, and none that does not act gets longer.
    ///
    /// One by one, the worst first, for each changes what the others have to do; a string that comes back is the last.
    pub(super) fn decide_strings(&mut self, around: &Environment<D>, t: f64, counters: &mut Counters) {
        let mut was_let_go = vec![false; if self.has_strings() { self.edges.list.len() } else { 0 }];
        self.accelerations(around, t, counters);
        for _ in 0..2 * was_let_go.len() {
            let change = match self.wrong().filter(|&k| !was_let_go[k]) {
                Some(edge) => {
                    was_let_go[edge] = true;
                    Some((edge, false))
                }
                None => self.parting().map(|edge| (edge, true)),
            };
            let Some((edge, is_taut)) = change else { break };
            self.tie(edge, is_taut);
            self.accelerations(around, t, counters);
        }
    }

    /// The string that would have to push most, by the last accelerations.
    fn wrong(&self) -> Option<usize> {
        let loose = S::EPSILON.to_f64() * LOOSE;
        let wrong = self.grips().filter(|grip| grip.1 < -loose);
        wrong.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(edge, _)| edge)
    }

    /// The string that rests at its length without acting and would get longer fastest, by the last accelerations.
    fn parting(&self) -> Option<usize> {
        let Group { points, pull, acceleration, .. } = self;
        let is_slack = |row| pull.rigid.as_ref().is_some_and(|rigid| !rigid.is_taut(row));
        let slack =
            self.edges.list.iter().enumerate().filter(|(_, edge)| edge.row().is_some_and(|(row, _)| is_slack(row)));
        let bends = slack.filter_map(|(k, edge)| {
            let gap = edge.gap(&points.position, &points.velocity);
            let rests = gap.margin <= STILL * gap.slack && gap.rate.abs() * self.substep <= STILL * gap.slack;
            rests.then(|| (k, edge.bend(&points.position, &points.velocity, acceleration)))
        });
        // A margin that bends down: what rounding makes of it is far below what gravity does.
        let falls = bends.filter(|bend| bend.1 < -1e-9);
        falls.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(edge, _)| edge)
    }

    /// A string acts from now on, or no longer.
    fn tie(&mut self, edge: usize, is_taut: bool) {
        if let (Some((row, _)), Some(rigid)) = (self.edges.list[edge].row(), &mut self.pull.rigid) {
            rigid.set_taut(row, is_taut);
        }
        self.note_strings();
    }

    /// Strings answer velocities that changed at once: those that would have to push are let go.
    pub(in crate::sim::group) fn jerk(&mut self) {
        let rigid = self.pull.rigid.as_mut();
        impact::strike(&mut self.points, &mut self.pull.contacts, rigid, (&[], true), |_, _| false, None);
        self.note_strings();
        self.watch_taut();
        self.engine.refresh();
    }

    /// Whether a string that is about to get taut still gets shorter: it would come back at once.
    pub(super) fn recedes(&self, event: Option<Event>) -> bool {
        let Some(Event::Reach { edge }) = event else { return false };
        let edge = &self.edges.list[edge];
        edge.row().is_some() && edge.gap(&self.points.position, &self.points.velocity).rate > 0.0
    }

    /// Taut strings take all of their velocities along themselves, whichever way they lead.
    pub(super) fn capture(&mut self) {
        if let Some(rigid) = &mut self.pull.rigid {
            rigid.make_ready(&self.points, &self.pull.contacts);
            rigid.project_velocity(&mut self.points, &self.pull.contacts);
        }
    }

    /// Whether there are strings that events decide on.
    pub(in crate::sim::group) fn has_strings(&self) -> bool {
        self.edges.has_strings() && self.pull.rigid.as_ref().is_some_and(|rigid| !rigid.chooses_itself())
    }
}
