//! What this version of the engine runs of what a scene can say: the rest is refused by name, never ignored.

use super::check::Resistance;
use super::error::{Fault, SceneError, Source};
use super::keys::{BodyKeys, BudgetKeys, MakerName, Meeting, MethodKeys, Scene, SolverName};
use super::obstacle;
use super::start::resistance;
use crate::sim::{self, BondKind};

/// Keys of a scene that a later version brings.
pub(crate) const LATER: [&str; 1] = ["drives"];

/// Counted work of a frame of 1/60 s where nothing is said `[ms]`: the rest of a frame is for drawing it.
const BUDGET: f64 = 6.0;

/// Errors: the first key that this version cannot run.
pub(super) fn check(scene: &Scene) -> Result<(), Fault> {
    check_form(scene)?;
    check_contact(scene)?;
    Ok(())
}

/// Errors: angles or areas under a solver that knows none.
fn check_form(scene: &Scene) -> Result<(), Fault> {
    let solver = solver(&scene.method)?;
    let Some(others) = solver.form_refusal() else {
        return Ok(());
    };
    let bends =
        |body: &BodyKeys| body.material.as_ref().and_then(|material| material.bending).is_some_and(|ei| ei > 0.0);
    let has_joints = |body: &BodyKeys| body.make == MakerName::Ragdoll;
    let resist = scene.areas.is_some_and(|areas| areas.kind.is_some() || areas.stiffness.is_some());
    let refused = |what: &str| Fault::invalid(format!("solver `{solver}` knows no {what}: use {others}"));
    if resist {
        return Err(refused("areas").at("areas"));
    }
    if !scene.angles.is_empty() {
        return Err(refused("angles").at("angles"));
    }
    if let Some(body) = scene.bodies.iter().position(has_joints) {
        return Err(refused("joints").at("make").item(body).at("bodies"));
    }
    match scene.bodies.iter().position(bends) {
        Some(body) => Err(refused("bending").at("material").item(body).at("bodies")),
        None => Ok(()),
    }
}

/// Errors: bodies cannot meet, or balls and boxes in space cannot be met, by this solver or within a tolerance.
fn check_contact(scene: &Scene) -> Result<(), Fault> {
    let solver = scene.method.solver.unwrap_or(SolverName::Auto);
    let is_live = matches!(solver, SolverName::Auto | SolverName::Live);
    let has_tolerance = scene.method.tolerance.is_some();
    if scene.contact.and_then(Meeting::resolve).is_some() {
        if !is_live {
            let message = format!("solver `{solver}` knows no contact: leave `solver` or `contact` out");
            return Err(Fault::invalid(message).at("solver").at("method"));
        }
        if has_tolerance {
            let message =
                "no tolerance is held to where bodies meet in this version: leave `tolerance` or `contact` out";
            return Err(Fault::unsupported(message).at("tolerance").at("method"));
        }
    }
    if obstacle::convex(scene).is_empty() {
        return Ok(());
    }
    if !is_live && solver != SolverName::AsPrinted {
        let message = format!("solver `{solver}` does not meet balls and boxes in space: leave `solver` out");
        return Err(Fault::invalid(message).at("solver").at("method"));
    }
    if has_tolerance {
        let message = "no tolerance is held to among balls and boxes in this version: leave `tolerance` out";
        return Err(Fault::unsupported(message).at("tolerance").at("method"));
    }
    Ok(())
}

