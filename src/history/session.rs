//! The history of a running world.

use std::sync::Arc;

use serde_json::Value;

use super::beside::Companion;
use super::branch::{BranchView, Spot, Tree};
use super::clock::Clock;
use super::command::{Do, Entry};
use super::discard::Discard;
use super::dress::Group;
use super::error::{HistoryError, Refusal};
use super::frame::Frame;
use super::keyframes::{Kept, Keyframes};
use super::mark::{Mark, hash_now};
use super::start::{Recording, Start};
use super::undo::Redo;
use crate::picture::{Skin, Tint};
use crate::scene::{LabelKeys, Scene};
use crate::sim::{Applied, Dynamics};

/// A running world with its past: a start, the commands that were given with their times, keyframes; undo, redo, going back,
/// branches.
pub struct History {
    pub(super) scene: Scene,
    /// The state that it began with, if not with the start of the scene.
    pub(super) state: Option<Value>,
    notes: Vec<String>,
    pub(super) frame: Frame,
    pub(super) tree: Tree,
    /// The branch that the world is on.
    pub(super) branch: usize,
    /// The commands that come next on the branch are not followed: they were undone.
    pub(super) is_free: bool,
    pub(super) keyframes: Keyframes,
    pub(super) undone: Vec<Redo>,
    pub(super) discards: Vec<Discard>,
    skins: Vec<Skin>,
    /// The topology that the skins are of, and how many were put on.
    dressed: (u64, usize),
    /// Time of the start `[s]`.
    from: f64,
    next_edit: u64,
    last_edit: Option<u64>,
    /// Whole second that is marked already, or was passed over.
    second: f64,
    /// When the last keyframe was taken.
    pub(super) kept: Kept,
    /// The same start by other methods.
    pub(super) companions: Vec<Companion>,
    refused: Vec<Refusal>,
}

/// What commands are called in the log, and the edit that they are undone with, if they are of one.
struct Called {
    edit: Option<u64>,
    name: Option<String>,
}

impl Called {
    fn of(edit: Option<(u64, String)>) -> Self {
        let (edit, name) = edit.unzip();
        Called { edit, name }
    }
}

impl History {
    /// The world at its start; the commands of a recording are followed as it steps, until something new is given.
    ///
    /// Errors: a scene that cannot be run, a state that cannot be gone on from.
    pub fn new(start: Start) -> Result<Self, HistoryError> {
        let Start { recording, undone, .. } = start;
        let frame = recording.begin(recording.scene.name())?;
        let entries = &recording.scene.beside;
        let companions = entries.iter().map(|entry| Companion::new(&recording, entry)).collect::<Result<_, _>>()?;
        let from = frame.world.time();
        let end = recording.end().max(from);
        let of_undone = undone.iter().flat_map(|undone| &undone.commands);
        let edits = recording.commands.iter().chain(of_undone).filter_map(|entry| entry.edit);
        let next_edit = edits.max().map_or(0, |edit| edit.saturating_add(1));
        let mut history = History {
            notes: recording.notes(),
            kept: Kept::at(&frame),
            companions,
            frame,
            tree: Tree::new(recording.commands, recording.marks, from, end),
            scene: recording.scene,
            state: recording.state,
            branch: 0,
            is_free: false,
            keyframes: Keyframes::new(),
            undone: Vec::new(),
            discards: Vec::new(),
            skins: Vec::new(),
            dressed: (0, 0),
            from,
            next_edit,
            last_edit: None,
            second: f64::NEG_INFINITY,
            refused: Vec::new(),
        };
        history.keyframes.keep(0, history.frame.clone(), false);
        history.follow_due();
        history.arrive();
        if let Some(undone) = undone {
            history.bring(undone);
        }
        Ok(history)
    }

    /// The world as it is now.
    pub fn world(&self) -> &dyn Dynamics {
        &*self.frame.world
    }

