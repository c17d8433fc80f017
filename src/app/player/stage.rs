//! The stepping thread's own: a history with its clock, and what orders do to them.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::acts::{Acts, Deeds};
use super::beside::{Companions, Escort, reference};
use super::movers::{EXACT, Movers, exact, movers, with};
use super::named::in_world;
use super::order::{Adder, Coming, Note, Order};
use super::pace::{Pace, SINGLE_STEP};
use super::rungs::{Load, Rung, Rungs, Yielded};
use super::save;
use super::shown::{Figures, Scenery, Shown};
use super::softness::Relaxed;
use super::watch::Watch;
use crate::app::lengths::length;
use crate::app::matter::{Among, Matter, MatterChange, commands};
use crate::app::meter::Meter;
use crate::app::tools::{HaulWay, Hauled, PinWay};
use crate::history::{BranchView, Do, History, HistoryError, Recording, Refusal, SetKeys, Start};
use crate::scene::{AddKeys, BondKeys, MOST_MEETING, Meeting, MethodKeys, Parameter, PinMotionKeys, ViewKeys};
use crate::sim::reach::{Reach, reaches};
use crate::sim::{Applied, Cursor, Dynamics, MouseForce, PointId};

/// How often figures are taken that cost something: nobody reads faster.
const FIGURES_EVERY: Duration = Duration::from_millis(100);

/// Why bodies pass through each other in a scene that is large.
pub fn too_many_to_meet() -> String {
    format!("a scene of more than {MOST_MEETING} bonds would be too slow if they met")
}

/// A pin that is led takes so long to the place where the cursor was `[s]`: a little longer than until it is sent on.
const PIN_TIME: f64 = 0.15;
/// The way of obstacles is gone in no more than this, in frames: before, they stood.
const LONGEST_HAUL: f64 = 6.0;
/// What is dragged is dragged on for so long after it was sent on its way last, in time of the wall `[s]`.
const DRAGS: f64 = 0.5;
/// Pins that are so much further apart than bonds reach are told of `[m]`.
const STRAINED: f64 = 1e-3;
/// What another solver is called.
const SOLVER: &str = "solver";
/// What leading a pin is called.
const LEAD_PIN: &str = "move a pin";
/// What leading pins that bonds join is called.
const LEAD_BAR: &str = "move a bar";

/// A history that is played.
pub struct Stage {
    history: History,
    pace: Pace,
    scenery: Arc<Scenery>,
    /// The topology of the scenery, as the world counts it, and how often it was another one.
    topology: Option<u64>,
    sceneries: u64,
    energy: f64,
    movers: Arc<Movers>,
    relaxed: Relaxed,
    rungs: Rungs,
    escort: Escort,
    yielded: Option<Yielded>,
    deeds: Deeds,
    acts: Acts,
    figures_at: Option<Instant>,
    steps: Meter,
    /// Wall time that stepping 1/60 s at its pace takes `[s]`.
    works: Meter,
    reached: Meter,
    /// Strength of the hover force when nothing is led `[1/s^2]`.
    base: Option<f64>,
    /// The hover force as it was last seen: without a cursor the world doesn't tell.
    force: Option<MouseForce>,
    substeps: u64,
    /// It went back once: from then on there may be branches.
    has_gone: bool,
    /// How it is looked at.
    view: Option<ViewKeys>,
    branches: Arc<[BranchView]>,
    watch: Watch,
    /// Whose matter is shown, and what it is.
    among: Among,
    matter: Option<Arc<Matter>>,
    /// Numbers that the scene names for sliders.
    named: Vec<Parameter>,
    /// What the world warned of when it was looked at last.
    warned: Vec<String>,
    /// What is to be said of a pin that is led.
    strained: Option<String>,
    /// When obstacles or pins went on their way last `[s]`.
    led_at: Option<f64>,
    /// How far obstacles went of the way that they are on.
    hauled: Option<Hauled>,
    /// The pins that are led, and how far they may be from others.
    led: Option<(Vec<PointId>, Vec<Reach>)>,
}

/// What commands did, and what is to be said of it.
type Given = (Vec<Applied>, Option<Note>);

/// A history without its worlds.
pub struct Folded {
    /// Start and log.
    pub recording: Recording,
    /// Where it was `[s]`.
    time: f64,
    rate: f64,
    playing: bool,
}

