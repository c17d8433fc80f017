//! What is drawn click by click.

use super::build::{Path, Step};
use super::{Deed, Doing, Hand, Scope};

impl Hand {
    /// Whether something is drawn click by click.
    pub(in crate::app) fn is_drawing(&self) -> bool {
        matches!(self.doing, Doing::Drawing(_))
    }

    /// Ends what is drawn click by click, if it can end here.
    pub(in crate::app) fn finish(&mut self, scope: Scope<'_>) -> Deed {
        match std::mem::take(&mut self.doing) {
            Doing::Drawing(mut path) => {
                let step = path.finish(self.maker, scope);
                self.go_on(path, step)
            }
            doing => {
                self.doing = doing;
                Deed::default()
            }
        }
    }

    /// Leaves what is drawn click by click: bonds that were drawn come into the world.
    pub(in crate::app) fn leave_drawing(&mut self, scope: Scope<'_>) -> Deed {
        match std::mem::take(&mut self.doing) {
            Doing::Drawing(path) => path.leave(self.maker, scope),
            doing => {
                self.doing = doing;
                Deed::default()
            }
        }
    }

    /// Takes the last click of it back.
    pub(in crate::app) fn step_back(&mut self) {
        if let Doing::Drawing(path) = &mut self.doing
            && !path.step_back(self.maker)
        {
            self.doing = Doing::Nothing;
        }
    }

    pub(super) fn go_on(&mut self, path: Path, step: Step) -> Deed {
        match step {
            Step::GoesOn(words) => {
                self.doing = Doing::Drawing(path);
                words.map_or_else(Deed::default, Deed::words)
            }
            Step::Done(deed) => deed,
        }
    }
}
