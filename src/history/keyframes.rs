//! Keyframes: copies of the world that going back starts from, in a bounded number of bytes.

use super::branch::{Spot, Tree};
use super::frame::Frame;

/// Bytes that keyframes may take unless another bound is set.
pub(super) const MOST_BYTES: usize = 512 << 20;

/// Scene time between two keyframes at most, where copies are cheap `[s]`: what is gone back to is shown as if it ran.
const TIME_BETWEEN: f64 = 0.1;
/// Counted work between two keyframes at most, where copies are cheap `[s]`: the exact state of any time is there in a tenth of a second.
const EFFORT_BETWEEN: f64 = 0.08;
/// Work beside a copy, at least: recording takes a hundredth of it.
const WORK_FOR_A_COPY: f64 = 100.0;
/// What a copy takes `[s]` for each byte.
const COPY: f64 = 2.5e-10;

/// A copy with its place.
pub(super) struct Keyframe {
    pub(super) branch: usize,
    pub(super) time: f64,
    pub(super) frame: Frame,
    bytes: usize,
    /// The last step was cut short for the command that comes next: another branch has not been here.
    is_cut: bool,
}

/// When the last copy was taken, or the present was come to.
#[derive(Clone, Copy)]
pub(super) struct Kept {
    /// The work until then `[s]`.
    effort: f64,
    /// `[s]`
    time: f64,
}

impl Kept {
    pub(super) fn at(frame: &Frame) -> Self {
        Kept { effort: frame.effort.seconds(), time: frame.world.time() }
    }
}

/// Copies, in the order in which they were taken.
pub(super) struct Keyframes {
    list: Vec<Keyframe>,
    bytes: usize,
    most_bytes: usize,
    taken: u64,
}

impl Keyframes {
    pub(super) fn new() -> Self {
        Keyframes { list: Vec::new(), bytes: 0, most_bytes: MOST_BYTES, taken: 0 }
    }

    /// Bytes that all copies take.
    pub(super) fn bytes(&self) -> usize {
        self.bytes
    }

    /// Bytes of the last copy that was taken.
    fn last_bytes(&self) -> usize {
        self.list.last().map_or(0, |kept| kept.bytes)
    }

    /// Another bound of the bytes.
    pub(super) fn bound(&mut self, most_bytes: usize, now: f64) {
        self.most_bytes = most_bytes;
        self.thin(now);
    }

    /// Keeps a copy of a frame of a branch.
    pub(super) fn keep(&mut self, branch: usize, frame: Frame, is_cut: bool) {
        let (time, place) = (frame.world.time(), frame.place);
        let is_same = |kept: &Keyframe| kept.branch == branch && kept.time == time && kept.frame.place == place;
        if self.list.iter().rev().take(16).any(is_same) {
            return;
        }
        let bytes = frame.world.heap_bytes() + size_of::<Keyframe>();
        self.bytes += bytes;
        self.list.push(Keyframe { branch, time, frame, bytes, is_cut });
        self.taken += 1;
        if self.taken.is_multiple_of(SPREAD_EVERY) {
            self.spread(time);
        }
        self.thin(time);
    }

    /// Keeps a copy where enough was done since the last one that a copy costs little beside it.
    pub(super) fn keep_now_and_then(&mut self, last: &mut Kept, branch: usize, frame: &Frame) {
        let now = Kept::at(frame);
        let done = now.effort - last.effort;
        let is_due = now.time - last.time >= TIME_BETWEEN || done >= EFFORT_BETWEEN;
        if is_due && done >= WORK_FOR_A_COPY * COPY * self.last_bytes() as f64 {
            *last = now;
            self.keep(branch, frame.clone(), false);
        }
    }

