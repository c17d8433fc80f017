//! Tools are taken and let go, and what they did is given to the world.

use std::time::Duration;

use super::Session;
use super::asking::points_of;
use crate::app::action::{Primitive, Tool};
use crate::app::count::counted;
use crate::app::panels::Opened;
use crate::app::player::Order;
use crate::app::tools::{Deed, PushWay, is_of_space, lack_of, unpin};

/// A key that is let go so soon was pressed for a moment.
const TAP: Duration = Duration::from_millis(400);

impl Session {
    /// Takes a tool; one that has no panel which says what to do says so.
    pub(super) fn take(&mut self, tool: Tool) {
        if let Some(why) = lack_of(tool, self.shown().driving) {
            return self.refuse(&why);
        }
        self.leave_drawing();
        self.hand.take(tool);
        self.panels.take(tool);
        // It is of the hand.
        self.place_hint();
        self.find_hinge();
        if tool == Tool::Build && self.scene.dimensions() == 3 && !is_of_space(self.hand.primitive()) {
            self.hand.choose(Primitive::SolidCircle);
        }
        if tool == Tool::Push {
            // Wind has a button of its own, and torques are of the plane.
            match self.hand.push_way() {
                PushWay::Turn if self.scene.dimensions() != 2 => self.hand.set_push_way(PushWay::default()),
                PushWay::Wind => self.hand.set_push_way(PushWay::default()),
                _ => {}
            }
        }
        let words = match tool {
            Tool::Pin => "pin: click a point to hold it where it is, or a pin to let it go",
            Tool::Cut => "cut: drag across bonds",
            Tool::Erase => "erase: click bodies, bonds and obstacles, or drag over them; Ctrl+Z brings them back",
            _ => return,
        };
        self.say(words.to_owned());
    }

    /// The key of the tool that builds, while that is taken: it makes the next thing.
    pub(in crate::app) fn build_next(&mut self) {
        self.leave_drawing();
        let mut next = self.hand.primitive().next();
        while self.scene.dimensions() == 3 && !is_of_space(next) {
            next = next.next();
        }
        self.hand.choose(next);
        self.panels.bring(Opened::Tool);
        self.say(format!("build: {}", next.name().to_lowercase()));
        self.touch();
    }

    /// The key that takes the tool for pins was let go: pressed for a moment without a click it lets the pin under the pointer go.
    pub(super) fn end_pins(&mut self) {
        let is_tap = self.pins_since.take().is_some_and(|since| since.elapsed() < TAP);
        let is_used = self.hand.hold_pins(false);
        if let Some(at) = self.pixel().filter(|_| is_tap && !is_used && !self.is_over_panels()) {
            let deed = self.with_scope(|_, scope| unpin(scope, at));
            self.do_deed(deed);
        }
    }

    /// Leaves what is drawn click by click: bonds that were drawn come into the world.
    pub(super) fn leave_drawing(&mut self) {
        if self.hand.is_drawing() {
            let deed = self.with_scope(|hand, scope| hand.leave_drawing(scope));
            self.do_deed(deed);
        }
    }

    pub(super) fn delete(&mut self) {
        let at = self.pixel();
        let deed = self.with_scope(|hand, scope| hand.delete(scope, at));
        self.do_deed(deed);
    }

    /// Gives commands to the world, if there are any.
    pub(super) fn do_deed(&mut self, deed: Deed) {
        if let Some(words) = deed.words.clone() {
            let over = self.lies_over();
            self.panels.notes.say_of_tool(words, over);
            self.touch();
        }
        if deed.edit.is_some() {
            self.panels.notes.offer_motor(deed.motor_for);
        }
        if let Some(among) = deed.painted.clone() {
            let brush = self.hand.brush();
            let change = brush.change();
            let bonds = among.bonds.as_ref().map_or(0, Vec::len);
            self.say(format!(
                "{}: {} and {}; Ctrl+Z takes it back",
                brush.name(),
                counted(among.points.len(), "point"),
                counted(bonds, "bond")
            ));
            self.painted.extend(&among.points);
            self.player.ask(Order::Change { among, change, goes_on: false });
            self.dirty = true;
        }
        if !deed.is_empty() {
            let coming = points_of(&deed.commands, &self.scene);
            self.ask_if_full(coming, move |session| session.player.give(deed.commands, deed.edit));
        }
    }
}
