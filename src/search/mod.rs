//! The cheapest setting that reaches an error, found on the scene itself by counted work, never by a clock.
//!
//! A reference is made first: a method of high order with a substep that is halved until the samples stand still. Then
//! every method that fits is tried against it, each at the largest substep that stays within the tolerance.

mod candidates;
mod trial;

use crate::sim::bond::BondKind;
use crate::sim::model::{Method, Model, ModelError};
use crate::sim::solver::Solver;
use trial::{Trial, Trials};

/// What a search found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The setting: a solver by name and a substep.
    pub method: Method,
    /// The error that it is expected to have at every sample `[m]`.
    pub expected_error: f64,
    /// Whether that is within the tolerance.
    pub is_reached: bool,
    /// Substeps that the whole search took.
    pub substeps: u64,
}

/// Share of the tolerance that a setting may use: the rest is for what the estimate misses.
const SHARE: f64 = 0.4;
/// A reference is good when halving its substep changes no sample by more than this share of the tolerance.
const REFERENCE: f64 = 0.02;
/// What rounding makes of a position at least, in units of the last place.
const ROUNDED: f64 = 4.0;
/// Changes of a sample that may be rounding `[m]`: where they stop falling, halving on is of no use.
const ROUNDING: f64 = 1e-9;
/// From one substep of a reference to the next: not a half, for guards split substeps in halves, and two runs that a
/// guard brings to the same substeps would agree in their errors.
const CUT: f64 = 0.45;
/// Cuts of a substep before a method is given up.
const MOST_HALVINGS: u32 = 24;

/// Finds the cheapest setting that reaches `tolerance` `[m]` at every one of `times` `[s]`.
///
/// A solver or a substep that the method says is kept. The model should end at the last of the times. Samples of the
/// same model are compared with each other, so that what all methods get wrong alike is not seen.
/// Errors: as [`Model::check`]; relaxed bonds, which have no error.
pub fn search<const D: usize>(model: &Model<D>, tolerance: f64, times: &[f64]) -> Result<Found, ModelError> {
    model.check()?;
    if let Some(bond) = model.bonds.iter().position(|bond| matches!(bond.kind, BondKind::Relaxed { .. })) {
        return Err(ModelError::NoError { bond });
    }
    if times.iter().all(|&t| t == 0.0) {
        let method = Method { tolerance: None, ..model.method };
        return Ok(Found { method, expected_error: 0.0, is_reached: true, substeps: 0 });
    }
    let mut trials = Trials::new(model, times);
    let kinds = candidates::of(model);
    let Some(reference) = find_reference(&mut trials, &kinds.references, tolerance)? else {
        return settle_for(&mut trials, &kinds.solvers, model.method);
    };
    let mut best: Option<(Trial, f64)> = None;
    for &solver in &kinds.solvers {
        let limit = best.as_ref().map_or(f64::INFINITY, |(trial, _)| trial.work);
        if let Some((trial, error)) = cheapest(&mut trials, solver, &reference, tolerance, limit)? {
            best = Some((trial, error));
        }
    }
    let (trial, error) = best.unwrap_or_else(|| (reference.trial.clone(), 0.0));
    // No run is better than its rounding.
    let estimate = (error + reference.uncertainty).max(ROUNDED * f64::EPSILON * reference.trial.extent());
    let is_reached = estimate <= tolerance;
    // Runs that stumbled where they do not agree say nothing of how far off both are.
    let is_known = is_reached || !reference.trial.is_patched;
    Ok(Found {
        method: trial.method,
        expected_error: if is_known { estimate } else { f64::INFINITY },
        is_reached,
        substeps: trials.substeps,
    })
}

/// Samples that others are held against.
struct Reference {
    trial: Trial,
    /// How far they moved when the substep was halved for the last time `[m]`, less what the order takes off that.
    uncertainty: f64,
}

