//! The log: a tree of branches, each with the commands that it has after it left another.

mod views;

use std::cmp::Ordering;

use super::command::{Do, Entry};
use super::mark::Mark;
pub use views::BranchView;

/// A state of a history: on a branch, after so many of its commands, at a time `[s]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    pub(super) branch: usize,
    pub(super) place: usize,
    pub(super) time: f64,
}

/// A branch that another comes from, and how many of its commands the other has.
type Shared = (usize, usize);

/// Where a branch was gone to last by undo or redo.
#[derive(Clone, Copy, Debug)]
struct Left {
    place: usize,
    time: f64,
    /// The branch on which time went on from there.
    by: Option<usize>,
}

/// The commands that were given since a branch left its parent.
#[derive(Clone, Debug, Default)]
struct Branch {
    /// The parent and how many of its commands are shared; more than the parent shares with its own.
    parent: Option<Shared>,
    /// Another that it comes from, at a distance that makes any way up short: see [`Tree::fork`].
    jump: Option<Shared>,
    /// How many branches it comes from.
    depth: usize,
    own: Vec<Entry>,
    /// Places in `own` of commands that are part of an edit, ascending.
    edits: Vec<usize>,
    /// When it left `[s]`.
    from: f64,
    /// How far it goes `[s]`.
    end: f64,
    /// Of the time since it left, ascending.
    marks: Vec<Mark>,
    /// Where it was gone to its beginning from, if it began anew, and how many commands were taken along.
    origin: Option<Spot>,
    taken_along: usize,
    /// The last branch on the way here that began anew, or else the first.
    anew: usize,
    /// `None`: it is left at its end.
    left: Option<Left>,
    /// It was followed until something else was done before the last of what was done on it.
    is_taken_over: bool,
    /// What somebody calls it.
    title: Option<String>,
    /// It is not wanted any more: it is not listed.
    is_discarded: bool,
}

/// All branches; the first is the one that a history begins with.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    branches: Vec<Branch>,
}

impl Tree {
    pub(super) fn new(entries: Vec<Entry>, marks: Vec<Mark>, from: f64, end: f64) -> Self {
        let edits = edits_of(&entries);
        Tree { branches: vec![Branch { own: entries, edits, marks, from, end, ..Branch::default() }] }
    }

    /// How many commands of its parent a branch has.
    fn shared(&self, branch: usize) -> usize {
        self.branches[branch].parent.map_or(0, |(_, shared)| shared)
    }

    /// How many commands a branch has from the start on.
    pub(super) fn len(&self, branch: usize) -> usize {
        self.shared(branch) + self.branches[branch].own.len()
    }

    /// Command `place` of a branch.
    pub(super) fn entry(&self, branch: usize, place: usize) -> Option<&Entry> {
        let owner = self.way_to(branch, place).last().unwrap_or(branch);
        self.branches[owner].own.get(place - self.shared(owner))
    }

    /// The branches that are looked at from one up to that which command `place` of it was given on.
    ///
    /// Accuracy: at most 3 log2 of the depth, which a test counts.
    fn way_to(&self, branch: usize, place: usize) -> impl Iterator<Item = usize> {
        let is_beyond = move |&branch: &usize| self.shared(branch) > place;
        std::iter::successors(Some(branch), move |branch| {
            let Branch { parent, jump, .. } = &self.branches[*branch];
            let far = jump.map(|(far, _)| far).filter(is_beyond);
            far.or(parent.map(|(parent, _)| parent)).filter(|_| is_beyond(branch))
        })
    }

    /// How far a branch goes `[s]`.
    pub(super) fn end(&self, branch: usize) -> f64 {
        self.branches[branch].end
    }

    /// A branch goes at least to `time` `[s]`.
    pub(super) fn extend_to(&mut self, branch: usize, time: f64) {
        let Branch { end, left, .. } = &mut self.branches[branch];
        if time > *end {
            (*end, *left) = (time, None);
        }
    }