impl Stage {
    /// A history at its start.
    ///
    /// Errors: as of [`History::new`].
    pub fn new(start: Start) -> Result<Self, HistoryError> {
        let history = History::new(start)?;
        let scene = history.scene();
        let pace = Pace::new(&history, scene.rate(), scene.duration);
        let force = scene.mouse_force();
        let named = scene.named_parameters();
        let base = history.base_strength();
        let mut stage = Stage {
            history,
            pace,
            scenery: Arc::default(),
            topology: None,
            sceneries: 0,
            energy: 0.0,
            movers: Arc::default(),
            relaxed: Relaxed::default(),
            rungs: Rungs::new(),
            escort: Escort::default(),
            yielded: None,
            deeds: Deeds::default(),
            acts: Acts::default(),
            figures_at: None,
            steps: Meter::default(),
            works: Meter::default(),
            reached: Meter::default(),
            base,
            force,
            substeps: 0,
            has_gone: false,
            view: None,
            branches: Arc::default(),
            watch: Watch::default(),
            among: Among::default(),
            named,
            matter: None,
            warned: Vec::new(),
            strained: None,
            led_at: None,
            hauled: None,
            led: None,
        };
        stage.warned = stage.history.world().warnings().to_vec();
        stage.look();
        Ok(stage)
    }

    /// Start and log, to be played on from here some time.
    pub fn folded(&self) -> Folded {
        let Pace { rate, playing, .. } = self.pace;
        Folded { recording: self.recording(), time: self.history.world().time(), rate, playing }
    }

    /// The same history again, where it was folded: worked out from its start.
    ///
    /// Errors: as of [`History::new`].
    pub fn unfolded(folded: Folded) -> Result<Self, HistoryError> {
        let mut stage = Stage::new(folded.recording.into())?;
        stage.pace.go_to(&mut stage.history, folded.time, None);
        (stage.pace.rate, stage.pace.playing) = (folded.rate, folded.playing);
        Ok(stage)
    }

    fn recording(&self) -> Recording {
        Recording { view: self.view.clone(), ..self.history.recording() }
    }

    /// The history.
    pub fn history(&self) -> &History {
        &self.history
    }

