//! The methods by name: what each is, and which bonds it takes.

use std::fmt;

use super::bond::BondKind;
use super::source::Source;

/// The integrator and the way bonds are held.
///
/// Errors per unit of time fall as the order says while h is below the stability limit; omega is the fastest
/// oscillation of the springs `[rad/s]`. Rigid bonds hold to rounding where they are solved directly (islands of up to
/// 2,000), to 1e-10 where they are swept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Every island by the cheapest method that is right for what it is made of.
    #[default]
    Auto,
    /// Flight under gravity and drag in closed form, for points that nothing else acts on.
    Flight,
    /// A rigid body with three degrees of freedom, what rigid bonds hold in its shape in the plane: in closed form, but for what pushes it
    /// and what it lies on (order 2).
    Rigid,
    /// Explicit Euler: order 1, unstable on undamped oscillations. Rigid bonds are projected at the end.
    Euler,
    /// Kick, then drift: order 1, stable up to omega h = 2. Rigid bonds are projected at the end.
    SymplecticEuler,
    /// Verlet's method with the right start: order 2, stable up to omega h = 2. Rigid bonds are swept along their old
    /// direction until they hold (SHAKE).
    Verlet,
    /// Verlet's method with velocities: order 2, stable up to omega h = 2. Rigid bonds by RATTLE, solved directly.
    VelocityVerlet,
    /// A splitting of order 4 in 4 forces, stable up to omega h = 2.97. Rigid bonds: RATTLE composed to order 4.
    Pefrl,
    /// A splitting of order 4 in 6 forces with a small error constant. Rigid bonds: RATTLE composed to order 4.
    BlanesMoan4,
    /// A splitting of order 6 in 14 forces. Rigid bonds: RATTLE composed to order 6.
    BlanesMoan6,
    /// Explicit midpoint: order 2.
    Rk2,
    /// The classical Runge-Kutta method: order 4, stable up to omega h = 2.83. Rigid bonds by multipliers.
    Rk4,
    /// Dormand and Prince's method of order 8 in 12 forces. Rigid bonds by multipliers.
    Rk8,
    /// Implicit: order 2, stable at any substep; what springs and rigid bonds do keeps energy.
    ImplicitMidpoint,
    /// Implicit: order 1, stable at any substep, damps what it does not resolve.
    BackwardEuler,
    /// Compliant projection: order 1, stable at any substep; springs are softer than they should be until sweeps
    /// converge.
    Xpbd,
    /// Every bond swept along its present direction, rigid ones as relaxed with relaxation 1: order 1.
    Relaxation,
    /// Paths of bonds solved at once, path after path: order 1 in the bonds, stable at any substep, and far stiffer than
    /// sweeps where paths are long.
    Path,
    /// Fixed work in every substep, order 1; bodies may meet.
    Live,
    /// The loop of a source as it is printed, with its faults: order 1.
    AsPrinted(Source),
}

impl Solver {
    /// All that can be asked for by name alone.
    pub const ALL: [Solver; 17] = [
        Solver::Auto,
        Solver::Euler,
        Solver::SymplecticEuler,
        Solver::Verlet,
        Solver::VelocityVerlet,
        Solver::Pefrl,
        Solver::BlanesMoan4,
        Solver::BlanesMoan6,
        Solver::Rk2,
        Solver::Rk4,
        Solver::Rk8,
        Solver::ImplicitMidpoint,
        Solver::BackwardEuler,
        Solver::Xpbd,
        Solver::Relaxation,
        Solver::Path,
        Solver::Live,
    ];

