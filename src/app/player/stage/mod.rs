//! The stepping thread's own: a history with its clock, and what orders do to them.

mod display;
mod giving;
mod going;
mod leading;
mod passing;

use std::sync::Arc;
use std::time::Instant;

use super::acts::{Acts, Deeds};
use super::beside::Escort;
use super::movers::{Movers, with};
use super::order::{Note, Order};
use super::pace::Pace;
use super::rungs::{Rungs, Yielded};
use super::save::{self, Seen};
use super::shown::{Latest, Scenery};
use super::softness::Relaxed;
use crate::app::matter::{Among, Former, Matter, Placed, Turned};
use crate::app::meter::{Lowest, Meter};
use crate::app::tools::Hauled;
use crate::history::{BranchView, Clock, GivenUp, GoneBack, History, HistoryError, Recording, Start};
use crate::scene::{MethodKeys, Parameter, ViewKeys};
use crate::sim::reach::Reach;
use crate::sim::{Jam, Knots, MouseForce, PointId};
pub use giving::too_many_to_meet;

/// What another solver is called.
const SOLVER: &str = "solver";

/// A history that is played.
pub struct Stage {
    history: History,
    pace: Pace,
    /// The clock that it goes by.
    clock: Clock,
    scenery: Arc<Scenery>,
    /// The topology of the scenery, as the world counts it, and how often it was another one.
    topology: Option<u64>,
    sceneries: u64,
    /// How many pictures bodies had been given then.
    worn: usize,
    /// What was given last, and whether that was shown since.
    latest: Latest,
    is_latest_shown: bool,
    energy: f64,
    /// The methods that rules chose, where something stands beside the world.
    by: String,
    /// The mean velocity of what is inspected `[m/s]`.
    velocity: Option<[f64; 3]>,
    /// Where that is.
    placed: Option<Placed>,
    movers: Arc<Movers>,
    relaxed: Relaxed,
    rungs: Rungs,
    /// When what gave way is to be given back, if nothing is asked for until then.
    gives_back_at: Option<Instant>,
    escort: Escort,
    yielded: Option<Yielded>,
    deeds: Deeds,
    acts: Acts,
    figures_at: Option<Instant>,
    steps: Meter,
    /// Wall time that stepping 1/60 s at its pace takes `[s]`.
    works: Meter,
    /// The same for each point, the least of late.
    costs: Lowest,
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
    /// What undo would take back and redo would bring again.
    ways: [Option<String>; 2],
    /// Whose matter is shown, and what it is.
    among: Among,
    matter: Option<Arc<Matter>>,
    /// Of a turn that is dragged on.
    turned: Turned,
    /// Stops that were taken from joints.
    former: Former,
    /// Numbers that the scene names for sliders.
    named: Vec<Parameter>,
    /// What the world warned of when it was looked at last.
    warned: Vec<String>,
    /// What is to be said of a pin that is led.
    strained: Option<String>,
    /// What was put somewhere by a number went aside, which is said where that was found.
    is_aside: bool,
    /// When obstacles or pins went on their way last `[s]`.
    led_at: Option<f64>,
    /// How far obstacles went of the way that they are on.
    hauled: Option<Hauled>,
    /// The edit that was begun last by what may be dragged on, and its name.
    opened: Option<(u64, &'static str)>,
    /// The tracks of pins that are stuck in them, as they were before any of it was gone.
    tracks: Vec<(PointId, Knots)>,
    /// What stops them.
    jam: Option<Jam>,
    /// The pins that are led, and how far they may be from others.
    led: Option<(Vec<PointId>, Vec<Reach>)>,
}

/// A history without its worlds.
pub struct Folded {
    /// Start and log, and what redo brings again.
    pub start: Start,
    /// Where it was `[s]`.
    time: f64,
    /// `None`: as the clock of the scene has it.
    rate: Option<f64>,
    playing: bool,
}

impl Folded {
    /// What was done of a start, at its end: it stands still there.
    pub fn at_end(start: &Start) -> Self {
        Folded { start: start.clone(), time: start.recording().end(), rate: None, playing: false }
    }
}

impl Stage {
    /// A history at its start.
    ///
    /// Errors: as of [`History::new`].
    pub fn new(start: Start) -> Result<Self, HistoryError> {
        let paused = start.recording().paused;
        let history = History::new(start)?;
        let scene = history.scene();
        let clock = history.clock();
        let mut pace = Pace::new(&history, clock.rate, clock.duration);
        pace.playing = !paused;
        let force = scene.mouse_force();
        let named = scene.named_parameters();
        let base = history.base_strength();
        // What a session that was cut off had undone is a branch from the start.
        let has_gone = history.has_undone();
        let mut stage = Stage {
            history,
            pace,
            clock,
            scenery: Arc::default(),
            topology: None,
            sceneries: 0,
            worn: 0,
            latest: Latest::default(),
            is_latest_shown: true,
            energy: 0.0,
            by: String::new(),
            velocity: None,
            placed: None,
            movers: Arc::default(),
            relaxed: Relaxed::default(),
            rungs: Rungs::new(),
            gives_back_at: None,
            escort: Escort::default(),
            yielded: None,
            deeds: Deeds::default(),
            acts: Acts::default(),
            figures_at: None,
            steps: Meter::default(),
            works: Meter::default(),
            costs: Lowest::default(),
            reached: Meter::default(),
            base,
            force,
            substeps: 0,
            has_gone,
            view: None,
            branches: Arc::default(),
            ways: Default::default(),
            among: Among::default(),
            named,
            matter: None,
            turned: Turned::default(),
            former: Former::default(),
            warned: Vec::new(),
            strained: None,
            is_aside: false,
            led_at: None,
            hauled: None,
            opened: None,
            tracks: Vec::new(),
            jam: None,
            led: None,
        };
        stage.warned = stage.history.world().warnings().to_vec();
        stage.look();
        Ok(stage)
    }