    /// Does what is asked. Returns what is to be said of it.
    pub fn obey(&mut self, order: Order) -> Option<Note> {
        let goes = order.goes();
        let comes = goes || matches!(order, Order::Step(_) | Order::Play(_) | Order::Beside(_));
        let (is_followed, branch) = (self.history.has_future(), self.history.branch());
        let was_taken = self.pace.is_taken;
        let note = match order {
            Order::Advance { wall, cursor, back: false } => {
                self.advance(wall, cursor);
                None
            }
            Order::Advance { wall, cursor, back: true } => {
                self.pace.rewind(&mut self.history, wall, cursor);
                None
            }
            Order::Play(playing) => {
                self.pace.playing = playing;
                self.pace.settle(&self.history);
                None
            }
            Order::Step(cursor) => {
                self.substeps += self.pace.step(&mut self.history, cursor);
                None
            }
            Order::Give(commands, edit) => self.give(commands, edit),
            Order::GiveOn(act, name) => self.give_on(vec![act], name),
            Order::Change { among, change, goes_on } => self.change_matter(&among, change, goes_on),
            Order::Inspect(among) => {
                self.among = among;
                self.inspect();
                None
            }
            Order::Copy(look) => {
                look(&self.history);
                None
            }
            Order::Beside(companions) => self.put_beside(companions),
            Order::Solver(solver) => {
                let method = MethodKeys { solver: Some(solver), source: None, ..self.history.method() };
                self.give(vec![with(method)], Some(SOLVER))
            }
            Order::Method(setting, goes_on) => {
                let act = with(setting.within(self.history.method()));
                match goes_on {
                    true => self.give_on(vec![act], setting.name()),
                    false => self.give(vec![act], Some(setting.name())),
                }
            }
            Order::Press(presses) => {
                self.pace.presses = presses;
                None
            }
            Order::LeadPins(way) => self.lead_pins(way),
            Order::Haul(way) => self.haul(way),
            Order::Add(adder) => Some(self.add(adder)),
            Order::Undo(cursor) => {
                let undone = self.history.undo();
                if undone.is_some() {
                    self.pace.gone_for_good(&self.history, cursor);
                }
                Some(undone.map_or(Note::NothingToUndo, |undone| Note::Undone(undone.name, undone.seconds)))
            }
            Order::Redo(cursor) => {
                let redone = self.history.redo();
                if redone.is_some() {
                    self.pace.gone_for_good(&self.history, cursor);
                }
                Some(redone.map_or(Note::NothingToRedo, |redone| Note::Redone(redone.name, redone.seconds)))
            }
            Order::GoTo(time, cursor) => {
                self.pace.go_to(&mut self.history, time, cursor);
                None
            }
            Order::ToBranch(number, cursor) => {
                self.history.to_branch(number);
                self.pace.gone_for_good(&self.history, cursor);
                None
            }
            Order::Exact => self.make_exact(),
            Order::TakeBack => self.take_back(),
            Order::Reset => {
                self.rungs.forget();
                let left = self.pace.reset(&mut self.history);
                (left > 0).then_some(Note::Left(left))
            }
            Order::Bound(bytes) => {
                self.history.bound_keyframes(bytes);
                None
            }
            // The thread does that.
            Order::Fold => None,
            Order::Rate(rate) => {
                self.pace.rate = rate;
                None
            }
            Order::Look(view) => {
                self.view = Some(view);
                None
            }
            Order::Watch(probes) => {
                self.watch.set(probes);
                let moves = self.pace.is_moving(&self.history);
                let before = self.watch.look_back(&self.history, self.history.scene().rate(), moves);
                (!before.is_empty()).then_some(Note::Before(before))
            }
            Order::Save(path) => Some(save::recording(&self.recording(), path)),
            Order::Moment(path) => Some(save::moment(&self.history, path, self.view.clone())),
            Order::Table(path, bytes) => Some(save::table(&bytes, path)),
            Order::Picture(path, picture) => Some(save::picture(&self.history, path, (&picture, self.view.clone()))),
        };
        if goes {
            // Of another past, whatever its number says.
            self.topology = None;
            self.rungs.have_gone();
            self.escort.have_gone();
            // What was warned of there was told when it was done.
            self.warned = self.history.world().warnings().to_vec();
            (self.has_gone, self.figures_at) = (true, None);
        }
        if comes {
            self.escort.come(&mut self.history, &self.pace, 0.0);
        }
        if self.pace.is_taken && !was_taken {
            self.base = self.history.base_strength();
        }
        self.look();
        let is_left = is_followed && !goes && self.history.branch() != branch;
        if is_left {
            (self.has_gone, self.figures_at) = (true, None);
        }
        note.or(is_left.then_some(Note::Branched))
    }

    /// What edits were warned of since it was last asked for.
    pub fn take_warnings(&mut self) -> Option<Note> {
        let all = self.history.world().warnings();
        let mut fresh = Vec::new();
        if all.len() != self.warned.len() {
            let known = all.iter().zip(&self.warned).take_while(|(a, b)| a == b).count();
            fresh = all[known..].to_vec();
            self.warned = all.to_vec();
        }
        fresh.extend(self.strained.take());
        (!fresh.is_empty()).then_some(Note::Warned(fresh))
    }

    /// Does commands that the hand gives.
    fn give(&mut self, commands: Vec<Do>, edit: Option<&'static str>) -> Option<Note> {
        self.do_now(commands, edit).map_or_else(Some, |(_, note)| note)
    }

    /// The same: what each of them did, and what is to be said.
    ///
    /// Errors: what is to be said of those that were refused.
    fn do_now(&mut self, commands: Vec<Do>, edit: Option<&'static str>) -> Result<Given, Note> {
        let changes = commands.iter().any(|act| matches!(act, Do::Mouse(_)));
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
        if given.is_ok() && changes {
            self.base = self.history.base_strength();
        }
        match given {
            Err(refusal) => Err(Note::Refused(refusal.reason)),
            Ok(applied) => Ok((applied, why.map(|why| Note::Added(Some(why))))),
        }
    }