    /// The world as it will be made once the numbers that are led to others are there; `None`: none is.
    pub fn ahead(&self) -> Option<Box<dyn Dynamics>> {
        self.frame.ahead(&self.scene)
    }

    /// The scene that it began with.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What is to be known of the recording that it began with, if another version made it: see [`Recording::notes`].
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// What is drawn on triangles now, on bodies that were added too. A triangle with a deleted corner is gone, and one of whose
    /// sides was a bond that is gone.
    pub fn skins(&self) -> &[Skin] {
        &self.skins
    }

    /// How many pictures were put on bodies, one on another too.
    pub fn worn(&self) -> usize {
        self.frame.dress.worn()
    }

    /// What bodies are called, by their numbers, of those of which it is known: see [`Scene::body_names`].
    pub fn body_names(&self) -> &[Option<String>] {
        self.frame.dress.names()
    }

    /// Which body points are of, and what colour it has.
    pub fn tints(&self) -> &Arc<[Tint]> {
        self.frame.dress.tints()
    }

    /// The groups as they were named, whatever is left of their points: shared, so that it is seen at once whether they are others.
    pub fn named(&self) -> &Arc<Vec<Group>> {
        self.frame.dress.named()
    }

    /// The words that stand in the world now, those of points that are gone too: shared, as groups are.
    pub fn labels(&self) -> &Arc<Vec<LabelKeys>> {
        self.frame.dress.labels()
    }

    /// The groups of points that have a name, of the points that are left.
    pub fn groups(&self) -> Vec<Group> {
        self.frame.dress.groups(&*self.frame.world)
    }

    /// How far the present branch goes `[s]`.
    pub fn end(&self) -> f64 {
        let time = self.world().time();
        if self.is_free { time } else { self.tree.end(self.branch).max(time) }
    }

    /// Whether the log goes on from here, which steps follow.
    pub fn has_future(&self) -> bool {
        self.has_more() || !self.is_free && self.tree.end(self.branch) > self.world().time()
    }

    /// Whether commands of the log are still to come.
    pub(super) fn has_more(&self) -> bool {
        !self.is_free && self.frame.place < self.tree.len(self.branch)
    }

    /// Bytes that the keyframes take.
    pub fn keyframe_bytes(&self) -> usize {
        self.keyframes.bytes()
    }

    /// Another bound of the bytes that keyframes take: 512 MiB unless set.
    pub fn bound_keyframes(&mut self, most_bytes: usize) {
        self.keyframes.bound(most_bytes, self.frame.world.time());
    }

    /// Commands of the log that could not be done as it was followed, since they were last asked for.
    pub fn take_refused(&mut self) -> Vec<Refusal> {
        std::mem::take(&mut self.refused)
    }

    /// One step of the world, with the commands of the log that it reaches; keyframes and marks.
    pub fn step(&mut self) {
        self.depart();
        self.mark_second();
        let next = self.tree.entry(self.branch, self.frame.place).map(|entry| entry.at);
        let is_cut = next.is_some_and(|at| self.frame.is_cut_at(at));
        self.frame.step(next, &self.scene);
        self.tree.extend_to(self.branch, self.frame.world.time());
        self.keep_before_edit(is_cut);
        self.follow_due();
        self.tree.pass(self.spot());
        self.keyframes.keep_now_and_then(&mut self.kept, self.branch, &self.frame);
        self.dress();
    }

    /// Does commands at the time reached, all or none. `edit`: what they are called when they are undone as one, such as "Draw a
    /// body"; `None`: for cursor and grab, which are not undone by themselves. A release that is an edit is undone with its grab.
    ///
    /// Errors: the first that cannot be done; the world before it is whole.
    pub fn give(&mut self, commands: Vec<Do>, edit: Option<&str>) -> Result<Vec<Applied>, Refusal> {
        let edit = edit.map(|name| (self.next_edit, name.to_owned()));
        self.give_as(commands, Called::of(edit))
    }

    /// How fast it is played and where it ends, as the scene and commands have it.
    pub fn clock(&self) -> Clock {
        self.frame.said.of(&self.scene)
    }