    /// Start and log, to be played on from here some time, with what redo brings again.
    pub fn folded(&self) -> Folded {
        let Pace { rate, playing, .. } = self.pace;
        let start = self.history.resumed_by(self.recording());
        Folded { start, time: self.history.world().time(), rate: Some(rate), playing }
    }

    /// The same history again, where it was folded: worked out from its start, as long as `goes_on` says so, which is told how much of it
    /// is worked out, 0 to 1. `None`: it does not go on.
    ///
    /// Errors: as of [`History::new`].
    pub fn unfolded(folded: &Folded, goes_on: impl FnMut(f64) -> bool) -> Result<Option<Self>, HistoryError> {
        let mut stage = Stage::new(folded.start.clone())?;
        if stage.pace.go_to_while((&mut stage.history, folded.time), None, goes_on).is_err() {
            return Ok(None);
        }
        stage.keep_time();
        stage.pace.rate = folded.rate.unwrap_or(stage.pace.rate);
        stage.pace.playing = folded.playing;
        Ok(Some(stage))
    }

    /// How this moment is seen: what came to its end was not paused by anybody.
    fn seen(&self) -> Seen {
        Seen { view: self.view.clone(), paused: !self.pace.playing && !self.pace.is_at_end(&self.history) }
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
        self.obey_while(order, &mut |_| true)
    }