/// Halves the substep of a method of high order until samples stand still; the next method where it does not get there.
fn find_reference<const D: usize>(
    trials: &mut Trials<'_, D>,
    solvers: &[Solver],
    tolerance: f64,
) -> Result<Option<Reference>, ModelError> {
    let mut best: Option<Reference> = None;
    for &solver in solvers {
        let mut substep = trials.longest(solver);
        let mut last: Option<Trial> = None;
        let mut change = f64::INFINITY;
        let mut worse = 0;
        for _ in 0..MOST_HALVINGS {
            if let Some(trial) = trials.run(solver, substep, f64::INFINITY)? {
                if let Some(last) = last.as_ref().filter(|last| trial.work > 1.3 * last.work) {
                    let now = trial.distance(last);
                    worse = if now > 0.7 * change && now < ROUNDING { worse + 1 } else { 0 };
                    let before = std::mem::replace(&mut change, now);
                    let uncertainty = change / f64::from(1_u32 << solver.order().min(4)).max(2.0);
                    if best.as_ref().is_none_or(|best| uncertainty < best.uncertainty) {
                        best = Some(Reference { trial: trial.clone(), uncertainty });
                    }
                    if change <= REFERENCE * tolerance && before <= tolerance {
                        return Ok(best);
                    }
                }
                last = Some(trial);
            } else if last.is_some() {
                break;
            }
            // What is left is rounding: no method gets further.
            if worse >= 3 {
                return Ok(best);
            }
            if trials.is_spent() {
                break;
            }
            substep *= CUT;
        }
        if best.as_ref().is_some_and(|best| best.uncertainty <= tolerance) || trials.is_spent() {
            break;
        }
    }
    Ok(best)
}

/// The cheapest substep of a method that stays within the tolerance, if that is cheaper than `limit`.
fn cheapest<const D: usize>(
    trials: &mut Trials<'_, D>,
    solver: Solver,
    reference: &Reference,
    tolerance: f64,
    limit: f64,
) -> Result<Option<(Trial, f64)>, ModelError> {
    let goal = SHARE * tolerance;
    let mut substep = trials.longest(solver);
    let mut best: Option<(Trial, f64)> = None;
    let mut last: Option<(f64, f64)> = None;
    let (mut too_long, mut tries, mut idle) = (f64::INFINITY, 0, 0);
    for _ in 0..MOST_HALVINGS {
        let limit = best.as_ref().map_or(limit, |(trial, _)| trial.work);
        let trial = trials.run(solver, substep, limit)?;
        let error = trial.as_ref().map_or(f64::INFINITY, |trial| trial.distance(&reference.trial));
        if trial.is_none() && trials.was_dear() {
            break;
        }
        if error <= goal {
            best = trial.map(|trial| (trial, error));
            tries += 1;
            // Between this one and the shortest that was too long there may be a longer one.
            let next = if error > 0.0 {
                substep * (0.8 * goal / error).powf(1.0 / f64::from(solver.order()))
            } else {
                too_long
            };
            let next = next.min((substep * too_long).sqrt()).min(2.0 * substep);
            if tries >= 3 || !too_long.is_finite() || next < 1.15 * substep {
                break;
            }
            substep = next;
            continue;
        }
        too_long = too_long.min(substep);
        if best.is_some() {
            break;
        }
        // As far as the order says, but no more than a factor of 8, for it may be wrong so far out.
        let order = order_seen(last, (substep, error)).unwrap_or_else(|| f64::from(solver.order()));
        let share = if error.is_finite() { (0.7 * goal / error).powf(1.0 / order).clamp(0.125, 0.8) } else { 0.5 };
        if error.is_finite() && best.is_none() && share * substep < substep && last.is_some() {
            let predicted = trials.last_work() * substep / (substep * (0.7 * goal / error).powf(1.0 / order));
            if predicted > 1.5 * limit {
                break;
            }
        }
        // An error that does not fall with the substep is the reference's: no substep will do.
        idle = if order < 0.5 { idle + 1 } else { 0 };
        if idle > 2 {
            break;
        }
        last = Some((substep, error));
        substep *= share;
        if trials.is_spent() {
            break;
        }
    }
    Ok(best)
}

/// The order that two errors show, if they show one.
fn order_seen(last: Option<(f64, f64)>, now: (f64, f64)) -> Option<f64> {
    let (h, error) = last?;
    let order = (error / now.1).ln() / (h / now.0).ln();
    order.is_finite().then(|| order.clamp(0.4, 12.0))
}

/// Where no reference could be made at all: the first method that runs.
fn settle_for<const D: usize>(
    trials: &mut Trials<'_, D>,
    solvers: &[Solver],
    method: Method,
) -> Result<Found, ModelError> {
    for &solver in solvers {
        let substep = trials.longest(solver) / 16.0;
        if let Some(trial) = trials.run(solver, substep, f64::INFINITY)? {
            return Ok(Found {
                method: trial.method,
                expected_error: f64::INFINITY,
                is_reached: false,
                substeps: trials.substeps,
            });
        }
    }
    let method = Method { tolerance: None, ..method };
    Ok(Found { method, expected_error: f64::INFINITY, is_reached: false, substeps: trials.substeps })
}
