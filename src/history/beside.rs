//! The same start by other methods, or under other keys, beside a history.
//!
//! A companion has a world of its own and no log: it follows that of the history, wherever that goes. So whatever is given to the
//! world is given to its companions too, and undo, reset and going back go for all of them. There a companion keeps its own steps: a
//! command is done at the end of its step that reaches the command's time, and a method of long steps hears of it that much later.
//! Where the log is whole before it begins ([`Companion::reach`]) steps are cut short for commands, as everywhere.
//!
//! Its method is its own, and so is what its entry says in place of the scene (`own`): a command that sets that passes it over.

use super::branch::{Spot, Tree};
use super::command::{Do, Entry, SetKeys};
use super::error::HistoryError;
use super::frame::Frame;
use super::keyframes::{Kept, Keyframes};
use super::own::Own;
use super::session::History;
use super::start::Recording;
use crate::picture::{Skin, Tint};
use crate::scene::{BesideKeys, MethodKeys, Scene};
use crate::sim::{Dynamics, Positions};

/// Bytes that the copies of a companion may take.
const MOST_BYTES: usize = 128 << 20;
/// Times that differ by less than this share of a step are the same.
const SLACK: f64 = 1e-9;

/// The world of a scene by another method or under keys of its own, led by the commands of the history that it stands beside.
pub struct Companion {
    entry: BesideKeys,
    title: String,
    scene: Scene,
    frame: Frame,
    /// Of the log that it follows.
    branch: usize,
    keyframes: Keyframes,
    kept: Kept,
    /// Positions before the last step, and when that began `[s]`.
    previous: (Vec<f64>, f64),
    refused: Option<String>,
    kept_own: Option<String>,
}

/// What of a log a companion follows: so many commands of a branch.
#[derive(Clone, Copy)]
struct Part<'a> {
    tree: &'a Tree,
    branch: usize,
    place: usize,
}

impl Part<'_> {
    fn entry(&self, place: usize) -> Option<&Entry> {
        self.tree.entry(self.branch, place).filter(|_| place < self.place)
    }
}

impl Companion {
    /// An entry of `beside`, at the start of a recording.
    ///
    /// Errors: its method or its keys cannot run the scene, or go on from the state; with its title.
    pub fn new(recording: &Recording, entry: &BesideKeys) -> Result<Self, HistoryError> {
        let title = recording.scene.companion_title(entry);
        let scene = recording.scene.companion(entry);
        let label = recording.scene.name().to_owned();
        let refused = |reason: String| HistoryError::file(&label, format!("beside: `{title}`: {reason}"));
        let own = Recording { scene: scene.clone(), ..recording.clone() };
        let mut frame = own.begin(&label).map_err(|error| refused(error.to_string()))?;
        if recording.state.is_some() && entry.own().next().is_some() {
            let start = scene.world(scene.duration).map_err(|error| refused(error.to_string()))?;
            let own = Own { entry, listed: scene.bonds.len() };
            frame.world = own.go_on(&*frame.world, &*start).map_err(&refused)?;
            frame.eased.retain(|eased| !(entry.owns("bonds") && eased.leads_springs()));
        } else if recording.state.is_some() {
            // A state goes on by the method that it was kept with.
            let method = MethodKeys { precision: None, tolerance: None, ..scene.method.clone() };
            let act = Do::Set(Box::new(SetKeys { method: Some(method), ..SetKeys::default() }));
            frame.apply(&act, &scene).map_err(|why| refused(why.to_string()))?;
        }
        let mut keyframes = Keyframes::new();
        keyframes.bound(MOST_BYTES, frame.world.time());
        keyframes.keep(0, frame.clone(), false);
        let (kept, previous) = (Kept::at(&frame), (flat(&*frame.world), frame.world.time()));
        let (entry, branch, refused, kept_own) = (entry.clone(), 0, None, None);
        Ok(Companion { entry, title, scene, frame, branch, keyframes, kept, previous, refused, kept_own })
    }

    /// What stands above it.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The same, in words where no title is given.
    pub fn words(&self) -> String {
        self.entry.called(|| self.scene.method.words())
    }

    /// The entry that it was made of.
    pub fn entry(&self) -> &BesideKeys {
        &self.entry
    }

    /// Its world.
    pub fn world(&self) -> &dyn Dynamics {
        &*self.frame.world
    }

    /// When its last step began `[s]`: it need not go back for what comes after.
    pub fn began(&self) -> f64 {
        self.previous.1
    }

    /// What is drawn on its triangles now.
    pub fn skins(&self) -> Vec<Skin> {
        if self.frame.dress.has_skins() { self.frame.dress.skins(&*self.frame.world) } else { Vec::new() }
    }

