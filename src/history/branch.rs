//! The log: a tree of branches, each with the commands that it has after it left another.

use super::command::Entry;
use super::mark::Mark;

/// A branch, to be shown.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchView {
    /// What [`super::History::to_branch`] takes.
    pub number: usize,
    /// What its last edit is called; empty where it has none.
    pub name: String,
    /// When it left the branch that it comes from [s].
    pub from: f64,
    /// How far it goes [s].
    pub end: f64,
    /// Whether the world is on it.
    pub is_present: bool,
}

/// A state of a history: on a branch, after so many of its commands, at a time [s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    pub(super) branch: usize,
    pub(super) place: usize,
    pub(super) time: f64,
}

/// The commands that were given since a branch left its parent.
#[derive(Clone, Debug, Default)]
struct Branch {
    /// The parent and how many of its commands are shared; more than the parent shares with its own.
    parent: Option<(usize, usize)>,
    own: Vec<Entry>,
    /// When it left [s].
    from: f64,
    /// How far it goes [s].
    end: f64,
    /// Of the time since it left, ascending.
    marks: Vec<Mark>,
    /// Where it was gone to from the start of all, if so.
    origin: Option<Spot>,
    /// Nothing is lost with it: it was left without an edit.
    is_barren: bool,
}

/// All branches; the first is the one that a history begins with.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    branches: Vec<Branch>,
}

impl Tree {
    pub(super) fn new(entries: Vec<Entry>, marks: Vec<Mark>, from: f64, end: f64) -> Self {
        Tree { branches: vec![Branch { own: entries, marks, from, end, ..Branch::default() }] }
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
    pub(super) fn entry(&self, mut branch: usize, place: usize) -> Option<&Entry> {
        while let Some((parent, shared)) = self.branches[branch].parent
            && place < shared
        {
            branch = parent;
        }
        self.branches[branch].own.get(place - self.shared(branch))
    }

    /// How far a branch goes [s].
    pub(super) fn end(&self, branch: usize) -> f64 {
        self.branches[branch].end
    }

    /// A branch goes at least to `time` [s].
    pub(super) fn extend_to(&mut self, branch: usize, time: f64) {
        let end = &mut self.branches[branch].end;
        *end = end.max(time);
    }

    /// A new branch that leaves another at a spot.
    pub(super) fn fork(&mut self, spot: Spot, origin: Option<Spot>) -> usize {
        let Spot { mut branch, place, time } = spot;
        // Of what both share it leaves the parent.
        while let Some((parent, shared)) = self.branches[branch].parent
            && place <= shared
        {
            branch = parent;
        }
        let parent = origin.is_none().then_some((branch, place));
        self.branches.push(Branch { parent, from: time, end: time, origin, ..Branch::default() });
        self.branches.len() - 1
    }

    /// A command is given at the end of a branch.
    pub(super) fn push(&mut self, branch: usize, entry: Entry) {
        self.branches[branch].own.push(entry);
    }

    /// How many commands two branches share from the start on.
    pub(super) fn common(&self, a: usize, b: usize) -> usize {
        let chain = |mut branch: usize| {
            let mut list = vec![(branch, usize::MAX)];
            while let Some((parent, shared)) = self.branches[branch].parent {
                list.push((parent, shared));
                branch = parent;
            }
            list
        };
        if a == b {
            return self.len(a);
        }
        let of_b = chain(b);
        let shared = chain(a).into_iter().find_map(|(branch, most)| {
            let other = of_b.iter().find(|(other, _)| *other == branch)?;
            Some(most.min(other.1).min(self.len(branch)))
        });
        shared.unwrap_or(0)
    }

    /// Where the world was before it went back to the start, where a branch goes on from there.
    pub(super) fn origin(&self, mut branch: usize) -> Option<Spot> {
        while let Some((parent, _)) = self.branches[branch].parent {
            branch = parent;
        }
        self.branches[branch].origin
    }

    /// The branch that begins at the start and that a branch comes from.
    pub(super) fn root(&self, mut branch: usize) -> usize {
        while let Some((parent, _)) = self.branches[branch].parent {
            branch = parent;
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

    /// The time of the last mark of a branch [s], its parents apart.
    pub(super) fn last_mark(&self, branch: usize) -> Option<f64> {
        self.branches[branch].marks.last().map(|mark| mark.at)
    }

    pub(super) fn mark(&mut self, branch: usize, mark: Mark) {
        self.branches[branch].marks.push(mark);
    }

    /// A branch is left: where it has no edit of its own and nothing left it, nothing is lost with it.
    pub(super) fn leave(&mut self, branch: usize) {
        let has_child = self.branches.iter().any(|other| other.parent.is_some_and(|(parent, _)| parent == branch));
        let has_edit = self.branches[branch].own.iter().any(|entry| entry.edit.is_some());
        if branch > 0 && !has_child && !has_edit {
            self.branches[branch].is_barren = true;
        }
    }

    /// A branch is gone back to.
    pub(super) fn enter(&mut self, branch: usize) {
        self.branches[branch].is_barren = false;
    }

    /// The branches that one may want to go back to.
    pub(super) fn views(&self, present: usize) -> Vec<BranchView> {
        let all = self.branches.iter().enumerate();
        let shown = all.filter(|(number, branch)| *number == present || !branch.is_barren);
        let view = |(number, branch): (usize, &Branch)| BranchView {
            number,
            name: branch.own.iter().rev().find_map(|entry| entry.name.clone()).unwrap_or_default(),
            from: branch.from,
            end: branch.end,
            is_present: number == present,
        };
        shown.map(view).collect()
    }

    pub(super) fn count(&self) -> usize {
        self.branches.len()
    }
}
