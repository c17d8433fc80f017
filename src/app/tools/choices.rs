//! Which tool is in the hand, and what the tools make.

use glam::DVec2;

use super::{Brush, BuiltOf, Deed, Drives, Hand, Links, PushWay, Scope};
use crate::app::action::{Primitive, Tool};
use crate::sim::PointId;

impl Hand {
    /// The tool that the next press uses.
    pub(in crate::app) fn tool(&self) -> Tool {
        match (self.cuts, self.pins) {
            (true, _) => Tool::Cut,
            (false, true) => Tool::Pin,
            (false, false) => self.tool,
        }
    }

    /// Takes another tool.
    pub(in crate::app) fn take(&mut self, tool: Tool) {
        self.tool = tool;
    }

    /// The button that cuts whatever tool is taken is held, or let go.
    pub(in crate::app) fn hold_cut(&mut self, is_held: bool) {
        self.cuts = is_held;
    }

    /// Whether that button is held.
    pub(in crate::app) fn cuts(&self) -> bool {
        self.cuts
    }

    /// The key that takes the tool for pins is held, or let go; returns whether there was a click since it was held before.
    pub(in crate::app) fn hold_pins(&mut self, is_held: bool) -> bool {
        self.pins = is_held;
        std::mem::take(&mut self.has_clicked_pins)
    }

    /// What the tool for building makes.
    pub(in crate::app) fn primitive(&self) -> Primitive {
        self.maker.primitive
    }

    /// What drawn bonds are made of.
    pub(in crate::app) fn links(&self) -> Links {
        self.maker.links
    }

    /// They are made of something else from now on.
    pub(in crate::app) fn set_links(&mut self, links: Links) {
        self.maker.links = links;
    }

    /// What bodies are built of.
    pub(in crate::app) fn built_of(&self) -> BuiltOf {
        self.maker.of
    }

    /// They are built of something else from now on.
    pub(in crate::app) fn build_of(&mut self, of: BuiltOf) {
        self.maker.of = of;
    }

    /// Another primitive is to be built: with the tool for that.
    pub(in crate::app) fn choose(&mut self, primitive: Primitive) {
        self.built_at = None;
        self.maker.primitive = primitive;
        self.tool = Tool::Build;
    }

    /// What the tools for muscles and motors make.
    pub(in crate::app) fn drives(&self) -> Drives {
        self.drives
    }

    /// They make something else from now on.
    pub(in crate::app) fn set_drives(&mut self, drives: Drives) {
        self.drives = drives;
    }

    /// Whether the hinge at a pixel has a motor; `None`: none is there.
    pub(in crate::app) fn hinge_at(&self, scope: Scope<'_>, at: DVec2) -> Option<bool> {
        self.drives.hinge_at(scope, at)
    }

    /// The hinge about a hub gets the motor that the tool makes.
    pub(in crate::app) fn give_motor(&self, scope: Scope<'_>, hub: PointId) -> Deed {
        self.drives.give_motor(scope, hub)
    }

    /// What the tool for forces makes.
    pub(in crate::app) fn push_way(&self) -> PushWay {
        self.push
    }

    /// It makes something else from now on.
    pub(in crate::app) fn set_push_way(&mut self, way: PushWay) {
        self.push = way;
    }

    /// What a press makes, with the keys that are held.
    pub(super) fn pushes(&self) -> PushWay {
        match (self.shift, self.alt) {
            _ if matches!(self.push, PushWay::Wind | PushWay::Speed) => self.push,
            (_, true) => PushWay::Turn,
            (true, false) => PushWay::Body,
            _ => self.push,
        }
    }

    /// What the brush paints with.
    pub(in crate::app) fn brush(&self) -> Brush {
        self.brush
    }

    /// It paints with something else from now on.
    pub(in crate::app) fn set_brush(&mut self, brush: Brush) {
        self.brush = brush;
    }

    /// Another history begins: what the brush painted with was of the one before, its size is of the hand.
    pub(in crate::app) fn renew_brush(&mut self) {
        self.brush = Brush { radius: self.brush.radius, ..Brush::default() };
    }

    /// Whether a drag beside all bodies is a free stroke.
    pub(in crate::app) fn draws_lasso(&self) -> bool {
        self.draws_lasso
    }

    /// It is from now on, or a box.
    pub(in crate::app) fn draw_lasso(&mut self, is_lasso: bool) {
        self.draws_lasso = is_lasso;
    }

    /// Shift and Alt are held, or let go.
    pub(in crate::app) fn hold(&mut self, [shift, alt]: [bool; 2]) {
        (self.shift, self.alt) = (shift, alt);
        (self.maker.is_free, self.maker.is_from_middle) = (shift, alt);
    }

    /// Ctrl is held, or let go.
    pub(in crate::app) fn hold_command(&mut self, is_held: bool) {
        self.command = is_held;
    }

    /// The next press comes so soon after the last one that they are a double click, where both are in one place.
    pub(in crate::app) fn hasten(&mut self, is_quick: bool) {
        self.is_quick = is_quick;
    }

    /// Time stands still from now on, or runs.
    pub(in crate::app) fn stand_still(&mut self, is_still: bool) {
        self.is_still = is_still;
    }
}
