//! What gives way where the machine is too slow for a scene: one rung at a time, each a command of the log.
//!
//! The clock proposes, and what was taken is in the log: it is replayed to the bit. Nobody asked for it, so it is no step of undo. Below
//! the last rung a scene plays more slowly, in substeps as short as before.

use super::movers::{is_exact, with};
use crate::history::{Do, History};
use crate::scene::{BudgetKeys, MethodKeys, SolverName};
use crate::sim::{Dynamics, Method, Solver};

/// How long steps have to take more time than there is until something gives way `[s of wall time]`.
const LATE: f64 = 0.5;
/// How long what gave way is given until it is judged `[s of wall time]`.
const TRIAL: f64 = 1.0;
/// Share of the time that steps may take for the load to be gone `[1]`.
const EASY: f64 = 0.3;
/// How long it has to be gone until a rung is given back `[s of wall time]`: twice as long each time, since it may come again.
const WAIT: f64 = 5.0;
const LONGEST_WAIT: f64 = 160.0;
/// For so long after a rung was given back at rest no load counts `[s]`: another method wakes all, and half a second passes until all
/// sleep again. Without it what is slow at rest too would take the rung again and again.
const WAKING: f64 = 1.0;
/// Counted work of a frame beyond which islands are handed over where the live step is cheaper `[ms]`: almost none.
const LEAST_BUDGET: f64 = 0.01;
/// What giving back is called.
const BACK: &str = "the method of before";

/// What may give way, the first first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rung {
    /// Order 2 in place of order 4.
    Order,
    /// The live step wherever it is cheaper.
    Live,
}

/// What gave way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yielded {
    /// The rung that the world is on.
    pub rung: Rung,
    /// Since when `[s]`.
    pub since: f64,
    /// What a frame of 1/60 s took when it was taken `[s of wall time]`; `None`: a log says that it was.
    pub work: Option<f64>,
}

/// What a frame took.
#[derive(Clone, Copy, Debug)]
pub(super) struct Load {
    /// Wall time that passed `[s]`.
    pub(super) wall: f64,
    /// Wall time of its steps `[s]`.
    pub(super) steps: f64,
    /// Time that was due was dropped.
    pub(super) is_late: bool,
    /// Wall time that 1/60 s takes, about `[s]`.
    pub(super) work: f64,
}

/// Which rung a history is on, and how long it has been late or at ease.
#[derive(Clone, Debug)]
pub(super) struct Rungs {
    late: f64,
    easy: f64,
    wait: f64,
    /// What is not taken again.
    refused: Vec<Rung>,
    /// The method of the world when its log was last looked at.
    known: Option<Method>,
    yielded: Option<Yielded>,
    /// The live step would have been cheaper when order 2 was taken.
    helps_later: bool,
    /// Until when no load counts `[s]`.
    wakes_until: f64,
}

impl Rung {
    const ALL: [Rung; 2] = [Rung::Order, Rung::Live];

    /// What the command is called that takes it.
    fn name(self) -> &'static str {
        match self {
            Rung::Order => "order 2 under load",
            Rung::Live => "live step under load",
        }
    }

    /// The rung that a command takes which is called so.
    pub(super) fn of(name: &str) -> Option<Self> {
        Rung::ALL.into_iter().find(|rung| rung.name() == name)
    }

    fn method(self, before: MethodKeys) -> MethodKeys {
        match self {
            Rung::Order => MethodKeys { solver: Some(SolverName::VelocityVerlet), ..before },
            Rung::Live => MethodKeys { budget: Some(BudgetKeys::Ms(LEAST_BUDGET)), ..before },
        }
    }
}

impl Rungs {
    pub(super) fn new() -> Self {
        Rungs {
            late: 0.0,
            easy: 0.0,
            wait: WAIT,
            refused: Vec::new(),
            known: None,
            yielded: None,
            helps_later: false,
            wakes_until: f64::NEG_INFINITY,
        }
    }

    /// What gave way in the world as it is now.
    pub(super) fn yielded(&mut self, history: &History) -> Option<Yielded> {
        let method = history.world().method();
        if self.known != Some(method) {
            self.known = Some(method);
            let last = history.method_changes().next();
            let of = last.and_then(|change| Some((Rung::of(change.name?)?, change.at)));
            let work = self.yielded.and_then(|yielded| yielded.work);
            self.yielded = of.map(|(rung, since)| Yielded { rung, since, work });
        }
        self.yielded
    }