    /// Which body its points are of, and what colour it has.
    pub fn tints(&self) -> &[Tint] {
        self.frame.dress.tints()
    }

    /// The last command that it could not do, with its time: what it shows since is of another log.
    pub fn refused(&self) -> Option<&str> {
        self.refused.as_deref()
    }

    /// What it kept of its own at the last command that sets some of that, with the time.
    pub fn kept_own(&self) -> Option<&str> {
        self.kept_own.as_deref()
    }

    /// Where its points are at `time` `[s]`, which lies in its last step, on straight lines between its ends `[m]`, as many numbers a
    /// point as it has dimensions.
    pub fn places(&self, time: f64, to: &mut Vec<f64>) {
        let (before, from) = &self.previous;
        let now = self.frame.world.positions();
        let span = self.frame.world.time() - from;
        let share = if span > 0.0 { ((time - from) / span).clamp(0.0, 1.0) } else { 1.0 };
        interpolate(Positions::F64(before), now, share, to);
    }

    /// Does the commands up to `time` `[s]`, where steps are cut short for them, and takes the steps that end by then: as a recording
    /// is run again by its method.
    pub fn reach(&mut self, commands: &[Entry], time: f64) {
        loop {
            let next = commands.get(self.frame.place);
            let at = next.map(|next| next.at);
            match next {
                Some(next) if next.at <= time && self.frame.is_due(next.at) => self.obey(next),
                Some(next) if next.at <= time => self.frame.step(at, &self.scene),
                _ if self.frame.ends_by(time) => self.frame.step(at, &self.scene),
                _ => return,
            }
        }
    }

    /// Goes to a spot of a log as far as `goes_on` lets it. Returns whether it is there: its last step reaches `time` `[s]`.
    fn follow(&mut self, log: Part<'_>, time: f64, goes_on: &mut dyn FnMut() -> bool) -> bool {
        if !self.is_on_the_way(log, time) {
            self.go_back(log, time);
        }
        self.branch = log.branch;
        loop {
            let slack = SLACK * self.frame.world.substep();
            match log.entry(self.frame.place) {
                Some(next) if self.frame.is_due(next.at) => self.obey(&next.clone()),
                _ if self.frame.world.time() >= time - slack => return true,
                _ if !goes_on() => return false,
                _ => self.step(),
            }
        }
    }

    /// Whether steps and commands lead from where it is to a spot of a log.
    fn is_on_the_way(&self, Part { tree, branch, place }: Part<'_>, time: f64) -> bool {
        let (here, began) = (self.frame.place, self.previous.1);
        let is_shared = here <= place && (self.branch == branch || tree.common(self.branch, branch) >= here);
        let has_stepped = self.frame.world.time() > began;
        let is_early = began <= time + SLACK * self.frame.world.substep();
        // A command that came before the last step was passed over: it is of another branch.
        let next = tree.entry(branch, here).filter(|_| here < place);
        is_shared && (is_early || !has_stepped) && !next.is_some_and(|next| has_stepped && next.at <= began)
    }

    fn go_back(&mut self, Part { tree, branch, place }: Part<'_>, time: f64) {
        if let Some(kept) = self.keyframes.before(tree, Spot { branch, place, time }) {
            self.frame = kept.frame.clone();
        }
        self.previous = (flat(&*self.frame.world), self.frame.world.time());
        self.kept = Kept::at(&self.frame);
        (self.refused, self.kept_own) = (None, None);
    }

    fn step(&mut self) {
        // Before it: of what comes within a step nothing is known yet.
        self.keyframes.keep_now_and_then(&mut self.kept, self.branch, &self.frame);
        flat_into(&*self.frame.world, &mut self.previous.0);
        self.previous.1 = self.frame.world.time();
        self.frame.step(None, &self.scene);
    }

    /// Does a command of the log, but for what it says of the method and of what else is the companion's own.
    fn obey(&mut self, entry: &Entry) {
        self.frame.place += 1;
        match &entry.act {
            Do::Set(keys) => {
                let own = Own { entry: &self.entry, listed: self.scene.bonds.len() };
                let (left, kept) = own.left_of(keys);
                if let Some(left) = left {
                    self.apply(&Do::Set(Box::new(left)), entry.at);
                }
                if !kept.is_empty() {
                    self.kept_own = Some(format!("at {:.2} s it kept its own {}", entry.at, kept.join(" and ")));
                }
            }
            // A step that is longer than the cursor's way ends after it.
            &Do::Cursor { to, by } => {
                let by = by.filter(|&by| by > self.frame.world.time());
                self.apply(&Do::Cursor { to, by }, entry.at);
            }
            act => self.apply(act, entry.at),
        }
    }

