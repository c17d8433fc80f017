//! What the hand is doing, and what is drawn of it.

use glam::{DVec2, DVec3};

use super::{Chosen, Doing, Hand, Held, Mark, PushWay, Scope, hidden, marks, push, throw, wind};
use crate::app::action::Tool;
use crate::sim::Cursor;

impl Hand {
    /// Whether something is led.
    pub(in crate::app) fn is_grabbing(&self) -> bool {
        matches!(self.doing, Doing::Grabbing(_))
    }

    /// Whether the hand moves something as a whole.
    pub(in crate::app) fn is_carrying(&self) -> bool {
        matches!(self.doing, Doing::Carrying(..))
    }

    /// Whether a pin is led.
    pub(in crate::app) fn is_leading(&self) -> bool {
        matches!(self.doing, Doing::Leading(_))
    }

    /// Where what is led goes, with the cursor here.
    pub(in crate::app) fn led_to(&self, cursor: Cursor) -> Cursor {
        if !self.is_grabbing() {
            return cursor;
        }
        Cursor { origin: (DVec3::from(cursor.origin) + self.beside).to_array(), ..cursor }
    }

    /// How the pointer looks while the button does something; `None`: as before.
    pub(in crate::app) fn holds(&self) -> Option<Held> {
        match self.doing {
            Doing::Grabbing(_) | Doing::Leading(_) | Doing::Stopping(_) => Some(Held::Grip),
            Doing::Moving(..) | Doing::Carrying(..) | Doing::Labelling(..) | Doing::Hauling(_) => Some(Held::Move),
            _ => None,
        }
    }

    /// Whether the button is doing anything.
    pub(in crate::app) fn is_busy(&self) -> bool {
        self.doing != Doing::Nothing
    }

    /// Where the middle of what is led goes, with the pointer at a pixel.
    pub(super) fn led_at(&self, scope: Scope<'_>, at: DVec2) -> DVec2 {
        if !self.is_grabbing() || self.beside == DVec3::ZERO {
            return at;
        }
        let middle = scope.shown.grab.as_ref().map_or_else(|| scope.camera.focus(), |grab| DVec3::from(grab.middle));
        let to = scope.facing(middle, at) + self.beside;
        scope.camera.screen_from_world(to).map_or(at, DVec2::from)
    }

    /// What a click at the pixel would do, to be drawn.
    pub(in crate::app) fn marks(&self, scope: Scope<'_>, at: Option<DVec2>) -> Vec<Mark> {
        let own = (self.tool(), self.maker, self.is_still);
        let mut marks = match (self.tool(), at) {
            (Tool::Muscle, Some(at)) => match &self.doing {
                Doing::Driving(swipe) => self.drives.muscle.marks(scope, swipe, at),
                _ => self.drives.muscle.would_be(scope, at),
            },
            (Tool::Motor, Some(at)) => self.drives.mark_motor(scope, at, self.shift),
            (Tool::Paint, Some(at)) => self.brush.marks(scope, at),
            (Tool::Push, at) if self.pushes() == PushWay::Wind => match (&self.doing, at) {
                (Doing::Blowing(blow), Some(at)) => blow.marks(scope, at),
                (_, at) => wind::marks(scope, self.wind_at, at),
            },
            (Tool::Push, at) if self.pushes() == PushWay::Speed => match (&self.doing, at) {
                (Doing::Throwing(throw), Some(at)) => throw.marks(scope, at),
                (_, at) => at.map_or_else(Vec::new, |at| throw::marks(scope, at)),
            },
            (Tool::Push, Some(at)) if self.doing == Doing::Nothing => self.pushes().marks(scope, at),
            (Tool::Select, Some(at)) if self.command && !self.alt && !self.is_busy() => {
                let part = Chosen::part_at(scope, at).map(|part| part.part_marks(scope));
                part.unwrap_or_else(|| marks::of(own, &self.doing, scope, Some(at)))
            }
            // What would come next is not shown over what has just come.
            (Tool::Build, _) if self.built_at.is_some() && !self.is_busy() => Vec::new(),
            _ => marks::of(own, &self.doing, scope, at.map(|at| self.led_at(scope, at))),
        };
        let pull = if let Doing::Forcing(pull) = &self.doing { Some(pull) } else { None };
        marks.splice(0..0, push::arrows(scope, pull));
        marks.extend(pull.zip(at).into_iter().flat_map(|(pull, at)| pull.marks(scope, at)));
        if let Doing::Painting(stroke) = &self.doing {
            marks.extend(stroke.marks(scope, self.brush.color()));
        }
        if self.tool() == Tool::Select {
            marks.splice(0..0, hidden::outlines(scope));
        }
        if let Some(chosen) = self.chosen(scope) {
            marks.extend(self.selection_marks(scope, &chosen, at));
        }
        marks
    }
}
