//! The method of a scene: names to meanings.

use super::error::Problem;
use super::file::{MethodFile, OrderFile, PrecisionFile};
use super::material::{above_zero, at_least_zero};
use crate::sim::{Method, Order, Precision, Solver};

/// Solvers that the format names and this version hasn't.
const MISSING: [&str; 13] = [
    "euler",
    "symplectic-euler",
    "velocity-verlet",
    "pefrl",
    "blanes-moan-4",
    "blanes-moan-6",
    "rk2",
    "rk4",
    "rk8",
    "implicit-midpoint",
    "backward-euler",
    "xpbd",
    "path",
];

/// The solver of that name.
///
/// Errors: what is wrong with the name, and which would do.
pub fn solver(name: &str) -> Result<Solver, String> {
    match name {
        "auto" => Ok(Solver::Auto),
        "verlet" => Ok(Solver::Verlet),
        "relaxation" => Ok(Solver::Relaxation),
        _ if MISSING.contains(&name) => {
            Err(format!("solver `{name}` is not in this version: use auto, verlet or relaxation"))
        }
        _ => Err(format!("there is no solver `{name}`: use auto, verlet or relaxation")),
    }
}

/// The name of a solver.
pub fn solver_name(solver: Solver) -> &'static str {
    match solver {
        Solver::Auto => "auto",
        Solver::Verlet => "verlet",
        Solver::Relaxation => "relaxation",
    }
}

/// Checks the numbers and names of a method.
pub(crate) fn check(file: &MethodFile) -> Result<(), Problem> {
    read(file)?;
    if let Some(substep) = file.substep {
        above_zero("substep", substep)?;
    }
    if file.iterations == Some(0) {
        return Err(Problem::new("iterations", "is 0: give 1 or more"));
    }
    for (key, value) in [("tolerance", file.tolerance), ("max_strain", file.max_strain)] {
        if let Some(value) = value {
            at_least_zero(key, value)?;
        }
    }
    Ok(())
}

/// The method that the keys mean.
pub(crate) fn read(file: &MethodFile) -> Result<Method, Problem> {
    let name = file.solver.as_deref().unwrap_or("auto");
    Ok(Method {
        solver: solver(name).map_err(|problem| Problem::new("solver", problem))?,
        substep: file.substep,
        iterations: file.iterations,
        order: match file.order {
            OrderFile::Auto => Order::Auto,
            OrderFile::Fixed => Order::Fixed,
            OrderFile::Symmetric => Order::Symmetric,
            OrderFile::Coloured => Order::Coloured,
            OrderFile::Shuffled => Order::Shuffled,
        },
        seed: file.seed,
        precision: match file.precision {
            PrecisionFile::Auto => Precision::Auto,
            PrecisionFile::F32 => Precision::F32,
            PrecisionFile::F64 => Precision::F64,
        },
    })
}
