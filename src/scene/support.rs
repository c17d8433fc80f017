//! What this version of the engine runs of what a scene can say: the rest is refused by name, never ignored.

use super::check::Resistance;
use super::error::Fault;
use super::keys::{Scene, SolverName};
use super::start::resistance;
use crate::sim::{self, BondKind};

/// Errors: the first key that this version cannot run.
pub(super) fn check(scene: &Scene) -> Result<(), Fault> {
    for (key, said) in [
        ("triangles", !scene.triangles.is_empty()),
        ("areas", scene.areas.is_some()),
        ("texture", scene.texture.is_some()),
        ("wind", scene.wind.is_some()),
        ("pin_motion", !scene.pin_motion.is_empty()),
        ("obstacles", !scene.obstacles.is_empty()),
    ] {
        if said {
            return Err(lacking(key));
        }
    }
    for (i, bond) in scene.bonds.iter().enumerate() {
        if bond.break_strain.is_some() {
            return Err(lacking("break_strain").item(i).at("bonds"));
        }
    }
    for (i, body) in scene.bodies.iter().enumerate() {
        let material = body.material.as_ref();
        if material.is_some_and(|material| material.break_strain.is_some()) {
            return Err(lacking("break_strain").at("material").item(i).at("bodies"));
        }
    }
    if scene.method.tolerance.is_some() {
        return Err(lacking("tolerance").at("method"));
    }
    if scene.method.max_strain.is_some() {
        return Err(lacking("max_strain").at("method"));
    }
    Ok(())
}

fn lacking(key: &str) -> Fault {
    Fault::unsupported(format!("`{key}` is not in this version: leave it out")).at(key)
}

/// The method in the engine's words.
///
/// Errors: a solver that this version lacks; springs under `relaxation`; bonds that are swept without substep and
/// iterations, which they mean nothing without.
pub(super) fn method(scene: &Scene) -> Result<sim::Method, Fault> {
    let keys = &scene.method;
    let solver = match keys.solver.unwrap_or(SolverName::Auto) {
        SolverName::Auto => sim::Solver::Auto,
        SolverName::Verlet => sim::Solver::Verlet,
        SolverName::Relaxation => sim::Solver::Relaxation,
        other => {
            let message = format!("solver `{other}` is not in this version: use auto, verlet or relaxation");
            return Err(Fault::unsupported(message).at("solver").at("method"));
        }
    };
    if solver == sim::Solver::Relaxation
        && let Some(spring) = find(scene, |kind| matches!(kind, BondKind::Spring { .. }))
    {
        let message = "is a spring, which solver `relaxation` refuses: use auto or verlet, or relaxed bonds";
        return Err(spring.fault(message));
    }
    let swept =
        solver == sim::Solver::Relaxation || find(scene, |kind| matches!(kind, BondKind::Relaxed { .. })).is_some();
    for (key, said) in [("substep", keys.substep.is_some()), ("iterations", keys.iterations.is_some())] {
        if swept && !said {
            return Err(Fault::invalid(format!(
                "relaxed bonds need `substep` and `iterations` from the scene or the call, for they mean nothing \
                 without: give `{key}`"
            ))
            .at("method"));
        }
    }
    Ok(sim::Method {
        solver,
        substep: keys.substep,
        iterations: keys.iterations,
        order: keys.order(),
        seed: keys.seed.unwrap_or(0),
        precision: keys.precision(),
    })
}

/// Where bonds of a kind were found.
enum Found {
    Bond(usize),
    Body(usize),
}

impl Found {
    fn fault(&self, message: &str) -> Fault {
        match self {
            Found::Bond(i) => Fault::invalid(message).item(*i).at("bonds"),
            Found::Body(i) => {
                let message = format!("the material {message}");
                Fault::invalid(message).item(*i).at("bodies")
            }
        }
    }
}

/// The first bond, or body with bonds, of a kind.
fn find(scene: &Scene, is: impl Fn(BondKind) -> bool) -> Option<Found> {
    let bond = scene.bonds.iter();
    let bond = bond.map(|bond| Resistance::from(bond).resolve()).position(&is);
    bond.map(Found::Bond).or_else(|| {
        let body = scene.bodies.iter();
        let body = body.map(|body| resistance(body).resolve()).position(&is);
        body.map(Found::Body)
    })
}
