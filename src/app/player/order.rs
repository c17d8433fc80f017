//! What the window asks of the stepping thread.

use std::path::PathBuf;

use super::beside::Companions;
use super::watch::{Measured, Probes};
use crate::app::matter::{Among, Fit, MatterChange, Placing};
use crate::app::tools::{HaulWay, PinWay};
use crate::app::warnings::refused;
use crate::history::{Do, GoneBack, History, Refusal, Start, Why};
use crate::scene::{AddKeys, BudgetKeys, MethodKeys, OrderName, PrecisionName, SolverName, ViewKeys};
use crate::sim::{CommandError, Cursor};

/// Works out what comes into a running world, or why it cannot, in words.
pub(super) type Adder = Box<dyn FnOnce(&History) -> Result<Coming, String> + Send>;

/// Looks at a running world, and keeps what it saw for itself.
pub(super) type Look = Box<dyn FnOnce(&History) + Send>;

/// What comes into a running world.
#[derive(Clone, Debug)]
pub struct Coming {
    /// What brings it, undone as one.
    pub commands: Vec<Do>,
    /// What that is called.
    pub name: &'static str,
    /// The numbers that it will have, where it is a copy, and what is to be said of where it lies.
    pub came: Option<(Among, Option<&'static str>)>,
}

/// What adding a body is called.
const ADD: &str = "add a body";

impl Coming {
    /// A body or an obstacle that is no copy.
    pub fn of(keys: AddKeys) -> Self {
        Coming { commands: vec![Do::Add(Box::new(keys))], name: ADD, came: None }
    }
}

/// What is to be done, in order.
pub enum Order {
    /// A frame's time passes while the cursor goes to where it is now.
    Advance {
        /// Wall time since the last frame `[s]`.
        wall: f64,
        /// Where the cursor is; `None`: it is away.
        cursor: Option<Cursor>,
        /// Time runs back.
        back: bool,
    },
    /// It plays from now on, or not.
    Play(bool),
    /// Pauses and goes on by one frame.
    Step(Option<Cursor>),
    /// Commands at the time reached; with a name they are an edit, undone as one.
    Give(Vec<Do>, Option<&'static str>),
    /// A command that belongs to the last edit, which is called so.
    GiveOn(Do, &'static str),
    /// Bodies get another matter. `goes_on`: this belongs to the last edit.
    Change {
        /// What of them.
        among: Among,
        /// What becomes of it.
        change: MatterChange,
        /// The same was changed just before.
        goes_on: bool,
    },
    /// Bodies and obstacles are put where a number says. `goes_on`: this belongs to the last edit.
    Place {
        /// What of them.
        among: Among,
        /// What goes along with it, and how far it goes aside.
        fit: Fit,
        /// The number.
        placing: Placing,
        /// It was dragged just before.
        goes_on: bool,
    },
    /// What these are made of is shown from now on; of nothing, nothing is.
    Inspect(Among),
    /// The world is looked at, as it is now.
    Copy(Look),
    /// Others stand beside the world from now on.
    Beside(Companions),
    /// Another solver, with all else of the method as it is.
    Solver(SolverName),
    /// One number of the method, with all else of it as it is; of the same drag as the last one.
    Method(MethodSetting, bool),
    /// A history is to begin at this moment with what is fixed when one begins: a precision, and a tolerance `[m]`.
    Begin(PrecisionName, Option<f64>),
    /// Pins go to places on straight ways from where they are; one that goes on belongs to the last edit.
    LeadPins(PinWay),
    /// Obstacles go on their way and push ahead what is in it.
    Haul(HaulWay),
    /// Something comes, where there is room for it now.
    Add(Adder),
    /// The hand presses beside all bodies, or does not any more: a log that is followed is left when the cursor moves meanwhile.
    Press(bool),
    /// The cursor is where it goes next at once: nothing lies on its way there.
    Jump,
    /// Every island is moved by its own method from now on, whatever that costs: but for those that meet, where bodies do.
    Exact,
    /// What gave way to the load is taken back, and does not give way again.
    TakeBack,
    /// Back to just before the last edit, with the cursor where it is.
    Undo(Option<Cursor>),
    /// To just after the edit that was undone.
    Redo(Option<Cursor>),
    /// To a time that was seen already `[s]`.
    GoTo(f64, Option<Cursor>),
    /// Back to the start.
    Reset,
    /// Copies of the world may take so many bytes.
    Bound(usize),
    /// It is called otherwise: that is written.
    Called,
    /// It is left for long: only its start and its log are kept. The next order brings it back to where it was.
    Fold,
    /// Seconds of the scene a second of wall time.
    Rate(f64),
    /// What is written from now on is looked at like this.
    Look(ViewKeys),
    /// Energies and these points are measured at fixed times from now on; `None`: nothing is.
    Watch(Option<Probes>),
    /// All that was done is written to a file.
    Save(PathBuf),
    /// This moment is written to a file, as a scene that goes on from it, without what was done before.
    Moment(PathBuf),
    /// A table is written to a file.
    Table(PathBuf, Vec<u8>),
    /// To another branch, where it was left.
    ToBranch(usize, Option<Cursor>),
    /// A branch is called so; of an empty title, by what was done in it.
    CallBranch(usize, String),
    /// A branch is not listed any more.
    DiscardBranch(usize),
    /// A snapshot of this moment is put into the picture, which is written to a file.
    Picture(PathBuf, Box<image::RgbaImage>),
}

impl Order {
    /// Whether something is built or changed by it that would be missed: what a hand throws about is not.
    pub(in crate::app) fn is_edit(&self) -> bool {
        match self {
            Order::Give(commands, name) => name.is_some() && commands.iter().any(|act| !matches!(act, Do::Release)),
            Order::GiveOn(..) | Order::Change { .. } | Order::Solver(_) | Order::Method(..) | Order::Add(_) => true,
            Order::Haul(_) | Order::Place { .. } => true,
            _ => false,
        }
    }

    /// Whether somebody does something to the world by it, edit or not: what only looks at it, or lets time go by, is nothing done.
    pub(super) fn is_deed(&self) -> bool {
        // The hover force that comes and goes with tools pushes nothing by that.
        let is_given = |commands: &[Do]| commands.iter().any(|act| !matches!(act, Do::Mouse(_)));
        let is_hand =
            matches!(self, Order::Give(commands, None) if is_given(commands)) || matches!(self, Order::Press(true));
        let is_gone = matches!(self, Order::GoTo(..) | Order::ToBranch(..) | Order::Reset | Order::LeadPins(_));
        self.is_edit() || is_hand || is_gone || matches!(self, Order::Give(_, Some(_)) | Order::Exact | Order::TakeBack)
    }

    /// What it is called while it is worked out, of what may take long.
    pub(super) fn going(&self) -> Option<String> {
        match self {
            Order::Undo(_) => Some("Undoing".to_owned()),
            Order::Redo(_) => Some("Redoing".to_owned()),
            Order::GoTo(time, _) => Some(format!("Going to {time:.1} s")),
            Order::ToBranch(..) => Some("Going to the other timeline".to_owned()),
            Order::Reset => Some("Going back".to_owned()),
            _ => None,
        }
    }

    /// The time that it goes to, if that is all that it does `[s]`.
    pub(super) fn goes_to(&self) -> Option<f64> {
        if let Order::GoTo(time, _) = self { Some(*time) } else { None }
    }

    /// Whether the world goes to another time by it, where what was done is done already.
    pub(super) fn goes(&self) -> bool {
        matches!(
            self,
            Order::Undo(_)
                | Order::Redo(_)
                | Order::GoTo(..)
                | Order::ToBranch(..)
                | Order::Reset
                | Order::Advance { back: true, .. }
        )
    }
}

/// Tells what became of an order.
#[derive(Clone, Debug, PartialEq)]
pub enum Note {
    /// What was undone is called so, and time went so far `[s]`, below 0 back.
    Undone(String, f64),
    /// What was redone, and how far time went `[s]`, below 0 back.
    Redone(String, f64),
    /// There was nothing to undo.
    NothingToUndo,
    /// There was nothing to redo.
    NothingToRedo,
    /// The start was gone to: what became of edits.
    GoneBack(GoneBack),
    /// A branch was discarded, which was called so.
    Discarded(String),
    /// What was to be worked out was given up: all is as it was.
    GivenUp,
    /// A log was followed until now; what is done from here on is another branch.
    Branched,
    /// What would have been measured before now, had it been watched.
    Before(Vec<Measured>),
    /// Something was added. Bodies do not meet: why, if that could not be had.
    Added(Option<String>),
    /// A copy came: its numbers, and what is to be said of where it lies; why bodies do not meet, if that could not be had.
    Came(Among, Option<&'static str>, Option<String>),
    /// Islands are moved by their own methods from now on.
    Exact,
    /// What a history is to begin with.
    Begins(Box<Start>),
    /// A command could not be done where it stood.
    Refused(String),
    /// Nothing could be grabbed: pins hold all that was in reach.
    Held,
    /// An edit was done, and this should be known of it.
    Warned(Vec<String>),
    /// A file was written.
    Written(PathBuf),
    /// A file was not.
    NotWritten(String),
    /// What would outlive a killed program, or what it is recorded to, could not be written; it is tried again.
    NotKept(String),
}

impl From<Refusal> for Note {
    fn from(refusal: Refusal) -> Self {
        match refusal.reason {
            Why::World(CommandError::Held) => Note::Held,
            why => Note::Refused(refused(&why)),
        }
    }
}

/// A number of the method, or a switch; `None`: as the rules choose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MethodSetting {
    /// Longest substep `[s]`.
    Substep(Option<f64>),
    /// Sweeps in a substep.
    Iterations(Option<u32>),
    /// In which order a sweep takes the bonds.
    Order(OrderName),
    /// The seed of the order that is shuffled.
    Seed(u64),
    /// Largest strain of rigid bonds `[1]`.
    MaxStrain(Option<f64>),
    /// Counted work of a frame beyond which something cheaper moves bodies `[ms]`; `None`: whatever it takes.
    Budget(Option<f64>),
    /// What stays where it is falls asleep.
    Sleep(bool),
    /// What lies on something comes to rest.
    Settle(bool),
}

impl MethodSetting {
    /// What it is called when it is undone.
    pub(crate) fn name(self) -> &'static str {
        match self {
            MethodSetting::Substep(_) => "substep",
            MethodSetting::Iterations(_) => "iterations",
            MethodSetting::Order(_) => "order",
            MethodSetting::Seed(_) => "seed",
            MethodSetting::MaxStrain(_) => "max_strain",
            MethodSetting::Budget(_) => "budget",
            MethodSetting::Sleep(_) => "sleep",
            MethodSetting::Settle(_) => "settle",
        }
    }

    /// The keys of a method with it.
    pub(super) fn within(self, keys: MethodKeys) -> MethodKeys {
        match self {
            MethodSetting::Substep(substep) => MethodKeys { substep, ..keys },
            MethodSetting::Iterations(iterations) => MethodKeys { iterations, ..keys },
            MethodSetting::Order(order) => MethodKeys { order: Some(order), ..keys },
            MethodSetting::Seed(seed) => MethodKeys { seed: Some(seed), ..keys },
            MethodSetting::MaxStrain(max_strain) => MethodKeys { max_strain, ..keys },
            MethodSetting::Budget(ms) => {
                MethodKeys { budget: Some(ms.map_or(BudgetKeys::None, BudgetKeys::Ms)), ..keys }
            }
            MethodSetting::Sleep(sleep) => MethodKeys { sleep: Some(sleep), ..keys },
            MethodSetting::Settle(settle) => MethodKeys { settle: Some(settle), ..keys },
        }
    }
}
