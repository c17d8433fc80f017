//! Single numbers that a brush paints: those that are switched on, all else stays.

use super::MatterChange;

/// A number, or a colour, that may be switched on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switched<T> {
    /// It is painted.
    pub is_on: bool,
    /// What with, also while it is off.
    pub value: T,
}

impl<T: Copy> Switched<T> {
    fn off(value: T) -> Self {
        Switched { is_on: false, value }
    }

    fn get(self) -> Option<T> {
        self.is_on.then_some(self.value)
    }
}

/// What a brush paints in place of a matter by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Painted {
    /// Of what has an area `[kg/m^2]`.
    pub density: Switched<f64>,
    /// Of springs `[N/m]`.
    pub stiffness: Switched<f64>,
    /// Of springs `[N s/m]`.
    pub damping: Switched<f64>,
    /// Strain at which bonds break `[1]`.
    pub breaks: Switched<f64>,
    /// E I of chains and skins `[N m^2]`.
    pub bending: Switched<f64>,
    /// Of skins `[1]`.
    pub friction: Switched<f64>,
    /// Of skins `[1]`, to 1.
    pub restitution: Switched<f64>,
    /// What it is filled in, red, green and blue.
    pub color: Switched<[u8; 3]>,
    /// How wide bonds are drawn `[m]`; 0: as is usual.
    pub width: Switched<f64>,
    /// Whether it is drawn.
    pub visible: Switched<bool>,
}

impl Default for Painted {
    fn default() -> Self {
        Painted {
            density: Switched::off(1.0),
            stiffness: Switched::off(300.0),
            damping: Switched::off(1.0),
            breaks: Switched::off(0.5),
            bending: Switched::off(1.0),
            friction: Switched::off(0.5),
            restitution: Switched::off(0.5),
            color: Switched::off([0x2f, 0x9e, 0x5b]),
            width: Switched::off(0.05),
            visible: Switched::off(false),
        }
    }
}

impl Painted {
    /// What is changed, one after the other.
    pub(in crate::app) fn changes(self) -> Vec<MatterChange> {
        let Painted { density, stiffness, damping, breaks, bending, friction, restitution, color, width, visible } =
            self;
        let all = [
            density.get().map(MatterChange::Density),
            stiffness.get().map(MatterChange::Stiffness),
            damping.get().map(MatterChange::Damping),
            breaks.get().map(MatterChange::Breaks),
            bending.get().map(MatterChange::Bending),
            friction.get().map(MatterChange::Friction),
            restitution.get().map(MatterChange::Restitution),
            color.get().map(MatterChange::Color),
            width.get().map(MatterChange::Width),
            visible.get().map(MatterChange::Visible),
        ];
        all.into_iter().flatten().collect()
    }

    /// Whether any is switched on.
    pub(in crate::app) fn is_any(self) -> bool {
        !self.changes().is_empty()
    }

    /// The same numbers, all switched off.
    pub(in crate::app) fn all_off(self) -> Self {
        Painted {
            density: Switched::off(self.density.value),
            stiffness: Switched::off(self.stiffness.value),
            damping: Switched::off(self.damping.value),
            breaks: Switched::off(self.breaks.value),
            bending: Switched::off(self.bending.value),
            friction: Switched::off(self.friction.value),
            restitution: Switched::off(self.restitution.value),
            color: Switched::off(self.color.value),
            width: Switched::off(self.width.value),
            visible: Switched::off(self.visible.value),
        }
    }

    /// What it is called when it is undone.
    pub(super) fn name(self) -> &'static str {
        match self.changes()[..] {
            [one] => one.name(),
            _ => "brush",
        }
    }
}