    /// A new branch from a spot, which was gone to from `origin` with these commands: the start of all, or a spot after some command.
    pub(super) fn begin_anew(&mut self, spot: Spot, origin: Spot, own: Vec<Entry>) -> usize {
        let branch = match spot.place {
            0 => {
                self.branches.push(Branch { from: spot.time, end: spot.time, ..Branch::default() });
                self.branches.len() - 1
            }
            _ => self.fork(spot),
        };
        let (taken_along, origin, edits) = (own.len(), Some(origin), edits_of(&own));
        let forked = std::mem::take(&mut self.branches[branch]);
        self.branches[branch] = Branch { origin, own, edits, taken_along, anew: branch, ..forked };
        branch
    }

    /// A new branch that leaves another at a spot.
    pub(super) fn fork(&mut self, spot: Spot) -> usize {
        let Spot { branch, place, time } = spot;
        // Of what both share it leaves the parent.
        let owner = place.checked_sub(1).and_then(|last| self.way_to(branch, last).last());
        let owner = owner.unwrap_or_else(|| self.root(branch));
        let parent = (owner, place);
        let depth = self.branches[owner].depth + 1;
        let (jump, anew) = (Some(self.jump(parent)), self.branches[owner].anew);
        let parent = Some(parent);
        self.branches.push(Branch { parent, jump, depth, anew, from: time, end: time, ..Branch::default() });
        self.branches.len() - 1
    }

    /// Where a child of a branch jumps to: twice as far as its parent, where the last two jumps above are as far as each other.
    ///
    /// Source: E. W. Myers, An applicative random-access stack, Information Processing Letters 17 (1983): lists whose k-th element
    /// is found in log k.
    fn jump(&self, parent: Shared) -> Shared {
        let depth = |branch: usize| self.branches[branch].depth;
        let Some(first) = self.branches[parent.0].jump else { return parent };
        match self.branches[first.0].jump {
            Some(second) if depth(parent.0) - depth(first.0) == depth(first.0) - depth(second.0) => second,
            _ => parent,
        }
    }

    /// Whether the last command of a branch was at that time `[s]`, or before.
    fn ends_by(&self, branch: usize, time: f64) -> bool {
        let last = self.len(branch).checked_sub(1).and_then(|last| self.entry(branch, last));
        last.is_none_or(|last| last.at <= time)
    }

    /// A command is given at the end of a branch. Marks of its time and later ones were of a motion without it.
    pub(super) fn push(&mut self, branch: usize, entry: Entry) {
        // A file whose times do not ascend is refused.
        debug_assert!(self.ends_by(branch, entry.at), "a command at {} s comes after later ones", entry.at);
        let Branch { own, edits, marks, left, is_discarded, .. } = &mut self.branches[branch];
        (*left, *is_discarded) = (None, false);
        marks.truncate(marks.partition_point(|mark| mark.at < entry.at));
        edits.extend(entry.edit.map(|_| own.len()));
        own.push(entry);
    }

    /// The last command before `place` of a branch that is part of an edit. Few commands are: those of the cursor are not looked at.
    pub(super) fn edit_before(&self, mut branch: usize, mut place: usize) -> Option<usize> {
        loop {
            let (shared, Branch { edits, parent, .. }) = (self.shared(branch), &self.branches[branch]);
            let count = edits.partition_point(|own| shared + own < place);
            if let Some(last) = edits[..count].last() {
                return Some(shared + last);
            }
            let (above, of_above) = (*parent)?;
            (branch, place) = (above, place.min(of_above));
        }
    }

    /// The first command from `place` of a branch on that is part of an edit, likewise.
    pub(super) fn edit_from(&self, mut branch: usize, place: usize) -> Option<usize> {
        let (mut found, mut end) = (None, usize::MAX);
        loop {
            let (shared, Branch { edits, parent, .. }) = (self.shared(branch), &self.branches[branch]);
            let first = edits[edits.partition_point(|own| shared + own < place)..].first();
            // What is nearer to the start comes first.
            found = first.map(|own| shared + own).filter(|&first| first < end).or(found);
            match *parent {
                Some((above, of_above)) if place < of_above => (branch, end) = (above, end.min(of_above)),
                _ => return found,
            }
        }
    }