    /// Its name in scene files and calls.
    pub fn name(self) -> &'static str {
        match self {
            Solver::Auto => "auto",
            Solver::Flight => "flight",
            Solver::Rigid => "rigid",
            Solver::Euler => "euler",
            Solver::SymplecticEuler => "symplectic-euler",
            Solver::Verlet => "verlet",
            Solver::VelocityVerlet => "velocity-verlet",
            Solver::Pefrl => "pefrl",
            Solver::BlanesMoan4 => "blanes-moan-4",
            Solver::BlanesMoan6 => "blanes-moan-6",
            Solver::Rk2 => "rk2",
            Solver::Rk4 => "rk4",
            Solver::Rk8 => "rk8",
            Solver::ImplicitMidpoint => "implicit-midpoint",
            Solver::BackwardEuler => "backward-euler",
            Solver::Xpbd => "xpbd",
            Solver::Relaxation => "relaxation",
            Solver::Path => "path",
            Solver::Live => "live",
            Solver::AsPrinted(_) => "as-printed",
        }
    }

    /// Order of convergence of smooth motion.
    pub fn order(self) -> u32 {
        match self {
            Solver::Euler
            | Solver::SymplecticEuler
            | Solver::BackwardEuler
            | Solver::Xpbd
            | Solver::Relaxation
            | Solver::Path
            | Solver::Live
            | Solver::AsPrinted(_) => 1,
            Solver::Auto
            | Solver::Rigid
            | Solver::Verlet
            | Solver::VelocityVerlet
            | Solver::Rk2
            | Solver::ImplicitMidpoint => 2,
            Solver::Pefrl | Solver::BlanesMoan4 | Solver::Rk4 => 4,
            Solver::BlanesMoan6 => 6,
            Solver::Rk8 | Solver::Flight => 8,
        }
    }

    /// Whether the method has no use for bonds of a kind: the kind in words, and solvers that would do.
    pub fn refusal(self, kind: BondKind) -> Option<(&'static str, &'static str)> {
        match (kind, self) {
            (kind, Solver::AsPrinted(source)) => source.refusal(kind),
            (BondKind::Spring { .. }, Solver::Relaxation) => {
                Some(("a spring", "auto, verlet, pefrl, rk4 or implicit-midpoint"))
            }
            (
                BondKind::Relaxed { .. },
                Solver::Pefrl
                | Solver::BlanesMoan4
                | Solver::BlanesMoan6
                | Solver::Rk2
                | Solver::Rk4
                | Solver::Rk8
                | Solver::ImplicitMidpoint
                | Solver::BackwardEuler
                | Solver::Flight
                | Solver::Rigid
                | Solver::Path,
            ) => Some(("relaxed", "auto, euler, symplectic-euler, verlet, velocity-verlet, xpbd, relaxation or live")),
            _ => None,
        }
    }

    /// Whether the method has no use for angles and areas: solvers that would do.
    pub fn form_refusal(self) -> Option<&'static str> {
        matches!(self, Solver::Relaxation | Solver::Xpbd | Solver::Path | Solver::Flight | Solver::AsPrinted(_))
            .then_some("auto, verlet, velocity-verlet, pefrl, rk4, implicit-midpoint or live")
    }

    /// The one that is written so: its name, and behind that of the sources' loops which.
    pub fn of_label(label: &str) -> Option<Solver> {
        let printed = Source::ALL.map(Solver::AsPrinted);
        Solver::ALL.into_iter().chain(printed).find(|solver| solver.to_string() == label)
    }

    /// Whether rigid bonds are solved together where there are not too many.
    pub(crate) fn solves_directly(self) -> bool {
        !matches!(
            self,
            Solver::Verlet | Solver::Relaxation | Solver::Xpbd | Solver::Path | Solver::Live | Solver::AsPrinted(_)
        )
    }

    /// Whether walls, the edge of the mouse region and turns of bonds are located in time: where the order would be lost
    /// otherwise.
    pub(crate) fn locates_events(self) -> bool {
        self.order() >= 4
    }
}

impl fmt::Display for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Solver::AsPrinted(source) => write!(f, "{} {source}", self.name()),
            _ => f.write_str(self.name()),
        }
    }
}

/// The order in which a sweep takes the bonds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// As [`Order::Coloured`].
    #[default]
    Auto,
    /// As listed, every sweep: feeds energy into over-determined meshes, and exists to show that.
    Fixed,
    /// As listed and backwards, sweep by sweep in turn.
    Symmetric,
    /// By colours: no two bonds of one colour share a point.
    Coloured,
    /// Shuffled anew for every sweep, from the seed.
    Shuffled,
}
