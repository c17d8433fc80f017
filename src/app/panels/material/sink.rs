//! What the rows of the panel ask for.

use egui::{Id, Response};

use crate::app::action::Action;
use crate::app::matter::{MatterChange, Placing};
use crate::app::panels::Wish;
use crate::app::panels::settings::Setting;
use crate::history::Do;

/// Where changes go to.
pub(in crate::app::panels) struct Sink<'a> {
    /// What is being dragged.
    pub(super) gesture: &'a mut Option<Id>,
    pub(super) wishes: &'a mut Vec<Wish>,
    /// The pointer rests on what gives joints stops.
    pub(in crate::app::panels) previews_stops: &'a mut bool,
}

impl Sink<'_> {
    /// What is dragged on is one edit.
    pub(in crate::app::panels) fn set(&mut self, by: &Response, change: MatterChange) {
        let goes_on = *self.gesture == Some(by.id);
        *self.gesture = by.ctx.input(|input| input.pointer.any_down()).then_some(by.id);
        self.wishes.push(Wish::Matter(change, goes_on));
    }

    /// The same of where it is.
    pub(super) fn place(&mut self, by: &Response, placing: Placing) {
        let goes_on = *self.gesture == Some(by.id);
        *self.gesture = by.ctx.input(|input| input.pointer.any_down()).then_some(by.id);
        self.wishes.push(Wish::Place(placing, goes_on));
    }

    pub(super) fn act(&mut self, action: Action) {
        self.wishes.push(Wish::Act(action));
    }

    /// A command; what is dragged on is one edit.
    pub(in crate::app::panels) fn give(&mut self, by: &Response, act: Do, name: &'static str) {
        let goes_on = *self.gesture == Some(by.id);
        *self.gesture = by.ctx.input(|input| input.pointer.any_down()).then_some(by.id);
        self.wishes.push(Wish::Set(Setting { act, name, goes_on }));
    }

    /// Commands of one click, and what they are called.
    pub(in crate::app::panels) fn give_all(&mut self, acts: Vec<Do>, name: &'static str) {
        self.wishes.push(Wish::Give(acts, name));
    }
}