    /// How many commands two branches share from the start on.
    pub(super) fn common(&self, a: usize, b: usize) -> usize {
        let mut both = [(a, usize::MAX), (b, usize::MAX)];
        while both[0].0 != both[1].0 {
            let Some(next) = self.up(both) else { return 0 };
            both = next;
        }
        let [(branch, by_a), (_, by_b)] = both;
        by_a.min(by_b).min(self.len(branch))
    }

    /// From two branches to two that they come from, nearer to the last that both come from; `None`: there is no such branch.
    ///
    /// Accuracy: at most 3 log2 of the depth of these until both are one, which a test counts.
    fn up(&self, [a, b]: [Shared; 2]) -> Option<[Shared; 2]> {
        let depth = |(branch, _): Shared| self.branches[branch].depth;
        let [of_a, of_b] = [a, b].map(|(branch, _)| &self.branches[branch]);
        Some(match depth(a).cmp(&depth(b)) {
            Ordering::Less => [a, of_b.jump.filter(|&far| depth(far) >= depth(a)).or(of_b.parent)?],
            Ordering::Greater => [of_a.jump.filter(|&far| depth(far) >= depth(b)).or(of_a.parent)?, b],
            Ordering::Equal => {
                let far = of_a.jump.zip(of_b.jump).filter(|(a, b)| a.0 != b.0);
                far.or(of_a.parent.zip(of_b.parent))?.into()
            }
        })
    }

    /// Where the world was before it went back to where a branch began anew.
    pub(super) fn origin(&self, branch: usize) -> Option<Spot> {
        self.branches[self.branches[branch].anew].origin
    }

    /// Where a branch began anew, after what was taken along then.
    pub(super) fn anew(&self, branch: usize) -> Spot {
        let branch = self.branches[branch].anew;
        let Branch { taken_along, from, .. } = self.branches[branch];
        Spot { branch, place: self.shared(branch) + taken_along, time: from }
    }

    /// The branch that begins at the start and that a branch comes from.
    fn root(&self, mut branch: usize) -> usize {
        while let Some((far, _)) = self.branches[branch].jump {
            branch = far;
        }
        branch
    }

    /// The marks along a branch, ascending.
    pub(super) fn marks(&self, branch: usize) -> Vec<Mark> {
        let mut parts = vec![&self.branches[branch].marks[..]];
        let mut child = branch;
        while let Some((parent, shared)) = self.branches[child].parent {
            let marks = &self.branches[parent].marks;
            // A mark is after the commands of its time: of the first that this branch has not, it is another's.
            let next = self.entry(parent, shared).map_or(f64::INFINITY, |entry| entry.at);
            let left = self.branches[child].from.min(next);
            parts.push(&marks[..marks.partition_point(|mark| mark.at < left)]);
            child = parent;
        }
        parts.into_iter().rev().flatten().cloned().collect()
    }

    /// The time of the last mark of a branch `[s]`, its parents apart.
    pub(super) fn last_mark(&self, branch: usize) -> Option<f64> {
        self.branches[branch].marks.last().map(|mark| mark.at)
    }

    pub(super) fn mark(&mut self, branch: usize, mark: Mark) {
        self.branches[branch].marks.push(mark);
    }

    /// Undo or redo leads to a spot: there its branch is left, until time goes on.
    pub(super) fn leave_at(&mut self, Spot { branch, place, time }: Spot) {
        self.branches[branch].left = Some(Left { place, time, by: None });
    }

    /// Time goes on along another branch from where undo or redo led to.
    pub(super) fn go_on(&mut self, branch: usize, along: usize) {
        if let Some(left) = &mut self.branches[branch].left {
            left.by = Some(along);
        }
    }

