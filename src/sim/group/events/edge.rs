//! Lengths at which something happens to a bond.

use crate::sim::bond::Limit;
use crate::sim::constrain::direct::Direct;
use crate::sim::force::spring::Spring;
use crate::sim::group::Breakable;
use crate::sim::group::guard::Watched;
use crate::sim::points::State;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::sizes::MOST_LIMITED;
use crate::sim::vector::{dot, sub};

/// Events of bonds that may cut a substep, beside two for each that has any.
const MOST_TURNS: u32 = 32;

/// What happens at an edge.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Change<S> {
    /// A spring with a limit begins to act or ends to: its place among the springs, and what it is while it acts.
    Spring(usize, Spring<S>),
    /// A rigid bond with a limit gets taut: its row among the rigid bonds. It is let go by its tension, not its length.
    String(usize, Limit),
    /// A bond breaks: which one of the world it is.
    Break(u32),
}

/// A length of a bond at which something happens to it.
///
/// On which side of it a bond is stays as it is for the whole of a step, so that the motion is smooth there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge<S> {
    a: u32,
    b: u32,
    /// `[m]`, > 0.
    length: S,
    pub(super) what: Change<S>,
    /// The bond counts as longer than that.
    pub(super) is_longer: bool,
}

/// How far a bond is from its edge, on the side where it counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    /// `[m]`; below 0 the edge was passed.
    pub(super) margin: f64,
    /// Change of the margin `[m/s]`.
    pub(super) rate: f64,
    /// A margin that rounding cannot tell from 0 `[m]`.
    pub(super) slack: f64,
}

impl<S: Real> Edge<S> {
    /// How far it is: (|d|^2 - length^2) / (2 length), which is as smooth as the motion.
    pub(super) fn gap<const D: usize>(&self, x: &[[S; D]], v: &[[S; D]]) -> Gap {
        let (i, j) = (self.a as usize, self.b as usize);
        let d = sub(x[i], x[j]);
        let side = if self.is_longer { S::ONE } else { -S::ONE };
        let far = x[i].iter().fold(self.length, |most, c| most.max(c.abs()));
        Gap {
            margin: (side * S::HALF * (dot(d, d) - self.length * self.length) / self.length).to_f64(),
            rate: (side * dot(d, sub(v[i], v[j])) / self.length).to_f64(),
            slack: (S::EPSILON * S::from_f64(64.0) * far).to_f64(),
        }
    }

    pub(super) fn gap_in<const D: usize>(&self, state: &State<S, D>) -> Gap {
        self.gap(&state.position, &state.velocity)
    }

    /// How the margin changes its rate under these accelerations `[m/s^2]`.
    pub(super) fn bend<const D: usize>(&self, x: &[[S; D]], v: &[[S; D]], a: &[[S; D]]) -> f64 {
        let (i, j) = (self.a as usize, self.b as usize);
        let (closing, side) = (sub(v[i], v[j]), if self.is_longer { 1.0 } else { -1.0 });
        let bend = dot(sub(x[i], x[j]), sub(a[i], a[j])) + dot(closing, closing);
        side * (bend / self.length).to_f64()
    }

    /// The side on which a bond acts.
    pub(super) fn limit(&self) -> Limit {
        match self.what {
            Change::Spring(_, Spring { limit, .. }) | Change::String(_, limit) => limit,
            Change::Break(_) => Limit::Both,
        }
    }

    /// Whether a bond with a limit acts.
    pub(super) fn acts(&self) -> bool {
        match self.limit() {
            Limit::Both => false,
            Limit::Max => self.is_longer,
            Limit::Min => !self.is_longer,
        }
    }

    /// The bond as the guard watches it.
    pub(super) fn watched(&self) -> Watched<S> {
        Watched { a: self.a, b: self.b, rest_square: self.length * self.length }
    }

    /// Whether a watched bond is this one, and has a limit.
    pub(super) fn guards(&self, bond: &Watched<S>) -> bool {
        let Watched { a, b, rest_square } = self.watched();
        let off = (rest_square - bond.rest_square).abs();
        self.limit() != Limit::Both && (a, b) == (bond.a, bond.b) && off <= S::EPSILON * S::from_f64(4.0) * rest_square
    }

    /// The row of a rigid bond with a limit.
    pub(super) fn row(&self) -> Option<(usize, Limit)> {
        match self.what {
            Change::String(row, limit) => Some((row, limit)),
            _ => None,
        }
    }

    pub(super) fn ends(&self) -> [usize; 2] {
        [self.a as usize, self.b as usize]
    }
}

/// Bonds that broke within a step, which ends there.
#[derive(Clone, Debug)]
pub(crate) struct Broken {
    /// When `[s]`.
    pub(crate) at: f64,
    /// Which ones of the world.
    pub(crate) bonds: Vec<u32>,
}

/// The edges of the bonds of a group; none where events are not located.
#[derive(Clone, Debug)]
pub(crate) struct Edges<S> {
    pub(super) list: Vec<Edge<S>>,
    /// Steps in a row that an event ended where they began.
    pub(super) restarts: u32,
    /// Events of bonds that cut the substep under way.
    pub(super) turns: u32,
    /// How many watched bonds have no limit.
    pub(super) always_watched: usize,
    /// A step ends where a bond breaks.
    pub(crate) stops: bool,
    pub(crate) broken: Option<Broken>,
}

impl<S: Real> Edges<S> {
    pub(crate) fn none() -> Self {
        Edges { list: Vec::new(), restarts: 0, turns: 0, always_watched: 0, stops: false, broken: None }
    }

    /// The edges of springs and rigid bonds with a limit, and of bonds that break.
    pub(crate) fn of<const D: usize>(pull: &Pull<S, D>, breakable: &[Breakable<S>]) -> Self {
        let mut edges = Edges::none();
        for (k, spring) in pull.springs.iter().enumerate() {
            if spring.limit != Limit::Both && spring.rest_length > S::ZERO {
                edges.add(spring.a, spring.b, spring.rest_length, Change::Spring(k, *spring));
            }
        }
        for (k, row) in pull.rigid.iter().flat_map(Direct::strings) {
            edges.add(row.a, row.b, row.rest_length, Change::String(k, row.limit));
        }
        if edges.list.len() > MOST_LIMITED {
            edges.list.clear();
        }
        for bond in breakable {
            edges.add(bond.a, bond.b, bond.most_square.sqrt(), Change::Break(bond.bond));
        }
        edges
    }

    fn add(&mut self, a: u32, b: u32, length: S, what: Change<S>) {
        self.list.push(Edge { a, b, length, what, is_longer: false });
    }

    /// Whether events may still cut the substep under way: bonds that are taut and slack by turns must not do so without
    /// end.
    pub(super) fn may_turn(&self) -> bool {
        self.turns < MOST_TURNS + 2 * self.list.len() as u32
    }

    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    pub(super) fn has_strings(&self) -> bool {
        self.list.iter().any(|edge| edge.row().is_some())
    }

    /// Whether a bond may break before a substep ends.
    pub(crate) fn has_breaks(&self) -> bool {
        self.list.iter().any(|edge| matches!(edge.what, Change::Break(_)))
    }
}
