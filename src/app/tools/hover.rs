//! The hover force is the hand's: it goes while something is led, and with any other tool.

use super::{Deed, Doing, Hand};
use crate::app::action::Tool;
use crate::history::Do;
use crate::sim::MouseChange;

/// The hover force stays away so long after a grab `[s]`: what was thrown is not blown off its way.
pub(super) const CALM: f64 = 0.2;

/// The hover force gets another strength.
pub(in crate::app) fn strength(strength: f64) -> Do {
    Do::Mouse(MouseChange { strength: Some(strength), ..MouseChange::default() })
}

impl Hand {
    /// Another scene, or another strength by hand.
    pub(in crate::app) fn set_strength(&mut self, strength: Option<f64>) {
        self.strength = strength;
    }

    /// What the hover force is when nothing is grabbed.
    pub(in crate::app) fn strength(&self) -> Option<f64> {
        self.strength
    }

    /// Whether the hover force pushes while the button is down.
    pub(in crate::app) fn is_pushing(&self) -> bool {
        self.doing == Doing::Pushing
    }

    /// Whether the hover force stays away.
    pub(in crate::app) fn is_calm(&self) -> bool {
        self.calm.is_some()
    }

    /// Whether the hover force is about to come or go.
    pub(in crate::app) fn is_fading(&self) -> bool {
        match (self.tool(), self.calm) {
            (Tool::Hand, Some(_)) => !self.leads(),
            (Tool::Hand, None) => false,
            (_, calm) => self.strength.is_some() && calm.is_none_or(f64::is_finite),
        }
    }

    /// Whether anything follows the cursor.
    pub(super) fn leads(&self) -> bool {
        self.is_grabbing() || self.is_leading() || self.is_carrying() || self.is_hauling()
    }

    /// The hover force goes away, if it is there.
    pub(super) fn calm_now(&mut self) -> Vec<Do> {
        let is_there = self.strength.is_some() && self.calm.is_none();
        self.calm = Some(f64::INFINITY);
        if is_there { vec![strength(0.0)] } else { Vec::new() }
    }

    /// A frame passes. The hover force is the hand's: with another tool it goes, and a while after a grab it comes back.
    pub(in crate::app) fn pass(&mut self, seconds: f64) -> Deed {
        if self.tool() != Tool::Hand {
            return Deed::plain(self.calm_now());
        }
        if !self.leads() {
            // Nothing keeps it away any more.
            self.calm = self.calm.map(|calm| calm.min(CALM));
        }
        let Some(calm) = &mut self.calm else { return Deed::default() };
        *calm -= seconds;
        if *calm > 0.0 {
            return Deed::default();
        }
        self.calm = None;
        Deed::plain(self.strength.map(strength).into_iter().collect())
    }
}