    /// Drops copies until the bytes are within their bound: those first whose neighbours are near, and long ago. The first of all
    /// stays.
    fn thin(&mut self, now: f64) {
        while self.bytes > self.most_bytes && self.list.len() > 2 {
            let times: Vec<f64> = self.list.iter().map(|kept| kept.time).collect();
            let score = |k: &usize| {
                let next = times.get(k + 1).copied().unwrap_or(now);
                let gap = (next - times[k - 1]).abs();
                gap / (now - times[*k]).abs().max(RECENT)
            };
            let Some(least) = (1..self.list.len()).min_by(|a, b| score(a).total_cmp(&score(b))) else { return };
            self.bytes -= self.list.remove(least).bytes;
        }
    }

    /// Of times long ago fewer copies do: those are dropped whose neighbours are near.
    fn spread(&mut self, now: f64) {
        let mut k = 1;
        while k + 1 < self.list.len() {
            let [before, this, after] = [&self.list[k - 1], &self.list[k], &self.list[k + 1]];
            let is_between = before.branch == this.branch && this.branch == after.branch && before.time <= this.time;
            let gap = after.time - before.time;
            let effort = after.frame.effort.seconds() - before.frame.effort.seconds();
            let is_near = (0.0..=LONG_AGO_BETWEEN).contains(&gap) && effort <= LONG_AGO_EFFORT;
            if now - this.time > RECENT && is_between && is_near {
                self.bytes -= self.list.remove(k).bytes;
            } else {
                k += 1;
            }
        }
    }

    /// The last copy that a branch has been at, at or before a spot of it.
    pub(super) fn before(&self, tree: &Tree, spot: Spot) -> Option<&Keyframe> {
        let mut best: Option<&Keyframe> = None;
        // The newest first: of others only those are looked at along their branches that would be better.
        for kept in self.list.iter().rev() {
            let (place, most) = (kept.frame.place, spot.place);
            let is_before = kept.time <= spot.time && place + usize::from(kept.is_cut) <= most;
            if is_before && best.is_none_or(|best| kept.is_after(best)) && kept.is_on(tree, spot.branch) {
                best = Some(kept);
            }
        }
        best
    }

    /// The copies that a branch has been at, from the last at or before `from` `[s]` on up to a spot of it, ascending in time: the last of
    /// each time.
    pub(super) fn along(&self, tree: &Tree, spot: Spot, from: f64) -> Vec<&Keyframe> {
        let is_on = |kept: &&Keyframe| {
            let is_before = kept.time <= spot.time && kept.frame.place + usize::from(kept.is_cut) <= spot.place;
            is_before && kept.is_on(tree, spot.branch)
        };
        let mut list: Vec<&Keyframe> = self.list.iter().filter(is_on).collect();
        list.sort_by(|a, b| a.time.total_cmp(&b.time).then(b.frame.place.cmp(&a.frame.place)));
        list.dedup_by(|later, kept| later.time == kept.time);
        let first = list.partition_point(|kept| kept.time <= from).saturating_sub(1);
        list.split_off(first)
    }
}

/// Time between the neighbours of a copy of long ago at most that is dropped `[s]`: what is shown at once is not far from what is meant.
const LONG_AGO_BETWEEN: f64 = 2.0;

/// Counted work between them at most `[s]`: the exact state of any time is there in a second.
const LONG_AGO_EFFORT: f64 = 0.8;

/// Copies that are taken between two times that old ones are dropped.
const SPREAD_EVERY: u64 = 64;

/// Times that lie no longer back than this are all as near `[s]`.
const RECENT: f64 = 60.0;

impl Keyframe {
    fn is_after(&self, other: &Keyframe) -> bool {
        (self.time, self.frame.place) > (other.time, other.frame.place)
    }

    /// Whether a branch came through this state.
    fn is_on(&self, tree: &Tree, branch: usize) -> bool {
        let place = self.frame.place;
        if self.branch != branch {
            let common = tree.common(self.branch, branch);
            if common < place || (self.is_cut && common == place) {
                return false;
            }
        }
        tree.entry(branch, place).is_none_or(|next| next.at >= self.time)
    }
}
