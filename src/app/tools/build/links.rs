//! What drawn bonds are made of.

use super::neighbours::REACH;
use crate::app::matter::Preset;
use crate::scene::{BondKeys, LimitName, Material};

/// How a bond that is drawn resists.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) enum Link {
    /// It keeps its length.
    #[default]
    Rod,
    /// It pulls back to its length.
    Spring,
    /// It gets no longer, and goes slack.
    String,
}

/// What the tool for points and bonds makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::app) struct Links {
    pub(in crate::app) link: Link,
    /// A loop that is closed becomes a body.
    pub(in crate::app) fills: bool,
    /// A new point is bonded to those about it too.
    pub(in crate::app) connects: bool,
    /// How far away these may be `[logical px]`.
    pub(in crate::app) reach: u32,
}

impl Default for Links {
    fn default() -> Self {
        Links { link: Link::default(), fills: false, connects: false, reach: REACH }
    }
}

impl Link {
    /// All of them.
    pub(in crate::app) const ALL: [Link; 3] = [Link::Rod, Link::Spring, Link::String];

    /// What it is called.
    pub(in crate::app) fn name(self) -> &'static str {
        match self {
            Link::Rod => "rod",
            Link::Spring => "spring",
            Link::String => "string",
        }
    }
}

impl Links {
    pub(super) fn name(self) -> &'static str {
        self.link.name()
    }

    /// A bond of a chain that brings so many points of 1 kg: springs are as soft for them as those of a soft box for its mass.
    pub(super) fn bond(self, ends: BondKeys, points: usize) -> BondKeys {
        match self.link {
            Link::Rod => ends,
            Link::String => BondKeys { limit: Some(LimitName::Max), ..ends },
            Link::Spring => {
                let Material { kind, stiffness, damping, .. } = Preset::Jelly.material(points.max(1) as f64, 1.0);
                BondKeys { kind, stiffness, damping, ..ends }
            }
        }
    }
}
