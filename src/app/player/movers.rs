//! What moves the islands of a world otherwise than by plan: how many, since when, why, and whether their own methods may have them back.

use std::sync::Arc;

use crate::history::{Do, History, SetKeys};
use crate::scene::{BudgetKeys, MethodKeys};
use crate::sim::{Dynamics, MovedBy, Solver, Why};

/// What the command is called that gives islands back to their own methods.
pub(super) const EXACT: &str = "exact motion";
/// Counted work of a frame that is never reached `[ms]`: nothing is handed over for it.
const NO_BOUND: f64 = 1e9;

/// Islands that are moved otherwise than by plan, for one reason.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moved {
    /// The reason.
    pub why: Why,
    /// How many islands.
    pub islands: usize,
    /// Since when the first of them, and the last `[s]`.
    pub since: [f64; 2],
}

/// What moves the islands of a world.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Movers {
    /// Those that are moved otherwise than by plan, by their reasons.
    pub moved: Vec<Moved>,
    /// All islands.
    pub islands: usize,
    /// Whether some of them can be given back to their own methods.
    pub can_be_exact: bool,
}

/// Who moves what in a world now.
pub(super) fn movers(world: &dyn Dynamics) -> Arc<Movers> {
    // Who is moved by whom changes seldom: where nothing was handed over, nothing is asked.
    let counters = world.counters();
    if counters.hand_overs + counters.frozen == 0 && world.contact().is_none() {
        return Arc::default();
    }
    Arc::new(sorted(&world.moved_by(), world.contact().is_some()))
}

fn sorted(list: &[MovedBy], has_contact: bool) -> Movers {
    let is_meant = |one: &&MovedBy| one.why == Why::NotFinite || (one.method == Solver::Live && one.why != Why::Plan);
    let of = |why: Why| {
        let own: Vec<&MovedBy> = list.iter().filter(is_meant).filter(|one| one.why == why).collect();
        let times = || own.iter().map(|one| one.since);
        let since = [times().fold(f64::INFINITY, f64::min), times().fold(f64::NEG_INFINITY, f64::max)];
        (!own.is_empty()).then(|| Moved { why, islands: own.iter().map(|one| one.islands).sum(), since })
    };
    let moved: Vec<Moved> = Why::ALL.into_iter().filter_map(of).collect();
    // Bodies that meet are moved by the live step alone: what is in danger there goes back by itself.
    let is_free = |one: &Moved| one.why == Why::Budget || (one.why == Why::Alarm && !has_contact);
    Movers { can_be_exact: moved.iter().any(is_free), islands: list.iter().map(|one| one.islands).sum(), moved }
}

/// The command that lets every island be moved by its own method whatever it costs: but for those that meet, where bodies do.
pub(super) fn exact(history: &History) -> Do {
    let meets = history.world().contact().is_some();
    let budget = if meets { BudgetKeys::Ms(NO_BOUND) } else { BudgetKeys::None };
    with(MethodKeys { budget: Some(budget), ..history.method() })
}

/// Whether a method is to be exact whatever it costs.
pub(super) fn is_exact(method: &MethodKeys) -> bool {
    method.budget.is_some_and(|budget| budget.ms().is_none_or(|ms| ms >= NO_BOUND))
}

/// The command that sets the keys of a method.
pub(super) fn with(method: MethodKeys) -> Do {
    Do::Set(Box::new(SetKeys { method: Some(method), ..SetKeys::default() }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::PointId;

    fn moved(method: Solver, why: Why, since: f64) -> MovedBy {
        MovedBy { first: PointId(0), count: 3, islands: 2, method, since, why }
    }

    #[test]
    fn islands_are_counted_by_their_reasons_since_the_first_and_the_last() {
        let exact = moved(Solver::Rk4, Why::Plan, 0.0);
        assert_eq!(sorted(&[exact, moved(Solver::Live, Why::Plan, 0.0)], false).moved, []);
        let list = [
            exact,
            moved(Solver::Live, Why::Budget, 3.0),
            moved(Solver::Live, Why::Budget, 2.0),
            moved(Solver::Rk4, Why::NotFinite, 4.0),
        ];
        let found = sorted(&list, false);
        let budget = Moved { why: Why::Budget, islands: 4, since: [2.0, 3.0] };
        assert_eq!(found.moved, [budget, Moved { why: Why::NotFinite, islands: 2, since: [4.0, 4.0] }]);
        assert_eq!((found.islands, found.can_be_exact), (8, true));
    }

    #[test]
    fn what_meets_cannot_be_exact_nor_what_is_in_danger_there() {
        let can = |why: Why, has_contact: bool| sorted(&[moved(Solver::Live, why, 0.0)], has_contact).can_be_exact;
        assert!(!can(Why::Contact, true) && !can(Why::Alarm, true) && can(Why::Budget, true) && can(Why::Alarm, false));
        assert!(!can(Why::NotFinite, false));
    }
}
