//! A step that is cut: groups as they were before it, for all that no command touches take it whole afterwards.

use super::World;
use crate::sim::group::Group;
use crate::sim::real::Real;

/// A group as it was before the step under way was cut.
#[derive(Clone, Debug)]
pub(crate) struct Kept<S: Real, const D: usize> {
    place: usize,
    /// When `[s]`.
    from: f64,
    pub(super) group: Group<S, D>,
}

impl<S: Real, const D: usize> World<S, D> {
    /// Keeps the groups that are awake; those of a list since the times there `[s]`, the others since now.
    pub(crate) fn keep(&mut self, since: &[(usize, f64)]) {
        let now = self.timeline.time();
        let from = |place: usize| since.binary_search_by_key(&place, |kept| kept.0).map_or(now, |found| since[found].1);
        let awake = self.plan.groups.iter().enumerate().filter(|(_, group)| !group.is_asleep());
        self.kept = awake.map(|(place, group)| Kept { place, from: from(place), group: group.clone() }).collect();
    }

    /// Groups that no command touched are as they were before the step was cut. Returns their places, ascending, and since when `[s]`.
    pub(crate) fn take_back(&mut self) -> Vec<(usize, f64)> {
        let restore = |Kept { place, from, group }: Kept<S, D>| {
            self.plan.groups[place] = group;
            (place, from)
        };
        std::mem::take(&mut self.kept).into_iter().map(restore).collect()
    }

    /// A command changes a group: what it did of the step under way is done.
    pub(crate) fn touch(&mut self, place: usize) {
        self.kept.retain(|kept| kept.place != place);
    }

    /// The groups that are kept and that the cursor may reach within the step under way.
    pub(crate) fn kept_in_reach(&self) -> Vec<usize> {
        let is_reached =
            |kept: &&Kept<S, D>| kept.group.may_be_reached(&self.around, (kept.from, self.timeline.left(kept.from)));
        self.kept.iter().filter(is_reached).map(|kept| kept.place).collect()
    }

    /// What is kept knows of the mouse force that there is now.
    pub(crate) fn tell_kept(&mut self) {
        let World { kept, around, .. } = self;
        kept.iter_mut().for_each(|kept| kept.group.mark_inside(around, kept.from));
    }
}