    /// The branch that something was done on last, of the commands of a branch from `place` on: an edit of its own, or what was driven or
    /// dragged. Where the cursor went is nothing done.
    pub(super) fn done_from(&self, branch: usize, place: usize) -> Option<usize> {
        let is_done = |&place: &usize| {
            let is_own = place >= self.shared(branch);
            self.entry(branch, place).is_some_and(|entry| match entry.act {
                Do::Key { .. } | Do::Grab(_) | Do::Release if entry.edit.is_none() => true,
                _ => is_own && does_something(entry),
            })
        };
        let last = (place..self.len(branch)).rev().find(is_done)?;
        Some(self.way_to(branch, last).last().unwrap_or(branch))
    }

    /// A branch that was followed is left before the last of what was done on it, for something else.
    pub(super) fn take_over(&mut self, branch: usize) {
        self.branches[branch].is_taken_over = true;
    }

    /// A branch is followed up to a spot: beyond where it was left it is not left there any more.
    pub(super) fn pass(&mut self, Spot { branch, place, time }: Spot) {
        self.branches[branch].left.take_if(|left| place > left.place || time > left.time);
    }

    /// Where a branch was left, as who is on `present` comes back to it: at its end, or where undo and redo led to and on from there, if
    /// nothing was done there since.
    pub(super) fn where_left(&self, branch: usize, present: usize) -> Spot {
        let at_end = |branch: usize| Spot { branch, place: usize::MAX, time: self.end(branch) };
        let along = |&branch: &usize| self.branches[branch].left.and_then(|left| left.by);
        // Each comes after the one before it.
        let on: Vec<usize> = std::iter::successors(along(&branch), along).collect();
        let last = on.last().copied().unwrap_or(branch);
        let is_something = |&other: &usize| self.last_edit(other).is_some() || self.branches[other].is_taken_over;
        if on.iter().any(|other| *other == present || is_something(other)) {
            return at_end(branch);
        }
        self.branches[last].left.map_or(at_end(last), |Left { place, time, .. }| Spot { branch: last, place, time })
    }

    /// The place of the last edit that was done on a branch and on none that it comes from.
    fn last_edit(&self, branch: usize) -> Option<usize> {
        let Branch { edits, taken_along, .. } = &self.branches[branch];
        edits.last().filter(|own| *own >= taken_along).map(|own| self.shared(branch) + own)
    }

    pub(super) fn count(&self) -> usize {
        self.branches.len()
    }
}

/// Whether somebody did something by a command: the way of the cursor is nothing done, nor are numbers that nobody asked for.
fn does_something(entry: &Entry) -> bool {
    // Files need not say which commands are one edit.
    !matches!(entry.act, Do::Cursor { .. } | Do::Mouse(_) | Do::Set(_)) || entry.edit.is_some()
}