    fn apply(&mut self, act: &Do, at: f64) {
        if let Err(reason) = self.frame.apply(act, &self.scene) {
            self.refused = Some(format!("at {at:.2} s it could not do what was done: {reason}"));
        }
    }
}

/// The positions of a world `[m]`.
fn flat(world: &dyn Dynamics) -> Vec<f64> {
    let mut list = Vec::new();
    flat_into(world, &mut list);
    list
}

fn flat_into(world: &dyn Dynamics, to: &mut Vec<f64>) {
    let positions = world.positions();
    to.clear();
    to.extend((0..positions.len()).map(|k| positions.get(k)));
}

/// Where points are at a share of the way from one state to the next, on straight lines `[m]`; the memory of `to` is used again.
///
/// Valid range: shares from 0 on; at 1 and beyond, and where other numbers are known of before, points are where they are now.
pub fn interpolate(before: Positions<'_>, now: Positions<'_>, share: f64, to: &mut Vec<f64>) {
    // What came since has no place before.
    let has_before = before.len() == now.len() && share < 1.0;
    to.clear();
    to.extend((0..now.len()).map(|k| {
        let here = now.get(k);
        if has_before { before.get(k) + share * (here - before.get(k)) } else { here }
    }));
}

/// The distance of each point from one place to another `[m]`; NaN where it is in one of them only.
///
/// Shapes: both have `dimensions` numbers a point; of the longer one the rest counts as points of one of them only.
pub fn distances(from: &[f64], to: &[f64], dimensions: usize) -> Vec<f32> {
    let count = from.len().max(to.len()) / dimensions.max(1);
    let of = |point: usize| {
        let at = dimensions * point..dimensions * (point + 1);
        let (Some(a), Some(b)) = (from.get(at.clone()), to.get(at)) else { return f32::NAN };
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt() as f32
    };
    (0..count).map(of).collect()
}

impl History {
    /// What stands beside the world.
    pub fn companions(&self) -> &[Companion] {
        &self.companions
    }

    /// Other companions from now on; those that stay go on, and the scene that is saved has them. New ones begin at the start: see
    /// [`History::bring_along`].
    ///
    /// Errors: one whose method cannot run the scene; all is as it was.
    pub fn set_beside(&mut self, entries: Vec<BesideKeys>) -> Result<(), HistoryError> {
        let scene = Scene { beside: entries.clone(), ..self.scene.clone() };
        scene.check()?;
        let start = Recording { state: self.state.clone(), ..scene.into() };
        let mut made = Vec::with_capacity(entries.len());
        for entry in &entries {
            let is_new = !self.companions.iter().any(|companion| companion.entry == *entry);
            made.push(is_new.then(|| Companion::new(&start, entry)).transpose()?);
        }
        let mut old = std::mem::take(&mut self.companions);
        for (entry, made) in entries.iter().zip(made) {
            let kept = old.iter().position(|companion| companion.entry == *entry);
            self.companions.extend(made.or_else(|| kept.map(|place| old.swap_remove(place))));
        }
        self.scene.beside = entries;
        Ok(())
    }

    /// Brings companions to where the world is, at `time` `[s]` of its last step, one after another as far as `goes_on` lets them.
    /// Returns whether all are there.
    pub fn bring_along(&mut self, time: f64, goes_on: &mut dyn FnMut() -> bool) -> bool {
        let log = Part { tree: &self.tree, branch: self.branch, place: self.frame.place };
        let mut all_are_there = true;
        for companion in &mut self.companions {
            all_are_there &= companion.follow(log, time, goes_on);
        }
        all_are_there
    }

    /// Whether nothing moves and nothing is to come: neither of the world nor of what stands beside it.
    pub fn rests(&self) -> bool {
        let is_still = self.frame.world.is_asleep() && self.frame.eased.is_empty();
        is_still && !self.has_more() && self.companions.iter().all(|companion| companion.world().is_asleep())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_on_straight_lines_between_two_states_and_exactly_where_they_are_at_the_second() {
        let mut places = vec![9.0; 7];
        let mut at = |before: &[f64], now: Positions<'_>, share: f64| {
            interpolate(Positions::F64(before), now, share, &mut places);
            places.clone()
        };
        assert_eq!(at(&[0.0, 8.0], Positions::F64(&[4.0, 4.0]), 0.25), [1.0, 7.0]);
        assert_eq!(at(&[0.0], Positions::F32(&[1.0]), 0.5), [0.5]);
        assert_eq!(at(&[1e16], Positions::F64(&[0.1]), 1.0), [0.1], "no rounding on the way there");
        assert_eq!(at(&[0.0], Positions::F64(&[4.0, 4.0]), 0.25), [4.0, 4.0], "a point came");
        assert!(at(&[f64::NAN], Positions::F64(&[4.0]), 0.25)[0].is_nan(), "it was nowhere");
    }
}
