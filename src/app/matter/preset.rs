//! Matter by name.

use super::change::THICKNESS;
use crate::scene::{ColorKey, KindName, Material};

/// A matter that a body can be given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preset {
    /// Soft.
    #[default]
    Jelly,
    /// Firm, and bounces.
    Rubber,
    /// Light, and tears.
    Cloth,
    /// Rigid and light.
    Wood,
    /// Rigid and heavy.
    Steel,
}

/// What a body of it is.
pub(super) struct Stuff {
    /// Of what has an area `[kg/m^2]`: relative to water these are the densities of the real ones, the cloth's that of a thin sheet.
    pub(super) density: f64,
    /// Stiffness of its springs over the mass of the body `[1/s^2]`, and damping over stiffness `[s]`; `None`: it is rigid. So a body of any
    /// size is squeezed by its weight alike, and wobbles as often.
    pub(super) springs: Option<[f64; 2]>,
    /// Strain at which its bonds break `[1]`; `None`: never.
    pub(super) breaks: Option<f64>,
    /// Of its skin `[1]`.
    pub(super) friction: f64,
    pub(super) restitution: f64,
    pub(super) color: [u8; 3],
}

impl Preset {
    /// All of them.
    pub(in crate::app) const ALL: [Preset; 5] =
        [Preset::Jelly, Preset::Rubber, Preset::Cloth, Preset::Wood, Preset::Steel];

    /// What it is called.
    pub(in crate::app) fn name(self) -> &'static str {
        match self {
            Preset::Jelly => "Jelly",
            Preset::Rubber => "Rubber",
            Preset::Cloth => "Cloth",
            Preset::Wood => "Wood",
            Preset::Steel => "Steel",
        }
    }

    /// How it behaves, in a few words.
    pub(in crate::app) fn words(self) -> &'static str {
        match self {
            Preset::Jelly => "soft, wobbles for long",
            Preset::Rubber => "firm springs that bounce and hold on",
            Preset::Cloth => "light, calm, tears when it is stretched by a third",
            Preset::Wood => "rigid and light",
            Preset::Steel => "rigid and heavy, slippery",
        }
    }

    /// Its colour.
    pub(in crate::app) fn color(self) -> [u8; 3] {
        self.stuff().color
    }

    /// What a maker makes of it: a body that covers so much `[m^2]` and whose springs are so many times as stiff as those of what is filled.
    pub(in crate::app) fn material(self, area: f64, times: f64) -> Material {
        let Stuff { density, springs, breaks, friction, restitution, color } = self.stuff();
        let mass = density * area;
        let kind = Some(if springs.is_some() { KindName::Spring } else { KindName::Rigid });
        let stiffness = springs.map(|[soft, _]| times * soft * mass);
        let damping = stiffness.zip(springs).map(|(stiffness, [_, damping])| damping * stiffness);
        Material {
            kind,
            stiffness,
            damping,
            mass: Some(mass),
            break_strain: breaks,
            friction: Some(friction),
            restitution: Some(restitution),
            color: Some(ColorKey(color)),
            ..Material::default()
        }
    }

    /// What a maker makes of it: a rope so long `[m]`, whose springs are so many times as stiff as those of what is filled. It weighs what the
    /// panel of what is selected would have it weigh.
    pub(in crate::app) fn rope(self, long: f64, times: f64) -> Material {
        self.material(THICKNESS * long, times)
    }

    pub(super) fn stuff(self) -> Stuff {
        match self {
            Preset::Jelly => Stuff {
                density: 1.0,
                // A tenth of it flows, ten times of it looks hard; a wobble is gone after some swings.
                springs: Some([250.0, 0.006]),
                breaks: None,
                friction: 0.4,
                restitution: 0.0,
                color: [255, 122, 146],
            },
            Preset::Rubber => Stuff {
                density: 1.1,
                springs: Some([2500.0, 0.001]),
                breaks: None,
                friction: 0.9,
                restitution: 0.7,
                color: [94, 158, 255],
            },
            Preset::Cloth => Stuff {
                density: 0.3,
                springs: Some([600.0, 0.03]),
                breaks: Some(0.3),
                friction: 0.6,
                restitution: 0.0,
                color: [240, 220, 168],
            },
            Preset::Wood => Stuff {
                density: 0.7,
                springs: None,
                breaks: None,
                friction: 0.5,
                restitution: 0.3,
                color: [202, 145, 92],
            },
            Preset::Steel => Stuff {
                density: 7.8,
                springs: None,
                breaks: None,
                friction: 0.2,
                restitution: 0.5,
                color: [166, 186, 206],
            },
        }
    }
}
