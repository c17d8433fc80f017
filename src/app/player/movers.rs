//! What moves the islands of a world, in a word or two.

use std::sync::Arc;

use crate::sim::{Dynamics, MovedBy, Solver, Why};

/// Why the live step moves what it moves; empty where all islands are moved by their own methods, or as the scene asks for.
pub(super) fn movers(world: &dyn Dynamics) -> Arc<str> {
    // Who is moved by whom changes seldom: where nothing was handed over, nothing is asked.
    if world.counters().hand_overs == 0 && world.contact().is_none() {
        return Arc::default();
    }
    words(&world.moved_by()).into()
}

fn words(list: &[MovedBy]) -> String {
    let why = |why: Why| match why {
        Why::Plan => None,
        Why::Budget => Some("too much work"),
        Why::Contact => Some("contact"),
        Why::Alarm => Some("unstable"),
    };
    let live: Vec<&MovedBy> =
        list.iter().filter(|moved| moved.method == Solver::Live && why(moved.why).is_some()).collect();
    let mut causes: Vec<&str> = live.iter().filter_map(|moved| why(moved.why)).collect();
    causes.sort_unstable();
    causes.dedup();
    match live.len() {
        0 => String::new(),
        count if count == list.len() => causes.join(", "),
        count => format!("{count} of {}: {}", list.len(), causes.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::PointId;

    #[test]
    fn causes_are_named_once_and_parts_counted() {
        let of = |method: Solver, why: Why| MovedBy { first: PointId(0), count: 3, method, since: 1.0, why };
        let (exact, budget) = (of(Solver::Rk4, Why::Plan), of(Solver::Live, Why::Budget));
        assert_eq!(words(&[exact]), "");
        assert_eq!(words(&[budget, budget]), "too much work");
        assert_eq!(words(&[exact, budget, of(Solver::Live, Why::Alarm)]), "2 of 3: too much work, unstable");
        assert_eq!(words(&[of(Solver::Live, Why::Plan)]), "");
    }
}
