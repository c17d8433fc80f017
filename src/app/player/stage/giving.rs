//! What the hand gives: commands, and what is added to the world, as edits.

use super::super::beside::{Companions, reference};
use super::super::order::{Adder, Coming, Note};
use super::super::rungs::Rung;
use super::super::shown::Latest;
use super::Stage;
use crate::app::matter::{Among, Fit, MatterChange, Placing, Stops, but_for_pictures, commands, led, placed};
use crate::app::warnings::{refused, said};
use crate::history::{Do, Refusal, SetKeys};
use crate::scene::{AddKeys, BondKeys, MOST_MEETING, Meeting};
use crate::sim::Applied;

/// Why bodies pass through each other in a scene that is large.
pub fn too_many_to_meet() -> String {
    format!("a scene of more than {MOST_MEETING} bonds would be too slow if they met")
}

/// What commands did, and what is to be said of it.
type Given = (Vec<Applied>, Option<Note>);

impl Stage {
    /// Does commands that the hand gives.
    pub(super) fn give(&mut self, commands: Vec<Do>, edit: Option<&'static str>) -> Option<Note> {
        self.do_now(commands, edit).map_or_else(Some, |(_, note)| note)
    }

    /// The same: what each of them did, and what is to be said.
    ///
    /// Errors: what is to be said of those that were refused.
    pub(super) fn do_now(&mut self, commands: Vec<Do>, edit: Option<&'static str>) -> Result<Given, Note> {
        let changes = commands.iter().any(|act| matches!(act, Do::Mouse(_)));
        let before = self.history.last_edit();
        self.opened.take_if(|_| edit.is_some());
        self.pace.take_over(&mut self.history);
        // Where a log is left, what it leads is let go with it.
        let mut all = if self.history.has_future() { self.history.letting_go() } else { Vec::new() };
        if let Some(why) = self.is_outdated(&commands) {
            return Err(Note::Refused(why.to_owned()));
        }
        let brings = commands.iter().any(|act| matches!(act, Do::Add(keys) if self.brings_body(keys)));
        let (meeting, why) = if brings { self.meeting() } else { (Vec::new(), None) };
        all.extend(commands);
        let (given, why) = self.give_met(meeting, all, edit, why);
        self.pace.motion += 1;
        self.pace.is_taken |= given.is_ok();
        // What was refused, or did nothing, began none.
        let begun = self.history.last_edit().filter(|&last| before != Some(last));
        self.opened = begun.zip(edit).or(self.opened);
        if given.is_ok() && changes {
            self.base = self.history.base_strength();
        }
        match given {
            Err(refusal) => Err(refusal.into()),
            Ok(applied) => Ok((applied, why.map(|why| Note::Added(Some(why))))),
        }
    }

    /// Gives commands after those that make bodies meet; alone where these are refused, whose reason is returned then.
    pub(super) fn give_met(
        &mut self,
        meeting: Vec<Do>,
        commands: Vec<Do>,
        edit: Option<&str>,
        why: Option<String>,
    ) -> (Result<Vec<Applied>, Refusal>, Option<String>) {
        let before = self.next_numbers();
        let given = self.give_or_meet(meeting, commands, edit, why);
        if self.next_numbers() != before {
            self.number_anew(before);
        }
        given
    }

    /// The numbers that the next point and obstacle get.
    fn next_numbers(&self) -> [u32; 2] {
        let [point, _, obstacle] = self.history.world().next_numbers();
        [point, obstacle]
    }

    /// Points and obstacles from these numbers on are others than those that had them before.
    pub(super) fn number_anew(&mut self, from: [u32; 2]) {
        let Latest { times, from: last } = self.latest;
        // Of several that nobody saw by themselves the first counts.
        let from = if self.is_latest_shown { from } else { [0, 1].map(|k| from[k].min(last[k])) };
        (self.latest, self.is_latest_shown) = (Latest { times: times + 1, from }, false);
    }

    fn give_or_meet(
        &mut self,
        meeting: Vec<Do>,
        commands: Vec<Do>,
        edit: Option<&str>,
        why: Option<String>,
    ) -> (Result<Vec<Applied>, Refusal>, Option<String>) {
        if meeting.is_empty() {
            return (self.history.give(commands, edit), why);
        }
        match self.history.give(meeting.into_iter().chain(commands.iter().cloned()).collect(), edit) {
            Err(refusal) => (self.history.give(commands, edit), Some(refused(&refusal.reason))),
            given => (given, why),
        }
    }

    /// Whether what comes is a body of its own: one by its name, or new points that bonds hold together.
    pub(super) fn brings_body(&self, keys: &AddKeys) -> bool {
        let [next, ..] = self.history.world().next_numbers();
        !keys.bodies.is_empty() || keys.bonds.iter().any(|bond| bond.a.min(bond.b) >= next)
    }