/// The solver in the engine's words.
///
/// Errors: one that this version lacks; `as-printed` without a `source`, or another one with it.
fn solver(keys: &MethodKeys) -> Result<sim::Solver, Fault> {
    let name = keys.solver.unwrap_or(SolverName::Auto);
    let fault = |fault: Fault, key| Err(fault.at(key).at("method"));
    match (name, keys.source) {
        (SolverName::AsPrinted, Some(source)) => {
            let found = sim::Source::ALL.into_iter().find(|known| known.name() == source.name());
            return found.map(sim::Solver::AsPrinted).map_or_else(
                || fault(Fault::unsupported(format!("source `{source}` is not in this version")), "source"),
                Ok,
            );
        }
        (SolverName::AsPrinted, None) => {
            let known = super::nearest::list(&sim::Source::ALL.map(sim::Source::name));
            let message = format!("solver `as-printed` needs to know whose loop: give `source`, one of {known}");
            return fault(Fault::invalid(message), "solver");
        }
        (_, Some(_)) => {
            let message = format!("`source` is for solver `as-printed`, not `{name}`: leave it out");
            return fault(Fault::invalid(message), "source");
        }
        _ => {}
    }
    sim::Solver::ALL.into_iter().find(|solver| solver.name() == name.name()).map_or_else(
        || {
            let known: Vec<&str> = sim::Solver::ALL.iter().map(|solver| solver.name()).collect();
            let message = format!("solver `{name}` is not in this version: use {}", super::nearest::list(&known));
            fault(Fault::unsupported(message), "solver")
        },
        Ok,
    )
}

/// The method in the engine's words.
///
/// Errors: a solver that this version lacks; a solver that refuses a kind of bond; bonds that are swept without
/// substep and iterations, which they mean nothing without.
pub(super) fn method(scene: &Scene) -> Result<sim::Method, Fault> {
    let keys = &scene.method;
    let solver = solver(keys)?;
    if let Some(found) = find(scene, |kind| solver.refusal(kind).is_some())
        && let Some((kind, others)) = solver.refusal(found.kind)
    {
        return Err(found.fault(&format!("is {kind}, which solver `{solver}` refuses: use {others}")));
    }
    // A source says itself how long its step is and how often it sweeps.
    let swept = !matches!(solver, sim::Solver::AsPrinted(_))
        && (solver == sim::Solver::Relaxation
            || find(scene, |kind| matches!(kind, BondKind::Relaxed { .. })).is_some());
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
        tolerance: keys.tolerance,
        max_strain: keys.max_strain,
        ledger: keys.ledger.unwrap_or(false),
        budget: if keys.tolerance.is_some() { None } else { keys.budget.map_or(Some(BUDGET), BudgetKeys::ms) },
        sleeps: keys.sleep.unwrap_or(keys.tolerance.is_none()),
        settles: keys.settle.unwrap_or(keys.tolerance.is_none()),
    })
}

/// Bonds of a kind, and where they were found.
struct Found {
    kind: BondKind,
    place: Place,
}

enum Place {
    Bond(usize),
    Body(usize),
}

impl Found {
    fn fault(&self, message: &str) -> Fault {
        match self.place {
            Place::Bond(i) => Fault::invalid(message).item(i).at("bonds"),
            Place::Body(i) => {
                let message = format!("the material {message}");
                Fault::invalid(message).item(i).at("bodies")
            }
        }
    }
}

/// The first bond, or body with bonds, of a kind.
fn find(scene: &Scene, is: impl Fn(BondKind) -> bool) -> Option<Found> {
    let kinds: Vec<BondKind> =
        scene.bonds.materials().iter().map(|material| Resistance::from(material).resolve()).collect();
    // Most scenes have none of the kind: their bonds need not be looked at.
    let listed = if kinds.iter().any(|&kind| is(kind)) { scene.bonds.len() } else { 0 };
    let bonds = (0..listed).map(|i| Found { kind: kinds[scene.bonds.material(i)], place: Place::Bond(i) });
    let bodies = scene.bodies.iter().map(|body| resistance(body).resolve());
    let bodies = bodies.enumerate().map(|(i, kind)| Found { kind, place: Place::Body(i) });
    bonds.chain(bodies).find(|found| is(found.kind))
}

impl Scene {
    /// The method in the engine's words, for what the scene has at its start.
    ///
    /// Errors: those of [`Scene::model`] that are the method's.
    pub(crate) fn engine_method(&self) -> Result<sim::Method, SceneError> {
        method(self).map_err(|fault| Source::default().error(fault))
    }
}