    /// Does a command that nobody asked for, which is called so in the log: it is replayed, and is no step of undo.
    ///
    /// Errors: as of [`History::give`].
    pub fn give_aside(&mut self, command: Do, name: &str) -> Result<Vec<Applied>, Refusal> {
        self.give_as(vec![command], Called { edit: None, name: Some(name.to_owned()) })
    }

    /// The number of the edit that [`History::give_on`] goes on with; `None`: it begins another.
    pub fn last_edit(&self) -> Option<u64> {
        self.last_edit
    }

    /// Does commands that belong to the last edit: a drag, a stroke or a slider is undone as one.
    ///
    /// Errors: as of [`History::give`].
    pub fn give_on(&mut self, commands: Vec<Do>, name: &str) -> Result<Vec<Applied>, Refusal> {
        let edit = self.last_edit.unwrap_or(self.next_edit);
        self.give_as(commands, Called::of(Some((edit, name.to_owned()))))
    }

    fn give_as(&mut self, commands: Vec<Do>, Called { edit, name }: Called) -> Result<Vec<Applied>, Refusal> {
        if commands.is_empty() {
            return Ok(Vec::new());
        }
        let at = self.frame.world.time();
        let grabs = commands.iter().any(|act| matches!(act, Do::Grab(_)));
        let before = (edit.is_some() || grabs || commands.len() > 1).then(|| self.frame.clone());
        let mut done = Vec::with_capacity(commands.len());
        for (number, act) in commands.iter().enumerate() {
            match self.frame.apply(act, &self.scene) {
                Ok(applied) => done.push(applied),
                Err(reason) => {
                    self.frame = before.unwrap_or_else(|| self.frame.clone());
                    return Err(Refusal { number, at, reason });
                }
            }
        }
        // What does nothing is nothing to undo.
        let is_edit = edit.is_some();
        let edit = edit.filter(|_| done.iter().any(|applied| applied.is_something));
        if let Some(before) = before.as_ref().filter(|_| grabs) {
            // A drag is undone to here.
            self.keyframes.keep(self.branch, before.clone(), false);
        }
        if let Some(number) = edit {
            if self.last_edit != Some(number)
                && let Some(before) = before
            {
                self.keyframes.keep(self.branch, before, false);
            }
            self.next_edit = self.next_edit.max(number.saturating_add(1));
            self.last_edit = Some(number);
            self.undone.clear();
        }
        self.fork();
        let name = name.filter(|_| edit.is_some() || !is_edit);
        for act in commands {
            let name = match &act {
                // What a file calls a group is the name of its edit too.
                Do::Group { name, .. } => edit.map(|_| name.clone()),
                _ => name.clone(),
            };
            self.tree.push(self.branch, Entry { at, act, edit, name });
            self.frame.place += 1;
        }
        self.dress();
        Ok(done)
    }

    /// Leaves what is to come: what was undone is not done again by itself.
    fn depart(&mut self) {
        if self.is_free {
            self.fork();
        }
    }

    /// A new branch, where the present one has commands that are still to come.
    fn fork(&mut self) {
        let time = self.frame.world.time();
        if self.frame.place < self.tree.len(self.branch) || self.tree.end(self.branch) > time {
            let next = self.tree.fork(self.spot());
            if self.is_free {
                self.tree.go_on(self.branch, next);
            } else if let Some(done_on) = self.tree.done_from(self.branch, self.frame.place) {
                self.tree.take_over(done_on);
            }
            self.branch = next;
        }
        self.is_free = false;
    }

    /// Where the world is.
    pub(super) fn spot(&self) -> Spot {
        Spot { branch: self.branch, place: self.frame.place, time: self.frame.world.time() }
    }