    /// The same; what goes to another time does so as long as `goes_on` says so, which is told how much of that is worked out, 0 to 1.
    pub fn obey_while(&mut self, order: Order, goes_on: &mut dyn FnMut(f64) -> bool) -> Option<Note> {
        let (goes, passes) = (order.goes(), matches!(order, Order::Advance { .. }));
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
            Order::Place { among, fit, placing, goes_on } => self.place((&among, &fit), placing, goes_on),
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
            Order::Begin(precision, tolerance) => Some(match self.history.begun_with(precision, tolerance) {
                Ok(recording) => {
                    let view = self.view.clone();
                    Note::Begins(Box::new(Recording { view, ..recording }.into()))
                }
                Err(why) => Note::Refused(why),
            }),
            Order::Press(presses) => {
                self.pace.presses = presses;
                None
            }
            Order::Jump => {
                self.pace.jump();
                None
            }
            Order::LeadPins(way) => self.lead_pins(way),
            Order::Haul(way) => self.haul(way),
            Order::Add(adder) => Some(self.add(adder)),
            Order::Undo(_) | Order::Redo(_) | Order::GoTo(..) | Order::ToBranch(..) => match self.go(&order, goes_on) {
                Ok(note) => note,
                // All is as it was.
                Err(GivenUp) => return Some(Note::GivenUp),
            },
            Order::CallBranch(number, title) => {
                self.history.call_branch(number, &title);
                self.figures_at = None;
                None
            }
            Order::DiscardBranch(number) => {
                self.figures_at = None;
                self.history.discard_branch(number).map(Note::Discarded)
            }
            Order::Exact => self.make_exact(),
            Order::TakeBack => self.take_back(),
            Order::Reset => match self.pace.reset_while(&mut self.history, goes_on) {
                Ok(edits) => {
                    self.rungs.forget();
                    (edits != GoneBack::default()).then_some(Note::GoneBack(edits))
                }
                Err(GivenUp) => return Some(Note::GivenUp),
            },
            Order::Bound(bytes) => {
                self.history.bound_keyframes(bytes);
                None
            }
            // The thread does these.
            Order::Fold | Order::Called => None,
            Order::Rate(rate) => {
                self.pace.rate = rate;
                None
            }
            Order::Look(view) => {
                self.view = Some(view);
                None
            }
            Order::Watch(probes) => {
                self.pace.watch.set(probes, self.history.world(), self.history.scene().rate());
                let moves = self.pace.is_moving(&self.history);
                let before = self.pace.watch.look_back(&self.history, moves);
                (!before.is_empty()).then_some(Note::Before(before))
            }
            Order::Save(path) => Some(save::recording(&self.recording(), path)),
            Order::Moment(path) => Some(save::moment(&self.history, path, self.seen())),
            Order::Table(path, bytes) => Some(save::table(&bytes, path)),
            Order::Picture(path, picture) => Some(save::picture(&self.history, path, (&picture, self.seen()))),
        };
        if goes {
            // Of another past, whatever its number says.
            self.topology = None;
            self.rungs.have_gone();
            self.escort.have_gone();
            self.pace.watch.forget_waiting();
            // What was warned of there was told when it was done.
            self.warned = self.history.world().warnings().to_vec();
            (self.has_gone, self.figures_at) = (true, None);
        }
        if !passes {
            self.look_for_ways();
        }
        if comes {
            self.escort.come(&mut self.history, &mut self.pace, 0.0);
        }
        if self.pace.is_taken && !was_taken {
            self.base = self.history.base_strength();
        }
        self.keep_time();
        self.look();
        self.note_pause();
        let is_left = is_followed && !goes && self.history.branch() != branch;
        if is_left {
            (self.has_gone, self.figures_at) = (true, None);
        }
        let is_listed = || self.history.branches().iter().any(|other| other.number == branch);
        note.or((is_left && is_listed()).then_some(Note::Branched))
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
        if std::mem::take(&mut self.is_aside) {
            // That the world put it out the rest of the way comes of the same. What finds no way out is told.
            fresh.retain(|line| !line.contains("moved out as a whole"));
        }
        if let Some(strained) = self.strained.take() {
            // That bonds were given other lengths comes of the same: it is said once, in the words of what is done.
            fresh.retain(|line| !line.contains("contradict each other"));
            fresh.push(strained);
        }
        (!fresh.is_empty()).then_some(Note::Warned(fresh))
    }
}