    /// The history went elsewhere: what is known of its log is known no more.
    pub(super) fn have_gone(&mut self) {
        (self.known, self.late, self.easy, self.wakes_until) = (None, 0.0, 0.0, f64::NEG_INFINITY);
    }

    /// The user took one back, and wants the motion as it was: none is taken again.
    pub(super) fn refuse_all(&mut self) {
        Rung::ALL.into_iter().for_each(|rung| self.refuse(rung));
    }

    /// A rung that cannot be taken is not tried again.
    pub(super) fn refuse(&mut self, rung: Rung) {
        self.refused.push(rung);
        self.have_gone();
    }

    /// All may be taken again.
    pub(super) fn forget(&mut self) {
        *self = Rungs::new();
    }

    /// After a frame in which time passed: the command that takes a rung or gives one back, with what it is called.
    pub(super) fn look(&mut self, history: &History, load: Load) -> Option<(Do, &'static str)> {
        if history.has_future() || history.has_undone() {
            // A log that is followed is left to itself, and what was undone may be done again.
            self.have_gone();
            return None;
        }
        let yielded = self.yielded(history);
        if history.world().time() < self.wakes_until {
            return None;
        }
        self.late = if load.is_late { self.late + load.wall } else { self.late.min(0.0) };
        self.easy = if load.steps < EASY * load.wall { self.easy + load.wall } else { 0.0 };
        if self.late >= LATE {
            self.late = LATE - TRIAL;
            return self.next(history, yielded, load.work);
        }
        if yielded.is_some() && self.easy >= self.wait {
            (self.easy, self.wait) = (0.0, (2.0 * self.wait).min(LONGEST_WAIT));
            return Some(self.back(history));
        }
        None
    }

    /// Where time passes no more: the command that gives back at once what gave way, with what it is called. Steps that are not taken load
    /// nothing.
    pub(super) fn rest(&mut self, history: &History) -> Option<(Do, &'static str)> {
        if history.has_future() || history.has_undone() {
            return None;
        }
        self.yielded(history)?;
        (self.late, self.easy) = (0.0, 0.0);
        self.wakes_until = history.world().time() + WAKING;
        Some(self.back(history))
    }

    /// The command that brings the method of before back.
    pub(super) fn back(&self, history: &History) -> (Do, &'static str) {
        (with(before(history)), BACK)
    }

    fn next(&mut self, history: &History, yielded: Option<Yielded>, work: f64) -> Option<(Do, &'static str)> {
        let before = before(history);
        let is_meant = before.solver.is_none_or(|solver| solver == SolverName::Auto) && !is_exact(&before);
        if !is_meant || history.scene().method.tolerance.is_some() {
            return None;
        }
        let world = history.world();
        let last = yielded.map(|yielded| yielded.rung);
        let helps = |rung: &Rung| match rung {
            Rung::Order => is_of_order_4(world),
            Rung::Live => world.is_cheaper_live() || (last == Some(Rung::Order) && self.helps_later),
        };
        let rungs = Rung::ALL.into_iter().filter(|rung| last.is_none_or(|last| *rung > last));
        let rung = rungs.filter(|rung| !self.refused.contains(rung)).find(helps)?;
        self.helps_later = world.is_cheaper_live();
        // What is known of the log is looked at anew after the command.
        self.known = None;
        self.yielded = Some(Yielded { rung, since: world.time(), work: Some(work) });
        Some((with(rung.method(before)), rung.name()))
    }
}

/// The method without what gave way.
fn before(history: &History) -> MethodKeys {
    let own = history.method_changes().find(|change| change.name.and_then(Rung::of).is_none());
    own.map_or_else(|| history.first_method(), |change| change.keys.clone())
}

/// Whether all that moves does so by one method of order 4: among others the one substep of a method that is asked for by name may be
/// dearer than theirs.
fn is_of_order_4(world: &dyn Dynamics) -> bool {
    let moving: Vec<Solver> = world.parts().iter().map(|part| part.solver).filter(|&s| s != Solver::Flight).collect();
    world.contact().is_none() && matches!(moving[..], [Solver::Rk4 | Solver::Pefrl])
}