    /// Does the commands of the log that are due.
    fn follow_due(&mut self) {
        while let Some(entry) = self.tree.entry(self.branch, self.frame.place)
            && self.frame.is_due(entry.at)
        {
            let (number, at) = (self.frame.place, entry.at);
            if let Err(reason) = self.frame.follow(entry, &self.scene) {
                self.refused.push(Refusal { number, at, reason });
            }
        }
    }

    /// The present is another: skins are those of its world.
    pub(super) fn arrive(&mut self) {
        let world = &*self.frame.world;
        self.skins = if self.frame.dress.has_skins() { self.frame.dress.skins(world) } else { Vec::new() };
        self.dressed = (world.topology(), self.frame.dress.worn());
        self.second = world.time().floor();
        self.kept = Kept::at(&self.frame);
        self.last_edit = None;
    }

    fn dress(&mut self) {
        let topology = self.frame.world.topology();
        let dressed = (topology, self.frame.dress.worn());
        if dressed != self.dressed && self.frame.dress.has_skins() {
            self.skins = self.frame.dress.skins(&*self.frame.world);
        }
        self.dressed = dressed;
    }

    /// Marks the state after all commands of its time, once a second.
    fn mark_second(&mut self) {
        let time = self.frame.world.time();
        if time.floor() <= self.second {
            return;
        }
        self.second = time.floor();
        let is_new = self.tree.last_mark(self.branch).is_none_or(|last| last < self.second);
        if is_new && self.frame.place == self.tree.len(self.branch) {
            let hash = hash_now(&*self.frame.world, time);
            self.tree.mark(self.branch, Mark { at: time, hash });
        }
    }

    /// A keyframe before an edit of the log, so that it is undone at once.
    fn keep_before_edit(&mut self, is_cut: bool) {
        let next = self.tree.entry(self.branch, self.frame.place);
        if next.is_some_and(|entry| entry.edit.is_some() && self.frame.is_due(entry.at)) {
            self.keyframes.keep(self.branch, self.frame.clone(), is_cut);
        }
    }

    /// The branches that one may want to return to, and the present one: those that undo left behind and redo leads to are none of them.
    pub fn branches(&self) -> Vec<BranchView> {
        self.tree.views(self.branch, self.undone.iter().filter_map(Redo::reaches))
    }

    /// All of the present branch as a file has it.
    pub fn recording(&self) -> Recording {
        let recording = self.unmarked();
        let end = recording.end();
        let mut marks = self.tree.marks(self.branch);
        // A mark is after the commands of its time: those of what was undone are of another motion.
        let undone = self.tree.entry(self.branch, recording.commands.len()).map_or(f64::INFINITY, |entry| entry.at);
        marks.retain(|mark| mark.at <= end && mark.at < undone);
        let is_at_end = self.frame.place == recording.commands.len() && self.frame.world.time() >= end;
        if is_at_end && marks.last().is_none_or(|mark| mark.at < end) {
            marks.push(Mark { at: end, hash: hash_now(&*self.frame.world, end) });
        }
        Recording { marks, ..recording }
    }

    /// A recording that begins at the present state.
    ///
    /// Errors: in words, why the state cannot be kept.
    pub fn snapshot(&self) -> Result<Recording, String> {
        Recording::snapshot(&self.scene, &self.frame)
    }

    /// The same without marks.
    pub(super) fn unmarked(&self) -> Recording {
        let commands = self.entries(0..self.log().1).cloned().collect();
        Recording { state: self.state.clone(), commands, end: Some(self.end()), ..self.scene.clone().into() }
    }

    /// The branch that a file has of it, and how many of its commands: of what was undone it has none.
    pub(super) fn log(&self) -> (usize, usize) {
        (self.branch, if self.is_free { self.frame.place } else { self.tree.len(self.branch) })
    }

    /// Some commands of the present branch.
    pub(super) fn entries(&self, places: std::ops::Range<usize>) -> impl Iterator<Item = &Entry> {
        places.filter_map(|place| self.tree.entry(self.branch, place))
    }

    /// Time of the start `[s]`.
    pub fn from(&self) -> f64 {
        self.from
    }
}
