//! The keys of the method, and the names of all solvers.

use super::budget::BudgetKeys;
use super::macros::{names, object};
use crate::sim;

names! {
    /// An integrator and a way to hold bonds.
    SolverName: "a solver" {
        /// Chosen for the scene.
        Auto = "auto",
        /// Explicit Euler.
        Euler = "euler",
        /// Semi-implicit Euler.
        SymplecticEuler = "symplectic-euler",
        /// The position form with the right start.
        Verlet = "verlet",
        /// With RATTLE.
        VelocityVerlet = "velocity-verlet",
        /// Order 4.
        Pefrl = "pefrl",
        /// Order 4.
        BlanesMoan4 = "blanes-moan-4",
        /// Order 6.
        BlanesMoan6 = "blanes-moan-6",
        /// Explicit, order 2.
        Rk2 = "rk2",
        /// Explicit, order 4.
        Rk4 = "rk4",
        /// Explicit, order 8.
        Rk8 = "rk8",
        /// For stiff springs.
        ImplicitMidpoint = "implicit-midpoint",
        /// For stiff springs, damps.
        BackwardEuler = "backward-euler",
        /// Compliant projection.
        Xpbd = "xpbd",
        /// The sources' method.
        Relaxation = "relaxation",
        /// Tridiagonal, path by path.
        Path = "path",
        /// Bodies may meet.
        Live = "live",
        /// The loop of a `source`, with its faults.
        AsPrinted = "as-printed",
    }
}

names! {
    /// A public text whose loop is run as it is printed; docs/sources.md has their faults.
    SourceName: "a source" {
        /// Verlet and one sweep: walls before it.
        Notebook = "000",
        /// The same with walls after it.
        NotebookGraph = "000-graph",
        /// Six moves to a sweep.
        Segments = "001",
        /// A rope of fifty sweeps.
        Rope = "002",
        /// Springs.
        Spring = "003",
        /// Springs by their strain: stiffness in N.
        SpringRelative = "003-relative",
        /// A cloth of fifteen sweeps.
        Cloth = "004",
    }
}

names! {
    /// The order in which a sweep takes the bonds.
    OrderName: "an order" {
        /// As coloured.
        Auto = "auto",
        /// As listed.
        Fixed = "fixed",
        /// As listed and backwards in turn.
        Symmetric = "symmetric",
        /// By colours.
        Coloured = "coloured",
        /// Anew for every sweep.
        Shuffled = "shuffled",
    }
}

names! {
    /// The scalar of a world.
    PrecisionName: "a precision" {
        /// By the size of the scene.
        Auto = "auto",
        /// 32 bits.
        F32 = "f32",
        /// 64 bits.
        F64 = "f64",
    }
}

object! {
    /// How the motion is computed; a call may set these over the file's.
    #[derive(Default)]
    MethodKeys: "a method: an object with keys such as `solver` and `substep`" {
        optional {
            /// auto if not said.
            solver: SolverName,
            /// Of `as-printed`: whose loop.
            source: SourceName,
            /// h `[s]`, > 0; chosen if not said.
            substep: f64,
            /// Sweeps in a substep, from 1 to 100000; chosen if not said.
            iterations: u32,
            /// auto if not said.
            order: OrderName,
            /// Of the shuffled order, 0 if not said.
            seed: u64,
            /// auto if not said.
            precision: PrecisionName,
            /// Largest error at every sample `[m]`, > 0.
            tolerance: f64,
            /// Largest strain `[1]`, > 0.
            max_strain: f64,
            /// Milliseconds of counted work a frame of 1/60 s, > 0, or "none": beyond, islands that auto moves are handed over to the
            /// live step. 6 if not said, but under a tolerance.
            budget: BudgetKeys,
            /// Whether what stays where it is falls asleep: true if not said, but under a tolerance.
            sleep: bool,
            /// Whether what touches something and is slow is slowed down in the live step until it rests: true if not said, but under a
            /// tolerance.
            settle: bool,
            /// Whether a ledger of the energy is kept: false if not said.
            ledger: bool,
        }
    }
}

impl SolverName {
    /// What it is called where it is read by people, not programs.
    pub fn words(self) -> &'static str {
        match self {
            SolverName::Auto => "automatic",
            SolverName::Euler => "explicit Euler",
            SolverName::SymplecticEuler => "semi-implicit Euler",
            SolverName::Verlet => "Verlet",
            SolverName::VelocityVerlet => "velocity Verlet",
            SolverName::Pefrl => "PEFRL, order 4",
            SolverName::BlanesMoan4 => "Blanes and Moan, order 4",
            SolverName::BlanesMoan6 => "Blanes and Moan, order 6",
            SolverName::Rk2 => "Runge-Kutta, order 2",
            SolverName::Rk4 => "Runge-Kutta, order 4",
            SolverName::Rk8 => "Runge-Kutta, order 8",
            SolverName::ImplicitMidpoint => "implicit midpoint",
            SolverName::BackwardEuler => "implicit Euler",
            SolverName::Xpbd => "XPBD, position based",
            SolverName::Relaxation => "relaxation, as in tutorials",
            SolverName::Path => "paths solved at once",
            SolverName::Live => "live, for bodies that meet",
            SolverName::AsPrinted => "as printed",
        }
    }
}

impl SourceName {
    /// What its loop is of.
    fn words(self) -> &'static str {
        match self {
            SourceName::Notebook => "the notebook",
            SourceName::NotebookGraph => "the notebook, walls last",
            SourceName::Segments => "points and segments",
            SourceName::Rope => "the rope",
            SourceName::Spring => "springs",
            SourceName::SpringRelative => "springs by strain",
            SourceName::Cloth => "the cloth",
        }
    }
}

impl MethodKeys {
    /// The method as it is called where people read it.
    pub fn words(&self) -> String {
        let solver = self.solver.unwrap_or(SolverName::Auto).words();
        let source = self.source.map_or_else(String::new, |source| format!(": {}", source.words()));
        let steps = self.substep.map_or_else(String::new, |substep| format!(", steps of {}", of_time(substep)));
        format!("{solver}{source}{steps}")
    }

    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        self.given().next().is_none()
    }

    /// The order of sweeps in the engine's words.
    pub(in crate::scene) fn order(&self) -> sim::Order {
        match self.order.unwrap_or(OrderName::Auto) {
            OrderName::Auto => sim::Order::Auto,
            OrderName::Fixed => sim::Order::Fixed,
            OrderName::Symmetric => sim::Order::Symmetric,
            OrderName::Coloured => sim::Order::Coloured,
            OrderName::Shuffled => sim::Order::Shuffled,
        }
    }

    /// The scalar in the engine's words.
    pub(in crate::scene) fn precision(&self) -> sim::Precision {
        match self.precision.unwrap_or(PrecisionName::Auto) {
            PrecisionName::Auto => sim::Precision::Auto,
            PrecisionName::F32 => sim::Precision::F32,
            PrecisionName::F64 => sim::Precision::F64,
        }
    }
}

/// A time `[s]` with the unit that suits it.
pub(super) fn of_time(time: f64) -> String {
    let digits = |value: f64| format!("{value:.3e}").parse::<f64>().unwrap_or(value);
    if time < 0.1 { format!("{} ms", digits(1e3 * time)) } else { format!("{} s", digits(time)) }
}