/// Places of commands that are part of an edit.
fn edits_of(entries: &[Entry]) -> Vec<usize> {
    entries.iter().enumerate().filter(|(_, entry)| entry.edit.is_some()).map(|(place, _)| place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::Reach;

    fn entry(at: f64) -> Entry {
        Entry { at, act: Do::Release, edit: Some(at as u64), name: None }
    }

    /// Rounds of two edits and one undo: each leaves a branch that comes from all before.
    fn nested(rounds: usize) -> (Tree, usize) {
        let mut tree = Tree::new(Vec::new(), Vec::new(), 0.0, 0.0);
        let mut branch = 0;
        for round in 0..rounds {
            let place = tree.len(branch).saturating_sub(1);
            branch = tree.fork(Spot { branch, place, time: round as f64 });
            tree.push(branch, entry(round as f64));
            tree.push(branch, entry(round as f64));
        }
        (tree, branch)
    }

    /// The branch that a command was given on, parent by parent.
    fn owner(tree: &Tree, mut branch: usize, place: usize) -> usize {
        while let Some((parent, shared)) = tree.branches[branch].parent
            && place < shared
        {
            branch = parent;
        }
        branch
    }

    #[test]
    fn ways_up_through_thousands_of_branches_are_a_few_steps() {
        const ROUNDS: usize = 3000;
        let (tree, last) = nested(ROUNDS);
        assert_eq!((last, tree.len(last)), (ROUNDS, ROUNDS + 1));
        // 3 log2(3000) = 34.6.
        for place in 0..ROUNDS {
            let way: Vec<usize> = tree.way_to(last, place).collect();
            assert_eq!(way.last(), Some(&owner(&tree, last, place)), "{place}");
            assert!(way.len() <= 35, "{place}: {} branches are looked at", way.len());
        }
        for other in (1..ROUNDS).step_by(7) {
            let (mut both, mut steps) = ([(last, usize::MAX), (other, usize::MAX)], 0);
            while both[0].0 != both[1].0 {
                both = tree.up(both).unwrap();
                steps += 1;
            }
            assert!(steps <= 35, "{other}: {steps} steps");
            assert_eq!(tree.common(other, last), other);
        }
    }

    #[test]
    fn branches_have_in_common_what_both_have_from_the_start_on() {
        let mut tree = Tree::new((0..5).map(|k| entry(f64::from(k))).collect(), Vec::new(), 0.0, 5.0);
        let mut random = 1_u64;
        let mut below = |count: usize| {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (random >> 33) as usize % count
        };
        for number in 0..200 {
            let branch = below(tree.count());
            let spot = Spot { branch, place: below(tree.len(branch) + 1), time: 0.0 };
            let branch = match number % 50 {
                49 => tree.begin_anew(Spot { place: 0, ..spot }, spot, vec![entry(0.0)]),
                24 => tree.begin_anew(spot, spot, vec![entry(0.0)]),
                _ => tree.fork(spot),
            };
            for _ in 0..below(4) {
                tree.push(branch, entry(5.0 + f64::from(number)));
            }
        }
        // What a command is: the branch that it was given on, and where.
        let tree = &tree;
        let all = |branch: usize| (0..tree.len(branch)).map(move |place| (owner(tree, branch, place), place));
        for a in 0..tree.count() {
            for b in 0..tree.count() {
                let shared = all(a).zip(all(b)).take_while(|(a, b)| a == b).count();
                assert_eq!(tree.common(a, b), shared, "{a} and {b}");
            }
            assert!(all(a).all(|(owner, place)| tree.way_to(a, place).last() == Some(owner)), "{a}");
        }
    }

    #[test]
    fn branches_that_others_have_all_edits_of_are_not_listed() {
        let mut tree = Tree::new((0..3).map(|k| entry(f64::from(k))).collect(), Vec::new(), 0.0, 5.0);
        let listed = |tree: &Tree, present: usize, redone: &[Shared]| -> Vec<usize> {
            tree.views(present, redone.iter().copied()).iter().map(|view| view.number).collect()
        };
        // Undone twice while time ran: only redo has the edits, and the present branch none.
        let first = tree.fork(Spot { branch: 0, place: 2, time: 5.0 });
        let second = tree.fork(Spot { branch: first, place: 1, time: 6.0 });
        assert_eq!(listed(&tree, second, &[(0, 3), (first, 2)]), [second]);
        // Something else is done: what was undone is nowhere else.
        tree.push(second, entry(7.0));
        assert_eq!(listed(&tree, second, &[]), [0, second]);
        // All of that is done in a later one too, by way of one that has nothing of its own.
        let on = tree.fork(Spot { branch: second, place: 2, time: 8.0 });
        let later = tree.fork(Spot { branch: on, place: 2, time: 9.0 });
        tree.push(later, entry(9.0));
        assert_eq!(listed(&tree, 0, &[]), [0, later]);
        assert_eq!(listed(&tree, second, &[]), [0, second, later], "the present one is listed");
        tree.take_over(0);
        assert_eq!(listed(&tree, later, &[(0, 3)]), [0, later], "what was followed until something else was done is");
    }

    #[test]
    fn what_was_driven_or_dragged_is_something_done_and_the_way_of_the_cursor_is_not() {
        let aside = |at: f64, act: Do| Entry { edit: None, act, ..entry(at) };
        let cursor = |at: f64| aside(at, Do::Cursor { to: None, by: None });
        let mut tree = Tree::new(vec![entry(0.0), cursor(1.0)], Vec::new(), 0.0, 5.0);
        assert_eq!([0, 1, 2].map(|place| tree.done_from(0, place)), [Some(0), None, None]);
        let first = tree.fork(Spot { branch: 0, place: 1, time: 1.0 });
        [cursor(1.0), aside(2.0, Do::Grab(Reach::Within(1.0))), cursor(3.0)]
            .into_iter()
            .for_each(|entry| tree.push(first, entry));
        assert_eq!([0, 2, 3].map(|place| tree.done_from(first, place)), [Some(first), Some(first), None]);
        // What it was done on has it, whatever comes after it.
        let on = tree.fork(Spot { branch: first, place: 4, time: 4.0 });
        tree.push(on, cursor(5.0));
        assert_eq!([1, 3].map(|place| tree.done_from(on, place)), [Some(first), None]);
        // Of what undo left an edit is no one else's.
        let undone = tree.fork(Spot { branch: 0, place: 1, time: 6.0 });
        tree.push(undone, cursor(6.0));
        let pin = Entry { act: Do::Pin(Vec::new()), ..entry(7.0) };
        tree.push(undone, pin);
        let later = tree.fork(Spot { branch: undone, place: 3, time: 8.0 });
        assert_eq!([undone, later].map(|branch| tree.done_from(branch, 1)), [Some(undone), None]);
        let listed =
            |tree: &Tree| tree.views(later, std::iter::empty()).iter().map(|view| view.number).collect::<Vec<_>>();
        assert!(!listed(&tree).contains(&first));
        tree.take_over(first);
        assert!(listed(&tree).contains(&first));
    }

    #[test]
    fn a_branch_that_was_left_before_it_began_is_listed_with_its_own_edit() {
        let mut tree = Tree::new(Vec::new(), Vec::new(), 0.0, 5.0);
        let branch = tree.fork(Spot { branch: 0, place: 0, time: 3.0 });
        tree.push(branch, Entry { name: Some("pin".to_owned()), ..entry(3.0) });
        tree.extend_to(branch, 4.0);
        let seen = |tree: &Tree| tree.views(0, std::iter::empty()).pop().map(|view| (view.name, view.from, view.end));
        assert_eq!(seen(&tree), Some(("pin".to_owned(), 3.0, 4.0)));
        tree.leave_at(Spot { branch, place: 0, time: 2.0 });
        assert_eq!(seen(&tree), Some(("pin".to_owned(), 2.0, 2.0)));
    }

    #[test]
    fn what_is_given_anew_ends_the_marks_of_what_was_there() {
        let mark = |at: f64| Mark { at, hash: String::new() };
        let mut tree = Tree::new(Vec::new(), vec![mark(1.0), mark(2.0), mark(3.0)], 0.0, 3.0);
        tree.push(0, entry(2.0));
        assert_eq!(tree.marks(0), [mark(1.0)]);
    }

    #[test]
    fn edits_before_and_after_a_place_are_found_along_all_branches() {
        let (mut tree, mut branch) = nested(12);
        let aside = Entry { edit: None, ..entry(20.0) };
        for round in 0..6 {
            (0..3).for_each(|_| tree.push(branch, aside.clone()));
            branch = tree.fork(Spot { branch, place: tree.len(branch) - round % 2, time: 20.0 });
            tree.push(branch, if round % 3 == 0 { entry(20.0) } else { aside.clone() });
        }
        let is_edit = |place: &usize| tree.entry(branch, *place).is_some_and(|entry| entry.edit.is_some());
        for place in 0..=tree.len(branch) {
            assert_eq!(tree.edit_before(branch, place), (0..place).rev().find(is_edit), "before {place}");
            assert_eq!(tree.edit_from(branch, place), (place..tree.len(branch)).find(is_edit), "from {place}");
        }
    }
}