    /// Gives commands after those that make bodies meet; alone where these are refused, whose reason is returned then.
    fn give_met(
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
            Err(refusal) => (self.history.give(commands, edit), Some(refusal.reason)),
            given => (given, why),
        }
    }

    /// Whether what comes is a body of its own: one by its name, or new points that bonds hold together.
    fn brings_body(&self, keys: &AddKeys) -> bool {
        let [next, ..] = self.history.world().next_numbers();
        !keys.bodies.is_empty() || keys.bonds.iter().any(|bond| bond.a.min(bond.b) >= next)
    }

    /// Why commands are of a moment that has gone: a new body would be bonded to others than were seen.
    fn is_outdated(&self, commands: &[Do]) -> Option<&'static str> {
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
    fn change_matter(&mut self, among: &Among, change: MatterChange, goes_on: bool) -> Option<Note> {
        match commands(self.history.world(), among, change) {
            Err(why) => Some(Note::Refused(why.to_owned())),
            Ok(list) if goes_on => self.give_on(list, change.name()),
            Ok(list) => self.give(list, Some(change.name())),
        }
    }

    /// Looks what is shown is made of now.
    fn inspect(&mut self) {
        let is_wanted = !self.among.is_empty();
        let matter = is_wanted.then(|| Matter::of(self.history.world(), self.history.tints(), &self.among)).flatten();
        self.matter = matter.map(Arc::new);
    }

    /// Does commands that belong to the last edit: a setting is dragged on.
    fn give_on(&mut self, acts: Vec<Do>, name: &'static str) -> Option<Note> {
        self.do_on(acts, name).err()
    }

    /// The same: what each of them did.
    ///
    /// Errors: as of [`Stage::do_now`].
    fn do_on(&mut self, acts: Vec<Do>, name: &'static str) -> Result<Given, Note> {
        let changes = acts.iter().any(|act| matches!(act, Do::Mouse(_)));
        let given = self.history.give_on(acts, name);
        self.pace.motion += 1;
        if given.is_ok() && changes {
            self.base = self.history.base_strength();
        }
        given.map(|applied| (applied, None)).map_err(|refusal| Note::Refused(refusal.reason))
    }

    /// Others stand beside the world from now on.
    fn put_beside(&mut self, companions: Companions) -> Option<Note> {
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
            note = self.history.set_beside(entries).err().map(|error| Note::Refused(error.to_string()));
            if note.is_none() {
                self.escort.begin();
                break;
            }
        }
        note
    }

    /// Lets time pass.
    fn advance(&mut self, wall: f64, cursor: Option<Cursor>) {
        let (start, before) = (Instant::now(), self.history.world().time());
        let substeps = self.pace.advance(&mut self.history, wall, cursor, || start.elapsed().as_secs_f64());
        self.substeps += u64::from(substeps);
        let beside = self.escort.come(&mut self.history, &self.pace, wall);
        let (steps, gone) = (start.elapsed().as_secs_f64(), self.history.world().time() - before);
        if substeps > 0 {
            self.steps.push(steps);
            self.works.push(SINGLE_STEP * (steps - beside) * self.pace.rate / gone);
        }
        if wall > 0.0 && self.pace.is_moving(&self.history) {
            self.reached.push(gone / (wall * self.pace.rate));
            self.give_way(Load { wall, steps, is_late: self.pace.is_late, work: self.works.value() });
        }
    }

    /// Where steps took too long for a while, something gives way; it is given back where they do no more.
    fn give_way(&mut self, load: Load) {
        // Companions wait first.
        if self.escort.gives_way(&self.history, load) {
            return;
        }
        // An edit of its own would part the drag in two.
        let now = self.history.world().time();
        if self.led_at.is_some_and(|last| (0.0..DRAGS * self.pace.rate).contains(&(now - last))) {
            return;
        }
        let Some((act, name)) = self.rungs.look(&self.history, load) else { return };
        // Nobody asked for it: it is in the log, and no step of undo.
        if self.history.give_aside(act, name).is_err() {
            // A world that cannot be moved so goes on as it is.
            Rung::of(name).into_iter().for_each(|rung| self.rungs.refuse(rung));
        }
        self.pace.motion += 1;
        self.figures_at = None;
    }

    /// Every island is moved by its own method from now on.
    fn make_exact(&mut self) -> Option<Note> {
        let note = self.give(vec![exact(&self.history)], Some(EXACT));
        (self.figures_at, self.movers) = (None, Arc::default());
        note.or(Some(Note::Exact))
    }

    /// What gave way is taken back.
    fn take_back(&mut self) -> Option<Note> {
        self.rungs.yielded(&self.history)?;
        let (act, name) = self.rungs.back(&self.history);
        self.rungs.refuse_all();
        self.figures_at = None;
        self.give(vec![act], Some(name))
    }

    /// Adds something as one edit.
    fn add(&mut self, adder: Adder) -> Note {
        let Coming { commands, name, came } = match adder(&self.history) {
            Ok(coming) => coming,
            Err(why) => return Note::Refused(why),
        };
        let (meeting, why) = self.meeting();
        let (given, why) = self.give_met(meeting, commands, Some(name), why);
        self.pace.settle(&self.history);
        match (given, came) {
            (Err(refusal), _) => Note::Refused(refusal.reason),
            (Ok(_), Some((came, said))) => Note::Came(came, said, why),
            (Ok(_), None) => Note::Added(why),
        }
    }

    /// What makes bodies meet from now on, where they do not and are not too many: whoever adds one wants it to lie on the others. Else
    /// why they go on passing through each other.
    fn meeting(&mut self) -> (Vec<Do>, Option<String>) {
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

    /// Sends pins on their way. Those that are none by now stay where they are.
    fn lead_pins(&mut self, PinWay { mut pins, goes_on }: PinWay) -> Option<Note> {
        let world = self.history.world();
        pins.retain(|(pin, _)| world.pinned().contains(pin));
        pins.sort_unstable_by_key(|(pin, _)| *pin);
        if pins.is_empty() {
            return None;
        }
        let (time, dimensions) = (world.time(), world.dimensions());
        self.led_at = Some(time);
        let track = |&(pin, to): &(PointId, [f64; 3])| {
            let here = (0..dimensions).map(|axis| world.positions().get(pin.index() * dimensions + axis));
            let from = std::iter::once(time).chain(here).collect();
            let there = std::iter::once(time + PIN_TIME).chain(to.into_iter().take(dimensions)).collect();
            PinMotionKeys { point: pin.0, track: vec![from, there] }
        };
        let pin_motion = pins.iter().map(track).collect();
        let numbers: Vec<PointId> = pins.iter().map(|(pin, _)| *pin).collect();
        // Looking for reaches goes through all bonds: once for pins that go on.
        let known = self.led.take().filter(|(led, _)| goes_on && *led == numbers).map(|(_, reaches)| reaches);
        let is_led = |pin: &PointId| numbers.binary_search(pin).is_ok();
        let all = || reaches(world.bonds(), &numbers, world.pinned());
        let reaches = known.unwrap_or_else(|| all().into_iter().filter(|reach| !is_led(&reach.pins[1])).collect());
        self.strained = beyond_reach(world, &reaches, &pins);
        self.led = Some((numbers, reaches));
        let way = Do::Add(Box::new(AddKeys { pin_motion, ..AddKeys::default() }));
        let name = if pins.len() > 1 { LEAD_BAR } else { LEAD_PIN };
        if !goes_on {
            return self.give(vec![way], Some(name));
        }
        self.give_on(vec![way], name)
    }

    /// Obstacles go on their way, as fast as time went since they did last, and as far as what they push has room.
    fn haul(&mut self, way: HaulWay) -> Option<Note> {
        let before = self.hauled.take().filter(|_| way.goes_on);
        let hauled = before.unwrap_or_else(|| way.begin());
        let Some(mut rest) = way.rest(hauled) else {
            self.hauled = before;
            return None;
        };
        let now = self.history.world().time();
        let shortest = SINGLE_STEP * self.pace.rate;
        let since = self.led_at.replace(now).filter(|_| before.is_some()).map_or(0.0, |last| now - last);
        rest.keys.over = Some(since.clamp(shortest, LONGEST_HAUL * shortest).max(rest.least * self.pace.rate));
        let acts = vec![Do::Move(rest.keys.clone())];
        let given = if before.is_some() { self.do_on(acts, rest.name) } else { self.do_now(acts, Some(rest.name)) };
        match given {
            Ok((applied, note)) => {
                let gone = applied.last().map_or(1.0, |applied| applied.gone);
                self.hauled = Some(hauled.then(&rest, gone));
                note
            }
            Err(note) => {
                self.hauled = before;
                Some(note)
            }
        }
    }

    /// What stands about the points is looked at again if it changed.
    fn look(&mut self) {
        let world = self.history.world();
        let (tints, groups) = (self.history.tints(), self.history.named());
        let is_dressed = Arc::ptr_eq(tints, &self.scenery.tints) && Arc::ptr_eq(groups, &self.scenery.groups);
        if self.topology != Some(world.topology()) || !is_dressed {
            self.topology = Some(world.topology());
            self.sceneries += 1;
            let mut scenery = Scenery::of(world, self.history.skins(), (tints, groups));
            scenery.named = self.named.iter().map(|parameter| in_world(&parameter.target, world)).collect();
            scenery.warnings.splice(0..0, self.history.notes().iter().cloned());
            self.scenery = Arc::new(scenery);
            self.inspect();
        }
    }

    /// Puts the present moment into `shown`, whose memory is used again.
    pub fn show(&mut self, shown: &mut Shown) {
        let moves = self.pace.is_moving(&self.history);
        let world = self.history.world();
        if !moves || self.figures_at.is_none_or(|at| at.elapsed() >= FIGURES_EVERY) {
            self.energy = world.energy();
            self.movers = movers(world);
            self.relaxed.look(&self.history);
            self.acts = self.deeds.look(world.counters(), Instant::now());
            self.yielded = self.rungs.yielded(&self.history);
            self.figures_at = Some(Instant::now());
            if self.has_gone {
                self.branches = self.history.branches().into();
            }
        }
        shown.dimensions = world.dimensions();
        shown.current.copy(world.positions());
        shown.previous.clone_from(&self.pace.previous);
        // What was added since has no place before.
        if shown.previous.view().len() != shown.current.view().len() {
            shown.previous.clone_from(&shown.current);
        }
        shown.mix = self.pace.mix(world);
        (shown.motion, shown.topology) = (self.pace.motion, self.sceneries);
        shown.scenery = Arc::clone(&self.scenery);
        let mouse = world.mouse();
        if let Some((force, _)) = mouse
            && self.force.as_ref() != Some(force)
        {
            self.force = Some(force.clone());
        }
        shown.mouse.clone_from(&self.force);
        (shown.cursor, shown.grab) = (mouse.map(|(_, cursor)| cursor), world.grab());
        (shown.base, shown.settings) = (self.base, world.settings());
        shown.figures = self.figures(world);
        shown.measured = self.watch.look(self.history.world());
        shown.matter.clone_from(&self.matter);
        let has_beside = !self.history.companions().is_empty();
        shown.title = if has_beside { self.history.method().words() } else { String::new() };
        shown.rests = world.is_asleep();
        self.escort.show(&self.history, &self.pace, shown.mix, &mut shown.beside);
    }

    fn figures(&self, world: &dyn Dynamics) -> Figures {
        Figures {
            time: world.time(),
            end: self.history.end(),
            follows: self.history.has_future(),
            playing: self.pace.playing,
            asleep: self.history.rests(),
            behind: self.escort.is_behind(&self.history),
            ended: self.pace.ended,
            rate: self.pace.rate,
            pace: self.reached.value(),
            step: self.steps.value(),
            work: self.works.value(),
            points: world.point_count() - world.gone().len(),
            bonds: world.bonds().len(),
            energy: self.energy,
            movers: Arc::clone(&self.movers),
            relaxed: self.relaxed.stiffness(),
            yielded: self.yielded,
            acts: self.acts,
            substeps: self.substeps,
            branches: Arc::clone(&self.branches),
        }
    }
}

/// What is said where rigid bonds do not let pins be so far from the others as where they go `[m]`.
fn beyond_reach(world: &dyn Dynamics, reaches: &[Reach], pins: &[(PointId, [f64; 3])]) -> Option<String> {
    let dimensions = world.dimensions();
    let apart = |[pin, other]: [PointId; 2]| {
        let to = pins.iter().find(|(led, _)| *led == pin).map_or([f64::NAN; 3], |(_, to)| *to);
        let place = |axis| world.positions().get(other.index() * dimensions + axis);
        (0..dimensions).map(|axis| (to[axis] - place(axis)).powi(2)).sum::<f64>().sqrt()
    };
    let most = reaches.iter().map(|reach| apart(reach.pins) - reach.most).fold(0.0, f64::max);
    (most > STRAINED).then(|| format!("the pins are {} further apart than the bonds between them reach", length(most)))
}
