//! Tools: what presses and strokes of the left button become. They return commands and change nothing.

mod areas;
#[cfg(test)]
mod bad_tests;
mod boxes;
mod brush;
#[cfg(test)]
mod brush_tests;
mod build;
mod choices;
mod chosen;
#[cfg(test)]
mod copy_tests;
mod cutting;
mod deed;
mod drawing;
mod drives;
#[cfg(test)]
mod drives_tests;
mod effort;
mod enclosed;
mod erase;
mod facing;
mod fastened;
#[cfg(test)]
mod flip_tests;
mod floor;
#[cfg(test)]
mod grab_tests;
mod ground;
mod grouping;
mod grown;
mod handles;
#[cfg(test)]
mod handles_tests;
mod haul;
#[cfg(test)]
mod haul_tests;
mod hidden;
#[cfg(test)]
mod hidden_tests;
mod hinge;
mod hint;
mod holding;
mod hover;
mod hub;
mod jam;
mod knot;
mod label;
mod lead;
#[cfg(test)]
mod lead_tests;
mod lifted;
mod likeness;
mod marks;
#[cfg(test)]
mod matrix_tests;
mod muscles;
#[cfg(test)]
mod muscles_tests;
mod others;
mod part;
mod patch;
#[cfg(test)]
mod patch_tests;
mod pick;
mod placing;
mod press;
mod push;
#[cfg(test)]
mod push_tests;
mod region;
mod release;
#[cfg(test)]
mod ring_tests;
mod rings;
mod room;
mod segments;
#[cfg(test)]
mod select_tests;
mod selecting;
mod selection;
mod skin;
mod slit;
#[cfg(test)]
mod space_tests;
mod stall;
#[cfg(test)]
mod stall_tests;
mod standing;
mod stopping;
mod stops;
mod strand;
#[cfg(test)]
mod tests;
mod throw;
mod touching;
mod wind;
#[cfg(test)]
mod wind_tests;

use glam::{DVec2, DVec3};

use super::action::Tool;
use crate::sim::PointId;
pub(super) use areas::touch;
use brush::Stroke;
pub(super) use brush::{Brush, RADII};
pub(super) use build::{BuiltOf, Fibre, Grain, Link, Links, REACHES, is_of_space};
use build::{Drag, Maker, Path};
pub(super) use chosen::Chosen;
use cutting::Slash;
pub(super) use deed::Deed;
pub(super) use drives::{Drives, lack_of, no_motors};
use erase::Sweep;
pub(super) use erase::clear as clear_bodies;
use facing::Hold;
use handles::Grip;
pub(super) use handles::Handle;
use haul::Haul;
pub(super) use haul::{HaulWay, Hauled};
pub(super) use hidden::bodies as hidden_bodies;
pub(super) use hover::strength;
pub(super) use label::moved as moved_label;
use lead::Lead;
pub(super) use lead::PinWay;
pub(super) use likeness::marks as labels;
pub(super) use marks::{Mark, Role, probe};
#[cfg(test)]
pub(super) use matrix_tests::{SCENES, scene_of};
use muscles::Swipe;
pub(super) use muscles::no_muscles;
pub(super) use pick::Scope;
pub(super) use press::unpin;
pub(super) use push::PushWay;
use region::Region;
pub(super) use rings::Ring;
use rings::RingGrip;
pub(super) use room::{Walls, over};
pub(super) use segments::distance_to_segment;
use selection::Selection;
pub(super) use stall::Stalls;
pub(super) use standing::Kept;
use stopping::Stop;
pub(super) use stops::would_be as would_stop;
use throw::Throw;
pub(super) use touching::gap_in;
use wind::Blow;

/// What is in the hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Held {
    /// It is led.
    Grip,
    /// It goes with the pointer.
    Move,
}

/// What the left button is doing.
#[derive(Clone, Debug, Default, PartialEq)]
enum Doing {
    #[default]
    Nothing,
    /// These points are led.
    Grabbing(Vec<PointId>),
    /// A pin is led.
    Leading(Lead),
    /// The hover force pushes through bodies.
    Pushing,
    /// A stroke, to cut what it crosses.
    Cutting(Slash),
    /// A stroke, to take away what it goes over.
    Erasing(Sweep),
    /// A primitive is drawn out.
    Building(Drag),
    /// Something is drawn click by click, also while the button is up.
    Drawing(Path),
    /// What is selected is moved, from where it was pressed on; a click selects what lies there alone.
    Moving(Hold, Chosen),
    /// What the hand pressed on from here is moved as a whole: while time stands still all, else an obstacle, which then is hauled.
    Carrying(Hold, Chosen),
    /// The label with this number is moved.
    Labelling(usize, Hold),
    /// A stop of a joint that is selected is dragged along its arc.
    Stopping(Stop),
    /// What is selected is turned or scaled by a handle.
    Handling(Grip),
    /// What is selected in space is turned or scaled by a ring.
    Turning(RingGrip),
    /// Obstacles go after the pointer while time runs.
    Hauling(Haul),
    /// A region is drawn, whose bodies are selected.
    Marking(Region),
    /// Bodies get another matter.
    Painting(Stroke),
    /// Bonds that a stroke goes over become muscles.
    Driving(Swipe),
    /// The arrow of a force is drawn or changed.
    Forcing(push::Pull),
    /// The arrow of a velocity is drawn.
    Throwing(Throw),
    /// The arrow of the wind is.
    Blowing(Blow),
}

/// The left button's tool and what it is doing.
#[derive(Clone, Debug, Default)]
pub(super) struct Hand {
    tool: Tool,
    /// The tool for pins is held by its key.
    pins: bool,
    /// There was a click meanwhile.
    has_clicked_pins: bool,
    /// The tool for cuts is held by a button.
    cuts: bool,
    /// What the tool for building makes.
    maker: Maker,
    /// What the tools for muscles and motors make.
    drives: Drives,
    /// What the brush paints with.
    brush: Brush,
    /// What the tool for forces makes, and where the arrow of the wind was drawn `[m]`.
    push: PushWay,
    wind_at: Option<DVec3>,
    /// What is selected.
    selection: Selection,
    /// A drag beside all bodies is a free stroke, not a box.
    draws_lasso: bool,
    shift: bool,
    alt: bool,
    /// Ctrl is held: a press selects one bond or one point.
    command: bool,
    /// The next press comes soon after the last one.
    is_quick: bool,
    /// What was selected before the last press, where that was on a body that a double click can be on.
    before: Option<Chosen>,
    doing: Doing,
    /// Where the button went down `[px]`, and whether the pointer left there since.
    pressed: DVec2,
    is_dragged: bool,
    /// Where something was built last, until the pointer moves on `[px]`.
    built_at: Option<DVec2>,
    /// The pin that goes with the cursor by itself.
    on_cursor: Option<Lead>,
    /// Time stands still: the hand moves bodies in place of leading them.
    is_still: bool,
    /// How far from the pointer the middle of what is led is to be `[m]`.
    beside: DVec3,
    /// What the hover force is when nothing is grabbed; `None`: the scene has none, or it goes along a track.
    strength: Option<f64>,
    /// How long the hover force stays away yet `[s]`; infinite while something is grabbed.
    calm: Option<f64>,
}
