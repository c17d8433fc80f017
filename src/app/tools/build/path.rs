//! What is drawn click by click: it goes on while the button is up.

use glam::DVec2;

use super::chain::{Chain, How};
use super::polygon::Outline;
use super::{Maker, Step};
use crate::app::action::Primitive;
use crate::app::tools::Deed;
use crate::app::tools::marks::Mark;
use crate::app::tools::pick::Scope;

/// An outline, or points and bonds.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::app::tools) struct Path {
    outline: Outline,
    chain: Chain,
}

impl Maker {
    /// What a chain comes to: a loop is filled by the switch or by Shift.
    fn how(self) -> How {
        How { links: self.links, fills: (self.links.fills || self.is_free).then_some((self.of.filled, self.of.grain)) }
    }

    fn draws_polygon(self) -> bool {
        self.primitive == Primitive::Polygon
    }
}

impl Path {
    pub(in crate::app::tools) fn press(&mut self, maker: Maker, scope: Scope<'_>, at: DVec2) -> Step {
        if maker.draws_polygon() { self.outline.press(scope, at) } else { self.chain.press(scope, at, maker.links) }
    }

    /// The pointer moves while the button is down.
    pub(in crate::app::tools) fn trace(&mut self, scope: Scope<'_>, at: DVec2) {
        self.outline.trace(scope, at);
    }

    pub(in crate::app::tools) fn release(&mut self, maker: Maker, scope: Scope<'_>, at: DVec2) -> Step {
        if maker.draws_polygon() { self.outline.release(scope, at) } else { self.chain.release(scope, at, maker.how()) }
    }

    /// Enter: an outline is closed if it can be, a chain ends as it is.
    pub(in crate::app::tools) fn finish(&mut self, maker: Maker, scope: Scope<'_>) -> Step {
        if maker.draws_polygon() { self.outline.close(scope) } else { Step::Done(self.chain.end(scope, maker.how())) }
    }

    /// Esc, or another tool: an outline goes, and the bonds of a chain come.
    pub(in crate::app::tools) fn leave(&self, maker: Maker, scope: Scope<'_>) -> Deed {
        if self.chain.has_bonds() { self.chain.end(scope, maker.how()) } else { Deed::default() }
    }

    /// Takes the last click back. Returns whether there is one left.
    pub(in crate::app::tools) fn step_back(&mut self, maker: Maker) -> bool {
        if maker.draws_polygon() { self.outline.step_back() } else { self.chain.step_back() }
    }

    /// What it is so far, and what a press at the pixel would make of it.
    pub(in crate::app::tools) fn marks(&self, maker: Maker, scope: Scope<'_>, at: Option<DVec2>) -> Vec<Mark> {
        match maker.draws_polygon() {
            true => self.outline.marks(scope, at),
            false => self.chain.marks(scope, at, maker.how()),
        }
    }
}
