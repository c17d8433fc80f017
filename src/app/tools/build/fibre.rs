//! What is built is made of: what is filled a matter, ropes and cloths a fibre each.

use super::grain::Grain;
use super::matter::{CLOTH_MASS, ROPE_MASS, rigid};
use crate::app::action::Primitive;
use crate::app::matter::Preset;
use crate::render::{Look, in_bytes};
use crate::scene::Material;

/// Springs of ropes and cloths of rubber are so many times as stiff as those of what is filled: a rope of the usual size that bears a box of
/// jelly of the usual size is drawn out by an eighth, where one twenty times as stiff would look like cord.
const OF_RUBBER: f64 = 0.05;
/// The same of threads: one bears a kilogram and hardly gives.
const OF_THREAD: f64 = 4.0;

/// What a rope or a cloth is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) enum Fibre {
    /// It keeps its length, and bears anything.
    #[default]
    Plain,
    /// It tears.
    Thin,
    /// It stretches.
    Rubber,
    /// It keeps its length, and is heavy.
    Steel,
}

impl Fibre {
    /// All of them.
    pub(in crate::app) const ALL: [Fibre; 4] = [Fibre::Plain, Fibre::Thin, Fibre::Rubber, Fibre::Steel];

    /// The matter that it is of; plain ones are of none that has a name.
    fn preset(self) -> Option<Preset> {
        match self {
            Fibre::Plain => None,
            Fibre::Thin => Some(Preset::Cloth),
            Fibre::Rubber => Some(Preset::Rubber),
            Fibre::Steel => Some(Preset::Steel),
        }
    }

    /// What it is called, of a rope or of a cloth.
    pub(in crate::app) fn name(self, of: Primitive) -> &'static str {
        match (self, of == Primitive::Rope) {
            (Fibre::Plain, true) => "Cord",
            (Fibre::Plain, false) => "Linen",
            (Fibre::Thin, true) => "Thread",
            (Fibre::Thin, false) => "Gauze",
            (Fibre::Rubber, _) => "Rubber",
            (Fibre::Steel, _) => "Steel",
        }
    }

    /// How it behaves, in a few words.
    pub(in crate::app) fn words(self) -> &'static str {
        match self {
            Fibre::Plain => "keeps its length and bears anything",
            Fibre::Thin => "light, tears when it is stretched by a third",
            Fibre::Rubber => "stretches under what it bears, and springs back",
            Fibre::Steel => "keeps its length, and is heavy",
        }
    }

    /// Its colour, of a rope or of a cloth: plain ones are drawn as all ropes and bonds are that have none of their own.
    pub(in crate::app) fn color(self, of: Primitive, look: &Look) -> [u8; 3] {
        let plain = if of == Primitive::Rope { look.rope } else { look.bond };
        self.preset().map_or_else(|| in_bytes(plain), Preset::color)
    }

    /// Of a rope so long `[m]` that has so many pieces, which pull one behind another.
    pub(super) fn rope(self, long: f64, pieces: u32) -> Material {
        let thread = if self == Fibre::Thin { OF_THREAD } else { 1.0 };
        let times = thread * self.times() * f64::from(pieces);
        self.preset().map_or_else(|| rigid(ROPE_MASS * long), |of| of.rope(long, times))
    }

    /// Of a cloth that covers so much `[m^2]`.
    pub(super) fn cloth(self, area: f64) -> Material {
        self.preset().map_or_else(|| rigid(CLOTH_MASS * area), |of| of.material(area, self.times()))
    }

    /// How many times as stiff as those of what is filled its springs are: what tears is as stiff, or it would tear under little.
    fn times(self) -> f64 {
        if self == Fibre::Rubber { OF_RUBBER } else { 1.0 }
    }
}

/// What the tool for building makes its bodies of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) struct BuiltOf {
    /// Boxes, discs, rims and loops.
    pub(in crate::app) filled: Preset,
    /// How finely these are made.
    pub(in crate::app) grain: Grain,
    pub(in crate::app) rope: Fibre,
    pub(in crate::app) cloth: Fibre,
}