    /// Why commands are of a moment that has gone: a new body would be bonded to others than were seen.
    pub(super) fn is_outdated(&self, commands: &[Do]) -> Option<&'static str> {
        let [next, ..] = self.history.world().next_numbers();
        let is_old = |bond: &BondKeys| bond.a.max(bond.b) < next;
        // The last of new points is named by a bond, an angle or a pin wherever anything is.
        let is_shifted = |keys: &AddKeys| {
            let count = keys.points.as_ref().map_or(0, |points| points.position.len() as u32);
            let pins = keys.points.iter().flat_map(|points| points.pinned.iter().copied());
            let ends = keys.bonds.iter().flat_map(|bond| [bond.a, bond.b]);
            let angles = keys.angles.iter().flat_map(|angle| angle.points.0);
            let last = ends.chain(angles).chain(pins).max();
            count > 0 && keys.bodies.is_empty() && last.is_some_and(|last| last + 1 != next + count)
        };
        let names_old = |act: &Do| match act {
            Do::Add(keys) => is_shifted(keys) || (!keys.bodies.is_empty() && keys.bonds.iter().any(is_old)),
            _ => false,
        };
        commands.iter().any(names_old).then_some("something else came into the scene meanwhile: draw it again")
    }

    /// Bodies get another matter.
    pub(super) fn change_matter(&mut self, among: &Among, change: MatterChange, goes_on: bool) -> Option<Note> {
        let goes_on = self.goes_on(goes_on, change.name());
        let ahead = self.history.ahead();
        let world = ahead.as_deref().unwrap_or(self.history.world());
        let list = commands((world, &self.former), among, change);
        if change == MatterChange::Stops(Stops::None) {
            self.former.note(world, among);
        }
        match list {
            Err(why) => Some(Note::Refused(why.to_owned())),
            // What is dragged on is led by the hand.
            Ok(list) if matches!(change, MatterChange::Preset(_)) => {
                let list = but_for_pictures(list, self.history.skins());
                self.give(led(self.history.world(), list), Some(change.name()))
            }
            Ok(list) if goes_on => self.give_on(list, change.name()),
            // How stiff springs are on their way says what they bear, not how stiff they will be.
            Ok(list) => self.give(led(self.history.world(), list), Some(change.name())),
        }
    }

    /// What is meant is put elsewhere, by the commands of the tool for that.
    pub(super) fn place(&mut self, of: (&Among, &Fit), placing: Placing, goes_on: bool) -> Option<Note> {
        let goes_on = self.goes_on(goes_on, placing.name());
        let (more, goes_on) = self.turned.more(placing, goes_on);
        self.is_aside = of.1.lift != [0.0; 3];
        let note = match placed(self.history.world(), of, more) {
            Err(why) => Some(Note::Refused(why.to_owned())),
            Ok(list) if goes_on => self.give_on(list, placing.name()),
            Ok(list) => self.give(list, Some(placing.name())),
        };
        if !matches!(note, Some(Note::Refused(_) | Note::Held)) {
            self.turned.take(placing);
        }
        note
    }

    /// Whether a drag goes on with an edit that it began itself: what came first may have been refused.
    fn goes_on(&mut self, goes_on: bool, name: &'static str) -> bool {
        self.opened.take_if(|_| !goes_on);
        self.opened.is_some() && self.opened == self.history.last_edit().map(|last| (last, name))
    }

    /// Does commands that belong to the last edit: a setting is dragged on.
    pub(super) fn give_on(&mut self, acts: Vec<Do>, name: &'static str) -> Option<Note> {
        self.do_on(acts, name).err()
    }

    /// The same: what each of them did. Where what is dragged on has begun no edit, they begin one.
    ///
    /// Errors: as of [`Stage::do_now`].
    pub(super) fn do_on(&mut self, acts: Vec<Do>, name: &'static str) -> Result<Given, Note> {
        if !self.goes_on(true, name) {
            return self.do_now(acts, Some(name));
        }
        let changes = acts.iter().any(|act| matches!(act, Do::Mouse(_)));
        let given = self.history.give_on(acts, name);
        self.pace.motion += 1;
        if given.is_ok() && changes {
            self.base = self.history.base_strength();
        }
        given.map(|applied| (applied, None)).map_err(Note::from)
    }

    /// Others stand beside the world from now on.
    pub(super) fn put_beside(&mut self, companions: Companions) -> Option<Note> {
        let before = self.history.scene().beside.clone();
        let lists = match companions {
            Companions::These(entries) => vec![entries],
            Companions::Reference => {
                let more = reference(&self.history).into_iter();
                more.map(|entry| before.iter().cloned().chain([entry]).collect()).collect()
            }
        };
        let mut note = None;
        for entries in lists {
            note = self.history.set_beside(entries).err().map(|error| Note::Refused(said(&error.to_string())));
            if note.is_none() {
                self.escort.begin();
                break;
            }
        }
        note
    }

    /// Adds something as one edit.
    pub(super) fn add(&mut self, adder: Adder) -> Note {
        let Coming { commands, name, came } = match adder(&self.history) {
            Ok(coming) => coming,
            Err(why) => return Note::Refused(why),
        };
        let (meeting, why) = self.meeting();
        let (given, why) = self.give_met(meeting, commands, Some(name), why);
        self.pace.settle(&self.history);
        match (given, came) {
            (Err(refusal), _) => refusal.into(),
            (Ok(_), Some((came, said))) => Note::Came(came, said, why),
            (Ok(_), None) => Note::Added(why),
        }
    }

    /// What makes bodies meet from now on, where they do not and are not too many: whoever adds one wants it to lie on the others. Else
    /// why they go on passing through each other.
    pub(super) fn meeting(&mut self) -> (Vec<Do>, Option<String>) {
        let world = self.history.world();
        if world.dimensions() != 2 || world.contact().is_some() {
            return (Vec::new(), None);
        }
        if world.bonds().len() > MOST_MEETING {
            return (Vec::new(), Some(too_many_to_meet()));
        }
        // A method of order 2 knows no contact.
        let yielded = self.rungs.yielded(&self.history);
        let back = yielded.filter(|yielded| yielded.rung == Rung::Order).map(|_| self.rungs.back(&self.history).0);
        let meets = Do::Set(Box::new(SetKeys { contact: Some(Meeting::Is(true)), ..SetKeys::default() }));
        (back.into_iter().chain([meets]).collect(), None)
    }
}
